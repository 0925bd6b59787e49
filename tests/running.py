"""The command in this process, as users and their scripts see it."""

import io
from contextlib import redirect_stderr, redirect_stdout

from replication.cli import main


def coldspray(*arguments: object) -> tuple[int, str, str]:
    """Run the command: status, standard output, standard error."""
    out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True) for _ in range(2))
    with redirect_stdout(out), redirect_stderr(err):
        try:
            status = main([str(argument) for argument in arguments])
        except SystemExit as done:
            status = int(str(done.code))
    text, said = (stream.buffer.getvalue().decode() for stream in (out, err))  # type: ignore[attr-defined]
    return status, text, said

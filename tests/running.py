"""Run the command in this process, and return what users and their scripts see of it."""

import io
from contextlib import redirect_stderr, redirect_stdout

from replication.cli import main


def coldspray(*arguments: object) -> tuple[int, str, str]:
    """Run the command and return its status, standard output and standard error."""
    out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True) for _ in range(2))
    with redirect_stdout(out), redirect_stderr(err):
        try:
            status = main([str(argument) for argument in arguments])
        except SystemExit as done:
            status = int(str(done.code))
    printed, errors = (stream.buffer.getvalue().decode() for stream in (out, err))  # type: ignore[attr-defined]
    return status, printed, errors

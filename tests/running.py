"""Run the command in this process, and return what users and their scripts see of it."""

import io
import re
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path

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


def state(folder: Path) -> dict[str, bytes | None]:
    """Return the content of every file in a folder; None for what is not a regular file."""
    return {
        str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None
        for path in folder.rglob("*")
    }


def promised(folder: Path, *arguments: str) -> tuple[int, str, str]:
    """Run a command in a folder and return what `coldspray` does, if it keeps its promises.

    The exit status is 0, 1 or 2. At status 2 nothing is printed on standard output, no file is
    written, and standard error has one short line without control characters.
    """
    before = state(folder)
    with chdir(folder):
        status, out, err = coldspray(*arguments)
    assert status in (0, 1, 2)
    assert "Traceback" not in err
    for line in err.splitlines():
        assert len(line) <= 400
        assert line.isprintable()
    if status == 2:
        assert out == ""
        assert err.endswith("\n")
        assert len(err.splitlines()) == 1
        assert state(folder) == before
    elif arguments and arguments[0] != "stability":  # some of its cases have such numbers
        assert not re.search(r"\b(?:nan|inf(?:inity)?)\b", out.lower())
    return status, out, err

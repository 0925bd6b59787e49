"""Print results: text, JSON or CSV on stdout; warnings and progress on stderr."""

import argparse
import codecs
import json
import os
import re
import shutil
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TextIO

from replication.text import json_text, prose, rows_csv
from replication.user_input import one_line


def put(
    options: argparse.Namespace,
    record: Any,
    text: Callable[[], str],
    rows: Sequence[Mapping[str, Any]] = (),
    warnings: Iterable[object] = (),
    notes: Iterable[str] = (),
    quietly: bool = False,
) -> int:
    """Print a command's result as JSON, rows of CSV or text, as asked for, and return status 0.

    Warnings, of what is not as expected, go to standard error; notes, of what is, stand below the
    text. `--quiet` suppresses both; for JSON the record contains them.
    quietly: the text only reports what was done, so `--quiet` suppresses it, too.
    """
    if options.json:
        put_json(json_text(record))
        return 0
    if "csv" in options and options.csv:
        sys.stdout.write(rows_csv(rows))
    elif not (quietly and options.quiet):
        print(text())
        for note in () if options.quiet else notes:
            print(paragraph(f"note: {note}", hanging="  "))
    for warning in () if options.quiet else warnings:
        complain(f"coldspray {options.command}", f"warning: {warning}")
    return 0


def complain(program: str, message: str) -> None:
    """Print a message as one line on stderr.

    If that fails, as on a full disk, the exit status is still that of the work.
    """
    if sys.stderr is not None:
        try:
            print(f"{program}: {one_line(message)}", file=sys.stderr, flush=True)
        except OSError:
            discard(sys.stderr)


def discard(stream: TextIO | None) -> None:
    """Redirect a stream to nowhere: otherwise Python retries the failed write when it exits."""
    # A stream that a caller has put in place of Python's own is left alone.
    if stream in (sys.__stdout__, sys.__stderr__) and stream is not None:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def put_json(text: str) -> None:
    """Print JSON. It is read as UTF-8, so for any other encoding of stdout use only ASCII."""
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    if codecs.lookup(encoding).name != "utf-8":
        text = re.sub("[^\\x00-\\x7f]", lambda match: json.dumps(match[0])[1:-1], text)
    sys.stdout.write(text)


def is_terminal() -> bool:
    """Return whether stdout is a terminal."""
    return sys.stdout.isatty()


def width(piped: int = 80) -> int:
    """Return the number of columns of the terminal, or `piped` if stdout is not a terminal."""
    return shutil.get_terminal_size().columns if is_terminal() else piped


def paragraph(text: str, indent: str = "", hanging: str = "") -> str:
    """Wrap a text to the terminal, but to lines of at most 100 characters, which one can read.

    indent and hanging: blanks before the first line, and before the others.
    """
    return prose(text, min(width(), 100), indent, hanging)


def may_emphasize() -> bool:
    """Return whether bold text and colours may be printed: on a terminal, without NO_COLOR."""
    is_capable = is_terminal() and os.environ.get("TERM") != "dumb"
    return is_capable and not os.environ.get("NO_COLOR")


def progress(options: argparse.Namespace, items: Any = None, **settings: Any) -> Any:
    """Return a progress bar, which shows nothing if quiet or without a terminal."""
    from tqdm import tqdm

    return tqdm(items, **settings, disable=options.quiet or None)  # None: unless on a terminal

"""Print results: text, JSON or CSV on stdout; warnings and progress on stderr."""

import argparse
import codecs
import json
import os
import re
import shutil
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from replication.reading import one_line
from replication.text import json_text, rows_csv


def put(
    options: argparse.Namespace,
    record: Any,
    text: Callable[[], str],
    rows: Sequence[Mapping[str, Any]] = (),
    warnings: Iterable[object] = (),
    quietly: bool = False,
) -> int:
    """Print a command's result as JSON, rows of CSV or text, as asked for, and return status 0.

    Warnings go to standard error, unless `--quiet` is given; for JSON the record contains them.
    quietly: the text only reports what was done, so `--quiet` suppresses it, too.
    """
    if options.json:
        put_json(json_text(record))
        return 0
    if "csv" in options and options.csv:
        sys.stdout.write(rows_csv(rows))
    elif not (quietly and options.quiet):
        print(text())
    for warning in () if options.quiet else warnings:
        print(one_line(f"coldspray {options.command}: warning: {warning}"), file=sys.stderr)
    return 0


def put_json(text: str) -> None:
    """Print JSON. It is read as UTF-8, so for any other encoding of stdout use only ASCII."""
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    if codecs.lookup(encoding).name != "utf-8":
        text = re.sub("[^\\x00-\\x7f]", lambda match: json.dumps(match[0])[1:-1], text)
    sys.stdout.write(text)


def width(piped: int = 80) -> int:
    """Return the number of columns of the terminal, or `piped` if stdout is not a terminal."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else piped


def may_emphasize() -> bool:
    """Return whether bold text may be printed: on a capable terminal, without NO_COLOR."""
    is_capable = sys.stdout.isatty() and os.environ.get("TERM") != "dumb"
    return is_capable and not os.environ.get("NO_COLOR")


def progress(options: argparse.Namespace, items: Any = None, **settings: Any) -> Any:
    """Return a progress bar, which shows nothing if quiet or without a terminal."""
    from tqdm import tqdm

    return tqdm(items, **settings, disable=options.quiet or None)  # None: unless on a terminal

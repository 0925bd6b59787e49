"""What `check` and `diff` share: files of the differences they found, and the exit status."""

import argparse
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from replication.cli.options import add_json, add_quiet, path
from replication.cli.output import put, width


def add_files(parser: argparse.ArgumentParser) -> None:
    """Add --html, --junit, --json and --quiet."""
    parser.add_argument(
        "--html", metavar="FILE", type=path, help="also write a page with the cells marked"
    )
    parser.add_argument(
        "--junit", metavar="FILE", type=path, help="also write the result as JUnit XML"
    )
    add_json(parser)
    add_quiet(parser, "print nothing; the exit status tells the result")


def check_files(options: argparse.Namespace, *workbooks: Path) -> None:
    """Raise OSError or ValueError if --html or --junit names a file that must not be written."""
    from spreadsheets.safely import check_own, check_target

    marks = (
        (options.html, b'<meta name="generator" content="coldspray '),
        (options.junit, b'<testsuite name="coldspray '),
    )
    written = [str(check_target(file)) for file, _ in marks if file is not None]
    read = {os.path.realpath(file) for file in workbooks}  # unlike resolve(), no error for a loop
    if len({*written, *read}) < len(written) + len(read):
        raise ValueError("--html and --junit each need a file of their own, not one that is read")
    for file, mark in marks:
        if file is not None:
            check_own(file, mark)


def put_differences(
    options: argparse.Namespace,
    record: dict[str, Any],
    text: Callable[[Mapping[str, Any], int], str],
    page: Callable[[], str],
    junit: Callable[[Mapping[str, Any]], str],
) -> int:
    """Write the files asked for, print the record as JSON or text, and return the exit status."""
    from spreadsheets.safely import write_files

    written = list[tuple[Path, bytes]]()
    if options.html is not None:
        written.append((options.html, page().encode()))
    if options.junit is not None:
        written.append((options.junit, junit(record).encode()))
    write_files(written)
    put(options, record, lambda: text(record, width(piped=10_000)), quietly=True)
    return 0 if record["clean"] else 1

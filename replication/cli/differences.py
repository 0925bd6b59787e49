"""What `check` and `diff` share: files of the differences they found, and the exit status."""

import argparse
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from replication.cli.options import add_json, add_quiet, path
from replication.cli.output import put


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
    from spreadsheets.safely import check_target

    files = [file for file in (options.html, options.junit) if file is not None]
    written = [str(check_target(file)) for file in files]
    read = {os.path.realpath(file) for file in workbooks}  # unlike resolve(), no error for a loop
    if len({*written, *read}) < len(written) + len(read):
        raise ValueError("--html and --junit each need a file of their own, not one that is read")


def put_differences(
    options: argparse.Namespace,
    record: dict[str, Any],
    page: Callable[[], str],
    kinds: Sequence[str],
) -> int:
    """Write the files asked for, print the record as JSON or text, and return the exit status."""
    from replication.check import show
    from spreadsheets.safely import write_bytes

    if options.html is not None:
        write_bytes(options.html, page().encode())
    if options.junit is not None:
        write_bytes(options.junit, show.junit(record, kinds).encode())
    put(options, record, lambda: show.text(record), quietly=True)
    return 0 if record["clean"] else 1

"""`coldspray check`: somebody's own workbook of the scheme, against the report's sheet."""

import argparse
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from replication.cli import options as shared

if TYPE_CHECKING:
    from replication.check.examination import Difference
    from spreadsheets.recalculation import Calculation


def check_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.add_argument(
        "file", type=shared.path, metavar="FILE", help="an .xlsx file; or .xlsm, .xls, .xlsb, .ods"
    )
    command.add_argument(
        "--map", action="append", default=[], metavar="NAME=RANGE",
        help="where a column or an input is: depth=Sheet1!D8:D139, radius=B4",
    )  # fmt: skip
    finding_options(command)


def run_check(options: argparse.Namespace) -> int:
    """Check, and say what was found: 1 if the workbook is not the report's sheet."""
    check_files(options, options.file)
    from replication.check.examination import KINDS
    from replication.check.show import check_record
    from replication.check.workbook import check

    mapping = {}
    for text in options.map:
        name, _, where = text.partition("=")
        if not where:
            raise ValueError(f"--map {text[:60]!r}: give NAME=RANGE, such as depth=D8:D139")
        mapping[name.strip().replace("-", "_")] = where.strip()
    checked = check(options.file, mapping)
    return put(options, check_record(checked), checked.differences, checked.calculation, KINDS)


# What `diff` does in the same way.


def finding_options(command: argparse.ArgumentParser) -> None:
    """--json, --html, --junit and --quiet: how what was found in a workbook is given."""
    command.add_argument("--json", action="store_true", help="print JSON")
    command.add_argument(
        "--html", type=shared.path, metavar="FILE", help="write a page with the cells marked"
    )
    command.add_argument("--junit", type=shared.path, metavar="FILE", help="write a JUnit file")
    command.add_argument("--quiet", action="store_true", help="print nothing; the status tells")


def check_files(options: argparse.Namespace, *workbooks: Path) -> None:
    """Raise OSError or ValueError, before any work, where a file cannot or must not be written."""
    from spreadsheets.safely import check_target

    files = [file for file in (options.html, options.junit) if file is not None]
    written = [str(check_target(file)) for file in files]
    read = {os.path.realpath(file) for file in workbooks}  # unlike resolve(), no error for a loop
    if len({*written, *read}) < len(written) + len(read):
        raise ValueError("--html and --junit each need a file of their own, none that is read")


def put(
    options: argparse.Namespace,
    record: dict[str, Any],
    differences: "Sequence[Difference]",
    calculation: "Calculation",
    kinds: Sequence[str],
) -> int:
    """Write the files that were asked for, then print the record as JSON or as text: the status."""
    from replication.check import show
    from spreadsheets.safely import write_bytes

    if options.html is not None:
        write_bytes(options.html, show.html(record, differences, calculation).encode())
    if options.junit is not None:
        write_bytes(options.junit, show.junit(record, kinds).encode())
    if options.json:
        shared.print_json(record)
    elif not options.quiet:
        print(show.text(record))
    return 0 if record["clean"] else 1

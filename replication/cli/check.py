"""`coldspray check` and `diff`: somebody's workbook against the report's sheet, or another one."""

import argparse
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from replication.cli import options as shared
from replication.reading import quoted

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
    _finding_options(command)


def run_check(options: argparse.Namespace) -> int:
    """Check, and say what was found: 1 if the workbook is not the report's sheet."""
    _check_files(options, options.file)
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
    return _put(options, check_record(checked), checked.differences, checked.calculation, KINDS)


def diff_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.add_argument("first", type=shared.path, metavar="A.xlsx", help="one workbook")
    command.add_argument("second", type=shared.path, metavar="B.xlsx", help="the other")
    command.add_argument("--values-only", action="store_true", help="leave formulas aside")
    command.add_argument(
        "--ulp", type=shared.whole(0, 10**9), default=0, metavar="N",
        help="equal if at most N doubles apart",
    )  # fmt: skip
    command.add_argument(
        "--relative", type=_share, default=0.0, metavar="X",
        help="equal if at most X times the number apart",
    )  # fmt: skip
    command.add_argument(
        "--digits", type=shared.whole(1, 17), metavar="N",
        help="equal if they print alike to N digits",
    )  # fmt: skip
    _finding_options(command)


def run_diff(options: argparse.Namespace) -> int:
    """Compare, and say what was found: 1 if anything differs."""
    _check_files(options, options.first, options.second)
    from replication.check.diff import KINDS, Tolerance, diff
    from replication.check.show import diff_record

    allowed = Tolerance(options.ulp, options.relative, options.digits)
    both = options.first, options.second
    comparison = diff(*both, values_only=options.values_only, allowed=allowed)
    record = diff_record(comparison)
    return _put(options, record, comparison.differences, comparison.after, KINDS)


def _share(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if not 0 <= number <= 1:
        raise argparse.ArgumentTypeError(f"give a number from 0 to 1, not {quoted(text)}")
    return number


# What both do in the same way.


def _finding_options(command: argparse.ArgumentParser) -> None:
    """--json, --html, --junit and --quiet: how what was found in a workbook is given."""
    command.add_argument("--json", action="store_true", help="print JSON")
    command.add_argument(
        "--html", type=shared.path, metavar="FILE", help="write a page with the cells marked"
    )
    command.add_argument("--junit", type=shared.path, metavar="FILE", help="write a JUnit file")
    command.add_argument("--quiet", action="store_true", help="print nothing; the status tells")


def _check_files(options: argparse.Namespace, *workbooks: Path) -> None:
    """Raise OSError or ValueError, before any work, where a file cannot or must not be written."""
    from spreadsheets.safely import check_target

    files = [file for file in (options.html, options.junit) if file is not None]
    written = [str(check_target(file)) for file in files]
    read = {os.path.realpath(file) for file in workbooks}  # unlike resolve(), no error for a loop
    if len({*written, *read}) < len(written) + len(read):
        raise ValueError("--html and --junit each need a file of their own, none that is read")


def _put(
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

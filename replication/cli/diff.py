"""`coldspray diff`: two workbooks, their layout, formulas and values."""

import argparse

from replication.cli import options as shared
from replication.cli.check import check_files, finding_options, put

HELP = "compare two workbooks: layout, formulas and values"


def options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.add_argument("first", type=shared.path, metavar="A.xlsx", help="one workbook")
    command.add_argument("second", type=shared.path, metavar="B.xlsx", help="the other")
    command.add_argument("--values-only", action="store_true", help="leave formulas aside")
    command.add_argument("--ulp", metavar="N", help="equal if at most N doubles apart")
    command.add_argument(
        "--relative", metavar="X", help="equal if at most X times the number apart"
    )
    command.add_argument("--digits", metavar="N", help="equal if they print alike to N digits")
    finding_options(command)


def run(options: argparse.Namespace) -> int:
    """Compare, and say what was found: 1 if anything differs."""
    check_files(options)
    from replication.check.diff import KINDS, diff, tolerance
    from replication.check.record import diff_record

    allowed = tolerance(options.ulp, options.relative, options.digits)
    found = diff(options.first, options.second, values_only=options.values_only, allowed=allowed)
    record = diff_record(found)
    put(options, record, found.differences, found.calculations[1], KINDS)
    return 0 if record["clean"] else 1

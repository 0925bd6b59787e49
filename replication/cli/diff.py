"""`coldspray diff`: two workbooks, their layout, formulas and values."""

import argparse

from replication.cli import options as shared
from replication.cli.check import check_files, finding_options, put
from replication.reading import quoted


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
    finding_options(command)


def run_diff(options: argparse.Namespace) -> int:
    """Compare, and say what was found: 1 if anything differs."""
    check_files(options, options.first, options.second)
    from replication.check.diff import KINDS, Tolerance, diff
    from replication.check.show import diff_record

    allowed = Tolerance(options.ulp, options.relative, options.digits)
    both = options.first, options.second
    comparison = diff(*both, values_only=options.values_only, allowed=allowed)
    record = diff_record(comparison)
    return put(options, record, comparison.differences, comparison.after, KINDS)


def _share(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if not 0 <= number <= 1:
        raise argparse.ArgumentTypeError(f"give a number from 0 to 1, not {quoted(text)}")
    return number

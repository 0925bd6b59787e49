"""`coldspray diff`: compare two workbooks."""

import argparse
from functools import partial

from replication.cli.differences import add_files, check_files, put_differences
from replication.cli.options import number_up_to_1, path, whole

HELP = "compare two workbooks: layout, formulas and values"
EXAMPLE = "coldspray diff mine.xlsx yours.xlsx --values-only --digits 12"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("first", metavar="A.xlsx", type=path, help="one workbook")
    parser.add_argument("second", metavar="B.xlsx", type=path, help="the other")
    parser.add_argument("--values-only", action="store_true", help="compare values, not formulas")
    parser.add_argument(
        "--ulp", metavar="N", type=whole(0, 1_000_000_000), default=0,
        help="equal if at most N doubles (ulp) apart (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--relative", metavar="X", type=number_up_to_1, default=0.0,
        help="equal if they differ by at most X times their size (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--digits", metavar="N", type=whole(1, 17),
        help="equal if they are the same when printed to N digits",
    )  # fmt: skip
    add_files(parser)


def run(options: argparse.Namespace) -> int:
    """Compare two workbooks and print the differences; status 1 if there are any."""
    check_files(options, options.first, options.second)
    from replication.check import diff_show as show
    from replication.check.diff import DIFFERENCE_KINDS, Tolerance, diff
    from replication.check.shown import junit

    allowed = Tolerance(options.ulp, options.relative, options.digits)
    both = options.first, options.second
    compared = diff(*both, values_only=options.values_only, allowed=allowed)
    record = show.diff_record(compared)
    page = partial(show.diff_page, record, compared.differences, compared.after)
    return put_differences(
        options, record, show.diff_text, page, partial(junit, kinds=DIFFERENCE_KINDS)
    )

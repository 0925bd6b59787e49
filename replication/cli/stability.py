"""`coldspray stability`: the hard cases by sheet, closed form and reference, side by side."""

import argparse

from replication.cli.options import add_json, add_quiet, whole
from replication.cli.output import put, width

HELP = "run the hard cases by sheet, closed form and reference"
EXAMPLE = "coldspray stability --random 1000 --seed 2"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--random", metavar="N", type=whole(1, 10_000_000), default=100_000,
        help="number of random cases (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--seed", metavar="N", type=whole(0, 2**63), default=1,
        help="seed of the random numbers (default: %(default)s)",
    )  # fmt: skip
    add_json(parser)
    add_quiet(parser, argparse.SUPPRESS)  # accepted everywhere; here nothing would be left out


def run(options: argparse.Namespace) -> int:
    """Print the hard cases as a table, and the worst of the random ones."""
    from replication.error import hard_cases

    record = hard_cases.record(options.random, options.seed)
    return put(options, record, lambda: hard_cases.hard_cases_text(record, width(piped=10_000)))

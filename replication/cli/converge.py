"""`coldspray converge`: split the sheet's error at several time steps."""

import argparse

from replication.cli.case import add_inputs, case_of
from replication.cli.options import add_csv_and_json, add_quiet, add_scheme, times, whole
from replication.cli.output import put

HELP = "split the sheet's error at several time steps; observed order, limit"
EXAMPLE = "coldspray converge --steps '0.4 ns,0.2 ns,0.1 ns' --scheme centered"

MOST_STEPS = 40
"""The most time steps, counted or listed: each half of the one before, to 1e-12 of the first."""


def add_options(parser: argparse.ArgumentParser) -> None:
    add_scheme(parser)
    wanted = parser.add_mutually_exclusive_group()
    wanted.add_argument(
        "--steps", metavar="X,X,...", help="steps, coarsest first (default: from 16 times --step)"
    )
    wanted.add_argument(
        "--levels", metavar="N", type=whole(2, MOST_STEPS), default=8,
        help="number of steps, each half of the previous one (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--digits", metavar="N", type=whole(1, 15),
        help="also find a step that, like its halvings, gives N correct digits",
    )  # fmt: skip
    add_csv_and_json(parser, "print the steps as CSV")
    add_quiet(parser)
    add_inputs(parser)


def run(options: argparse.Namespace) -> int:
    """Print the error and its parts at each step, the observed order and the limit."""
    from replication.error.ladder import converge, ladder, step_for_digits, text

    case, scheme = case_of(options), options.scheme
    if options.steps is None:
        steps = ladder(case.step, options.levels)
    else:
        steps = times("--steps", options.steps, MOST_STEPS)
    record = converge(case, steps, scheme)
    record["digits"] = options.digits and step_for_digits(case, options.digits, scheme)
    warnings = (
        f"{level['step']!r} s: {doubt}" for level in record["levels"] for doubt in level["warnings"]
    )
    rows = [level | level["budget"] for level in record["levels"]]
    for row in rows:
        del row["budget"], row["warnings"]
    return put(options, record, lambda: text(record), rows, warnings)

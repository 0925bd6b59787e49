"""`coldspray stability`: the hard cases."""

import argparse

from replication.commands import shared

HELP = "the hard cases: sheet, closed form and reference"


def options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.add_argument(
        "--random", type=int, default=100_000, metavar="N", help="random cases (100000)"
    )
    command.add_argument("--seed", type=int, default=1, metavar="N", help="of the random cases (1)")
    shared.output_options(command)


def run(options: argparse.Namespace) -> int:
    """Try the cases and print what came out."""
    from replication.analysis import stability
    from replication.reports import numerics

    if not 1 <= options.random <= 10_000_000 or options.seed < 0:
        raise ValueError("--random wants 1 to 10,000,000 cases, --seed zero or more")
    outcomes = [stability.outcome(case) for case in stability.HARD_CASES]
    worst = stability.worst_of(options.random, options.seed)
    if options.json:
        shared.print_json(numerics.stability_record(outcomes, worst))
    else:
        print(numerics.stability_text(outcomes, worst))
    return 0

"""`coldspray stability`: the hard cases."""

import argparse

from replication.cli import options as shared

HELP = "the hard cases: sheet, closed form and reference"


def options(command: argparse.ArgumentParser) -> None:
    cases, seeds = shared.whole(1, 10_000_000), shared.whole(0, 2**63)
    command.add_argument(
        "--random", type=cases, default=100_000, metavar="N", help="random cases (100000)"
    )
    command.add_argument(
        "--seed", type=seeds, default=1, metavar="N", help="of the random cases (1)"
    )
    shared.output_options(command)


def run(options: argparse.Namespace) -> int:
    from replication.error import hard_cases

    outcomes = hard_cases.outcomes()
    worst = hard_cases.worst_of(options.random, options.seed)
    if options.json:
        shared.print_json(hard_cases.record(outcomes, worst))
    else:
        print(hard_cases.text(outcomes, worst))
    return 0

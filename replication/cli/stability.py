"""`coldspray stability`: the hard cases."""

import argparse

from replication.cli import options as shared

HELP = "the hard cases: sheet, closed form and reference"


def options(command: argparse.ArgumentParser) -> None:
    random, seed = "random cases (100000)", "of the random cases (1)"
    shared.whole_option(command, "--random", 1, 10_000_000, random, default=100_000)
    shared.whole_option(command, "--seed", 0, 2**63, seed, default=1)
    shared.output_options(command)


def run(options: argparse.Namespace) -> int:
    from replication.error import hard_cases

    record = hard_cases.record(options.random, options.seed)
    return shared.put(options, record, lambda: hard_cases.text(record))

"""`coldspray converge`: error against time step, observed order, extrapolated limit."""

import argparse

from replication.cases import read_number
from replication.commands import shared
from replication.commands.sheet import scheme_option

HELP = "error against time step, observed order, limit"


def options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    shared.input_options(command)
    scheme_option(command)
    command.add_argument(
        "--steps", metavar="X,X,...", help="steps, coarsest first (default: from 16 times --step)"
    )
    command.add_argument(
        "--levels", type=int, default=8, metavar="N", help="number of steps, by halves (8)"
    )
    command.add_argument(
        "--digits", type=int, metavar="N", help="also find the largest step for N correct digits"
    )
    shared.output_options(command)


def run(options: argparse.Namespace) -> int:
    """Run the ladder and print it."""
    from replication.analysis import convergence
    from replication.reports import numerics

    case = shared.case(options)
    if not 2 <= options.levels <= 40:
        raise ValueError("--levels wants 2 to 40")
    if options.steps is None:
        steps = convergence.ladder(case.step, options.levels)
    else:
        steps = [read_number(text, "s") for text in options.steps.split(",")]
    found = convergence.converge(case, steps, options.scheme)
    digits = None
    if options.digits is not None:
        digits = convergence.step_for_digits(case, options.digits, options.scheme)
    if options.json:
        shared.print_json(numerics.convergence_record(found, digits))
    else:
        print(numerics.convergence_text(found, digits))
        shared.warn(options, (f"{x.step!r} s: {note}" for x in found.levels for note in x.warnings))
    return 0

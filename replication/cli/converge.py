"""`coldspray converge`: error against time step, observed order, extrapolated limit."""

import argparse

from replication.cli import options as shared

HELP = "error against time step, observed order, limit"

MOST_STEPS = 40


def options(command: argparse.ArgumentParser) -> None:
    shared.input_options(command)
    shared.scheme_option(command)
    command.add_argument(
        "--steps", metavar="X,X,...", help="steps, coarsest first (default: from 16 times --step)"
    )
    shared.whole_option(command, "--levels", 2, MOST_STEPS, "number of steps, by halves (8)", 8)
    largest = "also find the largest step for N correct digits"
    shared.whole_option(command, "--digits", 1, 15, largest)
    shared.output_options(command)


def run(options: argparse.Namespace) -> int:
    from replication.error.ladder import converge, ladder, step_for_digits, text

    case, scheme = shared.case(options), options.scheme
    if options.steps is None:
        steps = ladder(case.step, options.levels)
    else:
        steps = shared.times("--steps", options.steps, MOST_STEPS)
    record = converge(case, steps, scheme)
    digits = options.digits and step_for_digits(case, options.digits, scheme)
    record["digits"] = digits
    warnings = (f"{x['step']!r} s: {said}" for x in record["levels"] for said in x["warnings"])
    return shared.put(options, record, lambda: text(record), warnings=warnings)

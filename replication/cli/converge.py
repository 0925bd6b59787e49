"""`coldspray converge`: error against time step, observed order, extrapolated limit."""

import argparse

from replication.cli import options as shared
from replication.reading import place, read_number

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
    from replication.error.ladder import converge, ladder, record, step_for_digits, text

    case = shared.case(options)
    steps = ladder(case.step, options.levels) if options.steps is None else _steps(options.steps)
    result = converge(case, steps, options.scheme)
    digits = None
    if options.digits is not None:
        digits = step_for_digits(case, options.digits, options.scheme)
    warnings = (f"{level.step!r} s: {said}" for level in result.levels for said in level.warnings)
    document = record(result, digits)
    return shared.put(options, document, lambda: text(result, digits), warnings=warnings)


def _steps(text: str) -> list[float]:
    texts = text.split(",")
    if len(texts) > MOST_STEPS:
        raise ValueError(f"--steps takes at most {MOST_STEPS} steps, not {len(texts)}")
    steps = []
    for at, step in enumerate(texts, 1):
        with place(f"--steps, value {at}"):
            steps.append(read_number(step.strip(), "s"))
    return steps

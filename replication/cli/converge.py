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
    from replication.error.ladder import converge, ladder, step_for_digits, text

    case, scheme = shared.case(options), options.scheme
    steps = ladder(case.step, options.levels) if options.steps is None else _steps(options.steps)
    record = converge(case, steps, scheme)
    digits = options.digits and step_for_digits(case, options.digits, scheme)
    record["digits"] = digits
    warnings = (f"{x['step']!r} s: {said}" for x in record["levels"] for said in x["warnings"])
    return shared.put(options, record, lambda: text(record), warnings=warnings)


def _steps(text: str) -> list[float]:
    texts = text.split(",")
    if len(texts) > MOST_STEPS:
        raise ValueError(f"--steps takes at most {MOST_STEPS} steps, not {len(texts)}")
    steps = []
    for at, step in enumerate(texts, 1):
        with place(f"--steps, value {at}"):
            steps.append(read_number(step.strip(), "s"))
    return steps

"""`coldspray converge`: error against time step, observed order, extrapolated limit."""

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from replication.cases import inputs_of
from replication.cli import options as shared
from replication.reading import place, read_number
from replication.text import aligned, number

if TYPE_CHECKING:
    from replication.error.ladder import Convergence, Level, StepForDigits

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
    from replication.error.ladder import converge, ladder, step_for_digits

    case = shared.case(options)
    steps = ladder(case.step, options.levels) if options.steps is None else _steps(options.steps)
    result = converge(case, steps, options.scheme)
    digits = None
    if options.digits is not None:
        digits = step_for_digits(case, options.digits, options.scheme)
    warnings = (f"{level.step!r} s: {text}" for level in result.levels for text in level.warnings)
    record = _record(result, digits)
    return shared.put(options, record, lambda: _text(result, digits), warnings=warnings)


def _steps(text: str) -> list[float]:
    texts = text.split(",")
    if len(texts) > MOST_STEPS:
        raise ValueError(f"--steps takes at most {MOST_STEPS} steps, not {len(texts)}")
    steps = []
    for at, step in enumerate(texts, 1):
        with place(f"--steps, value {at}"):
            steps.append(read_number(step.strip(), "s"))
    return steps


def _record(result: "Convergence", digits: "StepForDigits | None") -> dict[str, Any]:
    from replication.error.ladder import ORDER

    return {
        "inputs": inputs_of(result.impact),
        "scheme": result.scheme,
        "nominal_order": ORDER[result.scheme],
        "levels": result.levels,
        "limit": result.limit,
        "limit_undefined": result.levels[-1].undefined,
        "exact": result.exact,
        "exact_at_stop": result.exact_at_stop,
        "digits": digits,
    }


_WHY = {
    "published": (
        "The published scheme is first order: it takes a row's deceleration at the middle depth,\n"
        "but at the initial velocity, and drag depends on velocity."
    ),
    "centered": (
        "The centered scheme is second order: it takes a row's deceleration at the middle depth\n"
        "and at the middle velocity."
    ),
}


def _um(length: float | None, digits: int) -> str:
    return "-" if length is None else number(length * 1e6, digits)


def _order(order: float | None) -> str:
    return "-" if order is None else f"{order:.2f}"


_COLUMNS: tuple[tuple[str, str, Callable[["Level"], str]], ...] = (
    ("step", "[ns]", lambda level: number(level.step * 1e9, 5)),
    ("steps", "", lambda level: str(level.steps)),
    ("depth", "[um]", lambda level: _um(level.depth, 7)),
    ("error", "[um]", lambda level: _um(level.error, 3)),
    ("order", "", lambda level: _order(level.order)),
    ("time step", "[um]", lambda level: _um(level.budget.time_step, 3)),
    ("order", "", lambda level: _order(level.time_step_order)),
    ("stop rule", "[um]", lambda level: _um(level.budget.stop_rule, 3)),
    ("half step", "[um]", lambda level: _um(level.budget.half_step, 3)),
    ("rounding", "[um]", lambda level: _um(level.budget.rounding, 2)),
    ("governed by", "", lambda level: level.regime),
)
"""Head, unit and text of each column."""


def _text(result: "Convergence", digits: "StepForDigits | None") -> str:
    """The ladder as a table, its limit, and where every part of the error comes from."""
    heads, units, writers = zip(*_COLUMNS, strict=True)
    rows = [tuple(write(level) for write in writers) for level in result.levels]
    last = result.levels[-1]
    limit = last.undefined or f"{_um(result.limit, 8)} um"
    if last.gci is not None:
        limit += f", observed order {last.observed_order:.2f}, grid convergence index "
        limit += f"{100 * last.gci:.2g} %"
    lines = [
        *aligned([heads, units, *rows]),
        "",
        f"exact, at rest            {_um(result.exact, 10)} um",
        f"exact, at stop velocity   {_um(result.exact_at_stop, 10)} um",
        f"limit of the last three   {limit}",
        "The error is the sum of the four parts: time step, stop rule, half step, rounding.",
        _WHY[result.scheme],
    ]
    if digits is not None:
        lines.append(
            f"{digits.digits} correct digits: largest step {number(digits.step * 1e9, 5)} ns "
            f"({digits.steps} steps, error {_um(digits.error, 3)} um); "
            f"{number(digits.fails * 1e9, 5)} ns fails."
        )
    return "\n".join(lines)

"""Convergence and hard cases as text and as records; lengths in m in the records."""

from collections.abc import Sequence
from dataclasses import asdict, replace
from typing import Any

from replication.analysis.budget import split
from replication.analysis.convergence import (
    ORDER,
    Convergence,
    Level,
    StepForDigits,
    converge,
    ladder,
)
from replication.analysis.stability import HARD_CASES, Outcome, Worst, outcome, worst_of
from replication.cases import BETA_5, CASES, inputs_of
from replication.models.sheet import SCHEMES, Sheet, run
from replication.text import aligned, number

__all__ = [
    "WHY",
    "budget_record",
    "budget_sheets",
    "convergence_record",
    "convergence_text",
    "numerics_record",
    "report_ladders",
    "stability_record",
    "stability_text",
]

WHY = {
    "published": (
        "The published scheme is first order: it takes a row's deceleration at the middle depth, "
        "but at the initial velocity, and drag depends on velocity."
    ),
    "centered": (
        "The centered scheme is second order: it takes a row's deceleration at the middle depth "
        "and at the middle velocity."
    ),
}


def convergence_record(found: Convergence, digits: StepForDigits | None) -> dict[str, Any]:
    """The JSON of `coldspray converge`."""
    return {
        "inputs": inputs_of(found.impact),
        "scheme": found.scheme,
        "nominal_order": ORDER[found.scheme],
        "levels": [_level_record(level) for level in found.levels],
        "limit": found.limit,
        "limit_undefined": found.levels[-1].undefined or None,
        "exact": found.exact,
        "exact_at_stop": found.exact_at_stop,
        "digits": None if digits is None else asdict(digits),
    }


def _level_record(level: Level) -> dict[str, Any]:
    return {**asdict(level), "undefined": level.undefined or None}


def convergence_text(found: Convergence, digits: StepForDigits | None) -> str:
    """The ladder as a table, its limit, and where every part of the error comes from."""
    heads = ("step", "steps", "depth", "error", "order", "time step", "order",
             "stop rule", "half step", "rounding", "governed by")  # fmt: skip
    units = ("[ns]", "", "[um]", "[um]", "", "[um]", "", "[um]", "[um]", "[um]", "")
    limit = f"{_um(found.limit, 8)} um" if found.limit else found.levels[-1].undefined
    gci = found.levels[-1].gci
    if gci is not None:
        limit += f", observed order {found.levels[-1].observed_order:.2f}, grid convergence index "
        limit += f"{100 * gci:.2g} %"
    lines = [
        *aligned([heads, units, *(_level_row(level) for level in found.levels)]),
        "",
        f"exact, at rest            {_um(found.exact, 10)} um",
        f"exact, at stop velocity   {_um(found.exact_at_stop, 10)} um",
        f"limit of the last three   {limit}",
        "The error is the sum of the four parts: time step, stop rule, half step, rounding.",
        WHY[found.scheme],
    ]
    if digits is not None:
        lines.append(
            f"{digits.digits} correct digits: largest step {number(digits.step * 1e9, 5)} ns "
            f"({digits.steps} steps, error {_um(digits.error, 3)} um); "
            f"{number(digits.fails * 1e9, 5)} ns fails."
        )
    return "\n".join(lines)


def _level_row(level: Level) -> tuple[str, ...]:
    budget = level.budget
    return (
        number(level.step * 1e9, 5),
        str(level.steps),
        f"{level.depth * 1e6:.7g}",
        _um(level.error, 3),
        _order(level.order),
        _um(budget.time_step, 3),
        _order(level.time_step_order),
        _um(budget.stop_rule, 3),
        _um(budget.half_step, 3),
        _um(budget.rounding, 2),
        level.regime,
    )


def _um(length: float | None, digits: int) -> str:
    return "-" if length is None else number(length * 1e6, digits)


def _order(order: float | None) -> str:
    return "-" if order is None else f"{order:.2f}"


def stability_record(outcomes: Sequence[Outcome], worst: Worst) -> dict[str, Any]:
    """The JSON of `coldspray stability`. Inputs that are no finite numbers are given as text."""
    return {"cases": [_outcome_record(outcome) for outcome in outcomes], "random": asdict(worst)}


def _outcome_record(outcome: Outcome) -> dict[str, Any]:
    changes = {k: v if abs(v) < float("inf") else str(v) for k, v in outcome.changes.items()}
    return {**asdict(outcome), "changes": changes}


def stability_text(outcomes: Sequence[Outcome], worst: Worst) -> str:
    """The hard cases as a table, notes under it, and the worst of the random cases."""
    heads = ("case", "steps", "sheet X/m", "off by", "closed form X/m", "ulp", "exact X/m")
    inputs = ", ".join(f"{name} {value!r}" for name, value in worst.inputs.items())
    return "\n".join(
        [
            *aligned([heads, *(_outcome_row(outcome) for outcome in outcomes)]),
            "",
            *(f"{outcome.name}: {note}" for outcome in outcomes for note in _notes(outcome)),
            "",
            f"Closed form over {worst.cases} random cases ({worst.skipped} without a normal double "
            f"for an answer): at worst {worst.ulps:.2f} ulp, at {inputs}.",
        ]
    )


def _outcome_row(outcome: Outcome) -> tuple[str, ...]:
    if outcome.refused:
        return outcome.name, "-", "refused", "", "", "", ""
    closed = (f"{outcome.closed_form:.9g}", f"{outcome.ulps:+.2f}", outcome.reference)
    if outcome.sheet is None or outcome.sheet_error is None:
        return outcome.name, "-", "refused", "", *closed
    off = f"{100 * outcome.sheet_error:+.3g} %"
    return outcome.name, str(outcome.steps), f"{outcome.sheet:.9g}", off, *closed


def _notes(outcome: Outcome) -> list[str]:
    refused = [note for note in (outcome.refused, outcome.sheet_refused) if note]
    return [*(f"refused: {note}" for note in refused), *outcome.warnings]


def budget_sheets() -> list[Sheet]:
    """The report's two cases at its step and at the one it compares with."""
    return [run(replace(case, step=step)) for case in CASES.values() for step in (2e-10, 5e-10)]


def report_ladders() -> list[dict[str, Any]]:
    """Both schemes over steps from 16 times the report's down to an eighth, beta = 5."""
    steps = ladder(BETA_5.step, levels=8)
    return [convergence_record(converge(BETA_5, steps, scheme), None) for scheme in SCHEMES]


def budget_record(sheet: Sheet) -> dict[str, Any]:
    """Where a sheet's error comes from."""
    head = {"beta": sheet.impact.beta, "step": sheet.impact.step, "steps": sheet.steps}
    return {**head, "depth": sheet.final_depth, **asdict(split(sheet))}


RANDOM_CASES = 10_000
"""For the audit's files; `coldspray stability` runs ten times as many."""


def numerics_record() -> dict[str, Any]:
    """What `audit.json` holds of the sheet's and the closed form's errors; it rests on no claim."""
    return {
        "error_budget": [budget_record(sheet) for sheet in budget_sheets()],
        "stability": stability_record(
            [outcome(case) for case in HARD_CASES], worst_of(RANDOM_CASES, seed=1)
        ),
        "convergence": report_ladders(),
    }

"""The results of a block of cases: the function that processes and clusters run."""

from typing import Any

import numpy as np
import numpy.typing as npt

from replication import closed_form
from replication.case import INPUTS
from replication.impact import Impact
from replication.midpoint import run
from replication.sweep.plan import BLOCK, Plan

__all__ = ["Block", "block", "columns"]

Block = dict[str, npt.NDArray[Any]]

RESULTS = {
    "depth": "m",
    "normalized_depth": "1",
    "beyond_radius": "",
    "stop_time": "s",
    "sheet_depth": "m",
    "sheet_steps": "1",
}


def columns(plan: Plan) -> dict[str, str]:
    """The names of a block's columns, in order, and their SI units; a truth value has none."""
    return {name: (INPUTS | RESULTS)[name] for name in compute(plan, 0, 1)}


def block(plan: Plan, number: int) -> Block:
    """Inputs and results of the cases of one block, number from 0 to `plan.blocks` - 1.

    Columns by name, each of shape (cases,), SI: the inputs, depth at rest [m], normalized_depth
    [1], beyond_radius, and the extras of the plan. A pure function of plan and number, whatever
    process or machine runs it. Raises ValueError naming the case that the sheet refuses.
    """
    first = number * BLOCK
    return compute(plan, first, min(BLOCK, plan.count - first))


def compute(plan: Plan, first: int, count: int) -> Block:
    """Inputs and results of `count` cases from `first` on."""
    inputs = plan.inputs(first, count)
    ratio = closed_form.normalized_depth(
        *(inputs[name] for name in ("velocity", "particle_density", "target_density", "resistance"))
    )
    results = {
        "depth": inputs["radius"] * ratio,
        "normalized_depth": ratio,
        "beyond_radius": ratio > 1,
    }
    return {**inputs, **results, **_extras(plan.extras, inputs, first)}


def _extras(names: tuple[str, ...], inputs: Block, first: int) -> Block:
    if not names:
        return {}
    cases = [
        dict(zip(inputs, map(float, case), strict=True))
        for case in zip(*inputs.values(), strict=True)
    ]
    values: dict[str, list[float]] = {name: [] for name in names}
    for number, case in enumerate(cases, first):
        case.pop("beta", None)
        case.pop("flow_stress", None)
        impact = Impact(**case)
        if "stop_time" in names:
            values["stop_time"].append(closed_form.stop_time(**impact.motion))
        if "sheet_depth" in names or "sheet_steps" in names:
            try:
                sheet = run(impact)
            except ValueError as error:
                raise ValueError(f"case {number}: {error} (with {case})") from error
            for name, value in (("sheet_depth", sheet.final_depth), ("sheet_steps", sheet.steps)):
                if name in names:
                    values[name].append(value)
    return {name: np.array(column) for name, column in values.items()}

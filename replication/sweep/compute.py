"""The results of a block of cases: the function that processes and clusters run."""

from typing import Any

import numpy.typing as npt

from replication import closed_form
from replication.case import INPUTS
from replication.closed_form.checked import ElementError
from replication.midpoint_many import run_many
from replication.sweep.plan import BLOCK, Plan

__all__ = ["Block", "block", "columns"]

Block = dict[str, npt.NDArray[Any]]

MOTION = ("velocity", "radius", "particle_density", "target_density", "resistance")

RESULTS: dict[str, tuple[str, type]] = {
    "depth": ("m", float),
    "normalized_depth": ("1", float),
    "beyond_radius": ("", bool),
    "stop_time": ("s", float),
    "sheet_depth": ("m", float),
    "sheet_steps": ("1", int),
}


def columns(plan: Plan) -> dict[str, tuple[str, type]]:
    """The names of a block's columns, in order, with SI unit (none for a truth value) and type."""
    inputs = {name: (INPUTS[name], float) for name in plan.inputs(0, 1)}
    return inputs | {name: RESULTS[name] for name in plan.results}


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
    motion = [inputs[name] for name in MOTION]
    velocity, radius, *materials = motion
    ratio = closed_form.normalized_depth(velocity, *materials)
    results = {
        "depth": radius * ratio,
        "normalized_depth": ratio,
        "beyond_radius": ratio > 1,
    }
    if "stop_time" in plan.extras:
        results["stop_time"] = closed_form.stop_time(*motion)
    if {"sheet_depth", "sheet_steps"} & set(plan.extras):
        results |= _sheets(inputs, first)
    return inputs | {name: results[name] for name in plan.results}


def _sheets(inputs: Block, first: int) -> Block:
    cases: Any = {name: inputs[name] for name in (*MOTION, "step", "stop_velocity")}
    try:
        depth, steps = run_many(**cases)
    except ElementError as error:
        number = error.index[0]
        given = ", ".join(f"{name} {float(value[number])!r}" for name, value in inputs.items())
        raise ValueError(error.at(f" of case {first + number} ({given})")) from error
    return {"sheet_depth": depth, "sheet_steps": steps}

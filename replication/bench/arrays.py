"""What this project has for many cases at once; a time is that of one of them."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from replication import closed_form
from replication.analysis.budget import exact_motion
from replication.bench.cases import Case, relative_error
from replication.bench.methods import CLOSED_FORM, SHEETS, steps_of
from replication.bench.task import Task
from replication.impact import Impact
from replication.midpoint_many import run_many

__all__ = ["ARRAYS", "SHEET_ARRAYS", "array_tasks"]

ARRAYS = f"{CLOSED_FORM}, arrays"
SHEET_ARRAYS = {scheme: f"{name}, arrays" for scheme, name in SHEETS.items()}

DEPTHS, HISTORIES, SHEETS_AT_ONCE = 100_001, 1001, 1001
"""Cases in the arrays; odd, so that the case itself is in their middle."""

SAMPLE = 11
"""Depths of an array, first and last included, that are compared with exact ones."""


def array_tasks(case: Case) -> list[Task]:
    """Depths and histories of the closed form, and the sheet in both schemes at every step."""
    return [_depths(case), _histories(case), *_sheets(case)]


def _columns(impact: Impact, count: int) -> dict[str, Any]:
    """So many cases, their velocities within 10 % of the one in the middle."""
    columns: dict[str, Any] = {name: np.full(count, x) for name, x in impact.motion.items()}
    columns["velocity"] *= 1 + 0.1 * np.linspace(-1, 1, count)
    return columns


def _depths(case: Case) -> Task:
    depths = partial(closed_form.final_depth, **_columns(case.impact, DEPTHS))
    error = partial(_worst, case.impact, 0.0)
    return Task(ARRAYS, f"{DEPTHS} cases", "depth", depths, error, DEPTHS)


def _histories(case: Case) -> Task:
    """Compared in the middle, with the exact history of the case itself."""
    columns = {name: values[:, None] for name, values in _columns(case.impact, HISTORIES).items()}

    def histories() -> Any:
        return closed_form.history(case.times, **columns)[0]

    def error(depths: Any) -> float:
        return case.history_error(depths[HISTORIES // 2])

    return Task(ARRAYS, f"{HISTORIES} cases", "history", histories, error, HISTORIES)


def _sheets(case: Case) -> list[Task]:
    return [
        Task(
            name,
            f"{impact.step * 1e9:.5g} ns",
            "depth",
            _sheet_depths(impact, scheme),
            partial(_worst, impact, impact.stop_velocity),
            SHEETS_AT_ONCE,
        )
        for scheme, name in SHEET_ARRAYS.items()
        for impact in steps_of(case)
    ]


def _sheet_depths(impact: Impact, scheme: str) -> Callable[[], Any]:
    columns = _columns(impact, SHEETS_AT_ONCE)
    columns |= {"step": impact.step, "stop_velocity": impact.stop_velocity}
    return lambda: run_many(**columns, scheme=scheme)[0]


def _worst(impact: Impact, at_velocity: float, depths: Any) -> float:
    """The worst of a sample of depths [m], against the exact ones at a velocity [m/s]."""
    velocities = _columns(impact, len(depths))["velocity"]
    errors = []
    for k in np.linspace(0, len(depths) - 1, SAMPLE, dtype=int):
        motion = exact_motion(replace(impact, velocity=float(velocities[k])))
        errors.append(relative_error(depths[k], motion.depth_at_velocity(at_velocity)))
    return max(errors)

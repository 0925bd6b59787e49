"""What this project has: the sheet in both schemes, and the closed form."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from replication import closed_form
from replication.analysis.budget import exact_motion
from replication.bench.cases import Case, relative_error
from replication.bench.task import Task
from replication.midpoint import Sheet, run

__all__ = ["ARRAYS", "CLOSED_FORM", "SHEETS", "closed_form_tasks", "sheet_tasks"]

SHEETS = {"published": "sheet, published", "centered": "sheet, centered"}
CLOSED_FORM = "closed form"
ARRAYS = "closed form, arrays"

STEPS = (16.0, 4.0, 1.0, 1 / 4, 1 / 16, 1 / 64, 1 / 256)
"""Of the sheet, over that of the case."""

COUNT = 100_000
"""Cases in the arrays."""

SAMPLE = range(0, COUNT, COUNT // 11)


def sheet_tasks(case: Case) -> list[Task]:
    """Both schemes at every step. The sheet's depth aims at the one at the stop velocity."""
    tasks = []
    for scheme, name in SHEETS.items():
        for factor in STEPS:
            impact = replace(case.impact, step=case.impact.step * factor)
            sheet = partial(run, impact, scheme)
            setting = f"{impact.step * 1e9:.5g} ns"
            tasks += [
                Task(name, setting, "depth", _depth_of(sheet), _stop_error(case)),
                Task(name, setting, "history", _history_of(sheet, case), case.history_error),
            ]
    return tasks


def _depth_of(sheet: Callable[[], Sheet]) -> Callable[[], float]:
    return lambda: sheet().final_depth


def _stop_error(case: Case) -> Callable[[float], float]:
    return partial(case.depth_error, at_velocity=case.impact.stop_velocity)


def _history_of(sheet: Callable[[], Sheet], case: Case) -> Callable[[], Any]:
    """The depths of the rows between which the times lie, on straight lines.

    The scheme's x stands in the middle of its row, half a step before the time printed there.
    """

    def history() -> npt.NDArray[np.float64]:
        found = sheet()
        middles = [row.time - found.impact.step / 2 for row in found.rows]
        middles[0] = 0.0
        return np.interp(case.times, middles, [row.depth for row in found.rows])

    return history


def closed_form_tasks(case: Case) -> list[Task]:
    """One case; many at once; and a history."""
    motion, setting = case.impact.motion, "no steps"

    def depth() -> Any:
        return closed_form.final_depth(**motion)

    def history() -> Any:
        return closed_form.history(case.times, **motion)[0]

    return [
        Task(CLOSED_FORM, setting, "depth", depth, case.depth_error),
        _arrays(case),
        Task(CLOSED_FORM, setting, "history", history, case.history_error),
    ]


def _arrays(case: Case) -> Task:
    """Many cases, their velocities within 10 % of the case's; the error is the worst of a dozen."""
    columns = {name: np.full(COUNT, value) for name, value in case.impact.motion.items()}
    columns["velocity"] *= np.linspace(0.9, 1.1, COUNT)

    def depth() -> Any:
        return closed_form.final_depth(**columns)

    def error(depths: npt.NDArray[np.float64]) -> float:
        return max(_error_at(case, columns["velocity"][k], depths[k]) for k in SAMPLE)

    return Task(ARRAYS, f"{COUNT} cases", "depth", depth, error, COUNT)


def _error_at(case: Case, velocity: float, depth: float) -> float:
    motion = exact_motion(replace(case.impact, velocity=float(velocity)))
    return relative_error(depth, motion.final_depth)

"""What this project has for one case: the sheet in both schemes, and the closed form."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from replication import closed_form
from replication.bench.cases import Case
from replication.bench.task import Task
from replication.impact import Impact
from replication.midpoint import Sheet, run

__all__ = ["CLOSED_FORM", "SHEETS", "STEPS", "closed_form_tasks", "sheet_tasks", "steps_of"]

SHEETS = {"published": "sheet, published", "centered": "sheet, centered"}
CLOSED_FORM = "closed form"

STEPS = (16.0, 4.0, 1.0, 1 / 4, 1 / 16, 1 / 64, 1 / 256)
"""Of the sheet, over that of the case."""


def steps_of(case: Case) -> list[Impact]:
    """The case at every step of the ladder, the longest first."""
    return [replace(case.impact, step=case.impact.step * factor) for factor in STEPS]


def sheet_tasks(case: Case) -> list[Task]:
    """Both schemes at every step, measured down to the stop velocity, where the sheet ends."""
    stop = case.impact.stop_velocity
    depth_error = partial(case.depth_error, at_velocity=stop)
    until = float(case.motion.stop_time(stop))
    history_error = partial(case.history_error, until=until)
    tasks = []
    for scheme, name in SHEETS.items():
        for impact in steps_of(case):
            sheet = partial(run, impact, scheme)
            setting = f"{impact.step * 1e9:.5g} ns"
            tasks += [
                Task(name, setting, "depth", _depth_of(sheet), depth_error),
                Task(name, setting, "history", _history_of(sheet, case), history_error),
            ]
    return tasks


def _depth_of(sheet: Callable[[], Sheet]) -> Callable[[], float]:
    return lambda: sheet().final_depth


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
    """The depth, and a history."""
    motion, setting = case.impact.motion, "no steps"

    def depth() -> Any:
        return closed_form.final_depth(**motion)

    def history() -> Any:
        return closed_form.history(case.times, **motion)[0]

    return [
        Task(CLOSED_FORM, setting, "depth", depth, case.depth_error),
        Task(CLOSED_FORM, setting, "history", history, case.history_error),
    ]

"""`Task`: one thing to time; and what this project has for it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Literal

import numpy as np

from replication.bench.cases import Case, relative_error
from replication.error.ladder import exact_motion
from replication.models import arrays, motion
from replication.models.impact import Impact
from replication.models.sheet import SCHEMES, run

Measure = Literal["depth", "history"]
MEASURES: tuple[Measure, ...] = ("depth", "history")
TITLES = {"depth": "final depth", "history": "history"}


@dataclass(frozen=True, slots=True)
class Task:
    """A method at a setting: what to time, and how far off its answer is.

    `measure` is "depth" (relative error of the final depth) or "history" (worst error of the depth
    at the case's times, relative to the final one); `error` turns what `run` returns into it. A run
    does `cases` cases at once. Where it is `compiled`, the first run takes that long, too.
    """

    method: str
    setting: str
    measure: Measure
    run: Callable[[], Any]
    error: Callable[[Any], float]
    compiled: bool = False
    cases: int = 1


DEPTH, SERIES, PLAIN = "closed form", "Taylor series", "Taylor series, plain Python"
SHEETS = {scheme: f"sheet, {scheme}" for scheme in SCHEMES}
OURS = {DEPTH, SERIES, PLAIN, *SHEETS.values()} | {
    f"{name}, many" for name in (DEPTH, SERIES, *SHEETS.values())
}

STEPS = (16.0, 4.0, 1.0, 1 / 4, 1 / 16, 1 / 64)
"""Of the sheet, over that of the case."""


def own_tasks(case: Case) -> Iterator[Task]:
    """The sheet in both schemes at every step, the closed form, and the Taylor series."""
    impact, times, given = case.impact, case.times, tuple(case.impact.motion.values())
    for scheme in SCHEMES:
        yield from _sheets(case, scheme)
    depth = partial(arrays.final_depth, *given)
    yield Task(DEPTH, "no steps", "depth", depth, case.depth_error)
    yield many(DEPTH, "no steps", impact, 0.0, 100_001, arrays.final_depth)
    histories = [column[:, None] for column in columns(impact, 1001)]
    error = case.history_error
    for name, history in (
        (PLAIN, lambda: _plain_history(times.tolist(), given)),
        (SERIES, lambda: arrays.history(times, *given)[0]),
    ):
        yield Task(name, "order 20", "history", history, error, compiled=name == SERIES)
    all_of_them: Any = lambda: arrays.history(times, *histories)[0]  # noqa: E731
    middle: Any = lambda found: error(found[500])  # noqa: E731
    yield Task(f"{SERIES}, many", "order 20", "history", all_of_them, middle, True, 1001)


def _sheets(case: Case, scheme: str) -> Iterator[Task]:
    """A scheme at every step, measured down to the stop velocity, where the sheet ends."""
    stop, name = case.impact.stop_velocity, SHEETS[scheme]
    until = float(case.motion.stop_time(stop))
    for factor in STEPS:
        impact = replace(case.impact, step=case.impact.step * factor)
        setting = f"{impact.step * 1e9:.5g} ns"
        depth = partial(lambda impact: run(impact, scheme).final_depth, impact)
        error = partial(case.depth_error, at_velocity=stop)
        yield Task(name, setting, "depth", depth, error)
        history = partial(_rows, impact, scheme, case.times)
        yield Task(name, setting, "history", history, partial(case.history_error, until=until))
        sheets = partial(arrays.run_many, step=impact.step, stop_velocity=stop, scheme=scheme)
        yield many(name, setting, impact, stop, 1001, lambda *c, sheets=sheets: sheets(*c)[0])


def _rows(impact: Impact, scheme: str, times: Any) -> Any:
    """The depths of the rows between which the times lie, on straight lines.

    The scheme's x stands in the middle of its row, half a step before the time printed there.
    """
    rows = run(impact, scheme).rows
    middles = [0.0, *(row.time - impact.step / 2 for row in rows[1:])]
    return np.interp(times, middles, [row.depth for row in rows])


def _plain_history(times: list[float], given: tuple[float, ...]) -> list[float]:
    depth, speed = [0.0] * len(times), [0.0] * len(times)
    motion.history(times, *given, depth=depth, speed=speed)  # type: ignore[misc]
    return depth


def columns(impact: Impact, count: int) -> list[Any]:
    """So many cases, their velocities within 10 % of the one in the middle."""
    velocity, *others = (np.full(count, value) for value in impact.motion.values())
    return [velocity * (1 + 0.1 * np.linspace(-1, 1, count)), *others]


def many(
    method: str, setting: str, impact: Impact, stop: float, count: int, work: Callable[..., Any]
) -> Task:
    """The task of so many final depths; eleven of them are compared with exact ones."""
    inputs = columns(impact, count)

    def error(depths: Any) -> float:
        errors = []
        for k in np.linspace(0, count - 1, 11, dtype=int):
            exact = exact_motion(replace(impact, velocity=float(inputs[0][k])))
            errors.append(relative_error(depths[k], exact.depth_at_velocity(stop)))
        return max(errors)

    run = partial(work, *inputs)
    return Task(f"{method}, many", setting, "depth", run, error, compiled=True, cases=count)

"""Every method on the cases asked for: measured, compared, ranked."""

import math
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from functools import partial

from replication.bench.arrays import ARRAYS, array_tasks
from replication.bench.cases import Case, build
from replication.bench.machine import machine
from replication.bench.measure import Stopwatch
from replication.bench.methods import CLOSED_FORM, closed_form_tasks, sheet_tasks
from replication.bench.pareto import Choice, Point, choices, front
from replication.bench.peers import SCIPY, mpmath_tasks, scipy_tasks
from replication.bench.task import Measure, Task

__all__ = ["Bench", "Result", "Trial", "Watch", "bench", "tasks"]


@dataclass(frozen=True, slots=True)
class Result:
    """A case with all its points."""

    case: Case
    points: tuple[Point, ...]

    def of(self, measure: Measure) -> list[Point]:
        """The points of one measure."""
        return [point for point in self.points if point.measure == measure]

    def front(self, measure: Measure) -> list[Point]:
        """The Pareto front of the methods that do one case at a time."""
        return front(_single(self.of(measure)))

    def choices(self, measure: Measure) -> list[Choice]:
        """For every number of digits: the best, the closed form, SciPy; one case at a time."""
        return choices(_single(self.of(measure)), [CLOSED_FORM], SCIPY)

    def array_choices(self, measure: Measure) -> list[Choice]:
        """The same for many cases: the closed form is that over arrays, its time a case."""
        return choices(self.of(measure), [ARRAYS], SCIPY)


@dataclass(frozen=True, slots=True)
class Bench:
    """A run: the machine, how often and how long each task was let run, and what came out."""

    machine: dict[str, str | int | None]
    repeat: int
    limit: float
    results: tuple[Result, ...]


def _single(points: Iterable[Point]) -> list[Point]:
    return [point for point in points if point.cases == 1]


class Trial:
    """A task on its way to a point: the first visit warms it up, the others time a batch each."""

    def __init__(self, task: Task, repeat: int, limit: float) -> None:
        self._task, self._repeat, self._limit = task, repeat, limit
        self._stopwatch: Stopwatch | None = None
        self._error, self._gap = math.nan, ""

    def visit(self) -> None:
        """One turn. A task that fails, or is not done in time, is left alone from then on."""
        if self._stopwatch is not None:
            self._stopwatch.batch()
        elif not self._gap:
            self._begin()

    def _begin(self) -> None:
        try:
            stopwatch = Stopwatch(self._task.run, self._repeat, self._limit)
        except (ArithmeticError, ValueError, TimeoutError) as failure:
            self._gap = str(failure)
            return
        self._error = self._task.error(stopwatch.answer)
        if math.isfinite(self._error):
            self._stopwatch = stopwatch
        else:
            self._gap = "the answer is not finite"

    @property
    def point(self) -> Point:
        """What was measured, or the gap and its reason."""
        task = self._task
        point = partial(Point, task.method, task.setting, task.measure, task.cases)
        if self._stopwatch is None:
            return point(gap=self._gap)
        return point(error=self._error, timing=self._stopwatch.timing.per(task.cases))


Watch = Callable[[Sequence[Trial], str], AbstractContextManager[Iterable[Trial]]]
"""What hands the visits of the case of a name through, one by one, and is closed at the end."""


def _unwatched(visits: Sequence[Trial], _: str) -> AbstractContextManager[Iterable[Trial]]:
    return nullcontext(visits)


def tasks(case: Case) -> list[Task]:
    """Every method at every setting, for both measures."""
    groups = (sheet_tasks, closed_form_tasks, array_tasks, scipy_tasks, mpmath_tasks)
    return [task for group in groups for task in group(case)]


def bench(
    names: Sequence[str], repeat: int = 7, limit: float = 5.0, watch: Watch = _unwatched
) -> Bench:
    """Measure everything on the named cases.

    A task and its repeats get about `limit` seconds. The tasks of a case take turns, so that a busy
    spell of the machine spoils one repeat of each and not all of one. `watch` hands their visits
    through, to show how far it has come. Raises ValueError for a case that is not there, a `repeat`
    below one and a limit that is not positive.
    """
    if repeat < 1:
        raise ValueError(f"{repeat} repeats: one or more are wanted")
    if not limit > 0:
        raise ValueError(f"a limit of {limit:g} s: it must be greater than zero")
    results = []
    for case in [build(name) for name in names]:
        trials = [Trial(task, repeat, limit) for task in tasks(case)]
        with watch(trials * (1 + repeat), case.name) as visits:
            for trial in visits:
                trial.visit()
        results.append(Result(case, tuple(trial.point for trial in trials)))
    return Bench(machine(), repeat, limit, tuple(results))

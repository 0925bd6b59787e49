"""Every method on the cases asked for: measured, compared, ranked."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial

from replication.bench.cases import Case, build
from replication.bench.machine import machine
from replication.bench.measure import measure
from replication.bench.methods import ARRAYS, CLOSED_FORM, closed_form_tasks, sheet_tasks
from replication.bench.pareto import Choice, Point, choices, front
from replication.bench.peers import SCIPY, mpmath_tasks, scipy_tasks
from replication.bench.task import Measure, Task

__all__ = ["Bench", "Result", "Watch", "bench", "point_of", "tasks"]


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

    def array_choices(self) -> list[Choice]:
        """The same for final depths, with the closed form over arrays, its time a case."""
        return choices(self.of("depth"), [ARRAYS], SCIPY)


@dataclass(frozen=True, slots=True)
class Bench:
    """A run: the machine, how often and how long each task was let run, and what came out."""

    machine: dict[str, str | int | None]
    repeat: int
    limit: float
    results: tuple[Result, ...]


def _single(points: Iterable[Point]) -> list[Point]:
    return [point for point in points if point.cases == 1]


Watch = Callable[[Sequence[Task], str], Iterable[Task]]
"""What hands the tasks of the case of a name through, one by one."""


def _unwatched(todo: Sequence[Task], _: str) -> Iterable[Task]:
    return todo


def tasks(case: Case) -> list[Task]:
    """Every method at every setting, for both measures."""
    return [*sheet_tasks(case), *closed_form_tasks(case), *scipy_tasks(case), *mpmath_tasks(case)]


def bench(
    names: Sequence[str], repeat: int = 7, limit: float = 5.0, watch: Watch = _unwatched
) -> Bench:
    """Measure everything on the named cases.

    A task and its repeats get about `limit` seconds. `watch` hands the tasks of a case through, to
    show how far it has come. Raises ValueError for a case that is not there, a `repeat` below one
    and a limit that is not positive.
    """
    if repeat < 1:
        raise ValueError(f"{repeat} repeats: one or more are wanted")
    if not limit > 0:
        raise ValueError(f"a limit of {limit:g} s: it must be greater than zero")
    cases = [build(name) for name in names]
    results = []
    for case in cases:
        points = [point_of(task, repeat, limit) for task in watch(tasks(case), case.name)]
        results.append(Result(case, tuple(points)))
    return Bench(machine(), repeat, limit, tuple(results))


def point_of(task: Task, repeat: int, limit: float) -> Point:
    """A task measured. One that fails, or is not done in time, is a gap and its reason."""
    point = partial(Point, task.method, task.setting, task.measure, task.cases)
    try:
        answer, timing = measure(task.run, repeat, limit)
    except (ArithmeticError, ValueError, TimeoutError) as failure:
        return point(gap=str(failure))
    error = task.error(answer)
    if not math.isfinite(error):
        return point(gap="the answer is not finite")
    return point(error=error, timing=timing.per(task.cases))

"""Every method on the cases asked for: measured, compared, ranked."""

import math
import os
import platform
import statistics
import tempfile
import timeit
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field, replace
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from replication.bench.cases import Case, build
from replication.bench.methods import MEASURES, OURS, Measure, Task, own_tasks
from replication.bench.peers import peer_tasks

DIGITS = range(1, 16)

BATCH = 5e-3
"""A call is repeated without a look at the clock for about so many seconds."""


@dataclass(frozen=True, slots=True)
class Point:
    """A method at a setting, measured: its error, and times [s] a case; or the gap's reason.

    `best` and `median` are of `repeats` batches of `calls` calls; `compile` is what the first call
    took longer, where something is compiled.
    """

    method: str
    setting: str
    measure: Measure
    cases: int
    error: float = math.inf
    compile: float | None = None
    best: float = math.inf
    median: float = math.inf
    repeats: int = 0
    calls: int = 0
    gap: str = ""

    @property
    def met(self) -> float:
        """The error that counts: not below half an ulp, where being nearer is luck."""
        return max(self.error, 2.0**-53)


def front(points: Iterable[Point]) -> list[Point]:
    """The points that no other beats in time without loss of accuracy; the fastest first.

    >>> points = [Point("a", "", "depth", 1, error=e, best=t) for e, t in
    ...           ((1e-3, 1.0), (1e-6, 2.0), (1e-5, 3.0))]
    >>> [point.error for point in front(points)]
    [0.001, 1e-06]
    """
    kept: list[Point] = []
    for point in sorted(points, key=lambda point: (point.best, point.met)):
        if point.met < min((other.met for other in kept), default=math.inf):
            kept.append(point)
    return kept


def error_for(digits: int) -> float:
    """The greatest relative error that leaves so many digits correct.

    >>> error_for(3)
    0.0005
    """
    return 0.5 * 10.0**-digits


def fastest(points: Iterable[Point | None], digits: int) -> Point | None:
    """The fastest of those that keep so many digits; None if there is none."""
    able = [point for point in points if point and point.met <= error_for(digits)]
    return min(able, key=lambda point: (point.best, point.met), default=None)


@dataclass(frozen=True, slots=True)
class Result:
    """A case with all its points."""

    case: Case
    points: tuple[Point, ...]

    def of(self, measure: Measure, many: bool) -> list[Point]:
        """The points of one measure; where wanted, those of many cases at once too."""
        return [p for p in self.points if p.measure == measure and (many or p.cases == 1)]

    @property
    def front(self) -> list[Point]:
        """The Pareto fronts of the methods that do one case at a time."""
        return [point for measure in MEASURES for point in front(self.of(measure, many=False))]

    def choice(
        self, measure: Measure, many: bool, digits: int
    ) -> tuple[Point | None, Point | None]:
        """For so many digits, the fastest of this project's methods and of the others."""
        points = self.of(measure, many)
        ours = fastest([point for point in points if point.method in OURS], digits)
        return ours, fastest([point for point in points if point.method not in OURS], digits)


@dataclass(frozen=True, slots=True)
class Bench:
    """A run: the machine, how often and how long each task was let run, and what came out."""

    machine: dict[str, Any]
    repeat: int
    limit: float
    results: tuple[Result, ...]


@dataclass(slots=True)
class Trial:
    """A task on its way to a point: the first visit warms it up, the others time a batch each."""

    task: Task
    repeat: int
    limit: float
    point: Point = field(init=False)
    batches: list[float] = field(default_factory=list)

    def __post_init__(self) -> None:
        task = self.task
        self.point = Point(task.method, task.setting, task.measure, task.cases)

    def visit(self) -> None:
        """One turn. A task that fails, or takes longer than the limit, is left alone from then."""
        if not self.point.calls:
            try:
                self._begin()
            except (ArithmeticError, ValueError, OSError) as failure:
                self.point = replace(self.point, gap=str(failure), calls=1)
        elif len(self.batches) < self.point.repeats:
            seconds = timeit.timeit(self.task.run, number=self.point.calls)
            self.batches.append(seconds / self.point.calls / self.task.cases)
            best, median = min(self.batches), statistics.median(self.batches)
            self.point = replace(self.point, best=best, median=median)

    def _begin(self) -> None:
        answers: list[Any] = []
        first = timeit.timeit(lambda: answers.append(self.task.run()), number=1)
        once = timeit.timeit(self.task.run, number=1)
        error = self.task.error(answers[0])
        if once > self.limit:
            raise TimeoutError(f"takes {once:.3g} s, more than {self.limit:g} s")
        if not math.isfinite(error):
            raise ArithmeticError("the answer is not finite")
        calls = max(1, round(BATCH / once))
        compiling = max(first - once, 0.0) if self.task.compiled else None
        repeats = max(1, int(min(self.repeat, self.limit / (once * calls))))
        changes: Any = {"error": error, "compile": compiling, "repeats": repeats, "calls": calls}
        self.point = replace(self.point, **changes)


Watch = Callable[[Sequence[Trial], str], AbstractContextManager[Iterable[Trial]]]
"""What hands the visits of the case of a name through, one by one, and is closed at the end."""


def bench(
    names: Sequence[str],
    repeat: int = 7,
    limit: float = 5.0,
    watch: Watch = lambda visits, _: nullcontext(visits),
) -> Bench:
    """Measure everything on the named cases.

    A task's repeats get about `limit` seconds. The tasks of a case take turns, so that a busy spell
    of the machine spoils one repeat of each and not all of one. `watch` hands their visits through,
    to show how far it has come. Raises ValueError for a case that is not there, a `repeat` below
    one and a limit that is not positive.
    """
    import numba

    from replication.models import arrays

    if repeat < 1:
        raise ValueError(f"{repeat} repeats: give one or more")
    if not limit > 0:
        raise ValueError(f"a limit of {limit:g} s: it must be greater than zero")
    results = []
    with tempfile.TemporaryDirectory() as empty:
        numba.config.CACHE_DIR = empty  # so that all is compiled anew
        arrays.ufunc.cache_clear()
        numba.vectorize(["f8(f8)"])(error_for)  # to start the compiler is no method's cost
        for case in [build(name) for name in names]:
            tasks = [*own_tasks(case), *peer_tasks(case)]
            trials = [Trial(task, repeat, limit) for task in tasks]
            with watch(trials * (1 + repeat), case.name) as visits:
                for trial in visits:
                    trial.visit()
            results.append(Result(case, tuple(trial.point for trial in trials)))
    return Bench(machine(), repeat, limit, tuple(results))


def machine() -> dict[str, Any]:
    """Processor, number of cores, system, and the versions of Python and the libraries."""
    file = Path("/proc/cpuinfo")  # where Linux tells the processor's name
    lines = file.read_text("utf-8").splitlines() if file.exists() else []
    models = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return {
        "processor": next(models, platform.processor() or platform.machine()),
        "cores": os.cpu_count(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        **{name: _version(name) for name in ("coldspray", "numpy", "numba", "scipy", "heyoka")},
    }


def _version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None

"""Time every method at every setting on cases whose exact motion is known, and rank them.

For each number of digits the fastest method is found.
"""

import math
import os
import platform
import tempfile
import timeit
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from importlib.metadata import distributions
from itertools import product
from pathlib import Path
from statistics import median
from typing import Any, Literal

import numba
import numpy as np
import numpy.typing as npt
from tqdm import tqdm

from reference.arithmetic import Number
from reference.motion import Trajectory
from reference.scheme import Scheme
from reference.signals import postponed_signals
from replication.bench.peers import SOLVERS, Kernel, bare_depth, depth_loop, sheet_loop
from replication.cases import BETA_5, changed, inputs_of
from replication.error.hard_cases import HARD_CASES
from replication.error.ladder import exact_motion
from replication.models import arrays, motion
from replication.models.impact import Impact
from replication.models.sheet import run
from replication.user_input import advice, quoted

Measure = Literal["depth", "history"]
MEASURES: dict[Measure, str] = {"depth": "final depth", "history": "history"}
"""The quantities that a method can compute, with their titles."""

BENCH_CASES = {
    "beta-5": "the report's beta-5",
    "beta-3": "the report's beta-3",
    "crossing": "depth just above R",
    "shallow": "slow, 1 m/s",
    "hypervelocity": "hypervelocity, 1e4 m/s",
}
"""The cases by their names on the command line, with their names among the hard cases."""

HISTORY_POINTS = 101
"""Number of times of a history, including the first and the last."""


@dataclass(frozen=True, slots=True)
class Case:
    """One case with its exact motion.

    `times` [s], shape (HISTORY_POINTS,), run from touch to rest; `depths` [m] are the exact depths
    then.
    """

    name: str
    impact: Impact
    motion: Trajectory
    times: npt.NDArray[np.float64]
    depths: tuple[Number, ...]

    def columns(self, count: int) -> list[Any]:
        """The inputs of `count` cases, with velocities up to 10 % below and above this one's."""
        spread = 0.1 * (count > 1) * np.linspace(-1, 1, count)
        inputs = {name: np.full(count, value) for name, value in self.impact.motion.items()}
        inputs["velocity"] *= 1 + spread
        return list(inputs.values())

    def error(self, measure: Measure, answer: Any, stop: float = 0.0) -> float:
        """Return the largest relative error of depths [m], down to the velocity `stop` [m/s].

        Eleven of the final depths of `columns` are compared. A history's depths are at `times`,
        with errors relative to the depth at rest; if there is a row for each case, the middle one
        is compared. Of a tuple of results, such as depth and velocity, the first is compared.
        """
        computed = np.atleast_1d(answer[0] if isinstance(answer, tuple) else answer)
        if measure == "depth":
            some = np.unique(np.linspace(0, len(computed) - 1, 11, dtype=int))
            velocities = self.columns(len(computed))[0][some].tolist()
            motions = [exact_motion(replace(self.impact, velocity=v)) for v in velocities]
            exact = wholes = [motion.depth_at_velocity(stop) for motion in motions]
            computed = computed[some]
        else:
            end = self.motion.depth_at_velocity(stop)
            exact = [depth for depth in self.depths if stop == 0 or depth <= end]
            wholes = [self.motion.final_depth] * len(exact)
            rows = np.atleast_2d(computed)
            computed = rows[len(rows) // 2, : len(exact)]
        terms = zip(map(self.motion.context.mpf, computed.tolist()), exact, wholes, strict=True)
        return float(np.max([float(abs(depth - true) / whole) for depth, true, whole in terms]))


def build_case(name: str) -> Case:
    """Build one of `BENCH_CASES`. Raises ValueError for another name.

    >>> case = build_case("beta-5")
    >>> f"{case.times[-1] * 1e9:.3f} ns", f"{case.error('depth', 7.67e-6):.1e}"
    ('26.079 ns', '6.4e-04')
    """
    if name not in BENCH_CASES:
        raise ValueError(f"there is no case {quoted(name)} to time: {advice(name, BENCH_CASES)}")
    impact = changed(BETA_5, HARD_CASES[BENCH_CASES[name]])
    motion, times, depths = exact_motion(impact), list[float](), list[Number]()
    for k in range(HISTORY_POINTS):
        # Depths X (1 - s^2), for equally spaced s, are about equally spaced in time. Finding the
        # time of a depth takes one quadrature; finding the depth at a time would take a dozen.
        s = motion.reals.number(Fraction(HISTORY_POINTS - 1 - k, HISTORY_POINTS - 1))
        depth = motion.final_depth * (1 - s * s)
        time = motion.time_to_depth(depth)
        times.append(float(time))
        # Rounding the time to a double changes the depth by about 1e-16; a first-order correction
        # makes up for that to within 1e-32.
        rounding = motion.context.mpf(times[-1]) - time
        depths.append(depth + motion.velocity_at_depth(depth) * rounding)
    return Case(name, impact, motion, np.array(times), tuple(depths))


# The methods

STEPS = (16.0, 4.0, 1.0, 1 / 4, 1 / 16, 1 / 64)
"""The time steps of the sheet, as multiples of the case's."""


@dataclass(frozen=True, slots=True)
class Task:
    """A method at a setting: `run` computes the quantity `measure`, down to `stop` [m/s].

    One run computes `cases` cases at once. If the method is `compiled`, the first run compiles it.
    """

    method: str
    setting: str
    measure: Measure
    run: Callable[[], Any]
    stop: float = 0.0
    cases: int = 1
    compiled: bool = False


def tasks(case: Case) -> Iterator[Task]:
    """Yield every method at every setting: this project's, ODE solvers, and plain loops."""
    given, stop = tuple(case.impact.motion.values()), case.impact.stop_velocity
    steps = [(step, f"{step * 1e9:.5g} ns") for step in (case.impact.step * f for f in STEPS)]
    for scheme, (step, setting) in product(Scheme, steps):
        name, impact = f"sheet, {scheme}", replace(case.impact, step=step)
        yield Task(name, setting, "depth", partial(_sheet_depths, impact, scheme, None), stop)
        yield Task(
            name, setting, "history", partial(_sheet_depths, impact, scheme, case.times), stop
        )
        sheets = partial(arrays.run_many, step=step, stop_velocity=stop, scheme=scheme)
        yield _many(name, setting, case, sheets, 1001, stop)
    yield Task("closed form", "no steps", "depth", partial(arrays.final_depth, *given))
    yield _many("closed form", "no steps", case, arrays.final_depth, 100_001)
    series = partial(Task, setting="order 20", measure="history")
    yield series("Taylor series, plain Python", run=partial(_plain_history, case.times, given))
    alone = partial(arrays.history, case.times, *given)
    yield series("Taylor series", run=alone, compiled=True)
    columns = [column[:, None] for column in case.columns(1001)]
    many = partial(arrays.history, case.times, *columns)
    yield series("Taylor series, many", run=many, cases=1001, compiled=True)

    for method, (form, levels, solve) in SOLVERS.items():
        for level in levels:
            yield from _solver(case, method, form.format(level), partial(solve, level))
    alone = partial(bare_depth, *given)
    yield Task("closed form, bare function", "no steps", "depth", alone)
    yield _many("closed form, Numba loop", "no steps", case, depth_loop, 100_001)
    for step, setting in steps:
        name, loop = "sheet, Numba loop", partial(sheet_loop, step, stop)
        yield _many(name, setting, case, loop, 1001, stop)
        alone = partial(loop, *case.columns(1))
        yield Task(name, setting, "depth", alone, stop, compiled=True)


def _many(name: str, setting: str, case: Case, work: Kernel, count: int, stop: float = 0) -> Task:
    work = partial(work, *case.columns(count))
    return Task(f"{name}, many", setting, "depth", work, stop, count, compiled=True)


def _sheet_depths(impact: Impact, scheme: Scheme, times: Any) -> Any:
    """Return the sheet's final depth, or its depths interpolated linearly at the times.

    The scheme's x belongs to the middle of its row, half a step before the time of the row.
    """
    rows = run(impact, scheme).rows
    if times is None:
        return rows[-1].depth
    middles = [0.0, *(row.time - impact.step / 2 for row in rows[1:])]
    return np.interp(times, middles, [row.depth for row in rows])


def _plain_history(times: Any, given: tuple[float, ...]) -> list[float]:
    depth, speed = [0.0] * len(times), [0.0] * len(times)
    motion.history(times.tolist(), *given, depth=depth, speed=speed)  # type: ignore[misc]
    return depth


def _solver(case: Case, method: str, setting: str, solve: Kernel) -> Iterator[Task]:
    """Yield final depth and history by a solver, which returns y = x/R for b, c and times."""
    impact, R = case.impact, case.impact.radius
    b = 3 * impact.target_density / (8 * impact.particle_density)
    c = 3 * impact.target_resistance / (4 * impact.particle_density * impact.velocity**2)
    times = case.times * impact.velocity / R
    ends = times[[0, -1]]
    task = partial(Task, method, setting, compiled=not method.startswith("solve_ivp"))
    yield task("depth", lambda: R * float(solve(b, c, ends)[-1]))
    yield task("history", lambda: R * np.asarray(solve(b, c, times)))


# Measuring

Point = dict[str, Any]
"""The measurements of a task by `measured_points`, as in the JSON."""

CORRECT_DIGITS = range(1, 16)

SOLVERS_DIGITS = (4, 6, 8, 10, 12)
"""The digits for which the loosest setting of each solver is sought."""


def bench(
    names: Sequence[str], repeat: int = 7, limit: float = 5.0, quiet: bool | None = True
) -> dict[str, Any]:
    """Measure all tasks on the named cases: the JSON of `coldspray bench`.

    The repeats of a task get about `limit` seconds. The tasks of a case take turns, so that a busy
    spell of the machine spoils one repeat of each rather than all repeats of one. Unless `quiet`,
    there is a progress bar; if it is None, only on a terminal. Raises ValueError for an unknown
    case or a limit that is not positive.
    """
    if not limit > 0:
        raise ValueError(f"a limit of {limit:g} s: it must be greater than zero")
    cases = [build_case(name) for name in names]
    measured = []
    with tempfile.TemporaryDirectory() as empty:
        numba.config.CACHE_DIR = empty  # so that everything is compiled again
        arrays.compiled.cache_clear()
        with postponed_signals():
            numba.vectorize(["f8(f8)"])(error_for)  # starts the compiler, which is no method's cost
        for case in cases:
            trials = [measured_points(case, task, repeat, limit) for task in tasks(case)]
            with tqdm(trials * (1 + repeat), case.name, leave=False, disable=quiet) as turns:
                points = [_next(turn) for turn in turns]
            del points[len(trials) :]  # later turns have filled in those of the first
            mark_front(points)
            asked = product((False, True), MEASURES, CORRECT_DIGITS)
            measured.append({
                "name": case.name,
                "inputs": inputs_of(case.impact),
                "depth": float(case.motion.final_depth),
                "times": case.times.tolist(),
                "points": points,
                "fastest": [fastest(points, *question) for question in asked],
            })  # fmt: skip
    runs = [case["points"] for case in measured]
    sought = product(SOLVERS, MEASURES, SOLVERS_DIGITS)
    return {
        "machine": _machine(),
        "repeat": repeat,
        "limit": limit,
        "cases": measured,
        "settings": [loosest(runs, *question) for question in sought],
    }


def _next(turn: Iterator[Point]) -> Point:
    """Let a trial take its next turn; a signal waits, as compilers and solvers would lose it."""
    with postponed_signals():
        return next(turn, {})


def measured_points(case: Case, task: Task, repeat: int, limit: float) -> Iterator[Point]:
    """Yield a task's point once a turn: the first turn warms up, each other turn times a batch.

    The point has the relative error; `best` and `median` of `repeats` batches of `calls` calls, in
    s per case; and for a compiled method the extra time of the first call. A task that fails or
    takes longer than the limit is not measured; `gap` then gives the reason.
    """
    names = ("error", "compile", "best", "median", "repeats", "calls", "gap")
    point: Point = {"method": task.method, "setting": task.setting, "measure": task.measure}
    point |= {"cases": task.cases, **dict.fromkeys(names), "front": False}
    answers: list[Any] = []
    try:
        first = timeit.timeit(lambda: answers.append(task.run()), number=1)
        once = timeit.timeit(task.run, number=1)
        error = case.error(task.measure, answers[0], task.stop)
        if once > limit:
            raise TimeoutError(f"takes {once:.3g} s, more than {limit:g} s")
        if not math.isfinite(error):
            raise ArithmeticError("the answer is not finite")
    except (ArithmeticError, ValueError, OSError) as failure:
        point["gap"] = str(failure)
        yield point
        return
    calls = max(1, round(5e-3 / once))  # a batch takes about 5 ms between two looks at the clock
    repeats = max(1, int(min(repeat, limit / (once * calls))))
    compiling = max(first - once, 0.0) if task.compiled else None
    point |= {"error": error, "compile": compiling, "repeats": repeats, "calls": calls}
    batches = []
    for _ in range(repeats):
        yield point
        batches.append(timeit.timeit(task.run, number=calls) / calls / task.cases)
        point |= {"best": min(batches), "median": median(batches)}


def met(point: Point) -> float:
    """Return the error to compare: at least half an ulp, as less is luck; infinite for a gap."""
    return math.inf if point["gap"] else max(float(point["error"]), 2.0**-53)


def ranked(points: Sequence[Point], measure: Measure, many: bool) -> list[Point]:
    """Return the points without a gap, fastest first; many cases at once count only if `many`."""
    asked = (p for p in points if not p["gap"] and p["measure"] == measure)
    able = (p for p in asked if many or p["cases"] == 1)
    return sorted(able, key=lambda point: (point["best"], met(point)))


def mark_front(points: Sequence[Point]) -> None:
    """Mark the Pareto front of single cases: no other point is faster and at least as accurate."""
    for measure in MEASURES:
        least = math.inf
        for point in ranked(points, measure, many=False):
            point["front"] = met(point) < least
            least = min(met(point), least)


def error_for(digits: int) -> float:
    """Return the greatest relative error that leaves this many digits correct.

    >>> error_for(3)
    0.0005
    """
    return 0.5 * 10.0**-digits


def fastest(points: Sequence[Point], many: bool, measure: Measure, digits: int) -> dict[str, Any]:
    """Return the fastest method for these digits and its `best` time [s]; None if there is none."""
    able = (point for point in ranked(points, measure, many) if met(point) <= error_for(digits))
    first = next(able, None)
    method = first and f"{first['method']}, {first['setting']}"
    asked = {"measure": measure, "many": many, "digits": digits}
    return asked | {"method": method, "best": first and first["best"]}


def loosest(
    runs: Sequence[Sequence[Point]], method: str, measure: Measure, digits: int
) -> dict[str, Any]:
    """Return the loosest setting of a solver that gives these digits in all cases, and its time.

    `runs` has the points of each case, those of a solver from its loosest setting to its tightest;
    `best` [s] is that of the slowest case. Both are None if no setting does. A solver does not give
    the digits of its tolerance: with 1e-8 one may be off by 1e-7 and another by 1e-9.
    """
    of_solver = [
        [p for p in run if (p["method"], p["measure"]) == (method, measure)] for run in runs
    ]
    able = (
        points for points in zip(*of_solver, strict=True)
        if max(map(met, points)) <= error_for(digits)
    )  # fmt: skip
    first = next(able, None)
    return {
        "method": method,
        "measure": measure,
        "digits": digits,
        "setting": first and first[0]["setting"],
        "best": first and max(point["best"] for point in first),
    }


def _machine() -> dict[str, Any]:
    """Return processor, number of cores, system, and the versions of Python and the libraries."""
    file = Path("/proc/cpuinfo")  # has the processor's name on Linux
    lines = file.read_text("utf-8").splitlines() if file.exists() else []
    models = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    names = ("coldspray", "numpy", "numba", "scipy", "heyoka")
    return {
        "processor": next(models, platform.processor() or platform.machine()),
        "cores": os.cpu_count(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        **{name: next((d.version for d in distributions(name=name)), None) for name in names},
    }

"""Every method on the cases asked for: measured, and the fastest for so many digits."""

import math
import os
import platform
import tempfile
import timeit
from collections.abc import Iterator, Sequence
from importlib.metadata import distributions
from itertools import product
from pathlib import Path
from statistics import median
from typing import Any

import numba
from tqdm import tqdm

from replication.bench.cases import MEASURES, Case, Measure, build
from replication.bench.methods import OURS, Task, tasks
from replication.cases import inputs_of
from replication.models import arrays

Point = dict[str, Any]
"""What `trial` measures of a task, as in the JSON."""

DIGITS = range(1, 16)

BATCH = 5e-3
"""A call is repeated without a look at the clock for about so many seconds."""


def bench(
    names: Sequence[str], repeat: int = 7, limit: float = 5.0, quiet: bool | None = True
) -> dict[str, Any]:
    """Measure everything on the named cases: the JSON of `coldspray bench`.

    A task's repeats get about `limit` seconds. The tasks of a case take turns, so that a busy spell
    of the machine spoils one repeat of each and not all of one. A progress bar is shown unless
    `quiet`; if that is None, on a terminal. Raises ValueError for a case that is not there and a
    limit that is not positive.
    """
    if not limit > 0:
        raise ValueError(f"a limit of {limit:g} s: it must be greater than zero")
    cases = [build(name) for name in names]
    with tempfile.TemporaryDirectory() as empty:
        numba.config.CACHE_DIR = empty  # so that all is compiled anew
        arrays.ufunc.cache_clear()
        numba.vectorize(["f8(f8)"])(error_for)  # to start the compiler is no method's cost
        measured = [_measure(case, repeat, limit, quiet) for case in cases]
    return {"machine": _machine(), "repeat": repeat, "limit": limit, "cases": measured}


def _measure(case: Case, repeat: int, limit: float, quiet: bool | None) -> dict[str, Any]:
    trials = [trial(case, task, repeat, limit) for task in tasks(case)]
    with tqdm(trials * (1 + repeat), case.name, leave=False, disable=quiet) as turns:
        points = [next(turn, {}) for turn in turns][: len(trials)]  # later turns fill them in
    mark_front(points)
    return {
        "name": case.name,
        "inputs": inputs_of(case.impact),
        "depth": float(case.motion.final_depth),
        "times": case.times.tolist(),
        "points": points,
        "ratios": [ratio(points, *asked) for asked in product((False, True), MEASURES, DIGITS)],
    }


def trial(case: Case, task: Task, repeat: int, limit: float) -> Iterator[Point]:
    """A task's point, measured in turns: the first warms it up, the others time a batch each.

    It has the relative error, and in s a case `best` and `median` of `repeats` batches of `calls`
    calls, and what the first call took longer where something is compiled. A task that fails, or
    takes longer than the limit, is left alone from then: a `gap`, for this reason.
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
    calls = max(1, round(BATCH / once))
    repeats = max(1, int(min(repeat, limit / (once * calls))))
    compiling = max(first - once, 0.0) if task.compiled else None
    point |= {"error": error, "compile": compiling, "repeats": repeats, "calls": calls}
    batches = []
    for _ in range(repeats):
        yield point
        batches.append(timeit.timeit(task.run, number=calls) / calls / task.cases)
        point |= {"best": min(batches), "median": median(batches)}


def met(point: Point) -> float:
    """The error that counts: not below half an ulp, where being nearer is luck; of a gap, any."""
    return math.inf if point["gap"] else max(float(point["error"]), 2.0**-53)


def ranked(points: Sequence[Point], measure: Measure, many: bool) -> list[Point]:
    """Those without a gap, the fastest first; where wanted, those of many cases at once too."""
    asked = (p for p in points if not p["gap"] and p["measure"] == measure)
    able = (p for p in asked if many or p["cases"] == 1)
    return sorted(able, key=lambda point: (point["best"], met(point)))


def mark_front(points: Sequence[Point]) -> None:
    """Mark those of one case at a time that no other beats in time without loss of accuracy."""
    for measure in MEASURES:
        least = math.inf
        for point in ranked(points, measure, many=False):
            point["front"] = met(point) < least
            least = min(met(point), least)


def error_for(digits: int) -> float:
    """The greatest relative error that leaves so many digits correct.

    >>> error_for(3)
    0.0005
    """
    return 0.5 * 10.0**-digits


def ratio(points: Sequence[Point], many: bool, measure: Measure, digits: int) -> dict[str, Any]:
    """For so many digits, the fastest of this project's methods and of the others."""
    able = [point for point in ranked(points, measure, many) if met(point) <= error_for(digits)]
    row: dict[str, Any] = {"measure": measure, "many": many, "digits": digits}
    row |= {"error": error_for(digits), "fastest": title(able[0]) if able else None}
    for side, ours in (("ours", True), ("peer", False)):
        best = next((point for point in able if (point["method"] in OURS) == ours), None)
        row |= {side: best and best["best"], f"{side}_method": best and title(best)}
    return row | {"ratio": row["peer"] / row["ours"] if row["peer"] and row["ours"] else None}


def title(point: Point) -> str:
    """Method and setting."""
    return f"{point['method']}, {point['setting']}"


def _machine() -> dict[str, Any]:
    """Processor, number of cores, system, and the versions of Python and the libraries."""
    file = Path("/proc/cpuinfo")  # where Linux tells the processor's name
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

"""Measuring every method on the cases asked for, and finding the fastest for so many digits."""

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

from replication.bench.tasks import MEASURES, Case, Measure, Task, build, tasks
from replication.cases import inputs_of
from replication.models import arrays

Point = dict[str, Any]
"""What `trial` measures of a task, as in the JSON."""

DIGITS = range(1, 16)


def bench(
    names: Sequence[str], repeat: int = 7, limit: float = 5.0, quiet: bool | None = True
) -> dict[str, Any]:
    """Measure everything on the named cases: the JSON of `coldspray bench`.

    A task's repeats get about `limit` seconds. The tasks of a case take turns, so that a busy spell
    of the machine spoils one repeat of each and not all of one. Unless `quiet` there is a progress
    bar; if that is None, on a terminal. Raises ValueError for another case or no positive limit.
    """
    if not limit > 0:
        raise ValueError(f"a limit of {limit:g} s: it must be greater than zero")
    cases = [build(name) for name in names]
    measured = []
    with tempfile.TemporaryDirectory() as empty:
        numba.config.CACHE_DIR = empty  # so that all is compiled anew
        arrays.ufunc.cache_clear()
        numba.vectorize(["f8(f8)"])(error_for)  # starting the compiler is no method's cost
        for case in cases:
            trials = [trial(case, task, repeat, limit) for task in tasks(case)]
            with tqdm(trials * (1 + repeat), case.name, leave=False, disable=quiet) as turns:
                points = [next(turn, {}) for turn in turns]
            del points[len(trials) :]  # later turns have filled in those of the first
            mark_front(points)
            asked = product((False, True), MEASURES, DIGITS)
            measured.append({
                "name": case.name,
                "inputs": inputs_of(case.impact),
                "depth": float(case.motion.final_depth),
                "times": case.times.tolist(),
                "points": points,
                "fastest": [fastest(points, *question) for question in asked],
            })  # fmt: skip
    return {"machine": _machine(), "repeat": repeat, "limit": limit, "cases": measured}


def trial(case: Case, task: Task, repeat: int, limit: float) -> Iterator[Point]:
    """A task's point, measured in turns: the first warms it up, the others time a batch each.

    It has the relative error; `best` and `median`, in s for one case, of `repeats` batches of
    `calls` calls; and, of a compiled method, how much longer the first call took. A task that fails
    or takes longer than the limit is not measured; `gap` then says why.
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
    """The error that counts: at least half an ulp, as less is luck; infinity for a gap."""
    return math.inf if point["gap"] else max(float(point["error"]), 2.0**-53)


def ranked(points: Sequence[Point], measure: Measure, many: bool) -> list[Point]:
    """Those without a gap, the fastest first; if `many`, also those of many cases at once."""
    asked = (p for p in points if not p["gap"] and p["measure"] == measure)
    able = (p for p in asked if many or p["cases"] == 1)
    return sorted(able, key=lambda point: (point["best"], met(point)))


def mark_front(points: Sequence[Point]) -> None:
    """Mark the Pareto front of one case at a time: no other is faster and at least as accurate."""
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


def fastest(points: Sequence[Point], many: bool, measure: Measure, digits: int) -> dict[str, Any]:
    """The fastest method for so many digits and its `best` time [s]; None where there is none."""
    able = (point for point in ranked(points, measure, many) if met(point) <= error_for(digits))
    first = next(able, None)
    method = first and f"{first['method']}, {first['setting']}"
    asked = {"measure": measure, "many": many, "digits": digits}
    return asked | {"method": method, "best": first and first["best"]}


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

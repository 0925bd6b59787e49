"""Work-precision as records."""

from collections.abc import Iterable
from typing import Any

from replication.bench.pareto import Choice, Point, error_for
from replication.bench.run import Bench, Result
from replication.bench.task import MEASURES, Measure
from replication.case import inputs_of

__all__ = ["bench_record", "bench_rows"]


def bench_record(done: Bench) -> dict[str, Any]:
    """The JSON of `coldspray bench`: errors relative, times in s a case."""
    return {
        "machine": done.machine,
        "repeat": done.repeat,
        "limit": done.limit,
        "cases": [_case_record(result) for result in done.results],
    }


def _case_record(result: Result) -> dict[str, Any]:
    case = result.case
    return {
        "name": case.name,
        "inputs": inputs_of(case.impact),
        "depth": float(case.motion.final_depth),
        "times": case.times.tolist(),
        "points": list(_points(result)),
        "ratios": [_ratio(*row) for row in _choices(result)],
    }


def _points(result: Result) -> Iterable[dict[str, Any]]:
    fronts = [point for measure in MEASURES for point in result.front(measure)]
    for point in result.points:
        timing = point.timing
        yield {
            "method": point.method,
            "setting": point.setting,
            "measure": point.measure,
            "cases": point.cases,
            "error": point.error,
            "best": None if timing is None else timing.best,
            "median": None if timing is None else timing.median,
            "repeats": None if timing is None else timing.repeats,
            "calls": None if timing is None else timing.calls,
            "front": point in fronts,
            "gap": point.gap or None,
        }


def _choices(result: Result) -> Iterable[tuple[Measure, bool, Choice]]:
    """Measure, whether over arrays, choice."""
    for measure in MEASURES:
        yield from ((measure, False, choice) for choice in result.choices(measure))
    for measure in MEASURES:
        yield from ((measure, True, choice) for choice in result.array_choices(measure))


def _ratio(measure: Measure, arrays: bool, choice: Choice) -> dict[str, Any]:
    return {
        "measure": measure,
        "arrays": arrays,
        "digits": choice.digits,
        "error": error_for(choice.digits),
        "fastest": _name(choice.best),
        "closed_form": None if choice.ours is None else choice.ours.seconds,
        "scipy": None if choice.peer is None else choice.peer.seconds,
        "scipy_method": _name(choice.peer),
        "ratio": choice.ratio,
    }


def _name(point: Point | None) -> str | None:
    return None if point is None else f"{point.method}, {point.setting}"


def bench_rows(record: dict[str, Any]) -> list[dict[str, Any]]:
    """The points of a record as the rows of its CSV, each with its case's name."""
    return [{"case": case["name"], **point} for case in record["cases"] for point in case["points"]]

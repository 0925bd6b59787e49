"""Work-precision as tables, and the plain answer."""

from collections.abc import Iterator, Sequence
from itertools import groupby

from replication.bench.pareto import Choice, Point
from replication.bench.run import Bench, Result
from replication.bench.task import MEASURES, Measure
from replication.text import aligned, number

__all__ = ["TITLES", "bench_text"]

TITLES = {"depth": "final depth", "history": "history"}


def bench_text(done: Bench) -> str:
    """The whole run: machine, every case's tables, and what to use for N digits."""
    machine = ", ".join(f"{name} {value}" for name, value in done.machine.items())
    return "\n".join(
        [
            machine,
            "The final depth of the sheet is measured against the exact one at the stop velocity, "
            "all others at rest; a history's worst error is relative to the depth at rest.",
            f"Times are a case's: best and median of {done.repeat} repeats, or of those that "
            f"{done.limit:g} s allow. * marks the Pareto front of one case at a time.",
            *(line for result in done.results for line in ("", *_case_lines(result))),
            "",
            "What should I use for N digits?",
            *(f"  {line}" for measure in MEASURES for line in _answer(done.results, measure)),
        ]
    )


def _case_lines(result: Result) -> Iterator[str]:
    yield f"{result.case.name}: {float(result.case.motion.final_depth) * 1e6:.7g} um"
    yield from aligned([_HEADS, _UNITS, *_rows(result)])
    gaps = [point for point in result.points if point.gap]
    yield from (f"- {p.method}, {p.setting}, {TITLES[p.measure]}: {p.gap}" for p in gaps)
    yield ""
    yield from aligned([_RATIO_HEADS, *_ratio_rows(result)])


_HEADS = ("method", "setting", "final depth", "", "", "", "history", "", "", "")
_UNITS = ("", "", "error", "best [us]", "median", "", "error", "best [us]", "median", "")


def _rows(result: Result) -> Iterator[tuple[str, ...]]:
    """One row a method and setting, with both measures side by side."""
    fronts = [point for measure in MEASURES for point in result.front(measure)]
    found = {(p.method, p.setting, p.measure): p for p in result.points}
    for method, setting in dict.fromkeys((p.method, p.setting) for p in result.points):
        cells = [_cells(found.get((method, setting, measure)), fronts) for measure in MEASURES]
        yield (method, setting, *cells[0], *cells[1])


def _cells(point: Point | None, fronts: Sequence[Point]) -> tuple[str, ...]:
    if point is None or point.error is None or point.timing is None:
        return ("" if point is None else "-", "", "", "")
    times = (_microseconds(point.timing.best), _microseconds(point.timing.median))
    return (f"{point.error:.1e}", *times, "*" if point in fronts else "")


def _microseconds(seconds: float) -> str:
    return f"{1e6 * seconds:.0f}" if seconds >= 1e-3 else number(1e6 * seconds, 4)


_RATIO_HEADS = ("digits", "best of SciPy", "times our time: final depth", "over arrays",
                "best of SciPy", "history")  # fmt: skip


def _ratio_rows(result: Result) -> Iterator[tuple[str, ...]]:
    columns = (result.choices("depth"), result.array_choices(), result.choices("history"))
    for depth, arrays, history in zip(*columns, strict=True):
        yield (
            str(depth.digits),
            _name(depth.peer),
            _times(depth),
            _times(arrays),
            _name(history.peer),
            _times(history),
        )


def _name(point: Point | None) -> str:
    return "-" if point is None else f"{point.method}, {point.setting}"


def _times(choice: Choice) -> str:
    return "-" if choice.ratio is None else number(choice.ratio, 3)


def _answer(results: Sequence[Result], measure: Measure) -> Iterator[str]:
    """The fastest for one case at a time, a line for all numbers of digits with the same answer."""
    names = [result.case.name for result in results]
    rows = list(zip(*(result.choices(measure) for result in results), strict=True))
    for advice, group in groupby(rows, key=lambda row: _advice(names, row)):
        choices = [choice for row in group for choice in row]
        first, last = choices[0].digits, choices[-1].digits
        digits = "1 digit" if last == 1 else f"{last} digits"
        digits = digits if first == last else f"{first} to {digits}"
        yield f"{TITLES[measure]}, {digits}: {advice}{_lead(choices)}"


def _advice(names: Sequence[str], row: Sequence[Choice]) -> str:
    """One method if it is the fastest in all cases, or each with its cases."""
    cases: dict[str, list[str]] = {}
    for name, choice in zip(names, row, strict=True):
        best = "none of these" if choice.best is None else choice.best.method
        cases.setdefault(best, []).append(name)
    if len(cases) == 1:
        return next(iter(cases))
    return ", ".join(f"{method} ({', '.join(where)})" for method, where in cases.items())


def _lead(choices: Sequence[Choice]) -> str:
    ratios = [choice.ratio for choice in choices if choice.ratio is not None]
    if not ratios:
        return ""
    least, most = number(min(ratios), 3), number(max(ratios), 3)
    times = least if least == most else f"{least} to {most}"
    return f"; SciPy takes {times} times as long as the closed form"

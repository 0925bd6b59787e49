"""Work-precision as tables, and the plain answer."""

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import groupby

from replication.bench.pareto import Choice, Point
from replication.bench.run import Bench, Result
from replication.bench.task import MEASURES
from replication.text import aligned, number

__all__ = ["TITLES", "bench_text"]

TITLES = {"depth": "final depth", "history": "history"}


def bench_text(done: Bench) -> str:
    """The whole run: machine, every case's tables, and what to use for N digits."""
    machine = ", ".join(f"{name} {value}" for name, value in done.machine.items())
    return "\n".join(
        [
            machine,
            "The sheet is measured down to its stop velocity: its final depth against the exact "
            "one there, its history until the exact time of it. All others are measured to rest. "
            "A history's worst error is relative to the depth at rest.",
            f"Times are a case's: best and median of {_repeats(done.repeat)} that take turns, or "
            f"of those that {done.limit:g} s allow. "
            "* marks the Pareto front of one case at a time.",
            *(line for result in done.results for line in ("", *_case_lines(result))),
            "",
            "What should I use for N digits?",
            *(f"  {line}" for line in _answers(done.results)),
        ]
    )


def _repeats(count: int) -> str:
    return "1 repeat" if count == 1 else f"{count} repeats"


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
                "best of SciPy", "history", "over arrays")  # fmt: skip


def _ratio_rows(result: Result) -> Iterator[tuple[str, ...]]:
    columns = (of(measure) for measure in MEASURES for of in (result.choices, result.array_choices))
    for row in zip(*columns, strict=True):
        depth, depths, history, histories = row
        yield (
            str(depth.digits),
            *(_name(depth.peer), _times(depth), _times(depths)),
            *(_name(history.peer), _times(history), _times(histories)),
        )


def _name(point: Point | None) -> str:
    return "-" if point is None else f"{point.method}, {point.setting}"


def _times(choice: Choice) -> str:
    return "-" if choice.ratio is None else number(choice.ratio, 3)


def _answers(results: Sequence[Result]) -> Iterator[str]:
    """For one case at a time, then for many: what is the fastest for how many digits."""
    for measure in MEASURES:
        yield from _answer(TITLES[measure], results, [r.choices(measure) for r in results])
    for measure in MEASURES:
        title = f"{TITLES[measure]} of many cases"
        yield from _answer(title, results, [r.array_choices(measure) for r in results])


def _answer(
    title: str, results: Sequence[Result], found: Sequence[Sequence[Choice]]
) -> Iterator[str]:
    """A line for all numbers of digits with the same answer; `found` holds each case's choices."""
    names = [result.case.name for result in results]
    for answer, group in groupby(zip(*found, strict=True), key=partial(_advice, names)):
        choices = [choice for row in group for choice in row]
        first, last = choices[0].digits, choices[-1].digits
        digits = "1 digit" if last == 1 else f"{last} digits"
        digits = digits if first == last else f"{first} to {digits}"
        best, cannot = answer
        yield f"{title}, {digits}: " + "; ".join(filter(None, (best, _lead(choices), cannot)))


def _advice(names: Sequence[str], row: Sequence[Choice]) -> tuple[str, str]:
    """One method if it is the fastest in all cases, or each with its cases; and where SciPy fails.

    That is where SciPy reaches no such error and something else does.
    """
    cases: dict[str, list[str]] = {}
    for name, choice in zip(names, row, strict=True):
        best = "none of these" if choice.best is None else choice.best.method
        cases.setdefault(best, []).append(name)
    pairs = zip(names, row, strict=True)
    unable = [name for name, choice in pairs if choice.best and choice.peer is None]
    where = "" if len(unable) == len(names) else f" ({', '.join(unable)})"
    return _listed(cases), f"SciPy cannot{where}" if unable else ""


def _listed(cases: dict[str, list[str]]) -> str:
    if len(cases) == 1:
        return next(iter(cases))
    return ", ".join(f"{method} ({', '.join(where)})" for method, where in cases.items())


def _lead(choices: Sequence[Choice]) -> str:
    """How much longer SciPy takes than what is recommended, unless that is SciPy itself."""
    others = [choice for choice in choices if choice.best != choice.peer]
    ratios = [choice.best_ratio for choice in others if choice.best_ratio is not None]
    if not ratios:
        return ""
    least, most = number(min(ratios), 3), number(max(ratios), 3)
    return f"SciPy takes {least if least == most else f'{least} to {most}'} times as long"

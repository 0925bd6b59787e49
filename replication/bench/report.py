"""What a run has measured: text, JSON, CSV, and a figure a case."""

import io
import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any

from replication.bench.methods import MEASURES, OURS, TITLES, Measure
from replication.bench.run import DIGITS, Bench, Point, Result, error_for, fastest
from replication.cases import inputs_of
from replication.plain import json_text, rows_csv
from replication.text import aligned, number
from spreadsheets.safely import check_folder, write_folder


def bench_record(done: Bench) -> dict[str, Any]:
    """The JSON of `coldspray bench`: errors relative, times in s a case."""
    return {
        "machine": done.machine,
        "repeat": done.repeat,
        "limit": done.limit,
        "cases": [_case_record(result) for result in done.results],
    }


def _case_record(result: Result) -> dict[str, Any]:
    case, front = result.case, result.front
    return {
        "name": case.name,
        "inputs": inputs_of(case.impact),
        "depth": float(case.motion.final_depth),
        "times": case.times.tolist(),
        "points": [_point(point, point in front) for point in result.points],
        "ratios": [
            _ratio(result, measure, many, digits)
            for many in (False, True)
            for measure in MEASURES
            for digits in DIGITS
        ],
    }


def _ratio(result: Result, measure: Measure, many: bool, digits: int) -> dict[str, Any]:
    ours, peer = result.choice(measure, many, digits)
    return {
        "measure": measure,
        "many": many,
        "digits": digits,
        "error": error_for(digits),
        "fastest": _name(fastest((ours, peer), digits)),
        "ours": ours and ours.best,
        "ours_method": _name(ours),
        "peer": peer and peer.best,
        "peer_method": _name(peer),
        "ratio": peer.best / ours.best if ours and peer else None,
    }


def _name(point: Point | None) -> str | None:
    return None if point is None else f"{point.method}, {point.setting}"


def _point(point: Point, on_front: bool) -> dict[str, Any]:
    known = {name: None if value == math.inf else value for name, value in asdict(point).items()}
    gap = {"repeats": None, "calls": None} if point.gap else {"gap": None}
    return known | gap | {"front": on_front}


def bench_rows(done: Bench) -> list[dict[str, Any]]:
    """The points as the rows of the CSV, each with its case's name."""
    cases = bench_record(done)["cases"]
    return [{"case": case["name"], **point} for case in cases for point in case["points"]]


def bench_text(done: Bench) -> str:
    """The whole run: machine, every case's table, and what to use for N digits."""
    repeats = "1 repeat" if done.repeat == 1 else f"{done.repeat} repeats"
    return "\n".join(
        [
            ", ".join(f"{name} {value}" for name, value in done.machine.items()),
            "The sheet is measured down to its stop velocity: its final depth against the exact "
            "one there, its history until the exact time of it. All others are measured to rest, "
            "and all but solve_ivp and this project's are told when it comes. "
            "A history's worst error is relative to the depth at rest.",
            f"Times are a case's, in us: best and median of {repeats} that take turns, or of those "
            f"that {done.limit:g} s allow; to compile in s. "
            "* marks the Pareto front of one case at a time.",
            *(line for result in done.results for line in ("", *_case_lines(result))),
            "",
            "What should I use for N digits?",
            *(f"  {line}" for line in _answers(done.results)),
        ]
    )


def _case_lines(result: Result) -> Iterator[str]:
    yield f"{result.case.name}: {float(result.case.motion.final_depth) * 1e6:.7g} um"
    heads = ("error", "best", "median", "")
    points = {(p.method, p.setting, p.measure): p for p in result.points}
    front = result.front
    rows: list[tuple[str, ...]] = [
        ("method", "setting", "compile", "final depth", "", "", "", "history", "", "", ""),
        ("", "", "", *heads, *heads),
    ]
    for method, setting in dict.fromkeys((p.method, p.setting) for p in result.points):
        pair = [points.get((method, setting, measure)) for measure in MEASURES]
        seconds = max((p.compile or 0.0 for p in pair if p), default=0.0)
        cells = [cell for point in pair for cell in _cells(point, front)]
        rows.append((method, setting, f"{seconds:.2f}" if seconds > 5e-3 else "", *cells))
    yield from aligned(rows)
    for point in result.points:
        if point.gap:
            yield f"- {_name(point)}, {TITLES[point.measure]}: {point.gap}"


def _cells(point: Point | None, front: Sequence[Point]) -> tuple[str, ...]:
    if point is None or point.gap:
        return ("" if point is None else "-", "", "", "")
    times = (_microseconds(point.best), _microseconds(point.median))
    return (f"{point.error:.1e}", *times, "*" if point in front else "")


def _microseconds(seconds: float) -> str:
    return f"{1e6 * seconds:.0f}" if seconds >= 1e-3 else number(1e6 * seconds, 4)


def _answers(results: Sequence[Result]) -> Iterator[str]:
    """For one case at a time, then for many: what is the fastest for how many digits."""
    names = [result.case.name for result in results]
    for many in (False, True):
        for measure in MEASURES:
            title = f"{TITLES[measure]} of many cases" if many else TITLES[measure]
            rows = [[r.choice(measure, many, digits) for r in results] for digits in DIGITS]
            for answer, group in groupby(zip(DIGITS, rows, strict=True), partial(_advice, names)):
                of_digits = dict(group)
                first, last = min(of_digits), max(of_digits)
                digits = f"{first} to {last}" if first < last else f"{last}"
                choices = [choice for row in of_digits.values() for choice in row]
                plural = "s" if last > 1 else ""
                yield f"{title}, {digits} digit{plural}: {answer}{_lead(choices)}"


Choice = tuple[Point | None, Point | None]


def _advice(names: Sequence[str], row: tuple[int, Sequence[Choice]]) -> str:
    """The method that is the fastest in all cases, or each with its cases."""
    cases: dict[str, list[str]] = {}
    for name, choice in zip(names, row[1], strict=True):
        best = fastest(choice, row[0])
        cases.setdefault(best.method if best else "none of these", []).append(name)
    if len(cases) == 1:
        return next(iter(cases))
    return ", ".join(f"{method} ({', '.join(where)})" for method, where in cases.items())


def _lead(choices: Sequence[Choice]) -> str:
    """How long the best takes, and how many times as long the others' best where it is ours."""
    pairs = [(ours.best if ours else math.inf, peer.best if peer else math.inf)
             for ours, peer in choices if ours or peer]  # fmt: skip
    if not pairs:
        return ""
    text = f", {_span([1e6 * min(pair) for pair in pairs])} us"
    leads = [peer / ours for ours, peer in pairs if ours < peer < math.inf]
    text += f"; the others' best takes {_span(leads)} times as long" if leads else ""
    return text + ("; some cases are beyond the others" if math.inf in dict(pairs).values() else "")


def _span(values: Sequence[float]) -> str:
    least, most = number(min(values), 3), number(max(values), 3)
    return least if least == most else f"{least} to {most}"


_SETTINGS: Any = {
    "font.family": "DejaVu Sans",  # comes with matplotlib: the same letters on every machine
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "svg.hashsalt": "coldspray",  # or the ids in the file would differ from run to run
    "svg.fonttype": "none",
}


def figure(result: Result, kind: str) -> bytes:
    """The figure of one case as "svg" or "png": error against time a case, on a white ground."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    content = io.BytesIO()
    methods = list(dict.fromkeys(point.method for point in result.points))
    colors = mpl.colormaps["tab20"]
    with mpl.rc_context(_SETTINGS):
        drawn = Figure(figsize=(12, 5.5), layout="constrained")
        for panel, measure in zip(drawn.subplots(1, 2), MEASURES, strict=True):
            panel.set(xscale="log", yscale="log", title=f"{result.case.name}: {TITLES[measure]}")
            panel.set(xlabel="time a case [s]", ylabel="relative error")
            panel.grid(color="#E5E5E5", linewidth=0.6)
            for k, method in enumerate(methods):
                points = [p for p in result.of(measure, many=True) if p.method == method]
                # A gap breaks the line.
                times = [math.nan if p.gap else p.best for p in points]
                errors = [math.nan if p.gap else p.met for p in points]
                look: Any = {"color": colors(k % 20), "marker": "s" if method in OURS else "o"}
                look |= {"markersize": 4, "linewidth": 1.0, "linestyle": "-" if k < 20 else "--"}
                panel.plot(times, errors, label=method if measure == "depth" else None, **look)
            edge = [point for point in result.front if point.measure == measure]
            where = ([p.best for p in edge], [p.met for p in edge])
            label = "Pareto front, one case at a time" if measure == "depth" else None
            panel.step(*where, where="post", color="#D55E00", linewidth=6, alpha=0.2, label=label)
        drawn.legend(loc="outside lower center", ncols=5, frameon=False)
        # A date would make the same numbers another file; only SVG would have one.
        undated = {"Date": None} if kind == "svg" else None
        drawn.savefig(content, format=kind, dpi=150, metadata=undated)
    return content.getvalue()


TEXTS, KINDS = ("bench.txt", "bench.json", "bench.csv"), ("svg", "png")


def check(folder: Path, cases: Sequence[str]) -> None:
    """Raise OSError where the files of a run on these cases cannot be written."""
    figures = [f"bench-{case}.{kind}" for case in cases for kind in KINDS]
    check_folder(folder, [*TEXTS, *figures])


def write(done: Bench, folder: Path) -> None:
    """Write bench.txt, .json and .csv, and a figure a case, into a folder, made if needed.

    All or none. Raises OSError.
    """
    texts = (bench_text(done) + "\n", json_text(bench_record(done)), rows_csv(bench_rows(done)))
    files = {name: text.encode() for name, text in zip(TEXTS, texts, strict=True)}
    for result in done.results:
        for kind in KINDS:
            files[f"bench-{result.case.name}.{kind}"] = figure(result, kind)
    write_folder(folder, files)

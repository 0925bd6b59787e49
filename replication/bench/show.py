"""The results of a run as text, JSON and CSV, and a figure for each case."""

import io
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from operator import itemgetter
from pathlib import Path
from typing import Any

import numpy as np

from replication.bench.measure import MEASURES, Point, met, ranked
from replication.bench.peers import SOLVERS
from replication.text import aligned, columns, json_text, number, rows_csv
from spreadsheets.safely import write_folder

_HEAD = """\
The sheet is measured down to its stop velocity: its final depth against the exact one there, its \
history until the exact time of it. All others are measured to rest, and all but solve_ivp and \
this project's are told when it comes. A history's worst error is relative to the depth at rest.
Times are for one case, in us: best and median of {repeats}, taken in turn, or of as many as \
{limit:g} s allow; compile times are in s. * marks the Pareto front of one case at a time."""


def texts(record: dict[str, Any], width: int = 10_000) -> dict[str, str]:
    """Return the text files of a run, by file name.

    Where a table is wider than `width`, final depth and history have one each.
    """
    cases = record["cases"]
    repeats = "1 repeat" if record["repeat"] == 1 else f"{record['repeat']} repeats"
    lines = [
        ", ".join(f"{name} {value}" for name, value in record["machine"].items()),
        _HEAD.format(repeats=repeats, limit=record["limit"]),
    ]
    for case in cases:
        lines += [
            "",
            f"{case['name']}: {case['depth'] * 1e6:.7g} um",
            *_table(case["points"], width),
        ]
    lines += ["", "What should I use for N digits?", *_answers(cases), ""]
    rows = [{"case": case["name"], **point} for case in cases for point in case["points"]]
    csv = rows_csv(rows)
    return {"bench.txt": "\n".join(lines), "bench.json": json_text(record), "bench.csv": csv}


def _table(points: Sequence[Point], width: int) -> Iterator[str]:
    heads = ("error", "best", "median", "")
    rows: list[tuple[str, ...]] = [
        ("method", "setting", "compile", "final depth", "", "", "", "history", "", "", ""),
        ("", "", "", *heads, *heads),
    ]
    for (method, setting), group in groupby(points, itemgetter("method", "setting")):
        known = {point["measure"]: point for point in group}
        seconds = max(point["compile"] or 0.0 for point in known.values())
        cells = [cell for measure in MEASURES for cell in _cells(known.get(measure))]
        rows.append((method, setting, f"{seconds:.2f}" if seconds > 5e-3 else "", *cells))
    table = aligned(rows)
    if max(map(len, table)) > width:
        history = [(*row[:2], *row[7:]) for row in rows]
        table = [columns([row[:7] for row in rows], width), "", columns(history, width)]
    yield from table
    for point in points:
        if point["gap"]:
            yield "- {method}, {setting}, {}: {gap}".format(MEASURES[point["measure"]], **point)


def _cells(point: Point | None) -> tuple[str, ...]:
    if point is None or point["gap"]:
        return ("-" if point else "", "", "", "")
    seconds = (point["best"], point["median"])
    times = (f"{1e6 * s:.0f}" if s >= 1e-3 else number(1e6 * s, 4) for s in seconds)
    return (f"{point['error']:.1e}", *times, "*" if point["front"] else "")


def _answers(cases: Sequence[dict[str, Any]]) -> Iterator[str]:
    """Yield the fastest methods by number of digits, for single cases and then for many."""

    def advice(row: Sequence[dict[str, Any]]) -> tuple[str, str]:
        """Return the question, and the fastest method of all cases or each with its cases."""
        asked = MEASURES[row[0]["measure"]] + (" of many cases" if row[0]["many"] else "")
        where: dict[str, list[str]] = {}
        for case, answer in zip(cases, row, strict=True):
            method = answer["method"].rpartition(", ")[0] if answer["method"] else "none of these"
            where.setdefault(method, []).append(case["name"])
        if len(where) == 1:
            return asked, next(iter(where))
        return asked, ", ".join(f"{method} ({', '.join(of)})" for method, of in where.items())

    questions = zip(*(case["fastest"] for case in cases), strict=True)
    for (asked, answer), group in groupby(questions, advice):
        answers = [answer for row in group for answer in row]
        digits = _span([answers[0]["digits"], answers[-1]["digits"]])
        times = [1e6 * answer["best"] for answer in answers if answer["best"]]
        taken = f", {_span(times)} us" if times else ""
        yield f"  {asked}, {digits} digit{'' if digits == '1' else 's'}: {answer}{taken}"


def _span(values: Sequence[float]) -> str:
    least, most = number(min(values), 3), number(max(values), 3)
    return least if least == most else f"{least} to {most}"


_STYLE: Any = {
    "font.family": "DejaVu Sans",  # comes with matplotlib, so that every machine has it
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#E5E5E5",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.0,
    "lines.markersize": 4,
    "svg.hashsalt": "coldspray",  # otherwise ids in the file would differ from run to run
    "svg.fonttype": "none",
}


def figure(case: dict[str, Any]) -> bytes:
    """Draw error against time for one case, as SVG on a white background."""
    import matplotlib as mpl
    from matplotlib.figure import Figure
    from matplotlib.rcsetup import cycler

    content, methods = io.BytesIO(), dict.fromkeys(point["method"] for point in case["points"])
    colors = mpl.colormaps["tab20"](range(20))
    looks = cycler(linestyle=("-", "--")) * cycler(color=list(colors))
    with mpl.rc_context({**_STYLE, "axes.prop_cycle": looks}):
        drawn = Figure(figsize=(12, 5.5), layout="constrained")
        for panel, measure in zip(drawn.subplots(1, 2), MEASURES, strict=True):
            panel.set(xscale="log", yscale="log", title=f"{case['name']}: {MEASURES[measure]}")
            panel.set(xlabel="time a case [s]", ylabel="relative error")
            points = [point for point in case["points"] if point["measure"] == measure]
            for method in methods:
                line = _line(point for point in points if point["method"] == method)
                is_peer = method in SOLVERS or "Numba" in method or "bare" in method
                panel.plot(*line, marker="o" if is_peer else "s", label=method)
            front = [point for point in ranked(points, measure, many=False) if point["front"]]
            edge: Any = {"label": "Pareto front, one case at a time", "color": "#D55E00"}
            panel.step(*_line(front), "-", where="post", linewidth=6, alpha=0.2, **edge)
        labels = panel.get_legend_handles_labels()
        drawn.legend(*labels, loc="outside lower center", ncols=5, frameon=False)
        # Without a date, the same numbers give the same file.
        drawn.savefig(content, format="svg", metadata={"Date": None})
    return content.getvalue()


def _line(points: Iterable[Point]) -> Any:
    """Return times and errors; a gap is NaN and breaks the line."""
    return np.array([(p["best"], met(p)) for p in points], float).reshape(-1, 2).T


def write(folder: Path, record: dict[str, Any]) -> None:
    """Write text, JSON, CSV and all figures into a folder, or none of them. Raises OSError."""
    figures = {f"bench-{case['name']}.svg": figure(case) for case in record["cases"]}
    write_folder(folder, {name: text.encode() for name, text in texts(record).items()} | figures)

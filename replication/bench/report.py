"""What a run has measured, from its JSON: text, CSV, and a figure a case."""

import io
import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from operator import itemgetter
from pathlib import Path
from typing import Any

import numpy as np

from replication.bench.cases import MEASURES
from replication.bench.methods import OURS
from replication.bench.run import Point, met, ranked, title
from replication.text import aligned, json_text, number, rows_csv
from spreadsheets.safely import check_folder, write_folder


def texts(record: dict[str, Any]) -> dict[str, str]:
    """The files of a run that are text, by name."""
    cases = record["cases"]
    rows = [{"case": case["name"], **point} for case in cases for point in case["points"]]
    text = "\n".join(_lines(record)) + "\n"
    return {"bench.txt": text, "bench.json": json_text(record), "bench.csv": rows_csv(rows)}


def _lines(record: dict[str, Any]) -> Iterator[str]:
    """The whole run: machine, every case's table, and what to use for N digits."""
    repeats = "1 repeat" if record["repeat"] == 1 else f"{record['repeat']} repeats"
    yield ", ".join(f"{name} {value}" for name, value in record["machine"].items())
    yield (
        "The sheet is measured down to its stop velocity: its final depth against the exact "
        "one there, its history until the exact time of it. All others are measured to rest, "
        "and all but solve_ivp and this project's are told when it comes. "
        "A history's worst error is relative to the depth at rest."
    )
    yield (
        f"Times are a case's, in us: best and median of {repeats} that take turns, or of those "
        f"that {record['limit']:g} s allow; to compile in s. "
        "* marks the Pareto front of one case at a time."
    )
    for case in record["cases"]:
        yield from ("", f"{case['name']}: {case['depth'] * 1e6:.7g} um")
        yield from _table(case["points"])
    yield from ("", "What should I use for N digits?")
    yield from (f"  {line}" for line in _answers(record["cases"]))


def _table(points: Sequence[Point]) -> Iterator[str]:
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
    yield from aligned(rows)
    for point in points:
        if point["gap"]:
            yield f"- {title(point)}, {MEASURES[point['measure']]}: {point['gap']}"


def _cells(point: Point | None) -> tuple[str, ...]:
    if point is None or point["gap"]:
        return ("-" if point else "", "", "", "")
    seconds = (point["best"], point["median"])
    times = (f"{1e6 * s:.0f}" if s >= 1e-3 else number(1e6 * s, 4) for s in seconds)
    return (f"{point['error']:.1e}", *times, "*" if point["front"] else "")


def _answers(cases: Sequence[dict[str, Any]]) -> Iterator[str]:
    """For one case at a time, then for many: what is the fastest for how many digits."""

    def advice(row: Sequence[dict[str, Any]]) -> tuple[str, str]:
        """What is asked; the method that is the fastest in all cases, or each with its cases."""
        asked = MEASURES[row[0]["measure"]] + (" of many cases" if row[0]["many"] else "")
        where: dict[str, list[str]] = {}
        for case, ratio in zip(cases, row, strict=True):
            best = ratio["fastest"]
            method = best.rpartition(", ")[0] if best else "none of these"
            where.setdefault(method, []).append(case["name"])
        if len(where) == 1:
            return asked, next(iter(where))
        named = (f"{method} ({', '.join(names)})" for method, names in where.items())
        return asked, ", ".join(named)

    questions = zip(*(case["ratios"] for case in cases), strict=True)
    for (asked, answer), group in groupby(questions, advice):
        ratios = [ratio for row in group for ratio in row]
        first, last = ratios[0]["digits"], ratios[-1]["digits"]
        digits = f"{first} to {last}" if first < last else f"{last}"
        yield f"{asked}, {digits} digit{'s' if last > 1 else ''}: {answer}{_lead(ratios)}"


def _lead(ratios: Sequence[dict[str, Any]]) -> str:
    """How long the best takes, and how many times as long the others' best where it is ours."""
    pairs = [(ratio["ours"] or math.inf, ratio["peer"] or math.inf) for ratio in ratios]
    best = [1e6 * min(pair) for pair in pairs if min(pair) < math.inf]
    text = f", {_span(best)} us" if best else ""
    leads = [peer / ours for ours, peer in pairs if ours < peer < math.inf]
    text += f"; the others' best takes {_span(leads)} times as long" if leads else ""
    beyond = any(ours < peer == math.inf for ours, peer in pairs)
    return text + ("; some cases are beyond the others" if beyond else "")


def _span(values: Sequence[float]) -> str:
    least, most = number(min(values), 3), number(max(values), 3)
    return least if least == most else f"{least} to {most}"


_STYLE: Any = {
    "font.family": "DejaVu Sans",  # comes with matplotlib: the same letters on every machine
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#E5E5E5",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.0,
    "lines.markersize": 4,
    "savefig.dpi": 150,
    "svg.hashsalt": "coldspray",  # or the ids in the file would differ from run to run
    "svg.fonttype": "none",
}


def figure(case: dict[str, Any], kind: str) -> bytes:
    """The figure of one case as "svg" or "png": error against time a case, on a white ground."""
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
                panel.plot(*line, marker="s" if method in OURS else "o", label=method)
            front = [point for point in ranked(points, measure, many=False) if point["front"]]
            edge: Any = {"label": "Pareto front, one case at a time", "color": "#D55E00"}
            panel.step(*_line(front), "-", where="post", linewidth=6, alpha=0.2, **edge)
        labels = panel.get_legend_handles_labels()
        drawn.legend(*labels, loc="outside lower center", ncols=5, frameon=False)
        # A date would make the same numbers another file; only SVG would have one.
        drawn.savefig(content, format=kind, metadata={"Date": None} if kind == "svg" else None)
    return content.getvalue()


def _line(points: Iterable[Point]) -> Any:
    """Times and errors; a gap, which has no time, breaks the line."""
    return np.array([(p["best"], met(p)) for p in points], float).reshape(-1, 2).T


KINDS = ("svg", "png")


def write(folder: Path, record: dict[str, Any]) -> None:
    """Write text, JSON, CSV and a figure a case into a folder, made if needed.

    All or none. Raises OSError.
    """
    files = {name: text.encode() for name, text in texts(record).items()}
    for case in record["cases"]:
        for kind in KINDS:
            files[f"bench-{case['name']}.{kind}"] = figure(case, kind)
    write_folder(folder, files)


def check(folder: Path, cases: Iterable[str]) -> None:
    """Raise OSError where the files of a run on these cases cannot be written."""
    figures = [f"bench-{case}.{kind}" for case in cases for kind in KINDS]
    check_folder(folder, ["bench.txt", "bench.json", "bench.csv", *figures])

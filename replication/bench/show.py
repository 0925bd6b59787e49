"""The results of a run as text, JSON and CSV, and a figure for each case."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from operator import itemgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from replication.bench.measure import MEASURES, Point, met, ranked
from replication.bench.peers import SOLVERS
from replication.plots import INK, SHADE, content, styled
from replication.text import aligned, columns, json_text, number, prose, rows_csv
from spreadsheets.safely import write_folder

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEAD = """\
The sheet is measured down to its stop velocity: its final depth against the exact one there, its \
history until the exact time of it. All others are measured to rest, and all but solve_ivp and \
this project's are told when it comes. A history's worst error is relative to the depth at rest.
Times are for one case, in us: best and median of {repeats}, taken in turn, or of as many as \
{limit:g} s allow; compile times are in s. * marks the Pareto front of one case at a time."""


def texts(record: dict[str, Any], width: int = 10_000) -> dict[str, str]:
    """Return the text files of a run, by file name.

    Where a table is wider than `width`, final depth and history have one each. Prose is wrapped to
    it.
    """
    cases = record["cases"]
    repeats = "1 repeat" if record["repeat"] == 1 else f"{record['repeat']} repeats"
    machine = ", ".join(f"{name} {value}" for name, value in record["machine"].items())
    head = _HEAD.format(repeats=repeats, limit=record["limit"])
    lines = [prose(line, width) for line in [machine, *head.splitlines()]]
    for case in cases:
        lines += [
            "",
            f"{case['name']}: {case['depth'] * 1e6:.7g} um",
            *_point_table(case["points"], width),
        ]
    lines += [
        "",
        "What should I use for N digits?",
        *(prose(answer, width, hanging="    ") for answer in _answers(cases)),
        *_settings(record["settings"], width),
        "",
    ]
    rows = [{"case": case["name"], **point} for case in cases for point in case["points"]]
    csv = rows_csv(rows)
    return {"bench.txt": "\n".join(lines), "bench.json": json_text(record), "bench.csv": csv}


def _point_table(points: Sequence[Point], width: int) -> Iterator[str]:
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
            gap = "- {method}, {setting}, {}: {gap}".format(MEASURES[point["measure"]], **point)
            yield prose(gap, width, hanging="  ")


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


def _settings(settings: Sequence[dict[str, Any]], width: int) -> Iterator[str]:
    """Yield a table for each quantity: of each solver the loosest settings by number of digits."""
    for measure, title in MEASURES.items():
        asked = [answer for answer in settings if answer["measure"] == measure]
        digits = dict.fromkeys(f"{answer['digits']} digits" for answer in asked)
        rows = [
            (method, *map(_setting, group))
            for method, group in groupby(asked, itemgetter("method"))
        ]
        yield ""
        yield f"Which setting of a solver gives N digits of the {title} in every case above?"
        yield columns([("solver", *digits), *rows], width)


def _setting(answer: Mapping[str, Any]) -> str:
    if answer["setting"] is None:
        return "-"
    microseconds = 1e6 * answer["best"]
    shown = f"{microseconds:.0f}" if microseconds >= 1e3 else number(microseconds, 3)
    return f"{answer['setting']}: {shown} us"


def _span(values: Sequence[float]) -> str:
    least, most = number(min(values), 3), number(max(values), 3)
    return least if least == most else f"{least} to {most}"


def accuracy_figure(case: dict[str, Any]) -> bytes:
    """Draw error against time for one case, as SVG on a white background.

    Each line is labelled by its method: this project's in black with filled marks, others in gray
    with hollow ones. Methods that are timed on many cases at once are dashed.
    """
    from matplotlib.figure import Figure

    with styled():
        drawn = Figure(figsize=(12, 6.5), layout="constrained")
        for panel, measure in zip(drawn.subplots(1, 2), MEASURES, strict=True):
            panel.set(xscale="log", yscale="log", title=f"{case['name']}: {MEASURES[measure]}")
            panel.set(xlabel="Time a case [s]", ylabel="Relative error [1]")
            points = [point for point in case["points"] if point["measure"] == measure]
            front = [point for point in ranked(points, measure, many=False) if point["front"]]
            band: Any = {
                "color": SHADE,
                "alpha": 0.3,
                "linewidth": 6,
                "marker": "o",
                "markersize": 10,
            }
            panel.step(*_line(front), "-", where="post", **band, label="Pareto front, single cases")
            ends: dict[str, tuple[float, float]] = {}
            for method in dict.fromkeys(point["method"] for point in points):
                times, errors = _line(point for point in points if point["method"] == method)
                panel.plot(times, errors, **_line_look(method))
                reached = ~np.isnan(times)
                if reached.any():
                    ends[method] = times[reached][-1], errors[reached][-1]
            panel.set_ylim(bottom=2.0**-55)  # four times below half an ulp, the least that is drawn
            _label(panel, ends)
        handles, labels = panel.get_legend_handles_labels()
        drawn.legend(handles, labels, loc="outside lower left")
        return content(drawn)


def _line_look(method: str) -> dict[str, Any]:
    """Return how the line of a method is drawn."""
    is_peer = method in SOLVERS or "Numba" in method or "bare" in method
    look: dict[str, Any] = {"color": "#6e7781" if is_peer else INK}
    look |= {"marker": "o", "markerfacecolor": "none" if is_peer else INK}
    return look | {"linestyle": "--" if method.endswith("many") else "-"}


LABEL_GAP = 0.036
"""The least distance of two labels beside a panel, as a share of its height: a line of text."""


def _label(panel: "Axes", ends: Mapping[str, tuple[float, float]]) -> None:
    """Write the methods beside a panel; a thin line leads from each to the last point of its line.

    A label stands as high as that point, or as near to it as those of other methods leave room.
    """
    by_error = sorted(ends, key=lambda method: (ends[method][1], ends[method][0]))
    to_share = panel.transData + panel.transAxes.inverted()
    heights = [float(to_share.transform(ends[method])[1]) for method in by_error]
    for method, height in zip(by_error, spread(heights, LABEL_GAP), strict=True):
        panel.annotate(
            method, ends[method], xytext=(1.04, height), textcoords="axes fraction", va="center",
            fontsize=8, color=_line_look(method)["color"],
            arrowprops={
                "arrowstyle": "-", "color": SHADE, "linewidth": 0.5, "relpos": (0, 0.5),
                "shrinkB": 3,
            },
        )  # fmt: skip


def spread(heights: Sequence[float], gap: float) -> list[float]:
    """Move rising heights apart, to a gap at least, and down again where they pass 1.

    >>> spread([0.1, 0.1, 0.5, 1.0, 1.0], 0.25)
    [0.0, 0.25, 0.5, 0.75, 1.0]
    """
    moved: list[float] = []
    for height in heights:
        moved.append(max(height, moved[-1] + gap) if moved else height)
    limit = 1.0
    for k in reversed(range(len(moved))):
        moved[k] = min(moved[k], limit)
        limit = moved[k] - gap
    return moved


def _line(points: Iterable[Point]) -> Any:
    """Return times and errors; a gap is NaN and breaks the line."""
    return np.array([(p["best"], met(p)) for p in points], float).reshape(-1, 2).T


def write_bench(folder: Path, record: dict[str, Any]) -> None:
    """Write text, JSON, CSV and all figures into a folder, or none of them. Raises OSError."""
    figures = {f"bench-{case['name']}.svg": accuracy_figure(case) for case in record["cases"]}
    write_folder(folder, {name: text.encode() for name, text in texts(record).items()} | figures)

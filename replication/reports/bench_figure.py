"""Work-precision as a log-log figure: a panel for each measure, with the Pareto front."""

import io
import math
from collections.abc import Sequence
from itertools import groupby, pairwise
from typing import Any

from replication.bench.arrays import ARRAYS, SHEET_ARRAYS
from replication.bench.methods import CLOSED_FORM, SHEETS
from replication.bench.pareto import Point
from replication.bench.peers import MPMATH, SCIPY
from replication.bench.run import Result
from replication.bench.task import MEASURES
from replication.reports.bench_text import TITLES

__all__ = ["image"]

# Okabe and Ito's palette, which color-blind readers tell apart; a marker for each family.
_SHEET_COLORS, _SCIPY_COLORS = ("#7F7F7F", "#000000"), ("#56B4E9", "#0072B2", "#009E73", "#CC79A7")
_STYLES = {
    **{name: (color, "s") for name, color in zip(SHEETS.values(), _SHEET_COLORS, strict=True)},
    **{name: (color, "o") for name, color in zip(SCIPY, _SCIPY_COLORS, strict=True)},
    **{name: ("#B07800", marker) for name, marker in zip(MPMATH, "^v", strict=True)},
    CLOSED_FORM: ("#D55E00", "*"),
    **{
        name: (color, "D") for name, color in zip(SHEET_ARRAYS.values(), _SHEET_COLORS, strict=True)
    },
    ARRAYS: ("#D55E00", "D"),
}

_SETTINGS: Any = {
    "font.family": "DejaVu Sans",  # comes with matplotlib: the same letters on every machine
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "svg.hashsalt": "coldspray",  # or the ids in the file would differ from run to run
    "svg.fonttype": "none",
}


def image(result: Result, kind: str) -> bytes:
    """The figure of one case as "svg" or "png": error against time a case, on a white ground."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    content = io.BytesIO()
    with mpl.rc_context(_SETTINGS):
        figure = Figure(figsize=(11, 5), layout="constrained")
        for panel, measure in zip(figure.subplots(1, 2), MEASURES, strict=True):
            panel.set_title(f"{result.case.name}: {TITLES[measure]}")
            _draw(panel, result.of(measure), result.front(measure))
        # A date would make the same numbers another file; only SVG would have one.
        undated = {"Date": None} if kind == "svg" else None
        figure.savefig(content, format=kind, dpi=150, metadata=undated)
    return content.getvalue()


def _draw(panel: Any, points: Sequence[Point], front: Sequence[Point]) -> None:
    panel.set(xscale="log", yscale="log", xlabel="time a case [s]", ylabel="relative error")
    panel.grid(color="#E5E5E5", linewidth=0.6)
    panel.set_axisbelow(True)
    shown = [point for point in points if not point.gap]
    drawn = {point.method for point in shown}
    for method, ladder in groupby(points, key=lambda point: point.method):
        if method in drawn:
            _draw_line(panel, method, list(ladder))
    panel.set(xlim=_wide(panel.get_xlim(), 10, 60), ylim=_wide(panel.get_ylim(), 300, 100))
    _label(panel, shown)
    _draw_front(panel, front)
    _note(panel, [point for point in points if point.method not in drawn])


def _draw_line(panel: Any, method: str, ladder: Sequence[Point]) -> None:
    """A method's points, joined; a gap breaks the line."""
    color, marker = _STYLES[method]
    times = [math.nan if point.gap else point.seconds for point in ladder]
    errors = [math.nan if point.gap else point.met for point in ladder]
    panel.plot(times, errors, color=color, marker=marker, markersize=5, linewidth=1.2)


def _note(panel: Any, gaps: Sequence[Point]) -> None:
    """Which methods have no point at all, and why."""
    lines = [f"not drawn: {gap.method}, {gap.setting} ({gap.gap})" for gap in gaps]
    panel.text(0.01, 0.01, "\n".join(lines), transform=panel.transAxes, fontsize=7, va="bottom")


def _wide(limits: tuple[float, float], below: float, above: float) -> tuple[float, float]:
    """Limits of an axis with room for labels and notes, as factors."""
    return limits[0] / below, limits[1] * above


def _label(panel: Any, points: Sequence[Point]) -> None:
    """Every method's name beside one of its points, where it covers no line and no other name."""
    from matplotlib.textpath import TextPath

    to_panel = panel.transScale + panel.transLimits
    ladders = {
        method: [tuple(to_panel.transform((point.seconds, point.met))) for point in group]
        for method, group in groupby(points, key=lambda point: point.method)
    }
    taken = [box for ladder in ladders.values() for box in _along(ladder)]
    for method, ladder in ladders.items():
        width = TextPath((0, 0), method, size=_SETTINGS["font.size"]).get_extents().width / _WIDTH
        box = _free(ladder[::-1], width, taken)
        taken.append(box)
        style = {"color": _STYLES[method][0], "ha": "center", "va": "center"}
        panel.text(*box[:2], method, transform=panel.transAxes, **style)


_WIDTH = 320.0
"""Of a panel, in points; a little less, so that names come out a little wide."""

_MARKER, _HEIGHT = 0.018, 0.042
"""Of a marker and of a name: in widths and heights of the panel."""

_Box = tuple[float, float, float, float]
"""Center, width and height."""


def _along(ladder: Sequence[tuple[float, float]]) -> list[_Box]:
    """Boxes that cover the line through these places."""
    steps = [k / 8 for k in range(8)]
    between = [
        (x + t * (u - x), y + t * (v - y)) for (x, y), (u, v) in pairwise(ladder) for t in steps
    ]
    return [(x, y, _MARKER, _MARKER) for x, y in (*between, ladder[-1])]


def _free(places: Sequence[tuple[float, float]], width: float, taken: Sequence[_Box]) -> _Box:
    """The first of the boxes beside, below or above these places that covers the least."""
    beside, above = width / 2 + _MARKER, _HEIGHT + _MARKER / 2
    sides = ((beside, 0.0), (-beside, 0.0), (0.0, -above), (0.0, above))
    boxes = [(x + dx, y + dy, width, _HEIGHT) for x, y in places for dx, dy in sides]
    return min(boxes, key=lambda box: sum(_overlap(box, other) for other in (*taken, *_EDGES)))


_EDGES: tuple[_Box, ...] = ((-1.0, 0.5, 2.0, 2.0), (2.0, 0.5, 2.0, 2.0), (0.5, 1.42, 2.0, 1.0))
"""What lies to the left of the panel, to its right, and above, with the legend."""


def _overlap(one: _Box, other: _Box) -> float:
    """The area that two boxes share."""
    width = (one[2] + other[2]) / 2 - abs(one[0] - other[0])
    height = (one[3] + other[3]) / 2 - abs(one[1] - other[1])
    return max(0.0, min(width, one[2], other[2])) * max(0.0, min(height, one[3], other[3]))


def _draw_front(panel: Any, front: Sequence[Point]) -> None:
    """The edge of what any method reaches: nothing measured lies below or left of it."""
    if not front:
        return
    (_, right), (_, top) = panel.get_xlim(), panel.get_ylim()
    times = [front[0].seconds, *(point.seconds for point in front), right]
    errors = [top, *(point.met for point in front), front[-1].met]
    style = {"color": "#D55E00", "linewidth": 6, "alpha": 0.2}
    panel.step(times, errors, where="post", label="Pareto front, one case at a time", **style)
    panel.legend(loc="upper right", frameon=False)

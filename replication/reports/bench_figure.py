"""Work-precision as a log-log figure: a panel for each measure, with the Pareto front."""

import io
import math
from collections.abc import Sequence
from itertools import groupby
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
    panel.set(xlim=_wide(panel.get_xlim(), 3, 20), ylim=_wide(panel.get_ylim(), 30, 1))
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


def _wide(limits: tuple[float, float], left: float, right: float) -> tuple[float, float]:
    """Limits with room for the labels at their left, right and lower end."""
    return limits[0] / left, limits[1] * right


def _label(panel: Any, points: Sequence[Point]) -> None:
    """Every method's name at its last point, where it covers no marker and no other name."""
    to_panel = panel.transScale + panel.transLimits
    at = [tuple(to_panel.transform((point.seconds, point.met))) for point in points]
    taken = [(x, y, _MARKER, _MARKER) for x, y in at]
    ends = {point.method: place for point, place in zip(points, at, strict=True)}
    for method, (x, y) in ends.items():
        size = _LETTER * len(method), _HEIGHT
        box = _free(x, y, size, taken)
        taken.append(box)
        color = _STYLES[method][0]
        panel.text(
            *box[:2], method, transform=panel.transAxes, color=color, va="center", ha="center"
        )


_MARKER, _LETTER, _HEIGHT = 0.015, 0.0165, 0.042
"""Of a marker, of a letter's width, of a line's height: in widths and heights of the panel."""

_Box = tuple[float, float, float, float]
"""Center, width and height."""


def _free(x: float, y: float, size: tuple[float, float], taken: Sequence[_Box]) -> _Box:
    """The box beside, below or above a point that covers the least, nearer ones preferred."""
    width, height = size
    beside, above = (width + 2 * _MARKER) / 2, (height + 2 * _MARKER) / 2
    boxes = [
        (x + sign * right * beside, y + sign_up * up * above, width, height)
        for up in (0.0, 1.0, 2.0, 3.0)
        for right in (1.0, 0.0)
        for sign_up in (-1, 1)
        for sign in (1, -1)
        if up or right
    ]
    return min(boxes, key=lambda box: sum(_overlap(box, other) for other in taken))


def _overlap(one: _Box, other: _Box) -> bool:
    apart_x, apart_y = abs(one[0] - other[0]), abs(one[1] - other[1])
    return apart_x < (one[2] + other[2]) / 2 and apart_y < (one[3] + other[3]) / 2


def _draw_front(panel: Any, front: Sequence[Point]) -> None:
    """The edge of what any method reaches: nothing measured lies below or left of it."""
    if not front:
        return
    (_, right), (_, top) = panel.get_xlim(), panel.get_ylim()
    times = [front[0].seconds, *(point.seconds for point in front), right]
    errors = [top, *(point.met for point in front), front[-1].met]
    panel.step(times, errors, where="post", color="#D55E00", linewidth=6, alpha=0.2)
    panel.annotate(
        "Pareto front, one case at a time",
        (times[0], top),
        xytext=(-4, -4),
        textcoords="offset points",
        rotation=90,
        color="#D55E00",
        ha="right",
        va="top",
    )

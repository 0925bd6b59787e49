"""Work-precision as a log-log figure: a panel for each measure, with the Pareto front."""

import io
import math
from collections.abc import Sequence
from itertools import groupby
from typing import Any

from replication.bench.methods import ARRAYS, CLOSED_FORM, SHEETS
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
    shown = [point for point in points if not point.gap]
    panel.set(xscale="log", yscale="log", xlabel="time a case [s]", ylabel="relative error")
    panel.grid(color="#E5E5E5", linewidth=0.6)
    panel.set_axisbelow(True)
    ends = []
    for method, group in groupby(shown, key=lambda point: point.method):
        ladder = list(group)
        color, marker = _STYLES[method]
        times, errors = [p.seconds for p in ladder], [p.met for p in ladder]
        panel.plot(times, errors, color=color, marker=marker, markersize=5, linewidth=1.2)
        ends.append((method, times[-1], errors[-1]))
    panel.set(xlim=_wide(panel.get_xlim(), 3, 20), ylim=_wide(panel.get_ylim(), 30, 1))
    _label(panel, ends)
    _draw_front(panel, front)


def _wide(limits: tuple[float, float], left: float, right: float) -> tuple[float, float]:
    """Limits with room for the labels, which stand to the right and may be moved down."""
    return limits[0] / left, limits[1] * right


def _label(panel: Any, ends: Sequence[tuple[str, float, float]]) -> None:
    """Every method's name at its last point, moved down where it would cover another."""
    low, high = panel.get_xlim()
    decades = math.log10(high / low)
    placed: list[tuple[float, float]] = []
    for method, time, error in sorted(ends, key=lambda end: (-end[2], end[1])):
        x, y = math.log10(time), math.log10(error)
        while any(abs(x - u) < decades * _WIDTH and abs(y - v) < _HEIGHT for u, v in placed):
            y -= _HEIGHT / 8
        placed.append((x, y))
        panel.text(
            time * 10 ** (0.013 * decades), 10**y, method, color=_STYLES[method][0], va="center"
        )


_WIDTH, _HEIGHT = 0.2, 0.8
"""Of a name: in widths of the panel, and in decades of the error."""


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

"""Work-precision as a log-log figure: a panel for each measure, with the Pareto front."""

import io
from collections.abc import Sequence
from itertools import groupby
from typing import Any

from replication.bench.methods import ARRAYS, CLOSED_FORM, SHEETS
from replication.bench.pareto import Point
from replication.bench.peers import MPMATH, SCIPY
from replication.bench.run import Bench, Result
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

_SETTINGS = {
    "font.family": "DejaVu Sans",  # comes with matplotlib: the same letters on every machine
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "svg.hashsalt": "coldspray",  # or the ids in the file would differ from run to run
    "svg.fonttype": "none",
}


def image(result: Result, machine: Bench, kind: str) -> bytes:
    """The figure of one case as "svg" or "png": error against time a case, on a white ground."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    content = io.BytesIO()
    with mpl.rc_context(_SETTINGS):
        figure = Figure(figsize=(11, 5), layout="constrained")
        axes = figure.subplots(1, 2, sharey=True)
        for panel, measure in zip(axes, MEASURES, strict=True):
            _draw(panel, result.of(measure), result.front(measure))
            panel.set_title(TITLES[measure])
        axes[0].set_ylabel("relative error")
        figure.savefig(content, format=kind, dpi=150, metadata={"Date": None} if kind == "svg" else None)
    return content.getvalue()


def _draw(panel: Any, points: Sequence[Point], front: Sequence[Point]) -> None:
    panel.set(xscale="log", yscale="log", xlabel="time a case [s]")
    panel.grid(color="#E5E5E5", linewidth=0.6)
    panel.set_axisbelow(True)
    for method, group in groupby((p for p in points if not p.gap), key=lambda p: p.method):
        ladder = list(group)
        color, marker = _STYLES[method]
        panel.plot([p.seconds for p in ladder], [p.met for p in ladder], color=color, marker=marker, markersize=9 if marker=="*" else 4, linewidth=1.2)
        last = ladder[-1]
        panel.annotate(method, (last.seconds, last.met), xytext=(6, 0), textcoords="offset points", color=color, va="center")
    panel.step([p.seconds for p in front], [p.met for p in front], where="post", color="#D55E00", linewidth=6, alpha=0.2)

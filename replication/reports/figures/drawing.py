"""What the figures share: their looks, and how one becomes SVG and PNG, the same bytes each time.

Ink is black: `svg.tidy` turns it into the color of the text around. The three colors are Okabe and
Ito's that stand out from white and from near-black, and from each other for the color-blind.
"""

import io
import math
from dataclasses import dataclass
from types import ModuleType
from typing import Any

from replication.reports.figures.svg import tidy

__all__ = ["BLUE", "GREEN", "INK", "VERMILION", "Drawing", "drawing", "power_of_ten"]

INK, BLUE, VERMILION, GREEN = "#000000", "#0072B2", "#D55E00", "#009E73"

_LOOKS: Any = {
    "svg.hashsalt": "coldspray",
    "svg.fonttype": "none",
    "font.family": "DejaVu Sans",
    "font.size": 10.0,
    "axes.titlesize": 10.0,
    "axes.facecolor": "none",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.use_mathtext": False,
    "axes.unicode_minus": True,
    "grid.color": INK,
    "grid.alpha": 0.15,
    "legend.frameon": False,
    "lines.linewidth": 1.8,
    "savefig.facecolor": "none",
    "figure.constrained_layout.use": True,
}


@dataclass(frozen=True, slots=True)
class Drawing:
    """A figure drawn: its name (as of the files), title, description, and both formats."""

    name: str
    title: str
    description: str
    svg: str
    png: bytes


def drawing(module: ModuleType, record: dict[str, Any]) -> Drawing:
    """Draw one figure once and save it in both formats."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    description = module.describe(record)
    with mpl.rc_context(_LOOKS):
        figure = Figure(figsize=module.SIZE)
        module.plot(figure, record)
        svg, png = io.StringIO(), io.BytesIO()
        figure.savefig(svg, format="svg", metadata={"Date": None, "Creator": None})
        figure.set_layout_engine("none")  # as laid out: no need to do it again
        figure.savefig(png, format="png", dpi=150, facecolor="white", metadata={"Software": None})
    tidied = tidy(svg.getvalue(), module.NAME, module.TITLE, description)
    return Drawing(module.NAME, module.TITLE, description, tidied, png.getvalue())


def power_of_ten(number: float, _: float = 0) -> str:
    """A tick of a logarithmic axis.

    >>> power_of_ten(1e-3), power_of_ten(1.0)
    ('10⁻³', '10⁰')
    """
    return "10" + str(round(math.log10(number))).translate(_RAISED)


_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

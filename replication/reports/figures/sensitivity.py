"""Tornado: what each input does to the exact normalized depth and the exact depth, beta = 5."""

from typing import TYPE_CHECKING, Any

from replication.reports.comparison import shown_range
from replication.reports.figures.drawing import BLUE, INK, VERMILION

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAME = "sensitivity"
TITLE = "What each input does to the exact penetration depth, beta = 5"
SIZE = (5.0, 6.4)

_CASE = "beta-5"
_PANELS = (("ten_percent", "each input ± 10 %"), ("stated", "its own stated range"))


def describe(record: dict[str, Any]) -> str:
    """Every bar's ends, the longest first."""
    return " ".join(
        f"{words.capitalize()}: "
        + "; ".join(
            f"{_name(effect)} {_um(effect, 0)} to {_um(effect, 1)} µm"
            for effect in _ordered(record, which)
        )
        + "."
        for which, words in _PANELS
    )


def plot(figure: "Figure", record: dict[str, Any]) -> None:
    """Two panels of bars about the nominal depth, the longest on top."""
    from matplotlib.patches import Patch

    nominal = float(record["sensitivity"][_CASE]["depth"]) * 1e6
    for axes, (which, words) in zip(figure.subplots(2, 1, sharex=True), _PANELS, strict=True):
        effects = _ordered(record, which)
        for y, effect in enumerate(effects):
            changes = [depth * 1e6 - nominal for depth in effect["depths"]]
            axes.barh([y, y], changes, left=nominal, color=[VERMILION, BLUE], height=0.7)
            axes.annotate(_changes(changes), (1.02, y), xycoords=_AT_RIGHT, va="center")
        axes.axvline(nominal, color=INK, linewidth=1.0)
        axes.set_yticks(range(len(effects)), [_label(effect, which) for effect in effects])
        axes.set(title=words, ylim=(len(effects) - 0.5, -0.5))
        axes.grid(visible=False, axis="y")
    axes.set(xlabel="Depth X [µm]")
    figure.legend(
        handles=[
            Patch(color=VERMILION, label="input at its low end"),
            Patch(color=BLUE, label="at its high end"),
        ],
        loc="outside lower center",
        ncols=2,
    )


_AT_RIGHT = ("axes fraction", "data")


def _changes(changes: list[float]) -> str:
    """What the low and the high end change the depth by [µm]."""
    return "\n".join(
        f"{change:+.3f}".replace("-", "\N{MINUS SIGN}") for change in changes if change
    )


def _label(effect: dict[str, Any], which: str) -> str:
    return f"{_name(effect)}\n{shown_range(effect)}" if which == "stated" else _name(effect)


def _ordered(record: dict[str, Any], which: str) -> list[dict[str, Any]]:
    effects = record["sensitivity"][_CASE][which]
    return sorted(effects, key=lambda e: -abs(e["depths"][1] - e["depths"][0]))


def _name(effect: dict[str, Any]) -> str:
    return str(effect["input"]).replace("_", " ").replace("beta", "β")


def _um(effect: dict[str, Any], end: int) -> str:
    return f"{effect['depths'][end] * 1e6:.2f}"

"""Figure 5 of the report: normalized depth against impact velocity, by the sheet and exact."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.ledger import load
from replication.audit.entries import value
from replication.cases import BETA_5
from replication.models.depth import normalized_depth
from replication.models.sheet import run
from replication.reports.figures.drawing import BLUE, INK

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAME = "figure-5"
TITLE = "Normalized depth against impact velocity, as in Figure 5 of the report"
SIZE = (5.0, 3.6)


def describe(record: dict[str, Any]) -> str:
    """The curve's ends and the observed level."""
    low, high = _ends()
    return (
        f"For beta = 5, X/R rises almost in proportion to the velocity, from {_ratio(low):.3f} at "
        f"{low:g} m/s to {_ratio(high):.3f} at {high:g} m/s; the sheet's points lie on the exact "
        f"line. All of it is above the observed {_observed(record):.3f}."
    )


def plot(figure: "Figure", record: dict[str, Any]) -> None:
    """The exact line, the sheet every 10 m/s, and the observed level."""
    low, high = _ends()
    axes = figure.subplots()
    line = np.linspace(low, high, 101)
    axes.plot(line, [_ratio(v) for v in line.tolist()], color=INK, linewidth=1.0, label="exact")
    points = np.linspace(low, high, 11)
    sheet = [run(replace(BETA_5, velocity=float(v))).normalized_depth for v in points]
    axes.plot(points, sheet, "s", color=BLUE, ms=5, label="the sheet, β = 5")
    axes.axhline(_observed(record), color=INK, linewidth=1.0, linestyle="--", label="observed")
    axes.set(xlabel="Impact velocity [m/s]", ylabel="Normalized depth X/R", ylim=(0, 0.8))
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.05))


def _ends() -> tuple[float, float]:
    ledger = load()
    low, high = (f"figure-5-velocity-{end}" for end in ("least", "greatest"))
    return float(value(ledger, low)), float(value(ledger, high))


def _ratio(velocity: float) -> float:
    others = BETA_5.particle_density, BETA_5.target_density, BETA_5.target_resistance
    return normalized_depth(velocity, *others)


def _observed(record: dict[str, Any]) -> float:
    found = {one["claim"]: one["computed"] for one in record["approaches"]}
    return float(found["observed-depth-ratio"])

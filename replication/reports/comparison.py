"""Approaches, sensitivity and scatter as records; lengths in m, all in SI."""

from dataclasses import asdict
from typing import Any

from reference.ledger import Ledger
from replication.analysis.approaches import Approach
from replication.analysis.scatter import (
    SHARES,
    Scatter,
    Spread,
    mean_mass_ratio,
    scatter,
    stated_deviations,
    tied_particles,
)
from replication.analysis.sensitivity import elasticities, stated_effects, ten_percent_effects
from replication.cases import BETA_5, CASES
from replication.models.depth import final_depth
from replication.text import number

__all__ = ["approach_record", "scatter_record", "sensitivity_record", "shown_range"]

_SHOWN = {
    "velocity": (1.0, "m/s"),
    "radius": (1e6, "µm"),
    "particle_density": (1.0, "kg/m³"),
    "target_density": (1.0, "kg/m³"),
    "beta": (1.0, ""),
    "flow_stress": (1e-6, "MPa"),
}


def shown_range(effect: dict[str, Any]) -> str:
    """The range of an effect's input as a reader wants it.

    >>> shown_range({"input": "radius", "low": 8.2e-6, "high": 1.38e-5})
    '8.2 to 13.8 µm'
    """
    scale, unit = _SHOWN[effect["input"]]
    low, high = (number(effect[end] * scale, 4) for end in ("low", "high"))
    return f"{low} to {high} {unit}".strip()


def approach_record(approach: Approach) -> dict[str, Any]:
    """One row of the table of normalized depths."""
    return {**asdict(approach), "recomputable": approach.recomputable}


def sensitivity_record(ledger: Ledger) -> dict[str, Any]:
    """By case: logarithmic derivatives, and what ranges of the inputs do to the exact depth."""
    return {
        name: {
            "depth": float(final_depth(**case.motion)),
            "elasticities": elasticities(case),
            "ten_percent": [asdict(effect) for effect in ten_percent_effects(case)],
            "stated": [asdict(effect) for effect in stated_effects(case, ledger)],
        }
        for name, case in CASES.items()
    }


def scatter_record(ledger: Ledger, observed: float) -> dict[str, Any]:
    """What the scatter of size and velocity does, by case; `observed` is the X/R of Eq. 4."""
    deviations = stated_deviations(ledger)
    return {
        "standard_deviations": deviations,
        "shares": list(SHARES),
        "mean_mass_ratio": mean_mass_ratio(BETA_5.diameter, deviations["diameter"]),
        "particles": [asdict(particle) for particle in tied_particles(BETA_5, ledger)],
        "streams": {
            name: [_stream(one) for one in scatter(case, deviations, observed)]
            for name, case in CASES.items()
        },
    }


def _stream(one: Scatter) -> dict[str, Any]:
    spreads = {part: _spread(getattr(one, part)) for part in ("depth", "ratio", "velocity")}
    return {**asdict(one), **spreads}


def _spread(spread: Spread) -> dict[str, Any]:
    return {**asdict(spread), "deviation": spread.deviation}

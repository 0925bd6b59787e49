"""How the exact final depth depends on each input: logarithmic derivatives, ranges of inputs."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from reference.ledger import Ledger
from replication.audit.entries import value
from replication.audit.inference import infer, possible
from replication.models.depth import final_depth
from replication.models.impact import Impact

__all__ = ["INPUTS", "Effect", "elasticities", "stated_effects", "ten_percent_effects"]

INPUTS = ("velocity", "radius", "particle_density", "target_density", "beta", "flow_stress")
"""What the depth at rest depends on; beta and flow stress only by their product R_t (Eq. 7)."""


@dataclass(frozen=True, slots=True)
class Effect:
    """The exact normalized depth X/R and depth X [m] at both ends of an input's range (SI).

    `why` says what kind of range it is, `sources` the claims that it comes from.
    """

    input: str
    low: float
    high: float
    ratios: tuple[float, float]
    depths: tuple[float, float]
    why: str
    sources: tuple[str, ...] = ()


def elasticities(impact: Impact) -> dict[str, float]:
    """d ln X / d ln input for each of `INPUTS`, from the closed form.

    So many percent of depth for one percent of the input. X/R has the same, but 0 for the radius.
    With c = (4 rho_p / 3 rho_t) ln(1 + p), p = rho_t V^2 / 2 R_t, and y^2 - y^3/3 = c (beyond R
    dy = dc): d ln y = s d ln c, where s = c / (y^2 (2 - y)), c/y beyond R; and
    d ln ln(1 + p) = q d ln p, where q = p / ((1 + p) ln(1 + p)).

    >>> from replication.cases import BETA_5
    >>> {name: round(x, 3) for name, x in elasticities(BETA_5).items()}["velocity"]
    1.044
    """
    density_ratio = impact.particle_density / impact.target_density
    p = impact.target_density * impact.velocity**2 / (2 * impact.target_resistance)
    c = 4 / 3 * density_ratio * math.log1p(p)
    y = _depth(impact) / impact.radius
    s = c / (y * y * (2 - y)) if y < 1 else c / y
    q = p / ((1 + p) * math.log1p(p))
    factors = (2 * q * s, 1.0, s, (q - 1) * s, -q * s, -q * s)
    return dict(zip(INPUTS, factors, strict=True))


def ten_percent_effects(impact: Impact) -> list[Effect]:
    """What 10 % less and more of each input does: the inputs compared on equal terms."""
    return [
        _effect(impact, name, 0.9 * number, 1.1 * number, "10 % less and more")
        for name in INPUTS
        for number in [getattr(impact, name)]
    ]


def stated_effects(impact: Impact, ledger: Ledger) -> list[Effect]:
    """What each input's own uncertainty does, as far as the report or its evidence states one.

    Velocity and size: the stated deviation within the stream, so not of their mean; beta: the range
    that the report derives; flow stress: its two hardness values; particle density: its rounding;
    target density: all that Table A-1 makes possible.
    """
    velocity, size = (
        float(value(ledger, name)) for name in ("velocity-deviation", "diameter-deviation")
    )
    (light, dense), (least, greatest) = (
        map(float, possible(ledger, name)) for name in ("a1-density", "inferred:target-density")
    )
    ranges: Mapping[str, tuple[tuple[float, float], str, tuple[str, ...]]] = {
        "velocity": (
            (impact.velocity - velocity, impact.velocity + velocity),
            "mean deviation in the stream",
            ("velocity-deviation",),
        ),
        "radius": (
            (impact.radius - size / 2, impact.radius + size / 2),
            "standard deviation of the powder",
            ("diameter-deviation",),
        ),
        "beta": _between(ledger, "beta-range-least", "beta-range-greatest", "the report's range"),
        "flow_stress": _between(ledger, "strength-clear", "strength-feathery", "two hardnesses"),
        "particle_density": (
            (light, dense),
            "rounding of the print",
            ("a1-density",),
        ),
        "target_density": (
            (least, greatest),
            "all that Table A-1 allows",
            infer(ledger, "target-density").entry.evidence,
        ),
    }
    return [_effect(impact, name, *ends, why, of) for name, (ends, why, of) in ranges.items()]


def _between(
    ledger: Ledger, least: str, greatest: str, why: str
) -> tuple[tuple[float, float], str, tuple[str, ...]]:
    ends = float(value(ledger, least)), float(value(ledger, greatest))
    return ends, why, (least, greatest)


def _effect(
    impact: Impact, name: str, low: float, high: float, why: str, of: tuple[str, ...] = ()
) -> Effect:
    below, above = (replace(impact, **{name: end}) for end in (low, high))
    depths = _depth(below), _depth(above)
    ratios = depths[0] / below.radius, depths[1] / above.radius
    return Effect(name, low, high, ratios, depths, why, of)


def _depth(impact: Impact) -> float:
    return float(final_depth(**impact.motion))

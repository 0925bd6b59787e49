"""What the scatter of particle size and velocity does to the depth.

Two ways: velocity tied to size by Eq. 1, and both independent and normal, with the exact final
depth for each particle. A "mean deviation" is taken as what it says, the mean absolute deviation:
of a normal distribution it is sqrt(2 / pi) standard deviations.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from statistics import NormalDist
from typing import Any

import numpy as np

from reference.ledger import Ledger
from replication.analysis.sensitivity import elasticities
from replication.audit.entries import value
from replication.models import stream
from replication.models.depth import normalized_depth
from replication.models.impact import Impact

__all__ = [
    "SHARES",
    "Particle",
    "Scatter",
    "Spread",
    "mean_mass_ratio",
    "scatter",
    "stated_deviations",
    "tied_particles",
]

SHARES = (0.05, NormalDist().cdf(-1.0), 0.5, NormalDist().cdf(1.0), 0.95)
"""Of the particles that are below a quantile: median, one standard deviation, nine tenths."""


@dataclass(frozen=True, slots=True)
class Particle:
    """A particle whose velocity follows from its size by Eq. 1; diameter [m], velocity [m/s]."""

    diameter: float
    average_velocity: float
    velocity: float
    ratio: float


@dataclass(frozen=True, slots=True)
class Spread:
    """A quantity over the particles of a stream: its quantiles for `SHARES`.

    Quantiles, as by Eq. 1 the velocity of ever smaller particles has no finite mean. `first_order`
    is the standard deviation by linear propagation, relative to the value at the means.
    """

    quantiles: tuple[float, ...]
    first_order: float

    @property
    def deviation(self) -> float:
        """Half of what the middle 68 % of the particles span: one deviation, were it normal."""
        return (self.quantiles[3] - self.quantiles[1]) / 2


@dataclass(frozen=True, slots=True)
class Scatter:
    """The spread of X [m], X/R [1] and V [m/s] over the stream.

    `velocity_for_observed` [m/s] is the impact velocity at which the exact X/R is the observed one;
    `share_below_observed` the share of particles of that X/R or less.
    """

    way: str
    depth: Spread
    ratio: Spread
    velocity: Spread
    velocity_for_observed: float
    share_below_observed: float


def stated_deviations(ledger: Ledger) -> dict[str, float]:
    """Standard deviations, SI: of the diameter as stated; of V from its mean deviation.

    >>> from reference.ledger import load
    >>> f"{stated_deviations(load())['velocity']:.1f}"
    '62.7'
    """
    return {
        "diameter": float(value(ledger, "diameter-deviation")),
        "velocity": float(value(ledger, "velocity-deviation")) * math.sqrt(math.pi / 2),
    }


def tied_particles(impact: Impact, ledger: Ledger) -> list[Particle]:
    """The least and the greatest particle of Figure 1 at 500 and 521 m/s, by Eq. 1.

    The average mass is taken as that of the particle of average size, which the report sends at
    the average velocity.
    """
    found = []
    for average in ("a1-initial-velocity", "velocity-521"):
        for size in ("particle-size-least", "particle-size-greatest"):
            diameter, mean = float(value(ledger, size)), float(value(ledger, average))
            velocity = stream.particle_velocity(mean, diameter**3, impact.diameter**3)
            (ratio,) = _ratios(impact, np.array([velocity])).tolist()
            found.append(Particle(diameter, mean, velocity, ratio))
    return found


def mean_mass_ratio(diameter: float, deviation: float) -> float:
    """The mean mass of normally distributed sizes over the mass of the mean size, E[D^3] / D^3.

    >>> f"{mean_mass_ratio(22e-6, 5.6e-6):.3f}"
    '1.194'
    """
    return 1 + 3 * (deviation / diameter) ** 2


def scatter(
    impact: Impact, deviations: Mapping[str, float], observed: float
) -> tuple[Scatter, Scatter]:
    """The stream of a case's velocity and size, tied by Eq. 1, and independent.

    `deviations` are standard deviations of "diameter" [m] and "velocity" [m/s], `observed` an X/R
    [1] below 1. Sizes and velocities of zero and less, which a normal distribution has, are left
    out: 4 in 100,000 of the report's sizes.

    >>> from replication.cases import BETA_5
    >>> tied, independent = scatter(BETA_5, {"diameter": 5.6e-6, "velocity": 50.0}, 0.298)
    >>> f"{tied.velocity.deviation:.0f}, {independent.velocity.deviation:.0f}"
    '210, 50'
    """
    needed = _velocity_for(impact, observed)
    return _tied(impact, deviations["diameter"], needed), _independent(impact, deviations, needed)


def _normal(mean: float, deviation: float, spacing: float = 0.02) -> tuple[Any, Any]:
    """Values above zero of a normal quantity, and weights in proportion to its density there."""
    z = np.arange(-8.0, 8.0 + spacing / 2, spacing)
    values = mean + deviation * z
    return values[values > 0], np.exp(-z * z / 2)[values > 0]


def _tied(impact: Impact, deviation: float, needed: float) -> Scatter:
    diameter, weights = _normal(impact.diameter, deviation)
    by_mass = partial(stream.particle_velocity, impact.velocity, average_mass=impact.diameter**3)
    velocity = np.array([by_mass(mass) for mass in (diameter**3).tolist()])
    ratio = _ratios(impact, velocity)
    of_size = deviation / impact.diameter
    steep = 1.5 * elasticities(impact)["velocity"]
    largest = impact.diameter * (impact.velocity / needed) ** (2 / 3)
    return Scatter(
        "velocity tied to mass by Eq. 1",
        depth=_spread(ratio * diameter / 2, weights, abs(1 - steep) * of_size),
        ratio=_spread(ratio, weights, steep * of_size),
        velocity=_spread(velocity, weights, 1.5 * of_size),
        velocity_for_observed=needed,
        share_below_observed=1 - NormalDist(impact.diameter, deviation).cdf(largest),
    )


def _independent(impact: Impact, deviations: Mapping[str, float], needed: float) -> Scatter:
    # Twice as far apart as for one quantity: of pairs there are many.
    diameter, of_diameter = _normal(impact.diameter, deviations["diameter"], spacing=0.04)
    velocity, of_velocity = _normal(impact.velocity, deviations["velocity"], spacing=0.04)
    ratio = _ratios(impact, velocity)
    by_size = deviations["diameter"] / impact.diameter
    by_velocity = deviations["velocity"] / impact.velocity
    steep = elasticities(impact)["velocity"] * by_velocity
    depth, of_pair = np.outer(diameter / 2, ratio), np.outer(of_diameter, of_velocity)
    return Scatter(
        "size and velocity independent",
        depth=_spread(depth.ravel(), of_pair.ravel(), math.hypot(by_size, steep)),
        ratio=_spread(ratio, of_velocity, steep),
        velocity=_spread(velocity, of_velocity, by_velocity),
        velocity_for_observed=needed,
        share_below_observed=NormalDist(impact.velocity, deviations["velocity"]).cdf(needed),
    )


def _ratios(impact: Impact, velocity: Any) -> Any:
    """The exact X/R at other velocities."""
    others = impact.particle_density, impact.target_density, impact.target_resistance
    return np.array([normalized_depth(v, *others) for v in velocity.tolist()])


def _velocity_for(impact: Impact, ratio: float) -> float:
    """The velocity at which the exact X/R, below 1, is the given one: c solved for V."""
    c = ratio * ratio - ratio**3 / 3
    logarithm = 3 * impact.target_density / (4 * impact.particle_density) * c
    return math.sqrt(2 * impact.target_resistance / impact.target_density * math.expm1(logarithm))


def _spread(values: Any, weights: Any, first_order: float) -> Spread:
    order = np.argsort(values, kind="stable")
    weights = weights[order] / np.sum(weights)
    below = np.cumsum(weights) - weights / 2
    quantiles = np.interp(SHARES, below, values[order])
    return Spread(tuple(float(quantile) for quantile in quantiles), first_order)

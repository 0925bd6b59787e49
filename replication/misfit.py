"""What speaks against a fit: residuals too large for chance, a measurement far off the others."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from replication.fit import Fit, Measurement, depth_slope, fit
from replication.models.depth import final_depth
from replication.models.impact import Impact

IMPROBABLE = 1e-3
"""The chance below which something is said. One sound data set of a thousand is suspected, too: few
enough not to cry wolf, and far above the chance of a misplaced decimal point."""

ROUNDING = 2.0**-48
"""What rounding may make of a depth, relative to it: 16 times the distance of doubles. The
resistance is the exponential of a logarithm of about 22, so it is off by up to 22 of its roundings,
and the depth by half of that."""


@dataclass(frozen=True, slots=True)
class FarOff:
    """A measurement that is far off the others: its number, counted from 0.

    `excess` is its depth less the one that the fit of the others gives [m], `deviations` that over
    its standard deviation, `chance` that of so large a one among all, and `without` the fit of the
    others.
    """

    number: int
    excess: float
    deviations: float
    chance: float
    without: Fit


def chance_of_chi_square(fitted: Fit) -> float | None:
    """Return the probability of a chi square at least as large, if the uncertainties are right.

    None without uncertainties, or without a degree of freedom.

    >>> sound = Fit("resistance", 3.5e9, 5e7, 3.5e9, residuals=11 * (0.0,), chi_square=10.0)
    >>> f"{chance_of_chi_square(sound):.4f}"
    '0.4405'
    """
    from scipy.stats import chi2

    if fitted.chi_square is None or fitted.points < 2:
        return None
    return float(chi2.sf(fitted.chi_square, fitted.points - 1))


def worst(fitted: Fit, measurements: Sequence[Measurement]) -> tuple[int, float]:
    """Return which measurement is off by most of its uncertainties, and by how many."""
    off = [
        abs(residual) / m.uncertainty
        for residual, m in zip(fitted.residuals, measurements, strict=True)
        if m.uncertainty is not None
    ]
    number = max(range(len(off)), key=off.__getitem__)
    return number, off[number]


def far_off(impact: Impact, fitted: Fit, measurements: Sequence[Measurement]) -> FarOff | None:
    """Return the measurement without an uncertainty that is far off the others, or None.

    The criterion is the externally studentized residual (R. D. Cook and S. Weisberg, *Residuals and
    Influence in Regression*, 1982, chapter 2): the depth less that which the fit of the others
    gives, over its standard deviation by their scatter. It is distributed as Student's t with n - 2
    degrees of freedom. As the largest of n is taken, its chance is n times that of a single one
    (Bonferroni). The fit of the others is computed, not linearized: an outlier can pull it far.
    """
    from scipy.stats import t

    count = len(measurements)
    if count < 3 or fitted.chi_square is not None:
        return None
    slopes = [depth_slope(m, fitted.resistance) for m in measurements]
    total = math.fsum(slope**2 for slope in slopes)
    # Of the studentized residuals the largest is the same, internally or externally.
    internal = [
        abs(residual) / math.sqrt(max(1 - slope**2 / total, ROUNDING))
        for residual, slope in zip(fitted.residuals, slopes, strict=True)
    ]
    number = max(range(count), key=internal.__getitem__)
    others = [m for k, m in enumerate(measurements) if k != number]
    without = fit(impact, others, fitted.quantity)
    suspect = measurements[number]
    scatter = math.hypot(*without.residuals) / math.sqrt(count - 2)
    slope = depth_slope(suspect, without.resistance)
    known = math.hypot(*(depth_slope(m, without.resistance) for m in others))
    # Depths that are exact to rounding scatter by that at least.
    deviation = max(scatter, ROUNDING * suspect.depth) * math.hypot(1, slope / known)
    excess = suspect.depth - final_depth(*suspect.impact, without.resistance)
    deviations = abs(excess) / deviation
    chance = min(1.0, 2 * count * float(t.sf(deviations, count - 2)))
    return FarOff(number, excess, deviations, chance, without) if chance < IMPROBABLE else None

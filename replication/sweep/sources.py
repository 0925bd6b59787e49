"""Where the values of an input come from: a list, a range, a distribution, or Eq. 1.

All values of a source lie within its `bounds`, rounding included: what is in range there is in
range everywhere between, and a sweep is refused before it runs, not in the middle.
"""

import math
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any

import numpy as np
import numpy.typing as npt

from replication.sphere import volume
from replication.stream import particle_velocity

__all__ = ["ByMass", "Floats", "Listed", "Random", "Source", "Spaced"]

Floats = npt.NDArray[np.float64]

LEAST_SHARE = 2.0**-53
"""The least of the random numbers in (0, 1); the greatest is 1 less it (`draws.py`)."""


@dataclass(frozen=True, slots=True)
class Listed:
    """Values one by one; a fixed input is a list of one.

    >>> Listed((3.0, 5.0)).at(np.array([1, 0]))
    array([5., 3.])
    """

    values: tuple[float, ...]

    @property
    def count(self) -> int:
        """Number of values."""
        return len(self.values)

    @property
    def bounds(self) -> tuple[float, float]:
        """The least and the greatest value."""
        return min(self.values), max(self.values)

    def at(self, index: npt.NDArray[np.int64]) -> Floats:
        """The values of these positions, each from 0 to count - 1."""
        return np.array(self.values)[index]


@dataclass(frozen=True, slots=True)
class Spaced:
    """`count` values from first to last, both exact, at equal distances or (log) equal ratios.

    >>> Spaced(1e-6, 1e-4, 3, log=True).at(np.arange(3))
    array([1.e-06, 1.e-05, 1.e-04])
    """

    first: float
    last: float
    count: int
    log: bool

    @property
    def bounds(self) -> tuple[float, float]:
        """The least and the greatest value."""
        return min(self.first, self.last), max(self.first, self.last)

    def at(self, index: npt.NDArray[np.int64]) -> Floats:
        """The values of these positions, each from 0 to count - 1."""
        first, last = (
            (math.log10(self.first), math.log10(self.last)) if self.log else (self.first, self.last)
        )
        values = first + index * ((last - first) / (self.count - 1))
        values = np.clip(10.0**values if self.log else values, *self.bounds)
        return np.where(
            index == 0, self.first, np.where(index == self.count - 1, self.last, values)
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Random:
    """A distribution, by the inverse of its cumulative probability.

    Uniform between lower and upper, or normal with mean and deviation: of the quantity itself or
    (log) of its logarithm. A normal one is truncated: what lies outside lower and upper is as if
    drawn again, so that inside the density keeps its shape.

    >>> normal = Random(lower=0.0, upper=math.inf, mean=11e-6, deviation=2.8e-6, log=False)
    >>> [f"{x * 1e6:.2f}" for x in normal.quantile(np.array([0.1587, 0.5, 0.8413]))]
    ['8.20', '11.00', '13.80']
    """

    lower: float
    upper: float
    log: bool
    mean: float | None = None
    deviation: float | None = None

    @property
    def bounds(self) -> tuple[float, float]:
        """The least and the greatest value that can be drawn."""
        least, greatest = self.quantile(np.array([LEAST_SHARE, 1 - LEAST_SHARE]))
        return float(least), float(greatest)

    @property
    def kept(self) -> float:
        """The part of the distribution that lies between lower and upper [1]."""
        low, high = self._shares()
        return high - low

    def quantile(self, share: Floats) -> Floats:
        """The values that this share of the cases falls short of; share in (0, 1)."""
        low, high = self._shares()
        share = low + (high - low) * share
        if self.mean is None:
            values = share
        else:
            # Python's own inverse (Wichura's AS241, 16 digits); rounding must not make it 1.
            inverse = self._normal().inv_cdf
            inside = np.minimum(share, 1 - LEAST_SHARE).tolist()
            values = np.fromiter(map(inverse, inside), np.float64, share.size)
        with np.errstate(over="ignore"):  # to infinity, which no input may be
            return np.clip(np.exp(values) if self.log else values, self.lower, self.upper)

    def _shares(self) -> tuple[float, float]:
        """Where the draws begin and end: in the normal's cumulative probability, or themselves."""
        ends = (_log(self.lower), _log(self.upper)) if self.log else (self.lower, self.upper)
        return (
            ends
            if self.mean is None
            else (self._normal().cdf(ends[0]), self._normal().cdf(ends[1]))
        )

    def _normal(self) -> NormalDist:
        assert self.mean is not None
        assert self.deviation is not None
        if not self.log:
            return NormalDist(self.mean, self.deviation)
        # Mean and deviation are those of the quantity, before truncation; these of its logarithm.
        ratio = self.deviation / self.mean
        variance = math.log1p(ratio * ratio)
        return NormalDist(math.log(self.mean) - variance / 2, math.sqrt(variance))


def _log(value: float) -> float:
    return math.log(value) if value > 0 else -math.inf


@dataclass(frozen=True, slots=True)
class ByMass:
    """Velocity by Eq. 1: that of a particle of the stream follows from its mass.

    average_velocity V [m/s], average_mass m_o [kg].

    >>> f"{ByMass(500.0, 4.96e-11).at(5.5e-6, 8900.0):.0f}"
    '1414'
    """

    average_velocity: float
    average_mass: float

    def at(self, radius: Any, particle_density: Any) -> Any:
        """Velocity [m/s] of particles of radius [m] and particle density [kg/m^3]; broadcast."""
        mass = particle_density * volume(radius)
        return particle_velocity(self.average_velocity, mass, self.average_mass)


Source = Listed | Spaced | Random | ByMass

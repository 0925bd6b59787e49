"""Where the values of an input come from: a list, a range, a distribution, or Eq. 1.

All values of a source lie within its `bounds`, rounding included: what is in range there is in
range everywhere between, and a sweep is refused before it runs, not in the middle.
"""

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]

LEAST_SHARE = 2.0**-53
"""The least of the uniform numbers; the greatest is 1 less it."""

_MARGIN = 1e-14
"""The inverse of the normal distribution has 15 digits, and need not rise in the last."""


def uniform(seed: int, stream: int, first: int, count: int) -> Floats:
    """Uniform numbers in (0, 1) of the cases from `first` on, shape (count,).

    Each is a function of the seed, the stream (one for each input) and the number of its case:
    Philox encrypts that number, four words at a time. 52 bits and a half leave neither 0 nor 1.

    >>> bool((uniform(1, 0, 0, 10)[7:] == uniform(1, 0, 7, 3)).all())
    True
    """
    philox = np.random.Philox(key=np.array([seed, stream], dtype=np.uint64), counter=first // 4)
    words = philox.random_raw(first % 4 + count)[first % 4 :]
    return ((words >> np.uint64(12)).astype(np.float64) + 0.5) * (2 * LEAST_SHARE)


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
        ends = (self.first, self.last)
        first, last = map(math.log10, ends) if self.log else ends
        values = first + index * ((last - first) / (self.count - 1))
        values = np.clip(10.0**values if self.log else values, *self.bounds)
        return np.select([index == 0, index == self.count - 1], ends, values)


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
        wide = (least - _MARGIN * abs(least), greatest + _MARGIN * abs(greatest))
        low, high = np.clip(wide, self.lower, self.upper)
        return float(low), float(high)

    @property
    def kept(self) -> float:
        """The part of the distribution that lies between lower and upper [1]."""
        low, high = self._shares()
        return high - low

    def quantile(self, share: Floats) -> Floats:
        """The values that this share of the cases falls short of; share in (0, 1)."""
        from scipy.special import ndtri

        low, high = self._shares()
        values = low + (high - low) * share
        if self.mean is not None:
            normal = self._normal()
            # Rounding must not make the share 1.
            values = normal.mean + normal.stdev * ndtri(np.minimum(values, 1 - LEAST_SHARE))
        with np.errstate(over="ignore"):  # to infinity, which no input may be
            return np.clip(np.exp(values) if self.log else values, self.lower, self.upper)

    def _shares(self) -> tuple[float, float]:
        """Where the draws begin and end: in the normal's cumulative probability, or themselves."""
        low, high = (_log(self.lower), _log(self.upper)) if self.log else (self.lower, self.upper)
        if self.mean is None:
            return low, high
        return self._normal().cdf(low), self._normal().cdf(high)

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
    """Velocity by Eq. 1, from the mass: average_velocity V [m/s], average_mass m_o [kg]."""

    average_velocity: float
    average_mass: float


Source = Listed | Spaced | Random | ByMass

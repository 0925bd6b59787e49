"""Random numbers that belong to a case: the same in every block, process and machine."""

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
import numpy.typing as npt

__all__ = ["LEAST_SHARE", "Floats", "Random", "uniform"]

Floats = npt.NDArray[np.float64]

LEAST_SHARE = 2.0**-53
"""The least of the uniform numbers; the greatest is 1 less it."""

_MARGIN = 1e-14


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
        # The inverse has 16 digits and need not rise in the last: a share beyond may fall short.
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

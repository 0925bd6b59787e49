"""Where the values of an input come from: a list, a range, a distribution, or Eq. 1.

All values of a source lie within its `bounds`, rounding included: what is in range there is in
range everywhere between, and a sweep is refused before it runs, not in the middle.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from replication.sphere import volume
from replication.stream import particle_velocity
from replication.sweep.draws import Floats, Random

__all__ = ["ByMass", "Listed", "Source", "Spaced"]


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

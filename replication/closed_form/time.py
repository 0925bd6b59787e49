"""Times: the integral of dx/v along the energy integral of Eq. 13."""

from functools import cache
from operator import mul
from typing import Any

import numpy as np

from replication.closed_form.depth import depth_and_left, depth_ratio, work_within
from replication.closed_form.elementwise import elementwise

__all__ = ["Motion", "gauss", "stop_time", "time_to_depth"]


def time_to_depth(
    at_depth: Any,
    velocity: Any,
    radius: Any,
    particle_density: Any,
    target_density: Any,
    resistance: Any,
) -> Any:
    """Time [s] from touch to a depth [m] of at most the final one; all broadcast.

    Close to rest the time left is the root of the depth that is left, whose last digits count.
    Raises ValueError naming the first element that is out of range or deeper than the final depth.

    >>> f"{time_to_depth(5e-6, 500.0, 11e-6, 8900.0, 7850.0, 3.5e9) * 1e9:.6f}"
    '11.192312'
    """
    inputs = locals()
    return elementwise(
        _time_to_depth, inputs, _BLOCK, never="at_depth must not exceed the final depth"
    )


def stop_time(
    velocity: Any,
    radius: Any,
    particle_density: Any,
    target_density: Any,
    resistance: Any,
    stop_velocity: Any = 0.0,
) -> Any:
    """Time [s] from touch until the velocity has fallen to `stop_velocity` [m/s]; all broadcast.

    Raises ValueError naming the first element that is out of range or whose stop velocity exceeds
    its V.

    >>> f"{stop_time(500.0, 11e-6, 8900.0, 7850.0, 3.5e9) * 1e9:.12f}"
    '26.079233782409'
    """
    inputs = locals()
    return elementwise(
        _stop_time, inputs, _BLOCK, never="stop_velocity must not exceed the impact velocity"
    )


_BLOCK = 1024
"""Sixteen Gauss points each make the arrays of `elementwise`'s usual size."""


def _time_to_depth(at: Any, velocity: Any, radius: Any, *materials: Any) -> Any:
    motion = Motion(velocity, radius, *materials)
    left = radius * motion.final - at
    return _time(motion, at / radius, np.where(left >= 0, left, np.nan) / radius)


def _stop_time(
    velocity: Any, radius: Any, rho_p: Any, rho_t: Any, resistance: Any, stop: Any
) -> Any:
    motion = Motion(velocity, radius, rho_p, rho_t, resistance)
    return _time(motion, *depth_and_left(stop, motion.final, velocity, rho_p, rho_t, resistance))


def _time(motion: "Motion", y: Any, left: Any) -> Any:
    """Time [s] to the depth y, where `left` is left."""
    end = np.minimum(motion.fraction(y, left), motion.crossing)
    panels = 1 + np.floor(motion.steepest)
    within: Any = 0.0
    nodes, weights = gauss(16)
    for panel in range(int(np.max(panels, initial=0.0))):
        e = np.multiply.outer(panel + nodes, end / panels)
        slowness = motion.slowness(e, motion.velocity_within(1 - e))
        # One after the other: a matrix product's order would depend on the number of cases.
        total = sum(map(mul, weights, slowness))
        within = within + np.where(panel < panels, total, 0.0)
    return within * end / panels + motion.time_beyond(np.minimum(left, motion.beyond))


@cache
def gauss(points: int) -> Any:
    """Nodes in (0, 1) and weights of Gauss-Legendre quadrature."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    return (nodes + 1) / 2, weights / 2


class Motion:
    """Cases of one block: floats or arrays of shape (n,). Depths are in radii.

    Within the radius the depth is y = Y e (2 - e), Y the final one: with s = 1 - e what is left,
    Y s^2, no longer has the square root singularity of dy/v at rest. Beyond it the area is constant
    and the velocity is rest_velocity tan(angle), the angle falling evenly with time.
    """

    def __init__(
        self,
        velocity: Any,
        radius: Any,
        particle_density: Any,
        target_density: Any,
        resistance: Any,
    ) -> None:
        self.radius = radius
        self.drag = 0.375 * target_density / particle_density
        self.rest_velocity = np.sqrt(2 * resistance / target_density)
        self.final = depth_ratio(velocity, particle_density, target_density, resistance)
        self.beyond = np.maximum(self.final - 1, 0.0)
        self.edge = np.minimum(self.final, 1.0)
        self.crossing = self.fraction(self.edge, self.beyond)
        self.crossing_velocity = self._velocity(self.beyond)

    @property
    def steepest(self) -> Any:
        """The fall of ln(v^2 + 2 R_t / rho_t) within the radius."""
        fall = 2 * self.drag * work_within(self.edge, self.edge)
        # Cases beyond the range of doubles have none; of all others the logarithm is below 710.
        return np.minimum(np.fmax(fall, 0.0), 710.0)

    def _velocity(self, work: Any) -> Any:
        """Velocity [m/s] where so much work is left."""
        return self.rest_velocity * np.sqrt(np.expm1(2 * self.drag * work))

    def fraction(self, y: Any, left: Any) -> Any:
        """e at the depth y, where `left` is left: each counts where it is small."""
        return y / self.final / (1 + np.sqrt(left / self.final))

    def velocity_within(self, s: Any) -> Any:
        """Velocity [m/s] within the radius, where Y s^2 is left."""
        short = self.final * s * s - self.beyond
        return self._velocity(self.beyond + work_within(self.edge, short))

    def slowness(self, e: Any, velocity: Any) -> Any:
        """dt/de [s] within the radius, where the velocity [m/s] is that."""
        return 2 * self.radius * self.final * (1 - e) / velocity

    def time_beyond(self, left: Any) -> Any:
        """Time [s] from the crossing of the radius to where `left` is left; 0 if there is none."""
        rest, crossing, v = self.rest_velocity, self.crossing_velocity, self._velocity(left)
        angle = np.arctan2(rest * (crossing - v), rest * rest + crossing * v)
        return angle * self.radius / (self.drag * rest)

    def deep(self, time: Any) -> tuple[Any, Any]:
        """Depth, and velocity [m/s], at times [s] after the crossing of the radius."""
        rest, crossing = self.rest_velocity, self.crossing_velocity
        angle = self.drag * rest / self.radius * np.maximum(time, 0.0)
        fallen = np.tan(np.minimum(angle, np.pi / 2))
        v = np.maximum((crossing - rest * fallen) / (1 + crossing / rest * fallen), 0.0)
        lost = (crossing - v) * (crossing + v) / (v * v + rest * rest)
        return 1 + np.log1p(lost) / (2 * self.drag), v

"""The report's sheet for arrays of cases at once: what `midpoint.run` reads off its last row.

Every operation is that of `midpoint`, in its order, so that each case gives the same double.
"""

import math
from typing import Any

import numpy as np

from replication import closed_form
from replication.closed_form.elementwise import checked
from replication.midpoint import MAX_STEPS, SCHEMES

__all__ = ["run_many"]

_BLOCK = 4096
"""Cases that walk together; some ten arrays of it fit the cache."""


def run_many(
    velocity: Any,
    radius: Any,
    particle_density: Any,
    target_density: Any,
    resistance: Any,
    step: Any = 2e-10,
    stop_velocity: Any = 1.0,
    scheme: str = "published",
) -> tuple[Any, Any]:
    """Final depth X [m] and number of steps of the sheet, for cases that broadcast; SI units.

    Raises ValueError naming the first element that is out of range or would need more than
    `MAX_STEPS` rows.

    >>> depth, steps = run_many(500.0, 11e-6, 8900.0, 7850.0, [2.1e9, 3.5e9])
    >>> [f"{x * 1e6:.2f}" for x in depth], steps.tolist()
    (['10.03', '7.67'], [178, 131])
    """
    if scheme not in SCHEMES:
        raise ValueError(f"there is no scheme {scheme!r}: choose one of {', '.join(SCHEMES)}")
    inputs = {
        "velocity": velocity,
        "radius": radius,
        "particle_density": particle_density,
        "target_density": target_density,
        "resistance": resistance,
        "step": step,
        "stop_velocity": stop_velocity,
    }
    arrays = np.broadcast_arrays(*checked(inputs).values())
    expected = _expected_steps(*arrays)
    cases = np.array([array.ravel() for array in arrays])
    depth, steps = np.zeros(expected.size), np.zeros(expected.size, dtype=np.int64)
    # Cases that stop at about the same row walk together.
    order = np.argsort(expected, axis=None, kind="stable")
    with np.errstate(all="ignore"):
        for first in range(0, len(order), _BLOCK):
            block = order[first : first + _BLOCK]
            _walk(cases[:, block], block, depth, steps, scheme == "centered")
    return depth.reshape(expected.shape)[()], steps.reshape(expected.shape)[()]


def _expected_steps(*arrays: Any) -> Any:
    velocity, radius, particle, target, resistance, step, stop = arrays
    slowest = np.minimum(stop, velocity)
    motion = velocity, radius, particle, target, resistance
    steps = closed_form.stop_time(*motion, stop_velocity=slowest) / step
    if np.any(~(steps <= MAX_STEPS)):
        index = tuple(int(i) for i in np.argwhere(~(steps <= MAX_STEPS))[0])
        raise ValueError(
            f"the sheet of case {list(index)} would take about {steps[index]:.4g} steps of "
            f"{float(step[index])!r} s down to {float(stop[index])!r} m/s, more than "
            f"{MAX_STEPS:,}: take a larger step"
        )
    return np.asarray(steps)


def _walk(cases: Any, places: Any, depth: Any, steps: Any, centered: bool) -> None:
    """Fill in depth and steps, at `places`, of cases of shape (7, n)."""
    v, dt, v_stop = cases[0], cases[5], cases[6]
    x, taken = np.zeros_like(v), 0
    running = v >= v_stop
    while running.any():
        if 2 * np.count_nonzero(running) < len(v) or not taken:
            places, v, x, cases = places[running], v[running], x[running], cases[:, running]
            dt, v_stop, drag = cases[5], cases[6], _Drag(cases)
            running = np.ones(len(v), dtype=bool)
        taken += 1
        if taken > 1.1 * MAX_STEPS:
            raise ValueError(f"a sheet does not end in {MAX_STEPS:,} steps: take a larger step")
        x = v * (dt / 2) if taken == 1 else x + v * dt
        a = drag(x, v)
        if centered:
            a = drag(x, v - a * (dt / 2))
        v = v - a * dt
        ended = running & (v < v_stop)
        if ended.any():
            depth[places[ended]], steps[places[ended]] = x[ended], taken
            running = running & ~ended


class _Drag:
    """`midpoint.deceleration` for arrays; what does not change from row to row is kept."""

    def __init__(self, cases: Any) -> None:
        _, r, rho_p, self.target_density, self.resistance, *_ = cases
        self.radius, self.diameter, self.square = r, 2 * r, r * r
        self.half_density = 0.5 * self.target_density
        self.mass = rho_p * 4 / 3 * math.pi * r * r * r

    def __call__(self, x: Any, v: Any) -> Any:
        area_over_pi = np.where(x < self.radius, self.diameter * x - x * x, self.square)
        stress = self.half_density * v * v + self.resistance
        return stress * math.pi * area_over_pi / self.mass

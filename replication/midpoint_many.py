"""The report's sheet for arrays of cases at once: what `midpoint.run` reads off its last row.

Every operation is that of `midpoint`, in its order, so that each case gives the same double.
"""

import math
from functools import partial
from typing import Any

import numpy as np

from replication import closed_form
from replication.closed_form.checked import ElementError, checked, first_true
from replication.closed_form.containers import lifted
from replication.midpoint import MAX_STEPS, SCHEMES

__all__ = ["run_many"]

_BLOCK = 4096
"""Cases that walk together; some ten arrays of it fit the cache."""

_AT_ONCE = 100_000
"""Cases among which to look for those that walk together: what bounds the memory."""


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
    inputs = locals()
    del inputs["scheme"]
    if scheme not in SCHEMES:
        raise ValueError(f"there is no scheme {scheme!r}: choose one of {', '.join(SCHEMES)}")
    depth, steps = lifted(partial(_sheets, scheme == "centered"), inputs, (float, int))
    return depth, steps


def _sheets(centered: bool, **inputs: Any) -> tuple[Any, Any]:
    arrays = np.broadcast_arrays(*checked(inputs).values())
    shape, count = arrays[0].shape, arrays[0].size
    depth, steps = np.zeros(count), np.zeros(count, dtype=np.int64)
    for first in range(0, count, _AT_ONCE):
        part = slice(first, first + _AT_ONCE)
        cases = np.array([array.flat[part] for array in arrays])
        try:
            _fill(cases, depth[part], steps[part], centered)
        except ElementError as error:
            place = np.unravel_index(first + error.index[0], shape)
            raise ElementError(error.text, tuple(map(int, place))) from None
    return depth.reshape(shape)[()], steps.reshape(shape)[()]


def _fill(cases: Any, depth: Any, steps: Any, centered: bool) -> None:
    """Fill in depth and steps of cases of shape (7, n)."""
    # Cases that stop at about the same row walk together.
    order = np.argsort(_expected_steps(*cases), kind="stable")
    with np.errstate(all="ignore"):
        for first in range(0, len(order), _BLOCK):
            block = order[first : first + _BLOCK]
            _walk(cases[:, block], block, depth, steps, centered)


def _expected_steps(*cases: Any) -> Any:
    velocity, radius, particle, target, resistance, step, stop = cases
    slowest = np.minimum(stop, velocity)
    motion = velocity, radius, particle, target, resistance
    steps = closed_form.stop_time(*motion, stop_velocity=slowest) / step
    bad = ~(steps <= MAX_STEPS)
    if bad.any():
        (k,) = first_true(bad)
        raise ElementError(
            f"the sheet{{place}} would take about {steps[k]:.4g} steps of "
            f"{float(step[k])!r} s down to {float(stop[k])!r} m/s, more than "
            f"{MAX_STEPS:,}: take a larger step",
            (k,),
        )
    return steps


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

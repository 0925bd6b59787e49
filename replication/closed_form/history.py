"""Depth and velocity against time: the motion tabulated by its time, and read between the lines."""

from collections.abc import Sequence
from math import prod
from typing import Any

import numpy as np

from replication.closed_form.elementwise import checked, lifted, require_finite
from replication.closed_form.time import Motion, gauss

__all__ = ["history"]


def history(
    time: Any,
    velocity: Any,
    radius: Any,
    particle_density: Any,
    target_density: Any,
    resistance: Any,
) -> Any:
    """Depth [m] and velocity [m/s] at times [s] after touch; time broadcasts against the cases.

    Both to 1e-13 of the final depth and of the impact velocity; after rest they are the final depth
    and 0. Raises ValueError naming the first element that is out of range.

    >>> depth, speed = history([0.0, 1e-8, 1.0], 500.0, 11e-6, 8900.0, 7850.0, 3.5e9)
    >>> [f"{x * 1e6:.4f}" for x in depth], [f"{v:.2f}" for v in speed]
    (['0.0000', '4.5634', '7.6749'], ['500.00', '378.56', '0.00'])
    """
    inputs = {
        "time": time,
        "velocity": velocity,
        "radius": radius,
        "particle_density": particle_density,
        "target_density": target_density,
        "resistance": resistance,
    }
    return lifted(_history, inputs, outputs=2)


def _history(**inputs: Any) -> tuple[Any, Any]:
    """Cases first, their times last: a table is made once for a case, not for each of its times."""
    arrays = checked(inputs)
    time, *given = arrays.values()
    cases = _stacked(given)
    shape = np.broadcast_shapes(time.shape, cases.shape[1:])
    sizes = (1,) * (len(shape) + 1 - cases.ndim) + cases.shape[1:]
    order = sorted(range(len(shape)), key=lambda axis: sizes[axis] == 1)
    times = np.broadcast_to(time, shape).transpose(order)
    moved = times.shape
    count = prod(sizes)
    times = times.reshape(count, prod(moved) // max(count, 1))
    with np.errstate(all="ignore"):
        results = _in_blocks(times, cases.reshape(len(cases), count))
    back = np.argsort(order)
    depth, velocity = (result.reshape(moved).transpose(back)[()] for result in results)
    require_finite(arrays, depth + velocity)
    return depth, velocity


def _stacked(inputs: Sequence[Any]) -> Any:
    stack = np.empty((len(inputs), *np.broadcast_shapes(*(value.shape for value in inputs))))
    for row, value in enumerate(inputs):
        stack[row] = value
    return stack


_CASES, _ELEMENTS = 64, 16384
"""In a block; a case's table has some two hundred panels."""


def _in_blocks(times: Any, cases: Any) -> tuple[Any, Any]:
    """Depths and velocities for times of shape (n, m) and cases of shape (5, n)."""
    depth, velocity = np.empty(times.shape), np.empty(times.shape)
    at_once = max(1, _ELEMENTS // _CASES)
    for first in range(0, len(times), _CASES):
        rows = slice(first, first + _CASES)
        # A single case as plain floats, whose arithmetic costs a tenth of an array's.
        table = _Table(*(cases[:, 0].tolist() if len(times) == 1 else cases[:, rows, None]))
        for column in range(0, times.shape[1], at_once):
            part = rows, slice(column, column + at_once)
            depth[part], velocity[part] = table.at(times[part])
    return depth, velocity


class _Table:
    """Depth and velocity within the radius as polynomials of the fifth degree in time.

    Cases are arrays of shape (n, 1). At both ends of a panel a polynomial has the value and the
    first two derivatives that the motion has; Eq. 13 gives them.
    """

    def __init__(self, velocity: Any, radius: Any, *materials: Any) -> None:
        self.motion = motion = Motion(velocity, radius, *materials)
        panels = _panels(motion)
        e = motion.crossing * (np.arange(panels + 1.0) / panels)[None]
        self.time = _times(motion, e)
        y, v = motion.final * e * (2 - e), motion.velocity_within(1 - e)
        v[:, :1] = velocity
        area, stress = y * (2 - y), v * v + motion.rest_velocity**2
        per_radius = motion.drag / radius
        a = -per_radius * stress * area
        jerk = -2 * per_radius * v * (a * area + stress * (1 - y) / radius)
        self.width = self.time[:, 1:] - self.time[:, :-1]
        self.polynomials = _quintics(((radius * y, v, a), (v, a, jerk)), self.width)

    def at(self, time: Any) -> tuple[Any, Any]:
        """Depth and velocity at times of shape (n, m)."""
        motion, end = self.motion, self.time[:, -1:]
        panel, share = self._place(np.minimum(time, end))
        depth, velocity = _horner(self.polynomials.take(panel, axis=-1), share)
        if np.any(motion.beyond):
            y, v = motion.deep(time - end)
        else:
            y, v = motion.final, 0.0
        past = time >= end
        return np.where(past, motion.radius * y, depth), np.where(past, v, np.maximum(velocity, 0))

    def _place(self, time: Any) -> tuple[Any, Any]:
        """Which panel, counted through all cases, and how far in it."""
        case = np.arange(len(time))[:, None]
        end, lines = self.time[:, -1:], self.time.shape[1]
        # Case number and share of its time increase together: one search for all cases.
        line = np.searchsorted((self.time / end + case).ravel(), time / end + case, "right") - 1
        panel = np.minimum(line - case * lines, lines - 2) + case * (lines - 1)
        before = self.time[:, :-1].ravel()[panel]
        return panel, (time - before) / self.width.ravel()[panel]


def _panels(motion: Motion) -> int:
    """So many that the polynomials' error stays below 1e-14 of the whole.

    It goes as the sixth power of what a panel turns a velocity by; where drag rules, that is the
    logarithm of the velocity, whose steepest fall goes with the root of all of it.
    """
    return 64 + int(160 * np.sqrt(motion.steepest))


def _times(motion: Motion, e: Any) -> Any:
    """Times of shape (n, panels + 1) at the ends of the panels."""
    nodes, weights = gauss(3)
    width = e[:, 1:] - e[:, :-1]
    slowness = motion.slowness(e[:, :-1] + np.multiply.outer(nodes, width))
    times = np.zeros_like(e)
    np.cumsum(
        (weights @ slowness.reshape(len(nodes), -1)).reshape(width.shape) * width,
        1,
        out=times[:, 1:],
    )
    return times


_QUINTIC = np.array(
    [  # of the first value, the rise, both slopes, both halved curvatures
        [1, 0, 0, 0, 0, 0],
        [0, 0, 1, 0, 0, 0],
        [0, 0, 0, 0, 1, 0],
        [0, 10, -6, -4, -3, 1],
        [0, -15, 8, 7, 3, -2],
        [0, 6, -3, -3, -1, 1],
    ],
    dtype=float,
)


def _quintics(curves: Any, width: Any) -> Any:
    """Coefficients, in the share of the panel, of curves given by value, slope and curvature."""
    ends = np.empty((6, len(curves), *width.shape))
    half_square = width * width / 2
    for k, (value, slope, curvature) in enumerate(curves):
        before, after = value[:, :-1], value[:, 1:]
        ends[:2, k] = before, after - before
        ends[2:4, k] = slope[:, :-1] * width, slope[:, 1:] * width
        ends[4:, k] = curvature[:, :-1] * half_square, curvature[:, 1:] * half_square
    return (_QUINTIC @ ends.reshape(6, -1)).reshape(6, len(curves), -1)


def _horner(coefficients: Any, share: Any) -> Any:
    value = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        value = value * share + coefficient
    return value

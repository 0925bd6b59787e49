"""Depth and velocity against time: the motion tabulated by its time, and read between the lines."""

from collections.abc import Sequence
from math import prod
from typing import Any

import numpy as np

from replication.closed_form.checked import checked, require_finite
from replication.closed_form.containers import lifted
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
    inputs = locals()
    return lifted(_history, inputs, (float, float))


def _history(**inputs: Any) -> tuple[Any, Any]:
    arrays = checked(inputs)
    time, *given = arrays.values()
    with np.errstate(all="ignore"):
        depth, velocity = _broadcast(time, _stacked(given))
    for result in (depth, velocity):
        require_finite(arrays, result)
    return depth, velocity


def _broadcast(time: Any, cases: Any) -> Any:
    """Cases first, their times last: a table is made once for a case, not for each of its times."""
    if cases.ndim == 1:
        results = _in_blocks(time.reshape(1, -1), cases[:, None])
        return (result.reshape(time.shape)[()] for result in results)
    shape = np.broadcast_shapes(time.shape, cases.shape[1:])
    sizes = (1,) * (len(shape) + 1 - cases.ndim) + cases.shape[1:]
    order = sorted(range(len(shape)), key=lambda axis: sizes[axis] == 1)
    times = np.broadcast_to(time, shape).transpose(order)
    moved = times.shape
    count = prod(sizes)
    times = times.reshape(count, prod(moved) // max(count, 1))
    results = _in_blocks(times, cases.reshape(len(cases), count))
    back = np.argsort(order)
    return (result.reshape(moved).transpose(back)[()] for result in results)


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

    Cases are arrays of shape (n, 1), each with panels enough for itself; the last of those that
    need fewer than others have no width. At both ends of a panel a polynomial has the value and
    the first two derivatives that the motion has; Eq. 13 gives them.
    """

    def __init__(self, velocity: Any, radius: Any, *materials: Any) -> None:
        self.motion = motion = Motion(velocity, radius, *materials)
        self.slowest = velocity * _REST
        panels = _panels(motion)
        lines = np.minimum(np.arange(np.max(panels) + 1.0)[None], panels)
        width = motion.crossing / panels
        e = (lines + _WITHIN) * width
        v = motion.velocity_within(1 - e)
        time = _times(motion.slowness(e[1:], v[1:]), (lines[:, 1:] - lines[:, :-1]) * width)
        self.end = time[:, -1:]
        self.lines = _key(np.fmin(time / self.end, 1.0)).ravel()
        self.time = time.ravel()
        self.width = self.time[1:] - self.time[:-1]
        v[0, :, :1] = velocity
        derivatives = self._derivatives(radius, motion.final * e[0] * (2 - e[0]), v[0])
        self.polynomials = _quintics(derivatives.reshape(4, -1), self.width)

    def _derivatives(self, radius: Any, y: Any, v: Any) -> Any:
        """Depth [m], its first, second and third derivative by time (Eq. 13)."""
        motion = self.motion
        per_radius = motion.drag / radius
        area, stress = y * (2 - y), v * v + motion.rest_velocity**2
        a = -per_radius * stress * area
        jerk = -2 * per_radius * v * (a * area + stress * (1 - y) / radius)
        return np.array((radius * y, v, a, jerk))

    def at(self, time: Any) -> tuple[Any, Any]:
        """Depth and velocity at times of shape (n, m)."""
        motion = self.motion
        key = _key(np.fmin(time / self.end, _BEFORE_1))
        panel = self.lines.searchsorted(key, "right") - 1
        share = np.minimum((time - self.time[panel]) / self.width[panel], 1.0)
        depth, v = _horner(self.polynomials.take(panel, axis=-1), share)
        if np.count_nonzero(motion.beyond):
            past, (y, slower) = time >= self.end, motion.deep(time - self.end)
            depth, v = np.where(past, motion.radius * y, depth), np.where(past, slower, v)
        rests = v <= self.slowest
        return np.where(rests, motion.radius * motion.final, depth), np.where(rests, 0.0, v)


_REST = 2.0**-46
"""Of the impact velocity: what rounding leaves of it at rest."""

_BEFORE_1 = 1 - 2.0**-53
_OFFSETS = (np.arange(_CASES) << 57)[:, None]


def _key(share: Any) -> Any:
    """Integers that put shares (0 to 1) of one case in order, and after them those of the next.

    Doubles have the order of their bits, of which six are dropped to number the cases: to 2^-46 of
    itself, whatever cases stand before it, each share keeps its place.
    """
    return (share.view(np.int64) >> 6) + _OFFSETS[: len(share)]


def _panels(motion: Motion) -> Any:
    """So many that the polynomials' error stays below 1e-14 of the whole.

    It goes as the sixth power of what a panel turns a velocity by; where drag rules, that is the
    logarithm of the velocity, whose steepest fall goes with the root of all of it.
    """
    return 64 + np.floor(160 * np.sqrt(motion.steepest))


_NODES, _WEIGHTS = gauss(3)
_WITHIN = np.array([0.0, *_NODES])[:, None, None]
"""Where in a panel: at its first line, and at Gauss points."""


def _times(slowness: Any, width: Any) -> Any:
    """Times of shape (n, panels + 1) at the lines, for slowness at the Gauss points after each."""
    first, middle, last = slowness[..., :-1]
    times = np.zeros(slowness.shape[1:])
    taken = _WEIGHTS[0] * (first + last) + _WEIGHTS[1] * middle
    taken *= width
    taken.cumsum(1, out=times[:, 1:])
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


def _quintics(derivatives: Any, width: Any) -> Any:
    """Coefficients, in the share of the panel, of the depth and of the velocity.

    Both by value, slope and curvature at the lines, of which `derivatives` has shape (4, lines).
    """
    ends = np.empty((6, 2, len(width)))
    value, slope, curvature = derivatives[:2], derivatives[1:3], derivatives[2:]
    half_square = width * width / 2
    ends[0] = value[:, :-1]
    np.subtract(value[:, 1:], value[:, :-1], out=ends[1])
    np.multiply(slope[:, :-1], width, out=ends[2])
    np.multiply(slope[:, 1:], width, out=ends[3])
    np.multiply(curvature[:, :-1], half_square, out=ends[4])
    np.multiply(curvature[:, 1:], half_square, out=ends[5])
    return (_QUINTIC @ ends.reshape(6, -1)).reshape(ends.shape)


def _horner(coefficients: Any, share: Any) -> Any:
    value = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        value *= share
        value += coefficient
    return value

"""Depth and velocity against time: Eq. 13 by Taylor series.

With y = x/R and u = v/V, time in units of R/V, it is polynomial up to y = 1: y' = u and
u' = -(b u^2 + c) (2y - y^2), b = 3 rho_t / (8 rho_p), c = 3 R_t / (4 rho_p V^2); beyond, the last
factor is 1. So the coefficients of the series follow from each other by products of series.

Order and step are those of Jorba and Zou (2005) for double precision: the radius of convergence r
is estimated from the last two coefficients of the velocity, and a step is r / e^2 long. Term k is
then about e^(-2k) of the first ones, so that order 20 leaves out e^(-42) / (1 - e^(-2)) = 7e-19 of
the velocity in a step, far less than rounding. The impact ends at the depth and velocity of the
energy integral; the time of a known state is found by Newton's method along the series.
"""

import math
from collections.abc import Iterator
from typing import Any

from replication.models.depth import depth_at_velocity, normalized_depth, velocity_at_depth

ORDER = 20
E_2 = math.exp(-2)

Series = Any  # a list of floats or, where it is compiled, an array


def history(
    time: Series, velocity: float, radius: float, particle_density: float, target_density: float,
    resistance: float, depth: Series, speed: Series,
) -> None:  # fmt: skip
    """Fill in `depth` [m] and `speed` [m/s] at times [s] after touch, in any order.

    What they are, and how exact, says `arrays.history`. NaN at negative and at not finite times.
    """
    V, R, rho_p, rho_t, R_t = velocity, radius, particle_density, target_density, resistance
    final = normalized_depth(V, rho_p, rho_t, R_t)
    y, w = zeros(ORDER + 1), zeros(ORDER + 1)
    s, at, dy = zeros(len(time)), zeros(len(time)), zeros(len(time))
    rising = True
    for k in range(1, len(time)):
        rising = rising and time[k - 1] <= time[k]
    k, end = 0, 0.0
    for start, unit, length in _steps(y, w, final, V, rho_p, rho_t, R_t):
        begin, end = start * R / V, (start + length * unit) * R / V
        k = k if rising else 0
        while k < len(time) and not (rising and time[k] >= end):
            first = k
            while k < len(time) and begin <= time[k] < end:
                s[k - first] = (time[k] * V / R - start) / unit
                k += 1
            _states(y, w, s, at, dy, k - first)
            for i in range(k - first):
                depth[first + i] = R * min(at[i], final)
                speed[first + i] = V * max(dy[i] / unit, 0.0)
            k = max(k, first + 1)
    for k in range(len(time)):
        if not 0 <= time[k] < math.inf:
            depth[k], speed[k] = math.nan, math.nan
        elif time[k] >= end:
            depth[k], speed[k] = R * final, 0.0


def stop_time(
    velocity: float, radius: float, particle_density: float, target_density: float,
    resistance: float, stop_velocity: float = 0.0,
) -> float:  # fmt: skip
    """Time [s] from touch until the velocity has fallen to `stop_velocity` [m/s], at most V.

    >>> f"{stop_time(500.0, 11e-6, 8900.0, 7850.0, 3.5e9) * 1e9:.12f}"
    '26.079233782409'
    """
    motion = velocity, radius, particle_density, target_density, resistance
    return _time(depth_at_velocity(stop_velocity, *motion), stop_velocity, *motion)


def time_to_depth(
    at_depth: float, velocity: float, radius: float, particle_density: float, target_density: float,
    resistance: float,
) -> float:  # fmt: skip
    """Time [s] from touch to a depth [m], at most the final one.

    Close to rest the time left varies as the square root of the depth left, so that fewer digits
    of the result are right.

    >>> f"{time_to_depth(5e-6, 500.0, 11e-6, 8900.0, 7850.0, 3.5e9) * 1e9:.6f}"
    '11.192312'
    """
    motion = velocity, radius, particle_density, target_density, resistance
    return _time(at_depth, velocity_at_depth(at_depth, *motion), *motion)


def _time(
    depth: float, speed: float, V: float, R: float, rho_p: float, rho_t: float, R_t: float
) -> float:
    """Time [s] at which the motion has this depth and speed; NaN if one of them is."""
    if math.isnan(depth + speed):
        return math.nan
    time, final = 0.0, normalized_depth(V, rho_p, rho_t, R_t)
    if depth == 0:
        return time
    y, w = zeros(ORDER + 1), zeros(ORDER + 1)
    for start, unit, length in _steps(y, w, final, V, rho_p, rho_t, R_t):
        aim_y, aim_w = depth / R, speed / V * unit
        at, dy, _ = _state(y, w, length)
        if speed > 0 and (at >= aim_y or dy <= aim_w):
            return (start + _locate(y, w, aim_y, aim_w, length) * unit) * R / V
        time = (start + length * unit) * R / V
    return time


def _steps(
    y: Series, w: Series, final: float, V: float, rho_p: float, rho_t: float, R_t: float
) -> Iterator[tuple[float, float, float]]:
    """The Taylor steps from touch to rest: start, unit of time, and length in this unit.

    `y` is filled with the series of the depth in the time since the start, in this unit, and `w`
    with that of its derivative dy.
    """
    b = 0.375 * rho_t / rho_p
    c = b / (rho_t * V * V / (2 * R_t))
    at_radius = math.sqrt(c / b * math.expm1(2 * b * (final - 1))) if final > 1 else 0.0
    area, stress = zeros(ORDER + 1), zeros(ORDER + 1)
    start, unit = 0.0, 1 / math.sqrt(1 + b + c)
    y[0], w[0] = 0.0, unit
    beyond, rest = False, False
    while not rest:
        growth = _expand(y, w, area, stress, b, c * unit * unit, beyond)
        length = growth
        at, dy, _ = _state(y, w, length)
        aim_y, aim_w = (final, 0.0) if beyond or final <= 1 else (1.0, at_radius * unit)
        if at >= aim_y or dy <= aim_w:
            length = _locate(y, w, aim_y, aim_w, length)
            at, dy, _ = _state(y, w, length)
            beyond, rest = True, aim_w == 0
        yield start, unit, length
        start += length * unit
        y[0], w[0] = at, dy * growth
        unit *= growth


def _expand(
    y: Series, w: Series, area: Series, stress: Series, b: float, c: float, beyond: bool
) -> float:
    """Fill in the coefficients that follow from y[0] and w[0]; return the length of a step."""
    area[0] = 1.0 if beyond else 2 * y[0] - y[0] * y[0]
    stress[0] = b * w[0] * w[0] + c
    y[1], w[1] = w[0], -stress[0] * area[0]
    for k in range(1, ORDER):
        # From both ends to the middle, in sums that the processor can form at the same time.
        yy, ww, first, last = y[0] * y[k], w[0] * w[k], 0.0, 0.0
        for j in range(1, (k + 1) // 2):
            yy += y[j] * y[k - j]
            ww += w[j] * w[k - j]
            first += stress[j] * area[k - j]
            last += stress[k - j] * area[j]
        yy, ww = 2 * yy, 2 * ww
        if k % 2 == 0:
            middle = k // 2
            yy += y[middle] * y[middle]
            ww += w[middle] * w[middle]
            first += stress[middle] * area[middle]
        area[k] = 0.0 if beyond else 2 * y[k] - yy
        stress[k] = b * ww
        product = first + last + stress[0] * area[k] + stress[k] * area[0]
        y[k + 1] = w[k] / (k + 1)
        w[k + 1] = -product / (k + 1)
    size = max(abs(w[0]), abs(w[1]))
    highest, before = abs(w[ORDER]) / size, abs(w[ORDER - 1]) / size
    inverse_radius: float = max(highest ** (1 / ORDER), before ** (1 / (ORDER - 1)), 0.05)
    return E_2 / inverse_radius


def _states(y: Series, w: Series, s: Series, at: Series, dy: Series, count: int) -> None:
    """Depths and dy at the first `count` times s of the step; arrays, for the compiled code."""
    for i in range(count):
        depth, speed = y[ORDER], w[ORDER]
        for k in range(ORDER - 1, -1, -1):
            depth = depth * s[i] + y[k]
            speed = speed * s[i] + w[k]
        at[i], dy[i] = depth, speed


def _state(y: Series, w: Series, s: float) -> tuple[float, float, float]:
    """Depth, dy and ddy at a time s since the start of the step."""
    at, dy, ddy = y[ORDER], w[ORDER], 0.0
    for k in range(ORDER - 1, -1, -1):
        ddy = ddy * s + dy
        dy = dy * s + w[k]
        at = at * s + y[k]
    return at, dy, ddy


def _locate(y: Series, w: Series, depth: float, speed: float, s: float) -> float:
    """The time along the series at which the motion has this depth and dy, which must occur there.

    Newton's method on the distance left, projected on the direction of the motion in the plane of
    depth and velocity: at touch the depth decides, at rest the velocity.
    """
    for _ in range(10):
        at, dy, ddy = _state(y, w, s)
        change = ((depth - at) * dy + (speed - dy) * ddy) / (dy * dy + ddy * ddy)
        s += change
        if abs(change) <= 1e-16 * s:
            break
    return s


def zeros(count: int) -> list[float]:
    """So many zeros: a list, or in compiled code an array."""
    return [0.0] * count

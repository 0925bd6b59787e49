"""Depth and velocity against time: Eq. 13 by Taylor series, and beyond y = 1 in closed form.

With y = x/R and u = v/V, and time in units of R/V, Eq. 13 is polynomial up to y = 1: y' = u and
u' = -(b u^2 + strength) (2y - y^2), where b = 3 rho_t / (8 rho_p), and strength is
3 R_t / (4 rho_p V^2). So each coefficient of the series follows from the previous ones by products
of series. Beyond y = 1 the last factor is 1, and u is a tangent of time.

The order and the steps are those of Jorba and Zou (2005) for double precision: the radius of
convergence r is estimated from the last two coefficients of the velocity, and a step is r / e^2
long. Term k is then about e^(-2k) of the first ones, so that order 20 leaves out
e^(-42) / (1 - e^(-2)) = 7e-19 of the velocity in a step, far less than rounding. The series end at
the depth and velocity that the energy integral gives for rest, or for y = 1; the time of a known
state is found by Newton's method along the series.
"""

import math
from collections.abc import Iterator
from typing import Any

from replication.models.depth import depth_at_velocity, normalized_depth, velocity_at_depth

ORDER = 20
E_2 = math.exp(-2)

LANES = 16
"""Number of times that are evaluated together, so that the compiler can use vector instructions."""

Array = Any  # a list of floats, or a list of such lists; in compiled code an array


def history(
    time: Array, velocity: float, radius: float, particle_density: float, target_density: float,
    resistance: float, depth: Array, speed: Array,
) -> None:  # fmt: skip
    """Fill in `depth` [m] and `speed` [m/s] at times [s] after touch, in any order.

    `arrays.history` documents the results and their errors. Raises ValueError for a time that is
    negative or not finite.
    """
    V, R = velocity, radius
    rising = _are_rising(time)
    b, strength, final, at_radius = _equation(V, particle_density, target_density, resistance)
    terms, scratch = zeros(4, ORDER + 1), zeros(3, LANES)
    k, end, reached = 0, 0.0, 0.0
    for start, unit, length in _steps(terms, b, strength, min(final, 1.0), at_radius):
        reached = start + length * unit
        begin, end = start * R / V, reached * R / V
        k = k if rising else 0
        while k < len(time) and not (rising and time[k] >= end):
            first = k
            while k < len(time) and begin <= time[k] < end:
                k += 1
            for batch in range(first, k, LANES):
                count = min(LANES, k - batch)
                for i in range(count):
                    scratch[0][i] = (time[batch + i] * V / R - start) / unit
                _states(terms[0], terms[1], scratch[0], scratch[1], scratch[2], LANES)
                for i in range(count):
                    depth[batch + i], speed[batch + i] = scratch[1][i], scratch[2][i] / unit
            k = max(k, first + 1)
    rest = (reached + _time_beyond(final, 0.0, b, strength, at_radius)) * R / V
    for k in range(len(time)):
        y, u = depth[k], speed[k]
        if time[k] >= rest:
            y, u = final, 0.0
        elif time[k] >= end:
            y, u = _beyond(time[k] * V / R - reached, b, strength, at_radius)
        depth[k], speed[k] = R * min(y, final), V * max(u, 0.0)


def _are_rising(time: Array) -> bool:
    """Return whether no time is earlier than the one before it. Raises as `history` does."""
    rising = True
    for k in range(len(time)):
        if not 0 <= time[k] < math.inf:
            raise ValueError("a time must be finite, and zero or more")
        rising = rising and (k == 0 or time[k - 1] <= time[k])
    return rising


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

    Close to rest the remaining time varies as the square root of the remaining depth, so that
    fewer digits of the result are correct.

    >>> f"{time_to_depth(5e-6, 500.0, 11e-6, 8900.0, 7850.0, 3.5e9) * 1e9:.6f}"
    '11.192312'
    """
    motion = velocity, radius, particle_density, target_density, resistance
    return _time(at_depth, velocity_at_depth(at_depth, *motion), *motion)


def _time(
    depth: float, speed: float, V: float, R: float, rho_p: float, rho_t: float, R_t: float
) -> float:
    """Time [s] at which the motion has this depth [m] and speed [m/s]; NaN if either is NaN."""
    if math.isnan(depth + speed):
        return math.nan
    if depth == 0:
        return 0.0
    b, strength, final, at_radius = _equation(V, rho_p, rho_t, R_t)
    reached, y, u = 0.0, depth / R, speed / V
    terms = zeros(4, ORDER + 1)
    for start, unit, length in _steps(terms, b, strength, min(final, 1.0), at_radius):
        at, dy = _state(terms, length)
        if u > 0 and (at >= y or dy <= u * unit):
            located = _locate(terms, y, u * unit, b, strength * unit * unit, length)
            return (start + located * unit) * R / V
        reached = start + length * unit
    return (reached + _time_beyond(y, u, b, strength, at_radius)) * R / V


def _equation(
    V: float, rho_p: float, rho_t: float, R_t: float
) -> tuple[float, float, float, float]:
    """Return b and strength, y at rest, and u at y = 1 (0 if the motion does not get beyond it)."""
    b = 0.375 * rho_t / rho_p
    strength = b / (rho_t * V * V / (2 * R_t))
    final = normalized_depth(V, rho_p, rho_t, R_t)
    at_radius = math.sqrt(strength / b * math.expm1(2 * b * (final - 1))) if final > 1 else 0.0
    return b, strength, final, at_radius


# Beyond y = 1, where u = k tan(constant - w t) with k^2 = strength / b and w = k b (the product b
# strength might underflow)


def _beyond(time: float, b: float, strength: float, at_radius: float) -> tuple[float, float]:
    """Return y and u at a time after the passage through y = 1, in a form without cancellation."""
    k = math.sqrt(strength / b)
    half = k * b * time / 2
    sine, cosine = math.sin(half), math.cos(half)
    growth = 2 * sine * (at_radius / k * cosine - sine)
    u = (at_radius * (1 - 2 * sine * sine) - 2 * k * sine * cosine) / (1 + growth)
    return 1 + math.log1p(growth) / b, u


def _time_beyond(y: float, u: float, b: float, strength: float, at_radius: float) -> float:
    """Return the time from y = 1 to the depth y and velocity u; 0 if the motion ends before."""
    k, lost = math.sqrt(strength / b), at_radius - u
    if at_radius > 0 and lost < u:
        # The difference has lost digits. The energy integral gives it from y.
        lost = -(at_radius * at_radius + k * k) * math.expm1(2 * b * (1 - y)) / (at_radius + u)
    return math.atan2(k * lost, k * k + at_radius * u) / (k * b)


# Up to y = 1. The rows of `terms` are the coefficients of y, its derivative w, b w^2 + strength,
# and 2y - y^2. Times s along a series are counted from the start of its step, in the step's unit
# of time, in which w and strength are, too


def _steps(
    terms: Array, b: float, strength: float, end_y: float, end_u: float
) -> Iterator[tuple[float, float, float]]:
    """Fill in `terms` for each step from touch to y = end_y, u = end_u.

    Yields the step's start, the unit of time of its series, and its length in that unit.
    """
    start, unit = 0.0, 1 / math.sqrt(1 + b + strength)
    terms[0][0], terms[1][0] = 0.0, unit
    ended = False
    while not ended:
        length = growth = _expand(terms, b, strength * unit * unit)
        y, w = _state(terms, length)
        ended = y >= end_y or w <= end_u * unit
        if ended:
            length = _locate(terms, end_y, end_u * unit, b, strength * unit * unit, length)
        yield start, unit, length
        start += length * unit
        terms[0][0], terms[1][0] = y, w * growth
        unit *= growth


def _expand(terms: Array, b: float, strength: float) -> float:
    """Fill in the coefficients that follow from y and w at the start; return the step's length."""
    y, w, stress, area = terms[0], terms[1], terms[2], terms[3]
    y_0, w_0 = y[0], w[0]
    stress_0, area_0 = b * w_0 * w_0 + strength, 2 * y_0 - y_0 * y_0
    y_k, w_k = w_0, -stress_0 * area_0
    stress[0], area[0], y[1], w[1] = stress_0, area_0, y_k, w_k
    for k in range(1, ORDER):
        # The sums run from the middle to both ends, so that the processor can start them before the
        # newest coefficients are known.
        yy, ww, first, last = 0.0, 0.0, 0.0, 0.0
        if k % 2 == 0:
            middle = k // 2
            yy, ww = y[middle] * y[middle] / 2, w[middle] * w[middle] / 2
            first = stress[middle] * area[middle]
        for j in range((k - 1) // 2, 0, -1):
            yy += y[j] * y[k - j]
            ww += w[j] * w[k - j]
            first += stress[j] * area[k - j]
            last += stress[k - j] * area[j]
        stress_k = 2 * b * (w_0 * w_k + ww)
        area_k = 2 * (y_k - (y_0 * y_k + yy))
        product = first + last + stress_0 * area_k + stress_k * area_0
        share = 1 / (k + 1)
        y_k, w_k = w_k * share, -product * share
        stress[k], area[k], y[k + 1], w[k + 1] = stress_k, area_k, y_k, w_k
    # 0.05 keeps the step finite where the last coefficients vanish.
    size = max(abs(w_0), abs(w[1]))
    highest, before = abs(w[ORDER]) / size, abs(w[ORDER - 1]) / size
    inverse_radius: float = max(highest ** (1 / ORDER), before ** (1 / (ORDER - 1)), 0.05)
    return E_2 / inverse_radius


def _states(y: Array, w: Array, s: Array, at: Array, dy: Array, count: int) -> None:
    """Fill in y (`at`) and w (`dy`) at the first `count` times s.

    With single rows and a count as arguments the compiler finds that it can use vectors.
    """
    for i in range(count):
        depth, speed = y[ORDER], w[ORDER]
        for k in range(ORDER - 1, -1, -1):
            depth = depth * s[i] + y[k]
            speed = speed * s[i] + w[k]
        at[i], dy[i] = depth, speed


def _state(terms: Array, s: float) -> tuple[float, float]:
    """Return y and w at the time s."""
    y, w = terms[0], terms[1]
    at, dy = y[ORDER], w[ORDER]
    for k in range(ORDER - 1, -1, -1):
        at = at * s + y[k]
        dy = dy * s + w[k]
    return at, dy


def _locate(terms: Array, y: float, w: float, b: float, strength: float, s: float) -> float:
    """Return the time at which the motion has this y and w, by Newton's method from s.

    What vanishes is the distance from the state (y, w), projected on the direction of motion in the
    plane of depth and velocity: so the depth decides at touch, and the velocity at rest.
    """
    for _ in range(10):
        at, dy = _state(terms, s)
        ddy = -(b * dy * dy + strength) * (2 * at - at * at)
        change = ((y - at) * dy + (w - dy) * ddy) / (dy * dy + ddy * ddy)
        s += change
        if abs(change) <= 1e-9 * s:  # the next change would be about its square
            break
    return s


def zeros(rows: int, columns: int) -> list[list[float]]:
    """Return rows of zeros: lists, or in compiled code an array."""
    return [[0.0] * columns for _ in range(rows)]

"""Depth and velocity from the energy integral of Eq. 13."""

import math
from typing import Any

import numpy as np

from replication.closed_form.compensated import left_of_pressure, left_of_product
from replication.closed_form.elementwise import elementwise

__all__ = [
    "depth_and_left",
    "depth_at_velocity",
    "depth_ratio",
    "final_depth",
    "normalized_depth",
    "velocity_at_depth",
    "work_within",
]


def normalized_depth(
    velocity: Any, particle_density: Any, target_density: Any, resistance: Any
) -> Any:
    """Normalized depth at rest, y = X/R [1], exact for the differential equation (Eqs. 12-13).

    With c = (4 rho_p / 3 rho_t) ln(1 + rho_t V^2 / 2 R_t), the depth solves y^2 - y^3/3 = c while
    c <= 2/3 (that is the crater of volume ratio 3c/4, Eq. 2) and is y = 1/3 + c beyond. It does
    not depend on the particle's size. V [m/s], rho_p and rho_t [kg/m^3], R_t [Pa] broadcast.
    Raises ValueError naming the first element that is not finite and positive.

    >>> f"{normalized_depth(500.0, 8900.0, 7850.0, 3.5e9):.4f}"
    '0.6977'
    """
    inputs = locals()
    return elementwise(depth_ratio, inputs)


def final_depth(
    velocity: Any, radius: Any, particle_density: Any, target_density: Any, resistance: Any
) -> Any:
    """Penetration depth at rest [m]: R times `normalized_depth`; radius R [m], all broadcast.

    >>> f"{final_depth(500.0, 11e-6, 8900.0, 7850.0, 2.1e9) * 1e6:.2f}"
    '10.04'
    """
    inputs = locals()
    return elementwise(_final_depth, inputs)


def depth_at_velocity(
    at_velocity: Any,
    velocity: Any,
    radius: Any,
    particle_density: Any,
    target_density: Any,
    resistance: Any,
) -> Any:
    """Depth [m] at which the velocity has fallen from V to `at_velocity` [m/s]; all broadcast.

    Raises ValueError naming the first element that is out of range or exceeds its V.

    >>> f"{depth_at_velocity(250.0, 500.0, 11e-6, 8900.0, 7850.0, 3.5e9) * 1e6:.4f}"
    '6.3777'
    """
    inputs = locals()
    return elementwise(
        _depth_at_velocity, inputs, never="at_velocity must not exceed the impact velocity"
    )


def velocity_at_depth(
    at_depth: Any,
    velocity: Any,
    radius: Any,
    particle_density: Any,
    target_density: Any,
    resistance: Any,
) -> Any:
    """Velocity [m/s] at a depth [m] of at most the final one; all broadcast.

    Close to rest the velocity is the root of the depth that is left, whose last digits count.
    Raises ValueError naming the first element that is out of range or deeper than the final depth.

    >>> f"{velocity_at_depth(5e-6, 500.0, 11e-6, 8900.0, 7850.0, 3.5e9):.3f}"
    '353.533'
    """
    inputs = locals()
    return elementwise(_velocity_at_depth, inputs, never="at_depth must not exceed the final depth")


def depth_ratio(velocity: Any, particle_density: Any, target_density: Any, resistance: Any) -> Any:
    """`normalized_depth` of one block."""
    return _root(*_volume_ratio(velocity, particle_density, target_density, 2 * resistance))


def _final_depth(
    velocity: Any, radius: Any, particle_density: Any, target_density: Any, resistance: Any
) -> Any:
    return radius * depth_ratio(velocity, particle_density, target_density, resistance)


def _depth_at_velocity(at: Any, velocity: Any, radius: Any, *materials: Any) -> Any:
    return radius * _ratio_at_velocity(at, velocity, *materials)


def _ratio_at_velocity(
    at: Any, velocity: Any, particle_density: Any, target_density: Any, resistance: Any
) -> Any:
    left = 2 * resistance + target_density * at * at
    lost = target_density * (velocity - at) * (velocity + at) / left
    r = particle_density * np.log1p(np.where(lost >= 0, lost, np.nan)) / target_density
    return np.where(lost == 0, 0.0, _root(r, 0.0))[()]


def depth_and_left(
    at: Any, final: Any, velocity: Any, particle_density: Any, target_density: Any, resistance: Any
) -> tuple[Any, Any]:
    """Normalized depth at the velocity `at` [m/s], and from there to rest at `final`."""
    y = _ratio_at_velocity(at, velocity, particle_density, target_density, resistance)
    left = np.maximum(final - y, 0.0)
    work = np.log1p(target_density * at * at / (2 * resistance))
    work = particle_density * work / (0.75 * target_density)
    # Near rest the difference keeps few digits; one Newton step on the work gives them back.
    edge = np.minimum(y, 1.0)
    newton = left - (_work_left(final, left) - work) / (edge * (2 - edge))
    return y, np.where(2 * left < final, np.maximum(newton, 0.0), left)[()]


def _velocity_at_depth(
    at: Any,
    velocity: Any,
    radius: Any,
    particle_density: Any,
    target_density: Any,
    resistance: Any,
) -> Any:
    final = depth_ratio(velocity, particle_density, target_density, resistance)
    left = radius * final - at
    work = _work_left(final, np.where(left >= 0, left, np.nan) / radius)
    exponent = 0.75 * target_density / particle_density * work
    return np.sqrt(2 * resistance / target_density * np.expm1(exponent))


def _work_left(final: Any, short: Any) -> Any:
    """The work from y = final - short to rest."""
    beyond = np.minimum(short, np.maximum(final - 1, 0.0))
    return beyond + work_within(np.minimum(final, 1.0), short - beyond)


def work_within(y: Any, short: Any) -> Any:
    """The work from y - short to y <= 1, in the form that does not cancel near y; of one block."""
    return short * (y * (2 - y) - short * (1 - y) - short * short / 3)


def _root(r: Any, r_low: Any) -> Any:
    """y of y^2 (3 - y) = 4 (r + r_low) up to y = 1, of 3y - 1 = 4 (r + r_low) beyond.

    The first by the triple angle, in the form that does not cancel for shallow craters: with
    h = asin(sqrt(r)) / 3, y = 4 sin(h) sin(h + pi/3), here half of it by the one tangent of h.
    """
    if type(r) is float:
        if r > 0.5:
            return _deep_root(r, r_low)
        return _shallow_root(r, r_low, math.tan(math.asin(math.sqrt(r)) / 3))
    capped = np.minimum(r, 0.5)
    shallow = _shallow_root(capped, r_low, np.tan(np.arcsin(np.sqrt(capped)) / 3))
    return np.where(r <= 0.5, shallow, _deep_root(r, r_low))


def _shallow_root(r: Any, r_low: Any, t: Any) -> Any:
    """The first root, from the tangent of h."""
    half = t + _SQRT_3
    half *= t
    t *= t
    t += 1
    half /= t
    half -= _newton_step(half, r, r_low)
    half *= 2
    return half


def _deep_root(r: Any, r_low: Any) -> Any:
    deep = 4 * r_low + 1
    deep += 4 * r
    deep /= 3
    return deep


_SQRT_3 = float(np.sqrt(3.0))


def _newton_step(z: Any, r: Any, r_low: Any) -> Any:
    """From z to the root of z^2 (3 - 2z) = r + r_low: takes out what rounding left in z."""
    square = z * z
    over = 3 - 2 * z
    over *= square
    over -= r
    over -= r_low
    slope = z - square
    slope *= 6
    over /= slope
    return over


def _volume_ratio(V: Any, rho_p: Any, rho_t: Any, twice_R_t: Any) -> tuple[Any, Any]:
    """3c/4 = (rho_p / rho_t) ln(1 + p), p = rho_t V^2 / 2 R_t, and what rounding left out of it.

    So the depth keeps within 4 ulp. A relative rounding, u = 2^-53, is an ulp at most, and NumPy's
    logarithm is within 1.2 u. A shallow depth has 0.6 ulp of it (the root halves all of r), 1.5 of
    the Newton step's residual (3 u), 1 of the step's sum, 0.5 of the product with R; a deep one 1.2
    of the logarithm, 1.3 of the sum 1 + 4r, 1 of the third, 0.5 of the product. Left in, the three
    roundings of p and the two of r would add 2.5 and up to 5. All holds where these products and
    quotients stay between 1e-250 and 1e250, which `checked` sees to.
    """
    p = V * V
    p *= rho_t
    p /= twice_R_t
    log = math.log1p(p) if type(p) is float else np.log1p(p)
    r = rho_p * log
    r /= rho_t
    low = left_of_pressure(V, rho_t, twice_R_t, p)
    p += 1
    p *= twice_R_t
    low /= p
    low *= rho_p
    low += left_of_product(rho_p, log, rho_t, r)
    low /= rho_t
    return r, low

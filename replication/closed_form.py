"""Final depth and stop time without time steps: Eq. 13 separated and integrated once."""

from functools import cache
from typing import Any

import numpy as np

from replication.sphere import depth_from_volume_ratio

__all__ = ["final_depth", "normalized_depth", "stop_time"]


def normalized_depth(
    velocity: Any, particle_density: Any, target_density: Any, resistance: Any
) -> Any:
    """Normalized depth at rest, y = X/R [1], exact for the differential equation (Eqs. 12-13).

    With c = (4 rho_p / 3 rho_t) ln(1 + rho_t V^2 / 2 R_t), the depth solves y^2 - y^3/3 = c while
    c <= 2/3 (that is the crater of volume ratio 3c/4, Eq. 2) and is y = 1/3 + c beyond. It does
    not depend on the particle's size. V [m/s], rho_p and rho_t [kg/m^3], R_t [Pa] broadcast.

    >>> f"{normalized_depth(500.0, 8900.0, 7850.0, 3.5e9):.4f}"
    '0.6977'
    """
    r, r_low = _volume_ratio(velocity, particle_density, target_density, resistance)
    capped = np.minimum(r, 0.5)
    y = depth_from_volume_ratio(capped)
    # One Newton step takes out the rounding of the root, and what r leaves out of the ratio.
    slope = 3 * y * (2 - y)
    y = y - (y * y * (3 - y) - 4 * capped - 4 * r_low) / np.where(slope > 0, slope, 1.0)
    deep = 1 + 4 * r
    left = np.where(r < 0.25, 4 * r - (deep - 1), 1 - (deep - 4 * r)) + 4 * r_low
    return np.where(r <= 0.5, y, (deep + left) / 3)[()]


def _volume_ratio(
    velocity: Any, particle_density: Any, target_density: Any, resistance: Any
) -> tuple[Any, Any]:
    """3c/4 = (rho_p / rho_t) ln(1 + p), p = rho_t V^2 / 2 R_t, and what rounding left out of it.

    The logarithm is the only rounding that remains, so that the depth keeps within 4 ulp; where
    these products and quotients stay between 1e-250 and 1e250, which `Impact` sees to.
    """
    square, square_low = _product(velocity, velocity)
    dynamic, dynamic_low = _product(square, target_density)
    dynamic_low = dynamic_low + square_low * target_density
    p, p_low = _quotient(dynamic, 2 * resistance)
    p_low = p_low + dynamic_low / (2 * resistance)
    density, density_low = _quotient(particle_density, target_density)
    log = np.log1p(p)
    r, r_low = _product(density, log)
    return r, r_low + density_low * log + density * (p_low / (1 + p))


def _product(a: Any, b: Any) -> tuple[Any, Any]:
    """A product and its rounding error, exactly (Dekker)."""
    product = a * b
    a_high, b_high = _high_half(a), _high_half(b)
    a_low, b_low = a - a_high, b - b_high
    error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    return product, error


def _quotient(a: Any, b: Any) -> tuple[Any, Any]:
    """A quotient and its rounding error, to double precision."""
    quotient = a / b
    product, error = _product(quotient, b)
    return quotient, ((a - product) - error) / b


def _high_half(a: Any) -> Any:
    """The upper 26 bits (Veltkamp)."""
    shifted = 134217729.0 * a  # 2^27 + 1
    return shifted - (shifted - a)


def final_depth(
    velocity: Any, radius: Any, particle_density: Any, target_density: Any, resistance: Any
) -> Any:
    """Penetration depth at rest [m]: R times `normalized_depth`; radius R [m], all broadcast.

    >>> f"{final_depth(500.0, 11e-6, 8900.0, 7850.0, 2.1e9) * 1e6:.2f}"
    '10.04'
    """
    return radius * normalized_depth(velocity, particle_density, target_density, resistance)


def stop_time(
    velocity: float,
    radius: float,
    particle_density: float,
    target_density: float,
    resistance: float,
    stop_velocity: float = 0.0,
) -> float:
    """Time from touch to the stop velocity [s], to about ten digits; scalars as for `final_depth`.

    The integral of dx/v with x = X (1 - s^2), which removes the square root singularity at rest, by
    Gauss-Legendre panels no wider than the velocity's exponential fall allows. The stop velocity
    [m/s] must not exceed V.

    >>> f"{stop_time(500.0, 11e-6, 8900.0, 7850.0, 3.5e9) * 1e9:.9f}"
    '26.079233782'
    """
    c = 4 / 3 * float(_volume_ratio(velocity, particle_density, target_density, resistance)[0])
    final = float(normalized_depth(velocity, particle_density, target_density, resistance))
    decay = 3 * target_density / (4 * particle_density)
    rest_velocity = np.sqrt(2 * resistance / target_density)
    left = np.log1p((stop_velocity / rest_velocity) ** 2) / decay
    start = np.sqrt(max(0.0, 1 - _depth_for_work(max(0.0, c - left)) / final))
    cuts = int(decay * c) + 1
    edges = {float(start), 1.0, *(k / cuts for k in range(cuts))}
    if final > 1:
        edges.add(float(np.sqrt(1 - 1 / final)))
    ends = np.array(sorted(edge for edge in edges if edge >= start))
    nodes, weights = _gauss(16)
    half = np.diff(ends)[:, None] / 2
    s = ends[:-1, None] + half * (1 + nodes)
    v = rest_velocity * np.sqrt(np.expm1(decay * _work_left(final, final * s * s)))
    return float(radius * np.sum(weights * half * 2 * final * s / v))


def _depth_for_work(c: float) -> float:
    """The normalized depth that the work c digs."""
    return float(depth_from_volume_ratio(0.75 * c)) if c <= 2 / 3 else 1 / 3 + c


@cache
def _gauss(points: int) -> Any:
    return np.polynomial.legendre.leggauss(points)


def _work_left(final: float, short: Any) -> Any:
    """The work from y = final - short to rest, in the form that does not cancel near rest."""
    beyond = np.minimum(short, max(final - 1, 0.0))
    y, short = min(final, 1.0), short - beyond
    return beyond + short * (y * (2 - y) - short * (1 - y) - short * short / 3)

"""Depth against velocity, without time: Eq. 13 separated and integrated once.

M v dv/dx = -(rho_t v^2 / 2 + R_t) A(x), so 2 b W(y) = ln((V^2 + v_r^2) / (v^2 + v_r^2))
with y = x/R, b = 3 rho_t / (8 rho_p), v_r^2 = 2 R_t / rho_t. W(y) = y^2 - y^3/3 up to y = 1, and
beyond, where the contact area stays pi R^2, y - 1/3.
"""

import math

from replication.models.crater import crater_depth


def normalized_depth(
    velocity: float, particle_density: float, target_density: float, resistance: float
) -> float:
    """Normalized depth at rest, y = X/R [1], exact for the differential equation (Eqs. 12-13).

    It solves W(y) = (4 rho_p / 3 rho_t) ln(1 + rho_t V^2 / 2 R_t), W(y) = y^2 - y^3/3 up to y = 1
    and y - 1/3 beyond, and does not depend on the particle's size. V [m/s], rho_p and rho_t
    [kg/m^3], R_t [Pa].

    >>> f"{normalized_depth(500.0, 8900.0, 7850.0, 3.5e9):.4f}"
    '0.6977'
    """
    V, rho_p, rho_t, R_t = velocity, particle_density, target_density, resistance
    p = rho_t * V * V / (2 * R_t)
    # From 2 on, rounding 1 + p moves its logarithm by half an ulp at most, and `log` takes a third
    # of the time of `log1p`.
    logarithm = math.log1p(p) if p < 2 else math.log(1 + p)
    # Up to y = 1 the crater's volume over the particle's is three quarters of W.
    return crater_depth(rho_p / rho_t * logarithm)


def final_depth(
    velocity: float, radius: float, particle_density: float, target_density: float,
    resistance: float,
) -> float:  # fmt: skip
    """Penetration depth at rest, X [m], exact for Eqs. 12-13: R times `normalized_depth`.

    >>> f"{final_depth(500.0, 11e-6, 8900.0, 7850.0, 2.1e9) * 1e6:.2f}"
    '10.04'
    """
    return radius * normalized_depth(velocity, particle_density, target_density, resistance)


def elasticities(
    velocity: float, particle_density: float, target_density: float, resistance: float
) -> dict[str, float]:
    """Return d ln X / d ln input [1] for each input: the percent of X for one percent of the input.

    With c = (4 rho_p / 3 rho_t) ln(1 + p), p = rho_t V^2 / 2 R_t, and W(y) = c as for
    `normalized_depth`: d ln y = s d ln c, where s = c / (y^2 (2 - y)), and c / y beyond y = 1; and
    d ln ln(1 + p) = q d ln p, where q = p / ((1 + p) ln(1 + p)). V [m/s], rho_p and rho_t [kg/m^3],
    R_t [Pa]; X is proportional to the radius.

    >>> by_input = elasticities(500.0, 8900.0, 7850.0, 3.5e9)
    >>> f"{by_input['velocity']:.3f}", f"{by_input['resistance']:.3f}"
    ('1.044', '-0.522')
    """
    V, rho_p, rho_t, R_t = velocity, particle_density, target_density, resistance
    p = rho_t * V * V / (2 * R_t)
    c = 4 / 3 * rho_p / rho_t * math.log1p(p)
    y = normalized_depth(V, rho_p, rho_t, R_t)
    s = c / (y * y * (2 - y)) if y < 1 else c / y
    q = p / ((1 + p) * math.log1p(p))
    return {
        "velocity": 2 * q * s, "radius": 1.0, "particle_density": s,
        "target_density": (q - 1) * s, "resistance": -q * s,
    }  # fmt: skip


def depth_at_velocity(
    at_velocity: float, velocity: float, radius: float, particle_density: float,
    target_density: float, resistance: float,
) -> float:  # fmt: skip
    """Depth [m] at which the velocity has fallen from V to `at_velocity` [m/s], at most V.

    It solves W(x/R) = (4 rho_p / 3 rho_t) ln((rho_t V^2 + 2 R_t) / (rho_t v^2 + 2 R_t)), from
    Eqs. 12-13; W as for `normalized_depth`.

    >>> f"{depth_at_velocity(250.0, 500.0, 11e-6, 8900.0, 7850.0, 3.5e9) * 1e6:.4f}"
    '6.3777'
    """
    v, V, rho_p, rho_t, R_t = at_velocity, velocity, particle_density, target_density, resistance
    if v > V:
        return math.nan
    lost = rho_t * (V - v) * (V + v) / (2 * R_t + rho_t * v * v)
    return radius * crater_depth(rho_p / rho_t * math.log1p(lost))


def velocity_at_depth(
    at_depth: float, velocity: float, radius: float, particle_density: float, target_density: float,
    resistance: float,
) -> float:  # fmt: skip
    """Velocity [m/s] at a depth [m], at most the final one.

    v^2 = (V^2 + v_r^2) exp(-2 b W(x/R)) - v_r^2, from Eqs. 12-13; W as for `normalized_depth`,
    b = 3 rho_t / (8 rho_p), v_r^2 = 2 R_t / rho_t.

    Close to rest the velocity varies as the square root of the remaining depth, so that fewer
    digits of the result are correct.

    >>> f"{velocity_at_depth(5e-6, 500.0, 11e-6, 8900.0, 7850.0, 3.5e9):.3f}"
    '353.533'
    """
    V, rho_p, rho_t, R_t = velocity, particle_density, target_density, resistance
    final = normalized_depth(V, rho_p, rho_t, R_t)
    left = (radius * final - at_depth) / radius
    if left < 0:
        return math.nan
    # The area integral from y - left to rest, beyond the radius and within it, in a form without
    # cancellation.
    beyond = min(left, max(final - 1, 0.0))
    y = min(final, 1.0)
    left = min(left - beyond, y)  # from 1e16 radii on, rounding exceeds a radius
    area_integral = beyond + left * (y * (2 - y) - left * (1 - y) - left * left / 3)
    rest_over_impact = 2 * R_t / (rho_t * V * V)
    return V * math.sqrt(rest_over_impact * math.expm1(0.75 * rho_t / rho_p * area_integral))

"""The report's estimates beside the penetration model.

Particle velocity (Eq. 1), strain rate, target resistance and its factor beta by two routes (Eqs.
7-11), centerline stress, the velocity from which on the particle penetrates (Eq. 5), the depth at a
constant pressure, and the Frank-Zook depth of a noneroding penetrator (Eqs. 14-17).
"""

import math

from replication.models.crater import crater_depth


def particle_velocity(average_velocity: float, mass: float, average_mass: float) -> float:
    """V_p = V (m_o / m)^(1/2) [m/s] (Eq. 1): V [m/s], m and m_o in the same unit.

    >>> particle_velocity(500.0, 4.0, 1.0)
    250.0
    """
    return average_velocity * math.sqrt(average_mass / mass)


def strain_rate(velocity: float, length: float) -> float:
    """Estimate V / L [1/s] (section 3): impact velocity [m/s] over a typical dimension [m].

    >>> f"{strain_rate(500.0, 20e-6):.1e}"
    '2.5e+07'
    """
    return velocity / length


def target_resistance(beta: float, flow_stress: float) -> float:
    """R_t = beta Y_t [Pa] (Eqs. 7, A-2); beta [1], flow stress Y_t [Pa].

    >>> target_resistance(5.0, 700e6)
    3500000000.0
    """
    return beta * flow_stress


def goodier_beta(q_over_flow_stress: float) -> float:
    """Goodier: beta = 4 (q / Y_t) / pi [1], from F_r = q (2a)^2 = pi a^2 R_t (Eqs. 8-9 with n = 2).

    q_over_flow_stress q / Y_t [1], 2.77 in section 3. The relative error is below 1e-15.

    >>> f"{goodier_beta(2.77):.1f}"
    '3.5'
    """
    return 4 * q_over_flow_stress / math.pi


def walker_anderson_alpha(elastic_modulus: float, flow_stress: float) -> float:
    """Extent of the plastic zone, alpha = (2 E_t / 3 Y_t)^(1/3) [1] (Eq. 11); both in [Pa].

    The relative error is below 1e-15.

    >>> f"{walker_anderson_alpha(200e9, 215e6):.1f}"
    '8.5'
    """
    return math.cbrt(2 * elastic_modulus / (3 * flow_stress))


def walker_anderson_beta(alpha: float) -> float:
    """Walker and Anderson: beta = 7/3 ln(alpha) [1] (Eq. 10).

    alpha [1] is the extent of the plastic zone (`walker_anderson_alpha`), which is above 1.
    The relative error is below 1e-15.

    >>> f"{walker_anderson_beta(walker_anderson_alpha(200e9, 215e6)):.1f}"
    '5.0'
    """
    return 7 / 3 * math.log(alpha)


def centerline_stress(target_density: float, velocity: float, resistance: float) -> float:
    """Axial stress Sigma = rho_t v^2 / 2 + R_t [Pa] of a rigid particle (Eqs. 5-6, v = u).

    By Eq. 5 it is also the least particle strength Y_p [Pa] at which the particle stays rigid.

    >>> f"{centerline_stress(7850.0, 500.0, 3.5e9) / 1e9:.2f}"
    '4.48'
    """
    return target_density * velocity * velocity / 2 + resistance


def penetration_threshold(
    particle_strength: float, resistance: float, particle_density: float
) -> float:
    """Impact velocity [m/s] above which the particle penetrates at all, by Eq. 5 (Tate).

    At the threshold the penetration velocity u is 0, so that rho_p v^2 / 2 + Y_p = R_t, and
    v = sqrt(2 (R_t - Y_p) / rho_p). Slower particles only flatten. If the particle's strength Y_p
    is R_t or more, every velocity penetrates, and the threshold is 0. Y_p and R_t [Pa], rho_p
    [kg/m^3]. The threshold says nothing of a depth. Its relative error is below 1e-15.

    >>> f"{penetration_threshold(90e6, 3.5e9, 8900.0):.0f}"  # annealed copper, beta = 5
    '875'
    """
    lacking = max(resistance - particle_strength, 0.0)
    return math.sqrt(2 * lacking / particle_density)


def constant_pressure_depth(
    velocity: float, radius: float, particle_density: float, resistance: float
) -> float:
    """Final depth X [m] at a pressure that is R_t throughout: Eq. 13 without the target's inertia.

    The work R_t CV is the particle's energy rho_p PV V^2 / 2, so CV/PV = rho_p V^2 / 2 R_t, and
    Eqs. 2 and 3 give the depth. It is the limit of `final_depth` for a target without density, and
    so the deepest crater at this resistance. V [m/s], R [m], rho_p [kg/m^3], R_t [Pa]. The relative
    error is below 1e-15.

    >>> f"{constant_pressure_depth(500.0, 11e-6, 8900.0, 3.5e9) / 11e-6:.3f}"
    '0.752'
    """
    return crater_depth(particle_density * velocity * velocity / (2 * resistance), radius)


def frank_zook_as_printed(
    length_ratio: float, particle_density: float, target_density: float, k_1: float, k_t: float,
    resistance: float, velocity: float,
) -> float:  # fmt: skip
    """X/R [1] as Eq. 16 prints it.

    length_ratio L/D [1], densities [kg/m^3], k_1 and k_t [1], R_t [Pa], V [m/s].

    >>> f"{frank_zook_as_printed(2 / 3, 8900.0, 7850.0, 0.557, 1.046, 9.13e9, 500.0):.3f}"
    '0.127'
    """
    inertia = (length_ratio * particle_density / target_density + k_1) / (2 * k_t)
    return inertia * math.log1p(k_t * target_density * velocity * velocity / resistance)


def frank_zook_derived(
    length_ratio: float, particle_density: float, target_density: float, k_1: float, k_t: float,
    resistance: float, velocity: float,
) -> float:  # fmt: skip
    """X/R [1] derived from Eqs. 14 and 15: twice the right side of Eq. 16, as R = D/2.

    -(L rho_p + k_1 rho_t D) dv/dt = k_t rho_t v^2 + R_t, integrated from V to rest, gives the right
    side of Eq. 16 for the depth in *diameters*. The inputs are those of `frank_zook_as_printed`.

    >>> f"{frank_zook_derived(2 / 3, 8900.0, 7850.0, 0.557, 1.046, 9.13e9, 500.0):.3f}"
    '0.255'
    """
    inputs = length_ratio, particle_density, target_density, k_1, k_t, resistance, velocity
    return 2 * frank_zook_as_printed(*inputs)


def frank_zook_depth_as_printed(
    velocity: float, radius: float, particle_density: float, target_density: float,
    resistance: float, length_ratio: float, k_1: float, k_t: float,
) -> float:  # fmt: skip
    """X [m] as Eq. 16 prints X/R; the inputs are those of `frank_zook_depth`."""
    inputs = length_ratio, particle_density, target_density, k_1, k_t, resistance, velocity
    return radius * frank_zook_as_printed(*inputs)


def frank_zook_depth(
    velocity: float, radius: float, particle_density: float, target_density: float,
    resistance: float, length_ratio: float, k_1: float, k_t: float,
) -> float:  # fmt: skip
    """Final depth X [m] of a noneroding penetrator by Frank and Zook, derived from Eqs. 14 and 15.

    X = D (L/D rho_p/rho_t + k_1) / (2 k_t) ln(1 + k_t rho_t V^2 / R_t), D = 2R. V [m/s], R [m],
    rho_p and rho_t [kg/m^3], R_t [Pa]; L/D, k_1 and k_t [1]. The relative error is below 2e-15.

    >>> X = frank_zook_depth(500.0, 11e-6, 8900.0, 7850.0, 9.13e9, 2 / 3, 0.557, 1.046)
    >>> f"{X / 11e-6:.3f}"
    '0.255'
    """
    inputs = length_ratio, particle_density, target_density, k_1, k_t, resistance, velocity
    return radius * frank_zook_derived(*inputs)


def sphere_length_ratio(length_ratio: float = 1.0) -> float:
    """L/D [1] of the cylinder with the sphere's mass and diameter (section 3): 2/3.

    From (pi / 6) D^3 = (pi / 4) D^2 L. `length_ratio` is L/D of the cylinder around the sphere, 1.

    >>> sphere_length_ratio() == 2 / 3
    True
    """
    return (1 / 6) / (1 / 4) * length_ratio

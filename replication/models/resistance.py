"""Target resistance and its factor beta by two routes (Eqs. 7-11), and the centerline stress."""

import math


def target_resistance(beta: float, flow_stress: float) -> float:
    """R_t = beta Y_t [Pa] (Eqs. 7, A-2); beta [1], flow stress Y_t [Pa].

    >>> target_resistance(5.0, 700e6)
    3500000000.0
    """
    return beta * flow_stress


def goodier_beta(q_over_flow_stress: float) -> float:
    """Goodier: beta = 4 (q / Y_t) / pi [1], from F_r = q (2a)^2 = pi a^2 R_t (Eqs. 8-9 with n = 2).

    >>> f"{goodier_beta(2.77):.1f}"
    '3.5'
    """
    return 4 * q_over_flow_stress / math.pi


def walker_anderson_alpha(elastic_modulus: float, flow_stress: float) -> float:
    """Extent of the plastic zone, alpha = (2 E_t / 3 Y_t)^(1/3) [1] (Eq. 11); both in [Pa].

    >>> f"{walker_anderson_alpha(200e9, 215e6):.1f}"
    '8.5'
    """
    return math.cbrt(2 * elastic_modulus / (3 * flow_stress))


def walker_anderson_beta(alpha: float) -> float:
    """beta = 7/3 ln(alpha) [1] (Eq. 10).

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

"""The Frank-Zook depth of a noneroding penetrator (Eqs. 14-17), derived and as printed.

Eqs. 14 and 15 give -(L rho_p + k_1 rho_t D) dv/dt = k_t rho_t v^2 + R_t. Integrated from V to rest
this is X/D = ((L/D) (rho_p/rho_t) + k_1) / (2 k_t) ln(1 + k_t rho_t V^2 / R_t): the right side of
Eq. 16, but for the depth in *diameters*. Eq. 16 prints X/R in front of it. Both readings are here.
"""

import math


def depth_as_printed(
    length_ratio: float, particle_density: float, target_density: float, k_1: float, k_t: float,
    resistance: float, velocity: float,
) -> float:  # fmt: skip
    """X/R [1] as Eq. 16 prints it.

    length_ratio L/D [1], densities [kg/m^3], k_1 and k_t [1], R_t [Pa], V [m/s].

    >>> f"{depth_as_printed(2 / 3, 8900.0, 7850.0, 0.557, 1.046, 9.13e9, 500.0):.3f}"
    '0.127'
    """
    inertia = (length_ratio * particle_density / target_density + k_1) / (2 * k_t)
    return inertia * math.log1p(k_t * target_density * velocity * velocity / resistance)


def depth_derived(*inputs: float, **named: float) -> float:
    """X/R [1] as it follows from Eqs. 14 and 15: twice the right side of Eq. 16, as R = D/2.

    >>> f"{depth_derived(2 / 3, 8900.0, 7850.0, 0.557, 1.046, 9.13e9, 500.0):.3f}"
    '0.255'
    """
    return 2 * depth_as_printed(*inputs, **named)


def sphere_length_ratio() -> float:
    """L/D [1] of the cylinder of the sphere's mass and diameter (section 3): 2/3.

    >>> sphere_length_ratio() == 2 / 3
    True
    """
    # (pi / 6) D^3 = (pi / 4) D^2 L
    return (1 / 6) / (1 / 4)

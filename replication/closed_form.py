"""Final depth without time steps: Eq. 13 separated and integrated once."""

from typing import Any

import numpy as np

from replication.sphere import depth_from_volume_ratio

__all__ = ["final_depth", "normalized_depth"]


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
    pressure_ratio = target_density * velocity * velocity / 2 / resistance
    c = 4 * particle_density / (3 * target_density) * np.log1p(pressure_ratio)
    shallow = depth_from_volume_ratio(np.minimum(0.75 * c, 0.5))
    return np.where(c <= 2 / 3, shallow, 1 / 3 + c)[()]


def final_depth(
    velocity: Any, radius: Any, particle_density: Any, target_density: Any, resistance: Any
) -> Any:
    """Penetration depth at rest [m]: R times `normalized_depth`; radius R [m], all broadcast.

    >>> f"{final_depth(500.0, 11e-6, 8900.0, 7850.0, 2.1e9) * 1e6:.2f}"
    '10.04'
    """
    return radius * normalized_depth(velocity, particle_density, target_density, resistance)

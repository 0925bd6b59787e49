"""Particles in the gas stream: velocity against mass (Eq. 1), and the strain rate of an impact."""

import math


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

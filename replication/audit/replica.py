"""The replica's answer to each computation that the ledger names, in IEEE doubles.

The same names as `reference.computations`, answered by the models of this package: the two are
written separately and the audit compares them.
"""

import math
from collections.abc import Callable

import numpy as np

from replication.models import crater, frank_zook, resistance, stream
from replication.models.impact import Impact
from replication.models.sheet import deceleration, run

__all__ = ["REPLICA"]


def _impact(
    velocity: float,
    radius: float,
    particle_density: float,
    target_density: float,
    resistance: float,
    step: float = 2e-10,
    stop_velocity: float = 1.0,
) -> Impact:
    return Impact(
        velocity=velocity,
        radius=radius,
        particle_density=particle_density,
        target_density=target_density,
        resistance=resistance,
        step=step,
        stop_velocity=stop_velocity,
    )


def _cell(column: str) -> Callable[..., float]:
    """The cell of one column in the given row of the sheet."""

    def cell(row: int, **inputs: float) -> float:
        return float(getattr(run(_impact(**inputs)).rows[row], column))

    return cell


def _depth(**inputs: float) -> float:
    return run(_impact(**inputs)).final_depth


def _normalized_depth(**inputs: float) -> float:
    return run(_impact(**inputs)).normalized_depth


def _deceleration_at_touch(impact: Impact) -> float:
    target = impact.target_density, impact.target_resistance
    return deceleration(0.0, impact.velocity, impact.radius, impact.mass, *target)


def _betas(
    q: float, elastic_modulus: float, flow_stress: float, hardness_ratio: float
) -> tuple[float, ...]:
    alpha = resistance.walker_anderson_alpha(elastic_modulus, flow_stress)
    return (
        float(resistance.goodier_beta(q)),
        float(resistance.walker_anderson_beta(alpha)),
        float(resistance.brinell_beta(hardness_ratio)),
    )


REPLICA: dict[str, Callable[..., float]] = {
    "same_as": lambda value: value,
    "ratio": lambda numerator, denominator: numerator / denominator,
    "half": lambda value: value / 2,
    "twice": lambda value: 2 * value,
    "count": lambda **values: float(len(values)),
    "cap_volume_factor": lambda: crater.cap_volume(1.0, 1.0) / (2 * math.pi),
    "cap_volume_power": lambda: math.log2(
        crater.cap_volume(0.25, 1.0) / 2.75 / (crater.cap_volume(0.125, 1.0) / 2.875)
    ),
    "cap_volume_offset": lambda: 3 * crater.cap_volume(1.0, 1.0) / math.pi + 1,
    "sphere_volume_factor": lambda: crater.volume(1.0) / math.pi,
    "sphere_volume_power": lambda: math.log2(crater.volume(2.0) / crater.volume(1.0)),
    "contact_area_power": lambda: math.log2(_missing_area(0.25) / _missing_area(0.125)),
    "sphere_length_ratio": frank_zook.sphere_length_ratio,
    "sphere_volume": lambda diameter: crater.volume(diameter / 2),
    "crater_normalized_depth": lambda volume_ratio: crater.depth_from_volume_ratio(volume_ratio),
    "crater_depth": lambda volume_ratio, diameter: (
        crater.depth_from_volume_ratio(volume_ratio) * diameter / 2
    ),
    "crater_depth_over_diameter": lambda volume_ratio: (
        crater.depth_from_volume_ratio(volume_ratio) / 2
    ),
    "contact_diameter": crater.contact_diameter,
    "target_resistance": resistance.target_resistance,
    "goodier_beta": lambda q: resistance.goodier_beta(q),
    "walker_anderson_alpha": resistance.walker_anderson_alpha,
    "walker_anderson_beta": lambda elastic_modulus, flow_stress: resistance.walker_anderson_beta(
        resistance.walker_anderson_alpha(elastic_modulus, flow_stress)
    ),
    "least_beta": lambda **inputs: min(_betas(**inputs)),
    "greatest_beta": lambda **inputs: max(_betas(**inputs)),
    "strain_rate": stream.strain_rate,
    "particle_mass": lambda radius, particle_density: crater.volume(radius) * particle_density,
    "row_time": lambda row, step: row * step,
    "row_velocity_initial": _cell("velocity_initial"),
    "row_depth": _cell("depth"),
    "row_deceleration": _cell("deceleration"),
    "row_velocity_final": _cell("velocity_final"),
    "deceleration_at_touch": lambda **inputs: _deceleration_at_touch(_impact(**inputs)),
    "sheet_depth": _depth,
    "sheet_normalized_depth": _normalized_depth,
    "sheet_over_observed": lambda observed, **inputs: _normalized_depth(**inputs) / observed,
    "sheet_excess_over_observed": lambda observed, **inputs: (
        _normalized_depth(**inputs) / observed - 1
    ),
    "frank_zook_as_printed": frank_zook.depth_as_printed,
    "frank_zook_derived": frank_zook.depth_derived,
    "frank_zook_denominator": lambda: _frank_zook_multiple(2.0),
    "frank_zook_denominator_for_diameters": lambda: _frank_zook_multiple(1.0),
    "frank_zook_offset": lambda: math.exp(frank_zook.depth_derived(2 / 3, 1, 1, 1, 1, 1, 0.0)),
}


def _missing_area(x: float) -> float:
    """D x - a^2 of a unit sphere at depth x, from the contact circle's diameter."""
    return 2 * x - float(crater.contact_diameter(x, 2.0)) ** 2 / 4


def _frank_zook_multiple(per_diameter: float) -> float:
    """The multiple of k_t that makes the right side of Eq. 16 the depth in D / per_diameter.

    Against Eqs. 14 and 15 integrated numerically, dx = -L rho_p v dv / Y_p with the unsteady term
    on the left side, in 20 Gauss points.
    """
    length, diameter, particle, target = 2 / 3, 1.0, 8900.0, 7850.0
    k_1, k_t, strength, velocity = 0.557, 1.046, 9.13e9, 500.0
    nodes, weights = np.polynomial.legendre.leggauss(20)
    v = velocity * (1 + nodes) / 2
    inertia = length * particle + k_1 * target * diameter
    depth = velocity / 2 * np.sum(weights * inertia * v / (k_t * target * v * v + strength))
    printed = frank_zook.depth_as_printed(
        length / diameter, particle, target, k_1, k_t, strength, velocity
    )
    return float(2 * printed / (depth * per_diameter / diameter))

"""The models' answer to each computation that the ledger names, in IEEE doubles.

The names are those of the ledger's computations. The ledger's formulas and these models are written
separately, and the audit compares their results.
"""

import math
from collections.abc import Callable, Mapping
from functools import partial

from reference.scheme import Scheme
from replication.models import crater, estimates, sheet
from replication.models.crater import normalized_depth_from_volume_ratio
from replication.models.impact import Impact, particle_mass


def replica(name: str, inputs: Mapping[str, float], **settings: object) -> float:
    """Return what the models give for a computation, in SI units.

    `settings` are the `row` of the sheet and the `scheme`, for computations that take them.

    >>> replica("target_resistance", {"beta": 5.0, "flow_stress": 7e8})
    3500000000.0
    """
    return float(REPLICA[name](**inputs, **settings))


def _cell(column: str, row: int, scheme: Scheme, **inputs: float) -> float:
    return float(getattr(sheet.run(Impact(**inputs), scheme).rows[row], column))


def _deceleration_at_start(depth: float, velocity: float, **inputs: float) -> float:
    impact = Impact(velocity=velocity, **inputs)
    return sheet.deceleration(
        depth, velocity, impact.radius, impact.mass, impact.target_density, impact.target_resistance
    )


def _resisting_force(radius: float) -> float:
    """Return the force [N] on a sphere immersed to depth x = R at a target resistance of 1 Pa."""
    return sheet.deceleration(radius, 0.0, radius, 1.0, 0.0, 1.0)


REPLICA: Mapping[str, Callable[..., float]] = {
    "ratio": lambda numerator, denominator: numerator / denominator,
    "excess": lambda numerator, denominator: numerator / denominator - 1,
    "half": lambda value: value / 2,
    "radius_of": lambda diameter: diameter / 2,
    "diameter_of": lambda radius: 2 * radius,
    "sphere_length_ratio": estimates.sphere_length_ratio,
    "sphere_volume": lambda diameter: crater.volume(diameter / 2),
    "crater_normalized_depth": lambda volume_ratio: normalized_depth_from_volume_ratio(
        volume_ratio
    ),
    "crater_depth_by_diameter": lambda volume_ratio, diameter: (
        normalized_depth_from_volume_ratio(volume_ratio) * diameter / 2
    ),
    "crater_depth_over_diameter": lambda volume_ratio: (
        normalized_depth_from_volume_ratio(volume_ratio) / 2
    ),
    "contact_diameter": crater.contact_diameter,
    "target_resistance": estimates.target_resistance,
    # Force = stress * length^power, so the power is log2 of what doubling the length does.
    "force_power": lambda: math.log2(_resisting_force(2.0) / _resisting_force(1.0)),
    "goodier_beta": lambda q, power: estimates.goodier_beta(q) * 2 ** (power - 2),
    "walker_anderson_alpha": estimates.walker_anderson_alpha,
    "walker_anderson_beta_of_target": lambda **steel: estimates.walker_anderson_beta(
        estimates.walker_anderson_alpha(**steel)
    ),
    "least_beta": lambda **betas: min(betas.values()),
    "greatest_beta": lambda **betas: max(betas.values()),
    "strain_rate": estimates.strain_rate,
    "particle_mass": particle_mass,
    "row_time": lambda row, step: row * step,
    "row_velocity_initial": partial(_cell, "velocity_initial"),
    "row_depth": partial(_cell, "depth"),
    "row_deceleration": partial(_cell, "deceleration"),
    "row_velocity_final": partial(_cell, "velocity_final"),
    "deceleration_at_start": _deceleration_at_start,
    "final_sheet_depth": lambda scheme, **case: sheet.run(Impact(**case), scheme).final_depth,
    "frank_zook_as_printed": estimates.frank_zook_as_printed,
    "frank_zook_derived": estimates.frank_zook_derived,
}

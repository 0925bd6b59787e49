"""The report's computations, re-run in IEEE doubles, and the audit of every number it prints.

The public names are those of `__all__`. Each is imported when it is first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from replication.audit.audit import audit
    from replication.cases import BETA_3, BETA_5
    from replication.models.arrays import (
        constant_pressure_depth,
        crater_depth,
        crater_volume_ratio,
        depth_at_velocity,
        final_depth,
        frank_zook_depth,
        goodier_beta,
        history,
        normalized_depth,
        particle_density_for_depth,
        penetration_threshold,
        radius_for_depth,
        resistance_for_depth,
        run_many,
        stop_time,
        target_density_for_depth,
        time_to_depth,
        velocity_at_depth,
        velocity_for_depth,
        walker_anderson_alpha,
        walker_anderson_beta,
    )
    from replication.models.impact import Impact
    from replication.models.sheet import run

__all__ = [
    "BETA_3",
    "BETA_5",
    "Impact",
    "audit",
    "constant_pressure_depth",
    "crater_depth",
    "crater_volume_ratio",
    "depth_at_velocity",
    "final_depth",
    "frank_zook_depth",
    "goodier_beta",
    "history",
    "normalized_depth",
    "particle_density_for_depth",
    "penetration_threshold",
    "radius_for_depth",
    "resistance_for_depth",
    "run",
    "run_many",
    "stop_time",
    "target_density_for_depth",
    "time_to_depth",
    "velocity_at_depth",
    "velocity_for_depth",
    "walker_anderson_alpha",
    "walker_anderson_beta",
]

_HOMES = {"BETA_3": "cases", "BETA_5": "cases", "Impact": "models.impact", "run": "models.sheet"}


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if name == "audit":  # this package is itself callable
        return import_module(f"{__name__}.audit")
    return getattr(import_module(f"{__name__}.{_HOMES.get(name, 'models.arrays')}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})

"""Flow stress, beta and the strength that a rigid particle would need."""

import math

from replication import closed_form, resistance, sphere
from replication.audit.findings.known import Computed, Known
from replication.impact import BETA_5

__all__ = ["EVIDENCE"]


def _observed_beta(known: Known) -> Computed:
    observed = known.ledger.claims["observed-ratio"]
    assert observed.printed is not None
    greatest = observed.printed.interval(quantum=observed.printed.quanta[-1]).upper
    assert greatest is not None
    p = _pressure_for(known, known.number("observed-ratio"))
    needed = _dynamic_pressure(known) / p
    flow_stress = known.number("flow-stress")
    return {
        "beta": needed / flow_stress,
        "resistance": needed,
        "beta_least": _dynamic_pressure(known)
        / _pressure_for(known, float(greatest))
        / flow_stress,
        "velocity": known.number("a1-initial-velocity")
        * math.sqrt(BETA_5.target_resistance / needed),
        "p": p,
    }


def _pressure_for(known: Known, y: float) -> float:
    """p = rho_t V^2 / 2 R_t at which the exact X/R is y <= 1: y^2 - y^3/3 = c."""
    densities = known.number("inferred:target-density") / known.number("a1-density")
    return math.expm1(float(sphere.volume_ratio(y)) * densities)


def _dynamic_pressure(known: Known) -> float:
    return known.number("inferred:target-density") * known.number("a1-initial-velocity") ** 2 / 2


def _beta_and_flow_stress(known: Known) -> Computed:
    modulus, flow_stress = known.number("elastic-modulus"), known.number("flow-stress")
    alpha = float(resistance.walker_anderson_alpha(modulus, flow_stress))
    beta = float(resistance.walker_anderson_beta(alpha))
    motion = {**BETA_5.motion, "resistance": beta * flow_stress}
    return {
        "alpha_bulk": known.computed("walker-anderson-alpha"),
        "beta_bulk": known.computed("walker-anderson-beta"),
        "alpha": alpha,
        "beta": beta,
        "resistance": beta * flow_stress,
        "ratio": float(closed_form.final_depth(**motion)) / BETA_5.radius,
        "cube": 2 * known.exact("elastic-modulus") / (3 * known.exact("flow-stress")),
    }


def _flow_stress_choice(known: Known) -> Computed:
    feathery, clear = known.exact("strength-feathery"), known.exact("strength-clear")
    choice, bulk = known.exact("flow-stress"), known.exact("strength-bulk")
    return {
        "feathery": feathery,
        "clear": clear,
        "mean": (feathery + clear) / 2,
        "choice": choice,
        "multiple": choice / bulk,
        "bulk": bulk,
        "yield": known.exact("yield-strength"),
        "clear_multiple": clear / bulk,
        "between": clear < choice < feathery,
    }


def _rigid_strength(known: Known) -> Computed:
    copper, pressure = known.number("copper-yield"), _dynamic_pressure(known)
    sigma = {
        beta: float(
            resistance.centerline_stress(
                known.number("inferred:target-density"),
                known.number("a1-initial-velocity"),
                beta * known.number("flow-stress"),
            )
        )
        for beta in (3, 5)
    }
    return {
        "sigma_5": sigma[5],
        "sigma_3": sigma[3],
        "multiple_5": sigma[5] / copper,
        "multiple_3": sigma[3] / copper,
        "more": sigma[5] / (5 * known.number("flow-stress")) - 1,
        "pressure": pressure,
    }


EVIDENCE = {
    "observed-beta": _observed_beta,
    "beta-and-flow-stress": _beta_and_flow_stress,
    "flow-stress-choice": _flow_stress_choice,
    "rigid-strength": _rigid_strength,
}

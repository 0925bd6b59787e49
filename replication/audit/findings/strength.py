"""Flow stress, beta and the strength that a rigid particle would need."""

import math
from fractions import Fraction

from replication.audit.findings.known import Computed, Known, model_ratio
from replication.cases import BETA_5
from replication.models import crater, resistance

__all__ = ["EVIDENCE"]


def _observed_beta(known: Known) -> Computed:
    p = _pressure_for(known, known.number("observed-ratio"))
    needed = _dynamic_pressure(known) / p
    least, greatest = known.ledger.claims["observed-ratio"].target.ends
    velocity = known.number("a1-initial-velocity")
    return {
        "beta": needed / known.number("flow-stress"),
        "resistance": needed,
        "beta_least": _beta_for(known, float(greatest)),
        "beta_greatest": _beta_for(known, float(least)),
        "velocity": velocity * math.sqrt(BETA_5.target_resistance / needed),
        "p": p,
        "density": _prints_the_same(known),
    }


def _beta_for(known: Known, y: float) -> float:
    return _dynamic_pressure(known) / _pressure_for(known, y) / known.number("flow-stress")


def _prints_the_same(known: Known) -> bool:
    """Whether X/R at beta = 5 prints as the report's for every admitted target density."""
    claim = known.ledger.claims["ratio-beta-5"]
    return claim.target.encloses(*known.reading(claim.id).enclosure)


def _pressure_for(known: Known, y: float) -> float:
    """p = rho_t V^2 / 2 R_t at which the exact X/R is y <= 1: y^2 - y^3/3 = c."""
    densities = known.number("inferred:target-density") / known.number("a1-density")
    return math.expm1(float(crater.volume_ratio(y)) * densities)


def _dynamic_pressure(known: Known) -> float:
    return known.number("inferred:target-density") * known.number("a1-initial-velocity") ** 2 / 2


def _beta_and_flow_stress(known: Known) -> Computed:
    modulus, flow_stress = known.number("elastic-modulus"), known.number("flow-stress")
    alpha = float(resistance.walker_anderson_alpha(modulus, flow_stress))
    beta = float(resistance.walker_anderson_beta(alpha))
    return {
        "alpha_bulk": known.computed("walker-anderson-alpha"),
        "beta_bulk": known.computed("walker-anderson-beta"),
        "alpha": alpha,
        "beta": beta,
        "resistance": beta * flow_stress,
        "ratio": model_ratio(resistance=beta * flow_stress),
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


def _unlike_strengths(known: Known) -> Computed:
    steel, code = known.number("autodyne-steel-yield"), known.number("autodyne-ratio")
    found: dict[str, Fraction | float | bool] = {}
    for name, beta in (("low", 3), ("high", 5)):
        ratio = model_ratio(resistance=known.number(f"depth-beta-{beta}-beta") * steel)
        printed = known.exact(f"ratio-beta-{beta}") / known.exact("autodyne-ratio")
        found |= {name: ratio, f"times_{name}": ratio / code, f"printed_{name}": printed}
    return found


def _autodyne_cells(known: Known) -> Computed:
    cell = known.exact("autodyne-least-length") / (known.exact("autodyne-diameter") / 2)
    ratio = known.exact("autodyne-ratio")
    return {
        "cell": cell,
        "cells": ratio / cell,
        "gap_cth": (ratio - known.exact("cth-ratio")) / cell,
        "gap": (ratio - known.exact("observed-ratio")) / cell,
    }


EVIDENCE = {
    "observed-beta": _observed_beta,
    "beta-and-flow-stress": _beta_and_flow_stress,
    "flow-stress-choice": _flow_stress_choice,
    "rigid-strength": _rigid_strength,
    "unlike-strengths": _unlike_strengths,
    "autodyne-cells": _autodyne_cells,
}

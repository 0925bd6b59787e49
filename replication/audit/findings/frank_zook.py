"""Eq. 16, and the two numbers that are said to come from it."""

import math
from fractions import Fraction

from reference.enclosure import explore
from reference.exact import Arithmetic, Number, cap_volume
from reference.printed import Interval
from replication import frank_zook
from replication.audit.entries import function_of, rounding
from replication.audit.findings.known import Computed, Known, known_interval, model_ratio
from replication.audit.inference import infer
from replication.impact import BETA_3, BETA_5

__all__ = ["EVIDENCE"]

_DERIVED = "derived from Eqs. 14 and 15"


def _equation_16(known: Known) -> Computed:
    diameters = "the multiple for X/D on the left side"
    off: dict[str, float] = {}
    for name in ("rha", "stainless"):
        claim = f"frank-zook-{name}"
        off[f"off_{name}"] = known.computed(claim, _DERIVED) / known.number(claim) - 1
        off[f"half_{name}"] = known.computed(claim) / known.number(claim) - 1
    return {
        "radius": known.reading("eq16-denominator").enclosure[0],
        "diameter": known.reading("eq16-denominator", diameters).enclosure[0],
        "printed_rha": known.computed("frank-zook-rha"),
        "printed_stainless": known.computed("frank-zook-stainless"),
        "derived_rha": known.computed("frank-zook-rha", _DERIVED),
        "derived_stainless": known.computed("frank-zook-stainless", _DERIVED),
        "inertia": _inertia(known),
        **off,
    }


def _inertia(known: Known) -> Fraction:
    """L/D rho_p/rho_t + k_1."""
    densities = known.exact("a1-density") / known.exact("inferred:target-density")
    return known.exact("sphere-length-ratio") * densities + known.exact("fz-k1")


def _drag(known: Known) -> Fraction:
    """z = k_t rho_t V^2 [Pa]."""
    density, velocity = known.exact("inferred:target-density"), known.exact("a1-initial-velocity")
    return known.exact("fz-kt") * density * velocity**2


def _log_ratio(ar: Arithmetic, drag: Number, armor: Number, stainless: Number) -> Number:
    """X/R at one target resistance over X/R at the other; drag is k_t rho_t V^2, all in Pa."""
    return ar.context.log(1 + drag / stainless) / ar.context.log(1 + drag / armor)


def _pair(known: Known) -> Computed:
    lower, upper = (known.ledger.claims[f"frank-zook-{name}"] for name in ("rha", "stainless"))
    (low, high), (least, greatest) = known_interval(lower.interval), known_interval(upper.interval)
    printed = Interval(least / high, greatest / low)
    strengths = {
        key: rounding(known.ledger, f"fz-resistance-{name}", loose=True)
        for key, name in (("armor", "rha"), ("stainless", "stainless"))
    }
    drag = _possible_drag(known)
    found = explore(_log_ratio, {"drag": drag, **strengths}, printed)
    # Octave by octave, as the ratio's two logarithms both vanish with the drag.
    octaves = [(_BOUND / 2 ** (k + 1), _BOUND / 2**k) for k in range(_OCTAVES)]
    excluded = all(
        explore(_log_ratio, {"drag": ends, **strengths}, printed).never for ends in octaves
    )
    z = float(_drag(known))
    armor, stainless = (known.number(f"fz-resistance-{name}") for name in ("rha", "stainless"))
    fastest = known.number("a1-initial-velocity") * math.sqrt(_BOUND / drag[1])
    return {
        "printed": greatest / low,
        "least": found.lower,
        "velocity": fastest if excluded else 0.0,
        "z": z,
        "hand": (armor + z) / (stainless + z),
        "times": _drag_for(float(greatest / low), armor, stainless) / z,
    }


def _drag_for(ratio: float, armor: float, stainless: float) -> float:
    """The drag [Pa] at which the logarithms have this ratio, which falls with it: by bisection."""
    low, high = 1e6, 1e15
    for _ in range(100):
        middle = math.sqrt(low * high)
        above = math.log1p(middle / stainless) > ratio * math.log1p(middle / armor)
        low, high = (middle, high) if above else (low, middle)
    return low


_BOUND = Fraction(60 * 10**9)
_OCTAVES = 12
"""The drags of which `explore` proves that they cannot give the pair; no results themselves."""


def _possible_drag(known: Known) -> tuple[Fraction, Fraction]:
    """Least and greatest k_t rho_t V^2 [Pa] of inputs that print like the report's."""
    k_t, velocity = (rounding(known.ledger, name) for name in ("fz-kt", "a1-initial-velocity"))
    density = known_interval(infer(known.ledger, "target-density").possible)
    low, high = (k_t[end] * density[end] * velocity[end] ** 2 for end in (0, 1))
    return low, high


def _values(known: Known) -> Computed:
    k_t, z = known.number("fz-kt"), float(_drag(known))
    wanted = {
        name: known.number(f"frank-zook-{name}") * k_t / float(_inertia(known))
        for name in ("rha", "stainless")
    }
    found: dict[str, Fraction | float | bool] = {}
    for name, logarithm in wanted.items():
        strength = known.number(f"fz-resistance-{name}")
        found[f"{name}_resistance"] = z / math.expm1(logarithm)
        found[f"{name}_velocity"] = known.number("a1-initial-velocity") * math.sqrt(
            strength * math.expm1(logarithm) / z
        )
    alone = [_within_rounding(known, f"frank-zook-{name}") for name in wanted]
    return {**found, "rounding": any(alone), "inertia": _inertia(known), "logarithm": wanted["rha"]}


def _within_rounding(known: Known, name: str) -> bool:
    """Whether some input, alone and within its printed digits, may give the claim's number."""
    ledger, claim = known.ledger, known.ledger.claims[name]
    target = Interval(*known_interval(claim.interval))
    entries = {entry for names in claim.inputs.values() for entry in names}
    boxes = {e: rounding(ledger, e) for e in entries if not e.startswith("inferred:")}
    boxes["inferred:target-density"] = known_interval(infer(ledger, "target-density").possible)
    return not all(
        explore(function_of(ledger, claim, function, frozenset({e})), {e: ends}, target).never
        for function in claim.functions.values()
        for e, ends in boxes.items()
    )


def _closest(known: Known) -> Computed:
    observed = known.number("observed-depth-ratio")
    claims = ("frank-zook-rha", "frank-zook-stainless")
    model = (known.computed(f"ratio-beta-{beta}") for beta in (3, 5))
    return {
        "far_printed": max(abs(known.number(c) - observed) for c in claims),
        "far_derived": max(abs(known.computed(c, _DERIVED) - observed) for c in claims),
        "far_cth": known.number("cth-ratio") - observed,
        "far_autodyne": known.number("autodyne-ratio") - observed,
        "far_model": min(model) - observed,
        "far_as_printed": max(abs(known.computed(c) - observed) for c in claims),
    }


def _sphere_equivalent(known: Known) -> Computed:
    ratio = cap_volume(Fraction(2), Fraction(1)) / 2
    long = known.number("circumscribed-length-ratio")
    width = float(ratio / known.exact("circumscribed-length-ratio")) ** (1 / 3)
    found = {
        name: _derived(known, known.number(f"fz-resistance-{name}"), long)
        for name in ("rha", "stainless")
    }
    return {
        "ratio": ratio,
        "diameter": width,
        **{f"long_{name}": depth for name, depth in found.items()},
        # Of a narrower cylinder the depth in its own radii, in radii of the sphere.
        **{f"narrow_{name}": depth * width for name, depth in found.items()},
    }


def _derived(known: Known, resistance: float, length_ratio: float) -> float:
    """X/R from Eqs. 14 and 15."""
    names = ("a1-density", "inferred:target-density", "fz-k1", "fz-kt")
    materials = [known.number(name) for name in names]
    velocity = known.number("a1-initial-velocity")
    return float(frank_zook.depth_derived(length_ratio, *materials, resistance, velocity))


def _two_resistances(known: Known) -> Computed:
    ratio = known.number("sphere-length-ratio")
    return {
        "fz_low": _derived(known, BETA_3.target_resistance, ratio),
        "fz_high": _derived(known, BETA_5.target_resistance, ratio),
        "model_stainless": model_ratio(resistance=known.number("fz-resistance-stainless")),
        "model_rha": model_ratio(resistance=known.number("fz-resistance-rha")),
    }


EVIDENCE = {
    "frank-zook-pair": _pair,
    "equation-16": _equation_16,
    "frank-zook-values": _values,
    "closest-approach": _closest,
    "sphere-equivalent": _sphere_equivalent,
    "two-resistances": _two_resistances,
}

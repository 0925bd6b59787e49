"""Eq. 16, and the two numbers that are said to come from it."""

import math
from fractions import Fraction

from reference.conjectures import load
from reference.enclosure import explore
from reference.exact import cap_volume
from reference.printed import Interval
from reference.slips import equation_16_ratio
from replication.audit.entries import rounding
from replication.audit.explanations import Explanation, explain_claim
from replication.audit.explanations.joint import consistency
from replication.audit.findings.known import Computed, Known, model_ratio
from replication.audit.inference import possible
from replication.audit.verdict import Verdict
from replication.cases import BETA_3, BETA_5
from replication.models import frank_zook

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


def _pair(known: Known) -> Computed:
    lower, upper = (known.ledger.claims[f"frank-zook-{name}"] for name in ("rha", "stainless"))
    (low, high), (least, greatest) = lower.target.ends, upper.target.ends
    printed = Interval(least / high, greatest / low)
    strengths = {
        key: rounding(known.ledger, f"fz-resistance-{name}", loose=True)
        for key, name in (("one", "rha"), ("other", "stainless"))
    }
    drag = _possible_drag(known)
    found = explore(equation_16_ratio, {"common": drag, **strengths}, printed)
    question = next(q for q in load().joint if q.id == "frank-zook-pair")
    assert question.ratio is not None
    impossible = consistency(known.ledger, question).outcome == "impossible"
    z = float(_drag(known))
    armor, stainless = (known.number(f"fz-resistance-{name}") for name in ("rha", "stainless"))
    searched = question.ratio.common[1] / drag[1]
    fastest = known.number("a1-initial-velocity") * math.sqrt(searched)
    return {
        "printed": greatest / low,
        "least": found.lower,
        "velocity": fastest if impossible else 0.0,
        "z": z,
        "nominal": math.log1p(z / stainless) / math.log1p(z / armor),
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


def _possible_drag(known: Known) -> tuple[Fraction, Fraction]:
    """Least and greatest k_t rho_t V^2 [Pa] of inputs that print like the report's."""
    names = ("fz-kt", "inferred:target-density", "a1-initial-velocity")
    k_t, density, velocity = (possible(known.ledger, name) for name in names)
    low, high = (k_t[end] * density[end] * velocity[end] ** 2 for end in (0, 1))
    return low, high


def _values(known: Known) -> Computed:
    rha, stainless = (
        explain_claim(known.ledger, f"frank-zook-{name}") for name in ("rha", "stainless")
    )
    tried = rha.alternatives
    assert tried is not None
    logarithm = known.number("frank-zook-rha") * known.number("fz-kt") / float(_inertia(known))
    edits = [{(m.what, m.edit.text) for m in of.misprints} for of in (rha, stainless)]
    return {
        **_back_solved("rha", rha),
        **_back_solved("stainless", stainless),
        "rounding": any(solved.rounding for of in (rha, stainless) for solved in of.back_solved),
        "together": known.reading("frank-zook-stainless", _DERIVED).verdict is _WITHIN,
        "never": all(
            known.reading("frank-zook-rha", form).verdict is Verdict.NOT_REPRODUCED
            for form in ("", _DERIVED)
        ),
        "misprints_rha": Fraction(len(rha.misprints)),
        "misprints": Fraction(len(stainless.misprints)),
        "both": Fraction(len(edits[0] & edits[1])),
        "readings": Fraction(len(tried.tried)),
        "explain_both": any(a.explains_all is not False for a in tried.tried),
        "inertia": _inertia(known),
        "logarithm": logarithm,
    }


_WITHIN = Verdict.WITHIN_ROUNDING

_SYMBOLS = {
    "a1-initial-velocity": "velocity",
    "sphere-length-ratio": "length",
    "fz-k1": "k_1",
    "fz-kt": "k_t",
    "a1-density": "density",
    "inferred:target-density": "target",
    "fz-resistance-rha": "resistance",
    "fz-resistance-stainless": "resistance",
}


def _back_solved(name: str, explanation: Explanation) -> dict[str, float]:
    """The value of each input that alone gives the number, in the form as derived."""
    values = {b.entry: b.value for b in explanation.back_solved if b.reading == _DERIVED}
    found = {f"{name}_{_SYMBOLS[entry]}": value for entry, value in values.items()}
    return {key: value for key, value in found.items() if value is not None}


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
    particle, target, k_1, k_t = (known.number(name) for name in names)
    velocity = known.number("a1-initial-velocity")
    materials = particle, target, k_1, k_t, resistance
    return frank_zook.depth_derived(length_ratio, *materials, velocity)


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

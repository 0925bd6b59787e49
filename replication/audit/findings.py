"""The evidence of every finding, computed anew from the ledger, the verdicts and the models."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import cache, partial
from statistics import NormalDist
from typing import Any

from reference import findings as asserted
from reference.arithmetic import Number
from reference.enclosure import enclose, holding, solve
from reference.ledger import INFERRED, Claim, Convention, Ledger, claims_of_case
from reference.printed import Interval
from reference.units import to_si
from replication.audit import record as r
from replication.audit import wording
from replication.audit.explain import Explainer
from replication.audit.verdict import Assessment, Judge, Reading, Verdict, assess_equation
from replication.models import crater, depth, frank_zook, resistance, sheet, stream
from replication.models.impact import Impact

Evidence = Mapping[str, Fraction | float | bool]
"""Evidence by name, in SI units."""

_DENSITY = INFERRED + "target-density"
_DERIVED = "derived from Eqs. 14 and 15"
_MEAN_DEVIATION = math.sqrt(2 / math.pi)
"""Mean absolute deviation of a normal distribution over its standard deviation."""


class Known:
    """What the evidence is computed from: a ledger and the verdicts on it, each computed once."""

    def __init__(self, ledger: Ledger, *, every_convention: bool = True) -> None:
        self.ledger = ledger
        self.judge = Judge(ledger, every_convention=every_convention)
        self.explainer = Explainer(self.judge)
        self.equation = cache(partial(assess_equation, ledger))
        self.assessment = cache(self._assess)
        self.shown = cache(self.explainer.shown)

    def _assess(self, claim: Claim) -> Assessment:
        """The verdict on one claim, and why."""
        if claim.kind == "remark":
            return Assessment(Verdict.REMARK, wording.REMARK)
        if claim.within is None and claim.computation is not None:
            assessed = self.judge.assess(claim)
            return replace(assessed, reason=wording.explanation(self.judge, claim, assessed))
        reason, constant = "", None
        if claim.within is not None:
            constant = self.equation(claim.within).constants.get(claim.id)
        if constant is not None:
            reason = wording.constant_explanation(self.ledger, claim, constant)
            if constant.verdict != Verdict.NOT_CHECKABLE:
                return Assessment(Verdict(constant.verdict), reason)
        if sources := self.sources(claim):
            agrees = any(source.agrees for source in sources)
            verdict = Verdict.AGREES if agrees else Verdict.DIFFERS
            return Assessment(verdict, reason or wording.sources(sources))
        if claim.shown_by:
            shown = self.shown(claim)
            verdict = Verdict.INCONSISTENT if shown is None else Verdict.CONSISTENT
            return Assessment(verdict, reason or wording.chosen(shown))
        undecided = f"Nothing in the report decides it: {claim.given}."
        return Assessment(Verdict.NOT_CHECKABLE, reason or undecided)

    def sources(self, claim: Claim) -> list[r.SourceRecord]:
        """The public sources for a claim, and whether each agrees with it."""
        return [
            r.filled(r.SourceRecord, source, agrees=claim.target().meets(source.interval))
            for source in self.ledger.sources.values()
            if claim.id in source.claims
        ]

    def target(self, claim: str) -> Interval:
        """What agrees with a claim, in SI."""
        return self.ledger.claims[claim].target()

    def exact(self, name: str) -> Fraction:
        """A claim as printed, an inferred input as assumed, or a source's number, in SI."""
        sources = self.ledger.sources
        return sources[name].value if name in sources else self.judge.value(name)

    def __getitem__(self, name: str) -> float:
        """The same as a double."""
        return float(self.exact(name))

    def reading(self, claim: str, name: str = "") -> Reading:
        """One reading of a claim. Raises ArithmeticError where it has no value."""
        for reading in self.assessment(self.ledger.claims[claim]).readings:
            if reading.name == name:
                return reading
        raise ArithmeticError(f"{claim} has no value")

    def computed(self, claim: str, reading: str = "") -> float:
        """What a reading makes of a claim, in SI."""
        return self.reading(claim, reading).computed * float(self.ledger.claims[claim].si)


def case(known: Known, beta: int, **changed: float) -> Impact:
    """One of the report's two cases, with some inputs changed (SI)."""
    inputs = {name: known[claim] for name, claim in claims_of_case(beta).items()}
    if "resistance" in changed:
        del inputs["beta"], inputs["flow_stress"]
    return Impact(**{**inputs, **changed})


def exact_ratio(impact: Impact) -> float:
    """The model's exact X/R [1]."""
    return depth.final_depth(**impact.motion) / impact.radius


def _headline(known: Known) -> Evidence:
    claims = known.ledger.claims
    model = [c for c in claims.values() if c.cell and c.computation and not c.computation.restates]
    model += [claims[f"{what}-beta-{beta}"] for what in ("depth", "ratio") for beta in (3, 5)]
    pair = [claims[f"frank-zook-{name}"] for name in ("rha", "stainless")]
    return {
        "model": all(known.assessment(c).verdict is Verdict.REPRODUCED for c in model),
        "pair": all(known.assessment(c).verdict is Verdict.NOT_REPRODUCED for c in pair),
        "together": _least_ratio(known, choices_exact=False) <= _printed_ratio(known)[1],
        "factor": _factor(known),
    }


# Frank and Zook


def _factor(known: Known) -> Fraction:
    """Derived right side of Eq. 16 over the printed one; 0 where that is no number."""
    factor = known.equation("eq16").factor
    return Fraction(0) if factor is None else 1 / factor


def _drag(known: Known) -> float:
    """k_t rho_t V^2 [Pa] at the inputs as printed."""
    return known["fz-kt"] * known[_DENSITY] * known["a1-initial-velocity"] ** 2


def _inertia(known: Known) -> float:
    """L/D rho_p/rho_t + k_1 [1]."""
    ratio = known["sphere-length-ratio"] * known["a1-density"] / known[_DENSITY]
    return ratio + known["fz-k1"]


def _derived(known: Known, strength: float, length_ratio: float | None = None) -> float:
    """X/R [1] from Eqs. 14 and 15."""
    ratio = known["sphere-length-ratio"] if length_ratio is None else length_ratio
    particle, target, k_1, k_t = (
        known[name] for name in ("a1-density", _DENSITY, "fz-k1", "fz-kt")
    )
    velocity = known["a1-initial-velocity"]
    return frank_zook.depth_derived(ratio, particle, target, k_1, k_t, strength, velocity)


def _printed_ratio(known: Known) -> tuple[Fraction, Fraction]:
    """Least and greatest ratio of two numbers that print like the report's pair."""
    low, high = known.target("frank-zook-rha").ends
    least, greatest = known.target("frank-zook-stainless").ends
    return least / high, greatest / low


def _least_ratio(known: Known, *, choices_exact: bool) -> Fraction:
    """The least ratio of the two depths that any Eq. 16 gives for inputs that print so, proven.

    Only R_t differs between them, so that all but the logarithms cancels. The 7.6E9 Pa, which the
    author chose, is exact or rounded to its digits.
    """

    def ratio(ar: Any, k_t: Number, density: Number, velocity: Number, armor: Number,
              stainless: Number) -> Number:  # fmt: skip
        drag = k_t * density * velocity**2
        return ar.log(1 + drag / stainless) / ar.log(1 + drag / armor)

    names = {
        "k_t": "fz-kt",
        "velocity": "a1-initial-velocity",
        "armor": "fz-resistance-rha",
        "stainless": "fz-resistance-stainless",
    }
    rounded = Convention(choices_exact=choices_exact)
    claims = known.ledger.claims
    box = {key: claims[name].as_input(rounded).ends for key, name in names.items()}
    box["density"] = known.judge.inference(_DENSITY).admitted(rounded)[1].ends
    return enclose(ratio, box).ends[0]


def _frank_zook_pair(known: Known) -> Evidence:
    z = _drag(known)
    armor, stainless = (known[f"fz-resistance-{name}"] for name in ("rha", "stainless"))
    nominal = math.log1p(z / stainless) / math.log1p(z / armor)
    printed = known.exact("frank-zook-stainless") / known.exact("frank-zook-rha")
    return {
        "falls": 1 - known.exact("fz-resistance-stainless") / known.exact("fz-resistance-rha"),
        "least": _least_ratio(known, choices_exact=True) - 1,
        "least_rounded": _least_ratio(known, choices_exact=False) - 1,
        "nominal": nominal - 1,
        "printed": printed - 1,
        "most": _printed_ratio(known)[1] - 1,
        "z": z,
    }


def _equation_16(known: Known) -> Evidence:
    (must,) = known.equation("eq16").constants["eq16-denominator"].needed
    ratios = {
        f"{form}_{name}": known.computed(f"frank-zook-{name}", reading)
        for form, reading in (("printed", ""), ("derived", _DERIVED))
        for name in ("rha", "stainless")
    }
    observed = known["observed-depth-ratio"]
    return ratios | {
        "factor": _factor(known),
        "must": Fraction(must),
        "above_rha": known["frank-zook-rha"] / ratios["derived_rha"] - 1,
        "below_stainless": 1 - known["frank-zook-stainless"] / ratios["derived_stainless"],
        "far_printed": observed - ratios["printed_rha"],
        "far_cth": known.exact("cth-ratio") - known.exact("observed-depth-ratio"),
        "far_derived": observed - ratios["derived_rha"],
    }


def _frank_zook_values(known: Known) -> Evidence:
    rha, strength = (
        known.ledger.claims[name] for name in ("frank-zook-rha", "fz-resistance-stainless")
    )
    exact, rounded = (
        [j for j in known.reading("frank-zook-stainless", _DERIVED).judgements
         if j.convention.choices_exact is choices_exact]
        for choices_exact in (True, False)
    )  # fmt: skip
    assert strength.printed is not None
    grid = strength.printed.quantum * strength.si
    nearest = min(
        (grid * k for k in range(1, 200)),
        key=lambda r_t: abs(_derived(known, float(r_t)) - known["observed-depth-ratio"]),
    )
    derived = known.computed("frank-zook-stainless", _DERIVED)
    return {
        "derived": derived,
        "off": derived / known["frank-zook-stainless"] - 1,
        "least_exact": min(j.lower for j in exact),
        "corner": any(j.verdict is Verdict.WITHIN_ROUNDING for j in rounded),
        "needed": _needed(known, "stainless", "fz-resistance-stainless"),
        "grid": grid,
        "nearest": nearest,
        "next": _derived(known, float(nearest)),
        "least_admitted": _least_admitted(known),
        "back": _resistance_for(known, derived, 3),
        "rha_resistance": _needed(known, "rha", "fz-resistance-rha"),
        "rha_velocity": _needed(known, "rha", "a1-initial-velocity"),
        "rha_derived": known.computed("frank-zook-rha", _DERIVED),
        "never": all(
            j.verdict is Verdict.NOT_REPRODUCED
            for reading in known.assessment(rha).readings
            for j in reading.judgements
            if j.convention.choices_exact
        ),
        "slips": not any(slip.fits for slip in known.explainer.slips(rha)),
        "inertia": _inertia(known),
        "z": _drag(known),
    }


def _least_admitted(known: Known) -> Fraction:
    """The least X/R for stainless steel, by Eqs. 14 and 15, proven.

    All inputs are rounded but the velocity; the density is one that the header as printed admits.
    """
    claim = known.ledger.claims["frank-zook-stainless"]
    box = dict(known.judge.box(claim, Convention(choices_exact=False))[1])
    box["a1-initial-velocity"] = (known.exact("a1-initial-velocity"),) * 2
    box[_DENSITY] = known.judge.inference(_DENSITY).outer.ends
    return enclose(known.ledger.function(claim, reading=_DERIVED), box).ends[0]


def _resistance_for(known: Known, ratio: float, digits: int) -> float:
    """R_t [Pa] at which Eqs. 14 and 15 give a depth X/R, rounded to some decimals."""
    exponent = round(ratio, digits) * known["fz-kt"] / _inertia(known)
    return _drag(known) / math.expm1(exponent)


def _needed(known: Known, which: str, entry: str) -> float:
    """The middle of the values of an entry with which the derived form gives the number."""
    claim = known.ledger.claims[f"frank-zook-{which}"]
    inner = known.explainer.solutions(claim, _DERIVED, entry).inner
    if not inner:
        raise ArithmeticError(f"no value of {entry} gives the number")
    return float(sum(inner[0])) / 2


def _two_resistances(known: Known) -> Evidence:
    low, high = (case(known, beta).target_resistance for beta in (3, 5))
    return {
        "fz_low": _derived(known, low),
        "fz_high": _derived(known, high),
        "low": low,
        "high": high,
        "model_stainless": exact_ratio(case(known, 5, resistance=known["fz-resistance-stainless"])),
        "model_rha": exact_ratio(case(known, 5, resistance=known["fz-resistance-rha"])),
        "inertia": _inertia(known),
        "z": _drag(known),
    }


def _sphere_equivalent(known: Known) -> Evidence:
    long = known["circumscribed-length-ratio"]
    return {
        "ratio": known.exact("sphere-length-ratio") / known.exact("circumscribed-length-ratio"),
        "long_rha": _derived(known, known["fz-resistance-rha"], long),
        "long_stainless": _derived(known, known["fz-resistance-stainless"], long),
    }


# The sheet


def _target_density(known: Known) -> Evidence:
    inference = known.judge.inference(_DENSITY)
    (least, greatest), (possible_least, possible_greatest) = (
        interval.ends for interval in (inference.inner, inference.admitted(Convention())[1])
    )
    centered = known.judge.inference(_DENSITY, centered=True).inner.ends
    sources = known.ledger.sources
    said = {name: inference.admits(sources[name].value, sources[name].interval)
            for name in ("304-density-793", "304-density-mill", "304-density-kinslow",
                         "carbon-steel-density")}  # fmt: skip
    depths = (known.reading(f"depth-beta-{beta}") for beta in (3, 5))
    return {
        "least": least,
        "greatest": greatest,
        "possible_least": possible_least,
        "possible_greatest": possible_greatest,
        "centered_least": centered[0],
        "centered_greatest": centered[1],
        "mass_greatest": inference.with_mass.ends[1],
        "assumed": known.exact(_DENSITY),
        "edge": known.target("a1-deceleration-1").ends[1],
        "carbon": said["carbon-steel-density"] == "admitted",
        "excluded": said["304-density-793"] == said["304-density-mill"] == "excluded",
        "kinslow": said["304-density-kinslow"] == "admitted only if the other inputs are rounded",
        "depths": all(reading.verdict is Verdict.REPRODUCED for reading in depths),
        "mass": case(known, 5).mass,
        "all": not inference.odd,
    }


def _two_schemes(known: Known) -> Evidence:
    evidence: dict[str, float | bool] = {}
    steps = {"fine": known["a-step"], "coarse": known["coarse-step"]}
    for beta in (3, 5):
        exact = depth.final_depth(**case(known, beta).motion)
        middle, plain = (
            {size: sheet.run(case(known, beta, step=step), scheme).final_depth
             for size, step in steps.items()}
            for scheme in ("centered", "published")
        )  # fmt: skip
        evidence |= {f"middle_{size}_{beta}": value for size, value in middle.items()}
        evidence |= {f"plain_{size}_{beta}": value for size, value in plain.items()}
        evidence |= {
            f"exact_{beta}": exact,
            f"short_{beta}": exact - plain["fine"],
            f"coarse_short_{beta}": exact - plain["coarse"],
            f"nm_{beta}": plain["fine"] - plain["coarse"],
            f"change_{beta}": 1 - plain["coarse"] / plain["fine"],
        }
    row, row_plain, row_middle = _first_difference(known)
    table = [c for c in known.ledger.claims.values() if c.cell and c.by_scheme]
    return evidence | {
        "middle_change_5": 1 - middle["coarse"] / middle["fine"],
        "reprinted": Fraction(f"{plain['coarse']:.2e}"),
        "middle_density": _middle_density(known),
        "row": Fraction(row),
        "row_plain": row_plain,
        "row_middle": row_middle,
        "table": all(
            j.verdict is Verdict.REPRODUCED
            for claim in table
            for j in known.reading(claim.id).judgements
            if j.convention.rounding is Convention().rounding
        ),
        "order_plain": _order(known, "published"),
        "order_middle": _order(known, "centered"),
    }


def _middle_density(known: Known) -> Fraction:
    """The least target density at which the drag at the middle velocity gives the depth."""
    ledger = known.ledger
    claim = ledger.claims["depth-beta-5"]
    printed = {name: ledger.value(name) for name in claim.stated}
    function = holding(ledger.function(claim, centered=True), printed)
    admitted = known.judge.inference(_DENSITY, centered=True).outer.ends
    outer = solve(function, _DENSITY, admitted, claim.target()).outer
    if not outer:
        raise ArithmeticError("no target density gives the depth")
    return outer[0][0]


def _first_difference(known: Known) -> tuple[int, float, float]:
    """The first row in which the two schemes print another deceleration, to three digits."""
    runs = [sheet.run(case(known, 5), scheme).rows for scheme in sheet.SCHEMES]
    for number, (plain, middle) in enumerate(zip(*runs, strict=False)):
        cells = [f"{row.deceleration:.2E}" for row in (plain, middle)]
        if cells[0] != cells[1]:
            return number, plain.deceleration, middle.deceleration
    raise ValueError("the two schemes print the same decelerations in every row")


def _order(known: Known, scheme: str) -> float:
    """Observed order of the error at the end of the motion, from 0.2 to 0.1 ns, for beta = 5.

    At a fixed time within the motion, where no stop rule interferes.
    """
    errors = []
    for parts in (1, 2):
        impact = case(known, 5, step=known["a-step"] / parts)
        row = sheet.run(impact, scheme).rows[50 * parts]
        assert row.velocity_final is not None
        behind = row.depth + row.velocity_final * impact.step / 2
        errors.append(behind - depth.depth_at_velocity(row.velocity_final, **impact.motion))
    return math.log2(errors[0] / errors[1])


def _table_columns(known: Known) -> Evidence:
    x, v = 0.0, known["a1-initial-velocity"]
    impact = case(known, 5)
    fixed = (impact.radius, impact.mass, impact.target_density, impact.target_resistance)
    for row in range(3):
        x += v * impact.step * (1 if row else 0.5)
        v += sheet.deceleration(x, v, *fixed) * impact.step
    return {
        "exact": known["a1-initial-velocity"] * known["a1-time-1"],
        "plus": v,
        "minus": known.computed("a1-velocity-final-3"),
    }


# Strengths


def _pressure_for(known: Known, y: float) -> float:
    """p = rho_t V^2 / 2 R_t at which the exact X/R is y <= 1: y^2 - y^3/3 = c."""
    return math.expm1(crater.volume_ratio(y) * known[_DENSITY] / known["a1-density"])


def _dynamic_pressure(known: Known) -> float:
    return known[_DENSITY] * known["a1-initial-velocity"] ** 2 / 2


def _observed_beta(known: Known) -> Evidence:
    y, (least, greatest) = known["observed-ratio"], known.target("observed-ratio").ends
    shallow, needed, deep = (
        _dynamic_pressure(known) / _pressure_for(known, x)
        for x in (float(least), y, float(greatest))
    )
    return {
        "beta": needed / known["flow-stress"],
        "resistance": needed,
        "beta_least": deep / known["flow-stress"],
        "beta_greatest": shallow / known["flow-stress"],
        "velocity": known["a1-initial-velocity"]
        * math.sqrt(case(known, 5).target_resistance / needed),
        "p": _pressure_for(known, y),
        "left": y**2 - y**3 / 3,
    }


def _beta_and_flow_stress(known: Known) -> Evidence:
    modulus, stress = known["elastic-modulus"], known["flow-stress"]
    alpha = resistance.walker_anderson_alpha(modulus, stress)
    beta = resistance.walker_anderson_beta(alpha)
    return {
        "alpha": alpha,
        "beta": beta,
        "resistance": beta * stress,
        "ratio": exact_ratio(case(known, 5, resistance=beta * stress)),
        "cavity_bulk": 2 / 3 + 2 * math.log(known.computed("walker-anderson-alpha")),
        "cavity": 2 / 3 + 2 * math.log(alpha),
        "cube": 2 * modulus / (3 * stress),
    }


def _strengths(known: Known) -> Evidence:
    feathery, clear = known.exact("strength-feathery"), known.exact("strength-clear")
    tensile = known.exact("a240-tensile")
    return {
        "feathery": feathery,
        "clear": clear,
        "choice": known.exact("flow-stress"),
        "between": clear < known.exact("flow-stress") < feathery,
        "like": clear / tensile,
        "like_most": feathery / tensile,
        "unlike": clear / known.exact("strength-bulk"),
        "bulk": known.exact("strength-bulk"),
        "ksi": to_si("ksi"),
    }


def _rigid_strength(known: Known) -> Evidence:
    copper, pressure = known["copper-yield"], _dynamic_pressure(known)
    sigma_3, sigma_5 = (
        resistance.centerline_stress(
            known[_DENSITY], known["a1-initial-velocity"], case(known, beta).target_resistance
        )
        for beta in (3, 5)
    )
    static = known["copper-johnson-cook"] + known["copper-johnson-cook-hardening"]
    fast = static * (1 + known["copper-johnson-cook-rate"] * math.log(known["strain-rate"]))
    return {
        "sigma_5": sigma_5,
        "sigma_3": sigma_3,
        "multiple_5": sigma_5 / copper,
        "multiple_3": sigma_3 / copper,
        "pressure": pressure,
        "fast": fast,
        "short_5": sigma_5 / fast,
        "short_3": sigma_3 / fast,
    }


def _inertia_term(known: Known) -> Evidence:
    evidence: dict[str, float] = {}
    for beta in (3, 5):
        impact = case(known, beta)
        evidence[f"pressed_{beta}"] = pressed = constant_pressure_ratio(impact)
        evidence[f"exact_{beta}"] = exact = depth.normalized_depth(
            impact.velocity, impact.particle_density, impact.target_density,
            impact.target_resistance,
        )  # fmt: skip
        evidence[f"price_{beta}"] = 1 - exact / pressed
    energy = known["a1-density"] * known["a1-initial-velocity"] ** 2 / 2
    evidence["work"] = energy / case(known, 5).target_resistance
    return evidence


def constant_pressure_ratio(impact: Impact) -> float:
    """X/R [1] of a crater at the constant pressure R_t: the model without the target's inertia.

    Its work R_t CV is the kinetic energy rho_p PV V^2 / 2, so CV/PV = rho_p V^2 / (2 R_t); beyond
    half a sphere the crater goes on as a cylinder.
    """
    ratio = impact.particle_density * impact.velocity**2 / (2 * impact.target_resistance)
    return crater.depth_from_volume_ratio(ratio) if ratio <= 0.5 else (1 + 4 * ratio) / 3


def _unlike_strengths(known: Known) -> Evidence:
    steel, code = known["autodyne-steel-yield"], known["autodyne-ratio"]
    evidence: dict[str, float] = {}
    for name, beta in (("low", 3), ("high", 5)):
        ratio = exact_ratio(case(known, 5, resistance=known[f"depth-beta-{beta}-beta"] * steel))
        evidence |= {name: ratio, f"times_{name}": ratio / code}
    return evidence


def _autodyne_cells(known: Known) -> Evidence:
    cell = known.exact("autodyne-least-length") / (known.exact("autodyne-diameter") / 2)
    return {"cell": cell, "cells": known.exact("autodyne-ratio") / cell}


def _cth_pressure(known: Known) -> Evidence:
    speeds = {name: known[f"{name}-hugoniot-speed"] for name in ("copper", "304")}
    slopes = {name: known[f"{name}-hugoniot-slope"] for name in ("copper", "304")}
    densities = {"copper": known["a1-density"], "304": known["304-density-kinslow"]}

    def pressure(name: str, u: float) -> float:
        return densities[name] * (speeds[name] + slopes[name] * u) * u

    low, high = 0.0, known["cth-velocity"]
    for _ in range(60):
        middle = (low + high) / 2
        stiffer = pressure("304", middle) < pressure("copper", known["cth-velocity"] - middle)
        low, high = (middle, high) if stiffer else (low, middle)
    radius = known["cth-diameter"] / 2
    return {
        "shock": pressure("304", low),
        "interface": low,
        "times": pressure("304", low) / known["cth-pressure"],
        "time": radius / speeds["copper"],
        "flow_low": _dynamic_pressure(known) + case(known, 3).target_resistance,
        "flow_high": _dynamic_pressure(known) + case(known, 5).target_resistance,
    }


# Craters and the stream


def _compared_velocity(known: Known) -> Evidence:
    speeds = {"first": "velocity-521", "second": "velocity-606", "least": "velocity-403"}
    return {
        name: exact_ratio(case(known, 5, velocity=known[claim])) for name, claim in speeds.items()
    } | {
        "volume_high": crater.volume_ratio(known["ratio-beta-5"]),
        "volume_low": crater.volume_ratio(known["ratio-beta-3"]),
    }


def _observed_digits(known: Known) -> Evidence:
    line = crater.depth_from_volume_ratio(known["volume-ratio-line"])
    least, greatest = known.target("volume-ratio").ends
    depth_ratio = known["profile-depth"] / (known["mean-diameter"] / 2)
    return {
        "line": line,
        "line_depth": line * known["observed-depth-diameter"] / 2,
        "least": crater.depth_from_volume_ratio(float(least)),
        "greatest": crater.depth_from_volume_ratio(float(greatest)),
        "profile": depth_ratio,
        "profile_volume": crater.volume_ratio(depth_ratio),
    }


def _equation_1_scatter(known: Known) -> Evidence:
    relative = known["diameter-deviation"] / known["mean-diameter"]
    velocity = known["a1-initial-velocity"]
    power = 3 * known.exact("eq1-power")  # the mass goes with the cube of the diameter
    drag = Fraction(1, 2)  # area over mass goes with one over the diameter
    ends = {"fast": "particle-size-least", "slow": "particle-size-greatest"}
    mean = known["mean-diameter"]
    return {
        "power": power,
        "drag_power": drag,
        "eq1_standard": float(power) * relative * velocity,
        "eq1_mean": float(power) * relative * velocity * _MEAN_DEVIATION,
        "drag_standard": float(drag) * relative * velocity,
        "drag_mean": float(drag) * relative * velocity * _MEAN_DEVIATION,
        "gaussian": _MEAN_DEVIATION,
        "drag_exact": _mean_deviation(float(drag), relative) * velocity,
        **{
            name: stream.particle_velocity(known["figure-1-velocity"], known[d] ** 3, mean**3)
            for name, d in ends.items()
        },
    }


def _mean_deviation(power: float, relative: float) -> float:
    """Mean |(d/d_0)^-p - 1| for normally distributed d > 0, by the midpoint rule in d."""
    normal = NormalDist(1.0, relative)
    count = 20_000
    sizes = [(k + 0.5) * 2 / count for k in range(count)]
    weights = [normal.pdf(d) for d in sizes]
    total = math.fsum(w * abs(d**-power - 1) for d, w in zip(sizes, weights, strict=True))
    return float(total / math.fsum(weights))


def _faster_particles(known: Known) -> Evidence:
    deviation = known["velocity-deviation"]
    above = known["stream-velocity-450"] - known["velocity-403"]
    return {
        "standard": NormalDist(0, deviation).cdf(-above),
        "mean": NormalDist(0, deviation / _MEAN_DEVIATION).cdf(-above),
        "ratio": above / deviation,
    }


# Words


def _times(known: Known, words: str) -> Fraction:
    """How often the report says so, line breaks aside."""
    return Fraction(" ".join(known.ledger.text.split()).count(words))


def _minimum_velocity(known: Known) -> Evidence:
    return {
        "section_2": _times(known, "be higher than 403 m/s, but less than 521 m/s"),
        "section_4": _times(known, "suggesting that only faster-than-average particles were"),
    }


def _wrong_reference(known: Known) -> Evidence:
    return {
        "stress": "Sigma" in known.ledger.printed_text("eq1"),
        "follows": known.equation("eq6").verdict is Verdict.REPRODUCED,
        "times": _times(known, "equation 1 reduces"),
        "caption": _times(known, "500-m/s steel"),
    }


EVIDENCE: Mapping[str, Callable[[Known], Evidence]] = {
    finding: globals()[f"_{finding.replace('-', '_')}"] for finding in asserted.load()
}
"""The evidence of every finding: of `equation-16`, what the function `_equation_16` computes."""

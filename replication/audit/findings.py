"""The findings: the evidence of each, computed anew from the ledger, the verdicts and the models.

What arithmetic gives is a formula of `reference/report/findings.toml`; here is what takes a proof,
a model or a search: for each finding a function of the same name.
"""

import math
from collections.abc import Mapping
from fractions import Fraction
from functools import cache, cached_property, partial
from statistics import NormalDist
from typing import Any

from msgspec.structs import replace

from reference import findings as asserted
from reference.arithmetic import Arithmetic, Number
from reference.enclosure import enclose, holding, solve
from reference.equations import evaluate
from reference.ledger import INFERRED, Claim, Convention, Ledger, claims_of_case
from reference.units import to_si
from replication.audit import record as r
from replication.audit import wording
from replication.audit.explain import Explainer
from replication.audit.verdict import Assessment, Judge, Reading, Verdict, assess_equation
from replication.models import crater, depth, estimates, sheet
from replication.models.impact import Impact

Value = Fraction | float | bool
"""Of a piece of evidence: a number in SI units, or whether something was proven."""

DENSITY = INFERRED + "target-density"
DERIVED = "derived from Eqs. 14 and 15"
"""How Eq. 16 is read otherwise than printed."""

_READINGS = {"computed": "", "derived": DERIVED}


class Known:
    """What the evidence is computed from: a ledger and the verdicts on it, each computed once."""

    def __init__(self, ledger: Ledger, *, every_convention: bool = True) -> None:
        self.ledger = ledger
        self.judge = Judge(ledger, every_convention=every_convention)
        self.explainer = Explainer(self.judge)
        self.equation = cache(partial(assess_equation, ledger))
        self.assessment = cache(self._assess)
        self.shown = cache(self.explainer.shown)
        self.sources = cache(self._sources)

    def _assess(self, claim: Claim) -> Assessment:
        """The verdict on one claim, and why."""
        if claim.kind == "remark":
            return Assessment(Verdict.REMARK, wording.REMARK)
        if claim.within is None and claim.computation is not None:
            assessed = self.judge.assess(claim)
            return replace(assessed, reason=wording.explanation(self.judge, claim, assessed))
        constant = self.equation(claim.within).constants.get(claim.id) if claim.within else None
        reason = wording.constant_explanation(self.ledger, claim, constant) if constant else ""
        if constant and constant.verdict != Verdict.NOT_CHECKABLE:
            return Assessment(Verdict(constant.verdict), reason)
        if sources := self.sources(claim.id):
            agrees = any(source.agrees for source in sources)
            verdict = Verdict.AGREES if agrees else Verdict.DIFFERS
            return Assessment(verdict, reason or wording.sources(sources))
        if claim.shown_by:
            shown = self.shown(claim)
            verdict = Verdict.CONSISTENT if shown else Verdict.INCONSISTENT
            return Assessment(verdict, reason or wording.chosen(self.ledger, shown))
        undecided = f"Nothing in the report decides it: {claim.given}."
        return Assessment(Verdict.NOT_CHECKABLE, reason or undecided)

    def _sources(self, name: str) -> list[r.SourceRecord]:
        """The public sources for a claim or an inferred input, and whether each agrees with it."""
        records = []
        for source in self.ledger.sources.values():
            if name not in source.claims:
                continue
            if name.startswith(INFERRED):
                admission = self.judge.inference(name).admits(source.value, source.interval)
                outcome = f"is {admission.value}"
            else:
                meets = self.ledger.claims[name].target().meets(source.interval)
                outcome = "agrees" if meets else "differs"
            agrees = outcome in ("agrees", "is admitted")
            records.append(r.filled(r.SourceRecord, source, agrees=agrees, outcome=outcome))
        return records

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


def case(known: Known, beta: int, /, **changed: float) -> Impact:
    """One of the report's two cases, with some inputs changed (SI)."""
    inputs = {name: known[claim] for name, claim in claims_of_case(beta).items()}
    if "resistance" in changed:
        del inputs["beta"], inputs["flow_stress"]
    return Impact(**{**inputs, **changed})


def exact_ratio(impact: Impact) -> float:
    """The model's exact X/R [1]."""
    return depth.final_depth(**impact.motion) / impact.radius


class Evidence:
    """The evidence of one finding, each piece computed when it is asked for."""

    def __init__(self, known: Known, finding: asserted.Finding) -> None:
        self.known, self.finding = known, finding
        self.value = cache(self._value)

    @cached_property
    def proven(self) -> Mapping[str, Value]:
        """What the function of the finding's name computes."""
        proven: Mapping[str, Value] = globals()[f"_{self.finding.id.replace('-', '_')}"](self)
        return proven

    def __getitem__(self, name: str) -> float:
        """A value by its name in a formula, as a double."""
        return float(self.value(name))

    def _value(self, name: str) -> Value:
        """What stands for a name: evidence, an entry, an end of its print, what a reading gives."""
        known, assertion = self.known, self.finding.evidence.get(name)
        entry, _, part = name.partition(".")
        if assertion is not None and assertion.formula:
            return self.calculated(assertion.formula)
        if assertion is not None and assertion.exact:
            changed = {key: float(self.calculated(x)) for key, x in assertion.exact.items()}
            return exact_ratio(case(known, 5, **changed))
        if assertion is not None and assertion.words:
            return Fraction(" ".join(known.ledger.text.split()).count(assertion.words))
        if part in _READINGS:
            reading = known.reading(entry, _READINGS[part])
            return reading.computed * float(known.ledger.claims[entry].si)
        if part:
            ends = known.ledger.claims[entry].target().ends
            return ends[("least", "greatest").index(part)]
        is_entry = assertion is None and (name in known.ledger.claims or INFERRED in name)
        return known.exact(name) if is_entry or name in known.ledger.sources else self.proven[name]

    def calculated(self, formula: str) -> Fraction | float:
        """The value of a formula, exact until a logarithm or a root is taken."""
        node, names = asserted.expression(formula)
        value: Fraction | float = evaluate(
            node, _Exact(), {name: self.value(name) for name in names}
        )
        return value

    def record(self) -> r.FindingRecord:
        """The finding with its evidence, as asserted and as computed."""
        evidence = [self._piece(name, own) for name, own in self.finding.evidence.items()]
        return r.filled(
            r.FindingRecord,
            self.finding,
            claims=list(self.finding.claims),
            holds=all(piece.holds for piece in evidence) and all(self.finding.steps.values()),
            evidence=evidence,
        )

    def _piece(self, name: str, assertion: asserted.Assertion) -> r.EvidenceRecord:
        value: Value | None
        try:
            value = self.value(name)
            if not isinstance(value, bool):
                value = Fraction(value) / to_si(assertion.unit)
        except (ArithmeticError, IndexError, ValueError):  # in a report with a misprint
            value = None
        return r.filled(
            r.EvidenceRecord,
            assertion,
            name=name,
            asserted=assertion.says,
            computed=float(value) if isinstance(value, Fraction) else value,
            holds=value is not None and assertion.holds(value),
        )


class _Exact(Arithmetic):
    """Fractions until a logarithm or a root is taken, then doubles."""

    pi, number = math.pi, Fraction
    log, power = staticmethod(math.log), staticmethod(math.pow)


def _headline(own: Evidence) -> Mapping[str, Value]:
    known = own.known
    claims = known.ledger.claims
    model = [c for c in claims.values() if c.cell and c.computation and not c.computation.restates]
    model += [claims[f"{what}-beta-{beta}"] for what in ("depth", "ratio") for beta in (3, 5)]
    pair = [claims[f"frank-zook-{name}"] for name in ("rha", "stainless")]
    greatest = own.value("frank-zook-stainless.greatest") / own.value("frank-zook-rha.least")
    return {
        "model": all(known.assessment(c).verdict is Verdict.REPRODUCED for c in model),
        "pair": all(known.assessment(c).verdict is Verdict.NOT_REPRODUCED for c in pair),
        "together": _least_ratio(known, choices_exact=False) <= greatest,
        "factor": _factor(known),
    }


# Frank and Zook


def _factor(known: Known) -> Fraction:
    """Derived right side of Eq. 16 over the printed one; 0 where that is no number."""
    factor = known.equation("eq16").factor
    return Fraction(0) if factor is None else 1 / factor


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
    box["density"] = known.judge.inference(DENSITY).admitted(rounded).ends
    return enclose(ratio, box).ends[0]


def _frank_zook_pair(own: Evidence) -> Mapping[str, Value]:
    return {
        name: _least_ratio(own.known, choices_exact=exact) - 1
        for name, exact in (("least", True), ("least_rounded", False))
    }


def _equation_16(own: Evidence) -> Mapping[str, Value]:
    (must,) = own.known.equation("eq16").constants["eq16-denominator"].needed
    return {"factor": _factor(own.known), "must": Fraction(must)}


def _frank_zook_values(own: Evidence) -> Mapping[str, Value]:
    known = own.known
    names = ("frank-zook-rha", "frank-zook-stainless", "fz-resistance-stainless")
    rha, stainless, strength = map(known.ledger.claims.__getitem__, names)
    exact, rounded = (
        [j for j in known.reading(stainless.id, DERIVED).judgements
         if j.convention.choices_exact is choices_exact]
        for choices_exact in (True, False)
    )  # fmt: skip
    inputs = {key: known[name] for key, (name,) in stainless.inputs.items()}

    def distance(resistance: Fraction) -> float:
        depth = estimates.frank_zook_derived(**{**inputs, "resistance": float(resistance)})
        return abs(depth - known["observed-depth-ratio"])

    grid = strength.number.quantum * strength.si
    exponent = round(own["derived"], 3) * known["fz-kt"] / own["inertia"]
    return {
        "least_exact": min(j.ends[0] for j in exact),
        "corner": any(j.verdict is Verdict.WITHIN_ROUNDING for j in rounded),
        "needed": _needed(known, stainless, strength.id),
        "grid": grid,
        "nearest": min((grid * k for k in range(1, 200)), key=distance),
        "least_admitted": _least_admitted(known),
        "back": own["z"] / math.expm1(exponent),
        "rha_resistance": _needed(known, rha, "fz-resistance-rha"),
        "rha_velocity": _needed(known, rha, "a1-initial-velocity"),
        "never": all(
            j.verdict is Verdict.NOT_REPRODUCED
            for reading in known.assessment(rha).readings
            for j in reading.judgements
            if j.convention.choices_exact
        ),
        "slips": not any(slip.fits for slip in known.explainer.slips(rha)),
    }


def _least_admitted(known: Known) -> Fraction:
    """The least X/R for stainless steel, by Eqs. 14 and 15, proven.

    All inputs are rounded but the velocity; the density is one that the header as printed admits.
    """
    claim = known.ledger.claims["frank-zook-stainless"]
    box = dict(known.judge.box(claim, Convention(choices_exact=False)))
    box["a1-initial-velocity"] = (known.exact("a1-initial-velocity"),) * 2
    box[DENSITY] = known.judge.inference(DENSITY).outer.ends
    return enclose(known.ledger.function(claim, reading=DERIVED), box).ends[0]


def _needed(known: Known, claim: Claim, entry: str) -> float:
    """The middle of the values of an entry with which the derived form gives the number."""
    inner = known.explainer.solutions(claim, DERIVED, entry).inner
    if not inner:
        raise ArithmeticError(f"no value of {entry} gives the number")
    return float(sum(inner[0])) / 2


# The sheet


def _target_density(own: Evidence) -> Mapping[str, Value]:
    known = own.known
    inference = known.judge.inference(DENSITY)
    ranges = {
        "": inference.inner,
        "possible_": inference.admitted(Convention()),
        "rounded_": inference.admitted(Convention(choices_exact=False)),
        "centered_": known.judge.inference(DENSITY, centered=True).inner,
    }
    evidence: dict[str, Value] = {}
    for name, interval in ranges.items():
        evidence[f"{name}least"], evidence[f"{name}greatest"] = interval.ends
    said = {source.id: source.outcome.removeprefix("is ") for source in known.sources(DENSITY)}
    depths = (known.reading(f"depth-beta-{beta}") for beta in (3, 5))
    return evidence | {
        "mass_greatest": inference.with_mass.ends[1],
        "carbon": said["carbon-steel-density"] == "admitted",
        "excluded": said["304-density-mill"].startswith("excluded"),
        "chosen": "what the author chose" in said["304-density-793"],
        "kinslow": "the header of Table A-1" in said["304-density-kinslow"],
        "depths": all(reading.verdict is Verdict.REPRODUCED for reading in depths),
        "all": not inference.odd,
    }


def _two_schemes(own: Evidence) -> Mapping[str, Value]:
    known = own.known
    evidence: dict[str, Value] = {}
    for beta in (3, 5):
        evidence[f"exact_{beta}"] = depth.final_depth(**case(known, beta).motion)
        for size, step in (("fine", known["a-step"]), ("coarse", known["coarse-step"])):
            for name, scheme in (("plain", "published"), ("middle", "centered")):
                run = sheet.run(case(known, beta, step=step), scheme)
                evidence[f"{name}_{size}_{beta}"] = run.final_depth
    row, row_plain, row_middle = _first_difference(known)
    table = [c for c in known.ledger.claims.values() if c.cell and c.by_scheme]
    return evidence | {
        "reprinted": Fraction(f"{evidence['plain_coarse_5']:.2e}"),
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
    admitted = known.judge.inference(DENSITY, centered=True).outer.ends
    outer = solve(function, DENSITY, admitted, claim.target()).outer
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


def _table_columns(own: Evidence) -> Mapping[str, Value]:
    impact = case(own.known, 5)
    fixed = (impact.radius, impact.mass, impact.target_density, impact.target_resistance)
    x, v = 0.0, impact.velocity
    for row in range(3):
        x += v * impact.step * (1 if row else 0.5)
        v += sheet.deceleration(x, v, *fixed) * impact.step
    return {"plus": v}


# Strengths


def _observed_beta(own: Evidence) -> Mapping[str, Value]:
    """p = rho_t V^2 / 2 R_t at which the exact X/R is y <= 1: y^2 - y^3/3 = c."""
    density = own[DENSITY] / own["a1-density"]
    depths = {"p": "observed-ratio", "p_least": "observed-ratio.least",
              "p_greatest": "observed-ratio.greatest"}  # fmt: skip
    return {p: math.expm1(crater.volume_ratio(own[y]) * density) for p, y in depths.items()}


def _strengths(own: Evidence) -> Mapping[str, Value]:
    between = own["strength-clear"] < own["flow-stress"] < own["strength-feathery"]
    return {"between": between, "ksi": to_si("ksi")}


def _inertia_term(own: Evidence) -> Mapping[str, Value]:
    return {f"pressed_{b}": constant_pressure_ratio(case(own.known, b)) for b in (3, 5)}


def constant_pressure_ratio(impact: Impact) -> float:
    """X/R [1] of a crater at the constant pressure R_t: the model without the target's inertia.

    Its work R_t CV is the kinetic energy rho_p PV V^2 / 2, so CV/PV = rho_p V^2 / (2 R_t); beyond
    half a sphere the crater goes on as a cylinder.
    """
    ratio = impact.particle_density * impact.velocity**2 / (2 * impact.target_resistance)
    return crater.depth_from_volume_ratio(ratio) if ratio <= 0.5 else (1 + 4 * ratio) / 3


def _cth_pressure(own: Evidence) -> Mapping[str, Value]:
    def pressure(name: str, density: str, u: float) -> float:
        return (
            own[density] * (own[f"{name}-hugoniot-speed"] + own[f"{name}-hugoniot-slope"] * u) * u
        )

    low, high = 0.0, own["cth-velocity"]
    for _ in range(60):
        middle = (low + high) / 2
        steel = pressure("304", "304-density-kinslow", middle)
        stiffer = steel < pressure("copper", "a1-density", own["cth-velocity"] - middle)
        low, high = (middle, high) if stiffer else (low, middle)
    return {"shock": pressure("304", "304-density-kinslow", low), "interface": low}


# Craters and the stream


def _observed_digits(own: Evidence) -> Mapping[str, Value]:
    ratios = {"line": "volume-ratio-line", "least": "volume-ratio.least",
              "greatest": "volume-ratio.greatest"}  # fmt: skip
    return {name: crater.depth_from_volume_ratio(own[ratio]) for name, ratio in ratios.items()}


def _equation_1_scatter(own: Evidence) -> Mapping[str, Value]:
    relative = own["diameter-deviation"] / own["mean-diameter"]
    return {"drag_exact": _mean_deviation(0.5, relative) * own["a1-initial-velocity"]}


def _mean_deviation(power: float, relative: float) -> float:
    """Mean |(d/d_0)^-p - 1| for normally distributed d > 0, by the midpoint rule in d."""
    normal = NormalDist(1.0, relative)
    count = 20_000
    sizes = [(k + 0.5) * 2 / count for k in range(count)]
    weights = [normal.pdf(d) for d in sizes]
    total = math.fsum(w * abs(d**-power - 1) for d, w in zip(sizes, weights, strict=True))
    return float(total / math.fsum(weights))


def _faster_particles(own: Evidence) -> Mapping[str, Value]:
    """If the deviation that the report states is the standard one, and if it is the mean one."""
    kinds = {"standard": 1.0, "mean": math.sqrt(2 / math.pi)}
    return {
        f"{kind}{of}": NormalDist().cdf(-own[f"ratio{of}"] * factor)
        for kind, factor in kinds.items()
        for of in ("", "_400")
    }


def _wrong_reference(own: Evidence) -> Mapping[str, Value]:
    return {
        "stress": "Sigma" in own.known.ledger.printed_text("eq1"),
        "follows": own.known.equation("eq6").verdict is Verdict.REPRODUCED,
    }

"""The findings: the evidence of each, computed anew from the ledger, the verdicts and the models.

`reference/report/findings.toml` says how each piece of evidence is computed: by formulas, runs of
the sheet, and verdicts. Only what these cannot express is a function in this module.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from fnmatch import fnmatch
from fractions import Fraction
from functools import cache, partial
from statistics import NormalDist, fmean
from typing import Any

from msgspec.structs import replace

from reference import findings as asserted
from reference.arithmetic import Arithmetic, Floats, Number
from reference.enclosure import enclose, solve
from reference.equations import evaluate
from reference.ledger import Convention
from reference.printed import Interval, Rounding
from reference.scheme import Scheme
from reference.units import same_dimension, to_si
from replication.audit import record as r
from replication.audit.explain import SHEET_BUDGET
from replication.audit.inference import Inference
from replication.audit.results import DENSITY, DERIVED, Results, case, exact_ratio
from replication.models import depth, estimates, sheet

Value = Fraction | float | bool
"""The value of a piece of evidence: a number in SI units, or the outcome of a proof."""

_READINGS = {"computed": "", "derived": DERIVED}
"""The readings of a claim, by the words for them in findings.toml."""

_CONVENTIONS = {
    "exact": Convention(header_exact=True),
    "usual": Convention(),
    "rounded": Convention(choices_exact=False),
}
"""How inputs are taken: header and choices exact, only the header rounded, or both rounded."""


class Evidence:
    """The evidence of one finding; each piece is computed once, when it is asked for."""

    def __init__(self, results: Results, finding: asserted.Finding) -> None:
        self.results, self.finding = results, finding
        pieces = finding.evidence.items()
        calculated = {name: p.formula for name, p in pieces if p.formula and not p.over}
        self.formulas = {**finding.where, **calculated}
        self.value = cache(self._value)

    def __getitem__(self, name: str) -> float:
        """Return the value of a name in a formula, as a double."""
        return float(self.value(name))

    def _value(self, name: str) -> Value:
        """Return the value of a piece of evidence, computed as its keys say, or of another name.

        Where a box of inputs is given (`over`), it is the proven least value.
        """
        piece = self.finding.evidence.get(name)
        if name in self.formulas:
            value: Fraction | float = self.calculated(self.formulas[name])
            return bool(value > 0) if piece is not None and piece.is_outcome else value
        if name.startswith("unit:"):
            return to_si(name.removeprefix("unit:"))
        if piece is None:
            return self._named(*name.split("."))
        if piece.over:
            box = {
                entry: self.results.judge.rounded(entry, _CONVENTIONS[convention]).ends
                for convention, entries in piece.over.items()
                for entry in entries
            }
            return enclose(partial(self.calculated, piece.formula), box).ends[0]
        if piece.exact:
            changed = {key: float(self.calculated(x)) for key, x in piece.exact.items()}
            impact = case(self.results, 5, **changed)
            is_length = same_dimension(piece.unit, "m")
            return depth.final_depth(**impact.motion) if is_length else exact_ratio(impact)
        if piece.run:
            return self._run(**piece.run)
        if piece.verdicts:
            return all(
                set(self._verdicts(pattern, piece.under)) == {verdict}
                for pattern, verdict in piece.verdicts.items()
            )
        if piece.words:
            return Fraction(" ".join(self.results.ledger.text.split()).count(piece.words))
        return _BESIDES[f"{self.finding.id}: {name}"](self)

    def _named(self, entry: str, *parts: str) -> Value:
        """Return the value (SI) of a name in a formula that is an id, perhaps with parts after it.

        The head of findings.toml lists what the parts mean. Raises KeyError for others.
        """
        results, ledger = self.results, self.results.ledger
        match parts:
            case ():
                return results.exact(entry)
            case (*settings, "least" | "greatest" as end):
                return self._range(entry, *settings).ends[end == "greatest"]
            case ("computed" | "derived" as part,):
                computed = results.reading(entry, _READINGS[part]).computed
                return computed * float(ledger.claims[entry].si)
            case ("by", needed):  # the middle of the values with which the derived form gives it
                solutions = results.explainer.solutions(ledger.claims[entry], DERIVED, needed)
                return float(sum(solutions.inner[0])) / 2
            case ("digit",):
                return ledger.claims[entry].number.quantum * ledger.claims[entry].si
            case ("slips",):
                slips = results.explainer.slips(ledger.claims[entry])
                return Fraction(sum(bool(slip.fits) for slip in slips))
            case ("factor",):
                factor = results.judge.equation(entry).factor
                return Fraction(0) if factor is None else 1 / factor
            case ("needed",):
                constants = results.judge.equation(ledger.claims[entry].within).constants
                (value,) = constants[entry].needed
                return Fraction(value)
            case (*settings, "odd"):
                return Fraction(len(self._inference(entry, *settings).odd))
        raise KeyError(".".join((entry, *parts)))

    def _range(self, entry: str, *settings: str) -> Interval:
        """Return what prints like a claim, or what the evidence of an inferred input admits, SI.

        Everything is taken exactly as printed unless a setting is the name of a convention, or
        changes it: the drag at the middle velocity ("centered"), digits cut off ("cut"), the
        printed mass ("mass").
        """
        judge = self.results.judge
        if entry in self.results.ledger.claims:
            return self.results.ledger.claims[entry].target()
        for setting in settings:
            if setting in _CONVENTIONS:
                return judge.rounded(entry, _CONVENTIONS[setting])
        inference = self._inference(entry, *settings)
        return inference.with_mass if "mass" in settings else inference.inner

    def _inference(self, entry: str, *settings: str) -> Inference:
        rounding = Rounding.CUT if "cut" in settings else Rounding.AWAY
        inference = self.results.judge.inference
        scheme = Scheme.CENTERED if "centered" in settings else Scheme.PUBLISHED
        return inference(entry, scheme=scheme, rounding=rounding)

    def calculated(self, formula: str, ar: Arithmetic | None = None, /, **numbers: Number) -> Any:
        """Return the value of a formula, exact unless a logarithm or a root is taken.

        In another arithmetic `numbers` are the values of some entries, such as intervals.
        """
        node, names = asserted.expression(formula)

        def value(name: str) -> Number:
            if numbers and name in self.formulas:
                return self.calculated(self.formulas[name], ar, **numbers)
            return numbers[name] if name in numbers else self.value(name)

        return evaluate(node, ar or _Exact(), {name: value(name) for name in names})

    def _run(self, claim: str, row: str = "", scheme: str = "published", **inputs: str) -> float:
        """Return what the sheet gives for a claim in another row or scheme or with other inputs."""
        computed = self.results.ledger.claims[claim].resting_on(**inputs)
        computed = replace(computed, row=int(self.value(row))) if row else computed
        return self.results.judge.modelled(computed, scheme=Scheme(scheme))

    def _verdicts(self, pattern: str, under: Mapping[Any, object]) -> Iterator[str]:
        """Yield the verdicts on the source, the equation and the computed claims with such an id.

        With `under` they are those under every convention that has these values; with a reading
        after a point in the pattern, those by this reading.
        """
        results, ledger = self.results, self.results.ledger
        if pattern in ledger.sources:
            yield results.judge.admission(ledger.sources[pattern]).value
        if pattern in ledger.equations:
            yield results.judge.equation(pattern).verdict
        pattern, _, part = pattern.partition(".")
        for claim in ledger.claims.values():
            if not claim.is_computed or not fnmatch(claim.id, pattern):
                continue
            assessment = results.judge.assess(claim)
            if not under and not part:
                yield assessment.verdict
                continue
            for reading in assessment.readings:
                if part and reading.name != _READINGS[part]:
                    continue
                for judgement in reading.judgements:
                    if all(getattr(judgement.convention, key) == under[key] for key in under):
                        yield judgement.verdict

    def record(self) -> r.FindingRecord:
        """Return the finding with its evidence, as asserted and as computed."""
        pieces = []
        for name, assertion in self.finding.evidence.items():
            value: Value | None
            try:
                value = self.value(name)
                if not isinstance(value, bool):
                    value = Fraction(value) / to_si(assertion.unit)
            except (ArithmeticError, LookupError, ValueError):  # in a report with a misprint
                value = None
            holds = value is not None and assertion.holds(value)
            computed = float(value) if isinstance(value, Fraction) else value
            given = {"name": name, "asserted": assertion.says, "computed": computed, "holds": holds}
            pieces.append(r.filled(r.EvidenceRecord, assertion, **given))
        holds = all(piece.holds for piece in pieces) and all(self.finding.steps.values())
        claims = list(self.finding.claims)
        return r.filled(r.FindingRecord, self.finding, claims=claims, evidence=pieces, holds=holds)


class _Exact(Floats):
    """An arithmetic of fractions, which become doubles where a logarithm or a root is taken."""

    number = Fraction
    expm1, normal = staticmethod(math.expm1), staticmethod(NormalDist().cdf)

    def rounded(self, x: Number) -> Fraction:
        return Fraction(f"{float(x):.2e}")


# Evidence that no formula expresses


def _order(evidence: Evidence, scheme: Scheme) -> float:
    """Return the observed order of the error at 10 ns, from steps of 0.2 and 0.1 ns, for beta = 5.

    At 10 ns the particle is still fast, so that the stop rule has no influence.
    """
    errors = []
    for parts in (1, 2):
        impact = case(evidence.results, 5, step=evidence["a-step"] / parts)
        row = sheet.run(impact, scheme).rows[50 * parts]
        assert row.velocity_final is not None
        # The row's depth is that half a step before its final velocity.
        reached = row.depth + row.velocity_final * impact.step / 2
        errors.append(reached - depth.depth_at_velocity(row.velocity_final, **impact.motion))
    return math.log2(errors[0] / errors[1])


def _first_difference(evidence: Evidence) -> Fraction:
    """Return the first row in which the schemes' decelerations differ in three digits."""
    runs = (sheet.run(case(evidence.results, 5), scheme).rows for scheme in Scheme)
    for number, rows in enumerate(zip(*runs, strict=False)):
        if len({f"{row.deceleration:.2E}" for row in rows}) > 1:
            return Fraction(number)
    raise ValueError("the two schemes print the same decelerations in every row")


def _middle_density(evidence: Evidence) -> Fraction:
    """Return the least target density with which drag at the middle velocity gives 7.67 um."""
    ledger = evidence.results.ledger
    claim = ledger.claims["depth-beta-5"]
    printed = {name: ledger.value(name) for name in claim.stated}
    function = ledger.function(claim, scheme=Scheme.CENTERED)
    admitted = evidence.results.judge.inference(DENSITY, scheme=Scheme.CENTERED).outer.ends
    return solve(function, DENSITY, admitted, claim.target(), SHEET_BUDGET, printed).outer[0][0]


def _added(evidence: Evidence) -> float:
    """Return the velocity after three rows of a sheet that adds a dt instead of subtracting it."""
    impact = case(evidence.results, 5)
    fixed = (impact.radius, impact.mass, impact.target_density, impact.target_resistance)
    x, v = 0.0, impact.velocity
    for row in range(3):
        x += v * impact.step * (1 if row else 0.5)
        v += sheet.deceleration(x, v, *fixed) * impact.step
    return v


def _nearest(evidence: Evidence) -> Fraction:
    """Return the resistance on the grid whose derived X/R comes nearest to the observed one."""
    claim = evidence.results.ledger.claims["frank-zook-stainless"]
    inputs = {key: evidence[name] for key, (name,) in claim.inputs.items()}
    grid, observed = Fraction(evidence.value("grid")), evidence["observed-depth-ratio"]

    def distance(resistance: Fraction) -> float:
        given = inputs | {"resistance": float(resistance)}
        return abs(estimates.frank_zook_derived(**given) - observed)

    return min((grid * k for k in range(1, 200)), key=distance)


def _mean_deviation(evidence: Evidence) -> float:
    """Return the mean |(d/d_0)^-1/2 - 1| V for normal d > 0, by the midpoint rule in d/d_0."""
    normal = NormalDist(1.0, evidence["diameter-deviation"] / evidence["mean-diameter"])
    sizes = [(k + 0.5) / 10_000 for k in range(20_000)]
    mean = fmean((abs(d**-0.5 - 1) for d in sizes), weights=map(normal.pdf, sizes))
    return mean * evidence["a1-initial-velocity"]


_BESIDES: Mapping[str, Callable[[Evidence], Value]] = {
    "frank-zook-values: nearest": _nearest,
    "two-schemes: order_plain": partial(_order, scheme=Scheme.PUBLISHED),
    "two-schemes: order_middle": partial(_order, scheme=Scheme.CENTERED),
    "two-schemes: middle_density": _middle_density,
    "two-schemes: row": _first_difference,
    "table-columns: plus": _added,
    "equation-1-scatter: drag_exact": _mean_deviation,
    "wrong-reference: stress": lambda e: "Sigma" in e.results.ledger.printed_text("eq1"),
}
"""The functions for evidence that has no formula, by the finding and the name of the piece."""

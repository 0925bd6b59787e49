"""The audit: every verdict, explanation and finding, computed once, as one record."""

import sys
from collections.abc import Iterable, Mapping
from dataclasses import replace
from fractions import Fraction
from hashlib import sha256
from importlib import metadata, resources
from itertools import product
from math import inf, isclose, nextafter
from types import SimpleNamespace

from reference import findings as asserted
from reference import ledger as ledgers
from reference.arithmetic import Floats
from reference.equations import MATHML, PLAIN, EquationError, Node, Notation, evaluate, rendered
from reference.ledger import INFERRED, Claim, Convention, Ledger
from reference.printed import Interval
from reference.units import to_si
from replication.audit import comparison, wording
from replication.audit import record as r
from replication.audit.findings import EVIDENCE, Known, case
from replication.audit.verdict import Judgement, Reading, Verdict
from replication.models import sheet
from replication.text import number, powers_of_ten


def audit(ledger: Ledger | None = None) -> r.Record:
    """Audit every number and equation of the report, or of a copy of its ledger with a misprint.

    >>> print(audit().claim("depth-beta-5").verdict)
    reproduced
    """
    return Audit(ledger or ledgers.load()).record()


def audit_claim(name: str) -> r.ClaimRecord:
    """Audit one claim. Raises KeyError if the ledger has none of this id."""
    whole = Audit(ledgers.load())
    return whole.claim(whole.ledger.claims[name])


class Audit(Known):
    """The audit of one ledger."""

    def record(self) -> r.Record:
        """Everything, as data."""
        claims = [self.claim(claim) for claim in self.ledger.claims.values()]
        equations = [self._equation(name) for name in self.ledger.equations]
        findings = [self._finding(finding) for finding in asserted.load().values()]
        headline = next(finding for finding in findings if finding.kind == "headline")
        verdicts = {
            part.id: Verdict(part.verdict) for parts in (claims, equations) for part in parts
        }
        wrong = [name for name, verdict in verdicts.items() if verdict.is_failure]
        counts = self._counts(claims, equations)
        return r.Record(
            schema=r.SCHEMA,
            headline=headline.statement if headline.holds else f"{counts.failing} numbers fail.",
            report=r.filled(r.ReportRecord, self.ledger.report),
            summary={v.value: sum(claim.verdict == v for claim in claims) for v in Verdict},
            counts=counts,
            culprit=self.explainer.culprit(wrong),
            claims=claims,
            equations=equations,
            findings=[finding for finding in findings if finding is not headline],
            inferred=[
                self._inferred(name, centered)
                for name in self.ledger.inferred
                for centered in (False, True)
            ],
            approaches=comparison.approaches(self),
            sensitivity=[comparison.sensitivity(self, beta) for beta in comparison.BETAS],
            scatter=comparison.scatter(self),
            curves=comparison.curves(self),
            velocity_curve=comparison.velocity_curve(self),
            ladders=comparison.ladders(self),
            blank_cells=list(self.ledger.blank),
            symbols={symbol.shown: symbol.means for symbol in self.ledger.symbols.values()},
            provenance=_provenance(),
        )

    def _counts(self, claims: list[r.ClaimRecord], equations: list[r.EquationRecord]) -> r.Counts:
        reproduced = [claim for claim in claims if claim.verdict == Verdict.REPRODUCED]
        calculations = {(c.computed_by or c.id, c.cell, str(c.rests_on)) for c in reproduced}
        remarks = sum(claim.kind in ("remark", "comparison") for claim in claims)
        return r.Counts(
            numbers=len(claims) - remarks,
            remarks=remarks,
            reproduced=len(reproduced),
            calculations=len(calculations),
            failing=sum(Verdict(claim.verdict).is_failure for claim in claims),
            equations=len(equations),
            equations_derived=sum(e.verdict == Verdict.REPRODUCED for e in equations),
            blank_cells=len(self.ledger.blank),
        )

    # Claims

    def claim(self, claim: Claim) -> r.ClaimRecord:
        """One claim, as data."""
        assessment = self.assessment(claim)
        first = assessment.readings[0] if assessment.readings else None
        fails = assessment.verdict.is_failure or any(
            reading.verdict is not Verdict.REPRODUCED for reading in assessment.readings[:1]
        )
        own = self._reading(claim, first) if first else _UNREAD
        interval = None if claim.printed is None and claim.bound is None else claim.interval()
        formula, mathml, by_hand = self._formula(claim, first)
        restates = claim.computation is not None and claim.computation.restates
        return r.filled(
            r.ClaimRecord,
            *(claim, claim.place, own),
            where=str(claim.place),
            quote=" ".join(claim.quote.split()),
            printed=claim.text,
            interval=_ends(interval) if interval else None,
            interval_exact=_exact(interval.lower, interval.upper) if interval else None,
            interval_text=str(interval) if interval else None,
            verdict=assessment.verdict,
            restates=claim.inputs["value"][0] if restates and "value" in claim.inputs else None,
            error_in_last_digit=_error(claim, first),
            readings=[self._reading(claim, reading) for reading in assessment.readings[1:]],
            rests_on={name: list(entries) for name, entries in claim.inputs.items()},
            assumes=wording.assumptions(self.judge, claim, own.computed),
            explanation=assessment.reason,
            formula=formula,
            mathml=mathml,
            by_hand=by_hand,
            shown_by=self.shown(claim),
            sources=self.sources(claim),
            figures=self._figures(claim),
            back_solved=self.explainer.back_solved(claim) if fails and first else [],
            repairs=self.explainer.repairs(claim.id) if fails else [],
            slips=self.explainer.slips(claim) if fails and first else [],
        )

    @staticmethod
    def _reading(claim: Claim, reading: Reading) -> r.ReadingRecord:
        judgement = reading.judgements[0]
        witness = judgement.witness
        return r.filled(
            r.ReadingRecord,
            reading,
            enclosure=_outward(judgement.lower, judgement.upper),
            enclosure_exact=_exact(judgement.lower, judgement.upper),
            witness={k: float(value) for k, value in witness.items()} if witness else None,
            holds=wording.holds(claim, reading),
            otherwise=[_judged(j) for j in reading.otherwise],
        )

    def _formula(self, claim: Claim, reading: Reading | None) -> tuple[str | None, ...]:
        """Of a failing claim: its formula with the numbers in it, as MathML too, and by hand.

        None where it takes more than one equation of the report.
        """
        nothing, computation = (None, None, None), claim.computation
        if reading is None or reading.verdict is not Verdict.NOT_REPRODUCED:
            return nothing
        if computation is None or not computation.equations:
            return nothing
        *_, premise = computation.premises.values()
        (left, right) = self.ledger.sides[premise.equation]
        inputs = {key: names for key, names in claim.inputs.items() if len(names) == 1}
        values = {
            symbol: self.judge.value(*inputs[text])
            for symbol, text in premise.put.items()
            if text in inputs
        } | {"D": Fraction(1)}  # L is given in diameters
        try:
            value = evaluate(right, Floats(), {key: float(x) for key, x in values.items()})
        except EquationError:
            return nothing
        if not isclose(value, reading.computed, rel_tol=1e-9):
            return nothing
        names = {key: symbol.shown for key, symbol in self.ledger.symbols.items()}
        put = names | {key: _short(value) for key, value in values.items()}
        result = f"{reading.computed:#.3g}"
        texts = (
            rendered(left, names), rendered(right, names), rendered(right, put, _NUMBERS), result,
        )  # fmt: skip
        cells = (
            rendered(left, names, MATHML), rendered(right, names, MATHML),
            "", rendered(right, put, _MATHML_NUMBERS),
            "", f"<mn>{result}</mn>",
        )  # fmt: skip
        row = "<mtr><mtd>{}</mtd><mtd><mo>=</mo></mtd><mtd>{}</mtd></mtr>"
        table = _math(f"<mtable>{(3 * row).format(*cells)}</mtable>")
        return " = ".join(texts), table, _by_hand(right, put, values, result)

    def _figures(self, claim: Claim) -> list[r.Figure]:
        """For a remark: the final depths at both steps, in both schemes."""
        if claim.kind != "remark":
            return []
        figures = []
        for beta, scheme in product(comparison.BETAS, sheet.SCHEMES):
            where = "initial" if scheme == "published" else "middle"
            with_what = f"beta = {beta}, drag at the {where} velocity"
            depths = []
            for name in ("a-step", "coarse-step"):
                impact = case(self, beta, step=self[name])
                depths.append(sheet.run(impact, scheme).final_depth)
                step = wording.quantity(self.ledger.claims[name].shown, "ns")
                means = f"final depth at {step}, {with_what}"
                figures.append(r.Figure(means=means, value=depths[-1] * 1e6, unit="um"))
            change = 100 * (depths[1] / depths[0] - 1)
            figures.append(r.Figure(means=f"change, {with_what}", value=change, unit="percent"))
        return figures

    # Equations and findings

    def _equation(self, name: str) -> r.EquationRecord:
        assessed = self.equation(name)
        place = assessed.equation.place
        shown = {key: symbol.shown for key, symbol in self.ledger.symbols.items()}
        sides = [rendered(side, shown, MATHML) for side in self.ledger.sides[name]]
        repairs = self.explainer.repairs(name) if assessed.verdict.is_failure else []
        return r.filled(
            r.EquationRecord,
            *(assessed.equation, assessed),
            number=place.equation,
            where=str(place),
            text=self.ledger.printed_text(name),
            mathml=_math("<mo>=</mo>".join(sides)),
            factor=None if assessed.factor is None else str(assessed.factor),
            checks=[r.filled(r.CheckRecord, check) for check in assessed.checks],
            constants=list(assessed.constants.values()),
            explanation=wording.equation_explanation(self.ledger, assessed),
            repairs=repairs,
        )

    def _finding(self, finding: asserted.Finding) -> r.FindingRecord:
        try:
            computed = EVIDENCE[finding.id](self)
        except (ArithmeticError, IndexError, ValueError):  # in a report with a misprint
            computed = {}
        evidence = []
        for name, assertion in finding.evidence.items():
            value = computed.get(name)
            if value is not None and not isinstance(value, bool):
                value = Fraction(value) / to_si(assertion.unit)
            evidence.append(
                r.filled(
                    r.EvidenceRecord,
                    assertion,
                    name=name,
                    asserted=assertion.says,
                    computed=float(value) if isinstance(value, Fraction) else value,
                    holds=value is not None and assertion.holds(value),
                )
            )
        return r.filled(
            r.FindingRecord,
            finding,
            claims=list(finding.claims),
            holds=all(e.holds for e in evidence) and all(finding.steps.values()),
            evidence=evidence,
        )

    def _inferred(self, name: str, centered: bool) -> r.InferredRecord:
        inference = self.judge.inference(INFERRED + name, centered=centered)
        entry, si = inference.entry, 1 / to_si(inference.entry.unit)
        inner = inference.inner.scaled(si).ends
        rounded = None if centered else inference.admitted(Convention())
        return r.filled(
            r.InferredRecord,
            entry,
            id=name,
            scheme="centered" if centered else "published",
            assumed=float(self.judge.value(INFERRED + name) * si),
            interval=_inward(*inner),
            interval_exact=(str(inner[0]), str(inner[1])),
            with_printed_mass=_inward(*inference.with_mass.scaled(si).ends),
            attained_with_rounded_inputs=rounded and _inward(*rounded[0].scaled(si).ends),
            possible_with_rounded_inputs=rounded and _outward(*rounded[1].scaled(si).ends),
            evidence=list(inference.agreeing),
            odd=list(inference.odd),
            sources=[
                r.HandbookRecord(
                    source=r.filled(r.SourceRecord, source, agrees=None),
                    verdict=inference.admits(source.value, source.interval),
                )
                for source in self.ledger.sources.values()
                if INFERRED + name in source.claims and not centered
            ],
        )


_UNREAD = SimpleNamespace(
    computed=None, reference=None, enclosure=None, enclosure_exact=None, witness=None, holds="",
    otherwise=[],
)  # fmt: skip
"""Of a claim that nothing computes."""


def _short(value: Fraction) -> str:
    """A number as it is put into a formula.

    >>> _short(Fraction(2, 3)), _short(Fraction(8900)), _short(Fraction(76 * 10**8))
    ('2/3', '8900', '7.6×10⁹')
    """
    return str(value) if 1 < value.denominator < 10 else powers_of_ten(number(value))


def _with_numbers(notation: Notation) -> Notation:
    """The notation of an equation with numbers in it: 2 · 3 for 2 3, and a for a/1."""
    unit = notation.number("1")

    def fraction(over: str, under: str) -> str:
        return over if under == unit else notation.fraction(over, under)

    return replace(notation, fraction=fraction, times=_TIMES[notation.times])


_TIMES = {PLAIN.times: " · ", MATHML.times: "<mo>·</mo>"}
_NUMBERS, _MATHML_NUMBERS = _with_numbers(PLAIN), _with_numbers(MATHML)


def _by_hand(
    right: Node, put: Mapping[str, str], values: Mapping[str, Fraction], result: str
) -> str:
    """The factors of a product, each calculated from the numbers put in, and the product."""
    at = {name: float(value) for name, value in values.items()}
    factors = right.parts if right.kind == "product" else (right,)
    texts = [f"{evaluate(factor, Floats(), at):#.5g}" for factor in factors]
    steps = [
        f"{rendered(factor, put, _NUMBERS)} = {text}"
        for factor, text in zip(factors, texts, strict=True)
    ]
    if len(steps) > 1:
        steps.append(f"{' · '.join(texts)} = {result}")
    return "; ".join(steps) + "."


def _math(inner: str) -> str:
    return f'<math display="block">{inner}</math>'


def _judged(judgement: Judgement) -> r.Judged:
    convention = judgement.convention
    return r.Judged(
        rounding=convention.rounding.value,
        choices="exact" if convention.choices_exact else "rounded",
        header="exact" if convention.header_exact else "rounded",
        scheme="centered" if convention.centered else "published",
        verdict=judgement.verdict,
        enclosure=_outward(judgement.lower, judgement.upper),
        enclosure_exact=_exact(judgement.lower, judgement.upper),
    )


def _error(claim: Claim, reading: Reading | None) -> float | None:
    """Computed minus printed, in units of the last digit; None where no digit counts."""
    printed = claim.printed
    if reading is None or printed is None or claim.bound is not None or printed.quantum == 0:
        return None
    quantum = printed.quanta[-1] if claim.kind == "approximation" else printed.quantum
    return float((Fraction(reading.computed) - printed.value) / quantum)


def _ends(interval: Interval) -> r.Ends:
    lower, upper = (None if end is None else float(end) for end in (interval.lower, interval.upper))
    return lower, upper


def _exact(lower: Fraction | None, upper: Fraction | None) -> r.ExactEnds:
    return None if lower is None else str(lower), None if upper is None else str(upper)


def _outward(lower: Fraction, upper: Fraction) -> tuple[float, float]:
    """Ends as doubles, rounded so that the interval is never narrower."""
    return _down(lower), -_down(-upper)


def _inward(lower: Fraction, upper: Fraction) -> tuple[float, float]:
    return -_down(-lower), _down(upper)


def _down(value: Fraction) -> float:
    """The greatest double that is not above the value."""
    double = float(value)
    return nextafter(double, -inf) if Fraction(double) > value else double


_LIBRARIES = ("coldspray", "msgspec", "mpmath", "numpy", "python-flint", "XlsxWriter")


def _provenance() -> dict[str, object]:
    """What the audit was made with, and of."""
    folder = resources.files("reference") / "report"
    names: Iterable[str] = ("de_rosset_2006.txt", "ledger.toml", "findings.toml", "sources.toml")
    return {
        "command": "coldspray audit",
        "python": ".".join(map(str, sys.version_info[:3])),
        "versions": {name: metadata.version(name) for name in _LIBRARIES},
        "sha256": {name: sha256((folder / name).read_bytes()).hexdigest() for name in names},
    }

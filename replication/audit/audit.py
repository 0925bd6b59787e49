"""The audit: every verdict, explanation and finding, put together as one record."""

import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from fractions import Fraction
from functools import cached_property, partial
from hashlib import sha256
from importlib import metadata, resources
from itertools import product
from math import inf, isclose, nextafter
from types import SimpleNamespace
from typing import Any

from msgspec.structs import replace

from reference import ledger as ledgers
from reference.arithmetic import Floats, Rationals
from reference.equations import MATHML, PLAIN, Equations, NoValueError, evaluate, rendered
from reference.ledger import INFERRED, Claim, Convention, Ledger
from reference.scheme import Scheme
from reference.units import to_si
from replication.audit import comparison, remarks, wording
from replication.audit import record as r
from replication.audit.findings import findings
from replication.audit.record import Verdict
from replication.audit.results import Results
from replication.audit.verdict import Judgement, Reading
from replication.text import number, powers_of_ten


def audit(ledger: Ledger | None = None) -> r.Record:
    """Audit every number and equation of the report, or of a ledger with planted misprints."""
    return Audit(ledger or ledgers.load()).record()


class Audit(Results):
    """The audit of one ledger: turns its results into records."""

    def record(self) -> r.Record:
        """Return the finished audit as data."""
        claims = [self.claim(claim) for claim in self.ledger.claims.values()]
        equations = [self._equation(name) for name in self.ledger.equations]
        headline, *others = findings(self)
        verdicts = {c.id: c.verdict for c in claims} | {e.id: e.verdict for e in equations}
        failing = [name for name, verdict in verdicts.items() if verdict.is_failure]
        counts = self._counts(claims, equations)
        count = "1 number fails." if counts.failing == 1 else f"{counts.failing} numbers fail."
        inferred = product(self.ledger.inferred, Scheme)
        return r.Record(
            schema=r.SCHEMA,
            headline=headline.statement if headline.holds else count,
            report=self.ledger.report,
            summary={v.value: sum(claim.verdict == v for claim in claims) for v in Verdict},
            counts=counts,
            culprit=self.explainer.culprit(failing),
            failing=failing,
            claims=claims,
            equations=equations,
            findings=others,
            inferred=[self._inferred(*pair) for pair in inferred],
            approaches=comparison.approaches(self),
            sensitivity=comparison.sensitivity(self),
            scatter=comparison.scatter(self),
            curves=comparison.curves(self),
            velocity_curve=comparison.velocity_curve(self),
            ladders=comparison.ladders(self),
            blank_cells=list(self.ledger.blank),
            symbols={symbol.shown: symbol.means for symbol in self.ledger.symbols.values()},
            provenance=_provenance(),
        )

    @staticmethod
    def _counts(claims: list[r.ClaimRecord], equations: list[r.EquationRecord]) -> r.Counts:
        reproduced = [claim for claim in claims if claim.verdict == Verdict.REPRODUCED]
        computed = [(c.reference, c.unit) for c in reproduced if c.reference is not None]
        values = {float(Fraction(digits) * to_si(unit)) for digits, unit in computed}
        remarks = sum(claim.kind in ("remark", "comparison") for claim in claims)
        return r.Counts(
            entries=len(claims),
            numbers=len(claims) - remarks,
            remarks=remarks,
            reproduced=len(reproduced),
            constants=len(reproduced) - len(computed),
            computed=len(computed),
            values=len(values),
            failing=sum(claim.verdict.is_failure for claim in claims),
            equations=len(equations),
            equations_derived=sum(e.verdict == Verdict.REPRODUCED for e in equations),
            equations_failing=sum(e.verdict.is_failure for e in equations),
        )

    # Claims

    def claim(self, claim: Claim) -> r.ClaimRecord:
        """Return the record of one claim."""
        assessment = self.judge.assess(claim)
        readings = [self._reading(claim, reading) for reading in assessment.readings]
        as_printed, *others = readings or [_NO_READING]
        is_open = assessment.verdict.is_open
        tried, fitting = self.slips(claim) if is_open and "eq16" in claim.uses else (None, [])
        interval = None if claim.printed is None and claim.bound is None else claim.interval()
        ends = interval and (interval.lower, interval.upper)
        return r.filled(
            r.ClaimRecord,
            *(claim, claim.place, as_printed),
            cell=claim.cell,
            where=str(claim.place),
            quote=" ".join(claim.quote.split()),
            printed=claim.text,
            interval=ends and tuple(end if end is None else float(end) for end in ends),
            interval_exact=ends and tuple(end if end is None else str(end) for end in ends),
            interval_text=str(interval) if interval else None,
            verdict=assessment.verdict,
            restates=claim.inputs.get("value", (None,))[0] if claim.restates else None,
            error_in_last_digit=_error(claim, as_printed.computed),
            readings=others,
            rests_on={name: list(entries) for name, entries in claim.inputs.items()},
            assumes=wording.assumptions(self.judge, claim, as_printed.computed),
            explanation=wording.explanation(self.judge, claim, assessment),
            **self._worked(claim, as_printed.computed),
            shown_by=self.judge.shown(claim),
            sources=self.judge.sources(claim.id),
            figures=remarks.figures(self, claim),
            back_solved=self.explainer.back_solved(claim) if is_open and readings else [],
            repairs=self.explainer.repairs(claim.id) if is_open else [],
            slips=fitting,
            slips_tried=tried,
        )

    @staticmethod
    def _reading(claim: Claim, reading: Reading) -> r.ReadingRecord:
        judgement = reading.judgements[0]
        witness = {name: float(value) for name, value in (judgement.witness or {}).items()}
        return r.filled(
            r.ReadingRecord,
            reading,
            **_proven(judgement),
            witness=witness or None,
            holds=wording.holds(claim, reading),
            otherwise=[
                r.Judged(verdict=j.verdict, **r.in_words(j.convention), **_proven(j))
                for j in reading.otherwise
            ],
        )

    def _worked(self, claim: Claim, computed: float | None) -> dict[str, str | None]:
        """Return a claim's formula with its numbers put in, its equation, and the steps by hand.

        All are None unless the claim is not reproduced and an equation of the report gives it.
        """
        nothing = dict.fromkeys(("formula", "mathml", "by_hand"))
        wrong = self.judge.assess(claim).verdict is Verdict.NOT_REPRODUCED
        if computed is None or not wrong or not claim.uses:
            return nothing
        equations = _Evaluations(self.ledger.sides)
        compute = self.ledger.function(claim, equations=equations)
        with suppress(ArithmeticError):  # the value itself may be irrational
            compute(Rationals(), **{entry: self.judge.value(entry) for entry in claim.entries})
        if equations.last is None:
            return nothing
        equation, values = equations.last  # which may give the value itself
        *_, right = sides = self.ledger.sides[equation]
        doubles = {key: float(value) for key, value in values.items()}
        value_of = partial(evaluate, ar=Floats(), values=doubles)
        try:
            if not isclose(value_of(right), computed, rel_tol=1e-9):
                return nothing
        except NoValueError:
            return nothing
        put_in = self._symbols | {key: _short(value) for key, value in values.items()}
        with_numbers = partial(rendered, shown=put_in, notation=_NUMBERS)
        factors = right.parts if right.kind == "product" else (right,)
        texts, result = [f"{value_of(factor):#.5g}" for factor in factors], f"{computed:#.3g}"
        steps = [f"{with_numbers(f)} = {text}" for f, text in zip(factors, texts, strict=True)]
        if len(steps) > 1:
            steps.append(f"{' · '.join(texts)} = {result}")
        in_symbols = (rendered(side, self._symbols) for side in sides)
        return {
            "formula": " = ".join((*in_symbols, with_numbers(right), result)),
            "mathml": self._mathml(equation),
            "by_hand": f"{'; '.join(steps)}.",
        }

    @cached_property
    def _symbols(self) -> dict[str, str]:
        """How a page shows each symbol, by its name in the ledger."""
        return {key: symbol.shown for key, symbol in self.ledger.symbols.items()}

    def _mathml(self, equation: str) -> str:
        sides = (rendered(side, self._symbols, MATHML) for side in self.ledger.sides[equation])
        return f'<math display="block">{"<mo>=</mo>".join(sides)}</math>'

    # Equations and inferred inputs

    def _equation(self, name: str) -> r.EquationRecord:
        assessed = self.judge.equation(name)
        place = assessed.equation.place
        return r.filled(
            r.EquationRecord,
            *(assessed.equation, assessed),
            number=place.equation,
            where=str(place),
            text=self.ledger.printed_text(name),
            mathml=self._mathml(name),
            factor=None if assessed.factor is None else str(assessed.factor),
            constants=list(assessed.constants.values()),
            explanation=wording.equation_explanation(self.ledger, assessed),
            repairs=self.explainer.repairs(name) if assessed.verdict.is_failure else [],
        )

    def _inferred(self, name: str, scheme: Scheme) -> r.InferredRecord:
        is_usual = scheme is Scheme.PUBLISHED
        inference = self.judge.inference(INFERRED + name, scheme=scheme)
        entry, si = inference.entry, 1 / to_si(inference.entry.unit)
        inner = inference.inner.scaled(si).ends
        rounded = inference.admitted(Convention()) if is_usual else None
        return r.filled(
            r.InferredRecord,
            entry,
            id=name,
            scheme=scheme,
            assumed=float(self.judge.value(INFERRED + name) * si),
            interval=_doubles(*inner, inward=True),
            interval_exact=(str(inner[0]), str(inner[1])),
            with_printed_mass=_doubles(*inference.with_mass.scaled(si).ends, inward=True),
            possible_with_rounded_inputs=rounded and _doubles(*rounded.scaled(si).ends),
            evidence=list(inference.agreeing),
            odd=list(inference.odd),
            sources=self.judge.sources(INFERRED + name) if is_usual else [],
        )


class _Evaluations(Equations):
    """The printed equations, with the last one that was evaluated and its symbols' values."""

    last: tuple[str, Mapping[str, Fraction]] | None = None

    def __getitem__(self, name: str) -> Callable[..., Any]:
        evaluated = super().__getitem__(name)

        def remembered(ar: Any, **symbols: Any) -> Any:
            self.last = name, {symbol: Fraction(value) for symbol, value in symbols.items()}
            return evaluated(ar, **symbols)

        return remembered


_NO_READING: Any = SimpleNamespace(
    **{**dict.fromkeys(r.ReadingRecord.__struct_fields__), "holds": "", "otherwise": []}
)
"""The reading of a claim that no computation gives."""


def _short(value: Fraction) -> str:
    """Return a number as it is put into a formula, such as 2/3, 8900 or 7.6×10⁹."""
    return str(value) if 1 < value.denominator < 10 else powers_of_ten(number(value))


_NUMBERS = replace(
    PLAIN,
    times=" · ",
    fraction=lambda over, under: over if under == "1" else f"{over}/{under}",
)
"""The notation of an equation with numbers put in: a dot between factors, and a for a/1."""


def _error(claim: Claim, computed: float | None) -> float | None:
    """Return computed less printed, in units of the last printed digit; None if it has no unit."""
    printed = claim.printed
    if computed is None or printed is None or claim.bound is not None or printed.quantum == 0:
        return None
    quantum = printed.quanta[-1] if claim.kind == "approximation" else printed.quantum
    return float((Fraction(computed) - printed.value) / quantum)


def _proven(judgement: Judgement) -> dict[str, Any]:
    """Return the fields for a proven range: as doubles, never narrower, and exactly."""
    return {
        "enclosure": _doubles(*judgement.ends),
        "enclosure_exact": tuple(map(str, judgement.ends)),
    }


def _doubles(lower: Fraction, upper: Fraction, inward: bool = False) -> tuple[float, float]:
    """Round the ends to doubles so that the interval never narrows, or if `inward` never widens."""
    if inward:
        return -_down(-lower), _down(upper)
    return _down(lower), -_down(-upper)


def _down(value: Fraction) -> float:
    """Return the greatest double that is not above the value."""
    double = float(value)
    return nextafter(double, -inf) if Fraction(double) > value else double


def _provenance() -> dict[str, object]:
    """Return the versions of the programs in use and the hashes of the files that were read."""
    folder = resources.files("reference") / "report"
    libraries = ("coldspray", "Jinja2", "msgspec", "mpmath", "python-flint", "XlsxWriter")
    files = ("de_rosset_2006.txt", "ledger.toml", "sources.toml")
    return {
        "command": "coldspray audit",
        "python": ".".join(map(str, sys.version_info[:3])),
        "versions": {name: metadata.version(name) for name in libraries},
        "sha256": {name: sha256((folder / name).read_bytes()).hexdigest() for name in files},
    }

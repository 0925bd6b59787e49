"""The audit: every verdict, explanation and finding, put together as one record."""

import sys
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from fractions import Fraction
from functools import cached_property, partial
from importlib import resources
from itertools import product
from math import isclose
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
from replication.audit.assessment import Standing, Verdict
from replication.audit.findings import findings
from replication.audit.results import Results
from replication.text import number, powers_of_ten


def audit(
    ledger: Ledger | None = None, progress: Callable[[Iterable[str]], Iterable[str]] = iter
) -> r.Record:
    """Audit every number and equation of the report, or of a ledger with planted misprints.

    `progress` wraps the iteration over the claims' ids, such as in a progress bar.
    """
    return Audit(ledger or ledgers.load()).record(progress)


class Audit(Results):
    """The audit of one ledger: turns its results into records."""

    def record(self, progress: Callable[[Iterable[str]], Iterable[str]] = iter) -> r.Record:
        """Return the finished audit; `progress` wraps the iteration over the ids of claims."""
        claims = [self.claim(name) for name in progress(self.ledger.claims)]
        equations = [self.equation(name) for name in self.ledger.equations]
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
            inferred=[self.inferred(*pair) for pair in inferred],
            approaches=comparison.approaches(self),
            sensitivity=comparison.sensitivity(self),
            scatter=comparison.scatter(self),
            curves=comparison.curves(self),
            velocity_curve=comparison.velocity_curve(self),
            ladders=comparison.ladders(self),
            blank_cells=list(self.ledger.blank),
            symbols={symbol.shown: symbol.means for symbol in self.ledger.symbols.values()},
            provenance=provenance(),
        )

    @staticmethod
    def _counts(claims: list[r.ClaimRecord], equations: list[r.EquationRecord]) -> r.Counts:
        reproduced = [claim for claim in claims if claim.verdict == Verdict.REPRODUCED]
        computed = [(c.as_printed.reference, c.claim.unit) for c in reproduced if c.as_printed]
        values = {float(Fraction(digits) * to_si(unit)) for digits, unit in computed}
        standings = Counter(claim.assessment.standing for claim in reproduced)
        open_ended = [c for c in reproduced if c.claim.bound is not None]
        bounds = sum(c.assessment.standing is Standing.INDEPENDENT for c in open_ended)
        remarks = sum(record.claim.kind == "remark" for record in claims)
        return r.Counts(
            entries=len(claims),
            numbers=len(claims) - remarks,
            remarks=remarks,
            reproduced=len(reproduced),
            constants=len(reproduced) - len(computed),
            computed=len(computed),
            values=len(values),
            independent=standings[Standing.INDEPENDENT],
            bounds=bounds,
            evidence=standings[Standing.EVIDENCE],
            by_definition=standings[Standing.BY_DEFINITION],
            repeats=standings[Standing.REPEATS],
            failing=sum(claim.verdict.is_failure for claim in claims),
            equations=len(equations),
            equations_derived=sum(e.verdict == Verdict.REPRODUCED for e in equations),
            equations_failing=sum(e.verdict.is_failure for e in equations),
        )

    # Claims

    def claim(self, name: str) -> r.ClaimRecord:
        """Return the record of one claim, by its id. Raises KeyError if there is none.

        >>> Audit(ledgers.load()).claim("depth-beta-5").verdict.value
        'reproduced'
        """
        claim = self.ledger.claims[name]
        assessment = self.judge.assess(claim)
        computed = assessment.readings[0].computed if assessment.readings else None
        explain, is_computed = assessment.verdict.needs_explanation, computed is not None
        tried, fitting = self.slips(claim) if explain and "eq16" in claim.uses else (None, [])
        return r.ClaimRecord(
            claim=claim,
            assessment=assessment,
            explanation=wording.explanation(self.judge, claim, assessment),
            scopes=[wording.scope(claim, reading) for reading in assessment.readings],
            assumes=wording.assumptions(self.judge, claim, computed),
            error_in_last_digit=_error(claim, computed),
            worked=self._worked(claim, computed),
            confirmed_range=self.judge.confirmed_range(claim),
            sources=self.judge.sources(name),
            figures=remarks.figures(self, claim),
            back_solved=self.explainer.back_solved(claim) if explain and is_computed else [],
            repairs=self.explainer.repairs(name) if explain else [],
            slips=fitting,
            slips_tried=tried,
        )

    def _worked(self, claim: Claim, computed: float | None) -> r.Worked | None:
        """Return a claim's formula with its numbers put in, its equation, and the steps by hand.

        None unless the claim is not reproduced and an equation of the report gives it.
        """
        wrong = self.judge.assess(claim).verdict is Verdict.NOT_REPRODUCED
        if computed is None or not wrong or not claim.uses:
            return None
        equations = _Evaluations(self.ledger.sides)
        compute = self.ledger.function(claim, equations=equations)
        with suppress(ArithmeticError):  # the value itself may be irrational
            compute(Rationals(), **{entry: self.judge.value(entry) for entry in claim.input_ids})
        if equations.last is None:
            return None
        equation, values = equations.last  # which may give the value itself
        *_, right = sides = self.ledger.sides[equation]
        doubles = {key: float(value) for key, value in values.items()}
        value_of = partial(evaluate, ar=Floats(), values=doubles)
        try:
            if not isclose(value_of(right), computed, rel_tol=1e-9):
                return None
        except NoValueError:
            return None
        put_in = self._symbols | {key: _short(value) for key, value in values.items()}
        with_numbers = partial(rendered, shown=put_in, notation=_NUMBERS)
        factors = right.parts if right.kind == "product" else (right,)
        texts, result = [f"{value_of(factor):#.5g}" for factor in factors], f"{computed:#.3g}"
        steps = [f"{with_numbers(f)} = {text}" for f, text in zip(factors, texts, strict=True)]
        if len(steps) > 1:
            steps.append(f"{' · '.join(texts)} = {result}")
        in_symbols = (rendered(side, self._symbols) for side in sides)
        return r.Worked(
            formula=" = ".join((*in_symbols, with_numbers(right), result)),
            mathml=self._mathml(equation),
            by_hand=f"{'; '.join(steps)}.",
        )

    @cached_property
    def _symbols(self) -> dict[str, str]:
        """How a page shows each symbol, by its name in the ledger."""
        return {key: symbol.shown for key, symbol in self.ledger.symbols.items()}

    def _mathml(self, equation: str) -> str:
        sides = (rendered(side, self._symbols, MATHML) for side in self.ledger.sides[equation])
        return f'<math display="block">{"<mo>=</mo>".join(sides)}</math>'

    # Equations and inferred inputs

    def equation(self, name: str) -> r.EquationRecord:
        """Return the record of one equation, by its id. Raises KeyError if there is none.

        >>> Audit(ledgers.load()).equation("eq16").assessment.factor
        Fraction(1, 2)
        """
        assessed = self.judge.assess_equation(name)
        return r.EquationRecord(
            assessment=assessed,
            text=self.ledger.printed_text(name),
            mathml=self._mathml(name),
            explanation=wording.equation_explanation(self.ledger, assessed),
            repairs=self.explainer.repairs(name) if assessed.verdict.is_failure else [],
        )

    def inferred(self, name: str, scheme: Scheme) -> r.InferredRecord:
        """Return what the evidence admits of an input that the report does not print."""
        is_usual = scheme is Scheme.PUBLISHED
        inference = self.judge.inference(INFERRED + name, scheme=scheme)
        si = 1 / to_si(inference.entry.unit)
        rounded = inference.admitted(Convention()) if is_usual else None
        return r.InferredRecord(
            id=name,
            entry=inference.entry,
            scheme=scheme,
            assumed=float(self.judge.value(INFERRED + name) * si),
            interval=inference.inner.scaled(si).ends,
            with_printed_mass=inference.with_mass.scaled(si).ends,
            possible_with_rounded_inputs=None if rounded is None else rounded.scaled(si).ends,
            evidence=inference.agreeing,
            odd=inference.odd,
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


LIBRARIES = "coldspray", "Jinja2", "msgspec", "mpmath", "python-flint", "XlsxWriter"
"""The distributions whose versions may change a byte of the files."""


def provenance() -> dict[str, Any]:
    """Return the versions of the programs in use and the hashes of the files that were read.

    A library that is not installed is left out, as an audit without its files can do without some.
    """
    from hashlib import sha256
    from importlib import metadata

    folder = resources.files("reference") / "report"
    versions = {}
    for name in LIBRARIES:
        with suppress(metadata.PackageNotFoundError):
            versions[name] = metadata.version(name)
    files = ("de_rosset_2006.txt", "ledger.toml", "sources.toml")
    return {
        "command": "coldspray audit",
        "python": ".".join(map(str, sys.version_info[:3])),
        "versions": versions,
        "sha256": {name: sha256((folder / name).read_bytes()).hexdigest() for name in files},
    }

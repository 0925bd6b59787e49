"""What failed or surprising claims teach: asserted in `reference`, computed anew by every audit."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from reference import findings as texts
from reference.findings import Assertion, FindingText
from reference.ledger import Ledger
from reference.units import to_si
from replication.audit.findings import crater, density, frank_zook, scheme, strength, wording
from replication.audit.findings.known import Computed, Known
from replication.audit.verdict import Assessment

__all__ = ["Evidence", "Finding", "findings"]

EVIDENCE = {
    **frank_zook.EVIDENCE,
    **density.EVIDENCE,
    **scheme.EVIDENCE,
    **crater.EVIDENCE,
    **strength.EVIDENCE,
    **wording.EVIDENCE,
}
"""For each finding the function that computes its evidence, in SI units."""


@dataclass(frozen=True, slots=True)
class Evidence:
    """One number of a finding: as asserted, and as this audit computed it (in its unit)."""

    assertion: Assertion
    computed: Fraction | float | bool

    @property
    def is_outcome(self) -> bool:
        """Whether it is the outcome of a proof, not a number."""
        return isinstance(self.computed, bool)

    @property
    def holds(self) -> bool:
        """Whether the computed number is as asserted."""
        return self.assertion.holds(self.computed)


@dataclass(frozen=True, slots=True)
class Finding:
    """One finding with its evidence."""

    text: FindingText
    evidence: tuple[Evidence, ...]

    @property
    def holds(self) -> bool:
        """Whether all its evidence does."""
        return all(piece.holds for piece in self.evidence)

    @property
    def title(self) -> str:
        """Its title, numbers filled in."""
        return self.text.filled(self.text.title)


def findings(ledger: Ledger, assessments: Mapping[str, Assessment]) -> list[Finding]:
    """All findings, the weightiest first."""
    known = Known(ledger, assessments)
    return [_finding(text, EVIDENCE[name](known)) for name, text in texts.load().items()]


def _finding(text: FindingText, computed: Computed) -> Finding:
    if set(computed) != set(text.evidence):
        raise AssertionError(f"{text.id}: {set(computed) ^ set(text.evidence)}")
    evidence = tuple(
        Evidence(assertion, _in_unit(computed[name], assertion.unit))
        for name, assertion in text.evidence.items()
    )
    return Finding(text, evidence)


def _in_unit(computed: Fraction | float | bool, unit: str) -> Fraction | float | bool:
    if isinstance(computed, bool) or unit == "1":
        return computed
    exact = Fraction(computed) / to_si(unit)
    return exact if isinstance(computed, Fraction) else float(exact)

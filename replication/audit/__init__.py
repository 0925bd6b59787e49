"""The audit: a verdict with its proof for every number that the report prints."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from reference import ledger as ledgers
from reference.ledger import Ledger
from replication.audit.findings import Finding, findings
from replication.audit.verdict import Assessment, Verdict, assess
from spreadsheets.plan import Cell

__all__ = ["Audit", "Verdict", "assess_claim", "audit"]


@dataclass(frozen=True, slots=True)
class Audit:
    """All verdicts by claim id, in the report's order, and the findings."""

    ledger: Ledger
    assessments: Mapping[str, Assessment]
    findings: tuple[Finding, ...]

    @property
    def summary(self) -> dict[str, int]:
        """How many claims got each verdict."""
        verdicts = [assessment.verdict for assessment in self.assessments.values()]
        return {verdict.value: verdicts.count(verdict) for verdict in Verdict}

    @property
    def reproduced_kinds(self) -> dict[str, int]:
        """How many reproduced claims are computed, merely repeat another, or are blank cells."""
        kinds = [_kind(assessment) for assessment in self.with_verdict(Verdict.REPRODUCED)]
        return {kind: kinds.count(kind) for kind in ("computed", "restated", "blank cells")}

    def with_verdict(self, verdict: Verdict) -> list[Assessment]:
        """The claims that got this verdict."""
        return [a for a in self.assessments.values() if a.verdict is verdict]


def audit() -> Audit:
    """Audit every claim of the report.

    >>> audit().assessments["depth-beta-5"].verdict.value
    'reproduced'
    """
    ledger = ledgers.load()
    assessments = {name: assess_claim(ledger, name) for name in ledger.claims}
    return Audit(ledger, assessments, tuple(findings(ledger, assessments)))


def assess_claim(ledger: Ledger, name: str) -> Assessment:
    """The verdict on one claim, blank cells included."""
    return assess(ledger, ledger.claims[name], _cell_is_blank)


def _kind(assessment: Assessment) -> str:
    if assessment.reading is None:
        return "blank cells"
    restates = assessment.reading.computation.name in ("same_as", "count")
    return "restated" if restates else "computed"


def _cell_is_blank(address: str) -> bool:
    cell = _table_cells().get(address)
    return cell is None or not (cell.text.strip() or cell.key)


@cache
def _table_cells() -> Mapping[str, Cell]:
    from replication import (
        workbook,
    )  # the proof of one number need not wait for the workbook's code

    return next(s.cells for s in workbook.build()[0].sheets if s.name == "Table A-1")

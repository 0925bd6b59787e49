"""The audit: a verdict with its proof for every number that the report prints."""

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from types import ModuleType

from reference import ledger as ledgers
from reference.conjectures import load as load_conjectures
from reference.ledger import Ledger
from replication.audit.assessed import assess_claim
from replication.audit.explanations.joint import JointAnswer, consistency
from replication.audit.findings import Finding, findings
from replication.audit.verdict import Assessment, Verdict

__all__ = ["Audit", "Verdict", "assess_claim", "audit"]


@dataclass(frozen=True, slots=True)
class Audit:
    """All verdicts by claim id, in the report's order, the findings, and the joint questions."""

    ledger: Ledger
    assessments: Mapping[str, Assessment]
    findings: tuple[Finding, ...]
    joint: tuple[JointAnswer, ...]

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
    joint = tuple(consistency(ledger, question) for question in load_conjectures().joint)
    return Audit(ledger, assessments, tuple(findings(ledger, assessments)), joint)


def _kind(assessment: Assessment) -> str:
    if assessment.reading is None:
        return "blank cells"
    restates = assessment.reading.computation.name in ("same_as", "count")
    return "restated" if restates else "computed"


class _Audit(ModuleType):
    """`replication.audit` names a function to users, and this package: so it can be called."""

    def __call__(self) -> Audit:
        return audit()


sys.modules[__name__].__class__ = _Audit

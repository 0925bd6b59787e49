"""What would explain a number that does not follow: nothing here is asserted, all is tried."""

from dataclasses import dataclass
from functools import cache

from reference.conjectures import load
from reference.ledger import Ledger
from replication.audit.assessed import assess_claim
from replication.audit.explanations.alternatives import Alternative, Alternatives, alternatives
from replication.audit.explanations.backsolve import BackSolved, back_solve
from replication.audit.explanations.misprints import Misprint, misprints
from replication.audit.verdict import Verdict

__all__ = ["Explanation", "explain_claim"]


@dataclass(frozen=True, slots=True)
class Explanation:
    """What was tried for one claim: empty where it is plainly reproduced or not checkable."""

    back_solved: tuple[BackSolved, ...]
    misprints: tuple[Misprint, ...]
    alternatives: Alternatives | None

    def listed(self, claim: str) -> list[Alternative]:
        """The readings worth a line: all with one slip, and those with two that give the claim."""
        tried = () if self.alternatives is None else self.alternatives.tried
        return [a for a in tried if a.slips < 2 or a.explains(claim)]


@cache
def explain_claim(ledger: Ledger, name: str) -> Explanation:
    """Back-solving, misprints and other readings, for every reading of a claim that fails."""
    assessment, conjectures = assess_claim(ledger, name), load()
    claim = assessment.claim
    failing = [
        reading
        for reading in (assessment.reading, *assessment.others)
        if reading is not None and reading.verdict is not Verdict.REPRODUCED
    ]
    family = next((f for f in conjectures.families if name in f.claims and failing), None)
    return Explanation(
        tuple(b for r in failing for b in back_solve(ledger, conjectures, claim, r)),
        tuple(m for r in failing for m in misprints(ledger, conjectures, claim, r)),
        None if family is None else alternatives(ledger, conjectures, family),
    )

"""What was tried for a failing claim, as plain records for JSON."""

from typing import Any

from reference.conjectures import load
from reference.ledger import Ledger
from reference.units import to_si
from replication.audit.explanations import explain_claim
from replication.audit.explanations.alternatives import Alternative
from replication.audit.explanations.backsolve import BackSolved
from replication.audit.explanations.joint import JointAnswer
from replication.audit.explanations.misprints import Misprint

__all__ = ["explanation_record", "joint_record"]


def explanation_record(ledger: Ledger, name: str) -> dict[str, Any]:
    """The keys `back_solved`, `misprints` and `alternatives` of a claim; inputs in their unit."""
    found = explain_claim(ledger, name)
    return {
        "back_solved": [_solved(solved) for solved in found.back_solved],
        "misprints": [_misprint(misprint) for misprint in found.misprints],
        "alternatives": [_alternative(a, name) for a in found.listed(name)],
        "alternatives_tried": 0 if found.alternatives is None else len(found.alternatives.tried),
    }


def _solved(solved: BackSolved) -> dict[str, Any]:
    si, quantity = to_si(solved.unit), load().quantity(solved.entry)
    return {
        "reading": solved.reading,
        "input": solved.entry,
        "title": solved.title,
        "unit": solved.unit,
        "printed": float(solved.printed / si),
        "search": [float(end) for end in quantity.search],
        "search_reason": quantity.reason,
        "intervals": [
            [float(end / si) for end in (part.lower, part.upper) if end is not None]
            for part in solved.solutions.inner
        ],
        "value": None if solved.value is None else solved.value / float(si),
        "proof": solved.proof,
        "within_rounding": solved.rounding,
        "marks": [
            {"kind": mark.kind, "name": mark.name, "value": float(mark.value / si)}
            for mark in solved.marks
        ],
    }


def _misprint(misprint: Misprint) -> dict[str, Any]:
    return {
        "what": misprint.what,
        "printed": misprint.printed,
        "edited": misprint.edit.text,
        "kind": misprint.edit.kind,
        "reading": misprint.reading,
        "computed": misprint.computed,
        "breaks": len(misprint.breaks),
        "breaks_first": misprint.breaks[0] if misprint.breaks else None,
    }


def _alternative(alternative: Alternative, name: str) -> dict[str, Any]:
    return {
        "name": alternative.name,
        "computed": alternative.computed[name],
        "verdict": alternative.verdicts[name].value,
        "explains_all": alternative.explains_all,
    }


def joint_record(answer: JointAnswer) -> dict[str, Any]:
    """One element of `joint`; the witness in SI."""
    witness = answer.witness
    return {
        "id": answer.question.id,
        "claims": list(answer.question.claims),
        "question": answer.question.question,
        "outcome": answer.outcome,
        "bound": answer.bound,
        "witness": None if witness is None else {k: float(v) for k, v in witness.items()},
    }

"""The audit as plain records: what the JSON, CSV and Markdown files are made of."""

from fractions import Fraction
from math import inf, nextafter
from typing import Any

from reference.ledger import Claim, Inferred, Ledger
from reference.printed import Interval
from replication.analysis.approaches import approaches
from replication.audit import Audit
from replication.audit.explain import assumptions, explanation
from replication.audit.findings import Finding
from replication.audit.inference import Inference, infer
from replication.audit.verdict import Assessment, Reading
from replication.reports.cells import workbook_cell
from replication.reports.comparison import approach_record, scatter_record, sensitivity_record
from replication.reports.explanations import explanation_record, joint_record
from replication.reports.numerics import numerics_record
from replication.reports.provenance import provenance

__all__ = [
    "SCHEMA",
    "audit_record",
    "claim_record",
    "finding_record",
    "ledger_record",
    "shown_record",
]

SCHEMA = "coldspray-audit-1"


def shown_record(audit: Audit, numerics: dict[str, Any]) -> dict[str, Any]:
    """The part of `audit.json` that figures show: `numerics_record` and comparisons."""
    ledger = audit.ledger
    return {
        **numerics,
        "approaches": [approach_record(one) for one in approaches(ledger, audit.assessments)],
        "sensitivity": sensitivity_record(ledger),
        "scatter": scatter_record(ledger, _observed(audit)),
    }


def audit_record(audit: Audit, shown: dict[str, Any] | None = None) -> dict[str, Any]:
    """The document of `audit.json`, keys as promised in the README, but for its workbook's hash.

    `shown`: its part that `shown_record` gives, if it is there already.
    """
    ledger = audit.ledger
    return {
        "schema": SCHEMA,
        "report": {"title": ledger.title, "author": ledger.author, "year": ledger.year},
        "summary": audit.summary,
        "reproduced": audit.reproduced_kinds,
        "claims": [_in_workbook(claim_record(ledger, a)) for a in audit.assessments.values()],
        "findings": [finding_record(finding) for finding in audit.findings],
        "joint": [joint_record(answer) for answer in audit.joint],
        "inferred": [_inference_record(infer(ledger, name)) for name in ledger.inferred],
        **(shown or shown_record(audit, numerics_record())),
        "provenance": provenance(),
    }


def _in_workbook(claim: dict[str, Any]) -> dict[str, Any]:
    return {**claim, "workbook": workbook_cell(claim["id"], claim["cell"])}


def _observed(audit: Audit) -> float:
    reading = audit.assessments["observed-depth-ratio"].reading
    assert reading is not None
    return reading.computed


def ledger_record(claim: Claim) -> dict[str, Any]:
    """What the ledger says of a claim, without a verdict."""
    return {
        "id": claim.id,
        "title": claim.title,
        "where": str(claim.place),
        "line": claim.place.line,
        "section": claim.place.section,
        "cell": claim.place.cell,
        "quote": " ".join(claim.quote.split()),
        "printed": claim.text,
        "unit": claim.unit,
        "kind": claim.kind,
        "like": claim.like,
    }


def claim_record(ledger: Ledger, assessment: Assessment) -> dict[str, Any]:
    """One element of `claims`; numbers in the claim's unit, inputs in SI."""
    claim, reading = assessment.claim, assessment.reading
    return {
        **ledger_record(claim),
        "interval": None if claim.interval is None else _interval(claim.interval),
        "interval_text": None if claim.interval is None else str(claim.interval),
        "verdict": assessment.verdict.value,
        **_reading(reading),
        "error_in_last_digit": assessment.error_in_last_digit,
        "readings": [
            {"name": other.name, "verdict": other.verdict.value, **_reading(other)}
            for other in assessment.others
        ],
        "rests_on": {name: list(entries) for name, entries in claim.inputs.items()},
        "assumes": assumptions(ledger, assessment),
        "explanation": explanation(ledger, assessment),
        **explanation_record(ledger, claim.id),
    }


def finding_record(finding: Finding) -> dict[str, Any]:
    """One element of `findings`: its texts with the numbers in them, and the evidence for these."""
    text = finding.text
    return {
        "id": text.id,
        "title": finding.title,
        "kind": text.kind,
        "status": text.status,
        "claims": list(text.claims),
        "statement": text.filled(text.statement),
        "by_hand": text.filled(text.by_hand),
        "settle": text.filled(text.settle),
        "holds": finding.holds,
        "evidence": [
            {
                "name": piece.assertion.name,
                "meaning": piece.assertion.means,
                "unit": piece.assertion.unit,
                "asserted": piece.assertion.says,
                "computed": piece.computed if piece.is_outcome else float(piece.computed),
                "holds": piece.holds,
            }
            for piece in finding.evidence
        ],
    }


def _reading(reading: Reading | None) -> dict[str, Any]:
    keys = ("computed_by", "computed", "reference", "enclosure", "witness")
    if reading is None:
        return dict.fromkeys(keys)
    witness = reading.witness
    values = (
        reading.computation.name,
        reading.computed,
        reading.reference,
        [_down(reading.enclosure[0]), _up(reading.enclosure[1])],
        None if witness is None else {name: float(value) for name, value in witness.items()},
    )
    return dict(zip(keys, values, strict=True))


def _interval(interval: Interval) -> list[float | None]:
    return [None if end is None else float(end) for end in (interval.lower, interval.upper)]


def _inside(interval: Interval) -> list[float]:
    """Ends as doubles, rounded inwards: what is proven of the interval is true of these."""
    lower, upper = interval.ends
    return [_up(lower), _down(upper)]


def _outside(interval: Interval) -> list[float]:
    lower, upper = interval.ends
    return [_down(lower), _up(upper)]


def _down(value: Fraction) -> float:
    """The greatest double that is not above the value."""
    double = float(value)
    return nextafter(double, -inf) if Fraction(double) > value else double


def _up(value: Fraction) -> float:
    return -_down(-value)


def _inference_record(inference: Inference) -> dict[str, Any]:
    entry: Inferred = inference.entry
    return {
        "id": entry.id,
        "title": entry.title,
        "unit": entry.unit,
        "nominal": float(entry.nominal),
        "nominal_source": entry.nominal_source,
        "interval": _inside(inference.inner),
        "interval_with_printed_mass": _inside(inference.with_mass),
        "interval_with_results": _inside(inference.with_results),
        "attained_with_rounded_inputs": _inside(inference.attained),
        "possible_with_rounded_inputs": _outside(inference.possible),
        "evidence": list(entry.evidence),
        "handbook": [
            {"name": name, "value": float(printed.value), "verdict": verdict}
            for name, (printed, verdict) in inference.handbook.items()
        ],
    }

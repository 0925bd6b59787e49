"""The audit as plain records: what the JSON, CSV and Markdown files are made of."""

import platform
from collections.abc import Iterable
from fractions import Fraction
from hashlib import sha256
from importlib import metadata, resources
from math import inf, nextafter
from typing import Any

from reference.ledger import Claim, Inferred, Ledger
from reference.printed import Interval
from replication.analysis.stability import HARD_CASES, outcome, worst_of
from replication.audit import Audit
from replication.audit.explain import assumptions, explanation
from replication.audit.findings import Finding
from replication.audit.inference import Inference, infer
from replication.audit.verdict import Assessment, Reading
from replication.reports.numerics import budget_record, budget_sheets, stability_record

__all__ = ["SCHEMA", "audit_record", "claim_record", "finding_record", "ledger_record"]

SCHEMA = "coldspray-audit-1"

RANDOM_CASES = 10_000
"""For the audit's files; `coldspray stability` runs ten times as many."""


def audit_record(audit: Audit) -> dict[str, Any]:
    """The document of `audit.json`; keys as promised in the README."""
    ledger = audit.ledger
    return {
        "schema": SCHEMA,
        "report": {"title": ledger.title, "author": ledger.author, "year": ledger.year},
        "summary": audit.summary,
        "reproduced": audit.reproduced_kinds,
        "claims": [claim_record(ledger, a) for a in audit.assessments.values()],
        "findings": [finding_record(finding) for finding in audit.findings],
        "inferred": [_inference_record(infer(ledger, name)) for name in ledger.inferred],
        "error_budget": [budget_record(sheet) for sheet in budget_sheets()],
        "stability": stability_record(
            [outcome(case) for case in HARD_CASES], worst_of(RANDOM_CASES, seed=1)
        ),
        "provenance": _provenance(),
    }


def ledger_record(claim: Claim) -> dict[str, Any]:
    """What the ledger says of a claim, without a verdict."""
    return {
        "id": claim.id,
        "title": claim.title,
        "where": str(claim.place),
        "line": claim.place.line,
        "printed": claim.text,
        "unit": claim.unit,
        "kind": claim.kind,
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
    assert interval.lower is not None
    assert interval.upper is not None
    return [_up(interval.lower), _down(interval.upper)]


def _outside(interval: Interval) -> list[float]:
    assert interval.lower is not None
    assert interval.upper is not None
    return [_down(interval.lower), _up(interval.upper)]


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


_LIBRARIES = (
    "coldspray", "mpmath", "numpy", "openpyxl", "pandas", "pint", "python-flint", "XlsxWriter",
)  # fmt: skip


def _provenance() -> dict[str, Any]:
    """What the audit was made with; no clock and no machine, so that it is the same again."""
    folder = resources.files("reference.report")
    files: Iterable[str] = ("de_rosset_2006.txt", "ledger.toml")
    return {
        "command": "coldspray audit",
        "python": platform.python_version(),
        "versions": {name: metadata.version(name) for name in _LIBRARIES},
        "sha256": {name: sha256((folder / name).read_bytes()).hexdigest() for name in files},
    }

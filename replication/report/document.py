"""Encode a record as `audit.json`, whose keys are a promise to users.

The installed file `audit.schema.json` describes every key; the tests compare the two. Some keys are
named otherwise here than in the program, where each of these words has one meaning: in JSON
`printed` is the printed text of a claim, a repair, an approach or a curve, and the printed value of
an input; `holds` is a sentence, or of a finding and its evidence a bool; `shown_by` is the range of
a chosen number that what is computed from it confirms.

Ranges are written twice: as doubles, rounded so that a proven range never narrows, and a range of
admitted values never widens; and as exact fractions such as "1533/200".
"""

from collections.abc import Mapping
from fractions import Fraction
from importlib import resources
from math import inf, nextafter
from typing import Any

from msgspec import to_builtins

from reference.enclosure import Ends
from reference.ledger import Convention
from replication.audit.assessment import Comparison, Judgement, Reading
from replication.audit.record import ClaimRecord, EquationRecord, InferredRecord, Record
from spreadsheets.sheets import cells_of_claims

Document = dict[str, Any]
"""A JSON object."""


def schema_text() -> str:
    """Return the JSON Schema of `audit.json` as it is installed."""
    return (resources.files("replication.report") / "audit.schema.json").read_text("utf-8")


def audit_document(record: Record) -> Document:
    """Encode a finished audit."""
    return {
        "schema": record.schema,
        "headline": record.headline,
        "report": to_builtins(record.report),
        "summary": record.summary,
        "counts": to_builtins(record.counts),
        "culprit": to_builtins(record.culprit),
        "failing": record.failing,
        "claims": [claim_document(claim) for claim in record.claims],
        "equations": [equation_document(equation) for equation in record.equations],
        "findings": to_builtins(record.findings),
        "inferred": [inferred_document(inferred) for inferred in record.inferred],
        "approaches": to_builtins(record.approaches),
        "sensitivity": to_builtins(record.sensitivity),
        "scatter": to_builtins(record.scatter),
        "curves": to_builtins(record.curves),
        "velocity_curve": to_builtins(record.velocity_curve),
        "ladders": to_builtins(record.ladders),
        "blank_cells": record.blank_cells,
        "symbols": record.symbols,
        "provenance": record.provenance,
    }


def claim_document(record: ClaimRecord) -> Document:
    """Encode the record of one claim. What does not apply to it is null."""
    claim, place, worked = record.claim, record.claim.place, record.worked
    interval = None if claim.printed is None else claim.interval()
    limits = None if interval is None else (interval.lower, interval.upper)
    readings = list(map(reading_document, record.assessment.readings, record.scopes))
    first, *others = readings or [dict[str, Any]()]
    return {
        "id": claim.id,
        "title": claim.title,
        "where": str(place),
        "line": place.line,
        "section": place.section,
        "equation": place.equation,
        "cell": claim.cell,
        "quote": " ".join(claim.quote.split()),
        "printed": claim.text,
        "unit": claim.unit,
        "kind": claim.kind,
        "interval": limits and [None if end is None else float(end) for end in limits],
        "interval_exact": limits and [None if end is None else str(end) for end in limits],
        "interval_text": None if interval is None else str(interval),
        "verdict": record.verdict.value,
        "restates": record.restated,
        "computed_by": claim.computed_by,
        "computed": first.get("computed"),
        "reference": first.get("reference"),
        "enclosure": first.get("enclosure"),
        "enclosure_exact": first.get("enclosure_exact"),
        "witness": first.get("witness"),
        "error_in_last_digit": record.error_in_last_digit,
        "holds": record.scope,
        "otherwise": first.get("otherwise", []),
        "readings": others,
        "rests_on": {name: list(entries) for name, entries in claim.inputs.items()},
        "assumes": record.assumes,
        "explanation": record.explanation,
        "formula": worked and worked.formula,
        "mathml": worked and worked.mathml,
        "by_hand": worked and worked.by_hand,
        "shown_by": to_builtins(record.confirmed_range),
        "sources": [source_document(comparison) for comparison in record.sources],
        "figures": to_builtins(record.figures),
        "back_solved": to_builtins(record.back_solved),
        "repairs": to_builtins(record.repairs),
        "slips": to_builtins(record.slips),
        "slips_tried": to_builtins(record.slips_tried),
        "standing": to_builtins(record.assessment.standing),
        "compared": record.assessment.compared,
        "workbook": cells_of_claims().get(claim.id),
    }


def reading_document(reading: Reading, scope: str) -> Document:
    """Encode what one reading of the report's words gives for a claim."""
    usual = reading.judgements[0]
    return {
        "name": reading.name,
        "summary": reading.summary,
        "verdict": reading.verdict.value,
        "computed": reading.computed,
        "reference": reading.reference,
        **_range(usual.ends),
        "witness": _doubles(usual.witness) if usual.witness else None,
        "holds": scope,
        "otherwise": [judgement_document(judgement) for judgement in reading.otherwise],
    }


def judgement_document(judgement: Judgement) -> Document:
    """Encode a verdict under one convention."""
    return {
        **convention_document(judgement.convention),
        "verdict": judgement.verdict.value,
        **_range(judgement.ends),
    }


def convention_document(convention: Convention) -> Document:
    """Encode a convention."""
    return {
        "rounding": convention.rounding.value,
        "choices": "exact" if convention.choices_exact else "rounded",
        "header": "exact" if convention.header_exact else "rounded",
        "scheme": convention.scheme.value,
    }


def source_document(comparison: Comparison) -> Document:
    """Encode a public source, and how it compares with a claim or an inferred input."""
    source = comparison.source
    return {
        "id": source.id,
        "title": source.title,
        "address": source.address,
        "quote": source.quote,
        "says": source.says,
        "unit": source.unit,
        "applies": source.applies,
        "agrees": comparison.agrees,
        "outcome": comparison.outcome,
    }


def equation_document(record: EquationRecord) -> Document:
    """Encode the record of one equation."""
    equation, factor = record.equation, record.assessment.factor
    return {
        "id": equation.id,
        "number": record.number,
        "title": equation.title,
        "where": str(equation.place),
        "text": record.text,
        "mathml": record.mathml,
        "kind": equation.kind,
        "follows_from": equation.follows_from,
        "verdict": record.verdict.value,
        "factor": None if factor is None else str(factor),
        "constants": to_builtins(list(record.assessment.constants.values())),
        "explanation": record.explanation,
        "repairs": to_builtins(record.repairs),
    }


def inferred_document(record: InferredRecord) -> Document:
    """Encode what the evidence admits of an input that the report does not print."""
    low, high = record.interval
    possible = record.possible_with_rounded_inputs
    return {
        "id": record.id,
        "title": record.entry.title,
        "unit": record.entry.unit,
        "scheme": record.scheme.value,
        "assumed": record.assumed,
        "nominal_source": record.entry.nominal_source,
        "interval": [_up(low), _down(high)],
        "interval_exact": [str(low), str(high)],
        "with_printed_mass": [_up(record.with_printed_mass[0]), _down(record.with_printed_mass[1])],
        "possible_with_rounded_inputs": possible and [_down(possible[0]), _up(possible[1])],
        "evidence": list(record.evidence),
        "odd": list(record.odd),
        "sources": [source_document(comparison) for comparison in record.sources],
    }


def _range(ends: Ends) -> Document:
    """Encode a proven range: as doubles, never narrower, and exactly."""
    low, high = ends
    return {"enclosure": [_down(low), _up(high)], "enclosure_exact": [str(low), str(high)]}


def _doubles(values: Mapping[str, Fraction]) -> dict[str, float]:
    return {name: float(value) for name, value in values.items()}


def _down(value: Fraction) -> float:
    """Return the greatest double that is not above the value."""
    double = float(value)
    return nextafter(double, -inf) if Fraction(double) > value else double


def _up(value: Fraction) -> float:
    """Return the least double that is not below the value."""
    return -_down(-value)

"""Findings: each number in them is computed by the audit, and one that is changed is noticed."""

import json
from functools import cache

import pytest
from kept import kept, pairs
from msgspec import ValidationError, convert
from msgspec.structs import replace

from reference.findings import Assertion
from reference.findings import load as load_findings
from reference.ledger import Ledger, load
from replication.audit.audit import audit
from replication.audit.findings import Evidence, Known
from replication.audit.record import FindingRecord, Record

FINDINGS = load_findings()


def test_every_finding_has_evidence_and_all_of_it_is_asserted(record: Record) -> None:
    assert [finding.id for finding in record.findings] == [n for n in FINDINGS if n != "headline"]
    assert record.headline == FINDINGS["headline"].statement
    for finding in record.findings:
        assert [part.name for part in finding.evidence] == list(FINDINGS[finding.id].evidence)
        assert finding.evidence, finding.id
        assert [part.name for part in finding.evidence if not part.holds] == []
        assert finding.holds


@kept("replication/kept.txt", "Verdicts as evidence, and whether they show it")
def test_verdicts_on_nothing_or_on_another_reading_show_nothing(question: str, answer: str) -> None:
    piece = convert({"says": "yes", "means": "-", **json.loads(question)}, Assertion)
    finding = replace(FINDINGS["headline"], evidence={"piece": piece})
    assert str(Evidence(Known(load()), finding).value("piece")) == answer


@pytest.mark.parametrize("under", [{"roundnig": "cut off"}, {"rounding": "cut"}])
def test_a_convention_that_is_none_is_refused(under: dict[str, str]) -> None:
    with pytest.raises(ValidationError):
        convert({"says": "yes", "means": "-", "under": under}, Assertion)


MISPRINTS = pairs("replication/kept.txt", "Misprints, and the findings that rest on them")


@cache
def with_misprints() -> dict[str, FindingRecord]:
    """The findings on a report with all of these misprints, in one audit."""
    ledger: Ledger = load()
    for misprint, _ in MISPRINTS:
        ledger = ledger.misprint(*misprint.split(": "))
    spoiled = audit(ledger)
    assert spoiled.headline != FINDINGS["headline"].statement
    return {finding.id: finding for finding in spoiled.findings}


@pytest.mark.parametrize(("misprint", "names"), MISPRINTS)
def test_a_finding_whose_evidence_is_misprinted_no_longer_holds(misprint: str, names: str) -> None:
    for finding in map(with_misprints().__getitem__, names.split(", ")):
        assert not finding.holds
        assert not all(part.holds for part in finding.evidence)


def test_a_formula_that_a_misprint_leaves_without_a_value_ends_no_audit() -> None:
    spoiled = audit(load().misprint("fz-resistance-rha", "0"))
    assert spoiled.claim("frank-zook-rha").verdict == "not reproduced"
    assert {f.id for f in spoiled.findings if not f.holds} >= {"equation-16", "frank-zook-values"}
    armor = [a for a in spoiled.approaches if a.claim == "frank-zook-rha"]
    assert [a.computed for a in armor] == [None, None]

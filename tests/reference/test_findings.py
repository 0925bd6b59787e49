"""The findings as asserted: what is wrong with an entry is an error when they are loaded."""

import tomllib
from importlib import resources
from typing import Any

import pytest

from reference.findings import KINDS, STATUSES, Assertion, load, read
from reference.ledger import LedgerError
from reference.ledger import load as load_ledger

GOOD = {
    "id": "one",
    "title": "A title",
    "kind": "method",
    "status": "open",
    "claims": ["depth-beta-5"],
    "statement": "It is {depth} um.",
    "settle": "Nothing.",
    "evidence": {"depth": {"says": "7.67", "unit": "um", "means": "depth"}},
}


def one(**changes: Any) -> dict[str, Any]:
    return {"finding": [{**GOOD, **changes}]}


def test_a_good_entry_is_read() -> None:
    finding = read(one(), load_ledger())["one"]
    assert finding.filled(finding.statement) == "It is 7.67 um."


@pytest.mark.parametrize(
    ("document", "message"),
    [
        ({}, "there are no findings"),
        ({"finding": [GOOD, GOOD]}, "stands there twice"),
        (one(kind="rumor"), "kind 'rumor' is none of"),
        (one(status="maybe"), "status 'maybe' is none of"),
        (one(claims=["no-such"]), "there is no claim 'no-such'"),
        (one(extra="x"), "there is no key 'extra'"),
        ({"finding": [{"id": "one"}]}, "lacks claims"),
        (one(statement="It is {width} um."), "its texts name {width}, which is no evidence"),
        (one(evidence={"depth": {"says": "7.67"}}), "wants says and means"),
        (one(evidence={"depth": {"says": "about 7", "means": "d"}}), "'about' is none of"),
        (one(evidence={"depth": {"says": "deep", "means": "d"}}), "cannot read 'deep'"),
        (one(evidence={"depth": {"says": "7", "means": "d", "unit": "ell"}}), "unknown unit"),
    ],
)
def test_a_bad_entry_is_named(document: dict[str, Any], message: str) -> None:
    with pytest.raises(LedgerError, match=message.replace("{", r"\{")):
        read(document, load_ledger())


@pytest.mark.parametrize(
    ("says", "inside", "outside"),
    [
        ("7.66", 7.6649, 7.6651),
        ("= 2", 2, 2.0000001),
        (">= 1.147", 1.147001, 1.146999),
        ("<= 1.073", 1.072, 1.074),
        ("> 2", 2.1, 2),
        ("< 2", 1.9, 2),
        ("yes", True, False),
        ("no", False, True),
    ],
)
def test_an_assertion_can_fail(says: str, inside: float, outside: float) -> None:
    relation, _, text = says.rpartition(" ")
    assertion = Assertion("name", "meaning", text, relation, "1")
    assert assertion.holds(inside)
    assert not assertion.holds(outside)
    assert assertion.says == says


def test_an_outcome_is_not_a_number() -> None:
    assert not Assertion("name", "meaning", "yes", "", "1").holds(1.0)


def test_every_finding_says_what_it_is_and_shows_numbers() -> None:
    for finding in load().values():
        assert finding.kind in KINDS
        assert finding.status in STATUSES
        assert finding.evidence
        assert finding.settle


@pytest.mark.parametrize(
    "topic",
    [
        "eq16-denominator", "frank-zook-rha", "frank-zook-stainless", "a1-deceleration-1",
        "coarse-step-beta-5", "flow-stress", "copper-yield", "excess-beta-5", "observed-ratio",
        "eq6-factor", "a-half-step", "particle-radius",
    ],
)  # fmt: skip
def test_what_fails_or_surprises_is_examined(topic: str) -> None:
    assert any(topic in finding.claims for finding in load().values())


def test_no_computed_number_is_typed_into_the_prose() -> None:
    """What a placeholder shows does not stand in the same text as digits, too."""
    source = resources.files("reference.report") / "findings.toml"
    for entry in tomllib.loads(source.read_text("utf-8"))["finding"]:
        computed = {
            given["says"].rpartition(" ")[2]
            for given in entry["evidence"].values()
            if len(given["says"].rpartition(" ")[2].strip("-")) > 4
        }
        assert not computed & set(entry["statement"].split()), entry["id"]

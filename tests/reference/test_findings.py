"""The findings as asserted: their words, their numbers, and what they name."""

import json
import re
import tomllib
from importlib import resources

import pytest
from kept import kept
from msgspec.structs import replace

from reference.findings import Assertion, filled, load
from reference.ledger import load as load_ledger
from reference.printed import parse
from reference.units import to_si

LEDGER = load_ledger()
RAW = tomllib.loads((resources.files("reference") / "report" / "findings.toml").read_text("utf-8"))
TEXTS = {entry["id"]: entry for entry in RAW["finding"]}

REFERENCE = re.compile(
    r"""[Ee]q(?:uation|s?\.)\ \d+(?:\ (?:and|to)\ \d+)? | Table\ A-1 | \b304\b | ASTM\ A240
    | (?:reference|[Ss]ection|[Ff]igure|[Rr]ow)\ \d+ | beta\ =\ [35]""",
    re.VERBOSE,
)
"""What a digit may belong to: a place in the report, an alloy, a standard, the name of a case."""
FORMULA = re.compile(
    r"""\^\(?-?\d(?:/\d)?\)? | (?<=[(/])\d(?=[\ /)a-zA-Z]) | \d(?=/\d) | (?<=/)\d
    | \d(?=\ [-+]\ | \ (?:k_t|R_t|rho_|ln)) | (?<=[a-z])_\d | d2x/dt2""",
    re.VERBOSE,
)
"""Coefficients and powers of a formula in symbols."""


@pytest.mark.parametrize("name", TEXTS)
def test_every_digit_is_evidence_printed_a_step_or_a_reference(name: str) -> None:
    for key in ("title", "statement", "by_hand", "settle"):
        text = " ".join(TEXTS[name].get(key, "").split())
        for known in (r"`.*?`", r"\{.*?\}", r'".*?"', REFERENCE, FORMULA):
            text = re.sub(known, "", text)
        assert re.findall(r".{0,20}\d.{0,20}", text) == [], key


def plain(text: str) -> str:
    return re.sub(r"[\s$~]", "", text.replace("μ", "u").replace("- um", "-um")).lower()


@pytest.mark.parametrize("name", TEXTS)
def test_quotations_arithmetic_names_and_assertions_of_a_finding(name: str) -> None:
    finding = load()[name]
    whole = " ".join((finding.title, finding.statement, finding.by_hand, finding.settle))
    assert [said for said in re.findall(r'"(.*?)"', whole) if plain(said) not in REPORT] == []
    assert [text for text, holds in finding.steps.items() if not holds] == []
    assert not re.search("[{}`]", whole)
    assert finding.settle or finding.kind == "headline"
    assert LEDGER.claims.keys() | LEDGER.equations.keys() >= set(finding.claims)
    for assertion in finding.evidence.values():
        assert to_si(assertion.unit)
        assert assertion.holds(parse("7.67").value) in (True, False)


REPORT = plain(LEDGER.text)


def test_no_finding_stands_there_twice() -> None:
    assert len(load()) == len(RAW["finding"]) == len(TEXTS)


def test_numbers_are_put_into_texts_and_arithmetic_is_calculated_again() -> None:
    evidence = {"depth": Assertion(says="7.67", unit="um", means="depth")}
    statement = "It is {depth} um, printed {depth-beta-5} or {depth-beta-5:mm}, {copper-density}."
    settle = "`2/3 * 3 = 2.1`, `ln(1 + 1) = 0.69`"
    known = replace(load()["headline"], statement=statement, settle=settle, evidence=evidence)
    finding = filled(known)
    assert finding.statement == "It is 7.67 um, printed 7.67 or 0.00767, 8.89."
    assert finding.settle == "2/3 * 3 = 2.1, ln(1 + 1) = 0.69"
    assert list(finding.steps.values()) == [False, True]
    with pytest.raises(KeyError, match="width"):
        filled(replace(known, statement="{width} um"))


@kept("reference/kept.txt", "Assertions: a value that they allow; one that they do not")
def test_an_assertion_can_fail(question: str, answer: str) -> None:
    assertion = Assertion(says=question, means="meaning")
    inside, outside = map(json.loads, answer.split("; "))
    assert assertion.holds(inside)
    assert not assertion.holds(outside)

"""The record of the audit: whole, as its schema says, and the same wherever it is made."""

import json
import os
import re
import subprocess
import sys
from fractions import Fraction as F
from math import log
from pathlib import Path

import jsonschema
import msgspec
import pytest

from reference.ledger import load
from reference.printed import parse
from replication.audit.audit import audit
from replication.audit.record import Figure, Record, filled, schema
from replication.text import json_text

LEDGER = load()


def test_the_record_is_what_its_schema_says_and_nothing_less(record: Record) -> None:
    document = json.loads(json_text(record))
    validator = jsonschema.Draft202012Validator(schema())
    validator.validate(document)
    small = {**document, "claims": [], "curves": [], "findings": [], "ladders": []}
    validator.validate(small)
    for key in small:
        assert not validator.is_valid({k: v for k, v in small.items() if k != key}), key
    for key in document["claims"][0]:
        spoiled = {k: v for k, v in document["claims"][0].items() if k != key}
        assert not validator.is_valid({**small, "claims": [spoiled]}), key
        wrong = {**spoiled, key: True}  # no key is a truth value
        assert not validator.is_valid({**small, "claims": [wrong]}), key


def test_the_record_comes_back_from_its_json(record: Record) -> None:
    again = msgspec.json.decode(json_text(record).encode(), type=Record)
    assert json_text(again) == json_text(record)
    assert again.claim("depth-beta-5") == record.claim("depth-beta-5")


# What is checked by hand

LINE = re.compile(r"^(?P<left>.+) = (?P<right>[-\d.]+)$")


def arithmetic(text: str) -> float:
    """The value of a line as it stands on the page."""
    raised = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")
    text = re.sub(r"×10([⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda power: "e" + power[1].translate(raised), text)
    text = text.replace("·", "*").replace("^", "**").replace("ln", "log")
    assert re.fullmatch(r"(?:log|[\de.+*/() -])+", text), text
    return float(eval(text, {"log": log}))  # only digits, signs and log are left


def test_every_line_by_hand_is_calculated_again(record: Record) -> None:
    by_hand = [claim.by_hand.removesuffix(".") for claim in record.claims if claim.by_hand]
    lines = [line for text in by_hand for line in text.split("; ")]
    assert len(lines) == 6
    for line in lines:
        match = LINE.match(line)
        assert match is not None, line
        interval = parse(match["right"]).interval()
        value = F(arithmetic(match["left"]))
        # The last line multiplies numbers that stand there with five digits.
        slack = value / 10**4 if line is lines[2] or line is lines[5] else 0
        assert interval.meets(type(interval)(value - slack, value + slack)), line


def test_numbers_and_symbols_are_marked_as_such(record: Record) -> None:
    formulas = [equation.mathml for equation in record.equations]
    formulas += [claim.mathml for claim in record.claims if claim.mathml]
    for formula in formulas:
        for tag, text in re.findall(
            r"<(m[ni])>([^<]+)</m[ni]>", re.sub("<msub>.*?</msub>", "", formula)
        ):
            assert (tag == "mn") == text[0].isdigit(), text


def test_what_no_source_has_or_more_than_one_is_refused_by_name() -> None:
    for sources in ((), 2 * (Figure(means="", value=1.0, unit="m"),)):
        with pytest.raises(TypeError, match=f"Figure.unit: {len(sources)} sources"):
            filled(Figure, *sources, means="depth", value=2.0)


def test_a_misprint_that_fails_by_another_equation_shows_that_equation() -> None:
    """Eq. 11 alone gives alpha; beta takes two equations, so that no single one shows it."""
    spoiled = audit(LEDGER.misprint("yield-strength", "251"))
    alpha, beta = (spoiled.claim(f"walker-anderson-{name}") for name in ("alpha", "beta"))
    assert alpha.verdict == beta.verdict == "not reproduced"
    assert alpha.by_hand is not None
    assert arithmetic(alpha.by_hand.removesuffix(".").rpartition(" = ")[0]) == pytest.approx(
        alpha.computed, rel=1e-3
    )
    assert beta.by_hand is None


# The same bytes

ELSEWHERE = (
    {"PYTHONHASHSEED": "0", "TZ": "UTC", "LC_ALL": "C", "OMP_NUM_THREADS": "1"},
    {"PYTHONHASHSEED": "7", "TZ": "Asia/Kathmandu", "LC_ALL": "C.UTF-8", "PYTHONOPTIMIZE": "1"},
)


@pytest.mark.slow
def test_an_audit_elsewhere_has_the_same_bytes(tmp_path: Path) -> None:
    folders = []
    for number, environment in enumerate(ELSEWHERE):
        folder = tmp_path / str(number) / "here"
        folder.mkdir(parents=True)
        command = [sys.executable, "-m", "replication", "audit", "--quiet", "--out", "out"]
        subprocess.run(command, cwd=folder, env={**os.environ, **environment}, check=True)
        folders.append({p.relative_to(folder): p.read_bytes() for p in folder.rglob("*.*")})
    first, second = folders
    assert {path.name for path in first} >= {
        "audit.json", "audit.html", "audit.md", "audit.csv", "workbook.xlsx", "hard-cases.txt",
    }  # fmt: skip
    assert [str(path) for path in first if first[path] != second.get(path)] == []
    assert set(first) == set(second)

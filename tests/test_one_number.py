"""One printed number on its way: ledger, verdict, record, files, page, and cell of the workbook.

The number is the report's final depth for beta = 5, once as printed (7.67 um) and once as if the
report printed 7.76 there. Whatever shows it must follow, as it is typed in the ledger only.
"""

import json
import re
from functools import cache
from math import isclose

import pytest
from pages import HTML, sound

from reference.ledger import Ledger, load
from replication import BETA_5, run
from replication.audit.assessment import Verdict
from replication.audit.audit import Audit
from replication.audit.record import Record
from replication.report import contents, summary
from replication.workbook import build_workbook
from spreadsheets.sheets import cells_of_claims

DEPTH = "depth-beta-5"
COMPUTED = run(BETA_5).final_depth * 1e6
"""The depth [um] that the sheet of the report's case gives."""

pytestmark = pytest.mark.parametrize(
    ("text", "verdict"),
    [
        pytest.param("7.67", Verdict.REPRODUCED, id="as printed"),
        pytest.param("7.76", Verdict.NOT_REPRODUCED, id="with two digits swapped"),
    ],
)


@cache
def misprinted() -> Record:
    return Audit(load().misprint(DEPTH, "7.76"), every_convention=False).record()


@pytest.fixture
def ledger(text: str) -> Ledger:
    """The ledger that prints this text."""
    printed = load()
    return printed if text == "7.67" else printed.misprint(DEPTH, text)


@pytest.fixture
def audited(text: str, record: Record) -> Record:
    """The record of its audit."""
    return record if text == "7.67" else misprinted()


@pytest.fixture
def files(text: str, audited: Record) -> dict[str, str]:
    """The files of its audit."""
    if text not in _FILES:
        _FILES[text] = {name: file.decode() for name, file in contents(audited, {}).items()}
    return _FILES[text]


_FILES: dict[str, dict[str, str]] = {}


def test_it_stands_in_the_report_where_the_ledger_says(
    text: str, verdict: Verdict, ledger: Ledger
) -> None:
    place = ledger.claims[DEPTH].place
    assert ledger.text[place.start : place.end] == "7.67"
    assert "10.0 and 7.67" in ledger.text.splitlines()[place.line - 1]


def test_it_is_judged_by_what_the_sheet_gives(text: str, verdict: Verdict, audited: Record) -> None:
    judged = audited.claim(DEPTH)
    assert judged.claim.text == text
    assert judged.computed is not None
    assert isclose(judged.computed, COMPUTED, rel_tol=1e-12)
    assert judged.verdict is verdict
    assert (DEPTH in audited.failing) == verdict.is_failure


def test_the_files_have_it(text: str, verdict: Verdict, files: dict[str, str]) -> None:
    claims = json.loads(files["audit.json"])["claims"]
    (claim,) = [claim for claim in claims if claim["id"] == DEPTH]
    assert (claim["printed"], claim["verdict"]) == (text, verdict)
    (line,) = [line for line in files["audit.csv"].splitlines() if line.startswith(f"{DEPTH},")]
    assert f",{text},um," in line
    assert f",{verdict}," in line


def test_page_and_markdown_show_it(text: str, verdict: Verdict, files: dict[str, str]) -> None:
    root = sound(files["audit.html"])
    (card,) = [e for e in root.iter(f"{HTML}article") if e.get("id") == f"claim-{DEPTH}"]
    shown = " ".join("".join(card.itertext()).split()).replace("\xa0", " ")
    assert f"{text} µm printed: {verdict}." in shown
    assert "7.669556889 µm" in shown
    pattern = rf"\*\*{text} µm\*\* [^\n]*\(`{DEPTH}`\), [^\n]*: {verdict}\."
    assert re.search(pattern, files["audit.md"])


def test_the_terminal_shows_it(text: str, verdict: Verdict, audited: Record) -> None:
    """The verdict stands in its line, or above the table where all main results have the same."""
    shown = summary(audited, 200)
    lines = [line for line in shown.splitlines() if f" {text} µm " in line]
    assert any("7.66956 µm" in line for line in lines)
    assert f"main results: {verdict}" in shown or any(line.endswith(verdict) for line in lines)


def test_the_workbook_has_it_beside_the_cell_that_computes_it(
    text: str, verdict: Verdict, audited: Record, ledger: Ledger
) -> None:
    cells = build_workbook(record=audited, ledger=ledger).cells
    name, _, address = cells_of_claims()[DEPTH].partition("!")
    computed = cells[name][address]
    assert isinstance(computed, float)
    assert isclose(computed, COMPUTED, rel_tol=1e-12)
    row = re.sub(r"\D", "", address)
    beside = [value for cell, value in cells[name].items() if re.sub(r"\D", "", cell) == row]
    assert text in beside
    (listed,) = [cell for cell, value in cells["Audit"].items() if value == DEPTH]
    row = re.sub(r"\D", "", listed)
    audit = [value for cell, value in cells["Audit"].items() if re.sub(r"\D", "", cell) == row]
    assert text in audit
    assert verdict in audit

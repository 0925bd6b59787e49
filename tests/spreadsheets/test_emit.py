"""The plan of the workbook and its file: formulas, printed texts, addresses, layout, parts."""

import os
import re
import signal
import zipfile
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import pytest
from kept import calls
from openpyxl import load_workbook

from reference.ledger import Ledger, load
from reference.units import written
from replication.audit.audit import audit
from replication.cases import BETA_5
from replication.workbook import Workbook, build
from spreadsheets import emit, safely
from spreadsheets.cases import prepared_rows
from spreadsheets.plan import TABLES, Cell, SheetPlan, WorkbookPlan, place_of
from spreadsheets.sheets import AS_PRINTED, OTHERWISE

LEDGER = load()
RECORD = audit()
BOOKS = {scheme: build(scheme=scheme, record=RECORD) for scheme in ("published", "centered")}
BOOK = BOOKS["published"]
PLAN = BOOK.plan
SHEETS = {sheet.name: sheet for sheet in PLAN.sheets}
FORMULAS = {place: cell.formula for place, cell in PLAN.cells.items() if cell.formula}
OWN = build(replace(BETA_5, velocity=600.0))


FUNCTIONS = {
    "ABS", "ASIN", "COUNT", "COUNTIF", "IF", "IFERROR", "INDEX", "ISNUMBER", "LN", "MAX", "MIN",
    "ROUND", "ROW", "SIN", "SQRT",
}  # fmt: skip
"""Functions that Excel 2010 has and every engine computes alike; none is volatile."""

MATHEMATICAL = {
    "0", "0.5", "1", "2", "3", "4", "6", "7", "21", "0.00000001", "1000000", "1000000000",
    "1000000000000",
}  # fmt: skip
"""Numbers of the printed equations (1/2, 4/3, 7/3), counts, and powers of ten for units."""


def test_formulas_are_ones_that_every_program_reads() -> None:
    """Known functions and names, no physical number, no power except in Eq. 11, no long text."""
    names = {cell.name for cell in PLAN.cells.values() if cell.name}
    counts = {str(n) for n in range(1, 12)}  # COUNT(...)=n
    for place, formula in FORMULAS.items():
        bare = re.sub(r'"[^"]*"|\'[^\']*\'!', "", formula)
        bare = re.sub(r"\$?\b[A-Z]{1,2}\$?\d+\b", "", bare)
        assert set(re.findall(r"([A-Z]+)\(", bare)) <= FUNCTIONS, place
        assert set(re.findall(r"\b[A-Za-z]\w*\b(?!\()", bare)) <= names, place
        numbers = re.sub(r"[A-Za-z]\w*", "", re.sub(r"COUNT\([^)]*\)=\d+", "", bare))
        assert set(re.findall(r"[\d.]+", numbers)) <= MATHEMATICAL | counts, (place, formula)
        assert len(formula) < 8192
        assert all(len(text) < 256 for text in re.findall(r'"([^"]*)"', formula))
    assert [p for p, f in FORMULAS.items() if "^" in f] == [PLAN.where["resistance.alpha"]]
    assert not [name for name in SHEETS if re.search(r"[,'\[\]:*?/\\]", name) or len(name) > 31]


def test_cells_whose_last_digits_depend_on_the_program_are_found() -> None:
    """Through cells, names, ranges and other sheets; no row of the scheme is among them."""
    keys = {PLAN.cells[place].key for place in PLAN.inexact}
    shown = {f"audit.{name}.computed" for name in ("observed-depth", "frank-zook-rha")}
    assert keys > shown | {"figure_5.depth_um[20]", "crater.least.ratio", "high.over_stop"}
    assert not [key for key in keys if ".row." in key]


# Printed texts


def shows_its_claim(cell: Cell, ledger: Ledger) -> bool:
    """Whether a cell shows the text of its claim, with or without its unit, or its number."""
    claim = ledger.claims[cell.claim]
    if cell.number is None:
        text = re.sub("^[<>≤≥] ", "", cell.text) if claim.kind == "bound" else cell.text
        return text in (claim.shown, f"{claim.shown} {written(claim.unit)}".rstrip())
    interval = claim.interval()
    assert claim.printed is not None
    ends = [None if end is None else float(end) for end in (interval.lower, interval.upper)]
    return cell.number in (*ends, float(claim.printed.value))


MISPRINTS = {
    "depth-beta-5": "7.66", "copper-yield": "91", "particle-volume": "5576",
    "figure-5-velocity-least": "410", "frank-zook-rha": "0.279", "a1-mass": "4.97E-11",
    "particle-size-greatest": "31", "walker-anderson-alpha": "8.6",
}  # fmt: skip


def test_what_the_workbook_calls_printed_is_its_claims_text_also_of_another_report() -> None:
    ledger = LEDGER
    for name, text in MISPRINTS.items():
        ledger = ledger.misprint(name, text)
    another = build(ledger=ledger, record=RECORD)
    shown = set()
    for book in (*BOOKS.values(), OWN, another):
        for place, cell in book.plan.cells.items():
            assert bool(cell.claim) == (cell.style == "printed") or cell.number is not None, place
            if cell.claim:
                assert shows_its_claim(cell, ledger if book is another else LEDGER), place
                shown.add(cell.claim)
    assert shown == set(LEDGER.claims)
    # The report's numbers beside the inputs follow the ledger, too.
    beside = [cell.number for (sheet, at), cell in another.plan.cells.items()
              if sheet == "Inputs" and at[0] == "H"]  # fmt: skip
    assert {410, 31, 91} <= {*beside}


# Addresses


THROUGH_PRINT = {
    "ratio-beta-3", "ratio-beta-5", "excess", "beta-range-least", "beta-range-greatest",
}  # fmt: skip
"""Claims that the audit computes from printed results, but the workbook from computed ones."""


def test_each_address_in_the_ledger_computes_its_claim() -> None:
    """In its unit; the live verdict agrees with the audit."""
    addressed = [claim for claim in LEDGER.claims.values() if claim.workbook]
    assert len(addressed) > 50
    for claim in addressed:
        place = place_of(str(claim.workbook))
        cell = SHEETS[place[0]].cells[place[1]]
        value = BOOK.values[cell.key]
        assert cell.formula
        assert cell.unit == claim.unit, claim.id
        record = RECORD.claim(claim.id)
        fails = record.verdict == "not reproduced"
        assert BOOK.values[f"audit.{claim.id}.verdict"] == (OTHERWISE if fails else AS_PRINTED)
        if record.computed is not None and claim.id not in THROUGH_PRINT:
            assert value == pytest.approx(record.computed, rel=1e-9, abs=0), claim.id


def test_a_wrong_address_is_refused() -> None:
    moved = msgspec.structs.replace(LEDGER.claim["depth-beta-5"], workbook="Sheet beta 5!A1")
    wrong = msgspec.structs.replace(LEDGER, claim={**LEDGER.claim, "depth-beta-5": moved})
    with pytest.raises(ValueError, match="'depth-beta-5': the workbook computes nothing in"):
        build(ledger=wrong, record=RECORD)


def test_live_verdicts_under_the_centered_scheme_are_the_audits() -> None:
    for claim in LEDGER.claims.values():
        if claim.workbook and claim.by_scheme:
            values = BOOKS["centered"].values
            assert values[f"audit.{claim.id}.verdict"] == AS_PRINTED, claim.id
    cells = BOOKS["centered"].plan.cells
    texts = [cell.text for (sheet, at), cell in cells.items() if sheet == "Audit" and at[0] == "L"]
    by_scheme = [claim.by_scheme for claim in LEDGER.claims.values()]
    assert [text.startswith("With the published scheme: ") for text in texts[1:]] == by_scheme


def test_each_number_of_table_a1_prints_as_it_does_in_the_report() -> None:
    claims = [claim for claim in LEDGER.claims.values() if claim.place.cell]
    assert len(claims) == 30
    for claim in claims:
        cell = SHEETS["Table A-1"].cells[str(claim.place.cell)]
        value, scientific = BOOK.values[cell.key], cell.shown == "0.00E+00"
        assert (f"{value:.2E}" if scientific else f"{value:g}".upper()) == claim.text
        assert abs(float(BOOK.values[f"table_check.{claim.place.cell}.difference"])) <= 0.5
    for address in LEDGER.blank:
        cell = SHEETS["Table A-1"].cells.get(address, Cell())
        assert (cell.text, cell.key, cell.number) == ("", "", None)


def test_the_front_sheet_tells_what_holds_and_links_to_it() -> None:
    front = SHEETS["Overview"]
    words = " ".join(cell.text for cell in front.cells.values())
    assert RECORD.headline in words
    for claim in RECORD.claims:
        if claim.verdict in ("not reproduced", "inconsistent"):
            assert claim.title in words
            assert claim.explanation.split(".")[0] in words
    links = {cell.text: address for address, cell in front.cells.items() if cell.link}
    for verdict, count in RECORD.summary.items():
        if count:
            assert front.cells[f"B{links[verdict][1:]}"].number == count
    assert set(SHEETS) - {"Overview"} <= set(links)
    assert "Written by coldspray" in words
    rows = range(12, 12 + len(LEDGER.claims))
    assert [SHEETS["Audit"].cells[f"A{row}"].text for row in rows] == [*LEDGER.claims]
    assert SHEETS["Audit"].filtered == f"A11:L{rows[-1]}"
    assert all(cell.link in PLAN.cells for cell in PLAN.cells.values() if cell.link)
    for name, sheet in SHEETS.items():
        links = [cell.link for cell in sheet.cells.values() if cell.link]
        assert name == "Overview" or ("Overview", "A1") in links


def beside(sheet: str, symbol: str) -> dict[str, str]:
    """Return the printed text beside each quantity with a symbol, by the quantity's meaning."""
    at = SHEETS[sheet].cells.get
    lines = (tuple(at(f"{column}{row}", Cell()) for column in "ABCE") for row in range(1, 50))
    return {b.text: e.text for a, b, c, e in lines if c.formula and a.text == symbol}


test_what_the_workbooks_hold = calls(
    "spreadsheets/kept.txt",
    "The report's workbook, with either scheme, and the workbook of another case",
    globals(),
)


# Layout


def width(sheet: SheetPlan, first: str, last: str) -> int:
    """Return the width of columns in pixels at 100 %; a column without a width has the default."""
    columns = map(chr, range(ord(first), ord(last) + 1))
    return sum(int(sheet.widths.get(column, 8.43) * 7 + 5) for column in columns)


@pytest.mark.parametrize("book", [*BOOKS.values(), OWN], ids=[*BOOKS, "own"])
def test_printed_type_is_at_least_8_points(book: Workbook) -> None:
    """Of 10 points, scaled so that the columns fit 10.4 inches of 96 pixels each."""
    for sheet in book.plan.sheets:
        columns = re.findall("[A-Z]+", sheet.print_area or " ".join(sheet.cells))
        assert 10 * 10.4 * 96 / width(sheet, min(columns), max(columns)) >= 8, sheet.name


def test_verdicts_and_checks_stand_on_the_first_screen() -> None:
    """Of 1366 pixels, less the row numbers and the scroll bar."""
    for name, head in (
        ("Audit", "The audit’s verdict"),
        ("Inputs", "Check"),
        ("Table A-1 check", "Difference"),
        ("Overview", "State of the run"),
    ):
        heads = [at for at, cell in SHEETS[name].cells.items() if cell.text == head]
        assert width(SHEETS[name], "A", heads[0][0]) <= 1366 - 60, name


def test_charts_have_titles_with_units_and_curves_that_differ_in_more_than_color() -> None:
    looks = TABLES["curves"]
    assert len({look["dash"] for look in looks}) == len({look["marker"] for look in looks}) == 2
    for name in ("Figure 3", "Figure 5", "Convergence"):
        page = SHEETS[name]
        assert all("[" in page.entry["chart"][axis] for axis in ("x_title", "y_title"))
        for (sheet, at), _, _ in page.curves:
            assert bool(SHEETS[sheet].cells[at].formula) == (name != "Convergence")
        for cells in (cells for _, *xy in page.curves for cells in xy):
            first, last = cells.split(":")
            rows = range(int(first[1:]), int(last[1:]) + 1)
            assert all(isinstance(BOOK.cells[name][f"{first[0]}{row}"], float) for row in rows)


@pytest.mark.parametrize("book", [*BOOKS.values(), OWN], ids=[*BOOKS, "own"])
def test_no_key_and_no_name_stands_twice(book: Workbook) -> None:
    """Excel does not distinguish names that differ only in case."""
    for things in ("key", "name"):
        words = [getattr(cell, things).casefold() for cell in book.plan.cells.values()]
        assert max(Counter(filter(None, words)).values()) == 1


def test_inputs_stand_apart_and_refuse_what_is_a_factor_of_a_million_off() -> None:
    """The column of inputs has nothing else, so that pasting into it breaks no formula."""
    for address, cell in SHEETS["Inputs"].cells.items():
        if address[0] == "C" and int(address[1:]) > 9:
            assert cell.limits
            assert not cell.formula
            factor = {"um": 1e-6, "ns": 1e-9, "MPa": 1e6, "GPa": 1e9}.get(cell.unit, -1.0)
            (least, most), number = cell.limits, BOOK.values[cell.key]
            assert least <= number <= most, cell.key
            assert not least <= number * factor <= most, cell.key


def plan_of(**cells: Cell) -> WorkbookPlan:
    return WorkbookPlan(sheets=(SheetPlan(name="S", cells=cells, widths={"A": 10.0}),))


test_rows_to_prepare_and_refused_values = calls(
    "spreadsheets/kept.txt",
    "Rows to prepare, and values that are refused",
    {"to_bytes": emit.to_bytes, "plan_of": plan_of, "Cell": Cell, "prepared_rows": prepared_rows},
)


@pytest.mark.filterwarnings("ignore:Name looks like a cell name")
def test_a_name_that_spreadsheets_refuse_is_an_error() -> None:
    with pytest.raises(ValueError, match="'v0' cannot name a cell"):
        emit.to_bytes(plan_of(A1=Cell(key="k", name="v0")), {"k": 1.0})


def test_the_file_is_sound_as_far_as_its_parts_tell(emitted: Any) -> None:
    """Finite numbers, rows in order, no errors, correct properties."""
    book = load_workbook(emitted.path)
    validations = {str(v.sqref): v for v in book["Inputs"].data_validations.dataValidation}
    for address, cell in emitted.book.plan.sheets[1].cells.items():
        assert (address in validations) == bool(cell.limits or cell.choices), address
        if cell.limits:
            ends = float(validations[address].formula1), float(validations[address].formula2)
            assert ends == cell.limits, address
    with zipfile.ZipFile(emitted.path) as archive:
        parts = {name: archive.read(name).decode() for name in archive.namelist()}
    core, app = parts["docProps/core.xml"], parts["docProps/app.xml"]
    assert "Modeling Impacts for Cold-Gas Dynamic Spray" in core
    assert "<dc:creator>coldspray " in core
    assert "Rosset</dc:creator>" not in core
    assert "dcterms:" not in re.sub(r"xmlns:\w+=\S+", "", core)  # no date
    assert "<Application>coldspray</Application>" in app
    assert "Excel" not in app
    sheets = [text for name, text in parts.items() if "worksheets/sheet" in name]
    for text in sheets:
        rows = [int(row) for row in re.findall(r'<row r="(\d+)"', text)]
        assert rows == sorted(set(rows))
        assert not re.search(r"<v>(?:nan|inf|-inf)</v>|_xlfn|#REF!", text)
        # A formula that gives "" must be marked as giving a text.
        assert not re.search(r'<c r="\w+" s="\d+"><f>[^<]*</f><v></v>', text)
        assert text.count("<ignoredError ") == 3
    assert sum("<autoFilter " in text for text in sheets) == 1
    charts = [text for name, text in parts.items() if "charts/chart" in name]
    assert len(charts) == 3
    for text in charts:
        assert "<c:numCache>" in text
        assert text.count("<c:strRef>") == text.count("<c:ser>")  # the names of the curves
        assert text.count('</c:yVal><c:smooth val="0"/>') == text.count("<c:ser>")  # straight lines
    drawings = [text for name, text in parts.items() if "drawings/drawing" in name]
    assert all('descr="Line chart' in text for text in drawings)


def test_an_interruption_waits_until_all_files_have_their_names(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rename = Path.replace

    def interrupted(draft: Path, target: Path) -> Path:
        os.kill(os.getpid(), signal.SIGINT)
        return rename(draft, target)

    monkeypatch.setattr(Path, "replace", interrupted)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in the background
    try:
        with pytest.raises(KeyboardInterrupt):
            safely.write_folder(tmp_path, dict.fromkeys("abc", b""))
    finally:
        signal.signal(signal.SIGINT, before)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b", "c"]

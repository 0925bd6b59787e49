"""Reading somebody else's workbook: its cells, its formulas, and what is refused."""

import zipfile
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest
from foreign.writers import Exact
from workbooks import rewritten

from spreadsheets import foreign, package
from spreadsheets.evaluate import Evaluator
from spreadsheets.foreign import StoredCell, WorkbookError, read
from spreadsheets.scalars import Area

SHEET, TABLE = "xl/worksheets/sheet1.xml", "xl/tables/table1.xml"
MAIN, LINKS = "xl/workbook.xml", "xl/_rels/workbook.xml.rels"


@pytest.fixture
def plain(tmp_path: Path) -> Path:
    """A small workbook without faults."""
    from openpyxl import Workbook

    book = Workbook()
    for row in ([1.0, 2.5, "text"], [0.1, "=A2*2", "=A1&C1"]):
        book.active.append(row)
    book.save(tmp_path / "plain.xlsx")
    return tmp_path / "plain.xlsx"


@pytest.fixture
def shared(tmp_path: Path) -> Path:
    """A workbook with shared texts, a table, an array formula and a number of 17 digits."""
    import xlsxwriter

    with xlsxwriter.Workbook(tmp_path / "shared.xlsx") as book:
        sheet = book.add_worksheet("Steps")
        sheet.write_string(0, 0, "text")
        sheet.write_string(1, 0, "<b>&amp;</b>")
        sheet.write_number(2, 0, 2.5)
        sheet.write_number(3, 0, Exact(0.1 + 0.2))
        sheet.write_array_formula("B1", "=A3:A4*2")
        sheet.add_table("D1:D2", {"name": "T", "header_row": False, "columns": [{"header": "x"}]})
        book.add_worksheet("More")
        book.define_name("Steps!dt", "=Steps!$A$3")
    return tmp_path / "shared.xlsx"


def spoiled(path: Path, change: Callable[[bytes], bytes], part: str = SHEET) -> Path:
    """A copy of a workbook with one part changed."""
    another = path.with_name("spoiled.xlsx")
    content = rewritten(path.read_bytes(), lambda n, data: change(data) if n == part else data)
    another.write_bytes(content)
    return another


def refusal(path: Path) -> str:
    """The message that refuses to read a file."""
    with pytest.raises(WorkbookError) as refused:
        read(path)
    message = str(refused.value)
    assert message.startswith(str(path))
    assert "\n" not in message
    return message


def adding(rows: bytes) -> Callable[[bytes], bytes]:
    """A change that adds rows to a sheet."""
    return lambda data: data.replace(b"</sheetData>", rows + b"</sheetData>")


def test_formulas_are_read_with_their_stored_values(plain: Path) -> None:
    """openpyxl stores no values of formulas."""
    assert read(plain).sheets["Sheet"] == {
        (1, 1): StoredCell(None, 1.0), (1, 2): StoredCell(None, 2.5),
        (1, 3): StoredCell(None, "text"), (2, 1): StoredCell(None, 0.1),
        (2, 2): StoredCell("=A2*2", None), (2, 3): StoredCell("=A1&C1", None),
    }  # fmt: skip


@pytest.mark.parametrize(("rows", "cells"), [
    pytest.param(
        b'<row r="5"><c r="A5"><f t="shared" ref="A5:A7" si="0">A4+$B$1</f><v>1</v></c></row>'
        b'<row r="6"><c r="A6"><f t="shared" si="0"/><v>2</v></c></row>',
        {(5, 1): StoredCell("=A4+$B$1", 1.0), (6, 1): StoredCell("=A5+$B$1", 2.0)},
        id="a shared formula is filled down",
    ),
    pytest.param(
        b'<row r="5"><c r="A5"><f t="array" ref="A5:A6">B1:B2*2</f><v>1</v></c></row>'
        b'<row r="6"><c r="A6"><v>2</v></c></row>',
        {
            (5, 1): StoredCell("=B1:B2*2", 1.0, array=(5, 1, 6, 1)),
            (6, 1): StoredCell("=B1:B2*2", 2.0, array=(5, 1, 6, 1)),
        },
        id="every cell of an array formula has it",
    ),
    pytest.param(
        b'<row r="5"><c r="A5"><f>[1]Sheet1!A1</f><v>3</v></c><c r="B5" t="str"><f>C1</f>'
        b'<v>#N/A</v></c><c r="C5" t="e"><f>NA()</f><v>#N/A</v></c></row>',
        {
            (5, 1): StoredCell("=[1]Sheet1!A1", 3.0),
            (5, 2): StoredCell("=C1", "#N/A"),
            (5, 3): StoredCell("=NA()", "#N/A", error=True),
        },
        id="a text that spells an error is none",
    ),
    pytest.param(
        b'<row><c><f>B3</f></c><c t="b"><v>1</v></c></row>',
        {(3, 1): StoredCell("=B3", None), (3, 2): StoredCell(None, True)},
        id="cells without addresses follow each other",
    ),
])  # fmt: skip
def test_rows_are_read(rows: bytes, cells: dict[tuple[int, int], StoredCell], plain: Path) -> None:
    """The rows stand below two others."""
    sheet = read(spoiled(plain, adding(rows))).sheets["Sheet"]
    assert {at: cell for at, cell in sheet.items() if at[0] > 2} == cells


@pytest.mark.parametrize(("cells", "reason"), [
    pytest.param(b'<c r="XFE1"/>', "no cell of 'Sheet' can be at 'XFE1'", id="last column"),
    pytest.param(b'<c r="A1048577"/>', "no cell of 'Sheet' can be at 'A1048577'", id="last row"),
    pytest.param(b'<c r="A0"/>', "no cell of 'Sheet' can be at 'A0'", id="row zero"),
    pytest.param(b'<c r="A99999999"/>', "no cell of 'Sheet' can be at 'A99999999'", id="far row"),
    pytest.param(
        b'<c><f t="shared" si="0">\'</f></c><c><f t="shared" si="0"/></c>',
        "the formula that Sheet!B5 shares with A5 cannot be read", id="open quotation mark",
    ),
])  # fmt: skip
def test_cells_that_cannot_be_are_damage(cells: bytes, reason: str, plain: Path) -> None:
    path = spoiled(plain, adding(b'<row r="5">' + cells + b"</row>"))
    assert refusal(path) == (
        f"{path}: is damaged: {reason}; a spreadsheet program may be able to repair it"
    )


def test_cells_of_a_table_are_addresses(tmp_path: Path) -> None:
    import xlsxwriter

    with xlsxwriter.Workbook(tmp_path / "table.xlsx") as book:
        sheet = book.add_worksheet()
        columns = [{"header": "v old"}, {"header": "x"}, {"header": "x [mm]"}]
        sheet.add_table(0, 0, 2, 2, {"name": "Steps", "columns": columns})
        sheet.write_number(1, 0, 3.0)
        sheet.write_formula(1, 1, "=Steps[[#This Row],[v old]]*2", None, 6)
        sheet.write_formula(2, 1, "=Steps[@[v old]]+Steps[@x]", None, 0)
        beside = book.add_worksheet()
        beside.add_table(0, 2, 2, 2, {"name": "More", "columns": [{"header": "x"}]})
        beside.write_formula(1, 4, "=Steps[@x]+More[@x]", None, 0)
        beside.write_formula(0, 0, "=MAX(steps[v old])+SUM(Steps[x '[mm']])")
    evaluator = Evaluator(read(tmp_path / "table.xlsx"))
    sheets = evaluator.book.sheets
    assert sheets["Sheet1"][2, 2].formula == "=$A2*2"
    assert sheets["Sheet1"][3, 2].formula == "=$A3+$B3"
    # A table of another sheet is not taken for the sheet's own.
    assert sheets["Sheet2"][2, 5].formula == "=Steps[@x]+$C2"
    # A column is its cells, without head and total.
    areas = [Area("Sheet1", 2, 1, 3, 1), Area("Sheet1", 2, 3, 3, 3)]
    assert evaluator.areas(("Sheet2", 1, 1)) == areas
    assert evaluator.values["Sheet2", 1, 1] == 3.0


@pytest.mark.parametrize("part", [SHEET, "xl/workbook.xml", "xl/sharedStrings.xml"])
def test_document_types_are_refused(shared: Path, part: str) -> None:
    """Also one that leads outside the file; `test_refusals.py` has one that declares entities."""
    declared = b'?><!DOCTYPE x SYSTEM "http://127.0.0.1/x.dtd">'
    path = spoiled(shared, lambda data: data.replace(b"?>", declared, 1), part)
    assert "declares a document type" in refusal(path)


ROW = b"<row>" + 100 * b"<c>%s</c>" + b"</row>"
ARRAY = b'<row><c><f t="array" ref="A1:XFD1048576">A9</f></c></row>'


@pytest.mark.parametrize(("module", "limit", "most", "rows", "reason"), [
    (package, "MAX_UNPACKED", 2**20, b" " * 2**22, "it unpacks to more than 1 MB"),
    (package, "MAX_EVENTS", 2**15, b"<row/>" * 2**15, "it has more than 32,768 pieces of XML"),
    (foreign, "MAX_CELLS", 500, 20 * ROW.replace(b"%s", b"<v>1</v>"), "it has too many cells"),
    (foreign, "MAX_FORMULAS", 500, 20 * ROW.replace(b"%s", b"<f>1+1</f><v>2</v>"), "many cells"),
    (foreign, "MAX_FORMULA_TEXT", 500, 20 * ROW.replace(b"%s", b"<f>1+1</f>"), "500 characters"),
    (foreign, "MAX_CELLS", 500, 30 * ARRAY + ROW.replace(b"%s", b"<v>1</v>"), "formulas fill"),
])  # fmt: skip
def test_what_is_too_much_is_refused(
    module: ModuleType, limit: str, most: int, rows: bytes, reason: str, plain: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    """The limits are lower than they are otherwise."""
    path = spoiled(plain, adding(rows))
    assert path.stat().st_size < 2**15
    assert read(path)
    monkeypatch.setattr(module, limit, most)
    assert reason in refusal(path)


def test_ranges_and_a_lone_cell_as_large_as_a_sheet_cost_nothing(plain: Path) -> None:
    added = (
        b'<row r="1048576"><c r="XFD1048576"><v>7</v></c></row></sheetData>'
        b'<mergeCells><mergeCell ref="A1:XFD1048576"/></mergeCells>'
        b'<hyperlinks><hyperlink ref="A1:XFD1048576" location="A1"/></hyperlinks>'
    )
    path = spoiled(plain, lambda data: data.replace(b"</sheetData>", added))
    cells = read(path).sheets["Sheet"]
    assert (len(cells), cells[1048576, 16384].value) == (7, 7)


@pytest.mark.parametrize(("part", "was", "now", "reason"), [
    (SHEET, b"</sheetData>", b"</sheetdata>", f"its part {SHEET} is not valid XML: mismatched tag"),
    (SHEET, b"</worksheet>", b"", f"its part {SHEET} is not valid XML: no element found"),
    (SHEET, b'encoding="UTF-8"', b'encoding="odd"', "is not valid XML: unknown encoding: odd"),
    (SHEET, b"<sheetData>", 99 * b"<a>", "its XML is nested more than 100 levels deep"),
    (SHEET, b"<v>2.5</v>", b"<v>abc</v>", "Steps!A3 holds 'abc', which is no number"),
    (SHEET, b"<v>1</v>", b"<v>99</v>", "the number of the shared text in Steps!A2 is '99' and must "
     "be a whole number below 2"),
    (SHEET, b"<v>1</v>", b"<v>-1</v>", "the number of the shared text in Steps!A2 is '-1'"),
    (SHEET, b'<row r="2"', b'<row r="two"', "the number of a row of 'Steps' is 'two' and must be"),
    (SHEET, b'<row r="2"', b'<row r="' + 5000 * b"9" + b'"', f"a row of 'Steps' is '{20 * '9'}'"),
    (SHEET, b'r="A1"', b'r="$"', "no cell of 'Steps' can be at '$'"),
    (SHEET, b'r="A1"', b'r="AAAA1"', "no cell of 'Steps' can be at 'AAAA1'"),
    (SHEET, b'ref="B1"', b'ref="what"', "an array formula of 'Steps' stands in 'what'"),
    (TABLE, b'ref="D1:D2"', b'ref="D1:what"', "the table 'T' stands in 'D1:what'"),
    (TABLE, b"displayName", b"shownName", f"a <table> of its part {TABLE} has no 'displayName'"),
    (TABLE, b'headerRowCount="0"', b'headerRowCount="no"', "headerRowCount of 'T' is 'no'"),
    (TABLE, b'totalsRowShown="0"', b'totalsRowCount="-1"', "totalsRowCount of 'T' is '-1'"),
    (MAIN, b'name="Steps"', b"", f"a <sheet> of its part {MAIN} has no 'name'"),
    (MAIN, b'name="More"', b'name="STEPS"', "two of its sheets have the same name"),
    (MAIN, b'r:id="rId1"', b"", "its sheet 'Steps' has no part of the file"),
    (MAIN, b'localSheetId="0"', b'localSheetId="2"', "sheet of the name 'dt' is '2'"),
    (LINKS, b"Target", b"Goal", f"a <Relationship> of its part {LINKS} has no 'Target'"),
])  # fmt: skip
def test_what_is_damaged_is_named(
    part: str, was: bytes, now: bytes, reason: str, shared: Path
) -> None:
    path = spoiled(shared, lambda data: data.replace(was, now), part)
    message = refusal(path)
    assert message.startswith(f"{path}: is damaged: ")
    assert reason in message


@pytest.mark.parametrize(("part", "reason"), [
    (SHEET, f"it refers to its part {SHEET}, which is not there"),
    ("xl/sharedStrings.xml", "it refers to its part xl/sharedStrings.xml, which is not there"),
    (LINKS, "its sheet 'Steps' has no part of the file"),
])  # fmt: skip
def test_a_part_that_is_gone_is_named(part: str, reason: str, shared: Path) -> None:
    assert f"is damaged: {reason}" in refusal(spoiled(shared, lambda _: b"", part))


# ---- files of other programs, which were read wrongly


CASES = Path(__file__).parents[1] / "foreign" / "cases"


def test_a_shared_formula_without_its_first_cell_is_damaged() -> None:
    message = refusal(CASES / "shared-orphans.xlsx")
    assert "is damaged: the formulas that Model!D17 to D66 share have no first cell; " in message


def test_a_shared_formula_may_come_after_the_cells_that_share_it(plain: Path) -> None:
    rows = (
        b'<row r="5"><c r="A5"><f t="shared" si="0"/><v>1</v></c></row>'
        b'<row r="6"><c r="A6"><f t="shared" ref="A5:A6" si="0">A5+$B$1</f><v>2</v></c></row>'
    )
    cells = read(spoiled(plain, adding(rows))).sheets["Sheet"]
    assert [cells[row, 1].formula for row in (5, 6)] == ["=A4+$B$1", "=A5+$B$1"]


def test_names_of_parts_may_be_written_in_small_letters() -> None:
    """The part xl/SharedStrings.xml is referred to as sharedStrings.xml."""
    cells = read(CASES / "z-sharedstrings-case.xlsx").sheets["Model"]
    assert cells[1, 1].value == "Particle radius R [m]"


def test_a_name_that_looks_like_a_cell_stays_in_shared_formulas() -> None:
    cells = read(CASES / "shared-yld1.xlsx").sheets["Model"]
    shared = [cell.formula for cell in cells.values() if "Yld" in (cell.formula or "")]
    assert len(shared) > 50
    assert all("Yld1" in str(formula) for formula in shared)


def test_heads_of_tables_may_have_line_breaks() -> None:
    cells = read(CASES / "table-linebreak-heads.xlsx").sheets["Model"]
    formulas = [cell.formula for cell in cells.values() if cell.formula]
    assert len(formulas) > 250
    assert not any("[" in formula for formula in formulas)


def test_hidden_rows_and_settings_are_read() -> None:
    book = read(CASES / "subtotal-hidden.xlsx")
    assert book.hidden["Model"]
    assert not book.date1904
    notes = read(CASES / "precision-as-displayed.xlsx").notes
    assert [note.partition(":")[0] for note in notes] == ["precision as displayed is set"]


@pytest.mark.parametrize(("attributes", "formula"), [
    (b'r1="B1"', "=TABLE(,B1)"),
    (b'dtr="1" r1="B1"', "=TABLE(B1,)"),
    (b'dt2D="1" r1="B1" r2="A1"', "=TABLE(B1,A1)"),
])  # fmt: skip
def test_every_cell_of_a_what_if_table_has_its_formula(
    attributes: bytes, formula: str, plain: Path
) -> None:
    rows = (
        b'<row r="5"><c r="B5"><f t="dataTable" ref="B5:B6" ' + attributes + b"/><v>1</v></c></row>"
        b'<row r="6"><c r="B6"><v>2</v></c></row>'
    )
    cells = read(spoiled(plain, adding(rows))).sheets["Sheet"]
    assert [cells[row, 2].formula for row in (5, 6)] == [formula, formula]
    assert cells[6, 2].array == (5, 2, 6, 2)


@pytest.mark.parametrize(("text", "day"), [
    (b"2024-02-16", 45338.0), (b"2024-02-17T12:00:00", 45339.5), (b"1900-01-01", 1.0),
    (b"soon", "soon"),
])  # fmt: skip
def test_dates_that_are_stored_as_texts_are_numbers(
    text: bytes, day: float | str, plain: Path
) -> None:
    path = spoiled(plain, adding(b'<row r="5"><c t="d"><v>' + text + b"</v></c></row>"))
    assert read(path).sheets["Sheet"][5, 1].value == day


def test_of_two_main_parts_the_first_is_read(plain: Path) -> None:
    second = (
        b'<Relationship Id="x" Type="http://x/officeDocument" Target="gone.xml"/></Relationships>'
    )
    twice = spoiled(plain, lambda data: data.replace(b"</Relationships>", second), "_rels/.rels")
    assert read(twice).sheets == read(plain).sheets


def test_shared_texts_and_all_digits_are_read(shared: Path) -> None:
    cells = read(shared).sheets["Steps"]
    values = [cells[row, 1].value for row in (1, 2, 3, 4)]
    assert values == ["text", "<b>&amp;</b>", 2.5, 0.1 + 0.2]


def test_macros_and_links_are_mentioned(plain: Path) -> None:
    with zipfile.ZipFile(plain, "a") as archive:
        archive.writestr("xl/vbaProject.bin", b"x")
        archive.writestr("xl/externalLinks/externalLink1.xml", b"<a/>")
    notes = read(plain).notes
    assert [("macros" in note, "links" in note) for note in notes] == [(True, False), (False, True)]


def test_a_password_and_a_changed_archive_are_refused(plain: Path) -> None:
    """`test_refusals.py` has texts, folders, devices, and files that are cut off or absent."""
    sealed = plain.with_name("sealed.xlsx")
    sealed.write_bytes(bytes.fromhex("D0CF11E0A1B11AE1") + bytes(999))
    assert "has a password" in refusal(sealed)
    data = plain.read_bytes()
    with zipfile.ZipFile(plain) as archive:
        at = archive.getinfo(SHEET).header_offset + 80
    plain.write_bytes(data[:at] + bytes(8) + data[at + 8 :])
    assert f"is damaged: its part {SHEET} cannot be unpacked" in refusal(plain)
    first = data.index(b"PK\x01\x02") + 8  # the flags of the first part in the list
    plain.write_bytes(data[:first] + b"\1" + data[first + 1 :])
    assert "has parts with a password" in refusal(plain)
    plain.write_bytes(data[:-9])
    assert "is damaged: its end is cut off or changed" in refusal(plain)


def test_an_ods_file_without_libreoffice_says_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "book.ods").write_bytes(b"x")
    monkeypatch.setattr("shutil.which", lambda _: None)
    assert "LibreOffice, which is not installed; save it as .xlsx" in refusal(tmp_path / "book.ods")

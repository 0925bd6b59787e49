"""Workbooks that would keep a reader busy, or end it: read rightly, or refused in a line."""

import zipfile
from collections.abc import Iterable, Iterator
from itertools import chain, repeat
from pathlib import Path

import pytest
from running import coldspray
from workbooks import usable

from spreadsheets.foreign import WorkbookError, read

MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
LINKS = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
RELATIONS = "http://schemas.openxmlformats.org/package/2006/relationships"
CELL = "<c><v>1</v></c>"
MEGABYTE = 2**20
LONG = "+".join(["A1"] * 2700)
"""A formula nearly as long as Excel allows."""


def relations(*targets: tuple[str, str]) -> str:
    links = "".join(
        f'<Relationship Id="rId{k}" Type="http://x/{kind}" Target="{target}"/>'
        for k, (kind, target) in enumerate(targets, 1)
    )
    return f'<Relationships xmlns="{RELATIONS}">{links}</Relationships>'


def written(
    path: Path, rows: Iterable[str], before: Iterable[str] = (), names: str = "", table: str = ""
) -> Path:
    """A workbook of one sheet, of these rows; its XML is written piece by piece."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        archive.writestr("_rels/.rels", relations(("officeDocument", "xl/workbook.xml")))
        archive.writestr(
            "xl/workbook.xml",
            f'<workbook xmlns="{MAIN}" xmlns:r="{LINKS}"><sheets>'
            f'<sheet name="S" sheetId="1" r:id="rId1"/></sheets>{names}</workbook>',
        )
        links = relations(("worksheet", "worksheets/sheet1.xml"))
        archive.writestr("xl/_rels/workbook.xml.rels", links)
        with archive.open("xl/worksheets/sheet1.xml", "w") as sheet:
            start, end = (f'<worksheet xmlns="{MAIN}">',), ("</sheetData></worksheet>",)
            for piece in chain(start, before, ("<sheetData>",), rows, end):
                sheet.write(piece.encode())
        if table:
            links = relations(("table", "../tables/table1.xml"))
            archive.writestr("xl/worksheets/_rels/sheet1.xml.rels", links)
            columns = f"<tableColumns>{table}</tableColumns>"
            archive.writestr(
                "xl/tables/table1.xml",
                f'<table xmlns="{MAIN}" displayName="T" ref="A1:B9">{columns}</table>',
            )
    return path


def formulas(*texts: str) -> Iterator[str]:
    """A row of formulas that store 1."""
    return (f"<row>{''.join(f'<c><f>{text}</f><v>1</v></c>' for text in texts)}</row>" for _ in "1")


def refused(path: Path) -> str:
    """The one line in which `check` and `diff` refuse a file, without the names."""
    lines = set()
    for command, files in (("check", [path]), ("diff", [path, path])):
        status, out, err = coldspray(command, *files)
        assert (status, out) == (2, "")
        assert err.count("\n") == 1
        lines.add(err.removeprefix(f"coldspray {command}: {path}: "))
    (line,) = lines
    return line


def test_a_comment_of_a_hundred_megabytes(tmp_path: Path) -> None:
    comment = chain(["<!--"], repeat("x" * MEGABYTE, 100), ["-->"])
    path = written(tmp_path / "a.xlsx", [f"<row>{CELL}</row>"], comment)
    assert refused(path).startswith(
        "is refused: a tag, comment or blank of its part xl/worksheets/sheet1"
    )


def test_an_attribute_of_a_hundred_megabytes(tmp_path: Path) -> None:
    tag = chain(['<a b="'], repeat("x" * MEGABYTE, 100), ['"/>'])
    path = written(tmp_path / "a.xlsx", [f"<row>{CELL}</row>"], tag)
    assert (
        "a tag, comment or blank of its part xl/worksheets/sheet1.xml has more than 1 MB"
        in refused(path)
    )


def test_many_comments_that_are_not_too_long(tmp_path: Path) -> None:
    comments = repeat(f"<!--{'x' * (MEGABYTE - 9)}-->", 20)
    path = written(tmp_path / "a.xlsx", [f"<row>{CELL}</row>"], comments)
    assert read(path).sheets["S"][1, 1].value == 1


@pytest.mark.slow
@pytest.mark.parametrize("piece", ["<m/>", "\n", "<!---->"])
def test_millions_of_pieces_that_mean_nothing(piece: str, tmp_path: Path) -> None:
    path = written(tmp_path / "a.xlsx", [f"<row>{CELL}</row>"], repeat(piece * 100_000, 31))
    assert refused(path) == "is refused: it has more than 3,000,000 pieces of XML\n"


def test_a_row_of_millions_of_cells(tmp_path: Path) -> None:
    row = chain(["<row>"], repeat("<c/>" * 10_000, 30), ["</row>"])
    path = written(tmp_path / "a.xlsx", row)
    # Where a sheet ends is noticed only at the end of the row.
    assert refused(path).startswith("is refused: one of its rows, or a list, has more than 200,000")


@pytest.mark.parametrize(("text", "shown"), [("1" * 5000, "1" * 20), ("1_000", "1_000")])
def test_a_number_that_no_program_writes(text: str, shown: str, tmp_path: Path) -> None:
    path = written(tmp_path / "a.xlsx", [f"<row><c><v>{text}</v></c></row>"])
    assert refused(path).startswith(f"is damaged: S!A1 holds '{shown}', which is no number; ")


def test_an_archive_of_too_many_parts(tmp_path: Path) -> None:
    path = written(tmp_path / "a.xlsx", [f"<row>{CELL}</row>"])
    with zipfile.ZipFile(path, "a") as archive:
        for number in range(40_000):
            archive.writestr(f"part{number}", "")
    assert refused(path) == "is refused: it holds more than 10,000 parts\n"


def test_too_many_names(tmp_path: Path) -> None:
    names = '<definedName name="a">S!A1</definedName>' * 200_001
    path = written(tmp_path / "a.xlsx", [f"<row>{CELL}</row>"],
                   names=f"<definedNames>{names}</definedNames>")  # fmt: skip
    assert refused(path).startswith("is refused: one of its rows, or a list, has more than 200,000")


def test_a_table_that_is_wider_than_a_sheet(tmp_path: Path) -> None:
    table = "".join(f'<tableColumn name="x{k}"/>' for k in range(18_279))
    path = written(tmp_path / "a.xlsx", [f"<row>{CELL}</row>"], table=table)
    assert refused(path).startswith("is damaged: the table 'T' is wider than a sheet; ")


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["typed", "shared"])
def test_long_formulas_in_many_cells(kind: str, tmp_path: Path) -> None:
    """Some hundred cells of these are read; more would take minutes to calculate."""
    first = f'<row><c><f t="shared" si="0">{LONG}</f><v>1</v></c></row>'
    shared = chain([first], repeat('<row><c><f t="shared" si="0"/><v>1</v></c></row>', 600))
    rows = shared if kind == "shared" else chain.from_iterable(repeat([*formulas(LONG)], 600))
    path = written(tmp_path / "a.xlsx", rows)
    assert refused(path) == "is refused: its formulas have more than 4,000,000 characters\n"


@pytest.mark.parametrize("text", ["a" * 8190, "[@" * 4000, "T[" * 4000, "T[[#This Row],[" * 500])
def test_long_formulas_in_a_sheet_with_a_table(text: str, tmp_path: Path) -> None:
    table = '<tableColumn name="x"/><tableColumn name="y"/>'
    path = written(tmp_path / "a.xlsx", formulas(*[text] * 100, "T[@y]*2"), table=table)
    cells = read(path).sheets["S"]
    assert (cells[1, 1].formula, cells[1, 101].formula) == (f"={text}", "=$B1*2")


@pytest.mark.parametrize("text", ["'" * 8001 + "A1", '"' * 8001, "A:" * 4000, "$" * 8000, LONG])
def test_formulas_of_odd_signs_are_compared(text: str, tmp_path: Path) -> None:
    a = written(tmp_path / "a.xlsx", formulas(*[text] * 50))
    b = written(tmp_path / "b.xlsx", formulas(*[f"{text}+B7"] * 50))
    assert coldspray("diff", a, a)[0] == 0
    assert coldspray("diff", a, b)[0] == 1


@pytest.mark.parametrize(
    "text", ["'" * 8001, "'" * 8001 + "A1", "''a" * 2700, "a" * 8190, "1E" * 4000, '"' * 8001]
)
def test_names_that_never_end_are_read_once(text: str, tmp_path: Path) -> None:
    """Looked for anew at each of its letters, a sheet's name would take minutes."""
    path = written(tmp_path / "a.xlsx", formulas(*[text] * 450))
    status, _, err = coldspray("check", path)
    assert (status, err.count("\n")) == (2, 1)


@pytest.mark.parametrize("text", ["", " ", "\n", "=", "= "])
def test_a_blank_formula_is_none(text: str, tmp_path: Path) -> None:
    """Its value stands there as if it was typed."""
    path = written(tmp_path / "a.xlsx", formulas(text))
    cell = read(path).sheets["S"][1, 1]
    assert (cell.formula, cell.value) == (None, 1)
    assert coldspray("check", path)[0] == 2
    assert coldspray("diff", path, path)[0] == 0


def test_rows_in_another_order_by_the_thousand(tmp_path: Path) -> None:
    """Matching 5,000 rows pair by pair would take 25 million comparisons."""
    rows = [f"<row><c><v>{k * 7919 % 4999}</v></c><c><v>{k % 7}</v></c></row>" for k in range(5000)]
    a = written(tmp_path / "a.xlsx", rows)
    b = written(tmp_path / "b.xlsx", rows[::-1])
    status, out, _ = coldspray("diff", a, b)
    assert status == 1
    assert "rows 1 to 5000 of 'S' are in another order" in out


def test_columns_without_anything_in_common(tmp_path: Path) -> None:
    paths = []
    for step in (3, 5):
        cells = "".join(f"<c><v>{k * step}</v></c>" for k in range(1, 2000))
        rows = repeat(f"<row>{cells}</row>", 5)
        paths.append(written(tmp_path / f"{step}.xlsx", rows))
    assert coldspray("diff", *paths, "--quiet")[0] == 1


# ---- files that LibreOffice opens


ODS = (
    '<office:document-content xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0"'
    ' xmlns:table="urn:oasis:names:tc:opendocument:xmlns:table:1.0"'
    ' xmlns:text="urn:oasis:names:tc:opendocument:xmlns:text:1.0" office:version="1.2">'
    '<office:body><office:spreadsheet><table:table table:name="S">{}</table:table>'
    "</office:spreadsheet></office:body></office:document-content>"
)


def ods(path: Path, rows: int | str, columns: int) -> Path:
    """An .ods file of one cell, repeated."""
    cell = (
        f'<table:table-row table:number-rows-repeated="{rows}"><table:table-cell '
        f'office:value-type="float" office:value="7" table:number-columns-repeated="{columns}">'
        "<text:p>7</text:p></table:table-cell></table:table-row>"
    )
    kind = "application/vnd.oasis.opendocument.spreadsheet"
    manifest = "urn:oasis:names:tc:opendocument:xmlns:manifest:1.0"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", kind)
        archive.writestr(
            "META-INF/manifest.xml",
            f'<m:manifest xmlns:m="{manifest}">'
            f'<m:file-entry m:full-path="/" m:media-type="{kind}"/>'
            '<m:file-entry m:full-path="content.xml" m:media-type="text/xml"/></m:manifest>',
        )
        archive.writestr("content.xml", ODS.format(cell))
    return path


def test_a_cell_that_is_repeated_a_billion_times(tmp_path: Path) -> None:
    usable("libreoffice")
    path = ods(tmp_path / "a.ods", 1_000_000, 1_000)
    assert path.stat().st_size < 2_000
    expected = "is refused: it has more than 250,000 cells, counting repeated ones\n"
    assert refused(path) == expected


def test_a_cell_that_is_repeated_how_often(tmp_path: Path) -> None:
    usable("libreoffice")
    with pytest.raises(WorkbookError, match="is damaged: a <table-row> is repeated '-1' times"):
        read(ods(tmp_path / "a.ods", "-1", 1))


def test_a_cell_that_is_repeated_some_times(tmp_path: Path) -> None:
    usable("libreoffice")
    cells = read(ods(tmp_path / "a.ods", 3, 2)).sheets["S"]
    assert {at: cell.value for at, cell in cells.items()} == {
        (row, column): 7.0 for row in (1, 2, 3) for column in (1, 2)
    }

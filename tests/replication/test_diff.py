"""`coldspray diff`: two workbooks of which it is known how they were made."""

import json
import os
import shutil
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from foreign import writers
from foreign.byhand import made
from foreign.layouts import Foreign
from openpyxl import Workbook, load_workbook
from running import coldspray

from replication.cases import BETA_5
from replication.check.diff import DIFFERENCE_KINDS, Tolerance, diff
from replication.check.matching import in_order

CASES = Path(__file__).parents[1] / "foreign" / "cases" / "diff"
Row = list[float | str | None]


def places(first: Path, second: Path, *options: str) -> list[str]:
    """The differences of two workbooks: the kind and the first cell of each."""
    status, out, err = coldspray("diff", first, second, "--json", *options)
    record = json.loads(out)
    assert (status, err) == (int(bool(record["differences"])), "")
    return [f"{d['kind']} {d['cell']}" for d in record["differences"]]


def written(path: Path, rows: list[Row]) -> Path:
    """A workbook of one sheet."""
    book = Workbook()
    for row in rows:
        book.active.append(row)
    book.save(path)
    return path


@pytest.mark.parametrize(("second", "expected"), [
    pytest.param("d1904-b", ["setting A1"], id="the same numbers are other dates"),
    pytest.param("d1904-c", ["setting A1", "value A2"], id="the same dates are other numbers"),
    pytest.param("iso", [], id="dates that are stored as texts"),
])  # fmt: skip
def test_date_systems_are_compared(second: str, expected: list[str]) -> None:
    assert places(CASES / "d1904-a.xlsx", CASES / f"{second}.xlsx") == expected


@pytest.mark.parametrize(("first", "second", "expected"), [
    pytest.param("dt-a", "dt-b", ["formula D3"], id="a what-if table of another input"),
    pytest.param("dt-a", "dt-c", ["formula D3"], id="the values of a what-if table, typed"),
    pytest.param(
        "dt-a", "dt-d", ["formula B2", "value B2", "value D2"],
        id="a formula that a what-if table follows",
    ),
    pytest.param("arr-a", "arr-b", ["formula C1", "value C1"], id="an array formula, other value"),
    pytest.param("arr-a", "arr-c", ["formula C1"], id="an array formula, the same value"),
    pytest.param("err-a", "err-b", ["value A1"], id="an error and a text that spells it"),
    pytest.param("ii-a", "ii-b", [], id="a formula of a range, its value stored or not"),
    pytest.param("snapd-a", "snapd-b", [], id="a difference stored as 0, or not stored"),
])  # fmt: skip
def test_nothing_is_called_equal_that_is_not(first: str, second: str, expected: list[str]) -> None:
    assert places(CASES / f"{first}.xlsx", CASES / f"{second}.xlsx") == expected


@pytest.mark.filterwarnings("ignore:Workbook contains no default style")
@pytest.mark.parametrize(
    ("name", "edited"), [("sorted-edited-60-50", 34), ("sorted-edited-300-10", 25)]
)
def test_an_order_is_said_once_and_then_only_edited_cells(name: str, edited: int) -> None:
    """The rows have a case in column A: by it, another program finds what was edited."""
    paths = [CASES / f"{name}-{letter}.xlsx" for letter in "ab"]
    old, new = ([*load_workbook(path)["S"].iter_rows(values_only=True)] for path in paths)
    by_case = {row[0]: row for row in old}
    expected = {
        ("S", r, c)
        for r, row in enumerate(new, 1)
        for c, value in enumerate(row, 1)
        if value != by_case[row[0]][c - 1]
    }
    assert len(expected) == edited
    order, *edits = diff(*paths).differences
    assert (order.kind, order.place) == ("moved", ("S", 2, 1))
    assert {cell for d in edits for cell in d.cells} == expected
    assert {d.kind for d in edits} == {"value"}


def test_an_order_and_a_new_row() -> None:
    assert places(CASES / "so-new-a.xlsx", CASES / "so-new-b.xlsx") == ["moved A1", "added A31"]


def test_rows_in_another_order_whose_answers_were_coded(tmp_path: Path) -> None:
    """As in a survey: sorted by age, and yes and no replaced by numbers. The first stays first."""
    rows: list[Row] = [
        [f"person {k}", 20 + k * 7 % 50, ["yes", "no"][k % 2], f"town {k % 9}"] for k in range(300)
    ]
    coded: list[Row] = [
        [name, age, float(answer == "yes"), town] for name, age, answer, town in rows
    ]
    coded.sort(key=lambda row: (row[1], str(row[0])))
    a = written(tmp_path / "a.xlsx", rows)
    b = written(tmp_path / "b.xlsx", coded)
    assert places(a, b) == ["moved A2", "value C1"]


TABLE: list[Row] = [
    ["name", "mass", "twice"], ["copper", 8.9, "=2*B2"], ["iron", 7.8, "=2*B3"],
    ["steel", 7.85, "=2*B4"], ["sum", "=SUM(B2:B4)", "=SUM(C2:C4)"],
]  # fmt: skip


@pytest.mark.parametrize(("rows", "expected"), [
    pytest.param(
        [*TABLE[:2], ["zinc", 7.1, "=2*B3"], ["iron", 7.8, "=2*B4"], ["steel", 7.85, "=2*B5"],
         ["sum", "=SUM(B2:B5)", "=SUM(C2:C5)"]],
        ["added A3"], id="a row inserted",
    ),
    pytest.param(
        [*TABLE[:2], ["steel", 7.85, "=2*B3"], ["sum", "=SUM(B2:B3)", "=SUM(C2:C3)"]],
        ["removed A3"], id="a row deleted",
    ),
    pytest.param(
        [[], [], ["name", "mass", "twice"], ["copper", 8.9, "=2*B4"], ["iron", 7.8, "=2*B5"],
         ["steel", 7.85, "=2*B6"], ["sum", "=SUM(B4:B6)", "=SUM(C4:C6)"]],
        ["moved A3"], id="blank rows above",
    ),
    pytest.param(
        [["name", "unit", "mass", "twice"], ["copper", "g", 8.9, "=2*C2"],
         ["iron", "g", 7.8, "=2*C3"], ["steel", "g", 7.85, "=2*C4"],
         ["sum", "g", "=SUM(C2:C4)", "=SUM(D2:D4)"]],
        ["added B1"], id="a column inserted",
    ),
    pytest.param(
        [["mass", "twice", "name"], [8.9, "=2*A2", "copper"], [7.8, "=2*A3", "iron"],
         [7.85, "=2*A4", "steel"], ["=SUM(A2:A4)", "=SUM(B2:B4)", "sum"]],
        ["moved C1"], id="the first column moved behind the others",
    ),
    pytest.param(
        [TABLE[0], ["steel", 7.85, "=2*B2"], ["iron", 7.8, "=2*B3"], ["copper", 8.9, "=2*B4"],
         TABLE[4]],
        ["moved A2"], id="rows in another order, their formulas with them",
    ),
    pytest.param(
        [*TABLE[:2], ["iron", 7.8, "=2*B2"], *TABLE[3:]], ["formula C3"], id="another reference"
    ),
    pytest.param([*TABLE[:4], ["sum", "=SUM(B2:B4)", "=SUM(C2:C3)"]], ["formula C5"],
                 id="a range that ends before"),
    pytest.param([*TABLE[:2], ["iron", 7.8, "= 2.0 * b3"], *TABLE[3:]], [], id="written otherwise"),
    pytest.param([*TABLE[:2], ["iron", 7.8, "=2*$B3"], *TABLE[3:]], ["formula C3"], id="a $ more"),
    pytest.param([*TABLE[:2], ["iron", 7.7, "=2*B3"], *TABLE[3:]], ["value B3"], id="a number"),
    pytest.param([*TABLE[:2], ["iron", "7.8", "=2*B3"], *TABLE[3:]], ["value B3"],
                 id="a number as text"),
    pytest.param([*TABLE[:2], [None, 7.8, "=2*B3"], *TABLE[3:]], ["removed A3"], id="a blank"),
])  # fmt: skip
def test_what_was_changed_by_hand_is_one_difference(
    rows: list[Row], expected: list[str], tmp_path: Path
) -> None:
    a, b = written(tmp_path / "a.xlsx", TABLE), written(tmp_path / "b.xlsx", rows)
    assert places(a, b) == expected


def test_a_row_that_a_formula_loses_is_no_row_that_it_reads(tmp_path: Path) -> None:
    """Its row was deleted, and another row now has that number."""
    a = written(tmp_path / "a.xlsx", [["copper", 8.9], ["iron", 7.8], ["zinc", 7.1], ["=B2"]])
    b = written(tmp_path / "b.xlsx", [["copper", 8.9], ["zinc", 7.1], ["=B2"]])
    assert places(a, b) == ["removed A2", "formula A3"]


def book_of(path: Path, edits: dict[tuple[str, str], float | str]) -> Path:
    """The report's sheet with its values stored, and some cells put otherwise."""
    f: Foreign = made("table-a1", BETA_5)
    for (sheet, cell), content in edits.items():
        f.put(sheet, cell, content)
    return writers.with_xlsxwriter(f, path, writers.calculated(f))


@pytest.mark.parametrize(("options", "expected"), [
    ((), {"formula", "value"}),
    (("--values-only",), {"value"}),
    (("--values-only", "--relative", "1e-11"), set()),
    (("--values-only", "--digits", "9"), set()),
    (("--values-only", "--digits", "17"), {"value"}),
])  # fmt: skip
def test_options_say_what_is_compared(
    options: tuple[str, ...], expected: set[str], tmp_path: Path
) -> None:
    """The diameter is off by a factor of 1 + 1e-14."""
    a = book_of(tmp_path / "a.xlsx", {("Sheet1", "B4"): "=2*B1"})
    b = book_of(tmp_path / "b.xlsx", {("Sheet1", "B4"): "=2*B1*(1+1E-14)"})
    kinds = {place.partition(" ")[0] for place in places(a, b, *options)}
    assert kinds == expected


def test_without_stored_values_formulas_are_compared_even_for_values_only(tmp_path: Path) -> None:
    rows: list[Row] = [[1.0, "=2*A1"]]
    a, b = written(tmp_path / "a.xlsx", rows), written(tmp_path / "b.xlsx", [[1.0, "=3*A1"]])
    assert places(a, b, "--values-only") == ["formula B1"]
    assert places(a, a, "--values-only") == []
    out = coldspray("diff", a, a)[1]
    assert out.startswith("Equal: every cell holds the same, as far as values are stored.\n")
    assert "for 1 of 1 formula no value is stored" in out


def test_zeros_of_a_program_that_does_not_calculate_are_no_values(tmp_path: Path) -> None:
    """XlsxWriter stores 0 for every formula if it is given no values."""
    f = made("plain", BETA_5)
    a = writers.with_xlsxwriter(f, tmp_path / "a.xlsx", dict.fromkeys(f.cells, 0.0))
    b = writers.with_xlsxwriter(f, tmp_path / "b.xlsx", writers.calculated(f))
    assert places(a, b) == []


def test_an_input_comes_first_and_what_follows_from_it_says_so(tmp_path: Path) -> None:
    a = book_of(tmp_path / "a.xlsx", {})
    b = book_of(tmp_path / "b.xlsx", {("Sheet1", "B1"): 1.2e-05})
    differences = diff(a, b).differences
    assert differences[0].place == ("Sheet1", 1, 2)
    assert len(differences) > 1
    assert all(d.explanation.startswith("the values differ, as do ") for d in differences[1:])


def test_values_near_the_largest_double_are_compared(tmp_path: Path) -> None:
    a = written(tmp_path / "a.xlsx", [[1.7e308, -1.7e308], [1e308, 5e-324]])
    b = written(tmp_path / "b.xlsx", [[-1.7e308, -1.7e308], [1e308, 0.0]])
    assert places(a, b, "--relative", "0.1", "--digits", "3") == ["value A1", "value B2"]


def test_our_own_workbook_is_equal_to_itself(our_own: bytes, tmp_path: Path) -> None:
    own = tmp_path / "own.xlsx"
    own.write_bytes(our_own)
    assert places(own, own) == []


@pytest.mark.parametrize(("tolerance", "a", "b", "expected"), [
    (Tolerance(ulp=1), 1.0, 1.0 + 2**-52, True),
    (Tolerance(ulp=1), 1.0, 1.0 + 2**-51, False),
    (Tolerance(digits=3), 7.664, 7.666, False),
    (Tolerance(digits=15), 10.037311494880546, 10.0373114948806, True),
    (Tolerance(digits=15), 10.0373114948805, 10.0373114948806, False),
])  # fmt: skip
def test_a_number_is_within_a_tolerance(
    tolerance: Tolerance, a: float, b: float, expected: bool
) -> None:
    assert tolerance.equal(a, b) is expected


@pytest.mark.parametrize("pairs", [[], [(1, 1)], [(1, 2), (2, 1)], [(1, 3), (2, 1), (3, 2)]])
def test_most_pairs_that_keep_their_order(pairs: list[tuple[int, int]]) -> None:
    kept = in_order(pairs)
    assert [*map(max, kept)] == sorted(map(max, kept))
    assert len(kept) == max(len(pairs) - 1, min(1, len(pairs)))


def test_text_page_and_junit_name_the_same_cell(tmp_path: Path) -> None:
    f = made("french", BETA_5)
    a = writers.with_openpyxl(f, tmp_path / "a.xlsx")
    f.put("Données", "C8", 450)
    b = writers.with_openpyxl(f, tmp_path / "b.xlsx")
    page, junit = tmp_path / "d.html", tmp_path / "d.xml"
    arguments = ("diff", a, b, "--html", page, "--junit", junit)
    status, out, _ = coldspray(*arguments)
    assert status == 1
    assert out.startswith("1 difference")
    assert "Données!C8, value\n    was 500.0, is 450.0" in out
    assert "c0-C8" in page.read_text("utf-8")
    suite = ET.parse(junit).getroot()
    assert [case.get("name") for case in suite] == list(DIFFERENCE_KINDS)
    assert [case.get("name") for case in suite if len(case)] == ["value"]
    assert coldspray(*arguments)[0] == 1  # both files are its own, and written again


@pytest.mark.parametrize("option", ["--html", "--junit"])
@pytest.mark.parametrize("command", ["check", "diff"])
def test_a_file_that_something_else_wrote_is_not_replaced(
    command: str, option: str, tmp_path: Path
) -> None:
    book = writers.with_openpyxl(made("plain", BETA_5), tmp_path / "a.xlsx")
    mine = tmp_path / "mine.html"
    mine.write_text("<!DOCTYPE html><p>three weeks of work</p>")
    files = (book, book) if command == "diff" else (book,)
    status, out, err = coldspray(command, *files, option, mine)
    assert (status, out) == (2, "")
    assert err.endswith("mine.html: this file was written by something else; "
                        "give another name, or remove it\n")  # fmt: skip
    assert "three weeks" in mine.read_text()


@pytest.mark.skipif(os.name != "posix", reason="there, names of files are text")
@pytest.mark.parametrize("command", ["check", "diff"])
def test_a_file_name_that_is_no_text_is_spelled_out(command: str, tmp_path: Path) -> None:
    book = writers.with_openpyxl(made("plain", BETA_5), tmp_path / "a.xlsx")
    odd = Path(os.fsdecode(os.fsencode(tmp_path / "odd") + b"\xff.xlsx"))
    shutil.copyfile(book, odd)
    files = (odd, book) if command == "diff" else (odd,)
    page = tmp_path / "page.html"
    status, out, err = coldspray(command, *files, "--json", "--html", page)
    assert (status, err) == (0, "")
    record: dict[str, Any] = json.loads(out)
    assert "odd\\udcff.xlsx" in record["file"]
    assert "odd\\udcff.xlsx" in page.read_text("utf-8")

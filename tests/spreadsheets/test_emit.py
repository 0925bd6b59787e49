"""The file of a workbook: its parts, its protection, its seal, and what is refused."""

import os
import re
import signal
import subprocess
import zipfile
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from openpyxl import load_workbook
from workbooks import rewritten, usable

from replication.workbook import Workbook
from spreadsheets import emit, safely
from spreadsheets.plan import (
    Cell,
    Chart,
    ChartCurve,
    SheetPlan,
    WorkbookPlan,
    formula,
)


def plan_of(**cells: Cell) -> WorkbookPlan:
    """Return a plan of one sheet with these cells."""
    return WorkbookPlan(sheets=(SheetPlan(name="S", cells=cells, widths={"A": 10.0}),))


# What is refused


@pytest.mark.parametrize("number", [float("inf"), float("-inf"), float("nan")])
@pytest.mark.parametrize("text", ["", "=1+1"])
def test_a_number_that_no_cell_can_hold_is_refused(text: str, number: float) -> None:
    plan = plan_of(A1=Cell(key="k", formula=text))
    message = rf"^k \(S!A1\) is {number}: not a number a cell can hold$"
    with pytest.raises(ValueError, match=message):
        emit.to_bytes(plan, {"k": number})


@pytest.mark.parametrize(
    ("values", "problem"),
    [
        ({}, "1 missing value(s), the first is 'k'"),
        ({"k": 1.0, "z": 2.0}, "1 surplus value(s), the first is 'z'"),
    ],
)
def test_values_must_have_the_keys_of_the_plan(values: Mapping[str, float], problem: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(problem)}$"):
        emit.to_bytes(plan_of(A1=Cell(key="k")), values)


@pytest.mark.filterwarnings("ignore:Name looks like a cell name")
def test_a_name_that_spreadsheets_refuse_is_an_error() -> None:
    with pytest.raises(ValueError, match="'v0' cannot name a cell"):
        emit.to_bytes(plan_of(A1=Cell(key="v0", named=True)), {"v0": 1.0})


# Parts


def parts_of(content: bytes) -> dict[str, str]:
    """Return the parts of a workbook as texts."""
    with zipfile.ZipFile(BytesIO(content)) as archive:
        return {name: archive.read(name).decode() for name in archive.namelist()}


def test_inputs_are_validated_and_nothing_else(emitted: Any) -> None:
    book = load_workbook(emitted.path)
    validations = {str(v.sqref): v for v in book["Inputs"].data_validations.dataValidation}
    for address, cell in emitted.book.plan.sheets[1].cells.items():
        assert (address in validations) == bool(cell.limits or cell.choices), address
        if cell.limits:
            ends = float(validations[address].formula1), float(validations[address].formula2)
            assert ends == cell.limits, address


def test_properties_name_the_program_and_no_date(emitted: Any) -> None:
    parts = parts_of(emitted.path.read_bytes())
    core, app = parts["docProps/core.xml"], parts["docProps/app.xml"]
    assert "Modeling Impacts for Cold-Gas Dynamic Spray" in core
    assert "<dc:creator>coldspray " in core
    assert "Rosset</dc:creator>" not in core
    assert "dcterms:" not in re.sub(r"xmlns:\w+=\S+", "", core)  # no date
    assert "<Application>coldspray</Application>" in app
    assert "Excel" not in app


def test_the_sheets_are_sound_as_far_as_their_parts_tell(emitted: Any) -> None:
    """Finite numbers, rows in order, texts marked as such, all kinds of green triangles off."""
    parts = parts_of(emitted.path.read_bytes())
    sheets = [text for name, text in parts.items() if "worksheets/sheet" in name]
    for text in sheets:
        rows = [int(row) for row in re.findall(r'<row r="(\d+)"', text)]
        assert rows == sorted(set(rows))
        assert not re.search(r"<v>(?:nan|inf|-inf)</v>|_xlfn|#REF!", text)
        # A formula that gives "" must be marked as giving a text.
        assert not re.search(r'<c r="\w+" s="\d+"><f>[^<]*</f><v></v>', text)
        assert text.count("<ignoredError ") == 4
        assert 'evalError="1"' in text
    assert sum("<autoFilter " in text for text in sheets) == 1


OLD_FUNCTIONS = {
    "ABS", "AND", "ASIN", "COUNT", "COUNTIF", "EXP", "IF", "IFERROR", "INDEX", "ISNUMBER", "LN",
    "MAX", "MIN", "NA", "PI", "ROUND", "SIN", "SQRT",
}  # fmt: skip
"""Functions of Excel 2007, the first to read .xlsx. Newer ones would need the prefix _xlfn."""


def test_every_function_is_as_old_as_the_file_format(emitted: Any) -> None:
    formulas = [
        re.sub('"[^"]*"', "", cell.formula)
        for plan in emitted.book.plan.sheets
        for cell in plan.cells.values()
    ]
    called = {name for formula in formulas for name in re.findall(r"([A-Za-z0-9.]+)\(", formula)}
    assert "IFERROR" in called
    assert called <= OLD_FUNCTIONS


def test_a_text_longer_than_its_column_has_room_for_two_lines(emitted: Any) -> None:
    parts = parts_of(emitted.path.read_bytes())
    for number, plan in enumerate(emitted.book.plan.sheets, start=1):
        rows = parts[f"xl/worksheets/sheet{number}.xml"]
        heights = dict(re.findall(r'<row r="(\d+)"[^>]* ht="([\d.]+)"', rows))
        for address, cell in plan.cells.items():
            if cell.wrap and len(cell.text) > 1.2 * plan.widths[address[0]]:
                assert float(heights[address[1:]]) == 2 * plan.row_height, (plan.name, address)


def test_charts_store_numbers_and_are_described(emitted: Any) -> None:
    parts = parts_of(emitted.path.read_bytes())
    charts = [text for name, text in parts.items() if "charts/chart" in name]
    assert len(charts) == 4  # Figure 3 also stands on Overview
    for text in charts:
        assert "<c:numCache>" in text
        assert text.count("<c:strRef>") == text.count("<c:ser>")  # the names of the curves
        assert text.count('</c:yVal><c:smooth val="0"/>') == text.count("<c:ser>")  # straight lines
    drawings = [text for name, text in parts.items() if "drawings/drawing" in name]
    assert all('descr="Line chart' in text for text in drawings)


def test_what_is_not_available_is_stored_as_an_error_and_not_drawn() -> None:
    cells = {
        "A1": formula("x[0]", "=1"), "A2": formula("x[1]", "=NA()"),
        "B1": formula("y[0]", "=2"), "B2": formula("y[1]", "=NA()"),
    }  # fmt: skip
    chart = Chart(
        at="D1", title="T", x_title="x", y_title="y", size=(100, 100),
        curves=[ChartCurve(("S", "A1"), "A1:A2", "B1:B2", beta="3")], describe=lambda _: "a chart",
    )  # fmt: skip
    plan = WorkbookPlan(sheets=(SheetPlan(name="S", cells=cells, charts=[chart]),))
    values = {"x[0]": 1.0, "x[1]": "#N/A", "y[0]": 2.0, "y[1]": "#N/A"}
    parts = parts_of(emit.to_bytes(plan, values))
    assert parts["xl/worksheets/sheet1.xml"].count('t="e"><f>NA()</f><v>#N/A</v>') == 2
    drawn = parts["xl/charts/chart1.xml"]
    cached = re.findall(r"<c:v>([^<]*)</c:v>", drawn.partition("<c:xVal>")[2])
    assert [float(number) for number in cached] == [1.0, 2.0]
    assert "#N/A" not in drawn


def test_the_same_workbook_gives_the_same_bytes(own: Workbook) -> None:
    assert own.to_bytes() == own.to_bytes()


@pytest.mark.slow
def test_the_reports_workbook_prints_on_17_pages(emitted: Any, tmp_path: Path) -> None:
    """Each sheet on one, but the runs of 178 and 131 rows on two each, and the audit on three."""
    assert usable("libreoffice").name
    profile = f"-env:UserInstallation={(tmp_path / 'profile').as_uri()}"
    command = ["soffice", profile, "--headless", "--convert-to", "pdf", str(emitted.path)]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, timeout=120)
    (printed,) = tmp_path.glob("*.pdf")
    assert len(re.findall(rb"/Type\s*/Page\b", printed.read_bytes())) == 17


# Protection


def test_formulas_are_locked_without_a_password_and_nothing_else_is(emitted: Any) -> None:
    for sheet in load_workbook(emitted.path).worksheets:
        assert sheet.protection.sheet
        assert sheet.protection.password is None
        for cell in (cell for row in sheet.iter_rows() for cell in row if cell.value is not None):
            assert cell.protection.locked == (cell.data_type == "f"), (sheet.title, cell.coordinate)


def test_all_else_stays_free(emitted: Any) -> None:
    """Blank cells of all columns, formats, new rows and columns, filters, drawings."""
    parts = parts_of(emitted.path.read_bytes())
    unlocked = {
        str(number)
        for number, style in enumerate(re.findall(r"<xf .*?(?:/>|</xf>)", cell_styles(parts)))
        if 'locked="0"' in style
    }
    assert "0" in unlocked  # cells without a style
    for text in (text for name, text in parts.items() if "worksheets/sheet" in name):
        columns = re.findall(r'<col min="(\d+)" max="(\d+)"[^>]* style="(\d+)"', text)
        covered = [n for first, last, _ in columns for n in range(int(first), int(last) + 1)]
        assert covered == list(range(1, 16385))
        assert {style for *_, style in columns} <= unlocked
        (protection,) = re.findall("<sheetProtection ([^>]*)/>", text)
        options = dict(re.findall(r'(\w+)="(\d)"', protection))
        assert options.pop("sheet") == "1"
        free = {"formatCells", "formatColumns", "formatRows", "insertColumns", "insertRows"}
        assert {name for name, value in options.items() if value == "0"} >= free
        assert "objects" not in options


def cell_styles(parts: Mapping[str, str]) -> str:
    """Return the styles of cells, to which cells and columns refer by number."""
    return parts["xl/styles.xml"].partition("<cellXfs")[2].partition("</cellXfs>")[0]


# The seal


def test_a_workbook_is_our_own_however_it_is_compressed(own: Workbook, tmp_path: Path) -> None:
    """Another version of zlib gives other bytes; here the parts are not compressed at all."""
    path = tmp_path / "own.xlsx"
    content = own.to_bytes()
    path.write_bytes(content)
    assert emit.is_own(path)
    with zipfile.ZipFile(BytesIO(content)) as before, zipfile.ZipFile(path, "w") as after:
        for name in before.namelist():
            after.writestr(name, before.read(name))
    assert path.read_bytes() != content
    assert emit.is_own(path)


def test_a_workbook_with_one_other_number_is_not_our_own(own: Workbook, tmp_path: Path) -> None:
    path = tmp_path / "own.xlsx"

    def changed(part: str, content: bytes) -> bytes:
        return content.replace(b"<v>600.0</v>", b"<v>601.0</v>") if "sheet2" in part else content

    path.write_bytes(rewritten(own.to_bytes(), changed))
    assert not emit.is_own(path)
    path.write_bytes(b"no workbook")
    assert not emit.is_own(path)


# Files


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

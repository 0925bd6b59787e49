"""The file itself: types and parts; what no file can hold is refused.

That it holds every value with all digits is in `test_workbook.py`.
"""

from __future__ import annotations

import io
import os
import re
import signal
import zipfile
from pathlib import Path
from typing import Any

import pytest
from openpyxl import load_workbook

from spreadsheets import emit, safely
from spreadsheets.plan import Cell, SheetPlan, Value, WorkbookPlan


def plan_of(**cells: Cell) -> WorkbookPlan:
    return WorkbookPlan(sheets=(SheetPlan(name="S", cells=cells, widths={"A": 10.0}),))


def test_empty_text_and_truth_have_their_types() -> None:
    values: dict[str, Value] = {"A1": "", "A2": True, "A3": "x"}
    formulas = {"A1": '=IF(1=1,"","x")', "A2": "=1=1", "A3": '="x"'}
    cells = {key: Cell(key=key, formula=formula) for key, formula in formulas.items()}
    content = emit.to_bytes(plan_of(**cells), values)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        sheet = archive.read("xl/worksheets/sheet1.xml").decode()
    assert dict(re.findall(r'<c r="(\w+)"[^>]* t="(\w+)"', sheet)) == {
        "A1": "str", "A2": "b", "A3": "str",
    }  # fmt: skip


@pytest.mark.parametrize("value", [float("inf"), float("-inf"), float("nan")])
@pytest.mark.parametrize("formula", ["", "=1+1"])
def test_a_number_that_no_cell_can_hold_is_refused(value: float, formula: str) -> None:
    with pytest.raises(ValueError, match=r"k \(S!A1\) is"):
        emit.to_bytes(plan_of(A1=Cell(key="k", formula=formula)), {"k": value})


def test_missing_and_surplus_values_are_refused() -> None:
    for values, said in (({}, "1 missing value.* 'k'"), ({"k": 1.0, "z": 2.0}, "1 surplus.* 'z'")):
        with pytest.raises(ValueError, match=said):
            emit.to_bytes(plan_of(A1=Cell(key="k")), values)


@pytest.mark.filterwarnings("ignore:Name looks like a cell name")
def test_a_name_that_spreadsheets_refuse_is_an_error() -> None:
    with pytest.raises(ValueError, match="'v0' cannot name a cell"):
        emit.to_bytes(plan_of(A1=Cell(key="k", name="v0")), {"k": 1.0})


# The whole workbook's file


def test_the_file_is_sound_as_far_as_its_parts_tell(emitted: Any) -> None:
    """Finite numbers, cells in order, no marked errors."""
    book = load_workbook(emitted.path)
    asked = {str(v.sqref): v for v in book["Inputs"].data_validations.dataValidation}
    for address, cell in emitted.book.plan.sheets[1].cells.items():
        assert (address in asked) == bool(cell.limits or cell.choices), address
        if cell.limits:
            ends = float(asked[address].formula1), float(asked[address].formula2)
            assert ends == cell.limits, address
    with zipfile.ZipFile(emitted.path) as archive:
        parts = {name: archive.read(name).decode() for name in archive.namelist()}
    core, app = parts["docProps/core.xml"], parts["docProps/app.xml"]
    assert "Modeling Impacts for Cold-Gas Dynamic Spray" in core
    assert "<dc:creator>coldspray " in core
    assert "Rosset</dc:creator>" not in core
    assert "dcterms:" not in re.sub(r"xmlns:\w+=\S+", "", core)  # no date: none would be true
    assert "<Application>coldspray</Application>" in app
    assert "Excel" not in app
    sheets = [text for name, text in parts.items() if "worksheets/sheet" in name]
    for text in sheets:
        rows = [int(row) for row in re.findall(r'<row r="(\d+)"', text)]
        assert rows == sorted(set(rows))
        assert not re.search(r"<v>(?:nan|inf|-inf)</v>|_xlfn|#REF!", text)
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

"""The file itself: all digits, the same bytes everywhere, whole or not written at all."""

import os
import random
import struct
import subprocess
import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from replication import workbook
from spreadsheets import emit
from spreadsheets.plan import Cell, SheetPlan, Value, WorkbookPlan
from spreadsheets.readback import read

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"


def plan_of(**cells: Cell) -> WorkbookPlan:
    sheet = SheetPlan(name="S", cells=cells, widths={"A": 10.0})
    return WorkbookPlan(sheets=(sheet,), title="t", author="a", subject="s")


def elements(path: Path, part: str = "xl/worksheets/sheet1.xml") -> dict[str, ET.Element]:
    with zipfile.ZipFile(path) as archive:
        root = ET.fromstring(archive.read(part))
    return {cell.attrib["r"]: cell for cell in root.iter(f"{MAIN}c")}


def test_random_doubles_survive_as_number_and_as_formula_value(tmp_path: Path) -> None:
    source = random.Random(1)
    bits = [source.getrandbits(64) for _ in range(1200)]
    doubles = [struct.unpack("<d", struct.pack("<Q", b))[0] for b in bits]
    doubles = [d for d in doubles if abs(d) < 1e300 and abs(d) > 1e-300]
    assert len(doubles) > 1000
    cells = {f"A{r}": Cell(key=f"n{r}") for r in range(1, len(doubles) + 1)}
    cells |= {f"B{r}": Cell(key=f"f{r}", formula="=1+1") for r in range(1, len(doubles) + 1)}
    values: dict[str, Value] = {f"{k}{r}": d for r, d in enumerate(doubles, 1) for k in "nf"}
    path = tmp_path / "w.xlsx"
    emit.write(path, plan_of(**cells), values)
    stored = read(path).values["S"]
    assert [stored[f"A{r}"] for r in range(1, len(doubles) + 1)] == doubles
    assert [stored[f"B{r}"] for r in range(1, len(doubles) + 1)] == doubles


def test_empty_text_and_truth_have_their_types(tmp_path: Path) -> None:
    cells = {
        "A1": Cell(key="blank", formula='=IF(1=1,"","x")'),
        "A2": Cell(key="true", formula="=1=1"),
        "A3": Cell(key="text", formula='="x"'),
    }
    emit.write(tmp_path / "w.xlsx", plan_of(**cells), {"blank": "", "true": True, "text": "x"})
    types = {place: cell.get("t") for place, cell in elements(tmp_path / "w.xlsx").items()}
    assert types == {"A1": "str", "A2": "b", "A3": "str"}


@pytest.mark.parametrize("value", [float("inf"), float("-inf"), float("nan")])
@pytest.mark.parametrize("formula", ["", "=1+1"])
def test_a_number_that_no_cell_can_hold_is_refused(value: float, formula: str) -> None:
    with pytest.raises(ValueError, match=r"k \(S!A1\) is"):
        emit.to_bytes(plan_of(A1=Cell(key="k", formula=formula)), {"k": value})


def test_missing_and_surplus_values_are_refused() -> None:
    plan = plan_of(A1=Cell(key="k"))
    with pytest.raises(ValueError, match=r"1 missing value.* 'k'"):
        emit.to_bytes(plan, {})
    with pytest.raises(ValueError, match=r"1 surplus value.* 'z'"):
        emit.cell_values(plan, {"k": 1.0, "z": 2.0})


@pytest.mark.filterwarnings("ignore:Name looks like a cell name")
def test_a_name_that_spreadsheets_refuse_is_an_error() -> None:
    with pytest.raises(ValueError, match="'v0' cannot name a cell"):
        emit.to_bytes(plan_of(A1=Cell(key="k", name="v0")), {"k": 1.0})


def test_a_failed_write_leaves_the_old_file_and_no_draft(tmp_path: Path) -> None:
    target = tmp_path / "taken"
    target.mkdir()
    with pytest.raises(OSError, match="taken"):
        emit.write(target, plan_of(A1=Cell(key="k")), {"k": 1.0})
    assert list(tmp_path.iterdir()) == [target]


def test_same_bytes_whatever_the_surroundings(tmp_path: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from replication import workbook; "
        "workbook.write(Path(sys.argv[1]))"
    )
    settings = [
        {"TZ": "Pacific/Kiritimati", "PYTHONHASHSEED": "1", "LC_ALL": "C"},
        {"TZ": "America/Adak", "PYTHONHASHSEED": "2", "LC_ALL": "de_DE.UTF-8"},
    ]
    files = []
    for number, setting in enumerate(settings):
        files.append(tmp_path / f"{number}.xlsx")
        environment = {**os.environ, **setting, "PYTHONPATH": os.pathsep.join(sys.path)}
        command = [sys.executable, "-c", code, str(files[-1])]
        subprocess.run(command, env=environment, check=True)
    assert files[0].read_bytes() == files[1].read_bytes()


def test_properties_name_the_report(tmp_path: Path) -> None:
    path = tmp_path / "w.xlsx"
    workbook.write(path)
    with zipfile.ZipFile(path) as archive:
        core = archive.read("docProps/core.xml").decode()
    assert "Modeling Impacts for Cold-Gas Dynamic Spray" in core
    assert "2006-01-01T00:00:00Z" in core

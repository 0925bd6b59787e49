"""What only the report's workbook has: its audit, its figures, its other time step, its checks."""

import subprocess
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from openpyxl import load_workbook

from reference.ledger import load
from replication import workbook
from replication.audit import Verdict, assess_claim
from replication.cases import BETA_5
from spreadsheets import emit
from spreadsheets.engines import Engine
from spreadsheets.plan import Limits, Value
from spreadsheets.sheets.audit import FAILED, REPRODUCED
from spreadsheets.sheets.audit_cells import CELLS, SCALES
from spreadsheets.sheets.inputs import INPUTS
from spreadsheets.sheets.lines import CHECK_INPUTS
from spreadsheets.sheets.results import INVALID
from spreadsheets.sheets.table_check import compared_cells

PLAN, VALUES = workbook.build()
LEDGER = load()
SHEETS = {sheet.name: sheet for sheet in PLAN.sheets}


def test_every_claim_stands_once_on_the_audit_sheet() -> None:
    found = [
        cell.text
        for address, cell in SHEETS["Audit"].cells.items()
        if address[0] == "A" and cell.text in LEDGER.claims
    ]
    assert sorted(found) == sorted(LEDGER.claims)


def test_every_mapped_claim_is_computed_by_the_cell_that_it_names() -> None:
    assert set(CELLS) <= set(LEDGER.claims)
    assert set(CELLS.values()) <= set(PLAN.where)
    assert set(SCALES) <= set(CELLS)
    for key in CELLS.values():
        sheet, address = PLAN.where[key]
        assert SHEETS[sheet].cells[address].formula


@pytest.mark.parametrize("name", CELLS)
def test_the_sheets_verdict_is_the_audits(name: str) -> None:
    verdict = {Verdict.REPRODUCED: REPRODUCED, Verdict.NOT_REPRODUCED: FAILED}
    assert VALUES[f"audit.{name}.verdict"] == verdict[assess_claim(LEDGER, name).verdict]


@pytest.mark.parametrize("name", CELLS)
def test_the_computed_cell_is_in_the_claims_unit(name: str) -> None:
    """To the digits that a double keeps: the audit has its number from 50 digits."""
    reading = assess_claim(LEDGER, name).reading
    computed = VALUES[f"audit.{name}.computed"]
    assert reading is not None
    assert computed == pytest.approx(float(reading.reference), rel=1e-9)


def test_each_number_of_table_a1_prints_as_it_does_in_the_report() -> None:
    for address, *_ in compared_cells():
        assert abs(float(VALUES[f"table_check.{address}.difference"])) <= 0.5


def test_the_coarser_step_moves_the_last_printed_digit() -> None:
    assert VALUES["low_coarse.change_digits"] == pytest.approx(-0.14, abs=0.005)
    assert VALUES["high_coarse.change_digits"] == pytest.approx(-0.93, abs=0.005)


def test_figures_5_closed_form_meets_the_sheet_at_500() -> None:
    assert VALUES["figure_5.velocity[20]"] == 500.0
    closed, sheet = VALUES["figure_5.normalized_depth[20]"], VALUES["high.normalized_depth"]
    assert closed == pytest.approx(sheet, abs=1e-3)


def test_charts_have_numbers_in_every_cell() -> None:
    for sheet in PLAN.sheets:
        shown = emit.cell_values(PLAN, VALUES)[sheet.name]
        for chart in sheet.charts:
            assert "[" in chart.y_title
            assert "[" in chart.x_title
            for cells in (cells for series in chart.series for cells in (series.x, series.y)):
                first, last = cells.split(":")
                rows = range(int(first[1:]), int(last[1:]) + 1)
                assert all(isinstance(shown[f"{first[0]}{row}"], float) for row in rows)


def test_a_users_own_workbook_leaves_out_what_is_about_the_report() -> None:
    plan, values = workbook.build({"Sheet": replace(BETA_5, velocity=600.0)})
    assert [sheet.name for sheet in plan.sheets] == [
        "Contents", "Inputs", "Table A-1", "Sheet", "Figure 3", "Frank-Zook", "Crater",
        "Resistance",
    ]  # fmt: skip
    assert not {"inputs.dt_coarse", "inputs.V_from"} & values.keys()


def test_limits_of_inputs() -> None:
    closed = {name for name, entry in INPUTS.items() if entry.limits.closed}
    assert closed == {"v_stop"}
    assert {INPUTS[name].limits for name in ("CV_PV", "CV_PV_line")} == {Limits(most=0.5)}


@pytest.mark.parametrize(
    ("name", "wrong"),
    [("V_impact", 0.0), ("R_p", -1e-5), ("rho_t", 0.0), ("CV_PV", 0.6), ("R_p", 1e-120)],
)
@pytest.mark.parametrize("program", ["ironcalc", "formualizer", "libreoffice"])
def test_an_input_out_of_range_gives_a_message_and_no_error(
    name: str, wrong: float, program: str, usable: Callable[[str], Engine], tmp_path: Path
) -> None:
    path = tmp_path / "wrong.xlsx"
    emit.write(path, PLAN, VALUES | {f"inputs.{name}": wrong})
    found = usable(program).recalculate(path)

    def at(key: str) -> Value:
        sheet, address = PLAN.where[key]
        return found[sheet].get(address, "")

    assert at("inputs.ok") == 0
    assert at("low.message") == INVALID
    assert at("high.depth_um") == CHECK_INPUTS
    assert at("low.row[0].index") == at("low.row[1].depth") == ""
    errors = [
        (sheet, address, value)
        for sheet, cells in found.items()
        for address, value in cells.items()
        if isinstance(value, str) and value.startswith("#")
    ]
    assert errors == []


def test_charts_store_the_numbers_that_they_show(tmp_path: Path) -> None:
    path = tmp_path / "w.xlsx"
    emit.write(path, PLAN, VALUES)
    with zipfile.ZipFile(path) as archive:
        charts = [archive.read(name).decode() for name in archive.namelist() if _CHART in name]
    assert len(charts) == 3
    for chart in charts:
        assert "<c:numCache>" in chart
        assert "<c:strRef>" not in chart


def test_it_survives_opening_and_saving_in_libreoffice(
    usable: Callable[[str], Engine], tmp_path: Path
) -> None:
    usable("libreoffice")
    emit.write(tmp_path / "w.xlsx", PLAN, VALUES)
    command = ["soffice", f"-env:UserInstallation={(tmp_path / 'profile').as_uri()}", "--headless"]
    command += ["--convert-to", "xlsx", "--outdir", str(tmp_path / "saved"), "w.xlsx"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, timeout=120)
    saved = tmp_path / "saved" / "w.xlsx"
    with zipfile.ZipFile(saved) as archive:
        assert len([name for name in archive.namelist() if _CHART in name]) == 3
    before, after = load_workbook(tmp_path / "w.xlsx"), load_workbook(saved)
    assert set(before.defined_names) <= set(after.defined_names)
    for sheet in PLAN.sheets:
        for address in list(sheet.cells)[:60]:
            old, new = before[sheet.name][address], after[sheet.name][address]
            assert old.number_format == new.number_format
            assert old.fill.fgColor.rgb == new.fill.fgColor.rgb
            assert old.font.b == new.font.b
        validations = after[sheet.name].data_validations.dataValidation
        assert len(validations) > 0 or sheet.name != "Inputs"


_CHART = "charts/chart"


def test_gnumerics_long_doubles_give_the_same_verdicts(
    usable: Callable[[str], Engine], tmp_path: Path
) -> None:
    path = tmp_path / "w.xlsx"
    emit.write(path, PLAN, VALUES)
    found = usable("gnumeric").recalculate(path)
    for name in CELLS:
        sheet, address = PLAN.where[f"audit.{name}.verdict"]
        assert found[sheet][address] == VALUES[f"audit.{name}.verdict"], name

"""The plan: keys and names stand once, formulas use known functions and no physical numbers."""

import re

import pytest

from replication import workbook
from spreadsheets.plan import Cell, SheetPlan, WorkbookPlan
from spreadsheets.sheets.case import MAX_STEPS, prepared_rows
from spreadsheets.sheets.inputs import INPUTS

PLAN = workbook.build()[0]
FORMULAS = {place: cell.formula for place, cell in PLAN.cells() if cell.formula}

FUNCTIONS = {
    "ABS", "ASIN", "COUNT", "EXP", "IF", "IFERROR", "INDEX", "ISNUMBER", "LN", "MAX", "MIN", "PI",
    "ROUND", "ROW", "SIN", "SQRT",
}  # fmt: skip
"""All of Excel 2010 and older, and the same in every engine; none is volatile."""

TRANSCENDENTAL = re.compile(r"LN\(|EXP\(|SIN\(|\^")

MATHEMATICAL = {"0", "0.5", "1", "2", "3", "4", "6", "7", "1000", "1000000", "1000000000"}
"""Numbers of the equations as printed (1/2, 4/3, 7/3), of counting, and of unit prefixes."""


def without_texts_and_addresses(formula: str) -> str:
    formula = re.sub(r'"[^"]*"|\'[^\']*\'!', "", formula)
    return re.sub(r"\$?\b[A-Z]{1,2}\$?\d+\b", "", formula)


@pytest.mark.parametrize("sheet", [sheet.name for sheet in PLAN.sheets])
def test_formulas_hold_no_physical_number(sheet: str) -> None:
    for (name, address), formula in FORMULAS.items():
        if name == sheet:
            rest = re.sub(r"[A-Za-z]\w*", "", without_texts_and_addresses(formula))
            assert set(re.findall(r"[\d.]+", rest)) <= MATHEMATICAL, (address, formula)


def test_formulas_use_known_functions_and_names_only() -> None:
    names = {cell.name for _, cell in PLAN.cells() if cell.name}
    used = set()
    for formula in FORMULAS.values():
        rest = without_texts_and_addresses(formula)
        assert set(re.findall(r"([A-Z]+)\(", rest)) <= FUNCTIONS
        used |= set(re.findall(r"\b[A-Za-z]\w*\b(?!\()", rest))
    assert used <= names
    # What no formula calls is listed for the reader: results.
    results = (
        "depth_um",
        "normalized_depth",
        "final_depth",
        "final_velocity",
        "steps",
        "stop_time",
    )
    cases = ("low", "high", "low_coarse", "high_coarse")
    unused = {
        f"{what}_{case}" for what in (*results, "stopped", "exact_depth_um") for case in cases
    }
    assert names - used <= unused | {"half_step"}


def test_squares_are_written_out() -> None:
    """A power is not the same double everywhere; only the cube root of Eq. 11 is one."""
    powers = [place for place, formula in FORMULAS.items() if "^" in formula]
    assert powers == [PLAN.where["resistance.alpha"]]


def test_every_cell_with_a_transcendental_function_is_marked() -> None:
    found = {place for place, formula in FORMULAS.items() if TRANSCENDENTAL.search(formula)}
    assert found <= PLAN.transcendental
    # The others hand such a value on or round: no row of a sheet is among them.
    keys = {cell.key for _, cell in PLAN.cells() if cell.transcendental}
    assert not [key for key in keys if ".row[" in key]


def test_the_sheets_of_the_report() -> None:
    assert [sheet.name for sheet in PLAN.sheets] == [
        "Contents", "Inputs", "Table A-1", "Table A-1 check", "Sheet beta 3", "Sheet beta 5",
        "Sheet beta 3, 0.5 ns", "Sheet beta 5, 0.5 ns", "Figure 3", "Figure 5", "Convergence",
        "Frank-Zook", "Crater", "Resistance", "Equations", "Audit",
    ]  # fmt: skip


def test_where_finds_the_cell_of_a_key() -> None:
    assert PLAN.where["table.row[1].deceleration"] == ("Table A-1", "E9")
    assert PLAN.where["high.row[131].depth"] == ("Sheet beta 5", "D137")


def test_links_lead_to_sheets() -> None:
    links = {cell.link for (sheet, _), cell in PLAN.cells() if cell.link and sheet == "Contents"}
    assert links == {(sheet.name, "A1") for sheet in PLAN.sheets[1:]}


def test_links_lead_to_cells() -> None:
    cells = dict(PLAN.cells())
    assert all(cell.link in cells for cell in cells.values() if cell.link)


def workbook_of(*cells: Cell) -> WorkbookPlan:
    placed = {f"A{row}": cell for row, cell in enumerate(cells, 1)}
    sheet = SheetPlan(name="S", cells=placed, widths={})
    return WorkbookPlan(sheets=(sheet,), title="t", author="a", subject="s")


def test_a_key_or_name_that_stands_twice_is_an_error() -> None:
    with pytest.raises(ValueError, match="key used twice in the workbook: k"):
        workbook_of(Cell(key="k"), Cell(key="k"))
    with pytest.raises(ValueError, match="name used twice in the workbook: rho"):
        workbook_of(Cell(key="k", name="rho"), Cell(key="m", name="RHO"))


def test_a_cell_is_of_one_kind() -> None:
    with pytest.raises(ValueError, match="not both"):
        Cell(text="x", key="k")
    with pytest.raises(ValueError, match="has a key"):
        Cell(formula="=1")
    with pytest.raises(ValueError, match="starts with '='"):
        Cell(formula="1", key="k")


def test_inputs_are_the_decimals_that_the_report_prints() -> None:
    assert INPUTS["R_p"].si == 11e-6
    assert INPUTS["R_t_RHA"].si == 9.13e9
    assert INPUTS["L_typ"].si == 20e-6
    unprinted = {name for name, entry in INPUTS.items() if not entry.printed}
    assert unprinted == {"rho_t", "lbf_N", "inch_m"}


def test_rows_are_prepared_with_a_reserve() -> None:
    for steps in (0, 1, 99, 100, 131, 178, MAX_STEPS):
        assert prepared_rows(steps) >= max(2 * steps, steps + 100)
    with pytest.raises(ValueError, match="take a larger step"):
        prepared_rows(MAX_STEPS + 1)

"""The sheet `Table A-1`: the report's table, cell for cell in A1:F12, as live formulas.

Every number format gives the text that the report prints, `6E-10` in General included. Beside it,
from column H on, stands the printed text itself.
"""

from spreadsheets.plan import Cell, SheetPlan
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.motion import impact_index, moves_on, step_cells

__all__ = ["PRINTED", "ROWS", "sheet"]

ROWS = 5
"""Rows of the table, row 0 (the impact itself) included."""

PRINTED = (
    ("R =", "1.10E-05", "", "", "", ""),
    ("Density =", "8.90E+03", "", "", "", ""),
    ("M =", "4.96E-11", "", "", "", ""),
    ("D =", "2.20E-05", "", "", "", ""),
    ("Initial vel =", "500", "", "", "", ""),
    ("Rt =", "3.50E+09", "", "", "", ""),
    ("Time", "", "dx/dt initial", "x", "d²x/dt²", "dx/dt final"),
    ("0", "", "500", "0", "0", ""),
    ("2.00E-10", "", "500", "5.00E-08", "3.11E+08", "5.00E+02"),
    ("4.00E-10", "", "5.00E+02", "1.50E-07", "9.30E+08", "5.00E+02"),
    ("6E-10", "", "5.00E+02", "2.50E-07", "1.54E+09", "4.99E+02"),
    ("8.00E-10", "", "4.99E+02", "3.50E-07", "2.15E+09", "4.99E+02"),
)
"""The text of A1:F12, as the report prints it."""

_FIRST = 8
_SCIENTIFIC = "0.00E+00"
_HEADER = {
    "radius": ("R_p", "m"),
    "particle_density": ("rho_p", "kg/m³"),
    "mass": ("M_p", "kg"),
    "diameter": ("D_p", "m"),
    "velocity": ("V_impact", "m/s"),
    "resistance": ("R_t", "Pa"),
}


def sheet(case: CaseSheet, report: bool) -> SheetPlan:
    """The table for a case: the report's is the one of beta = 5.

    `report`: with the printed text beside it.
    """
    cells = _header(case) | _impact_row()
    for step in range(1, ROWS):
        cells |= _step_row(step, (case.named("R_t"), case.step_named))
    if report:
        cells |= _printed()
    notes = (
        "Table A-1. Rigid body penetration. Columns A to F: live formulas, the inputs of "
        f"{case.name}." + (" Columns H to M: the report's text." if report else ""),
        "M: Eq. 3 times the density. Rt: Eqs. 7, A-2. d²x/dt²: Eqs. 13, A-1, A-3. "
        "Velocities and x: appendix.",
    )
    for row, note in enumerate(notes, start=14):
        cells[f"A{row}"] = Cell(text=note, style="note")
    widths = dict.fromkeys("ABCDEF", 13.0) | {"G": 4.0} | dict.fromkeys("HIJKLM", 13.0)
    return SheetPlan(name="Table A-1", cells=cells, widths=widths)


def _header(case: CaseSheet) -> dict[str, Cell]:
    cells: dict[str, Cell] = {}
    for row, (what, (symbol, unit)) in enumerate(_HEADER.items(), start=1):
        label, printed = PRINTED[row - 1][:2]
        name = case.named(symbol) if what == "resistance" else symbol
        cells[f"A{row}"] = Cell(text=label, style="body")
        cells[f"B{row}"] = Cell(
            key=f"table.{what}",
            formula=f"={name}",
            style="number",
            number_format=_format(printed),
            unit=unit,
            source="Table A-1",
        )
    for column, text in zip("ABCDEF", PRINTED[_FIRST - 2], strict=True):
        style = "head" if column in "AB" else "head right"
        cells[f"{column}{_FIRST - 1}"] = Cell(text=text, style=style)
    return cells


def _impact_row() -> dict[str, Cell]:
    """Row 0: at time 0 the particle stands at x = 0, not yet decelerated."""
    start = {"A": "time", "D": "depth", "E": "deceleration"}
    cells = {
        f"{column}{_FIRST}": Cell(
            key=f"table.row[0].{what}", formula=impact_index(), style="number"
        )
        for column, what in start.items()
    }
    velocity = Cell(key="table.row[0].velocity_initial", formula="=V_impact", style="number")
    return cells | {f"C{_FIRST}": velocity}


def _step_row(step: int, names: tuple[str, str]) -> dict[str, Cell]:
    row, first = _FIRST + step, step == 1
    printed = dict(zip("ABCDEF", PRINTED[row - 1], strict=True))
    formats = {column: _format(text) for column, text in printed.items()}
    time = moves_on(row, first, f"(ROW(A{row - 1})-ROW(A${_FIRST})+1)*dt_s")
    cells = step_cells(row, first, names, f"table.row[{step}]", formats)
    cells[f"A{row}"] = Cell(
        key=f"table.row[{step}].time",
        formula=time,
        style="number",
        number_format=formats["A"],
        unit="s",
        source="Table A-1",
    )
    return cells


def _printed() -> dict[str, Cell]:
    cells = {}
    for row, texts in enumerate(PRINTED, start=1):
        for column, text in zip("HIJKLM", texts, strict=True):
            if text:
                label = column == "H" and row < _FIRST
                style = "printed label" if label else "printed"
                cells[f"{column}{row}"] = Cell(text=text, style=style)
    return cells


def _format(printed: str) -> str:
    """The number format that shows a number as printed: "6E-10" is General, "2.00E-10" is not."""
    return _SCIENTIFIC if "." in printed else "General"

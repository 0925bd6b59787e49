"""The sheet `Figure 5`: normalized depth against impact velocity, by the closed form."""

from spreadsheets.plan import Cell, Chart, Series, SheetPlan
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.lines import valid_only
from spreadsheets.sheets.results import rest_depth_formula

__all__ = ["POINTS", "sheet"]

POINTS = 21
"""Velocities, both ends included: 5 m/s apart from 400 to 500 m/s."""

_FIRST = 6
_LAST = _FIRST + POINTS - 1
_NOTE = (
    "Depth at rest by the closed form (Eq. 13 separated and integrated), without time steps; β and "
    "materials from Inputs, as are the two ends of the axis."
)
_COLUMNS = (
    ("P", "Point", "", "", "0"),
    ("Q", "Velocity", "m/s", "velocity", "General"),
    ("R", "c", "–", "c", "0.0000"),
    ("S", "X/R", "–", "normalized_depth", "0.0000"),
    ("T", "X", "µm", "depth_um", "0.0000"),
)


def sheet(case: CaseSheet) -> SheetPlan:
    """The sheet for the case that the figure is about: beta = 5."""
    cells = {
        "A1": Cell(
            text="Normalized depth against velocity (as the report's Figure 5)", style="title"
        ),
        "A2": Cell(text=_NOTE, style="note"),
    }
    for column, head, unit, _, _ in _COLUMNS:
        cells[f"{column}{_FIRST - 2}"] = Cell(text=head, style="head right")
        if unit:
            cells[f"{column}{_FIRST - 1}"] = Cell(text=unit, style="unit right")
    for point in range(POINTS):
        cells |= _point(point, case)
    chart = Chart(
        at="A4",
        title="Normalized penetration depth against impact velocity",
        x_title="Impact velocity [m/s]",
        y_title="Normalized depth X/R [–]",
        series=(Series(case.name, f"Q{_FIRST}:Q{_LAST}", f"S{_FIRST}:S{_LAST}"),),
        categories=True,
    )
    return SheetPlan(
        name="Figure 5",
        cells=cells,
        widths={"P": 8.0} | dict.fromkeys("QRST", 12.0),
        charts=(chart,),
        print_area="A1:N29",
    )


def _point(point: int, case: CaseSheet) -> dict[str, Cell]:
    row = _FIRST + point
    c, depth = rest_depth_formula(f"Q{row}", case.named("R_t"), f"R{row}")
    formulas = {
        "Q": f"=V_from+(V_to-V_from)*P{row}/P${_LAST}",
        "R": c,
        "S": depth,
        "T": f"=S{row}*R_p*1000000",
    }
    cells = {f"P{row}": Cell(key=f"figure_5.point[{point}]", style="number")}
    for column, _, unit, what, shown in _COLUMNS:
        if column in formulas:
            cells[f"{column}{row}"] = Cell(
                key=f"figure_5.{what}[{point}]",
                formula=valid_only(formulas[column]),
                style="number",
                number_format=shown,
                unit=unit,
                source="Eq. 13",
                transcendental=column != "Q",
            )
    return cells

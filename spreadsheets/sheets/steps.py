"""The sheets of a case: the whole midpoint scheme, down to the stop, with either time step.

Below the stop follow rows that are blank until an input needs them. If even they do not suffice,
the result says so instead of giving a depth.
"""

from spreadsheets.plan import Cell, Rule, SheetPlan
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.motion import guarded, impact_index, moves_on, step_cells
from spreadsheets.sheets.results import WIDTHS, results

__all__ = ["FIRST_ROW", "sheet"]

FIRST_ROW = 6
"""Row 0 of the scheme, the impact itself, stands in this row of the sheet."""

_HEADS = (
    ("A", "Row", "", ""),
    ("B", "Time", "s", "Appendix"),
    ("C", "dx/dt initial", "m/s", "Appendix"),
    ("D", "x", "m", "Appendix"),
    ("E", "d²x/dt²", "m/s²", "Eqs. 13, A-3"),
    ("F", "dx/dt final", "m/s", "Appendix"),
    ("G", "x", "µm", ""),
)
_FORMATS = {"C": "0.000", "D": "0.0000E+00", "E": "0.0000E+00", "F": "0.000"}


def sheet(case: CaseSheet) -> SheetPlan:
    """The sheet of one case."""
    last = FIRST_ROW + case.rows
    cells = _title(case) | {"A2": Cell(text=_NOTE, style="note")}
    for column, head, unit, source in _HEADS:
        cells[f"{column}4"] = Cell(text=head, style="head right")
        if unit:
            cells[f"{column}5"] = Cell(text=unit, style="unit right")
        if source:
            cells[f"{column}3"] = Cell(text=source, style="printed")
    cells |= results(case, FIRST_ROW, last) | _impact_row(case)
    for step in range(1, case.rows + 1):
        cells |= _step_row(step, case)
    widths = {"A": 5.0, **dict.fromkeys("BCDEF", 12.0), "G": 8.0, "H": 3.0}
    widths |= WIDTHS
    return SheetPlan(
        name=case.name,
        cells=cells,
        widths=widths,
        frozen=f"A{FIRST_ROW}",
        repeated_rows=(4, 5),
        print_area=f"A1:N{FIRST_ROW + case.steps}",
        rules=_rules(case, cells, last),
    )


def _title(case: CaseSheet) -> dict[str, Cell]:
    """The title, with the live β and Δt: the sheet keeps its name when they change."""
    cells = {"A1": Cell(text="Rigid-body penetration, row by row", style="title")}
    shown = [("I", "J", "Δt [s] =", "step", case.step_named)]
    if not case.resistance_given:
        shown.append(("F", "G", "β =", "beta", case.named("beta")))
    for label, value, text, what, name in shown:
        cells[f"{label}1"] = Cell(text=text, style="title right")
        cells[f"{value}1"] = Cell(
            key=f"{case.part}.title.{what}", formula=f"={name}", style="title left", source="Inputs"
        )
    return cells


_NOTE = (
    "Row 1 takes x = v Δt/2 (half a step), every later row x + v Δt; d²x/dt² is printed positive, "
    "from that x and the initial velocity. The run stops with the first row below v_stop. "
    "Printing ends with the last row of the inputs as emitted."
)


def _rules(case: CaseSheet, cells: dict[str, Cell], last: int) -> tuple[Rule, ...]:
    """A thin line under each row in use; a red message when the rows do not suffice."""
    places = {cell.key: address for address, cell in cells.items()}
    message, stopped = places[f"{case.part}.message"], places[f"{case.part}.stopped"]
    return (
        Rule(cells=f"A{FIRST_ROW}:G{last}", formula=f"=ISNUMBER($A{FIRST_ROW})", style="ruled"),
        Rule(cells=message, formula=f"={stopped}=0", style="warning"),
    )


def _impact_row(case: CaseSheet) -> dict[str, Cell]:
    """Row 0: time, x and deceleration are 0 by the initial conditions; no final velocity."""
    row, key = FIRST_ROW, f"{case.part}.row[0]"
    starts = {"B": "time", "D": "depth", "E": "deceleration"}
    cells = {
        f"{column}{row}": Cell(key=f"{key}.{what}", formula=guarded(row, "0"), style="number")
        for column, what in starts.items()
    }
    cells[f"A{row}"] = Cell(key=f"{key}.index", formula=impact_index(), style="number")
    cells[f"C{row}"] = Cell(
        key=f"{key}.velocity_initial",
        formula=guarded(row, "V_impact"),
        style="number",
        number_format="0.000",
    )
    cells[f"G{row}"] = _micrometers(row, key)
    return cells


def _step_row(step: int, case: CaseSheet) -> dict[str, Cell]:
    row, first, key = FIRST_ROW + step, step == 1, f"{case.part}.row[{step}]"
    index = moves_on(row, first, f"A{row - 1}+1")
    cells = {
        f"A{row}": Cell(key=f"{key}.index", formula=index, style="number"),
        f"B{row}": Cell(
            key=f"{key}.time",
            formula=guarded(row, f"A{row}*{case.step_named}"),
            style="number",
            number_format="0.00E+00",
        ),
    }
    cells |= step_cells(row, first, (case.named("R_t"), case.step_named), key, _FORMATS)
    return cells | {f"G{row}": _micrometers(row, key)}


def _micrometers(row: int, key: str) -> Cell:
    return Cell(
        key=f"{key}.depth_um",
        formula=guarded(row, f"D{row}*1000000"),
        style="number",
        number_format="0.0000",
    )

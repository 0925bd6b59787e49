"""The sheet `Figure 3`: penetration depth against time, its chart and the numbers behind it."""

from spreadsheets.plan import Cell, Chart, Series, SheetPlan
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.steps import FIRST_ROW

__all__ = ["sheet"]

_HEAD = 4
_FIRST = 6
_NOTE = (
    "Columns P on repeat the rows of the sheets in ns and µm. After the stop they hold the last "
    "row, so that the chart has a number in every cell."
)


def sheet(cases: tuple[CaseSheet, ...]) -> SheetPlan:
    """The sheet: one curve for each of the cases."""
    cells = {
        "A1": Cell(text="Penetration depth against time (as the report's Figure 3)", style="title"),
        "A2": Cell(text=_NOTE, style="note"),
    }
    series = []
    for columns, case in zip((("P", "Q"), ("R", "S")), cases, strict=False):
        cells |= _curve(case, columns)
        last = _FIRST + case.rows
        x, y = (f"{column}{_FIRST}:{column}{last}" for column in columns)
        series.append(Series(case.name, x, y))
    chart = Chart(
        at="A4",
        title="Penetration depth against time",
        x_title="Time [ns]",
        y_title="Penetration depth [µm]",
        series=tuple(series),
    )
    return SheetPlan(
        name="Figure 3",
        cells=cells,
        widths=dict.fromkeys("PQRS", 14.0),
        charts=(chart,),
        print_area="A1:N29",
    )


def _curve(case: CaseSheet, columns: tuple[str, str]) -> dict[str, Cell]:
    time, depth = columns
    cells = {f"{time}{_HEAD - 1}": Cell(text=case.name, style="block")}
    for column, head, unit in ((time, "Time", "ns"), (depth, "Depth", "µm")):
        cells[f"{column}{_HEAD}"] = Cell(text=head, style="head right")
        cells[f"{column}{_HEAD + 1}"] = Cell(text=unit, style="unit right")
    quantities = (
        (time, "time", "B", "*1000000000", "0.00"),
        (depth, "depth", "G", "", "0.0000"),
    )
    for k in range(case.rows + 1):
        row, there = _FIRST + k, FIRST_ROW + k
        for column, what, source, scale, shown in quantities:
            before = f"{column}{row - 1}" if k else "0"
            running = f"ISNUMBER('{case.name}'!A{there})"
            cells[f"{column}{row}"] = Cell(
                key=f"figure_3.{case.slug}.{what}[{k}]",
                formula=f"=IF({running},'{case.name}'!{source}{there}{scale},{before})",
                style="number",
                number_format=shown,
            )
    return cells

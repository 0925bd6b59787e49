"""The sheet `Figure 3`: depth against time, one curve for each case."""

from collections.abc import Mapping, Sequence

from reference.ledger import Ledger
from spreadsheets.plan import Cell, Chart, ChartCurve, SheetPlan, ShownValue, formula
from spreadsheets.sheets.case import FIRST_ROW, CaseSheet

_FIRST = 7


def figure_3(ledger: Ledger, cases: Sequence[CaseSheet]) -> SheetPlan:
    """Plan the chart of depth against time, one curve for each case."""
    sheet = SheetPlan(ledger=ledger, name="Figure 3", about="Depth against time, with its chart")
    sheet.begin("Penetration depth against time (compare the report’s Figure 3)")
    sheet.wide("PQRS", 14)
    sheet.cells["P2"] = Cell(
        "After the stop the columns repeat the last row, so that every cell has a number to draw.",
        "note",
    )
    curves = []
    for row, (columns, case) in enumerate(zip(("PQ", "RS"), cases, strict=False), start=3):
        s = case.suffix
        message = f'=label{s}&": "&message{s}'
        sheet.cells[f"A{row}"] = formula(f"figure_3.{case.slug}.message", message, "message")
        sheet.rules += case.rules(f"A{row}")
        sheet.cells[f"{columns[0]}4"] = Cell(case.name, "block")
        sheet.row = 5
        _curve(sheet, case, *columns)
        x, y = (f"{column}{_FIRST}:{column}{_FIRST + case.rows}" for column in columns)
        curves.append(ChartCurve((case.name, "I1"), x, y, case.beta))

    def describe(values: Mapping[str, ShownValue]) -> str:
        ends = ", ".join(
            f"{case.label} reaches {values[f'depth_um{case.suffix}']:.4g} µm after"
            f" {values[f'figure_3.{case.slug}.time[{case.rows}]']:.3g} ns"
            for case in cases
        )
        return (
            "Line chart: depth x in µm against time in ns, one curve for each case, the first solid"
            f" and the second dashed. As written, {ends}."
        )

    sheet.chart = Chart(
        at="A6",
        title="Penetration depth against time",
        x_title="Time [ns]",
        y_title="Penetration depth [µm]",
        size=(820, 470),
        curves=curves,
        describe=describe,
        sheet=sheet.name,
    )
    sheet.print_area = "A1:N34"
    return sheet


def _curve(sheet: SheetPlan, case: CaseSheet, time_column: str, depth_column: str) -> None:
    """Add times and depths; they repeat the last row of the case, and are #N/A without any row."""
    times, depths = [], []
    for step in range(case.rows + 1):
        row = f"{FIRST_ROW + step}"
        index, time, depth = (f"'{case.name}'!{column}{row}" for column in "ABG")
        above = _FIRST + step - 1
        last_time, last_depth = f"{time_column}{above}", f"{depth_column}{above}"
        if step == 0:
            last_time = last_depth = "NA()"
        key = f"figure_3.{case.slug}"
        times.append(
            formula(
                f"{key}.time[{step}]", f"=IF(ISNUMBER({index}),{time}*1000000000,{last_time})",
                shown="0.00", unit="ns",
            )
        )  # fmt: skip
        depths.append(
            formula(
                f"{key}.depth[{step}]", f"=IF(ISNUMBER({index}),{depth},{last_depth})",
                shown="0.0000", unit="um", like=f"{case.part}.depth_um",
            )
        )  # fmt: skip
    sheet.column(time_column, "Time", "ns", times)
    sheet.column(depth_column, "Depth", "um", depths)

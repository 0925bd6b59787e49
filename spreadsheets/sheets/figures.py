"""The sheet of both charts: depth against time (Figure 3) and against velocity (Figure 5)."""

from collections.abc import Mapping, Sequence

from reference.ledger import Ledger
from spreadsheets.plan import Cell, Chart, ChartCurve, Rule, SheetPlan, ShownValue, formula
from spreadsheets.sheets import messages
from spreadsheets.sheets.case import FIRST_ROW, CaseSheet
from spreadsheets.sheets.formulas import cap_angle, depth, log1p

FIGURES = "Figures 3 and 5"
"""The name of the sheet."""

FIGURE_5_POINTS = 21
"""Number of velocities, including both ends."""

_FIRST = 7
_LAST = _FIRST + FIGURE_5_POINTS - 1
"""The first row of the numbers that are drawn, and the last one of Figure 5."""

_SIZE = (760, 425)
"""Of each chart in pixels: 12 columns and 24 rows."""


def figures(ledger: Ledger, cases: Sequence[CaseSheet]) -> SheetPlan:
    """Plan the sheet: one curve for each case in Figure 3, and the last case in Figure 5."""
    about = "Depth against time, and normalized depth against velocity, with their charts"
    sheet = SheetPlan(ledger=ledger, name=FIGURES, about=about, portrait=True, most_pages=1)
    sheet.begin("Figures 3 and 5")
    _figure_3(sheet, cases)
    _figure_5(sheet, cases[-1])
    sheet.print_area = "A1:L60"
    return sheet


def _figure_3(sheet: SheetPlan, cases: Sequence[CaseSheet]) -> None:
    """Add the chart of depth against time, one curve for each case."""
    sheet.block("Penetration depth against time: compare the report’s Figure 3")
    sheet.wide("NOPQ", 14)
    sheet.cells["N2"] = Cell("After the stop the columns repeat the last row.", "note")
    curves = []
    for row, (columns, case) in enumerate(zip(("NO", "PQ"), cases, strict=False), start=4):
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

    chart = Chart(
        at="A7",
        title="Penetration depth against time",
        x_title="Time [ns]",
        y_title="Penetration depth [µm]",
        size=_SIZE,
        curves=curves,
        describe=describe,
        sheet=sheet.name,
    )
    sheet.charts.append(chart)


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


def _figure_5(sheet: SheetPlan, case: CaseSheet) -> None:
    """Add the chart of normalized depth against velocity; the report's own is for beta = 5."""
    sheet.row = 32
    sheet.block("Normalized depth against velocity: compare the report’s Figure 5")
    sheet.wide("S", 8)
    sheet.wide("TUVWXYZ", 12)
    points = f"COUNT(Y{_FIRST}:Y{_LAST})"
    message = f'=IF({points}<{FIGURE_5_POINTS},"{messages.POINTS_MISSING}","{messages.ALL_POINTS}")'
    sheet.rules.append(Rule(f"A{sheet.row}", f"={points}<{FIGURE_5_POINTS}", "warning"))
    sheet.put(A=formula("figure_5.message", message, "message"))
    sheet.say(
        "Depth at rest without time steps (Eqs. 12 and 13 integrated), so no warning about the step"
        " concerns it. The ends of the axis stand on the sheet Inputs.",
        width=120,
    )
    sheet.cells["S2"] = Cell("p, c and h as on the sheets of the cases.", "note")
    sheet.row = _FIRST - 2
    _points(sheet, case)

    def describe(values: Mapping[str, ShownValue]) -> str:
        low, high = (
            f"{values[f'figure_5.normalized_depth[{k}]']:.3g} at"
            f" {values[f'figure_5.velocity[{k}]']:.4g} m/s"
            for k in (0, FIGURE_5_POINTS - 1)
        )
        return (
            "Line chart: normalized depth X/R at rest against impact velocity in m/s. As written,"
            f" for {case.label}, from {low} to {high}."
        )

    x, y = f"T{_FIRST}:T{_LAST}", f"Y{_FIRST}:Y{_LAST}"
    chart = Chart(
        at="A37",
        title="Normalized penetration depth against impact velocity",
        x_title="Impact velocity [m/s]",
        y_title="Normalized depth X/R [–]",
        size=_SIZE,
        curves=[ChartCurve((case.name, "I1"), x, y, case.beta)],
        describe=describe,
    )
    sheet.charts.append(chart)


def _points(sheet: SheetPlan, case: CaseSheet) -> None:
    """Add the columns: number of the point, velocity, p, ln(1 + p), c, h, X/R and X."""
    rows = range(_FIRST, _LAST + 1)

    def column(
        letter: str, head: str, unit: str, key: str, formulas: list[str], shown: str = "0.0000"
    ) -> None:
        cells = [
            formula(f"figure_5.{key}[{k}]", text, unit=unit if unit != "–" else "1", shown=shown)
            for k, text in enumerate(formulas)
        ]
        sheet.column(letter, head, unit, cells)

    sheet.column(
        "S", "Point", "", [Cell(number=float(k), style="number") for k in range(FIGURE_5_POINTS)]
    )
    velocities = [f"=V_from+(V_to-V_from)*S{row}/S{_LAST}" for row in rows]
    column("T", "Velocity", "m/s", "velocity", velocities, shown="General")
    pressures = [f"=rho_t*T{row}*T{row}/2/{case.resistance}" for row in rows]
    column("U", "p", "–", "pressure", pressures)
    column("V", "ln(1 + p)", "–", "ln", [log1p(f"U{row}") for row in rows])
    column("W", "c", "–", "c", [f"=4*rho_p/(3*rho_t)*V{row}" for row in rows])
    column("X", "h", "–", "h", [cap_angle(f"W{row}") for row in rows])
    depths = [depth(f"W{row}", f"X{row}") for row in rows]
    column("Y", "X/R", "–", "normalized_depth", depths)
    column("Z", "X", "um", "depth_um", [f"=Y{row}*R_p*1000000" for row in rows])

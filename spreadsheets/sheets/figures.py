"""The sheets `Figure 3`, `Figure 5` and `Convergence`: charts, and the numbers behind them."""

from collections.abc import Sequence

from spreadsheets.plan import Cell, Chart, Rule, Series, SheetPlan
from spreadsheets.sheets.lines import NOT_COMPUTED, guarded, notes, title
from spreadsheets.sheets.steps import FIRST_ROW, CaseSheet, rest_depth

__all__ = ["LEVELS", "POINTS", "RUN_INPUTS", "convergence", "figure_3", "figure_5"]

_CHART_ROWS = 24
"""Rows that a chart covers, with the default height of 20 pixels."""


def figure_3(cases: Sequence[CaseSheet], written: str) -> SheetPlan:
    """Depth against time, one curve for each case; `written` says what it shows as written."""
    cells = title("Penetration depth against time (as the report’s Figure 3)")
    first, series = 7, []
    rules: list[Rule] = []
    for at, (columns, case) in enumerate(zip((("P", "Q"), ("R", "S")), cases, strict=False)):
        cells |= _curve(case, columns, first)
        state = f"A{3 + at}"
        message = f"='{case.name}'!I1&\": \"&{case.result('message')}"
        key = f"figure_3.{case.slug}.message"
        cells[state] = Cell(key=key, formula=message, style="message")
        rules += case.rules(state)
        last = first + case.rows
        x, y = (f"{column}{first}:{column}{last}" for column in columns)
        series.append(Series((case.name, "I1"), x, y))
    cells["P2"] = Cell(
        text="After the stop the columns hold the last row, so that the chart has a number in each "
        "cell.",
        style="note",
    )
    chart = Chart(
        at="A6",
        title="Penetration depth against time",
        description="Line chart: depth x in µm against time in ns, one curve for each case, the "
        f"first solid and the second dashed. {written}",
        x_title="Time [ns]",
        y_title="Penetration depth [µm]",
        series=tuple(series),
    )
    return SheetPlan(
        name="Figure 3",
        cells=cells,
        widths=dict.fromkeys("PQRS", 14.0),
        rules=tuple(rules),
        charts=(chart,),
        print_area=f"A1:N{7 + _CHART_ROWS}",
    )


def _curve(case: CaseSheet, columns: tuple[str, str], first: int) -> dict[str, Cell]:
    time, depth = columns
    cells = {f"{time}{first - 3}": Cell(text=case.name, style="block")}
    for column, head, unit in ((time, "Time", "ns"), (depth, "Depth", "µm")):
        cells[f"{column}{first - 2}"] = Cell(text=head, style="head right")
        cells[f"{column}{first - 1}"] = Cell(text=unit, style="unit right")
    quantities = (
        (time, "time", "B", "*1000000000", "0.00", ""),
        (depth, "depth", "G", "", "0.0000", f"{case.part}.depth_um"),
    )
    for k in range(case.rows + 1):
        row, there = first + k, FIRST_ROW + k
        for column, what, source, scale, shown, group in quantities:
            before = f"{column}{row - 1}" if k else "0"
            running = f"ISNUMBER('{case.name}'!A{there})"
            cells[f"{column}{row}"] = Cell(
                key=f"figure_3.{case.slug}.{what}[{k}]",
                formula=f"=IF({running},'{case.name}'!{source}{there}{scale},{before})",
                style="number",
                number_format=shown,
                column=group,
            )
    return cells


POINTS = 21
"""Velocities of Figure 5, both ends included."""

_FIGURE_5 = (
    ("P", "Point", "", "", "0"),
    ("Q", "Velocity", "m/s", "velocity", "General"),
    ("R", "p", "–", "pressure", "0.0000"),
    ("S", "c", "–", "c", "0.0000"),
    ("T", "X/R", "–", "normalized_depth", "0.0000"),
    ("U", "X", "µm", "depth_um", "0.0000"),
)


def figure_5(case: CaseSheet, written: str) -> SheetPlan:
    """Normalized depth against velocity for one case; the report's is that of beta = 5."""
    first = 7
    last = first + POINTS - 1
    cells = title("Normalized depth against velocity (as the report’s Figure 5)")
    cells["P2"] = Cell(text="p and c as on the sheets of the cases.", style="note")
    message = f'IF(COUNT(T{first}:T{last})={POINTS},"All points are computed.",'
    message += f'"POINTS ARE MISSING: {NOT_COMPUTED}, see the sheet Inputs.")'
    cells["A3"] = Cell(key="figure_5.message", formula=f"={message}", style="message")
    cells |= notes(
        4,
        "Depth at rest without time steps (Eqs. 12 and 13 integrated), so no warning about the "
        "step concerns it. The ends of the axis stand on the sheet Inputs.",
        width=110,
    )
    for column, head, unit, _, _ in _FIGURE_5:
        cells[f"{column}{first - 2}"] = Cell(text=head, style="head right")
        cells[f"{column}{first - 1}"] = Cell(text=unit, style="unit right")
    for point in range(POINTS):
        cells |= _point(point, first + point, last, case)
    chart = Chart(
        at="A7",
        title="Normalized penetration depth against impact velocity",
        description="Line chart: normalized depth X/R at rest against impact velocity in m/s. "
        f"{written}",
        x_title="Impact velocity [m/s]",
        y_title="Normalized depth X/R [–]",
        series=(Series((case.name, "I1"), f"Q{first}:Q{last}", f"T{first}:T{last}"),),
    )
    return SheetPlan(
        name="Figure 5",
        cells=cells,
        widths={"P": 8.0} | dict.fromkeys("QRSTU", 12.0),
        rules=(Rule(cells="A3", formula=f"=COUNT(T{first}:T{last})<{POINTS}", style="warning"),),
        charts=(chart,),
        print_area=f"A1:N{8 + _CHART_ROWS}",
    )


def _point(point: int, row: int, last: int, case: CaseSheet) -> dict[str, Cell]:
    c, depth = rest_depth(f"R{row}", f"S{row}")
    formulas = {
        "Q": f"=V_from+(V_to-V_from)*P{row}/P{last}",
        "R": f"=rho_t*Q{row}*Q{row}/2/{case.named('R_t')}",
        "S": c,
        "T": depth,
        "U": f"=T{row}*R_p*1000000",
    }
    cells = {f"P{row}": Cell(number=float(point), style="number")}
    for column, _, _, what, shown in _FIGURE_5:
        if column in formulas:
            cells[f"{column}{row}"] = Cell(
                key=f"figure_5.{what}[{point}]",
                formula=guarded(formulas[column]),
                style="number",
                number_format=shown,
                transcendental=column in "STU",
            )
    return cells


LEVELS = 8
"""Steps of the ladder, each half of the one before; the fifth is the step dt_s as written."""

RUN_INPUTS = ("V_impact", "R_p", "rho_p", "rho_t", "dt_s", "v_stop")
"""The inputs, besides the target resistance, that the ladder's runs were made with."""

CURRENT = "The inputs in use are those of these runs."
STALE = "THE INPUTS IN USE ARE NOT THOSE OF THESE RUNS: write the workbook again to renew them."
NO_ORDER = "–"

_COLUMNS = (("C", "D", "E", "F", "G"), ("H", "I", "J", "K", "L"))
_LADDER = (
    ("Steps", "", "steps", "0"),
    ("Final depth", "µm", "depth_um", "0.000000"),
    ("Error", "µm", "error", "0.000000"),
    ("|Error|", "µm", "size", "0.0E+00"),
    ("Order", "–", "order", "0.00"),
)


def convergence(cases: Sequence[CaseSheet], written: str) -> SheetPlan:
    """The final depth at a ladder of time steps against the depth at rest."""
    cells = title("Convergence with the time step") | notes(
        4,
        "Gray: computed when the workbook was written, and not live: each line is a whole sheet "
        f"with that time step ({cases[0].scheme} scheme). Error: final depth minus depth at rest. "
        "Black: live. Order: how the error falls from line to line, 1 for a scheme of first order.",
        width=125,
    )
    top = 8
    first = top + 3
    last = first + LEVELS - 1
    cells |= _steps(first)
    series, runs = [], {name: "" for name in RUN_INPUTS}
    for columns, case in zip(_COLUMNS, cases, strict=False):
        runs[case.named("R_t")] = ""
        cells |= _levels(case, columns, first)
        size = columns[3]
        series.append(Series((case.name, "I1"), f"B{first}:B{last}", f"{size}{first}:{size}{last}"))
    cells |= _same_inputs(list(runs), last + 2)
    chart = Chart(
        at=f"A{last + len(runs) + 5}",
        title="Error of the final depth against the time step",
        description="Line chart with logarithmic axes: size of the error of the final depth in µm "
        f"against the time step in ns, the first case solid, the second dashed. {written}",
        x_title="Time step [ns]",
        y_title="|final depth - depth at rest| [µm]",
        series=tuple(series),
        logarithmic=True,
    )
    return SheetPlan(
        name="Convergence",
        cells=cells,
        widths=dict.fromkeys("ABCDEFGHIJKL", 12.0),
        rules=(Rule(cells="A3", formula=f'=$A$3="{STALE}"', style="warning"),),
        charts=(chart,),
        print_area=f"A1:L{last + len(runs) + 6 + _CHART_ROWS}",
    )


def _steps(first: int) -> dict[str, Cell]:
    """The time steps of the ladder, and the line with the depth at rest."""
    cells = {}
    for column, unit in (("A", "s"), ("B", "ns")):
        cells[f"{column}{first - 2}"] = Cell(text="Time step", style="head right")
        cells[f"{column}{first - 1}"] = Cell(text=unit, style="unit right")
    for k in range(LEVELS):
        row = first + k
        key, shown = f"convergence.step[{k}]", "0.00E+00"
        cells[f"A{row}"] = Cell(key=key, style="recorded", number_format=shown)
        cells[f"B{row}"] = Cell(
            key=f"convergence.step_ns[{k}]",
            formula=f"=A{row}*1000000000",
            style="number",
            number_format="0.0000",
        )
    cells[f"A{first + LEVELS}"] = Cell(text="At rest, without steps")
    return cells


def _levels(case: CaseSheet, columns: Sequence[str], first: int) -> dict[str, Cell]:
    """The ladder of one case; all but the order was computed when the workbook was written."""
    part = f"convergence.{case.slug}"
    cells = {
        f"{columns[0]}{first - 3}": Cell(text=f"{case.name}, {case.label}", style="block"),
        f"{columns[1]}{first + LEVELS}": Cell(
            key=f"{part}.rest_um", style="recorded", number_format="0.000000"
        ),
    }
    for column, (head, unit, _, _) in zip(columns, _LADDER, strict=True):
        cells[f"{column}{first - 2}"] = Cell(text=head, style="head right")
        cells[f"{column}{first - 1}"] = Cell(text=unit, style="unit right")
    for k in range(LEVELS):
        row = first + k
        for column, (_, _, what, shown) in zip(columns, _LADDER, strict=True):
            formula = ""
            if what == "order":
                if not k:
                    continue
                above, here = f"{columns[2]}{row - 1}", f"{columns[2]}{row}"
                order = f"LN({above}/{here})/LN(A{row - 1}/A{row})"
                formula = f'=IF({above}*{here}>0,{order},"{NO_ORDER}")'
            cells[f"{column}{row}"] = Cell(
                key=f"{part}.{what}[{k}]",
                formula=formula,
                style="number" if formula else "recorded",
                number_format=shown,
                transcendental=what == "order",
            )
    return cells


def _same_inputs(names: Sequence[str], row: int) -> dict[str, Cell]:
    """The inputs of the runs beside those in use, and whether they are the same."""
    heads = ("Input", "Of these runs", "In use", "")
    cells = {
        f"{column}{row}": Cell(text=text, style="head right" if column in "BC" else "head")
        for column, text in zip("ABCD", heads, strict=True)
    }
    for at, name in enumerate(names, start=row + 1):
        cells[f"A{at}"] = Cell(text=name)
        cells[f"B{at}"] = Cell(
            key=f"convergence.run.{name}", style="recorded", number_format="0.0####E+00"
        )
        cells[f"C{at}"] = Cell(
            key=f"convergence.in_use.{name}",
            formula=f"={name}",
            style="number",
            number_format="0.0####E+00",
        )
        cells[f"D{at}"] = Cell(
            key=f"convergence.same.{name}",
            formula=f"=IF(B{at}=C{at},1,0)",
            style="text",
            number_format='"same";;"other"',
        )
    same = f"MIN(D{row + 1}:D{row + len(names)})=1"
    cells["A3"] = Cell(
        key="convergence.message", formula=f'=IF({same},"{CURRENT}","{STALE}")', style="message"
    )
    return cells

"""The sheets `Figure 3`, `Figure 5` and `Convergence`: charts, and the numbers behind them."""

from collections.abc import Sequence

from spreadsheets.plan import Cell, Chart, Rule, Series, SheetPlan
from spreadsheets.sheets.lines import (
    NOT_COMPUTED,
    formula,
    guarded,
    heads,
    notes,
    row_of,
    text,
    title,
)
from spreadsheets.sheets.steps import FIRST_ROW, CaseSheet, rest_depth

_CHART_ROWS = 26
"""Rows that a chart covers, with the default height of 20 pixels, and some room."""


def _heads(row: int, columns: str, words: Sequence[str], units: Sequence[str]) -> dict[str, Cell]:
    """The heads of columns of numbers, and the units under them."""
    under = dict(zip(columns, (text(unit, "unit right") for unit in units), strict=True))
    return heads(row, columns, words, columns) | row_of(row + 1, under)


def figure_3(cases: Sequence[CaseSheet], written: str) -> SheetPlan:
    """Depth against time, one curve for each case; `written` says what it shows as written."""
    first, series = 7, []
    rules: list[Rule] = []
    cells = title("Penetration depth against time (as the report’s Figure 3)")
    said = "After the stop the columns hold the last row, so that each cell has a number to draw."
    cells["P2"] = text(said, "note")
    for at, (columns, case) in enumerate(zip(("PQ", "RS"), cases, strict=False), start=3):
        key = f"figure_3.{case.slug}"
        message = f"='{case.name}'!I1&\": \"&{case.result('message')}"
        cells[f"A{at}"] = formula(f"{key}.message", message, "message")
        rules += case.rules(f"A{at}")
        cells[f"{columns[0]}{first - 3}"] = text(case.name, "block")
        cells |= _heads(first - 2, columns, ("Time", "Depth"), ("ns", "µm"))
        for k in range(case.rows + 1):
            there = f"'{case.name}'!{{}}{FIRST_ROW + k}"
            for column, what, source, shown, like in (
                (columns[0], "time", f"{there.format('B')}*1000000000", "0.00", ""),
                (columns[1], "depth", there.format("G"), "0.0000", f"{case.part}.depth_um"),
            ):
                before = f"{column}{first + k - 1}" if k else "0"
                running = f"=IF(ISNUMBER({there.format('A')}),{source},{before})"
                cells[f"{column}{first + k}"] = formula(
                    f"{key}.{what}[{k}]", running, number_format=shown, column=like
                )
        x, y = (f"{column}{first}:{column}{first + case.rows}" for column in columns)
        series.append(Series((case.name, "I1"), x, y))
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
        print_area=f"A1:N{5 + _CHART_ROWS}",
    )


POINTS = 21
"""Velocities of Figure 5, both ends included."""


def figure_5(case: CaseSheet, written: str) -> SheetPlan:
    """Normalized depth against velocity for one case; the report's is that of beta = 5."""
    first = 7
    last = first + POINTS - 1
    cells = title("Normalized depth against velocity (as the report’s Figure 5)") | notes(
        4,
        "Depth at rest without time steps (Eqs. 12 and 13 integrated), so no warning about the "
        "step concerns it. The ends of the axis stand on the sheet Inputs.",
        width=120,
    )
    cells["P2"] = text("p and c as on the sheets of the cases.", "note")
    missing = f"COUNT(T{first}:T{last})<{POINTS}"
    message = f'=IF({missing},"POINTS ARE MISSING: see the sheet Inputs.","{COMPLETE}")'
    cells["A3"] = formula("figure_5.message", message, "message")
    words, units = ("Point", "Velocity", "p", "c", "X/R", "X"), ("", "m/s", "–", "–", "–", "µm")
    cells |= _heads(first - 2, "PQRSTU", words, units)
    for point, row in enumerate(range(first, last + 1)):
        c, depth = rest_depth(f"R{row}", f"S{row}")
        cells[f"P{row}"] = Cell(number=float(point), style="number")
        for column, what, expression in (
            ("Q", "velocity", f"=V_from+(V_to-V_from)*P{row}/P{last}"),
            ("R", "pressure", f"=rho_t*Q{row}*Q{row}/2/{case.named('R_t')}"),
            ("S", "c", c),
            ("T", "normalized_depth", depth),
            ("U", "depth_um", f"=T{row}*R_p*1000000"),
        ):
            cells[f"{column}{row}"] = formula(
                f"figure_5.{what}[{point}]",
                guarded(expression),
                number_format="General" if column == "Q" else "0.0000",
                transcendental=column in "STU",
            )
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
        rules=(Rule(cells="A3", formula=f"={missing}", style="warning"),),
        charts=(chart,),
        print_area=f"A1:N{6 + _CHART_ROWS}",
    )


COMPLETE = "All points are computed."


LEVELS = 8
"""Steps of the ladder, each half of the one before; the fifth is the step dt_s as written."""

RUN_INPUTS = ("V_impact", "R_p", "rho_p", "rho_t", "dt_s", "v_stop")
"""The inputs, besides the target resistance, that the ladder's runs were made with."""

CURRENT = "The inputs in use are those of these runs."
STALE = "THE INPUTS IN USE ARE NOT THOSE OF THESE RUNS: write the workbook again to renew them."
NO_ORDER = "–"
_LADDER = {
    "steps": "0",
    "depth_um": "0.000000",
    "error": "0.000000",
    "size": "0.0E+00",
    "order": "0.00",
}
"""What stands in the columns of a case, and its number format."""


def convergence(cases: Sequence[CaseSheet], written: str) -> SheetPlan:
    """The final depth at a ladder of time steps against the depth at rest."""
    first = 11
    last = first + LEVELS - 1
    cells = title("Convergence with the time step") | notes(
        4,
        "Gray: computed when the workbook was written, and not live: each line is a whole sheet "
        f"with that time step ({cases[0].scheme} scheme). Error: final depth minus depth at rest. "
        "Black: live. Order: how the error falls from line to line, 1 for a scheme of first order.",
        width=160,
    )
    cells |= _heads(first - 2, "AB", ("Time step", "Time step"), ("s", "ns"))
    for k, row in enumerate(range(first, last + 1)):
        key = f"convergence.step[{k}]"
        cells[f"A{row}"] = _recorded(key, "0.00E+00")
        cells[f"B{row}"] = formula(
            f"convergence.step_ns[{k}]", f"=A{row}*1000000000", number_format="0.0000"
        )
    cells[f"A{last + 1}"] = text("At rest, without steps")
    series, names = [], list(RUN_INPUTS)
    for columns, case in zip(("CDEFG", "HIJKL"), cases, strict=False):
        names.append(case.named("R_t"))
        cells |= _levels(case, columns, first)
        size = columns[3]
        # Called as it was when it was computed: the head of its columns.
        whose = "Convergence", f"{columns[0]}{first - 3}"
        series.append(Series(whose, f"B{first}:B{last}", f"{size}{first}:{size}{last}"))
    cells |= _same_inputs(names, last + 4)
    chart = Chart(
        at=f"A{last + 4}",
        title="Error of the final depth against the time step",
        description="Line chart with logarithmic axes: size of the error of the final depth in µm "
        f"against the time step in ns, the first case solid, the second dashed. {written}",
        x_title="Time step [ns]",
        y_title="|final depth - depth at rest| [µm]",
        series=tuple(series),
        logarithmic=True,
        size=(690, 430),
    )
    return SheetPlan(
        name="Convergence",
        cells=cells,
        widths=dict.fromkeys("ABCDEFGHIJKL", 12.0),
        rules=(Rule(cells="A3", formula=f'=$A$3="{STALE}"', style="warning"),),
        charts=(chart,),
        print_area=f"A1:L{last + 4 + _CHART_ROWS}",
        page_break=last + 2,
    )


def _levels(case: CaseSheet, columns: str, first: int) -> dict[str, Cell]:
    """The ladder of one case; all but the order was computed when the workbook was written.

    The error, too: it is small beside the depths, and a program of long doubles reads those anew.
    """
    part, error = f"convergence.{case.slug}", columns[2]
    words = ("Steps", "Final depth", "Error", "|Error|", "Order")
    cells = _heads(first - 2, columns, words, ("", "µm", "µm", "µm", "–"))
    cells[f"{columns[0]}{first - 3}"] = text(f"{case.name}, {case.label}", "block")
    cells[f"{columns[1]}{first + LEVELS}"] = _recorded(f"{part}.rest_um", "0.000000")
    for k, row in enumerate(range(first, first + LEVELS)):
        for column, (what, shown) in zip(columns, _LADDER.items(), strict=True):
            key = f"{part}.{what}[{k}]"
            if what != "order":
                cells[f"{column}{row}"] = _recorded(key, shown)
            elif k:
                order = f"LN({error}{row - 1}/{error}{row})/LN(A{row - 1}/A{row})"
                order = f'=IFERROR({order},"{NO_ORDER}")'
                cells[f"{column}{row}"] = formula(
                    key, order, number_format=shown, transcendental=True
                )
    return cells


def _recorded(key: str, shown: str) -> Cell:
    """A number that was computed when the workbook was written."""
    return Cell(key=key, style="recorded", number_format=shown)


def _same_inputs(names: Sequence[str], row: int) -> dict[str, Cell]:
    """The inputs of the runs beside those in use, and whether they are the same."""
    words = ("Input", "Of these runs", "In use", "")
    cells, shown = heads(row, "IJKL", words, "JK"), "0.0####E+00"
    for at, name in enumerate(names, start=row + 1):
        # To twelve digits: programs round a conversion of units in their own way.
        same = f"=IF(ABS(J{at}-K{at})*1000000000000<=ABS(J{at}),1,0)"
        same = guarded(same).replace(f'"{NOT_COMPUTED}"', "0")
        cells[f"I{at}"] = text(name, "text")
        cells[f"J{at}"] = _recorded(f"convergence.run.{name}", shown)
        cells[f"K{at}"] = formula(f"convergence.in_use.{name}", f"={name}", number_format=shown)
        cells[f"L{at}"] = formula(
            f"convergence.same.{name}", same, "text", number_format='"same";;"other"'
        )
    message = f'=IF(MIN(L{row + 1}:L{row + len(names)})=1,"{CURRENT}","{STALE}")'
    cells["A3"] = formula("convergence.message", message, "message")
    return cells

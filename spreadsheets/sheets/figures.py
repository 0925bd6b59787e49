"""The sheets `Figure 3`, `Figure 5` and `Convergence`: charts, and the numbers behind them."""

from collections.abc import Sequence

from spreadsheets.plan import (
    NOT_COMPUTED,
    Cell,
    Rule,
    SheetPlan,
    formula,
    guarded,
    recorded,
    text,
)
from spreadsheets.sheets.steps import FIRST_ROW, CaseSheet, rest_depth

_CHART_ROWS = 26
"""Rows that a chart covers, with the default height of 20 pixels, and some room."""


def figure_3(cases: Sequence[CaseSheet]) -> SheetPlan:
    """Depth against time, one curve for each case."""
    first, series = 7, []
    page = SheetPlan(
        name="Figure 3", widths=dict.fromkeys("PQRS", 14.0), print_area=f"A1:N{5 + _CHART_ROWS}"
    )
    page.title("Penetration depth against time (as the report’s Figure 3)")
    said = "After the stop the columns hold the last row, so that each cell has a number to draw."
    page.cells["P2"] = text(said, "note")
    for at, (columns, case) in enumerate(zip(("PQ", "RS"), cases, strict=False), start=3):
        key = f"figure_3.{case.slug}"
        message = f"='{case.name}'!I1&\": \"&{case.result('message')}"
        page.cells[f"A{at}"] = formula(f"{key}.message", message, "message")
        page.rules += case.rules(f"A{at}")
        page.row = first - 3
        page.put(**{columns[0]: text(case.name, "block")})
        page.heads(columns, ("Time", "Depth"), columns, ("ns", "µm"))
        for k in range(case.rows + 1):
            there = f"'{case.name}'!{{}}{FIRST_ROW + k}"
            for column, what, source, shown, like in (
                (columns[0], "time", f"{there.format('B')}*1000000000", "0.00", ""),
                (columns[1], "depth", there.format("G"), "0.0000", f"{case.part}.depth_um"),
            ):
                before = f"{column}{first + k - 1}" if k else "0"
                running = f"=IF(ISNUMBER({there.format('A')}),{source},{before})"
                page.cells[f"{column}{first + k}"] = formula(
                    f"{key}.{what}[{k}]", running, number_format=shown, column=like
                )
        x, y = (f"{column}{first}:{column}{first + case.rows}" for column in columns)
        series.append(((case.name, "I1"), x, y))
    reached = (
        f"{case.label} reaches {{{case.slug}.depth_um:.4g}} µm after "
        f"{{figure_3.{case.slug}.time[{case.rows}]:.3g}} ns"
        for case in cases
    )
    page.draw(series, ", ".join(reached))
    return page


POINTS = 21
"""Velocities of Figure 5, both ends included."""


def figure_5(case: CaseSheet) -> SheetPlan:
    """Normalized depth against velocity for one case; the report's is that of beta = 5."""
    first = 7
    last = first + POINTS - 1
    page = SheetPlan(
        name="Figure 5",
        widths={"P": 8.0} | dict.fromkeys("QRSTU", 12.0),
        print_area=f"A1:N{6 + _CHART_ROWS}",
    )
    page.title("Normalized depth against velocity (as the report’s Figure 5)")
    page.row = 4
    page.say(
        "Depth at rest without time steps (Eqs. 12 and 13 integrated), so no warning about the "
        "step concerns it. The ends of the axis stand on the sheet Inputs.",
        width=120,
    )
    page.cells["P2"] = text("p and c as on the sheets of the cases.", "note")
    missing = f"COUNT(T{first}:T{last})<{POINTS}"
    message = f'=IF({missing},"POINTS ARE MISSING: see the sheet Inputs.","{COMPLETE}")'
    page.cells["A3"] = formula("figure_5.message", message, "message")
    page.rules = [Rule("A3", f"={missing}", "warning")]
    page.row = first - 2
    words, units = ("Point", "Velocity", "p", "c", "X/R", "X"), ("", "m/s", "–", "–", "–", "µm")
    page.heads("PQRSTU", words, "PQRSTU", units)
    for point, row in enumerate(range(first, last + 1)):
        c, depth = rest_depth(f"R{row}", f"S{row}")
        page.cells[f"P{row}"] = Cell(number=float(point), style="number")
        for column, what, expression in (
            ("Q", "velocity", f"=V_from+(V_to-V_from)*P{row}/P{last}"),
            ("R", "pressure", f"=rho_t*Q{row}*Q{row}/2/{case.named('R_t')}"),
            ("S", "c", c),
            ("T", "normalized_depth", depth),
            ("U", "depth_um", f"=T{row}*R_p*1000000"),
        ):
            page.cells[f"{column}{row}"] = formula(
                f"figure_5.{what}[{point}]",
                guarded(expression),
                number_format="General" if column == "Q" else "0.0000",
                transcendental=column in "STU",
            )
    low, high = (
        f"{{figure_5.normalized_depth[{k}]:.3g}} at {{figure_5.velocity[{k}]:.4g}} m/s"
        for k in (0, POINTS - 1)
    )
    name = case.name, "I1"
    series = [(name, f"Q{first}:Q{last}", f"T{first}:T{last}")]
    page.draw(series, f"{case.label}, from {low} to {high}")
    return page


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


def convergence(cases: Sequence[CaseSheet]) -> SheetPlan:
    """The final depth at a ladder of time steps against the depth at rest."""
    first = 11
    last = first + LEVELS - 1
    page = SheetPlan(
        name="Convergence",
        widths=dict.fromkeys("ABCDEFGHIJKL", 12.0),
        rules=[Rule("A3", f'=$A$3="{STALE}"', "warning")],
        print_area=f"A1:L{last + 4 + _CHART_ROWS}",
        page_break=last + 2,
    )
    page.title("Convergence with the time step")
    page.row = 4
    page.say(
        "Gray: computed when the workbook was written, and not live: each line is a whole sheet "
        f"with that time step ({cases[0].scheme} scheme). Error: final depth minus depth at rest. "
        "Black: live. Order: how the error falls from line to line, 1 for a scheme of first order.",
        width=160,
    )
    page.row = first - 2
    page.heads("AB", ("Time step", "Time step"), "AB", ("s", "ns"))
    for k in range(LEVELS):
        ns = f"=A{page.row}*1000000000"
        page.put(
            A=recorded(f"convergence.step[{k}]", number_format="0.00E+00"),
            B=formula(f"convergence.step_ns[{k}]", ns, number_format="0.0000"),
        )
    page.put(A=text("At rest, without steps"))
    series, names, written = [], list(RUN_INPUTS), []
    for columns, case in zip(("CDEFG", "HIJKL"), cases, strict=False):
        names.append(case.named("R_t"))
        _levels(page, case, columns, first)
        ends = (
            f"{{convergence.{case.slug}.size[{k}]:.2g}} µm at {{convergence.step_ns[{k}]:.3g}} ns"
            for k in (0, LEVELS - 1)
        )
        written.append(f"{case.label} from {' to '.join(ends)}")
        size = columns[3]
        # Called as it was when it was computed: the head of its columns.
        whose = "Convergence", f"{columns[0]}{first - 3}"
        series.append((whose, f"B{first}:B{last}", f"{size}{first}:{size}{last}"))
    page.row = last + 4
    _same_inputs(page, names)
    page.draw(series, ", ".join(written))
    return page


def _levels(page: SheetPlan, case: CaseSheet, columns: str, first: int) -> None:
    """The ladder of one case; all but the order was computed when the workbook was written.

    The error, too: it is small beside the depths, and a program of long doubles reads those anew.
    """
    part, error = f"convergence.{case.slug}", columns[2]
    words = ("Steps", "Final depth", "Error", "|Error|", "Order")
    page.row = first - 2
    page.heads(columns, words, columns, ("", "µm", "µm", "µm", "–"))
    page.cells[f"{columns[0]}{first - 3}"] = text(f"{case.name}, {case.label}", "block")
    page.cells[f"{columns[1]}{first + LEVELS}"] = recorded(
        f"{part}.rest_um", number_format="0.000000"
    )
    for k, row in enumerate(range(first, first + LEVELS)):
        for column, (what, shown) in zip(columns, _LADDER.items(), strict=True):
            key = f"{part}.{what}[{k}]"
            if what != "order":
                page.cells[f"{column}{row}"] = recorded(key, number_format=shown)
            elif k:
                order = f"LN({error}{row - 1}/{error}{row})/LN(A{row - 1}/A{row})"
                order = f'=IFERROR({order},"{NO_ORDER}")'
                page.cells[f"{column}{row}"] = formula(
                    key, order, number_format=shown, transcendental=True
                )


def _same_inputs(page: SheetPlan, names: Sequence[str]) -> None:
    """The inputs of the runs beside those in use, and whether they are the same."""
    page.heads("IJKL", ("Input", "Of these runs", "In use", ""), "JK")
    first, shown = page.row, "0.0####E+00"
    for name in names:
        # To twelve digits: programs round a conversion of units in their own way.
        same = f"=IF(ABS(J{page.row}-K{page.row})*1000000000000<=ABS(J{page.row}),1,0)"
        same = guarded(same).replace(f'"{NOT_COMPUTED}"', "0")
        page.put(
            I=text(name, "text"),
            J=recorded(f"convergence.run.{name}", number_format=shown),
            K=formula(f"convergence.in_use.{name}", f"={name}", number_format=shown),
            L=formula(f"convergence.same.{name}", same, "text", number_format='"same";;"other"'),
        )
    message = f'=IF(MIN(L{first}:L{page.row - 1})=1,"{CURRENT}","{STALE}")'
    page.cells["A3"] = formula("convergence.message", message, "message")

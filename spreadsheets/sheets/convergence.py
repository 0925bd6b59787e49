"""The sheet `Convergence`: errors of the final depth at eight time steps, computed when written."""

from collections.abc import Mapping, Sequence

from reference.ledger import Ledger
from spreadsheets.plan import (
    YES_OR_NO,
    Cell,
    Chart,
    ChartCurve,
    Rule,
    SheetPlan,
    ShownValue,
    formula,
    recorded,
)
from spreadsheets.sheets import messages
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.inputs import input_lines

LEVELS = 8
"""Number of time steps, each half of the one before; the fifth is dt_s as written."""

NO_ORDER = "–"
"""Stands for an order that is undefined."""


SMALL = {"R_p": (10**6, "um"), "dt_s": (10**9, "ns"), "D_p": (10**6, "um"), "M_p": (10**15, "pg")}
"""How many of which unit the SI unit of a number has that is small in SI units.

An .ods file keeps only 20 decimals of a number: of a mass of 5e-11 kg ten digits. The comparison
with the inputs of these runs must hold when the workbook was saved as one and opened again.
"""


def run_inputs(cases: Sequence[CaseSheet]) -> list[str]:
    """Return the names of all numbers on which the runs depend: inputs, derived numbers and π."""
    blocks = input_lines(cases, report=False).values()
    typed = [line.name for block in blocks for line in block if line.attribute]
    return list(dict.fromkeys([*typed, "D_p", "M_p", "pi_", *(case.resistance for case in cases)]))


def convergence(ledger: Ledger, cases: Sequence[CaseSheet]) -> SheetPlan:
    """Plan the errors of the final depth at eight time steps, and the inputs of these runs."""
    about = "Final depth at eight time steps against the depth at rest, with its chart"
    sheet = SheetPlan(ledger=ledger, name="Convergence", about=about)
    sheet.portrait, sheet.most_pages = True, 1
    sheet.begin("Convergence with the time step")
    sheet.wide("ABCDEFGK", 10)
    sheet.wide("IJ", 12)
    sheet.wide("H", 40)
    sheet.row = 4
    sheet.say(
        "Gray: computed when the workbook was written, and not live: each line is a whole sheet"
        f" with that time step ({cases[0].scheme} scheme), whose state is shown as on the sheet of"
        " the case. Error: final depth minus depth at rest. Black: live. Order: how the error falls"
        " from line to line, 1 for a scheme of first order; after a run of fewer than two steps"
        " there is none. coldspray converge shows more of each run.",
        width=160,
    )
    sheet.row = 8
    said = _inputs_of_runs(sheet, cases)
    message = f'=IFERROR({said},"{messages.STALE}")'
    sheet.cells["A3"] = formula("convergence.message", message, "message")
    sheet.rules = [Rule("A3", f'=$A$3="{messages.STALE}"', "warning")]
    sheet.row, curves = 34, []
    for case in cases:
        # The label is a text, not a formula: it names the case as it was when the runs were made.
        label = f"A{sheet.row}"
        sheet.put(A=Cell(f"{case.name}, {case.label}", "block"))
        first = sheet.row + 2
        _levels(sheet, case, first)
        last = first + LEVELS - 1
        x, y = f"B{first}:B{last}", f"F{first}:F{last}"
        curves.append(ChartCurve((sheet.name, label), x, y, case.beta))
        sheet.row = last + 1
        at_rest = recorded(f"convergence.{case.slug}.rest_um", shown="0.000000")
        sheet.put(A=Cell("At rest, without steps"), D=at_rest)
        sheet.row += 1
    sheet.print_area = f"A1:K{sheet.row - 2}"
    sheet.charts = [_chart(cases, curves)]
    return sheet


def _inputs_of_runs(sheet: SheetPlan, cases: Sequence[CaseSheet]) -> str:
    """Add the inputs of the runs beside those in use, and return the cell that compares all."""
    sheet.heads("HIJK", ("Input", "Of these runs", "In use", "Same?"), "IJ")
    first, shown = sheet.row, "0.0####E+00"
    for name in run_inputs(cases):
        row = sheet.row
        scale, unit = SMALL.get(name, (1, ""))
        # Not to the last digit, since programs differ in how they round a conversion of units.
        same = f"=IF(ABS(J{row}-I{row})<=same_within*ABS(I{row}),1,0)"
        sheet.put(
            H=Cell(f"{name} [{unit}]" if unit else name, "text"),
            I=recorded(f"convergence.run.{name}", shown=shown),
            J=formula(
                f"convergence.in_use.{name}",
                f"={name}*{scale}" if unit else f"={name}",
                shown=shown,
            ),
            K=formula(f"convergence.same.{name}", same, "text", shown=YES_OR_NO),
        )
    all_same = f"=MIN(K{first}:K{sheet.row - 1})"
    says = f'=IF(K{sheet.row}=1,"{messages.CURRENT}","{messages.STALE}")'
    sheet.put(
        H=Cell("all of them", "text"),
        K=formula("convergence.all_same", all_same, "text", shown=YES_OR_NO),
        L=formula("convergence.says", says, "text"),
    )
    return f"L{sheet.row - 1}"


def _levels(sheet: SheetPlan, case: CaseSheet, first: int) -> None:
    """Add the runs of a case from the row `first` on, one in each line.

    Everything but the order and the step in ns was computed when the workbook was written. That
    includes the error, which is small compared with the depths: a program that computes in long
    doubles would round their difference in another way.
    """
    part, rows = f"convergence.{case.slug}", range(first, first + LEVELS)

    def column(letter: str, head: str, unit: str, key: str, shown: str = "General") -> None:
        cells = [recorded(f"{part}.{key}[{k}]", shown=shown) for k in range(LEVELS)]
        sheet.column(letter, head, unit, cells)

    column("A", "Time step", "s", "step", "0.00E+00")
    in_ns = [
        formula(f"{part}.step_ns[{k}]", f"=A{row}*1000000000", shown="0.0000")
        for k, row in enumerate(rows)
    ]
    sheet.column("B", "Time step", "ns", in_ns)
    column("C", "Steps", "", "steps", "0")
    column("D", "Final depth", "um", "depth_um", "0.000000")
    column("E", "Error", "um", "error", "0.000000")
    column("F", "|Error|", "um", "size", "0.0E+00")
    orders: list[Cell | None] = [None]
    for k, row in enumerate(rows[1:], start=1):
        order = f"LN(E{row - 1}/E{row})/LN(A{row - 1}/A{row})"
        live = f'=IFERROR(IF(C{row - 1}>1,{order},"{NO_ORDER}"),"{NO_ORDER}")'
        orders.append(formula(f"{part}.order[{k}]", live, shown="0.00"))
    sheet.column("G", "Order", "–", orders)
    column("H", "State of the run", "", "state")


def _chart(cases: Sequence[CaseSheet], curves: Sequence[ChartCurve]) -> Chart:
    def describe(values: Mapping[str, ShownValue]) -> str:
        ends = []
        for case in cases:
            part = f"convergence.{case.slug}"
            first, last = (
                f"{values[f'{part}.size[{k}]']:.2g} µm at {values[f'{part}.step_ns[{k}]']:.3g} ns"
                for k in (0, LEVELS - 1)
            )
            ends.append(f"{case.label} from {first} to {last}")
        return (
            "Line chart with logarithmic axes: size of the error of the final depth in µm against"
            " the time step in ns, the first case solid, the second dashed."
            f" For {', '.join(ends)}."
        )

    return Chart(
        at="A8",
        title="Error of the final depth against the time step",
        x_title="Time step [ns]",
        y_title="|final depth - depth at rest| [µm]",
        size=(515, 430),
        curves=curves,
        describe=describe,
        logarithmic=True,
    )

"""The sheet `Figure 5`: normalized depth at rest against impact velocity."""

from collections.abc import Mapping

from reference.ledger import Ledger
from spreadsheets.plan import Cell, Chart, ChartCurve, Rule, SheetPlan, ShownValue, formula
from spreadsheets.sheets import messages
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.formulas import cap_angle, depth, log1p

FIGURE_5_POINTS = 21
"""Number of velocities, including both ends."""

_FIRST = 7
_LAST = _FIRST + FIGURE_5_POINTS - 1


def figure_5(ledger: Ledger, case: CaseSheet) -> SheetPlan:
    """Plan the chart of normalized depth against velocity; the report's own is for beta = 5."""
    about = "Normalized depth against velocity, with its chart (section 4)"
    sheet = SheetPlan(ledger=ledger, name="Figure 5", about=about)
    sheet.begin("Normalized depth against velocity (compare the report’s Figure 5)")
    sheet.wide("P", 8)
    sheet.wide("QRSTUVW", 12)
    points = f"COUNT(V{_FIRST}:V{_LAST})"
    message = f'=IF({points}<{FIGURE_5_POINTS},"{messages.POINTS_MISSING}","{messages.ALL_POINTS}")'
    sheet.cells["A3"] = formula("figure_5.message", message, "message")
    sheet.rules = [Rule("A3", f"={points}<{FIGURE_5_POINTS}", "warning")]
    sheet.cells["P2"] = Cell("p, c and h as on the sheets of the cases.", "note")
    sheet.row = 4
    sheet.say(
        "Depth at rest without time steps (Eqs. 12 and 13 integrated), so no warning about the step"
        " concerns it. The ends of the axis stand on the sheet Inputs.",
        width=120,
    )
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

    x, y = f"Q{_FIRST}:Q{_LAST}", f"V{_FIRST}:V{_LAST}"
    curve = ChartCurve((case.name, "I1"), x, y, case.beta)
    sheet.chart = Chart(
        at="A7",
        title="Normalized penetration depth against impact velocity",
        x_title="Impact velocity [m/s]",
        y_title="Normalized depth X/R [–]",
        size=(820, 470),
        curves=[curve],
        describe=describe,
    )
    sheet.print_area = "A1:N36"
    return sheet


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
        "P", "Point", "", [Cell(number=float(k), style="number") for k in range(FIGURE_5_POINTS)]
    )
    velocities = [f"=V_from+(V_to-V_from)*P{row}/P{_LAST}" for row in rows]
    column("Q", "Velocity", "m/s", "velocity", velocities, shown="General")
    pressures = [f"=rho_t*Q{row}*Q{row}/2/{case.resistance}" for row in rows]
    column("R", "p", "–", "pressure", pressures)
    column("S", "ln(1 + p)", "–", "ln", [log1p(f"R{row}") for row in rows])
    column("T", "c", "–", "c", [f"=4*rho_p/(3*rho_t)*S{row}" for row in rows])
    column("U", "h", "–", "h", [cap_angle(f"T{row}") for row in rows])
    depths = [depth(f"T{row}", f"U{row}") for row in rows]
    column("V", "X/R", "–", "normalized_depth", depths)
    column("W", "X", "um", "depth_um", [f"=V{row}*R_p*1000000" for row in rows])

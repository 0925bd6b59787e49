"""The sheet `Solve`: which resistance, velocity, radius or density gives a measured depth."""

from collections.abc import Sequence

from reference.ledger import Ledger
from spreadsheets.plan import (
    LINE_HEADS,
    YES_OR_NO,
    Cell,
    Rule,
    SheetPlan,
    formula,
    printed,
    recorded,
    unit_text,
)
from spreadsheets.sheets import messages
from spreadsheets.sheets.case import CaseSheet, lines_of_depth
from spreadsheets.sheets.formulas import expm1
from spreadsheets.sheets.inputs import within_limits

MEASURED = "observed-depth"
"""The claim whose depth is typed when the workbook is written."""

DEPTH_LIMITS, RATIO_LIMITS = (1e-4, 1e6), (1e-4, 1e4)
"""Least and greatest depth [um] and X/R [1] that may be typed, as on the sheet Inputs."""

_EXTRA_HEADS = (
    ("Least", 8), ("Greatest", 10), ("Number typed", 14), ("Below least?", 14), ("Above most?", 14),
    ("Fault", 14), ("Accepted", 14),
)  # fmt: skip
"""As on the sheet Inputs."""


def solve(ledger: Ledger, cases: Sequence[CaseSheet]) -> SheetPlan:
    """Plan the sheet of the inverse question: each input that gives a depth, all else as in use.

    By Eqs. 12 and 13 the final depth satisfies ln(1 + p) = (rho_t/rho_p) CV/PV, where
    p = rho_t V^2/2R_t and CV/PV is the crater's volume over the particle's.
    """
    about = "Which resistance, velocity, radius or density gives a measured depth"
    sheet = SheetPlan(ledger=ledger, name="Solve", about=about, portrait=True, most_pages=1)
    sheet.widths = dict(zip(sheet.columns, (width for _, width in LINE_HEADS), strict=True))
    sheet.widths |= dict(zip("GHIJKLM", (width for _, width in _EXTRA_HEADS), strict=True))
    sheet.begin("Which input gives a measured depth?")
    sheet.say(
        "Type a measured depth, or X/R, which then takes its place. Each answer is the value of one"
        " input that gives this depth at rest (Eqs. 12 and 13 integrated), all other inputs as in"
        " use.",
        width=150,
    )
    sheet.row += 1
    _measured(sheet)
    _pressure(sheet)
    _resistance(sheet, cases)
    for case in cases:
        _other_inputs(sheet, case)
    _back_again(sheet)
    _said(sheet)
    sheet.print_area = f"A1:F{sheet.row - 1}"
    return sheet


def _measured(sheet: SheetPlan) -> None:
    """Add the cells to type into, with their limits, and which of them is taken."""
    heads = [head for head, _ in (*LINE_HEADS, *_EXTRA_HEADS)]
    heads[4] = "To compare"
    sheet.headed = "A", sheet.row, sheet.row
    sheet.heads("ABCDEFGHIJKLM", heads, right="CEGHIM")
    depth_row, ratio_row = sheet.row, sheet.row + 1
    _typed(sheet, "depth", "X", "measured depth", "um", DEPTH_LIMITS)
    _typed(sheet, "ratio", "X/R", "or measured depth over radius; may be blank", "1", RATIO_LIMITS)
    says = "says_for_depth&says_for_ratio&says_too_deep"
    message = f'=IFERROR({says},"{messages.NOT_SOLVED}")'
    sheet.rules = [Rule(f"A{sheet.row}", "=ISERROR(p_meas)", "warning")]
    sheet.put(A=formula("solve.message", message, "message"))
    sheet.row += 1
    sheet.block("The crater of this depth")
    sheet.line("by_ratio", "", "X/R is typed", f"=IF(ISNUMBER(C{ratio_row}),1,0)", shown=YES_OR_NO)
    sheet.line(
        "y_meas", "y", "normalized depth X/R",
        f"=IF(by_ratio=1,M{ratio_row},M{depth_row}/1000000/R_p)",
    )  # fmt: skip
    sheet.line("X_meas", "X", "depth", "=y_meas*R_p", "m", source="y R", shown="0.0000E+00")
    sheet.line(
        "CV_PV_meas", "CV/PV", "crater’s volume over the particle’s",
        "=IF(y_meas<=1,y_meas*y_meas*(3-y_meas)/4,(3*y_meas-1)/4)",
        source="Eqs. 2 and 3; beyond R a cylinder", shown="0.0000E+00",
    )  # fmt: skip


def _typed(
    sheet: SheetPlan, name: str, symbol: str, meaning: str, unit: str, limits: tuple[float, float]
) -> None:
    """Add the line of a number to be typed; column M has it if it can be used.

    It is #N/A for a blank X/R, for which the depth is taken.
    """
    row, key = sheet.row, f"solve.{name}"
    claim = MEASURED if name == "depth" else "discussion-observed"
    sheet.put(
        A=Cell(symbol, "text"),
        B=Cell(meaning, "text"),
        C=Cell(key=key, style="input", unit=unit, limits=limits),
        D=unit_text(unit),
        E=printed(sheet.ledger, claim, unit),
        F=Cell(str(sheet.ledger.claims[claim].place), "unit"),
        G=recorded(limits[0]),
        H=recorded(limits[1]),
        I=formula(f"{key}.number", f"=IF(ISNUMBER(C{row}),C{row},NA())"),
        **within_limits(key, row, number="I", limits="GH", columns="JKLM"),
    )


def _pressure(sheet: SheetPlan) -> None:
    """Add p = e^L - 1, which all answers for the target resistance and velocity have in common."""
    sheet.row += 1
    sheet.block("The dynamic pressure over R_t that makes it")
    sheet.line(
        "L_meas", "L", "ln(1 + p)", "=CV_PV_meas*(rho_t/rho_p)", source="(ρ_t/ρ_p) CV/PV",
        shown="0.0000E+00",
    )  # fmt: skip
    sheet.line(
        "exp_L", "1 + p", "pressure over R_t, plus 1", "=IF(L_meas<L_most,EXP(L_meas),NA())",
        source="e^L", shown="0.0000E+00",
    )  # fmt: skip
    sheet.line(
        "p_meas", "p", "right for slow impacts, too", expm1("L_meas", "exp_L"), source="e^L - 1",
        shown="0.0000E+00",
    )  # fmt: skip


def _resistance(sheet: SheetPlan, cases: Sequence[CaseSheet]) -> None:
    """Add the target resistance, and β for the flow stress in use."""
    sheet.row += 1
    sheet.block("The target resistance that gives it")
    sheet.line(
        "R_t_meas", "R_t", "target resistance", "=rho_t*V_impact*V_impact/(2*p_meas)", "Pa",
        source="ρ_t V²/2p", shown="0.0000E+00",
    )  # fmt: skip
    sheet.line("R_t_meas_GPa", "R_t", "the same", "=R_t_meas/1000000000", "GPa", shown="0.000")
    if not cases[0].resistance_given:
        sheet.line(
            "beta_meas", "β", "β for the flow stress in use", "=R_t_meas/Y_t", source="Eq. 7"
        )


def _other_inputs(sheet: SheetPlan, case: CaseSheet) -> None:
    """Add the inputs that depend on the target resistance of a case, or on its β."""
    s = case.input_suffix
    sheet.row += 1
    sheet.block(f"All else as in {case.name}; to compare: in use")

    def answer(
        name: str, symbol: str, meaning: str, expression: str, unit: str, source: str, shown: str
    ) -> None:
        """Add the value of an input that gives the depth; beside it the one in use."""
        in_use = formula(f"solve.{name}{s}", f"={name}", unit=unit, shown=shown)
        sheet.cells[f"E{sheet.row}"] = in_use
        sheet.line(f"{name}_meas{s}", symbol, meaning, expression, unit, source=source, shown=shown)

    if not case.resistance_given:
        flow_stress = f"=R_t_meas/beta{s}"
        answer(
            "Y_t", "Y_t", "target flow stress", flow_stress, "Pa", "R_t above, Eq. 7", "0.0000E+00"
        )
    velocity = f"=SQRT(2*{case.resistance}/rho_t)*SQRT(p_meas)"
    answer("V_impact", "V", "impact velocity", velocity, "m/s", "V² = 2R_t p/ρ_t", "0.00")
    radius = f"=X_meas/X_R_rest{s}"
    answer("R_p", "R", "particle radius", radius, "m", "X over X/R at rest in use", "0.0000E+00")
    density = f"=CV_PV_meas/ln_rest{s}*rho_t"
    in_use = "ρ_t (CV/PV)/ln(1 + p), p in use"
    answer("rho_p", "ρ_p", "particle density", density, "kg/m^3", in_use, "0.0")


def _back_again(sheet: SheetPlan) -> None:
    """Add the depth that the target resistance gives."""
    sheet.row += 1
    sheet.block("Back again: the depth that this target resistance gives")
    sheet.line(
        "p_back", "p", "dynamic pressure over it", "=rho_t*V_impact*V_impact/2/R_t_meas",
        source="ρ_t V²/2R_t", shown="0.0000E+00",
    )  # fmt: skip
    lines_of_depth(sheet, "back")
    sheet.line(
        "X_back_um", "X", "penetration depth", "=X_R_back*R_p*1000000", "um",
        source="R times the line above",
    )  # fmt: skip


def _said(sheet: SheetPlan) -> None:
    """Add the states of which one holds, each with what the message of the sheet says of it."""
    sheet.row += 1
    sheet.block("Which one of these does the message above say?")
    sheet.line(
        "solved", "", "a resistance gives this depth", "=IF(L_meas<L_most,1,0)", shown=YES_OR_NO,
        source="L below L_most",
    )  # fmt: skip
    # Only `solved` may be #N/A, so it is the first condition; see `case.py`.
    for_ratio = "=IF(AND(solved=1,by_ratio=1),1,0)"
    for_depth = "=IF(AND(solved=1,by_ratio=0),1,0)"
    too_deep = "=IF(solved=0,1,0)"
    sheet.state("for_ratio", "solved for X/R", for_ratio, messages.BY_RATIO)
    sheet.state("for_depth", "solved for the depth", for_depth, messages.BY_DEPTH)
    sheet.state("too_deep", "too deep for any resistance", too_deep, messages.TOO_DEEP)

"""The sheet `Frank-Zook`: Eq. 16 as it is printed, and as it follows from Eqs. 14 and 15."""

from reference.ledger import Ledger
from spreadsheets.plan import SheetPlan
from spreadsheets.sheets.formulas import log1p
from spreadsheets.sheets.table import table_of_lines


def frank_zook(ledger: Ledger) -> SheetPlan:
    """Plan the sheet: Eq. 16 for both resistances of section 3, in both readings."""
    sheet = table_of_lines(
        ledger,
        name="Frank-Zook",
        about="Eq. 16 as printed and as derived (Eqs. 14 to 17)",
        title="Frank-Zook depth of a noneroding penetrator",
        note="Eqs. 14 and 15, integrated from V to rest, give the right side of Eq. 16 for the"
        " depth in diameters, X/D. Eq. 16 prints X/R in front of it. Both readings stand here: the"
        " derived one is twice the printed one.",
    )
    sheet.block("The cylinder of the sphere’s mass and diameter")
    # It depends on no input: (pi/6) D^3 = (pi/4) D^2 L.
    sheet.line(
        "L_D", "L/D", "length over diameter of the cylinder", "=(1/6)/(1/4)",
        claim="sphere-length-ratio",
    )  # fmt: skip
    sheet.row += 1
    sheet.block("Rolled homogeneous armor (Eq. 17)")
    sheet.repeat(
        "frank_zook.R_t_RHA", "R_t", "target resistance", "R_t_RHA", "Pa",
        beside="fz-resistance-rha", shown="0.00E+00",
    )  # fmt: skip
    sheet.line(
        "z_RHA", "z", "drag over resistance", "=k_t*rho_t*V_impact*V_impact/R_t_RHA",
        source="in Eq. 16", shown="0.0000E+00",
    )  # fmt: skip
    sheet.line(
        "ln_RHA", "ln(1 + z)", "right for slow impacts, too", log1p("z_RHA"),
        source="in Eq. 16", shown="0.0000E+00",
    )  # fmt: skip
    sheet.line(
        "X_R_RHA", "X/R", "normalized depth, equation as printed",
        "=(L_D*rho_p/rho_t+k_1)/(2*k_t)*ln_RHA",
        claim="frank-zook-rha", source="Eq. 16 as printed",
    )  # fmt: skip
    sheet.line(
        "X_R_RHA_derived", "X/R", "normalized depth, as derived", "=2*X_R_RHA",
        beside="frank-zook-rha", source="Eqs. 14 and 15, with R = D/2",
    )  # fmt: skip
    sheet.row += 1
    sheet.block("Stainless steel")
    sheet.repeat(
        "frank_zook.R_t_lower", "R_t", "target resistance", "R_t_lower", "Pa",
        beside="fz-resistance-stainless", shown="0.00E+00",
    )  # fmt: skip
    sheet.line(
        "z_lower", "z", "drag over resistance", "=k_t*rho_t*V_impact*V_impact/R_t_lower",
        source="in Eq. 16", shown="0.0000E+00",
    )  # fmt: skip
    sheet.line(
        "ln_lower", "ln(1 + z)", "right for slow impacts, too", log1p("z_lower"),
        source="in Eq. 16", shown="0.0000E+00",
    )  # fmt: skip
    sheet.line(
        "X_R_lower", "X/R", "normalized depth, equation as printed",
        "=(L_D*rho_p/rho_t+k_1)/(2*k_t)*ln_lower",
        claim="frank-zook-stainless", source="Eq. 16 as printed",
    )  # fmt: skip
    sheet.line(
        "X_R_lower_derived", "X/R", "normalized depth, as derived", "=2*X_R_lower",
        beside="frank-zook-stainless", source="Eqs. 14 and 15, with R = D/2",
    )  # fmt: skip
    return sheet

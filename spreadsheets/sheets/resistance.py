"""The sheet of section 3: β by three routes, strengths, stress, and the Frank-Zook depths.

Eq. 16 stands there as it is printed, and as it follows from Eqs. 14 and 15.
"""

from collections.abc import Sequence

from reference.ledger import Ledger
from spreadsheets.plan import SheetPlan
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.formulas import log1p
from spreadsheets.sheets.table import table_of_lines


def resistance(ledger: Ledger, cases: Sequence[CaseSheet]) -> SheetPlan:
    """Plan the sheet of the target's resistance, and of the depths by Frank and Zook with theirs.

    Eq. 16 is taken for both target resistances of section 3, in both readings.
    """
    sheet = table_of_lines(
        ledger,
        name="Resistance and Frank-Zook",
        about="β by three routes, strengths, stress; Eq. 16 as printed and as derived (section 3)",
        title="Target resistance, and the depth by Frank and Zook",
    )
    _beta(sheet)
    _strength(sheet)
    _stress(sheet, cases)
    sheet.row += 1
    sheet.block("Strain rate")
    sheet.line(
        "strain_rate", "V/L", "impact velocity over a typical dimension", "=V_impact/L_typ", "1/s",
        claim="strain-rate", shown="0.0E+00",
    )  # fmt: skip
    _frank_zook(sheet)
    return sheet


def _beta(sheet: SheetPlan) -> None:
    sheet.block("Target resistance over flow stress, β")
    sheet.line(
        "beta_G", "β", "Goodier", "=4*q_Y/pi_", claim="goodier-beta",
        source="Eqs. 8 and 9 with n = 2",
    )  # fmt: skip
    sheet.line(
        "alpha", "α", "extent of the plastic zone, Walker and Anderson",
        "=(2*E_t/(3*Y_steel))^(1/3)", claim="walker-anderson-alpha", source="Eq. 11",
    )  # fmt: skip
    sheet.line(
        "beta_WA", "β", "Walker and Anderson", "=7/3*LN(alpha)", claim="walker-anderson-beta",
        source="Eq. 10",
    )  # fmt: skip
    sheet.line(
        "beta_B", "β", "Brinell hardness as target resistance", "=HB_ratio", claim="brinell-beta"
    )
    sheet.line(
        "beta_least", "β", "least of the three", "=MIN(beta_G,beta_WA,beta_B)",
        claim="beta-range-least",
    )  # fmt: skip
    sheet.line(
        "beta_greatest", "β", "greatest of the three", "=MAX(beta_G,beta_WA,beta_B)",
        claim="beta-range-greatest",
    )  # fmt: skip


def _strength(sheet: SheetPlan) -> None:
    sheet.row += 1
    sheet.block("Strength of the target’s grains")
    for grains, meaning in (
        ("feathery", "strength, feathery grains"),
        ("clear", "strength, clear grains"),
        ("bulk", "strength, bulk material"),
    ):
        sheet.line(
            f"S_{grains}_MPa", "S", meaning, f"=S_{grains}/1000000", "MPa",
            beside=f"strength-{grains}", shown="0.0",
        )  # fmt: skip
    sheet.line(
        "S_mean", "S", "mean of the two kinds of grain", "=(S_feathery_MPa+S_clear_MPa)/2", "MPa",
        shown="0.0",
    )  # fmt: skip
    sheet.line(
        "clear_over_bulk", "", "clear grains over bulk", "=S_clear_MPa/S_bulk_MPa",
        claim="strength-multiple", shown="0.00",
    )  # fmt: skip
    sheet.line("mean_over_bulk", "", "mean over bulk", "=S_mean/S_bulk_MPa", shown="0.00")


def _stress(sheet: SheetPlan, cases: Sequence[CaseSheet]) -> None:
    sheet.row += 1
    sheet.block("Target resistance and centerline stress at impact")
    for case in cases:
        s = case.input_suffix
        sheet.repeat(
            f"resistance.R_t{s}", "R_t", f"target resistance, {case.name}", f"R_t{s}", "Pa",
            source="Eq. 7; Inputs", shown="0.000E+00",
        )  # fmt: skip
        sheet.line(
            f"stress{s}", "Σ", f"centerline stress, {case.name}",
            f"=rho_t*V_impact*V_impact/2+R_t{s}", "Pa",
            source="Eq. 6; by Eq. 5 the least strength of a rigid particle", shown="0.000E+00",
        )  # fmt: skip
        sheet.line(
            f"stress_over_copper{s}", "Σ/Y_p", "over the yield strength of annealed copper",
            f"=stress{s}/Y_copper",
            source="a rigid particle is at least this many times as strong", shown="0.0",
        )  # fmt: skip


def _frank_zook(sheet: SheetPlan) -> None:
    sheet.row += 1
    sheet.block("Depth of a noneroding penetrator by Frank and Zook")
    sheet.say(
        "Eqs. 14 and 15, integrated from V to rest, give the right side of Eq. 16 for the depth in"
        " diameters, X/D. Eq. 16 prints X/R in front of it. Both readings stand here: the derived"
        " one is twice the printed one."
    )
    sheet.row += 1
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

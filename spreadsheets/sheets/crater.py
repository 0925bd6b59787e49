"""The sheet `Crater`: section 2's geometry of a sphere pressed into a flat surface, and Eq. 1."""

from reference.ledger import Ledger
from spreadsheets.plan import SheetPlan
from spreadsheets.sheets.table import table_of_lines


def crater(ledger: Ledger) -> SheetPlan:
    """Plan the sheet: craters of two volume ratios, the contact circle, and particle velocities."""
    sheet = table_of_lines(
        ledger,
        name="Crater",
        about="Section 2: crater volume, depth and contact diameter; particle velocities",
        title="Crater and particle",
        note="A crater of depth X ≤ R is a cap of the sphere: CV/PV = y² (3 - y)/4 with y = X/R."
        " Its root is y = 4 sin(h) sin(h + π/3) with h = asin(√(CV/PV))/3.",
    )
    sheet.block("Particle")
    sheet.line(
        "PV_m3", "PV", "volume of the mean particle", "=4/3*pi_*(D_mean/2)*(D_mean/2)*(D_mean/2)",
        "m^3", source="Eq. 3", shown="0.000E+00",
    )  # fmt: skip
    sheet.line(
        "PV_um3", "PV", "the same", "=PV_m3*um3_per_m3", "um^3",
        claim="particle-volume", shown="0.00",
    )  # fmt: skip
    _observed(sheet)
    _line_of_figure_1(sheet)
    _contact(sheet)
    _velocities(sheet)
    return sheet


def _observed(sheet: SheetPlan) -> None:
    sheet.row += 1
    sheet.block("Crater of the observed CV/PV")
    sheet.line(
        "h_crater", "h", "angle of the depth", "=ASIN(SQRT(CV_PV))/3", source="asin(√(CV/PV))/3"
    )
    sheet.line(
        "X_R_crater", "X/R", "normalized depth", "=4*SIN(h_crater)*SIN(h_crater+pi_/3)",
        claim="observed-depth-ratio", source="Eqs. 2 and 3 solved",
        also=[
            "observed-third", "observed-ratio", "discussion-observed", "general-ratio",
            "general-third", "summary-ratio",
        ],
    )  # fmt: skip
    sheet.line(
        "X_D_crater", "X/D", "depth over the diameter", "=X_R_crater/2",
        claim="general-sixth", source="D = 2R",
    )  # fmt: skip
    sheet.line(
        "X_crater", "X", "penetration depth", "=X_R_crater*(D_mean/2)", "m",
        source="Section 2, below Eq. 4", shown="0.000E+00",
    )  # fmt: skip
    sheet.line(
        "X_crater_um", "X", "the same", "=X_crater*1000000", "um",
        claim="observed-depth", source="Section 2, below Eq. 4", shown="0.000",
    )  # fmt: skip
    sheet.line(
        "CV_crater", "CV", "crater volume", "=1/3*pi_*X_crater*X_crater*(3*(D_mean/2)-X_crater)",
        "m^3", source="Eq. 2", shown="0.000E+00",
    )  # fmt: skip
    sheet.line(
        "CV_crater_um3", "CV", "the same", "=CV_crater*um3_per_m3", "um^3",
        shown="0.00",
    )  # fmt: skip
    sheet.line(
        "CV_PV_again", "CV/PV", "back again through Eq. 2", "=CV_crater/PV_m3",
        beside="volume-ratio", source="Eqs. 2 and 3",
    )  # fmt: skip


def _line_of_figure_1(sheet: SheetPlan) -> None:
    sheet.row += 1
    sheet.block("Line of Figure 1: CV in proportion to PV")
    sheet.line(
        "CV_line_um3", "CV", "crater volume on the line, at this PV", "=CV_PV_line*PV_um3", "um^3",
        source="Section 2, Figure 1", shown="0.00",
    )  # fmt: skip
    sheet.line(
        "h_line", "h", "angle of the depth", "=ASIN(SQRT(CV_PV_line))/3",
        source="asin(√(CV/PV))/3",
    )  # fmt: skip
    sheet.line(
        "X_R_line", "X/R", "normalized depth", "=4*SIN(h_line)*SIN(h_line+pi_/3)",
        source="Eqs. 2 and 3 solved",
    )  # fmt: skip
    sheet.line("X_D_line", "X/D", "depth over the diameter", "=X_R_line/2", source="D = 2R")
    sheet.line(
        "X_line", "X", "penetration depth", "=X_R_line*(D_mean/2)", "m",
        source="Section 2, below Eq. 4", shown="0.000E+00",
    )  # fmt: skip
    sheet.line(
        "X_line_um", "X", "the same", "=X_line*1000000", "um",
        source="Section 2, below Eq. 4", shown="0.000",
    )  # fmt: skip
    sheet.line(
        "CV_line", "CV", "crater volume", "=1/3*pi_*X_line*X_line*(3*(D_mean/2)-X_line)", "m^3",
        source="Eq. 2", shown="0.000E+00",
    )  # fmt: skip
    sheet.line(
        "CV_line_again_um3", "CV", "the same", "=CV_line*um3_per_m3", "um^3",
        shown="0.00",
    )  # fmt: skip
    sheet.line(
        "CV_PV_line_again", "CV/PV", "back again through Eq. 2", "=CV_line/PV_m3",
        beside="volume-ratio-line", source="Eqs. 2 and 3",
    )  # fmt: skip


def _contact(sheet: SheetPlan) -> None:
    sheet.row += 1
    sheet.block("Contact circle of the mean particle (section 3)")
    third = sheet.ledger.value("observed-third")
    sheet.line("y_contact", "X/R", "normalized depth", f"={third}", beside="observed-third")
    sheet.line(
        "contact", "2a", "diameter of the contact circle",
        "=D_mean*SQRT(y_contact*(2-y_contact))", "m",
        source="Eq. 12: a² = Dx - x²", shown="0.000E+00",
    )  # fmt: skip
    sheet.line(
        "contact_um", "2a", "the same", "=contact*1000000", "um",
        claim="contact-diameter-bound", shown="0.00",
    )  # fmt: skip


def _velocities(sheet: SheetPlan) -> None:
    equation_1 = "Eq. 1, with V the impact velocity and m_o = M"
    sheet.row += 1
    sheet.block("Particle velocity against mass (Eq. 1)")
    sheet.line(
        "m_min", "m", "mass for diameter d_min", "=rho_p*4/3*pi_*(d_min/2)*(d_min/2)*(d_min/2)",
        "kg", source="Eq. 3 times ρ_p", shown="0.000E+00",
    )  # fmt: skip
    sheet.line(
        "V_min", "V_p", "velocity for diameter d_min", "=V_impact*SQRT(M_p/m_min)", "m/s",
        source=equation_1, shown="0.0",
    )  # fmt: skip
    sheet.line(
        "m_max", "m", "mass for diameter d_max", "=rho_p*4/3*pi_*(d_max/2)*(d_max/2)*(d_max/2)",
        "kg", source="Eq. 3 times ρ_p", shown="0.000E+00",
    )  # fmt: skip
    sheet.line(
        "V_max", "V_p", "velocity for diameter d_max", "=V_impact*SQRT(M_p/m_max)", "m/s",
        source=equation_1, shown="0.0",
    )  # fmt: skip

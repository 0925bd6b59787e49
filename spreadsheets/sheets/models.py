"""The sheets `Crater`, `Resistance` and `Frank-Zook`: the report's closed formulas."""

from collections.abc import Sequence

from reference.ledger import Ledger
from spreadsheets.plan import Line, SheetPlan, log1p
from spreadsheets.sheets.steps import CaseSheet

# One quantity a line reads as a table.
# fmt: off

_SI = "0.000E+00"


def _sheet(
    ledger: Ledger, name: str, heading: str, said: Sequence[str], lines: Sequence[Line | str]
) -> SheetPlan:
    """One table under notes; its keys begin with the sheet's name."""
    widths = dict(zip("ABCDEF", (9.0, 44.0, 14.0, 8.0, 20.0, 46.0), strict=True))
    page = SheetPlan(name=name, widths=widths)
    page.title(heading)
    page.say(*said)
    page.row += 1
    page.repeated_rows, page.frozen = (page.row, page.row), f"A{page.row + 1}"
    page.lines(ledger, name.lower().replace("-", "_"), lines)
    return page


def crater(ledger: Ledger) -> SheetPlan:
    """Section 2's geometry of a sphere pressed into a flat surface, and Eq. 1."""
    third = ledger.value("observed-third")
    lines: list[Line | str] = [
        "Particle",
        Line("volume", "PV", "particle volume", "=4/3*pi_*R_p*R_p*R_p", "m^3", "Eq. 3", shown=_SI),
        Line("volume_um3", "PV", "the same", _cubed("volume"), "um^3", claim="particle-volume",
             shown="0.00"),
        "Crater of the observed CV/PV",
        *_crater("least", "CV_PV", "observed-depth-ratio", "observed-depth", "volume-ratio"),
        "Line of Figure 1: CV in proportion to PV",
        Line("on_line", "CV", "crater volume on the line, at this PV", "=CV_PV_line*{volume_um3}",
             "um^3", "Section 2, Figure 1", shown="0.00"),
        *_crater("line", "CV_PV_line", "", "", "volume-ratio-line"),
        "Contact circle of the impact (section 3)",
        Line("third", "X/R", "normalized depth", f"={third.numerator}/{third.denominator}",
             claim="observed-third"),
        Line("contact_diameter", "2a", "diameter of the contact circle",
             "=D_p*SQRT({third}*(2-{third}))", "m", "Eq. 12: a² = Dx - x²", shown=_SI),
        Line("contact_diameter_um", "2a", "the same", "={contact_diameter}*1000000", "um",
             claim="contact-diameter-bound", shown="0.00"),
        "Particle velocity against mass (Eq. 1)",
    ]
    for which, diameter in (("smallest", "d_min"), ("average", "D_p"), ("largest", "d_max")):
        half = f"({diameter}/2)"
        lines += [
            Line(f"{which}_mass", "m", f"mass for diameter {diameter}",
                 f"=rho_p*4/3*pi_*{half}*{half}*{half}", "kg", "Eq. 3 times ρ_p", shown=_SI),
            Line(f"{which}_velocity", "V_p", f"velocity for diameter {diameter}",
                 f"=V_impact*SQRT(M_p/{{{which}_mass}})", "m/s",
                 "Eq. 1, with V the impact velocity and m_o = M", shown="0.0"),
        ]
    said = (
        "A crater of depth X ≤ R is a cap of the sphere: CV/PV = y² (3 - y)/4 with y = X/R. "
        "Its root is y = 4 sin(h) sin(h + π/3) with h = asin(√(CV/PV))/3."
    )
    return _sheet(ledger, "Crater", "Crater and particle", [said], lines)


def _cubed(volume: str) -> str:
    return f"={{{volume}}}*1000000*1000000*1000000"


def _crater(which: str, ratio: str, depth: str, micrometers: str, back: str) -> list[Line]:
    """Normalized depth from CV/PV, depth, and the ratio back through Eq. 2."""
    angle, below = f"ASIN(SQRT({ratio}))/3", "Section 2, below Eq. 4"
    y, x, cap = (f"{{{which}_{what}}}" for what in ("normalized_depth", "depth", "volume"))
    return [
        Line(f"{which}.normalized_depth", "X/R", "normalized depth",
             f"=4*SIN({angle})*SIN({angle}+pi_/3)", source="Eqs. 2 and 3 solved", claim=depth),
        Line(f"{which}.over_diameter", "X/D", "depth over the diameter", f"={y}/2",
             source="D = 2R", claim="general-sixth" if depth else ""),
        Line(f"{which}.depth", "X", "penetration depth", f"={y}*R_p", "m", below, shown=_SI),
        Line(f"{which}.depth_um", "X", "the same", f"={x}*1000000", "um", below, micrometers,
             "0.000"),
        Line(f"{which}.volume", "CV", "crater volume", f"=1/3*pi_*{x}*{x}*(3*R_p-{x})", "m^3",
             "Eq. 2", shown=_SI),
        Line(f"{which}.volume_um3", "CV", "the same", _cubed(f"{which}_volume"), "um^3",
             shown="0.00"),
        Line(f"{which}.ratio", "CV/PV", "back again through Eq. 2", f"={cap}/{{volume}}",
             source="Eqs. 2 and 3", claim=back),
    ]


def resistance(ledger: Ledger, cases: Sequence[CaseSheet]) -> SheetPlan:
    """Beta by three routes, grain strengths, centerline stress, strain rate."""
    three = "{goodier_beta},{walker_anderson_beta},{brinell_beta}"
    grains = (("feathery", "feathery grains"), ("clear", "clear grains"), ("bulk", "bulk material"))
    lines: list[Line | str] = [
        "Target resistance over flow stress, β",
        Line("goodier_beta", "β", "Goodier", "=4*q_Y/pi_", source="Eqs. 8 and 9 with n = 2",
             claim="goodier-beta"),
        Line("alpha", "α", "extent of the plastic zone, Walker and Anderson",
             "=(2*E_t/(3*Y_steel))^(1/3)", source="Eq. 11", claim="walker-anderson-alpha"),
        Line("walker_anderson_beta", "β", "Walker and Anderson", "=7/3*LN({alpha})",
             source="Eq. 10", claim="walker-anderson-beta"),
        Line("brinell_beta", "β", "Brinell hardness as target resistance", "=HB_ratio",
             claim="brinell-beta"),
        Line("least_beta", "β", "least of the three", f"=MIN({three})", claim="beta-range-least"),
        Line("greatest_beta", "β", "greatest of the three", f"=MAX({three})",
             claim="beta-range-greatest"),
        "Strength of the target’s grains",
        *(
            Line(which, "S", f"strength, {meaning}", f"=S_{which}/1000000", "MPa",
                 claim=f"strength-{which}", shown="0.0")
            for which, meaning in grains
        ),
        Line("mean_grain", "S", "mean of the two kinds of grain", "=({feathery}+{clear})/2", "MPa",
             claim="flow-stress", shown="0.0"),
        Line("clear_over_bulk", "", "clear grains over bulk", "={clear}/{bulk}",
             claim="strength-multiple", shown="0.00"),
        Line("grain_over_bulk", "", "mean over bulk", "={mean_grain}/{bulk}",
             claim="strength-multiple", shown="0.00"),
        "Target resistance and centerline stress at impact",
    ]
    for case in cases:
        key, r_t = case.slug, case.named("R_t")
        lines += [
            Line(f"{key}.target_resistance", "R_t", f"target resistance, {case.name}", f"={r_t}",
                 "Pa", "Eq. 7; Inputs", shown=_SI),
            Line(f"{key}.centerline_stress", "Σ", f"centerline stress, {case.name}",
                 f"=rho_t*V_impact*V_impact/2+{r_t}", "Pa",
                 "Eq. 6; by Eq. 5 the least strength of a rigid particle", shown=_SI),
            Line(f"{key}.over_copper", "Σ/Y_p", "over the yield strength of annealed copper",
                 f"={{{key}_centerline_stress}}/Y_copper",
                 source="a rigid particle is at least so many times as strong", shown="0.0"),
        ]
    lines += [
        "Strain rate",
        Line("strain_rate", "V/L", "impact velocity over a typical dimension", "=V_impact/L_typ",
             "1/s", claim="strain-rate", shown="0.0E+00"),
    ]
    return _sheet(ledger, "Resistance", "Target resistance", [], lines)


def frank_zook(ledger: Ledger) -> SheetPlan:
    """Eq. 16 as it is printed, and as it follows from Eqs. 14 and 15."""
    lines: list[Line | str] = [
        "The cylinder of the sphere’s mass and diameter",
        # It hangs on no input: (pi/6) D^3 = (pi/4) D^2 L.
        Line("length_ratio", "L/D", "length over diameter of the cylinder", "=(1/6)/(1/4)",
             claim="sphere-length-ratio"),
    ]
    for which, head, r_t, given, depth in (
        ("rha", "Rolled homogeneous armor (Eq. 17)", "R_t_RHA",
         "fz-resistance-rha", "frank-zook-rha"),
        ("lower", "Stainless steel", "R_t_lower",
         "fz-resistance-stainless", "frank-zook-stainless"),
    ):
        inertia = "({length_ratio}*rho_p/rho_t+k_1)/(2*k_t)"
        lines += [
            head,
            Line(f"{which}.resistance", "R_t", "target resistance", f"={r_t}", "Pa", claim=given,
                 shown="0.00E+00"),
            Line(f"{which}.pressure", "z", "drag over resistance",
                 f"=k_t*rho_t*V_impact*V_impact/{r_t}", source="in Eq. 16", shown="0.0000E+00"),
            Line(f"{which}.as_printed", "X/R", "normalized depth, equation as printed",
                 f"={inertia}*{log1p(f'{{{which}_pressure}}')}", source="Eq. 16 as printed",
                 claim=depth),
            Line(f"{which}.derived", "X/R", "normalized depth, as derived",
                 f"=2*{{{which}_as_printed}}", source="Eqs. 14 and 15, with R = D/2", claim=depth),
        ]
    said = (
        "Eqs. 14 and 15, integrated from V to rest, give the right side of Eq. 16 for the depth in "
        "diameters, X/D. Eq. 16 prints X/R in front of it. Both readings stand here: the derived "
        "one is twice the printed one."
    )
    heading = "Frank-Zook depth of a noneroding penetrator"
    return _sheet(ledger, "Frank-Zook", heading, [said], lines)

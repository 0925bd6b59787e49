"""The sheets `Crater`, `Resistance` and `Frank-Zook`: the report's closed formulas."""

from collections.abc import Sequence

from reference.ledger import Ledger
from spreadsheets.plan import SheetPlan
from spreadsheets.sheets.lines import Line, log1p, sheet_of_lines
from spreadsheets.sheets.steps import CaseSheet

_SI = "0.000E+00"


def crater(ledger: Ledger) -> SheetPlan:
    """Section 2's geometry of a sphere pressed into a flat surface, and Eq. 1."""
    return sheet_of_lines(
        ledger,
        "Crater",
        "Crater and particle",
        [
            "A crater of depth X ≤ R is a cap of the sphere: CV/PV = y² (3 - y)/4 with y = X/R. "
            "Its root is y = 4 sin(h) sin(h + π/3) with h = asin(√(CV/PV))/3."
        ],
        [
            "Particle",
            Line("crater.volume", "PV", "particle volume", "=4/3*pi_*R_p*R_p*R_p", "m^3", "Eq. 3",
                 shown=_SI),
            Line("crater.volume_um3", "PV", "the same", _cubed("{volume}"), "um^3",
                 claim="particle-volume", shown="0.00"),
            "Crater of the least CV/PV",
            *_crater("least", "CV_PV", "observed-depth-ratio", "observed-depth", "volume-ratio"),
            "Line of Figure 1: CV in proportion to PV",
            Line("crater.on_line", "CV", "crater volume on the line, at this PV",
                 "=CV_PV_line*{volume_um3}", "um^3", "Section 2, Figure 1", shown="0.00"),
            *_crater("line", "CV_PV_line", "", "", "volume-ratio-line"),
            "Contact circle of the impact (section 3)",
            *_contact(ledger),
            "Particle velocity against mass (Eq. 1)",
            *_velocities(),
        ],
    )  # fmt: skip


def _cubed(volume: str) -> str:
    return f"={volume}*1000000*1000000*1000000"


def _crater(which: str, ratio: str, depth: str, micrometers: str, back: str) -> list[Line]:
    """Normalized depth from CV/PV, depth, and the ratio back through Eq. 2."""
    key, angle = f"crater.{which}", f"ASIN(SQRT({ratio}))/3"
    y, x, cap = (f"{{{which}_{what}}}" for what in ("normalized_depth", "depth", "volume"))
    below = "Section 2, below Eq. 4"
    lines = (
        ("normalized_depth", "X/R", "normalized depth", f"=4*SIN({angle})*SIN({angle}+pi_/3)", "1",
         "Eqs. 2 and 3 solved", "0.0000", depth),
        ("over_diameter", "X/D", "depth over the diameter", f"={y}/2", "1", "D = 2R", "0.0000",
         "general-sixth" if depth else ""),
        ("depth", "X", "penetration depth", f"={y}*R_p", "m", below, _SI, ""),
        ("depth_um", "X", "the same", f"={x}*1000000", "um", below, "0.000", micrometers),
        ("volume", "CV", "crater volume", f"=1/3*pi_*{x}*{x}*(3*R_p-{x})", "m^3", "Eq. 2", _SI, ""),
        ("volume_um3", "CV", "the same", _cubed(f"{{{which}_volume}}"), "um^3", "", "0.00", ""),
        ("ratio", "CV/PV", "back again through Eq. 2", f"={cap}/{{volume}}", "1", "Eqs. 2 and 3",
         "0.0000", back),
    )  # fmt: skip
    return [
        Line(f"{key}.{what}", symbol, meaning, formula, unit, source, shown=shown,
             claim=claim, transcendental=True)
        for what, symbol, meaning, formula, unit, source, shown, claim in lines
    ]  # fmt: skip


def _contact(ledger: Ledger) -> list[Line]:
    third = ledger.value("observed-third")
    return [
        Line("crater.third", "X/R", "normalized depth", f"={third.numerator}/{third.denominator}",
             claim="observed-third"),
        Line("crater.contact_diameter", "2a", "diameter of the contact circle",
             "=D_p*SQRT({third}*(2-{third}))", "m", "Eq. 12: a² = Dx - x²", shown=_SI),
        Line("crater.contact_diameter_um", "2a", "the same", "={contact_diameter}*1000000", "um",
             claim="contact-diameter-bound", shown="0.00"),
    ]  # fmt: skip


def _velocities() -> list[Line]:
    lines = []
    for which, diameter in (("smallest", "d_min"), ("average", "D_p"), ("largest", "d_max")):
        mass, half = f"{which}_mass", f"({diameter}/2)"
        lines += [
            Line(f"crater.{mass}", "m", f"mass, {which} particle",
                 f"=rho_p*4/3*pi_*{half}*{half}*{half}", "kg", "Eq. 3 times ρ_p",
                 shown=_SI),
            Line(f"crater.{which}_velocity", "V_p", f"velocity, {which} particle",
                 f"=V_impact*SQRT(M_p/{{{mass}}})", "m/s",
                 "Eq. 1, with V the impact velocity and m_o = M", shown="0.0"),
        ]  # fmt: skip
    return lines


def resistance(ledger: Ledger, cases: Sequence[CaseSheet]) -> SheetPlan:
    """Beta by three routes, grain strengths, centerline stress, strain rate."""
    three = "{goodier_beta},{walker_anderson_beta},{brinell_beta}"
    lines: list[Line | str] = [
        "Target resistance over flow stress, β",
        Line("resistance.goodier_beta", "β", "Goodier", "=4*q_Y/pi_",
             source="Eqs. 8 and 9 with n = 2", claim="goodier-beta"),
        Line("resistance.alpha", "α", "extent of the plastic zone, Walker and Anderson",
             "=(2*E_t/(3*Y_steel))^(1/3)", source="Eq. 11", claim="walker-anderson-alpha",
             transcendental=True),
        Line("resistance.walker_anderson_beta", "β", "Walker and Anderson", "=7/3*LN({alpha})",
             source="Eq. 10", claim="walker-anderson-beta", transcendental=True),
        Line("resistance.brinell_beta", "β", "Brinell hardness as target resistance", "=HB_ratio",
             claim="brinell-beta"),
        Line("resistance.least_beta", "β", "least of the three", f"=MIN({three})",
             claim="beta-range-least", transcendental=True),
        Line("resistance.greatest_beta", "β", "greatest of the three", f"=MAX({three})",
             claim="beta-range-greatest", transcendental=True),
        "Strength of the target’s grains",
        *(
            Line(f"resistance.{which}", "S", f"strength, {meaning}", f"=S_{which}/1000000", "MPa",
                 claim=f"strength-{which}", shown="0.0")
            for which, meaning in (("feathery", "feathery grains"), ("clear", "clear grains"),
                                   ("bulk", "bulk material"))
        ),
        Line("resistance.mean_grain", "S", "mean of the two kinds of grain",
             "=({feathery}+{clear})/2", "MPa", claim="flow-stress", shown="0.0"),
        Line("resistance.clear_over_bulk", "", "clear grains over bulk", "={clear}/{bulk}",
             claim="strength-multiple", shown="0.00"),
        Line("resistance.grain_over_bulk", "", "mean over bulk", "={mean_grain}/{bulk}",
             claim="strength-multiple", shown="0.00"),
        "Target resistance and centerline stress at impact",
    ]  # fmt: skip
    for case in cases:
        lines += _stresses(case)
    lines += [
        "Strain rate",
        Line("resistance.strain_rate", "V/L", "impact velocity over a typical dimension",
             "=V_impact/L_typ", "1/s", claim="strain-rate", shown="0.0E+00"),
    ]  # fmt: skip
    return sheet_of_lines(ledger, "Resistance", "Target resistance", [], lines)


def _stresses(case: CaseSheet) -> list[Line]:
    key, resistance = f"resistance.{case.slug}", case.named("R_t")
    return [
        Line(f"{key}.target_resistance", "R_t", f"target resistance, {case.name}",
             f"={resistance}", "Pa", "Eq. 7; Inputs", shown=_SI),
        Line(f"{key}.centerline_stress", "Σ", f"centerline stress, {case.name}",
             f"=rho_t*V_impact*V_impact/2+{resistance}", "Pa",
             "Eq. 6; by Eq. 5 the least strength of a rigid particle", shown=_SI),
        Line(f"{key}.over_copper", "Σ/Y_p", "over the yield strength of annealed copper",
             f"={{{case.slug}_centerline_stress}}/Y_copper", "1",
             "a rigid particle must be so many times stronger", shown="0.0"),
    ]  # fmt: skip


def frank_zook(ledger: Ledger) -> SheetPlan:
    """Eq. 16 as it is printed, and as it follows from Eqs. 14 and 15."""
    return sheet_of_lines(
        ledger,
        "Frank-Zook",
        "Frank-Zook depth of a noneroding penetrator",
        [
            "Eqs. 14 and 15, integrated from V to rest, give the right side of Eq. 16 for the "
            "depth in diameters, X/D. Eq. 16 prints X/R in front of it. Both readings stand here: "
            "the derived one is twice the printed one."
        ],
        [
            "The cylinder of the sphere’s mass and diameter",
            # It hangs on no input: (pi/6) D^3 = (pi/4) D^2 L.
            Line("frank_zook.length_ratio", "L/D", "length over diameter of the cylinder",
                 "=(1/6)/(1/4)", claim="sphere-length-ratio"),
            "Rolled homogeneous armor (Eq. 17)",
            *_depths("rha", "R_t_RHA", "fz-resistance-rha", "frank-zook-rha"),
            "The lower target resistance",
            *_depths("lower", "R_t_lower", "fz-resistance-stainless", "frank-zook-stainless"),
        ],
    )  # fmt: skip


def _depths(which: str, resistance: str, printed: str, claim: str) -> list[Line]:
    key, z = f"frank_zook.{which}", f"{{{which}_pressure}}"
    inertia = "({length_ratio}*rho_p/rho_t+k_1)/(2*k_t)"
    derived = f"=2*{{{which}_as_printed}}"
    return [
        Line(f"{key}.resistance", "R_t", "target resistance", f"={resistance}", "Pa",
             claim=printed, shown="0.00E+00"),
        Line(f"{key}.pressure", "z", "drag over resistance",
             f"=k_t*rho_t*V_impact*V_impact/{resistance}", source="in Eq. 16",
             shown="0.0000E+00"),
        Line(f"{key}.as_printed", "X/R", "normalized depth, equation as printed",
             f"={inertia}*{log1p(z)}", source="Eq. 16 as printed", claim=claim,
             transcendental=True),
        Line(f"{key}.derived", "X/R", "normalized depth, as derived", derived,
             source="Eqs. 14 and 15, with R = D/2", claim=claim, transcendental=True),
    ]  # fmt: skip

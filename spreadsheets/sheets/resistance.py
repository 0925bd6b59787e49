"""The sheet `Resistance`: beta by three routes, grain strengths, centerline stress, strain rate."""

from spreadsheets.plan import Cell, SheetPlan
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.lines import WIDTHS, Line, heads, live, place

__all__ = ["sheet"]

_SI = "0.000E+00"
_THREE = "{goodier_beta},{walker_anderson_beta},{brinell_beta}"


def sheet(cases: tuple[CaseSheet, ...]) -> SheetPlan:
    """The sheet for these cases."""
    lines: list[Line | str] = ["Resistance over flow stress, β", *_betas()]
    lines += ["Strength of the target's grains", *_strengths()]
    lines += ["Target resistance and centerline stress at impact"]
    for case in cases:
        lines += _stresses(case)
    lines += ["Strain rate", _strain_rate()]
    cells = {"A1": Cell(text="Target resistance", style="title")}
    return SheetPlan(
        name="Resistance",
        cells=cells | heads(3) | place(lines, 4),
        widths=dict(zip("ABCDEF", WIDTHS, strict=True)),
    )


def _betas() -> list[Line]:
    return [
        live(
            "resistance.goodier_beta", "β", "Goodier", "=4*q_Y/PI()", "1",
            "Eqs. 8-9 with n = 2", printed="3.5",
        ),
        live(
            "resistance.alpha", "α", "extent of the plastic zone, Walker and Anderson",
            "=(2*E_t/(3*Y_steel))^(1/3)", "1", "Eq. 11", printed="8.5", transcendental=True,
        ),
        live(
            "resistance.walker_anderson_beta", "β", "Walker and Anderson", "=7/3*LN({alpha})", "1",
            "Eq. 10", printed="5.0", transcendental=True,
        ),
        live(
            "resistance.brinell_beta", "β", "Brinell hardness as target resistance", "=HB_ratio",
            "1", "Section 3, below Eq. 11", printed="3",
        ),
        live(
            "resistance.least_beta", "β", "least of the three", f"=MIN({_THREE})", "1",
            "Section 3: “in the range of 3 to 5”", printed="3", transcendental=True,
        ),
        live(
            "resistance.greatest_beta", "β", "greatest of the three", f"=MAX({_THREE})", "1",
            "Section 3: “in the range of 3 to 5”", printed="5", transcendental=True,
        ),
    ]  # fmt: skip


def _strengths() -> list[Line]:
    grains = (
        ("feathery", "feathery grains", "S_feathery", "110 ksi"),
        ("clear", "clear grains", "S_clear", "98 ksi"),
        ("bulk", "bulk material", "S_bulk", "~30 ksi"),
    )
    lines = [
        live(
            f"resistance.{which}", "S", f"strength, {meaning}",
            f"={name}*1000*lbf_N/(inch_m*inch_m)/1000000", "MPa",
            "Section 3; 1 ksi = 1000 lbf/in²", printed=printed, number_format="0.0",
        )
        for which, meaning, name, printed in grains
    ]  # fmt: skip
    mean = live(
        "resistance.mean_grain", "S", "mean of the two kinds of grain", "=({feathery}+{clear})/2",
        "MPa", "Section 3: the flow stress “will be taken to be”", printed="700 MPa",
        number_format="0.0",
    )  # fmt: skip
    least = live(
        "resistance.clear_over_bulk", "", "clear grains over bulk", "={clear}/{bulk}", "1",
        "Section 3: the least of them", printed="several times", number_format="0.00",
    )  # fmt: skip
    several = live(
        "resistance.grain_over_bulk", "", "mean over bulk", "={mean_grain}/{bulk}", "1",
        "Section 3", printed="several times", number_format="0.00",
    )  # fmt: skip
    return [*lines, mean, least, several]


def _stresses(case: CaseSheet) -> list[Line]:
    key, resistance = f"resistance.{case.slug}", case.named("R_t")
    stress = f"=rho_t*V_impact*V_impact/2+{resistance}"
    return [
        live(
            f"{key}.target_resistance", "R_t", f"target resistance, {case.name}",
            f"={resistance}", "Pa", "Eq. 7; Inputs", number_format=_SI,
        ),
        live(
            f"{key}.centerline_stress", "Σ", f"centerline stress, {case.name}", stress, "Pa",
            "Eq. 6: by Eq. 5 also the least strength of a rigid particle", number_format=_SI,
        ),
        live(
            f"{key}.over_copper", "Σ/Y_p", "over the yield strength of annealed copper",
            f"={{{case.slug}_centerline_stress}}/Y_copper", "1",
            "Section 3: a rigid particle must be so many times stronger", number_format="0.0",
        ),
    ]  # fmt: skip


def _strain_rate() -> Line:
    return live(
        "resistance.strain_rate", "V/L", "impact velocity over a typical dimension",
        "=V_impact/L_typ", "1/s", "Section 3: “on the order of”", printed="10^7 s^-1",
        number_format="0.0E+00",
    )  # fmt: skip

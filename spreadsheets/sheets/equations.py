"""The sheet `Equations`: the constants that the report's equations print, from the geometry."""

from spreadsheets.plan import Cell, SheetPlan
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.lines import WIDTHS, Line, heads, live, place

__all__ = ["sheet"]

_NOTES = (
    "A sphere of radius R = 1 cut at depth X: the section at depth x has the area π (2Rx - x²), "
    "and Simpson's rule, exact for it, gives the cap's volume CV.",
    "A power is ln(ratio of the values)/ln 2, with the depth or the radius doubled.",
)
_CUT = "π a² = π (2Rx - x²)"
_PYTHAGORAS = "Pythagoras: a² = R² - (R - x)²"
_WORK = "Eqs. 14-15: (L ρ_p + k_1 ρ_t D) V²/2 = R_t X"


def sheet(cases: tuple[CaseSheet, ...]) -> SheetPlan:
    """The sheet for these cases."""
    cells = {"A1": Cell(text="Constants of the equations", style="title")}
    for row, note in enumerate(_NOTES, start=2):
        cells[f"A{row}"] = Cell(text=note, style="note")
    lines: list[Line | str] = ["Crater volume (Eq. 2): CV = 1/3 π X² (3R - X)", *_crater()]
    lines += ["Particle volume (Eq. 3): PV = 4/3 π R³", *_particle()]
    lines += ["Contact area (Eqs. 12 and A-3): π a² = π (Dx - x²)", *_contact()]
    lines += ["Frank-Zook depth (Eq. 16), from Eqs. 14 and 15", *_frank_zook()]
    lines += ["Sheet against experiment", *map(_excess, cases)]
    lines += ["Particle", *_radius()]
    return SheetPlan(
        name="Equations",
        cells=cells | heads(5) | place(lines, 6),
        widths=dict(zip("ABCDEF", WIDTHS, strict=True)),
    )


def _simpson(depth: str, radius: str) -> str:
    """The integral of 2Rx - x² from 0, where it vanishes, to the depth."""
    half = f"({depth}/2)"
    middle, end = (f"(2*{radius}*{x}-{x}*{x})" for x in (half, depth))
    return f"={depth}*(4*{middle}+{end})/6"


def _crater() -> list[Line]:
    caps = (("quarter", "R/4", "(1/4)"), ("half", "R/2", "(1/2)"), ("radius", "R", "1"))
    at_radius = "{eq2_radius}"
    return [
        *(
            live(
                f"equations.eq2.{what}", "CV/π", f"cap's volume over π, X = {depth}",
                _simpson(x, "1"), "1", _CUT, number_format="0.000000",
            )
            for what, depth, x in caps
        ),
        live(
            "equations.eq2.factor", "", "factor: over X² (3R - X), at X = R",
            f"={at_radius}/(3*1-1)", "1", "Eq. 2", printed="1/3",
        ),
        live(
            "equations.eq2.power", "", "power of X: over 3R - X, X = R/2 against R/4",
            "=LN({eq2_half}/(3-1/2)/({eq2_quarter}/(3-1/4)))/LN(2)", "1", "Eq. 2",
            printed="2", transcendental=True,
        ),
        live(
            "equations.eq2.offset", "", "multiple of R: 3 CV/(π X²) + X, at X = R",
            f"=3*{at_radius}+1", "1", "Eq. 2", printed="3",
        ),
    ]  # fmt: skip


def _particle() -> list[Line]:
    return [
        live(
            "equations.eq3.factor", "PV/(π R³)", "factor: the cap's volume over π, X = 2R",
            _simpson("2", "1"), "1", "Eq. 3", printed="4/3",
        ),
        live(
            "equations.eq3.double", "PV/π", "the same of a sphere of twice the radius",
            _simpson("4", "2"), "1", "Eq. 3",
        ),
        live(
            "equations.eq3.power", "", "power of R", "=LN({eq3_double}/{eq3_factor})/LN(2)", "1",
            "Eq. 3", printed="3", transcendental=True,
        ),
    ]  # fmt: skip


def _contact() -> list[Line]:
    depths = (("quarter", "R/4", "(1/4)"), ("half", "R/2", "(1/2)"))
    return [
        *(
            live(
                f"equations.contact.{what}", "Dx - a²", f"what Dx lacks, x = {depth}",
                f"=2*{x}-(1-(1-{x})*(1-{x}))", "1", _PYTHAGORAS, number_format="0.000000",
            )
            for what, depth, x in depths
        ),
        live(
            "equations.contact.power", "", "power of x, x = R/2 against R/4",
            "=LN({contact_half}/{contact_quarter})/LN(2)", "1", "Eqs. 12 and A-3",
            printed="2", transcendental=True,
        ),
    ]  # fmt: skip


def _frank_zook() -> list[Line]:
    length_ratio = "{eq3_factor}/2"
    return [
        live(
            "equations.eq16.inertia", "", "(L/D) (ρ_p/ρ_t) + k_1",
            f"={length_ratio}*rho_p/rho_t+k_1", "1", "Eq. 16; π R² L = PV",
        ),
        live(
            "equations.eq16.depth", "R_t X/V²", "work against R_t alone, over V², as V → 0",
            f"=({length_ratio}*D_p*rho_p+k_1*rho_t*D_p)/2", "kg/m²", _WORK,
        ),
        live(
            "equations.eq16.denominator", "", "multiple of k_t, if Eq. 16 is to give X/R",
            "={eq16_inertia}*rho_t*R_p/{eq16_depth}", "1", "Eq. 16 as V → 0, against Eqs. 14-15",
            printed="2",
        ),
        live(
            "equations.eq16.diameters", "", "multiple of k_t, if Eq. 16 is to give X/D",
            "={eq16_inertia}*rho_t*D_p/{eq16_depth}", "1", "Eq. 16 as V → 0, against Eqs. 14-15",
        ),
        live(
            "equations.eq16.offset", "", "argument of the logarithm at no depth, X/D = 0",
            "=EXP(2*k_t*0/{eq16_inertia})", "1", "Eq. 16 solved for the argument", printed="1",
            transcendental=True,
        ),
    ]  # fmt: skip


def _excess(case: CaseSheet) -> Line:
    return live(
        f"equations.{case.slug}.excess", "", f"X/R over the observed X/R, {case.name}",
        f"={case.named('normalized_depth')}/observed_ratio", "1", "Section 4",
        printed="over two",
    )  # fmt: skip


def _radius() -> list[Line]:
    return [
        live(
            "equations.radius", "R", "half of the mean diameter", "=D_mean/2", "m", "Section 4",
            number_format="0.000E+00",
        ),
        live(
            "equations.radius_um", "R", "the same", "={radius}*1000000", "µm", "Section 4",
            printed="11 μm", number_format="0.00",
        ),
    ]  # fmt: skip

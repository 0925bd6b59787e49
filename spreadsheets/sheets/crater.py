"""The sheet `Crater`: section 2's geometry of a sphere pressed into a flat surface, and Eq. 1."""

from spreadsheets.plan import Cell, SheetPlan
from spreadsheets.sheets.lines import WIDTHS, Line, heads, live, place

__all__ = ["sheet"]

_SI = "0.000E+00"


def sheet() -> SheetPlan:
    """The sheet; it has the same cells for every case."""
    cells = {
        "A1": Cell(text="Crater and particle", style="title"),
        "A2": Cell(
            text="A crater of depth X ≤ R is a cap of the sphere: CV/PV = y² (3 - y)/4 with "
            "y = X/R. Its root: y = 4 sin(h) sin(h + π/3), h = asin(√(CV/PV))/3.",
            style="note",
        ),
    }
    lines: list[Line | str] = ["Particle", *_volume("volume", "PV", "particle volume", "5575")]
    lines += ["Crater of the least CV/PV", *_crater("least", "CV_PV", "0.298", "3.3", "0.06")]
    lines += ["Line of figure 1: CV in proportion to PV", *_line()]
    lines += ["Contact circle at a third of the radius", *_contact()]
    lines += ["Particle velocity against mass (Eq. 1)", *_velocities()]
    return SheetPlan(
        name="Crater",
        cells=cells | heads(4) | place(lines, 5),
        widths=dict(zip("ABCDEF", WIDTHS, strict=True)),
    )


def _volume(what: str, symbol: str, meaning: str, printed: str) -> list[Line]:
    formula = "=4/3*PI()*R_p*R_p*R_p"
    return [
        live(f"crater.{what}", symbol, meaning, formula, "m³", "Eq. 3", number_format=_SI),
        live(
            f"crater.{what}_um3", symbol, "the same", _cubic_micrometers(what), "µm³", "Section 2",
            printed=printed, number_format="0.00",
        ),
    ]  # fmt: skip


def _cubic_micrometers(what: str) -> str:
    return f"={{{what}}}*1000000*1000000*1000000"


def _crater(which: str, ratio: str, depth: str, micrometers: str, back: str) -> list[Line]:
    """Normalized depth from CV/PV, depth, and the ratio back through Eq. 2."""
    key, angle = f"crater.{which}", f"ASIN(SQRT({ratio}))/3"
    y, x, cap = (f"{{{which}_{what}}}" for what in ("normalized_depth", "depth", "volume"))
    lines = (
        ("normalized_depth", "X/R", "normalized depth", f"=4*SIN({angle})*SIN({angle}+PI()/3)",
         "1", "Eqs. 2-3 solved: Eq. 4", "0.0000", depth),
        ("depth", "X", "penetration depth", f"={y}*R_p", "m", "Section 2, below Eq. 4", _SI, ""),
        ("depth_um", "X", "the same", f"={x}*1000000", "µm", "Section 2, below Eq. 4", "0.000",
         micrometers),
        ("volume", "CV", "crater volume", f"=1/3*PI()*{x}*{x}*(3*R_p-{x})", "m³", "Eq. 2", _SI, ""),
        ("volume_um3", "CV", "the same", _cubic_micrometers(f"{which}_volume"), "µm³", "", "0.00",
         ""),
        ("ratio", "CV/PV", "back again through Eq. 2", f"={cap}/{{volume}}", "1", "Eqs. 2-3",
         "0.0000", back),
    )  # fmt: skip
    return [
        live(
            f"{key}.{what}", symbol, meaning, formula, unit, source,
            number_format=shown, printed=printed, transcendental=True,
        )
        for what, symbol, meaning, formula, unit, source, shown, printed in lines
    ]  # fmt: skip


def _line() -> list[Line]:
    on_line = live(
        "crater.on_line", "CV", "crater volume on the line, at this PV",
        "=CV_PV_line*{volume_um3}", "µm³", "Section 2, figure 1", number_format="0.00",
    )  # fmt: skip
    return [on_line, *_crater("line", "CV_PV_line", "", "", "0.058")]


def _contact() -> list[Line]:
    source = "Section 3, above figure 2"
    diameter = "=D_p*SQRT({third}*(2-{third}))"
    return [
        live("crater.third", "X/R", "normalized depth", "=1/3", "1", source, printed="a third"),
        live(
            "crater.contact_diameter", "2a", "diameter of the contact circle", diameter, "m",
            "Eq. 12: a² = Dx - x²", number_format=_SI,
        ),
        live(
            "crater.contact_diameter_um", "2a", "the same", "={contact_diameter}*1000000", "µm",
            source, printed="less than 20 μm", number_format="0.00",
        ),
    ]  # fmt: skip


def _velocities() -> list[Line]:
    """Mass and velocity of the least, the average and the largest particle of section 2."""
    particles = (
        ("smallest", "smallest particle", "d_min"),
        ("average", "average particle", "D_p"),
        ("largest", "largest particle", "d_max"),
    )
    lines = []
    for which, meaning, diameter in particles:
        mass, velocity = f"{which}_mass", f"V_impact*SQRT(M_p/{{{which}_mass}})"
        half = f"({diameter}/2)"
        lines += [
            live(
                f"crater.{mass}", "m", f"mass, {meaning}",
                f"=rho_p*4/3*PI()*{half}*{half}*{half}", "kg", "Eq. 3 times ρ_p",
                number_format=_SI,
            ),
            live(
                f"crater.{which}_velocity", "V_p", f"velocity, {meaning}", f"={velocity}", "m/s",
                "Eq. 1, with V = impact velocity and m_o = M", number_format="0.0",
            ),
        ]  # fmt: skip
    return lines

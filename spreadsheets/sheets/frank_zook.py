"""The sheet `Frank-Zook`: Eq. 16 as it is printed, and as it follows from Eqs. 14 and 15."""

from spreadsheets.plan import Cell, SheetPlan
from spreadsheets.sheets.lines import WIDTHS, Line, heads, live, place

__all__ = ["sheet"]

_NOTES = (
    "Eqs. 14 and 15, integrated from V to rest, give the right side of Eq. 16 for the depth in "
    "diameters, X/D.",
    "Eq. 16 prints X/R in front of it. Both readings stand here: the derived one is twice the "
    "printed one.",
)


def sheet() -> SheetPlan:
    """The sheet; it has the same cells for every case."""
    cells = {"A1": Cell(text="Frank-Zook depth of a noneroding penetrator", style="title")}
    for row, note in enumerate(_NOTES, start=2):
        cells[f"A{row}"] = Cell(text=note, style="note")
    cells |= heads(5) | place(
        [
            "The cylinder of the sphere's mass and diameter",
            _length_ratio(),
            "Rolled homogeneous armor (Eq. 17)",
            *_depths("RHA", "R_t_RHA", "0.278"),
            "Lower target resistance",
            *_depths("lower", "R_t_lower", "0.297"),
        ],
        6,
    )
    return SheetPlan(
        name="Frank-Zook", cells=cells, widths=dict(zip("ABCDEF", WIDTHS, strict=True))
    )


def _length_ratio() -> Line:
    return live(
        "frank_zook.length_ratio",
        "L/D",
        "length over diameter of the sphere's equivalent",
        "=(1/6)/(1/4)",
        "1",
        "Section 3, below Eq. 17: (π/6) D³ = (π/4) D² L",
        printed="2/3",
    )


def _depths(which: str, resistance: str, printed: str) -> list[Line]:
    key = f"frank_zook.{which}"
    inertia = "({length_ratio}*rho_p/rho_t+k_1)/(2*k_t)"
    as_printed = f"={inertia}*LN(1+k_t*rho_t*V_impact*V_impact/{resistance})"
    readings = (
        ("as_printed", "equation as printed", as_printed, "Eq. 16 as printed"),
        ("derived", "as derived", f"=2*{{{which}_as_printed}}", "Eqs. 14 and 15, with R = D/2"),
    )
    return [
        live(
            f"{key}.resistance", "R_t", "target resistance", f"={resistance}", "Pa", "Inputs",
            number_format="0.00E+00",
        ),
        *(
            live(
                f"{key}.{what}", "X/R", f"normalized depth, {meaning}", formula, "1", source,
                printed=printed, transcendental=True,
            )
            for what, meaning, formula, source in readings
        ),
    ]  # fmt: skip

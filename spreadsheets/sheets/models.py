"""The sheets `Crater`, `Resistance` and `Frank-Zook`: the report's closed formulas."""

from collections.abc import Sequence

from reference.ledger import Ledger
from spreadsheets.plan import Line, SheetPlan, lines_of, log1p, tables
from spreadsheets.sheets.steps import CaseSheet


def _sheet(
    ledger: Ledger, name: str, heading: str, said: Sequence[str], lines: Sequence[Line | str]
) -> SheetPlan:
    """One table under notes; its keys begin with the sheet's name."""
    columns = zip("ABCDEF", tables()["columns"]["lines"], strict=True)
    page = SheetPlan(name=name, widths={letter: width for letter, (_, width) in columns})
    page.title(heading)
    page.say(*said)
    page.row += 1
    page.repeated_rows, page.frozen = (page.row, page.row), f"A{page.row + 1}"
    page.lines(ledger, name.lower().replace("-", "_"), lines)
    return page


def crater(ledger: Ledger) -> SheetPlan:
    """Section 2's geometry of a sphere pressed into a flat surface, and Eq. 1."""
    said = (
        "A crater of depth X ≤ R is a cap of the sphere: CV/PV = y² (3 - y)/4 with y = X/R. "
        "Its root is y = 4 sin(h) sin(h + π/3) with h = asin(√(CV/PV))/3."
    )
    lines = lines_of("crater", {"third": str(ledger.value("observed-third"))})
    return _sheet(ledger, "Crater", "Crater and particle", [said], lines)


def resistance(ledger: Ledger, cases: Sequence[CaseSheet]) -> SheetPlan:
    """Beta by three routes, grain strengths, centerline stress, strain rate."""
    words = [{"slug": c.slug, "sheet": c.name, "R_t": c.named("R_t")} for c in cases]
    return _sheet(ledger, "Resistance", "Target resistance", [], lines_of("resistance", *words))


def frank_zook(ledger: Ledger) -> SheetPlan:
    """Eq. 16 as it is printed, and as it follows from Eqs. 14 and 15."""
    said = (
        "Eqs. 14 and 15, integrated from V to rest, give the right side of Eq. 16 for the depth in "
        "diameters, X/D. Eq. 16 prints X/R in front of it. Both readings stand here: the derived "
        "one is twice the printed one."
    )
    logarithms = {f"log_{which}": log1p(f"{{{which}_pressure}}") for which in ("rha", "lower")}
    heading = "Frank-Zook depth of a noneroding penetrator"
    return _sheet(ledger, "Frank-Zook", heading, [said], lines_of("frank_zook", logarithms))

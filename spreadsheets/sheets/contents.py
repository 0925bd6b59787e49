"""The sheet `Contents`: what the workbook is, where things stand, and the headline results."""

from collections.abc import Sequence

from spreadsheets.plan import Cell, SheetPlan
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.inputs import INPUTS

__all__ = ["AUTHOR", "REPORT", "coarse_name", "sheet"]

AUTHOR = "W. S. de Rosset"
REPORT = "Modeling Impacts for Cold-Gas Dynamic Spray"

_ABOUT = (
    f"Replication of {AUTHOR}, “{REPORT}” (2006), as live formulas.",
    "Every formula is stored with the value that Python computed for it, with all its digits,",
    "so a viewer that cannot calculate shows the same numbers as a spreadsheet program that does.",
)
_HOW = (
    ("input", "Blue on yellow: an input. Change it on the sheet Inputs and every sheet follows."),
    ("inferred", "Blue on orange: an input that the report never prints, inferred from others."),
    ("number", "Black: a formula."),
    ("printed", "Gray: the report's own text, for its own inputs. It does not follow a change."),
)


def sheet(cases: tuple[CaseSheet, ...], names: Sequence[str]) -> SheetPlan:
    """The first sheet, for these cases and the other sheets' names."""
    cells = {"A1": Cell(text=f"{REPORT}: the model as a workbook", style="title")}
    for row, text in enumerate(_ABOUT, start=2):
        cells[f"A{row}"] = Cell(text=text, style="body")
    cells |= _headline(cases, 6)
    described = _described(cases)
    sheets = [(name, described[name]) for name in names]
    top = 8 + len(cases)
    cells[f"A{top}"] = Cell(text="Sheets", style="block")
    for row, (name, what) in enumerate(sheets, start=top + 1):
        cells[f"A{row}"] = Cell(text=name, style="link", link=(name, "A1"))
        cells[f"B{row}"] = Cell(text=what, style="text")
    top += len(sheets) + 2
    cells[f"A{top}"] = Cell(text="How to read it", style="block")
    for row, (style, what) in enumerate(_HOW, start=top + 1):
        cells[f"A{row}"] = Cell(text="1.23", style=f"{style} sample")
        cells[f"B{row}"] = Cell(text=what, style="text")
    widths = {"A": 23.0, "B": 20.0, "C": 19.0, "D": 20.0, "E": 19.0, "F": 20.0}
    return SheetPlan(name="Contents", cells=cells, widths=widths)


def _headline(cases: tuple[CaseSheet, ...], row: int) -> dict[str, Cell]:
    heads = ("Final depth [µm]", "The report prints", "Normalized depth", "The report prints")
    cells = {f"A{row}": Cell(text="Headline results", style="head")}
    for column, head in zip("BCDE", heads, strict=True):
        cells[f"{column}{row}"] = Cell(text=head, style="head right")
    for at, case in enumerate(cases, start=row + 1):
        cells[f"A{at}"] = Cell(text=case.name, style="link", link=(case.name, "A1"))
        for column, what, unit in (("B", "depth_um", "µm"), ("D", "normalized_depth", "1")):
            cells[f"{column}{at}"] = Cell(
                key=f"contents.{case.slug}.{what}",
                formula=f"={case.named(what)}",
                style="result",
                number_format="0.0000",
                unit=unit,
                source="Section 3, below Eq. 13",
            )
        for column, text in zip("CE", case.printed, strict=True):
            if text:
                cells[f"{column}{at}"] = Cell(text=text, style="printed")
    return cells


def _described(cases: tuple[CaseSheet, ...]) -> dict[str, str]:
    """What each sheet is, by name."""
    rows = "All rows of the midpoint scheme down to the stop, and its final depth (appendix)"
    coarse = "The same with the coarser time step, and what that changes (section 3)"
    described = {
        "Inputs": "Every physical number, with unit, name, source, limits and the report’s value",
        "Table A-1": "The five rows that the report’s appendix prints, cell for cell",
        "Table A-1 check": "Printed, computed in full, and the difference in the last digit",
        "Figure 3": "Depth against time, with its chart",
        "Figure 5": "Normalized depth against velocity, with its chart (section 4)",
        "Convergence": "Final depth at eight time steps against the depth at rest, with its chart",
        "Frank-Zook": "Eq. 16 as printed and as derived (Eqs. 14-17)",
        "Crater": "Section 2: crater volume, depth and contact diameter; particle velocities",
        "Resistance": "β by three routes, grain strengths, centerline stress, strain rate",
        "Equations": "Constants that the equations print, from geometry; what section 4 compares",
        "Audit": "Every printed number: interval, computed value, verdict, and the cell to look at",
    }
    for case in cases:
        described[case.name] = rows
        described[coarse_name(case.name)] = coarse
    return described


def coarse_name(name: str) -> str:
    """The name of the sheet that repeats a case with the coarser step.

    >>> coarse_name("Sheet beta 3")
    'Sheet beta 3, 0.5 ns'
    """
    return f"{name}, {INPUTS['dt_coarse'].printed}"

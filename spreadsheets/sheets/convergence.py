"""The sheet `Convergence`: final depth at a ladder of time steps against the depth at rest."""

from collections.abc import Sequence

from spreadsheets.plan import Cell, Chart, Rule, Series, SheetPlan
from spreadsheets.sheets.case import CaseSheet

__all__ = ["CURRENT", "LEVELS", "NO_ORDER", "STALE", "sheet"]

LEVELS = 8
"""Steps of the ladder, each half of the one before; the fifth is the step dt_s as written."""

CURRENT = "The inputs are those of these runs."
STALE = "THE INPUTS HAVE CHANGED since these runs: write the workbook again to renew them."
NO_ORDER = "–"

_FIRST = 8
_LAST = _FIRST + LEVELS - 1
_NOTES = (
    "Gray: computed by coldspray when the workbook was written, not live: each is the result of a "
    "whole sheet with that time step.",
    "Black: live. Error: final depth minus depth at rest. Order: of the error against the line "
    "above; the scheme is of first order (the report’s midpoint takes the initial velocity).",
)
_SAME = "1000000000"
"""Depths at rest that agree to one part in this are of the same inputs."""

_COLUMNS = (("C", "D", "E", "F", "G"), ("H", "I", "J", "K", "L"))
_HEADS = (
    ("Steps", "", "steps", "0"),
    ("Final depth", "µm", "depth_um", "0.000000"),
    ("Error", "µm", "error", "0.000000"),
    ("|Error|", "µm", "size", "0.0E+00"),
    ("Order", "–", "order", "0.00"),
)


def sheet(cases: Sequence[CaseSheet]) -> SheetPlan:
    """The sheet for the cases, side by side."""
    cells = {"A1": Cell(text="Convergence with the time step", style="title")}
    for row, note in enumerate(_NOTES, start=2):
        cells[f"A{row}"] = Cell(text=note, style="note")
    cells |= _ladder()
    rules, series = [], []
    for columns, case in zip(_COLUMNS, cases, strict=False):
        cells |= _case(case, columns)
        message = f"{columns[0]}{_LAST + 3}"
        rules.append(Rule(cells=message, formula=f'={message}="{STALE}"', style="warning"))
        error = columns[3]
        series.append(Series(case.name, f"B{_FIRST}:B{_LAST}", f"{error}{_FIRST}:{error}{_LAST}"))
    chart = Chart(
        at=f"A{_LAST + 5}",
        title="Error of the final depth against the time step",
        x_title="Time step [ns]",
        y_title="|final depth - depth at rest| [µm]",
        series=tuple(series),
        logarithmic=True,
    )
    return SheetPlan(
        name="Convergence",
        cells=cells,
        widths=dict.fromkeys("ABCDEFGHIJKL", 12.0),
        rules=tuple(rules),
        charts=(chart,),
        print_area=f"A1:L{_LAST + 30}",
    )


def _ladder() -> dict[str, Cell]:
    cells = {}
    for column, unit in (("A", "s"), ("B", "ns")):
        cells[f"{column}{_FIRST - 2}"] = Cell(text="Time step", style="head right")
        cells[f"{column}{_FIRST - 1}"] = Cell(text=unit, style="unit right")
    for k in range(LEVELS):
        row = _FIRST + k
        cells[f"A{row}"] = Cell(
            key=f"convergence.step[{k}]", style="printed", number_format="0.00E+00"
        )
        cells[f"B{row}"] = Cell(
            key=f"convergence.step_ns[{k}]",
            formula=f"=A{row}*1000000000",
            style="number",
            number_format="0.0000",
        )
    cells[f"A{_LAST + 1}"] = Cell(text="Depth at rest", style="body")
    cells[f"A{_LAST + 2}"] = Cell(text="the same, live", style="body")
    return cells


def _case(case: CaseSheet, columns: Sequence[str]) -> dict[str, Cell]:
    part, depth = f"convergence.{case.slug}", columns[1]
    rest, live = f"{depth}{_LAST + 1}", f"{depth}{_LAST + 2}"
    difference = f"ABS({live}-{rest})*{_SAME}"
    cells = {
        f"{columns[0]}{_FIRST - 3}": Cell(text=case.name, style="block"),
        rest: Cell(key=f"{part}.rest_um", style="printed", number_format="0.000000"),
        live: Cell(
            key=f"{part}.rest_live_um",
            formula=f"={case.named('exact_depth_um')}",
            style="number",
            number_format="0.000000",
            unit="µm",
            source="Eq. 13 separated",
            transcendental=True,
        ),
        f"{columns[0]}{_LAST + 3}": Cell(
            key=f"{part}.message",
            formula=(
                f'=IF(ISNUMBER({live}),IF({difference}<={rest},"{CURRENT}","{STALE}"),"{STALE}")'
            ),
            style="message",
        ),
    }
    for column, (head, unit, _, _) in zip(columns, _HEADS, strict=True):
        cells[f"{column}{_FIRST - 2}"] = Cell(text=head, style="head right")
        if unit:
            cells[f"{column}{_FIRST - 1}"] = Cell(text=unit, style="unit right")
    for k in range(LEVELS):
        cells |= _level(k, part, columns, rest)
    return cells


def _level(k: int, part: str, columns: Sequence[str], rest: str) -> dict[str, Cell]:
    row = _FIRST + k
    _, depth, error, _, _ = columns
    formulas = {"error": f"={depth}{row}-{rest}", "size": f"=ABS({error}{row})"}
    if k:
        above, here = f"{error}{row - 1}", f"{error}{row}"
        steps = f"LN(A{row - 1}/A{row})"
        order = f"LN({above}/{here})/{steps}"
        formulas["order"] = f'=IF({above}*{here}>0,{order},"{NO_ORDER}")'
    return {
        f"{column}{row}": Cell(
            key=f"{part}.{what}[{k}]",
            formula=formulas.get(what, ""),
            style="number" if what in formulas else "printed",
            number_format=shown,
            transcendental=what == "order",
        )
        for column, (_, _, what, shown) in zip(columns, _HEADS, strict=True)
        if what != "order" or k
    }

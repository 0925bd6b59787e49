"""Tables that repeat another one, though the workbook tells that another beta was meant.

Two equal tables are no fault. But if a head says another beta, or if a cell that is called beta or
target resistance is read by no table, then one of them reads a cell that is not its own.
"""

import math
import re
from collections.abc import Iterator, Sequence

from replication.check.examination import Examination, Input
from replication.check.inputs import as_role, report_inputs
from replication.check.table import Table, address
from replication.check.words import quantity, title
from spreadsheets.foreign import Position

_ABOVE = 6
"""How far above its first row a table's title may stand."""
_BLOCK = 3
"""Cells that are not further from each other may stand in one list of inputs."""
_BETA = re.compile(r"(?:\bbeta|β) ?[=:]? ?(\d+(?:\.\d+)?)", re.IGNORECASE)


def meant(tables: Sequence[Examination], beside: Sequence[Input]) -> dict[int, tuple[float, str]]:
    """The target resistance [Pa] that tables by number should have, and what tells so.

    `beside` are all numbers beside the tables.
    """
    alike: dict[object, list[int]] = {}
    for number, f in enumerate(tables):
        if _source(f):
            alike.setdefault((_source(f), f.case, f.rows("depth", 4)), []).append(number)
    told: dict[int, tuple[float, str]] = {}
    for group in (numbers for numbers in alike.values() if len(numbers) > 1):
        f, source = tables[group[0]], _source(tables[group[0]])
        own = f.inputs.get("flow_stress")
        stress = own.si if own else report_inputs()["flow_stress"][0]
        what, heads = "head", {number: _said(_heads(tables[number].table)) for number in group}
        if len(set(heads.values())) == 1:
            what = "sheet's name"
            heads = {number: _said([tables[number].table.sheet]) for number in group}
        by_head = {
            number: (beta * stress, f"its {what} says beta {beta:g}")
            for number, beta in heads.items()
            if beta and len(set(heads.values())) > 1 and _differ(beta * stress, f)
        }
        told |= by_head
        for cell in () if by_head else _idle(f, beside):
            assert cell.place is not None
            assert source is not None
            # The table that it stands nearest to, compared with the cell that is read; or the last.
            off = {
                number: _apart(cell.place, table) - _apart(source, table)
                for number in reversed(group)
                if cell.place[0] in (source[0], (table := tables[number].table).sheet)
            }
            number = min(off, key=lambda number: off[number], default=group[0])
            resistance = cell.si * (stress if cell.role == "beta" else 1.0)
            if off.get(number, math.inf) <= _BLOCK and _differ(resistance, f):
                where, value = address(cell.place, True), quantity(cell.si, cell.role)
                says = f"{title(cell.role)} in {where}, {value}, is read by no table"
                told.setdefault(number, (resistance, says))
    return told


def _source(f: Examination) -> Position | None:
    """The cell of the target resistance, or of beta, that a table reads."""
    cells = (f.inputs[role].place for role in ("resistance", "beta") if role in f.inputs)
    return next(filter(None, cells), None)


def _differ(resistance: float, f: Examination) -> bool:
    return not math.isclose(resistance, f.case.resistance, rel_tol=1e-6)


def _said(texts: Sequence[str]) -> float | None:
    """The beta that some texts say, if it is one."""
    said = {float(number) for text in texts for number in _BETA.findall(text)}
    return said.pop() if len(said) == 1 else None


def _heads(table: Table) -> list[str]:
    """The texts that stand above a table."""
    top, left, _, right = _box(table)
    return [
        text
        for (sheet, row, column), text in table.calculation.values.items()
        if sheet == table.sheet and top - _ABOVE <= row <= top and left - 1 <= column <= right
        if isinstance(text, str)
    ]


def _box(table: Table) -> tuple[int, int, int, int]:
    """The first row and column of a table, and the last."""
    _, rows, columns = zip(*table.places, strict=True)
    return min(rows), min(columns), max(rows), max(columns)


def _apart(place: Position, table: Table) -> float:
    """How many rows and columns a cell is away from a table."""
    top, left, bottom, right = _box(table)
    sheet, row, column = place
    if sheet != table.sheet:
        return 1e6
    return max(top - row, row - bottom, 0) + max(left - column, column - right, 0)


def _idle(f: Examination, beside: Sequence[Input]) -> Iterator[Input]:
    """Cells called resistance that nothing reads; called beta that nothing but those reads."""
    formulas, idle = f.calculation.formulas, set[Position]()
    for role in ("resistance", "beta"):
        readers = formulas.keys() - idle
        read = {area.corner for place in readers for area in formulas[place].areas}
        for cell in beside:
            if cell.roles == {role} and cell.place and cell.place not in read:
                idle.add(cell.place)
                yield as_role(cell, role, report_inputs())

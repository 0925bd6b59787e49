"""Tables that repeat another one, though the workbook tells that another beta was meant.

Two equal tables are no fault. But if a head says another beta, or if a cell that is called beta or
target resistance is read by no table, then one of them reads a cell that is not its own.
"""

import math
import re
from collections.abc import Iterator, Mapping, Sequence

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
        f = tables[group[0]]
        own = f.inputs.get("flow_stress")
        stress = own.si if own else report_inputs()["flow_stress"][0]
        by_head = _by_head(tables, group, stress)
        told |= by_head
        for cell in () if by_head else _idle(f, beside):
            resistance = cell.si * (stress if cell.role == "beta" else 1.0)
            # Where two are as near, it is the last that was copied from the first.
            nearest = _nearest(cell, f, {n: tables[n].table for n in reversed(group)})
            if cell.place and nearest is not None and _differ(resistance, f):
                where, value = address(cell.place, True), quantity(cell.si, cell.role)
                says = f"{title(cell.role)} in {where}, {value}, is read by no table"
                told.setdefault(nearest, (resistance, says))
    return told


def _by_head(
    tables: Sequence[Examination], group: Sequence[int], stress: float
) -> dict[int, tuple[float, str]]:
    """The tables of a group whose head, or sheet's name, says another beta than their rows have."""
    for what, texts in (("head", _heads), ("sheet's name", lambda table: [table.sheet])):
        heads = {number: _said(texts(tables[number].table)) for number in group}
        if len(set(heads.values())) > 1:
            return {
                number: (beta * stress, f"its {what} says beta {beta:g}")
                for number, beta in heads.items()
                if beta and _differ(beta * stress, tables[number])
            }
    return {}


def _nearest(cell: Input, f: Examination, group: Mapping[int, Table]) -> int | None:
    """The table to which a cell is nearest, compared with the cell that is read; or the first."""
    source, place = _source(f), cell.place
    assert source is not None
    assert place is not None
    off = {
        number: _apart(place, table) - _apart(source, table)
        for number, table in group.items()
        if place[0] in (source[0], table.sheet)
    }
    number = min(off, key=lambda number: off[number], default=None)
    return None if number is None or off[number] > _BLOCK else number


def _source(f: Examination) -> Position | None:
    """The cell of the target resistance, or of beta, that a table reads."""
    cells = (f.inputs[role].place for role in ("resistance", "beta") if role in f.inputs)
    return next(filter(None, cells), None)


def _differ(resistance: float, f: Examination) -> bool:
    """Whether a resistance is possible, and another one than the rows have."""
    return 0 < resistance < 1e100 and not math.isclose(resistance, f.case.resistance, rel_tol=1e-6)


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

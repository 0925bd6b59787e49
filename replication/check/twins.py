"""Tables that repeat another one, though a cell beside them tells that another input was meant.

Two equal tables are no fault. But if a cell that is called velocity or step has another value, or
one called beta or target resistance that of the report's other case, and nothing reads it (of the
latter: no table), then one table reads a cell that is not its own.
"""

from collections.abc import Sequence

from replication.check.examination import Examination, Input, near
from replication.check.inputs import as_role, report_inputs
from replication.check.scheme import Case
from replication.check.table import Table, address
from replication.check.words import quantity, title
from spreadsheets.foreign import Position

_BLOCK = 3
"""By so many cells an input may be further from its table than the one that is read by mistake."""


def meant(
    tables: Sequence[Examination], beside: Sequence[Input]
) -> dict[int, tuple[str, float, str]]:
    """The input that tables by number should have: role, value in SI, and what tells so.

    `beside` are all numbers beside the tables.
    """
    told: dict[int, tuple[str, float, str]] = {}
    by_tables = set().union(*(f.read for f in tables))
    formulas = tables[0].calculation.formulas.values()
    by_any = by_tables | {area.corner for formula in formulas for area in formula.areas}
    for role in ("resistance", "velocity", "step"):
        # Velocities and steps may be of curves and of other results; a resistance is of a table.
        read = by_tables if role == "resistance" else by_any
        alike: dict[tuple[Position, Case, float | None], list[int]] = {}
        for number, f in enumerate(tables):
            names = (role, "beta") if role == "resistance" else (role,)
            cells = (f.inputs[name].place for name in names if name in f.inputs)
            if source := next(filter(None, cells), None):
                alike.setdefault((source, f.case, f.rows("depth", 4)), []).append(number)
        for (source, *_), numbers in alike.items():
            f = tables[numbers[0]]
            idle = (
                as_role(cell, name, report_inputs())
                for name in names
                for cell in beside
                if len(numbers) > 1 and cell.roles == {name}
            )
            for cell in idle:
                place, value = cell.place, cell.si
                if place is None or place in read:
                    continue
                if cell.role == "beta":
                    stress = f.inputs.get("flow_stress")
                    value *= stress.si if stress else report_inputs()["flow_stress"][0]
                # A resistance or a beta may be of another model, unless the report prints it.
                is_printed = any(near(value, each) for each in report_inputs()[role])
                owner = _owner(place, source, {number: tables[number].table for number in numbers})
                if owner is None or (role == "resistance" and not is_printed):
                    continue
                if not near(value, getattr(f.case, role)):
                    where = f"{address(place, True)}, {quantity(cell.si, cell.role)}"
                    says = f"{title(cell.role)} in {where}, is read by no table"
                    told.setdefault(owner, (role, value, says))
    return told


def _owner(place: Position, source: Position, tables: dict[int, Table]) -> int | None:
    """The table by number to which an idle cell belongs, None if it is far from all.

    It is the nearest, compared with the cell that is read, `source`; of several the last, which was
    copied from the first.
    """
    off = {
        number: _apart(place, table) - _apart(source, table)
        for number, table in reversed(tables.items())
        if place[0] in (source[0], table.sheet)
    }
    nearest = min(off, key=off.__getitem__, default=None)
    return None if nearest is None or off[nearest] > _BLOCK else nearest


def _apart(place: Position, table: Table) -> int:
    """How many rows and columns a cell is away from a table; very many on another sheet."""
    if place[0] != table.sheet:
        return 10**6
    _, rows, columns = zip(*table.places, strict=True)
    pairs = ((place[1], rows), (place[2], columns))
    return sum(max(min(numbers) - at, at - max(numbers), 0) for at, numbers in pairs)

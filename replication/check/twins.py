"""Tables that repeat another one, though a cell beside them tells that another input was meant.

Two equal tables are no fault. But if a cell that is called velocity or step has another value, or
one called beta or target resistance that of the report's other case, and nothing calculates with
it, then one table reads a cell that is not its own.
"""

from collections.abc import Iterator, Sequence

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
    # Whoever reads one cell alone takes it over, as summaries do, and does not calculate with it.
    several = [formula for formula in formulas if len(formula.areas) > 1]
    products = {cell.place for cell in beside if cell.roles == {"resistance"}}
    by_most = by_tables | {a.corner for f in several if f.place not in products for a in f.areas}
    by_most |= {a.corner for f in several if f.place in products & by_most for a in f.areas}
    for role, names in _CALLED.items():
        read = by_most if role == "resistance" else by_any
        called = ((cell, name) for name in names for cell in beside if cell.roles == {name})
        idle = [(place, as_role(cell, name, report_inputs())) for cell, name in called
                if (place := cell.place) and place not in read]  # fmt: skip
        for source, alike in _repeating(tables, names):
            for place, cell in idle:
                number, value = _owner(place, source, alike), cell.si
                if cell.role == "beta":  # the resistance that follows from it
                    stress = next(iter(alike.values())).inputs.get("flow_stress")
                    value *= stress.si if stress else report_inputs()["flow_stress"][0]
                # A resistance or a beta may be of another model, unless the report prints it.
                is_its = role != "resistance" or any(near(value, x) for x in report_inputs()[role])
                if number is None or not is_its or near(value, getattr(alike[number].case, role)):
                    continue
                where = f"{address(place, True)}, {quantity(cell.si, cell.role)}"
                says = f"{title(cell.role)} in {where}, is read by no table"
                told.setdefault(number, (role, value, says))
    return told


_CALLED = {"resistance": ("resistance", "beta"), "velocity": ("velocity",), "step": ("step",)}
"""By which names a cell tells an input."""


def _repeating(
    tables: Sequence[Examination], names: Sequence[str]
) -> Iterator[tuple[Position, dict[int, Examination]]]:
    """The cell that several equal tables read for an input of these names, and the tables."""
    alike: dict[tuple[Position, Case, float | None], dict[int, Examination]] = {}
    for number, f in enumerate(tables):
        cells = (f.inputs[name].place for name in names if name in f.inputs)
        if source := next(filter(None, cells), None):
            alike.setdefault((source, f.case, f.rows("depth", 4)), {})[number] = f
    return ((source, equal) for (source, *_), equal in alike.items() if len(equal) > 1)


def _owner(place: Position, source: Position, tables: dict[int, Examination]) -> int | None:
    """The table by number to which an idle cell belongs, None if it is far from all.

    It is the nearest, compared with the cell that is read, `source`; of several the last, which was
    copied from the first.
    """
    off = {
        number: _apart(place, f.table) - _apart(source, f.table)
        for number, f in reversed(tables.items())
        if place[0] in (source[0], f.table.sheet)
    }
    near_by = [number for number in off if off[number] <= _BLOCK]
    return min(near_by, key=off.__getitem__, default=None)


def _apart(place: Position, table: Table) -> int:
    """How many rows and columns a cell is away from a table; very many on another sheet."""
    if place[0] != table.sheet:
        return 10**6
    _, rows, columns = zip(*table.places, strict=True)
    pairs = ((place[1], rows), (place[2], columns))
    return sum(max(min(numbers) - at, at - max(numbers), 0) for at, numbers in pairs)

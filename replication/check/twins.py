"""Tables that repeat another table although a cell beside them holds another input for them.

Two equal tables are no fault. But suppose that a cell labelled velocity or step holds another
value, or one labelled beta or target resistance holds that of the report's other case, and that
nothing calculates with this cell. Then one of the tables reads an input that is not its own.
"""

from collections.abc import Iterator, Sequence

from replication.check.examination import Examination, Input, near
from replication.check.inputs import as_role, report_inputs
from replication.check.scheme import Case
from replication.check.table import Table, address
from replication.check.words import quantity, title
from spreadsheets.foreign import Position

_BLOCK = 3
"""By how many cells an unread input may be further from its table than the input read instead."""
_LABELS = {"resistance": ("resistance", "beta"), "velocity": ("velocity",), "step": ("step",)}
"""The inputs by which tables may differ, and the labels of cells that hold them."""


def meant(
    tables: Sequence[Examination], beside: Sequence[Input]
) -> dict[int, tuple[str, float, str]]:
    """Return, by number of the table, the input that it should have instead of the one it reads.

    Each is a role, a value in SI units and a text that says where it stands. `beside` are all
    numbers beside the tables.
    """
    intended: dict[int, tuple[str, float, str]] = {}
    by_tables = set().union(*(exam.read for exam in tables))
    calculation = tables[0].calculation
    read_by = {place: calculation.corners(place) for place in calculation.formulas}
    by_any = by_tables.union(*read_by.values())
    # A formula that reads a single cell only shows it, as summaries do. So does a product of beta
    # and flow stress that is itself not used.
    several = {place: cells for place, cells in read_by.items() if len(cells) > 1}
    products = {cell.place for cell in beside if cell.roles == {"resistance"}}
    by_most = by_tables.union(*(several[place] for place in several.keys() - products))
    by_most = by_most.union(*(several[place] for place in several.keys() & products & by_most))
    for role, names in _LABELS.items():
        read = by_most if role == "resistance" else by_any
        labelled = ((cell, name) for name in names for cell in beside if cell.roles == {name})
        idle = [(place, as_role(cell, name, report_inputs())) for cell, name in labelled
                if (place := cell.place) and place not in read]  # fmt: skip
        for source, alike in _repeating(tables, names):
            for place, cell in idle:
                number, value = _owner(place, source, alike), cell.si
                if cell.role == "beta":  # compare the resistance that follows from it
                    stress = next(iter(alike.values())).inputs.get("flow_stress")
                    value *= stress.si if stress else report_inputs()["flow_stress"][0]
                # A resistance or beta that the report does not print may belong to another model.
                is_its = role != "resistance" or any(near(value, x) for x in report_inputs()[role])
                if number is None or not is_its or near(value, getattr(alike[number].case, role)):
                    continue
                where = f"{address(place, True)}, {quantity(cell.si, cell.role)}"
                text = f"{title(cell.role)} in {where}, is read by no table"
                intended.setdefault(number, (role, value, text))
    return intended


def _repeating(
    tables: Sequence[Examination], names: Sequence[str]
) -> Iterator[tuple[Position, dict[int, Examination]]]:
    """Yield each cell that several equal tables read for one of these inputs, and the tables."""
    alike: dict[tuple[Position, Case, float | None], dict[int, Examination]] = {}
    for number, exam in enumerate(tables):
        cells = (exam.inputs[name].place for name in names if name in exam.inputs)
        if source := next(filter(None, cells), None):
            alike.setdefault((source, exam.case, exam.rows("depth", 4)), {})[number] = exam
    return ((source, equal) for (source, *_), equal in alike.items() if len(equal) > 1)


def _owner(place: Position, source: Position, tables: dict[int, Examination]) -> int | None:
    """Return the number of the table to which an idle cell belongs, None if it is far from all.

    That is the table nearest to the cell, relative to its distance from `source`, the cell that is
    read instead. Of several it is the last, as people copy the first table to make the others.
    """
    excess = {
        number: _distance(place, exam.table) - _distance(source, exam.table)
        for number, exam in reversed(tables.items())
        if place[0] in (source[0], exam.table.sheet)
    }
    nearest = min(excess, key=excess.__getitem__, default=None)
    return nearest if nearest is not None and excess[nearest] <= _BLOCK else None


def _distance(place: Position, table: Table) -> int:
    """Return the rows plus columns between a cell and a table; very many on another sheet."""
    if place[0] != table.sheet:
        return 10**6
    _, rows, columns = zip(*table.places, strict=True)
    pairs = ((place[1], rows), (place[2], columns))
    return sum(max(min(numbers) - at, at - max(numbers), 0) for at, numbers in pairs)

"""Numbers that no table reads, such as the inputs of pasted rows, and the table they belong to."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from replication.check.fit import TableFit
from replication.check.roles import recognize
from replication.check.table import SchemeTable
from replication.check.units import equations, state_units
from spreadsheets.evaluate import Evaluator
from spreadsheets.foreign import Position

_MOST_IDLE = 5_000
"""So many numbers that no table reads are looked at."""
_MOST_BESIDE = 500
"""So many of them may belong to one table."""
_MOST_UNUSED = 100
"""So many formulas that no table reads are looked at."""
_FEW = 64
"""Of larger ranges the cells are not looked at."""
_OF_TABLE = frozenset({"D", "G", "H", "c = dt", "e = dt", "t = dt", "V"})
"""The equations between a table and its inputs; others are between inputs alone."""


@dataclass(frozen=True)
class Idle:
    """The numbers of a workbook that stand in no table, and what its tables read.

    `unread` are those that no table reads, `typed` those without a formula; `sheets` are the sheets
    that each table reads, besides its own.
    """

    evaluator: Evaluator
    tables: Sequence[tuple[SchemeTable, TableFit]]
    unread: Sequence[Position]
    typed: Sequence[Position]
    sheets: Mapping[SchemeTable, frozenset[str]]


def numbers_apart(evaluator: Evaluator, tables: Sequence[tuple[SchemeTable, TableFit]]) -> Idle:
    """Find the numbers that stand in no table, and those of them that no table reads."""
    lined = {place for table, _ in tables for place in _lined(table)}
    read, sheets = set[Position](), dict[SchemeTable, frozenset[str]]()
    for table, _ in tables:
        own = _read_by(table, lined)
        read |= own
        sheets[table] = frozenset(place[0] for place in own) - {table.sheet}
    apart = [p for p, v in evaluator.values.items() if type(v) is float and p not in lined]
    unread = [place for place in apart if place not in read]
    typed = [place for place in apart if place not in evaluator.formulas]
    return Idle(evaluator, tables, unread[:_MOST_IDLE], typed, sheets)


def _lined(table: SchemeTable) -> set[Position]:
    """The cells of a table and of the lines beside it."""
    helpers = (line.place(i) for line in table.helpers for i in line.values)
    return {*table.places, *helpers}


def _read_by(table: SchemeTable, lined: set[Position]) -> set[Position]:
    """The cells that a table reads, directly or not; of a large range, its first cell."""
    formulas = table.evaluator.formulas
    read, waiting = set[Position](), [p for p in _lined(table) if p in formulas]
    seen = set(waiting)
    while waiting:
        for area in table.evaluator.areas(waiting.pop()):
            for cell in area.places() if area.cells <= _FEW else [area.corner]:
                read.add(cell)
                if cell in formulas and cell not in lined and cell not in seen:
                    seen.add(cell)
                    waiting.append(cell)
    return read


def unused_formulas(idle: Idle, table: SchemeTable) -> list[Position]:
    """The formulas on the sheet of a table that no table reads: of a mass, say."""
    formulas = idle.evaluator.formulas
    return [p for p in idle.unread if p in formulas and p[0] == table.sheet][:_MOST_UNUSED]


def typed_beside(idle: Idle, table: SchemeTable) -> list[Position]:
    """The typed numbers on the sheet of a table that stand in no table."""
    return [place for place in idle.typed if place[0] == table.sheet][:_MOST_BESIDE]


def idle_inputs(idle: Idle, table: SchemeTable, names: Mapping[Position, str]) -> list[Position]:
    """The typed numbers that nothing reads and that may be inputs of a table.

    A sheet with tables is theirs; another one belongs to the tables that read it, or to all if none
    does. Nothing links numbers that were pasted to a cell but the cell's label. So where several
    tables may own a sheet, pasted rows do only if its numbers agree with no other table better, and
    with them in more than half of what can be tested.
    """
    formulas = idle.evaluator.formulas
    sheets: dict[str, list[Position]] = {}
    for place in idle.unread:
        if place not in formulas:
            sheets.setdefault(place[0], []).append(place)
    own: list[Position] = []
    for sheet, places in sheets.items():
        owners = _owners(idle, sheet)
        if table not in (owner for owner, _ in owners):
            continue
        fitted = next(fit for owner, fit in owners if owner is table)
        if len(owners) > 1 and fitted.probe is None:
            shares = {o: _agreement(o, fit, names, places) for o, fit in owners}
            if shares[table] <= 0.5 or shares[table] < max(shares.values()):
                continue
        own += places
    return own[:_MOST_BESIDE]


def _owners(idle: Idle, sheet: str) -> list[tuple[SchemeTable, TableFit]]:
    """The tables to which the numbers of a sheet may belong."""
    on_it = [entry for entry in idle.tables if entry[0].sheet == sheet]
    readers = [entry for entry in idle.tables if sheet in idle.sheets[entry[0]]]
    return on_it or readers or list(idle.tables)


def _agreement(
    table: SchemeTable, fitted: TableFit, names: Mapping[Position, str], places: Sequence[Position]
) -> float:
    """The share of the equations between a table and some cells that hold up to units."""
    inputs = recognize(table, fitted, {}, names, places)
    state_units(table, inputs)
    rests = [
        (eq.residual(inputs.powers), eq.slack)
        for eq in equations(table, fitted, inputs)
        if eq.name in _OF_TABLE
    ]
    good = sum(abs(rest - round(rest)) <= slack for rest, slack in rests)
    return good / len(rests) if rests else 0.0

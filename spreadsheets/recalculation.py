"""A book -> every formula's value, computed afresh in bounded time.

The engine is IronCalc: the lightest of those that pip installs, and it gives the doubles that other
engines give. It never sees the file, only formulas that were read and found harmless; whatever else
a cell holds stands there as the value stored.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from spreadsheets.foreign import Book, Position, Value
from spreadsheets.references import Area, Formula, parse

MAX_WORK = 20_000_000
"""Cells that all formulas together may read: some seconds of an engine's time."""


@dataclass(frozen=True)
class Calculation:
    """A book, its formulas parsed, and the value of every cell.

    `values` holds what each cell is worth: computed where that was possible, stored where not.
    `uncomputed` gives the reason for each formula that was not computed.
    """

    book: Book
    formulas: Mapping[Position, Formula]
    values: Mapping[Position, Value]
    uncomputed: Mapping[Position, str] = field(default_factory=dict)

    def number(self, place: Position | None) -> float | None:
        """The value of a cell, if it is a number."""
        value = None if place is None else self.values.get(place)
        return float(value) if isinstance(value, float) else None

    def error(self, place: Position) -> str | None:
        """The error that a formula gives, but for #N/A, which people let it give on purpose."""
        value = self.values.get(place)
        if place in self.formulas and isinstance(value, str) and value.startswith("#"):
            return None if value == "#N/A" else value
        return None

    @cached_property
    def named(self) -> dict[Position, str]:
        """The cells that have a name, with it."""
        sheets = {name.upper(): name for name in self.book.sheets}
        here = (next(iter(self.book.sheets)), 1, 1)
        found = {}
        for name, meaning in self.book.names.items():
            areas = parse(f"={meaning}", here, sheets, {}).areas
            if len(areas) == 1 and areas[0].cells == 1:
                found[areas[0].corner] = name.rpartition("!")[2]
        return found

    @cached_property
    def order(self) -> dict[Position, int]:
        """The rank of each formula in order of calculation: precedents before what reads them.

        Cells that read each other in a circle come in no particular order.
        """
        order: dict[Position, int] = {}
        for place in self.formulas:
            stack = [(place, False)]
            started: set[Position] = set()
            while stack:
                here, done = stack.pop()
                if here in order:
                    continue
                if done:
                    order[here] = len(order)
                elif here not in started:
                    started.add(here)
                    stack.append((here, True))
                    stack.extend((before, False) for before in self.precedents(here)[::-1])
        return order

    def precedents(self, place: Position) -> list[Position]:
        """The formula cells that a formula reads, as far as it names them."""
        formula = self.formulas.get(place)
        return [] if formula is None else [p for a in formula.areas for p in self.within(a)]

    def within(self, area: Area) -> list[Position]:
        """The formula cells of an area."""
        if area.cells <= 64:
            return [place for place in area.places() if place in self.formulas]
        return [
            (area.sheet, row, column)
            for column, rows in self._by_column.get(area.sheet, {}).items()
            if area.left <= column <= area.right
            for row in rows
            if area.top <= row <= area.bottom
        ]

    @cached_property
    def _by_column(self) -> dict[str, dict[int, list[int]]]:
        found: dict[str, dict[int, list[int]]] = {}
        for sheet, row, column in self.formulas:
            found.setdefault(sheet, {}).setdefault(column, []).append(row)
        return found


def calculate(book: Book) -> Calculation:
    """Compute a book's formulas, all but those that are refused."""
    sheets = {name.upper(): name for name in book.sheets}
    names = {name.upper(): meaning for name, meaning in book.names.items()}
    formulas = {
        place: parse(cell.formula, place, sheets, names)
        for place, cell in book.cells()
        if cell.formula
    }
    refused = _refused(book, formulas)
    computed = _computed(book, formulas, refused)
    values = {place: cell.value for place, cell in book.cells() if cell.value is not None}
    reasons = dict(refused)
    for place, value in computed.items():
        stored = book[place]
        wrong = isinstance(value, str) and value.startswith("#")
        if wrong and stored.value is not None and not stored.error:
            # An engine's error beside a value that its author saw says that the engine cannot.
            reasons[place] = f"the engine gives {value}"
        else:
            values[place] = value
    return Calculation(book, formulas, values, reasons)


def _refused(book: Book, formulas: Mapping[Position, Formula]) -> dict[Position, str]:
    refused = {}
    used = {
        name: (max((r for r, _ in cells), default=0), max((c for _, c in cells), default=0))
        for name, cells in book.sheets.items()
    }
    work = 0
    for place, formula in formulas.items():
        if book[place].array:
            refused[place] = "it is an array formula"
        elif formula.obstacle:
            refused[place] = formula.obstacle
        else:
            cost = _cost(formula, used)
            work += cost
            if work > MAX_WORK:
                refused[place] = "the formulas before it read too many cells already"
                work -= cost
    return refused


def _cost(formula: Formula, used: Mapping[str, tuple[int, int]]) -> int:
    """How many cells an engine may have to look at, ranges against ranges at worst."""
    cost = 1
    for area in formula.areas:
        if area.cells > 1:
            rows, columns = used[area.sheet]
            height = max(min(area.bottom, rows) - area.top + 1, 1)
            cost *= height * max(min(area.right, columns) - area.left + 1, 1)
    return cost + len(formula.pieces)


def _computed(
    book: Book, formulas: Mapping[Position, Formula], refused: Mapping[Position, str]
) -> dict[Position, Value]:
    import ironcalc

    if len(formulas) == len(refused):
        return {}
    model = ironcalc.create("workbook")
    number = {name: index for index, name in enumerate(book.sheets)}
    called = {name: f"S{index}" for name, index in number.items()}
    for index in range(len(number)):
        if index:
            model.new_sheet()
        model.rename_sheet(index, f"S{index}")
    for (sheet, row, column), cell in book.cells():
        formula = formulas.get((sheet, row, column))
        if formula is not None and (sheet, row, column) not in refused:
            text = formula.for_engine(called)
            model.update_cell_with_formula(number[sheet], row, column, text)
        elif cell.value is not None:
            _put(model, number[sheet], row, column, cell.value)
    model.evaluate()
    return {
        place: value
        for place in formulas
        if place not in refused
        and (value := model.get_cell_value(number[place[0]], place[1], place[2])) is not None
    }


def _put(model: Any, sheet: int, row: int, column: int, value: Value) -> None:
    if isinstance(value, bool):
        model.update_cell_with_bool(sheet, row, column, value)
    elif isinstance(value, float):
        model.update_cell_with_number(sheet, row, column, value)
    else:
        model.update_cell_with_text(sheet, row, column, value)

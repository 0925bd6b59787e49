"""A book -> every formula's value, computed afresh in bounded time.

The engine is IronCalc: the lightest of those that pip installs, and it gives the doubles that other
engines give. It never sees the file, only formulas that were read and found harmless; whatever else
a cell holds stands there as the value stored.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from spreadsheets.foreign import Book, Position, Value
from spreadsheets.references import Area, Formula, parse

MAX_WORK = 20_000_000
"""Cells that all formulas together may read: some seconds of an engine's time."""
_TOO_MUCH = "the formulas before it read too many cells already"


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
    def spoiling(self) -> set[Position]:
        """The cells with a typed text, be it a blank, for which formulas give #VALUE!."""
        wrong = (place for place in self.formulas if self.error(place) == "#VALUE!")
        areas = (area for place in wrong for area in self.areas(place) if area.cells == 1)
        read = {self.source(area.corner) for area in areas} - self.formulas.keys()
        return {cell for cell in read if isinstance(self.values.get(cell), str)}

    def areas(self, place: Position | None) -> tuple[Area, ...]:
        """What a cell's formula refers to; nothing for a number, or a formula of numbers alone."""
        formula = self.formulas.get(place) if place else None
        return formula.areas if formula else ()

    def source(self, place: Position) -> Position:
        """The cell that a formula brings into another unit, if it reads only that; else itself."""
        for _ in range(8):
            areas = self.areas(place)
            if len(areas) != 1 or areas[0].cells > 1:
                break
            place = areas[0].corner
        return place

    @cached_property
    def named(self) -> dict[Position, str]:
        """The cells that have a name, with it."""
        unnamed = Book(self.book.path, self.book.sheets, {})
        here = (next(iter(self.book.sheets)), 1, 1)
        found = {}
        for name, meaning in self.book.names.items():
            areas = parse(f"={meaning}", here, unnamed).areas
            if len(areas) == 1 and areas[0].cells == 1:
                found[areas[0].corner] = name.rpartition("!")[2]
        return found

    @cached_property
    def order(self) -> dict[Position, int]:
        """The rank of each formula in order of calculation: precedents before what reads them.

        Cells that read each other in a circle come in no particular order; what a formula reads
        that reads too much to be computed is not followed.
        """
        too_much = {place for place, why in self.uncomputed.items() if why == _TOO_MUCH}
        order: dict[Position, int] = {}
        started: set[Position] = set()

        def waiting(place: Position) -> Iterator[Position]:
            areas = () if place in too_much else self.areas(place)
            read = (p for area in areas for p in _filled(area, self.book).places())
            return (p for p in read if p in self.formulas and p not in started)

        for place in self.formulas:
            stack = [] if place in started else [(place, waiting(place))]
            while stack:
                here, before = stack[-1]
                started.add(here)
                if (first := next(before, None)) is None:
                    order[here] = len(order)
                    stack.pop()
                else:
                    stack.append((first, waiting(first)))
        return order


def calculate(book: Book) -> Calculation:
    """Compute a book's formulas, all but those that are refused."""
    formulas = {place: parse(c.formula, place, book) for place, c in book.cells() if c.formula}
    reasons = _refused(book, formulas)
    computed = _computed(book, {p: f for p, f in formulas.items() if p not in reasons})
    values = {place: cell.value for place, cell in book.cells() if cell.value is not None}
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
    """Formulas that no engine may compute, with the reason."""
    refused = {}
    work = 0
    for place, formula in formulas.items():
        # An engine may look at ranges against ranges, at worst.
        sizes = (_filled(area, book).cells for area in formula.areas if area.cells > 1)
        cost = math.prod(sizes) + len(formula.pieces)
        if work + cost > MAX_WORK:
            refused[place] = _TOO_MUCH
            continue
        work += cost
        if book[place].array:
            refused[place] = "it is an array formula"
        elif formula.obstacle:
            refused[place] = formula.obstacle
    return refused


def _filled(area: Area, book: Book) -> Area:
    """The part of an area that may hold something."""
    rows, columns = book.size[area.sheet]
    bottom, right = min(area.bottom, rows), min(area.right, columns)
    return area._replace(bottom=max(bottom, area.top), right=max(right, area.left))


def _computed(book: Book, formulas: Mapping[Position, Formula]) -> dict[Position, Value]:
    """What each formula gives."""
    import ironcalc

    if not formulas:
        return {}
    model = ironcalc.create("workbook")
    number = {name: index for index, name in enumerate(book.sheets)}
    called = {name: f"S{index}" for name, index in number.items()}
    for index, name in enumerate(called.values()):
        if index:
            model.new_sheet()
        model.rename_sheet(index, name)
    for (sheet, row, column), cell in book.cells():
        formula, at = formulas.get((sheet, row, column)), (number[sheet], row, column)
        if formula is not None:
            model.update_cell_with_formula(*at, formula.for_engine(called))
        elif isinstance(cell.value, bool):
            model.update_cell_with_bool(*at, cell.value)
        elif isinstance(cell.value, float):
            model.update_cell_with_number(*at, cell.value)
        elif cell.value is not None:
            model.update_cell_with_text(*at, cell.value)
    model.evaluate()
    return {
        (sheet, row, column): value
        for sheet, row, column in formulas
        if (value := model.get_cell_value(number[sheet], row, column)) is not None
    }

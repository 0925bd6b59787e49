"""Parse the formulas of a book and compute their values, in bounded time.

Two formulas have the same shape if one is the other filled down or across: in a shape, references
are distances, as in R1C1 notation (ExceLint compares formulas in this way), and names are replaced
by what they stand for.

The engine is IronCalc: it is the lightest that pip installs, and gives the same doubles as others.
It never sees the file, only formulas that were parsed and found harmless. Every other cell is given
to it as its stored value.
"""

import math
import re
from collections.abc import Iterator, Mapping, Set
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from itertools import accumulate, pairwise, product
from typing import NamedTuple

from openpyxl.formula.tokenizer import Token, Tokenizer, TokenizerError
from openpyxl.utils.cell import column_index_from_string, get_column_letter

from spreadsheets.engines import address
from spreadsheets.foreign import LAST_COLUMN, LAST_ROW, MAX_FORMULA, Book, Position, Value

MAX_DEPTH = 64
"""Levels of nesting, as in Excel. One engine ends the process at some thousands."""
_MAX_EXPANSIONS = 200
"""How many names one formula may use, counting names within names."""

MAX_WORK = 20_000_000
"""How many cells all formulas together may read: an engine takes some seconds for these."""
_TOO_MUCH = "together with the formulas before it, it reads too many cells"

_FEW = 3
"""Where all formulas store 0, so few wrong values are stale; more were never calculated."""

FUNCTIONS = frozenset((
    "ABS", "ACOS", "AND", "ASIN", "ATAN", "ATAN2", "AVERAGE", "CEILING", "CHOOSE", "COLUMN",
    "COLUMNS", "CONVERT", "COS", "COSH", "COUNT", "COUNTA", "COUNTBLANK", "COUNTIF", "COUNTIFS",
    "EXP", "FALSE", "FLOOR", "HLOOKUP", "IF", "IFERROR", "IFNA", "IFS", "INDEX", "INT",
    "ISBLANK", "ISERROR", "ISNA", "ISNUMBER", "ISTEXT", "LARGE", "LN", "LOG", "LOG10", "LOOKUP",
    "MATCH", "MAX", "MAXIFS", "MEDIAN", "MIN", "MINIFS", "MOD", "N", "NA", "NOT", "OFFSET",
    "OR", "PI", "POWER", "PRODUCT", "ROUND", "ROUNDDOWN", "ROUNDUP", "ROW", "ROWS", "SIGN",
    "SIN", "SINH", "SMALL", "SQRT", "STDEV", "SUBTOTAL", "SUM", "SUMIF", "SUMIFS", "SUMPRODUCT",
    "SUMSQ", "TAN", "TANH", "TRUE", "TRUNC", "VLOOKUP", "XLOOKUP",
))  # fmt: skip
"""What an engine may compute: functions of bounded cost that reach nothing outside the book."""

_LOOKUPS = frozenset({"LOOKUP(", "MATCH(", "VLOOKUP(", "HLOOKUP("})
"""Functions that search a range, as pieces of a formula."""


class Area(NamedTuple):
    """All cells from the top left to the bottom right one; rows and columns are counted from 1."""

    sheet: str
    top: int
    left: int
    bottom: int
    right: int

    @property
    def cells(self) -> int:
        """How many cells it has."""
        return (self.bottom - self.top + 1) * (self.right - self.left + 1)

    @property
    def corner(self) -> Position:
        """The first cell."""
        return self.sheet, self.top, self.left

    def called(self, sheet: str) -> str:
        """The area as a formula writes it, with this name for its sheet."""
        first, last = address(self.top, self.left), address(self.bottom, self.right)
        return f"{sheet}!{first}" if self.cells == 1 else f"{sheet}!{first}:{last}"

    @property
    def ends(self) -> tuple[Position, Position]:
        """The first and the last cell; of whole columns (or rows), their last cells."""
        top = self.bottom if (self.top, self.bottom) == (1, LAST_ROW) else self.top
        left = self.right if (self.left, self.right) == (1, LAST_COLUMN) else self.left
        return (self.sheet, top, left), (self.sheet, self.bottom, self.right)

    def places(self) -> Iterator[Position]:
        """All its cells, row by row."""
        rows, columns = range(self.top, self.bottom + 1), range(self.left, self.right + 1)
        return product([self.sheet], rows, columns)

    def covers(self, place: Position) -> bool:
        """Whether a cell lies in it."""
        sheet, row, column = place
        inside = self.top <= row <= self.bottom and self.left <= column <= self.right
        return sheet == self.sheet and inside

    def overlaps(self, area: "Area") -> bool:
        """Whether any cell lies in both areas."""
        rows = self.top <= area.bottom and area.top <= self.bottom
        columns = self.left <= area.right and area.left <= self.right
        return self.sheet == area.sheet and rows and columns


class Piece(NamedTuple):
    """One token of a formula: its kind, its text, and the area that it refers to, if any.

    `shape` is that area in R1C1 notation; or the name, if the token is a number that has a name.
    """

    kind: str
    text: str
    area: Area | None = None
    shape: str = ""


@dataclass(frozen=True)
class Formula:
    """A formula, parsed at its place. `obstacle` says why no engine may compute it, if none may."""

    place: Position
    pieces: tuple[Piece, ...]
    obstacle: str | None

    @cached_property
    def areas(self) -> tuple[Area, ...]:
        """All areas that it refers to."""
        return tuple(piece.area for piece in self.pieces if piece.area is not None)

    @cached_property
    def shape(self) -> tuple[str, ...]:
        """What is the same in every cell that the formula is filled into, piece by piece."""
        return tuple(piece.shape or piece.text for piece in self.pieces)

    @cached_property
    def literals(self) -> tuple[float, ...]:
        """The numbers in it, typed or as names of numbers."""
        return tuple(float(piece.text) for piece in self.pieces if piece.kind == "number")

    @cached_property
    def typed(self) -> tuple[float, ...]:
        """The numbers that are typed into it, without those of names."""
        numbers = (piece for piece in self.pieces if piece.kind == "number" and not piece.shape)
        return tuple(float(piece.text) for piece in numbers)

    @cached_property
    def names(self) -> frozenset[str]:
        """The names in it that stand for numbers, in capitals."""
        return frozenset(p.shape for p in self.pieces if p.kind == "number" and p.shape)

    def reads(self, place: Position) -> bool:
        """Whether it refers to a cell."""
        return any(area.covers(place) for area in self.areas)

    def for_engine(self, sheets: Mapping[str, str]) -> str:
        """The formula without names, and with the sheets renamed as in `sheets`."""
        return "=" + "".join(
            piece.text if piece.area is None else piece.area.called(sheets[piece.area.sheet])
            for piece in self.pieces
        )


def parse(text: str, place: Position, book: Book) -> Formula:
    """Parse a formula at its place in a book; one that cannot be read has an obstacle."""
    reader = _Reader(place, book)
    depths = accumulate((character in "([{") - (character in ")]}") for character in text)
    if len(text) > MAX_FORMULA:
        reader.obstacle = f"it has more than {MAX_FORMULA:,} characters"
    elif len(text) > MAX_DEPTH < max(depths):
        reader.obstacle = f"it is nested more than {MAX_DEPTH} levels deep"
    else:
        with suppress(TokenizerError, IndexError, ValueError):
            return Formula(place, tuple(reader.read(text)), reader.obstacle)
        reader.obstacle = "it cannot be read"
    return Formula(place, (Piece("text", text),), reader.obstacle)


_LAST_LETTERS = f"${get_column_letter(LAST_COLUMN)}"
_COLUMN, _ROW = r"(\$?[A-Za-z]{1,3})", r"(\$?[1-9][0-9]{0,6})"
_SHEET = r"(?:('(?:[^']|'')+'|[^'!\[\]]+)!)?"
_REFERENCES = (  # a cell or some, whole columns, whole rows
    re.compile(rf"{_SHEET}{_COLUMN}{_ROW}(?::{_COLUMN}{_ROW})?#?"),
    re.compile(rf"{_SHEET}{_COLUMN}():{_COLUMN}()"),
    re.compile(rf"{_SHEET}(){_ROW}:(){_ROW}"),
)


class _Tokenizer(Tokenizer):
    SN_RE = re.compile(r"(?:\d+\.?\d*|\.\d+)[Ee]$")  # type: ignore[misc]  # final in openpyxl
    """What precedes the sign of an exponent: openpyxl's own misses 0.2E-9 and 22E-6."""


@lru_cache(maxsize=4096)
def _tokens(text: str) -> tuple[Token, ...]:
    """The tokens of a formula; cached, since the meaning of a name is parsed with every formula."""
    return tuple(_Tokenizer(text).items)


@dataclass
class _Reader:
    """Turn tokens into pieces; `obstacle` is the first reason not to compute the formula."""

    place: Position
    book: Book
    obstacle: str | None = None
    expansions: int = 0

    def read(self, text: str) -> Iterator[Piece]:
        """Yield the pieces of a formula."""
        for token in _tokens(text):
            value, kind = token.value, token.type
            if kind == Token.OPERAND and token.subtype == Token.RANGE:
                yield from self.operand(value)
            elif kind == Token.OPERAND and token.subtype == Token.NUMBER:
                yield Piece("number", value)
            elif kind == Token.FUNC and token.subtype == Token.OPEN:
                name = value.rstrip("(").upper().removeprefix("_XLFN.").removeprefix("_XLWS.")
                if name not in FUNCTIONS:
                    self.stop(f"it uses {name[:40]}")
                yield Piece("function", f"{name}(")
            elif kind != Token.WSPACE:
                if kind == Token.ARRAY:
                    self.stop("it holds an array")
                yield Piece("sign", value)

    def stop(self, reason: str) -> None:
        self.obstacle = self.obstacle or reason

    def operand(self, value: str) -> Iterator[Piece]:
        """Yield the piece of a reference, or those of what a name stands for."""
        match = next((m for pattern in _REFERENCES if (m := pattern.fullmatch(value))), None)
        if match is not None and (area := self.area(match)) is not None:
            yield area
            return
        names = self.book.meanings
        meaning = names.get(f"'{self.place[0]}'!{value}".upper(), names.get(value.upper()))
        if meaning is None or self.expansions > _MAX_EXPANSIONS:
            is_outside = "[" in value.rpartition("!")[0] or "|" in value
            unknown = f"nothing is called {value[:40]}"
            self.stop("it refers outside the workbook" if is_outside else unknown)
            yield Piece("name", value)
            return
        self.expansions += 1
        inner = tuple(self.read(f"={meaning.removeprefix('=')}"))
        if len(inner) == 1 and inner[0].kind == "number":
            inner = (inner[0]._replace(shape=inner[0].shape or value.rpartition("!")[2].upper()),)
        yield from inner if len(inner) == 1 else (Piece("sign", "("), *inner, Piece("sign", ")"))

    def area(self, match: re.Match[str]) -> Piece | None:
        """The piece of a reference, or None if no such cells exist."""
        named, left, top, right, bottom = match.groups()
        if named and named.startswith("'"):
            named = named[1:-1].replace("''", "'")
        sheet = self.place[0] if named is None else self.book.called.get(named.upper())
        if right is None:  # a single cell
            right, bottom = left, top
        # Whole columns have all rows, wherever the formula is filled, as if $ fixed their ends.
        ends = top or "$1", left or "$A", bottom or f"${LAST_ROW}", right or _LAST_LETTERS
        bare = [end.lstrip("$") for end in ends]
        numbers = [int(end) if end.isdigit() else column_index_from_string(end) for end in bare]
        (first, last), (leftmost, rightmost) = sorted(numbers[::2]), sorted(numbers[1::2])
        if sheet is None or last > LAST_ROW or rightmost > LAST_COLUMN:
            return None
        area = Area(sheet, first, leftmost, last, rightmost)
        own_sheet, *own_cell = self.place
        steps = [
            str(number) if end.startswith("$") else f"[{number - start}]"
            for end, number, start in zip(ends, numbers, own_cell * 2, strict=True)
        ]
        shape = "" if sheet == own_sheet else f"{sheet}!"
        shape += f"R{steps[0]}C{steps[1]}"
        shape += "" if area.cells == 1 else f":R{steps[2]}C{steps[3]}"
        return Piece("area", match[0], area, shape)


@dataclass(frozen=True)
class Calculation:
    """A book, its parsed formulas, and the value of every cell.

    `values` are computed where that is possible, and stored ones elsewhere. `uncomputed` has the
    reason for each formula that was not computed. `texts` are cells that formulas read and that
    hold a number as a text; in `values` they are numbers.
    """

    book: Book
    formulas: Mapping[Position, Formula]
    values: Mapping[Position, Value]
    uncomputed: Mapping[Position, str] = field(default_factory=dict)
    texts: Mapping[Position, str] = field(default_factory=dict)

    def number(self, place: Position | None) -> float | None:
        """The value of a cell, if it is a number."""
        value = None if place is None else self.values.get(place)
        return value if isinstance(value, float) else None

    def error(self, place: Position) -> str | None:
        """The error that a formula gives, except #N/A, which people produce on purpose."""
        value = self.values.get(place)
        if place in self.formulas and isinstance(value, str) and value.startswith("#"):
            return None if value == "#N/A" else value
        return None

    @cached_property
    def spoiling(self) -> set[Position]:
        """The cells whose typed text, perhaps only a space, makes formulas give #VALUE!."""
        wrong = (place for place in self.formulas if self.error(place) == "#VALUE!")
        areas = (area for place in wrong for area in self.areas(place) if area.cells == 1)
        read = {self.source(area.corner) for area in areas} - self.formulas.keys()
        return {cell for cell in read if isinstance(self.values.get(cell), str)}

    def areas(self, place: Position | None) -> tuple[Area, ...]:
        """The areas that a cell's formula refers to, if any."""
        formula = self.formulas.get(place) if place else None
        return formula.areas if formula else ()

    def corners(self, place: Position | None) -> list[Position]:
        """The first cell of each of these areas: in most formulas, all the cells that they read."""
        return [area.corner for area in self.areas(place)]

    def source(self, place: Position) -> Position:
        """The last cell of the `chain` that starts at a cell."""
        return self.chain(place)[-1]

    def chain(self, place: Position) -> list[Position]:
        """A cell and those behind it, each the only one that the formula before it reads."""
        cells = [place]
        for _ in range(8):
            areas = self.areas(cells[-1])
            if len(areas) != 1 or areas[0].cells > 1:
                break
            cells.append(areas[0].corner)
        return cells

    def precedents(self, place: Position) -> Iterator[Position]:
        """The cells that a formula reads, within the used part of a sheet; none if too many."""
        areas = () if self.uncomputed.get(place) == _TOO_MUCH else self.areas(place)
        return (cell for area in areas for cell in _filled(area, self.book).places())

    @cached_property
    def unknown(self) -> set[Position]:
        """Formulas without any value: neither computed nor stored, or computed from such a one."""
        return self.needing({p for p in self.uncomputed if self.book[p].value is None})

    def needing(self, places: Set[Position]) -> set[Position]:
        """These formulas, and all that are computed from them."""
        needing = set(places)
        if places:
            computed = self.formulas.keys() - self.uncomputed.keys()
            for place in sorted(computed, key=self.order.__getitem__):
                if not needing.isdisjoint(self.precedents(place)):
                    needing.add(place)
        return needing

    @cached_property
    def named(self) -> dict[Position, str]:
        """The cells that have a defined name, with that name."""
        unnamed, corner = replace(self.book, names={}), (next(iter(self.book.sheets)), 1, 1)
        names = {}
        for name, meaning in self.book.names.items():
            areas = parse(f"={meaning}", corner, unnamed).areas
            if len(areas) == 1 and areas[0].cells == 1:
                names[areas[0].corner] = name.rpartition("!")[2]
        return names

    @cached_property
    def order(self) -> dict[Position, int]:
        """The rank of each formula in order of calculation: after all that it reads.

        Formulas that read each other in a circle come in no particular order.
        """
        order: dict[Position, int] = {}
        started: set[Position] = set()

        def waiting(place: Position) -> Iterator[Position]:
            formulas = (cell for cell in self.precedents(place) if cell in self.formulas)
            return (cell for cell in formulas if cell not in started)

        for place in self.formulas:
            stack = [] if place in started else [(place, waiting(place))]
            while stack:
                current, precedents = stack[-1]
                started.add(current)
                if (first := next(precedents, None)) is None:
                    order[current] = len(order)
                    stack.pop()
                else:
                    stack.append((first, waiting(first)))
        return order


def calculate(book: Book) -> Calculation:
    """Compute the formulas of a book, except those that no engine may compute."""
    formulas = {
        place: parse(cell.formula, place, book) for place, cell in book.cells() if cell.formula
    }
    values = {place: cell.value for place, cell in book.cells() if cell.value is not None}
    numbers = _numbers_as_text(values, formulas)
    texts = {place: str(values[place]) for place in numbers}
    values |= numbers
    reasons = _refused(book, formulas)
    computable = {place: formula for place, formula in formulas.items() if place not in reasons}
    for place, value in _computed(book, computable).items():
        stored = book[place]
        is_error = isinstance(value, str) and value.startswith("#")
        if is_error and stored.value is not None and not stored.error:
            # The author's program stored a value, so the error is a limit of this engine.
            reasons[place] = f"the engine gives {value}"
        else:
            values[place] = value
    calculation = Calculation(_without_zeros(book, values), formulas, values, reasons, texts)
    for place in calculation.unknown:
        values.pop(place, None)  # it was computed with blanks in place of unknown numbers
    return calculation


def _without_zeros(book: Book, values: Mapping[Position, Value]) -> Book:
    """The book without stored values, if its program stored 0 for every formula; else unchanged."""
    stored = {place: cell.value for place, cell in book.cells() if cell.formula}
    are_zero = all(type(value) is float and value == 0 for value in stored.values())
    stale = sum(values.get(place) != value for place, value in stored.items())
    if not are_zero or stale <= max(_FEW, len(stored) / 2):
        return book
    note = "every formula stores 0, as some programs write it: none is calculated"
    sheets = {
        sheet: {at: c._replace(value=None) if c.formula else c for at, c in cells.items()}
        for sheet, cells in book.sheets.items()
    }
    return replace(book, sheets=sheets, notes=(*book.notes, note))


_NUMBER = re.compile(r"\s*[-+]?(?:\d+\.?\d*|\.\d+)(?:[Ee][-+]?\d{1,3})?\s*")


def _numbers_as_text(
    values: Mapping[Position, Value], formulas: Mapping[Position, Formula]
) -> dict[Position, float]:
    """The numbers that are typed as texts into single cells that formulas read.

    Most programs calculate with such a text, though they compare it, and sum it up, as a text.
    """
    areas = (area for formula in formulas.values() for area in formula.areas if area.cells == 1)
    read = {area.corner for area in areas} - formulas.keys()
    texts = ((place, text) for place in read if isinstance(text := values.get(place), str))
    numbers = {place: float(text) for place, text in texts if _NUMBER.fullmatch(text)}
    return {place: number for place, number in numbers.items() if math.isfinite(number)}


def _refused(book: Book, formulas: Mapping[Position, Formula]) -> dict[Position, str]:
    """The formulas that no engine may compute, with the reason."""
    refused = {}
    work = 0
    for place, formula in formulas.items():
        # At worst, an engine compares every cell of a range with every cell of another. It also
        # goes through the cells beyond those in use, except in whole columns and rows.
        ranges = [area for area in formula.areas if area.cells > 1]
        cost = math.prod(_filled(area, book).cells for area in ranges) + len(formula.pieces)
        cost += sum(_without_unused_ends(area, book).cells for area in ranges)
        if work + cost > MAX_WORK:
            refused[place] = _TOO_MUCH
            continue
        work += cost
        if book[place].array:
            refused[place] = "it is an array formula"
        elif formula.obstacle:
            refused[place] = formula.obstacle
        elif any(
            test.text.startswith("IS") and tested.area and tested.area.cells > 1
            for test, tested in pairwise(formula.pieces)
        ):
            refused[place] = "the engine does not test each cell of a range"
    return refused


def _without_unused_ends(area: Area, book: Book) -> Area:
    """The area; of whole columns or rows the part that the sheet uses."""
    used = _filled(area, book)
    if (area.top, area.bottom) == (1, LAST_ROW):
        area = area._replace(bottom=used.bottom)
    if (area.left, area.right) == (1, LAST_COLUMN):
        area = area._replace(right=used.right)
    return area


def _filled(area: Area, book: Book) -> Area:
    """The part of an area within the rows and columns that its sheet uses; at least one cell."""
    rows, columns = book.size[area.sheet]
    bottom, right = min(area.bottom, rows), min(area.right, columns)
    return area._replace(bottom=max(bottom, area.top), right=max(right, area.left))


def _without_ends(formula: Formula, book: Book) -> Formula:
    """The formula with the ranges that lookups search cut at their last cell that is not blank.

    The engine would find a blank cell at the end of such a range. Only the second argument of a
    lookup is cut: other readers of a range may count its blanks.
    """
    calls = [("", 1)]  # open functions and brackets, each with the number of its argument
    pieces = []
    for piece in formula.pieces:
        function, argument = calls[-1]
        if piece.kind == "function" or piece.text == "(":
            calls.append((piece.text, 1))
        elif piece.text == ")" and len(calls) > 1:
            calls.pop()
        elif piece.text == ",":
            calls[-1] = function, argument + 1
        elif piece.area and function in _LOOKUPS and argument == 2:
            piece = piece._replace(area=_searched(piece.area, function, book))
        pieces.append(piece)
    return replace(formula, pieces=tuple(pieces))


def _searched(area: Area, function: str, book: Book) -> Area:
    """An area cut after the last cell that is not blank in the column, or row, that is searched."""
    cells = book.sheets[area.sheet]
    _, top, left, bottom, right = _filled(area, book)
    if function == "VLOOKUP(" or (function != "HLOOKUP(" and bottom - top >= right - left):
        while bottom > top and (bottom, left) not in cells:
            bottom -= 1
    else:
        while right > left and (top, right) not in cells:
            right -= 1
    return area._replace(bottom=bottom, right=right)


def _computed(book: Book, formulas: Mapping[Position, Formula]) -> dict[Position, Value]:
    """The values of formulas, as the engine computes them."""
    import ironcalc

    if not formulas:
        return {}
    model = ironcalc.create("workbook")
    number = {name: index for index, name in enumerate(book.sheets)}
    short = {name: f"S{index}" for name, index in number.items()}
    for name, index in number.items():
        if index:
            model.new_sheet()
        model.rename_sheet(index, short[name])
    for (sheet, row, column), cell in book.cells():
        formula, at = formulas.get((sheet, row, column)), (number[sheet], row, column)
        if formula is not None:
            model.update_cell_with_formula(*at, _without_ends(formula, book).for_engine(short))
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

"""Values in formulas, and how one becomes another: errors, references, numbers, texts, comparisons.

`evaluate` parses formulas and `functions` has the functions that they may call; both stand on this.
"""

import math
import re
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple, Protocol

from spreadsheets.foreign import Book, Position

MAX_WORK = 8_000_000
"""How many cells all ranges of all formulas may have together: some seconds."""


MAX_CHAIN = 200
"""Formulas that read each other, one behind the other, in one evaluation."""


TOO_MUCH = "together with the formulas before it, it reads too many cells"


class Error(str):
    """An error value, such as #N/A; a text that only looks like one is a plain str."""

    __slots__ = ()


Scalar = float | str | bool | None
"""The value of a cell; None is a blank one, and an `Error` is a str, too."""


class CellError(Exception):
    """An error value on its way through a formula."""

    def __init__(self, error: str) -> None:
        super().__init__(error)
        self.error = Error(error)


class NotComputedError(Exception):
    """A formula is not computed here; the message is the reason."""


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

    def places(self) -> Iterator[Position]:
        """All its cells, row by row."""
        for row in range(self.top, self.bottom + 1):
            for column in range(self.left, self.right + 1):
                yield self.sheet, row, column

    def covers(self, place: Position) -> bool:
        """Whether a cell lies in it."""
        sheet, row, column = place
        inside = self.top <= row <= self.bottom and self.left <= column <= self.right
        return sheet == self.sheet and inside


Run = Callable[["Site"], object]
"""A compiled part of a formula: its value, or an `Area` or a `One` for a reference."""


LiteralKey = tuple[str, int, int, int] | tuple[str, int]
"""A number typed into the formula of a cell, or into a name: which one it is, for replacing it."""


class One(NamedTuple):
    """A reference to a single cell."""

    sheet: str
    row: int
    column: int


def scalar(value: object, at: "Site") -> Scalar:
    """One value: that of a cell, or the cell of a range in the formula's own row or column."""
    if isinstance(value, One):
        value = at.value(value)
    elif isinstance(value, Area):
        value = at.value(_crossed_cell(value, at))
    if type(value) is Error:
        raise CellError(value)
    return value  # type: ignore[return-value]  # what is no reference is a scalar


def _crossed_cell(area: Area, at: "Site") -> Position:
    """The cell of a row or column that stands for it at a site."""
    sheet, top, left, bottom, right = area
    if top == bottom and left == right:
        return sheet, top, left
    if left == right and top <= at.row <= bottom:
        return sheet, at.row, left
    if top == bottom and left <= at.column <= right:
        return sheet, top, at.column
    raise CellError("#VALUE!")


_NUMBER = re.compile(r"\s*[-+]?(?:\d+\.?\d*|\.\d+)(?:[Ee][-+]?\d{1,3})?\s*(%?)\s*")


def as_number(given: object, at: "Site") -> float:
    """One number, as arithmetic takes it: a blank is 0, a text of digits the number."""
    value = given if type(given) is float else scalar(given, at)
    if type(value) is float:
        return value
    if value is None:
        return 0.0
    if isinstance(value, bool | int):
        return float(value)
    match = _NUMBER.fullmatch(str(value))
    if match is None:
        raise CellError("#VALUE!")
    return float(str(value).rstrip(" %")) / (100 if match[1] else 1)


def finite(value: float) -> float:
    """The number. Raises CellError if it is none, or beyond the range of doubles."""
    if value - value != 0:
        raise CellError("#NUM!")
    return value


def power(base: float, exponent: float) -> float:
    """A power as spreadsheets compute it."""
    try:
        if base == 0 and exponent <= 0:
            raise CellError("#NUM!" if exponent == 0 else "#DIV/0!")
        result = base**exponent
    except (OverflowError, ZeroDivisionError) as error:
        raise CellError("#NUM!") from error
    if isinstance(result, complex):
        raise CellError("#NUM!")
    return finite(result)


def as_text(value: Scalar) -> str:
    """A value as `&` joins it."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).upper()
    return f"{value:.15G}" if isinstance(value, float) else value


def _sort_key(value: Scalar) -> tuple[int, float | str]:
    if isinstance(value, bool):
        return 2, float(value)
    if isinstance(value, str):
        return 1, value.casefold()
    return 0, value or 0.0


def compared(sign: str, left: Scalar, right: Scalar) -> bool:
    """Compare two values; numbers that agree to fifteen digits are equal, as in spreadsheets."""
    blank: dict[type, Scalar] = {str: "", bool: False}
    left = blank.get(type(right), 0.0) if left is None else left
    right = blank.get(type(left), 0.0) if right is None else right
    (left_kind, a), (right_kind, b) = _sort_key(left), _sort_key(right)
    order = (left_kind > right_kind) - (left_kind < right_kind)
    if not order and isinstance(a, float) and isinstance(b, float):
        order = 0 if math.isclose(a, b, rel_tol=1e-15) else (a > b) - (a < b)
    elif not order:
        order = (str(a) > str(b)) - (str(a) < str(b))
    return order in MEETS[sign]


MEETS = {"=": (0,), "<>": (-1, 1), "<": (-1,), ">": (1,), "<=": (-1, 0), ">=": (0, 1)}
"""For each sign of comparison how the left value may stand to the right one."""


class Cells(Protocol):
    """What a formula may ask of the book that is evaluated; `evaluate.Evaluator` answers."""

    book: Book
    values: dict[Position, Scalar]
    pending: dict[Position, None]
    aggregates: dict[tuple[str, Area], float]
    work: int

    def used(self, area: Area) -> Area:
        """The part of an area that its sheet uses."""
        ...

    def computed(self, place: Position, at: "Site") -> Scalar:
        """The value of a formula, at a site."""
        ...

    def has_subtotal(self, place: Position) -> bool:
        """Whether a cell has a formula with SUBTOTAL, which other subtotals leave out."""
        ...


class Site:
    """Where a formula is evaluated, and with what: values already known, and what is replaced.

    `affected` are the formulas that are evaluated again; None in the first evaluation of all.
    """

    __slots__ = ("affected", "column", "depth", "evaluator", "known", "literals", "row")

    def __init__(
        self,
        evaluator: Cells,
        known: dict[Position, Scalar],
        literals: Mapping[LiteralKey, float],
        affected: frozenset[Position] | None,
    ) -> None:
        self.evaluator, self.known, self.literals = evaluator, known, literals
        self.affected = affected
        self.row = self.column = self.depth = 0

    def value(self, place: Position) -> Scalar:
        """The value of a cell."""
        if place in self.known:
            return self.known[place]
        evaluator = self.evaluator
        if self.affected is None:
            if place in evaluator.pending:
                raise NotComputedError("it reads itself, or a formula that needs it")
            return evaluator.values.get(place)
        if place not in self.affected:
            return evaluator.values.get(place)
        if self.depth > MAX_CHAIN:
            raise NotComputedError("it is computed through too many cells")
        own = self.row, self.column
        self.depth += 1
        result = self.known[place] = evaluator.computed(place, self)
        self.depth -= 1
        self.row, self.column = own
        return result

    def spend(self, cells: int) -> None:
        """Count the cells of a range before they are read."""
        self.evaluator.work += cells
        if self.evaluator.work > MAX_WORK:
            raise NotComputedError(TOO_MUCH)

"""Evaluate the formulas of a book: one function of a cell, with cells and numbers replaced.

A formula is parsed once for all cells that it is filled into. Its text is first written with
distances in place of relative references, as in R1C1 notation; this is its *shape*. Formulas mean
what the file format says they mean: where one value is wanted, a range stands for its cell in the
formula's own row or column, and relative references in a name start at the cell that uses it.

Nothing outside the book is reached. Work is bounded: by the number of cells that all formulas read
together, where whole columns count as far as the sheet uses them, and by the depth of nesting. A
formula that cannot be computed here keeps its stored value, and `Evaluator.reasons` says why.
"""

import re
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from operator import add, mul, sub
from typing import NamedTuple

from spreadsheets.foreign import (
    LAST_COLUMN,
    LAST_ROW,
    MAX_FORMULA,
    MAX_TEXT,
    Book,
    Position,
)
from spreadsheets.functions import FUNCTIONS, OF_SINGLE_VALUES
from spreadsheets.scalars import (
    MAX_WORK,
    MEETS,
    Area,
    CellError,
    Error,
    LiteralKey,
    NotComputedError,
    One,
    Run,
    Scalar,
    Site,
    as_number,
    as_text,
    compared,
    power,
    scalar,
)

MAX_NESTING = 64
"""Levels of nesting in a formula, as in Excel."""
MAX_SIZE = 2_000
"""Operations in one formula, with those of the names that it uses."""
MAX_CONE = 2_000
"""Formulas that are followed behind a row of a table."""
MAX_FEW = 64
"""Cells of a range that are followed: a lookup of an input in a small list."""


class CellReference(NamedTuple):
    """A reference in a shape: distances to the formula's own cell where `fixed` is False.

    `crossing`: a range where one value is wanted; it stands for the cell in the formula's own row
    or column.
    """

    sheet: str
    rows: tuple[int, int]
    columns: tuple[int, int]
    fixed: tuple[bool, bool, bool, bool]  # top, left, bottom, right
    crossing: bool = False

    def at(self, row: int, column: int) -> Area:
        """The area that it means in a formula at this row and column; it wraps at the ends."""
        (top, bottom), (left, right), fixed = self.rows, self.columns, self.fixed
        top = top if fixed[0] else (top + row - 1) % LAST_ROW + 1
        left = left if fixed[1] else (left + column - 1) % LAST_COLUMN + 1
        bottom = bottom if fixed[2] else (bottom + row - 1) % LAST_ROW + 1
        right = right if fixed[3] else (right + column - 1) % LAST_COLUMN + 1
        if top > bottom:
            top, bottom = bottom, top
        if left > right:
            left, right = right, left
        if self.crossing and left == right and top <= row <= bottom:
            top = bottom = row
        elif self.crossing and top == bottom and left <= column <= right:
            left = right = column
        return Area(self.sheet, top, left, bottom, right)


@dataclass(frozen=True, eq=False)
class Shape:
    """A parsed formula, the same for all cells that it is filled into.

    `literals` are the numbers typed into it, in order; those of names it uses are in `names`, by
    name in capitals. `reason` says why it is not computed here, if it is not.
    """

    key: str
    run: Run | None
    references: tuple[CellReference, ...] = ()
    literals: tuple[float, ...] = ()
    names: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    reason: str | None = None

    @cached_property
    def has_subtotal(self) -> bool:
        """Whether it calls SUBTOTAL."""
        return "SUBTOTAL(" in self.key.upper()


# ---- from a text to a shape

_STRING = r'"(?:[^"]|"")*"'
_SHEET = r"(?:'(?:[^']|'')++'|[^\W\d][\w.]*+)!"
_A1 = re.compile(
    rf"{_STRING}|(?<![\w.$])(?P<sheet>{_SHEET})?(?:"
    r"(?P<cell>\$?[A-Za-z]{1,3}\$?[1-9][0-9]{0,6})(?::(?P<to>\$?[A-Za-z]{1,3}\$?[1-9][0-9]{0,6}))?"
    r"|(?P<columns>\$?[A-Za-z]{1,3}:\$?[A-Za-z]{1,3})|(?P<rows>\$?[1-9][0-9]{0,6}:\$?[1-9][0-9]{0,6})"
    r")(?![\w.(!\[])"
    r"|'(?:[^']|'')*+'?+"
)
"""Texts, references, and what else stands in apostrophes, which is skipped as a whole.

What was read is not read again, so that the time grows with the length: a quantifier with a + gives
nothing back, and a sheet's name starts where a word does. (Such a + after a named group matches
wrongly in Python 3.11.2.)
"""
_CELL = re.compile(r"(\$?)([A-Za-z]{1,3})(\$?)([0-9]+)")
_OPEN, _CLOSE = "\x02", "\x03"
"""They stand around a reference in the key of a shape; no file can hold these characters."""


@lru_cache(maxsize=20_000)
def column_number(letters: str) -> int:
    """The number of a column.

    >>> column_number("A"), column_number("xfd")
    (1, 16384)
    """
    number = 0
    for letter in letters.upper():
        number = 26 * number + ord(letter) - 64
    return number


@lru_cache(maxsize=20_000)
def column_letters(number: int) -> str:
    """The letters of a column.

    >>> column_letters(1), column_letters(16384)
    ('A', 'XFD')
    """
    letters = ""
    while number > 0:
        number, rest = divmod(number - 1, 26)
        letters = chr(65 + rest) + letters
    return letters


def shape_key(text: str, row: int, column: int) -> str:
    """A formula with distances in place of relative references: equal if one is the other filled.

    >>> shape_key("=A1+$B$2", 2, 1) == shape_key("=A2+$B$2", 3, 1)
    True
    """

    def end(cell: str) -> str:
        match = _CELL.fullmatch(cell)
        assert match is not None
        fixed_column, letters, fixed_row, digits = match.groups()
        r, c = int(digits), column_number(letters)
        return (
            (f"{r}" if fixed_row else f"[{r - row}]")
            + ","
            + (f"{c}" if fixed_column else f"[{c - column}]")
        )

    def relative(match: re.Match[str]) -> str:
        text = match[0]
        sheet, cell, to, columns, rows = match.groups()
        if not (cell or columns or rows):
            return text
        if cell:
            if _is_no_cell(cell) or (to and _is_no_cell(to)):
                return text
            ends = end(cell) + ";" + end(to or cell) + (":" if to else "")
        elif columns:
            first, last = columns.split(":")
            ends = f"{end(first + '$1')};{end(f'{last}${LAST_ROW}')}:"
        else:
            first, last = rows.split(":")
            ends = f"{end(f'$A{first}')};{end(f'$XFD{last}')}:"
        return f"{_OPEN}{sheet or ''}{ends}{_CLOSE}"

    return _A1.sub(relative, text)


def formula_text(key: str, row: int, column: int) -> str:
    """The formula of a shape as the cell at a row and a column shows it.

    >>> formula_text(shape_key("=A1+$B$2", 2, 1), 3, 1)
    '=A2+$B$2'
    """

    def shown(match: re.Match[str]) -> str:
        text = match[1]
        bang = text.rfind("!") + 1
        ends = []
        for relative_row, r, relative_column, c in _END.findall(text[bang:]):
            rows = f"{int(r) + row}" if relative_row else f"${r}"
            columns = int(c) + column if relative_column else int(c)
            ends.append(f"{'' if relative_column else '$'}{column_letters(columns)}{rows}")
        return text[:bang] + (":".join(ends) if text.endswith(":") else ends[0])

    return re.sub(f"{_OPEN}([^{_CLOSE}]*){_CLOSE}", shown, key)


def _is_no_cell(cell: str) -> bool:
    """Whether a text such as YLD1048577 or ZZZ1 is no cell: then it is a name."""
    match = _CELL.fullmatch(cell)
    return match is None or int(match[4]) > LAST_ROW or column_number(match[2]) > LAST_COLUMN


_TOKEN = re.compile(
    rf"(?P<space>\s+)|(?P<text>{_STRING})|{_OPEN}(?P<area>[^{_CLOSE}]*){_CLOSE}"
    r"|(?P<error>#(?:N/A|DIV/0!|VALUE!|REF!|NAME\?|NUM!|NULL!))"
    r"|(?P<number>(?:\d+\.?\d*|\.\d+)(?:[Ee][-+]?\d{1,4})?)"
    r"|(?P<function>[^\W\d][\w.]*)\("
    rf"|(?P<name>(?:{_SHEET})?[^\W\d][\w.\\?]*(?:\[(?:[^\[\]]|\[[^\[\]]*\])*\])?)"
    r"|(?P<sign><=|>=|<>|[-+*/^&=<>%(),;@])"
)
_END = re.compile(r"(\[?)(-?\d+)\]?,(\[?)(-?\d+)\]?")
_BINARY = {"=": 1, "<>": 1, "<": 1, ">": 1, "<=": 1, ">=": 1, "&": 2, "+": 3, "-": 3, "*": 4,
           "/": 4, "^": 5}  # fmt: skip
"""The operators and how strongly they bind."""


class _Parser:
    """Compile the key of a shape: a recursive descent over its tokens."""

    def __init__(self, key: str, sheet: str, book: Book, within: tuple[str, ...] = ()) -> None:
        self.tokens = list(self.read(key))
        self.sheet, self.book, self.within = sheet, book, within
        self.at = self.depth = self.size = 0
        self.references: list[CellReference] = []
        self.literals: list[float] = []
        self.names: dict[str, tuple[float, ...]] = {}
        self.ranges: dict[Run, CellReference] = {}

    @staticmethod
    def read(key: str) -> Iterator[tuple[str, str]]:
        at = 1 if key.startswith("=") else 0
        while at < len(key):
            match = _TOKEN.match(key, at)
            if match is None:
                what = "it holds an array" if key[at] == "{" else "it cannot be read"
                raise NotComputedError("it refers outside the workbook" if key[at] == "[" else what)
            kind = match.lastgroup or ""
            if kind != "space":
                yield kind, match[kind]
            at = match.end()
        yield "end", ""

    def parsed(self) -> Run:
        run = self.expression(0)
        if self.tokens[self.at][0] != "end":
            raise NotComputedError("it cannot be read")
        return run

    def crossed(self, run: Run) -> Run:
        """A part where one value is wanted: a range becomes its cell in the formula's own line."""
        reference = self.ranges.pop(run, None)
        if reference is None:
            return run
        self.references.remove(reference)
        crossing = reference._replace(crossing=True)
        self.references.append(crossing)
        return _run_of_range(crossing)

    def next(self, wanted: str = "") -> bool:
        """Whether the next token is this sign; it is then taken."""
        if self.tokens[self.at] == ("sign", wanted):
            self.at += 1
            return True
        return False

    def expression(self, least: int) -> Run:
        self.depth += 1
        if self.depth > MAX_NESTING:
            raise NotComputedError(f"it is nested more than {MAX_NESTING} levels deep")
        left = self.prefix()
        while True:
            kind, sign = self.tokens[self.at]
            strength = _BINARY.get(sign, 0) if kind == "sign" else 0
            if strength <= least:
                break
            self.at += 1
            self.count()
            right = self.expression(strength)
            left = _binary(sign, self.crossed(left), self.crossed(right))
        self.depth -= 1
        return left

    def count(self) -> None:
        self.size += 1
        if self.size > MAX_SIZE:
            raise NotComputedError(f"it has more than {MAX_SIZE:,} operations")

    def prefix(self) -> Run:
        first = self.at
        while self.tokens[self.at][0] == "sign" and self.tokens[self.at][1] in "-+@":
            self.at += 1
        signs = [sign for _, sign in self.tokens[first : self.at]]
        run = self.operand()
        if "@" in signs:
            run = self.crossed(run)
        while self.next("%"):
            run = _binary("/", self.crossed(run), _run_of_constant(100.0))
        if "-" not in signs:
            return run
        # Two minus signs make a number of a text or a truth value.
        run = self.crossed(run)
        return _negative(run) if signs.count("-") % 2 else _number_of(run)

    def operand(self) -> Run:
        kind, text = self.tokens[self.at]
        self.at += 1
        self.count()
        if kind == "number":
            value = float(text)
            self.literals.append(value)
            return _literal(value, self.sheet, self.within, len(self.literals) - 1)
        if kind == "text":
            return _run_of_constant(text[1:-1].replace('""', '"'))
        if kind == "error":
            return _failing(text)
        if kind == "area":
            return self.area(text)
        if kind == "name":
            return self.name(text)
        if kind == "function":
            return self.function(text)
        if (kind, text) == ("sign", "("):
            run = self.expression(0)
            if not self.next(")"):
                raise NotComputedError("it cannot be read")
            return run
        raise NotComputedError("it cannot be read")

    def area(self, text: str) -> Run:
        bang = text.rfind("!")
        sheet, ends = self.sheet, text[bang + 1 :]
        if bang >= 0:
            named = text[:bang]
            named = named[1:-1].replace("''", "'") if named.startswith("'") else named
            if "[" in named:
                raise NotComputedError("it refers outside the workbook")
            if named.upper() not in self.book.called:
                raise NotComputedError(f"there is no sheet {named[:40]!r}")
            sheet = self.book.called[named.upper()]
        first, last = _END.findall(ends)
        reference = CellReference(
            sheet, (int(first[1]), int(last[1])), (int(first[3]), int(last[3])),
            (not first[0], not first[2], not last[0], not last[2]),
        )  # fmt: skip
        self.references.append(reference)
        if not ends.endswith(":"):
            return _run_of_cell(reference)
        run = _run_of_range(reference)
        self.ranges[run] = reference
        return run

    def name(self, text: str) -> Run:
        upper = text.upper()
        if upper in ("TRUE", "FALSE"):
            return _run_of_constant(upper == "TRUE")
        own = f"'{self.sheet}'!{text}".upper()
        meaning = self.book.meanings.get(own, self.book.meanings.get(upper))
        bare = upper.rpartition("!")[2]
        if meaning is None and bare != upper:  # a sheet before a name of the whole book
            meaning = self.book.meanings.get(bare)
        if meaning is None:
            outside = "[" in text and "]" in text
            raise NotComputedError(f"nothing is called {text[:40]}" if not outside else
                              f"it refers to {text[:40]}, which is not known")  # fmt: skip
        if bare in self.within or len(self.within) > 8:
            raise NotComputedError(f"the name {text[:40]} refers to itself")
        key = shape_key(f"={meaning.removeprefix('=')}", 1, 1)
        inner = _Parser(key, self.sheet, self.book, (*self.within, bare))
        inner.size = self.size
        run = inner.parsed()
        self.size = inner.size
        self.references += inner.references
        self.ranges |= inner.ranges
        self.names |= inner.names
        if inner.literals:
            self.names[bare] = tuple(inner.literals)
        return run

    def function(self, text: str) -> Run:
        name = text.upper().removeprefix("_XLFN.").removeprefix("_XLWS.")
        arguments: list[Run | None] = []
        if not self.next(")"):
            while True:
                kind, sign = self.tokens[self.at]
                empty = kind == "sign" and sign in ",;)"
                arguments.append(None if empty else self.expression(0))
                if self.next(")"):
                    break
                if not (self.next(",") or self.next(";")):
                    raise NotComputedError("it cannot be read")
        if name in OF_SINGLE_VALUES:
            arguments = [None if run is None else self.crossed(run) for run in arguments]
        if name not in FUNCTIONS:
            raise NotComputedError(f"it uses {name[:40]}")
        return FUNCTIONS[name](name, arguments)


def parse_formula(text: str, sheet: str, book: Book, key: str) -> Shape:
    """Compile the formula with this key; one that cannot be computed here has a reason."""
    if len(text) > MAX_FORMULA:
        return Shape(key, None, reason=f"it has more than {MAX_FORMULA:,} characters")
    try:
        parser = _Parser(key, sheet, book)
        run = parser.crossed(parser.parsed())
    except NotComputedError as error:
        return Shape(key, None, reason=str(error))
    return Shape(
        key, run, tuple(dict.fromkeys(parser.references)), tuple(parser.literals), parser.names
    )


# ---- compiled parts


def _run_of_constant(value: Scalar) -> Run:
    return lambda _: value


def _failing(error: str) -> Run:
    def run(_: "Site") -> object:
        raise CellError(error)

    return run


def _literal(value: float, sheet: str, within: tuple[str, ...], index: int) -> Run:
    name = within[-1] if within else ""

    def run(at: "Site") -> object:
        if at.literals:
            key: LiteralKey = (name, index) if name else (sheet, at.row, at.column, index)
            return at.literals.get(key, value)
        return value

    return run


def _run_of_cell(reference: CellReference) -> Run:
    sheet, (row_step, _), (column_step, _), (fixed_row, fixed_column, _, _), _ = reference

    def run(at: "Site") -> object:
        return One(
            sheet,
            row_step if fixed_row else (row_step + at.row - 1) % LAST_ROW + 1,
            column_step if fixed_column else (column_step + at.column - 1) % LAST_COLUMN + 1,
        )

    return run


def _run_of_range(reference: CellReference) -> Run:
    return lambda at: reference.at(at.row, at.column)


def _negative(run: Run) -> Run:
    return lambda at: -as_number(run(at), at)


def _number_of(run: Run) -> Run:
    return lambda at: as_number(run(at), at)


def _binary(sign: str, left: Run, right: Run) -> Run:
    if sign == "&":
        return lambda at: _joined(scalar(left(at), at), scalar(right(at), at))
    if sign in MEETS:
        return lambda at: compared(sign, scalar(left(at), at), scalar(right(at), at))
    function = _ARITHMETIC[sign]

    def run(at: "Site") -> object:
        result = function(as_number(left(at), at), as_number(right(at), at))
        if result - result != 0:
            raise CellError("#NUM!")
        return result

    return run


def _joined(left: Scalar, right: Scalar) -> str:
    return (as_text(left) + as_text(right))[:MAX_TEXT]


def _divided(a: float, b: float) -> float:
    if b == 0:
        raise CellError("#DIV/0!")
    return a / b


_ARITHMETIC = {"+": add, "-": sub, "*": mul, "/": _divided, "^": power}


# ---- evaluation


class Evaluator:
    """The values of a book: `values` by cell, and `reasons` for formulas that are not computed.

    `value` evaluates a cell again with other cells or typed numbers in place of those that the
    book holds.
    """

    def __init__(self, book: Book, texts: Mapping[Position, float] | None = None) -> None:
        self.book = book
        self.values: dict[Position, Scalar] = {}
        self.formulas: dict[Position, Shape] = {}
        self.reasons: dict[Position, str] = {}
        self.work = 0
        self._shapes: dict[tuple[str, str], Shape] = {}
        for place, cell in book.cells():
            if cell.formula is None:
                if cell.value is not None:
                    self.values[place] = Error(cell.value) if cell.error else cell.value
            else:
                self.formulas[place] = self.shape(cell.formula, place)
                if cell.array:
                    self.reasons[place] = "it is an array formula"
        self.values |= texts or {}
        self.pending = dict.fromkeys(self.formulas)
        self.order: dict[Position, int] = {}
        self._by_sheet: dict[str, dict[tuple[int, int], None]] = {}
        for sheet, row, column in self.formulas:
            self._by_sheet.setdefault(sheet, {})[row, column] = None
        self._finished: set[Area] = set()
        self.aggregates: dict[tuple[str, Area], float] = {}
        first = Site(self, {}, {}, None)
        for place in self.formulas:
            if place in self.pending:
                self._finish(place, first)
        self.unknown = {p for p in self.reasons if self.book[p].value is None}

    def shape(self, text: str, place: Position) -> Shape:
        """The shape of a formula at a place."""
        sheet, row, column = place
        key = shape_key(text, row, column) if len(text) <= MAX_FORMULA else text
        shape = self._shapes.get((sheet, key))
        if shape is None:
            shape = self._shapes[sheet, key] = parse_formula(text, sheet, self.book, key)
        return shape

    def used(self, area: Area) -> Area:
        """The part of an area within the rows and columns that its sheet uses."""
        rows, columns = self.book.size[area.sheet]
        return area._replace(
            bottom=max(min(area.bottom, rows), area.top),
            right=max(min(area.right, columns), area.left),
        )

    def has_subtotal(self, place: Position) -> bool:
        """Whether a cell has a formula with SUBTOTAL, which other subtotals leave out."""
        shape = self.formulas.get(place)
        return shape is not None and shape.has_subtotal

    def areas(self, place: Position) -> list[Area]:
        """The areas that the formula of a cell refers to; none for a cell without a formula."""
        shape = self.formulas.get(place)
        return [ref.at(place[1], place[2]) for ref in shape.references] if shape else []

    def precedents(self, place: Position) -> Iterator[Position]:
        """The cells that the formula of a cell refers to, within the used part of the sheets."""
        for area in self.areas(place):
            if area.cells == 1:
                yield (area.sheet, area.top, area.left)
            else:
                yield from self.used(area).places()

    def _waiting(self, place: Position) -> Iterator[Position]:
        """The formulas that must be evaluated before that of a cell."""
        for area in self.areas(place):
            if area.cells == 1:
                cell = (area.sheet, area.top, area.left)
                if cell in self.pending:
                    yield cell
            elif area not in self._finished:
                self._finished.add(area)
                used, formulas = self.used(area), self._by_sheet.get(area.sheet, {})
                self.work += min(used.cells, len(formulas))
                if self.work > MAX_WORK:
                    continue
                if used.cells > len(formulas):
                    inside = ((area.sheet, *at) for at in formulas)
                    yield from (p for p in inside if used.covers(p) and p in self.pending)
                else:
                    yield from (p for p in used.places() if p in self.pending)

    def _finish(self, place: Position, first: Site) -> None:
        """Evaluate a formula, and before it those that it reads."""
        stack = [(place, self._waiting(place))]
        started = {place}
        while stack:
            current, waiting = stack[-1]
            ahead = next((p for p in waiting if p not in started), None)
            if ahead is not None:
                started.add(ahead)
                stack.append((ahead, self._waiting(ahead)))
                continue
            stack.pop()
            if current not in self.pending:
                continue
            value = self.computed(current, first)
            del self.pending[current]
            self.order[current] = len(self.order)
            if value is not None:
                self.values[current] = value

    def computed(self, place: Position, at: Site) -> Scalar:
        """The value of the formula of a cell; the stored one if it is not computed here."""
        shape, stored = self.formulas[place], self.book[place]
        reason = self.reasons.get(place) or shape.reason
        if reason is None and shape.run is not None:
            try:
                return self.evaluated(shape, place, at)
            except NotComputedError as error:
                reason = str(error)
            except RecursionError:
                reason = "it is computed through too many cells"
        if at.affected is None:
            self.reasons[place] = reason or ""
        return Error(stored.value) if stored.error and stored.value else stored.value

    @staticmethod
    def evaluated(shape: Shape, place: Position, at: Site) -> Scalar:
        """The value of a shape at a place; what is blank becomes 0, as in spreadsheets."""
        assert shape.run is not None
        at.row, at.column = place[1:]
        try:
            value = scalar(shape.run(at), at)
        except CellError as fault:
            return fault.error
        except (OverflowError, ValueError, ZeroDivisionError):
            return Error("#NUM!")
        if value is None:
            return 0.0
        return float(value) if type(value) is int else value

    def value(
        self,
        place: Position,
        cells: Mapping[Position, Scalar],
        literals: Mapping[LiteralKey, float] | None = None,
        within: frozenset[Position] = frozenset(),
        shape: Shape | None = None,
    ) -> Scalar:
        """The value of a cell if other cells, or numbers typed into formulas, were replaced.

        Only the formulas `within` are evaluated again (see `cone`), apart from that of the cell
        itself; all others keep their values. `shape` takes the place of the cell's own formula.
        None stands for a blank cell, and for a formula that cannot be computed.
        """
        at = Site(self, dict(cells), literals or {}, within)
        if shape is None:
            if place in cells or place not in self.formulas:
                return at.value(place)
            if place in self.reasons:
                return self.values.get(place)
            shape = self.formulas[place]
        if shape.run is None:
            return None
        try:
            return self.evaluated(shape, place, at)
        except (NotComputedError, RecursionError):
            return None

    def cone(self, places: Iterable[Position], stop: Container[Position]) -> frozenset[Position]:
        """The formulas behind some cells: what they read, what that reads, and so on.

        Nothing behind the cells of `stop` is followed, nor large ranges.
        """
        cone: set[Position] = set()
        waiting = [p for p in places if p in self.formulas]
        while waiting and len(cone) < MAX_CONE:
            place = waiting.pop()
            if place in cone:
                continue
            cone.add(place)
            for area in self.areas(place):
                if area.cells <= MAX_FEW:
                    cells = (p for p in area.places() if p in self.formulas)
                    waiting += [p for p in cells if p not in stop and p not in cone]
        return frozenset(cone)

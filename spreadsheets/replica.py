"""A workbook calculated here, in doubles or in 80-bit long doubles: what an engine is held against.

An engine that computes in long doubles gives other last digits, and how far they may lie from the
doubles depends on every operation. So its arithmetic is repeated: the same formulas in the same
order, each constant the long double nearest to its decimal digits, rounded to doubles at the end.
"""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from spreadsheets.engines.base import address
from spreadsheets.formula import Area, Call, Name, Number, Text, Tree, UnsupportedError, parse
from spreadsheets.plan import Value

__all__ = ["has_long_doubles", "replicate"]

_Cell = tuple[str, int, int]
"""Sheet, row and column."""


class CellError(Exception):
    """An error value, such as "#NUM!"; handed on as a value, raised where it is computed with."""


def has_long_doubles() -> bool:
    """Whether this machine's NumPy has the 80-bit long doubles of Intel's processors."""
    import numpy as np

    return np.finfo(np.longdouble).nmant == 63


def replicate(path: Path, precision: str = "double") -> dict[str, dict[str, Value]]:
    """Every cell of an .xlsx file calculated again, by sheet and address, rounded to doubles.

    Stored values of formulas are not read. A cell that needs something unsupported is left out,
    and so are blank ones; an error is its text. "long double" wants `has_long_doubles`.
    """
    import numpy as np

    number = {"double": np.float64, "long double": np.longdouble}[precision]
    with np.errstate(all="ignore"):  # what is not finite becomes an error value
        return _Book(path, number).values()


class _Book:
    """The cells of a file, calculated when they are asked for."""

    def __init__(self, path: Path, number: Any) -> None:
        from openpyxl import load_workbook

        book = load_workbook(path)
        self._number = number
        self._functions = _functions(number)
        self._sheets = book.sheetnames
        self._names = {
            name.casefold(): str(defined.attr_text) for name, defined in book.defined_names.items()
        }
        self._contents: dict[_Cell, Any] = {
            (sheet.title, cell.row, cell.column): cell.value
            for sheet in book.worksheets
            for row in sheet.iter_rows()
            for cell in row
            if cell.value is not None
        }
        self._known: dict[_Cell, Any] = {}

    def values(self) -> dict[str, dict[str, Value]]:
        """What every cell holds."""
        found: dict[str, dict[str, Value]] = {sheet: {} for sheet in self._sheets}
        for sheet, row, column in self._long_sheets_first():
            try:
                value = self._cell((sheet, row, column))
            except UnsupportedError:
                continue
            if value is not None and value != "":
                found[sheet][address(row, column)] = _plain(value)
        return found

    def _long_sheets_first(self) -> list[_Cell]:
        """All cells, those of the largest sheet first.

        So a long column is filled from its top before another sheet asks for its end, which
        would have to call its way up through all rows.
        """
        sizes = dict.fromkeys(self._sheets, 0)
        for sheet, _, _ in self._contents:
            sizes[sheet] += 1
        return sorted(self._contents, key=lambda cell: -sizes[cell[0]])

    def _cell(self, cell: _Cell) -> Any:
        if cell not in self._known:
            self._known[cell] = UnsupportedError(f"{cell} depends on itself")
            try:
                self._known[cell] = self._content(cell)
            except UnsupportedError as reason:
                self._known[cell] = reason
        value = self._known[cell]
        if isinstance(value, UnsupportedError):
            raise value
        return value

    def _content(self, cell: _Cell) -> Any:
        content = self._contents.get(cell)
        if isinstance(content, str) and content.startswith("="):
            value = self._scalar(parse(content), cell[0])
            return self._number(0) if value is None else value
        if content is None or isinstance(content, bool | str):
            return content
        # The shortest digits that give this double: those that the file holds.
        return self._number(repr(float(content)))

    def _scalar(self, tree: Tree, sheet: str) -> Any:
        value = self._evaluate(tree, sheet)
        if isinstance(value, list):
            raise UnsupportedError("several cells where one value is wanted")
        return value

    def _evaluate(self, tree: Tree, sheet: str) -> Any:
        """A value, or the list of the values of several cells."""
        match tree:
            case Number(text):
                return self._number(text)
            case Text(text):
                return text
            case Name(name):
                return self._named(name, sheet)
            case Area(first=first, last=last):
                cells = [self._cell(cell) for cell in _cells(tree, sheet)]
                return cells[0] if first == last else cells
            case Call(function, arguments):
                try:
                    return self._call(function, arguments, sheet)
                except CellError as fault:
                    return fault

    def _named(self, name: str, sheet: str) -> Any:
        if name in ("TRUE", "FALSE"):
            return name == "TRUE"
        if name.casefold() not in self._names:
            return CellError("#NAME?")
        return self._evaluate(parse(self._names[name.casefold()]), sheet)

    def _call(self, function: str, arguments: tuple[Tree, ...], sheet: str) -> Any:
        if function == "IF":
            # Only the branch taken is calculated.
            branch = 1 if _truth(self._scalar(arguments[0], sheet)) else 2
            return self._evaluate(arguments[branch], sheet) if branch < len(arguments) else False
        if function == "ROW" and len(arguments) == 1 and isinstance(arguments[0], Area):
            return self._number(arguments[0].first[0])
        if function not in self._functions:
            raise UnsupportedError(f"no function {function}")
        values = [self._evaluate(argument, sheet) for argument in arguments]
        try:
            return self._functions[function](*values)
        except TypeError as error:
            raise UnsupportedError(f"{function}: {error}") from error


def _cells(area: Area, sheet: str) -> Iterator[_Cell]:
    """The cells of an area, row by row."""
    for row in range(area.first[0], area.last[0] + 1):
        for column in range(area.first[1], area.last[1] + 1):
            yield area.sheet or sheet, row, column


def _functions(number: Any) -> dict[str, Callable[..., Any]]:
    """Operators and functions over values of that type, by name."""
    import numpy as np

    def real(function: Callable[..., Any]) -> Callable[..., Any]:
        """A function of numbers that gives a number."""

        def called(*values: Any) -> Any:
            result = number(function(*(_number(value, number) for value in values)))
            if not np.isfinite(result):
                raise CellError("#NUM!")
            return result

        return called

    def divide(one: Any, other: Any) -> Any:
        if other == 0:
            raise CellError("#DIV/0!")
        return one / other

    def index(cells: list[Any], at: Any) -> Any:
        place = int(_number(at, number))
        if not 1 <= place <= len(cells):
            raise CellError("#REF!")
        return cells[place - 1]

    def count_if(cells: list[Any], wanted: Any) -> Any:
        if not isinstance(wanted, str) or set(wanted) & set("<>=*?~") or not wanted:
            raise UnsupportedError(f"COUNTIF with the condition {wanted!r}")
        return number(sum(_kind(cell) == "text" and _equal(cell, wanted) for cell in cells))

    return {
        "+": real(lambda one, other=None: one if other is None else one + other),
        "-": real(lambda one, other=None: -one if other is None else one - other),
        "*": real(lambda one, other: one * other),
        "/": real(divide),
        "^": real(np.power),
        "&": lambda one, other: _text(one) + _text(other),
        "=": _equal,
        "<>": lambda one, other: not _equal(one, other),
        "<": _less,
        ">": lambda one, other: _less(other, one),
        "<=": lambda one, other: not _less(other, one),
        ">=": lambda one, other: not _less(one, other),
        "PI": lambda: number("3.14159265358979323846264338327950288"),
        "SQRT": real(np.sqrt),
        "LN": real(np.log),
        "LOG10": real(np.log10),
        "EXP": real(np.exp),
        "SIN": real(np.sin),
        "ASIN": real(np.arcsin),
        "ABS": real(np.abs),
        "INT": real(np.floor),
        "ROUND": real(_rounded),
        "MIN": lambda *areas: min(_numbers(areas), default=number(0)),
        "MAX": lambda *areas: max(_numbers(areas), default=number(0)),
        "COUNT": lambda *areas: number(sum(_kind(cell) == "number" for cell in _flat(areas))),
        "COUNTIF": count_if,
        "INDEX": index,
        "ISNUMBER": lambda value: _kind(value) == "number",
        "AND": lambda *values: min(map(_truth, values)),
        "OR": lambda *values: max(map(_truth, values)),
        "NOT": lambda value: not _truth(value),
        "IFERROR": lambda value, other: other if isinstance(value, CellError) else value,
    }


def _rounded(value: Any, digits: Any) -> Any:
    """Half away from zero, in the arithmetic of `value`."""
    scale = type(value)(10) ** digits
    away = type(value)("0.5") if value >= 0 else type(value)("-0.5")
    return type(value)(int(value * scale + away)) / scale


_RANKS = ("number", "text", "truth")
"""Values of different kinds are ordered by kind: every text is above every number."""


def _kind(value: Any) -> str:
    """Number, text, truth, blank or fault."""
    kinds = {bool: "truth", str: "text", type(None): "blank", CellError: "fault"}
    if isinstance(value, list):
        raise UnsupportedError("several cells where one value is wanted")
    return kinds.get(type(value), "number")


def _number(value: Any, number: Any) -> Any:
    """A value to compute with. A text is none, even if it spells a number."""
    kind = _kind(value)
    if kind == "fault":
        raise value
    if kind == "text":
        raise CellError("#VALUE!")
    return value if kind == "number" else number(value or 0)


def _flat(areas: tuple[Any, ...]) -> Iterator[Any]:
    """Every cell of the areas."""
    for area in areas:
        yield from area if isinstance(area, list) else [area]


def _numbers(areas: tuple[Any, ...]) -> Iterator[Any]:
    """The numbers among cells; texts, truths and blanks do not count."""
    for cell in _flat(areas):
        if _kind(cell) == "fault":
            raise cell
        if _kind(cell) == "number":
            yield cell


def _truth(value: Any) -> bool:
    kind = _kind(value)
    if kind == "fault":
        raise value
    if kind == "text":
        raise CellError("#VALUE!")
    return bool(value)


def _text(value: Any) -> str:
    kind = _kind(value)
    if kind == "fault":
        raise value
    if kind not in ("text", "blank"):
        raise UnsupportedError(
            "a number joined to a text, which every program spells in its own way"
        )
    return value or ""


def _equal(one: Any, other: Any) -> bool:
    return _ordered(one, other) == _ordered(other, one)


def _less(one: Any, other: Any) -> bool:
    return bool(_ordered(one, other) < _ordered(other, one))


def _ordered(value: Any, other: Any) -> tuple[int, Any]:
    """What to compare `value` by; a blank cell takes the kind of what it is compared with."""
    kind = _kind(value)
    if kind == "fault":
        raise value
    if kind == "blank":
        kind = "number" if _kind(other) in ("blank", "fault") else _kind(other)
        value = "" if kind == "text" else 0
    return _RANKS.index(kind), value.casefold() if kind == "text" else value


def _plain(value: Any) -> Value:
    """Python's own type; an error as its text."""
    if isinstance(value, CellError):
        return str(value)
    return value if isinstance(value, bool | str) else float(value)

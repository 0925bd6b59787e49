"""A formula's text -> a tree, for the part of the formula language that the workbooks use."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

__all__ = ["Area", "Call", "Name", "Number", "Text", "Tree", "UnsupportedError", "parse"]


class UnsupportedError(Exception):
    """A formula uses something that is not written here. Its message is one line."""


@dataclass(frozen=True, slots=True)
class Number:
    """A number as typed, for whoever reads it to choose its precision."""

    text: str


@dataclass(frozen=True, slots=True)
class Text:
    """A text in quotes, without them."""

    text: str


@dataclass(frozen=True, slots=True)
class Area:
    """One cell, or all between two corners; `sheet` is empty on the formula's own sheet.

    Corners are (row, column), both counted from 1.
    """

    sheet: str
    first: tuple[int, int]
    last: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Name:
    """A defined name, or TRUE or FALSE."""

    name: str


@dataclass(frozen=True, slots=True)
class Call:
    """A function or an operator with its arguments; a sign is an operator with one."""

    function: str
    arguments: "tuple[Tree, ...]"


Tree = Number | Text | Area | Name | Call

_LEVELS = (("=", "<>", "<", "<=", ">", ">="), ("&",), ("+", "-"), ("*", "/"), ("^",))
"""Operators from the loosest to the tightest; each level groups from the left, "^" too."""

_CELL = r"\$?[A-Z]{1,3}\$?\d+"
_TOKEN = re.compile(
    rf"""\s*(?:
    (?P<number>(?:\d+\.?\d*|\.\d+)(?:E[+-]?\d+)?)
    | (?P<text>"(?:[^"]|"")*")
    | (?P<area>(?:(?:'(?:[^']|'')+'|[^\W\d][\w.]*)!)?{_CELL}(?::{_CELL})?)(?![\w.(])
    | (?P<call>[A-Z][A-Z0-9.]*)\(
    | (?P<name>[^\W\d][\w.]*)
    | (?P<sign><=|>=|<>|[-+*/^&=<>(),])
    )\s*""",
    re.VERBOSE,
)


def parse(formula: str) -> Tree:
    """The tree of a formula, with or without its "=". Raises UnsupportedError.

    >>> parse("=2*A1")
    Call(function='*', arguments=(Number(text='2'), Area(sheet='', first=(1, 1), last=(1, 1))))
    """
    parser = _Parser(list(_tokens(formula)))
    tree = parser.operation(0)
    parser.expect("end", "")
    return tree


def _tokens(formula: str) -> Iterator[tuple[str, str]]:
    """Kind and text of each token, and an end."""
    at = len(formula) - len(formula.removeprefix("="))
    while at < len(formula):
        found = _TOKEN.match(formula, at)
        if found is None:
            raise UnsupportedError(f"cannot read {formula[at:]!r} in {formula}")
        assert found.lastgroup is not None
        yield found.lastgroup, found[found.lastgroup]
        at = found.end()
    yield "end", ""


class _Parser:
    """Takes the tokens one by one, from the loosest operator down to single terms."""

    def __init__(self, tokens: list[tuple[str, str]]) -> None:
        self._tokens = tokens[::-1]

    def expect(self, kind: str, text: str) -> None:
        """Take that token, or raise UnsupportedError."""
        found = self._tokens.pop()
        if found != (kind, text):
            raise UnsupportedError(f"{found[1]!r} stands where {text!r} is wanted")

    def operation(self, level: int) -> Tree:
        """Terms joined by the operators of a level and of all tighter ones."""
        if level == len(_LEVELS):
            return self._signed()
        left = self.operation(level + 1)
        while self._next_is(*_LEVELS[level]):
            operator = self._tokens.pop()[1]
            left = Call(operator, (left, self.operation(level + 1)))
        return left

    def _next_is(self, *signs: str) -> bool:
        kind, text = self._tokens[-1]
        return kind == "sign" and text in signs

    def _signed(self) -> Tree:
        if self._next_is("-", "+"):
            return Call(self._tokens.pop()[1], (self._signed(),))
        return self._term()

    def _term(self) -> Tree:
        kind, text = self._tokens.pop()
        match kind:
            case "number":
                return Number(text)
            case "text":
                return Text(text[1:-1].replace('""', '"'))
            case "area":
                return _area(text)
            case "name":
                return Name(text)
            case "call":
                return Call(text, tuple(self._arguments()))
        if (kind, text) != ("sign", "("):
            raise UnsupportedError(f"{text!r} stands where a term is wanted")
        inner = self.operation(0)
        self.expect("sign", ")")
        return inner

    def _arguments(self) -> Iterator[Tree]:
        while not self._next_is(")"):
            yield self.operation(0)
            if not self._next_is(")"):
                self.expect("sign", ",")
        self.expect("sign", ")")


def _area(text: str) -> Area:
    sheet, _, cells = text.rpartition("!")
    if sheet.startswith("'"):
        sheet = sheet[1:-1].replace("''", "'")
    first, _, last = cells.replace("$", "").partition(":")
    return Area(sheet, _corner(first), _corner(last or first))


def _corner(cell: str) -> tuple[int, int]:
    letters = cell.rstrip("0123456789")
    column = 0
    for letter in letters:
        column = column * 26 + ord(letter) - ord("A") + 1
    return int(cell[len(letters) :]), column

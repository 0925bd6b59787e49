"""The tables of the files of `reference/report`, and where in the report their quotes stand.

What each key means is said at the head of its file.
"""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any, Literal

import msgspec

from reference.printed import Interval, Printed, parse
from reference.units import to_si


class LedgerError(ValueError):
    """Something in the ledger is wrong; the message names the entry and what would be right."""


Kind = Literal[
    "input", "result", "approximation", "order of magnitude", "bound", "comparison", "range",
    "quoted", "constant", "remark",
]  # fmt: skip
Relation = Literal["<", "<=", ">", ">="]


class Entry(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A table of a file, which may hold no keys but its own."""


class ClaimEntry(Entry, frozen=True):
    """A [[claim]]."""

    id: str
    title: str
    quote: str
    kind: Kind
    unit: str = "1"
    computed_by: str | None = None
    rests_on: dict[str, str] = {}
    readings: dict[str, str] = {}
    given: str | None = None
    shown_by: list[str] = []
    relation: Relation | None = None
    against: str | None = None
    assumes: str | None = None
    exact: bool = False
    cell: str | None = None
    row: int | None = None
    quantity: str | None = None
    workbook: str | None = None


class EquationEntry(Entry, frozen=True):
    """An [[equation]]."""

    id: str
    title: str
    quote: str
    kind: Literal["derived", "definition", "taken over"]
    follows_from: str


class Inferred(Entry, frozen=True):
    """An input that the report does not print, to be inferred from the numbers that it does."""

    title: str
    symbol: str
    unit: str
    quantity: str
    search: tuple[Fraction, Fraction]
    nominal: Fraction
    nominal_source: str
    mass: str
    radius: str
    density: str
    header: list[str]
    results: list[str]
    evidence: list[str]


class Symbol(Entry, frozen=True):
    """What a symbol of the equations means, how the report writes it, and how a page shows it."""

    written: list[str]
    shown: str
    unit: str
    means: str
    value: str | None = None


class Quantity(Entry, frozen=True):
    """A physical quantity: the range of it that is searched, in its unit, and why this one."""

    unit: str
    search: tuple[Fraction, Fraction]
    reason: str


class Slip(Entry, frozen=True):
    """What the author may have computed instead: another text of an equation, or other inputs."""

    name: str
    reason: str
    equation: str
    text: str | None = None
    inputs: dict[str, str] = {}


class Source(Entry, frozen=True):
    """A public source for a number that the report takes from nowhere; see sources.toml."""

    id: str
    title: str
    address: str
    quote: str
    unit: str
    applies: str
    claims: list[str]

    @property
    def numbers(self) -> list[Printed]:
        """The number that it prints, or the two ends of a range."""
        return [parse(text) for text in re.findall("⟦(.*?)⟧", self.quote)]

    @property
    def says(self) -> str:
        """The number or the range as text, without its unit."""
        return " to ".join(number.text for number in self.numbers)

    @property
    def value(self) -> Fraction:
        """The number in SI; of a range, its lower end."""
        return self.numbers[0].value * to_si(self.unit)

    @property
    def interval(self) -> Interval:
        """What agrees with it, in SI."""
        ends = [number.interval() for number in self.numbers]
        whole = Interval(ends[0].lower, ends[-1].upper, ends[0].lower_closed, ends[-1].upper_closed)
        return whole.scaled(to_si(self.unit))


class Report(Entry, frozen=True):
    """What is audited."""

    text: str
    title: str
    author: str
    year: int


class Furniture(Entry, frozen=True):
    """Digits and number words of the text that are no quantities."""

    pattern: str
    reason: str


class Document(Entry, frozen=True):
    """The whole of ledger.toml."""

    report: Report
    reasons: dict[str, str]
    table: dict[Literal["blank"], list[str]]
    groups: dict[str, dict[str, str]]
    inferred: dict[str, Inferred]
    symbols: dict[str, Symbol]
    quantities: dict[str, Quantity]
    furniture: list[Furniture]
    equation_entries: list[EquationEntry] = msgspec.field(name="equation")
    claim_entries: list[ClaimEntry] = msgspec.field(name="claim")
    slips: list[Slip] = msgspec.field(name="slip", default=[])


def converted(document: Any, kind: Any, file: str) -> Any:
    """Parsed TOML as structs. Raises LedgerError where it does not fit them."""

    def named(place: re.Match[str]) -> str:
        """An entry by its id or name, where it has one, instead of by its number."""
        entry = (document[place[1]] if place[1] else document)[int(place[2])]
        return f"{place[1] or 'entry'} {entry.get('id') or entry.get('name') or place[2]!r}"

    try:
        return msgspec.convert(document, kind, dec_hook=lambda kind, value: kind(value))
    except msgspec.ValidationError as error:
        says = re.sub(r"\$(?:\.(\w+))?\[(\d+)\]", named, str(error))
        raise LedgerError(f"{file}: {says}") from error


@contextmanager
def naming(who: str) -> Iterator[None]:
    """What is wrong with an entry is told with its name before it."""
    try:
        yield
    except (ValueError, ArithmeticError) as error:
        raise LedgerError(f"{who}: {error}") from error


# Places in the text


@dataclass(frozen=True, slots=True)
class Place:
    """Where something stands: characters and line of the text, section, equation, table cell."""

    start: int
    end: int
    line: int
    section: str
    equation: str | None
    cell: str | None

    @property
    def order(self) -> tuple[bool, int, str]:
        """By place in the text; the table, which ends it, cell by cell."""
        return (True, int(self.cell[1:]), self.cell) if self.cell else (False, self.start, "")

    def __str__(self) -> str:
        if self.cell:
            return f"Table A-1, cell {self.cell}"
        where = f"{self.section}, line {self.line}"
        return f"{where}, Eq. {self.equation}" if self.equation else where


def place_of(text: str, quote: str, cell: str | None = None) -> Place:
    """Where the marked words of a quote stand. Raises ValueError unless they stand there once."""
    match = re.fullmatch("(.*?)⟦(.*?)⟧(.*)", quote, re.DOTALL)
    if match is None:
        raise ValueError("its quote needs the printed text between ⟦ and ⟧")
    words = "".join(match.groups())
    if (times := text.count(words)) != 1:
        raise ValueError(f"the report has {words!r} {times} times, not once")
    start = text.index(words) + len(match[1])
    section = next(name for at, name in reversed(_sections(text)) if at <= start)
    equation = next((name for at, end, name in _displays(text) if at <= start < end), None)
    line = text.count("\n", 0, start) + 1
    return Place(start, start + len(match[2]), line, section, equation, cell)


@cache
def _sections(text: str) -> list[tuple[int, str]]:
    """Where the parts of the report begin, and what they are called."""
    headings = re.finditer(r"(?m)^ ?(?:\d+\. (ABSTRACT)|(\d)\. [A-Z]|(Appendix)\.)", text)
    named = ((h.start(), f"section {h[2]}" if h[2] else (h[1] or h[3]).lower()) for h in headings)
    return [(0, "title"), *named]


@cache
def _displays(text: str) -> list[tuple[int, int, str]]:
    """Where the numbered equations stand, and their numbers."""
    numbered = r"\$\$(?:(?!\$\$).)*?\\quad \((?:\\text\{)?([-A\d]+)\}?\)"
    return [(*match.span(), match[1]) for match in re.finditer(numbered, text, re.DOTALL)]

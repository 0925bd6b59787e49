"""The tables of the files of `reference/report`, and where in the report their quotes stand.

What each key means is said at the head of its file.
"""

import re
from fractions import Fraction
from functools import cache
from typing import Literal

import msgspec

from reference.printed import Interval, Printed, parse
from reference.units import to_si

Kind = Literal[
    "input", "result", "approximation", "order of magnitude", "bound", "comparison", "range",
    "quoted", "constant", "remark",
]  # fmt: skip
Relation = Literal["<", "<=", ">", ">="]


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A table of a file, which may hold no keys but its own."""


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


class Place(msgspec.Struct, frozen=True):
    """Where something stands: characters and line of the text, section, equation, table cell."""

    start: int = 0
    end: int = 0
    line: int = 0
    section: str = ""
    equation: str | None = None
    cell: str | None = None

    def __str__(self) -> str:
        if self.cell:
            return f"Table A-1, cell {self.cell}"
        where = f"{self.section}, line {self.line}"
        return f"{where}, Eq. {self.equation}" if self.equation else where


def place_of(text: str, quote: str, cell: str | None = None) -> Place:
    """Where the marked words of a quote stand. Raises ValueError unless they stand there once."""
    before, own, after = re.split("[⟦⟧]", quote)
    words = before + own + after
    if (times := text.count(words)) != 1:
        raise ValueError(f"the report has {words!r} {times} times, not once")
    start = text.index(words) + len(before)
    section = next(name for at, name in reversed(_sections(text)) if at <= start)
    equation = next((name for at, end, name in _displays(text) if at <= start < end), None)
    line = text.count("\n", 0, start) + 1
    return Place(start, start + len(own), line, section, equation, cell)


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


# Equations and formulas


class Side(Entry, frozen=True, kw_only=True):
    """A side of an equation, or its slope by a symbol, with something put in for its symbols."""

    side: int = -1
    put: dict[str, str] = {}
    slope: str | None = None


class Premise(Side, frozen=True):
    """What another equation is derived from."""

    equation: str


class Condition(Side, frozen=True):
    """What must hold of an equation, so that it follows from its premises."""

    says: str
    equals: str


class Equation(Entry, frozen=True, eq=False):
    """An [[equation]], and where it stands."""

    id: str
    title: str
    quote: str
    kind: Literal["derived", "definition", "taken over"]
    follows_from: str
    checks: list[Condition] = []
    premises: dict[str, Premise] = {}
    place: Place = Place()


class Computation(Entry, frozen=True, eq=False):
    """A [[computation]]: what it computes, and its formula in the report's notation.

    Without a formula it is the function of its name in reference/formulas.py. What `restates` only
    repeats or counts what the report prints elsewhere. `by_row`: it takes the number of a row of
    the sheet (1 is the first time step); `by_scheme`: it runs the sheet, in either of the two
    schemes that fit the report's words.
    """

    name: str
    summary: str
    formula: str | None = None
    premises: dict[str, Premise] = {}
    restates: bool = False
    by_row: bool = False
    by_scheme: bool = False

    @property
    def equations(self) -> list[str]:
        """The printed equations that it evaluates."""
        return [premise.equation for premise in self.premises.values()]

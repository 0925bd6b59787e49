"""What a workbook holds, cell by cell, before any file exists.

A cell holds a text, a number that is known when the workbook is planned, or something whose value
is supplied later under the cell's *key* (`high.row[17].depth`): an input, or a formula. Whoever
supplies the values never sees the formulas, so that the two can be compared.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

Value = float | str | bool
"""What a cell shows: numbers are float; the empty string is what a formula leaves for blank."""

Place = tuple[str, str]
"""Sheet name and address: ("Crater", "C5")."""


class Limits(NamedTuple):
    """The least and the greatest number that may be typed into an input, in its unit."""

    least: float
    most: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """One cell.

    It holds a `text`, a `number`, an input (a `key` alone), or a `formula` with a key; or nothing
    but a style.

    name: what formulas call it. unit: of its value, spelled as in the ledger. claim: the id of the
    claim whose printed text, or printed number, it shows. transcendental: its value passes through
    LN, SIN, ASIN or a cube root, whose last digits depend on the program; all other values are the
    same double everywhere. column: names a set of cells of like size, such as the velocities of a
    sheet; their rounding errors are as large as the largest of them allows. link: where a click on
    the text leads. limits, choices: what may be typed. wrap: long text takes several lines.
    """

    text: str = ""
    number: float | None = None
    key: str = ""
    formula: str = ""
    style: str = "body"
    number_format: str = "General"
    name: str = ""
    unit: str = "1"
    claim: str = ""
    transcendental: bool = False
    column: str = ""
    link: Place | None = None
    limits: Limits | None = None
    choices: tuple[str, ...] = ()
    wrap: bool = False

    def __post_init__(self) -> None:
        if sum((bool(self.text), self.number is not None, bool(self.key))) > 1:
            raise ValueError(f"a cell holds a text, a number or a key, one of them: {self!r}")
        if self.formula and not (self.key and self.formula.startswith("=")):
            raise ValueError(f"a formula starts with '=' and has a key: {self!r}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """A style that a range of cells takes while a formula, written for its first cell, is true."""

    cells: str
    formula: str
    style: str


class Series(NamedTuple):
    """One curve: the cell with its name, and the cells of its x and y, such as "A5:A25"."""

    name: Place
    x: str
    y: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Chart:
    """Curves of the sheet's own cells, drawn with the upper left corner in the cell `at`.

    Axis titles name quantity and unit; `description` says in words what the chart shows. With
    `logarithmic` both axes are. size: width and height in pixels.
    """

    at: str
    title: str
    description: str
    x_title: str
    y_title: str
    series: tuple[Series, ...]
    logarithmic: bool = False
    size: tuple[int, int] = (820, 470)


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetPlan:
    """One sheet: cells by address, column widths in characters, and how it scrolls and prints.

    frozen: the first cell that scrolls. repeated_rows: first and last row that head every printed
    page. print_area: the cells printed, all by default. page_break: the last row of page 1.
    filtered: a table with a filter.
    """

    name: str
    cells: Mapping[str, Cell]
    widths: Mapping[str, float]
    frozen: str = ""
    repeated_rows: tuple[int, int] | None = None
    rules: tuple[Rule, ...] = ()
    charts: tuple[Chart, ...] = ()
    print_area: str = ""
    page_break: int | None = None
    filtered: str = ""


@dataclass(frozen=True, kw_only=True)
class WorkbookPlan:
    """The sheets in order. Raises ValueError for a key or a defined name that stands twice."""

    sheets: tuple[SheetPlan, ...]
    title: str
    properties: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        cells = [cell for _, cell in self.cells()]
        _require_unique("key", [cell.key for cell in cells if cell.key])
        # Excel takes names that differ only in case as the same.
        _require_unique("name", [cell.name.casefold() for cell in cells if cell.name])

    def cells(self) -> Iterator[tuple[Place, Cell]]:
        """Every cell with its place, sheet by sheet."""
        for sheet in self.sheets:
            for address, cell in sheet.cells.items():
                yield (sheet.name, address), cell

    @cached_property
    def where(self) -> Mapping[str, Place]:
        """Key -> the place of the cell that holds it."""
        return {cell.key: place for place, cell in self.cells() if cell.key}

    def cell(self, place: Place) -> Cell:
        """The cell at a place. Raises KeyError where there is none."""
        sheet, address = place
        return next(each for each in self.sheets if each.name == sheet).cells[address]


def place_of(text: str) -> Place:
    """A place that is written as in a formula, without quotes.

    >>> place_of("Table A-1!B3")
    ('Table A-1', 'B3')
    """
    sheet, _, address = text.rpartition("!")
    return sheet, address


def _require_unique(what: str, items: list[str]) -> None:
    twice = sorted(item for item, count in Counter(items).items() if count > 1)
    if twice:
        raise ValueError(f"{what} used twice in the workbook: {', '.join(twice)}")

"""What a workbook holds, cell by cell, before any file exists: formula texts, but no values.

A value is supplied later under the cell's *key* (`low.final_depth`, `high.row[17].depth`), by code
that never sees the formula. `WorkbookPlan.where` answers which cell computes a key.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

__all__ = [
    "Cell",
    "Chart",
    "Limits",
    "Place",
    "Rule",
    "Series",
    "SheetPlan",
    "Value",
    "WorkbookPlan",
]

Value = float | str | bool
"""What a cell shows: numbers are float; the empty string is what a guarded formula leaves."""

Place = tuple[str, str]
"""Sheet name and address: ("Crater", "C5")."""


@dataclass(frozen=True, slots=True)
class Limits:
    """What an input may be: above `least`, or from it on where `closed`, and not above `most`."""

    least: float = 0.0
    closed: bool = False
    most: float | None = None

    @property
    def words(self) -> str:
        """The limits as a message says them.

        >>> Limits().words, Limits(closed=True).words, Limits(most=0.5).words
        ('greater than 0', 'at least 0', 'greater than 0 and at most 0.5')
        """
        low = f"{'at least' if self.closed else 'greater than'} {self.least:g}"
        return low if self.most is None else f"{low} and at most {self.most:g}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """One cell: a `text`, a number under a `key`, a `formula` with its value under a key, or blank.

    `name` defines the cell's name in the workbook; `unit` and `source` (section or equation of the
    report) are what the neighboring cells print. `transcendental` marks a value that passes through
    LN, EXP, SIN, ASIN or a cube root, whose last digits depend on the C library; all others are the
    same double everywhere. `link` is the sheet, and the cell of it, that a text cell leads to;
    `limits` tell what may be typed into an input.
    """

    text: str = ""
    key: str = ""
    formula: str = ""
    style: str = "body"
    number_format: str = "General"
    name: str = ""
    unit: str = ""
    source: str = ""
    transcendental: bool = False
    link: Place | None = None
    limits: Limits | None = None

    def __post_init__(self) -> None:
        if self.text and self.key:
            raise ValueError(f"a cell has a text or a key, not both: {self!r}")
        if self.formula and not (self.key and self.formula.startswith("=")):
            raise ValueError(f"a formula starts with '=' and has a key: {self!r}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """A style that a range of cells takes while a formula, written for its first cell, is true."""

    cells: str
    formula: str
    style: str


@dataclass(frozen=True, slots=True)
class Series:
    """One curve: its `name` in the legend, and the cells of its x and y, such as "A5:A25"."""

    name: str
    x: str
    y: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Chart:
    """Curves of the sheet's own cells, drawn with the upper left corner in the cell `at`.

    Axis titles name quantity and unit. With `categories` the x are labels at equal distances, so
    that the axis spans them exactly, whatever they are; with `logarithmic` both axes are.
    """

    at: str
    title: str
    x_title: str
    y_title: str
    series: tuple[Series, ...]
    categories: bool = False
    logarithmic: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetPlan:
    """One sheet: cells by address, column widths in characters, and how it scrolls and prints."""

    name: str
    cells: Mapping[str, Cell]
    widths: Mapping[str, float]
    frozen: str = ""
    """The first cell that scrolls."""
    repeated_rows: tuple[int, int] | None = None
    """Rows (first, last) printed at the head of every page."""
    rules: tuple[Rule, ...] = ()
    charts: tuple[Chart, ...] = ()
    print_area: str = ""
    """The cells that are printed, such as "A1:N184"; all of them by default."""


@dataclass(frozen=True, kw_only=True)
class WorkbookPlan:
    """The sheets in order. Raises ValueError for a key or a defined name that stands twice."""

    sheets: tuple[SheetPlan, ...]
    title: str
    author: str
    subject: str
    keywords: str = ""
    comments: str = ""

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

    @cached_property
    def transcendental(self) -> frozenset[Place]:
        """The places whose values may differ in the last digits between C libraries."""
        return frozenset(place for place, cell in self.cells() if cell.transcendental)


def _require_unique(what: str, items: list[str]) -> None:
    twice = sorted(item for item, count in Counter(items).items() if count > 1)
    if twice:
        raise ValueError(f"{what} used twice in the workbook: {', '.join(twice)}")

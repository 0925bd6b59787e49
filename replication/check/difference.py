"""One difference between two workbooks, and how cells and their number are written."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from spreadsheets.engines import address
from spreadsheets.foreign import Position, Value


@dataclass(frozen=True)
class Difference:
    """What differs in some cells, the first of which is the one to look at.

    `expected` is what the first workbook holds there, `found` what the second does.
    """

    kind: str
    cells: tuple[Position, ...]
    expected: Value | None
    found: Value | None
    explanation: str

    @property
    def place(self) -> Position:
        """The cell to look at."""
        return self.cells[0]

    def record(self) -> dict[str, Any]:
        """Return the JSON entry, in which `cells` is a range and `count` the number of cells."""
        sheets = {sheet for sheet, _, _ in self.cells}
        cells = span((row, column) for _, row, column in self.cells)
        if len(sheets) > 1 or not is_range([(row, column) for _, row, column in self.cells]):
            cells = f"{address(*self.place[1:])} and {counted(len(self.cells) - 1, 'cell')} more"
        expected, content = (
            str(value).upper() if isinstance(value, bool) else value
            for value in (self.expected, self.found)
        )
        return {
            "sheet": self.place[0], "cell": address(*self.place[1:]), "kind": self.kind,
            "expected": expected, "found": content, "explanation": self.explanation,
            "cells": cells, "count": len(self.cells),
        }  # fmt: skip


def is_range(cells: Iterable[tuple[int, int]]) -> bool:
    """Whether some cells fill a rectangle."""
    places = set(cells)
    rows, columns = map(set, zip(*places, strict=True))
    area = (max(rows) - min(rows) + 1) * (max(columns) - min(columns) + 1)
    return bool(len(places) == area)


def span(cells: Iterable[tuple[int, int]]) -> str:
    """Return the smallest range around some cells, given by row and column.

    >>> span([(3, 2), (1, 4)]), span([(1, 1)])
    ('B1:D3', 'A1')
    """
    rows, columns = zip(*cells, strict=True)
    first, last = address(min(rows), min(columns)), address(max(rows), max(columns))
    return first if first == last else f"{first}:{last}"


def counted(number: int, what: str) -> str:
    """Return a number and the noun that it counts.

    >>> counted(1, "cell"), counted(2000, "cell")
    ('1 cell', '2,000 cells')
    """
    return f"{number:,} {what}{'s' * (number != 1)}"

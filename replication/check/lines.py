"""Lines of numbers in a workbook: a column, or a row that runs to the right, with its head."""

import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

from replication.check.words import column_roles, is_unit, unit_in
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation

LEAST = 4
"""Fewer numbers are no line; the report itself prints five rows."""
_GAP = 3
"""Cells that a line may lack in its middle."""
_ABOVE = 6
"""How far above its first number a line's head may stand."""


@dataclass(frozen=True)
class Line:
    """Numbers in one column (or row) of a sheet, from the row (or column) `first` on.

    `values` are None where a cell has no number. `given` is the role that the user gave it. Rows
    are counted without those of `left_out`, which are blank and over which the formulas step.
    """

    sheet: str
    number: int
    first: int
    values: tuple[float | None, ...]
    across: bool
    head: str | None = None
    unit: str | None = None
    unit_place: Position | None = None
    given: str | None = None
    left_out: tuple[int, ...] = ()

    @property
    def last(self) -> int:
        """The row, or column, of the last cell."""
        return self.first + len(self.values) - 1

    @cached_property
    def roles(self) -> frozenset[str]:
        """What it is, by the user or by its head."""
        if self.given == "velocity":
            return frozenset({"velocity_initial", "velocity_final"})
        if self.given:
            return frozenset({self.given})
        return column_roles(self.head) if self.head else frozenset()

    def place(self, at: int) -> Position:
        """The cell in a row, or column, of the sheet."""
        for blank in self.left_out:
            at += at >= blank
        return (self.sheet, self.number, at) if self.across else (self.sheet, at, self.number)

    def index(self, place: Position) -> int | None:
        """The row, or column, of a cell, as `place` takes it; None for a cell of another line."""
        sheet, row, column = place
        number, at = (row, column) if self.across else (column, row)
        if (sheet, number) != (self.sheet, self.number) or at in self.left_out:
            return None
        return at - sum(blank < at for blank in self.left_out)

    def follows(self, at: int) -> bool:
        """Whether a cell stands right after the one before, with no blank between."""
        before, here = self.place(at - 1), self.place(at)
        return here[1] - before[1] + here[2] - before[2] == 1

    def covers(self, place: Position) -> bool:
        """Whether a cell is one of these."""
        at = self.index(place)
        return at is not None and self.first <= at <= self.last

    def overlaps(self, other: "Line") -> bool:
        """Whether a cell is in both."""
        same = (self.sheet, self.number, self.across) == (other.sheet, other.number, other.across)
        return same and self.first <= other.last and other.first <= self.last

    def at(self, at: int) -> float | None:
        """The number in a row, or column, of the sheet."""
        return self.values[at - self.first] if self.first <= at <= self.last else None

    def change(self, at: int) -> float | None:
        """By how much a number differs from the one before."""
        here, before = self.at(at), self.at(at - 1)
        return None if here is None or before is None else here - before

    @cached_property
    def falls(self) -> bool:
        """Whether it looks like a velocity: positive at first, and rarely rising."""
        pairs = self._pairs
        falling = sum(b <= a for a, b in pairs)
        return pairs[0][0] > 0 and falling >= 0.9 * len(pairs) and pairs[-1][1] < pairs[0][0]

    @cached_property
    def rises(self) -> bool:
        """Whether it looks like a depth: not negative, rarely falling, and no mere count."""
        pairs = self._pairs
        rising = sum(b >= a for a, b in pairs)
        grows = pairs[0][0] >= 0 and pairs[-1][1] > pairs[0][0]
        return grows and rising >= 0.9 * len(pairs) and any(b - a != 1 for a, b in pairs)

    @cached_property
    def _pairs(self) -> list[tuple[float, float]]:
        return list(pairwise(value for value in self.values if value is not None))


def address(place: Position, with_sheet: bool = False) -> str:
    """A cell as people write it.

    >>> address(("Sheet1", 9, 4)), address(("my sheet", 9, 4), with_sheet=True)
    ('D9', "'my sheet'!D9")
    """
    from openpyxl.utils.cell import get_column_letter

    sheet, row, column = place
    cell = f"{get_column_letter(column)}{row}"
    plain = re.fullmatch(r"[A-Za-z_]\w*", sheet)
    quoted = sheet if plain else "'" + sheet.replace("'", "''") + "'"
    return f"{quoted}!{cell}" if with_sheet else cell


def area_of(first: Position, last: Position) -> str:
    """The cells from one to another, as an address without the sheet."""
    return address(first) if first == last else f"{address(first)}:{address(last)}"


def runs(labels: Mapping[Position, object], across: bool = False) -> Iterator[list[Position]]:
    """Neighbouring cells of a column (of a row, if `across`) with the same label, together."""
    line, along = (1, 2) if across else (2, 1)
    run: list[Position] = []
    for place in sorted(labels, key=lambda place: (place[0], place[line], place[along])):
        if run:
            last = run[-1]
            after = (last[0], last[line], int(last[along]) + 1)
            if after != (place[0], place[line], place[along]) or labels[last] != labels[place]:
                yield run
                run = []
        run.append(place)
    if run:
        yield run


def lines(calculation: Calculation) -> Iterator[Line]:
    """Every line of a workbook, down the columns and along the rows, with its head and unit."""
    numbers: dict[str, dict[tuple[int, int], float | None]] = {}
    for (sheet, row, column), value in calculation.values.items():
        if isinstance(value, float) and math.isfinite(value):
            numbers.setdefault(sheet, {})[row, column] = value
        elif calculation.error((sheet, row, column)):
            # An error is part of a line that has gone wrong.
            numbers.setdefault(sheet, {})[row, column] = None
    for sheet, cells in numbers.items():
        for across in (False, True):
            turned = cells if across else {(c, r): value for (r, c), value in cells.items()}
            blank = _left_out(sheet, across, turned, calculation)
            turned = {
                (line, at - sum(b < at for b in blank)): v for (line, at), v in turned.items()
            }
            by_line: dict[int, list[int]] = {}
            for line, at in turned:
                by_line.setdefault(line, []).append(at)
            filled = Counter(at for _, at in turned)
            for line, places in sorted(by_line.items()):
                whole = Line(sheet, line, 1, (), across, left_out=blank)
                for first, last in _runs(sorted(places), filled, whole, calculation):
                    values = tuple(turned.get((line, at)) for at in range(first, last + 1))
                    if sum(value is not None for value in values) >= LEAST:
                        yield headed(replace(whole, first=first, values=values), calculation)


def _left_out(
    sheet: str,
    across: bool,
    numbers: Mapping[tuple[int, int], object],
    calculation: Calculation,
) -> tuple[int, ...]:
    """Blank rows (or columns) of a sheet in the midst of formulas that step over them."""
    used = sorted({column if across else row for name, row, column in calculation.values
                   if name == sheet})  # fmt: skip
    by_row: dict[int, list[Line]] = {}
    for line, at in numbers:
        by_row.setdefault(at, []).append(Line(sheet, line, 1, (), across))
    return tuple(
        blank
        for before, here in pairwise(used)
        if 1 < here - before <= _GAP + 1
        and any(
            _reads(line, here, before, calculation)
            and _reads(line, before, before - 1, calculation)
            for line in by_row.get(here, ())
        )
        for blank in range(before + 1, here)
    )


def _reads(line: Line, at: int, other: int, calculation: Calculation) -> bool:
    """Whether a formula of a line reads another cell of it."""
    formula = calculation.formulas.get(line.place(at))
    return formula is not None and formula.reads(line.place(other))


def _runs(
    places: Sequence[int], filled: Counter[int], line: Line, calculation: Calculation
) -> Iterator[tuple[int, int]]:
    """First and last of each run.

    A few missing cells end it only where others are missing, too, and where the formula after them
    is not the one before, filled on.
    """
    first = places[0]
    for before, here in pairwise([*places, math.inf]):
        gap = range(int(before) + 1, int(here)) if here - before - 1 <= _GAP else None
        ends = gap is None or any(filled[at] < 2 for at in gap)
        if gap and ends:
            left, right = (calculation.formulas.get(line.place(int(at))) for at in (before, here))
            ends = left is None or right is None or left.shape != right.shape
        if ends:
            if before - first + 1 >= LEAST:
                yield first, int(before)
            first = int(here) if here < math.inf else 0


def headed(line: Line, calculation: Calculation) -> Line:
    """The line with the head above it (or at its left), and its unit."""
    unit = place = None
    for at in range(line.first - 1, max(line.first - 1 - _ABOVE, 0), -1):
        text = calculation.values.get(line.place(at), "")
        if not isinstance(text, str):
            break  # a number above, after a gap, belongs to something else
        own = is_unit(text) if text.strip() else None
        if own and unit is None:
            unit, place = own, line.place(at)
        elif text.strip() and not own:
            if unit is None and (unit := unit_in(text)):
                place = line.place(at)
            return replace(line, head=text.strip(), unit=unit, unit_place=place)
    return replace(line, unit=unit, unit_place=place)

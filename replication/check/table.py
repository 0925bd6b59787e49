"""Where the scheme stands in a workbook: lines of numbers, and the tables that they make.

A line is a column, or a row that runs to the right. Tables are found by the heads of lines and by
their values, which give themselves away: from row to row the depth grows by the velocity times a
constant, and the velocity falls by the deceleration times that constant, whatever the units are.
"""

import math
import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import groupby, pairwise, product, takewhile
from statistics import median
from typing import NamedTuple

from reference.units import same_dimension
from replication.check.words import (
    COLUMNS,
    column_roles,
    digits_of,
    is_end,
    is_unit,
    result_of,
    unit_in,
)
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Area, Calculation, Formula

LEAST = 4
"""Fewer numbers are no line; the report itself prints five rows."""
_GAP = 3
"""Cells that a line may lack in its middle."""
_ABOVE = 6
"""How far above its first number a line's head may stand."""
_MAX_LINES = 60
ROUNDED = 12
"""Numbers without formulas and with at most so many digits are taken as rounded."""
_SAMPLE = 500
"""Rows that are looked at to see whether two lines may belong together."""
_CLOSE = 0.02
"""How nearly a ratio of neighbouring rows must repeat. The velocity falls by 1 % a row, mostly."""
NEAR_END = 2
"""What is only called a depth may be that of any row; so near the end it should be the last."""
FEW = 64
"""Cells of a range that are each looked at: more of them are no inputs of a formula."""
_SURE = 0.75
"""What two lines must score to be depth and velocity: their values fit, or both heads say so."""


# ---- lines


@dataclass(frozen=True)
class Line:
    """Numbers in one column (or row) of a sheet, from the row (or column) `first` on.

    `values` are None where a cell has no number. `given` is the role that the user gave it. Rows
    are counted without those of `left_out`, which are blank and over which the formulas step.
    """

    calculation: Calculation = field(repr=False, compare=False)
    sheet: str
    across: bool
    left_out: tuple[int, ...] = ()
    number: int = 1
    first: int = 1
    values: tuple[float | None, ...] = ()
    head: str | None = None
    unit: str | None = None
    unit_place: Position | None = None
    given: str | None = None

    @property
    def last(self) -> int:
        """The row, or column, of the last cell."""
        return self.first + len(self.values) - 1

    @cached_property
    def roles(self) -> frozenset[str]:
        """What it is, by the user or by its head."""
        if self.given in COLUMNS:
            return frozenset({self.given})
        return column_roles(self.given or self.head or "")  # given: a velocity of either end

    @property
    def is_speed(self) -> bool:
        """Whether it is a velocity, by the user or by its head."""
        return any(role.startswith("velocity") for role in self.roles)

    def may_be(self, unit: str) -> bool:
        """Whether neither its head nor its unit says that it measures anything else."""
        named = self.unit or "1"  # "(1)" may be a note
        return not self.roles and (named == "1" or same_dimension(named, unit))

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

    def is_headed_by(self, place: Position) -> bool:
        """Whether a cell stands where its head may be."""
        at = self.index(place)
        return at is not None and self.first - _ABOVE <= at < self.first

    def overlaps(self, another: "Line") -> bool:
        """Whether a cell is in both."""
        here, there = ((line.sheet, line.number, line.across) for line in (self, another))
        return here == there and self.first <= another.last and another.first <= self.last

    def at(self, at: int) -> float | None:
        """The number in a row, or column, of the sheet."""
        return self.values[at - self.first] if self.first <= at <= self.last else None

    def change(self, at: int) -> float | None:
        """By how much a number differs from the one before."""
        here, before = self.at(at), self.at(at - 1)
        return None if here is None or before is None else here - before

    @property
    def cells(self) -> list[Position]:
        """Every cell of it."""
        return [self.place(at) for at in range(self.first, self.last + 1)]

    def formula(self, at: int) -> Formula | None:
        """The formula in a row, or column, of the sheet."""
        return self.calculation.formulas.get(self.place(at))

    def reads_cell(self, at: int, source: int, of: "Line | None" = None) -> bool:
        """Whether a formula of it reads another cell, of it or of another line."""
        formula = self.formula(at)
        return formula is not None and formula.reads((of or self).place(source))

    def reads(self, source: "Line", back: int) -> bool:
        """Whether most cells are formulas that read another line's cell, so many rows back."""
        rows = range(self.first + 1, self.last + 1)[:: 1 + len(self.values) // _SAMPLE]
        return sum(self.reads_cell(at, at - back, source) for at in rows) >= 0.5 * len(rows)

    @cached_property
    def falls(self) -> bool:
        """Whether it looks like a velocity: positive at first, and rarely rising."""
        pairs = list(pairwise(self.numbers))
        falling = sum(b <= a for a, b in pairs)
        ends_lower = bool(pairs) and pairs[0][0] > max(0.0, pairs[-1][1])
        return ends_lower and falling >= 0.9 * len(pairs)

    @cached_property
    def rises(self) -> bool:
        """Whether it looks like a depth: not negative, rarely falling, and no mere count.

        Rows that go on after the particle is at rest have it come back.
        """
        deepest = self.numbers.index(max(self.numbers))
        pairs = list(pairwise(self.numbers[: deepest + 1]))
        rising = sum(b >= a for a, b in pairs)
        counts = all(b - a == 1 for a, b in pairs)
        is_long = len(pairs) >= LEAST - 1
        return is_long and pairs[0][0] >= 0 and rising >= 0.9 * len(pairs) and not counts

    @property
    def goes_on(self) -> bool:
        """Whether it rises, or would: each of its cells, in metres or so, reads the one before."""
        return self.rises or (self.unit is not None and self.reads(self, 1))

    @cached_property
    def numbers(self) -> list[float]:
        """Its values, without the cells that have none."""
        return [value for value in self.values if value is not None]

    def headed(self) -> "Line":
        """The line with the head above it (or at its left), and its unit."""
        unit = place = None
        for at in range(self.first - 1, max(self.first - 1 - _ABOVE, 0), -1):
            text = self.calculation.values.get(self.place(at), "")
            if not isinstance(text, str):
                break  # a number above, after a gap, belongs to something else
            named_unit = is_unit(text) if text.strip() else None
            if named_unit and unit is None:
                unit, place = named_unit, self.place(at)
            elif text.strip() and not named_unit:
                if unit is None and (unit := unit_in(text)):
                    place = self.place(at)
                head, above = text.strip(), self.calculation.values.get(self.place(at - 1))
                if isinstance(above, str) and is_end(head) and replace(self, head=above).is_speed:
                    head = f"{above.strip()} {head}"  # "Velocity", and "initial" below it
                return replace(self, head=head, unit=unit, unit_place=place)
        return replace(self, unit=unit, unit_place=place)


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


def span(cells: Iterable[tuple[int, int]]) -> str:
    """The area that reaches over cells, each by row and column, as an address.

    >>> span([(9, 4), (8, 5)]), span([(1, 1)])
    ('D8:E9', 'A1')
    """
    rows, columns = zip(*cells, strict=True)
    corners = (("", end(rows), end(columns)) for end in (min, max))
    return ":".join(dict.fromkeys(map(address, corners)))


def runs(labels: Mapping[Position, object], across: bool = False) -> Iterator[list[Position]]:
    """Neighbouring cells of a column (of a row, if `across`) with the same label, together."""

    def by_line(place: Position) -> tuple[str, int, int]:
        sheet, row, column = place
        return (sheet, row, column) if across else (sheet, column, row)

    def run(entry: tuple[int, Position]) -> tuple[object, ...]:
        """What neighbours have in common: their rows grow as their ranks do."""
        rank, place = entry
        sheet, line, along = by_line(place)
        return sheet, line, along - rank, labels[place]

    for _, entries in groupby(enumerate(sorted(labels, key=by_line)), run):
        yield [place for _, place in entries]


def lines(calculation: Calculation) -> Iterator[Line]:
    """Every line of a workbook, down the columns and along the rows, with its head and unit."""
    values, formulas = calculation.values, calculation.formulas
    for (sheet, cells), across in product(calculation.book.sheets.items(), (False, True)):
        # Each cell by its line and its place along it.
        places = {(p if across else p[::-1]): (sheet, *p) for p in cells}
        used = {at for (_, at), place in places.items()
                if place in formulas or not isinstance(values.get(place), str | None)}  # fmt: skip
        blank = _left_out(Line(calculation, sheet, across), sorted(used), places)
        by_line: dict[int, dict[int, float | None]] = {}
        for (number, at), place in places.items():
            value = calculation.number(place)
            usable = None if value is None or not math.isfinite(value) else value
            # An error is part of a line that has gone wrong, and so is the text that it comes from.
            wrong = calculation.error(place) or is_spoiling(place, calculation, across)
            belongs = usable is not None or wrong or place in calculation.unknown
            if belongs and not _sums_up(calculation, place, across):
                by_line.setdefault(number, {})[at - sum(b < at for b in blank)] = usable
        filled = Counter(at for numbers in by_line.values() for at in numbers)
        for number, numbers in sorted(by_line.items()):
            line = Line(calculation, sheet, across, blank, number)
            for first, last in _runs(sorted(numbers), filled, line):
                run = tuple(numbers.get(at) for at in range(first, last + 1))
                yield replace(line, first=first, values=run).headed()


def is_spoiling(place: Position, calculation: Calculation, across: bool) -> bool:
    """Whether a cell is a text for which formulas give errors, and no head that they stray to.

    Beside a head stands another one.
    """
    sheet, row, column = place
    beside = ((row + k, column) if across else (row, column + k) for k in (-1, 1))
    values = (calculation.values.get((sheet, *cell)) for cell in beside)
    is_head = any(isinstance(value, str) and value and value[0] != "#" for value in values)
    is_head = is_head or bool(column_roles(str(calculation.values.get(place))))
    return place in calculation.spoiling and not is_head


def _sums_up(calculation: Calculation, place: Position, across: bool) -> bool:
    """Whether a cell gives one number for many of its own column (or row), such as the largest."""
    areas, line = calculation.areas(place), 1 if across else 2
    if len(areas) != 1 or areas[0].cells < LEAST:
        return False
    return {(end[0], end[line]) for end in areas[0].ends} == {(place[0], place[line])}


def _left_out(
    line: Line, used: Sequence[int], places: Iterable[tuple[int, int]]
) -> tuple[int, ...]:
    """Rows (or columns) without numbers in the midst of formulas that step over them."""
    numbers = defaultdict[int, list[int]](list)
    for number, at in places:
        numbers[at].append(number)
    stepped: list[int] = []
    for before, here in pairwise(used):
        if here - before == 1:
            continue
        along = [replace(line, number=number) for number in numbers[before]]
        going = [each for each in along if each.reads_cell(before, before - 1)]
        over = [each for each in along if each.reads_cell(here, before)]
        # Below, a table goes on in all of them, and does not only show its last row again. The
        # row of the impact reads none before; time and depth go on from it, or other two.
        goes_on = [each for each in going or over if each.reads_cell(here + 1, here)]
        is_blank = not any(map(numbers.get, range(before + 1, here)))
        if set(going) <= set(over) and goes_on and (going or (is_blank and len(goes_on) > 1)):
            stepped += range(before + 1, here)
    return tuple(stepped)


def _runs(places: Sequence[int], filled: Counter[int], line: Line) -> Iterator[tuple[int, int]]:
    """First and last of each run.

    A few missing cells end it only where others are missing, too, and where the formula after them
    is not the one before, filled on.
    """
    first = places[0]
    for before, here in pairwise([*places, places[-1] + _GAP + 2]):
        gap = range(before + 1, here)
        ends = len(gap) > _GAP or any(filled[at] < 2 for at in gap)
        if ends and len(gap) <= _GAP:
            left, right = line.formula(before), line.formula(here)
            ends = left is None or right is None or left.shape != right.shape
        if ends:
            if before - first + 1 >= LEAST:
                yield first, before
            first = here


# ---- tables


class Result(NamedTuple):
    """A cell that is called the final depth, or the "ratio" of it to the radius, by a `label`.

    Or one "beyond" the "first" in its row, which may also be what it differs by from another
    number; or one "listed" below the label, where each may be of its own table, or of any row.
    """

    kind: str
    place: Position
    unit: str | None
    label: Position
    where: str


@dataclass
class Table:
    """One run of the scheme: its columns by role, and the row of the sheet that is its row 0.

    Row k of the scheme stands in row (or column) `zero` + k of the sheet, up to row `steps`. A
    table need not show row 0. `helpers` are other lines beside it.
    """

    lines: Mapping[str, Line]
    zero: int
    steps: int
    helpers: tuple[Line, ...] = ()

    def __post_init__(self) -> None:
        depth = self.lines["depth"]
        self.calculation, self.sheet, self.across = depth.calculation, depth.sheet, depth.across
        self.every_line = (*self.lines.values(), *self.helpers)

    def place(self, role: str, k: int) -> Position:
        """The cell of a role in row k."""
        return self.lines[role].place(self.zero + k)

    @property
    def speed(self) -> str:
        """The velocity that its rows move by."""
        return "velocity_initial" if "velocity_initial" in self.lines else "velocity_final"

    def number(self, role: str, k: int) -> float | None:
        """What that cell holds."""
        return self.lines[role].at(self.zero + k) if role in self.lines else None

    def area(self, role: str) -> str:
        """The cells of a role, as an address."""
        every = range(self.steps + 1)
        rows = [k for k in every if self.number(role, k) is not None] or every
        return span(self.place(role, k)[1:] for k in (rows[0], rows[-1]))

    @property
    def results(self) -> list[Result]:
        """Cells beside or below a label that says final depth, or depth over radius."""
        return [result for result in self.labelled if result.where != "listed"]

    @cached_property
    def labelled(self) -> list[Result]:
        """Results, and cells of lists below their labels.

        A cell below a label that numbers follow is the first of a list, not a result. What is only
        called a depth, and what stands beyond the first number, is one if it reads the table's.
        """
        labelled: list[Result] = []
        for label, text in self.calculation.values.items():
            sheet, row, column = label
            kind = result_of(text) if isinstance(text, str) else None
            if kind == "any depth" and str(text)[0] == (self.lines["depth"].head or "")[:1] == "X":
                continue  # where the column is called X, it may be that of any row
            for down, right in ((0, 1), (0, 2), (1, 0), (0, -1)) if kind else ():
                along = ((k, 0) if down else (0, k) for k in range(FEW))
                places = ((sheet, row + down + k, column + right + n) for k, n in along)
                cells = list(takewhile(self._is_beside, places))
                if right < 0 and cells and not self.gives_depth(cells[0]):
                    break  # a label at its right
                is_list = down and self.calculation.number((sheet, row + 2, column)) is not None
                for cell in cells:
                    where = "listed" if is_list else "first" if cell == cells[0] else "beyond"
                    if self.gives_depth(cell) or (where == "first" and kind != "any depth"):
                        labelled.append(self._result(kind == "ratio", cell, label, where))
                if cells:
                    break
        return labelled or self._unnamed()

    def _unnamed(self) -> list[Result]:
        """The one cell that shows a depth near the end, if its label is in an unknown language."""
        values, depth = self.calculation.values, self.lines["depth"]
        shown = []
        for (sheet, row, column), formula in self.calculation.formulas.items():
            corners = [area.corner for area in formula.areas if area.cells == 1]
            at = depth.index(corners[0]) if len(corners) == len(formula.areas) == 1 else None
            text = values.get(label := (sheet, row, column - 1))
            # A number in it may be that of a row.
            is_labelled = isinstance(text, str) and not (is_unit(text) or re.search(r"\d", text))
            near_end = at is not None and 0 <= self.zero + self.steps - at <= NEAR_END
            if is_labelled and near_end and self._is_beside((sheet, row, column)):
                shown.append(self._result(False, (sheet, row, column), label, "first"))
        return shown if len(shown) == 1 else []

    def _is_beside(self, place: Position) -> bool:
        """Whether a cell holds a number and is in no line of the table."""
        is_number = self.calculation.number(place) is not None
        return is_number and not any(line.covers(place) for line in self.every_line)

    def _result(self, is_ratio: bool, place: Position, label: Position, where: str) -> Result:
        """A result, with the unit that its label or a cell beside it gives."""
        sheet, row, column = place
        near = (self.calculation.values.get((sheet, row, column + side)) for side in (1, -1))
        texts = [text for text in near if isinstance(text, str)]
        # A label's unit need not be that of all numbers in its row.
        named = unit_in(str(self.calculation.values[label])) if where != "beyond" else None
        unit = named or next(filter(None, map(is_unit, texts)), None)
        kind, measure = ("ratio", "1") if is_ratio else ("depth", "m")
        fits = unit is not None and same_dimension(unit, measure)
        return Result(kind, place, unit if fits else None, label, where)

    def gives_depth(self, place: Position) -> bool:
        """Whether a cell's formula reads a depth of the table, through cells beside it or not."""
        return "depth" in self.readers.get(place, ())

    @cached_property
    def readers(self) -> dict[Position, set[str]]:
        """The cells beside the table whose formulas read it, directly or not.

        Each with what of it: its columns by role, and the "last" depth.
        """
        areas = {}
        for name in (*self.lines, "last"):
            role, first = ("depth", self.steps) if name == "last" else (name, 0)
            (sheet, *begin), (_, *end) = (self.place(role, k) for k in (first, self.steps))
            areas[name] = Area(sheet, *begin, *end)
        readers: dict[Position, set[str]] = {}
        for place in sorted(self.calculation.formulas, key=self.calculation.order.__getitem__):
            if place in self.places:
                continue
            for area in self.calculation.areas(place):
                read = {name for name, wanted in areas.items() if area.overlaps(wanted)}
                # Of many cells, such as a long column, the first and the last are looked at.
                cells = area.places() if area.cells <= FEW else area.ends
                read = read.union(*(readers.get(cell, ()) for cell in cells))
                if read:
                    readers.setdefault(place, set()).update(read)
        return readers

    @cached_property
    def places(self) -> dict[Position, tuple[str, int]]:
        """Every cell of the table -> its role and row."""
        rows = range(self.steps + 1)
        return {self.place(role, k): (role, k) for role in self.lines for k in rows}

    @cached_property
    def digits(self) -> int | None:
        """The fewest digits that a column but the time has, if its numbers are typed and rounded.

        None if they are not.
        """
        lines = [line for role, line in self.lines.items() if role != "time"]
        rows = range(self.zero + 1, self.zero + self.steps + 1)
        if any(line.formula(at) for line in lines for at in rows):
            return None
        fewest = min(digits for role, (digits, _) in self.roundings.items() if role != "time")
        return fewest if fewest <= ROUNDED else None

    @cached_property
    def roundings(self) -> dict[str, tuple[int, int]]:
        """The most digits of a number of each column, and the least power of ten that one has.

        Numbers may be rounded to so many digits, or to so many decimals. Row 0 is left out.
        """
        roundings = {}
        for role in self.lines:
            numbers = (self.number(role, k) for k in range(1, self.steps + 1))
            parts = sorted(digits_of(x) for x in numbers if x)
            digits = parts[len(parts) * 19 // 20][0] if parts else 17  # a few may have more
            usual = (least for count, least in parts if count <= digits)
            roundings[role] = digits, min(usual, default=-300)
        return roundings


def tables(calculation: Calculation, given: Sequence[Line]) -> list[Table]:
    """Every table of the scheme in a workbook, in the order of sheets and columns.

    `given` are lines that the user named; only the table that they belong to is then meant. Raises
    ValueError where they belong to none.
    """
    known = [line for line in lines(calculation) if not any(map(line.overlaps, given))]
    chosen: list[Table] = []
    for depth, speed in _pairs([*known, *given]):
        used = [line for table in chosen for line in table.lines.values()]
        if not any(line.overlaps(depth) or line.overlaps(speed) for line in used):
            table = _table(depth, speed, [line for line in (*known, *given) if line not in used])
            # Other quantities grow like this, too: it takes a third one, or names for both.
            named = all(role in line.roles for role, line in table.lines.items())
            if named or len(table.lines) > 2:
                chosen.append(table)
    if given:
        chosen = [table for table in chosen if all(line in table.lines.values() for line in given)]
        if not chosen:
            raise ValueError(
                "what --map names belongs to no table of depth and velocity: name both, with as "
                "many rows"
            )
    chosen = [table for table in chosen if not _viewed(table, chosen)]
    taken = {line for table in chosen for line in table.lines.values()}
    chosen = [
        replace(
            t, helpers=tuple(h for h in t.helpers if h not in taken and _nearest(h, chosen) is t)
        )
        for t in chosen
    ]
    sheets = list(calculation.book.sheets)
    return sorted(chosen, key=lambda t: (sheets.index(t.sheet), t.lines["depth"].number))


def _pairs(known: Sequence[Line]) -> list[tuple[Line, Line]]:
    """Depths with their velocities, the surest first."""
    # Errors may end a column with a head in its third row, by a reference that no $ fixes.
    able = [line for line in known if len(line.numbers) >= LEAST - bool(line.roles)]
    longest = sorted(able, key=lambda line: (not line.roles, -len(line.values)))
    depths = [x for x in longest if "depth" in x.roles or (x.may_be("m") and x.goes_on)]
    speeds = [v for v in longest if v.is_speed or (v.may_be("m/s") and v.falls)]
    scored = [
        (_score(x, v), len(x.values), -abs(x.number - v.number), x, v)
        for x, v in product(depths[:_MAX_LINES], speeds[:_MAX_LINES])
        if (x.sheet, x.across) == (v.sheet, v.across)
    ]
    scored.sort(key=lambda entry: entry[:3], reverse=True)
    return [(x, v) for score, *_, x, v in scored if score >= _SURE]


def _score(depth: Line, speed: Line) -> float:
    """How table-like: 1 for telling heads, 1 for fitting values, some for formulas, more for --map.

    Values that do not fit may come from a faulty sheet, whose depths still read the one before.
    """
    rows = range(max(depth.first, speed.first), min(depth.last, speed.last) + 1)
    if len(rows) < LEAST:
        return 0.0
    fit = _constant((depth.change(at), speed.at(at)) for at in rows[:: 1 + len(rows) // _SAMPLE])
    grows = depth.reads(depth, 1)
    given = (depth.given is not None) + (speed.given is not None)
    named = (depth.unit is not None or "depth" in depth.roles) + (
        speed.unit is not None or speed.is_speed
    )
    final = speed.roles == {"velocity_final"}
    reads = depth.reads(speed, 0) or depth.reads(speed, 1)
    # A velocity that ends higher than it began is the axis of a curve, and so is one that does not
    # rest on the depths.
    sure = grows or given or (named == 2 and reads and _rests_on(speed, depth))
    if not sure and (fit < 0.5 or speed.numbers[-1] > speed.numbers[0]):
        return 0.0
    return fit + 0.5 * named + 0.3 * reads + 0.2 * grows - 0.2 * final + 2 * given


def _rests_on(line: Line, source: Line) -> bool:
    """Whether the last cell of a line reads another line, through no more cells than a row has."""
    cells = {line.place(line.last)}
    for _ in COLUMNS:
        cells = {area.corner for cell in cells for area in line.calculation.areas(cell)}
        if any(map(source.covers, cells)):
            return True
    return False


def _constant(pairs: Iterable[tuple[float | None, float | None]], close: float = _CLOSE) -> float:
    """In which share of some pairs the ratio is the same number."""
    ratios = [a / b for a, b in pairs if a is not None and b]
    middle = median(ratios) if len(ratios) >= LEAST - 1 else 0.0
    if not middle or not math.isfinite(middle):
        return 0.0
    return sum(abs(ratio / middle - 1) < close for ratio in ratios) / len(ratios)


def _nearest(line: Line, chosen: Sequence[Table]) -> Table:
    """Of the tables that a line stands beside the one nearest to it."""
    beside = (table for table in chosen if line in table.helpers)
    return min(beside, key=lambda table: abs(table.lines["depth"].number - line.number))


def _viewed(table: Table, others: Sequence[Table]) -> bool:
    """Whether a table only shows what another one holds, but for some typed cells."""
    shown = {place for another in others if another is not table for place in another.places}
    areas = [table.calculation.areas(table.place("depth", k)) for k in range(1, table.steps + 1)]
    views = sum(any(area.corner in shown for area in each) for each in areas)
    depth = table.lines["depth"]
    return views > 0.9 * len(areas) and not depth.reads(depth, 1)


def _table(depth: Line, speed: Line, known: Sequence[Line]) -> Table:
    """The table around a depth and a velocity: its other columns and its rows."""
    first, last = max(depth.first, speed.first), min(depth.last, speed.last)
    beside = [
        line
        for line in known
        if (line.sheet, line.across) == (depth.sheet, depth.across)
        and line not in (depth, speed)
        and min(line.last, last) - max(line.first, first) >= 0.5 * (last - first)
    ]
    initial = _at_beginning(depth, speed, beside)
    roles = {"depth": depth, "velocity_initial" if initial else "velocity_final": speed}
    for role in ("velocity_final" if initial else "velocity_initial", "deceleration", "time"):
        left = [line for line in beside if line not in roles.values()]
        if left:
            fits = {line: _fits(role, line, speed, initial) for line in left}
            best = max(left, key=lambda line: (fits[line], -abs(line.number - depth.number)))
            if fits[best] >= 0.9:
                roles[role] = best
    zeros = [at for at in range(depth.first, min(depth.first + 4, last)) if depth.at(at) == 0]
    touch = [at for at in zeros if "time" in roles and roles["time"].at(at) == 0]
    zero = (touch or zeros or [first - 1])[-1]
    last = _end(depth, speed, zero, last)
    ordered = {role: roles[role] for role in COLUMNS if role in roles}
    helpers = tuple(line for line in beside if line not in roles.values())
    return Table(ordered, zero, last - zero, helpers)


def _at_beginning(depth: Line, speed: Line, beside: Sequence[Line]) -> bool:
    """Whether a velocity is that at the beginning of its row, not at its end.

    The deceleration of a row takes the velocity at its beginning to that of the next row, and that
    of the row before to the velocity at its end. Without decelerations, the depth moves on by the
    velocity at the beginning of a row.
    """
    if len(speed.roles) == 1 and not any("velocity_initial" in line.roles for line in beside):
        return speed.roles == {"velocity_initial"}
    brakes = [line for line in beside if "deceleration" in line.roles or not line.roles]
    if not brakes:
        here, later = (_tied(depth, speed, back, 1e-9) for back in (0, 1))
        return here >= later - 0.05
    here, later = (max(_tied(speed, line, back) for line in brakes) for back in (0, 1))
    return later >= here - 0.05


def _tied(line: Line, source: Line, back: int, close: float = _CLOSE) -> float:
    """The share of rows in which a line changes by a constant times another, so many rows back."""
    rows = range(source.first, source.last + 1)
    return _constant(((line.change(at + back), source.at(at)) for at in rows), close)


def _fits(role: str, line: Line, speed: Line, initial: bool) -> float:
    """How well a line would do in a role: 1 for its head, 1 for its values; more for --map."""
    named = (role in line.roles) * (3.0 if line.given else 1.0)
    if line.roles and not any(named_role[:4] == role[:4] for named_role in line.roles):
        return 0.0
    if role.startswith("velocity"):
        later = 1 if initial else -1
        rows = range(line.first, line.last + 1)
        pairs = ((line.at(at), speed.at(at + later)) for at in rows)
        both = [(a, b) for a, b in pairs if a is not None and b is not None]
        same = sum(math.isclose(a, b, rel_tol=1e-9) for a, b in both) / max(len(both), 1)
        before, after = (line, speed) if initial else (speed, line)
        typed = after.formula(after.last) is None
        if same < 0.5 and not (typed or line.given or after.reads(before, 1)):
            return 0.0  # a velocity that no other row takes on is one in the middle of its row
        return named + same * line.falls
    if role == "deceleration":
        fit = _tied(speed, line, initial) + 0.5 * _tied(speed, line, initial, 1e-9)
        return named + fit * (not line.falls)
    steps = [b - a for a, b in pairwise(line.numbers)] or [0.0]
    counts = median(steps) == 1  # the rows, unless its head says time
    return named + _constant((step, 1.0) for step in steps) * (not counts and min(steps) > 0)


def _end(depth: Line, speed: Line, zero: int, last: int) -> int:
    """The last row, without those that only hold zero or repeat it once the motion has ended."""
    for at in range(last, zero + 2, -1):
        x, v = depth.at(at), speed.at(at)
        stays = x == depth.at(at - 1) and v == speed.at(at - 1)
        if x is None or v is None or not (stays or x == v == 0):
            fastest = max(map(abs, speed.numbers))
            ended = abs(speed.at(at) or 0.0) <= 0.2 * fastest and x is not None
            if at >= last - 1 or not ended:
                return last
            # Velocities that end the motion may stand in rows where the depth stays.
            moves = (k for k in range(at, zero, -1) if depth.at(k) != depth.at(k - 1))
            return next(moves, last)
    return last

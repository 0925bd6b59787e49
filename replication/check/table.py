"""Find the tables of the scheme in a workbook: first its lines of numbers, then what they form.

A line is a column of numbers, or a row of numbers in a table that runs to the right. Tables are
recognized by the heads of their lines and by their values: from row to row the depth grows by the
velocity times a constant, and the velocity falls by the deceleration times the same constant,
whatever the units are.
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
"""The fewest numbers that make a line; the report itself prints five rows."""
_GAP = 3
"""The most cells without a number between two numbers of a line."""
_ABOVE = 6
"""How many cells above its first number, at most, a line's head may stand."""
_MAX_LINES = 60
"""The most depths, and the most velocities, that are tried with each other."""
ROUNDED = 12
"""Typed numbers with at most this many digits count as rounded."""
_SAMPLE = 500
"""About how many rows are compared to decide whether two lines belong together."""
_CLOSE = 0.02
"""How nearly a ratio must repeat from row to row: a velocity mostly falls by 1 % a row."""
NEAR_END = 2
"""How many rows before the last a result may show and still be taken for a final depth."""
FEW = 64
"""The most cells of a range that are looked at one by one; larger ranges are no inputs."""
_SURE = 0.75
"""The least score for a depth and its velocity: their values fit, or both have telling heads."""


# ---- lines


@dataclass(frozen=True)
class Line:
    """Numbers in one column of a sheet, or `across` it in one row; `number` says in which.

    A cell's index is its row (across: its column), not counting the indices in `left_out`, which
    are blank and which the formulas skip. `first` is the index of the first value; a value is None
    where the cell holds no number. `given` is the role that the user named with --map.
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
        """The index of the last cell."""
        return self.first + len(self.values) - 1

    @cached_property
    def roles(self) -> frozenset[str]:
        """The roles that the line may have by the user's word, or else by its head."""
        if self.given in COLUMNS:
            return frozenset({self.given})
        return column_roles(self.given or self.head or "")  # --map velocity names neither end

    @property
    def is_speed(self) -> bool:
        """Whether the user or the head says that it is a velocity."""
        return any(role.startswith("velocity") for role in self.roles)

    def may_be(self, unit: str) -> bool:
        """Whether nothing in its head contradicts a quantity of this unit."""
        named = self.unit or "1"  # "(1)" may be a note rather than a unit
        return not self.roles and (named == "1" or same_dimension(named, unit))

    def place(self, at: int) -> Position:
        """The cell at an index."""
        for blank in self.left_out:
            at += at >= blank
        return (self.sheet, self.number, at) if self.across else (self.sheet, at, self.number)

    def index(self, place: Position) -> int | None:
        """The index of a cell, the inverse of `place`; None for a cell of another line."""
        sheet, row, column = place
        number, at = (row, column) if self.across else (column, row)
        if (sheet, number) != (self.sheet, self.number) or at in self.left_out:
            return None
        return at - sum(blank < at for blank in self.left_out)

    def follows(self, at: int) -> bool:
        """Whether no left-out row (or column) lies between a cell and the one before it."""
        (_, *before), (_, *after) = self.place(at - 1), self.place(at)
        return sum(after) - sum(before) == 1

    def covers(self, place: Position) -> bool:
        """Whether a cell belongs to the line."""
        at = self.index(place)
        return at is not None and self.first <= at <= self.last

    def overlaps(self, another: "Line") -> bool:
        """Whether two lines have a cell in common and run in the same direction."""
        own, its = ((line.sheet, line.number, line.across) for line in (self, another))
        return own == its and self.first <= another.last and another.first <= self.last

    def at(self, at: int) -> float | None:
        """The number at an index."""
        return self.values[at - self.first] if self.first <= at <= self.last else None

    def change(self, at: int) -> float | None:
        """The difference between a number and the one before it."""
        before, after = self.at(at - 1), self.at(at)
        return None if before is None or after is None else after - before

    @property
    def cells(self) -> list[Position]:
        """Every cell of the line."""
        return [self.place(at) for at in range(self.first, self.last + 1)]

    @cached_property
    def formulas(self) -> list[Formula]:
        """The formulas among its cells."""
        return list(filter(None, map(self.calculation.formulas.get, self.cells)))

    def formula(self, at: int) -> Formula | None:
        """The formula at an index."""
        return self.calculation.formulas.get(self.place(at))

    def reads_cell(self, at: int, source: int, of: "Line | None" = None) -> bool:
        """Whether the formula at an index reads the cell at index `source` (`of` another line)."""
        formula = self.formula(at)
        return formula is not None and formula.reads((of or self).place(source))

    def reads(self, source: "Line", back: int) -> bool:
        """Whether most cells are formulas that read the source's cell `back` rows before."""
        rows = range(self.first + 1, self.last + 1)[:: 1 + len(self.values) // _SAMPLE]
        return sum(self.reads_cell(at, at - back, source) for at in rows) >= 0.5 * len(rows)

    @cached_property
    def falls(self) -> bool:
        """Whether it looks like a velocity: positive at first, lower at the end, rarely rising."""
        pairs = list(pairwise(self.numbers))
        falling = sum(b <= a for a, b in pairs)
        ends_lower = bool(pairs) and pairs[0][0] > max(0.0, pairs[-1][1])
        return ends_lower and falling >= 0.9 * len(pairs)

    @cached_property
    def rises(self) -> bool:
        """Whether it looks like a depth: not negative, rarely falling, and no count of the rows.

        Only the rows down to the deepest are compared: beyond the standstill the scheme takes the
        particle back.
        """
        deepest = self.numbers.index(max(self.numbers))
        pairs = list(pairwise(self.numbers[: deepest + 1]))
        rising = sum(b >= a for a, b in pairs)
        counts = all(b - a == 1 for a, b in pairs)
        is_long = len(pairs) >= LEAST - 1
        return is_long and pairs[0][0] >= 0 and rising >= 0.9 * len(pairs) and not counts

    @property
    def may_rise(self) -> bool:
        """Whether it rises, or would without a fault: it has a unit, and adds to the row before."""
        return self.rises or (self.unit is not None and self.reads(self, 1))

    @cached_property
    def numbers(self) -> list[float]:
        """The values of the cells that hold a number."""
        return [value for value in self.values if value is not None]

    def headed(self) -> "Line":
        """The line with its head and unit, from the texts above it (across: at its left)."""
        unit = place = None
        for at in range(self.first - 1, max(self.first - 1 - _ABOVE, 0), -1):
            text = self.calculation.values.get(self.place(at), "")
            if not isinstance(text, str):
                break  # beyond a number stand the head and the unit of something else
            is_head = bool(text.strip()) and not is_unit(text)
            if unit is None and (unit := unit_in(text) if is_head else is_unit(text)):
                place = self.place(at)
            if is_head:
                head, above = text.strip(), self.calculation.values.get(self.place(at - 1))
                if isinstance(above, str) and is_end(head) and replace(self, head=above).is_speed:
                    head = f"{above.strip()} {head}"  # "Velocity", with "initial" below it
                return replace(self, head=head, unit=unit, unit_place=place)
        return replace(self, unit=unit, unit_place=place)


def address(place: Position, with_sheet: bool = False) -> str:
    """Return the address of a cell as a spreadsheet shows it.

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
    """Return the address of the smallest area around some cells, given as (row, column).

    >>> span([(9, 4), (8, 5)]), span([(1, 1)])
    ('D8:E9', 'A1')
    """
    rows, columns = zip(*cells, strict=True)
    corners = (("", end(rows), end(columns)) for end in (min, max))
    return ":".join(dict.fromkeys(map(address, corners)))


def runs(labels: Mapping[Position, object], across: bool = False) -> Iterator[list[Position]]:
    """Yield groups of cells with the same label that adjoin in a column (`across`: in a row)."""

    def by_line(place: Position) -> tuple[str, int, int]:
        sheet, row, column = place
        return (sheet, row, column) if across else (sheet, column, row)

    def run(entry: tuple[int, Position]) -> tuple[object, ...]:
        # Position along the line and rank grow together as long as the cells adjoin.
        rank, place = entry
        sheet, line, along = by_line(place)
        return sheet, line, along - rank, labels[place]

    for _, entries in groupby(enumerate(sorted(labels, key=by_line)), run):
        yield [place for _, place in entries]


def lines(calculation: Calculation) -> Iterator[Line]:
    """Yield every line of a workbook, down the columns and across, with its head and unit."""
    values, formulas = calculation.values, calculation.formulas
    for (sheet, cells), across in product(calculation.book.sheets.items(), (False, True)):
        # Cells by line number and index, which are column and row, or row and column if across.
        places = {(p if across else p[::-1]): (sheet, *p) for p in cells}
        used = {at for (_, at), place in places.items()
                if place in formulas or not isinstance(values.get(place), str | None)}  # fmt: skip
        blank = _left_out(Line(calculation, sheet, across), sorted(used), places)
        by_line: dict[int, dict[int, float | None]] = {}
        for (number, at), place in places.items():
            value = calculation.number(place)
            usable = None if value is None or not math.isfinite(value) else value
            # An error belongs to a line that has gone wrong, and so does the text that causes it.
            belongs = usable is not None or calculation.error(place) or place in calculation.unknown
            belongs = belongs or is_spoiling(place, calculation, across)
            if belongs and not _sums_up(calculation, place, across):
                by_line.setdefault(number, {})[at - sum(b < at for b in blank)] = usable
        filled = Counter(at for numbers in by_line.values() for at in numbers)
        for number, numbers in sorted(by_line.items()):
            line = Line(calculation, sheet, across, blank, number)
            for first, last in _runs(sorted(numbers), filled, line):
                run = tuple(numbers.get(at) for at in range(first, last + 1))
                yield replace(line, first=first, values=run).headed()


def is_spoiling(place: Position, calculation: Calculation, across: bool) -> bool:
    """Whether a cell holds a text that makes formulas fail, and is not a head of a line.

    Formulas may stray to a head; it is recognized by another text beside it.
    """
    if place not in calculation.spoiling:
        return False
    sheet, row, column = place
    beside = ((row + k, column) if across else (row, column + k) for k in (-1, 1))
    values = (calculation.values.get((sheet, *cell)) for cell in beside)
    is_beside_head = any(isinstance(value, str) and value and value[0] != "#" for value in values)
    return not (is_beside_head or column_roles(str(calculation.values.get(place))))


def _sums_up(calculation: Calculation, place: Position, across: bool) -> bool:
    """Whether a formula combines many cells of its own column (or row), such as their maximum."""
    areas, line = calculation.areas(place), 1 if across else 2
    if len(areas) != 1 or areas[0].cells < LEAST:
        return False
    return {(end[0], end[line]) for end in areas[0].ends} == {(place[0], place[line])}


def _left_out(
    line: Line, used: Sequence[int], places: Iterable[tuple[int, int]]
) -> tuple[int, ...]:
    """Return the blank rows (or columns) that formulas skip when they read the row before.

    `used` are the indices of cells with a formula or a number; `places` are all cells by line
    number and index.
    """
    numbers = defaultdict[int, list[int]](list)
    for number, at in places:
        numbers[at].append(number)
    skipped: list[int] = []
    for before, after in pairwise(used):
        if after - before == 1:
            continue
        along = [replace(line, number=number) for number in numbers[before]]
        growing = [column for column in along if column.reads_cell(before, before - 1)]
        skipping = [column for column in along if column.reads_cell(after, before)]
        # A table goes on in all its growing lines and in the rows after; a cell that only repeats
        # its last row does not. The row of the impact reads no row before, so nothing grows there:
        # then two lines, such as time and depth, must skip a gap that holds nothing at all.
        going_on = [c for c in growing or skipping if c.reads_cell(after + 1, after)]
        is_blank = not any(map(numbers.get, range(before + 1, after)))
        if set(growing) <= set(skipping) and (
            (growing and going_on) or (is_blank and len(going_on) > 1)
        ):
            skipped += range(before + 1, after)
    return tuple(skipped)


def _runs(places: Sequence[int], filled: Counter[int], line: Line) -> Iterator[tuple[int, int]]:
    """Yield the first and the last index of each run of cells, given by their sorted indices.

    A small gap ends a run only if other lines lack cells there, too (`filled` counts the cells at
    an index), and if the formula after the gap is not the one before it, filled on.
    """
    first = places[0]
    for before, after in pairwise([*places, places[-1] + _GAP + 2]):
        if not (gap := range(before + 1, after)):
            continue
        above, below = line.formula(before), line.formula(after)
        goes_on = above and below and above.shape == below.shape
        if len(gap) > _GAP or not (goes_on or all(filled[at] > 1 for at in gap)):
            if before - first + 1 >= LEAST:
                yield first, before
            first = after


# ---- tables


class Result(NamedTuple):
    """A cell that a `label` calls the final depth, or the "ratio" of the depth to the radius.

    `where` it stands: the "first" number beside its label; one "beyond" the first, which may also
    be a deviation from another number; or one "listed" in a column below the label, where each
    number may belong to a table of its own, or to any row.
    """

    kind: str
    place: Position
    unit: str | None
    label: Position
    where: str


@dataclass
class Table:
    """One run of the scheme: its columns by role, and the index of its row 0.

    Row k of the scheme stands at index `zero` + k of the lines, up to k = `steps`. A table need not
    show row 0. `helpers` are other lines beside it.
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
        """The role of its velocity; if it shows both, that at the beginning of a row."""
        return "velocity_initial" if "velocity_initial" in self.lines else "velocity_final"

    def number(self, role: str, k: int) -> float | None:
        """The number in the cell of a role in row k."""
        return self.lines[role].at(self.zero + k)

    def area(self, role: str) -> str:
        """The address of the cells of a role, from the first number to the last."""
        rows = [k for k in range(self.steps + 1) if self.number(role, k) is not None]
        return span(self.place(role, k)[1:] for k in (rows or [0, self.steps]))

    @property
    def results(self) -> list[Result]:
        """The labelled results, without those in lists."""
        return [result for result in self.labelled if result.where != "listed"]

    @cached_property
    def labelled(self) -> list[Result]:
        """Cells beside or below a label that says final depth, or depth over radius.

        Numbers that stand below one another under a label are a list. A cell that is only called a
        depth, or that stands beyond the first number, counts only if it reads a depth of the table.
        """
        labelled: list[Result] = []
        for label, text in self.calculation.values.items():
            sheet, row, column = label
            kind = result_of(text) if isinstance(text, str) else None
            if kind == "any depth" and str(text)[0] == (self.lines["depth"].head or "")[:1] == "X":
                continue  # where the column of depths is called X, too, X may be that of any row
            for down, right in ((0, 1), (0, 2), (1, 0), (0, -1)) if kind else ():
                steps = ((k, 0) if down else (0, k) for k in range(FEW))
                places = ((sheet, row + down + i, column + right + j) for i, j in steps)
                cells = list(takewhile(self._is_beside, places))
                is_list = down and self.calculation.number((sheet, row + 2, column)) is not None
                for cell in cells:
                    where = "listed" if is_list else "first" if cell == cells[0] else "beyond"
                    # A number at the left may have a label of its own.
                    is_called = kind != "any depth" and where == "first" and right >= 0
                    if is_called or self.gives_depth(cell):
                        labelled.append(self._result(kind == "ratio", cell, label, where))
                if cells:
                    break
        return labelled or self._unnamed()

    def _unnamed(self) -> list[Result]:
        """The only labelled cell that shows a depth near the end, whatever language labels it."""
        values, depth = self.calculation.values, self.lines["depth"]
        shown = []
        for sheet, row, column in self.calculation.formulas:
            _, *read = self.calculation.chain((sheet, row, column))
            at = depth.index(read[0]) if read else None
            text = values.get(label := (sheet, row, column - 1))
            # A number in the label may be that of a row.
            is_labelled = isinstance(text, str) and not (is_unit(text) or re.search(r"\d", text))
            near_end = at is not None and 0 <= self.zero + self.steps - at <= NEAR_END
            if is_labelled and near_end and self._is_beside((sheet, row, column)):
                shown.append(self._result(False, (sheet, row, column), label, "first"))
        return shown if len(shown) == 1 else []

    def _is_beside(self, place: Position) -> bool:
        """Whether a cell holds a number and belongs to no line of the table."""
        is_number = self.calculation.number(place) is not None
        return is_number and not any(line.covers(place) for line in self.every_line)

    def _result(self, is_ratio: bool, place: Position, label: Position, where: str) -> Result:
        """Return a result with its unit, as its label or a cell beside it gives it."""
        sheet, row, column = place
        near = (self.calculation.values.get((sheet, row, column + side)) for side in (1, -1))
        texts = [text for text in near if isinstance(text, str)]
        # The label's unit need not be that of the numbers beyond the first.
        named = unit_in(str(self.calculation.values[label])) if where != "beyond" else None
        unit = named or next(filter(None, map(is_unit, texts)), None)
        kind, measure = ("ratio", "1") if is_ratio else ("depth", "m")
        fits = unit is not None and same_dimension(unit, measure)
        return Result(kind, place, unit if fits else None, label, where)

    def gives_depth(self, place: Position) -> bool:
        """Whether a cell beside the table reads one of its depths, directly or not."""
        return "depth" in self.readers.get(place, ())

    @cached_property
    def readers(self) -> dict[Position, set[str]]:
        """The cells beside the table that read it, directly or not, and what they read of it.

        That is the roles of its columns, and "last" for the depth in the last row.
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
                # Of a large area, such as a long column, only the ends are looked at.
                cells = area.places() if area.cells <= FEW else area.ends
                read = read.union(*(readers.get(cell, ()) for cell in cells))
                if read:
                    readers.setdefault(place, set()).update(read)
        return readers

    @cached_property
    def places(self) -> dict[Position, tuple[str, int]]:
        """The role and the row of every cell of the table."""
        rows = range(self.steps + 1)
        return {self.place(role, k): (role, k) for role in self.lines for k in rows}

    @cached_property
    def digits(self) -> int | None:
        """The digits that the least precise column but the time is rounded to.

        None unless all its numbers are typed, and rounded.
        """
        lines = [line for role, line in self.lines.items() if role != "time"]
        rows = range(self.zero + 1, self.zero + self.steps + 1)
        if any(line.formula(at) for line in lines for at in rows):
            return None
        fewest = min(digits for role, (digits, _) in self.roundings.items() if role != "time")
        return fewest if fewest <= ROUNDED else None

    @cached_property
    def roundings(self) -> dict[str, tuple[int, int]]:
        """The digits of each column, and the power of ten of its last decimal.

        People round to a number of digits or to a number of decimals. The digits are those of all
        numbers but the longest 5 %; row 0, which is exact, is left out.
        """
        roundings = {}
        for role in self.lines:
            numbers = (self.number(role, k) for k in range(1, self.steps + 1))
            parts = sorted(digits_of(x) for x in numbers if x)
            digits = parts[len(parts) * 19 // 20][0] if parts else 17
            powers = (power for count, power in parts if count <= digits)
            roundings[role] = digits, min(powers, default=-300)
        return roundings


def tables(calculation: Calculation, given: Sequence[Line]) -> list[Table]:
    """Return every table of the scheme in a workbook, in the order of sheets and columns.

    If the user named lines (`given`), return only the tables that have them all. Raises ValueError
    if there is none.
    """
    known = [line for line in lines(calculation) if not any(map(line.overlaps, given))]
    chosen: list[Table] = []
    for depth, speed in _pairs([*known, *given]):
        used = {line for table in chosen for line in table.lines.values()}
        if not used & {depth, speed}:
            table = _table(depth, speed, [line for line in (*known, *given) if line not in used])
            # Other pairs of quantities grow like this, too: so both must have telling heads, or a
            # third column must fit.
            named = all(role in line.roles for role, line in table.lines.items())
            if named or len(table.lines) > 2:
                chosen.append(table)
    if given:
        chosen = [table for table in chosen if all(line in table.lines.values() for line in given)]
        if not chosen:
            raise ValueError(
                "what --map names belongs to no table of depth and velocity: name both columns, "
                "with the same number of rows"
            )
    shown = [table for table in chosen if not _is_view(table, chosen)]
    taken = {line for table in shown for line in table.lines.values()}

    def is_own(line: Line, table: Table) -> bool:
        beside = (other for other in shown if line in other.helpers)
        nearest = min(beside, key=lambda t: abs(t.lines["depth"].number - line.number))
        return line not in taken and nearest is table

    sheets = list(calculation.book.sheets)
    in_order = sorted(shown, key=lambda t: (sheets.index(t.sheet), t.lines["depth"].number))
    return [
        replace(table, helpers=tuple(line for line in table.helpers if is_own(line, table)))
        for table in in_order
    ]


def _pairs(known: Sequence[Line]) -> list[tuple[Line, Line]]:
    """Return lines that may be a depth and its velocity, the best pair first."""
    # A reference that drifts for want of a $ may turn a column into errors from its fourth row on:
    # a telling head makes up for the missing number.
    able = [line for line in known if len(line.numbers) >= LEAST - bool(line.roles)]
    longest = sorted(able, key=lambda line: (not line.roles, -len(line.values)))
    depths = [x for x in longest if "depth" in x.roles or (x.may_be("m") and x.may_rise)]
    speeds = [v for v in longest if v.is_speed or (v.may_be("m/s") and v.falls)]
    scored = [
        (_score(x, v), len(x.values), -abs(x.number - v.number), x, v)
        for x, v in product(depths[:_MAX_LINES], speeds[:_MAX_LINES])
        if (x.sheet, x.across) == (v.sheet, v.across)
    ]
    scored.sort(key=lambda entry: entry[:3], reverse=True)
    return [(x, v) for score, *_, x, v in scored if score >= _SURE]


def _score(depth: Line, speed: Line) -> float:
    """Return how well two lines go together as depth and velocity.

    Fitting values and telling heads give up to 1 each, formulas that read each other some more, and
    --map the most. The values of a faulty sheet need not fit if its depths read the one before.
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
    # A velocity that rises, or that does not follow from the depths, is the axis of a curve.
    sure = grows or given or (named == 2 and reads and _rests_on(speed, depth))
    if not sure and (fit < 0.5 or speed.numbers[-1] > speed.numbers[0]):
        return 0.0
    return fit + 0.5 * named + 0.3 * reads + 0.2 * grows - 0.2 * final + 2 * given


def _rests_on(line: Line, source: Line) -> bool:
    """Whether the last cell of a line reads the source through no more cells than a row has."""
    cells = {line.place(line.last)}
    for _ in COLUMNS:
        cells = set[Position]().union(*map(line.calculation.corners, cells))
        if any(map(source.covers, cells)):
            return True
    return False


def _constant(pairs: Iterable[tuple[float | None, float | None]], close: float = _CLOSE) -> float:
    """Return the share of pairs whose ratio equals the median ratio."""
    ratios = [a / b for a, b in pairs if a is not None and b]
    middle = median(ratios) if len(ratios) >= LEAST - 1 else 0.0
    if not middle or not math.isfinite(middle):
        return 0.0
    return sum(abs(ratio / middle - 1) < close for ratio in ratios) / len(ratios)


def _is_view(table: Table, tables: Sequence[Table]) -> bool:
    """Whether a table only shows the depths of another one, apart from some typed cells."""
    others = {place for another in tables if another is not table for place in another.places}
    cells = [table.place("depth", k) for k in range(1, table.steps + 1)]
    views = sum(not others.isdisjoint(table.calculation.corners(cell)) for cell in cells)
    depth = table.lines["depth"]
    return views > 0.9 * len(cells) and not depth.reads(depth, 1)


def _table(depth: Line, speed: Line, known: Sequence[Line]) -> Table:
    """Return the table of a depth and a velocity, with its other columns and its rows."""
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
        free = [line for line in beside if line not in roles.values()]
        fits = {line: _fits(role, line, speed, initial) for line in free}
        if fits:
            best = max(fits, key=lambda line: (fits[line], -abs(line.number - depth.number)))
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
    """Whether a velocity is that at the beginning of its row, not that at the end.

    If the head does not tell, the values do: a velocity at the beginning of a row changes to that
    of the next row by the row's own deceleration, one at the end changed from that of the row
    before. Without decelerations: the depth grows by the velocity at the beginning of its row.
    """
    if len(speed.roles) == 1 and not any("velocity_initial" in line.roles for line in beside):
        return speed.roles == {"velocity_initial"}
    brakes = [line for line in beside if "deceleration" in line.roles or not line.roles]
    if not brakes:
        same_row, next_row = (_tied(depth, speed, back, 1e-9) for back in (0, 1))
        return same_row >= next_row - 0.05
    same_row, next_row = (max(_tied(speed, line, back) for line in brakes) for back in (0, 1))
    return next_row >= same_row - 0.05


def _tied(line: Line, source: Line, back: int, close: float = _CLOSE) -> float:
    """Return the share of rows where a line changes in proportion to the source `back` rows ago."""
    rows = range(source.first, source.last + 1)
    return _constant(((line.change(at + back), source.at(at)) for at in rows), close)


def _fits(role: str, line: Line, speed: Line, initial: bool) -> float:
    """Return how well a line fits a role: up to 1 each for head and values, 3 for --map."""
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
            return 0.0  # no other row starts or ends with it, so it is that in mid-step
        return named + same * line.falls
    if role == "deceleration":
        fit = _tied(speed, line, initial) + 0.5 * _tied(speed, line, initial, 1e-9)
        return named + fit * (not line.falls)
    steps = [b - a for a, b in pairwise(line.numbers)] or [0.0]
    counts_rows = median(steps) == 1  # then only its head can make it a time
    return named + _constant((step, 1.0) for step in steps) * (not counts_rows and min(steps) > 0)


def _end(depth: Line, speed: Line, zero: int, last: int) -> int:
    """Return the index of the last row, without zeros and repeated rows after the standstill."""
    for at in range(last, zero + 2, -1):
        x, v = depth.at(at), speed.at(at)
        stays = x == depth.at(at - 1) and v == speed.at(at - 1)
        if x is None or v is None or not (stays or x == v == 0):
            fastest = max(map(abs, speed.numbers))
            ended = abs(speed.at(at) or 0.0) <= 0.2 * fastest and x is not None
            if at >= last - 1 or not ended:
                return last
            # The velocities that end the motion may stand in rows that keep the depth.
            moves = (k for k in range(at, zero, -1) if depth.at(k) != depth.at(k - 1))
            return next(moves, last)
    return last

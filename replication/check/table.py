"""Where the scheme stands in a workbook: its tables, found by their heads and by their values.

The values give themselves away: from row to row the depth grows by the velocity times a constant,
and the velocity falls by the deceleration times that constant, whatever the units are.
"""

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from statistics import median

from replication.check.words import COLUMNS, column_roles, is_unit, unit_in
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation

__all__ = ["Line", "Table", "address", "area_of", "tables"]

LEAST_ROWS = 4
"""Fewer numbers below each other are no table; the report itself prints five rows."""
_MAX_LINES = 60
_SAMPLE = 500
"""Rows that are looked at to see whether two columns may belong together."""
_GAP = 3
"""Cells that a column may lack: a blank or an error in its middle."""
_CLOSE = 0.02
"""How nearly a ratio of neighbouring rows must repeat. The velocity falls by 1 % a row, mostly."""


@dataclass(frozen=True)
class Line:
    """Numbers in one column, or in one row of a sheet that runs to the right.

    `first` is the row (or column) of the first of them, `values` what each cell holds.
    """

    sheet: str
    number: int
    first: int
    values: tuple[float | None, ...]
    across: bool
    head: str | None = None
    unit: str | None = None
    unit_place: Position | None = None

    @property
    def last(self) -> int:
        """The row, or column, of the last number."""
        return self.first + len(self.values) - 1

    @cached_property
    def roles(self) -> frozenset[str]:
        """What its head says it is."""
        return column_roles(self.head) if self.head else frozenset()

    def place(self, row: int) -> Position:
        """The cell in a row, or column, of the sheet."""
        return (self.sheet, self.number, row) if self.across else (self.sheet, row, self.number)

    def covers(self, place: Position) -> bool:
        """Whether a cell is one of these."""
        sheet, row, column = place
        line, at = (row, column) if self.across else (column, row)
        return sheet == self.sheet and line == self.number and self.first <= at <= self.last

    def at(self, row: int) -> float | None:
        """The number in a row, or column, of the sheet."""
        inside = self.first <= row <= self.last
        return self.values[row - self.first] if inside else None

    @cached_property
    def falls(self) -> bool:
        """Whether it looks like a velocity: positive, and rarely rising."""
        pairs = self._pairs()
        falling = sum(b <= a for a, b in pairs)
        start = next(v for v in self.values if v is not None)
        return start > 0 and falling >= 0.9 * len(pairs) and pairs[-1][1] < start

    @cached_property
    def rises(self) -> bool:
        """Whether it looks like a depth: from nearly nothing, and rarely falling."""
        pairs = self._pairs()
        rising = sum(b >= a for a, b in pairs)
        counts = all(b - a == 1 for a, b in pairs)
        grows = pairs[0][0] >= 0 and pairs[-1][1] > pairs[0][0]
        return grows and not counts and rising >= 0.9 * len(pairs)

    def _pairs(self) -> list[tuple[float, float]]:
        numbers = [value for value in self.values if value is not None]
        return list(zip(numbers, numbers[1:], strict=False))


@dataclass(frozen=True)
class Table:
    """One run of the scheme: its columns by role, and the row of the sheet that is its row 0.

    Row k of the scheme stands in row (or column) `zero` + k of the sheet, up to row `steps`. A
    table need not show row 0. `how` tells for each role by what it was found.
    """

    lines: Mapping[str, Line]
    zero: int
    steps: int
    how: Mapping[str, str]
    helpers: tuple[Line, ...] = ()

    @property
    def sheet(self) -> str:
        """The sheet that it stands on."""
        return self.lines["depth"].sheet

    @property
    def across(self) -> bool:
        """Whether its steps run to the right."""
        return self.lines["depth"].across

    def place(self, role: str, k: int) -> Position:
        """The cell of a role in row k."""
        return self.lines[role].place(self.zero + k)

    def number(self, role: str, k: int) -> float | None:
        """What that cell holds."""
        return self.lines[role].at(self.zero + k) if role in self.lines else None

    def area(self, role: str) -> str:
        """The cells of a role, as an address."""
        rows = [k for k in range(self.steps + 1) if self.number(role, k) is not None]
        return area_of(self.place(role, rows[0]), self.place(role, rows[-1]))

    @cached_property
    def places(self) -> dict[Position, tuple[str, int]]:
        """Every cell of the table -> its role and row."""
        return {
            self.place(role, k): (role, k) for role in self.lines for k in range(self.steps + 1)
        }


def address(place: Position, with_sheet: bool = False) -> str:
    """A cell as people write it.

    >>> address(("Sheet1", 9, 4)), address(("my sheet", 9, 4), with_sheet=True)
    ('D9', "'my sheet'!D9")
    """
    from openpyxl.utils.cell import get_column_letter

    cell = f"{get_column_letter(place[2])}{place[1]}"
    return f"{_quoted(place[0])}!{cell}" if with_sheet else cell


def area_of(first: Position, last: Position) -> str:
    """The cells from one to another, as an address without the sheet."""
    return address(first) if first == last else f"{address(first)}:{address(last)}"


def _quoted(sheet: str) -> str:
    return sheet if re.fullmatch(r"[A-Za-z_]\w*", sheet) else "'" + sheet.replace("'", "''") + "'"


def tables(calculation: Calculation, mapped: Mapping[str, Line]) -> list[Table]:
    """Every table of the scheme in a workbook, in the order of sheets and columns.

    `mapped` are the columns that the user named; they belong to one table.
    """
    lines = [_headed(line, calculation) for line in _lines(calculation)]
    if mapped:
        mapped = {role: _headed(line, calculation) for role, line in mapped.items()}
        return [_mapped(mapped, lines, calculation)]
    found: list[Table] = []
    for depth, velocity in _pairs(lines, calculation):
        if any(_overlap(line, depth) for table in found for line in table.lines.values()):
            continue
        if any(_overlap(line, velocity) for table in found for line in table.lines.values()):
            continue
        if not any(_copied(table, depth, calculation) for table in found):
            chosen = {"depth": depth, "velocity": velocity}
            table = _completed(chosen, lines, found, {}, calculation)
            # Other quantities grow like this, too: it takes a third one, or names.
            if table is not None and (len(table.lines) > 2 or set(table.how.values()) == {"head"}):
                found.append(table)
    found = [table for table in found if not _viewed(table, found, calculation)]
    sheets = list(calculation.book.sheets)
    return sorted(found, key=lambda t: (sheets.index(t.sheet), t.lines["depth"].number))


def _lines(calculation: Calculation) -> Iterator[Line]:
    """Runs of numbers, down the columns and along the rows, those of the same line joined."""
    by_sheet: dict[str, dict[tuple[int, int], float | None]] = {s: {} for s in calculation.book.sheets}
    for (sheet, row, column), value in calculation.values.items():
        if isinstance(value, float) and math.isfinite(value):
            by_sheet[sheet][row, column] = value
        elif calculation.error((sheet, row, column)):
            by_sheet[sheet][row, column] = None  # part of a table, though gone wrong
    for sheet, numbers in by_sheet.items():
        for across in (False, True):
            by_line: dict[int, list[int]] = {}
            for row, column in numbers:
                line, at = (row, column) if across else (column, row)
                by_line.setdefault(line, []).append(at)
            for line, places in sorted(by_line.items()):
                for first, last in _runs(sorted(places), sheet, line, across, calculation):
                    cells = [
                        numbers.get((line, i) if across else (i, line))
                        for i in range(first, last + 1)
                    ]
                    if sum(cell is not None for cell in cells) >= LEAST_ROWS:
                        yield Line(sheet, line, first, tuple(cells), across)


def _runs(
    places: Sequence[int], sheet: str, line: int, across: bool, calculation: Calculation
) -> Iterator[tuple[int, int]]:
    """First and last of each run; a few cells without a number do not end it, a text does."""
    first = before = places[0]
    for here in [*places[1:], None]:
        if here is not None and (here == before + 1 or _bridged(before, here, sheet, line, across, calculation)):
            before = here
            continue
        if before - first + 1 >= LEAST_ROWS:
            yield first, before
        if here is not None:
            first = before = here


def _bridged(
    before: int, here: int, sheet: str, line: int, across: bool, calculation: Calculation
) -> bool:
    """Whether the cells between belong to a table: formulas or errors, not blanks or words."""
    if here - before - 1 > _GAP:
        return False
    between = ((sheet, line, i) if across else (sheet, i, line) for i in range(before + 1, here))
    return all(place in calculation.formulas or calculation.book[place].error for place in between)


def _headed(line: Line, calculation: Calculation) -> Line:
    """The line with the head above it (or at its left), and its unit."""
    head = unit = place = None
    blanks = 0
    for at in range(line.first - 1, max(line.first - 7, 0), -1):
        text = calculation.values.get(line.place(at))
        if isinstance(text, str) and text.strip():
            own = is_unit(text)
            if own and unit is None and not (own == "m" and len(text.strip()) == 1 and blanks):
                unit, place = own, line.place(at)
            elif not own:
                head = text.strip()
                if unit is None and (unit := unit_in(head)):
                    place = line.place(at)
                break
        elif text is None:
            blanks += 1
            if blanks > 2:
                break
        else:
            break
    return Line(line.sheet, line.number, line.first, line.values, line.across, head, unit, place)


def _pairs(lines: Sequence[Line], calculation: Calculation) -> list[tuple[Line, Line]]:
    """Depths with their velocities, the surest first."""
    scored = []
    longest = sorted(lines, key=lambda line: (not line.roles, -len(line.values)))
    depths = [line for line in longest if _may_be(line, "depth", line.rises)][:_MAX_LINES]
    speeds = [line for line in longest if _may_be(line, "velocity", line.falls)][:_MAX_LINES]
    for depth in depths:
        for speed in speeds:
            if depth.sheet != speed.sheet or depth.across != speed.across or depth is speed:
                continue
            score = _score(depth, speed, calculation)
            if score >= 0.75:
                distance = abs(depth.number - speed.number)
                scored.append((score, len(depth.values), -distance, depth, speed))
    scored.sort(key=lambda entry: entry[:3], reverse=True)
    return [(depth, speed) for *_, depth, speed in scored]


def _may_be(line: Line, role: str, looks: bool) -> bool:
    named = any(r.startswith(role) for r in line.roles)
    return named or (looks and not line.roles)


def _score(depth: Line, speed: Line, calculation: Calculation) -> float:
    """From 0 to 2.5: 1 for heads that say so, 1 for values that fit, a little for their formulas.

    Values that do not fit may be those of a sheet gone wrong: then each depth reads the one before.
    """
    rows = range(max(depth.first, speed.first), min(depth.last, speed.last) + 1)
    if len(rows) < LEAST_ROWS:
        return 0.0
    rows = rows[:: 1 + len(rows) // _SAMPLE]
    steps = [(_difference(depth, row), speed.at(row)) for row in rows]
    fit = _constant([a / b for a, b in steps if a is not None and b])
    grows = _reads(depth, depth, 1, calculation)
    if fit < 0.5 and not grows:
        return 0.0
    named = ("depth" in depth.roles) + any(r.startswith("velocity") for r in speed.roles)
    final = speed.roles == {"velocity_final"}
    reads = any(_reads(depth, speed, back, calculation) for back in (0, 1))
    return fit + 0.5 * named + 0.3 * reads + 0.2 * grows - 0.2 * final


def _reads(line: Line, other: Line, back: int, calculation: Calculation) -> bool:
    """Whether most cells of a line are formulas that read another line's cell, so many rows back."""
    rows = range(line.first + 1, line.last + 1)
    rows = rows[:: 1 + len(rows) // _SAMPLE]
    formulas = ((row, calculation.formulas.get(line.place(row))) for row in rows)
    reads = sum(f is not None and any(other.place(row - back) in a for a in f.areas) for row, f in formulas)
    return reads >= 0.5 * len(rows)


def _difference(line: Line, row: int) -> float | None:
    here, before = line.at(row), line.at(row - 1)
    return None if here is None or before is None else here - before


def _constant(ratios: Sequence[float], close: float = _CLOSE) -> float:
    """Which share of some ratios is the same number."""
    if len(ratios) < LEAST_ROWS - 1:
        return 0.0
    middle = median(ratios)
    if not middle or not math.isfinite(middle):
        return 0.0
    return sum(abs(ratio / middle - 1) < close for ratio in ratios) / len(ratios)


def _overlap(a: Line, b: Line) -> bool:
    same = a.sheet == b.sheet and a.number == b.number and a.across == b.across
    return same and a.first <= b.last and b.first <= a.last


def _copied(table: Table, depth: Line, calculation: Calculation) -> bool:
    """Whether a depth is that of a table once more, in another unit or for a chart."""
    own = table.lines["depth"]
    if own.sheet != depth.sheet or own.across != depth.across:
        return False
    rows = range(max(own.first, depth.first), min(own.last, depth.last) + 1)
    pairs = [(own.at(row), depth.at(row)) for row in rows]
    ratios = [b / a for a, b in pairs if a and b]
    if len(ratios) < LEAST_ROWS - 1 or max(ratios) - min(ratios) > 1e-6 * abs(max(ratios)):
        return False
    formulas = [f for row in rows if (f := calculation.formulas.get(depth.place(row)))]
    reads = (any(own.place(row) in area for area in f.areas) for row, f in zip(rows, formulas, strict=False))  # noqa: E501
    return not formulas or any(reads)


def _viewed(table: Table, others: Sequence[Table], calculation: Calculation) -> bool:
    """Whether a table only shows what another one holds."""
    shown = {place for other in others if other is not table for place in other.places}
    places = [table.place("depth", k) for k in range(1, table.steps + 1)]
    formulas = [calculation.formulas.get(place) for place in places]
    return all(f is not None and any(area.corner in shown for area in f.areas) for f in formulas)


def _mapped(
    mapped: Mapping[str, Line], lines: Sequence[Line], calculation: Calculation
) -> Table:
    chosen = dict(mapped)
    own = chosen.get("velocity_initial") or chosen.get("velocity_final")
    for role in ("depth", "velocity"):
        if role == "velocity" and own is not None:
            chosen["velocity"] = own
        elif role not in chosen:
            near = [pair for pair in _pairs(lines, calculation) if _beside(pair, chosen.values())]
            if not near:
                raise ValueError(
                    f"no {role} is found beside what --map names: give --map {role}=RANGE, too"
                )
            chosen[role] = near[0][role == "velocity"]
    table = _completed(
        {"depth": chosen["depth"], "velocity": chosen["velocity"]}, lines, [], mapped, calculation
    )
    if table is None:
        raise ValueError("the ranges of --map share fewer than four rows: they are no table")
    return table


def _beside(pair: tuple[Line, Line], lines: Iterable[Line]) -> bool:
    return all(
        line.sheet == pair[0].sheet and line.across == pair[0].across
        and (line in pair or not any(_overlap(line, p) for p in pair))
        and line.first <= pair[0].last and pair[0].first <= line.last
        for line in lines
    )  # fmt: skip


def _completed(
    chosen: Mapping[str, Line],
    lines: Sequence[Line],
    taken: Sequence[Table],
    mapped: Mapping[str, Line],
    calculation: Calculation,
) -> Table | None:
    """The table around a depth and a velocity: its other columns and its rows."""
    depth, speed = chosen["depth"], chosen["velocity"]
    first, last = min(depth.first, speed.first), max(depth.last, speed.last)
    used = {id(line) for table in taken for line in table.lines.values()}
    beside = [
        line
        for line in lines
        if line.sheet == depth.sheet
        and line.across == depth.across
        and id(line) not in used
        and line not in (depth, speed)
        and min(line.last, last) - max(line.first, first) + 1 >= 0.5 * (last - first + 1)
    ]
    roles: dict[str, Line] = {"depth": depth}
    role = _which_velocity(speed, beside, mapped)
    roles[role] = speed
    other = "velocity_final" if role == "velocity_initial" else "velocity_initial"
    for wanted in (other, "deceleration", "time"):
        if wanted in mapped:
            roles[wanted] = mapped[wanted]
            continue
        scored = [
            (_fits(wanted, line, speed, role), -abs(line.number - depth.number), i)
            for i, line in enumerate(beside)
            if line not in roles.values()
        ]
        if scored and max(scored)[0] >= 0.9:
            roles[wanted] = beside[max(scored)[2]]
    return _rows(roles, mapped, beside)


def _which_velocity(speed: Line, beside: Sequence[Line], mapped: Mapping[str, Line]) -> str:
    """Whether a velocity is that at the beginning of its row, or at its end."""
    for role in ("velocity_initial", "velocity_final"):
        if mapped.get(role) is speed:
            return role
    if speed.roles == {"velocity_final"} and not any(
        "velocity_initial" in line.roles and line.falls for line in beside
    ):
        return "velocity_final"
    # The one that takes from this row's velocity the next row's is the one at the beginning.
    best = "velocity_initial", 0.0
    for line in beside:
        if "deceleration" not in line.roles and line.roles:
            continue
        for role, later in (("velocity_initial", 1), ("velocity_final", 0)):
            fit = _braking(line, speed, later)
            if fit > best[1] + 0.05:
                best = role, fit
    return best[0]


def _braking(brake: Line, speed: Line, later: int, close: float = _CLOSE) -> float:
    """The share of rows in which a deceleration takes the velocity down by a constant times it."""
    ratios = []
    for row in range(brake.first, brake.last + 1):
        change, a = _difference(speed, row + later), brake.at(row)
        if change is not None and a:
            ratios.append(change / a)
    return _constant(ratios, close)


def _fits(wanted: str, line: Line, speed: Line, role: str) -> float:
    """How well a line would do in a role: 1 for its head, 1 for its values."""
    named = float(wanted in line.roles)
    if line.roles and not any(r[:4] == wanted[:4] for r in line.roles):
        return 0.0
    rows = range(line.first, line.last + 1)
    if wanted.startswith("velocity"):
        later = 1 if role == "velocity_initial" else -1
        pairs = [(line.at(row), speed.at(row + later)) for row in rows]
        both = [(a, b) for a, b in pairs if a is not None and b is not None]
        same = sum(math.isclose(a, b, rel_tol=1e-9) for a, b in both) / max(len(both), 1)
        return named + same * line.falls
    if wanted == "deceleration":
        later = 1 if role == "velocity_initial" else 0
        fit = _braking(line, speed, later) + 0.5 * _braking(line, speed, later, 1e-9)
        return named + fit * (not line.falls)
    numbers = [value for value in line.values if value is not None]
    steps = [b - a for a, b in zip(numbers, numbers[1:], strict=False)]
    whole = all(step == 1 for step in steps)  # an index, unless its head says time
    return named + _constant(steps) * (not whole and min(steps) > 0)


def _rows(
    roles: dict[str, Line], mapped: Mapping[str, Line], beside: Sequence[Line]
) -> Table | None:
    """The table's row 0 and its last row."""
    depth = roles["depth"]
    speed = roles.get("velocity_initial") or roles["velocity_final"]
    first = max(depth.first, speed.first)
    last = min(max(depth.last, speed.last), *(line.last for line in (depth, speed)))
    if last - first + 1 < LEAST_ROWS:
        return None
    zeros = [row for row in range(depth.first, min(depth.first + 4, last)) if depth.at(row) == 0]
    zero = zeros[-1] if zeros else first - 1
    last = _end(depth, speed, zero, last)
    how = {
        role: "--map" if role in mapped else "head" if role in line.roles else "values"
        for role, line in roles.items()
    }
    ordered = {
        role: roles[role]
        for role in COLUMNS
        if role in roles and any(roles[role].at(row) is not None for row in range(zero, last + 1))
    }
    if len(ordered.keys() & {"velocity_initial", "velocity_final"}) == 0 or "depth" not in ordered:
        return None
    helpers = tuple(line for line in beside if line not in roles.values())
    return Table(ordered, zero, last - zero, how, helpers)


def _end(depth: Line, speed: Line, zero: int, last: int) -> int:
    """The last row, without those that only hold zero or repeat it once the motion has ended."""
    for row in range(last, zero + 2, -1):
        x, v = depth.at(row), speed.at(row)
        held = x == depth.at(row - 1) and v == speed.at(row - 1)
        if x is None or v is None or not (held or x == v == 0):
            return row if row < last - 1 else last
    return last

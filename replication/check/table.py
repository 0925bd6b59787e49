"""Where the scheme stands in a workbook: its tables, found by their heads and by their values.

The values give themselves away: from row to row the depth grows by the velocity times a constant,
and the velocity falls by the deceleration times that constant, whatever the units are.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from statistics import median

from replication.check.lines import LEAST, Line, area_of, lines
from replication.check.words import COLUMNS
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation

_MAX_LINES = 60
_SAMPLE = 500
"""Rows that are looked at to see whether two lines may belong together."""
_CLOSE = 0.02
"""How nearly a ratio of neighbouring rows must repeat. The velocity falls by 1 % a row, mostly."""
_SURE = 0.75
"""What two lines must score to be depth and velocity: their values fit, or both heads say so."""


@dataclass(frozen=True)
class Table:
    """One run of the scheme: its columns by role, and the row of the sheet that is its row 0.

    Row k of the scheme stands in row (or column) `zero` + k of the sheet, up to row `steps`. A
    table need not show row 0. `helpers` are other lines beside it.
    """

    lines: Mapping[str, Line]
    zero: int
    steps: int
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
        rows = range(self.steps + 1)
        return {self.place(role, k): (role, k) for role in self.lines for k in rows}


def tables(calculation: Calculation, given: Sequence[Line]) -> list[Table]:
    """Every table of the scheme in a workbook, in the order of sheets and columns.

    `given` are lines that the user named; only the table that they belong to is then meant. Raises
    ValueError where they belong to none.
    """
    known = [line for line in lines(calculation) if not any(map(line.overlaps, given))]
    found: list[Table] = []
    for depth, speed in _pairs([*known, *given], calculation):
        used = [line for table in found for line in table.lines.values()]
        if any(line.overlaps(depth) or line.overlaps(speed) for line in used):
            continue
        if any(_copied(table, depth, calculation) for table in found):
            continue
        left = [line for line in (*known, *given) if line not in used]
        table = _table(depth, speed, left, calculation)
        # Other quantities grow like this, too: it takes a third one, or names for both.
        if table and (
            len(table.lines) > 2 or all(role in table.lines[role].roles for role in table.lines)
        ):
            found.append(table)
    if given:
        found = [table for table in found if all(line in table.lines.values() for line in given)]
        if not found:
            raise ValueError(
                "what --map names belongs to no table of depth and velocity: name both, with as "
                "many rows"
            )
    own = [table for table in found if not _viewed(table, found, calculation)]
    sheets = list(calculation.book.sheets)
    return sorted(own, key=lambda t: (sheets.index(t.sheet), t.lines["depth"].number))


def _pairs(known: Sequence[Line], calculation: Calculation) -> list[tuple[Line, Line]]:
    """Depths with their velocities, the surest first."""
    longest = sorted(known, key=lambda line: (not line.roles, -len(line.values)))
    depths = [x for x in longest if "depth" in x.roles or (x.rises and not x.roles)]
    speeds = [v for v in longest if _is_speed(v) or (v.falls and not v.roles)]
    scored = [
        (_score(x, v, calculation), len(x.values), -abs(x.number - v.number), x, v)
        for x in depths[:_MAX_LINES]
        for v in speeds[:_MAX_LINES]
        if (x.sheet, x.across) == (v.sheet, v.across)
    ]
    scored.sort(key=lambda entry: entry[:3], reverse=True)
    return [(x, v) for score, *_, x, v in scored if score >= _SURE]


def _is_speed(line: Line) -> bool:
    return any(role.startswith("velocity") for role in line.roles)


def _score(depth: Line, speed: Line, calculation: Calculation) -> float:
    """1 for heads that say so, 1 for values that fit, a little for formulas; more for --map.

    Values that do not fit may be those of a sheet gone wrong: then each depth reads the one before.
    """
    rows = range(max(depth.first, speed.first), min(depth.last, speed.last) + 1)
    if len(rows) < LEAST:
        return 0.0
    changes = ((depth.change(at), speed.at(at)) for at in rows[:: 1 + len(rows) // _SAMPLE])
    fit = _constant([a / b for a, b in changes if a is not None and b])
    grows = _reads(depth, depth, 1, calculation)
    given = (depth.given is not None) + (speed.given is not None)
    # A velocity that ends higher than it began is the axis of a curve.
    held = [value for value in speed.values if value is not None]
    if not grows and not given and (fit < 0.5 or held[-1] > held[0]):
        return 0.0
    named = ("depth" in depth.roles) + _is_speed(speed)
    final = speed.roles == {"velocity_final"}
    reads = any(_reads(depth, speed, back, calculation) for back in (0, 1))
    return fit + 0.5 * named + 0.3 * reads + 0.2 * grows - 0.2 * final + 2 * given


def _reads(line: Line, other: Line, back: int, calculation: Calculation) -> bool:
    """Whether most cells of a line are formulas that read another's cell, so many rows back."""
    rows = range(line.first + 1, line.last + 1)[:: 1 + len(line.values) // _SAMPLE]
    formulas = ((at, calculation.formulas.get(line.place(at))) for at in rows)
    reads = sum(f is not None and f.reads(other.place(at - back)) for at, f in formulas)
    return reads >= 0.5 * len(rows)


def _constant(ratios: Sequence[float], close: float = _CLOSE) -> float:
    """Which share of some ratios is the same number."""
    middle = median(ratios) if len(ratios) >= LEAST - 1 else 0.0
    if not middle or not math.isfinite(middle):
        return 0.0
    return sum(abs(ratio / middle - 1) < close for ratio in ratios) / len(ratios)


def _copied(table: Table, depth: Line, calculation: Calculation) -> bool:
    """Whether a depth is that of a table once more, in another unit or for a chart."""
    own = table.lines["depth"]
    if (own.sheet, own.across) != (depth.sheet, depth.across):
        return False
    pairs = ((own.at(at), depth.at(at)) for at in range(depth.first, depth.last + 1))
    ratios = [b / a for a, b in pairs if a and b]
    formulas = any(depth.place(at) in calculation.formulas for at in range(depth.first, depth.last))
    reads = not formulas or _reads(depth, own, 0, calculation)
    return reads and _constant(ratios, 1e-6) == 1.0


def _viewed(table: Table, others: Sequence[Table], calculation: Calculation) -> bool:
    """Whether a table only shows what another one holds."""
    shown = {place for other in others if other is not table for place in other.places}
    places = [table.place("depth", k) for k in range(1, table.steps + 1)]
    formulas = [calculation.formulas.get(place) for place in places]
    return all(f is not None and any(area.corner in shown for area in f.areas) for f in formulas)


def _table(
    depth: Line, speed: Line, known: Sequence[Line], calculation: Calculation
) -> Table | None:
    """The table around a depth and a velocity: its other columns and its rows."""
    first, last = max(depth.first, speed.first), min(depth.last, speed.last)
    if last - first + 1 < LEAST:
        return None
    beside = [
        line
        for line in known
        if (line.sheet, line.across) == (depth.sheet, depth.across)
        and line not in (depth, speed)
        and min(line.last, last) - max(line.first, first) >= 0.5 * (last - first)
    ]
    initial = _at_beginning(speed, beside)
    roles = {"depth": depth, "velocity_initial" if initial else "velocity_final": speed}
    for role in ("velocity_final" if initial else "velocity_initial", "deceleration", "time"):
        left = [line for line in beside if line not in roles.values()]
        if left:
            fits = {line: _fits(role, line, speed, initial, calculation) for line in left}
            best = max(left, key=lambda line: (fits[line], -abs(line.number - depth.number)))
            if fits[best] >= 0.9:
                roles[role] = best
    zeros = [at for at in range(depth.first, min(depth.first + 4, last)) if depth.at(at) == 0]
    zero = zeros[-1] if zeros else first - 1
    last = _end(depth, speed, zero, last)
    ordered = {
        role: roles[role]
        for role in COLUMNS
        if role in roles and any(roles[role].at(at) is not None for at in range(zero, last + 1))
    }
    if "depth" not in ordered or not any(role.startswith("velocity") for role in ordered):
        return None
    helpers = tuple(line for line in beside if line not in roles.values())
    return Table(ordered, zero, last - zero, helpers)


def _at_beginning(speed: Line, beside: Sequence[Line]) -> bool:
    """Whether a velocity is that at the beginning of its row, not at its end.

    The deceleration of a row takes the velocity at its beginning to that of the next row, and that
    of the row before to the velocity at its end.
    """
    if len(speed.roles) == 1 and not any("velocity_initial" in line.roles for line in beside):
        return speed.roles == {"velocity_initial"}
    brakes = [line for line in beside if "deceleration" in line.roles or not line.roles]
    later = max((_braking(line, speed, 1) for line in brakes), default=0.0)
    return later >= max((_braking(line, speed, 0) for line in brakes), default=0.0) - 0.05


def _braking(brake: Line, speed: Line, later: int, close: float = _CLOSE) -> float:
    """The share of rows in which a deceleration takes the velocity down by a constant times it."""
    rows = range(brake.first, brake.last + 1)
    pairs = ((speed.change(at + later), brake.at(at)) for at in rows)
    return _constant([change / a for change, a in pairs if change is not None and a], close)


def _fits(role: str, line: Line, speed: Line, initial: bool, calculation: Calculation) -> float:
    """How well a line would do in a role: 1 for its head, 1 for its values; more for --map."""
    named = (role in line.roles) * (3.0 if line.given else 1.0)
    if line.roles and not any(own[:4] == role[:4] for own in line.roles):
        return 0.0
    if role.startswith("velocity"):
        later = 1 if initial else -1
        rows = range(line.first, line.last + 1)
        pairs = ((line.at(at), speed.at(at + later)) for at in rows)
        both = [(a, b) for a, b in pairs if a is not None and b is not None]
        same = sum(math.isclose(a, b, rel_tol=1e-9) for a, b in both) / max(len(both), 1)
        before, after = (line, speed) if initial else (speed, line)
        typed = after.place(after.last) not in calculation.formulas
        if same < 0.5 and not (typed or line.given or _reads(after, before, 1, calculation)):
            return 0.0  # a velocity that no other row takes on is one in the middle of its row
        return named + same * line.falls
    if role == "deceleration":
        fit = _braking(line, speed, initial) + 0.5 * _braking(line, speed, initial, 1e-9)
        return named + fit * (not line.falls)
    steps = [b - a for a, b in pairwise(value for value in line.values if value is not None)]
    counts = all(step == 1 for step in steps)  # the rows, unless its head says time
    return named + _constant(steps) * (not counts and min(steps) > 0)


def _end(depth: Line, speed: Line, zero: int, last: int) -> int:
    """The last row, without those that only hold zero or repeat it once the motion has ended."""
    for at in range(last, zero + 2, -1):
        x, v = depth.at(at), speed.at(at)
        held = x == depth.at(at - 1) and v == speed.at(at - 1)
        if x is None or v is None or not (held or x == v == 0):
            fastest = max(abs(value) for value in speed.values if value is not None)
            ended = abs(speed.at(at) or 0.0) <= 0.2 * fastest and x is not None
            return at if at < last - 1 and ended else last
    return last

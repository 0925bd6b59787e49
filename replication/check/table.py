"""Find the tables of a workbook by their values alone: lines of numbers, down or across.

From row to row of a table the depth grows by the velocity times a constant; the velocity at the
start of a row repeats that at the end of the row before; the velocity falls by the deceleration
times the same constant. Heads only decide between lines that fit alike, and name things.
"""

import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import groupby, pairwise
from statistics import median
from typing import NamedTuple

from replication.check.difference import span
from replication.check.labels import is_sure
from replication.check.words import column_roles, digits_of, is_unit, power_of_ten, unit_in
from spreadsheets.engines import in_quotes
from spreadsheets.evaluate import Evaluator, Shape, column_letters
from spreadsheets.foreign import Position

LEAST = 4
"""The fewest numbers of a line."""
_MOST_LINES = 150
"""The most lines of one sheet and direction that are compared with each other."""
_GAP = 3
"""So many blank rows may be left out inside a table."""
_HEADS = 5
"""How far above its numbers the head of a line may stand."""
_FAR_MORE = 3
"""That all numbers of a column but one end in so many zeros is no chance."""
_EXACT = 1e-9
"""Relative difference up to which formulas follow a relation; they round to some 1e-15."""
_ABOUT = 0.01
"""The decimal logarithm of a ratio up to which two steps of typed numbers may be the same."""
_LOOSE = 0.05
"""The same where no pair of lines follows one exactly, as in another scheme."""


def cell_name(place: Position, with_sheet: bool = False) -> str:
    """Return the address of a cell as a spreadsheet shows it.

    >>> cell_name(("Sheet1", 9, 4)), cell_name(("my sheet", 9, 4), with_sheet=True)
    ('D9', "'my sheet'!D9")
    """
    sheet, row, column = place
    cell = f"{column_letters(column)}{row}"
    plain = re.fullmatch(r"[A-Za-z_]\w*", sheet)
    return f"{sheet if plain else in_quotes(sheet)}!{cell}" if with_sheet else cell


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


@dataclass(frozen=True, eq=False)
class Line:
    """A column (or, `across`, a row) of numbers, by their index along it.

    `head` is the text above, `unit` the unit that it states, if any; `sure`: that unit stands in
    brackets or in a cell of its own. `given`: the user named the line. `meant` is the formula that
    its cells should have, if it is known by what it gives.
    """

    evaluator: Evaluator
    sheet: str
    across: bool
    number: int
    values: Mapping[int, float]
    given: str | None = None
    meant: Shape | None = None

    def place(self, index: int) -> Position:
        """The cell at an index."""
        if self.across:
            return self.sheet, self.number, index
        return self.sheet, index, self.number

    @cached_property
    def texts(self) -> list[str]:
        """The texts above the first number, the nearest first."""
        first, texts = min(self.values), []
        for index in range(first - 1, max(0, first - 1 - _HEADS), -1):
            value = self.evaluator.values.get(self.place(index))
            if isinstance(value, float):
                break
            if isinstance(value, str) and self.place(index) not in self.evaluator.formulas:
                texts.append(value)
        return texts

    @property
    def head(self) -> str:
        """The nearest text above that is no unit."""
        return next((text for text in self.texts if not is_unit(text)), "")

    @cached_property
    def unit(self) -> str | None:
        """The unit in the nearest text above that has one."""
        for text in self.texts[:2]:
            if unit := is_unit(text) or unit_in(text):
                return unit
        return None

    @property
    def unit_place(self) -> Position | None:
        """The cell above in which a unit stands."""
        first = min(self.values)
        for index in range(first - 1, max(0, first - 1 - _HEADS), -1):
            value = self.evaluator.values.get(self.place(index))
            if isinstance(value, str) and (is_unit(value) or unit_in(value)):
                return self.place(index)
        return None

    @property
    def sure(self) -> bool:
        """Whether the unit stands in brackets, after "in", or in a cell of its own."""
        stated = (text for text in self.texts[:2] if is_unit(text) or unit_in(text))
        return any(map(is_sure, stated))

    @cached_property
    def roles(self) -> frozenset[str]:
        """The columns of the scheme that the head may name; "other" for another quantity."""
        return column_roles(self.head) if self.head else frozenset()

    @cached_property
    def computed(self) -> bool:
        """Whether most of its cells are formulas."""
        formulas = self.evaluator.formulas
        return sum(self.place(i) in formulas for i in self.values) > len(self.values) / 2

    @cached_property
    def grows(self) -> bool:
        """Whether most numbers are larger than those before them."""
        ordered = [self.values[index] for index in sorted(self.values)]
        return sum(b > a for a, b in pairwise(ordered)) > 0.8 * (len(ordered) - 1)

    @cached_property
    def falls(self) -> bool:
        """Whether few numbers are larger than those before them."""
        ordered = [self.values[index] for index in sorted(self.values)]
        return sum(b > a for a, b in pairwise(ordered)) < 0.2 * (len(ordered) - 1)

    @cached_property
    def positive(self) -> bool:
        """Whether most numbers are above zero."""
        return sum(value > 0 for value in self.values.values()) > 0.8 * len(self.values)

    @cached_property
    def largest_change(self) -> float:
        """The largest difference between neighbours."""
        ordered = [self.values[index] for index in sorted(self.values)]
        return max((abs(b - a) for a, b in pairwise(ordered)), default=0.0)

    @cached_property
    def negative(self) -> bool:
        """Whether most numbers are below zero."""
        return sum(value < 0 for value in self.values.values()) > len(self.values) / 2

    @cached_property
    def _digits(self) -> tuple[int, int]:
        """The most digits of a typed or printed number, and the power of ten of the last digit.

        A single number with far more digits, and decimals, than all others says nothing of these.
        """
        printed = self.evaluator.book.digits.get(self.sheet, {})
        counts = [
            printed.get(self.place(i)[1:]) or digits_of(value)
            for i, value in self.values.items()
            if value
        ]
        if len(counts) > 1:
            (digits, last), *others = sorted(counts, key=lambda count: count[1])
            most, least = max(n for n, _ in others), others[0][1]
            if digits >= most + _FAR_MORE and last <= least - _FAR_MORE:
                counts = others
        return max((n for n, _ in counts), default=15), min((p for _, p in counts), default=-300)

    def rounding(self, value: float, fewest: int = 3) -> float:
        """How far a number of this line may be from the one that was meant, by its digits.

        `fewest`: a number with fewer digits was typed with zeros at its end left out.
        """
        if self.computed or value == 0 or not math.isfinite(value):
            return 1e-14 * abs(value)
        digits, last = self._digits
        if digits >= 15:
            return max(1e-15 * abs(value), 0.5 * 10.0**last if last > -300 else 0.0)
        least = 10.0 ** (math.floor(math.log10(abs(value))) - max(digits, fewest) + 1)
        return 0.5 * max(least, 10.0**last if last > -300 else 0.0)

    @cached_property
    def usual(self) -> Shape | None:
        """The formula that most cells have, if a third have one."""
        if self.meant is not None:
            return self.meant
        shapes = self.shapes
        if not shapes:
            return None
        shape, count = shapes.most_common(1)[0]
        return shape if count > 2 and 3 * count >= len(self.values) - 2 else None

    @cached_property
    def shapes(self) -> Counter[Shape]:
        """Its formulas, with the number of cells that have each."""
        formulas, counter = self.evaluator.formulas, Counter[Shape]()
        for index in self.values:
            if (shape := formulas.get(self.place(index))) is not None:
                counter[shape] += 1
        return counter


@dataclass(frozen=True, eq=False)
class SchemeTable:
    """A table of the scheme: its lines by role, other lines beside them, and its rows.

    `rows` gives the index of each row by its number: row 0 is the impact, row 1 the first step.
    Row 0 need not be shown, nor one that is left out. `whole`: its first rows are there; a part of
    a table starts later. `repeated` are the indices of rows that stand twice and have no number.
    """

    evaluator: Evaluator
    sheet: str
    across: bool
    lines: dict[str, Line]
    helpers: tuple[Line, ...]
    rows: Mapping[int, int]
    whole: bool = True
    repeated: tuple[int, ...] = ()
    places: dict[Position, tuple[str, int]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for role, line in self.lines.items():
            for k, index in self.rows.items():
                self.places[line.place(index)] = role, k
            for index in self.repeated:
                same = max((k for k, own in self.rows.items() if own < index), default=0)
                self.places[line.place(index)] = role, same

    @property
    def steps(self) -> int:
        """The number of its last row."""
        return max(self.rows)

    def place(self, role: str, k: int) -> Position:
        """The cell of a role in row k, which need not be shown."""
        index = self.rows.get(k)
        if index is None:
            first = min(self.rows)
            index = self.rows[first] - (first - k)
        return self.lines[role].place(index)

    def number(self, role: str, k: int) -> float | None:
        """The number of a role in row k; None if there is none."""
        if role not in self.lines or k not in self.rows:
            return None
        value = self.evaluator.values.get(self.place(role, k))
        return value if type(value) is float else None

    def area(self, role: str) -> str:
        """The cells of a role as a range."""
        ends = (self.place(role, k) for k in (min(self.rows), self.steps))
        return span(place[1:] for place in ends)

    @property
    def follows(self) -> bool:
        """Whether row k follows without a gap on row k - 1, in all rows."""
        return all(b - a == 1 for a, b in pairwise(self.rows.values()))


# ---- lines


def lines(evaluator: Evaluator) -> dict[tuple[str, bool], list[Line]]:
    """All lines of numbers, by sheet and direction."""
    numbers: dict[tuple[str, bool], dict[int, dict[int, float]]] = {}
    typed: dict[tuple[str, bool], Counter[int]] = {}
    texts: dict[tuple[str, bool], dict[int, set[int]]] = {}
    for place, value in evaluator.values.items():
        sheet, row, column = place
        for across, number, index in ((False, column, row), (True, row, column)):
            if type(value) is float:
                line = numbers.setdefault((sheet, across), {}).setdefault(number, {})
                line[index] = value
            elif isinstance(value, str) and value.strip() and place not in evaluator.formulas:
                typed.setdefault((sheet, across), Counter())[index] += 1
                texts.setdefault((sheet, across), {}).setdefault(number, set()).add(index)
    by_sheet: dict[tuple[str, bool], list[Line]] = {}
    for key, by_number in numbers.items():
        heads = {index for index, count in typed.get(key, Counter()).items() if count > 1}
        for number in sorted(by_number):
            own = heads & texts.get(key, {}).get(number, set())
            for values in _runs(by_number[number], own):
                by_sheet.setdefault(key, []).append(Line(evaluator, *key, number, values))
    return by_sheet


def _runs(values: dict[int, float], heads: set[int]) -> Iterator[dict[int, float]]:
    """Cut a line at its heads and at long gaps."""
    run: dict[int, float] = {}
    last = 0
    for index in sorted(values):
        broken = index - last > _GAP + 1 or any(last < head < index for head in heads)
        if run and broken:
            if len(run) >= LEAST:
                yield run
            run = {}
        run[index] = values[index]
        last = index
    if len(run) >= LEAST:
        yield run


# ---- relations between lines


def _pairs(line: Line) -> list[tuple[int, int]]:
    """The indices of neighbouring numbers of a line."""
    return list(pairwise(sorted(line.values)))


def _share(terms: Sequence[tuple[float, float, float]], close: float) -> tuple[float, float]:
    """The constant c for which a = c b in most of some (a, b, tolerance), and their share."""
    ratios = [a / b for a, b, _ in terms if b]
    if len(ratios) < LEAST - 1:
        return 0.0, 0.0
    c = median(ratios)
    good = tested = 0
    for a, b, tolerance in terms:
        if abs(a) > 4 * tolerance:
            tested += 1
            good += abs(a - c * b) <= tolerance + close * abs(a)
    return (c, good / tested) if tested >= LEAST - 1 else (c, 0.0)


def _sampled(pairs: Sequence[tuple[int, int]]) -> Sequence[tuple[int, int]]:
    step = max(1, len(pairs) // 9)
    return pairs[::step]


def grows_by(depth: Line, speed: Line, lag: int, close: float = _EXACT) -> tuple[float, float]:
    """The constant by which the depth grows with the velocity, and the share of such rows.

    `lag` 0 takes the velocity in the same row, 1 that in the row before.
    """
    pairs = _pairs(depth)

    def terms(of: Sequence[tuple[int, int]], exact: bool) -> list[tuple[float, float, float]]:
        result = []
        for before, now in of:
            v = speed.values.get(before if lag else now)
            if v is not None:
                x, last = depth.values[now], depth.values[before]
                tolerance = 0.0
                if exact:
                    tolerance = depth.rounding(x) + depth.rounding(last)
                    if v:
                        tolerance += abs(x - last) * speed.rounding(v) / abs(v)
                result.append((x - last, v, tolerance))
        return result

    sample = [a / b for a, b, _ in terms(_sampled(pairs), False) if b]
    if len(sample) < LEAST - 1:
        return 0.0, 0.0
    middle = median(sample)
    near = sum(abs(ratio - middle) <= 0.2 * abs(middle) for ratio in sample)
    if middle == 0 or near < len(sample) / 2:
        return 0.0, 0.0
    return _share(terms(pairs, True), close)


def repeats(start: Line, end: Line) -> float:
    """The share of rows whose velocity at the start repeats that at the end of the row before."""
    pairs = [(end.values[i], start.values[j]) for i, j in _pairs(start) if i in end.values]
    if len(pairs) < LEAST - 1:
        return 0.0
    distinct = len(set(start.values.values())) > 2
    same = sum(
        abs(a - b) <= 2e-14 * abs(a) + start.rounding(b) * (not start.computed) for a, b in pairs
    )
    return same / len(pairs) if distinct else 0.0


def _is_repeated(start: Line, end: Line) -> bool:
    """Whether one velocity repeats another; of formulas a third tell it, as none does by chance."""
    return repeats(start, end) > (0.3 if start.computed and end.computed else 0.5)


def _is_constant(line: Line) -> bool:
    values = list(line.values.values())
    return sum(value == values[0] for value in values) > 0.8 * len(values)


def _velocity_falls(speed: Line, ends: Line | None, role: str) -> list[tuple[int, float, float]]:
    """How much the velocity falls in each row: the row's index, the fall and its rounding."""
    falls = []
    pairs = _pairs(speed)
    if ends is not None:  # velocities at both ends of a row
        for index, v in speed.values.items():
            w = ends.values.get(index)
            if w is not None:
                falls.append((index, v - w, speed.rounding(v) + ends.rounding(w)))
    else:
        for before, now in pairs:
            v, w = speed.values[before], speed.values[now]
            index = before if role == "velocity_initial" else now
            falls.append((index, v - w, speed.rounding(v) + speed.rounding(w)))
    return falls


# ---- tables


def tables(evaluator: Evaluator, given: Mapping[str, Line]) -> list[SchemeTable]:
    """The tables of a workbook in the order of its sheets; `given` are lines that a user named."""
    chosen: list[SchemeTable] = []
    every = lines(evaluator)
    if given.keys() & {"depth", "velocity", "velocity_initial", "velocity_final"}:
        line = next(iter(given.values()))
        beside = [o for o in every.get((line.sheet, line.across), []) if o.number not in
                  {g.number for g in given.values()}]  # fmt: skip
        table = _given(evaluator, given, beside)
        return [table] if table else []
    longest = {key: max(len(o.values) for o in known) for key, known in every.items()}
    for known in every.values():
        chosen += _by_heads(evaluator, [o for o in known if not o.computed and len(o.values) < 8])
    for close in (_EXACT, _LOOSE):
        for _, known in sorted(every.items(), key=lambda item: -longest[item[0]]):
            taken = {place for table in chosen for place in table.places}
            free = [o for o in known if not any(o.place(i) in taken for i in o.values)]
            chosen += _on_sheet(evaluator, free[:_MOST_LINES], close)
        if chosen:
            break
    if not chosen:
        for known in every.values():
            chosen += _by_heads(evaluator, known)
    order = {name: number for number, name in enumerate(evaluator.book.sheets)}
    chosen = [t for t in chosen if not any(_shows(t, o) for o in chosen if o is not t)]
    return sorted(chosen, key=lambda t: (order[t.sheet], min(t.places)))


def _by_heads(evaluator: Evaluator, known: Sequence[Line]) -> list[SchemeTable]:
    """The table of lines whose heads name them, where values do not tell."""
    named = {role: o for o in reversed(known) for role in o.roles if len(o.roles) == 1}
    if not {"depth", "velocity_initial"} <= named.keys():
        return []
    depth, speed = named["depth"], named["velocity_initial"]
    if not (depth.grows or _reads(depth, speed)):
        return []
    table = _given(evaluator, {r: o for r, o in named.items() if r != "other"}, [])
    return [table] if table else []


def _shows(table: SchemeTable, source: SchemeTable) -> bool:
    """Whether a table only shows another one, cell by cell."""
    line = table.lines["depth"]
    if not line.computed:
        return False
    if _reads(line, line) or any(_reads(line, o) for o in table.lines.values() if o is not line):
        return False
    some = sorted(i for i in line.values if line.place(i) in table.evaluator.formulas)[:20]
    reads = sum(any(cell in source.places for cell in behind(line, i)) for i in some)
    return reads > len(some) / 2


def _on_sheet(evaluator: Evaluator, known: Sequence[Line], close: float) -> list[SchemeTable]:
    """The tables among some lines of a sheet, the best pairs of depth and velocity first."""
    pairs = list(_pairs_of(known, close))
    if any(not pair.depth.computed for pair in pairs):
        pairs = [pair._replace(score=pair.score + _support(pair, known)) for pair in pairs]
    chosen: list[SchemeTable] = []
    used: set[Position] = set()

    def is_free(line: Line) -> bool:
        return used.isdisjoint(map(line.place, line.values))

    for _, depth, speed, lag, c in sorted(pairs, key=lambda pair: -pair.score):
        if not (is_free(depth) and is_free(speed)):
            continue
        table = _made(evaluator, depth, speed, lag, c, [o for o in known if is_free(o)])
        if table is None or any(_is_beside(table, o) for o in chosen):
            continue
        if depth.computed or len(table.lines) > 2 or not chosen:
            chosen.append(table)
            used.update(table.places)
    return chosen


class _Pair(NamedTuple):
    """A depth that grows by a velocity times `c`, of the same row (`lag` 0) or the one before."""

    score: float
    depth: Line
    speed: Line
    lag: int
    c: float


def _pairs_of(known: Sequence[Line], close: float) -> Iterator[_Pair]:
    """The pairs of lines that may be depth and velocity."""
    depths = [
        o for o in known
        if (o.grows and (o.computed or not o.negative)) or (o.computed and _reads(o, o))
    ]  # fmt: skip
    speeds = [o for o in known if (o.positive or o.computed) and not _is_constant(o)]
    if close == _LOOSE:
        depths, speeds = ([o for o in some if o.computed] for some in (depths, speeds))
    for depth in depths:
        for speed in speeds:
            if speed is depth or len(speed.values.keys() & depth.values.keys()) < LEAST - 1:
                continue
            for lag in (0, 1):
                c, share = grows_by(depth, speed, lag, close)
                if share > 0.5 and c > 0 and _may_be_pair(depth, speed):
                    yield _Pair(_pair_score(depth, speed, lag, share), depth, speed, lag, c)


def _support(pair: _Pair, known: Sequence[Line]) -> float:
    """How well other numbers support a velocity: one repeats it, or it falls by one times c.

    Of two depths, one of which is the other over the radius, c is the step for one of them only.
    """
    speed = pair.speed
    others = [line for line in known if line is not speed]
    repeated = any(repeats(speed, line) > 0.5 or repeats(line, speed) > 0.5 for line in others)
    falls: list[tuple[str, Line | None]] = [("velocity_initial", None), ("velocity_final", None)]
    falls += [("velocity_initial", line) for line in others if repeats(speed, line) > 0.5]
    falls += [("velocity_initial", speed) for line in others if repeats(line, speed) > 0.5]
    for role, end in falls:
        falls_by = _velocity_falls(speed, end, role)
        if _brake_line(falls_by, others, pair.c, pair.depth, speed, strict=True) is not None:
            return 1.0 + repeated
    return float(repeated)


def _may_be_pair(depth: Line, speed: Line) -> bool:
    """Whether a pair of computed lines may be depth and velocity by what they read.

    The depth is computed from the velocity, or both only show a table that stands elsewhere.
    """
    if not (depth.computed and speed.computed):
        return speed.falls
    return _reads(depth, speed) or not _reads(depth, depth)


def _is_beside(table: SchemeTable, main: SchemeTable) -> bool:
    """Whether a table consists of lines that only show those of another one beside it."""
    depth = table.lines["depth"]
    if not depth.computed or _reads(depth, depth):
        return False
    return any(_reads(depth, line) for line in main.lines.values()) and not any(
        _reads(line, depth) for line in main.lines.values()
    )


def _reads(line: Line, source: Line) -> bool:
    """Whether the usual formula of a line reads another line, directly or by its helpers."""
    if line.usual is None:
        return False
    own, wanted = line.place(_typical(line)), set(map(source.place, source.values))
    return any(cell in wanted and cell != own for cell in behind(line, _typical(line), source))


def behind(line: Line, index: int, *stop: Line) -> set[Position]:
    """The cells of single references that a cell of a line rests on, by way of its own row.

    What stands behind cells of the lines of `stop` is not followed.
    """
    evaluator, own = line.evaluator, line.place(index)
    read, waiting = set[Position](), [own]
    while waiting and len(read) < 200:
        for area in evaluator.areas(waiting.pop()):
            cell = (area.sheet, area.top, area.left)
            if area.cells > 1 or cell in read:
                continue
            read.add(cell)
            along = cell[2] if line.across else cell[1]
            number = cell[1] if line.across else cell[2]
            if cell[0] == line.sheet and along == index and all(o.number != number for o in stop):
                waiting.append(cell)
    return read


def _typical(line: Line) -> int:
    """An index in the middle of a line, where it has its usual formula."""
    formulas = line.evaluator.formulas
    indices = [i for i in sorted(line.values) if formulas.get(line.place(i)) is line.usual]
    return indices[len(indices) // 2] if indices else min(line.values)


def _pair_score(depth: Line, speed: Line, lag: int, share: float) -> float:
    """How well a pair fits: by its rows, by what reads what, and by its heads."""
    score = round(share, 1) + min(len(depth.values), 1000) / 1e4 - 0.1 * lag
    score += 2 * depth.grows + 2 * speed.positive
    if depth.computed and speed.computed:
        score += 2 * (_reads(depth, depth) and not _by_view(depth)) + 2 * _reads(depth, speed)
    score += 0.5 * ("depth" in depth.roles) + 0.3 * any("veloc" in r for r in speed.roles)
    score -= 0.5 * (bool(depth.roles) and "depth" not in depth.roles)
    return score - 0.5 * (bool(speed.roles) and not any("veloc" in r for r in speed.roles))


def _by_view(line: Line) -> bool:
    """Whether a line only shows another one in its own rows."""
    shape = line.usual
    return shape is not None and len(shape.references) == 1 and not _reads(line, line)


def _made(
    evaluator: Evaluator, depth: Line, speed: Line, lag: int, c: float, known: Sequence[Line]
) -> SchemeTable | None:
    """The table of a depth and a velocity, with the lines that belong to it."""
    others = [o for o in known if o not in (depth, speed)]
    roles: dict[str, Line] = {"depth": depth}
    ends = [o for o in others if _is_repeated(speed, o)]
    starts = [o for o in others if _is_repeated(o, speed)]
    ends.sort(key=lambda o: (not _reads(speed, o), "velocity_final" not in o.roles))
    starts.sort(key=lambda o: (not _reads(o, speed), "velocity_initial" not in o.roles))
    if ends and (lag == 0 or not starts):
        roles |= {"velocity_initial": speed, "velocity_final": ends[0]}
    elif starts:
        roles |= {"velocity_initial": starts[0], "velocity_final": speed}
    else:
        single = "velocity_final" if lag else "velocity_initial"
        roles[_single(single, depth, speed)] = speed
    return _completed(evaluator, roles, known, c)


def _single(role: str, depth: Line, speed: Line) -> str:
    """The end of the rows to which their only velocity belongs.

    If the force of a row is taken at the velocity in the same row, that is the one at its start,
    even where the depths move on by the velocity of the row before.
    """
    if role == "velocity_final" and not _is_ahead(speed, depth):
        return "velocity_initial"
    return role


def _is_ahead(speed: Line, depth: Line) -> bool:
    """Whether the velocity of a row is computed from the depth of the same row."""
    if not speed.computed:
        return True
    index = _typical(speed)
    return depth.place(index) in behind(speed, index, depth)


def _completed(
    evaluator: Evaluator, roles: dict[str, Line], known: Sequence[Line], c: float
) -> SchemeTable | None:
    """The table with its deceleration, time and helpers, and its rows numbered."""
    depth = roles["depth"]
    start = roles.get("velocity_initial")
    speed = start or roles["velocity_final"]
    role = "velocity_initial" if start else "velocity_final"
    both = roles.get("velocity_final") if start else None
    taken = set(roles.values())
    others = [
        o for o in known
        if o not in taken and len(o.values.keys() & depth.values.keys()) >= len(depth.values) / 2
    ]  # fmt: skip
    if "deceleration" not in roles and (
        brake := _brake_line(_velocity_falls(speed, both, role), others, c, depth, both or speed)
    ):
        roles["deceleration"] = brake
    if "time" not in roles and (time := _time_line(others, c, depth.number, set(roles.values()))):
        roles["time"] = time
    shown = sorted(set(depth.values) | set(speed.values))
    first, last = min(depth.values), max(depth.values)
    indices = _own_rows([i for i in shown if first <= i <= last], depth, speed)
    if len(indices) < LEAST:
        return None
    roles = {name: _within(line, indices) for name, line in roles.items()}
    if both is not None:
        roles[role] = _repeating(roles[role], roles["velocity_final"])
    depth, speed = roles["depth"], roles[role]
    zero, whole = _first_row(depth, speed, role, indices, c)
    rows = dict(enumerate(indices, zero))
    if max(rows) < 1:
        return None
    numbers = {line.number for line in roles.values()}
    helpers = tuple(_within(o, indices) for o in others if o.number not in numbers)
    return SchemeTable(evaluator, depth.sheet, depth.across, roles, helpers, rows, whole)


def _repeating(start: Line, end: Line) -> Line:
    """The velocities at the start of rows, with the formula meant that repeats those at the end.

    Where two formulas share the column, it need not be the more frequent one.
    """
    formulas, counter = start.evaluator.formulas, Counter[Shape]()
    for before, now in _pairs(start):
        shape = formulas.get(start.place(now))
        if shape is not None and end.values.get(before) == start.values[now]:
            counter[shape] += 1
    if not counter:
        return start
    shape, count = counter.most_common(1)[0]
    is_usual = count > 2 and 3 * count >= len(start.values) - 2
    return replace(start, meant=shape) if is_usual else start


def _within(line: Line, indices: Sequence[int]) -> Line:
    """The part of a line that belongs to some rows."""
    return replace(
        line, values={i: v for i, v in line.values.items() if indices[0] <= i <= indices[-1]}
    )


def _own_rows(indices: list[int], depth: Line, speed: Line) -> list[int]:
    """The rows of a table, without numbers that stand above or below it.

    The last row has a usual formula. Before the first usual formula of the depths at most two rows
    belong to the table, the impact and the first step. Without formulas, long gaps end it.
    """
    formulas = depth.evaluator.formulas

    def usual(line: Line, i: int) -> bool:
        return line.usual is not None and formulas.get(line.place(i)) is line.usual

    if depth.usual is not None and depth.computed:
        first = next(n for n, i in enumerate(indices) if usual(depth, i))
        last = max(n for n, i in enumerate(indices) if usual(depth, i) or usual(speed, i))
        start = first
        while start and first - start < 2 and indices[start] - indices[start - 1] <= 2:
            start -= 1
        return indices[start : last + 1]
    blocks: list[list[int]] = [[]]
    for i in indices:
        if blocks[-1] and i - blocks[-1][-1] > 2:
            blocks.append([])
        blocks[-1].append(i)
    return max(blocks, key=len)


def _first_row(
    depth: Line, speed: Line, role: str, indices: Sequence[int], c: float
) -> tuple[int, bool]:
    """The number of the first row shown, and whether the table begins at the impact."""
    x = depth.values.get(indices[0])
    v = speed.values.get(indices[0], speed.values.get(indices[1], 0.0))
    step = abs(c * v)
    if x is None or not step:
        return 0, True
    if abs(x) < 0.25 * step or _is_half_step_next(depth, speed, indices, c):
        return 0, True
    if abs(x) < 1.6 * step and role == "velocity_initial":
        return 1, True
    if abs(x) < 1.6 * step:
        return 1, True
    return 0, False


def _is_half_step_next(depth: Line, speed: Line, indices: Sequence[int], c: float) -> bool:
    """Whether the second row of a table of numbers has moved by half a step from the surface.

    It is then the first step, and the row before it the impact, whatever that one holds.
    """
    x, v = depth.values.get(indices[1]), speed.values.get(indices[1])
    if x is None or not v or depth.computed:
        return False
    return abs(x - c * v / 2) <= _ABOUT * abs(c * v) + depth.rounding(x)


def _brake_line(
    falls: Sequence[tuple[int, float, float]], others: Sequence[Line], c: float, depth: Line,
    speed: Line, strict: bool = False,
) -> Line | None:  # fmt: skip
    """The line of decelerations: the velocity falls by it times the constant of the depth.

    Forces and changes of velocity fall with it, too, but by other constants; `strict` takes no
    line with another constant than a power of ten times `c`.
    """
    ranked, of_depth = [], _error_of_growth(depth)
    for line in others:
        if _is_constant(line):
            continue
        terms = [
            (fall, line.values[i], rounding + abs(fall) * line.rounding(line.values[i])
             / abs(line.values[i]))
            for i, fall, rounding in falls
            if line.values.get(i)
        ]  # fmt: skip
        close = _EXACT
        e, share = _share(terms, close)
        if share <= 0.5 or not e:
            close = 1e-3
            e, share = _share(terms, close) if not line.computed else (e, 0.0)
        if share <= 0.5:
            continue
        error = of_depth + median(tolerance / abs(fall) for fall, _, tolerance in terms if fall)
        power = math.log10(abs(e) / c)
        off = abs(power - round(power))
        near = min(_ABOUT, math.log10(1 + 2 * error + close))
        fits = power_of_ten(abs(e) / c) is not None or (not line.computed and off < near)
        named = "deceleration" in line.roles
        other_role = bool(line.roles) and not named
        reads = _reads(speed, line)
        rank = (not fits, not named, other_role, round(off, 3), not reads, line.number)
        ranked.append((*rank, line))
    ranked.sort(key=lambda entry: entry[:-1])
    if strict:
        return ranked[0][-1] if ranked and not ranked[0][0] else None
    if not ranked or (ranked[0][0] and ranked[0][1]):
        likely = [entry for entry in ranked if not entry[2] and not entry[4]]
        best = likely[0][-1] if likely and ranked[0][0] else None
        return None if best is None or _is_product(best) else best
    return ranked[0][-1]


def _error_of_growth(depth: Line) -> float:
    """The usual relative error of what a depth grows by in a row, by the digits of its numbers."""
    errors = []
    for before, now in _pairs(depth):
        x, last = depth.values[now], depth.values[before]
        if x != last:
            errors.append((depth.rounding(x) + depth.rounding(last)) / abs(x - last))
    return median(errors) if errors else 0.0


def _is_product(line: Line) -> bool:
    """Whether a line is one other line times something: a change of velocity, say."""
    shape = line.usual
    return shape is not None and len(shape.references) <= 2 and len(shape.key) < 40


def _time_line(others: Sequence[Line], c: float, near: int, taken: set[Line]) -> Line | None:
    """The line of times: it grows by the same constant, up to its unit."""
    ranked = []
    for line in others:
        if line in taken:
            continue
        steps = [line.values[j] - line.values[i] for i, j in _pairs(line)]
        step = median(steps)
        close = 1e-9 * abs(step) + 3 * max(map(line.rounding, line.values.values()))
        even = sum(abs(s - step) <= close for s in steps) > 0.5 * len(steps)
        if not even or step <= 0:
            continue
        fits = abs(math.log10(step / c) - round(math.log10(step / c))) < 1e-6
        named = "time" in line.roles
        whole = all(value == int(value) for value in line.values.values())
        if whole and step == 1 and not fits and line.unit is None:
            continue  # it counts the rows, whatever its head
        if named or (fits and not whole):
            ranked.append((not named, not fits, abs(line.number - near), line))
    ranked.sort(key=lambda entry: entry[:-1])
    return ranked[0][-1] if ranked else None


def _best(depths: Iterable[tuple[Line, float]]) -> Line | None:
    """The line with the largest share of rows that fit, if more than half of them do."""
    ranked = [(share, line) for line, share in depths if share > 0.5]
    return max(ranked, key=lambda entry: entry[0])[1] if ranked else None


def _given(
    evaluator: Evaluator, given: Mapping[str, Line], beside: Sequence[Line]
) -> SchemeTable | None:
    """The table of lines that the user named; the others are found as usual."""
    roles = {("velocity_initial" if r == "velocity" else r): o for r, o in given.items()}
    if "depth" not in roles:
        depth = _best(
            (o, max(grows_by(o, r, lag)[1] for lag in (0, 1)))
            for o in beside if o.grows for r in roles.values()
        )  # fmt: skip
        if depth is None:
            return None
        roles["depth"] = depth
    if not roles.keys() & {"velocity_initial", "velocity_final"}:
        speed = _best((o, grows_by(roles["depth"], o, 0)[1]) for o in beside)
        if speed is None:
            return None
        roles["velocity_initial"] = speed
    if "velocity_final" not in roles:
        roles |= _other_velocity(roles, "velocity" in given, beside)
        if roles["velocity_initial"] is roles.get("velocity_final"):
            del roles["velocity_initial"]
    c = _step_of(roles)
    return _completed(evaluator, roles, list(beside), c) if c else None


def _other_velocity(
    roles: Mapping[str, Line], is_either: bool, beside: Sequence[Line]
) -> dict[str, Line]:
    """The velocities of both ends of the rows, where the user named one; `is_either`: of any end.

    If there is only one line for both, it is at the end.
    """
    speed, depth = roles["velocity_initial"], roles["depth"]
    starts = [o for o in beside if repeats(o, speed) > 0.5]
    if is_either and starts:
        return {"velocity_initial": starts[0], "velocity_final": speed}
    ends = [o for o in beside if repeats(speed, o) > 0.5]
    lag = grows_by(depth, speed, 1)[1] > grows_by(depth, speed, 0)[1]
    if is_either and lag and _is_ahead(speed, depth):
        return {"velocity_final": speed}
    return {"velocity_final": ends[0]} if ends else {}


def _step_of(roles: Mapping[str, Line]) -> float:
    """The constant by which the depth grows with the velocity; 0 if none can be told."""
    depth = roles["depth"]
    speed = roles.get("velocity_initial") or roles["velocity_final"]
    c, _ = grows_by(depth, speed, int("velocity_initial" not in roles), _LOOSE)
    if c:
        return c
    steps = [
        (depth.values[j] - depth.values[i]) / speed.values[j]
        for i, j in _pairs(depth)
        if speed.values.get(j)
    ]
    return abs(median(steps)) if steps else 0.0


def with_only_velocity_at_start(table: SchemeTable) -> SchemeTable | None:
    """The table with its only velocity taken for that at the start of the rows.

    Textbooks put depth, velocity and deceleration of one moment into one row. None if the table
    shows the velocities at both ends of its rows, or at their start.
    """
    if "velocity_initial" in table.lines:
        return None
    return _with_only_velocity(table, "velocity_final", "velocity_initial")


def with_only_velocity_at_end(table: SchemeTable) -> SchemeTable | None:
    """The table with its only velocity taken for that at the end of the rows; None as above."""
    if "velocity_final" in table.lines:
        return None
    return _with_only_velocity(table, "velocity_initial", "velocity_final")


def _with_only_velocity(table: SchemeTable, shown: str, taken_for: str) -> SchemeTable | None:
    """The table with the velocity of one end of the rows taken for that of the other one."""
    roles = {"depth": table.lines["depth"], taken_for: table.lines[shown]}
    taken = set(roles.values())
    beside = [o for o in (*table.lines.values(), *table.helpers) if o not in taken]
    c = _step_of({name: table.lines[name] for name in ("depth", shown)})
    return _completed(table.evaluator, roles, beside, c) if c else None


def moving_pair(evaluator: Evaluator) -> tuple[Line, Line] | None:
    """A depth and a velocity that belong to one motion, however it was computed; None if none.

    In steps of a constant time the depth grows by about the mean of two velocities times the step.
    """
    for known in lines(evaluator).values():
        for depth in known[:_MOST_LINES]:
            for speed in known[:_MOST_LINES]:
                if not (depth.grows and speed.falls and speed.positive) or _is_constant(speed):
                    continue
                terms = [
                    (depth.values[now] - depth.values[before],
                     (speed.values[now] + speed.values[before]) / 2, 0.0)
                    for before, now in _pairs(depth)
                    if before in speed.values and now in speed.values
                ]  # fmt: skip
                c, share = _share(terms, _LOOSE)
                if c > 0 and share > 0.5:
                    return depth, speed
    return None

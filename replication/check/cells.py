"""Cells that differ from their column: in value, in response to the state, or to an input.

Every cell that does not have the usual formula of its column is compared with that formula in its
own row. So a wrong cell is found where it stands, and the rows that follow from it are not accused.
"""

import math
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from replication.check.examination import Departure, Examination
from replication.check.fit import Probe
from replication.check.roles import Inputs
from replication.check.six import EXACT, VARIANTS, start_of_row
from replication.check.table import LEAST, Line, SchemeTable, behind, runs
from replication.check.times import judge_times
from replication.check.words import COLUMNS, title
from replication.user_input import quoted
from spreadsheets.evaluate import Evaluator, Shape, formula_text
from spreadsheets.foreign import Position
from spreadsheets.scalars import Error, LiteralKey, Scalar

RIGHT_HERE = "; it gives the right value here"
"""The end of a sentence about a formula or a number that is right as long as nothing changes."""
BLANK_ROW = "the row is blank"
"""How the explanation of rows that were cleared begins."""
_MOST_PROBED = 40
"""So many odd cells of a column are probed; of others only the value is compared."""


def formula_at(exam: Examination, place: Position) -> str:
    """The formula of a cell, cut if it is long; for a typed one, "the number"."""
    shape = exam.table.evaluator.formulas.get(place)
    return formula_text(shape.key, place[1], place[2])[:200] if shape else "the number"


def feeding(table: SchemeTable) -> list[Line]:
    """The lines beside the table that its columns read, in order of calculation."""
    read: set[Line] = set()
    feeders: list[Line] = []
    for role, line in table.lines.items():
        if role == "time" or line.usual is None:
            continue
        indices = [
            i
            for i in sorted(line.values)
            if line.evaluator.formulas.get(line.place(i)) is line.usual
        ]
        if not indices:
            continue
        cells = behind(line, indices[len(indices) // 2])
        for helper in table.helpers:
            if helper not in read and any(helper.place(i) in cells for i in helper.values):
                read.add(helper)
                feeders.append(helper)
    order = table.evaluator.order
    return sorted(
        feeders, key=lambda o: max((order.get(o.place(i), -1) for i in o.values), default=-1)
    )


Mended = Mapping[tuple[str, int], float]
"""What wrong cells should hold, by their roles and rows."""


def _force(exam: Examination, x: float, v: float) -> float:
    """The deceleration at a depth and a velocity as it was fitted, positive."""
    six, bounded = exam.fitted.six, exam.fitted.bounded
    a = six.deceleration(x, v, bounded)
    half = a * abs(six.e) / 2
    return six.deceleration(x, v - half, bounded) if exam.fitted.centered else a


def predicted(exam: Examination, role: str, k: int, mended: Mended | None = None) -> float | None:
    """What a cell should hold by the six numbers, given the other cells; None if one is missing.

    `mended` takes the place of what these cells hold.
    """
    mended = mended or {}
    table = exam.table
    result: float | None
    if role == "time":
        result = _next_time(exam, k, mended)
    elif role == "depth":
        result = _next_depth(exam, k, mended)
    elif role == "deceleration":
        result = _next_brake(exam, k, mended)
    elif role == "velocity_initial" and "velocity_final" in table.lines:
        result = _number_meant(exam, mended, "velocity_final", k - 1)
    else:
        result = _next_velocity(exam, k if role == "velocity_final" else k - 1, mended)
    return result if result is not None and math.isfinite(result) else None


def _number_meant(exam: Examination, mended: Mended, role: str, k: int) -> float | None:
    """The number of a cell, or what it should be."""
    right = mended.get((role, k))
    return exam.table.number(role, k) if right is None else right


def _next_time(exam: Examination, k: int, mended: Mended) -> float | None:
    """The time in row k by that of the row before."""
    before, step = _number_meant(exam, mended, "time", k - 1), exam.fitted.time
    return None if before is None or step is None else before + step


def _start_velocity(exam: Examination, k: int, mended: Mended) -> float | None:
    """The velocity at the start of row k."""
    role, lag = start_of_row(exam.table)
    return _number_meant(exam, mended, role, k + lag)


def _next_depth(exam: Examination, k: int, mended: Mended) -> float | None:
    """The depth in row k by that of the row before and the velocity; half a step in the first."""
    is_euler = exam.fitted.ways.get("depth") is VARIANTS["explicit Euler"]
    before, v = (
        _number_meant(exam, mended, "depth", k - 1),
        _start_velocity(exam, k - is_euler, mended),
    )
    if v is None or (before is None and k != 1):
        return None
    c = exam.fitted.six.c
    return c * v / 2 if k == 1 or before is None else before + c * v


def _next_brake(exam: Examination, k: int, mended: Mended) -> float | None:
    """The deceleration in row k by its depth and velocity, with the sign of its column."""
    x, u = _number_meant(exam, mended, "depth", k), _start_velocity(exam, k, mended)
    if x is None or u is None:
        return None
    return exam.fitted.sign * _force(exam, x, u)


def _next_velocity(exam: Examination, k: int, mended: Mended) -> float | None:
    """The velocity at the end of row k by that at its start and its deceleration."""
    v, a = _start_velocity(exam, k, mended), _number_meant(exam, mended, "deceleration", k)
    if a is None and "deceleration" not in exam.table.lines:
        a = _next_brake(exam, k, mended)
    return None if v is None or a is None else v - exam.fitted.six.e * exam.fitted.sign * a


def _following(exam: Examination) -> frozenset[Position]:
    """The cells of a table without formulas that are right by what wrong cells should hold.

    A program goes on with the number that it had, not with the one that somebody typed over it.
    """
    table, mended, following = exam.table, dict[tuple[str, int], float](), set[Position]()
    roles = [role for role in COLUMNS if role in table.lines]
    for k in sorted(table.rows):
        for role in roles if k > 1 else ():
            value, line = table.number(role, k), table.lines[role]
            if value is None or _same(value, predicted(exam, role, k), line, exam):
                continue
            right = predicted(exam, role, k, mended)
            if right is not None and _same(value, right, line, exam):
                following.add(table.place(role, k))
            elif right is not None:
                mended[role, k] = right
    return frozenset(following)


def odd_cells(exam: Examination, inputs: Inputs) -> None:
    """Report the cells of a table that differ from their column, also in lines that it reads."""
    table = exam.table
    exam.following = frozenset() if exam.fitted.probe is not None else _following(exam)
    for role, line in table.lines.items():
        if _is_pasted(exam, role, line):
            cells = [p for p in exam.cells(role, 1) if p not in table.evaluator.formulas]
            text = f"the whole column of {title(role)} is typed as numbers"
            exam.add("typed number", cells, None, text)
        elif not (_is_of_numbers(exam, role, line) and judge_times(exam)):
            _judge_line(exam, inputs, line, role)
    helpers = [line for line in feeding(table) if line.usual is not None]
    for helper in helpers:
        _judge_line(exam, inputs, helper, None)
    _blank_rows(exam)
    _broken_off(exam, [*table.lines.values(), *helpers])
    _broken_times(exam)


def _is_of_numbers(exam: Examination, role: str, line: Line) -> bool:
    """Whether a column has the times of a table without formulas."""
    return role == "time" and exam.fitted.probe is None and not line.computed


def _is_pasted(exam: Examination, role: str, line: Line) -> bool:
    """Whether a whole column is typed where others are computed."""
    if role == "time" or line.computed or len(line.values) <= LEAST - 1:
        return False
    others = (o for r, o in exam.table.lines.items() if r not in (role, "time"))
    matters = exam.fitted.probe is not None or role in ("deceleration", "velocity_initial")
    return matters and any(o.computed for o in others)


def _is_blank(evaluator: Evaluator, place: Position) -> bool:
    return place not in evaluator.formulas and evaluator.values.get(place) is None


_FAR = 100
"""So many blank rows are looked at below a table whose formulas may go on."""


def _blank_rows(exam: Examination) -> None:
    """Report rows that were cleared: formulas of the same columns follow and read the blank cells.

    Rows that are left out of a table of numbers, and two tables below each other, are none: no
    formula reads the cells between them.
    """
    table = exam.table
    evaluator = table.evaluator
    usual = [line for line in table.lines.values() if line.usual is not None]
    shown = set(table.rows.values())
    last = max(shown)
    for k, index in sorted(table.rows.items()):
        after = index + 1
        while after <= (last if index < last else last + _FAR) and all(
            _is_blank(evaluator, line.place(after)) for line in usual
        ):
            after += 1
        gap = {line.place(i) for line in usual for i in range(index + 1, after)}
        goes_on = [o for o in usual if evaluator.formulas.get(o.place(after)) is o.usual]
        moving = [o for o in goes_on if evaluator.values.get(o.place(after)) not in ("", "#N/A")]
        reads = [o for o in moving if _reads_one(evaluator, o.place(after), gap)]
        if reads and len(goes_on) == len(usual):  # not a last velocity by itself
            cells = sorted(line.place(i) for i in range(index + 1, after) for line in usual)
            text = f"{BLANK_ROW}, though the formulas below it read it"
            rank = (1, k + 0.5, 0)
            exam.differences.append(Departure("odd formula", tuple(cells), None, None, text, rank))


def _reads_one(evaluator: Evaluator, place: Position, cells: Collection[Position]) -> bool:
    """Whether a formula reads one of some cells, by itself and not as a part of a range."""
    return any(area.cells == 1 and area.corner in cells for area in evaluator.areas(place))


def _broken_off(exam: Examination, lines: Sequence[Line]) -> None:
    """Report what ends a table before its formulas do: a blank cell, a text, or an error."""
    evaluator, index = exam.table.evaluator, max(exam.table.rows.values()) + 1
    usual = [o for o in lines if o.usual and evaluator.formulas.get(o.place(index)) is o.usual]
    values = [evaluator.values.get(line.place(index)) for line in usual]
    if any(isinstance(value, Error) and value != "#N/A" for value in values):
        cells = [line.place(index) for line in lines if line not in usual]
        cells = [p for p in cells if type(evaluator.values.get(p)) is not float]
        if spoilt := [p for p in cells if not _is_blank(evaluator, p)]:
            _breaks_off(exam, spoilt[0])
        return
    for line in lines:
        place = line.place(index)
        if _is_blank(evaluator, place) and any(
            _reads_one(evaluator, o.place(index), [place]) for o in usual
        ):
            _breaks_off(exam, place)
            return


def _breaks_off(exam: Examination, place: Position, after: str = "the table breaks off") -> None:
    """Report the cell at which a column stops to give numbers."""
    evaluator = exam.table.evaluator
    if place in evaluator.formulas:
        text = f"{formula_at(exam, place)} gives no number: {after}"
        exam.add("odd formula", [place], None, text)
    elif _is_blank(evaluator, place):
        text = f"the cell is blank, though formulas of its row read it: {after}"
        exam.add("odd formula", [place], None, text)
    else:
        value = evaluator.values.get(place)
        text = f"{typed_what(value)} is typed here: {after}"
        exam.add("typed number", [place], None, text, as_typed(value))


def _broken_times(exam: Examination) -> None:
    """Report a cell after which the times are errors.

    Times grow by a constant: each formula reads the cell before it and nothing else of the rows.
    """
    table = exam.table
    if "time" in table.lines:
        return
    evaluator = table.evaluator
    last = max(table.rows.values())
    known = {line.number for line in table.lines.values()}
    line = table.lines["depth"]
    columns = {p[1] if table.across else p[2] for p in evaluator.formulas if p[0] == table.sheet}
    for number in sorted(columns - known):
        column = replace(line, number=number)
        shape = evaluator.formulas.get(column.place(last))
        if shape is None or not isinstance(evaluator.values.get(column.place(last)), Error):
            continue
        index = last
        while evaluator.formulas.get(column.place(index)) is shape and _adds(column, index):
            index -= 1
        if last - index < LEAST or not isinstance(
            evaluator.values.get(column.place(index + 1)), Error
        ):
            continue
        while isinstance(evaluator.values.get(column.place(index - 1)), Error):
            index -= 1
        before = column.place(index - 1)
        if type(evaluator.values.get(before)) is str and _reads_one(
            evaluator, column.place(index), [before]
        ):
            index -= 1
        value = evaluator.values.get(column.place(index))
        if type(value) is not float and not _is_blank(evaluator, column.place(index)):
            _breaks_off(exam, column.place(index), "the times from here on are errors")


def _adds(line: Line, index: int) -> bool:
    """Whether a formula reads the cell before it, and no other cell of its own row or that one."""
    evaluator, before = line.evaluator, line.place(index - 1)
    along = 2 if line.across else 1
    rows = [
        area.corner for area in evaluator.areas(line.place(index))
        if area.cells > 1
        or (area.sheet == line.sheet and area.corner[along] in (index, index - 1))
    ]  # fmt: skip
    return rows == [before]


def _rows_of(table: SchemeTable, line: Line, role: str | None) -> Iterator[tuple[int, Position]]:
    """The rows of a line that should have its usual formula, each with its cell."""
    for k in sorted(table.rows):
        if k <= 0 or (k == 1 and role in ("depth", "velocity_initial")):
            continue
        if k == min(table.rows) and not table.whole:
            continue
        yield k, line.place(table.rows[k])


def _judge_line(exam: Examination, inputs: Inputs, line: Line, role: str | None) -> None:
    """Report what is odd in a line; neighbours of one kind together."""
    table, evaluator, usual = exam.table, exam.table.evaluator, line.usual
    odd: dict[Position, tuple[object, ...]] = {}
    probed = 0
    is_wrong = _is_wrong(exam, line)
    first = min(line.values)
    for k, place in _rows_of(table, line, role):
        shape = evaluator.formulas.get(place)
        if usual is not None and shape is usual and evaluator.values.get(place) is not None:
            continue
        if place in exam.following:
            continue
        if role is None and line.place(first)[1:] > place[1:]:
            continue
        if shape is not None and is_wrong:
            continue  # which may be right
        is_last = k == table.steps and role in ("deceleration", "velocity_final")
        end = table.lines.get("velocity_final")
        if role == "deceleration" and end is not None and end.computed:
            is_last = False  # the velocity at the end of the row needs it
        if is_last and shape is None and place not in evaluator.values:
            continue
        probed += 1
        verdict = _verdict_on_cell(exam, inputs, line, role, k, place, probed <= _MOST_PROBED)
        if verdict is not None:
            odd[place] = verdict
    groups = runs({p: (v[0], v[1]) for p, v in odd.items()}, table.across)
    for group in groups:
        kind, text, expected, content = odd[group[0]]
        exam.add(str(kind), group, expected, str(text), content)  # type: ignore[arg-type]


def _is_wrong(exam: Examination, line: Line) -> bool:
    """Whether the usual formula of a line is accused already, wherever it stands."""
    formulas, usual = exam.table.evaluator.formulas, line.usual
    own = {line.place(i) for i in line.values}
    return usual is not None and any(
        len(d.cells) > LEAST and own.issuperset(d.cells) and formulas.get(d.place) is usual
        for d in exam.differences
        if d.kind in ("other scheme", "odd formula", "typed constant")
    )


Oddity = tuple[str, str, object, object]
"""What is wrong with a cell: its kind, a text, what is expected and what is there."""


@dataclass(frozen=True)
class _Cell:
    """A cell of row k that has not the usual formula of its line.

    `expected` is the number that it should hold, `instead` the usual formula as it would stand
    there; `applies` says whether that gives a number.
    """

    line: Line
    role: str | None
    k: int
    place: Position
    expected: float | None
    instead: str
    applies: bool

    @property
    def value(self) -> Scalar:
        """What the cell holds or gives."""
        return self.line.evaluator.values.get(self.place)

    @property
    def would(self) -> str:
        """The end of a sentence, with the formula that should stand there."""
        return f" where {self.instead[:200]} would stand" if self.instead else ""


def _odd_cell(exam: Examination, line: Line, role: str | None, k: int, place: Position) -> _Cell:
    """A cell with what it should hold: by its column's formula, or by the six numbers."""
    rows, usual = exam.table.rows, line.usual
    expected = predicted(exam, role, k) if role else None
    straight = rows[k] - rows.get(k - 1, rows[k] - 1) == 1
    if usual is None or not straight:
        return _Cell(line, role, k, place, expected, "", False)
    shown = exam.table.evaluator.value(place, {}, shape=usual)
    applies = type(shown) is float
    if type(shown) is float:
        close = expected is None or math.isclose(
            shown, expected, rel_tol=1e-6, abs_tol=_least_size(line)
        )
        expected = shown if close or role is None else expected
    instead = formula_text(usual.key, place[1], place[2])
    return _Cell(line, role, k, place, expected, instead, applies)


def _verdict_on_cell(
    exam: Examination, inputs: Inputs, line: Line, role: str | None, k: int, place: Position,
    probe: bool,
) -> Oddity | None:  # fmt: skip
    """What is wrong with a cell that has not its column's formula; None if nothing."""
    odd = _odd_cell(exam, line, role, k, place)
    shape = exam.table.evaluator.formulas.get(place)
    if shape is None:
        return _verdict_on_typed(exam, odd)
    if type(odd.value) is not float:
        return _without_number(odd)
    if odd.expected is None:
        return None
    same = _same(odd.value, odd.expected, line, exam)
    usual = line.usual
    if usual is not None and odd.applies and probe and exam.fitted.probe is not None:
        return _unlike(odd, own(shape, place), same, _alike(exam, inputs, place, shape, usual, k))
    return None if same else _other_number(odd, own(shape, place))


def own(shape: Shape, place: Position) -> str:
    """The formula of a cell, cut if it is long."""
    return formula_text(shape.key, place[1], place[2])[:200]


def _other_number(odd: _Cell, formula: str) -> Oddity:
    text = f"{formula} does not give what the rest of the table does"
    return "odd formula", text, odd.expected, odd.value


def _unlike(odd: _Cell, formula: str, same: bool, alike: tuple[bool, bool, bool]) -> Oddity | None:
    """The verdict on a formula that responds to the row, or to the inputs, as its column or not.

    A number in the formula of the others, where this one reads a cell, is theirs.
    """
    state, given, reads_more = alike
    if same and state and not given and not reads_more:
        text = f"{formula} has a number where its column reads a cell: {odd.instead[:200]}"
        return "typed constant", f"{text}{RIGHT_HERE}", None, None
    if not same and _repeats(formula, odd.instead):
        text = f"{formula} has a number where its column reads a cell: {odd.instead[:200]}"
        return "typed constant", text, odd.expected, odd.value
    if odd.role == "time":  # which people count up in several ways
        return None if same else _other_number(odd, formula)
    if same and state:
        return None
    return "odd formula", f"{formula} is unlike its column{odd.would}", odd.expected, odd.value


def _repeats(formula: str, instead: str) -> bool:
    """Whether a formula is another one but for a number in place of a fixed cell.

    >>> _repeats("=D19+C20*2E-10", "=D19+C20*$E$2"), _repeats("=D19+C20", "=D19+C20*$E$2")
    (True, False)
    """
    fixed = list(re.finditer(r"\$[A-Z]+\$\d+", instead))
    number = r"\d+\.?\d*(?:E[-+]?\d+)?"
    return any(
        re.fullmatch(
            re.escape(instead[: m.start()]) + number + re.escape(instead[m.end() :]), formula
        )
        for m in fixed
    )


def typed_what(value: object) -> str:
    """What is typed into a cell, for a sentence.

    >>> typed_what(1.0), typed_what("abc"), typed_what(True)
    ('a number', 'a text', 'a logical value')
    """
    if isinstance(value, bool):
        return "a logical value"
    return "a number" if isinstance(value, float) else "a text"


def as_typed(value: Scalar) -> Scalar:
    """What is typed into a cell as a difference shows it: a text in quotation marks."""
    return quoted(value) if isinstance(value, str) else value


def _verdict_on_typed(exam: Examination, odd: _Cell) -> Oddity | None:
    """The verdict on a cell without a formula."""
    value, line = odd.value, odd.line
    if value is None:
        text = f"the cell is blank{odd.would}"
        return None if odd.expected is None else ("odd formula", text, odd.expected, None)
    if type(value) is not float:
        if (line.computed and line.usual is not None) or odd.role not in (None, "time"):
            text = f"{typed_what(value)} is typed{odd.would}"
            return "typed number", text, odd.expected, as_typed(value)
        return None
    same = _same(value, odd.expected, line, exam)
    mixed = line.computed or odd.role is not None  # half of a column may be typed
    if mixed and line.usual is not None:
        if odd.role is None and same and odd.k == 1:
            return None
        text = f"a number is typed{odd.would}{RIGHT_HERE if same else ''}"
        return "typed number", text, odd.expected, value
    if odd.role is None or odd.expected is None or same:
        return None
    text = "the number does not follow from the cells before it"
    return "typed number", text, odd.expected, value


def _without_number(odd: _Cell) -> Oddity | None:
    """The verdict on a formula that gives no number."""
    value = odd.value
    if value == "#N/A" and odd.role is not None and _goes_on(odd.line, odd.place):
        return "odd formula", f"the formula gives {value}{odd.would}", odd.expected, str(value)
    if isinstance(value, Error) and value != "#N/A" and odd.expected is not None:
        return "odd formula", f"the formula gives {value}", odd.expected, str(value)
    if odd.role is None or odd.expected is None or value in ("", "#N/A"):
        return None
    return "odd formula", f"the formula gives no number{odd.would}", odd.expected, value


def _goes_on(line: Line, place: Position) -> bool:
    """Whether the usual formula of a line stands below a cell: the rows did not end there."""
    index = (place[2] if line.across else place[1]) + 1
    return line.usual is not None and line.evaluator.formulas.get(line.place(index)) is line.usual


def _least_size(line: Line) -> float:
    return 1e-12 * max(map(abs, line.values.values()), default=0.0)


def _same(value: float, expected: float | None, line: Line, exam: Examination) -> bool:
    """Whether a number is the one expected, to nine digits of it or to its own digits."""
    if expected is None:
        return True
    typed = 0.0
    if not line.computed:
        size = max(map(abs, line.values.values()))
        typed = 4 * line.rounding(value or size) + _spread(exam, line, abs(expected))
    scale = max(abs(expected), 1e-5 * max(map(abs, line.values.values())))
    return abs(value - expected) <= EXACT * scale + typed


def _spread(exam: Examination, line: Line, expected: float) -> float:
    """By how much typed digits of the cells before may change what follows from them."""
    table = exam.table
    role = next((r for r, o in table.lines.items() if o is line), None)
    spread = exam.fitted.digits * expected
    if role is not None and role.startswith("velocity"):
        speed = table.lines[start_of_row(table)[0]]
        spread += 4 * speed.rounding(max(map(abs, speed.values.values())))
        if "deceleration" in table.lines:
            brake = table.lines["deceleration"]
            spread += (
                abs(exam.fitted.six.e) * 2 * brake.rounding(max(map(abs, brake.values.values())))
            )
        else:
            spread += 2 * exam.fitted.rough * speed.largest_change
    if role == "depth":
        spread += 2 * line.rounding(max(map(abs, line.values.values())))
    if role == "deceleration":
        depth = table.lines["depth"]
        deepest = max(map(abs, depth.values.values()))
        spread += 4 * max(map(abs, line.values.values())) * depth.rounding(deepest) / deepest
        six = exam.fitted.six
        steepest = abs(six.G * six.V**2 + six.H) * abs(six.D)  # at the surface
        spread = max(spread, 2 * steepest * depth.rounding(deepest) if steepest > 0 else 0.0)
    return spread


def _alike(
    exam: Examination, inputs: Inputs, place: Position, shape: Shape, usual: Shape, k: int
) -> tuple[bool, bool, bool]:
    """Whether a formula responds like its column's to the state of its row, and to the inputs.

    Then whether it responds to all inputs to which that one does, and to more.
    """
    table, evaluator = exam.table, exam.table.evaluator
    probe = Probe(table, k)
    state: dict[Position, float | str | bool | None] = {}
    for number, (name, cell) in enumerate(probe.state.items(), 1):
        if cell != place:
            state[cell] = probe.base[name] * (1 + 0.0037 * number)
    given: dict[Position, float | str | bool | None] = {}
    for number, source in enumerate(inputs.sources, 1):
        if source.literal is None and not source.computed and source.place is not None:
            given[source.place] = source.value * (1 + 0.0029 * number)
    numbers = {
        source.literal: source.value * (1 + 0.0023 * number)
        for number, source in enumerate(inputs.sources, 1)
        if source.literal is not None and source.name
    }
    cone = probe.cone(place)
    wide = cone | evaluator.cone(
        [(a.sheet, a.top, a.left) for ref in usual.references for a in [ref.at(place[1], place[2])]
         if a.cells == 1], probe.stop)  # fmt: skip

    def same(
        cells: Mapping[Position, float | str | bool | None], literals: Mapping[LiteralKey, float]
    ) -> bool:
        own = evaluator.value(place, cells, literals, wide, shape)
        want = evaluator.value(place, cells, literals, wide, usual)
        if type(own) is float and type(want) is float:
            return math.isclose(own, want, rel_tol=EXACT)
        return type(own) is type(want)

    def read(formula: Shape) -> set[Position]:
        first = evaluator.value(place, {}, {}, wide, formula)
        return {
            cell
            for cell, nudged in given.items()
            if evaluator.value(place, {cell: nudged}, {}, wide, formula) != first
        }

    alike = same(state, {})
    if not alike or same({**state, **given}, numbers):
        return alike, True, False
    return True, False, read(shape) > read(usual)

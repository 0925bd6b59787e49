"""Cells that differ from their column: in value, in response to the state, or to an input.

Every cell that does not have the usual formula of its column is compared with that formula in its
own row. So a wrong cell is found where it stands, and the rows that follow from it are not accused.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

from replication.check.examination import Examination
from replication.check.fit import Probe
from replication.check.roles import Inputs
from replication.check.six import EXACT, start_of_row
from replication.check.table import Line, Table, behind, runs
from replication.check.words import title
from replication.reading import quoted
from spreadsheets.evaluate import Error, LiteralKey, Shape, written
from spreadsheets.foreign import Position

_MOST_PROBED = 40
"""So many odd cells of a column are probed; of others only the value is compared."""


def formula_at(exam: Examination, place: Position) -> str:
    """The formula of a cell, cut if it is long; for a typed one, "the number"."""
    shape = exam.table.evaluator.formulas.get(place)
    return written(shape.key, place[1], place[2])[:200] if shape else "the number"


def feeding(table: Table) -> list[Line]:
    """The lines beside the table that its columns read, in order of calculation."""
    read: set[Line] = set()
    found: list[Line] = []
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
                found.append(helper)
    order = table.evaluator.order
    return sorted(
        found, key=lambda o: max((order.get(o.place(i), -1) for i in o.values), default=-1)
    )


def predicted(exam: Examination, role: str, k: int) -> float | None:
    """What a cell should hold by the six numbers, given the other cells; None if one is missing."""
    table, six, sign = exam.table, exam.fitted.six, exam.fitted.sign
    start = start_of_row(table)

    def at(name: str, row: int) -> float | None:
        return table.number(name, row)

    def u(row: int) -> float | None:
        return at(start[0], row + start[1])

    def brake(row: int) -> float | None:
        a = at("deceleration", row)
        if a is not None:
            return sign * a
        x, v = at("depth", row), u(row)
        return None if "deceleration" in table.lines or x is None or v is None else force(x, v)

    def force(x: float, v: float) -> float:
        a = six.deceleration(x, v)
        return six.deceleration(x, v - a * six.e / 2) if exam.fitted.centered else a

    result: float | None = None
    if role == "time":
        before = at("time", k - 1)
        if before is not None and exam.fitted.time is not None:
            result = before + exam.fitted.time
    elif role == "depth":
        before, v = at("depth", k - 1), u(k)
        if k == 1:
            result = None if v is None else six.c * v / 2
        elif before is not None and v is not None:
            result = before + six.c * v
    elif role == "deceleration":
        x, v = at("depth", k), u(k)
        result = None if x is None or v is None else sign * force(x, v)
    elif role == "velocity_initial" and "velocity_final" in table.lines:
        result = at("velocity_final", k - 1)
    else:
        row = k if role == "velocity_final" else k - 1
        v, a = u(row), brake(row)
        result = None if v is None or a is None else v - six.e * a
    return result if result is not None and math.isfinite(result) else None


def odd_cells(exam: Examination, inputs: Inputs) -> None:
    """Report the cells of the table, and of the lines that it reads, that differ from their column."""
    table = exam.table
    for role, line in table.lines.items():
        some_computed = any(o.computed for r, o in table.lines.items() if r not in (role, "time"))
        if role != "time" and not line.computed and some_computed and len(line.values) > 3:
            if exam.fitted.probe is not None or role in ("deceleration", "velocity_initial"):
                cells = [p for p in exam.cells(role, 1) if p not in table.evaluator.formulas]
                text = f"the whole column of {title(role)} is typed as numbers"
                exam.add("typed number", cells, None, text)
                continue
        _judge_line(exam, inputs, line, role)
    helpers = [line for line in feeding(table) if line.usual is not None]
    for helper in helpers:
        _judge_line(exam, inputs, helper, None)
    _broken_off(exam, [*table.lines.values(), *helpers])


def _broken_off(exam: Examination, lines: Sequence[Line]) -> None:
    """Report what ends a table before its formulas do: a text, or a formula that gives an error."""
    evaluator, index = exam.table.evaluator, max(exam.table.rows.values()) + 1
    usual = [o for o in lines if o.usual and evaluator.formulas.get(o.place(index)) is o.usual]
    values = [evaluator.values.get(line.place(index)) for line in usual]
    if not any(isinstance(value, Error) and value != "#N/A" for value in values):
        return
    for line in lines:
        place = line.place(index)
        value, shape = evaluator.values.get(place), evaluator.formulas.get(place)
        if line in usual or type(value) is float or (value is None and shape is None):
            continue
        kind = "odd formula" if shape is not None else "typed number"
        what = formula_at(exam, place) if shape is not None else "a text is typed here, and"
        text = (
            f"{what} gives no number: the table breaks off"
            if shape is not None
            else (f"{what} the table breaks off")
        )
        exam.add(kind, [place], None, text, quoted(value) if shape is None else str(value))
        return


def _rows_of(table: Table, line: Line, role: str | None) -> Iterator[tuple[int, Position]]:
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
    first = min(line.values)
    for k, place in _rows_of(table, line, role):
        shape = evaluator.formulas.get(place)
        if usual is not None and shape is usual and evaluator.values.get(place) is not None:
            continue
        if role is None and line.place(first)[1:] > place[1:]:
            continue
        is_last = k == table.steps and role in ("deceleration", "velocity_final")
        end = table.lines.get("velocity_final")
        if role == "deceleration" and end is not None and end.computed:
            is_last = False  # the velocity at the end of the row needs it
        if is_last and shape is None and place not in evaluator.values:
            continue
        probed += 1
        verdict = _verdict(exam, inputs, line, role, k, place, probed <= _MOST_PROBED)
        if verdict is not None:
            odd[place] = verdict
    groups = runs({p: (v[0], v[1]) for p, v in odd.items()}, table.across)
    for group in groups:
        kind, text, expected, found = odd[group[0]]
        exam.add(str(kind), group, expected, str(text), found)  # type: ignore[arg-type]


def _verdict(
    exam: Examination, inputs: Inputs, line: Line, role: str | None, k: int, place: Position,
    probe: bool,
) -> tuple[str, str, object, object] | None:  # fmt: skip
    """What is wrong with a cell that has not its column's formula: kind, text, expected, found."""
    table, evaluator = exam.table, exam.table.evaluator
    usual, shape = line.usual, evaluator.formulas.get(place)
    value = evaluator.values.get(place)
    straight = table.rows[k] - table.rows.get(k - 1, table.rows[k] - 1) == 1
    expected = predicted(exam, role, k) if role else None
    instead = ""
    applies = False
    if usual is not None and straight:
        shown = evaluator.value(place, {}, shape=usual)
        exact = type(shown) is float and (
            expected is None or math.isclose(shown, expected, rel_tol=1e-6, abs_tol=_size(line))
        )
        applies = type(shown) is float
        if type(shown) is float and (exact or role is None):
            expected = shown
        instead = written(usual.key, place[1], place[2])
    would = f" where {instead[:200]} would stand" if instead else ""
    if value is None and shape is None:
        if expected is None or (role is None and type(expected) is not float):
            return None
        return "odd formula", f"the cell is blank{would}", expected, None
    if shape is None:
        if line.computed and usual is not None:
            if type(value) is float:
                same = _same(value, expected, line, exam)
                if role is None and same and k == 1:
                    return None
                text = f"a number is typed{would}" + (
                    "; it gives the right value here" if same else ""
                )
                return "typed number", text, expected, value
            return "typed number", f"a text is typed{would}", expected, quoted(value)
        if type(value) is float and role and expected is not None:
            if not _same(value, expected, line, exam):
                return (
                    "typed number",
                    "the number does not follow from the cells before it",
                    expected,
                    value,
                )
            return None
        if type(value) is not float and role and role != "time":
            return "typed number", "the cell holds no number", expected, quoted(value)
        return None
    if isinstance(value, Error) and value != "#N/A" and type(expected) is float:
        return "odd formula", f"the formula gives {value}", expected, str(value)
    if type(value) is not float:
        if role is None or expected is None or value in ("", "#N/A"):
            return None
        return "odd formula", f"the formula gives no number{would}", expected, value
    own = written(shape.key, place[1], place[2])[:200]
    if expected is None or type(expected) is not float:
        return None
    same = _same(value, expected, line, exam)
    if usual is None or not applies or not probe or exam.fitted.probe is None or role == "time":
        if same:
            return None
        return (
            "odd formula",
            f"{own} does not give what the rest of the table does",
            expected,
            value,
        )
    state, given, reads_more = _alike(exam, inputs, place, shape, usual, k)
    if same and state and (given or reads_more):
        return None  # a number in the formula of the others, where this one reads a cell, is theirs
    if same and state:
        text = f"{own} has a number where its column reads a cell: {instead[:200]}; it gives the right value here"
        return "typed constant", text, None, None
    text = f"{own} is unlike its column{would}"
    return "odd formula", text, expected, value


def _size(line: Line) -> float:
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
    spread = exam.fitted.slack * expected
    if role is not None and role.startswith("velocity"):
        speed = table.lines[start_of_row(table)[0]]
        spread += 4 * speed.rounding(abs(exam.fitted.six.V))
        if "deceleration" in table.lines:
            brake = table.lines["deceleration"]
            spread += (
                abs(exam.fitted.six.e) * 2 * brake.rounding(max(map(abs, brake.values.values())))
            )
    if role == "depth":
        spread += 2 * line.rounding(max(map(abs, line.values.values())))
    if role == "deceleration":
        depth = table.lines["depth"]
        deepest = max(map(abs, depth.values.values()))
        spread += 4 * max(map(abs, line.values.values())) * depth.rounding(deepest) / deepest
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

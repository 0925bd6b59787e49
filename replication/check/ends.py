"""The first rows of a table and its last: half a step, the first velocity, and the stop."""

import math
from collections.abc import Mapping, Sequence

from replication.check.cells import (
    BLANK_ROW,
    RIGHT_HERE,
    as_typed,
    feeding,
    formula_at,
    predicted,
    typed_what,
)
from replication.check.examination import NO_FAULT, AnotherModelError, Examination, near
from replication.check.fit import grows_beyond, is_bounded
from replication.check.model import maybe_other_method
from replication.check.responses import Influence, is_plain
from replication.check.roles import Inputs
from replication.check.six import (
    VARIANTS,
    end_of_row,
    first_speed,
    first_written,
    run_scheme,
    start_of_row,
)
from replication.check.table import cell_name
from replication.check.taken import report_case, report_inputs
from replication.check.words import input_roles, times_too, title
from replication.models.impact import STOP_VELOCITY
from spreadsheets.foreign import Position

OTHER_STOP = "other stop"
"""How the explanation of rows that end elsewhere begins."""
NEAR_END = 3
"""A result that shows one of so many rows before the last was meant to show the last."""
_SLOW = 0.1
"""A stop velocity is at most this part of the impact velocity."""


def first_rows(exam: Examination, inputs: Inputs, idle: Sequence[Position]) -> None:
    """Judge the first depth, half a step, and the first velocity; a part of a table has none."""
    if exam.table.whole:
        if exam.fitted.probe is not None:
            _first_velocity(exam, inputs, idle)
        _first_depth(exam, inputs)


def _half_step(exam: Examination) -> float | None:
    """The first depth: V times half a step.

    If the depths are accused of their step already, it is the step of the velocities.
    """
    table, six, units = exam.table, exam.fitted.six, exam.units
    wanted = predicted(exam, "depth", 1)
    accused = {cell for d in exam.differences for cell in d.cells}
    later = table.place("depth", 2) if 2 in table.rows else None
    if wanted is None or later not in accused or "deceleration" not in table.lines:
        return wanted
    X, A = units.get("depth", 0.0), units.get("deceleration", 0.0)
    step = abs(six.e) * 10.0 ** (2 * units.get(start_of_row(table)[0], 0.0) - A - X)
    return wanted * step / six.c if math.isfinite(step) and step else wanted


def _first_depth(exam: Examination, inputs: Inputs) -> None:
    table, wanted = exam.table, _half_step(exam)
    if wanted is None or not wanted or 1 not in table.rows:
        return
    line, place = table.lines["depth"], table.place("depth", 1)
    euler = (d for d in exam.differences if d.explanation.startswith("explicit Euler"))
    if any(place in d.cells for d in euler):
        return  # of which a first row with the whole step is a part
    is_formula = place in table.evaluator.formulas
    value, step = table.number("depth", 1), inputs.cells.get("step")
    if value is None:
        _no_number(exam, place, "the first depth", wanted)
        return
    digits = 0.0 if line.computed else exam.fitted.digits + line.rounding(value) / abs(wanted)
    slack, ratio = 1e-9 + 2 * digits, value / wanted
    if abs(ratio - 1) <= slack:
        if is_formula:
            _first_response(exam, place, inputs)
        elif line.computed and step is not None and step.cell is not None:
            text = f"the first depth is typed, though it rests on {cell_name(step.cell, True)}"
            exam.add("typed number", [place], wanted, text + RIGHT_HERE)
        return
    name = _named_start(exam, ratio, slack)
    power = math.log10(ratio) if ratio > 0 else math.nan
    if name and (is_formula or not line.computed or not ratio):
        exam.add("other scheme", [place], wanted, f"{name}: {VARIANTS[name].says}")
    elif not is_formula:
        text = "the first depth is typed, and is not V times half a step"
        exam.add("typed number", [place], wanted, text)
    elif abs(power - round(power if power == power else 0)) < 1e-9:
        text = f"the first depth is {times_too(round(power))}: a unit is not converted"
        exam.add("unit", [place], wanted, text)
    else:
        text = f"{formula_at(exam, place)} does not give V times half a step"
        exam.add("odd formula", [place], wanted, text)


def _named_start(exam: Examination, ratio: float, slack: float) -> str | None:
    """The name of a first depth that is so many times half a step; None if it has none.

    Raises AnotherModelError if it is a whole step, as in other methods, and the rows do not tell.
    """
    named = {"no half step": 2.0, "starts at zero": 0.0}
    name = next((name for name, times in named.items() if abs(ratio - times) <= slack), None)
    if name == "no half step" and not exam.fitted.told:
        raise AnotherModelError(maybe_other_method(exam.table, name))
    return name


def _no_number(exam: Examination, place: Position, what: str, wanted: float) -> None:
    """Report a cell of the first row that is blank, or holds or gives no number."""
    value = exam.table.evaluator.values.get(place)
    if place in exam.table.evaluator.formulas:
        text = f"{formula_at(exam, place)} gives no number for {what}"
        exam.add("odd formula", [place], wanted, text)
    elif value is None:
        exam.add("odd formula", [place], wanted, f"{what} is blank")
    else:
        text = f"{typed_what(value)} is typed for {what}"
        exam.add("typed number", [place], wanted, text, as_typed(value))


def _first_response(exam: Examination, place: Position, inputs: Inputs) -> None:
    """Report a first depth that does not respond to the cell of the step or the velocity."""
    evaluator = exam.table.evaluator
    cone, value = evaluator.cone([place], ()), evaluator.values[place]
    for role in ("step", "velocity"):
        source = inputs.cells.get(role)
        if source is None or source.cell is None or not source.powers:
            continue
        if role == "velocity" and first_speed(exam.table) in {d.place for d in exam.differences}:
            continue  # it reads a first velocity that is wrong itself
        now = evaluator.value(place, {source.cell: source.value * 1.01}, within=cone)
        if type(now) is float and type(value) is float and not near(now / value, 1.01):
            where = cell_name(source.cell, True)
            text = f"{title(role)} is typed into the first depth, where {where} should be read"
            exam.add("typed constant", [place], where, text, formula_at(exam, place))
            return


def _first_velocity(exam: Examination, inputs: Inputs, idle: Sequence[Position]) -> None:
    """Judge the velocity that the rows start from: that of the impact, from its cell."""
    table, values = exam.table, exam.table.evaluator.values
    start = table.place("velocity_initial", 1) if "velocity_initial" in table.lines else None
    if start is not None and 1 in table.rows and table.number("velocity_initial", 1) is None:
        _no_number(exam, start, "the first velocity", exam.fitted.six.V)
        return
    place = first_speed(table)
    if place is None or place in {d.place for d in exam.differences}:
        return
    first = values[place]
    assert type(first) is float
    is_formula = place in table.evaluator.formulas
    impact = table.number("velocity_initial", 0)
    if impact is not None and not near(impact, first):
        kind = "odd formula" if is_formula else "typed number"
        shown = formula_at(exam, place) if is_formula else "the first velocity"
        exam.add(kind, [place], impact, f"{shown} is not the velocity of the impact")
        return
    place = first_written(table, place)
    if place in table.evaluator.formulas:
        return
    known = _velocity_cell(inputs, idle, first, values)
    if known is not None and known.cell != place and (known.cell or known.name):
        same = RIGHT_HERE if near(first, known.value) else ""
        where = cell_name(known.cell, True) if known.cell else known.name
        text = f"the first velocity is typed, where {where} should be read"
        exam.add("typed number", [place], known.value, text + same)


def _velocity_cell(
    inputs: Inputs, idle: Sequence[Position], first: float, values: Mapping[Position, object]
) -> Influence | None:
    """The cell of the impact velocity: by label, or one with that number and no other label."""
    if "velocity" in inputs.cells:
        return inputs.cells["velocity"]
    for place in idle:
        if values.get(place) == first and not is_plain(first):
            label, unit = inputs.labels.get(place, ("", None))
            roles = input_roles(label, unit) if label else frozenset()
            if not roles or "velocity" in roles:
                return Influence(place, None, first, {})
    return None


# ---- the stop


def judge_stop(exam: Examination, idle: Sequence[Position]) -> None:
    """Run the scheme with the intended inputs, and compare where it stops."""
    table, six = exam.table, exam.intended
    end = end_of_row(table)
    unit = 10.0 ** exam.units.get(end[0], 0.0)
    shown = ((k, table.number(end[0], k + end[1])) for k in sorted(table.rows) if k >= 1)
    speeds = {k: v * unit for k, v in shown if v is not None}
    exam.ends = False
    if six is None or not speeds or not all(0 < x < math.inf for x in six):
        return
    stop = exam.stop_velocity = _stop_velocity(exam, speeds, idle, unit)
    rows = run_scheme(six, stop)
    if not rows or rows[-1].velocity_final >= stop:
        return
    exam.right_depth = rows[-1].depth
    _beyond_radius(exam)
    if "radius" not in exam.inputs:
        exam.right_depth = None  # the digits of the rows do not tell it
    below = next((k for k, v in speeds.items() if v < stop), None)
    exam.ends = table.whole and below is not None
    if not table.whole or len(rows) == table.steps:
        exam.ends = table.whole
    elif any(d.explanation.startswith(BLANK_ROW) for d in exam.differences):
        exam.ends = False  # what stands below a row that is blank says nothing
    elif below is None:
        _ends_early(exam, speeds, stop, len(rows))
    elif below < max(speeds) and _at_rest(exam, below):
        exam.stop_row = below
        _at_rest_after(exam, below)
    elif below < max(speeds) and _shows_stop(exam, below):
        exam.stop_row = below
    elif below < max(speeds):
        cells = [table.place(end[0], k) for k in sorted(table.rows) if k > below and k in speeds]
        last = speeds[max(speeds)]
        text = f"{OTHER_STOP}: the rows end at {last:.4g} m/s, after the stop at {stop:g} m/s"
        exam.add("other scheme", cells, None, text)


def _beyond_radius(exam: Examination) -> None:
    """Report a contact area that shrinks beyond the radius, if the particle gets there."""
    table, six = exam.table, exam.intended
    assert six is not None
    assert exam.right_depth is not None
    cells = _unbounded_cells(exam)
    accused = {d.place for d in exam.differences if d.kind != "stale value"}
    if exam.right_depth <= six.D / 2 or accused.intersection(cells):
        return
    if not is_bounded(exam.fitted):
        deep = {k for k in table.rows if (table.number("depth", k) or 0.0) > exam.fitted.six.D / 2}
        indices = {table.rows[k] for k in deep}
        along = 2 if table.across else 1
        blamed = [cell for cell in cells if cell[along] in indices]
        way = VARIANTS["area beyond the radius"]
        if blamed:  # rows that end before the radius are right as they are
            exam.add("other scheme", blamed, None, f"{way.name}: {way.says}")


def _unbounded_cells(exam: Examination) -> list[Position]:
    """The cells of the column in which the contact area shrinks: the first one that has it."""
    table, probe = exam.table, exam.fitted.probe
    if probe is not None:
        for line in feeding(table):
            if grows_beyond(exam.fitted, line.place(table.rows[probe.k])):
                rows = sorted(table.rows.items())
                return [line.place(i) for k, i in rows if k >= 1 and i in line.values]
    return exam.cells(exam.fitted.brakes, 1)


def _ends_early(exam: Examination, speeds: Mapping[int, float], stop: float, steps: int) -> None:
    """Report rows that end before the stop.

    With other inputs, or the other beta, the rows prepared for the former inputs run out, and an
    excerpt has few rows; a single row may be left out. But other formulas of the report's case that
    end shortly before the stop were ended at another velocity. Numbers may be cut anywhere.
    """
    table, six = exam.table, exam.intended
    assert six is not None
    last = speeds[max(speeds)]
    text = f"the rows end at {last:.4g} m/s, before the stop at {stop:g} m/s: "
    text += f"{table.steps} of {steps:,} steps"
    ours = report_inputs()["resistance"]
    prepared = any(
        len(run_scheme(six._replace(H=six.H * a / b), stop)) == table.steps
        for a in ours for b in ours if a != b
    )  # fmt: skip
    faults = [d for d in exam.differences if d.kind not in NO_FAULT or d.kind == "other input"]
    is_report = stop == STOP_VELOCITY and report_case(six, exam.fitted) is not None
    column = end_of_row(table)[0]
    complete = is_report and not faults and not prepared
    in_numbers = exam.fitted.probe is None
    early = table.steps < steps - 1 if in_numbers else 2 * table.steps < steps
    exam.cut_short = complete and early
    if complete and not in_numbers and steps // 2 <= table.steps < steps - 1:
        exam.add("other scheme", [table.place(column, table.steps)], None, f"{OTHER_STOP}: {text}")
        exam.ends = True
    else:
        exam.add("not calculated", [table.place(column, table.steps)], None, text)


def _stop_velocity(
    exam: Examination, speeds: Mapping[int, float], idle: Sequence[Position], unit: float
) -> float:
    """The velocity at which the rows stop: that of its cell, or 1 m/s as in the report.

    A cell without a known label is it if the last row is the first one below its number, in the
    unit of the column or in SI units; in any unit if no unit of a velocity is stated.
    """
    last, before = speeds[max(speeds)], speeds.get(max(speeds) - 1, math.inf)
    labelled = exam.inputs.get("stop_velocity")
    own = labelled is not None and (labelled.place is None or exam.on_own_sheets(labelled.place))
    if last < STOP_VELOCITY <= before and exam.firm_speed and not own:
        return STOP_VELOCITY
    if labelled is not None and (exam.firm_speed or last < labelled.si <= before):
        return labelled.si
    if last < STOP_VELOCITY <= before:
        return STOP_VELOCITY
    taken = {e.place for role, e in exam.inputs.items() if role != "stop_velocity"}
    for place in (*sorted(exam.read), *idle):
        value = exam.table.evaluator.values.get(place)
        if type(value) is float and place not in taken and value > 0:
            units = (unit, 1.0) if exam.firm_speed else [10.0**n for n in range(-12, 13)]
            for each in (value * factor for factor in units):
                if last < each <= before and each <= _SLOW * exam.fitted.six.V * unit:
                    return float(each)
    if exam.firm_speed and report_case(exam.intended, exam.fitted) is not None:
        return STOP_VELOCITY
    # Nobody states it, or its unit: the rows should end with the first velocity below zero.
    earlier = (v for k, v in speeds.items() if v > 0 and k != max(speeds))
    return min([STOP_VELOCITY, *earlier])


def _at_rest(exam: Examination, below: int) -> bool:
    """Whether the depth stays as it is after the row of the stop."""
    depths = [exam.table.number("depth", k) for k in sorted(exam.table.rows) if k >= below]
    return len(set(depths)) == 1


def _at_rest_after(exam: Examination, below: int) -> None:
    """Take rows that stand still after the stop for what they are: no steps of the scheme."""
    places = exam.table.places
    exam.differences = [
        d for d in exam.differences if d.place not in places or places[d.place][1] <= below
    ]


def _shows_stop(exam: Examination, below: int) -> bool:
    """Whether a cell beside the table shows the depth of the row of the stop, or that over R.

    Later rows are then spare. So they are if it shows a row shortly before by a slip.
    """
    table, evaluator = exam.table, exam.table.evaluator
    depths = {table.place("depth", k): table.number("depth", k) for k in _near_stop(exam, below)}
    radius = exam.inputs.get("radius")
    X = 10.0 ** exam.units.get("depth", 0.0)
    scales = [1.0, *([X / radius.si] if radius is not None and radius.si > 0 else [])]
    lined = {line.place(i) for line in table.helpers for i in line.values}
    for cell in evaluator.formulas.keys() - table.places.keys() - lined:
        value = evaluator.values.get(cell)
        if type(value) is not float:
            continue
        for place, depth in depths.items():
            shows = depth and any(_is_power(value / (depth * scale)) for scale in scales)
            if shows and any(area.covers(place) for area in evaluator.areas(cell)):
                return True
    return False


def _near_stop(exam: Examination, below: int) -> list[int]:
    """The row of the stop, and those shortly before it."""
    return [k for k in exam.table.rows if below - NEAR_END <= k <= below]


def _is_power(ratio: float) -> bool:
    """Whether a ratio is a power of ten."""
    power = math.log10(ratio) if 0 < ratio < math.inf else math.nan
    return math.isfinite(power) and abs(power - round(power)) < 1e-10

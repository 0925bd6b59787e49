"""Row 0 of a table without formulas: the impact itself, from which no formula takes a number.

The rows that follow tell what it may hold. People fill it in several ways; only a number that none
of them gives is reported.
"""

from collections.abc import Iterator

from replication.check.examination import Examination
from replication.check.six import first_speed, start_of_row
from replication.check.table import Line
from replication.check.words import title

_SMALL = 1e-3
"""A first depth that is no larger part of a step is there to keep a formula from dividing by 0."""
_LEAST_SLACK = 1e-9
"""Relative difference up to which numbers of full precision are the same."""


def judge_impact(exam: Examination) -> None:
    """Report the numbers of row 0 that cannot be those of the impact.

    The time is judged with its column.
    """
    table = exam.table
    if exam.fitted.probe is not None or not table.whole or {0, 1} - table.rows.keys():
        return
    accused = {cell for d in exam.differences for cell in d.cells}
    for role, wanted, text in (*_speeds(exam), *_depth(exam), *_brake(exam)):
        place = table.place(role, 0)
        if place not in accused and not table.lines[role].computed:
            exam.add("typed number", [place], wanted, text)


def _slack(line: Line, *numbers: float) -> float:
    """What the digits of some numbers of a line admit together."""
    largest = _LEAST_SLACK * max(map(abs, numbers))
    return largest + sum(line.rounding(number) for number in numbers)


def _speeds(exam: Examination) -> Iterator[tuple[str, float, str]]:
    """Velocities at the impact that are not that of the first step.

    Some programs write that half a step, or a step, before or after. A velocity at the end of
    row 0 may be left zero.
    """
    table = exam.table
    start = first_speed(table)
    if start is None or start not in table.places or table.places[start] == ("velocity_final", 0):
        return  # a velocity at the end of row 0 is the one from which row 1 starts: judged there
    V, after = table.number("velocity_initial", 1), table.number("velocity_initial", 2)
    if after is None:
        after = table.number("velocity_final", 1)
    if V is None or after is None or not _starts_with(exam, V):
        return
    for role in ("velocity_initial", "velocity_final"):
        value = table.number(role, 0)
        if value is None or (role == "velocity_final" and value == 0):
            continue
        unit = 10.0 ** (exam.units.get("velocity_initial", 0.0) - exam.units.get(role, 0.0))
        wanted, fall = V * unit, abs(V - after) * unit
        if abs(value - wanted) > fall + _slack(table.lines[role], value, wanted, after * unit):
            text = f"{title(role)} in the row of the impact is not the one of the first step"
            yield role, wanted, text


def _starts_with(exam: Examination, V: float) -> bool:
    """Whether the first depth is half a step, or a whole one, with this first velocity."""
    first, line = exam.table.number("depth", 1), exam.table.lines["depth"]
    step = exam.fitted.six.c * V
    if first is None or not step:
        return False
    close = _slack(line, first, step) + (exam.fitted.digits + exam.fitted.errors.c) * abs(step)
    return any(abs(first - part * step) <= close for part in (0.0, 0.5, 1.0))


def _depth(exam: Examination) -> Iterator[tuple[str, float, str]]:
    """A depth at the impact that is not zero, nor half a step before it.

    Half a step before the surface each row adds the same, V times the step.
    """
    table, line = exam.table, exam.table.lines["depth"]
    value, first = table.number("depth", 0), table.number("depth", 1)
    V = table.number(*_first_start(exam))
    if value is None or first is None or V is None:
        return
    step = abs(exam.fitted.six.c * V)
    close = _slack(line, first) + _SMALL * step
    if abs(value) > close and abs(value + step / 2) > close + exam.fitted.digits * step:
        yield "depth", 0.0, "the depth in the row of the impact is not zero"


def _first_start(exam: Examination) -> tuple[str, int]:
    """The role and row of the velocity at the start of row 1."""
    role, lag = start_of_row(exam.table)
    return role, 1 + lag


def _brake(exam: Examination) -> Iterator[tuple[str, float, str]]:
    """A deceleration at the impact that is not between zero, as at the surface, and the next."""
    if "deceleration" not in exam.table.lines:
        return
    line = exam.table.lines["deceleration"]
    value, first = (exam.table.number("deceleration", k) for k in (0, 1))
    if value is None or first is None:
        return
    close = _slack(line, value, first)
    if not min(0.0, first) - close <= value <= max(0.0, first) + close:
        is_large = value * first > 0
        problem = "is larger than that of the first step" if is_large else "has the wrong sign"
        text = f"the deceleration in the row of the impact, at depth zero, {problem}"
        yield "deceleration", 0.0, text

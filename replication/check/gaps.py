"""Rows of numbers that stand twice, and rows that are left out: the rows numbered without them."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from statistics import median

from replication.check.delimited import line_named
from replication.check.examination import Examination
from replication.check.six import start_of_row
from replication.check.table import SchemeTable

_LEAST_ROWS = 8
"""Of fewer rows it cannot be said which one is missing."""
_MOST_GAPS = 0.1
"""If a larger share of rows were missing, the rows would be another table's."""
_USUAL = 0.3
"""Part by which the fall of the velocity over a few rows may differ from that of its neighbours."""
_CLEAR = 4.0
"""A row moves if it should move by so many times the rounding of its depth."""


def renumbered(table: SchemeTable) -> SchemeTable:
    """The table with its rows numbered by the steps that they show.

    A row that repeats the one before it is none; a number is free where a row is left out.
    """
    if len(table.rows) < _LEAST_ROWS or any(line.computed for line in table.lines.values()):
        return table
    step = _usual_growth(table)
    repeated = [k for k in sorted(table.rows) if _repeats(table, k, step)]
    kept = [k for k in sorted(table.rows) if k not in repeated]
    left_out = {k: n for k, n in _left_out(table, kept, step) if n > 1}
    if len(repeated) + len(left_out) > _MOST_GAPS * len(kept) or not (repeated or left_out):
        return table
    rows, number = {}, kept[0] - 1
    for k in kept:
        number += left_out.get(k, 1)
        rows[number] = table.rows[k]
    doubles = tuple(table.rows[k] for k in repeated)
    return replace(table, rows=rows, repeated=doubles, places={})


def judge_gaps(exam: Examination) -> None:
    """Report rows that stand twice or are left out; where lines are blank, openly, they may be."""
    table, book = exam.table, exam.table.evaluator.book
    columns = list(table.lines.values())
    for index in table.repeated:
        text = f"a row stands twice ({line_named(book, index, table.across)})"
        exam.add("typed number", [line.place(index) for line in columns], None, text)
    if exam.fitted.probe is not None:
        return
    for before, k in pairwise(sorted(table.rows)):
        last, index = table.rows[before], table.rows[k]
        between = set(range(last + 1, index)) - set(table.repeated)
        if k - before > 1 and not between:
            count = k - before - 1
            rows = "a row is" if count == 1 else f"{count} rows are"
            text = f"{rows} missing after {line_named(book, last, table.across)}"
            exam.add("typed number", [line.place(index) for line in columns], None, text)


def _usual_growth(table: SchemeTable) -> float:
    """By how much the depth grows in most rows for each unit of the velocity."""
    role, lag = start_of_row(table)
    ratios = []
    for k in table.rows:
        x, before = table.number("depth", k), table.number("depth", k - 1)
        u = table.number(role, k + lag)
        if x is not None and before is not None and u:
            ratios.append((x - before) / u)
    return median(ratios) if ratios else 0.0


def _repeats(table: SchemeTable, k: int, step: float) -> bool:
    """Whether a row has all numbers of the row before it, though it should have moved."""
    role, lag = start_of_row(table)
    x, u = table.number("depth", k), table.number(role, k + lag)
    if x is None or u is None or step * u < _CLEAR * table.lines["depth"].rounding(x):
        return False
    pairs = [(table.number(name, k), table.number(name, k - 1)) for name in table.lines]
    return k > 1 and all(own == before for own, before in pairs)


def _left_out(table: SchemeTable, kept: Sequence[int], step: float) -> Iterator[tuple[int, int]]:
    """By how many steps each row is behind the one before it, if the numbers tell."""
    speed = next(role for role in ("velocity_initial", "velocity_final") if role in table.lines)
    falls = {}
    for a, b in pairwise(kept):
        u, w = table.number(speed, a), table.number(speed, b)
        falls[b] = None if u is None or w is None else u - w
    for number, (a, b) in enumerate(pairwise(kept), 1):
        beside = [falls.get(kept[i]) for i in (number - 1, number + 1) if 0 < i < len(kept)]
        known = [fall for fall in beside if fall is not None]
        steps = _steps_between(table, a, b, speed, step)
        fall = falls[b]
        if a < 1 or steps < 2 or fall is None or not known:
            continue
        usual = steps * sum(known) / len(known)
        rounding = 2 * table.lines[speed].rounding(table.number(speed, a) or 0.0)
        if abs(fall - usual) <= _USUAL * usual + rounding and _time_agrees(table, a, b, steps):
            yield b, steps


def _steps_between(table: SchemeTable, a: int, b: int, speed: str, step: float) -> int:
    """How many steps of the velocities in between lead from one depth to another; 0 if none do."""
    line = table.lines["depth"]
    x, before = table.number("depth", b), table.number("depth", a)
    high, low = table.number(speed, a), table.number(speed, b)
    if x is None or before is None or high is None or low is None or high + low <= 0 or step <= 0:
        return 0
    steps = round((x - before) / (step * (high + low) / 2))
    close = line.rounding(x) + line.rounding(before) + 1e-9 * abs(x)
    good = steps * step * low - close <= x - before <= steps * step * high + close
    return steps if good else 0


def _time_agrees(table: SchemeTable, a: int, b: int, steps: int) -> bool:
    """Whether the times of two rows, if there are any, are so many steps apart."""
    now, before = table.number("time", b), table.number("time", a)
    if now is None or before is None:
        return "time" not in table.lines
    pairs = ((table.number("time", k), table.number("time", k - 1)) for k in table.rows)
    usual = median(t - last for t, last in pairs if t is not None and last is not None)
    line = table.lines["time"]
    close = (steps + 1) * 2 * max(line.rounding(now), line.rounding(before)) + 1e-9 * abs(now)
    return usual > 0 and abs(now - before - steps * usual) <= min(close, usual / 2)

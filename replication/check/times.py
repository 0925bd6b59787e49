"""The times of a table without formulas: whether they count the rows in equal steps.

A time is k times the step, whatever its origin: where the step itself ends within the digits that
are printed, each time is known to half a unit of its last digit, without the time before it.
"""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import pairwise
from statistics import median
from typing import NamedTuple

from replication.check.examination import Examination
from replication.check.six import start_of_row

_SINGLE = 2.0**-24
"""The relative rounding error of single precision, in which some programs add up times."""
_DOUBLE = 1e-15
"""The relative error of doubles, generously."""
_SAME = 1e-9
"""Relative difference up to which times of full precision are the same."""
_LEAST_ROWS = 6
"""Of fewer times it cannot be said which one is wrong."""
_MOST = 0.5
"""A larger share of rows is most of them."""
_NEARLY_ALL = 0.9
"""So large a share of times leaves no doubt of the step, nor of half a digit."""
_PART = 1e-3
"""Times that are so small a part of their last digit apart are printed as the same."""
_FAR = 3.0
"""Two steps that differ by so many times what their digits admit are two."""

Numbers = Mapping[int, float]
"""A number for each row that has one, by the number of the row."""


class Steps(NamedTuple):
    """Equal steps of times, the error that the digits admit, and the time of row 0 by them.

    `near` is how far from their row times may be that count as known, and `clear` says that nearly
    all are. The origin is None where the step has more digits than the times, which are rounded.
    """

    step: float
    error: float
    near: float
    origin: float | None
    clear: bool = False


class WrongTime(NamedTuple):
    """The row of a time that does not count the rows, and what it should be.

    `goes_on`: the times after it follow from it.
    """

    k: int
    expected: float
    goes_on: bool


def judge_times(exam: Examination) -> bool:
    """Report times that do not count the rows; False if their steps are not equal at all."""
    table, line = exam.table, exam.table.lines["time"]
    shown = ((k, table.number("time", k)) for k in sorted(table.rows))
    times = {k: t for k, t in shown if t is not None}
    usual = median(line.rounding(t, 1) for t in times.values())
    errors = {k: line.rounding(t, 1) if t else usual for k, t in times.items()}
    steps = equal_steps(times, errors)
    if steps is None:
        return False
    for wrong in wrong_times(times, errors, steps):
        text = "the time does not count the rows in equal steps"
        if wrong.goes_on:
            off = times[wrong.k] - wrong.expected
            way = "large" if off > 0 else "small"
            text += f": all times from here on are too {way} by {abs(off):.6g}"
        exam.add("typed number", [table.place("time", wrong.k)], wrong.expected, text)
    _compare_steps(exam, steps.step, max(steps.error, 2 * usual / len(times)))
    return True


def _compare_steps(exam: Examination, step: float, error: float) -> None:
    """Report times that grow by another step than the depths, in whatever unit."""
    fitted, units = exam.fitted, exam.units
    six, errors = fitted.six, fitted.errors
    if not (step > 0 and six.c > 0 and fitted.followed == 1):
        return
    unit = units.get("depth", 0.0) - units.get(start_of_row(exam.table)[0], 0.0)
    off = math.log10(step / six.c) + units.get("time", 0.0) - unit
    close = _FAR * (errors.c + error / step) + _SAME
    if abs(off - round(off)) > math.log10(1 + close):
        moved = six.c * 10.0 ** (unit - units.get("time", 0.0) + round(off))
        text = f"the times grow by {step:.6g} a row, the depths by the velocity times {moved:.6g}"
        exam.add("other scheme", exam.cells("time", 1), None, f"another step: {text}")


def equal_steps(times: Numbers, errors: Numbers) -> Steps | None:
    """The steps of most times, whose `errors` are what their digits admit; None if they have none.

    >>> steps = equal_steps({k: round(k / 5, 1) for k in range(20)}, dict.fromkeys(range(20), 0.05))
    >>> steps.step, steps.origin
    (0.2, 0.0)
    """
    if len(times) < _LEAST_ROWS:
        return None
    rows, rounding = sorted(times), median(errors.values())
    same = _PART * rounding + _DOUBLE * max(map(abs, times.values()))
    far = max(1, len(rows) // 4)
    middle = median((times[b] - times[a]) / (b - a) for a, b in zip(rows, rows[far:], strict=False))
    for step in (_most_frequent(times, rounding), middle):
        origins = {k: round((t - k * step) / same) for k, t in times.items()}
        origin = Counter(origins.values()).most_common(1)[0][0]
        agree = {k for k, rest in origins.items() if rest == origin}
        # Times with more decimals than most, as small ones in exponents, must tell no other step.
        finer = {k for k, error in errors.items() if error < rounding / 2}
        if len(agree) > _MOST * len(times) and len(agree & finer) >= _MOST * len(finer):
            start = median(times[k] - k * step for k in agree)
            clear = len(agree) >= _NEARLY_ALL * len(times)
            return Steps(step, 2 * same / len(agree), same, start, clear)
    pairs = sum(
        abs(times[b] - times[a] - (b - a) * middle) <= errors[a] + errors[b] + same
        for a, b in pairwise(rows)
    )
    if pairs <= _MOST * len(times):
        return None
    return Steps(middle, 2 * rounding / far, same, None)


def _most_frequent(times: Numbers, rounding: float) -> float:
    """The step that most neighbouring times show."""
    digits = 2 - math.floor(math.log10(rounding)) if rounding > 0 else 15
    steps = ((times[b] - times[a]) / (b - a) for a, b in pairwise(sorted(times)))
    return Counter(round(step, digits) for step in steps).most_common(1)[0][0]


def wrong_times(times: Numbers, errors: Numbers, steps: Steps) -> list[WrongTime]:
    """The times that do not count the rows by these steps.

    Where the times after a wrong one follow from it, only the first of them is wrong. The time of
    the impact may also be that of the first step, or half a step before it.
    """
    rows, walk = sorted(times), _Walk(times, errors, steps)
    last, before = walk.start(rows)
    wrong: list[WrongTime] = []
    by_a_digit: list[WrongTime] = []
    for k, after in zip(rows, [*rows[1:], None], strict=True):
        miss, close = walk.off(last, before, k), walk.slack(last, k)
        if abs(miss) <= close:
            if steps.origin is None:
                last, before = k, times[k]
            continue
        if k == 0 and min(abs(miss - steps.step), abs(miss - steps.step / 2)) <= close:
            continue
        alone = after is not None and abs(walk.off(last, before, after)) <= walk.slack(last, after)
        goes_on = after is not None and not alone and walk.follows(k, after)
        if steps.origin is not None and abs(miss) <= close + errors[k]:
            by_a_digit += [WrongTime(k, times[k] - miss, False)] if alone else []
        elif not goes_on or abs(miss) > close + k * _SINGLE * abs(times[k]):
            wrong.append(WrongTime(k, times[k] - miss, goes_on))
        if goes_on:
            last, before = k, times[k]
    # Ties, and cutting digits off, make the last digit of several times another one.
    return sorted(wrong + by_a_digit) if steps.clear and len(by_a_digit) == 1 else wrong


class _Walk(NamedTuple):
    """Times, what their digits admit as their errors, and the steps that most of them take."""

    times: Numbers
    errors: Numbers
    steps: Steps

    def off(self, last: int, before: float, k: int) -> float:
        """How much later row k is than equal steps from another row, at the time `before`."""
        return self.times[k] - before - (k - last) * self.steps.step

    def slack(self, last: int, k: int) -> float:
        """What the digits admit for that; of times on a known line only those of row k."""
        own = self.errors[k] + (self.errors[last] if self.steps.origin is None else 0.0)
        own += abs(k - last) * self.steps.error + self.steps.near
        return own + _SAME * max(abs(self.times[k]), abs(self.times[last]))

    def follows(self, last: int, k: int) -> bool:
        """Whether the time of a row follows from that of another one."""
        return abs(self.off(last, self.times[last], k)) <= self.slack(last, k)

    def start(self, rows: Sequence[int]) -> tuple[int, float]:
        """The row from which the times of others are expected, and its time without rounding.

        It is the first of two rows that are a step apart.
        """
        last = next((a for a, b in pairwise(rows) if self.follows(a, b)), rows[0])
        origin, before = self.steps.origin, self.times[last]
        if origin is not None and abs(self.off(0, origin, last)) <= self.slack(last, last):
            before = origin + last * self.steps.step
        return last, before

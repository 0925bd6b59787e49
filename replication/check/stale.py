"""Stored values that are not what their formulas give."""

import math
from collections.abc import Iterator

from spreadsheets.evaluate import Evaluator
from spreadsheets.foreign import Position
from spreadsheets.scalars import Error, Scalar

_DIGITS = 1e-14
"""Relative deviation above which a stored value is stale: LibreOffice saves 15 digits."""
_FEW = 200
"""So many cells that a formula reads are varied."""


def stale(evaluator: Evaluator) -> Iterator[Position]:
    """The formulas whose stored value is not theirs by what they read now, nor by what is stored.

    A difference of nearly equal numbers has few digits of its own: a stored value is accepted if it
    lies within what the formula gives when the numbers that it reads change in their fifteenth
    digit. Programs store 0 there. Where numbers are rounded as they are shown, none is judged.
    """
    if evaluator.book.as_displayed:
        return
    for place in evaluator.formulas:
        stored = evaluator.book[place].value
        value = evaluator.values.get(place)
        if place in evaluator.reasons or stored is None or stored == value:
            continue
        if type(stored) is float and type(value) is float:
            if abs(stored - value) <= _DIGITS * abs(value) + evaluator.book.resolution:
                continue
            if _within_last_digits(evaluator, place, stored, value):
                continue
        elif evaluator.book[place].error and isinstance(value, Error):
            continue
        if type(stored) is not type(value) and _may_be_stored(evaluator, place, stored):
            continue
        if _follows(evaluator, place, stored):
            continue
        yield place


def _numbers_read(evaluator: Evaluator, place: Position) -> list[Position]:
    """The cells with numbers that a formula reads one by one."""
    cells: list[Position] = []
    for area in evaluator.areas(place):
        used = evaluator.used(area)
        if used.cells <= _FEW - len(cells):
            cells += [p for p in used.places() if type(evaluator.values.get(p)) is float]
    return cells


def _within_last_digits(
    evaluator: Evaluator, place: Position, stored: float, value: float,
    given: dict[Position, Scalar] | None = None,
) -> bool:  # fmt: skip
    """Whether a stored value differs by no more than the last digits of what the formula reads."""
    low = high = value
    spread = 0.0
    for changed in _varied(evaluator, place, given or {}):
        if type(changed) is float and math.isfinite(changed):
            low, high = min(low, changed), max(high, changed)
            spread += abs(changed - value) / 2
    wide = any(area.cells > 1 for area in evaluator.areas(place))
    slack = spread + (10 if wide else 1) * _DIGITS * abs(value) + evaluator.book.resolution
    return low - slack <= stored <= high + slack


def _varied(
    evaluator: Evaluator, place: Position, given: dict[Position, Scalar]
) -> Iterator[Scalar]:
    """What a formula gives when each number that it reads or holds changes in its last digits."""
    for sign in (-1, 1):
        factor = 1 + sign * 1.01 * _DIGITS
        for cell in _numbers_read(evaluator, place):
            base = given.get(cell, evaluator.values[cell])
            if type(base) is float:
                yield evaluator.value(place, {**given, cell: base * factor})
        for index, number in enumerate(evaluator.formulas[place].literals):
            yield evaluator.value(place, given, {(*place, index): number * factor})


def _may_be_stored(evaluator: Evaluator, place: Position, stored: Scalar) -> bool:
    """Whether a stored value is what the formula gives with other last digits of what it reads."""
    for changed in _varied(evaluator, place, {}):
        if changed == stored:
            return True
        if type(changed) is not float or type(stored) is not float:
            continue
        if abs(changed - stored) <= 2 * _DIGITS * abs(stored):
            return True
    return False


def _follows(evaluator: Evaluator, place: Position, stored: Scalar) -> bool:
    """Whether a stored value follows from the stored values of the cells that the formula reads."""
    given: dict[Position, Scalar] = {}
    for cell in _numbers_read(evaluator, place):
        if cell in evaluator.formulas:
            own = evaluator.book[cell].value
            if own is not None and own != evaluator.values.get(cell):
                given[cell] = own
    if not given:
        return False
    value = evaluator.value(place, given)
    if type(value) is float and type(stored) is float:
        if abs(stored - value) <= _DIGITS * abs(value) + evaluator.book.resolution:
            return True
        return _within_last_digits(evaluator, place, stored, value, given)
    return value == stored

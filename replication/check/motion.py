"""How depths grow in numbers without formulas: by one velocity a row, or by the mean of two.

A better method than the report's moves the depth by about the mean of the velocities at both ends
of a step. In one row the digits may not tell that; over many rows they do, since the roundings of a
sum do not grow, while the difference does.
"""

from collections.abc import Callable
from statistics import median
from typing import NamedTuple

from replication.check.six import start_of_row
from replication.check.table import SchemeTable

_PARTS = (8, 4, 3)
"""The depth is compared over these parts of all rows."""
_LEAST_ROWS = 5
"""Of fewer rows it cannot be said."""
BETTER = 0.25
"""So large a share of stretches more tells a way: a wrong number spoils both alike."""


class _Row(NamedTuple):
    """The depth of a row and the velocities at the start of the row and of the one before."""

    k: int
    depth: float
    speed: float
    speed_before: float


def told_from_mean(table: SchemeTable, by_row_before: bool) -> float:
    """How much better the depths grow by one velocity a row than by the mean of two.

    The share of stretches of rows that the one explains, less that of the other: near 1 for the
    report's scheme, near -1 for better methods, and 0 where the digits do not tell. `by_row_before`
    says by which one, as in explicit Euler: that of the row before.
    """
    rows = _rows(table)
    if len(rows) < _LEAST_ROWS:
        return 0.0

    def alone(row: _Row) -> float:
        return row.speed_before if by_row_before else row.speed

    def mean(row: _Row) -> float:
        return (row.speed + row.speed_before) / 2

    lengths = [max(1, len(rows) // part) for part in _PARTS]
    shares = [_followed(table, rows, alone, n) - _followed(table, rows, mean, n) for n in lengths]
    return max(shares, key=abs)


def _rows(table: SchemeTable) -> list[_Row]:
    """The rows from the second step on: most of those without one between that lacks a number."""
    role, lag = start_of_row(table)
    stretches: list[list[_Row]] = [[]]
    for k in range(max(2, min(table.rows) + 1), table.steps + 1):
        numbers = (
            table.number("depth", k), table.number(role, k + lag), table.number(role, k - 1 + lag),
        )  # fmt: skip
        x, u, before = numbers
        if x is None or u is None or before is None:
            stretches.append([])
        else:
            stretches[-1].append(_Row(k, x, u, before))
    return max(stretches, key=len)


def _followed(
    table: SchemeTable, rows: list[_Row], speed: Callable[[_Row], float], length: int
) -> float:
    """The share of stretches of so many rows in which the depth grows by the sum of velocities."""
    depth, line = table.lines["depth"], table.lines[start_of_row(table)[0]]
    sums = [0.0]
    for row in rows:
        sums.append(sums[-1] + speed(row))
    stretches = []
    for first, last in zip(range(len(rows)), range(length, len(rows)), strict=False):
        x, before = rows[last].depth, rows[first].depth
        moved = sums[last + 1] - sums[first + 1]
        error = depth.rounding(x) + depth.rounding(before)
        stretches.append((x - before, moved, error, length * line.rounding(rows[first].speed)))
    step = median(x / moved for x, moved, _, _ in stretches if moved)
    near = (
        abs(x - step * moved) <= error + abs(step) * loss for x, moved, error, loss in stretches
    )
    return sum(near) / len(stretches)

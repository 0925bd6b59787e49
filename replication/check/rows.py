"""Numbers without formulas: the six numbers fitted to the rows, their digits as uncertainty."""

import math
from collections.abc import Sequence
from statistics import median

from replication.check.fit import Fit, fit_formulas
from replication.check.six import (
    REPORT,
    VARIANTS,
    Six,
    end_of_row,
    impact_velocity,
    start_of_row,
    time_step,
)
from replication.check.table import Table

Row = tuple[float, float, float]
"""Depth, velocity (later its square) and deceleration of a row."""
_ENOUGH = 20
"""So many digits in all rows together tell the three numbers of a force."""


def fit_table(table: Table) -> Fit:
    """Fit a table: by its formulas, where it has them, or else by its numbers."""
    return fit_formulas(table) or fit_numbers(table)


def fit_numbers(table: Table) -> Fit:
    """Fit the rows of a table without formulas; of few rows with few digits only the steps."""
    start, end = start_of_row(table), end_of_row(table)
    growth, falls, forces = [], [], []
    shown = "deceleration" in table.lines
    for k in sorted(table.rows):
        x, before = table.number("depth", k), table.number("depth", k - 1)
        u, w = table.number(start[0], k + start[1]), table.number(end[0], k + end[1])
        if x is not None and before is not None and u and k > 1:
            growth.append((x - before) / u)
        if u is None or k < 1:
            continue
        a = table.number("deceleration", k) if shown else None if w is None else u - w
        if a and shown and w is not None:
            falls.append((u - w) / a)
        if a and x is not None:
            forces.append((x, u, a))
    c = _middle(growth)
    e = _middle(falls) if falls else c
    sign = -1.0 if shown and forces and median(a for *_, a in forces) < 0 else 1.0
    force = Six(math.nan, math.nan, math.nan, 1.0, 1.0, 1.0)
    bounded, centered = True, False
    digits = _uncertainty(table)
    slack = digits
    if forces and not shown:  # what velocities fall by has fewer digits than they have
        line = table.lines[start[0]]
        error = 2 * line.rounding(max(u for _, u, _ in forces))
        slack = max(slack, min(0.05, error / (median(abs(a) for *_, a in forces) or 1.0)))
    if -len(forces) * math.log10(slack) > _ENOUGH:
        divisor = sign if shown else e
        rows = [(x, u, a / divisor) for x, u, a in forces]
        force, bounded, centered = _best_force(rows, abs(e), slack)
    six = Six(*force[:3], c, sign * e if falls else c, impact_velocity(table))
    ways = {role: REPORT[role] for role in ("depth", "deceleration", "velocity_final")}
    if centered:
        ways["deceleration"] = VARIANTS["centered"]
    return Fit(
        six, time_step(table), sign, ways, "deceleration" if shown else end[0], slack=slack,
        bounded=bounded, centered=centered, digits=digits,
    )  # fmt: skip


def _best_force(rows: Sequence[Row], e: float, slack: float) -> tuple[Six, bool, bool]:
    """The force that rows (x, u, a) show, whether it is bounded, and whether it is centered.

    It is the report's, unless that misses the rows by more than their digits, and another one by
    a tenth of that at most.
    """
    force = Six(*_least_squares(rows), 1.0, 1.0, 1.0)
    missed = _usual_miss(rows, force)
    if not missed > slack / 4 or len(rows) < 8:
        return force, True, False
    free = Six(*_least_squares(rows, bounded=False), 1.0, 1.0, 1.0)
    if max(x for x, *_ in rows) > free.D / 2 and _usual_miss(rows, free, False) < missed / 10:
        return free, False, False
    central, middle = force, rows
    for _ in range(8):
        middle = [(x, u - e / 2 * central.deceleration(x, u), a) for x, u, a in rows]
        central = Six(*_least_squares(middle), 1.0, 1.0, 1.0)
    if _usual_miss(middle, central) < missed / 10:
        return central, True, True
    return force, True, False


def _usual_miss(rows: Sequence[Row], six: Six, bounded: bool = True) -> float:
    """The median of the relative deviations of rows from a fit; infinite if there is no fit."""
    miss = median(abs(six.deceleration(x, u, bounded) / a - 1) for x, u, a in rows)
    return miss if math.isfinite(miss) else math.inf


def _uncertainty(table: Table) -> float:
    """The relative uncertainty of what is fitted to typed numbers, by the digits of these."""
    worst = 1e-9
    for role, line in table.lines.items():
        sizes = [abs(value) for value in line.values.values() if value]
        if role != "time" and sizes:
            worst = max(worst, line.rounding(median(sizes)) / median(sizes))
    return min(0.05, 4 * worst)


def _middle(values: Sequence[float]) -> float:
    """The mean of the middle half of some numbers; NaN if there are none."""
    ordered = sorted(values)
    quarter = len(ordered) // 4
    kept = ordered[quarter : len(ordered) - quarter]
    return math.fsum(kept) / len(kept) if kept else math.nan


def _least_squares(rows: Sequence[Row], bounded: bool = True) -> tuple[float, float, float]:
    """G, H and D with a = (G u² + H)(D x - x²), constant beyond D/2 if `bounded`, by least squares.

    A wrong number spoils a third of the rows; the fit to the others misses least of all rows, and
    is repeated without those that it misses.
    """
    nan = (math.nan, math.nan, math.nan)
    if len(rows) < 4:
        return nan
    X, U, A = (max(abs(row[i]) for row in rows) or 1.0 for i in range(3))
    data = [(x / X, (u / U) ** 2, a / A) for x, u, a in rows]
    thirds = [data[i::3] for i in range(3)] if len(data) >= 12 else []
    # Where most rows are beyond the radius, only the first ones tell the sphere.
    shallow = [data[: len(data) // n] for n in (2, 4, 8, 16) if len(data) // n >= 8]
    fits = [
        six
        for part in (data, *thirds, *shallow)
        if (six := _three_numbers(part, None, bounded)) is not None
    ]
    if not fits:
        return nan
    best = min(fits, key=lambda six: median(_misses(data, six, bounded)))
    for _ in range(3):
        kept = _without_outliers(data, best, bounded)
        best = _three_numbers(kept, best, bounded) or best
    return best.G * A / (U * X) ** 2, best.H * A / X**2, best.D * X


def _three_numbers(data: Sequence[Row], start: Six | None, bounded: bool) -> Six | None:
    """G, H and D of scaled rows (x, u², a) by Gauss-Newton; None if they do not tell."""
    guess = start[:3] if start is not None else _linear(data)
    if guess is None:
        return None
    G, H, D = guess
    for _ in range(40):
        matrix = [[0.0] * 3 for _ in range(3)]
        right = [0.0] * 3
        for x, w, a in data:
            inside = x < D / 2 or not bounded
            area = D * x - x * x if inside else D * D / 4
            gradient = (w * area, area, (G * w + H) * (x if inside else D / 2))
            rest = a - (G * w + H) * area
            weight = 1.0 / max(abs(a), 1e-6) ** 2
            for i in range(3):
                right[i] += weight * gradient[i] * rest
                for j in range(3):
                    matrix[i][j] += weight * gradient[i] * gradient[j]
        change = _solved(matrix, right)
        if change is None:
            return None
        G, H, D = G + change[0], H + change[1], D + change[2]
        if not all(map(math.isfinite, (G, H, D))):
            return None
        if max(abs(d) for d in change) < 1e-15 * max(abs(G), abs(H), abs(D)):
            break
    return Six(G, H, D, 1.0, 1.0, 1.0)


def _misses(data: Sequence[Row], six: Six, bounded: bool) -> list[float]:
    """The relative deviation of each row from a fit."""
    return [
        abs(six.deceleration(x, math.sqrt(max(w, 0.0)), bounded) - a) / max(abs(a), 1e-6)
        for x, w, a in data
    ]  # fmt: skip


def _without_outliers(data: list[Row], six: Six, bounded: bool) -> list[Row]:
    """The rows whose deviation from a fit is not far above the usual one."""
    off = _misses(data, six, bounded)
    most = 20 * median(off) + 1e-13
    kept = [row for row, deviation in zip(data, off, strict=True) if deviation <= most]
    return kept if len(kept) >= max(4, 0.7 * len(data)) else data


def _linear(data: Sequence[Row]) -> tuple[float, float, float] | None:
    """A first guess: a / x is linear in w = u², w x, 1 and x."""
    matrix = [[0.0] * 4 for _ in range(4)]
    right = [0.0] * 4
    for x, w, a in data:
        terms = (w, w * x, 1.0, x)
        for i in range(4):
            right[i] += terms[i] * a / x if x else 0.0
            for j in range(4):
                matrix[i][j] += terms[i] * terms[j] if x else 0.0
    solved = _solved(matrix, right)
    if solved is None:
        return None
    GD, G, HD, H = solved[0], -solved[1], solved[2], -solved[3]
    guesses = [a / b for a, b in ((GD, G), (HD, H)) if a > 0 and b > 0]
    D = guesses[-1] if guesses else 2.0
    return GD / D, HD / D, D


def _solved(matrix: list[list[float]], right: list[float]) -> list[float] | None:
    """The solution of a few linear equations by elimination; None if they are singular."""
    size = len(right)
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for i in range(size):
        pivot = max(range(i, size), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        if not rows[i][i] or not math.isfinite(rows[i][i]):
            return None
        for r in range(i + 1, size):
            factor = rows[r][i] / rows[i][i]
            for column in range(i, size + 1):
                rows[r][column] -= factor * rows[i][column]
    solution = [0.0] * size
    for i in reversed(range(size)):
        rest = rows[i][size] - sum(rows[i][j] * solution[j] for j in range(i + 1, size))
        solution[i] = rest / rows[i][i]
    return solution

"""Numbers without formulas: the six numbers fitted to the rows, with what their digits admit."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from statistics import median
from typing import NamedTuple

from replication.check.fit import TableFit, fit_formulas
from replication.check.gaps import renumbered
from replication.check.motion import BETTER, told_from_mean
from replication.check.six import (
    EXACT,
    REPORT,
    VARIANTS,
    Errors,
    Six,
    Variant,
    end_of_row,
    impact_velocity,
    start_of_row,
)
from replication.check.table import (
    SchemeTable,
    with_only_velocity_at_end,
    with_only_velocity_at_start,
)

_ENOUGH = 20
"""So many digits in all rows together tell the three numbers of a force."""
_FAR = 3.0
"""A row whose deviation is so many times what its digits admit is not explained."""
MOST = 0.5
"""A larger share of rows is most of them."""
_TOLD = 0.1
"""Rows that do not tell the diameter to this part of itself do not tell another way."""
_BEYOND = 0.999
"""A diameter of this part of twice the first depth has all rows beyond its radius."""
_FEW = 6
"""Of fewer rows it cannot be said that most follow another method."""
_FIRST_ROWS = 6
"""So many rows are tried as the only ones before the depth R."""
_MANY = 200
"""Of more rows than twice these, so many come near a centered force; the last turn takes all."""
_SMALL = 1e-6
"""Of decelerations that are a smaller part of the largest one, the absolute error counts."""
_LEAST = 1e-280
"""A deceleration is larger: the square of its error is to be a double."""
_SETTLED = EXACT / 1000
"""A fit ends when a step changes its numbers by less: further steps change no digit that counts."""
_RIDGE = 1e-12
"""What is added to each pivot, so that numbers that the rows do not tell stay where they are."""


class ForceRow(NamedTuple):
    """Depth, velocity and deceleration, and the relative error of this that the digits admit."""

    x: float
    u: float
    a: float
    error: float


class ForceOfRows(NamedTuple):
    """G, H and D of a force, what the digits admit as their relative errors, and its ways."""

    G: float
    H: float
    D: float
    errors: tuple[float, float, float] = (math.inf, math.inf, math.inf)
    bounded: bool = True
    centered: bool = False

    def at(self, x: float, u: float) -> float:
        """The deceleration at a depth and a velocity."""
        half = self.D / 2
        area = self.D * x - x * x if x < half or not self.bounded else half * half
        return (self.G * u * u + self.H) * area


def fit_table(table: SchemeTable) -> tuple[SchemeTable, TableFit]:
    """Fit a table: by its formulas, where it has them, or else by its numbers.

    Two formulas may share a column, a wrong one that most cells have and a right one that at least
    a quarter has: the table is returned with the right one as that which its cells should have.
    """
    fitted = fit_formulas(table)
    if fitted is None:
        return _fit_numbers_either_way(renumbered(table))
    for trial in _with_rarer_formulas(table) if fitted.odd else ():
        again = fit_formulas(trial)
        if again is not None and again.probe is not None and not again.odd:
            return trial, again
    return table, fitted


def _with_rarer_formulas(table: SchemeTable) -> Iterator[SchemeTable]:
    """The table with the second formula of one of its columns in place of the usual one."""
    for line in (*table.lines.values(), *table.helpers):
        for shape, count in line.shapes.most_common(2)[1:]:
            if line.usual is not None and shape is not line.usual and 4 * count >= len(line.values):
                rarer = replace(line, meant=shape)
                lines = {r: rarer if o is line else o for r, o in table.lines.items()}
                helpers = tuple(rarer if o is line else o for o in table.helpers)
                yield replace(table, lines=lines, helpers=helpers, places={})


def _fit_numbers_either_way(table: SchemeTable) -> tuple[SchemeTable, TableFit]:
    """Fit a table without formulas, whose only velocity may be that at the start of its rows.

    If the depth grows by the velocity in the row before, this is the one at the end of that row in
    the report's scheme. In explicit Euler it is the one at its start: only the force tells.
    """
    table = _with_velocity_told(table)
    plain = fit_numbers(table, only_report=True)
    if plain.followed == 1:
        return table, plain
    trial = with_only_velocity_at_start(table)
    if trial is None:
        return table, fit_numbers(table)
    way = VARIANTS["explicit Euler"]
    euler = fit_numbers(trial, way, only_report=True)
    if euler.followed == 1:
        return trial, euler
    if euler.followed > max(MOST, plain.followed):
        return trial, fit_numbers(trial, way)
    return table, fit_numbers(table)


def _with_velocity_told(table: SchemeTable) -> SchemeTable:
    """The table with its only velocity at the end of the rows, if sums of many rows tell that.

    Single rows of few digits may fit both ways.
    """
    trial = with_only_velocity_at_end(table)
    if trial is None or told_from_mean(table, by_row_before=True) <= BETTER:
        return table
    return table if told_from_mean(table, by_row_before=False) > BETTER else trial


def fit_numbers(
    table: SchemeTable, growth: Variant = REPORT["depth"], only_report: bool = False
) -> TableFit:
    """Fit the rows of a table without formulas; of few rows with few digits only the steps.

    `growth` is the way in which the depth grows: the report's, or explicit Euler. `only_report`
    tries no other force than the report's.
    """
    end, shown = end_of_row(table), "deceleration" in table.lines
    growths = list(_growths(table, growth is VARIANTS["explicit Euler"]))
    c, c_error = _common_ratio(growths)
    falls = list(_falls_over_brake(table)) if shown else []
    e, e_error = _common_ratio(falls) if shown else (c, c_error)
    rows = list(_forces(table))
    sign = -1.0 if shown and rows and median(row.a for row in rows) < 0 else 1.0
    divisor = sign if shown else e
    rows = _of_one_scale([row._replace(a=row.a / divisor) for row in rows if divisor])
    rough = median(row.error for row in rows) if rows else EXACT
    force = ForceOfRows(math.nan, math.nan, math.nan)
    if rows and math.isfinite(e) and -len(rows) * math.log10(rough) > _ENOUGH:
        force = _fitted_force(rows) if only_report else _best_force(rows, abs(e))
    time, time_error = _common_ratio(list(_time_steps(table)))
    V = impact_velocity(table)
    speed = table.lines["velocity_initial" if "velocity_initial" in table.lines else end[0]]
    V_error = speed.rounding(V) / abs(V) if V else math.inf
    six = Six(force.G, force.H, force.D, c, sign * e, V)
    ways = {role: REPORT[role] for role in ("depth", "deceleration", "velocity_final")}
    ways["depth"] = growth
    if force.centered:
        ways["deceleration"] = VARIANTS["centered"]
    shares = [_share_near(growths, c), _share_near(falls, e), _share_explained(rows, force, e)]
    told = told_from_mean(table, growth is VARIANTS["explicit Euler"])
    if told < -BETTER:
        shares.append(0.0)
    return TableFit(
        six, time, sign, ways, "deceleration" if shown else end[0],
        bounded=force.bounded, centered=force.centered, digits=_fewest_digits(table), rough=rough,
        errors=Errors(*force.errors, c_error, e_error, V_error), time_error=time_error,
        followed=min(shares), told=told > BETTER,
    )  # fmt: skip


def _share_near(ratios: Sequence[tuple[float, float]], middle: float) -> float:
    """The share of ratios that are a constant as far as their errors tell; 1 if there are few."""
    if len(ratios) < _FEW or not math.isfinite(middle):
        return 1.0
    close = ((abs(ratio - middle), _FAR * error + EXACT * abs(middle)) for ratio, error in ratios)
    return sum(off <= most for off, most in close) / len(ratios)


def explains_as_well(table: SchemeTable, fitted: TableFit, six: Six, centered: bool) -> bool:
    """Whether the force of other six numbers explains as many rows as the one fitted to them."""
    divisor = fitted.sign if "deceleration" in table.lines else fitted.six.e
    rows = _of_one_scale([row._replace(a=row.a / divisor) for row in _forces(table) if divisor])
    own, trial = (
        ForceOfRows(n.G, n.H, n.D, bounded=bounded, centered=middle)
        for n, bounded, middle in (
            (fitted.six, fitted.bounded, fitted.centered), (six, True, centered),
        )
    )  # fmt: skip
    shares = [_share_explained(rows, force, fitted.six.e) for force in (trial, own)]
    return len(rows) >= _FEW and shares[0] >= shares[1]


def _share_explained(rows: Sequence[ForceRow], force: ForceOfRows, e: float) -> float:
    """The share of rows that a force explains; 1 if there are few, or if they tell no force."""
    if len(rows) < _FEW or not all(map(math.isfinite, force[:3])):
        return 1.0
    if force.centered:
        rows = [row._replace(u=row.u - abs(e) / 2 * force.at(row.x, row.u)) for row in rows]
    return _explained(rows, force) / len(rows)


# ---- the rows


def _speeds(table: SchemeTable, k: int) -> tuple[float | None, float | None]:
    """The velocities at the start and at the end of row k."""
    (start, lag), (end, ahead) = start_of_row(table), end_of_row(table)
    return table.number(start, k + lag), table.number(end, k + ahead)


def _time_steps(table: SchemeTable) -> Iterator[tuple[float, float]]:
    """By how much the time grows, row by row, and the error by the digits."""
    for k in sorted(table.rows):
        now, before = table.number("time", k), table.number("time", k - 1)
        if now is not None and before is not None:
            line = table.lines["time"]
            yield now - before, line.rounding(now) + line.rounding(before)


def _growths(table: SchemeTable, by_row_before: bool) -> Iterator[tuple[float, float]]:
    """By how much the depth grows over the velocity, row by row, and the error by the digits.

    It grows by the velocity at the start of the row, or of the row before, as in explicit Euler.
    """
    depth, speed = table.lines["depth"], table.lines[start_of_row(table)[0]]
    for k in sorted(table.rows):
        x, before = table.number("depth", k), table.number("depth", k - 1)
        u, _ = _speeds(table, k - by_row_before)
        if x is not None and before is not None and u and k > 1:
            error = depth.rounding(x) + depth.rounding(before)
            error += abs(x - before) * speed.rounding(u) / abs(u)
            yield (x - before) / u, error / abs(u)


def _falls_over_brake(table: SchemeTable) -> Iterator[tuple[float, float]]:
    """By how much the velocity falls over the deceleration, and the error by the digits."""
    start, end = (table.lines[at(table)[0]] for at in (start_of_row, end_of_row))
    brake = table.lines["deceleration"]
    for k in sorted(table.rows):
        a, (u, w) = table.number("deceleration", k), _speeds(table, k)
        if a and u is not None and w is not None and k >= 1:
            error = start.rounding(u) + end.rounding(w) + abs(u - w) * brake.rounding(a) / abs(a)
            yield (u - w) / a, error / abs(a)


def _forces(table: SchemeTable) -> Iterator[ForceRow]:
    """The rows by which a force is fitted: of decelerations, or of what the velocity falls by."""
    start, end = (table.lines[at(table)[0]] for at in (start_of_row, end_of_row))
    depth, brake = table.lines["depth"], table.lines.get("deceleration")
    for k in sorted(table.rows):
        x, (u, w) = table.number("depth", k), _speeds(table, k)
        if not x or not u or k < 1:
            continue
        if brake is not None:
            a = table.number("deceleration", k)
            error = brake.rounding(a) if a else 0.0
        else:
            a = None if w is None else u - w
            error = 0.0 if w is None else start.rounding(u) + end.rounding(w)
        if a:
            error = error / abs(a) + depth.rounding(x) / abs(x) + 2 * start.rounding(u) / abs(u)
            yield ForceRow(x, u, a, max(EXACT, error))


def _of_one_scale(rows: Sequence[ForceRow]) -> list[ForceRow]:
    """The rows; a deceleration far below the largest one counts no more than that shows."""
    least = _SMALL * max((abs(row.a) for row in rows), default=0.0)
    some = [row for row in rows if _LEAST < abs(row.a) < math.inf]
    return [row._replace(error=row.error * max(1.0, least / abs(row.a))) for row in some]


def _fewest_digits(table: SchemeTable) -> float:
    """The relative uncertainty of the numbers as typed, in the column with the fewest digits."""
    worst = 1e-9
    for role, line in table.lines.items():
        sizes = [abs(value) for value in line.values.values() if value]
        if role != "time" and sizes:
            worst = max(worst, line.rounding(median(sizes)) / median(sizes))
    return min(0.05, 4 * worst)


def _common_ratio(ratios: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """The constant that most of some ratios show, and its relative error; NaN if there is none.

    Each ratio has an error by its digits; those that are far from the middle are left out.
    """
    if not ratios:
        return math.nan, math.inf
    best = sorted(ratios, key=lambda entry: entry[1])[: max(3, len(ratios) // 2)]
    middle = median(ratio for ratio, _ in best)
    if not middle or not math.isfinite(middle):
        return middle, math.inf
    usual = median(abs(ratio / middle - 1) for ratio, _ in best)
    parts = [(ratio / middle - 1, error / abs(middle) + 1e-15) for ratio, error in ratios]
    near = [(off, error) for off, error in parts if abs(off) <= _FAR * (error + usual)]
    weights = [error**-2 for _, error in near]
    total = math.fsum(weights)
    off = math.fsum(w * off for w, (off, _) in zip(weights, near, strict=True)) / total
    error = math.fsum(w * error for w, (_, error) in zip(weights, near, strict=True)) / total
    return middle * (1 + off), max(EXACT, error)


# ---- the force


def _best_force(rows: Sequence[ForceRow], e: float) -> ForceOfRows:
    """The force that rows show: the report's, unless another way explains three more rows."""
    force = _fitted_force(rows)
    explained = _explained(rows, force)
    if explained == len(rows) or len(rows) < 8:
        return force
    others = []
    free = _fitted_force(rows, bounded=False)
    if max(row.x for row in rows) > free.D / 2:
        others.append((_explained(rows, free), free))
    central, middle = force, list(rows)
    for turn in range(8):
        some = rows[:: 1 if turn == 7 else max(1, len(rows) // _MANY)]
        middle = [row._replace(u=row.u - e / 2 * central.at(row.x, row.u)) for row in some]
        central = _fitted_force(middle)
    others.append((_explained(middle, central), central._replace(centered=True)))
    others = [entry for entry in others if entry[1].errors[2] <= _TOLD]
    count, best = max(others, key=lambda entry: entry[0], default=(0, force))
    better = count >= explained + 3 and count > len(rows) / 2
    return best if better else force


def _explained(rows: Sequence[ForceRow], force: ForceOfRows) -> int:
    """How many rows a force explains by their digits."""
    return sum(miss <= _FAR for miss in _misses(rows, force))


def _misses(rows: Sequence[ForceRow], force: ForceOfRows) -> list[float]:
    """The deviation of each row from a force, over what its digits admit."""
    return [abs(force.at(row.x, row.u) - row.a) / (row.error * abs(row.a)) for row in rows]


def _fitted_force(rows: Sequence[ForceRow], bounded: bool = True) -> ForceOfRows:
    """G, H and D with a = (G u² + H)(D x - x²), constant beyond D/2 if `bounded`.

    Wrong rows spoil a fit. So several starts are tried; the best one misses most rows by little,
    and is repeated without those that it misses.
    """
    lost = ForceOfRows(math.nan, math.nan, math.nan, bounded=bounded)
    if len(rows) < 4:
        return lost
    X, U, A = (max(abs(row[i]) for row in rows) or 1.0 for i in range(3))
    scaled = [row._replace(x=row.x / X, u=row.u / U, a=row.a / A) for row in rows]
    fits: list[ForceOfRows] = []
    for force in _trials(scaled, bounded):
        fits.append(force)
        if _explained(scaled, force) == len(scaled):
            break
    if not fits:
        return lost
    best = min(fits, key=lambda force: _loss(scaled, force))
    for _ in range(3):
        kept = _without_outliers(scaled, best)
        best = _three_numbers(kept, best, bounded) or best
    G, H, D = best.G * A / (U * X) ** 2, best.H * A / X**2, best.D * X
    errors = _errors_admitted(_without_outliers(scaled, best), best)
    if bounded and _may_be_beyond(scaled, best):
        errors = (math.inf, math.inf, math.inf)
    return ForceOfRows(G, H, D, errors, bounded)


def _may_be_beyond(rows: Sequence[ForceRow], force: ForceOfRows) -> bool:
    """Whether all rows may be beyond the depth D/2, so that they tell no diameter.

    They are so for a diameter below twice the first depth. The force that is the same there
    explains as many rows, if not.
    """
    D = 2 * _BEYOND * min(row.x for row in rows)
    if not 0 < D < force.D:
        return 0 < force.D <= D
    times = (force.D / D) ** 2
    smaller = force._replace(G=force.G * times, H=force.H * times, D=D)
    return _explained(rows, smaller) >= _explained(rows, force)


def _trials(rows: Sequence[ForceRow], bounded: bool) -> Iterator[ForceOfRows]:
    """The forces of all rows, and of parts of them without a wrong one."""
    thirds = [rows[i::3] for i in range(3)] if len(rows) >= 12 else []
    # Where most rows are beyond the radius, only the first ones tell the sphere.
    shallow = [rows[: len(rows) // n] for n in (2, 4, 8, 16) if len(rows) // n >= 8]
    for part in (rows, *thirds, *shallow):
        if (force := _three_numbers(part, _linear(part), bounded)) is not None:
            yield force
    if bounded:
        yield from _mostly_beyond(rows)


def _loss(rows: Sequence[ForceRow], force: ForceOfRows) -> float:
    """How badly a force fits: a row that is far off counts little more than one that is off."""
    return math.fsum(math.log1p(miss * miss) for miss in _misses(rows, force))


def _mostly_beyond(rows: Sequence[ForceRow]) -> Iterator[ForceOfRows]:
    """Forces by which all rows but the first few are beyond the depth D/2.

    There a = p u² + q with p = G D²/4 and q = H D²/4. With y = 2 x/D, a row before that has
    a / (p u² + q) = 2 y - y².
    """
    for first in range(1, min(_FIRST_ROWS, len(rows) - 3)):
        beyond = rows[first:]
        matrix, right = [[0.0] * 2 for _ in range(2)], [0.0] * 2
        for row in beyond:
            terms, weight = (row.u * row.u, 1.0), (row.error * row.a) ** -2
            for i in range(2):
                right[i] += weight * terms[i] * row.a
                for j in range(2):
                    matrix[i][j] += weight * terms[i] * terms[j]
        solved = _linear_solution(matrix, right)
        if solved is None:
            continue
        p, q = solved
        for row in rows[:first]:
            share = row.a / (p * row.u * row.u + q) if p * row.u * row.u + q else 2.0
            if 0 < share < 1:
                D = 2 * row.x / (1 - math.sqrt(1 - share))
                force = ForceOfRows(4 * p / D**2, 4 * q / D**2, D)
                if (fitted := _three_numbers(rows, force, True)) is not None:
                    yield fitted


def _gradient(row: ForceRow, force: ForceOfRows) -> tuple[float, float, float]:
    """The derivatives of the deceleration by G, H and D."""
    x, square, half = row.x, row.u * row.u, force.D / 2
    inside = x < half or not force.bounded
    area = force.D * x - x * x if inside else half * half
    return square * area, area, (force.G * square + force.H) * (x if inside else half)


def _normal(rows: Sequence[ForceRow], force: ForceOfRows) -> tuple[list[list[float]], list[float]]:
    """The normal equations of a change of G, H and D, each row with the weight of its digits."""
    GG = GH = GD = HH = HD = DD = G_rest = H_rest = D_rest = 0.0
    for row in rows:
        by_G, by_H, by_D = _gradient(row, force)
        weight = (row.error * row.a) ** -2
        weighted = weight * (row.a - force.at(row.x, row.u))
        G_rest += by_G * weighted
        H_rest += by_H * weighted
        D_rest += by_D * weighted
        GG += weight * by_G * by_G
        GH += weight * by_G * by_H
        GD += weight * by_G * by_D
        HH += weight * by_H * by_H
        HD += weight * by_H * by_D
        DD += weight * by_D * by_D
    ridge = 1 + _RIDGE
    matrix = [[GG * ridge, GH, GD], [GH, HH * ridge, HD], [GD, HD, DD * ridge]]
    return matrix, [G_rest, H_rest, D_rest]


def _three_numbers(
    rows: Sequence[ForceRow], start: ForceOfRows | None, bounded: bool
) -> ForceOfRows | None:
    """G, H and D of rows by Gauss-Newton from a start; None if they do not tell."""
    if start is None:
        return None
    force = start._replace(bounded=bounded)
    for _ in range(40):
        change = _linear_solution(*_normal(rows, force))
        if change is None:
            return None
        force = force._replace(G=force.G + change[0], H=force.H + change[1], D=force.D + change[2])
        if not all(map(math.isfinite, force[:3])):
            return None
        if max(map(abs, change)) < _SETTLED * max(map(abs, force[:3])):
            break
    return force


def _errors_admitted(rows: Sequence[ForceRow], force: ForceOfRows) -> tuple[float, float, float]:
    """The relative errors of G, H and D that the digits of the rows admit, to first order.

    Digits are cut by anything up to half of the last one, not by chance: so errors add up as they
    are.
    """
    matrix, _ = _normal(rows, force)
    columns = [_linear_solution(matrix, [float(i == j) for i in range(3)]) for j in range(3)]
    if any(column is None for column in columns):
        return (math.inf, math.inf, math.inf)
    errors = []
    for column, number in zip(columns, force[:3], strict=True):
        error = math.fsum(
            abs(math.fsum(c * g for c, g in zip(column or (), _gradient(row, force), strict=True)))
            / (row.error * abs(row.a))
            for row in rows
        )
        errors.append(max(EXACT, error / abs(number)) if number else math.inf)
    return (errors[0], errors[1], errors[2])


def _without_outliers(rows: list[ForceRow], force: ForceOfRows) -> list[ForceRow]:
    """The rows whose deviation from a force is not far above the usual one, and their digits."""
    off = _misses(rows, force)
    most = max(_FAR, 20 * median(off))
    kept = [row for row, deviation in zip(rows, off, strict=True) if deviation <= most]
    return kept if len(kept) >= max(4, 0.7 * len(rows)) else rows


def _linear(rows: Sequence[ForceRow]) -> ForceOfRows | None:
    """A first guess: a / x is linear in w = u², w x, 1 and x."""
    matrix = [[0.0] * 4 for _ in range(4)]
    right = [0.0] * 4
    for row in rows:
        w = row.u * row.u
        terms = (w, w * row.x, 1.0, row.x)
        for i in range(4):
            right[i] += terms[i] * row.a / row.x
            for j in range(4):
                matrix[i][j] += terms[i] * terms[j]
    solved = _linear_solution(matrix, right)
    if solved is None:
        return None
    GD, G, HD, H = solved[0], -solved[1], solved[2], -solved[3]
    guesses = [a / b for a, b in ((GD, G), (HD, H)) if a > 0 and b > 0]
    D = guesses[-1] if guesses else 2.0
    return ForceOfRows(GD / D, HD / D, D)


def _linear_solution(matrix: list[list[float]], right: list[float]) -> list[float] | None:
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

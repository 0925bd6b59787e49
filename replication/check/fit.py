"""What the formulas of a table do: one row is probed, and fitted to six numbers.

A row that has the usual formulas is given states that are independent of each other: depths and
velocities of its own row and of its neighbours. Which of these its formulas answer to, and how,
tells the way in which each column is filled.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from statistics import median
from typing import NamedTuple

from replication.check.six import (
    EXACT,
    REPORT,
    ROUNDED,
    VARIANTS,
    Errors,
    Six,
    State,
    Variant,
    end_of_row,
    impact_velocity,
    start_of_row,
    time_step,
)
from replication.check.table import SchemeTable
from spreadsheets.foreign import Position
from spreadsheets.scalars import LiteralKey, Scalar

CellNumbers = Mapping[Position, Scalar]
Literals = Mapping[LiteralKey, float]
"""What takes the place of cells, and of numbers typed into formulas."""
_ROUGH = 1e-7
"""Relative difference up to which a force fits: its terms lose some digits to each other."""


class Probe:
    """One row of a table, whose formulas are evaluated in other states and with other inputs."""

    def __init__(self, table: SchemeTable, k: int) -> None:
        self.table, self.k, self.evaluator = table, k, table.evaluator
        self.state: dict[State, Position] = {
            (role, d): table.place(role, k + d)
            for role in table.lines
            for d in (-1, 0, 1)
            if table.number(role, k + d) is not None
        }
        self.base: dict[State, float] = {}
        for role, d in self.state:
            value = table.number(role, k + d)
            later = table.number(role, k + d + 1)
            # A first depth of zero would hide what depends on it.
            self.base[role, d] = value or (later / 2 if later else 1.0)
        near = {table.rows[k + d] for d in (-1, 0, 1) if k + d in table.rows}
        self.stop = set(table.places) | {
            line.place(i) for line in table.helpers for i in line.values if i not in near
        }
        self._cones: dict[Position, frozenset[Position]] = {}

    def cone(self, place: Position) -> frozenset[Position]:
        """The formulas behind a cell that belong to its row, or to no row."""
        if place not in self._cones:
            self._cones[place] = self.evaluator.cone([place], self.stop - {place})
        return self._cones[place]

    def scalar(
        self, place: Position, state: Mapping[State, float],
        cells: Mapping[Position, Scalar], literals: Mapping[LiteralKey, float],
    ) -> Scalar:  # fmt: skip
        """What a cell gives in a state: a number, a text, or an error."""
        replaced: dict[Position, Scalar] = {
            p: state.get(name, self.base[name]) for name, p in self.state.items() if p != place
        }
        replaced |= cells
        return self.evaluator.value(place, replaced, literals, self.cone(place))

    def value(
        self, place: Position, state: Mapping[State, float],
        cells: Mapping[Position, Scalar], literals: Mapping[LiteralKey, float],
    ) -> float:  # fmt: skip
        """The number of a cell in a state; NaN if it is none."""
        value = self.scalar(place, state, cells, literals)
        return value if type(value) is float else math.nan

    def answers(self, place: Position) -> list[State]:
        """The cells of the state to which the formula of a cell responds."""
        first = self.value(place, {}, {}, {})
        names = []
        for name, value in self.base.items():
            if self.state[name] == place:
                continue
            changed = self.value(place, {name: value * 1.25}, {}, {})
            if not math.isclose(changed, first, rel_tol=1e-13) and changed == changed:
                names.append(name)
        return names


@dataclass(frozen=True)
class Force:
    """A deceleration as the formulas give it by the depth `x` and the velocity `u` of a state.

    Where no column shows it, it is the fall of the velocity over `e`.
    """

    probe: Probe
    place: Position
    x: State
    u: State
    sign: float
    e: float | None = None
    cells: CellNumbers | None = None
    literals: Literals | None = None

    def __call__(self, depth: float, speed: float) -> float:
        """The deceleration at a depth and a velocity, positive; NaN if it is no number."""
        state = {self.x: depth, self.u: speed}
        value = self.probe.value(self.place, state, self.cells or {}, self.literals or {})
        return self.sign * value if self.e is None else (speed - value) / self.e


@dataclass(frozen=True)
class TableFit:
    """What the formulas of a table do, or its numbers where it has none.

    `six` are its numbers, `time` is by how much the time grows, `sign` is -1 where decelerations
    are negative. `ways` are the ways in which columns are filled, None for a formula that follows
    none; `brakes` is the column in which the force is seen. `force` is missing if there is none,
    or if there are no formulas; so is then `probe`. `time_adds` and `depth_adds` say whether the
    formula of a time or a depth adds to the one before, or is a sum by itself. `errors` are the
    relative errors of the six that digits admit, and `time_error` that of the time. Of
    numbers without formulas `bounded` says whether the area stays the same beyond D/2, `digits` is
    the relative uncertainty of the numbers as typed, `rough` that of the decelerations they show,
    `followed` is the least share of its rows that a column has as its numbers give it, and `told`
    says whether they tell that the depth grows by one velocity and not by the mean of two.
    """

    six: Six
    time: float | None
    sign: float
    ways: Mapping[str, Variant | None]
    brakes: str
    force: Force | None = None
    centered: bool = False
    probe: Probe | None = None
    errors: Errors = ROUNDED
    time_error: float = EXACT
    time_adds: bool = False
    depth_adds: bool = True
    bounded: bool = True
    digits: float = EXACT
    rough: float = EXACT
    followed: float = 1.0
    told: bool = True

    @property
    def odd(self) -> list[Variant | None]:
        """The ways that are not the report's."""
        return [way for role, way in self.ways.items() if way is not REPORT[role]]


def fit_formulas(table: SchemeTable) -> TableFit | None:
    """Fit a table by its formulas; None if it has none, or if they answer to nothing."""
    k = _row_to_probe(table)
    speed = table.lines[start_of_row(table)[0]]
    if k is None or not (table.lines["depth"].computed and speed.computed):
        return None
    fitted = _probed(table, Probe(table, k))
    known = any(math.isfinite(x) and x for x in fitted.six[2:5])
    return fitted if known else None


def _row_to_probe(table: SchemeTable) -> int | None:
    """A row in the middle in which all columns have their usual formulas."""
    formulas = table.evaluator.formulas
    computed = [
        (role, line.usual)
        for role, line in table.lines.items()
        if role != "time" and line.usual is not None
    ]
    helpers = [(line, line.usual) for line in table.helpers if line.usual is not None]
    candidates = []
    for k in table.rows:
        if k < 2 or k - 1 not in table.rows or k + 1 not in table.rows:
            continue
        own = sum(formulas.get(table.place(role, k)) is shape for role, shape in computed)
        own += sum(formulas.get(line.place(table.rows[k])) is shape for line, shape in helpers)
        later = sum(formulas.get(table.place(role, k + 1)) is shape for role, shape in computed)
        straight = table.rows[k + 1] - table.rows[k - 1] == 2
        candidates.append((-own - later, -own, not straight, abs(k - table.steps // 2), k))
    return min(candidates)[-1] if candidates else None


def _probed(table: SchemeTable, probe: Probe) -> TableFit:
    """The fit of a table by the answers of one row."""
    start, end, brake = start_of_row(table), end_of_row(table), ("deceleration", 0)
    ways: dict[str, Variant | None] = {}
    c, ways["depth"] = _advance(table, probe)
    falls, e, sign = probe.state[end], c, 1.0
    line = table.lines.get("deceleration")
    if line is not None:
        sign = -1.0 if line.computed and _is_negative(table, probe) else 1.0
        e, ways["velocity_final"] = _fall(probe, falls, start, sign)
        if ways["velocity_final"] is REPORT["velocity_final"] and math.isnan(e):
            e = c  # the velocity repeats the force in its own formula
    adds = ("time", 0) in probe.state and ("time", -1) in probe.answers(probe.state["time", 0])
    six = Six(math.nan, math.nan, math.nan, c, e, impact_velocity(table))
    grows = ("depth", -1) in probe.answers(probe.state["depth", 0])
    fitted = TableFit(
        six,
        _time_of(table, probe, adds),
        sign,
        ways,
        end[0],
        probe=probe,
        time_adds=adds,
        depth_adds=grows,
    )
    if line is not None and not line.computed:
        return replace(fitted, brakes="deceleration")
    place = falls if line is None else probe.state[brake]
    read = probe.answers(place)
    x, u = _depth_of(read), _velocity_of(read, start)
    fitted = replace(fitted, brakes=end[0] if line is None else "deceleration")
    if x is None and not any(role != "depth" for role, _ in read):
        return replace(fitted, ways={**ways, "deceleration": None})
    force = Force(probe, place, x or ("depth", 0), u or start, sign, e if line is None else None)
    numbers, way, centered = _numbers_of(force, table, e)
    if way is REPORT["deceleration"] and numbers[0] * numbers[1] < 0:
        way = None  # the one part of the force drives what the other one brakes
        if ways.get("velocity_final") is VARIANTS["sign of the deceleration"]:
            ways["velocity_final"] = REPORT["velocity_final"]
            fitted = replace(fitted, sign=-sign)
    elif way is REPORT["deceleration"]:
        way = _as_read(x, u, read, probe, end)
    return replace(
        fitted, six=Six(*numbers, *six[3:]), ways={**ways, "deceleration": way}, force=force,
        centered=centered,
    )  # fmt: skip


def _time_of(table: SchemeTable, probe: Probe, adds: bool) -> float | None:
    """By how much the time grows: by the formula itself, if it agrees with the numbers.

    It loses no digits where the times are large.
    """
    step = time_step(table)
    if adds and step is not None:
        alone = probe.value(probe.state["time", 0], {("time", -1): 1e-200}, {}, {})
        return alone if math.isclose(alone, step, rel_tol=1e-6) else step
    return step


def _is_negative(table: SchemeTable, probe: Probe) -> bool:
    """Whether decelerations count as negative: at the impact velocity and a small depth, one is.

    Beyond the depth 2R a contact area D x - x² is negative, too.
    """
    small = abs(table.number("depth", 1) or 0.0) / 20
    speed = abs(impact_velocity(table))
    state = {
        (role, d): small if role == "depth" else speed
        for role, d in probe.state
        if role == "depth" or role.startswith("velocity")
    }
    value = probe.value(probe.state["deceleration", 0], state, {}, {}) if small else math.nan
    if math.isfinite(value) and value:
        return value < 0
    return median(table.lines["deceleration"].values.values()) < 0


def _as_read(
    x: State | None, u: State | None, read: Sequence[State], probe: Probe, end: State
) -> Variant | None:
    """The way of a right force by the row from which it takes depth and velocity."""
    if x == ("depth", -1) and ("depth", 0) in probe.state:
        return VARIANTS["force at the row before"]
    if u == ("velocity_initial", -1):
        return VARIANTS["drag at the row before"]
    more = [state for state in read if state not in (x, u, end)]
    return None if more else REPORT["deceleration"]


def _depth_of(read: Sequence[State]) -> State | None:
    depths = [state for state in read if state[0] == "depth"]
    return depths[0] if len(depths) == 1 else None


def _velocity_of(read: Sequence[State], start: State) -> State | None:
    speeds = [state for state in read if state[0].startswith("velocity")]
    return speeds[0] if len(speeds) == 1 else start if start in speeds else None


def _slopes(probe: Probe, place: Position, read: Sequence[State]) -> dict[State, float] | None:
    """The derivatives of a linear formula; None if it is not linear."""
    value, slopes = probe.value(place, {}, {}, {}), {}
    for name in read:
        base = probe.base[name]
        far, near = (probe.value(place, {name: base * s}, {}, {}) for s in (2.0, 1.5))
        slopes[name] = (far - value) / base
        if not math.isclose(near - value, 0.5 * slopes[name] * base, rel_tol=1e-6):
            return None
    return slopes


def _advance(table: SchemeTable, probe: Probe) -> tuple[float, Variant | None]:
    """The constant c of the depths and the way in which they grow."""
    place, before = probe.state["depth", 0], ("depth", -1)
    read = probe.answers(place)
    slopes = _slopes(probe, place, read)
    if slopes is None:
        return math.nan, None
    speeds = [state for state in read if state[0].startswith("velocity")]
    others = [state for state in read if state != before and state not in speeds]
    adds = math.isclose(slopes.get(before, 0.0), 1.0, rel_tol=1e-9)
    if adds and not speeds and not others:
        step = probe.value(place, {}, {}, {}) - probe.base[before]
        return step / impact_velocity(table), VARIANTS["impact velocity"]
    c = sum(slopes[state] for state in speeds) if speeds else math.nan
    if not adds and _is_sum(table, probe, slopes):
        return slopes[start_of_row(table)], REPORT["depth"]
    if not adds:
        return c, _without_adding(table, speeds, others)
    if others and all(role == "deceleration" for role, _ in others):
        return c, VARIANTS["second order"]
    if others or not speeds:
        return math.nan, None
    if len(speeds) == 1:  # again without the depth before it, to lose no digits
        c = probe.value(place, {before: 1e-200}, {}, {}) / probe.base[speeds[0]]
    elif not math.isclose(*(slopes[state] for state in speeds[:2]), rel_tol=1e-9):
        return math.nan, None
    return c, _with_speeds(table, speeds)


def _is_sum(table: SchemeTable, probe: Probe, slopes: Mapping[State, float]) -> bool:
    """Whether a depth is a sum of all velocities: it grows by one of them from row to row."""
    start = start_of_row(table)
    k = probe.k
    now, before = table.number("depth", k), table.number("depth", k - 1)
    u = table.number(start[0], k + start[1])
    if start not in slopes or len(slopes) < 2 or None in (now, before, u):
        return False
    assert now is not None
    assert before is not None
    assert u is not None
    return math.isclose(now - before, slopes[start] * u, rel_tol=1e-7)


def _without_adding(
    table: SchemeTable, speeds: Sequence[State], others: Sequence[State]
) -> Variant | None:
    """The way of a depth that adds nothing to the one before."""
    if not speeds or any(role != "time" for role, _ in others):
        return None
    # Without a column of times each row has its own typed into its formula.
    by_time = others or table.lines["depth"].usual is None
    return VARIANTS["velocity times time" if by_time else "half a step alone"]


def _with_speeds(table: SchemeTable, speeds: Sequence[State]) -> Variant:
    """The way of a depth that adds a velocity, or two, to the one before."""
    if len(speeds) > 1:
        return VARIANTS["mean velocity"]
    start, end = start_of_row(table), end_of_row(table)
    if speeds[0] in (start, ("velocity_final", -1)):  # where the one repeats the other
        return REPORT["depth"]
    return VARIANTS["final velocity" if speeds[0] == end else "explicit Euler"]


def _fall(probe: Probe, place: Position, start: State, sign: float) -> tuple[float, Variant | None]:
    """The constant e by which the velocity falls with the deceleration, and the way it does so.

    e is NaN where the formula has the force itself, without its column.
    """
    read, brake = probe.answers(place), ("deceleration", 0)
    own = [state for state in read if state[0].startswith("velocity")]
    if brake not in read:
        repeats = _velocity_of(read, start) is not None and any(r == "depth" for r, _ in read)
        return math.nan, REPORT["velocity_final"] if repeats else None
    if len(own) != 1 or len(read) != 2:
        return math.nan, None
    u, a = probe.base[own[0]], probe.base[brake]
    for _ in range(60):  # find a deceleration that takes a good part of the velocity
        fall = abs(u - probe.value(place, {brake: a}, {}, {}))
        if not 0 < fall < math.inf or 0.05 * abs(u) < fall < 0.45 * abs(u):
            break
        a *= abs(u) / fall / 4  # twice of which leaves a velocity above zero
    e, twice = ((u - probe.value(place, {brake: s * a}, {}, {})) / (s * a) * sign for s in (1, 2))
    value, far = (probe.value(place, {own[0]: s * u}, {}, {}) for s in (1, 2))
    same = own[0] in (start, ("velocity_final", -1))
    if not same or not math.isclose((far - value) / u, 1.0, rel_tol=1e-9):
        return e, None
    if not math.isclose(e, twice, rel_tol=1e-9):
        return e, None
    return abs(e), REPORT["velocity_final"] if e > 0 else VARIANTS["sign of the deceleration"]


# ---- the force


def _quadratic(values: Sequence[float]) -> tuple[float, float, float]:
    """The coefficients of 1, s and s² through values at s = 1, 2 and 3."""
    first, second, third = values
    square = (first - 2 * second + third) / 2
    slope = second - first - 3 * square
    return first - slope - square, slope, square


def _grid_of_terms(force: Force, x: float, u: float) -> list[list[float]]:
    """The coefficients of u^i x^j, in units of the two scales: `result[i][j]`."""
    by_depth = [_quadratic([force(s * x, t * u) for t in (1, 2, 3)]) for s in (1, 2, 3)]
    return [list(_quadratic([row[i] for row in by_depth])) for i in range(3)]


def _is_polynomial(force: Force, grid: list[list[float]], x: float, u: float) -> bool:
    for s, t in ((1.7, 2.6), (2.9, 1.2)):
        wanted = sum(grid[i][j] * t**i * s**j for i in range(3) for j in range(3))
        if not math.isclose(force(s * x, t * u), wanted, rel_tol=_ROUGH):
            return False
    return True


def _numbers_of(
    force: Force, table: SchemeTable, e: float
) -> tuple[tuple[float, float, float], Variant | None, bool]:
    """G, H and D of a force, the way that it follows, and whether its drag is centered."""
    nan = (math.nan, math.nan, math.nan)
    small = abs(table.number("depth", 1) or table.number("depth", 2) or 1e-9) / 20
    speed = abs(impact_velocity(table)) / 3 or 1.0
    first = centered_numbers(force, small, speed, 0.0)
    if first is None:
        return nan, None, False
    G, H, D = first
    if 0 < D < math.inf and G > 0 and H > 0:  # where all terms matter
        small, speed = 0.14 * D, 0.5 * math.sqrt(H / G)
    grid = _grid_of_terms(force, small, speed)
    if not all(math.isfinite(value) for row in grid for value in row):
        return nan, None, False
    if _is_polynomial(force, grid, small, speed):
        return *_named_force(grid, small, speed), False
    if (diameter := _diameter_of(force, small, speed)) is not None:
        return (math.nan, math.nan, diameter), None, False
    if math.isfinite(e):
        D = D if 0 < D < math.inf else 40 * small
        middle = centered_numbers(force, 0.1 * D, abs(impact_velocity(table)) / 3, e / 2)
        if middle is not None and _is_centered(force, middle, e / 2, table):
            return middle, VARIANTS["centered"], True
    return nan, None, False


def _diameter_of(force: Force, x: float, u: float) -> float | None:
    """D of a force that is a contact area D x - x² times anything that depends on the velocity."""
    diameters = []
    for speed in (u, 2.3 * u):
        free, slope, square = _quadratic([force(s * x, speed) for s in (1, 2, 3)])
        largest = max(abs(slope), abs(square))
        if not square or abs(free) > 1e-8 * largest or abs(square) < 1e-6 * largest:
            return None
        test = 2.6 * slope + 2.6**2 * square
        if not math.isclose(force(2.6 * x, speed), test, rel_tol=_ROUGH):
            return None
        diameters.append(-slope / square * x)
    return diameters[0] if diameters[0] > 0 and math.isclose(*diameters, rel_tol=_ROUGH) else None


def centered_numbers(
    force: Force, x: float, u: float, h: float
) -> tuple[float, float, float] | None:
    """G, H and D of a force whose drag is taken at u - h a, from four values; h = 0 if at u."""
    xs, us = (x, 3 * x), (2 * u, 3 * u)
    a = [[force(s, t) for t in us] for s in xs]
    at = [list(us), list(us)]
    G = H = D = math.nan
    for turn in range(60 if h else 1):
        drag, rest = [], []
        for i in range(2):
            divisor = at[i][1] ** 2 - at[i][0] ** 2
            if not divisor or not math.isfinite(divisor):
                return None
            slope = (a[i][1] - a[i][0]) / divisor
            drag.append(slope)
            rest.append(a[i][0] - slope * at[i][0] ** 2)
        last = (G, H, D)
        sums = [r + d * us[1] ** 2 for r, d in zip(rest, drag, strict=True)]
        ratio = sums[0] / sums[1] if sums[1] else math.nan
        below = ratio * xs[1] - xs[0]
        D = (ratio * xs[1] ** 2 - xs[0] ** 2) / below if below else math.inf
        area = D * xs[1] - xs[1] ** 2 if math.isfinite(D) else xs[1]
        if not area:
            return None
        G, H = drag[1] / area, rest[1] / area
        if not all(math.isfinite(value) for value in (G, H)):
            return None
        if not h or (
            turn
            and all(math.isclose(p, q, rel_tol=1e-15) for p, q in zip(last, (G, H, D), strict=True))
        ):
            break
        for i, s in enumerate(xs):
            for j, t in enumerate(us):
                at[i][j] = t - h * (G * t * t + H) * (D * s - s * s)
    return G, H, D


def _is_centered(
    force: Force, numbers: tuple[float, float, float], h: float, table: SchemeTable
) -> bool:
    G, H, D = numbers
    speed = abs(impact_velocity(table))
    for s, t in ((0.17 * D, 0.9 * speed), (0.36 * D, 0.7 * speed)):
        area = D * s - s * s
        middle = t - h * (G * t * t + H) * area
        if not math.isclose(force(s, t), (G * middle**2 + H) * area, rel_tol=_ROUGH):
            return False
    return True


def _named_force(
    grid: list[list[float]], x: float, u: float
) -> tuple[tuple[float, float, float], Variant | None]:
    """G, H and D of a polynomial force, and its variant by the terms that it has."""
    largest = max(abs(value) for row in grid for value in row)
    terms = {(i, j) for i in range(3) for j in range(3) if abs(grid[i][j]) > 1e-8 * largest}
    drag = grid[2] if (2, 1) in terms or (2, 2) in terms or (2, 0) in terms else grid[1]
    power = 2 if drag is grid[2] else 1
    G, H = -drag[2] / (u**power * x * x), -grid[0][2] / (x * x)
    lead = max(grid, key=lambda row: max(map(abs, row)))
    D = -lead[1] / lead[2] * x if lead[2] else math.inf
    area = {(0, 1), (0, 2), (2, 1), (2, 2)}
    report = REPORT["deceleration"]
    if terms == area:
        alike = math.isclose(grid[0][1] * grid[2][2], grid[2][1] * grid[0][2], rel_tol=1e-6)
        if not alike:
            return (G, H, D), None
        if D > 0:
            return (G, H, D), report
        return (-G, -H, -D), VARIANTS["sign in the area"]
    named = {
        frozenset({(0, 1), (0, 2)}): "no drag",
        frozenset({(2, 1), (2, 2)}): "no resistance",
        frozenset({(1, 1), (1, 2), (0, 1), (0, 2)}): "drag with v for v²",
        frozenset({(2, 1), (0, 1)}): "area without x²",
        frozenset({(2, 2), (0, 2)}): "area of a circle with radius x",
        frozenset({(2, 0), (0, 0)}): "area of the whole sphere",
    }
    name = named.get(frozenset(terms))
    if name == "area without x²":
        return (grid[2][1] / (u * u * x), grid[0][1] / x, math.inf), VARIANTS[name]
    if name in ("area of a circle with radius x", "area of the whole sphere"):
        j = 2 if "circle" in name else 0
        return (grid[2][j] / u**2 / x**j, grid[0][j] / x**j, math.nan), VARIANTS[name]
    return (G, H, D), VARIANTS[name] if name else None


# ---- the same numbers again, with inputs replaced


def numbers_with(
    fitted: TableFit, table: SchemeTable, cells: CellNumbers, literals: Literals
) -> dict[str, float]:
    """The numbers by name, with some inputs replaced: of c, e and t only their ratios count."""
    probe, six = fitted.probe, fitted.six
    assert probe is not None
    base, brake = probe.base, ("deceleration", 0)
    place = probe.state["depth", 0]
    depth = probe.value(place, {}, cells, literals)
    result = {"c": depth - base["depth", -1] if fitted.depth_adds else depth}
    if fitted.brakes == "deceleration":
        u, falls = base[start_of_row(table)], probe.state[end_of_row(table)]
        strong = {brake: u / six.e / 4} if six.e and math.isfinite(six.e) else {}
        result["e"] = u - probe.value(falls, strong, cells, literals)
    if fitted.force is not None:
        speed = abs(six.V) / 3
        if six.G > 0 and six.H > 0 and not fitted.centered:
            speed = 0.5 * math.sqrt(six.H / six.G)
        small = 0.1 * six.D if 0 < six.D < math.inf else abs(base["depth", 0]) / 10
        force = replace(fitted.force, cells=cells, literals=literals)
        numbers = centered_numbers(force, small, speed, abs(six.e) / 2 * fitted.centered)
        if numbers is not None:
            result |= dict(zip("GHD", numbers, strict=True))
    if ("time", 0) in probe.state and table.lines["time"].computed:
        value = probe.value(probe.state["time", 0], {}, cells, literals)
        result["t"] = value - base["time", -1] if fitted.time_adds else value
    return result


# ---- the parts of the force


class RightForce(NamedTuple):
    """The right force by its inputs, in SI units but for D.

    `ratio` is G/H in the units of the columns; `off` is the ratio in which the wrong one is off.
    """

    ratio: float | None
    D: float | None
    density: float | None
    resistance: float | None
    off: float | None = None


def is_part(fitted: TableFit, place: Position, right: RightForce) -> bool:
    """Whether a formula beside the table is a part of the right force, up to a constant.

    Such parts are powers of the velocity and the depth, the contact area D x - x², and the pressure
    (G u² + H); `right.ratio` is the right G/H, `right.D` the right D, in the units of the columns.
    A constant is wrong if its digits are `right.off` times those that the inputs give.
    """
    assert fitted.force is not None
    force = replace(fitted.force, place=place, sign=1.0, e=None)
    D = right.D or (fitted.six.D if 0 < fitted.six.D < math.inf else 1.0)
    small, speed = 0.1 * D, abs(fitted.six.V) / 3
    if right.ratio and right.ratio > 0:
        speed = 0.5 / math.sqrt(right.ratio)
    grid = _grid_of_terms(force, small, speed)
    if not all(math.isfinite(value) for row in grid for value in row):
        return True
    if not _is_polynomial(force, grid, small, speed):
        return False
    largest = max(abs(value) for row in grid for value in row)
    terms = {(i, j) for i in range(3) for j in range(3) if abs(grid[i][j]) > 1e-8 * largest}
    rows, columns = sorted({i for i, _ in terms}), sorted({j for _, j in terms})
    if len(terms) != len(rows) * len(columns) or columns not in ([0], [1], [2], [1, 2], [0, 1]):
        return False
    i, j = rows[-1], columns[-1]
    if (rows, columns) == ([0], [1]) and _lacks_square(fitted, grid[0][1] / small, D):
        return False
    if columns == [1, 2] and not math.isclose(grid[i][1] / grid[i][2], -D / small, rel_tol=1e-6):
        return False
    if len(rows) > 1:
        if rows != [0, 2]:
            return False
        share = grid[2][j] / grid[0][j] / speed**2
        if right.ratio and not math.isclose(share, right.ratio, rel_tol=1e-6):
            return False
    constant = abs(grid[rows[0]][j]) / (speed ** rows[0] * small**j)
    return _is_right_constant(constant, rows, columns, right)


def _is_right_constant(
    constant: float, rows: Sequence[int], columns: Sequence[int], right: RightForce
) -> bool:
    """Whether the constant of a part of the force is not off as the wrong force is.

    `rows` are the powers of the velocity in the part, `columns` those of the depth.
    """
    if right.off is None or columns not in ([0], [1, 2]) or rows == [0] == columns:
        return True
    known = {0: right.resistance, 2: right.density and right.density / 2}.get(rows[0])
    if columns == [1, 2]:
        known = math.pi if rows == [0] else math.pi * (known or 1.0)
    if known is None:
        return True
    slip = math.log10(constant / known / right.off)
    return abs(slip - round(slip)) > 1e-8


def _lacks_square(fitted: TableFit, slope: float, D: float) -> bool:
    """Whether a line that is proportional to the depth is pi D x, as the area of a wrong force."""
    if fitted.ways.get("deceleration") is not VARIANTS["area without x²"]:
        return False
    power = math.log10(abs(slope) / (math.pi * D))
    return abs(power - round(power)) < 1e-8


def grows_beyond(fitted: TableFit, place: Position) -> bool:
    """Whether a formula beside the table has the contact area D x - x² and no right end at R."""
    D, speed = fitted.six.D, abs(fitted.six.V) / 3
    if fitted.force is None or not 0 < D < math.inf:
        return False
    force = replace(fitted.force, place=place, sign=1.0, e=None)
    tenth, third, deep = (force(part * D, speed) for part in (0.1, 0.3, 0.75))
    if not tenth or not math.isclose(third / tenth, 0.21 / 0.09, rel_tol=1e-6):
        return False
    return not math.isclose(deep / tenth, 0.25 / 0.09, rel_tol=1e-6)


def is_bounded(fitted: TableFit) -> bool:
    """Whether the contact area stays pi R² beyond the depth R, as in the report."""
    six = fitted.six
    if fitted.force is None or not 0 < six.D < math.inf:
        return fitted.bounded
    depth, speed = 0.75 * six.D, abs(six.V) / 3
    wanted = six.deceleration(depth, speed)
    close = 0.05 if fitted.centered else 1e-6
    return math.isclose(fitted.force(depth, speed), wanted, rel_tol=close)

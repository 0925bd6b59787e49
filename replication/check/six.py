"""What the formulas of a table do: probed, and fitted to six numbers.

One row that has the usual formulas is given states that are independent of each other, and its
formulas answer. Of the report's scheme, whatever its layout, they are six numbers:

    x += c w    a = (G u^2 + H) (D x - x^2), constant beyond D/2    v -= e a    from V on

with w and u the velocity at the start of the row. Formulas that answer otherwise are compared with
the other schemes that people use (`VARIANTS`). All numbers are in the units of the columns.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from statistics import median
from typing import NamedTuple

from replication.check.table import Line, Table
from spreadsheets.evaluate import LiteralKey, Scalar
from spreadsheets.foreign import Position

EXACT = 1e-9
"""Relative difference up to which formulas are the same: they round to some 1e-14, and a constant
that somebody typed with ten digits differs by more."""
_MOST_ROWS = 100_000
"""The most rows that are run for a comparison."""

State = tuple[str, int]
"""A cell of the state of a row: its role, and its row counted from the one that is probed."""


class Variant(NamedTuple):
    """One way to fill a column: the role of the column, a name, and how it differs."""

    role: str
    name: str
    says: str = ""


REPORT = {
    role: Variant(role, "the report's")
    for role in ("depth", "deceleration", "velocity_final", "start")
}
VARIANTS = {
    variant.name: variant
    for variant in (
        Variant("start", "no half step",
                "the first depth is V times the whole step; the report takes half of it"),
        Variant("start", "starts at zero",
                "the first step leaves the depth at zero; the report takes V times half a step"),
        Variant("depth", "explicit Euler",
                "the depth moves on by the initial velocity of the row before"),
        Variant("depth", "impact velocity",
                "the depth moves on by the impact velocity in every row"),
        Variant("depth", "final velocity",
                "the depth moves on by the velocity at the end of the row"),
        Variant("depth", "mean velocity",
                "the depth moves on by the mean of two velocities"),
        Variant("depth", "velocity times time",
                "the depth is the velocity times the time; no row adds to the one before"),
        Variant("depth", "half a step alone",
                "each depth is that of one step; no row adds to the one before"),
        Variant("depth", "half steps throughout",
                "every step moves the depth by half a step only"),
        Variant("depth", "second order",
                "the depth takes the deceleration into account, which the report does not"),
        Variant("velocity_final", "sign of the deceleration",
                "the velocity grows by the deceleration, by which it should fall"),
        Variant("deceleration", "centered",
                "the drag is taken at the velocity in the middle of the step, half a step ahead of "
                "the row's initial velocity"),
        Variant("deceleration", "force at the row before",
                "the force is taken at the depth of the row before"),
        Variant("deceleration", "drag at the row before",
                "the drag is taken at the initial velocity of the row before"),
        Variant("deceleration", "drag at impact velocity",
                "the drag is taken at the impact velocity in every row"),
        Variant("deceleration", "no drag", "the force lacks the term with the target's density"),
        Variant("deceleration", "no resistance", "the force lacks the target's resistance"),
        Variant("deceleration", "drag without 1/2",
                "the factor 1/2 before the target's density is missing"),
        Variant("deceleration", "drag with the particle's density",
                "the drag has the particle's density, where the target's belongs"),
        Variant("deceleration", "drag with v for v²",
                "the drag has the velocity where its square belongs"),
        Variant("deceleration", "area without x²", "the contact area is pi D x, without - x²"),
        Variant("deceleration", "area with R for D",
                "the contact area has the radius where the diameter belongs"),
        Variant("deceleration", "area of a circle with radius x",
                "the contact area is pi x², a circle whose radius is the depth"),
        Variant("deceleration", "area of the whole sphere",
                "the contact area is that of the whole sphere, pi R², at every depth"),
        Variant("deceleration", "sign in the area", "the contact area is pi (D x + x²)"),
        Variant("deceleration", "area beyond the radius",
                "the contact area shrinks again beyond the depth R, where the report keeps pi R²"),
    )
}  # fmt: skip
"""The other ways, by their names."""


class Six(NamedTuple):
    """The six numbers of a table; G [1/m^2 in SI], H [1/(m s^2)], D [m], c and e [s], V [m/s]."""

    G: float
    H: float
    D: float
    c: float
    e: float
    V: float

    def deceleration(self, x: float, u: float) -> float:
        """The deceleration at a depth and a velocity."""
        half = self.D / 2
        area = self.D * x - x * x if x < half else half * half
        return (self.G * u * u + self.H) * area


class Step(NamedTuple):
    """One row of a run."""

    velocity_initial: float
    depth: float
    deceleration: float
    velocity_final: float


def run(six: Six, stop: float, *, centered: bool = False, most: int = _MOST_ROWS) -> list[Step]:
    """The rows of the report's scheme for six numbers, to the first velocity below `stop`."""
    rows: list[Step] = []
    x, v = 0.0, six.V
    while v >= stop and len(rows) < most:
        x = x + six.c * v if rows else six.c * v / 2
        a = six.deceleration(x, v)
        if centered:
            a = six.deceleration(x, v - a * six.e / 2)
        end = v - six.e * a
        rows.append(Step(v, x, a, end))
        v = end
        if not math.isfinite(v + x + a):
            break
    return rows


# ---- probing


class Probe:
    """One row of a table, whose formulas are evaluated in other states and with other inputs."""

    def __init__(self, table: Table, k: int) -> None:
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

    def value(
        self, place: Position, state: Mapping[State, float],
        cells: Mapping[Position, Scalar], literals: Mapping[LiteralKey, float],
    ) -> float:  # fmt: skip
        """The number of a cell in a state; NaN if it is none."""
        replaced: dict[Position, Scalar] = {
            p: state.get(name, self.base[name]) for name, p in self.state.items() if p != place
        }
        replaced |= cells
        value = self.evaluator.value(place, replaced, literals, self.cone(place))
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


Force = Callable[[float, float], float]
"""A deceleration by depth and velocity, as the formulas give it."""


@dataclass(frozen=True)
class Fit:
    """What the formulas of a table do.

    `six` are its numbers, `time` is by how much the time grows, `sign` is -1 where decelerations
    are negative. `ways` are the variants by role, None for a formula that follows none; a role that
    is not computed is missing. `force_of` names the depth and the velocity that the force is taken
    at; `brakes` is the column in which it is seen.
    """

    six: Six
    time: float | None
    sign: float
    ways: Mapping[str, Variant | None]
    brakes: str
    falls: State | None
    force_of: tuple[State, State] | None = None
    centered: bool = False
    probe: Probe | None = None
    slack: float = EXACT
    time_adds: bool = False

    @property
    def odd(self) -> list[Variant | None]:
        """The variants that are not the report's."""
        return [way for role, way in self.ways.items() if way is not REPORT[role]]


def start_of_row(table: Table) -> State:
    """The velocity at the start of a row."""
    if "velocity_initial" in table.lines:
        return "velocity_initial", 0
    return "velocity_final", -1


def end_of_row(table: Table) -> State:
    """The velocity at the end of a row."""
    if "velocity_final" in table.lines:
        return "velocity_final", 0
    return "velocity_initial", 1


def _row_to_probe(table: Table) -> int | None:
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
        good = sum(formulas.get(table.place(role, k)) is shape for role, shape in computed)
        good += sum(formulas.get(table.place(role, k + 1)) is shape for role, shape in computed)
        for line, shape in helpers:
            good += formulas.get(line.place(table.rows[k])) is shape
        straight = table.rows[k + 1] - table.rows[k - 1] == 2
        candidates.append((-good, not straight, abs(k - table.steps // 2), k))
    return min(candidates)[-1] if candidates else None


def fit(table: Table) -> Fit:
    """Fit a table: by its formulas, where it has them, or else by its numbers."""
    k = _row_to_probe(table)
    depth, speed = table.lines["depth"], table.lines[start_of_row(table)[0]]
    if k is None or not (depth.computed and speed.computed):
        return fit_numbers(table)
    fitted = _probed(table, Probe(table, k))
    if "time" in table.lines:
        assert fitted.probe is not None
        read = fitted.probe.answers(table.place("time", k))
        fitted = replace(fitted, time_adds=("time", -1) in read)
    if not any(math.isfinite(x) and x for x in fitted.six[2:5]):
        return fit_numbers(table)
    return fitted


def _probed(table: Table, probe: Probe) -> Fit:
    start, end = start_of_row(table), end_of_row(table)
    ways: dict[str, Variant | None] = {}
    c, ways["depth"] = _advance(table, probe, start, end)
    brake = ("deceleration", 0) if "deceleration" in table.lines else None
    falls = probe.state[end]
    own = probe.answers(falls)
    e, sign = math.nan, 1.0
    if brake is not None and table.lines["deceleration"].computed:
        place = probe.state[brake]
        sign = -1.0 if _typical_sign(table.lines["deceleration"]) < 0 else 1.0
        if brake in own:
            e, ways["velocity_final"] = _linear_fall(probe, falls, start, brake, own, sign)
        elif _velocity_of(own, start) is not None and any(r == "depth" for r, _ in own):
            ways["velocity_final"] = REPORT["velocity_final"]  # it repeats the force by itself
            e = c
        else:
            ways["velocity_final"] = None

        def force(
            x: State,
            u: State,
            given: Mapping[Position, Scalar],
            numbers: Mapping[LiteralKey, float],
        ) -> Force:
            return lambda depth, speed: (
                sign * probe.value(place, {x: depth, u: speed}, given, numbers)
            )

        read, brakes = probe.answers(place), "deceleration"
    else:
        e, brakes = c, end[0]
        if brake is not None and brake in own:
            e, ways["velocity_final"] = _linear_fall(probe, falls, start, brake, own, 1.0)
            return Fit(Six(math.nan, math.nan, math.nan, c, e, _first_speed(table)),
                       _time_step(table, probe), 1.0, ways, brakes, start, probe=probe)  # fmt: skip
        place = falls

        def force(
            x: State,
            u: State,
            given: Mapping[Position, Scalar],
            numbers: Mapping[LiteralKey, float],
        ) -> Force:
            return lambda depth, speed: (
                (speed - probe.value(place, {x: depth, u: speed}, given, numbers)) / e
            )

        read = own
    x, u = _depth_of(read), _velocity_of(read, start)
    if x is None:
        x, whole = ("depth", 0), any(r != "depth" for r, _ in read)
        if not whole:
            ways["deceleration"] = None
            return Fit(Six(math.nan, math.nan, math.nan, c, e, _first_speed(table)),
                       _time_step(table, probe), sign, ways, brakes, start, probe=probe)  # fmt: skip
    numbers, way, centered = _force(force(x, u or start, {}, {}), table, e)
    if way is REPORT["deceleration"]:
        if x == ("depth", -1) and ("depth", 0) in probe.state:
            way = VARIANTS["force at the row before"]
        elif u is not None and _is_before(u, start):
            way = VARIANTS["drag at the row before"]
    extra = [s for s in read if s not in (x, u) and s != end]
    if extra and way is REPORT["deceleration"]:
        way = None
    ways["deceleration"] = way
    six = Six(*numbers, c, e, _first_speed(table))
    return Fit(
        six, _time_step(table, probe), sign, ways, brakes, start, (x, u or start), centered, probe
    )


def _typical_sign(line: Line) -> float:
    return median(line.values.values())


def _first_speed(table: Table) -> float:
    """The velocity V at which the table starts."""
    for role, k in (("velocity_initial", 1), ("velocity_final", 0), ("velocity_initial", 0)):
        if (value := table.number(role, k)) is not None:
            return value
    return math.nan


def _depth_of(read: Sequence[State]) -> State | None:
    depths = [s for s in read if s[0] == "depth"]
    return depths[0] if len(depths) == 1 else None


def _velocity_of(read: Sequence[State], start: State) -> State | None:
    speeds = [s for s in read if s[0].startswith("velocity")]
    return speeds[0] if len(speeds) == 1 else start if start in speeds else None


def _is_before(u: State, start: State) -> bool:
    """Whether a velocity is that at the start of the row before."""
    return u in (("velocity_initial", -1), ("velocity_final", -2)) and u != start


def _advance(table: Table, probe: Probe, start: State, end: State) -> tuple[float, Variant | None]:
    """The constant c of the depths and the way in which they grow."""
    place, before = probe.state["depth", 0], ("depth", -1)
    read = probe.answers(place)
    value = probe.value(place, {}, {}, {})
    slopes = {}
    for name in read:
        base = probe.base[name]
        up, down = (probe.value(place, {name: base * s}, {}, {}) for s in (2.0, 1.5))
        slope = (up - value) / base
        if not math.isclose(down - value, 0.5 * slope * base, rel_tol=1e-6):
            return math.nan, None
        slopes[name] = slope
    speeds = [s for s in read if s[0].startswith("velocity")]
    c = sum(slopes[s] for s in speeds) if speeds else math.nan
    if len(speeds) == 1 and before in read:  # without the depth, to lose no digits
        c = probe.value(place, {before: 1e-200}, {}, {}) / probe.base[speeds[0]]
    same = {start}  # the same velocity may be read where it is repeated
    if start == ("velocity_initial", 0) and ("velocity_final", -1) in probe.state:
        same.add(("velocity_final", -1))
    late = {end} if end != ("velocity_initial", 1) else {end}
    adds = math.isclose(slopes.get(before, 0.0), 1.0, rel_tol=1e-9)
    others = [s for s in read if s != before and s not in speeds]
    if adds and not speeds and not others:
        step = value - probe.base[before]
        return step / _first_speed(table), VARIANTS["impact velocity"]
    if not adds and speeds and not [s for s in others if s[0] != "time"]:
        if others:
            return c, VARIANTS["velocity times time"]
        whole = _is_free_of_rows(table)
        return c, VARIANTS["velocity times time" if not whole else "half a step alone"]
    if adds and others and all(s[0] == "deceleration" for s in others):
        return c, VARIANTS["second order"]
    if not adds or others or not speeds:
        return math.nan, None
    if len(speeds) == 1:
        if speeds[0] in same:
            return c, REPORT["depth"]
        if speeds[0] in late:
            return c, VARIANTS["final velocity"]
        return c, VARIANTS["explicit Euler"]
    if len(speeds) == 2 and math.isclose(slopes[speeds[0]], slopes[speeds[1]], rel_tol=1e-9):
        return c, VARIANTS["mean velocity"]
    return math.nan, None


def _is_free_of_rows(table: Table) -> bool:
    """Whether the formulas of the depths are alike: they hold no time that is typed in each row."""
    return table.lines["depth"].usual is not None


def _linear_fall(
    probe: Probe, place: Position, start: State, brake: State, read: Sequence[State], sign: float
) -> tuple[float, Variant | None]:
    """The constant e by which the velocity falls, if it falls as in the report."""
    own = [s for s in read if s[0].startswith("velocity")]
    if len(own) != 1 or len(read) != 2:
        return math.nan, None
    same = own[0] == start or {own[0], start} == {("velocity_initial", 0), ("velocity_final", -1)}
    u, a = probe.base[own[0]], probe.base[brake]
    value = probe.value(place, {}, {}, {})
    for _ in range(60):  # a deceleration that takes a good part of the velocity
        fall = abs(u - probe.value(place, {brake: a}, {}, {}))
        if not 0 < fall < math.inf or 0.1 * abs(u) < fall < 10 * abs(u):
            break
        a *= abs(u) / fall
    e = (u - probe.value(place, {brake: a}, {}, {})) / a * sign
    slope = (probe.value(place, {own[0]: 2 * u}, {}, {}) - value) / u
    twice = (u - probe.value(place, {brake: 2 * a}, {}, {})) / (2 * a) * sign
    if not same or not math.isclose(slope, 1.0, rel_tol=1e-9):
        return e, None
    if not math.isclose(e, twice, rel_tol=1e-9):
        return e, None
    if e < 0:
        return -e, VARIANTS["sign of the deceleration"]
    return e, REPORT["velocity_final"]


def _time_step(table: Table, probe: Probe) -> float | None:
    """By how much the time grows in a row."""
    line = table.lines.get("time")
    if line is None:
        return None
    steps = []
    for k in table.rows:
        now, before = table.number("time", k), table.number("time", k - 1)
        if now is not None and before is not None:
            steps.append(now - before)
    if not steps:
        return None
    return median(steps)


# ---- the force


def _quadratic(values: Sequence[float]) -> tuple[float, float, float]:
    """The coefficients of 1, s and s² through values at s = 1, 2 and 3."""
    one, two, three = values
    square = (one - 2 * two + three) / 2
    slope = two - one - 3 * square
    return one - slope - square, slope, square


def _grid(force: Force, x: float, u: float) -> list[list[float]]:
    """The coefficients of u^i x^j, in units of the two scales: `result[i][j]`."""
    by_depth = [_quadratic([force(s * x, t * u) for t in (1, 2, 3)]) for s in (1, 2, 3)]
    return [list(_quadratic([row[i] for row in by_depth])) for i in range(3)]


def _is_polynomial(force: Force, grid: list[list[float]], x: float, u: float) -> bool:
    for s, t in ((1.7, 2.6), (2.9, 1.2)):
        wanted = sum(grid[i][j] * t**i * s**j for i in range(3) for j in range(3))
        if not math.isclose(force(s * x, t * u), wanted, rel_tol=1e-7):
            return False
    return True


def _force(
    force: Force, table: Table, e: float
) -> tuple[tuple[float, float, float], Variant | None, bool]:
    """G, H and D of a force, its variant, and whether the drag is centered."""
    nan = (math.nan, math.nan, math.nan)
    small = abs(table.number("depth", 1) or table.number("depth", 2) or 1e-9) / 20
    speed = abs(_first_speed(table)) / 3 or 1.0
    if (refined := centered_numbers(force, small, speed, 0.0)) is None:
        return nan, None, False
    G, H, D = refined
    if D > 0 and math.isfinite(D) and G > 0 and H > 0:
        small, speed = 0.14 * D, 0.5 * math.sqrt(H / G)
    grid = _grid(force, small, speed)
    if not all(math.isfinite(value) for row in grid for value in row):
        return nan, None, False
    if _is_polynomial(force, grid, small, speed):
        numbers, way = _named_force(grid, small, speed)
        return numbers, way, False
    if (diameter := _diameter_of(force, small, speed)) is not None:
        return (math.nan, math.nan, diameter), None, False
    if math.isfinite(e):
        D = D if D > 0 and math.isfinite(D) else 40 * small
        middle = centered_numbers(force, 0.1 * D, abs(_first_speed(table)) / 3, e / 2)
        if middle is not None and _is_centered(force, middle, e / 2, table):
            return middle, VARIANTS["centered"], True
    return nan, None, False


def _diameter_of(force: Force, x: float, u: float) -> float | None:
    """D of a force that is a contact area D x - x² times anything that depends on the velocity."""
    found = []
    for speed in (u, 2.3 * u):
        free, slope, square = _quadratic([force(s * x, speed) for s in (1, 2, 3)])
        largest = max(abs(slope), abs(square))
        if not square or abs(free) > 1e-8 * largest or abs(square) < 1e-6 * largest:
            return None
        test = 2.6 * slope + 2.6**2 * square
        if not math.isclose(force(2.6 * x, speed), test, rel_tol=1e-7):
            return None
        found.append(-slope / square * x)
    return found[0] if found[0] > 0 and math.isclose(*found, rel_tol=1e-7) else None


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


def _is_centered(force: Force, numbers: tuple[float, float, float], h: float, table: Table) -> bool:
    G, H, D = numbers
    speed = abs(_first_speed(table))
    for s, t in ((0.17 * D, 0.9 * speed), (0.36 * D, 0.7 * speed)):
        area = D * s - s * s
        middle = t - h * (G * t * t + H) * area
        if not math.isclose(force(s, t), (G * middle**2 + H) * area, rel_tol=1e-7):
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
    fitted: Fit, table: Table, cells: Mapping[Position, Scalar],
    literals: Mapping[LiteralKey, float],
) -> dict[str, float]:  # fmt: skip
    """The six numbers, and the time step, with some inputs replaced: few probes for each."""
    probe = fitted.probe
    assert probe is not None
    start, end = start_of_row(table), end_of_row(table)
    base, result = probe.base, {}
    place = probe.state["depth", 0]
    value = probe.value(place, {}, cells, literals)
    result["c"] = value - base["depth", -1]
    brake = ("deceleration", 0)
    falls = probe.state[end]
    if fitted.brakes == "deceleration":
        u = base[start]
        strong = {brake: u / fitted.six.e} if fitted.six.e and math.isfinite(fitted.six.e) else {}
        result["e"] = u - probe.value(falls, strong, cells, literals)
        brakes = probe.state[brake]
    else:
        brakes = falls
    if fitted.force_of is not None:
        x, u = fitted.force_of
        single = brakes is not falls

        def force(depth: float, speed: float) -> float:
            value = probe.value(brakes, {x: depth, u: speed}, cells, literals)
            return fitted.sign * value if single else (speed - value) / fitted.six.e

        D, speed = fitted.six.D, abs(fitted.six.V) / 3
        if fitted.six.G > 0 and fitted.six.H > 0 and not fitted.centered:
            speed = 0.5 * math.sqrt(fitted.six.H / fitted.six.G)
        span = (
            0.1 * D if 0 < D < math.inf else abs(table.number("depth", min(3, table.steps)) or 1.0)
        )
        h = fitted.sign * fitted.six.e / 2 if fitted.centered else 0.0
        h = abs(h)
        numbers = centered_numbers(force, span, speed, h)
        if numbers is not None:
            result |= dict(zip("GHD", numbers, strict=True))
    if "time" in table.lines and table.lines["time"].computed:
        cell = probe.state["time", 0]
        value = probe.value(cell, {}, cells, literals)
        result["t"] = value - base["time", -1] if fitted.time_adds else value
    return result


class RightForce(NamedTuple):
    """The right force by its inputs, in SI units but for D, and in which ratio the wrong one is off."""

    ratio: float | None
    D: float | None
    density: float | None
    resistance: float | None
    off: float | None = None


def is_part(fitted: Fit, place: Position, right: RightForce) -> bool:
    """Whether a formula beside the table is a part of the right force, up to a constant.

    Such parts are powers of the velocity and the depth, the contact area D x - x², and the pressure
    (G u² + H); `right.ratio` is the right G/H, `right.D` the right D, in the units of the columns.
    A constant is wrong if its digits are `right.off` times those that the inputs give.
    """
    assert fitted.probe is not None and fitted.force_of is not None
    probe, (x, u) = fitted.probe, fitted.force_of

    def force(depth: float, speed: float) -> float:
        return probe.value(place, {x: depth, u: speed}, {}, {})

    D = right.D or (fitted.six.D if 0 < fitted.six.D < math.inf else 1.0)
    small, speed = 0.1 * D, abs(fitted.six.V) / 3
    if right.ratio and right.ratio > 0:
        speed = 0.5 / math.sqrt(right.ratio)
    grid = _grid(force, small, speed)
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
    if columns == [1, 2] and not math.isclose(grid[i][1] / grid[i][2], -D / small, rel_tol=1e-6):
        return False
    if len(rows) > 1:
        if rows != [0, 2]:
            return False
        share = grid[2][j] / grid[0][j] / speed**2
        if right.ratio and not math.isclose(share, right.ratio, rel_tol=1e-6):
            return False
    constant = abs(grid[rows[0]][j]) / (speed ** rows[0] * small**j)
    known = {0: right.resistance, 2: right.density and right.density / 2}.get(rows[0])
    if columns == [1, 2]:
        known = math.pi * (known or 1.0) if rows != [0] else math.pi
    if right.off is None or known is None or columns not in ([0], [1, 2]) or rows == [0] == columns:
        return True
    slip = math.log10(constant / known / right.off)
    return abs(slip - round(slip)) > 1e-8


def is_bounded(fitted: Fit, table: Table) -> bool:
    """Whether the contact area stays pi R² beyond the depth R, as in the report."""
    if fitted.probe is None or fitted.force_of is None or not 0 < fitted.six.D < math.inf:
        return True
    depth, speed = 0.75 * fitted.six.D, abs(fitted.six.V) / 3
    (x, u), probe, falls = fitted.force_of, fitted.probe, fitted.probe.state[end_of_row(table)]
    single = fitted.brakes == "deceleration"
    place = probe.state["deceleration", 0] if single else falls
    value = probe.value(place, {x: depth, u: speed}, {}, {})
    a = fitted.sign * value if single else (speed - value) / fitted.six.e
    wanted = fitted.six.deceleration(depth, speed)
    return math.isclose(a, wanted, rel_tol=0.05 if fitted.centered else 1e-6)


# ---- numbers without formulas


def fit_numbers(table: Table) -> Fit:
    """Fit the rows of a table without formulas, with the digits of its numbers as uncertainty.

    The force is fitted by least squares: (a u-term, rest) on x and x².
    """
    start, end = start_of_row(table), end_of_row(table)
    speeds, growth, falls, forces = [], [], [], []
    for k in table.rows:
        x, before = table.number("depth", k), table.number("depth", k - 1)
        u = table.number(start[0], k + start[1])
        w = table.number(end[0], k + end[1])
        a = table.number("deceleration", k)
        if x is not None and before is not None and u and k > 1:
            growth.append(((x - before) / u, k))
        if u is not None and w is not None and a and k > 0:
            falls.append(((u - w) / a, k))
        if x is not None and u is not None and k > 0:
            if a is not None and a != 0:
                forces.append((x, u, a))
            elif "deceleration" not in table.lines and w is not None:
                forces.append((x, u, u - w))
        if u is not None:
            speeds.append(u)
    c = _between(growth, table, "depth")
    e = _between(falls, table, "velocity") if falls else c
    sign = -1.0 if forces and median(a for *_, a in forces) < 0 else 1.0
    divisor = sign if "deceleration" in table.lines else e
    G = H = D = math.nan
    slack = _slack(table)
    if len(forces) * -math.log10(slack) > 20:  # few rows of few digits do not tell
        G, H, D = _least_squares([(x, u, a / divisor) for x, u, a in forces])
    ways: dict[str, Variant | None] = {
        role: REPORT[role] for role in ("depth", "deceleration", "velocity_final")
    }
    six = Six(G, H, D, c, sign * e if falls else c, _first_speed(table))
    step = None
    if "time" in table.lines:
        times = [(table.number("time", k), k) for k in table.rows]
        known = [(t, k) for t, k in times if t is not None]
        if len(known) > 1 and known[-1][1] != known[0][1]:
            step = (known[-1][0] - known[0][0]) / (known[-1][1] - known[0][1])
    brakes = "deceleration" if "deceleration" in table.lines else end[0]
    return Fit(six, step, sign, ways, brakes, start, probe=None, slack=slack)


def _slack(table: Table) -> float:
    """The relative uncertainty of numbers fitted to typed ones, by the digits of these."""
    worst = 1e-9
    for role, line in table.lines.items():
        if role != "time":
            middle = (
                median(abs(v) for v in line.values.values() if v)
                if any(line.values.values())
                else 1.0
            )
            worst = max(worst, line.rounding(middle) / middle)
    return min(0.05, 4 * worst)


def _between(ratios: Sequence[tuple[float, int]], table: Table, what: str) -> float:
    """The constant of many rows: the mean of the middle half."""
    if not ratios:
        return math.nan
    ordered = sorted(value for value, _ in ratios)
    quarter = len(ordered) // 4
    middle = ordered[quarter : len(ordered) - quarter]
    return math.fsum(middle) / len(middle)


def _least_squares(rows: Sequence[tuple[float, float, float]]) -> tuple[float, float, float]:
    """G, H and D with a = (G u² + H)(D x - x²), from rows before the radius.

    a / x is linear in u², x and their product, so that three passes of weighted least squares on
    four terms do; of these four one is redundant, and D is taken from the larger pair.
    """
    nan = (math.nan, math.nan, math.nan)
    if len(rows) < 4:
        return nan
    scale_x = max(abs(x) for x, _, _ in rows) or 1.0
    scale_u = max(abs(u) for _, u, _ in rows) or 1.0
    scale_a = max(abs(a) for *_, a in rows) or 1.0
    data = [(x / scale_x, (u / scale_u) ** 2, a / scale_a) for x, u, a in rows]
    thirds = [data[i::3] for i in range(3)] if len(data) >= 12 else []
    # A wrong number spoils one of them; the best fits most of all rows.
    fits = [six for part in (data, *thirds) if (six := _three_numbers(part)) is not None]
    if not fits:
        return nan
    best = min(fits, key=lambda six: _usual_miss(data, six))
    for _ in range(3):
        kept = _without_outliers(data, best)
        best = _three_numbers(kept, best) or best
    G, H, D = best[:3]
    return (
        G * scale_a / (scale_u**2 * scale_x**2), H * scale_a / scale_x**2, D * scale_x,
    )  # fmt: skip


def _three_numbers(
    data: Sequence[tuple[float, float, float]], start: Six | None = None
) -> Six | None:
    """G, H and D of scaled rows (x, u², a) by Gauss-Newton; None if they do not tell."""
    guess = start[:3] if start is not None else _linear(data)
    if guess is None:
        return None
    G, H, D = guess
    for _ in range(40):
        matrix = [[0.0] * 3 for _ in range(3)]
        right = [0.0] * 3
        for x, w, a in data:
            inside = x < D / 2
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


def _misses(data: Sequence[tuple[float, float, float]], six: Six) -> list[float]:
    """The relative deviation of each row from a fit."""
    return [
        abs(six.deceleration(x, math.sqrt(max(w, 0.0))) - a) / max(abs(a), 1e-6)
        for x, w, a in data
    ]  # fmt: skip


def _usual_miss(data: Sequence[tuple[float, float, float]], six: Six) -> float:
    return median(_misses(data, six))


def _without_outliers(
    data: list[tuple[float, float, float]], six: Six
) -> list[tuple[float, float, float]]:
    """The rows whose deviation from a fit is not far above the usual one."""
    off = _misses(data, six)
    usual = median(off)
    kept = [
        row for row, deviation in zip(data, off, strict=True) if deviation <= 20 * usual + 1e-13
    ]
    return kept if len(kept) >= max(4, 0.7 * len(data)) else data


def _linear(data: Sequence[tuple[float, float, float]]) -> tuple[float, float, float] | None:
    """A first guess: a / x = A + B x in the plane of x, with w as a third direction."""
    matrix = [[0.0] * 4 for _ in range(4)]
    right = [0.0] * 4
    for x, w, a in data:
        if not x:
            continue
        terms = (w, w * x, 1.0, x)
        value = a / x
        for i in range(4):
            right[i] += terms[i] * value
            for j in range(4):
                matrix[i][j] += terms[i] * terms[j]
    solved = _solved(matrix, right)
    if solved is None:
        return None
    GD, G, HD, H = solved[0], -solved[1], solved[2], -solved[3]
    pairs = [(GD, G), (HD, H)]
    guesses = [a / b for a, b in pairs if b > 0 and a > 0]
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

"""The six numbers of a table, the ways in which its columns may be filled, and a run of the scheme.

Of the report's scheme, whatever its layout, a table is six numbers, in the units of its columns:

    x += c w    a = (G u^2 + H) (D x - x^2), constant beyond D/2    v -= e a    from V on

with w and u the velocity at the start of the row. `VARIANTS` are other ways that people use.
"""

import math
from statistics import median
from typing import NamedTuple

from replication.check.table import SchemeTable
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

    def deceleration(self, x: float, u: float, bounded: bool = True) -> float:
        """The deceleration at depth and velocity; if not `bounded`, no pi R² beyond D/2."""
        half = self.D / 2
        area = self.D * x - x * x if x < half or not bounded else half * half
        return (self.G * u * u + self.H) * area


class Errors(NamedTuple):
    """The relative errors of six numbers, as far as digits admit them."""

    G: float
    H: float
    D: float
    c: float
    e: float
    V: float

    @property
    def of_force(self) -> float:
        """That of what follows from the force and the volume of the sphere."""
        return max(self.G, self.H) + 3 * self.D


ROUNDED = Errors(EXACT, EXACT, EXACT, EXACT, EXACT, EXACT)
"""The relative errors of six numbers that formulas give."""


class Step(NamedTuple):
    """One row of a run."""

    velocity_initial: float
    depth: float
    deceleration: float
    velocity_final: float


def run_scheme(
    six: Six, stop: float, *, centered: bool = False, most: int = _MOST_ROWS
) -> list[Step]:
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


def start_of_row(table: SchemeTable) -> State:
    """The velocity at the start of a row."""
    if "velocity_initial" in table.lines:
        return "velocity_initial", 0
    return "velocity_final", -1


def end_of_row(table: SchemeTable) -> State:
    """The velocity at the end of a row."""
    if "velocity_final" in table.lines:
        return "velocity_final", 0
    return "velocity_initial", 1


def first_speed(table: SchemeTable) -> Position | None:
    """The cell of the velocity at the impact that rows start from."""
    for role, k in (("velocity_initial", 1), ("velocity_final", 0), ("velocity_initial", 0)):
        if table.number(role, k) is not None:
            return table.place(role, k)
    return None


def first_written(table: SchemeTable, place: Position) -> Position:
    """The cell in which the first velocity is written, where another one only repeats it."""
    zero = table.number("velocity_initial", 0)
    if zero is None:
        return place
    impact = table.place("velocity_initial", 0)
    repeated = [area.corner for area in table.evaluator.areas(place)] == [impact]
    return impact if repeated and table.evaluator.values.get(place) == zero else place


def impact_velocity(table: SchemeTable) -> float:
    """The velocity V at which the table starts; NaN if it shows none."""
    place = first_speed(table)
    value = table.evaluator.values.get(place) if place else None
    return value if type(value) is float else math.nan


def time_step(table: SchemeTable) -> float | None:
    """By how much the time grows in most rows."""
    pairs = ((table.number("time", k), table.number("time", k - 1)) for k in table.rows)
    steps = [now - before for now, before in pairs if now is not None and before is not None]
    return median(steps) if steps else None

"""The rules of the report's scheme, and other rules that people use instead.

A rule computes what one cell should hold, in SI units, from the cells calculated before it. A
workbook is therefore judged against its own earlier cells: only the cell in which an error occurs
fails, not the hundred cells that follow from it.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

PARTS = {"start": ("depth", 1), "advance": ("depth", 2), "brake": ("deceleration", 1),
         "end": ("velocity_final", 1)}  # fmt: skip
"""The column that each part of a scheme fills, and the first row in which it does."""

FILLS = {role: part for part, (role, _) in PARTS.items()}
"""The part of the scheme that fills a column below its first row."""

ORDER = ("velocity_initial", "depth", "deceleration", "velocity_final")
"""The order of calculation within a row."""

MOST_ROWS = 20_000
"""The most rows that are computed for a comparison."""


@dataclass(frozen=True)
class Case:
    """The inputs of a run in SI units.

    `own_mass` and `own_diameter` are the workbook's; without them, mass and diameter are computed.
    `pi` is the workbook's, because LibreOffice saves a cell that holds it with 15 digits.
    """

    velocity: float
    radius: float
    particle_density: float
    target_density: float
    resistance: float
    step: float
    stop_velocity: float = 1.0
    own_mass: float | None = None
    own_diameter: float | None = None
    pi: float = math.pi

    @property
    def mass(self) -> float:
        """M = (4/3) pi R^3 rho_p [kg], or the workbook's mass."""
        if self.own_mass is not None:
            return self.own_mass
        r = self.radius
        return self.particle_density * 4 / 3 * self.pi * r * r * r

    @property
    def diameter(self) -> float:
        """D = 2R [m], or the workbook's diameter."""
        return 2 * self.radius if self.own_diameter is None else self.own_diameter

    def holding(self, role: str, value: float) -> "Case":
        """Return the case with another mass, diameter or resistance, and nothing else changed."""
        return replace(self, **{"resistance" if role == "resistance" else f"own_{role}": value})

    def with_input(self, role: str, value: float, by: float = 1.0) -> "Case":
        """Return the case with another input, `by` times the present one, and all that follows."""
        changes: dict[str, dict[str, Any]] = {
            "beta": {"resistance": self.resistance * by},
            "flow_stress": {"resistance": self.resistance * by},
            "mass": {"own_mass": value},
            "diameter": {"own_diameter": value, "radius": value / 2},
            "radius": {"radius": value, "own_mass": None, "own_diameter": None},
            "particle_density": {"particle_density": value, "own_mass": None},
        }
        return replace(self, **changes.get(role, {role: value}))


@dataclass(frozen=True)
class Rows:
    """The numbers of a run by role and row, in SI units.

    A role without a column follows from the others: the final velocity of a row is the initial
    velocity of the next one, and the deceleration is computed by the rules.
    """

    columns: Mapping[str, Mapping[int, float]]
    case: Case
    rules: "Mapping[str, Rule]"

    @property
    def others(self) -> "dict[str, Rule]":
        """The rules that are not the report's, by part."""
        return {part: rule for part, rule in self.rules.items() if rule.says}

    def __getitem__(self, cell: tuple[str, int]) -> float:
        """Return the number of a role in row k. Raises KeyError if there is none."""
        role, k = cell
        if k in self.columns.get(role, ()):
            return self.columns[role][k]
        if role not in self.columns and role == "velocity_final":
            return self.columns["velocity_initial"][k + 1]
        if role not in self.columns and role == "velocity_initial":
            return self.case.velocity if k <= 1 else self.columns["velocity_final"][k - 1]
        if k == 0:  # a table need not show the row of the impact
            return self.case.velocity if role.startswith("velocity") else 0.0
        if role not in self.columns and role == "deceleration":
            return self.rules["brake"].formula(self, k)
        raise KeyError(cell)

    def __call__(self, role: str, k: int) -> float | None:
        """Return the number of a role in row k, None if there is none."""
        try:
            return self[role, k]
        except KeyError:
            return None

    def shows(self, part: str, k: int) -> tuple[str, int]:
        """Return the role and row of the cell in which a part of row k can be seen.

        If the part has no column of its own, that is the velocity computed from it.
        """
        for role in (PARTS[part][0], "velocity_final"):
            if role in self.columns:
                return role, k
        return "velocity_initial", k + 1

    def wanted(self, role: str, k: int) -> float | None:
        """Return what a cell should hold, given the other cells; None if one of them is missing."""
        try:
            if role == "time":
                return self["time", k - 1] + self.case.step
            if role.startswith("velocity") and k <= (role == "velocity_initial"):
                return self.case.velocity
            if k == 0:
                return 0.0
            if role == "velocity_initial" and "velocity_final" in self.columns:
                return self["velocity_final", k - 1]
            if role == "velocity_initial":
                return self.rules["end"].formula(self, k - 1)
            part = "start" if role == "depth" and k == 1 else FILLS[role]
            return self.rules[part].formula(self, k)
        except KeyError:
            return None


@dataclass(frozen=True)
class Rule:
    """One way to fill a column.

    `says` describes how it departs from the report's rule (nothing for that rule itself), `lacks`
    names the input that it leaves out.
    """

    name: str
    formula: Callable[[Rows, int], float]
    says: str = ""
    lacks: str = ""


def deceleration(
    case: Case, x: float, v: float, *, factor: float = 0.5, area: float | None = None
) -> float:
    """Return the deceleration at a depth [m] and velocity [m/s] (Eqs. A-1 to A-3) [m/s^2].

    `factor` is that of rho_t v^2 in the drag; `area` is the contact area over pi [m^2] if it is not
    the report's.

    >>> case = Case(500.0, 11e-6, 8900.0, 7850.0, 3.5e9, 2e-10)
    >>> f"{deceleration(case, 5e-8, 500.0):.2E}"
    '3.11E+08'
    """
    area = contact(case, x) if area is None else area
    stress = factor * case.target_density * v * v + case.resistance
    return stress * case.pi * area / case.mass if case.mass else math.inf


def contact(case: Case, x: float) -> float:
    """Return the contact area over pi [m^2]: D x - x^2 while x < R, and R^2 beyond."""
    return case.diameter * x - x * x if x < case.radius else case.radius * case.radius


def orders(case: Case, x: float, v: float) -> set[float]:
    """Return the deceleration for every order of operations in which the equations may be typed.

    A square may be a product or a power, which now and then differ in the last digit.
    """
    rho, pi, m = case.target_density, case.pi, case.mass
    areas = {contact(case, x)}
    if 0 < x < case.radius:
        areas.add(case.diameter * x - x**2)
    stresses = {0.5 * rho * v * v, 0.5 * rho * (v * v)}
    if abs(v) < 1e100:  # Python's powers end with an error where products become infinite
        stresses.add(0.5 * rho * v**2)
    return {
        value
        for area in areas
        for s in (stress + case.resistance for stress in stresses)
        for value in (s * pi * area / m, s * (pi * area) / m)
    }


def _brake(
    name: str, formula: Callable[[Case, float, float], float], says: str = "", lacks: str = ""
) -> Rule:
    """Make a rule for the deceleration from the depth and the initial velocity of the same row."""

    def by_row(rows: Rows, k: int) -> float:
        return formula(rows.case, rows["depth", k], rows["velocity_initial", k])

    return Rule(name, by_row, says, lacks)


BEYOND = _brake(
    "area beyond the radius", lambda c, x, v: deceleration(c, x, v, area=c.diameter * x - x * x),
    "the contact area shrinks again beyond the depth R, where the report keeps pi R²",
)  # fmt: skip


def depth_times_ten(power: int) -> Rule:
    """Make the report's rule with a depth 10^power times too large in D x - x²."""

    def wrong(case: Case, x: float, v: float) -> float:
        x *= 10.0**power
        return deceleration(case, x, v, area=case.diameter * x - x * x)

    return _brake("", wrong)


BRAKES = (
    _brake("velocity at the beginning", deceleration),
    _brake("centered",
           lambda c, x, v: deceleration(c, x, v - deceleration(c, x, v) * (c.step / 2)),
           "the drag is taken at the velocity in the middle of the step, half a step ahead of the "
           "row's initial velocity"),
    Rule("explicit Euler",
         lambda r, k: deceleration(r.case, r["depth", k - 1], r["velocity_initial", k]),
         "the force is taken at the depth of the row before"),
    _brake("no drag", lambda c, x, v: deceleration(c, x, v, factor=0.0),
           "the force lacks the term with the target's density", "target_density"),
    _brake("no resistance", lambda c, x, v: deceleration(replace(c, resistance=0.0), x, v),
           "the force lacks the target's resistance", "resistance"),
    _brake("drag without 1/2", lambda c, x, v: deceleration(c, x, v, factor=1.0),
           "the factor 1/2 before the target's density is missing"),
    _brake("drag with the particle's density",
           lambda c, x, v: deceleration(replace(c, target_density=c.particle_density,
                                                own_mass=c.mass), x, v),
           "the drag has the particle's density, where the target's belongs", "target_density"),
    _brake("drag with v for v²",
           lambda c, x, v: deceleration(c, x, v, factor=0.5 / v if v else 0.0),
           "the drag has the velocity where its square belongs"),
    _brake("drag at impact velocity", lambda c, x, _: deceleration(c, x, c.velocity),
           "the drag is taken at the impact velocity in every row"),
    _brake("area without x²", lambda c, x, v: deceleration(c, x, v, area=c.diameter * x),
           "the contact area is pi D x, without - x²"),
    _brake("area with R for D",
           lambda c, x, v: deceleration(c, x, v, area=c.radius * x - x * x),
           "the contact area has the radius where the diameter belongs"),
    _brake("area of a circle with radius x", lambda c, x, v: deceleration(c, x, v, area=x * x),
           "the contact area is pi x², a circle whose radius is the depth"),
    _brake("area of the whole sphere",
           lambda c, x, v: deceleration(c, x, v, area=c.radius * c.radius),
           "the contact area is that of the whole sphere, pi R², at every depth"),
    BEYOND,
    Rule("drag at the row before",
         lambda r, k: deceleration(r.case, r["depth", k], r["velocity_initial", k - 1]),
         "the drag is taken at the initial velocity of the row before"),
)  # fmt: skip


def _advance(name: str, speed: Callable[[Rows, int], float], says: str = "") -> Rule:
    """Make a rule that adds a velocity times the step to the depth of the row before."""
    return Rule(name, lambda r, k: r["depth", k - 1] + speed(r, k) * r.case.step, says)


def _by_time(start: float) -> Rule:
    """Make a rule for depth = velocity times time, the time counted in steps from a start."""
    return Rule(
        "velocity times time", lambda r, k: r["velocity_initial", k] * (k - start) * r.case.step,
        "the depth is the velocity times the time; no row adds to the one before",
    )  # fmt: skip


def _mean(rows: Rows, k: int) -> float:
    return (rows["velocity_initial", k] + rows["velocity_final", k]) / 2


def _by_energy(rows: Rows, k: int) -> float:
    v, way = rows["velocity_initial", k], rows["depth", k] - rows["depth", k - 1]
    return math.sqrt(max(v * v - 2 * rows["deceleration", k] * way, 0.0))


KNOWN: dict[str, tuple[Rule, ...]] = {
    "start": (
        Rule("half step", lambda r, k: r["velocity_initial", k] * (r.case.step / 2)),
        Rule("no half step", lambda r, k: r["velocity_initial", k] * r.case.step,
             "the first depth is V times the whole step; the report takes half of it"),
        Rule("starts at zero", lambda *_: 0.0,
             "the first step leaves the depth at zero; the report takes V times half a step"),
    ),
    "advance": (
        _advance("initial velocity", lambda r, k: r["velocity_initial", k]),
        _advance("explicit Euler", lambda r, k: r["velocity_initial", k - 1],
                 "the depth moves on by the initial velocity of the row before"),
        _advance("impact velocity", lambda r, _: r.case.velocity,
                 "the depth moves on by the impact velocity in every row"),
        _advance("final velocity", lambda r, k: r["velocity_final", k],
                 "the depth moves on by the velocity at the end of the row"),
        _advance("mean velocity", _mean,
                 "the depth moves on by the mean of the row's two velocities"),
        _advance("mean velocity of the row before", lambda r, k: _mean(r, k - 1),
                 "the depth moves on by the mean of the velocities of the row before"),
        _by_time(0.0), _by_time(0.5), _by_time(1.0),
        Rule("half a step alone", lambda r, k: r["velocity_initial", k] * (r.case.step / 2),
             "each depth is that of half a step; no row adds to the one before"),
        _advance("half steps throughout", lambda r, k: r["velocity_initial", k] / 2,
                 "every step moves the depth by half a step only"),
    ),
    "brake": BRAKES,
    "end": (
        Rule("whole step",
             lambda r, k: r["velocity_initial", k] - r["deceleration", k] * r.case.step),
        Rule("half a step",
             lambda r, k: r["velocity_initial", k] - r["deceleration", k] * (r.case.step / 2),
             "the velocity falls by the deceleration times half a step only"),
        Rule("by energy", _by_energy, "the velocity follows from v² - 2 a times the step in depth"),
    ),
}  # fmt: skip
"""The rules for each part, the report's first."""

REPORT = {part: rules[0] for part, rules in KNOWN.items()}
"""The report's scheme."""


def march(
    case: Case,
    rules: Mapping[str, Rule] = REPORT,
    fixed: Mapping[tuple[str, int], float] | None = None,
    steps: int | None = None,
) -> dict[str, dict[int, float]]:
    """Compute the columns of a scheme by role and row, down to the stop velocity or for `steps`.

    Cells in `fixed` keep the number given there.

    >>> rows = march(Case(500.0, 11e-6, 8900.0, 7850.0, 3.5e9, 2e-10))
    >>> len(rows["depth"]) - 1, f"{rows['depth'][131] * 1e6:.2f}"
    (131, '7.67')
    """
    columns: dict[str, dict[int, float]] = {role: {} for role in ORDER}
    rows = Rows(columns, case, rules)
    columns["velocity_initial"][0] = case.velocity
    columns["depth"][0] = columns["deceleration"][0] = 0.0
    for k in range(1, (steps or MOST_ROWS) + 1):
        for role in ORDER * len(ORDER):  # some rules need a column that is filled later
            if k not in columns[role]:
                value = (fixed or {}).get((role, k), rows.wanted(role, k))
                if value is not None:
                    columns[role][k] = value
        final = columns["velocity_final"].get(k, math.nan)
        if not math.isfinite(final) or (steps is None and final < case.stop_velocity):
            break
    return columns

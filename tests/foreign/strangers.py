"""Strangers: right sheets of the scheme in layouts that nobody tuned a program to, as plans.

`draw` draws a plan from a seed: inputs over decades, their units, words (known, of other languages,
random letters, none), places, columns, and how each formula is written. `slips.py` lists the faults
that it can have, `built.py` makes the workbook.

Nothing here is shared with the program under test, except that it is its scheme.
"""

import random
from collections.abc import Sequence
from dataclasses import dataclass, field

from foreign.layouts import BRAKE, DEPTH, END, START, TIME

from replication.models.impact import Impact, particle_mass
from replication.models.sheet import run


@dataclass(frozen=True)
class Unit:
    """A unit: its name, how many SI units it is, and the power of ten if it is one."""

    name: str
    si: float
    power: int | None = None


def metric(name: str, power: int) -> Unit:
    return Unit(name, float(f"1e{power}"), power)


LENGTHS = (metric("m", 0), metric("cm", -2), metric("mm", -3), metric("µm", -6), metric("um", -6),
           metric("nm", -9))  # fmt: skip
DENSITIES = (metric("kg/m³", 0), metric("kg/m3", 0), metric("g/cm³", 3), metric("g/cc", 3),
             metric("kg/L", 3), metric("t/m3", 3))  # fmt: skip
VELOCITIES = (metric("m/s", 0), metric("km/s", 3), metric("cm/s", -2), metric("mm/s", -3))
STRESSES = (metric("Pa", 0), metric("kPa", 3), metric("MPa", 6), metric("N/mm²", 6),
            metric("GPa", 9), metric("bar", 5), Unit("ksi", 6894757.293168),
            Unit("psi", 6894.757293168))  # fmt: skip
TIMES = (metric("s", 0), metric("ms", -3), metric("µs", -6), metric("ns", -9), metric("ps", -12))
MASSES = (metric("kg", 0), metric("g", -3), metric("mg", -6), metric("µg", -9), metric("ng", -12))
AREAS = (metric("m²", 0), metric("mm²", -6), metric("µm²", -12))
FORCES = (metric("N", 0), metric("mN", -3), metric("kN", 3))
DECELERATIONS = (metric("m/s²", 0), metric("m/s^2", 0), metric("km/s²", 3))
NUMBER = (Unit("", 1.0, 0),)

UNITS = {
    "radius": LENGTHS, "diameter": LENGTHS, "particle_density": DENSITIES,
    "target_density": DENSITIES, "velocity": VELOCITIES, "resistance": STRESSES,
    "flow_stress": STRESSES, "beta": NUMBER, "step": TIMES, "stop_velocity": VELOCITIES[:1],
    "mass": MASSES, TIME: TIMES, START: VELOCITIES[:3], END: VELOCITIES[:3], DEPTH: LENGTHS,
    BRAKE: DECELERATIONS, "area": AREAS, "pressure": STRESSES[:5], "force": FORCES,
    "change": VELOCITIES[:1], "ratio": NUMBER, "energy": (metric("J", 0), metric("mJ", -3)),
    "count": NUMBER, "pi": NUMBER,
}  # fmt: skip
"""The units in which an input is typed or a column calculates."""


@dataclass(frozen=True)
class Plan:
    """One stranger's workbook, before it has cells."""

    seed: int
    impact: Impact
    given: tuple[str, ...]  # the inputs that have cells, in their order
    numbers: dict[str, float]  # what is typed into them
    units: dict[str, Unit]  # of inputs and columns
    columns: tuple[str, ...]  # from left to right, or from top to bottom
    velocities: str  # "both", "start" (of a row) or "end"
    words: str  # "known", "foreign", "letters" or "none"
    unit_beside_input: str  # "label", "next" (the next cell) or "none"
    unit_of_column: str  # "head", "row" (below the heads) or "none"
    inputs_at: str  # "above", "beside", "below" or "sheet"
    flat: bool  # inputs side by side, labels above their numbers
    converted: bool  # whether a cell beside each input holds it in SI units
    references: str  # "absolute", "mixed" or "names"
    across: bool
    zero: bool  # whether the row of the impact is shown
    negative: bool  # whether the acceleration is shown, not the deceleration
    beyond: bool  # whether the formula for the area has two branches
    guard: str  # "", "count" or "velocity": what leaves rows blank after the stop
    spare: int  # the number of rows below the stop
    mass: str  # "cell", "inline" or "typed"
    digits: int | None = None  # of tables that hold numbers only
    style: dict[str, int] = field(default_factory=dict)  # how each formula is written

    @property
    def name(self) -> str:
        return f"stranger-{self.seed}"

    @property
    def steps(self) -> int:
        return run(self.impact).steps

    @property
    def summed(self) -> bool:
        """Whether each depth is a sum over all velocities before it."""
        return self.velocities == "both" and not self.guard and self.style["sum"] == 0

    @property
    def inside(self) -> bool:
        """Whether the impact velocity is typed into the table, and has no other cell."""
        return "velocity" not in self.given

    @property
    def diameter_cell(self) -> bool:
        """Whether a cell computes the diameter from the radius."""
        return "radius" in self.given and self.style["area"] % 3 == 0

    @property
    def resistance_cell(self) -> bool:
        """Whether a cell computes the resistance from beta and the flow stress."""
        return "beta" in self.given and bool(self.style["pressure"] % 2)

    @property
    def has_result(self) -> bool:
        """Whether cells with known words show the final depth and X/R."""
        return self.style["result"] < 6 and self.words != "none" and self.digits is None

    def shown(self, quantity: str) -> str:
        """The column whose formula computes a quantity."""
        if quantity in self.columns:
            return quantity
        if quantity == END:
            return START
        if BRAKE not in self.columns:
            return END
        return "force" if quantity in ("area", "pressure") and "force" in self.columns else BRAKE


def draw(seed: int, words: str = "", *, pasted: bool | None = None) -> Plan:
    """Draw the plan of a seed; `words` and `pasted` settle these two instead."""
    r = random.Random(f"stranger {seed}")
    words = words or r.choices(("known", "foreign", "letters", "none"), (3, 3, 3, 2))[0]
    velocities = r.choices(("both", "start", "end"), (6, 2, 1))[0]
    columns = _columns(r, velocities)
    metric_only = r.random() < 0.3
    units = {name: choices[0] if metric_only or r.random() < 0.25 else r.choice(choices)
             for name, choices in UNITS.items()}  # fmt: skip
    units[END] = units[START]
    guard = r.choices(("", "count", "velocity"), (6, 2, 1))[0] if velocities == "both" else ""
    if guard == "count" and "count" not in columns:
        columns = ("count", *columns)
    given = _given(r, bool(guard))
    while True:
        numbers, impact = _inputs(r, units, given)
        if impact is not None:
            break
    if impact.stop_velocity != 1.0 and "stop_velocity" not in given:
        given.append("stop_velocity")
    digits = r.randrange(5, 13) if r.random() < 0.15 else None
    if pasted is not None:
        digits = (digits or r.randrange(5, 13)) if pasted else None
    deep = run(impact).final_depth >= impact.radius
    zero = r.random() < 0.75 or velocities != "both"
    if zero and velocities == "both" and r.random() < 0.1:
        given.remove("velocity")
        numbers["velocity"] = float(f"{impact.velocity / units[START].si:.12g}")
    return Plan(
        seed, impact, tuple(given), numbers, units, columns, velocities, words,
        unit_beside_input=r.choice(("label", "label", "next", "none")),
        unit_of_column=r.choice(("head", "head", "row", "none")),
        inputs_at=r.choices(("above", "beside", "below", "sheet"), (5, 2, 1, 3))[0],
        flat=r.random() < 0.2,
        converted=r.random() < 0.3,
        references=r.choices(("absolute", "mixed", "names"), (5, 1, 2))[0],
        across=r.random() < 0.18,
        zero=zero,
        negative=r.random() < 0.2,
        beyond=deep or r.random() < 0.3,
        guard="" if digits else guard,
        spare=r.randrange(2, 12) if guard and not digits else 0,
        mass="typed" if "mass" in given else r.choice(("cell", "cell", "cell", "inline")),
        digits=digits,
        style={name: r.randrange(12) for name in (
            "area", "pressure", "force", "half", "time", "power", "mass", "head", "first", "gap",
            "square", "pi", "sum", "blank", "top", "left", "result", "notes", "second",
            "depth", "end", "dollar", "inputs",
        )},
    )  # fmt: skip


def _columns(r: random.Random, velocities: str) -> tuple[str, ...]:
    """The columns in their order: those of the scheme, some left out, and helpers."""
    order = [TIME, START, DEPTH, BRAKE, END]
    if velocities == "both" and r.random() < 0.12:
        order.remove(BRAKE)
        return tuple(order)
    if velocities != "both":
        order.remove(END if velocities == "start" else START)
    if r.random() < 0.3:
        order.remove(TIME)
    for helper in ("area", "pressure", "force"):
        if r.random() < 0.25:
            order.insert(order.index(BRAKE), helper)
    if r.random() < 0.15:
        order.insert(order.index(BRAKE) + 1, "change")
    if r.random() < 0.35:
        r.shuffle(order)
    order += [extra for extra in ("ratio", "energy") if r.random() < 0.15]
    if r.random() < 0.35:
        order.insert(r.choice((0, len(order))), "count")
    return tuple(order)


def _inputs(
    r: random.Random, units: dict[str, Unit], given: Sequence[str]
) -> tuple[dict[str, float], Impact | None]:
    """The numbers that are typed, and the impact; None if it is no sheet that one would make."""

    def typed(name: str, si: float, digits: int) -> float:
        return float(f"{si / units[name].si:.{digits}g}")

    def between(name: str, least: float, most: float) -> float:
        return typed(name, least * (most / least) ** r.random(), r.choice((2, 3, 3, 4)))

    numbers = {
        "radius": between("radius", 2e-7, 2e-3),
        "particle_density": between("particle_density", 900, 20000),
        "target_density": between("target_density", 900, 20000),
        "velocity": between("velocity", 60, 2500),
        "beta": between("beta", 1.1, 7),
        "flow_stress": between("flow_stress", 3e6, 4e9),
    }
    si = {name: number * units[name].si for name, number in numbers.items()}
    stop = 1.0 if r.random() < 0.6 else float(f"{si['velocity'] * r.uniform(0.004, 0.05):.2g}")
    numbers["stop_velocity"] = si["stop_velocity"] = stop
    # What is typed instead of these has its own digits.
    if "diameter" in given:
        numbers["diameter"] = typed("diameter", 2 * si["radius"], 4)
        si["radius"] = numbers["diameter"] * units["diameter"].si / 2
    if "mass" in given:
        mass = particle_mass(si["radius"], si["particle_density"])
        numbers["mass"] = typed("mass", mass, 4)
        si["particle_density"] *= numbers["mass"] * units["mass"].si / mass
    if "resistance" in given:
        own = si.pop("beta") * si.pop("flow_stress")
        numbers["resistance"] = typed("resistance", own, 3)
        si["resistance"] = numbers["resistance"] * units["resistance"].si
    steps, short = r.randrange(14, 130), 0.003 * si["radius"] / si["velocity"]
    try:
        time = run(Impact(**si, step=short)).rows[-1].time
        numbers["step"] = typed("step", time / steps, 2)
        sheet = run(Impact(**si, step=numbers["step"] * units["step"].si))
    except ValueError:
        return numbers, None
    good = 0.03 < sheet.normalized_depth < 6 and 12 <= sheet.steps <= 160
    return numbers, sheet.impact if good else None


def _given(r: random.Random, guarded: bool) -> list[str]:
    """The inputs that have cells, in their order."""
    given = ["target_density", "velocity", "step"]
    given.append("diameter" if r.random() < 0.25 else "radius")
    given.append("mass" if r.random() < 0.12 else "particle_density")
    given += ["resistance"] if r.random() < 0.5 else ["beta", "flow_stress"]
    if guarded or r.random() < 0.35:
        given.append("stop_velocity")
    r.shuffle(given)
    return given

"""Workbooks of strangers: right sheets of the scheme in layouts that nobody tuned a program to.

`draw` draws a plan from a seed: inputs over decades, their units, words (known, of other languages,
random letters, none), places, columns, and how each formula is written. `build` makes the workbook
of a plan, with one slip or none. So it is known what is true of each workbook: `Truth`.

Nothing here is shared with the program under test, except that it is its scheme.
"""

import copy
import math
import random
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

from foreign import writers
from foreign.layouts import BRAKE, DEPTH, END, START, TIME, Foreign, Place, letters
from foreign.truth import CLEAN, EITHER, Truth, full
from foreign.vocabulary import FOREIGN, KNOWN, syllables

from replication.models.impact import Impact, particle_mass
from replication.models.sheet import run

# ---- what is drawn


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


# ---- faults


@dataclass(frozen=True)
class Slip:
    """One fault: what is wrong, in which column or of which input, and in which row if in one."""

    name: str
    column: str = ""
    row: int | None = None
    given: str = ""


ODD, SCHEME, UNIT = ("odd formula",), ("other scheme",), ("unit",)

IN_A_ROW = (
    ("plus x²", "area"), ("no x²", "area"), ("radius for diameter", "area"),
    ("no 1/2", "pressure"), ("cube of the velocity", "pressure"), ("no resistance", "pressure"),
    ("minus resistance", "pressure"), ("another number", "pressure"), ("twice", BRAKE),
    ("no pi", "area"), ("half a step", DEPTH), ("minus", DEPTH), ("row before", DEPTH),
    ("row before", BRAKE), ("column beside", DEPTH), ("plus", END), ("half a step", END),
    ("column beside", END),
)  # fmt: skip
"""Slips in a formula, each with the quantity that is wrong."""

OF_A_COLUMN = {
    "plus x²": EITHER, "no x²": EITHER, "radius for diameter": EITHER, "no 1/2": EITHER,
    "cube of the velocity": EITHER, "no resistance": EITHER, "minus resistance": EITHER,
    "twice": EITHER, "no pi": EITHER, "half a step": EITHER, "minus": EITHER, "plus": EITHER,
}  # fmt: skip
"""Those that somebody makes in all rows, and how they may then be called."""


KINDS = {
    "typed": ("typed number",), "typed, right digits": ("typed number",),
    "stale": ("stale value",), "stale, slightly": ("stale value",),
    "typed constant": ("typed constant",), "mass: 3.14": ("typed constant",),
    "no half step": SCHEME, "explicit Euler": SCHEME, "centered": SCHEME,
    "beyond the stop": SCHEME,
    "label": UNIT, "conversion": UNIT, "head": UNIT,
}  # fmt: skip
"""What slips are called that are no odd formulas."""

ROWS = {"typed constant": (1, 2), "explicit Euler": (2, 3)}
"""The first rows in which some slips in a column can be seen; others in one of the first three."""


SUMMED = (
    "typed",
    "typed, right digits",
    "stale",
    "stale, slightly",
    "typed constant",
    "lost $",
    "head",
)
"""The faults of depths that are sums."""

BEYOND = 4
"""So many rows too many are filled down."""


def kinds(slip: Slip) -> tuple[str, ...]:
    """What a slip is called."""
    if slip.row is None and slip.name in OF_A_COLUMN:
        return OF_A_COLUMN[slip.name]
    return KINDS.get(slip.name, ODD)


def slips(plan: Plan) -> list[Slip]:
    """Every fault that the workbook of a plan can have; rows and inputs are drawn."""
    r = random.Random(f"slip {plan.seed}")
    shown = {name: _shown(plan, name) for name in ("area", "pressure", BRAKE, DEPTH, END)}
    n = plan.steps
    found = [Slip(name, shown[where], r.randrange(3, n - 1)) for name, where in IN_A_ROW]
    found += [Slip(name, shown[where]) for name, where in IN_A_ROW if name in OF_A_COLUMN]
    roles = [role for role in (START, DEPTH, BRAKE, END) if role in plan.columns]
    for name in ("typed", "typed, right digits", "stale", "stale, slightly"):
        found.append(Slip(name, r.choice(roles), r.randrange(3, n - 1)))
    found += [
        Slip("no half step", DEPTH, 1),
        Slip("explicit Euler", DEPTH),
        Slip("centered", BRAKE),
    ]
    readers = [(given, column) for given in plan.given for column in _readers(plan, given)]
    for row in (r.randrange(3, n - 1), None):
        given, column = r.choice(readers)
        found.append(Slip("typed constant", column, row, given))
    given, column = r.choice(readers)
    found.append(Slip("lost $", column, None, given))
    found += [Slip(f"mass: {what}", "mass") for what in ("no third", "square", "3.14")]
    found += [Slip("diameter the radius", "diameter"), Slip("resistance a sum", "resistance")]
    found += [Slip("label", given=r.choice(plan.given)), Slip("head", column=DEPTH)]
    found += [Slip("conversion", given=r.choice(plan.given)), Slip("beyond the stop", END)]
    found += [Slip("result of the row before"), Slip("result over the diameter")]
    if plan.digits is not None:
        found = [slip for slip in found if slip.name == "typed"]
    if plan.summed:
        found = [slip for slip in found if slip.column != DEPTH or slip.name in SUMMED]
    return [slip for slip in found if _possible(plan, slip)]


def _shown(plan: Plan, quantity: str) -> str:
    """The column whose formula computes a quantity."""
    if quantity in plan.columns:
        return quantity
    if quantity == END:
        return START
    if BRAKE not in plan.columns:
        return END
    return "force" if quantity in ("area", "pressure") and "force" in plan.columns else BRAKE


def _readers(plan: Plan, given: str) -> list[str]:
    """The columns whose formulas read an input."""
    radius = ["area"]
    quantities = {
        "radius": radius, "diameter": radius, "target_density": ["pressure"],
        "resistance": ["pressure"], "beta": ["pressure"], "flow_stress": ["pressure"],
        "step": [DEPTH] if "change" in plan.columns else [DEPTH, END], "mass": [BRAKE],
        "particle_density": [BRAKE] if plan.mass == "inline" else [],
    }  # fmt: skip
    hidden = given in ("beta", "flow_stress") and _resistance_cell(plan)
    hidden = hidden or (given == "radius" and _diameter_cell(plan) and not plan.beyond)
    return [] if hidden else [_shown(plan, name) for name in quantities.get(given, [])]


def _possible(plan: Plan, slip: Slip) -> bool:
    """Whether the workbook can have the fault, and enough stands in it to call that a fault."""
    if slip.name in ("label", "head", "conversion"):
        return _unit_possible(plan, slip)
    if slip.name in ("centered", "explicit Euler", "column beside"):
        return plan.velocities == "both" and BRAKE in plan.columns
    if slip.name.startswith("mass: "):
        return plan.mass == "cell"
    if slip.name.startswith("result"):
        return _result(plan)
    match slip.name:
        case "beyond the stop":
            stops = "stop_velocity" in plan.given and not plan.guard and not _result(plan)
            return stops and plan.velocities == "both" and plan.inputs_at in ("above", "sheet")
        case "lost $":
            return plan.references == "absolute" and plan.inputs_at != "sheet"
        case "diameter the radius":
            return _diameter_cell(plan)
        case "resistance a sum":
            return _resistance_cell(plan)
    return True


def _unit_possible(plan: Plan, slip: Slip) -> bool:
    """Whether all units are stated, so that one that is wrong contradicts the others."""
    if plan.unit_beside_input == "none" or plan.unit_of_column == "none" or plan.words == "none":
        return False
    if slip.name == "head":
        return True
    power = plan.units[slip.given].power
    if slip.given in ("beta", "stop_velocity") or power is None:
        return False
    return plan.converted and not plan.flat and power != 0 if slip.name == "conversion" else (
        not plan.converted)  # fmt: skip


def _diameter_cell(plan: Plan) -> bool:
    return "radius" in plan.given and plan.style["area"] % 3 == 0


def _resistance_cell(plan: Plan) -> bool:
    return "beta" in plan.given and bool(plan.style["pressure"] % 2)


def _result(plan: Plan) -> bool:
    """Whether a cell with the words of a final depth shows it."""
    return plan.style["result"] < 6 and plan.words != "none" and plan.digits is None


# ---- the workbook


@dataclass
class Stranger:
    """A workbook with its stored values, and what is true of it."""

    plan: Plan
    slip: Slip | None
    book: Foreign
    truth: Truth
    values: writers.Values = field(default_factory=dict)


def build(plan: Plan, slip: Slip | None = None) -> Stranger | None:
    """Make the workbook of a plan; None if the slip changes nothing that could be seen."""
    right = _Builder(plan, None).stranger()
    if plan.style["second"] < 2 and plan.references != "names":
        _add_another(right, plan.seed)
    right.values = writers.calculated(right.book)
    if plan.digits is not None:
        _paste(right, plan.digits)
    if slip is None:
        return right
    if slip.name.startswith(("typed", "stale")) and slip.name != "typed constant":
        return _overwritten(right, slip)
    wrong = _Builder(plan, slip).stranger()
    added = {at: c for at, c in right.book.cells.items() if at not in wrong.book.cells}
    wrong.book.cells |= added
    wrong.values = writers.calculated(wrong.book)
    return wrong if _visible(right, wrong) else None


def _add_another(right: Stranger, seed: int) -> None:
    """Another right table with inputs of its own on sheets of its own."""
    plan = replace(draw(seed + 700_000, pasted=False), references="absolute")
    another = _Builder(plan, None).stranger().book
    sheets = {at[0] for at in another.cells}
    if sheets & {at[0] for at in right.book.cells}:
        return
    right.book.cells |= another.cells


def _paste(right: Stranger, digits: int) -> None:
    """Leave only numbers in the table, with few digits, and not all of the inputs."""
    cells, plan = right.book.cells, right.plan
    for at, text in list(cells.items()):
        value = right.values.get(at)
        if isinstance(text, str) and text.startswith("="):
            cells[at] = float(f"{value:.{digits}g}") if isinstance(value, float) else value
    kept = plan.style["inputs"] % 3
    for name, place in list(right.book.inputs.items()):
        if plan.inside and name == "velocity":
            continue
        if kept == 0 or (kept == 1 and name in ("radius", "target_density", "step")):
            del right.book.inputs[name]
            row, column = place[1], place[2]
            label = (row - 1, column) if plan.flat else (row, column - 1)
            for at in (label, (row, column), (row, column + 1), (row, column + 2)):
                if not (plan.flat and at[1] > column):
                    cells.pop((place[0], *at), None)
    right.values = {}


def _overwritten(right: Stranger, slip: Slip) -> Stranger | None:
    """A number typed over a formula, or a stored value that is not what the formula gives."""
    r = random.Random(f"value {right.plan.seed}")
    at = right.book.where[slip.column, slip.row or 1]
    value = right.values.get(at, right.book.cells[at])
    if not isinstance(value, float):
        return None
    wrong = replace(right, slip=slip, book=copy.deepcopy(right.book), values=dict(right.values))
    wrong.truth = _Builder(right.plan, slip).truth({})
    # A pasted number must be wrong by more than its digits and those of its neighbours leave open.
    factor = 1 + r.choice((1, -1)) * 10 ** r.uniform(-1.5 if right.plan.digits else -2.5, -0.5)
    match slip.name:
        case "typed":
            wrong.book.cells[at] = float(f"{value * factor:.{right.plan.digits or 5}g}")
        case "typed, right digits":
            wrong.book.cells[at] = float(f"{value:.{r.choice((6, 10, 17))}g}")
        case "stale":
            wrong.values[at] = value * factor
        case _:
            wrong.values[at] = value * (1 + r.choice((1, -1)) * 10 ** r.uniform(-10, -6))
    if slip.name.startswith("typed"):
        wrong.values = writers.calculated(wrong.book) if right.values else {}
    return wrong


def _visible(right: Stranger, wrong: Stranger) -> bool:
    """Whether a wrong formula can be told from the right one, and its table still has numbers.

    A typed constant and a wrong statement of a unit change no value.
    """
    assert wrong.slip
    texts = {at for at, c in wrong.book.cells.items() if right.book.cells.get(at) != c}
    if not texts:
        return False
    places = [at for at in right.book.where.values() if at in right.values]
    if not all(isinstance(wrong.values.get(at), float) for at in places):
        return False
    if wrong.slip.name in ("typed constant", "label", "head", "beyond the stop"):
        return True
    return any(_apart(right.values[at], wrong.values.get(at)) for at in texts if at in right.values)


def _apart(a: object, b: object) -> bool:
    """Whether two values differ by more than a millionth."""
    return not (isinstance(a, float) and isinstance(b, float)
                and math.isclose(a, b, rel_tol=1e-6))  # fmt: skip


class _Builder:
    """The cells of one workbook. Its methods return texts of formulas in SI units."""

    def __init__(self, plan: Plan, slip: Slip | None) -> None:
        self.plan, self.slip = plan, slip
        self.r = random.Random(f"cells {plan.seed}")
        names = ["Sheet1", "Tabelle1", "calc", "Hárok1", "run 7", "シート1", "x"]
        self.sheet = self.r.choice(names)
        self.input_sheet = self.sheet if plan.inputs_at != "sheet" else self.r.choice(["In", "p q"])
        self.book = Foreign(plan.name, plan.impact, si=False)
        self.cell_of: dict[str, Place] = {}
        self.touched: dict[str, set[Place]] = {}
        self.steps = plan.steps
        self.rows = self.steps + plan.spare
        if slip and slip.name == "beyond the stop":
            self.rows += BEYOND
        gap = 2 if plan.style["gap"] == 0 else 1
        self.left = 1 + plan.style["left"] % 5
        self.top = self._height() + 3 + plan.style["top"]
        start = self.left if plan.across else self.top
        heads = 2 if plan.unit_of_column == "row" else 1
        self.origin = start + heads  # the row or column of the impact
        first = self.top if plan.across else self.left
        self.line = {name: first + i * gap for i, name in enumerate(plan.columns)}
        if plan.inside:
            self.cell_of["velocity"] = self.book.inputs["velocity"] = self.at(START, 0)

    def _height(self) -> int:
        """How many rows the inputs take above the table."""
        if self.plan.inputs_at != "above":
            return 0
        return 3 if self.plan.flat else len(self.plan.given) + 5

    def stranger(self) -> Stranger:
        self._put_inputs()
        self._put_heads()
        for name in self.plan.columns:
            for k in range(0 if self.plan.zero else 1, self.rows + 1):
                self._put_row(name, k)
        results = self._put_results()
        self._put_notes()
        return Stranger(self.plan, self.slip, self.book, self.truth(results))

    # words

    def word(self, name: str) -> str:
        """The words for an input or a column."""
        match self.plan.words:
            case "known":
                return self.r.choice(KNOWN[name])
            case "foreign":
                return self.r.choice(FOREIGN[name])
            case "letters":
                return syllables(self.r)
        return ""

    def unit(self, name: str) -> str:
        """The name of the unit that the workbook states."""
        unit = self.plan.units[name].name
        slip = self.slip
        if slip and (slip.name, slip.given or slip.column) in (("label", name), ("head", name)):
            power = self.plan.units[name].power
            other = [u.name for u in UNITS[name] if u.power not in (power, None)]
            return random.Random(f"unit {self.plan.seed}").choice(other)
        return unit

    # inputs

    def _input_place(self, i: int) -> tuple[int, int]:
        plan = self.plan
        if plan.inputs_at == "beside" and not plan.across:
            row, column = 2, max(self.line.values()) + 3
        elif plan.inputs_at == "below" or plan.inputs_at == "beside":
            down = max(self.line.values()) if plan.across else self.origin + self.rows
            row, column = down + 4, 2
        else:
            row, column = 2, 1 + plan.style["left"] % 3
        return (row + 1, column + i) if plan.flat else (row + i, column + 1)

    def _put_inputs(self) -> None:
        plan = self.plan
        derived = {"diameter": _diameter_cell(plan), "mass": plan.mass == "cell",
                   "resistance": _resistance_cell(plan)}  # fmt: skip
        names = (*plan.given, *(name for name, has in derived.items() if has))
        if plan.style["pi"] == 0:
            names = (*names, "pi")
        at = {name: (self.input_sheet, *self._input_place(i)) for i, name in enumerate(names)}
        for name in names:
            self._put_label(name, at[name])
        for name in plan.given:
            self._put_number(name, at[name])
        if "pi" in names:
            self.cell_of["pi"] = at["pi"]
        formulas = {"diameter": self._diameter_formula, "mass": self._mass_formula,
                    "resistance": self._resistance_formula, "pi": lambda: "PI()"}  # fmt: skip
        for name in names[len(plan.given) :]:
            self.book.cells[at[name]] = f"={formulas[name]()}"
            self.cell_of[name] = at[name]
        if plan.references == "names":
            for name, place in self.cell_of.items():
                address = f"'{place[0]}'!{_ref(place, '$')}"
                self.book.names[self._defined_name(name)] = address

    def _put_label(self, name: str, at: Place) -> None:
        """The words and the unit of an input, or of what follows from inputs."""
        plan, (sheet, row, column) = self.plan, at
        self.touched[name] = {at}
        label = (sheet, row - 1, column) if plan.flat else (sheet, row, column - 1)
        words, unit = (
            self.word(name),
            self.unit(name) if name in plan.given else UNITS[name][0].name,
        )
        if plan.unit_beside_input == "none":
            unit = ""
        if words and unit and (plan.unit_beside_input == "label" or plan.flat):
            words = f"{words} [{unit}]"
        elif unit and not plan.flat:
            self.book.cells[sheet, row, column + 1] = unit
            self.touched[name].add((sheet, row, column + 1))
        if words:
            self.book.cells[label] = words
            self.touched[name].add(label)

    def _put_number(self, name: str, at: Place) -> None:
        """The number of an input, and in a cell beside what it is in SI units."""
        plan, (sheet, row, column) = self.plan, at
        self.book.cells[at] = plan.numbers[name]
        self.book.inputs[name] = self.cell_of[name] = at
        if plan.converted and plan.units[name].power != 0 and not plan.flat:
            si = (sheet, row, column + 2)
            self.book.cells[si] = f"={_ref(at, '')}{self._to_si(name, wrong=True)}"
            self.cell_of[f"{name} in SI"] = si
            self.touched[name].add(si)

    def _defined_name(self, name: str) -> str:
        short = {"step": "dt_", "radius": "Rad_", "diameter": "Dia_", "velocity": "Vel_"}
        base = short.get(name, f"q_{name.replace(' ', '_')}")
        return f"z{[*self.cell_of].index(name)}_" if self.plan.words == "letters" else base

    def _to_si(self, name: str, *, wrong: bool = False) -> str:
        """What follows a number in the unit of an input or a column to convert it."""
        unit = self.plan.units[name]
        power = unit.power
        if power is None:
            return f"*{unit.si!r}"
        slip = self.slip
        if wrong and slip and slip.name == "conversion" and slip.given == name:
            power += 3 if power < 0 else -1
        return _times(power, self.plan.style["power"])

    def _wrong(self, name: str, k: int | None = None) -> bool:
        """Whether the slip of that name is to be made in row k."""
        slip = self.slip
        return slip is not None and slip.name == name and slip.row in (None, k)

    def given(self, name: str, column: str = "", k: int = 0) -> str:
        """An input in SI units, as a formula reads it."""
        slip, plan = self.slip, self.plan
        here = slip and slip.given == name and slip.column == column and column
        own = self.cell_of.get(f"{name} in SI")
        at = own or self.cell_of[name]
        suffix = "" if own or name not in plan.given else self._to_si(name)
        if name == "velocity" and plan.inside:
            suffix = self._factor(START)
        if here and slip and slip.name == "typed constant" and slip.row in (None, k):
            number = plan.numbers[name] * (plan.units[name].si if own else 1.0)
            return _bracketed(_plain(float(f"{number:.15g}")), suffix)
        if here and slip and slip.name == "lost $" and k > 1:
            moved = (at[0], at[1], at[2] + k - 1) if plan.across else (at[0], at[1] + k - 1, at[2])
            return _bracketed(_ref(moved, ""), suffix)
        return _bracketed(self._reference(name if own is None else f"{name} in SI", at), suffix)

    def _reference(self, name: str, at: Place) -> str:
        if self.plan.references == "names":
            return self._defined_name(name)
        prefix = "" if at[0] == self.sheet else f"'{at[0]}'!"
        if self.plan.references == "mixed":
            row, column = ("", "$") if self.plan.across else ("$", "")
            return f"{prefix}{column}{letters(at[2])}{row}{at[1]}"
        return prefix + _ref(at, "$")

    def radius(self, column: str = "", k: int = 0) -> str:
        if "radius" in self.plan.given:
            return self.given("radius", column, k)
        return f"({self.given('diameter', column, k)}/2)"

    def diameter(self, column: str = "", k: int = 0) -> str:
        if "diameter" in self.cell_of:
            return self.given("diameter", column, k)
        return f"2*{self.given('radius', column, k)}"

    def resistance(self, column: str = "", k: int = 0) -> str:
        if "resistance" in self.cell_of:
            return self.given("resistance", column, k)
        return f"{self.given('beta', column, k)}*{self.given('flow_stress', column, k)}"

    def pi(self) -> str:
        return self.given("pi") if "pi" in self.cell_of else "PI()"

    def _diameter_formula(self) -> str:
        factor = "1*" if self._wrong("diameter the radius") else "2*"
        return f"{factor}{self.given('radius')}"

    def _resistance_formula(self) -> str:
        sign = "+" if self._wrong("resistance a sum") else "*"
        return f"{self.given('beta')}{sign}{self.given('flow_stress')}"

    def _mass_formula(self, column: str = "", k: int = 0) -> str:
        pi = "3.14" if self._wrong("mass: 3.14") else self.pi()
        power = 2 if self._wrong("mass: square") else 3
        rho = self.given("particle_density", column, k)
        if "diameter" in self.plan.given and self.plan.style["mass"] % 2:
            whole = pi if self._wrong("mass: no third") else f"{pi}/6"
            return f"{rho}*{whole}*{self.given('diameter', column, k)}^{power}"
        third = "4" if self._wrong("mass: no third") else "4/3"
        R = self.radius(column, k)
        forms = (f"{third}*{pi}*{R}^{power}*{rho}", f"{rho}*{third}*{pi}*{R}^{power}")
        return forms[self.plan.style["mass"] % len(forms)]

    # the table

    def at(self, name: str, k: int) -> Place:
        line = self.line[name]
        if self.plan.across:
            return self.sheet, line, self.origin + k
        return self.sheet, self.origin + k, line

    def _put_heads(self) -> None:
        heads = 2 if self.plan.unit_of_column == "row" else 1
        shown = 0 if self.plan.zero else 1
        for name in self.plan.columns:
            words, unit = self.word(name), self.unit(name)
            if self.plan.unit_of_column == "none":
                unit = ""
            if heads == 1 and unit and words:
                words = (f"{words} ({unit})", f"{words} [{unit}]", f"{words}, {unit}")[
                    self.plan.style["head"] % 3
                ]
            self.touched[name] = {self.at(name, shown), self.at(name, 1)}
            if words:
                self.book.cells[self.at(name, shown - heads)] = words
                self.touched[name].add(self.at(name, shown - heads))
            if heads == 2 and unit:
                self.book.cells[self.at(name, shown - 1)] = unit
                self.touched[name].add(self.at(name, shown - 1))

    def ref(self, name: str, k: int) -> str:
        """The reference to a cell of the table."""
        _, row, column = self.at(name, k)
        if self.plan.style["dollar"] == 0:
            return f"{letters(column)}${row}" if self.plan.across else f"${letters(column)}{row}"
        return f"{letters(column)}{row}"

    def value(self, name: str, k: int) -> str:
        """A cell of the table in SI units."""
        return _bracketed(self.ref(name, k), self._factor(name))

    def _factor(self, name: str) -> str:
        """What follows a number of a column to convert it to SI units."""
        return _times(self.plan.units[name].power or 0, self.plan.style["power"])

    def _put_row(self, name: str, k: int) -> None:
        cell = self.at(name, k)
        content = self._content(name, k)
        if content is not None:
            self.book.cells[cell] = content
            if name in (TIME, START, DEPTH, BRAKE, END) and k <= self.steps:
                self.book.where[name, k] = cell

    def _content(self, name: str, k: int) -> str | float | None:
        """What a cell of the table holds."""
        slip, plan = self.slip, self.plan
        if k == 0:
            return self._impact(name)
        row = k
        if slip and slip.name == "row before" and (slip.column, slip.row) == (name, k):
            row = k - 1  # copied without moving its references
        if name == "count":
            text = f"{self.ref('count', row - 1)}+1" if k > 1 or plan.zero else ""
            if not text:
                return 1.0
        else:
            text = self._in_unit(name, row)
        if plan.guard and not (k == 1 and name in ("count", START, DEPTH)):
            text = self._guarded(name, text, row)
        return f"={text}"

    def _guarded(self, name: str, text: str, k: int) -> str:
        """The formula with a guard that leaves the rows after the stop blank."""
        if self.plan.guard == "count" and name != "count":
            return f'IF(ISNUMBER({self.ref("count", k)}),{text},"")'
        if k == 1:
            return text
        # A blank text counts as zero, so that it is below the stop velocity.
        low = _bracketed(f"N({self.ref(END, k - 1)})", self._factor(END))
        blank = "NA()" if self.plan.style["blank"] % 3 == 0 else '""'
        return f"IF({low}<{self.given('stop_velocity')},{blank},{text})"

    def _impact(self, name: str) -> str | float | None:
        """What the row of the impact shows."""
        own = "=" + self._to_unit(START, self.given("velocity"))
        if self.plan.inside and name == START:
            return self.plan.numbers["velocity"]
        blank = self.plan.style["first"] % 2
        match name:
            case "count" | "time" | "depth":
                return 0.0
            case "velocity_initial":
                return own
            case "velocity_final":
                return (
                    own if self.plan.velocities == "end" or self.plan.style["first"] % 3 else None
                )
            case "deceleration":
                return None if blank else 0.0
            case "ratio":
                return 0.0
        return None

    def _to_unit(self, name: str, text: str) -> str:
        power = self.plan.units[name].power or 0
        return f"({text}){_times(-power, self.plan.style['power'])}" if power else text

    def _in_unit(self, name: str, k: int) -> str:
        """The formula of a column in step k, in its unit."""
        if name == START:
            return self._start(k)
        formulas = {
            TIME: self._time, DEPTH: self._depth, "area": self._pi_area, BRAKE: self._deceleration,
            "pressure": self._pressure, "force": self._force, "change": self._change,
            END: self._end, "ratio": self._ratio, "energy": self._energy,
        }  # fmt: skip
        return self._to_unit(name, formulas[name](k))

    def _change(self, k: int) -> str:
        return f"{self.value(BRAKE, k)}*{self.step('change', k)}"

    def _ratio(self, k: int) -> str:
        return f"{self.value(DEPTH, k)}/{self.radius()}"

    def _energy(self, k: int) -> str:
        mass = self.given("mass") if "mass" in self.cell_of else f"({self._mass_formula()})"
        return f"0.5*{mass}*{self._velocity(k)}^2"

    def _pi_area(self, k: int) -> str:
        return self._area(k) if self._wrong("no pi", k) else f"{self.pi()}*{self._area(k)}"

    def step(self, column: str, k: int) -> str:
        return self.given("step", column, k)

    def _time(self, k: int) -> str:
        dt, way = self.step(TIME, k), self.plan.style["time"] % 4
        if way == 1 and "count" in self.plan.columns:
            return f"{self.ref('count', k)}*{dt}"
        if way == 2 and not self.plan.across:
            return f"(ROW()-{self.origin})*{dt}"
        if k == 1 and not self.plan.zero:
            return f"1*{dt}"
        return f"{self.value(TIME, k - 1)}+{dt}"

    def _velocity(self, k: int) -> str:
        """The velocity at the beginning of step k."""
        return self.value(END, k - 1) if self.plan.velocities == "end" else self.value(START, k)

    def _start(self, k: int) -> str:
        if k == 1:
            shown = self.plan.zero and self.plan.style["first"] % 4 == 0
            own = self._to_unit(START, self.given("velocity"))
            return self.ref(START, 0) if shown else own
        if self.plan.velocities == "both":
            return self.ref(END, k - 1)
        return self._to_unit(START, self._slower(START, k - 1, k))

    def _end(self, k: int) -> str:
        return self._slower(END, k, k)

    def _slower(self, column: str, k: int, row: int) -> str:
        """The velocity at the end of step k, in a cell of that row."""
        sign = "+" if self.plan.negative else "-"
        if self._wrong("plus", row):
            sign = "-" if sign == "+" else "+"
        half = "/2" if self._wrong_in("half a step", column, row) else ""
        v = self._velocity(k)
        if self._wrong_in("column beside", column, row):
            v = self.value(DEPTH, k)
        if "change" in self.plan.columns:
            return f"{v}{sign}{self.value('change', k)}{half}"
        dt, a = self.step(column, row), f"({self._deceleration(k)})"
        if BRAKE in self.plan.columns:
            a = self.value(BRAKE, k)
        product = f"{a}*{dt}" if self.plan.style["end"] % 2 else f"{dt}*{a}"
        return f"{v}{sign}{product}{half}"

    def _wrong_in(self, name: str, column: str, k: int) -> bool:
        return self.slip is not None and self.slip.column == column and self._wrong(name, k)

    def _depth(self, k: int) -> str:
        v, dt = self._velocity(k), self.step(DEPTH, k)
        if self.plan.summed:
            first, factor = _ref(self.at(START, 1), "$"), self._factor(START)
            return f"{dt}*(SUM({first}:{self.ref(START, k)}){factor}-{first}{factor}/2)"
        if k > 1 and self._wrong("explicit Euler"):
            v = self._velocity(k - 1)
        if self._wrong_in("column beside", DEPTH, k):
            v = self.value(BRAKE, k - 1)
        whole = f"{v}*{dt}" if self.plan.style["depth"] % 2 else f"{dt}*{v}"
        half = (f"{v}*{dt}/2", f"{v}*({dt}/2)", f"0.5*{dt}*{v}", f"{v}/2*{dt}", f"{dt}*{v}*0.5")[
            self.plan.style["half"] % 5
        ]
        if k == 1:
            text = whole if self._wrong("no half step", 1) else half
            before = self.plan.zero and self.plan.style["half"] > 6
            return f"{self.value(DEPTH, 0)}+{text}" if before else text
        if self._wrong_in("half a step", DEPTH, k):
            whole = f"{whole}/2"
        sign = "-" if self._wrong_in("minus", DEPTH, k) else "+"
        return f"{self.value(DEPTH, k - 1)}{sign}{whole}"

    def _area(self, k: int) -> str:
        """The contact area over pi, in brackets."""
        column = _shown(self.plan, "area")
        x, D, R = self.value(DEPTH, k), self.diameter(column, k), self.radius(column, k)
        if self._wrong("radius for diameter", k):
            D = R
        sign = "+" if self._wrong("plus x²", k) else "-"
        way = self.plan.style["area"]
        inner = f"{D}*{x}{sign}{x}^2" if way % 2 else f"{x}*({D}{sign}{x})"
        if self._wrong("no x²", k):
            inner = f"{D}*{x}"
        if self.plan.beyond:
            return f"IF({x}<{R},{inner},{R}^2)"
        return f"({inner})"

    def _pressure(self, k: int, velocity: str = "") -> str:
        column = _shown(self.plan, "pressure")
        v, rho = velocity or self._velocity(k), self.given("target_density", column, k)
        square = (f"{v}^2", f"{v}*{v}", f"POWER({v},2)", f"{v}^2")[self.plan.style["square"] % 4]
        if self._wrong("cube of the velocity", k):
            square = f"{v}^3"
        half, by = "0.5*", "/2"
        if self._wrong("no 1/2", k):
            half, by = "", ""
        if self._wrong("another number", k):
            half, by = "0.6*", "/3"
        drag = (f"{half}{rho}*{square}", f"{rho}*{square}{by}")[
            self.plan.style["pressure"] % 4 // 2
        ]
        if self._wrong("no resistance", k):
            return drag
        R_t = self.resistance(column, k)
        if self._wrong("minus resistance", k):
            return f"{drag}-{R_t}"
        return f"{R_t}+{drag}" if self.plan.style["pressure"] > 8 else f"{drag}+{R_t}"

    def _force(self, k: int, velocity: str = "") -> str:
        columns = self.plan.columns
        stress = self.value("pressure", k) if "pressure" in columns and not velocity else (
            f"({self._pressure(k, velocity)})")  # fmt: skip
        if "area" in columns:
            return f"{stress}*{self.value('area', k)}"
        pi = "" if self._wrong("no pi", k) else f"{self.pi()}*"
        return f"{stress}*{pi}{self._area(k)}"

    def _deceleration(self, k: int) -> str:
        column = _shown(self.plan, BRAKE)
        M = self.given("mass", column, k) if "mass" in self.cell_of else (
            f"({self._mass_formula(column, k)})")  # fmt: skip
        force = self.value("force", k) if "force" in self.plan.columns else self._force(k)
        if self.slip and self.slip.name == "centered":
            middle = f"({self._velocity(k)}-{self._force(k)}/{M}*{self.step('', k)}/2)"
            force = self._force(k, middle)
        twice = "2*" if self._wrong("twice", k) else ""
        minus = "-" if self.plan.negative else ""
        return f"{minus}{twice}{force}/{M}"

    # results and notes

    def _put_results(self) -> dict[str, Place]:
        """Final depth and X/R, with words that are known, on the sheet of the table."""
        plan = self.plan
        if not _result(plan):
            return {}
        rows = [self.at(name, k) for name in plan.columns for k in (0, self.rows)]
        column = max(c for _, _, c in [*rows, *self.book.cells]) + 3
        last = self.steps - (1 if self._wrong("result of the row before") else 0)
        # A largest depth of rows that end with #N/A is #N/A.
        way = plan.style["result"] % 3 if plan.guard != "velocity" else 0
        cells = f"{self.ref(DEPTH, 1)}:{self.ref(DEPTH, self.rows)}".replace("$", "")
        text = self.ref(DEPTH, last)
        if way == 1 and last == self.steps:
            text = f"MAX({cells})"
        elif way == 2:
            text = f"INDEX({cells},COUNT({cells}){'' if last == self.steps else '-1'})"
        unit = plan.units[DEPTH].name
        over = self.diameter() if self._wrong("result over the diameter") else self.radius()
        depth, ratio = (self.sheet, 2, column), (self.sheet, 3, column)
        self.book.cells[self.sheet, 2, column - 1] = f"final depth [{unit}]"
        self.book.cells[depth] = f"={text}"
        self.book.cells[self.sheet, 3, column - 1] = "X/R"
        si = _bracketed(_ref(depth, ""), _times(plan.units[DEPTH].power or 0, plan.style["power"]))
        self.book.cells[ratio] = f"={si}/({over})"
        return {"depth": depth, "ratio": ratio}

    def _put_notes(self) -> None:
        """A title, a date, a note below, a sheet more: what stands around."""
        plan, cells = self.plan, self.book.cells
        bottom = max(row for sheet, row, _ in cells if sheet == self.sheet)
        if plan.style["notes"] % 3 == 0:
            cells[self.sheet, bottom + 3, 1] = self.word("note") or "12/3"
        if plan.style["notes"] % 4 == 0 and plan.style["top"] > 2 and plan.words != "none":
            cells[self.sheet, 1, 1] = self.word("title")
        if plan.style["second"] == 7:
            cells["zz", 1, 1] = self.word("title") or "3"
            for i in range(2, 9):
                cells["zz", i, 1] = float(i)
                cells["zz", i, 2] = f"=A{i}^2/7"

    # what is true

    def truth(self, results: dict[str, Place]) -> Truth:
        if self.slip is None:
            return CLEAN
        cells = tuple(map(full, self._accused(self.slip, results)))
        return Truth(1, kinds(self.slip), cells)

    def _accused(self, slip: Slip, results: dict[str, Place]) -> Iterable[Place]:
        """The cells in which a slip can be seen."""
        if slip.name in ("label", "conversion", "head"):
            return self.touched[slip.given or slip.column]
        if slip.name.startswith("result"):
            return (results["ratio" if "diameter" in slip.name else "depth"],)
        if slip.column not in self.line:
            return (self.cell_of[slip.column],)
        rows: Iterable[int] = (slip.row,) if slip.row else ROWS.get(slip.name, (1, 2, 3))
        if slip.name == "beyond the stop":
            rows = range(self.steps, self.rows + 1)
        return (self.at(slip.column, k) for k in rows)


def _ref(at: Place, dollar: str) -> str:
    return f"{dollar}{letters(at[2])}{dollar}{at[1]}"


def _bracketed(text: str, suffix: str) -> str:
    return f"({text}{suffix})" if suffix else text


def _plain(number: float) -> str:
    """A number as one types it into a formula."""
    text = repr(number)
    return text.replace("e", "E") if "e" in text else text.removesuffix(".0")


def _times(power: int, way: int) -> str:
    """What multiplies by a power of ten, in one of the ways of writing that."""
    if power == 0:
        return ""
    ways = (
        f"*1E{power}",
        f"/1{'0' * -power}" if power < 0 else f"*1{'0' * power}",
        f"*10^{power}" if power > 0 else f"*10^({power})",
        f"*0.{'0' * (-power - 1)}1" if power < 0 else f"/0.{'0' * (power - 1)}1",
    )
    return ways[way % 4]

"""The inputs of a table: which cells hold them, in which units, and what the rows say of the rest.

Only cells that the table's formulas read count as its inputs, through however many cells between.
They are told apart by label, name, unit and value. What no cell holds is taken from the formulas'
own numbers, or solved back from the rows, and is said to be so.
"""

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import fields, replace
from fractions import Fraction
from functools import cache
from itertools import islice, product
from statistics import median

from reference.ledger import claims_of_case, load
from reference.units import same_dimension, to_si
from replication.check.examination import Examination, Input, near
from replication.check.scheme import BRAKES, REPORT, Case, Rows, contact
from replication.check.table import FEW, Table, address
from replication.check.words import (
    INPUTS,
    between_units,
    input_roles,
    is_unit,
    power_of_ten,
    scaled,
    title,
    titles,
    unit_in,
    unit_power,
)  # fmt: skip
from replication.models import crater
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation

_MAX_CANDIDATES = 4_000
_MAX_CHOICES = 64
RESTS_ON = {
    "diameter": ("radius",),
    "mass": ("radius", "particle_density"),
    "resistance": ("beta", "flow_stress"),
}
"""What follows from other inputs, and from which."""


@cache
def report_inputs() -> dict[str, tuple[float, ...]]:
    """The report's inputs in SI, for both betas and steps; its target density as inferred."""
    five, three = claims_of_case(5), claims_of_case(3)
    names = {role: (claim,) for role, claim in five.items()} | {
        "diameter": ("a1-diameter",),
        "mass": ("a1-mass",),
        "beta": (five["beta"], three["beta"]),
        "step": (five["step"], "coarse-step"),
    }
    ledger = load()
    values = {
        role: tuple(float(ledger.value(claim)) for claim in claims)
        for role, claims in names.items()
    }
    values["resistance"] = tuple(beta * values["flow_stress"][0] for beta in values["beta"])
    return values


def find(
    table: Table,
    candidates: Sequence[Input],
    mapped: Mapping[str, Position],
    read: Mapping[Position, int],
    elsewhere: Set[Position],
) -> Examination:
    """What is known of a table before it is judged.

    `candidates` are what `numbers_beside` gives, `mapped` the cells that the user named,
    `read` the cells that it reads, as `read_beside` gives them, `elsewhere` those that other tables
    read. Raises ValueError, saying what to give, when two cells could be the same input and the
    rows do not decide.
    """
    calculation = table.calculation
    names = {name for formula in calculation.formulas.values() for name in formula.names}

    def is_read(cell: Input) -> bool:
        return cell.place in read if cell.place else cell.label.upper() in names

    reads = [cell for cell in candidates if not (read or names) or is_read(cell)]
    reads = _told_by_mass(_not_made_of(reads, calculation), calculation)
    nearest = {
        role: _nearest(cells, read, calculation)
        for role, cells in _by_role(reads, bool(read), _hinted(table)).items()
    }
    nearest |= _either_density(reads, calculation)
    choices = _typed_first(nearest, reads, calculation) | _as_mapped(mapped, candidates, table)
    seen = {*read, *calculation.formulas}
    idle = [c for c in candidates if c.label and c.place not in seen and c not in reads]
    unread = _by_role(idle, True)
    # Whoever ends the rows by hand reads the stop velocity with his eyes; a wrong formula for the
    # mass need not read the density; and where decelerations are typed, nothing reads an input.
    brake = table.lines.get("deceleration")
    is_typed = brake is not None and not any(map(brake.formula, range(brake.first, brake.last + 1)))
    given = {*choices, *unread}
    free = [role for role in unread if not given.issuperset(RESTS_ON.get(role, ("",)))]
    for role in free if is_typed else ("stop_velocity", "particle_density"):
        lone = [cell for cell in unread.get(role, ()) if cell.place not in elsewhere]
        if role not in choices and len(lone) == 1:
            choices[role] = lone
            del unread[role]
    if not {*choices, *unread}.issuperset(RESTS_ON["resistance"]):
        called = [c for c in nearest.get("resistance", ()) if c.how != "value" and c.si > 0]
        if called:  # whatever else its formula reads, it is the resistance
            choices.setdefault("resistance", called)
    feeding = _feeding({**nearest, **choices}, reads, calculation)
    rounded = (cell.si for cell in reads if math.isclose(cell.si, math.pi, rel_tol=1e-14))
    examination = _settled(table, choices, feeding, next(rounded, math.pi))
    left = {role: cells[0] for role, cells in nearest.items() if cells[0].place}
    settled = {role: entry for role, entry in examination.inputs.items() if entry.place}
    derived = {r: c for r, c in {**left, **settled, **examination.derived}.items() if r in RESTS_ON}
    # Mass and diameter are computed for nothing where their values are typed into the rows.
    unused = calculation.formulas.keys() - read.keys() - elsewhere if read else ()
    computed = [c for c in candidates if c.roles & RESTS_ON.keys() and c.place in unused]
    by_role = _by_role(computed, False)
    unread |= {role: cells for role, cells in by_role.items() if role not in derived}
    own = [_own(cells, examination, read, elsewhere) for cells in unread.values()]
    single = tuple(cell for cell in own if cell)
    return replace(examination, read=frozenset(read), derived=derived, unread=single)


_OF_MATERIALS = frozenset({"particle_density", "target_density", "flow_stress"})


def _own(
    cells: Sequence[Input], f: Examination, read: Collection[Position], elsewhere: Set[Position]
) -> Input | None:
    """Of cells for one input that a table does not read the one that it should; None if not clear.

    What another table reads is this one's only if it stands among this one's inputs with the value
    that the rows take, or is a property of the materials, which tables share. Of several, it is the
    nearest to cells that the table reads.
    """
    used = f.inputs.get(cells[0].role)
    sheets = {f.table.sheet, *(place[0] for place in read)}

    def rank(cell: Input) -> tuple[bool, float]:
        alike = used is not None and near(cell.si, used.si)
        _, row, column = place = cell.place or ("", 0, 0)
        far = (abs(p[1] - row) + abs(p[2] - column) for p in read if p[0] == place[0])
        return not alike, min(far, default=math.inf)

    ranks = {
        cell: rank(cell)
        for cell in cells
        if not elsewhere or (cell.place and cell.place[0] in sheets)
        if cell.place not in elsewhere or cell.role in _OF_MATERIALS or not rank(cell)[0]
    }
    nearest = [cell for cell in ranks if ranks[cell] == min(ranks.values())]
    return nearest[0] if len(nearest) == 1 else None


def read_beside(table: Table) -> dict[Position, int]:
    """The cells beside a table that its formulas read, and through how many others."""
    read = _read(table.places, table.calculation)
    return {place: far for place, far in read.items() if place not in table.places}


def _as_mapped(
    mapped: Mapping[str, Position], candidates: Sequence[Input], table: Table
) -> dict[str, list[Input]]:
    """The cells that the user named, as inputs. Raises ValueError for one without a number."""
    inputs = {}
    for role, place in mapped.items():
        value = table.calculation.number(place)
        if value is None:
            raise ValueError(f"--map {role}: the cell {address(place, True)} holds no number")
        known = next((c for c in candidates if c.place == place), Input("", value, place, ""))
        inputs[role] = [replace(as_role(known, role, report_inputs()), how="--map")]
    return inputs


def _feeding(
    by_role: Mapping[str, Sequence[Input]], reads: Sequence[Input], calculation: Calculation
) -> dict[str, Input]:
    """The cells of mass, diameter and resistance, by label or by what they read.

    One without a known label is the mass if its formula reads radius and density and nothing else.
    """
    feeding = {role: cells[0] for role, cells in by_role.items() if role in RESTS_ON}
    for role in ("mass", "resistance"):
        sources = {by_role[of][0].place if of in by_role else None for of in RESTS_ON[role]}
        for cell in reads if role not in feeding and None not in sources else ():
            areas = () if cell.roles else calculation.areas(cell.place)
            if areas and {calculation.source(area.corner) for area in areas} == sources:
                feeding.setdefault(role, replace(cell, role=role))
    return feeding


def _not_made_of(cells: list[Input], calculation: Calculation) -> list[Input]:
    """The cells; of those made of an input of their name and others, as R_t/M is, the name goes."""
    called = {cell.place: cell.roles for cell in cells}

    def named(cell: Input) -> Input:
        of = {name for role in cell.roles for name in RESTS_ON.get(role, ())}
        read = [called.get(area.corner) for area in calculation.areas(cell.place)]
        alike = {bool(cell.roles & roles) for roles in read if roles and not roles & of}
        is_made = len(alike) == 2 and cell.unit is None
        return replace(cell, roles=frozenset(), label="") if is_made else cell

    return list(map(named, cells))


_DENSITIES = frozenset({"particle_density", "target_density"})


def _told_by_mass(cells: list[Input], calculation: Calculation) -> list[Input]:
    """The cells; of densities whose labels do not say whose, that which the mass reads is said so.

    It is the particle's.
    """
    unsaid = {cell.place for cell in cells if cell.place and cell.roles == _DENSITIES}
    masses = (c.place for c in cells if c.place and (c.roles == {"mass"} or c.unit in ("kg", "g")))
    for place in masses:
        of_particle = unsaid & _read([place], calculation).keys()
        if len(of_particle) == 1 < len(unsaid):
            whose: dict[Position | None, str] = dict.fromkeys(unsaid, "target_density")
            whose |= dict.fromkeys(of_particle, "particle_density")
            return [
                replace(cell, roles=frozenset({whose[cell.place]})) if cell.place in whose else cell
                for cell in cells
            ]
    return cells


def _either_density(cells: Sequence[Input], calculation: Calculation) -> dict[str, list[Input]]:
    """Two densities whose labels do not say of what, each as that of either: the rows decide.

    Not if one is the other in another unit.
    """
    unsaid = [cell for cell in cells if cell.place and cell.roles == _DENSITIES]
    places = {cell.place for cell in unsaid}
    converts = any(places & _read([p], calculation).keys() - {p} for p in places if p)
    if len(unsaid) != 2 or converts or any(len(c.roles & _DENSITIES) == 1 for c in cells):
        return {}
    report = report_inputs()
    return {role: [as_role(c, role, report) for c in unsaid] for role in sorted(_DENSITIES)}


def _typed_first(
    nearest: Mapping[str, list[Input]], reads: Sequence[Input], calculation: Calculation
) -> dict[str, list[Input]]:
    """Of the cells for each role those that are typed, or that take over a typed one of that role.

    Where there are none, all; but what rests on other inputs is then left to them.
    """
    called = {(cell.place, role) for cell in reads for role in cell.roles}

    def is_typed(cell: Input) -> bool:
        areas = calculation.areas(cell.place)
        return not areas or any((area.corner, cell.role) in called for area in areas)

    return {
        role: list(filter(is_typed, cells)) or cells
        for role, cells in nearest.items()
        if role not in RESTS_ON or any(map(is_typed, cells))
    }


def _read(cells: Iterable[Position], calculation: Calculation) -> dict[Position, int]:
    """Every cell that some cells' formulas read, and through how many others; 0 for themselves."""
    edge = list(cells)
    distances = dict.fromkeys(edge, 0)
    distance = 0
    while edge:
        distance += 1
        areas = (area for place in edge for area in calculation.areas(place) if area.cells <= FEW)
        edge = list({p for area in areas for p in area.places() if p not in distances})
        distances.update(dict.fromkeys(edge, distance))
    return distances


def _nearest(
    cells: Sequence[Input], read: Mapping[Position, int], calculation: Calculation
) -> list[Input]:
    """Of the cells for one role those that are read most directly; constants behind conversions."""
    far = {cell: read.get(cell.place, 0) if cell.place else 0 for cell in cells}
    near = [cell for cell in cells if far[cell] == min(far.values())]
    sources = {calculation.source(cell.place) for cell in near if cell.place}
    return [cell for cell in cells if cell.place in sources] or near


# ---- cells by label, name and value


def numbers_beside(calculation: Calculation, tables: Sequence[Table]) -> Iterator[Input]:
    """Every number beside the tables, with its label or name; and names that are numbers."""
    inside = [line for table in tables for line in table.every_line]
    numbers = (place for place, value in calculation.values.items() if isinstance(value, float))
    beside = (place for place in numbers if not any(line.covers(place) for line in inside))
    for place in islice(beside, _MAX_CANDIDATES):
        label, unit = label_of(place, calculation)
        roles, how = input_roles(label, unit) if label else frozenset(), "label"
        if not roles and place in calculation.named:
            label, how = calculation.named[place], "name"
            roles = input_roles(label, unit)
        value = calculation.number(place) or 0.0
        if not roles and label and unit and same_dimension(unit, INPUTS["particle_density"]):
            roles = _DENSITIES  # in a language that is not known
        yield Input("", value, place, how, label, unit, roles=roles)
    for name, meaning in calculation.book.names.items():
        try:
            value = float(meaning)
        except ValueError:
            continue
        if math.isfinite(value):
            label = name.rpartition("!")[2]
            yield Input("", value, None, "name", label, roles=input_roles(label, None))


def label_of(place: Position, calculation: Calculation) -> tuple[str, str | None]:
    """The label of a number, at its left, above or at its right, and its unit."""
    sheet, row, column = place

    def text(down: int, right: int) -> str:
        value = calculation.values.get((sheet, row + down, column + right))
        return value.strip() if isinstance(value, str) else ""

    # Behind a label, a number and its unit stands what it was converted to.
    another = calculation.number((sheet, row, column - 2)) is not None and text(0, -3)
    sides = (text(0, 1), "" if another else text(0, -1))
    in_units = all(side and is_unit(side) for side in sides)  # a row of units, in which it has none
    beside = (*(() if in_units else sides), text(-1, 0), text(1, 0))
    unit = next((unit for cell in beside if cell and (unit := is_unit(cell))), None)
    left: list[str] = []
    for i in range(1, 6):
        number = calculation.number(nearer := (sheet, row, column - i))
        made = unit is None and calculation.source(nearer) == place
        ratio = (calculation.number(place) or 0.0) / number if made and number else 1.0
        # What stands beyond another number is that number's label, and so is that of a number which
        # is computed from this one, as beta from a hardness: but not if it is this in another unit.
        if number is not None and (any(left) or power_of_ten(ratio) is None):
            break
        left.append(text(0, -i))
    for cells in (left, [text(-1, 0), text(-2, 0)], [text(0, 1), text(0, 2)]):
        words = [cell for cell in cells if cell and not is_unit(cell)]
        if words:  # "β | resistance over flow stress | 3": the nearest that says something
            label = next((cell for cell in words if input_roles(cell, unit)), words[0])
            return label, unit or unit_in(label)
    return "", unit


Report = Mapping[str, tuple[float, ...]]


def _by_role(
    cells: Sequence[Input], all_read: bool, hints: Report | None = None
) -> dict[str, list[Input]]:
    """Cells by role: first those whose label has one meaning, then by value for roles left over."""
    report = hints or report_inputs()
    by_role: dict[str, list[Input]] = {}
    for cell in cells:
        if len(cell.roles) == 1:
            (role,) = cell.roles
            by_role.setdefault(role, []).append(as_role(cell, role, report))
    for cell in cells:
        # A label that says nothing known may be in another language, if the table reads the cell.
        by_value = all_read or not cell.label or cell.unit is not None
        alike = (role for role in report if by_value and _like_the_report(cell, report[role], role))
        left = [role for role in cell.roles or alike if role not in by_role]
        if len(cell.roles) != 1 and left:
            nearest = min(left, key=lambda role: _distance(cell, report.get(role, ())))
            entry = replace(as_role(cell, nearest, report), how=cell.how if cell.roles else "value")
            by_role.setdefault(nearest, []).append(entry)
    return by_role


def _hinted(table: Table) -> Report:
    """The report's values, and those that the table itself shows of velocity and step."""
    report = report_inputs()
    speeds = (table.number(role, k) for k in range(2) for role in table.lines if "velocity" in role)
    first = tuple(islice(filter(None, speeds), 1))
    step = tuple(filter(None, [_usual(table, "time")]))
    return {**report, "velocity": report["velocity"] + first, "step": report["step"] + step}


def _like_the_report(cell: Input, values: Iterable[float], role: str) -> bool:
    """Whether it has the digits of the report's; a number without a unit has no other power.

    Nor has the stop velocity of 1 m/s: a power of ten is a factor between units.
    """
    powers = (power_of_ten(cell.si / value) for value in values)
    scalable = INPUTS[role] != "1" and role != "stop_velocity"
    return any(p == 0 or (p is not None and scalable) for p in powers)


def _distance(cell: Input, values: Iterable[float]) -> float:
    """How many powers of ten away from the report's it is."""
    si = scaled(cell.si, to_si(cell.unit or "1"))
    if not 0 < si < math.inf:
        return math.inf
    return min((abs(math.log10(si / value)) for value in values), default=9)


def as_role(cell: Input, role: str, report: Report) -> Input:
    """The cell as an input, in SI by its unit; without one, by the nearest power of a thousand.

    If it has the digits of the report's, it is the power that lies between them.
    """
    factor = Fraction(1)
    if INPUTS[role] != "1" and cell.unit:
        factor = to_si(cell.unit)
    elif INPUTS[role] != "1" and role in report and cell.si > 0:
        ratios = sorted((value / cell.si for value in report[role]), key=lambda r: abs(_round(r)))
        powers = (power_of_ten(ratio) for ratio in ratios)
        same = next((p for p in powers if p is not None and between_units(p, role)), None)
        factor = Fraction(10) ** (_thousands(ratios[0]) if same is None else same)
    return replace(cell, role=role, si=scaled(cell.si, factor), factor=factor)


# ---- the examination that the rows agree with


def _settled(
    table: Table, choices: Mapping[str, list[Input]], feeding: Mapping[str, Input], pi: float
) -> Examination:
    """One cell for each role: where there are several, those that the rows agree with."""
    choices = {
        role: [_as_converted(cell, table.calculation) for cell in cells]
        for role, cells in choices.items()
    }
    if (step := next(iter(choices.get("step", ())), None)) and step.unit is None:
        # It is in the unit of the time column, or in that which gives it the report's size.
        typed = replace(step, si=scaled(step.si, 1 / step.factor))
        choices["step"] = [*choices["step"], as_role(typed, "step", report_inputs())]
    several = {
        role: cells
        for role, cells in choices.items()
        if any(not math.isclose(cell.si, cells[0].si, rel_tol=1e-12) for cell in cells)
    }
    chosen = {role: cells[0] for role, cells in choices.items()}
    tried: list[tuple[float, float, Examination]] = []
    for picked in islice(product(*several.values()), _MAX_CHOICES):
        inputs = chosen | dict(zip(several, picked, strict=True))
        densities = [inputs[role].place for role in _DENSITIES & several.keys()]
        if len(densities) == 2 and densities[0] == densities[1]:
            continue  # a cell is not both
        examination = _examined(table, inputs, pi, feeding)
        advances = examination.share("advance", REPORT["advance"])
        tried.append((examination.agreement(), advances, examination))
    tried.sort(key=lambda entry: entry[:2], reverse=True)
    best, _, examination = tried[0]
    places = {entry.place for entry in examination.inputs.values()}
    rivals = [rival for agreement, _, rival in tried if best - agreement < 0.2]
    if any({entry.place for entry in rival.inputs.values()} != places for rival in rivals):
        role, cells = next(iter(several.items()))
        alike = dict.fromkeys(address(c.place, True) for c in cells if c.place)
        where = " and ".join(list(alike)[:3])
        raise ValueError(f"{where} could each be {title(role)}: give --map {role}=CELL")
    return examination


def _as_converted(cell: Input, calculation: Calculation) -> Input:
    """An input in a unit such as ksi by the factor that formulas have, of four digits or more.

    The factor is a number in a formula that reads the input, or in a cell that it reads, too.
    """
    if cell.place is None or power_of_ten(float(cell.factor)) is not None:
        return cell
    for formula in calculation.formulas.values():
        cells = [area.corner for area in formula.areas if area.cells == 1][:FEW]
        if cell.place not in cells:
            continue
        for number in (*formula.literals, *filter(None, map(calculation.number, cells))):
            power = _round(number / float(cell.factor))
            factor = Fraction(repr(number)) / Fraction(10) ** power if number > 0 else Fraction()
            if abs(factor / cell.factor - 1) < 1e-4:
                return replace(cell, si=scaled(cell.si, factor / cell.factor), factor=factor)
    return cell


def _examined(
    table: Table, chosen: Mapping[str, Input], pi: float, feeding: Mapping[str, Input]
) -> Examination:
    """A table with these cells as inputs, its columns in the units that tie them together.

    If the deceleration is not what depth and velocity give in that unit, but in the one that its
    head names, or in SI, then it is the velocities that are wrong. If it is with velocities in SI,
    then it is the unit that the impact velocity's label names.
    """
    powers = _powers(table, chosen)
    tied = _solved_back(_with_inputs(table, chosen, pi, powers), feeding)
    if tied.agreement(BRAKES) >= 0.5:
        return tied
    tries = []
    if "deceleration" in powers:
        named = unit_power(table.lines["deceleration"].unit) or 0
        tries.append((chosen, powers | {"deceleration": named}))
    if "velocity" in chosen and (power := powers[table.speed]):
        entry, by = chosen["velocity"], Fraction(10) ** -power
        entry = replace(entry, si=scaled(entry.si, by), factor=entry.factor * by)
        in_si = {role: p if role == "time" else p - power for role, p in powers.items()}
        tries.append(({**chosen, "velocity": entry}, in_si))
    for inputs, units in tries:
        examination = _solved_back(_with_inputs(table, inputs, pi, units), feeding)
        if examination.agreement() >= 0.9:
            return examination
    return tied


def _with_inputs(
    table: Table, chosen: Mapping[str, Input], pi: float, powers: dict[str, int]
) -> Examination:
    """A table with these cells as inputs, and the report's where there are none."""
    columns = {
        role: {
            k: si
            for k in range(table.steps + 1)
            if (value := table.number(role, k)) is not None
            and math.isfinite(si := scaled(value, Fraction(10) ** powers[role]))
        }
        for role in table.lines
    }
    brakes = columns.get("deceleration", {})
    # By the first rows: where a motion goes wrong, its deceleration may change its sign. If there
    # the velocity rises, the sign is wrong.
    speeds = columns.get("velocity_initial") or columns.get("velocity_final") or {}
    if len(speeds) < 2:
        raise ValueError(
            f"the table on {table.sheet!r} has no velocities: give --map velocity=RANGE"
        )
    first, *_, last = islice(speeds.values(), 4)
    negative = last < first and median([0.0, *islice(filter(None, brakes.values()), 4)]) < 0
    if negative:
        columns["deceleration"] = {k: -a for k, a in brakes.items()}
    inputs = _completed(table, chosen, speeds, powers)
    for entry in inputs.values():
        if not (1e-100 < entry.si < 1e100 or (entry.role == "stop_velocity" and entry.si == 0)):
            where = address(entry.place, True) if entry.place else f"the table on {table.sheet!r}"
            raise ValueError(
                f"{where}: taken for {title(entry.role)}, is {entry.si:g}; it should be greater "
                f"than zero; if another cell is meant, give --map {entry.role}=CELL"
            )
    names = [each.name for each in fields(Case) if each.name in inputs]
    case = Case(**{name: inputs[name].si for name in names}, pi=pi)
    if inputs["particle_density"].place is None and "mass" in inputs:
        case = replace(case, own_mass=inputs["mass"].si)
    rows = Rows(columns, case, REPORT)
    return Examination(table, inputs, rows, case, powers, negative)


def _powers(table: Table, inputs: Mapping[str, Input]) -> dict[str, int]:
    """The power of ten of each column.

    The rows tie the units together: dx = v dt and dv = a dt. Of the powers that may be meant, those
    that contradict the fewest units named, then the fewest of these ties, then none at all, then
    those nearest to the report's numbers.
    """
    report, speed = report_inputs(), table.speed
    # What the step would be, and what a column would be, if all cells were in SI units.
    step, move = _usual(table, "time"), _usual(table, "depth", speed)
    depth = table.lines["depth"]
    advance = depth.formula(depth.last)
    if advance and not depth.reads(depth, 1):
        move = 0.0  # its rows do not add to those before
    brake = _usual(table, speed, "deceleration", speed == "velocity_initial")
    named = {role: unit_power(line.unit) for role, line in table.lines.items()}
    start = next((abs(v) for v in table.lines[speed].values if v), 1.0)
    impact = inputs["velocity"].si if "velocity" in inputs else 0.0
    impact = impact if impact > 0 else report["velocity"][0]
    speeds = {named[speed] or 0, _round(impact / start)}
    steps = [inputs["step"].si] if "step" in inputs else []
    place = inputs["step"].place if steps else None
    is_direct = place is None or advance is None or advance.reads(place)
    if step or move:
        steps.append((step or move) * 10.0 ** _thousands(report["step"][0] / (step or move)))
    if step and (power := named.get("time")) is not None:
        steps.append(step * 10.0**power)
    steps = [dt for dt in steps if 0 < dt < math.inf] or [report["step"][0]]
    options = []
    for power, dt in product(speeds, steps):
        v = 10.0**power
        wanted = {
            "time": dt / step if step else 0.0,
            "depth": dt * v / move if move else 0.0,
            "deceleration": v / dt * brake,
        }
        powers = {
            role: _whole(wanted[role], named[role]) if role in wanted else power
            for role in table.lines
        }
        against: float = sum(named[role] not in (None, power) for role, power in powers.items())
        untied = sum(_round(factor) != powers[role] for role, factor in wanted.items() if factor)
        if step and named.get("time") is not None and "step" in inputs and inputs["step"].si > 0:
            # The head says so, the cell does not, or what converts it for the table.
            against += (_round(dt / inputs["step"].si) != 0) * (1 if is_direct else 0.5)
        slower, faster = abs(_round(start * v / impact)), abs(_round(dt / report["step"][0]))
        options.append(((against, untied, slower + faster), powers))
    return min(options, key=lambda option: option[0])[1]


def _usual(table: Table, role: str, over: str | None = None, later: int = 0) -> float:
    """By how much a column changes from row to row, in units of another's number; 0 if seldom."""
    line, base = table.lines.get(role), table.lines.get(over or role)
    if line is None or base is None:
        return 0.0
    rows = range(table.zero + 2, table.zero + table.steps + 1)
    pairs = ((line.change(at + later), base.at(at) if over else 1.0) for at in rows)
    ratios = [abs(a / b) for a, b in pairs if a and b and math.isfinite(a / b)]
    return median(ratios) if ratios and len(ratios) >= 0.3 * len(rows) else 0.0


def _round(ratio: float) -> int:
    """The nearest power of ten, within what any unit could be."""
    return max(-30, min(30, round(math.log10(ratio)))) if 0 < ratio < math.inf else 0


def _thousands(ratio: float) -> int:
    """The nearest power of ten that is one of a thousand; for less than 300 times none is meant."""
    return 3 * round(_round(ratio) / 3) if abs(_round(ratio)) > 2 else 0


def _whole(factor: float, named: int | None) -> int:
    """A factor as a power of ten: the one that a unit names, if it is that, else of a thousand."""
    if not 0 < factor < math.inf:
        return named or 0
    return named if _round(factor) == named else _thousands(factor)


def _completed(
    table: Table,
    chosen: Mapping[str, Input],
    speeds: Mapping[int, float],
    powers: Mapping[str, int],
) -> dict[str, Input]:
    """The inputs, with those that follow from others or from the columns."""
    inputs, report = dict(chosen), report_inputs()

    def add(role: str, si: float, how: str, *of: str) -> None:
        inputs.setdefault(role, Input(role, si, None, how, titles(of)))

    if "diameter" in inputs:
        add("radius", inputs["diameter"].si / 2, "follows", "diameter")
    if {"beta", "flow_stress"} <= set(inputs):
        resistance = inputs["beta"].si * inputs["flow_stress"].si
        add("resistance", resistance, "follows", "beta", "flow_stress")
    add("velocity", speeds[min(speeds)], "rows")
    add("radius", report["radius"][0], "report")
    if "mass" in inputs:
        volume = crater.volume(inputs["radius"].si)
        density = inputs["mass"].si / volume if volume else 0.0
        add("particle_density", density, "follows", "mass", "radius")
    if "step" not in inputs:
        step = _usual(table, "time") * 10.0 ** powers.get("time", 0)
        scale = 10.0 ** (powers["depth"] - powers[table.speed])
        step = step or _usual(table, "depth", table.speed) * scale
        step = _shortest(step, 1e-6) if 0 < step < math.inf else report["step"][0]
        add("step", step, "formulas" if step in _typed(table.calculation) else "rows")
    for role in ("particle_density", "target_density", "resistance"):
        add(role, report[role][0], "report")
    return inputs


def _typed(calculation: Calculation) -> set[float]:
    """Every number that stands in a formula."""
    return {number for formula in calculation.formulas.values() for number in formula.literals}


def _shortest(value: float, near: float) -> float:
    """The decimal with the fewest digits within `near` (relative) of a value.

    >>> _shortest(2.0000000003e-10, 1e-9)
    2e-10
    """
    decimals = (float(f"{value:.{digits}e}") for digits in range(17))
    return next((d for d in decimals if math.isclose(d, value, rel_tol=near)), value)


def _solved_back(examination: Examination, feeding: Mapping[str, Input]) -> Examination:
    """Inputs that no cell holds: the first that the rows agree with, else the report's, assumed.

    The report's values first; with mass, diameter and resistance as they should be, then as the
    cells `feeding` the rows hold them; then what the rows themselves say.
    """
    unknown = [role for role, entry in examination.inputs.items() if entry.how == "report"]
    typed = _typed(examination.table.calculation) if unknown else set()
    values = product(*(report_inputs()[role] for role in unknown))
    of_report = [dict(zip(unknown, each, strict=True)) for each in values]
    solved = {}
    for role, value in _solved(examination).items():
        if role in unknown:  # a number that some formula has, or the shortest decimal
            near = (number for number in typed if math.isclose(number, value, rel_tol=1e-7))
            solved[role] = next(near, _shortest(value, 1e-8))
    tries = product((BRAKES[:2], BRAKES), ((), *_fed(examination, feeding)), ["report"], of_report)
    for rules, fed, how, tried in (*tries, (BRAKES[:2], (), "rows", solved)):
        case, intended = examination.case, examination.intended
        for role, value in tried.items():
            if value == getattr(case, role):
                continue  # and the mass stays that of its cell
            case, intended = case.with_input(role, value), intended.with_input(role, value)
        for cell in fed:
            case = case.holding(cell.role, cell.si)
        agreed = replace(examination.following(case), intended=intended)
        if agreed.agreement(rules) >= 0.5:
            hidden = {role for cell in fed for role in (cell.role, RESTS_ON[cell.role][-1])}
            hidden.add(max(rules, key=lambda rule: agreed.share("brake", rule)).lacks)
            inputs = dict(examination.inputs)
            for role, value in tried.items():
                known = "assumed" if role in hidden else "formulas" if value in typed else how
                inputs[role] = replace(inputs[role], si=value, how=known)
            return replace(agreed, inputs=inputs, derived={cell.role: cell for cell in fed})
    assumed = {role: replace(examination.inputs[role], how="assumed") for role in unknown}
    return replace(examination, inputs={**examination.inputs, **assumed})


def _fed(examination: Examination, feeding: Mapping[str, Input]) -> Iterator[tuple[Input, ...]]:
    """Mass, diameter and resistance as their cells hold them, where that is not what it should be.

    A formula that is wrong does not tell its unit by its value: every power of a thousand may be.
    """
    wrong = []
    for role, cell in feeding.items():
        number = examination.table.calculation.number(cell.place)
        wanted = getattr(examination.intended, role)
        if number is None or (number == 0 and role != "resistance"):
            continue
        if number > 0 and power_of_ten(wanted / number) is not None:
            continue  # right, or a unit is not converted, which the rows tell otherwise
        thousands = () if cell.unit else (Fraction(1000) ** power for power in range(-5, 6))
        factors = dict.fromkeys((cell.factor, *thousands))
        wrong.append([replace(cell, role=role, si=scaled(number, by), factor=by) for by in factors])
    if wrong:
        yield from islice(product(*wrong), 2 * _MAX_CHOICES)


def _solved(examination: Examination) -> dict[str, float]:
    """Target density and resistance for which the rows brake as they do, drag at the beginning.

    a M / (pi A) is a straight line in v²: its slope is half the density, its end the resistance.
    Each pair of rows gives both; the medians withstand some wrong rows. Nothing if there are none.
    """
    case, rows, points = examination.case, examination.rows, []
    for k in range(1, max(rows.columns["depth"]) + 1):
        x, v, final = (rows(role, k) for role in ("depth", "velocity_initial", "velocity_final"))
        if x and v is not None and (area := contact(case, x)):
            if "deceleration" in rows.columns:
                a = rows("deceleration", k)
            else:
                a = None if final is None else (v - final) / case.step
            if a is not None:
                points.append((v * v, a * case.mass / (math.pi * area)))
    pairs = zip(points, points[len(points) // 2 :], strict=False)
    apart = [(p, q) for p, q in pairs if p[0] - q[0] > 0.05 * p[0]]
    if len(apart) < 3:
        return {}
    slopes = [(p[1] - q[1]) / (p[0] - q[0]) for p, q in apart]
    ends = [p[1] - slope * p[0] for (p, _), slope in zip(apart, slopes, strict=True)]
    density, resistance = 2 * median(slopes), median(ends)
    solved = {"target_density": density, "resistance": resistance}
    return solved if density > 0 and resistance > 0 else {}

"""Find the inputs of a table: the cells that hold them, their units, and those that no cell holds.

Only cells that the table's formulas read, directly or through other cells, count as its inputs.
They are recognized by label, defined name, unit and value. An input that no cell holds is taken
from the numbers typed into formulas, or solved back from the rows; the output says so.
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
"""The most numbers beside the tables that are looked at."""
_MAX_CHOICES = 64
"""The most combinations of cells for inputs that are tried."""
RESTS_ON = {
    "diameter": ("radius",),
    "mass": ("radius", "particle_density"),
    "resistance": ("beta", "flow_stress"),
}
"""The inputs that follow from others, and from which."""
_DENSITIES = frozenset({"particle_density", "target_density"})
_OF_MATERIALS = _DENSITIES | {"flow_stress"}
"""Properties of the materials, which the tables of a workbook share."""


@cache
def report_inputs() -> dict[str, tuple[float, ...]]:
    """Return the report's inputs in SI units: both betas and steps, an inferred target density."""
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
    """Return a table's inputs, units and rows, ready for `judge`.

    `candidates` are the numbers of `numbers_beside`, `mapped` the cells that the user named, `read`
    the cells that the table reads (from `read_by`), `elsewhere` those that other tables read.
    Raises ValueError, with the option that would help, if two cells could be the same input and the
    rows do not decide between them.
    """
    calculation = table.calculation
    names = {name for formula in calculation.formulas.values() for name in formula.names}

    def is_read(cell: Input) -> bool:
        return cell.place in read if cell.place else cell.label.upper() in names

    reads = [cell for cell in candidates if not (read or names) or is_read(cell)]
    reads = _not_made_of(reads, calculation)
    nearest = {
        role: _nearest(cells, read, calculation)
        for role, cells in _by_role(reads, _hinted(table), bool(read)).items()
    }
    nearest |= _either_density(reads, calculation)
    choices = _typed_first(nearest, reads, calculation) | _as_mapped(mapped, candidates, table)
    seen = {*read, *calculation.formulas}
    idle = [c for c in candidates if c.label and c.place not in seen and c not in reads]
    unread = _by_role(idle)
    # No formula reads the stop velocity where the rows are ended by hand, nor the particle density
    # where the formula for the mass is wrong, nor any input where the decelerations are typed.
    brake = table.lines.get("deceleration")
    is_typed = brake is not None and not any(map(brake.formula, range(brake.first, brake.last + 1)))
    known = {*choices, *unread}
    independent = [role for role in unread if not known.issuperset(RESTS_ON.get(role, ("",)))]
    for role in independent if is_typed else ("stop_velocity", "particle_density"):
        free = [cell for cell in unread.get(role, ()) if cell.place not in elsewhere]
        if role not in choices and len(free) == 1:
            choices[role] = free
            del unread[role]
    if not known.issuperset(RESTS_ON["resistance"]):
        labelled = [c for c in nearest.get("resistance", ()) if c.how != "value" and c.si > 0]
        if labelled:  # its label outweighs whatever else its formula reads
            choices.setdefault("resistance", labelled)
    feeding = _feeding({**nearest, **choices}, reads, calculation)
    stored_pi = (cell.si for cell in reads if math.isclose(cell.si, math.pi, rel_tol=1e-14))
    examination = _settled(table, choices, feeding, next(stored_pi, math.pi))
    first = {role: cells[0] for role, cells in nearest.items()}
    found = (first, examination.inputs, examination.derived)
    cells = ((role, cell) for by_role in found for role, cell in by_role.items())
    derived = {role: cell for role, cell in cells if role in RESTS_ON and cell.place}
    # Nothing reads the cell of a mass or diameter whose value is typed into the rows.
    unused = calculation.formulas.keys() - read.keys() - elsewhere if read else ()
    computed = [c for c in candidates if c.roles & RESTS_ON.keys() and c.place in unused]
    unread |= {r: cells for r, cells in _by_role(computed).items() if r not in derived}
    single = (_own(cells, examination, read, elsewhere) for cells in unread.values())
    own = tuple(filter(None, single))
    return replace(examination, read=frozenset(read), derived=derived, unread=own)


def _own(
    cells: Sequence[Input], exam: Examination, read: Collection[Position], elsewhere: Set[Position]
) -> Input | None:
    """Return the one of several unread cells for an input that the table should read.

    A cell that another table reads counts only if it holds the value that the rows take, or is a
    property of the materials. Among several the one nearest to cells that the table reads is
    chosen; None if that is not unique.
    """
    used = exam.inputs.get(cells[0].role)
    sheets = {exam.table.sheet, *(place[0] for place in read)}

    def rank(cell: Input) -> tuple[bool, float]:
        is_used = used is not None and near(cell.si, used.si)
        sheet, row, column = cell.place or ("", 0, 0)
        distances = (abs(p[1] - row) + abs(p[2] - column) for p in read if p[0] == sheet)
        return not is_used, min(distances, default=math.inf)

    ranks = {
        cell: rank(cell)
        for cell in cells
        if not elsewhere or (cell.place and cell.place[0] in sheets)
        if cell.place not in elsewhere or cell.role in _OF_MATERIALS or not rank(cell)[0]
    }
    nearest = [cell for cell in ranks if ranks[cell] == min(ranks.values())]
    return nearest[0] if len(nearest) == 1 else None


def _as_mapped(
    mapped: Mapping[str, Position], candidates: Sequence[Input], table: Table
) -> dict[str, list[Input]]:
    """Return the cells named by the user as inputs. Raises ValueError for one without a number."""
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
    """Return the cells of mass, diameter and resistance, found by label or by what they read.

    A cell without a known label is the mass if its formula reads radius and density and nothing
    else, and the resistance likewise.
    """
    feeding = {role: cells[0] for role, cells in by_role.items() if role in RESTS_ON}
    for role in ("mass", "resistance"):
        sources = {by_role[of][0].place if of in by_role else None for of in RESTS_ON[role]}
        for cell in reads if role not in feeding and None not in sources else ():
            read = [] if cell.roles else calculation.corners(cell.place)
            if read and set(map(calculation.source, read)) == sources:
                feeding.setdefault(role, replace(cell, role=role))
    return feeding


def _not_made_of(cells: list[Input], calculation: Calculation) -> list[Input]:
    """Return the cells, without the label of those that combine the input they name with others.

    R_t/M is such a cell: it names the resistance, but is computed from it and the mass.
    """
    roles_at = {cell.place: cell.roles for cell in cells}

    def named(cell: Input) -> Input:
        of = {name for role in cell.roles for name in RESTS_ON.get(role, ())}
        read = map(roles_at.get, calculation.corners(cell.place))
        alike = {bool(cell.roles & roles) for roles in read if roles and not roles & of}
        is_made = len(alike) == 2 and cell.unit is None
        return replace(cell, roles=frozenset(), label="") if is_made else cell

    return list(map(named, cells))


def _either_density(cells: Sequence[Input], calculation: Calculation) -> dict[str, list[Input]]:
    """Return two densities whose labels do not say whose as choices for both: the rows decide.

    Return nothing if one is the other in another unit. Where the rows do not decide, the one that
    the mass reads is the particle's: it comes first for the particle and last for the target.
    """
    unsaid = [cell for cell in cells if cell.place and cell.roles == _DENSITIES]
    places = {cell.place for cell in unsaid}
    converts = any(places & read_by([p], calculation).keys() for p in places if p)
    if len(unsaid) != 2 or converts or any(len(c.roles & _DENSITIES) == 1 for c in cells):
        return {}
    masses = [cell.place for cell in cells if cell.place and cell.roles == {"mass"}]
    of_mass = read_by(masses, calculation)
    unsaid.sort(key=lambda cell: cell.place not in of_mass)
    orders = {"particle_density": unsaid, "target_density": unsaid[::-1]}
    report = report_inputs()
    return {role: [as_role(c, role, report) for c in order] for role, order in orders.items()}


def _typed_first(
    nearest: Mapping[str, list[Input]], reads: Sequence[Input], calculation: Calculation
) -> dict[str, list[Input]]:
    """Return for each role the cells that are typed, or that read a typed cell of that role.

    If a role has only computed cells, return them all; but leave out a role of `RESTS_ON`, which
    then follows from its own inputs.
    """
    called = {(cell.place, role) for cell in reads for role in cell.roles}

    def is_typed(cell: Input) -> bool:
        read = calculation.corners(cell.place)
        return not read or any((place, cell.role) in called for place in read)

    return {
        role: list(filter(is_typed, cells)) or cells
        for role, cells in nearest.items()
        if role not in RESTS_ON or any(map(is_typed, cells))
    }


def read_by(cells: Iterable[Position], calculation: Calculation) -> dict[Position, int]:
    """Return every other cell that some cells read, with the number of steps to it."""
    edge = list(cells)
    distances = dict.fromkeys(edge, 0)
    while edge:
        distance = distances[edge[0]] + 1
        areas = (area for place in edge for area in calculation.areas(place) if area.cells <= FEW)
        edge = list({p for area in areas for p in area.places() if p not in distances})
        distances.update(dict.fromkeys(edge, distance))
    return {place: distance for place, distance in distances.items() if distance}


def _nearest(
    cells: Sequence[Input], read: Mapping[Position, int], calculation: Calculation
) -> list[Input]:
    """Return the cells for a role that are read most directly, or the cells that they convert."""
    far = {cell: read.get(cell.place, 0) if cell.place else 0 for cell in cells}
    nearest = [cell for cell in cells if far[cell] == min(far.values())]
    sources = {calculation.source(cell.place) for cell in nearest if cell.place}
    return [cell for cell in cells if cell.place in sources] or nearest


# ---- cells by label, name and value


def numbers_beside(calculation: Calculation, tables: Sequence[Table]) -> Iterator[Input]:
    """Yield every number beside the tables with its label or name, and every name of a number."""
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
            roles = _DENSITIES  # the label is in an unknown language
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
    """Return the label of a number, from its left, above or its right, and its unit."""
    sheet, row, column = place

    def text(down: int, right: int) -> str:
        value = calculation.values.get((sheet, row + down, column + right))
        return value.strip() if isinstance(value, str) else ""

    # After a label, a number and its unit comes the converted number: the unit is not its own.
    another = calculation.number((sheet, row, column - 2)) is not None and text(0, -3)
    sides = (text(0, 1), "" if another else text(0, -1))
    in_units = all(side and is_unit(side) for side in sides)  # a number in a row of units has none
    beside = (*(() if in_units else sides), text(-1, 0), text(1, 0))
    unit = next((unit for cell in beside if cell and (unit := is_unit(cell))), None)
    left: list[str] = []
    for i in range(1, 6):
        number = calculation.number(nearer := (sheet, row, column - i))
        made = unit is None and calculation.source(nearer) == place
        ratio = (calculation.number(place) or 0.0) / number if made and number else 1.0
        # A text beyond another number labels that number, also if it is computed from this one, as
        # beta from a hardness; but it labels both if they are the same in two units.
        if number is not None and (any(left) or power_of_ten(ratio) is None):
            break
        left.append(text(0, -i))
    for cells in (left, [text(-1, 0), text(-2, 0)], [text(0, 1), text(0, 2)]):
        words = [cell for cell in cells if cell and not is_unit(cell)]
        if words:  # of "β | resistance over flow stress | 3" the nearest that names an input
            label = next((cell for cell in words if input_roles(cell, unit)), words[0])
            return label, unit or unit_in(label)
    return "", unit


Report = Mapping[str, tuple[float, ...]]


def _by_role(
    cells: Sequence[Input], hints: Report | None = None, all_read: bool = True
) -> dict[str, list[Input]]:
    """Return cells by role: those whose label has one meaning, then the others by their values.

    The value decides only for roles that no label has. `hints` are the values to compare with, the
    report's unless given.
    """
    report = hints or report_inputs()
    by_role: dict[str, list[Input]] = {}
    for cell in sorted(cells, key=lambda cell: len(cell.roles) != 1):
        # If the table reads the cell, an unknown label may be in another language.
        by_value = all_read or not cell.label or cell.unit is not None
        alike = (role for role in report if by_value and _like_the_report(cell, report[role], role))
        left = [r for r in cell.roles or alike if r not in by_role or len(cell.roles) == 1]
        if left:
            nearest = min(left, key=lambda role: _distance(cell, report.get(role, ())))
            entry = replace(as_role(cell, nearest, report), how=cell.how if cell.roles else "value")
            by_role.setdefault(nearest, []).append(entry)
    return by_role


def _hinted(table: Table) -> Report:
    """Return the report's values, and the velocity and the step that the table itself shows."""
    report = report_inputs()
    speeds = (table.number(role, k) for k in range(2) for role in table.lines if "velocity" in role)
    first = tuple(islice(filter(None, speeds), 1))
    step = tuple(filter(None, [_usual(table, "time")]))
    return {**report, "velocity": report["velocity"] + first, "step": report["step"] + step}


def _like_the_report(cell: Input, values: Iterable[float], role: str) -> bool:
    """Whether a cell has one of the report's values, maybe in another unit, a power of ten.

    Inputs without a unit must be equal, and so must the stop velocity: as it is 1 m/s, any power of
    ten would do.
    """
    powers = (power_of_ten(cell.si / value) for value in values)
    scalable = INPUTS[role] != "1" and role != "stop_velocity"
    return any(p == 0 or (p is not None and scalable) for p in powers)


def _distance(cell: Input, values: Iterable[float]) -> float:
    """Return how many powers of ten a cell lies from the nearest of the report's values."""
    si = scaled(cell.si, to_si(cell.unit or "1"))
    if not 0 < si < math.inf:
        return math.inf
    return min((abs(math.log10(si / value)) for value in values), default=9)


def as_role(cell: Input, role: str, report: Report) -> Input:
    """Return the cell as an input, converted to SI by its unit.

    Without a unit, the factor is the power of ten that makes it the report's value; if there is
    none, the power of a thousand that brings it nearest to that.
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
    """Return the examination with one cell for each role, chosen so that the rows agree best."""
    options = {
        role: [_as_converted(cell, table.calculation) for cell in cells]
        for role, cells in choices.items()
    }
    if "step" in options and (step := options["step"][0]).unit is None:
        # Its unit is that of the time column, or the one that gives it the report's magnitude.
        typed = replace(step, si=scaled(step.si, 1 / step.factor))
        options["step"].append(as_role(typed, "step", report_inputs()))
    for role, cells in options.items():
        if all(math.isclose(cell.si, cells[0].si, rel_tol=1e-12) for cell in cells):
            options[role] = cells[:1]
    several = [role for role, cells in options.items() if len(cells) > 1]
    tried: list[tuple[float, float, Examination]] = []
    for picked in islice(product(*options.values()), _MAX_CHOICES):
        inputs = dict(zip(options, picked, strict=True))
        densities = [inputs[role].place for role in _DENSITIES.intersection(several)]
        if len(densities) == 2 and densities[0] == densities[1]:
            continue  # a cell is not the density of both
        examination = _examined(table, inputs, pi, feeding)
        advances = examination.share("advance", REPORT["advance"])
        tried.append((examination.agreement(), advances, examination))
    tried.sort(key=lambda entry: entry[:2], reverse=True)
    best, _, examination = tried[0]
    places = {entry.place for entry in examination.inputs.values()}
    rivals = [rival for agreement, _, rival in tried if best - agreement < 0.2]
    if any({entry.place for entry in rival.inputs.values()} != places for rival in rivals):
        role = several[0]
        alike = dict.fromkeys(address(cell.place, True) for cell in options[role] if cell.place)
        where = " and ".join(list(alike)[:3])
        raise ValueError(f"{where} could each be {title(role)}: give --map {role}=CELL")
    return examination


def _as_converted(cell: Input, calculation: Calculation) -> Input:
    """Return an input in a unit such as ksi, converted by the workbook's own, rounded factor.

    The factor, right to four digits or more, is typed into a formula that reads the input, or
    stands in another cell that this formula reads.
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
    """Return the examination with these cells as inputs, the columns in units that fit together.

    If the rows do not follow the scheme in these units, the velocities may be wrong: then the
    deceleration's unit is the one that its head names, or SI. Or the label of the impact velocity
    names a wrong unit: then the rows follow the scheme with velocities in SI.
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
    """Return the examination with these cells as inputs, completed, and the columns in SI units.

    Raises ValueError if the table has no velocities, or an input is not positive.
    """
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
    speeds = columns[table.speed]
    if len(speeds) < 2:
        raise ValueError(
            f"the table on {table.sheet!r} has no velocities: give --map velocity=RANGE"
        )
    # The first rows tell the sign of the decelerations: further down, a motion that goes wrong may
    # change it. If the velocity rises there, the sign itself is the fault.
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
    known = {field.name: inputs[field.name].si for field in fields(Case) if field.name in inputs}
    case = Case(**known, pi=pi)
    if inputs["particle_density"].place is None and "mass" in inputs:
        case = replace(case, own_mass=inputs["mass"].si)
    rows = Rows(columns, case, REPORT)
    return Examination(table, inputs, rows, case, powers, negative)


def _powers(table: Table, inputs: Mapping[str, Input]) -> dict[str, int]:
    """Return the power of ten between each column's unit and SI.

    The rows tie the units together: dx = v dt and dv = a dt. Of all possible powers those are
    chosen that contradict the fewest units in heads, then the fewest of these ties, then those that
    bring velocity and step nearest to the report's.
    """
    report, speed = report_inputs(), table.speed
    # The step by the times, the step by depths and velocities, and dv/a, in the columns' units.
    step, move = _usual(table, "time"), _usual(table, "depth", speed)
    depth = table.lines["depth"]
    advance = depth.formula(depth.last)
    if advance and not depth.reads(depth, 1):
        move = 0.0  # the depths do not add to the row before, so their changes tell no step
    brake = _usual(table, speed, "deceleration", speed == "velocity_initial")
    named = {role: unit_power(line.unit) for role, line in table.lines.items()}
    start = next((abs(v) for v in table.lines[speed].values if v), 1.0)
    impact = inputs["velocity"].si if "velocity" in inputs else 0.0
    impact = impact if impact > 0 else report["velocity"][0]
    speeds = {named[speed] or 0, _round(impact / start)}
    cell = inputs.get("step")
    steps = [cell.si] if cell else []
    is_direct = not (cell and cell.place and advance) or advance.reads(cell.place)
    if shown := step or move:
        steps.append(shown * 10.0 ** _thousands(report["step"][0] / shown))
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
        if step and named.get("time") is not None and cell and cell.si > 0:
            # The head contradicts the cell of the step; half as bad if formulas convert the step.
            against += (_round(dt / cell.si) != 0) * (1 if is_direct else 0.5)
        slower, faster = abs(_round(start * v / impact)), abs(_round(dt / report["step"][0]))
        options.append(((against, untied, slower + faster), powers))
    return min(options, key=lambda option: option[0])[1]


def _usual(table: Table, role: str, over: str | None = None, later: int = 0) -> float:
    """Return the median change of a column from row to row, over the number of another column.

    That number is taken `later` rows before the change. Return 0 if few rows have both.
    """
    line, base = table.lines.get(role), table.lines.get(over or role)
    if line is None or base is None:
        return 0.0
    rows = range(table.zero + 2, table.zero + table.steps + 1)
    pairs = ((line.change(at + later), base.at(at) if over else 1.0) for at in rows)
    ratios = [abs(a / b) for a, b in pairs if a and b and math.isfinite(a / b)]
    return median(ratios) if ratios and len(ratios) >= 0.3 * len(rows) else 0.0


def _round(ratio: float) -> int:
    """Return the nearest power of ten, limited to what units can make up; 0 if there is none."""
    return max(-30, min(30, round(math.log10(ratio)))) if 0 < ratio < math.inf else 0


def _thousands(ratio: float) -> int:
    """Return the nearest power of a thousand, as a power of ten; 0 for ratios below about 300."""
    return 3 * round(_round(ratio) / 3) if abs(_round(ratio)) > 2 else 0


def _whole(factor: float, named: int | None) -> int:
    """Return a factor as a power of ten: that of the unit named if it fits, else of a thousand."""
    if not 0 < factor < math.inf:
        return named or 0
    return named if _round(factor) == named else _thousands(factor)


def _completed(
    table: Table,
    chosen: Mapping[str, Input],
    speeds: Mapping[int, float],
    powers: Mapping[str, int],
) -> dict[str, Input]:
    """Return the inputs with those that follow from others or from the columns, or the report's."""
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
    """Return every number that stands in a formula."""
    return {number for formula in calculation.formulas.values() for number in formula.literals}


def _shortest(value: float, near: float) -> float:
    """Return the decimal with the fewest digits within a relative distance of a value.

    >>> _shortest(2.0000000003e-10, 1e-9)
    2e-10
    """
    decimals = (float(f"{value:.{digits}e}") for digits in range(17))
    return next((d for d in decimals if math.isclose(d, value, rel_tol=near)), value)


def _solved_back(examination: Examination, feeding: Mapping[str, Input]) -> Examination:
    """Return the examination with values for the inputs that no cell holds.

    They are the first that the rows agree with. The report's values are tried first, with mass,
    diameter and resistance as they should be, then as the cells `feeding` the rows hold them; then
    the values solved from the rows. If none agrees, the report's are assumed.
    """
    unknown = [role for role, entry in examination.inputs.items() if entry.how == "report"]
    typed = _typed(examination.table.calculation) if unknown else set()
    values = product(*(report_inputs()[role] for role in unknown))
    of_report = [dict(zip(unknown, each, strict=True)) for each in values]
    solved = {}
    for role, value in _solved(examination).items():
        if role in unknown:  # the number in some formula that is near, else the shortest decimal
            near_by = (number for number in typed if math.isclose(number, value, rel_tol=1e-7))
            solved[role] = next(near_by, _shortest(value, 1e-8))
    tries = product((BRAKES[:2], BRAKES), ((), *_fed(examination, feeding)), ["report"], of_report)
    for rules, fed, how, tried in (*tries, (BRAKES[:2], (), "rows", solved)):
        case, intended = examination.case, examination.intended
        for role, value in tried.items():
            if value == getattr(case, role):
                continue  # so that the mass stays that of its cell
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
    """Yield combinations of mass, diameter and resistance as their cells hold wrong values of them.

    The value of a wrong formula does not tell its unit, so without one every power of a thousand is
    tried.
    """
    wrong = []
    for role, cell in feeding.items():
        number = examination.table.calculation.number(cell.place)
        wanted = getattr(examination.intended, role)
        if number is None or (number == 0 and role != "resistance"):
            continue
        if number > 0 and power_of_ten(wanted / number) is not None:
            continue  # it is right, or a power of ten off, which `judge` finds by the rows
        thousands = () if cell.unit else (Fraction(1000) ** power for power in range(-5, 6))
        factors = dict.fromkeys((cell.factor, *thousands))
        wrong.append([replace(cell, role=role, si=scaled(number, by), factor=by) for by in factors])
    if wrong:
        yield from islice(product(*wrong), 2 * _MAX_CHOICES)


def _solved(examination: Examination) -> dict[str, float]:
    """Return the target density and resistance that the decelerations of the rows imply, if any.

    By Eqs. A-1 to A-3, a M / (pi A) = rho v²/2 + R is a straight line in v², v being the velocity
    at the beginning of the row. Each pair of rows gives both; medians withstand some wrong rows.
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

"""The verdict on one table: what its six numbers and its inputs say about each other."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from replication.check.beside import units_beside
from replication.check.cells import feeding, formula_at, odd_cells
from replication.check.constants import typed_constants, typed_stops
from replication.check.ends import first_rows, judge_stop
from replication.check.examination import AnotherModelError, Examination, near
from replication.check.excerpt import judge_excerpt
from replication.check.fit import TableFit, is_part
from replication.check.gaps import judge_gaps
from replication.check.impact_row import judge_impact
from replication.check.model import blank_inputs, refuse_other_model, zero_of_blank
from replication.check.responses import CLOSE, Item, unit_power
from replication.check.roles import Inputs, recognize
from replication.check.six import (
    EXACT,
    REPORT,
    VARIANTS,
    end_of_row,
    first_speed,
    first_written,
    start_of_row,
)
from replication.check.solved import tell_solved
from replication.check.table import Line, SchemeTable, cell_name
from replication.check.taken import compare_with_report, intend, is_report, take_inputs
from replication.check.units import Balance, Magnitude, equations, right_units, state_units
from replication.check.words import times_too, title, unit_name
from spreadsheets.foreign import Position

_PIS = (3.14, 3.1416, 3.14159, 3.142, 3.1415, 22 / 7, 3.141593, 3.1415927)
"""How people type pi."""
_FEW_DIGITS = 1e-4 / math.log(10)
"""The logarithm of a ratio up to which a unit that is no power of ten may be converted."""
_ABOUT = 0.05
"""The logarithm of a ratio up to which two numbers are about the same: 12 percent."""
_LEAST_RATIO = 0.02
"""The target's density over the particle's is larger: magnesium over osmium is 0.08."""
_MOST_POWER = 300.0
"""Doubles reach to 1e308."""


def examine(
    table: SchemeTable, fitted: TableFit, names: Mapping[Position, str],
    given: Mapping[str, Position],
    idle: Sequence[Position], typed: Sequence[Position],
) -> Examination:  # fmt: skip
    """Judge a table. Raises AnotherModelError if it does not follow the report's.

    `names` are the names of cells, `given` the cells of inputs that the user named, `idle` numbers
    that no table reads, `typed` all typed numbers beside the table.
    """
    exam = Examination(table, fitted)
    inputs = recognize(table, exam.fitted, given, names, idle)
    exam.read = frozenset(s.cell for s in inputs.sources if s.cell)
    zero = zero_of_blank(exam, inputs)
    if zero is not None:
        text = f"{formula_at(exam, zero)} reads a blank cell: it is 0, so that nothing follows"
        exam.add("odd formula", [zero], None, text)
        exam.ends = False
        return exam
    state_units(table, inputs)
    _trust_report(inputs)
    balances = equations(table, exam.fitted, inputs)
    if _is_half(balances, inputs):
        _take_for_radius(inputs)
        balances = equations(table, exam.fitted, inputs)
    broken, of_units = _without_unit(inputs, balances)
    result, stated = right_units(of_units, inputs), inputs.powers
    if result is not None:
        inputs.powers = result[0]
    exam.units = {role: inputs.powers.get(("column", role), 0.0) for role in table.lines}
    sizes = [inputs.cells[role].item for role in ("radius", "diameter") if role in inputs.cells]
    exam.firm = any(item in inputs.stated for item in (("column", "depth"), *sizes))
    speeds: list[Item] = [("column", role) for role in ("velocity_initial", "velocity_final")]
    speeds += [inputs.cells["velocity"].item] if "velocity" in inputs.cells else []
    exam.firm_speed = any(item in inputs.stated for item in speeds)
    refuse_other_model(exam, inputs, balances)
    take_inputs(exam, inputs)
    typed_constants(exam, inputs, [place for place in typed if place not in exam.read], broken)
    typed_stops(exam, inputs)
    _broken_equations(exam, inputs, balances, broken)
    if result is None:
        _not_converted(exam, inputs, of_units)
    else:
        for item in result[1]:
            _wrong_unit(exam, inputs, item, stated.get(item, 0.0))
    _other_ways(exam)
    _without_drag(exam)
    units_beside(exam, inputs)
    compare_with_report(exam, inputs)
    intend(exam)
    if not judge_excerpt(exam):
        first_rows(exam, inputs, idle)
        odd_cells(exam, inputs)
        judge_impact(exam)
        judge_gaps(exam)
    judge_stop(exam, idle)
    tell_solved(exam)
    exam.differences.sort(key=lambda d: d.rank)
    return exam


def _trust_report(inputs: Inputs) -> None:
    """Take a number without a unit for SI units if it is the report's, though not surely."""
    for role, source in inputs.cells.items():
        if source.item not in inputs.stated and is_report(role, source.value):
            inputs.stated[source.item] = False


def _is_half(balances: Sequence[Balance], inputs: Inputs) -> bool:
    """Whether the number taken for the diameter is the radius: the mass is an eighth.

    The formula for the diameter is then wrong, not that for the mass.
    """
    if "diameter" not in inputs.cells or "radius" in inputs.cells:
        return False
    rests = {eq.name: eq.residual(inputs.powers) for eq in balances}
    off = [rests[name] - math.log10(8) for name in ("mass",) if name in rests]
    off = off or [rests[name] + math.log10(8) for name in ("G", "H") if name in rests]
    return len(off) > ("mass" not in rests) and all(abs(x - round(x)) < CLOSE for x in off)


def _take_for_radius(inputs: Inputs) -> None:
    """Take the cell of the diameter for that of the radius, and a formula that repeats it for D."""
    radius = inputs.cells["radius"] = inputs.cells.pop("diameter")
    for source in inputs.sources:
        if source.computed and source.family == "size" and source.value == radius.value:
            inputs.derived["diameter"] = source


# ---- columns that follow another scheme


def _other_ways(exam: Examination) -> None:
    """Report the columns whose formulas follow another scheme, or none."""
    fitted, table = exam.fitted, exam.table
    blank = blank_inputs(exam)
    exam.read |= set(blank)
    for place in blank:
        exam.add("odd formula", [place], None, "a blank cell is used as an input")
    for role, way in fitted.ways.items():
        if way is REPORT[role] or (blank and role == "deceleration"):
            continue
        column = role if role in table.lines else fitted.brakes
        if role == "velocity_final" and role not in table.lines:
            column = start_of_row(table)[0]
        line = table.lines[column]
        later = role == "depth" or column == "velocity_initial"
        later = later and not (way is VARIANTS["explicit Euler"] and _is_whole_step(exam))
        cells = exam.cells(column, 2 if later else 1)
        cells = _usual(line, cells)
        if role == "deceleration":
            cells = _first_wrong(exam) or cells
        if way is None and _not_computed(exam, cells[0]):
            continue
        if way is not None:
            exam.add("other scheme", cells, None, f"{way.name}: {way.says}")
        else:
            text = f"{formula_at(exam, cells[0])} is not what the report has for {title(column)}"
            exam.add("odd formula", cells, None, text)


def _is_whole_step(exam: Examination) -> bool:
    """Whether the first row moves the depth by V times the whole step, as explicit Euler does."""
    first, six = exam.table.number("depth", 1), exam.fitted.six
    line = exam.table.lines["depth"]
    if first is None or not exam.table.whole:
        return False
    close = exam.fitted.digits * abs(first) + line.rounding(first) + EXACT * abs(first)
    return abs(first - six.c * six.V) <= close


def _without_drag(exam: Examination) -> None:
    """Report numbers without formulas whose deceleration does not depend on the velocity.

    G D^3 = 3 rho_t/rho_p, whatever the units, as c and e are the same step. No two solids have a
    ratio of densities below 1/50, as far as the digits tell.
    """
    six, errors = exam.fitted.six, exam.fitted.errors
    if exam.fitted.probe is not None or not (six.H > 0 and six.D > 0 and six.c and six.V > 0):
        return
    drag = 3 / (six.D * (1 + errors.D)) ** 3 * six.c / abs(six.e)
    if abs(six.G) * (1 + errors.G) < _LEAST_RATIO * drag:
        text = (
            "no drag: the deceleration does not depend on the velocity; the force lacks the drag, "
        )
        text += "or has it at the impact velocity"
        exam.add("other scheme", exam.cells(exam.fitted.brakes, 2), None, text)


def _not_computed(exam: Examination, place: Position) -> bool:
    """Whether a formula of the rows reads one that is not computed, and has no stored value.

    A name that nothing has is a fault; of other such formulas nothing can be said.
    """
    evaluator = exam.table.evaluator
    for area in evaluator.areas(place):
        reason = evaluator.reasons.get(area.corner)
        if reason is None or evaluator.values.get(area.corner) is not None:
            continue
        if not reason.startswith("nothing is called"):
            raise AnotherModelError(f"{cell_name(area.corner, True)} is not computed: {reason}")
        text = f"{formula_at(exam, area.corner)}: {reason}"
        exam.add("odd formula", [area.corner], None, text)
        return True
    return False


def _first_wrong(exam: Examination, off: float | None = None) -> list[Position]:
    """The cells of the first column beside the table that is no part of the right force.

    `off` is the ratio of the wrong force to the right one, if it is known.
    """
    fitted, table = exam.fitted, exam.table
    if fitted.probe is None or fitted.force is None:
        return []
    index = table.rows[fitted.probe.k]
    for line in feeding(table):
        if not is_part(fitted, line.place(index), exam.right_force(off)):
            rows = sorted(table.rows.items())
            return _usual(line, [line.place(i) for k, i in rows if k >= 1 and i in line.values])
    return []


def _usual(line: Line, cells: list[Position]) -> list[Position]:
    """Those of some cells that have the usual formula of their line: others may be right."""
    if line.usual is None:
        return cells
    return [cell for cell in cells if line.evaluator.formulas.get(cell) is line.usual] or cells


# ---- equations that do not hold


def _slips(name: str, inputs: Inputs) -> list[tuple[float, str]]:
    """The ratios by which people get an equation wrong, each with what it means."""
    slips: list[tuple[float, str]] = []
    if name == "G":
        slips.append((2.0, "drag without 1/2"))
        particle, target = inputs.si("particle_density"), inputs.si("target_density")
        if particle and target and not near(particle, target):
            slips.append((particle / target, "drag with the particle's density"))
    elif name == "D":
        slips.append((0.5, "area with R for D"))
    elif name == "c = dt":
        slips.append((0.5, "half steps throughout"))
    if name in ("mass", "G", "H"):
        for typed in _PIS:
            slips += [(typed / math.pi, f"pi {typed:.7g}"), (math.pi / typed, f"pi {typed:.7g}")]
    return slips


def _without_unit(
    inputs: Inputs, balances: Sequence[Balance]
) -> tuple[dict[str, str], list[Balance]]:
    """The equations that no unit can mend, each by its name with the slip that it shows.

    Then all the others; and those with a slip, without it, as they still tell a unit.
    """
    broken: dict[str, str] = {}
    mendable: list[Balance] = []
    for eq in balances:
        rest = eq.residual(inputs.powers)
        free = [item for item in eq.terms if item not in inputs.stated]
        odd = any(inputs.powers.get(item, 0.0) % 1 for item in eq.terms if item in inputs.stated)
        if odd and abs(rest) < _FEW_DIGITS:
            continue  # converted by a factor of a few digits
        by_unit = any(
            unit_power(-rest / eq.terms[item], eq.slack, eq.ratio.error) is not None
            for item in free
        )
        if abs(rest - round(rest)) <= eq.slack + 2 * CLOSE or by_unit:
            mendable.append(eq)
            continue
        broken[eq.name] = ""
        for ratio, slip in _slips(eq.name, inputs):
            off = rest - math.log10(ratio)
            if not broken[eq.name] and abs(off - round(off)) <= max(eq.slack, 1e-8):
                broken[eq.name] = slip
                mendable.append(replace(eq, ratio=eq.ratio * Magnitude(-math.log10(ratio))))
    return broken, mendable


def _clipped(power: float) -> float:
    """A power of ten that a double can hold."""
    return max(-_MOST_POWER, min(_MOST_POWER, power))


def _broken_equations(
    exam: Examination, inputs: Inputs, balances: Sequence[Balance], broken: Mapping[str, str]
) -> None:
    """Report the equations that do not hold, each where it is written."""
    times = {eq.name: 10.0 ** _clipped(eq.residual(inputs.powers)) for eq in balances}
    rests_on = {
        "diameter": title("radius"), "radius": title("diameter"),
        "mass": "the radius and the particle density", "resistance": "beta and the flow stress",
    }  # fmt: skip
    for role, source in rests_on.items():
        typed_over = (
            exam.fitted.probe is not None
            and role in times
            and _is_typed_over(inputs, role, times[role])
        )
        if typed_over or (role in broken and not _is_elsewhere(inputs, role)):
            _wrong_cell(exam, inputs, role, source, times[role], broken.get(role, ""))
    _wrong_force(exam, inputs, broken, times)
    _other_steps(exam, broken)
    start = first_speed(exam.table)
    if "V" in broken and start is not None and start not in {d.place for d in exam.differences}:
        velocity = inputs.cells["velocity"]
        where = cell_name(velocity.cell, True) if velocity.cell else "its name"
        start = _written(exam.table, first_written(exam.table, start))
        kind = "odd formula" if start in exam.table.evaluator.formulas else "typed number"
        text = f"the first velocity is {times['V']:.6g} times {title('velocity')} in {where}"
        exam.add(kind, [start], velocity.value, text)


def _written(table: SchemeTable, place: Position) -> Position:
    """The cell beside a table in which a number is computed that others only repeat."""
    evaluator = table.evaluator
    shown = evaluator.areas(place)
    while len(shown) == 1 and shown[0].corner in evaluator.formulas:
        before = shown[0].corner
        if before in table.places or evaluator.values.get(before) != evaluator.values[place]:
            break
        place, shown = before, evaluator.areas(before)
    return place


_PARTS_OF = {"mass": ("particle_density",), "resistance": ("beta", "flow_stress")}
"""The inputs of a mass and a resistance that are nothing else's."""


def _is_elsewhere(inputs: Inputs, role: str) -> bool:
    """Whether a typed mass or resistance has parts that no formula reads: of another table, say."""
    typed = role in inputs.cells and not inputs.cells[role].computed
    return typed and any(inputs.how.get(part) == "unread" for part in _PARTS_OF.get(role, ()))


def _is_typed_over(inputs: Inputs, role: str, times: float) -> bool:
    """Whether a mass or resistance is typed, though cells that nothing reads hold its inputs.

    It is about what follows from them, in some unit.
    """
    power = math.log10(times)
    if abs(power - round(power)) > _ABOUT:
        return False
    parts = _PARTS_OF.get(role, ())
    typed = role in inputs.cells and not inputs.cells[role].computed
    typed = typed and inputs.how.get(role) != "unread"
    return typed and bool(parts) and all(inputs.how.get(part) == "unread" for part in parts)


def _wrong_cell(
    exam: Examination, inputs: Inputs, role: str, rests_on: str, times: float, slip: str
) -> None:
    """Report a mass, diameter or resistance that does not follow from its inputs."""
    source = inputs.derived.get(role) or inputs.cells.get(role)
    if source is None or source.cell is None or source.cell in {d.place for d in exam.differences}:
        return
    kind, expected = "odd formula", source.value / times
    if not source.computed:
        kind, text = "typed constant", f"{title(role)} is typed as a number, though it rests on "
        text += f"{rests_on}: a change there changes nothing"
    elif slip.startswith("pi "):
        kind, text = "typed constant", f"{title(role)} takes {slip[3:]} for pi"
    else:
        text = f"{formula_at(exam, source.cell)} does not give {title(role)} of {rests_on}: "
        text += f"it is {times:.6g} times that"
    exam.add(kind, [source.cell], expected, text)


_PARTS = {"D": "the diameter in the contact area", "G": "the drag", "H": "the resistance"}


def _repeats_radius(exam: Examination, inputs: Inputs) -> Position | None:
    """A formula of which only the contact area makes use, and that repeats the radius."""
    radius = inputs.cells.get("radius")
    for source in inputs.sources:
        alone = abs(source.powers.get("G", 0.0)) < 0.02 and source.family == "size"
        if source.computed and alone and radius is not None and source.cell is not None:
            power = math.log10(source.value / radius.value)
            if abs(power - round(power)) < 1e-12 and source.cell not in {
                d.place for d in exam.differences
            }:
                return source.cell
    return None


def _beta_typed(
    exam: Examination, inputs: Inputs, blamed: Sequence[Position], times: float
) -> bool:
    """Report another beta that is typed into the force beside the cell of the flow stress."""
    beta, stress = inputs.cells.get("beta"), inputs.cells.get("flow_stress")
    shape = exam.table.evaluator.formulas.get(blamed[0])
    if beta is None or stress is None or beta.cell is None or shape is None:
        return False
    own = exam.table.evaluator.areas(blamed[0])
    typed = [n for n in shape.literals if near(n, beta.value * times)]
    if not typed or any(area.covers(beta.cell) for area in own):
        return False
    if stress.cell is None or not any(area.covers(stress.cell) for area in own):
        return False
    where = cell_name(beta.cell, beta.cell[0] != exam.table.sheet)
    text = f"{title('beta')} is typed as {typed[0]:.10g}, where {where} should be read"
    exam.add("typed constant", blamed, where, text, formula_at(exam, blamed[0]))
    return True


def _wrong_force(
    exam: Examination, inputs: Inputs, broken: Mapping[str, str], times: Mapping[str, float]
) -> None:
    """Report a force that has not the numbers that the inputs give."""
    way = exam.fitted.ways.get("deceleration", REPORT["deceleration"])
    parts = [
        name for name in _PARTS if name in broken and not (name == "D" and "diameter" in broken)
    ]
    if not parts or (way is not REPORT["deceleration"] and not exam.fitted.centered):
        return
    both = {"G", "H"} <= broken.keys() and math.isclose(times["G"], times["H"], rel_tol=1e-8)
    off = times["G"] if both else times.get("H") if parts == ["H"] else None
    brakes = exam.table.lines[exam.fitted.brakes]
    blamed = _first_wrong(exam, off) or _usual(brakes, exam.cells(exam.fitted.brakes, 1))
    if broken.get("D") == "area with R for D" and (cell := _repeats_radius(exam, inputs)):
        text = f"{formula_at(exam, cell)} does not give {title('diameter')}: it repeats the radius"
        exam.add("odd formula", [cell], None, text)
        parts.remove("D")
    if parts == ["H"] and _beta_typed(exam, inputs, blamed, times["H"]):
        return
    if not parts or blamed[0] in {d.place for d in exam.differences}:
        return
    if both:
        parts = [name for name in parts if name == "D"]
        if broken["G"].startswith("pi "):
            exam.add("typed constant", blamed, None, f"pi is typed as {broken['G'][3:]}")
        else:
            text = f"{formula_at(exam, blamed[0])} gives {times['G']:.6g} times the deceleration"
            exam.add("odd formula", blamed, None, f"{text} that its inputs give")
    for name in parts:
        if broken[name] in VARIANTS:
            slip = VARIANTS[broken[name]]
            exam.add("other scheme", blamed, None, f"{slip.name}: {slip.says}")
        else:
            text = f"{formula_at(exam, blamed[0])}: {_PARTS[name]} is {times[name]:.6g} times"
            exam.add("odd formula", blamed, None, f"{text} what the inputs give")


def _other_steps(exam: Examination, broken: Mapping[str, str]) -> None:
    """Report columns that take another step than the rest."""
    if exam.fitted.probe is None:
        return
    end = end_of_row(exam.table)[0]
    blamed = {role: first for name, role, first in (
        ("c = dt", "depth", 2), ("e = dt", end, 1), ("t = dt", "time", 1), ("t = c", "time", 1),
    ) if name in broken}  # fmt: skip
    if "c = e" in broken and not blamed.keys() & {"depth", end}:
        blamed[end] = 1
    accused = {cell for d in exam.differences for cell in d.cells}
    for role, first in blamed.items():
        cells = _usual(exam.table.lines[role], exam.cells(role, first))
        odd = exam.fitted.ways.get("depth" if role == "depth" else "velocity_final")
        if accused.intersection(cells) or (role != "time" and odd not in (*REPORT.values(),)):
            continue
        slip = broken.get("c = dt", "") if role == "depth" else ""
        if slip in VARIANTS:
            exam.add("other scheme", cells, None, f"{slip}: {VARIANTS[slip].says}")
        else:
            text = f"{formula_at(exam, cells[0])} takes another step than the rest of the table"
            exam.add("odd formula", cells, None, text)


# ---- units


def _wrong_unit(exam: Examination, inputs: Inputs, item: Item, stated: float) -> None:
    """Report a unit that is stated and contradicts the numbers."""
    right = inputs.powers.get(item, 0.0)
    kind, what = item
    whole = abs(right - round(right)) < 1e-9
    if kind == "column":
        role = str(what)
        line = exam.table.lines[role]
        shown = unit_name(role, round(right)) if whole else "another unit"
        text = f"the head gives {title(role)} in {line.unit or 'SI units'}, but the numbers are in "
        place = line.unit_place or line.place(min(line.values))
        exam.add("unit", [place, *exam.cells(role, 0)], shown, text + shown, line.unit)
        return
    every = (*inputs.cells.items(), *inputs.derived.items())
    role, source = next((r, s) for r, s in every if s.item == item)
    if source.place is None:
        return  # a name that stands for a number states no unit
    _, unit = inputs.label(source)
    shown = unit_name(role, round(right)) if whole else "another unit"
    if unit is None and source.computed:
        power = round(right - stated)
        text = f"{title(role)} is {times_too(-power)}: a unit is not converted"
        exam.add("unit", [source.place], source.value * 10.0**power, text)
        return
    text = (
        f"{title(role)} is {source.value:.10g} without a unit, but the formulas take it in {shown}"
    )
    if unit is not None:
        text = (
            f"the label gives {title(role)} in {unit}, but the formulas take the number in {shown}"
        )
    exam.add("unit", [source.place], shown, text, unit)


_FOLLOWS = {"c = e": {"c = dt", "e = dt"}, "t = c": {"t = dt", "c = dt"}}
"""Equations that follow from two others, which tell the column that is wrong."""


def _not_converted(exam: Examination, inputs: Inputs, balances: Sequence[Balance]) -> None:
    """Report equations that a power of ten breaks, where no single statement mends all of them."""
    accused = {cell for d in exam.differences for cell in d.cells}
    rests = {eq.name: eq.residual(inputs.powers) for eq in balances}
    wrong = [eq for eq in balances if not eq.holds(inputs.powers)]
    of_cell = any(eq.name in ("c = dt", "e = dt", "t = dt") for eq in wrong)
    for eq in wrong:
        rest = rests[eq.name]
        if of_cell and eq.name in ("c = e", "t = c"):
            continue  # which follows: the column is named that has another step than the cell
        if rests.keys() >= _FOLLOWS.get(eq.name, {""}):
            continue
        cells, what = _written_in(exam, inputs, eq.name)
        if not accused.intersection(cells):
            accused |= set(cells)
            text = f"{what} is {times_too(round(rest))}: a unit is not converted"
            exam.add("unit", cells, None, text)


def _written_in(exam: Examination, inputs: Inputs, name: str) -> tuple[list[Position], str]:
    """The cells in which an equation is written, and what they hold."""
    source = inputs.derived.get(name)
    if source is not None and source.cell is not None:
        return [source.cell], title(name)
    start = first_speed(exam.table)
    if name == "V" and start is not None:
        return [first_written(exam.table, start)], "the first velocity"
    column, first = exam.fitted.brakes, 1
    if name in ("t = dt", "t = c"):
        column = "time"
    elif name in ("c = dt", "c = e"):
        column, first = "depth", 2
    elif name == "e = dt":
        column = end_of_row(exam.table)[0]
    return exam.cells(column, first), title(column)

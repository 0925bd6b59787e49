"""The verdict on one table: its formulas, its inputs, its units, its cells, its first and last row.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import cache

from reference.ledger import claims_of_case, load
from replication.check.cells import feeding, odd_cells, predicted
from replication.check.examination import Examination, near
from replication.check.roles import (
    CLOSE,
    FAMILIES,
    Equation,
    Input,
    Inputs,
    Item,
    Source,
    equations,
    first_speed,
    is_plain,
    mended,
    recognize,
    state_units,
)
from replication.check.six import (
    REPORT,
    VARIANTS,
    Six,
    Variant,
    end_of_row,
    fit,
    is_bounded,
    run,
    start_of_row,
)
from replication.check.table import Table, address
from replication.check.words import INPUTS, input_roles, quantity, times_too, title, unit_text
from spreadsheets.evaluate import written
from spreadsheets.foreign import Position

_EQUAL = 1e-9
"""Relative difference of two final depths that are the same."""
_PIS = (3.14, 3.1416, 3.14159, 3.142, 3.1415, 22 / 7, 3.141593, 3.1415927)
"""How people type pi."""
_LEAST_KNOWN = 3
"""So many kinds of inputs must be known by label or value where the formulas are not the report's."""


class AnotherModel(ValueError):
    """A table follows another model than the report's. The message says which formula tells."""


@cache
def report_inputs() -> dict[str, tuple[float, ...]]:
    """The report's inputs in SI units; two of beta and resistance."""
    values: dict[str, list[float]] = {}
    for beta in (5, 3):
        case = {name: float(load().value(claim)) for name, claim in claims_of_case(beta).items()}
        case["resistance"] = case["beta"] * case["flow_stress"]
        case["diameter"] = 2 * case["radius"]
        case["mass"] = 4 / 3 * math.pi * case["radius"] ** 3 * case["particle_density"]
        for name, value in case.items():
            known = values.setdefault(name, [])
            if value not in known:
                known.append(value)
    return {name: tuple(known) for name, known in values.items()}


def examine(
    table: Table, names: Mapping[Position, str], given: Mapping[str, Position],
    idle: Sequence[Position], typed: Sequence[Position],
) -> Examination:  # fmt: skip
    """Judge a table. `idle` are numbers that no table reads, `typed` those beside it. Raises AnotherModel if it does not follow the report's."""
    exam = Examination(table, fit(table))
    inputs = recognize(table, exam.fitted, given, names, idle)
    exam.read = frozenset(s.place for s in inputs.sources if s.place and s.literal is None)
    state_units(table, inputs)
    _trust_report(inputs)
    found = equations(table, exam.fitted, inputs)
    slack = max(CLOSE, exam.fitted.slack)
    if _is_half(found, inputs):
        diameter = inputs.cells.pop("diameter")
        inputs.cells["radius"] = diameter
        alike = [s for s in inputs.sources if s.computed and s.literal is None and s.family == "size"
                 and s.value == diameter.value]  # fmt: skip
        if alike:
            inputs.derived["diameter"] = alike[0]
        found = equations(table, exam.fitted, inputs)
    broken = _slipped(exam, inputs, found, slack)
    whole = [eq for eq in found if eq.name not in broken]
    result = mended(whole, inputs, slack)
    changed: list[Item] = []
    if result is not None:
        powers, changed = result
        before, inputs.powers = inputs.powers, powers
    else:
        before = inputs.powers
    exam.units = {role: inputs.powers.get(("column", role), 0.0) for role in table.lines}
    _other_model(exam, inputs, found, slack)
    _take(exam, inputs)
    beside = [p for p in typed if p not in exam.read]
    _typed_constants(exam, inputs, beside, broken)
    _broken_equations(exam, inputs, found, broken, slack)
    for item in changed:
        _unit(exam, inputs, item, before.get(item, 0.0), inputs.powers.get(item, 0.0))
    if result is None:
        _not_mended(exam, inputs, whole, slack)
    _variants(exam)
    _far_from_report(exam, inputs)
    _first_rows(exam, inputs, idle)
    odd_cells(exam, inputs)
    _intend(exam, inputs)
    _stop(exam, idle)
    exam.differences.sort(key=lambda d: d.rank)
    return exam


def _is_half(found: Sequence[Equation], inputs: Inputs) -> bool:
    """Whether the number taken for the diameter is the radius: the mass is an eighth of the right one.

    The formula for the diameter is then wrong, not that for the mass.
    """
    if "diameter" not in inputs.cells or "radius" in inputs.cells:
        return False
    rests = {eq.name: eq.residual(inputs.powers) for eq in found}
    eighth = math.log10(8)
    if "mass" in rests:
        return abs(rests["mass"] - eighth - round(rests["mass"] - eighth)) < CLOSE
    return {"G", "H"} <= rests.keys() and all(
        abs(rests[name] + eighth - round(rests[name] + eighth)) < CLOSE for name in ("G", "H")
    )


def _trust_report(inputs: Inputs) -> None:
    """A number without a unit that is the report's in SI units is in SI units, though not surely."""
    for role, source in inputs.cells.items():
        item: Item = source.item
        if item not in inputs.stated and any(near(source.value, x) for x in report_inputs().get(role, ())):
            inputs.stated[item] = False


# ---- another model, and formulas that are not the report's


def _known_families(inputs: Inputs) -> tuple[int, int]:
    """How many kinds of inputs are known by their label or value, and how many hold the report's."""
    known, report = set(), set()
    for family, members in FAMILIES.items():
        if family in ("step", "speed"):
            continue
        for role in members:
            source = inputs.cells.get(role) or inputs.derived.get(role)
            if source is None:
                continue
            values = [abs(math.log10(abs(source.value) / x)) for x in report_inputs().get(role, ()) if source.value]
            is_report = any(abs(v - round(v)) < 1e-9 for v in values)
            label, unit = inputs.labels.get(source.cell or ("", 0, 0), (source.name, None))
            named = role in input_roles(label, unit) if label else False
            if named or is_report or inputs.how.get(role) == "--map":
                known.add(family)
            if is_report:
                report.add(family)
    return len(known), len(report)


def _other_model(exam: Examination, inputs: Inputs, found: Sequence[Equation], slack: float) -> None:
    """Raise AnotherModel if the formulas are not the report's and the inputs are not either."""
    fitted, table = exam.fitted, exam.table
    odd = [way for way in fitted.ways.values() if way is None or way.name != "the report's"]
    if not odd:
        if fitted.probe is None and not (_rows_agree(exam) and _steps_agree(found, inputs, slack)):
            raise AnotherModel(_sentence(exam, "deceleration"))
        return
    hold = {eq.name for eq in found if abs(eq.residual(inputs.powers)) < slack}
    strong = len(hold & {"D", "mass", "diameter", "G", "H", "resistance"})
    way = fitted.ways.get("deceleration", REPORT["deceleration"])
    if way is not None and way.name in ("the report's", "centered") and (strong >= 1 or way.name == "the report's"):
        return
    known, report = _known_families(inputs)
    if strong >= 2 or (known >= _LEAST_KNOWN and (strong or report >= 2)):
        return
    wrong = next((r for r in ("deceleration", "velocity_final", "depth") if r in fitted.ways and (
        fitted.ways[r] is None or fitted.ways[r] is not REPORT[r])), "deceleration")  # fmt: skip
    raise AnotherModel(_sentence(exam, wrong))


def _sentence(exam: Examination, role: str) -> str:
    table = exam.table
    column = role if role in table.lines else exam.fitted.brakes
    k = min(3, table.steps)
    place = table.place(column, k)
    shape = table.evaluator.formulas.get(place)
    formula = f" {written(shape.key, place[1], place[2])[:120]}" if shape else ""
    depth, speed = table.area("depth"), table.area(start_of_row(table)[0])
    what = {
        "deceleration": "is no pressure (G v² + H) on the contact area of a sphere, D x - x²",
        "velocity_final": "does not lose the deceleration times the step",
        "depth": "does not grow by a velocity times the step",
    }[role]
    if not shape:
        what = "do not follow from a pressure (G v² + H) on the contact area of a sphere, D x - x²"
        return (f"another model: {table.sheet!r} has depths in {depth} and velocities in {speed}, "
                f"but its numbers, such as {address(place, True)}, {what}")  # fmt: skip
    subject = {"deceleration": "the deceleration", "velocity_final": "the velocity", "depth": "the depth"}[role]
    return (f"another model: {table.sheet!r} has depths in {depth} and velocities in {speed}, but "
            f"{subject} in {address(place, True)},{formula}, {what}")  # fmt: skip


def _steps_agree(found: Sequence[Equation], inputs: Inputs, slack: float) -> bool:
    """Whether depth and velocity of a table of numbers change by the same step, in some unit."""
    rests = [eq.residual(inputs.powers) for eq in found if eq.name == "c = e"]
    return all(abs(rest - round(rest)) < max(100 * slack, 1e-3) for rest in rests)


def _rows_agree(exam: Examination) -> bool:
    """Whether most rows of numbers follow from the six numbers that were fitted to them."""
    table, six = exam.table, exam.fitted.six
    if not all(math.isfinite(x) for x in (six.G, six.H, six.D, six.c)) or table.steps < 6:
        return True
    start, end = start_of_row(table), end_of_row(table)
    good = tested = 0
    role = "deceleration" if "deceleration" in table.lines else end[0]
    line = table.lines[role]
    for k in table.rows:
        value, wanted = table.number(role, k), predicted(exam, role, k)
        if value is None or wanted is None or k < 1:
            continue
        tested += 1
        size = max(abs(value), 1e-3 * max(map(abs, line.values.values())))
        good += abs(value - wanted) <= 0.02 * size
    _ = start
    return tested == 0 or good > 0.5 * tested


def _variants(exam: Examination) -> None:
    """Report the columns whose formulas follow another scheme, or none."""
    fitted, table = exam.fitted, exam.table
    for role, way in fitted.ways.items():
        if way is not None and way.name == "the report's":
            continue
        column = role if role in table.lines else fitted.brakes
        if role == "velocity_final" and role not in table.lines:
            column = start_of_row(table)[0]
        cells = exam.cells(column, 2 if role == "depth" else 1)
        blamed = cells
        if role == "deceleration":
            blamed = _first_wrong(exam) or cells
        if way is not None:
            says = way.says if way.name.split()[0] in way.says else f"{way.name}: {way.says}"
            exam.add("other scheme", blamed, None, says)
            continue
        text = f"{_formula(exam, blamed[0])} is not what the report's scheme has for {title(column)}"
        exam.add("odd formula", blamed, None, text)


def _formula(exam: Examination, place: Position) -> str:
    shape = exam.table.evaluator.formulas.get(place)
    return written(shape.key, place[1], place[2])[:200] if shape else "the number"


def _first_wrong(exam: Examination) -> list[Position] | None:
    """The cells of the first column beside the table that is no part of the right force."""
    from replication.check.six import parts_of

    fitted, table = exam.fitted, exam.table
    if fitted.probe is None or fitted.force_of is None:
        return None
    for line in feeding(table):
        index = table.rows[fitted.probe.k]
        if not parts_of(fitted, table, line.place(index), exam.intended_ratio):
            return [line.place(i) for k, i in sorted(table.rows.items()) if k >= 1 and i in line.values]
    return None


# ---- equations that do not hold


def _slips(name: str, exam: Examination, inputs: Inputs) -> list[tuple[float, str]]:
    """The ratios by which people get an equation wrong, each with what it means."""
    slips: list[tuple[float, str]] = []
    if name == "G":
        slips.append((2.0, "drag without 1/2"))
        particle, target = inputs.si("particle_density"), inputs.si("target_density")
        if particle and target and not near(particle, target):
            slips.append((particle / target, "drag with the particle's density"))
        slips.append((0.5, "drag with another half"))
    if name == "D":
        slips.append((0.5, "area with R for D"))
    if name in ("mass", "G", "H"):
        slips += [(sign_pi / math.pi, f"pi {sign_pi:.7g}") for sign_pi in _PIS]
        slips += [(math.pi / sign_pi, f"pi {sign_pi:.7g}") for sign_pi in _PIS]
    if name == "c = dt":
        slips.append((0.5, "half steps throughout"))
    return slips


def _slipped(
    exam: Examination, inputs: Inputs, found: Sequence[Equation], slack: float
) -> dict[str, str]:
    """The equations that no unit can mend: each by its name, with the slip that it shows."""
    broken: dict[str, str] = {}
    for eq in found:
        rest = eq.residual(inputs.powers)
        free = [i for i in eq.terms if i not in inputs.stated]
        if abs(rest - round(rest)) <= slack + 2 * CLOSE:
            continue
        if exam.fitted.probe is None and abs(rest) < 30 * slack:
            continue
        if free and _may_be_unit(rest, free, eq):
            continue
        name = ""
        for ratio, slip in _slips(eq.name, exam, inputs):
            off = rest - math.log10(ratio)
            if abs(off - round(off)) <= max(slack, 1e-8):
                name = slip
                break
        broken[eq.name] = name
    return broken


def _may_be_unit(rest: float, free: Sequence[Item], eq: Equation) -> bool:
    from replication.check.roles import _UNUSUAL

    for item in free:
        power = -rest / eq.terms[item]
        if any(abs((power - u) - round(power - u)) < 1e-6 for u in _UNUSUAL):
            return True
    return False


def _broken_equations(
    exam: Examination, inputs: Inputs, found: Sequence[Equation], broken: Mapping[str, str],
    slack: float,
) -> None:  # fmt: skip
    """Report the equations that do not hold, each where it is written."""
    table, fitted = exam.table, exam.fitted
    by_name = {eq.name: eq for eq in found}
    told: set[str] = set()
    accused = {d.place for d in exam.differences}
    column = fitted.brakes
    brakes = exam.cells(column, 1)

    def ratio(name: str) -> float:
        return 10.0 ** by_name[name].residual(inputs.powers)

    def derived(name: str, role: str, from_what: str) -> None:
        source = inputs.derived.get(role) or inputs.cells.get(role)
        if source is None or source.cell is None or source.cell in accused:
            return
        slip, times = broken[name], ratio(name)
        expected = source.value / times
        if not source.computed:
            digits = 0.5 * 10.0 ** (math.floor(math.log10(abs(source.value))) - 2)
            text = f"{title(role)} is typed as a number, though it rests on {from_what}: a change there changes nothing"
            if abs(source.value - expected) <= digits * 1.01 and False:
                return
            exam.add("typed constant", [source.place], expected, text)
            return
        if slip.startswith("pi "):
            text = f"{title(role)} takes {slip[3:]} for pi"
            exam.add("typed constant", [source.place], expected, text)
            return
        text = f"{_formula(exam, source.place)} does not give {title(role)} of {from_what}: it is {times:.6g} times that"
        exam.add("odd formula", [source.place], expected, text)

    if "diameter" in broken:
        derived("diameter", "diameter", title("radius"))
    if "mass" in broken:
        derived("mass", "mass", "the radius and the particle density")
    if "resistance" in broken:
        derived("resistance", "resistance", "beta and the flow stress")
    both = "G" in broken and "H" in broken and math.isclose(ratio("G"), ratio("H"), rel_tol=1e-8)
    if both and "mass" not in broken:
        blamed = _first_wrong(exam) or brakes
        slip = broken["G"]
        if slip.startswith("pi "):
            exam.add("typed constant", blamed, None, f"pi is typed as {slip[3:]}")
        else:
            text = f"{_formula(exam, blamed[0])} gives {ratio('G'):.6g} times the deceleration that its inputs give"
            exam.add("odd formula", blamed, None, text)
        told |= {"G", "H"}
    for name in ("D", "G", "H"):
        if name not in broken or name in told or (name == "D" and "diameter" in broken):
            continue
        if fitted.ways.get("deceleration", REPORT["deceleration"]) is not REPORT["deceleration"] and (
            fitted.ways.get("deceleration") is None or fitted.ways["deceleration"].name != "centered"):  # type: ignore[union-attr]
            continue
        slip = broken[name]
        blamed = _first_wrong(exam) or brakes
        if any(p in accused for p in blamed[:1]):
            continue
        if slip in VARIANTS:
            way = VARIANTS[slip]
            exam.add("other scheme", blamed, None, f"{way.name}: {way.says}")
            continue
        what = {"D": "the diameter in the contact area", "G": "the drag", "H": "the resistance"}[name]
        text = f"{_formula(exam, blamed[0])}: {what} is {ratio(name):.6g} times what the inputs give"
        exam.add("odd formula", blamed, None, text)
    _steps_differ(exam, inputs, broken, ratio)
    if "V" in broken and (start := first_speed(table)) is not None and start not in accused:
        velocity = inputs.cells["velocity"]
        text = f"the first velocity is {ratio('V'):.6g} times {title('velocity')} in {address(velocity.place or start, True)}"
        exam.add("odd formula", [start], velocity.value, text)


def _steps_differ(exam: Examination, inputs: Inputs, broken: Mapping[str, str], ratio: object) -> None:
    """Report columns that take another step than the rest."""
    table = exam.table
    if exam.fitted.probe is None:
        return
    accused = {cell for d in exam.differences for cell in d.cells}
    end = end_of_row(table)[0]
    blamed: list[tuple[str, list[Position]]] = []
    if "c = dt" in broken or ("c = e" in broken and "e = dt" not in broken and "step" in inputs.cells and "c = dt" not in broken and False):
        blamed.append(("depth", exam.cells("depth", 2)))
    if "e = dt" in broken:
        blamed.append((end, exam.cells(end, 1)))
    if not blamed and "c = e" in broken:
        blamed.append((end, exam.cells(end, 1)))
    if "t = dt" in broken or "t = c" in broken:
        blamed.append(("time", exam.cells("time", 1)))
    for role, cells in blamed:
        if accused.intersection(cells) or exam.fitted.ways.get(role, REPORT["depth"]) not in (*REPORT.values(),):
            continue
        slip = broken.get("c = dt", "") if role == "depth" else ""
        if slip in VARIANTS:
            exam.add("other scheme", cells, None, f"{slip}: {VARIANTS[slip].says}")
            continue
        text = f"{_formula(exam, cells[0])} takes another step than the rest of the table"
        exam.add("odd formula", cells, None, text)


# ---- units


def _unit(exam: Examination, inputs: Inputs, item: Item, stated: float, right: float) -> None:
    """Report a unit that is stated and contradicts the numbers."""
    power = round(right - stated)
    kind, what = item
    if kind == "column":
        role = str(what)
        line = exam.table.lines[role]
        cells = [p for p in _head_cells(line) if p]
        exact = right if abs(right - round(right)) < 1e-9 else None
        shown = unit_text(role, round(exact)) if exact is not None else "another unit"
        text = f"the head gives {title(role)} in {line.unit or 'SI units'}, but the numbers are in {shown}"
        place = cells[0] if cells else line.place(min(line.values))
        exam.add("unit", [place, *exam.cells(role, 0)], shown, text, line.unit)
        return
    place = what
    role = next(
        (r for r, s in (*inputs.cells.items(), *inputs.derived.items()) if s.place == place), ""
    )
    label, unit = inputs.labels.get(place, ("", None))  # type: ignore[call-overload]
    source = inputs.cells.get(role) or inputs.derived.get(role)
    assert source is not None
    if source.computed and unit is None:
        text = f"{title(role)} is {times_too(-power)}: a unit is not converted"
        exam.add("unit", [place], source.value * 10.0**power, text)  # type: ignore[list-item]
        return
    shown = unit_text(role, round(right)) if abs(right - round(right)) < 1e-9 else "another unit"
    if unit is None:
        text = f"{title(role)} is {source.value:.10g} without a unit, but the formulas take it in {shown}"
    else:
        text = f"the label gives {title(role)} in {unit}, but the formulas take the number in {shown}"
    exam.add("unit", [place], shown, text, unit)  # type: ignore[list-item]


def _head_cells(line: object) -> list[Position]:
    """The cell above a line in which its unit stands."""
    from replication.check.table import Line
    from replication.check.words import is_unit, unit_in

    assert isinstance(line, Line)
    first = min(line.values)
    for index in range(first - 1, max(0, first - 8), -1):
        value = line.evaluator.values.get(line.place(index))
        if isinstance(value, str) and (is_unit(value) or unit_in(value)):
            return [line.place(index)]
    return []


def _not_mended(exam: Examination, inputs: Inputs, found: Sequence[Equation], slack: float) -> None:
    """Report equations that a power of ten breaks, where no single statement mends all of them."""
    accused = {cell for d in exam.differences for cell in d.cells}
    for eq in found:
        rest = eq.residual(inputs.powers)
        if abs(rest) < 30 * slack:
            continue
        role = {"mass": "mass", "resistance": "resistance", "diameter": "diameter"}.get(eq.name)
        source = inputs.derived.get(role or "")
        if role and source is not None and source.place is not None:
            cells, what = [source.place], title(role)
        elif eq.name in ("t = dt", "t = c"):
            cells, what = exam.cells("time", 1), title("time")
        elif eq.name in ("c = dt", "c = e"):
            cells, what = exam.cells("depth", 2), title("depth")
        elif eq.name == "e = dt":
            column = end_of_row(exam.table)[0]
            cells, what = exam.cells(column, 1), title(column)
        elif eq.name == "V" and (start := first_speed(exam.table)) is not None:
            cells, what = [start], "the first velocity"
        else:
            cells, what = exam.cells(exam.fitted.brakes, 1), title(exam.fitted.brakes)
        if accused.intersection(cells):
            continue
        accused |= set(cells)
        text = f"{what} is {times_too(round(rest))}: a unit is not converted"
        exam.add("unit", cells, None, text)


# ---- typed constants


def _typed_constants(
    exam: Examination, inputs: Inputs, idle: Sequence[Position], broken: dict[str, str]
) -> None:
    """Report numbers typed into formulas where the cell of an input should be read."""
    table, evaluator = exam.table, exam.table.evaluator
    if exam.fitted.probe is None:
        return
    literals = [s for s in inputs.sources if s.literal is not None and s.family is not None]
    told: set[tuple[Position | None, str]] = set()
    for source in literals:
        family = source.family
        assert family is not None
        if source.place is None:
            continue  # the number of a name: it is an input, and has its place there
        cell = _cell_for(source, family, inputs, idle, evaluator.values)
        if cell is None:
            continue
        role, place = cell
        cells = _cells_with(exam, source)
        if (cells[0], role) in told:
            continue
        told.add((cells[0], role))
        text = f"{title(role)} is typed as {source.value:.10g}, where {address(place, True)} should be read"
        exam.add("typed constant", cells, address(place, place[0] != table.sheet), text, _formula(exam, cells[0]))
        for name in {"step": ("c = dt", "e = dt", "t = dt", "c = e"), "target": ("G",), "strength": ("H",),
                     "size": ("D", "G", "H", "mass"), "inertia": ("G", "H"), "speed": ("V",)}[family]:  # fmt: skip
            broken.pop(name, None)


def _cells_with(exam: Examination, source: Source) -> list[Position]:
    """All cells of a column whose formula holds a typed number; or the one cell beside the table."""
    table, evaluator = exam.table, exam.table.evaluator
    place = source.place
    assert place is not None
    shape = evaluator.formulas[place]
    for line in (*table.lines.values(), *table.helpers):
        along = place[2] if line.across else place[1]
        if line.place(along) == place:
            cells = [line.place(i) for _, i in sorted(table.rows.items())
                     if evaluator.formulas.get(line.place(i)) is shape]  # fmt: skip
            return cells or [place]
    return [place]


def _cell_for(
    source: Source, family: str, inputs: Inputs, idle: Sequence[Position],
    values: Mapping[Position, object],
) -> tuple[str, Position] | None:  # fmt: skip
    """The cell that holds what a typed number repeats: its role and place; None if there is none."""
    needed = [n for n in "GHDcetV" if abs(source.powers.get(n, 0.0)) > 0.02]
    for role in FAMILIES[family]:
        known = inputs.cells.get(role)
        if known is None or known.cell is None or inputs.how.get(role) == "unread":
            continue
        lacking = [n for n in needed if abs(known.powers.get(n, 0.0)) < 0.02]
        if lacking and (family != "inertia" and (family != "size" or _digits_alike(source.value, known.value))):
            return role, known.place  # type: ignore[return-value]
    for role in FAMILIES[family]:
        known = inputs.cells.get(role)
        if known is not None and known.cell is not None and inputs.how.get(role) == "unread":
            others = [r for r in FAMILIES[family] if r in inputs.cells and r != role]
            if family in ("target", "step", "speed") or _digits_alike(source.value, known.value) or not others:
                if _digits_alike(source.value, known.value) or family in ("target", "step", "speed"):
                    return role, known.place
    for place in idle:
        value = values.get(place)
        if type(value) is float and value == source.value and not is_plain(value):
            label, unit = inputs.labels.get(place, ("", None))
            roles = input_roles(label, unit) if label else frozenset()
            if not roles or roles & set(FAMILIES[family]):
                return FAMILIES[family][0] if not roles else next(iter(roles)), place
    return None


def _digits_alike(a: float, b: float) -> bool:
    """Whether two numbers are the same but for a power of ten, or one is twice the other."""
    if not a or not b or a / b <= 0:
        return False
    for times in (1.0, 2.0, 0.5):
        power = math.log10(a / b * times)
        if abs(power - round(power)) < 1e-9:
            return True
    return False


# ---- the inputs as they are taken, and as they should be


def _take(exam: Examination, inputs: Inputs) -> None:
    """Note the inputs in SI units, from cells, from formulas, from typed numbers, from the fit."""
    for role in INPUTS:
        source = inputs.cells.get(role) or inputs.derived.get(role)
        if source is None:
            continue
        label, unit = inputs.labels.get(source.cell or ("", 0, 0), (source.name, None))
        power = inputs.powers.get(source.item, 0.0)
        how = "formulas" if source.cell is None else inputs.how.get(role, "response")
        exam.inputs[role] = Input(role, _si(source.value, power), source.cell, how, label, unit, source.value)
    six = _six_si(exam)
    known = {"step": six.c, "velocity": six.V, "radius": six.D / 2}
    for role, value in known.items():
        if role not in exam.inputs and not (role == "radius" and "diameter" in exam.inputs):
            if math.isfinite(value) and value > 0:
                exam.inputs[role] = Input(role, value, None, "rows")
    if "diameter" in exam.inputs and "radius" not in exam.inputs:
        diameter = exam.inputs["diameter"]
        exam.inputs["radius"] = Input("radius", diameter.si / 2, None, "follows", "diameter")
    if "resistance" not in exam.inputs and {"beta", "flow_stress"} <= exam.inputs.keys():
        value = exam.inputs["beta"].si * exam.inputs["flow_stress"].si
        exam.inputs["resistance"] = Input("resistance", value, None, "follows", "beta and flow stress")
    _solve_rest(exam, six)


def _si(value: float, power: float) -> float:
    """A number in SI units, rounded once where the unit is a power of ten."""
    from fractions import Fraction

    if power == round(power) and math.isfinite(value):
        return float(Fraction(repr(value)) * Fraction(10) ** round(power))
    return value * 10.0**power


def _solve_rest(exam: Examination, six: Six) -> None:
    """Solve inputs that no cell holds from the six numbers."""
    inputs = exam.inputs
    radius = inputs.get("radius")
    if radius is None or not math.isfinite(six.G + six.H):
        return
    volume = 4 / 3 * math.pi * radius.si**3
    mass = inputs.get("mass")
    M = mass.si if mass else None
    if M is None and "particle_density" in inputs:
        M = volume * inputs["particle_density"].si
    if M is None and "target_density" in inputs and six.G > 0:
        M = math.pi * inputs["target_density"].si / (2 * six.G)
    if M is None and "resistance" in inputs and six.H > 0:
        M = math.pi * inputs["resistance"].si / six.H
    if M is None:
        density = report_inputs()["particle_density"][0]
        trial = volume * density
        solved = 2 * six.G * trial / math.pi
        loose = max(1e-6, 10 * exam.fitted.slack)
        if not any(math.isclose(solved, x, rel_tol=loose) for x in report_inputs()["target_density"]):
            return
        M = trial
        inputs["particle_density"] = Input("particle_density", density, None, "report")
    if "particle_density" not in inputs and M > 0:
        inputs["particle_density"] = Input("particle_density", M / volume, None, "rows")
    if "target_density" not in inputs and six.G > 0:
        inputs["target_density"] = Input("target_density", 2 * six.G * M / math.pi, None, "rows")
    if "resistance" not in inputs and six.H > 0:
        inputs["resistance"] = Input("resistance", six.H * M / math.pi, None, "rows")


def _six_si(exam: Examination) -> Six:
    """The six numbers in SI units."""
    units, six = exam.units, exam.fitted.six
    X = units.get("depth", 0.0)
    W = units.get(start_of_row(exam.table)[0], 0.0)
    A = units.get("deceleration", 2 * W - X)
    return Six(
        six.G * 10.0 ** (A - 2 * W - 2 * X), six.H * 10.0 ** (A - 2 * X), six.D * 10.0**X,
        six.c * 10.0 ** (X - W), six.e * 10.0 ** (W - A), six.V * 10.0**W,
    )  # fmt: skip


def _far_from_report(exam: Examination, inputs: Inputs) -> None:
    """Report an input that is the report's but for a power of ten, where all others are the report's;
    and, without accusing them, inputs that are not the report's."""
    others = {}
    report = report_inputs()
    primary = [r for r in exam.inputs if exam.inputs[r].place and not (
        inputs.derived.get(r) and r not in inputs.cells)]  # fmt: skip
    for role in primary:
        entry = exam.inputs[role]
        if role in report and not any(near(entry.si, x) for x in report[role]) and role != "stop_velocity":
            if role == "step" and near(entry.si, 5e-10):
                continue
            others[role] = entry
    alike = [r for r in primary if r in report and r not in others]
    accused = {d.place for d in exam.differences}
    for role, entry in others.items():
        place = entry.place
        assert place is not None
        powers = [math.log10(entry.si / x) for x in report[role] if entry.si > 0]
        off = next((round(p) for p in powers if abs(p - round(p)) < 1e-9), None)
        if place in accused:
            continue
        if off and len(others) == 1 and len(alike) >= 3 and (off % 3 == 0 or off % 2 == 0):
            text = f"the formulas take {title(role)} as {quantity(entry.si, role)}, {times_too(off)}"
            exam.add("unit", [place], entry.value / 10.0**off, text)
            exam.inputs[role] = Input(role, entry.si / 10.0**off, place, entry.how, entry.label, entry.unit, entry.value)
            if role == "radius" and "diameter" in exam.inputs:
                exam.inputs.pop("diameter")
            continue
        shown = " or ".join(quantity(x, role) for x in report[role])
        text = f"{title(role)} is {quantity(entry.si, role)}, in the report {shown}"
        exam.add("other input", [place], None, text)


def _intend(exam: Examination, inputs: Inputs) -> None:
    """The six numbers that the inputs should give, in SI units, and the run with them."""
    six = _six_si(exam)
    si = {role: entry.si for role, entry in exam.inputs.items()}
    D = 2 * si["radius"] if "radius" in si else six.D
    M = None
    if "particle_density" in si and "radius" in si:
        M = 4 / 3 * math.pi * si["radius"] ** 3 * si["particle_density"]
        if exam.inputs["particle_density"].how == "rows" and "mass" in si:
            M = si["mass"]
    elif "mass" in si:
        M = si["mass"]
    G, H = six.G, six.H
    strength = si["beta"] * si["flow_stress"] if {"beta", "flow_stress"} <= si.keys() else si.get("resistance")
    if M and "target_density" in si:
        G = math.pi * si["target_density"] / (2 * M)
    if M and strength:
        H = math.pi * strength / M
    step = si.get("step", six.c)
    exam.intended = Six(G, H, D, step, step, si.get("velocity", six.V))
    exam.stop_velocity = si.get("stop_velocity", 1.0)


# ---- the first rows and the last


def _first_rows(exam: Examination, inputs: Inputs, idle: Sequence[Position]) -> None:
    """Judge the first depth, half a step, and the first velocity."""
    table, evaluator = exam.table, exam.table.evaluator
    if not table.whole:
        return
    step, velocity = inputs.cells.get("step"), inputs.cells.get("velocity")
    if exam.fitted.probe is not None:
        _first_velocity(exam, inputs, idle)
    value, wanted = table.number("depth", 1), predicted(exam, "depth", 1)
    if wanted is None or 1 not in table.rows:
        return
    place = table.place("depth", 1)
    shape = evaluator.formulas.get(place)
    if value is None:
        exam.add("typed number" if shape is None else "odd formula", [place], wanted, "the first depth is no number")
        return
    line = table.lines["depth"]
    slack = 1e-9 + (0.0 if line.computed else 2 * exam.fitted.slack + 2 * line.rounding(value) / abs(wanted))
    ratio = value / wanted
    if abs(ratio - 1) <= slack:
        if shape is None and line.computed and step is not None and step.cell is not None:
            text = f"the first depth is typed, though it rests on {address(step.cell, True)}; it gives the right value here"
            exam.add("typed number", [place], wanted, text)
        elif shape is not None:
            _first_response(exam, place, step, velocity)
        return
    for times, name in ((2.0, "no half step"), (0.0, "starts at zero")):
        if abs(ratio - times) <= max(slack, 1e-9):
            if shape is None and line.computed and times:
                break
            exam.add("other scheme", [place], wanted, f"{name}: {VARIANTS[name].says}")
            return
    if shape is None:
        exam.add("typed number", [place], wanted, "the first depth is typed, and is not V times half a step")
        return
    power = math.log10(ratio) if ratio > 0 else math.nan
    if abs(power - round(power)) < 1e-9:
        exam.add("unit", [place], wanted, f"the first depth is {times_too(round(power))}: a unit is not converted")
        return
    text = f"{_formula(exam, place)} does not give V times half a step"
    exam.add("odd formula", [place], wanted, text)


def _first_response(exam: Examination, place: Position, step: Source | None, velocity: Source | None) -> None:
    """Report a first depth that does not respond to the step or the velocity of their cells."""
    evaluator = exam.table.evaluator
    cone = evaluator.cone([place], ())
    value = evaluator.values[place]
    for role, source in (("step", step), ("velocity", velocity)):
        if source is None or source.cell is None or not source.powers:
            continue
        now = evaluator.value(place, {source.place: source.value * 1.01}, within=cone)
        if type(now) is float and type(value) is float and not math.isclose(now / value, 1.01, rel_tol=1e-9):
            text = f"{title(role)} is typed into the first depth, where {address(source.place, True)} should be read"
            exam.add("typed constant", [place], address(source.place, True), text, _formula(exam, place))
            return


def _first_velocity(exam: Examination, inputs: Inputs, idle: Sequence[Position]) -> None:
    """Judge the velocity that the rows start from."""
    table, evaluator = exam.table, exam.table.evaluator
    place = first_speed(table)
    if place is None or place in {d.place for d in exam.differences}:
        return
    zero = table.place("velocity_initial", 0) if "velocity_initial" in table.lines and 0 in table.rows else None
    first = evaluator.values.get(place)
    if zero is not None and zero != place:
        other = evaluator.values.get(zero)
        if type(other) is float and type(first) is float and not near(other, first):
            if place in evaluator.formulas:
                exam.add("odd formula", [place], other, f"{_formula(exam, place)} is not the velocity of the impact")
            else:
                exam.add("typed number", [place], other, "the first velocity is typed, and is not that of the impact")
            return
    if place in evaluator.formulas:
        return
    known = inputs.cells.get("velocity")
    if known is not None and known.cell is not None and known.cell != place:
        same = "; it gives the right value here" if type(first) is float and _digits_alike(first, known.value) else ""
        text = f"the first velocity is typed, where {address(known.place, True)} should be read{same}"
        exam.add("typed number", [place], known.value, text)
        return
    for cell in idle:
        value = evaluator.values.get(cell)
        if type(value) is float and value == first and not is_plain(value) and cell != zero and cell not in table.places:
            label, unit = inputs.labels.get(cell, ("", None))
            roles = input_roles(label, unit) if label else frozenset()
            if not roles or "velocity" in roles:
                text = f"the first velocity is typed, where {address(cell, True)} should be read; it gives the right value here"
                exam.add("typed number", [place], first, text)
                return


def _stop(exam: Examination, idle: Sequence[Position]) -> None:
    """Run the scheme with the intended inputs, and compare where it stops."""
    table, six = exam.table, exam.intended
    if six is None or not all(math.isfinite(x) and x > 0 for x in six):
        exam.ends = False
        return
    end = end_of_row(table)
    W = exam.units.get(end[0], 0.0)
    speeds = {k: v * 10.0**W for k in table.rows if k >= 1 and (v := table.number(end[0], k + end[1])) is not None}
    last = max(speeds, default=None)
    if last is None:
        exam.ends = False
        return
    stop = _stop_velocity(exam, speeds, last, idle, W)
    exam.stop_velocity = stop
    centered = False
    rows = run(six, stop, centered=centered)
    if not rows or rows[-1].velocity_final >= stop:
        exam.ends = False
        return
    exam.right_depth, exam.steps_right = rows[-1].depth, len(rows)
    if exam.right_depth > six.D / 2 and not is_bounded(exam.fitted, table):
        cells = exam.cells(exam.fitted.brakes, 1)
        if not any(d.place in cells for d in exam.differences if d.kind != "stale value"):
            beyond = VARIANTS["area beyond the radius"]
            deep = [p for p in cells if (x := table.number("depth", table.places[p][1])) and x > exam.fitted.six.D / 2]
            exam.add("other scheme", deep or cells, None, f"{beyond.name}: {beyond.says}")
    steps = table.steps
    if not table.whole or steps == exam.steps_right:
        exam.ends = table.whole
        return
    below = next((k for k, v in sorted(speeds.items()) if v < stop), None)
    column = end[0]
    others = [d for d in exam.differences if d.kind not in ("other input", "not calculated")]
    if below is not None and below < last:
        if others and steps <= exam.steps_right + len(others) * 50 and below == exam.steps_right and False:
            return
        cells = [table.place(column, k) for k in sorted(table.rows) if k > below and k in speeds]
        text = f"other stop: the rows end at {speeds[last]:.4g} m/s, after the stop at {stop:g} m/s"
        shown = _shows_stop(exam, below)
        if cells and not shown:
            exam.add("other scheme", cells, None, text)
        return
    if below is not None:
        return  # it ends at its own stop; another number of steps follows from another fault
    exam.ends = False
    text = f"the rows end at {speeds[last]:.4g} m/s, before the stop at {stop:g} m/s: {steps} of {exam.steps_right:,} steps"
    is_report = not any(d.kind == "other input" for d in exam.differences) and not others
    prepared = any(
        len(run(six._replace(H=six.H * x / y), stop)) == steps
        for x in report_inputs()["resistance"] for y in report_inputs()["resistance"] if x != y
    )  # fmt: skip
    place = table.place(column, steps)
    if is_report and not prepared and 2 * steps >= exam.steps_right and exam.inputs.get("velocity") is not None and _all_report(exam):
        exam.add("other scheme", [place], None, f"other stop: {text}")
        exam.ends = True
    else:
        exam.add("not calculated", [place], None, text)


def _all_report(exam: Examination) -> bool:
    """Whether the six numbers are those of one of the report's cases, whatever the step."""
    six = exam.intended
    assert six is not None
    report = report_inputs()
    M = report["mass"][0]
    G = math.pi * report["target_density"][0] / (2 * M)
    loose = max(1e-6, 10 * exam.fitted.slack)
    return (
        math.isclose(six.G, G, rel_tol=loose)
        and any(math.isclose(six.H, math.pi * x / M, rel_tol=loose) for x in report["resistance"])
        and math.isclose(six.V, report["velocity"][0], rel_tol=loose)
    )


def _stop_velocity(
    exam: Examination, speeds: Mapping[int, float], last: int, idle: Sequence[Position], W: float
) -> float:
    """The velocity at which the rows stop: that of its cell, or 1 m/s as in the report.

    A cell without a label is it if the last row is the first one below it.
    """
    if "stop_velocity" in exam.inputs:
        return exam.inputs["stop_velocity"].si
    before = speeds.get(last - 1, math.inf)
    if speeds[last] < 1.0 <= before:
        return 1.0
    evaluator = exam.table.evaluator
    cells = [p for p in (*exam.read, *idle) if p not in exam.table.places]
    for place in cells:
        value = evaluator.values.get(place)
        if type(value) is float and 0 < value and any(entry.place == place for entry in exam.inputs.values()) is False:
            if speeds[last] < value * 10.0**W <= before and value * 10.0**W <= 0.1 * exam.fitted.six.V * 10.0**W:
                return value * 10.0**W
    return 1.0


def _shows_stop(exam: Examination, below: int) -> bool:
    """Whether a cell beside the table shows the depth of the row of the stop; later rows are spare."""
    table = exam.table
    depth = table.number("depth", below)
    if depth is None:
        return False
    places = set(table.places)
    for place in table.evaluator.formulas:
        if place in places:
            continue
        value = table.evaluator.values.get(place)
        if type(value) is float and value and depth:
            power = math.log10(abs(value / depth))
            if abs(power - round(power)) < 1e-10 and any(
                a.covers(table.place("depth", below)) for a in table.evaluator.areas(place)
            ):
                return True
    return False



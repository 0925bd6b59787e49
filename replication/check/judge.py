"""What is wrong with one table: each difference with its kind, place and cause.

Units and inputs first, then the scheme: a column in which most cells follow another rule than the
report's is one difference, named by that rule. Then every cell by itself (`cells`), and the stop.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import fields, replace
from fractions import Fraction
from functools import partial
from itertools import pairwise, product
from statistics import median

from reference.units import to_si
from replication.check.cells import (
    drifting,
    each_cell,
    irregular,
    order,
    units_beside,
    wrong_beside,
)
from replication.check.examination import NEAR, Change, Difference, Examination, Input, near
from replication.check.inputs import RESTS_ON, label_of, report_inputs
from replication.check.scheme import (
    BEYOND,
    BRAKES,
    KNOWN,
    MOST_ROWS,
    ORDER,
    PARTS,
    REPORT,
    Case,
    depth_times_ten,
    march,
)  # fmt: skip
from replication.check.table import ROUNDED, Line, address
from replication.check.words import (
    INPUTS,
    between_units,
    digits_of,
    input_roles,
    power_of_ten,
    quantity,
    scaled,
    times_too,
    title,
    titles,
    unit_power,
    unit_text,
)  # fmt: skip
from spreadsheets.foreign import Position

_MIXED = 0.2
"""With so many rows by the report's rule, another one is no scheme, but wrong cells."""
OTHER_STOP: Change = {}
"""The change that a stop elsewhere makes: the rules stay, the number of rows is another."""


def judge(f: Examination, meant: tuple[str, float, str] | None = None) -> None:
    """Find every difference between a table and the report's sheet, but for printed numbers.

    `meant` is an input that it should have: its role, its value in SI, and what tells so.
    """
    _units(f)
    if f.table.digits is None:
        _blanks(f)
        drifting(f)
        _calibrate(f)
        _derived(f)
    if meant:
        _repeated(f, *meant)
    _other_inputs(f)
    if f.table.digits is None:
        _scheme(f)
        each_cell(f)
        _taken_otherwise(f)
        _typed_inputs(f)
        _typed_numbers(f)
        units_beside(f)
        order(f)
    else:
        _as_rounded(f)
    _stop(f)
    _effects(f)


# ---- units and inputs: what the workbook says of them, what its formulas make of them


def _units(f: Examination) -> None:
    """Units in heads that contradict the rest."""
    for role, line in f.table.lines.items():
        named = unit_power(line.unit)
        if named is None or named == f.powers[role]:
            continue
        right, slip = unit_text(role, f.powers[role]), abs(named - f.powers[role])
        place = line.unit_place or f.table.place(role, 1)
        text = f"the head gives {title(role)} in {line.unit}, but the numbers are in {right}"
        f.add("unit", [place], right, f"{text}, a factor of 1e{slip}", line.unit)


def _changed(role: str, value: float, by: float) -> Change:
    """The change to another input, `by` times the one before."""
    return partial(Case.with_input, role=role, value=value, by=by)


def _calibrate(f: Examination) -> None:
    """Inputs that the rows take in another unit than their labels say."""
    drifts = any(difference.kind == "odd formula" for difference in f.differences)
    # Rows whose references drift do not tell.
    if not drifts and f.agreement(BRAKES) < 0.5 and not _has_power(f):
        untold = ("beta", "stop_velocity", "mass")
        entries = [e for e in f.inputs.values() if e.place and e.role not in untold]
        powers = [sign * power for power in (3, 6, 9, 12, 1, 2) for sign in (-1, 1)]
        for entry, power in product(entries, powers):
            if _try_power(f, entry, power, Examination.agreement):
                break
    step, times = f.inputs["step"], f.rows.columns.get("time", {})
    advance = partial(Examination.share, part="advance", rule=REPORT["advance"])
    slip = power_of_ten((times.get(3, math.nan) - times.get(2, math.nan)) / step.si)
    if step.unit and step.place and slip and advance(f) < 0.5:
        _try_power(f, step, slip, advance)
    entry = f.inputs["velocity"]
    if entry.place and entry.unit and entry.factor != (factor := to_si(entry.unit)):
        labelled = replace(entry, si=scaled(entry.si, factor / entry.factor), factor=factor)
        f.inputs = {**f.inputs, "velocity": labelled}
        f.intended = f.intended.with_input("velocity", labelled.si)
        _taken(f, labelled, entry.si, power_of_ten(entry.si / labelled.si) or 0)


def _try_power(
    f: Examination, entry: Input, power: int, share: Callable[[Examination], float]
) -> bool:
    """Take an input as so many powers of ten off, if the rows then follow; whether they do."""
    factor = Fraction(10) ** power
    value = scaled(entry.si, factor)
    changed = f.following(f.case.with_input(entry.role, value, float(factor)))
    if share(changed) < 0.9:
        return False
    f.rows = changed.rows
    _taken(f, entry, value, power)
    return True


def _mislabelled(f: Examination, entry: Input, power: int) -> None:
    """That a label gives another unit than the formulas take: by a power of ten too large."""
    right = unit_text(entry.role, (power_of_ten(float(entry.factor)) or 0) - power)
    text = f"the label gives {title(entry.role)} in {entry.unit}, but the number is in {right}"
    assert entry.place is not None
    f.add("unit", [entry.place], right, f"{text}, as the formulas take it", entry.unit)


def _taken(f: Examination, entry: Input, value: float, power: int) -> None:
    """That the rows take an input as a value so many powers of ten off: by a wrong label, or unit.

    The label is wrong if the value is nearer to the report's than what it says. No fault where it
    has no unit, and might be another number.
    """
    factor = Fraction(10) ** power
    chosen = not entry.unit and not between_units(power, entry.role, surely=True)
    usual = report_inputs()[entry.role]
    off, off_by_label = (min(abs(math.log(x / y)) for y in usual) for x in (value, entry.si))
    if not chosen and not (entry.unit and off < off_by_label):
        _unconverted(f, entry, value, power)
        return
    f.inputs = {**f.inputs, entry.role: replace(entry, si=value, factor=entry.factor * factor)}
    f.intended = f.intended.with_input(entry.role, value, float(factor))
    if not chosen:
        _mislabelled(f, entry, -power)


def _unconverted(f: Examination, entry: Input, value: float, power: int) -> None:
    """That the formulas take an input as a value that is so many powers of ten off.

    If its label has a unit, accused is the cell that should convert it, or the formulas that read
    it; else the input itself.
    """
    cell = f.derived.get("resistance")
    if cell and cell.unit and entry.role in RESTS_ON["resistance"]:
        labelled = scaled(f.calculation.number(cell.place) or 0.0, to_si(cell.unit))
        if near(labelled, f.intended.resistance) and not near(labelled, f.case.resistance):
            entry, value = cell, f.case.resistance  # it is right, what reads it is not
    assert entry.place is not None
    expected: float | None = scaled(entry.si, Fraction(10) ** -power / entry.factor)
    cells, taken = [entry.place], f"{quantity(value, entry.role)}, {times_too(power)}"
    text = f"the formulas take {title(entry.role)} as {taken}"
    ranked = sorted(f.read | f.table.places.keys(), key=f.rank)
    readers = [p for p in ranked if any(a.corner == entry.place for a in f.calculation.areas(p))]
    if entry.unit and readers:
        text += f": {address(entry.place)} is in {entry.unit}"
        columns = {place: f.table.places.get(place, ("",))[0] for place in readers}
        cells = [place for place in readers if columns[place] == columns[readers[0]]]
        lone = (place for place in readers if len(f.calculation.areas(place)) == 1)
        converting = [p for p in lone if near(f.calculation.number(p) or 0.0, value)]
        cells, expected = (converting[:1], entry.si) if converting else (cells, None)
    f.add("unit", cells, expected, text, change=_changed(entry.role, value, 10.0**power))


def _has_power(f: Examination) -> bool:
    """Whether mass, diameter or resistance has a power of ten though its inputs are in SI units."""
    for role, of in RESTS_ON.items():
        cell, sources = f.derived.get(role), [f.inputs[name] for name in of if name in f.inputs]
        if cell is None or cell.unit or any(s.place is None or s.factor != 1 for s in sources):
            continue
        number, wanted = f.calculation.number(cell.place) or 0.0, getattr(f.intended, role)
        power, changed = power_of_ten(number / wanted), f.following(f.case.holding(role, number))
        if sources and cell.place and power and changed.agreement(BRAKES) >= 0.9:
            f.rows = changed.rows
            text = f"{title(role)} is {times_too(power)} for {titles(of)}"
            change = partial(Case.holding, role=role, value=number)
            f.add("unit", [cell.place], wanted, text, change=change)
            return True
    return False


def _derived(f: Examination) -> None:
    """Mass, diameter and resistance as the workbook has them, against what they rest on."""
    known = {entry.role: entry for entry in (*f.unread, *f.inputs.values())}
    spoilt = any(difference.change for difference in f.differences)
    rows, stated = replace(f.case, own_mass=None, own_diameter=None), f.intended
    beta, flow_stress = (known.get(name) for name in RESTS_ON["resistance"])
    if beta and flow_stress and min(beta.si, flow_stress.si) > 0:
        stated = replace(stated, resistance=beta.si * flow_stress.si)
        _product(f, beta, flow_stress, stated.resistance)
    halved = _halved(f, known["radius"])
    for role, of in RESTS_ON.items():
        cell, sources = f.derived.get(role), [known[name] for name in of if name in known]
        # From a number that is not positive nothing follows.
        if cell is None or (role == "diameter" and halved) or any(s.si <= 0 for s in sources):
            continue
        # With an input in a wrong unit the rows have what follows from it, which is no new fault.
        follows = spoilt and math.isclose(cell.si, getattr(rows, role), rel_tol=NEAR)
        if not follows and (any(s.place for s in sources) or cell.si == 0):
            _derived_cell(f, cell, getattr(stated, role), sources)
    if halved:
        _judge_radius(f, halved)


def _halved(f: Examination, radius: Input) -> list[Position]:
    """The cells from that of the radius down to the diameter's, if it is computed from that."""
    cells, place, diameter = list[Position](), radius.place, f.derived.get("diameter")
    while diameter and diameter.si > 0 and place and place not in cells:
        cells.append(place)
        if place == diameter.place:
            return cells if len(cells) > 1 else []
        place = next((area.corner for area in f.calculation.areas(place)), None)
    return []


def _judge_radius(f: Examination, cells: Sequence[Position]) -> None:
    """A radius that is computed from the diameter, through cells, against half of that."""
    radius, diameter = f.inputs["radius"], f.derived["diameter"]
    ratio = radius.si / diameter.si * 2
    simple = all(len(f.calculation.areas(place)) == 1 for place in cells[:-1])
    # Half of it in another unit, the diameter itself, or a quarter of it.
    power, *powers = map(power_of_ten, (ratio, ratio / 2, ratio * 2))
    if not simple or math.isclose(ratio, 1.0, rel_tol=NEAR) or {power, *powers} == {None}:
        return
    place, factor = cells[0], radius.factor * 2
    for between in cells[-2:0:-1]:  # which may have the diameter in another unit
        unit = to_si(label_of(between, f.calculation)[1] or "1")
        if not near(scaled(f.calculation.number(between) or 0.0, unit), diameter.si):
            place, factor = between, unit
            break
    by_diameter = f.following(f.case.holding("diameter", diameter.si))
    f.rows = max(f, by_diameter, key=Examination.agreement).rows
    f.intended = f.intended.with_input("radius", diameter.si / 2)
    named = title("radius") if place == cells[0] else "this diameter"
    says = f"is {times_too(power)} for" if power else "does not follow from"
    text = f"{named} {says} {title('diameter')} in {address(cells[-1])}"
    kind, change = "unit" if power else "odd formula", _changed("radius", radius.si, 1.0)
    f.add(kind, [place], scaled(diameter.si, 1 / factor), text, change=change)


def _product(f: Examination, beta: Input, flow_stress: Input, stated: float) -> None:
    """A target resistance that the rows take, though the cells of its factors give another."""
    used, cell = f.inputs["resistance"], f.derived.get("resistance")
    if cell and _typed_factor(f, cell, cell.si, stated, (beta, flow_stress)):
        return  # the rows take it from its cell, whose formula is judged
    typing = _typing(f, used.si)
    if math.isclose(used.si, stated, rel_tol=1e-6):
        if used.how in ("formulas", "report") and typing and beta.place:
            _lost(f, "resistance", typing, beta)
        return
    cells = typing or f.cells(*f.rows.shows("brake", 1))
    if used.how not in ("rows", "formulas", "report"):
        return
    taken, times = quantity(used.si, "resistance"), f"{used.si / flow_stress.si:.6g}"
    text = f"the rows take {taken} for the target resistance, {times} times the flow stress; "
    text += f"beta is {beta.si:g} in {_where(beta, cells[0])}"
    change = _changed("resistance", used.si, 1.0)
    f.intended = f.intended.with_input("resistance", stated)
    f.add("typed constant", cells, None, text, f.calculation.book[cells[0]].formula, change)


def _typing(f: Examination, value: float) -> list[Position]:
    """The cells of the column that has a number typed into most of its formulas, if one has.

    It may be typed in another unit, if it has more digits than one: 5 is in 0.5, too.
    """
    several = digits_of(value)[0] > 1

    def is_typed(number: float) -> bool:
        return near(number, value) or (several and power_of_ten(number / value) is not None)

    for line in f.table.every_line:
        formulas = [f.calculation.formulas[p] for p in line.cells if p in f.calculation.formulas]
        cells = [each.place for each in formulas if any(map(is_typed, each.typed))]
        if len(cells) > 0.5 * len(formulas):
            return cells
    return []


def _lost(f: Examination, role: str, cells: Sequence[Position], source: Input) -> None:
    """That an input's value is typed into cells, and a change of the cell that has it is lost."""
    role_there, _ = f.table.places.get(cells[0], ("", 0))
    where = _where(source, cells[0])
    column = f"{'the column of ' * (len(cells) > 1)}{address(cells[0])}"
    into = title(role_there) if role_there else column
    text = f"{title(role)} is typed into {into}: a change of {where} is lost"
    expected = where if source.place else source.label
    f.add("typed constant", cells, expected, text, f.calculation.book[cells[0]].formula)


def _where(source: Input, beside: Position) -> str:
    """The cell of an input, with its sheet if that is another, or its name."""
    if source.place is None:
        return f"the name {source.label}"
    return address(source.place, source.place[0] != beside[0])


def _repeated(f: Examination, role: str, value: float, told: str) -> None:
    """A table that reads an input of another one, which it repeats."""
    part, taken = "advance" if role == "step" else "brake", getattr(f.case, role)
    cells = [f.start] if role == "velocity" else f.cells(*f.rows.shows(part, 1))
    text = f"the rows take {quantity(taken, role)} for {title(role)}, "
    text += f"and so repeat another table; {told}"
    f.intended = f.intended.with_input(role, value)
    formula = f.calculation.book[cells[0]].formula
    f.add("odd formula", cells, None, text, formula, _changed(role, taken, 1.0))


def _derived_cell(f: Examination, cell: Input, wanted: float, sources: Sequence[Input]) -> None:
    """Mass, diameter or resistance in a cell, against what its sources give [SI]."""
    role, place = cell.role, cell.place
    assert place is not None
    number = f.calculation.number(place) or 0.0
    by_value = power_of_ten(wanted / number) if number and cell.unit is None else None
    factor = cell.factor if by_value is None else Fraction(10) ** by_value
    in_si = scaled(number, factor)
    power = power_of_ten(in_si / wanted)
    if power and cell.unit and f.agreement(BRAKES) >= 0.5:  # the formulas take it rightly
        _mislabelled(f, cell, power)
        return
    exact = math.isclose(in_si, wanted, rel_tol=NEAR)
    fault = _fault_of_derived(f, cell, in_si, wanted, sources)
    if fault:
        change = None if exact else partial(Case.holding, role=role, value=in_si)
        expected = None if exact else scaled(wanted, 1 / factor)
        f.add(fault[0], [place], expected, f"{title(role)} {fault[1]}", change=change)
    if in_si > 0 and (not exact or (role == "mass" and factor == 1)):
        f.rows = replace(f.rows, case=f.case.holding(role, in_si))
        f.intended = f.intended.holding(role, wanted if fault and not exact else in_si)


def _fault_of_derived(
    f: Examination, cell: Input, in_si: float, wanted: float, sources: Sequence[Input]
) -> tuple[str, str] | None:
    """The kind of what is wrong with a value that rests on others, and its text; None if right."""
    role, place = cell.role, cell.place
    assert place is not None
    if factor := _typed_factor(f, cell, in_si, wanted, sources):
        return factor
    # What the formula has for pi, or for the factor of a unit such as ksi.
    constants = {"pi": math.pi, **{f"a {s.unit}": float(s.factor) for s in sources if s.unit}}
    typed = [
        (name, constant, number)
        for name, constant in constants.items()
        for number in _as_typed(f, place, constant)
        if math.isclose(in_si / number * constant, wanted, rel_tol=NEAR)
    ]
    right = math.isclose(in_si, wanted, rel_tol=NEAR)
    # Tables print the factors of units with four digits and more.
    right |= any(n != "pi" and math.isclose(c, t, rel_tol=1e-4) for n, c, t in typed)
    rests, power = titles(source.role for source in sources), power_of_ten(in_si / wanted)
    if place not in f.calculation.formulas:
        whole = len(sources) == len(RESTS_ON[role])  # from one factor nothing follows
        if not f.read or not whole or (right and not any(s in f.unread for s in sources)):
            return None
        if power:
            return "unit", f"is {times_too(power)} for {rests}"
        lost = "a change there changes nothing"
        return "typed constant", f"is typed as a number, though it rests on {rests}: {lost}"
    if power:
        return "unit", f"is {times_too(power)} for {rests}: a unit is not converted"
    if right:
        return None
    if typed:
        name, constant, number = typed[0]
        return "typed constant", f"takes {number:.10g} for {name}, not {constant:.10g}"
    says = f"does not follow from {rests}" if in_si else "is 0; the report's is assumed"
    return "odd formula", says


def _typed_factor(
    f: Examination, cell: Input, in_si: float, wanted: float, sources: Sequence[Input]
) -> tuple[str, str] | None:
    """The fault of a formula that has a number for an input, whose own cell nothing reads."""
    assert cell.place is not None
    formula = f.calculation.formulas.get(cell.place)
    if formula is None or cell.role != "resistance":
        return None
    for source in sources:
        typed = source.si * in_si / wanted
        if source in f.unread and any(near(number, typed) for number in formula.typed):
            where = f"{source.si:.6g} in {_where(source, cell.place)}"
            says = f"takes {typed:.6g} for {title(source.role)}, which is {where}"
            return "typed constant", f"{says}: a change there is lost"
    return None


def _as_typed(f: Examination, place: Position, constant: float) -> Iterator[float]:
    """Numbers of a cell's formula that are a constant rounded to three digits or more.

    Or of the formulas of cells that it reads. A power of ten that converts another unit may be in
    them.
    """
    cells = [area.corner for area in f.calculation.areas(place) if area.cells == 1]
    formulas = filter(None, map(f.calculation.formulas.get, (place, *cells)))
    typed = (number for formula in formulas for number in formula.literals)
    numbers = [*typed, *map(f.calculation.number, cells)]
    for number in numbers if power_of_ten(constant) is None else ():
        if number is None or number <= 0:
            continue
        power = round(math.log10(number / constant))
        value = scaled(number, Fraction(10) ** -power)
        digits, _ = digits_of(value)
        if digits >= 3 and value == float(f"{constant:.{digits - 1}e}"):
            yield value


def _other_inputs(f: Examination) -> None:
    """Other inputs than the report's; a single one that is a power of ten off has a wrong unit."""
    report, density = report_inputs(), f.inputs["particle_density"]
    told = {entry.role for entry in f.unread}  # by `_taken_otherwise`, if in no cell that is read
    lone_mass = density.how == "follows" and not near(density.si, report["particle_density"][0])
    off = {
        role: entry
        for role, entry in f.inputs.items()
        if role in report and entry.how not in ("report", "assumed", "follows")
        if getattr(f.intended, role, entry.si) == entry.si
        if role != "mass" or lone_mass
        if entry.place or role not in told
        if not any(near(entry.si, value) for value in report[role])
    }
    for role, entry in off.items():
        alike = [value for value in report[role] if power_of_ten(entry.si / value) is not None]
        nearest = min(alike or report[role], key=lambda value: abs(value - entry.si))
        value, usual = quantity(entry.si, role), quantity(nearest, role)
        text = f"{title(role)} is {value}, in the report {usual}"
        if role == "target_density":
            text += ", inferred, since the report prints none"
        for name, values in report.items():
            if INPUTS[name] == INPUTS[role] and any(near(entry.si, x) for x in values):
                text += f"; {value} is {title(name)} there"
        kind, change = "other input", None
        power = power_of_ten(entry.si / nearest) or 0
        may_be_chosen = len(off) > 1 and abs(power) < 6  # such as a step of 0.2 ps
        if power and between_units(power, role, surely=True) and not may_be_chosen:
            kind, text = "unit", f"{text}: a factor of 1e{abs(power)}"
            change = _changed(role, entry.si, entry.si / nearest)
            f.intended = f.intended.with_input(role, nearest, nearest / entry.si)
        typed = _typing(f, entry.si) if entry.how == "formulas" else []
        place = entry.place or next(iter(typed), f.table.place("depth", 1))
        solved = entry.si if entry.place is None else None
        f.add(kind, [place], scaled(nearest, 1 / entry.factor), text, solved, change)


def _taken_otherwise(f: Examination) -> None:
    """Inputs whose cells the rows do not read, and for which they take another value."""
    for entry in f.unread:
        used = f.inputs.get(entry.role)
        if used is None or used.place or used.how in ("follows", "name"):
            continue  # its cell, or those that it follows from, are known
        if entry.role == "resistance" and any(e.role == "beta" for e in f.unread):
            continue  # told by that already
        if entry.role == "target_density" and f.rows.rules["brake"] != REPORT["brake"]:
            continue  # which may have none
        unlike = not math.isclose(used.si, entry.si, rel_tol=1e-6)
        if min(used.si, entry.si) <= 0 or not unlike:
            continue
        cells = [f.start] if entry.role == "velocity" else _typing(f, used.si)
        cells = cells or [entry.place or f.table.place("depth", 1)]
        where = _where(entry, cells[0])
        here, there = (quantity(value, entry.role) for value in (entry.si, used.si))
        text = f"{title(entry.role)} is {here} in {where}, but the rows take {there}"
        change = _changed(entry.role, used.si, used.si / entry.si)
        formula = f.calculation.book[cells[0]].formula
        f.add("typed constant", cells, None, text, formula, change)
        f.intended = f.intended.with_input(entry.role, entry.si, entry.si / used.si)


def _typed_inputs(f: Examination) -> None:
    """Inputs whose value stands in formulas that do not read their cell."""
    accused, told = f.accused, set[tuple[str, Position]]()
    columns = [(role, f.cells(role, 0)) for role in f.table.lines]
    columns += [("", line.cells) for line in f.table.helpers]
    columns += [("", [r.place]) for r in f.table.results if f.table.gives_depth(r.place)]
    for entry, (role, places) in product((*f.inputs.values(), *f.unread), columns):
        if entry.place is None and entry.how != "name":
            continue
        cells = [place for k, place in enumerate(places)
                 if place not in accused and _typed_in(f, entry, role, k, place)]  # fmt: skip
        # A number in a few formulas of many is one of their own, such as the row's.
        often = len(cells) >= 0.5 * len(places) or set(cells) & set(places[:2])
        if often and (entry.role, cells[0]) not in told:
            told.add((entry.role, cells[0]))
            _lost(f, entry.role, cells, entry)


def _typed_numbers(f: Examination) -> None:
    """Numbers that are typed where the rest is computed: whole columns, first cells, and texts."""
    formulas, roles = f.calculation.formulas, [role for role in ORDER if role in f.table.lines]
    cells = {role: f.cells(role, 1) for role in roles}
    typed = [role for role in roles if not formulas.keys() & set(cells[role][1:])]
    for role in typed if len(typed) < len(roles) else ():
        if not f.accused.intersection(cells[role]):
            lost = "a change of an input changes nothing there"
            text = f"{title(role)} is typed in every row: {lost}"
            f.add("typed number", cells[role], None, text)
    rests_on = {"velocity_initial": ["velocity"], "depth": ["velocity", "step"]}
    for role, of in rests_on.items():
        if role not in roles:
            continue
        place, sources = cells[role][0], [f.inputs[name].place for name in of]
        known = [cell for cell in sources if cell and cell not in f.table.places]
        is_typed = place not in formulas and f.table.place(role, 2) in formulas
        if known == sources and is_typed and place not in f.accused and f.calculation.number(place):
            lost = " or ".join(address(cell, cell[0] != place[0]) for cell in known)
            text = f"it is typed as a number: a change of {lost} is lost here"
            f.add("typed number", [place], None, text)
    texts = f.calculation.texts
    for place in sorted((texts.keys() & (f.read | f.table.places.keys())) - f.accused):
        text = "it is a text, not a number: not every program calculates with it"
        f.add("typed number", [place], float(texts[place]), text, repr(texts[place]))


def _blanks(f: Examination) -> None:
    """Blank cells that a label calls an input, if the rows take each of them for 0."""
    values, blanks, case = f.calculation.values, dict[Position, str](), f.case
    for sheet, row, column in sorted(f.read - values.keys()):
        label = values.get((sheet, row, column - 1))
        if not isinstance(label, str):
            continue
        named = input_roles(label, None) or f.inputs.keys()  # in any language
        known = (f.inputs[role] for role in named & f.inputs.keys())
        roles = [entry.role for entry in known if entry.place is None and entry.how != "follows"]
        if len(roles) == 1:
            blanks[sheet, row, column] = roles[0]
            case = case.with_input(roles[0], 0.0, 0.0)
    taken = f.following(case)
    if taken.agreement() > f.agreement():
        f.rows = taken.rows
        for place, role in blanks.items():
            text = f"{title(role)} is blank, which the formulas take for 0"
            f.add("odd formula", [place], None, text, change=_changed(role, 0.0, 0.0))


def _typed_in(f: Examination, entry: Input, role: str, k: int, place: Position) -> bool:
    """Whether a cell has an input's value as a number, and does not read the input's cell."""
    formula, value = f.calculation.formulas.get(place), scaled(entry.si, 1 / entry.factor)
    if role and k == 0 and 0 not in f.rows.columns[role]:
        return False  # a head above the first row
    if formula is None:
        # The impact velocity typed into the first row, while its own cell is read by nothing.
        first = entry.role == "velocity" and role.startswith("velocity") and k <= 1
        number = f.rows.columns[role].get(k) if first else None
        return entry in f.unread and number is not None and near(number, entry.si)
    if not formula.typed or entry.role == "beta" or entry.label.upper() in formula.names:
        return False
    if entry.role == "stop_velocity":
        pairs = pairwise(piece.text for piece in formula.pieces)
        typed = any(sign in ("<", "<=", ">", ">=") and to == f"{value:g}" for sign, to in pairs)
    else:
        values = {wanted for wanted in (entry.si, value) if not _plain(wanted)}
        if entry.role == "step":
            halves, is_first = {entry.si / 2, value / 2}, (role, k) == ("depth", 1)
            # The first row takes half of it, be it 1e-10 s, which lies between no units of time.
            odd = {h for h in halves if not between_units(power_of_ten(h) or 0, "step", True)}
            values |= {h for h in halves if not _plain(h) or (is_first and h in odd)}
        typed = any(near(*pair) for pair in product(values, formula.typed))
    read = (f.calculation.source(area.corner) for area in formula.areas if area.cells == 1)
    return typed and all(cell != entry.place for cell in read)


def _plain(value: float) -> bool:
    """Whether a number stands in formulas for itself: small whole ones, halves, powers of ten."""
    whole = float(value).is_integer() and abs(value) <= 10
    return whole or value in (0.5, 1.5, 12.0) or power_of_ten(abs(value)) is not None


# ---- which scheme the table follows, rule by rule, by what most of its rows do


def _scheme(f: Examination) -> None:
    """The rules that most rows follow, and a difference for each that is not the report's."""
    chosen = {"start": REPORT["start"]}
    if f.follows("start", REPORT["start"], 1) is False:  # None if there is no velocity
        starts = (rule for rule in KNOWN["start"] if f.follows("start", rule, 1))
        chosen["start"] = next(starts, REPORT["start"])
    unknown = []
    # Without a column for the deceleration, the brake is known by the velocity that it makes.
    parts = ("advance", "brake", "end") if "deceleration" in f.table.lines else ("advance", "brake")
    for part in parts:
        published, *others = KNOWN[part]
        shares = {published: f.share(part, published)}
        if shares[published] < 0.9:
            shares |= {rule: f.share(part, rule) for rule in others}
        best = max(shares, key=lambda rule: shares[rule])
        # Where formulas of some rows are right, those that are not are found one by one.
        beside = wrong_beside(f) if part == "brake" and best != BEYOND else None
        line = beside.line if beside else f.line(part)
        is_mixed = _MIXED <= shares[published] < shares[best] and any(irregular(line, f.table))
        # Or it is known already why the rows do not follow.
        place = f.table.place(*f.rows.shows(part, 3))
        read = {place, *(area.corner for area in f.calculation.areas(place))} & f.accused
        known = any(line.covers(cell) for cell in read for line in f.table.every_line)
        if is_mixed or (known and (best != published or shares[best] < 0.5)):
            continue
        if shares[best] < 0.5:
            unknown.append(part)
        else:
            chosen[part] = best
    deepest = max(march(f.intended)["depth"].values())
    if "brake" in chosen and deepest < f.intended.radius:
        # What the area is beyond the radius does not matter to a sheet that should not get there.
        rules = (BRAKES[0], chosen["brake"], BEYOND)
        flat, brake, deeper = (f.share("brake", rule) for rule in rules)
        if deeper > flat and deeper >= brake:
            chosen["brake"] = replace(BEYOND, says="")
    f.rows = replace(f.rows, rules=REPORT | chosen)
    _accuse(f, unknown)


def _accuse(f: Examination, unknown: Sequence[str] = ()) -> None:
    """A difference for each part of the scheme that follows another rule, or none that is known."""
    for part in (*unknown, *f.rows.others):
        filled, first = PARTS[part]
        judged = range(first, f.table.steps)
        first = next((k for k in judged if not f.follows(part, REPORT[part], k)), first)
        role, at = f.rows.shows(part, first)
        wanted = replace(f.rows, rules=REPORT).wanted(role, at) if role == filled else None
        cells, shown = f.cells(role, at), f.shown(role, wanted)
        if part in unknown:
            kind, text, line = _cause(f, part)
            if not line.covers(cells[0]):  # a column beside it, which it reads
                rows, shown = range(first, f.table.steps + 1), None
                cells = [*(line.place(f.table.zero + k) for k in rows), *cells]
            f.add(kind, cells, shown, text)
            continue
        rule = f.rows.rules[part]
        cells = cells[:1] if part == "start" else cells
        if part == "brake" and (beside := wrong_beside(f)):
            cells, shown = [*beside.cells.values()], None
        f.add("other scheme", cells, shown, f"{rule.name}: {rule.says}", change={part: rule})


def _cause(f: Examination, part: str) -> tuple[str, str, Line]:
    """What else explains a column that follows no rule known here: a constant factor, and where."""
    beside = wrong_beside(f) if part == "brake" else None
    column = beside.line if beside else f.line(part)
    rows = range(PARTS[part][1], f.table.steps + 1)
    ratios = [ratio for k in rows if (ratio := _ratio(f, part, k)) is not None]
    ratio = median(ratios) if ratios else 0.0
    if not ratio or sum(near(each, ratio) for each in ratios) < 0.5 * len(ratios):
        for slip in (3, -3, 6, -6) if part == "brake" else ():
            if f.share(part, depth_times_ten(slip)) >= 0.9:
                text = f"the contact area takes the depth as {times_too(slip)}: a unit is not"
                return "unit", f"{text} converted rightly", column
        text = "these cells follow no scheme that this program knows"
        return "other scheme", beside.says if beside else text, column
    what, slips, constants = "step", dict[str, float](), {"the time step": f.case.step}
    if part == "brake":
        what, constants = "force", {"pi": math.pi, "the mass": f.case.mass}
        slips = {"pi is missing in the force": 1 / math.pi,
                 "the force is not divided by the mass": f.case.mass}  # fmt: skip
    if power := power_of_ten(ratio):
        return "unit", f"every {what} is {times_too(power)}: a unit is not converted", column
    slips[f"every {what} has the other sign"] = -1.0
    if named := next((says for says, value in slips.items() if near(ratio, value)), ""):
        return "other scheme", named, column
    for line, (constant, value) in product((column, *f.table.helpers), constants.items()):
        formulas = filter(None, map(line.calculation.formulas.get, line.cells))
        for number in sorted({abs(n) for formula in formulas for n in formula.literals} - {0.0}):
            # What is divided by makes the force larger the smaller it is.
            if near(value / number if constant == "the mass" else number / value, ratio):
                return "typed constant", f"{constant} is typed as {number:.10g}", line
    fraction = Fraction(ratio).limit_denominator(8)
    named = f"{fraction}" if near(fraction, ratio) else f"{ratio:.6g}"
    named = f"{ratio:.10g}" if named == "1" else named
    return "other scheme", f"every {what} is {named} times that of the report's scheme", column


def _ratio(f: Examination, part: str, k: int) -> float | None:
    """What a row adds to the one before, over what it would add by the report's rule."""
    rows = replace(f.rows, rules=REPORT)
    role, at = rows.shows(part, k)
    before = {"deceleration": 0.0, "depth": rows("depth", k - 1)}
    start = before.get(role, rows("velocity_initial", k))
    actual, wanted = rows(role, at), rows.wanted(role, at)
    if start is None or actual is None or wanted is None or wanted == start:
        return None
    ratio = (actual - start) / (wanted - start)
    return ratio if math.isfinite(ratio) else None


def _as_rounded(f: Examination) -> None:
    """Judge typed and rounded numbers by whole runs, of the scheme that fits them best."""
    parts = ("brake", "start", "advance", "end")
    others = [REPORT | {part: rule} for part in parts for rule in KNOWN[part][1:]]
    # The report's own table may stand beside a sheet that has other inputs.
    report = {role: values[0] for role, values in report_inputs().items()}
    printed = Case(**{each.name: report[each.name] for each in fields(Case) if each.name in report})
    if not any(_misprints(f, march(printed, steps=f.table.steps))):
        f.intended, f.rows = printed, replace(f.rows, case=printed)

        def is_printed(role: str, value: float) -> bool:
            return near(value, report[role]) or near(value, getattr(printed, role, 0.0))

        f.inputs = {role: e for role, e in f.inputs.items() if is_printed(role, e.si)}
        f.derived = {role: e for role, e in f.derived.items() if is_printed(role, e.si)}
    tried = []
    for rules in (REPORT, *others):
        run = march(f.case, rules, steps=f.table.steps)
        if f.table.steps in run["depth"]:  # some need another brake, and give no rows without
            tried.append((list(_misprints(f, run)), rules))
    misprints, rules = min(tried, key=lambda each: len(each[0]))
    f.rows = replace(f.rows, rules=rules)
    _accuse(f)
    for role, k, expected in misprints:
        text = f"{title(role)} of row {k} is not what the scheme gives"
        f.add("typed number", [f.table.place(role, k)], expected, text)


def _misprints(
    f: Examination, run: Mapping[str, Mapping[int, float]]
) -> Iterator[tuple[str, int, float | None]]:
    """Numbers that do not round as a scheme's do: role, row, and what it should be if finite."""
    for role in set(run) & set(f.table.lines):
        for k, right in run[role].items():
            value, wanted = f.table.number(role, k), f.shown(role, right)
            if value is None or wanted is None or (k == 0 and role == "velocity_final"):
                continue
            digits, least = f.table.roundings[role]
            expected, place = None, least
            if wanted and math.isfinite(wanted):
                digits = min(digits, ROUNDED)  # the last ones depend on the order of operations
                place = max(math.floor(math.log10(abs(wanted))) + 1 - digits, least)
                expected = float(round(Fraction(wanted), -place))
            if not abs(value - wanted) <= 10.0**place * (0.5 + 1e-9):
                yield role, k, expected


# ---- the stop, and all of it together


def _stop(f: Examination) -> None:
    """Whether the rows end with the first velocity below the stop."""
    steps, rows, case = f.table.steps, f.rows, f.case
    finals = {k: v for k in range(1, steps + 1) if (v := rows("velocity_final", k)) is not None}
    if steps not in finals and (last := rows.wanted("velocity_final", steps)) is not None:
        finals[steps] = last  # computed where the table ends before it shows it
    below = next((k for k, v in finals.items() if v < case.stop_velocity), None)
    planned = max(march(f.intended)["depth"])
    if not finals or steps in (below, planned):
        return  # with as many rows as there should be, where they end follows from the rest
    role = "velocity_final" if "velocity_final" in f.table.lines else "velocity_initial"
    end, stop = f"{finals[max(finals)]:.4g} m/s", f"the stop at {case.stop_velocity:g} m/s"
    if below is not None:
        guarded = f.calculation.book[f.table.place(role, below)].formula or ""
        if "IF(" not in guarded.upper() and _end_as_shown(f, below, planned):
            return
        text = f"other stop: the rows end at {end}, after {stop}"
        f.add("other scheme", f.cells(role, below + 1), None, text, change=OTHER_STOP)
        return
    run = march(case, rows.rules)["velocity_final"]
    whole = max(run, default=0)
    if whole <= steps or (run[whole] >= case.stop_velocity and whole < MOST_ROWS):
        return  # the rules that the rows follow do not lead to the stop by themselves
    of = f"{whole:,}" if whole < MOST_ROWS else f"more than {MOST_ROWS:,}"
    text = f"the rows end at {end}, before {stop}: {steps} of {of} steps"
    # With other inputs, or the report's other beta, rows prepared for those before run out; an
    # excerpt has few, none of which is called the final depth. But who leaves off shortly before
    # the report does stops at another velocity.
    changed = any(d.kind == "other input" or callable(d.change) for d in f.differences)
    cases = [replace(case, resistance=each) for each in report_inputs()["resistance"]]
    prepared = any(max(march(each, rows.rules)["depth"]) == steps for each in cases)
    place = f.table.place(role, steps)
    named = (result.place for result in f.table.results if result.kind == "depth")
    shown = any(a.corner in f.table.places for each in named for a in f.calculation.areas(each))
    if changed or prepared or (2 * steps < whole and not shown):
        f.add("not calculated", [place], None, text)
    else:
        f.add("other scheme", [place], None, f"other stop: {text}", change=OTHER_STOP)


def _end_as_shown(f: Examination, below: int, planned: int) -> bool:
    """Whether a result shows the stop, or the row before: then the rows after it are left out.

    They were filled in to be enough, and the final depth is looked up where the stop is.
    """
    shown = [(r.kind, f.calculation.number(r.place)) for r in f.table.results if r.where == "first"]
    for k in (below, planned, below - 1):
        if any(x is not None and f.power_shown(kind, x, k) is not None for kind, x in shown):
            last, columns = planned if k == planned else below, f.rows.columns.items()
            kept = {role: {n: x for n, x in each.items() if n <= last} for role, each in columns}
            f.table, f.rows = replace(f.table, steps=last), replace(f.rows, columns=kept)
            return True
    return False


def stops_elsewhere(f: Examination) -> bool:
    """Whether a difference is a stop in another row."""
    return any(difference.change == OTHER_STOP for difference in f.differences)


def _effects(f: Examination) -> None:
    """What the final depth should be, and what each difference alone would make of it."""
    run = march(f.intended)
    steps = max(run["depth"])
    if run["velocity_final"].get(steps, math.inf) < f.intended.stop_velocity:
        f.right_depth = run["depth"][steps]
    for role, column in f.rows.columns.items():
        for k, value in column.items() if role in run else ():
            right = run[role].get(k)
            f.differing += k > steps if right is None else abs(value - right) > 1e-9 * abs(right)
    if not stops_elsewhere(f):
        steps = f.table.steps
    if f.ends:  # an excerpt has no final depth
        f.differences = [replace(d, effect=_effect(f, d, steps)) for d in f.differences]
    f.differences.sort(key=lambda d: d.rank)


def _effect(f: Examination, difference: Difference, steps: int) -> float | None:
    """The final depth that a difference alone would give, after so many steps."""
    change, fixed, case = difference.change, {}, f.intended
    brake = f.rows.rules["brake"]
    rules = REPORT if brake.says else REPORT | {"brake": brake}
    if callable(change):
        case = change(case)
    elif change is not None:
        rules, steps = {**rules, **change}, f.table.steps
    elif difference.kind in ("typed number", "odd formula", "typed constant", "other scheme"):
        for place in set(difference.cells) & f.table.places.keys():
            role, k = f.table.places[place]
            # A formula takes a blank cell for zero.
            blank = place not in f.calculation.values and place not in f.calculation.formulas
            value = f.rows.columns[role].get(k, 0.0 if blank else None)
            if value is not None:
                fixed[role, k] = value
        if not fixed and f.rank(difference.place)[0] == 1:
            return None  # a text, an error, or a cell beside the table: nothing to go on with
    else:
        return None
    return march(case, rules, fixed, steps=steps)["depth"].get(steps)

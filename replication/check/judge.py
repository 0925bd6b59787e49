"""Judge one table: report each difference from the report's sheet with its kind, place and cause.

Units and inputs come first, then the scheme: if most cells of a column follow another rule than the
report's, that is one difference, named after the rule. Single cells (`cells`) and the stop follow.
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
    Beside,
    irregular,
    judge_cells,
    judge_heads_beside,
    judge_order,
    judge_references,
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
"""If this share of rows follows the report's rule, the others are wrong cells, not a scheme."""
OTHER_STOP: Change = {}
"""The change made by a stop in another row: the rules stay, only the number of rows differs."""


def judge(exam: Examination, meant: tuple[str, float, str] | None = None) -> None:
    """Find every difference between a table and the report's sheet, except printed numbers.

    `meant` is an input that the table should have instead of the one it reads: its role, its value
    in SI units, and a text that says where it stands.
    """
    is_rounded = exam.table.digits is not None
    _units_of_heads(exam)
    if not is_rounded:
        _blank_inputs(exam)
        judge_references(exam)
        _units_of_inputs(exam)
        _derived_inputs(exam)
    if meant:
        _repeated(exam, *meant)
    _other_inputs(exam)
    if is_rounded:
        _as_rounded(exam)
    else:
        _scheme(exam)
        judge_cells(exam)
        _taken_otherwise(exam)
        _typed_inputs(exam)
        _typed_numbers(exam)
        judge_heads_beside(exam)
        judge_order(exam)
    _end_of_rows(exam)
    _effects(exam)


# ---- units and inputs: what the workbook states, and what its formulas make of them


def _units_of_heads(exam: Examination) -> None:
    """Report heads whose unit contradicts the numbers of their column."""
    for role, line in exam.table.lines.items():
        named, power = unit_power(line.unit), exam.powers[role]
        if named is not None and named != power:
            right = unit_text(role, power)
            text = f"the head gives {title(role)} in {line.unit}, but the numbers are in {right}"
            text += f", a factor of 1e{abs(named - power)}"
            place = line.unit_place or exam.table.place(role, 1)
            exam.add("unit", [place], right, text, line.unit)


def _changed(role: str, value: float, by: float) -> Change:
    """Return the change that gives an input another value, `by` times the intended one."""
    return partial(Case.with_input, role=role, value=value, by=by)


def _units_of_inputs(exam: Examination) -> None:
    """Find inputs that the rows take in another unit than their labels state."""
    if exam.agreement(BRAKES) < 0.5 and not _has_power(exam):
        untold = ("beta", "stop_velocity", "mass")
        entries = [e for e in exam.inputs.values() if e.place and e.role not in untold]
        powers = (-3, 3, -6, 6, -9, 9, -12, 12, -1, 1, -2, 2)
        for entry, power in product(entries, powers):
            if _try_power(exam, entry, power, Examination.agreement):
                break
    step, times = exam.inputs["step"], exam.rows.columns.get("time", {})
    advance = partial(Examination.share, part="advance", rule=REPORT["advance"])
    slip = power_of_ten((times.get(3, math.nan) - times.get(2, math.nan)) / step.si)
    if step.unit and step.place and slip and advance(exam) < 0.5:
        _try_power(exam, step, slip, advance)
    entry = exam.inputs["velocity"]
    if entry.place and entry.unit and entry.factor != (factor := to_si(entry.unit)):
        labelled = replace(entry, si=scaled(entry.si, factor / entry.factor), factor=factor)
        exam.inputs = {**exam.inputs, "velocity": labelled}
        exam.intended = exam.intended.with_input("velocity", labelled.si)
        _judge_power(exam, labelled, entry.si, power_of_ten(entry.si / labelled.si) or 0)


def _try_power(
    exam: Examination, entry: Input, power: int, share: Callable[[Examination], float]
) -> bool:
    """Whether the rows follow if an input is 10^power times its stated value; if so, report it."""
    factor = Fraction(10) ** power
    value = scaled(entry.si, factor)
    changed = exam.following(exam.case.with_input(entry.role, value, float(factor)))
    if share(changed) < 0.9:
        return False
    exam.rows = changed.rows
    _judge_power(exam, entry, value, power)
    return True


def _judge_power(exam: Examination, entry: Input, value: float, power: int) -> None:
    """Report that the rows take an input as `value`, 10^power times what its label states.

    The label is wrong if `value` is nearer to the report's than the labelled one, otherwise the
    formulas are. An input without a unit may simply be another number, which is no fault.
    """
    chosen = not entry.unit and not between_units(power, entry.role, surely=True)
    usual = report_inputs()[entry.role]
    off, off_by_label = (min(abs(math.log(x / y)) for y in usual) for x in (value, entry.si))
    if not chosen and not (entry.unit and off < off_by_label):
        _unconverted(exam, entry, value, power)
        return
    factor = Fraction(10) ** power
    taken = replace(entry, si=value, factor=entry.factor * factor)
    exam.inputs = {**exam.inputs, entry.role: taken}
    exam.intended = exam.intended.with_input(entry.role, value, float(factor))
    if not chosen:
        _mislabelled(exam, entry, -power)


def _mislabelled(exam: Examination, entry: Input, power: int) -> None:
    """Report a label whose unit makes an input 10^power times what the formulas take."""
    right = unit_text(entry.role, (power_of_ten(float(entry.factor)) or 0) - power)
    text = f"the label gives {title(entry.role)} in {entry.unit}, but the number is in {right}"
    assert entry.place is not None
    exam.add("unit", [entry.place], right, f"{text}, as the formulas take it", entry.unit)


def _unconverted(exam: Examination, entry: Input, value: float, power: int) -> None:
    """Report that the formulas take an input as `value`, 10^power times too large.

    If its label has a unit, this accuses the cell that should convert it, or the first column of
    formulas that read it; otherwise the input's own cell.
    """
    calculation = exam.calculation
    product_cell = exam.derived.get("resistance")
    if product_cell and product_cell.unit and entry.role in RESTS_ON["resistance"]:
        number = calculation.number(product_cell.place) or 0.0
        labelled = scaled(number, to_si(product_cell.unit))
        if near(labelled, exam.intended.resistance) and not near(labelled, exam.case.resistance):
            # The product is right, so the formulas that read it are wrong.
            entry, value = product_cell, exam.case.resistance
    assert entry.place is not None
    cells = [entry.place]
    expected: float | None = scaled(entry.si, Fraction(10) ** -power / entry.factor)
    text = f"the formulas take {title(entry.role)} as {quantity(value, entry.role)}, "
    text += times_too(power)
    ranked = sorted(exam.read | exam.table.places.keys(), key=exam.rank)
    readers = [place for place in ranked if entry.place in calculation.corners(place)]
    if entry.unit and readers:
        text += f": {address(entry.place)} is in {entry.unit}"
        # Only the first column is accused, so that another fault of a later one is still found.
        columns = {place: exam.table.places.get(place, ("",))[0] for place in readers}
        cells = [place for place in readers if columns[place] == columns[readers[0]]]
        lone = (place for place in readers if len(calculation.areas(place)) == 1)
        converting = [p for p in lone if near(calculation.number(p) or 0.0, value)]
        cells, expected = (converting[:1], entry.si) if converting else (cells, None)
    change = _changed(entry.role, value, 10.0**power)
    exam.add("unit", cells, expected, text, change=change)


def _has_power(exam: Examination) -> bool:
    """Whether a power of ten in mass, diameter or resistance explains the rows; then report it."""
    for role, names in RESTS_ON.items():
        cell = exam.derived.get(role)
        sources = [exam.inputs[name] for name in names if name in exam.inputs]
        if cell is None or cell.unit or any(s.place is None or s.factor != 1 for s in sources):
            continue
        number, wanted = exam.calculation.number(cell.place) or 0.0, getattr(exam.intended, role)
        power = power_of_ten(number / wanted)
        changed = exam.following(exam.case.holding(role, number))
        if sources and cell.place and power and changed.agreement(BRAKES) >= 0.9:
            exam.rows = changed.rows
            text = f"{title(role)} is {times_too(power)} for {titles(names)}"
            change = partial(Case.holding, role=role, value=number)
            exam.add("unit", [cell.place], wanted, text, change=change)
            return True
    return False


def _derived_inputs(exam: Examination) -> None:
    """Compare the workbook's mass, diameter and resistance with the inputs that they rest on."""
    known = {entry.role: entry for entry in (*exam.unread, *exam.inputs.values())}
    is_spoilt = any(difference.change for difference in exam.differences)
    rows, stated = replace(exam.case, own_mass=None, own_diameter=None), exam.intended
    beta, flow_stress = (known.get(name) for name in RESTS_ON["resistance"])
    if beta and flow_stress and min(beta.si, flow_stress.si) > 0:
        stated = replace(stated, resistance=beta.si * flow_stress.si)
        if "resistance" not in exam.derived:  # no cell that the rows read it from
            _judge_resistance(exam, beta, flow_stress, stated.resistance)
    chain = _radius_from_diameter(exam, known["radius"])
    for role, names in RESTS_ON.items():
        cell, sources = exam.derived.get(role), [known[name] for name in names if name in known]
        # Nothing follows from a number that is not positive.
        if cell is None or (role == "diameter" and chain) or any(s.si <= 0 for s in sources):
            continue
        # What follows from an input in a wrong unit, which is reported already, is no new fault.
        follows = is_spoilt and math.isclose(cell.si, getattr(rows, role), rel_tol=NEAR)
        if not follows and (any(s.place for s in sources) or cell.si == 0):
            _judge_derived(exam, cell, getattr(stated, role), sources)
    if chain:
        _judge_radius(exam, chain)


def _radius_from_diameter(exam: Examination, radius: Input) -> list[Position]:
    """Return the cells from the radius back to the diameter that it is computed from, if it is."""
    cells, place, diameter = list[Position](), radius.place, exam.derived.get("diameter")
    while diameter and diameter.si > 0 and place and place not in cells:
        cells.append(place)
        if place == diameter.place:
            return cells if len(cells) > 1 else []
        place = next(iter(exam.calculation.corners(place)), None)
    return []


def _judge_radius(exam: Examination, cells: Sequence[Position]) -> None:
    """Report a radius, computed from the diameter through some cells, that is not half of it."""
    radius, diameter = exam.inputs["radius"], exam.derived["diameter"]
    ratio = radius.si / diameter.si * 2
    is_simple = all(len(exam.calculation.areas(place)) == 1 for place in cells[:-1])
    # It may be half the diameter in another unit, the diameter itself, or a quarter of it.
    power, *others = map(power_of_ten, (ratio, ratio / 2, ratio * 2))
    if not is_simple or math.isclose(ratio, 1.0, rel_tol=NEAR) or {power, *others} == {None}:
        return
    place, factor = cells[0], radius.factor * 2
    for between in cells[-2:0:-1]:  # cells that may convert the diameter to another unit
        unit = to_si(label_of(between, exam.calculation)[1] or "1")
        if not near(scaled(exam.calculation.number(between) or 0.0, unit), diameter.si):
            place, factor = between, unit
            break
    by_diameter = exam.following(exam.case.holding("diameter", diameter.si))
    exam.rows = max(exam, by_diameter, key=Examination.agreement).rows
    exam.intended = exam.intended.with_input("radius", diameter.si / 2)
    named = title("radius") if place == cells[0] else "this diameter"
    relation = f"is {times_too(power)} for" if power else "does not follow from"
    text = f"{named} {relation} {title('diameter')} in {address(cells[-1])}"
    kind, change = "unit" if power else "odd formula", _changed("radius", radius.si, 1.0)
    exam.add(kind, [place], scaled(diameter.si, 1 / factor), text, change=change)


def _judge_resistance(exam: Examination, beta: Input, flow_stress: Input, stated: float) -> None:
    """Report a target resistance that is typed into the rows, or unlike beta times flow stress."""
    used = exam.inputs["resistance"]
    typing = _cells_with_typed(exam, used.si)
    if math.isclose(used.si, stated, rel_tol=1e-6):
        if used.how in ("formulas", "report") and typing and beta.place:
            _report_typed(exam, "resistance", typing, beta)
    elif used.how in ("rows", "formulas", "report"):
        cells = typing or exam.cells(*exam.rows.shows("brake", 1))
        taken, times = quantity(used.si, "resistance"), f"{used.si / flow_stress.si:.6g}"
        text = f"the rows take {taken} for the target resistance, {times} times the flow stress; "
        text += f"beta is {beta.si:g} in {_where(beta, cells[0])}"
        change = _changed("resistance", used.si, 1.0)
        exam.intended = exam.intended.with_input("resistance", stated)
        formula = exam.calculation.book[cells[0]].formula
        exam.add("typed constant", cells, None, text, formula, change)


def _cells_with_typed(exam: Examination, value: float) -> list[Position]:
    """Return the cells of the first column that has a number typed into most of its formulas.

    The number may be typed in another unit if it has more than one digit: 0.5 need not be a 5.
    """
    has_digits = digits_of(value)[0] > 1

    def is_typed(number: float) -> bool:
        return near(number, value) or (has_digits and power_of_ten(number / value) is not None)

    for line in exam.table.every_line:
        cells = [formula.place for formula in line.formulas if any(map(is_typed, formula.typed))]
        if len(cells) > 0.5 * len(line.formulas):
            return cells
    return []


def _report_typed(exam: Examination, role: str, cells: Sequence[Position], source: Input) -> None:
    """Report an input's value typed into formulas, so that a change of its own cell is lost."""
    column, _ = exam.table.places.get(cells[0], ("", 0))
    column = title(column) if column else "the column of " * (len(cells) > 1) + address(cells[0])
    where = _where(source, cells[0])
    text = f"{title(role)} is typed into {column}: a change of {where} is lost"
    expected = where if source.place else source.label
    exam.add("typed constant", cells, expected, text, exam.calculation.book[cells[0]].formula)


def _where(source: Input, beside: Position) -> str:
    """Return the address of an input, with its sheet if that is another one, or else its name."""
    if source.place is None:
        return f"the name {source.label}"
    return address(source.place, source.place[0] != beside[0])


def _repeated(exam: Examination, role: str, value: float, reason: str) -> None:
    """Report a table that repeats another one because it reads an input of that one."""
    part, taken = "advance" if role == "step" else "brake", getattr(exam.case, role)
    cells = [exam.start] if role == "velocity" else exam.cells(*exam.rows.shows(part, 1))
    text = f"the rows take {quantity(taken, role)} for {title(role)}, "
    text += f"and so repeat another table; {reason}"
    exam.intended = exam.intended.with_input(role, value)
    formula = exam.calculation.book[cells[0]].formula
    exam.add("odd formula", cells, None, text, formula, _changed(role, taken, 1.0))


def _judge_derived(exam: Examination, cell: Input, wanted: float, sources: Sequence[Input]) -> None:
    """Compare a cell for mass, diameter or resistance with the value that its sources give [SI]."""
    role, place = cell.role, cell.place
    assert place is not None
    number = exam.calculation.number(place) or 0.0
    by_value = power_of_ten(wanted / number) if number and cell.unit is None else None
    factor = cell.factor if by_value is None else Fraction(10) ** by_value
    in_si = scaled(number, factor)
    power = power_of_ten(in_si / wanted)
    if power and cell.unit and exam.agreement(BRAKES) >= 0.5:  # the formulas take it rightly
        _mislabelled(exam, cell, power)
        return
    is_exact = math.isclose(in_si, wanted, rel_tol=NEAR)
    fault = _fault_of_derived(exam, cell, in_si, wanted, sources)
    if fault:
        change = None if is_exact else partial(Case.holding, role=role, value=in_si)
        expected = None if is_exact else scaled(wanted, 1 / factor)
        exam.add(fault[0], [place], expected, f"{title(role)} {fault[1]}", change=change)
    if in_si > 0 and (not is_exact or (role == "mass" and factor == 1)):
        exam.rows = replace(exam.rows, case=exam.case.holding(role, in_si))
        exam.intended = exam.intended.holding(role, wanted if fault and not is_exact else in_si)


def _fault_of_derived(
    exam: Examination, cell: Input, in_si: float, wanted: float, sources: Sequence[Input]
) -> tuple[str, str] | None:
    """Return kind and explanation of what is wrong with a derived value; None if it is right."""
    role, place = cell.role, cell.place
    assert place is not None
    if fault := _typed_factor(exam, cell, in_si, wanted, sources):
        return fault
    is_right = math.isclose(in_si, wanted, rel_tol=NEAR)
    names, power = titles(source.role for source in sources), power_of_ten(in_si / wanted)
    if place not in exam.calculation.formulas:
        is_whole = len(sources) == len(RESTS_ON[role])  # one factor of two gives nothing
        is_unread = any(source in exam.unread for source in sources)
        if not exam.read or not is_whole or (is_right and not is_unread):
            return None
        if power:
            return "unit", f"is {times_too(power)} for {names}"
        lost = "a change there changes nothing"
        return "typed constant", f"is typed as a number, though it rests on {names}: {lost}"
    if power:
        return "unit", f"is {times_too(power)} for {names}: a unit is not converted"
    if is_right:
        return None
    # Pi, and the factors of units such as ksi.
    constants = {"pi": math.pi, **{f"a {s.unit}": float(s.factor) for s in sources if s.unit}}
    for name, constant in constants.items():
        for number in _rounded(exam, place, constant):
            if math.isclose(in_si / number * constant, wanted, rel_tol=NEAR):
                return "typed constant", f"takes {number:.10g} for {name}, not {constant:.10g}"
    text = f"does not follow from {names}" if in_si else "is 0; the report's is assumed"
    return "odd formula", text


def _typed_factor(
    exam: Examination, cell: Input, in_si: float, wanted: float, sources: Sequence[Input]
) -> tuple[str, str] | None:
    """Return the fault of a resistance with a number typed for an input that nothing reads."""
    assert cell.place is not None
    formula = exam.calculation.formulas.get(cell.place)
    if formula is None or cell.role != "resistance":
        return None
    for source in sources:
        typed = source.si * in_si / wanted
        if source in exam.unread and any(near(number, typed) for number in formula.typed):
            where = f"{source.si:.6g} in {_where(source, cell.place)}"
            text = f"takes {typed:.6g} for {title(source.role)}, which is {where}"
            return "typed constant", f"{text}: a change there is lost"
    return None


def _rounded(exam: Examination, place: Position, constant: float) -> Iterator[float]:
    """Yield the numbers in a cell's formula that are a constant rounded to three digits or more.

    They may stand in cells that the formula reads, and include a power of ten that converts a unit.
    """
    cells = [area.corner for area in exam.calculation.areas(place) if area.cells == 1]
    formulas = filter(None, map(exam.calculation.formulas.get, (place, *cells)))
    typed = (number for formula in formulas for number in formula.literals)
    numbers = filter(None, [*typed, *map(exam.calculation.number, cells)])
    for number in (number for number in numbers if number > 0):
        power = round(math.log10(number / constant))
        value = scaled(number, Fraction(10) ** -power)
        digits, _ = digits_of(value)
        if digits >= 3 and value == float(f"{constant:.{digits - 1}e}"):
            yield value


def _other_inputs(exam: Examination) -> None:
    """Report inputs unlike the report's; a lone one off by a power of ten has a wrong unit."""
    report, density = report_inputs(), exam.inputs["particle_density"]
    unread = {entry.role for entry in exam.unread}  # which `_taken_otherwise` judges
    lone_mass = density.how == "follows" and not near(density.si, report["particle_density"][0])
    off = {
        role: entry
        for role, entry in exam.inputs.items()
        if role in report and entry.how not in ("report", "assumed", "follows")
        if getattr(exam.intended, role, entry.si) == entry.si
        if role != "mass" or lone_mass
        if entry.place or role not in unread
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
            exam.intended = exam.intended.with_input(role, nearest, nearest / entry.si)
        typed = _cells_with_typed(exam, entry.si) if entry.how == "formulas" else []
        place = entry.place or next(iter(typed), exam.table.place("depth", 1))
        solved = entry.si if entry.place is None else None
        exam.add(kind, [place], scaled(nearest, 1 / entry.factor), text, solved, change)


def _taken_otherwise(exam: Examination) -> None:
    """Report inputs whose cells the rows do not read, and for which they take another value."""
    for entry in exam.unread:
        used = exam.inputs.get(entry.role)
        if used is None or used.place or used.how in ("follows", "name"):
            continue  # the rows read another cell, or cells from which it follows
        if entry.role == "resistance" and any(e.role == "beta" for e in exam.unread):
            continue  # beta is reported instead
        if entry.role == "target_density" and exam.rows.rules["brake"] != REPORT["brake"]:
            continue  # such a rule may have no density
        differs = not math.isclose(used.si, entry.si, rel_tol=1e-6)
        if min(used.si, entry.si) <= 0 or not differs:
            continue
        cells = [exam.start] if entry.role == "velocity" else _cells_with_typed(exam, used.si)
        cells = cells or [entry.place or exam.table.place("depth", 1)]
        stated, taken = (quantity(value, entry.role) for value in (entry.si, used.si))
        text = f"{title(entry.role)} is {stated} in {_where(entry, cells[0])}, "
        text += f"but the rows take {taken}"
        change = _changed(entry.role, used.si, used.si / entry.si)
        formula = exam.calculation.book[cells[0]].formula
        exam.add("typed constant", cells, None, text, formula, change)
        exam.intended = exam.intended.with_input(entry.role, entry.si, entry.si / used.si)


def _typed_inputs(exam: Examination) -> None:
    """Report inputs whose value is typed into formulas that do not read their cell."""
    accused, reported = exam.accused, set[tuple[str, Position]]()
    columns = [(role, exam.cells(role, 0)) for role in exam.table.lines]
    columns += [("", line.cells) for line in exam.table.helpers]
    columns += [("", [r.place]) for r in exam.table.results if exam.table.gives_depth(r.place)]
    for entry, (role, places) in product((*exam.inputs.values(), *exam.unread), columns):
        if entry.place is None and entry.how != "name":
            continue
        cells = [place for k, place in enumerate(places)
                 if place not in accused and _typed_in(exam, entry, role, k, place)]  # fmt: skip
        # A number in only a few of many formulas is their own, such as the number of the row.
        is_usual = len(cells) >= 0.5 * len(places) or set(cells) & set(places[:2])
        # Two cells may be labelled as the same input.
        if is_usual and (entry.role, cells[0]) not in reported:
            reported.add((entry.role, cells[0]))
            _report_typed(exam, entry.role, cells, entry)


def _typed_in(exam: Examination, entry: Input, role: str, k: int, place: Position) -> bool:
    """Whether a cell has an input's value as a number, and does not read the input's cell."""
    formula, value = exam.calculation.formulas.get(place), scaled(entry.si, 1 / entry.factor)
    if role and k == 0 and 0 not in exam.rows.columns[role]:
        return False  # a head above the first row
    if formula is None:
        # The impact velocity is typed into the first row, while nothing reads its own cell.
        is_first = entry.role == "velocity" and role.startswith("velocity") and k <= 1
        number = exam.rows.columns[role].get(k) if is_first else None
        return entry in exam.unread and number is not None and near(number, entry.si)
    if not formula.typed or entry.role == "beta" or entry.label.upper() in formula.names:
        return False
    if entry.role == "stop_velocity":
        pairs = pairwise(piece.text for piece in formula.pieces)
        typed = any(sign in ("<", "<=", ">", ">=") and to == f"{value:g}" for sign, to in pairs)
    else:
        values = {wanted for wanted in (entry.si, value) if not _is_ordinary(wanted)}
        if entry.role == "step":
            halves, is_first = {entry.si / 2, value / 2}, (role, k) == ("depth", 1)
            # The first row takes half a step, even of 1e-10 s, which is no factor between units.
            odd = {h for h in halves if not between_units(power_of_ten(h) or 0, "step", True)}
            values |= {h for h in halves if not _is_ordinary(h) or (is_first and h in odd)}
        typed = any(near(*pair) for pair in product(values, formula.typed))
    read = (exam.calculation.source(area.corner) for area in formula.areas if area.cells == 1)
    return typed and all(cell != entry.place for cell in read)


def _is_ordinary(value: float) -> bool:
    """Whether a number is common in formulas: small whole ones, halves and powers of ten."""
    is_whole = float(value).is_integer() and abs(value) <= 10
    return is_whole or value in (0.5, 1.5, 12.0) or power_of_ten(abs(value)) is not None


def _typed_numbers(exam: Examination) -> None:
    """Report typed numbers where others are computed: whole columns, first cells, and texts."""
    formulas, roles = exam.calculation.formulas, [r for r in ORDER if r in exam.table.lines]
    cells = {role: exam.cells(role, 1) for role in roles}
    typed = [role for role in roles if not formulas.keys() & set(cells[role][1:])]
    for role in typed if len(typed) < len(roles) else ():
        if not exam.accused.intersection(cells[role]):
            lost = "a change of an input changes nothing there"
            text = f"{title(role)} is typed in every row: {lost}"
            exam.add("typed number", cells[role], None, text)
    rests_on = {"velocity_initial": ["velocity"], "depth": ["velocity", "step"]}
    for role, names in rests_on.items():
        if role not in roles:
            continue
        place, sources = cells[role][0], [exam.inputs[name] for name in names]
        have_cells = all(s.place and s.place not in exam.table.places for s in sources)
        is_typed = place not in formulas and exam.table.place(role, 2) in formulas
        if have_cells and is_typed and place not in exam.accused and exam.calculation.number(place):
            lost = " or ".join(_where(source, place) for source in sources)
            text = f"it is typed as a number: a change of {lost} is lost here"
            exam.add("typed number", [place], None, text)
    texts = exam.calculation.texts
    for place in sorted((texts.keys() & (exam.read | exam.table.places.keys())) - exam.accused):
        text = "it is a text, not a number: not every program calculates with it"
        exam.add("typed number", [place], float(texts[place]), text, repr(texts[place]))


def _blank_inputs(exam: Examination) -> None:
    """Report blank cells that a label calls an input, if the rows take them for 0."""
    values, blanks, case = exam.calculation.values, dict[Position, str](), exam.case
    for sheet, row, column in sorted(exam.read - values.keys()):
        label = values.get((sheet, row, column - 1))
        if not isinstance(label, str):
            continue
        named = input_roles(label, None) or exam.inputs.keys()  # a label in any language
        known = (exam.inputs[role] for role in named & exam.inputs.keys())
        roles = [entry.role for entry in known if entry.place is None and entry.how != "follows"]
        if len(roles) == 1:
            blanks[sheet, row, column] = roles[0]
            case = case.with_input(roles[0], 0.0, 0.0)
    taken = exam.following(case)
    if taken.agreement() > exam.agreement():
        exam.rows = taken.rows
        for place, role in blanks.items():
            text = f"{title(role)} is blank, which the formulas take for 0"
            exam.add("odd formula", [place], None, text, change=_changed(role, 0.0, 0.0))


# ---- the scheme that the table follows, found from the rule that most of its rows follow


def _scheme(exam: Examination) -> None:
    """Find the rule that most rows follow for each part; report those that are not the report's."""
    chosen = {"start": REPORT["start"]}
    if exam.follows("start", REPORT["start"], 1) is False:  # None if there is no velocity
        starts = (rule for rule in KNOWN["start"] if exam.follows("start", rule, 1))
        chosen["start"] = next(starts, REPORT["start"])
    unknown, columns = [], exam.table.every_line
    for part in ("advance", "brake", "end"):
        if part == "end" and "deceleration" not in exam.table.lines:
            continue  # the velocity tells the brake
        published, *others = KNOWN[part]
        shares = {published: exam.share(part, published)}
        if shares[published] < 0.9:
            shares |= {rule: exam.share(part, rule) for rule in others}
        best = max(shares, key=lambda rule: shares[rule])
        # If the formulas of some rows are right, the wrong ones are found one by one.
        beside = wrong_beside(exam) if part == "brake" and best != BEYOND else None
        line = beside.line if beside else exam.line(part)
        is_mixed = _MIXED <= shares[published] < shares[best] and any(irregular(line, exam.table))
        # A fault reported before may explain why the rows do not follow.
        place = exam.table.place(*exam.rows.shows(part, 3))
        read = {place, *exam.calculation.corners(place)} & exam.accused
        is_explained = any(column.covers(cell) for cell in read for column in columns)
        if is_mixed or (is_explained and (best != published or shares[best] < 0.5)):
            continue
        if shares[best] < 0.5:
            unknown.append(part)
        else:
            chosen[part] = best
    deepest = max(march(exam.intended)["depth"].values())
    if "brake" in chosen and deepest < exam.intended.radius:
        # The area beyond the radius is irrelevant to a sheet whose particle does not get there.
        rules = (BRAKES[0], chosen["brake"], BEYOND)
        flat, brake, deeper = (exam.share("brake", rule) for rule in rules)
        if deeper > flat and deeper >= brake:
            chosen["brake"] = replace(BEYOND, says="")
    exam.rows = replace(exam.rows, rules=REPORT | chosen)
    _accuse(exam, unknown)


def _accuse(exam: Examination, unknown: Sequence[str] = ()) -> None:
    """Report each part of the scheme that follows another rule, or an `unknown` one."""
    for part in (*unknown, *exam.rows.others):
        filled, first = PARTS[part]
        judged = range(first, exam.table.steps)
        first = next((k for k in judged if not exam.follows(part, REPORT[part], k)), first)
        role, row = exam.rows.shows(part, first)
        cells, expected = exam.cells(role, row), None
        if role == filled:
            wanted = replace(exam.rows, rules=REPORT).wanted(role, row)
            expected = exam.shown(role, wanted)
        beside = wrong_beside(exam) if part == "brake" else None
        if part in unknown:
            kind, text, column = _cause(exam, part, beside)
            if not column.covers(cells[0]):  # a column beside the table, which this one reads
                rows, expected = range(first, exam.table.steps + 1), None
                cells = [*(column.place(exam.table.zero + k) for k in rows), *cells]
            exam.add(kind, cells, expected, text)
            continue
        rule = exam.rows.rules[part]
        cells = cells[:1] if part == "start" else cells
        if beside:
            cells, expected = [*beside.cells.values()], None
        text = f"{rule.name}: {rule.says}"
        exam.add("other scheme", cells, expected, text, change={part: rule})


def _cause(exam: Examination, part: str, beside: Beside | None) -> tuple[str, str, Line]:
    """Return kind and explanation for a column that follows no known rule, and where to look.

    The step or the force may be off by a constant factor in every row. `beside` is the column
    beside the table that makes decelerations wrong, if there is one.
    """
    column = beside.line if beside else exam.line(part)
    rows = range(PARTS[part][1], exam.table.steps + 1)
    ratios = [ratio for k in rows if (ratio := _ratio(exam, part, k)) is not None]
    ratio = median(ratios) if ratios else 0.0
    if not ratio or sum(near(value, ratio) for value in ratios) < 0.5 * len(ratios):
        for slip in (3, -3, 6, -6) if part == "brake" else ():
            if exam.share(part, depth_times_ten(slip)) >= 0.9:
                text = f"the contact area takes a depth {times_too(slip)}"
                return "unit", f"{text}: a unit is converted wrongly", column
        text = "these cells follow no scheme that this program knows"
        return "other scheme", beside.says if beside else text, column
    name, slips, constants = "step", dict[str, float](), {"the time step": exam.case.step}
    if part == "brake":
        name, constants = "force", {"pi": math.pi, "the mass": exam.case.mass}
        slips = {"pi is missing in the force": 1 / math.pi,
                 "the force is not divided by the mass": exam.case.mass}  # fmt: skip
    if power := power_of_ten(ratio):
        return "unit", f"every {name} is {times_too(power)}: a unit is not converted", column
    slips[f"every {name} has the other sign"] = -1.0
    if named := next((text for text, value in slips.items() if near(ratio, value)), ""):
        return "other scheme", named, column
    for line, (constant, value) in product((column, *exam.table.helpers), constants.items()):
        numbers = {abs(x) for formula in line.formulas for x in formula.literals}
        for number in sorted(numbers - {0.0}):
            # A smaller mass makes the deceleration larger.
            if near(value / number if constant == "the mass" else number / value, ratio):
                return "typed constant", f"{constant} is typed as {number:.10g}", line
    fraction = Fraction(ratio).limit_denominator(8)
    named = f"{fraction}" if near(fraction, ratio) else f"{ratio:.6g}"
    named = f"{ratio:.10g}" if named == "1" else named
    return "other scheme", f"every {name} is {named} times that of the report's scheme", column


def _ratio(exam: Examination, part: str, k: int) -> float | None:
    """Return what row k adds to the row before, over what it would add by the report's rule."""
    rows = replace(exam.rows, rules=REPORT)
    role, row = rows.shows(part, k)
    starts = {"deceleration": 0.0, "depth": rows("depth", k - 1)}
    start = starts.get(role, rows("velocity_initial", k))
    actual, wanted = rows(role, row), rows.wanted(role, row)
    if start is None or actual is None or wanted is None or wanted == start:
        return None
    ratio = (actual - start) / (wanted - start)
    return ratio if math.isfinite(ratio) else None


def _as_rounded(exam: Examination) -> None:
    """Judge a table of typed, rounded numbers by whole runs of the scheme that fits it best."""
    # The report's own table may stand beside a sheet with other inputs.
    report = {role: values[0] for role, values in report_inputs().items()}
    names = [field.name for field in fields(Case) if field.name in report]
    printed = Case(**{name: report[name] for name in names})
    if not any(_misprints(exam, march(printed, steps=exam.table.steps))):
        exam.intended, exam.rows = printed, replace(exam.rows, case=printed)

        def is_printed(role: str, value: float) -> bool:
            return near(value, report[role]) or near(value, getattr(printed, role, 0.0))

        exam.inputs = {role: e for role, e in exam.inputs.items() if is_printed(role, e.si)}
        exam.derived = {role: e for role, e in exam.derived.items() if is_printed(role, e.si)}
    parts = ("brake", "start", "advance", "end")
    tried = []
    for rules in (REPORT, *(REPORT | {part: rule} for part in parts for rule in KNOWN[part][1:])):
        run = march(exam.case, rules, steps=exam.table.steps)
        if exam.table.steps in run["depth"]:  # some rules give no rows with this brake
            tried.append((list(_misprints(exam, run)), rules))
    misprints, rules = min(tried, key=lambda entry: len(entry[0]))
    exam.rows = replace(exam.rows, rules=rules)
    _accuse(exam)
    for role, k, expected in misprints:
        text = f"{title(role)} of row {k} is not what the scheme gives"
        exam.add("typed number", [exam.table.place(role, k)], expected, text)


def _misprints(
    exam: Examination, run: Mapping[str, Mapping[int, float]]
) -> Iterator[tuple[str, int, float | None]]:
    """Yield the numbers that a run does not round to: role, row, and the right one if finite."""
    for role in set(run) & set(exam.table.lines):
        for k, right in run[role].items():
            value, wanted = exam.table.number(role, k), exam.shown(role, right)
            if value is None or wanted is None or (k == 0 and role == "velocity_final"):
                continue
            digits, least = exam.table.roundings[role]
            expected, place = None, least
            if wanted and math.isfinite(wanted):
                digits = min(digits, ROUNDED)  # the last ones depend on the order of operations
                place = max(math.floor(math.log10(abs(wanted))) + 1 - digits, least)
                expected = float(round(Fraction(wanted), -place))
            if not abs(value - wanted) <= 10.0**place * (0.5 + 1e-9):
                yield role, k, expected


# ---- the stop, and what the differences do to the final depth


def _end_of_rows(exam: Examination) -> None:
    """Report rows that do not end with the first final velocity below the stop velocity."""
    steps, rows, case = exam.table.steps, exam.rows, exam.case
    finals = {k: v for k in range(1, steps + 1) if (v := rows("velocity_final", k)) is not None}
    if steps not in finals and (last := rows.wanted("velocity_final", steps)) is not None:
        finals[steps] = last  # the table ends before it shows this one
    below = next((k for k, v in finals.items() if v < case.stop_velocity), None)
    planned = max(march(exam.intended)["depth"])
    if not finals or steps in (below, planned):
        return  # with the right number of rows, a wrong stop follows from another fault
    role = "velocity_final" if "velocity_final" in exam.table.lines else "velocity_initial"
    end, stop = f"{finals[max(finals)]:.4g} m/s", f"the stop at {case.stop_velocity:g} m/s"
    if below is not None:
        if _end_as_shown(exam, below, planned):
            return
        text = f"other stop: the rows end at {end}, after {stop}"
        exam.add("other scheme", exam.cells(role, below + 1), None, text, change=OTHER_STOP)
        return
    run = march(case, rows.rules)["velocity_final"]
    whole = max(run, default=0)
    if whole <= steps or (run[whole] >= case.stop_velocity and whole < MOST_ROWS):
        return  # the rules that the rows follow do not lead to the stop by themselves
    of = f"{whole:,}" if whole < MOST_ROWS else f"more than {MOST_ROWS:,}"
    text = f"the rows end at {end}, before {stop}: {steps} of {of} steps"
    # With other inputs, or the report's other beta, the rows prepared for the former inputs run
    # out. An excerpt has few rows, none of which is called the final depth. But rows that end
    # shortly before the report's stop were ended at another velocity.
    is_changed = any(d.kind == "other input" or callable(d.change) for d in exam.differences)
    cases = [replace(case, resistance=value) for value in report_inputs()["resistance"]]
    is_prepared = any(max(march(case, rows.rules)["depth"]) == steps for case in cases)
    place = exam.table.place(role, steps)
    results = (result.place for result in exam.table.results if result.kind == "depth")
    read = {cell for result in results for cell in exam.calculation.corners(result)}
    is_excerpt = 2 * steps < whole and not read & exam.table.places.keys()
    if is_changed or is_prepared or is_excerpt:
        exam.add("not calculated", [place], None, text)
    else:
        exam.add("other scheme", [place], None, f"other stop: {text}", change=OTHER_STOP)


def _end_as_shown(exam: Examination, below: int, planned: int) -> bool:
    """Whether a result shows the row of the stop or the one before; if so, drop the later rows.

    Such a sheet has more rows than needed and looks up the final depth where the particle stops.
    """
    number, results = exam.calculation.number, exam.table.results
    shown = [(r.kind, x) for r in results if r.where == "first" and (x := number(r.place))]
    for k in (below, planned, below - 1):
        if any(exam.power_shown(kind, value, k) is not None for kind, value in shown):
            last = planned if k == planned else below
            kept = {
                role: {n: value for n, value in column.items() if n <= last}
                for role, column in exam.rows.columns.items()
            }
            exam.table = replace(exam.table, steps=last)
            exam.rows = replace(exam.rows, columns=kept)
            return True
    return False


def stops_elsewhere(exam: Examination) -> bool:
    """Whether a stop in another row is among the differences."""
    return any(difference.change == OTHER_STOP for difference in exam.differences)


def _effects(exam: Examination) -> None:
    """Compute the right final depth, and the one that each difference alone would give."""
    run = march(exam.intended)
    steps = max(run["depth"])
    if run["velocity_final"].get(steps, math.inf) < exam.intended.stop_velocity:
        exam.right_depth = run["depth"][steps]
    for role, column in exam.rows.columns.items():
        for k, value in column.items() if role in run else ():
            right = run[role].get(k)
            exam.differing += k > steps if right is None else abs(value - right) > 1e-9 * abs(right)
    if not stops_elsewhere(exam):
        steps = exam.table.steps
    if exam.ends:  # an excerpt has no final depth
        exam.differences = [replace(d, effect=_effect(exam, d, steps)) for d in exam.differences]
    exam.differences.sort(key=lambda d: d.rank)


def _effect(exam: Examination, difference: Difference, steps: int) -> float | None:
    """Return the final depth [m] that a difference alone would give after so many steps."""
    change, fixed, case = difference.change, {}, exam.intended
    brake, formulas = exam.rows.rules["brake"], exam.calculation.formulas
    rules = REPORT if brake.says else REPORT | {"brake": brake}
    if callable(change):
        case = change(case)
    elif change is not None:
        rules, steps = {**rules, **change}, exam.table.steps
    elif difference.kind in ("typed number", "odd formula", "typed constant", "other scheme"):
        for place in set(difference.cells) & exam.table.places.keys():
            role, k = exam.table.places[place]
            # Formulas take a blank cell for zero.
            is_blank = place not in exam.calculation.values and place not in formulas
            value = exam.rows.columns[role].get(k, 0.0 if is_blank else None)
            if value is not None:
                fixed[role, k] = value
        if not fixed and exam.rank(difference.place)[0] == 1:
            return None  # a text, an error or a cell beside the table gives no number to go on with
    else:
        return None
    return march(case, rules, fixed, steps=steps)["depth"].get(steps)

"""Units and inputs: what the workbook says of them, what its formulas make of them."""

import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial

from replication.check.cells import types
from replication.check.findings import Findings
from replication.check.inputs import NEAR, Input, agreement
from replication.check.lines import address
from replication.check.scheme import BRAKES, Case, holding, with_input
from replication.check.words import (
    power_of_ten,
    quantity,
    scaled,
    times_too,
    title,
    titles,
    unit_text,
)
from spreadsheets.foreign import Position


def units(f: Findings) -> None:
    """Units in heads that contradict the rest."""
    for role, slip in f.setting.slips.items():
        line, right = f.table.lines[role], unit_text(role, f.setting.powers[role])
        place = line.unit_place or f.table.place(role, 1)
        text = f"the head gives {title(role)} in {line.unit}, but the numbers are in {right}"
        f.add("unit", [place], right, f"{text}, a factor of 1e{abs(slip)}", line.unit)


def other_inputs(f: Findings) -> None:
    """Other inputs than the report's; a single one that is a power of ten off has a wrong unit."""
    stated = {
        role: own
        for role, own in f.setting.inputs.items()
        if role in f.report and role != "mass" and own.how not in ("report", "assumed", "follows")
    }
    off = {
        role: own
        for role, own in stated.items()
        if not any(math.isclose(own.si, value, rel_tol=1e-12) for value in f.report[role])
    }
    for role, own in off.items():
        nearest = min(f.report[role], key=lambda value: abs(value - own.si))
        text = f"{title(role)} is {quantity(own.si, role)}, in the report {quantity(nearest, role)}"
        if role == "radius" and math.isclose(own.si, 2 * nearest, rel_tol=1e-9):
            text += ", whose diameter this is"
        if role == "target_density":
            text += ", inferred, since the report prints none"
        if own.how == "rows":
            text += "; no cell holds it, it is solved back from the rows"
        place = own.place or f.table.place("depth", 1)
        power = power_of_ten(own.si / nearest) if len(off) == 1 else None
        kind = "unit" if power else "other input"
        text += f": a factor of 1e{abs(power)}" if power else ""
        found = own.si if own.place is None else None
        f.add(kind, [place], scaled(nearest, 1 / own.factor), text, found)
        if power:
            f.spoils[place] = partial(_scaled_input, role=role, value=own.si, by=own.si / nearest)
            f.intend(_scaled_input(f.intended, role, nearest, nearest / own.si))


def _scaled_input(case: Case, role: str, value: float, by: float) -> Case:
    """The case with an input of another `value`, which is the one that it has times `by`."""
    if role in ("beta", "flow_stress"):
        return with_input(case, "resistance", case.resistance * by)
    return with_input(case, role, value)


def calibrate(f: Findings) -> None:
    """An input that the rows take in another unit than its label says."""
    if agreement(f.setting, rules=BRAKES) >= 0.5:
        return
    powers = [sign * power for power in (3, 6, 9, 12, 1, 2) for sign in (-1, 1)]
    for role, own in f.setting.inputs.items():
        if own.place is not None and role not in ("beta", "stop_velocity", "mass"):
            for power in powers:
                if _shifted(f, own, power):
                    return


def _shifted(f: Findings, own: Input, power: int) -> bool:
    """Whether the rows agree with an input times a power of ten; if so, take it so."""
    factor = Fraction(10) ** power
    value = scaled(own.si, factor)
    change = partial(_scaled_input, role=own.role, value=value, by=float(factor))
    setting = f.setting.with_case(change(f.case))
    if agreement(setting) < 0.9:
        return False
    f.setting = setting
    assert own.place is not None
    f.spoils[own.place] = change
    text = (
        f"the formulas take {title(own.role)} as {quantity(value, own.role)}, not "
        f"{quantity(own.si, own.role)}: a factor of 1e{abs(power)} is missing"
    )
    right = scaled(own.si, 1 / factor / own.factor)
    f.add("unit", [own.place], right, text)
    return True


def derived(f: Findings) -> None:
    """Mass, diameter and resistance as the workbook has them, against what they rest on."""
    known = {own.role: own for own in (*f.setting.unread, *f.setting.inputs.values())}
    rows = replace(f.case, own_mass=None, own_diameter=None) if f.spoils else None
    resistance = f.intended.resistance
    if "beta" in known and "flow_stress" in known:
        resistance = known["beta"].si * known["flow_stress"].si
    for role, wanted, of in (
        ("diameter", 2 * f.intended.radius, ("radius",)),
        ("mass", f.intended.mass, ("radius", "particle_density")),
        ("resistance", resistance, ("beta", "flow_stress")),
    ):
        cell = f.setting.derived.get(role)
        sources = [known[name] for name in of if name in known]
        # With an input in a wrong unit the rows have what follows from it, which is no new fault.
        if cell is not None and rows and math.isclose(cell.si, getattr(rows, role), rel_tol=NEAR):
            continue
        if cell is not None and (any(s.place for s in sources) or cell.si == 0):
            _derived_cell(f, cell, wanted, sources)


def _derived_cell(f: Findings, cell: Input, wanted: float, sources: Sequence[Input]) -> None:
    role, place = cell.role, cell.place
    assert place is not None
    number = f.calculation.number(place) or 0.0
    power = power_of_ten(wanted / number) if number and cell.unit is None else None
    factor = cell.factor if power is None else Fraction(10) ** power
    held = scaled(number, factor)
    exact = math.isclose(held, wanted, rel_tol=NEAR)
    # Whoever converts ksi types its factor with some ten digits.
    typed = any(power_of_ten(float(source.factor)) is None for source in sources)
    right = exact or (typed and math.isclose(held, wanted, rel_tol=1e-8))
    rests = titles(source.role for source in sources)
    accused = len(f.differences)
    expected = scaled(wanted, 1 / factor)
    if place in f.calculation.formulas:
        if power := power_of_ten(held / wanted):
            text = f"{title(role)} is {times_too(power)} for {rests}: a unit is not converted"
            f.add("unit", [place], expected, text)
        elif not right:
            give = "gives" if len(sources) == 1 else "give"
            text = f"{title(role)} is not what {rests} {give}"
            if not held:
                text = f"{title(role)} is 0; the report's is assumed"
            f.add("odd formula", [place], expected, text)
    elif f.setting.read and (not right or any(s in f.setting.unread for s in sources)):
        text = f"{title(role)} is typed as a number, though it rests on {rests}: a change there changes nothing"  # noqa: E501
        f.add("typed constant", [place], expected, text)
    if exact and not (role == "mass" and factor == 1):
        return

    if len(f.differences) > accused and not exact:
        f.spoils[place] = partial(holding, role=role, value=held)
        f.intend(holding(f.intended, role, wanted))
    else:
        f.intend(holding(f.intended, role, held))
    f.setting = f.setting.with_case(holding(f.case, role, held))


def typed_inputs(f: Findings) -> None:
    """Inputs whose value stands in formulas that do not read their cell."""
    accused = f.accused
    typed = {role: f.literals(role) for role in f.table.lines}
    for own in (*f.setting.unread, *f.setting.inputs.values()):
        if own.place is None:
            continue
        for role in f.table.lines:
            if not typed[role] and own.role != "velocity":
                continue
            places = f.cells(role, 0)
            cells = [
                place
                for k, place in enumerate(places)
                if place not in accused and _typed_in(f, own, role, k, place)
            ]
            # A number in a few formulas of many is one of their own, such as the row's.
            if len(cells) >= 0.5 * len(places) or set(cells) & set(places[:2]):
                formula = f.calculation.book[cells[0]].formula
                where = address(own.place, with_sheet=own.place[0] != cells[0][0])
                text = f"{title(own.role)} is typed into {title(role)}; {where} holds it, and a change there changes nothing here"  # noqa: E501
                f.add("typed constant", cells, where, text, formula)


def _typed_in(f: Findings, own: Input, role: str, k: int, place: Position) -> bool:
    """Whether a cell has an input's value as a number, though a cell for it exists."""
    formula = f.calculation.formulas.get(place)
    if formula is not None:
        return types(formula, own, f.calculation)
    # The impact velocity typed into the first row, while its own cell is read by nothing.
    first = own.role == "velocity" and role.startswith("velocity") and k <= 1
    return first and own in f.setting.unread and f.calculation.number(place) is not None

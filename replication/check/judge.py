"""What is wrong with one table: each difference with its kind, place and cause.

Units and inputs first, then the scheme: a column in which most cells follow another rule than the
report's is one difference, named by that rule. Then every cell by itself (`cells`), and the stop.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import product
from statistics import median

from replication.check.cells import each_cell, order, types
from replication.check.examination import NEAR, Difference, Examination, Input
from replication.check.inputs import report_inputs
from replication.check.scheme import (
    BEYOND,
    BRAKES,
    KNOWN,
    MOST_ROWS,
    PARTS,
    REPORT,
    Case,
    Rule,
    march,
)  # fmt: skip
from replication.check.table import Line, address
from replication.check.words import (
    INPUTS,
    power_of_ten,
    quantity,
    scaled,
    times_too,
    title,
    titles,
    unit_text,
)  # fmt: skip
from spreadsheets.foreign import Position

OTHER_STOP: Mapping[str, Rule] = {}
"""The change that a stop elsewhere makes: the rules stay, the number of rows is another."""


def judge(f: Examination) -> None:
    """Find every difference between a table and the report's sheet, but for printed numbers."""
    _units(f)
    if f.digits is None:
        _calibrate(f)
        _derived(f)
    _other_inputs(f)
    if f.digits is None:
        _scheme(f)
        each_cell(f)
        _typed_inputs(f)
        order(f)
    else:
        _as_rounded(f, f.digits)
    _stop(f)
    _effects(f)


# ---- units and inputs: what the workbook says of them, what its formulas make of them


def _units(f: Examination) -> None:
    """Units in heads that contradict the rest."""
    for role, slip in f.slips.items():
        line, right = f.table.lines[role], unit_text(role, f.powers[role])
        place = line.unit_place or f.table.place(role, 1)
        text = f"the head gives {title(role)} in {line.unit}, but the numbers are in {right}"
        f.add("unit", [place], right, f"{text}, a factor of 1e{abs(slip)}", line.unit)


def _changed(role: str, value: float, by: float) -> Callable[[Case], Case]:
    """What makes of a case the one with another input."""
    return lambda case: case.with_input(role, value, by)


def _other_inputs(f: Examination) -> None:
    """Other inputs than the report's; a single one that is a power of ten off has a wrong unit."""
    report, density = report_inputs(), f.inputs["particle_density"]
    lone_mass = density.how == "follows" and not _near(density.si, report["particle_density"][0])
    off = {
        role: own
        for role, own in f.inputs.items()
        if role in report and own.how not in ("report", "assumed", "follows")
        if role != "mass" or lone_mass
        if not any(math.isclose(own.si, value, rel_tol=1e-12) for value in report[role])
    }
    for role, own in off.items():
        alike = [value for value in report[role] if power_of_ten(own.si / value) is not None]
        nearest = min(alike or report[role], key=lambda value: abs(value - own.si))
        text = f"{title(role)} is {quantity(own.si, role)}, in the report {quantity(nearest, role)}"
        if role == "target_density":
            text += ", inferred, since the report prints none"
        for name, values in report.items():
            if INPUTS[name] == INPUTS[role] and any(_near(own.si, value) for value in values):
                text += f"; {quantity(own.si, role)} is {title(name)} there"
        if own.how == "rows":
            text += "; no cell holds it, it is solved back from the rows"
        kind, change = "other input", None
        if len(off) == 1 and (power := power_of_ten(own.si / nearest)):
            kind, text = "unit", f"{text}: a factor of 1e{abs(power)}"
            change = _changed(role, own.si, own.si / nearest)
            f.intended = f.intended.with_input(role, nearest, nearest / own.si)
        place = own.place or f.table.place("depth", 1)
        solved = own.si if own.place is None else None
        f.add(kind, [place], scaled(nearest, 1 / own.factor), text, solved, change)


def _calibrate(f: Examination) -> None:
    """An input that the rows take in another unit than its label says."""
    if f.agreement(BRAKES) >= 0.5:
        return
    powers = [sign * power for power in (3, 6, 9, 12, 1, 2) for sign in (-1, 1)]
    for (role, own), power in product(f.inputs.items(), powers):
        if own.place is None or role in ("beta", "stop_velocity", "mass"):
            continue
        factor = Fraction(10) ** power
        value = scaled(own.si, factor)
        change = _changed(role, value, float(factor))
        changed = f.following(change(f.case))
        if changed.agreement() < 0.9:
            continue
        f.rows = changed.rows
        if own.unit and any(_near(value, number) for number in report_inputs()[role]):
            taken = replace(own, si=value, factor=own.factor * factor)
            f.inputs = {**f.inputs, role: taken}
            f.intended = change(f.intended)
            right = unit_text(role, power_of_ten(float(taken.factor)) or 0)
            text = f"the label gives {title(role)} in {own.unit}, but the number is in {right}"
            f.add("unit", [own.place], right, f"{text}, as the formulas take it", own.unit)
        else:
            expected = scaled(own.si, 1 / factor / own.factor)
            text = (
                f"the formulas take {title(role)} as {quantity(value, role)}, not "
                f"{quantity(own.si, role)}: a factor of 1e{abs(power)} is missing"
            )
            f.add("unit", [own.place], expected, text, change=change)
        return


def _derived(f: Examination) -> None:
    """Mass, diameter and resistance as the workbook has them, against what they rest on."""
    known = {own.role: own for own in (*f.unread, *f.inputs.values())}
    spoilt = any(difference.change for difference in f.differences)
    rows, intended = replace(f.case, own_mass=None, own_diameter=None), f.intended
    resistance = intended.resistance
    if "beta" in known and "flow_stress" in known:
        resistance = known["beta"].si * known["flow_stress"].si
    for role, wanted, of in (
        ("diameter", 2 * intended.radius, ("radius",)),
        ("mass", intended.mass, ("radius", "particle_density")),
        ("resistance", resistance, ("beta", "flow_stress")),
    ):
        cell = f.derived.get(role)
        sources = [known[name] for name in of if name in known]
        # With an input in a wrong unit the rows have what follows from it, which is no new fault.
        if cell and spoilt and math.isclose(cell.si, getattr(rows, role), rel_tol=NEAR):
            continue
        if cell and (any(s.place for s in sources) or cell.si == 0):
            _derived_cell(f, cell, wanted, sources)


def _derived_cell(f: Examination, cell: Input, wanted: float, sources: Sequence[Input]) -> None:
    role, place = cell.role, cell.place
    assert place is not None
    number = f.calculation.number(place) or 0.0
    power = power_of_ten(wanted / number) if number and cell.unit is None else None
    factor = cell.factor if power is None else Fraction(10) ** power
    in_si = scaled(number, factor)
    exact = math.isclose(in_si, wanted, rel_tol=NEAR)
    # Whoever converts ksi types its factor with some ten digits.
    typed = any(power_of_ten(float(source.factor)) is None for source in sources)
    right = exact or (typed and math.isclose(in_si, wanted, rel_tol=1e-8))
    rests, kind = titles(source.role for source in sources), ""
    if place in f.calculation.formulas:
        if power := power_of_ten(in_si / wanted):
            kind = "unit"
            text = f"is {times_too(power)} for {rests}: a unit is not converted"
        elif not right:
            kind = "odd formula"
            text = f"is not what {rests} {'gives' if len(sources) == 1 else 'give'}"
            if not in_si:
                text = "is 0; the report's is assumed"
    elif f.read and (not right or any(s in f.unread for s in sources)):
        kind = "typed constant"
        text = f"is typed as a number, though it rests on {rests}: a change there changes nothing"
    if kind:
        change = None if exact else _holding(role, in_si)
        expected = scaled(wanted, 1 / factor)
        f.add(kind, [place], expected, f"{title(role)} {text}", change=change)
    if not exact or (role == "mass" and factor == 1):
        f.rows = replace(f.rows, case=f.case.holding(role, in_si))
        f.intended = f.intended.holding(role, wanted if kind and not exact else in_si)


def _holding(role: str, value: float) -> Callable[[Case], Case]:
    """What makes of a case the one in which a cell holds another mass, diameter or resistance."""
    return lambda case: case.holding(role, value)


def _typed_inputs(f: Examination) -> None:
    """Inputs whose value stands in formulas that do not read their cell."""
    for own in f.unread:
        used = f.inputs.get(own.role)
        if used is None or used.place or own.place is None or min(used.si, own.si) <= 0:
            continue
        if not math.isclose(used.si, own.si, rel_tol=1e-6):
            here, there = (quantity(value, own.role) for value in (own.si, used.si))
            text = (
                f"{title(own.role)} here is {here}, but the rows take {there}: they do not read "
                "this cell"
            )
            change = _changed(own.role, used.si, used.si / own.si)
            f.add("typed constant", [own.place], None, text, change=change)
            f.intended = f.intended.with_input(own.role, own.si, own.si / used.si)
    accused = f.accused
    inputs = (own for own in (*f.unread, *f.inputs.values()) if own.place)
    for own, role in product(inputs, f.table.lines):
        places = f.cells(role, 0)
        cells = [
            place
            for k, place in enumerate(places)
            if place not in accused and _typed_in(f, own, role, k, place)
        ]
        # A number in a few formulas of many is one of their own, such as the row's.
        if own.place and (len(cells) >= 0.5 * len(places) or set(cells) & set(places[:2])):
            formula = f.calculation.book[cells[0]].formula
            where = address(own.place, with_sheet=own.place[0] != cells[0][0])
            text = (
                f"{title(own.role)} is typed into {title(role)}; {where} holds it, and a change "
                "there changes nothing here"
            )
            f.add("typed constant", cells, where, text, formula)


def _typed_in(f: Examination, own: Input, role: str, k: int, place: Position) -> bool:
    """Whether a cell has an input's value as a number, though a cell for it exists."""
    formula = f.calculation.formulas.get(place)
    if formula is not None:
        return types(formula, own, f.calculation)
    # The impact velocity typed into the first row, while its own cell is read by nothing.
    first = own.role == "velocity" and role.startswith("velocity") and k <= 1
    value = f.rows.columns[role].get(k)
    return first and own in f.unread and value is not None and _near(value, own.si)


# ---- which scheme the table follows, rule by rule, by what most of its rows do

_FACTORS = (
    (2.0, "2"), (0.5, "1/2"), (math.pi, "pi"), (1 / math.pi, "1/pi"), (4.0, "4"), (0.25, "1/4"),
    (8.0, "8"), (0.125, "1/8"), (4 / 3, "4/3"), (0.75, "3/4"), (3.0, "3"), (1 / 3, "1/3"),
)  # fmt: skip


def _scheme(f: Examination) -> None:
    """The rules that most rows follow, and a difference for each that is not the report's."""
    chosen = {"start": REPORT.start}
    if f.follows("start", REPORT.start, 1) is False:  # None if there is no velocity
        starts = (rule for rule in KNOWN["start"] if f.follows("start", rule, 1))
        chosen["start"] = next(starts, REPORT.start)
    unknown = []
    for part in ("advance", "brake", "end"):
        if part == "end" and "deceleration" not in f.table.lines:
            continue  # the brake is known by it
        own, *others = KNOWN[part]
        shares = {own: f.share(part, own)}
        if shares[own] < 0.9:
            shares |= {rule: f.share(part, rule) for rule in others}
        best = max(shares, key=lambda rule: shares[rule])
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
    f.rows = replace(f.rows, rules=replace(REPORT, **chosen))
    for part in unknown:
        first = PARTS[part][1]
        role, at = f.rows.shows(part, first)
        wanted = f.rows.wanted(role, at) if role == PARTS[part][0] else None
        kind, text, line = _cause(f, part, role)
        cells = f.cells(role, at)
        if line != f.table.lines[role]:  # a column beside it, which it reads
            rows, wanted = range(first, f.table.steps + 1), None
            cells = [*(line.place(f.table.zero + k) for k in rows), *cells]
        f.add(kind, cells, f.shown(role, wanted), text)
    _named(f)


def _named(f: Examination) -> None:
    """A difference for each rule that is not the report's."""
    rows = replace(f.rows, rules=REPORT)
    for part, rule in f.rules.others.items():
        own, (fills, first) = getattr(REPORT, part), PARTS[part]
        judged = range(first, f.table.steps)
        first = next((k for k in judged if not f.follows(part, own, k)), first)
        role, at = rows.shows(part, first)
        wanted = rows.wanted(role, at) if role == fills else None
        cells = f.cells(role, at, at if part == "start" else None)
        text = f"{rule.name}: {rule.says}"
        f.add("other scheme", cells, f.shown(role, wanted), text, change={part: rule})


def _cause(f: Examination, part: str, role: str) -> tuple[str, str, Line]:
    """What else explains a column that follows no rule known here: a constant factor, and where."""
    own = f.table.lines[role]
    pairs = [_increment(f, part, k) for k in range(PARTS[part][1], f.table.steps + 1)]
    ratios = [actual / wanted for actual, wanted in filter(None, pairs) if wanted]
    ratio = median(ratios) if ratios else 0.0
    if not ratio or sum(_near(each, ratio) for each in ratios) < 0.5 * len(ratios):
        return "other scheme", "these cells follow no scheme that this program knows", own
    what, base, constant = "step", f.case.step, "the time step"
    if part == "brake":
        what, base, constant = "force", math.pi, "pi"
    if power := power_of_ten(ratio):
        return "unit", f"every {what} is {times_too(power)}: a unit is not converted", own
    for line in (own, *f.table.helpers):
        if any(_near(number / base, ratio) for number in f.literals(line)):
            return "typed constant", f"{constant} is typed as {ratio * base:.10g}", line
    named = next((name for value, name in _FACTORS if _near(value, ratio)), f"{ratio:.6g}")
    return "other scheme", f"every {what} is {named} times that of the report's scheme", own


def _near(a: float, b: float) -> bool:
    return math.isclose(a, b, rel_tol=1e-9)


def _increment(f: Examination, part: str, k: int) -> tuple[float, float] | None:
    """What a row adds to the one before, and what it would add by the report's rule."""
    rows = replace(f.rows, rules=REPORT)
    role, at = rows.shows(part, k)
    before = {"deceleration": 0.0, "depth": rows("depth", k - 1)}
    start = before.get(role, rows("velocity_initial", k))
    actual, wanted = rows(role, at), rows.wanted(role, at)
    if start is None or actual is None or wanted is None:
        return None
    return actual - start, wanted - start


def _as_rounded(f: Examination, digits: int) -> None:
    """Judge typed and rounded numbers by whole runs, of the scheme that fits them best."""
    parts = ("brake", "start", "advance", "end")
    others = [replace(REPORT, **{part: rule}) for part in parts for rule in KNOWN[part][1:]]
    # Some rules need another brake to go with them: by themselves they give no rows.
    runs = {rules: march(f.case, rules, steps=f.table.steps) for rules in (REPORT, *others)}
    misprints = {
        rules: list(_misprints(f, run, digits))
        for rules, run in runs.items()
        if f.table.steps in run["depth"]
    }
    rules = min(misprints, key=lambda rules: len(misprints[rules]))
    f.rows = replace(f.rows, rules=rules)
    _named(f)
    for place, expected, text in misprints[rules]:
        f.add("typed number", [place], expected, text)


def _misprints(
    f: Examination, run: Mapping[str, Mapping[int, float]], digits: int
) -> Iterator[tuple[Position, float | None, str]]:
    """Numbers that do not round as a scheme's do, and what they should be if that is finite."""
    for role in set(run) & set(f.table.lines):
        for k, right in run[role].items():
            value, wanted = f.table.number(role, k), f.shown(role, right)
            if value is None or wanted is None or (k == 0 and role == "velocity_final"):
                continue
            expected = float(f"{wanted:.{digits}g}") if math.isfinite(wanted) else None
            last = 0.0
            if wanted and expected is not None:
                last = 10.0 ** (math.floor(math.log10(abs(wanted))) + 1 - digits)
            if not abs(value - wanted) <= last * (0.5 + 1e-9):
                text = f"{title(role)} of row {k} is not what the scheme gives"
                yield f.table.place(role, k), expected, text


# ---- the stop, and all of it together


def _stop(f: Examination) -> None:
    """Whether the rows end with the first velocity below the stop."""
    steps, rows, case = f.table.steps, f.rows, f.case
    stop, report = case.stop_velocity, report_inputs()["resistance"]
    finals = {k: v for k in range(1, steps + 1) if (v := rows("velocity_final", k)) is not None}
    if steps not in finals and (last := rows.wanted("velocity_final", steps)) is not None:
        finals[steps] = last  # computed where the table ends before it shows it
    below = next((k for k, v in finals.items() if v < stop), None)
    right = max(march(f.intended)["depth"])
    if not finals or below == steps or (below != steps and right == steps):
        return  # with as many rows as there should be, where they end follows from the rest
    last = finals[max(finals)]
    role = "velocity_final" if "velocity_final" in f.table.lines else "velocity_initial"
    if below is not None:
        cells = f.cells(role, below + 1)
        text = f"other stop: the rows go on after the velocity has fallen below {stop:g} m/s, to {last:.3g} m/s"  # noqa: E501
        f.add("other scheme", cells, None, text, change=OTHER_STOP)
        return
    run = march(case, f.rules)["velocity_final"]
    whole = max(run, default=0)
    if whole <= steps or (run[whole] >= stop and whole < MOST_ROWS):
        return  # the rules that the rows follow do not lead to the stop by themselves
    text = f"the rows end at {last:.4g} m/s, before the stop at {stop:g} m/s"
    of = f"{whole:,} steps" if whole < MOST_ROWS else f"more than {MOST_ROWS:,} steps"
    place = f.table.place(role, steps)
    # With other inputs, or the report's other beta, rows prepared for those before run out, and an
    # excerpt has few; but who leaves off shortly before the report does stops at another velocity.
    changed = any(difference.kind == "other input" for difference in f.differences)
    cases = [replace(case, resistance=resistance) for resistance in report]
    prepared = any(max(march(each, f.rules)["depth"]) == steps for each in cases)
    if changed or prepared or 2 * steps < whole:
        f.add("not calculated", [place], None, f"{text}: {steps} of {of}")
    else:
        f.add(
            "other scheme", [place], None, f"other stop: {text}, {steps} of {of}", change=OTHER_STOP
        )


def _effects(f: Examination) -> None:
    """What the final depth should be, and what each difference alone would make of it."""
    run = march(f.intended)
    steps = max(run["depth"])
    if run["velocity_final"].get(steps, math.inf) < f.intended.stop_velocity:
        f.right_depth = run["depth"][steps]
    for role, column in f.rows.columns.items():
        for k, own in column.items() if role in run else ():
            right = run[role].get(k)
            if right is None:
                f.differing += k > steps
            else:
                f.differing += abs(own - right) > 1e-9 * abs(right)
    if not any(d.change == OTHER_STOP for d in f.differences):
        steps = f.table.steps
    with_effects = (_with_effect(f, difference, steps) for difference in f.differences)
    f.differences = sorted(with_effects, key=lambda d: d.rank)


def _with_effect(f: Examination, difference: Difference, steps: int) -> Difference:
    """The difference with the final depth that it alone would give, after so many steps."""
    change, fixed = difference.change, {}
    rules, case = REPORT, f.intended
    if not f.rules.brake.says:
        rules = replace(rules, brake=f.rules.brake)
    if callable(change):
        case = change(case)
    elif change is not None:
        rules, steps = replace(rules, **change), f.table.steps
    elif difference.kind in ("typed number", "odd formula", "typed constant", "other scheme"):
        for place in set(difference.cells) & f.table.places.keys():
            role, k = f.table.places[place]
            # A formula takes a blank cell for zero.
            blank = place not in f.calculation.values and place not in f.calculation.formulas
            value = f.rows.columns[role].get(k, 0.0 if blank else None)
            if value is not None:
                fixed[role, k] = value
        if not fixed and f.rank(difference.place)[0] == 1:
            return difference  # a text, an error, or a cell beside the table: nothing to go on with
    else:
        return difference
    depths = march(case, rules, fixed, steps=steps)["depth"]
    return replace(difference, effect=depths.get(steps))

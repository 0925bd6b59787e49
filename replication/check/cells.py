"""Judge each cell of a table by the cells calculated before it and by the rest of its column.

So an error is found in the cell where it occurs, and the cells that follow from it are not accused.
"""

import math
import re
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from itertools import product
from typing import NamedTuple

from reference.units import same_dimension
from replication.check.examination import NEAR, Examination, near
from replication.check.scheme import BEYOND, FILLS, REPORT, Case, contact, orders
from replication.check.table import LEAST, Line, Table, address, is_spoiling, runs
from replication.check.words import power_of_ten, times_too, title, unit_power
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation, Formula

# ---- references that drift, and columns beside the table that the decelerations rest on


_BLOCK = 12
"""The most inputs that stand one below the other; more numbers are a column."""


def judge_references(exam: Examination) -> None:
    """Report references to a cell beside the table that move on from row to row for want of a $."""
    lines, number = exam.table.every_line, exam.calculation.number
    entries = (*exam.inputs.values(), *exam.derived.values(), *exam.unread)
    inputs = {entry.place for entry in entries}
    for line in lines:
        alike = [formula for formula in line.formulas if formula.shape == line.formulas[-1].shape]
        begin = line.formulas.index(alike[0]) if alike else 0
        before = line.formulas[begin - 1] if begin else None
        for pieces in zip(*(formula.pieces for formula in alike), strict=True):
            read = [piece.area.corner for piece in pieces if piece.area and piece.area.cells == 1]
            if len(read) > 1:  # a first row with another formula may read the right cell
                (sheet, *first), (_, *second) = read[:2]
                row, column = (2 * a - b for a, b in zip(first, second, strict=True))
                if before and before.reads((sheet, row, column)):
                    read.insert(0, (sheet, row, column))
            beside = [place for place in read if not any(column.covers(place) for column in lines)]
            moves = len(read) > 1 and read[0] != read[1] and read[:1] == beside[:1]
            # Such a reference soon meets a blank, a text or an input; others read a whole column.
            strays = None in map(number, beside[:_BLOCK]) or inputs & set(beside[1:])
            if moves and strays and number(read[0]) is not None:
                cells = [formula.place for formula in alike[1 - len(read) :]]
                right, wrong = (address(place, place[0] != line.sheet) for place in read[:2])
                text = f"the reference to {right} is not fixed by a $: this "
                text += f"{'column' if line.across else 'row'} reads {wrong}, and so on"
                exam.add("odd formula", cells, None, text, exam.calculation.book[cells[0]].formula)


class Beside(NamedTuple):
    """A column beside the table that may hold a quantity on which the decelerations rest.

    `implied` gives, by row, the unit in which the number is what the row's deceleration implies,
    `right` the unit in which it is the right value, and `cells` the cells in which these differ.
    `says` explains what is wrong with such a cell.
    """

    line: Line
    name: str
    says: str
    dimension: str
    implied: dict[int, float]
    right: dict[int, float]
    cells: dict[int, Position]


def _beside(exam: Examination) -> Iterator[Beside]:
    """Yield each column that may hold contact areas, pressures or forces."""
    if not exam.table.helpers or "deceleration" not in exam.rows.columns:
        return
    areas, pressures, forces = (dict[int, tuple[float, float]]() for _ in range(3))
    for k in range(1, exam.table.steps + 1):
        x, v, a = (exam.rows(role, k) for role in ("depth", "velocity_initial", "deceleration"))
        area = math.pi * contact(exam.case, x or 0.0)  # 0 at touch, and at depths such as 5E-324 m
        if area and v is not None and a is not None:
            force = a * exam.case.mass
            pressure = 0.5 * exam.case.target_density * v * v + exam.case.resistance
            areas[k], pressures[k] = (force / pressure, area), (force / area, pressure)
            forces[k] = force, pressure * area
    quantities = (
        ("area", "the depth", "m^2", areas),
        ("pressure", "the velocity", "Pa", pressures),
        ("force", "the depth and the velocity", "N", forces),
    )
    for (name, sources, dimension, values), line in product(quantities, exam.table.helpers):
        numbers = {k: number for k in values if (number := line.at(exam.table.zero + k))}
        if len(numbers) >= LEAST:
            implied, right = ({k: values[k][i] / x for k, x in numbers.items()} for i in (0, 1))
            cells = {k: line.place(exam.table.zero + k) for k in right if not near(*values[k])}
            says = f"this {name} does not follow from {sources} of its row"
            yield Beside(line, name, says, dimension, implied, right, cells)


def _power(units: dict[int, float]) -> int | None:
    """Return n if all units are 10^n, else None."""
    first, *others = units.values()
    return power_of_ten(first) if all(near(unit, first) for unit in others) else None


def judge_heads_beside(exam: Examination) -> None:
    """Report heads of contact areas, pressures and forces whose unit contradicts the numbers."""
    for column in _beside(exam):
        line, power = column.line, _power(column.right)
        if power is None or not line.unit or not same_dimension(line.unit, column.dimension):
            continue
        if slip := (unit_power(line.unit) or 0) - power:
            size = f"in which it is {times_too(slip)}"
            text = f"the head gives the {column.name} in {line.unit}, {size}"
            exam.add("unit", [line.unit_place or line.place(line.first)], None, text, line.unit)


def wrong_beside(exam: Examination) -> Beside | None:
    """Return the column of areas, pressures or forces because of which decelerations are wrong."""
    for column in _beside(exam):
        if column.cells and _power(column.implied) is not None and _power(column.right) is None:
            return column
    return None


# ---- each cell, by the cells before it and by its column


def judge_cells(exam: Examination) -> None:
    """Report every cell that does not follow from the cells before it or is unlike its column."""
    calculation = exam.calculation
    beside = wrong_beside(exam)
    odd = _unlike(exam, beside)
    areas = (area for place in exam.table.places for area in calculation.areas(place))
    read = {area.corner for area in areas if area.cells == 1}
    spoilt, accused = _spoilt(exam, odd.keys() - exam.table.places.keys()), exam.accused
    wrong: dict[Position, tuple[str, str, float | None]] = {}
    for place, (role, k) in exam.table.places.items():
        expected = exam.rows.wanted(role, k)
        sources = {*calculation.corners(place)} - {place}
        if place in odd:
            kind, text = odd.pop(place)
            if error := calculation.error(place):
                kind, text = "odd formula", f"{text}; it gives {error}"
            elif reason := calculation.uncomputed.get(place):
                kind, text = "odd formula", f"{text}; it is not computed here: {reason}"
        elif place in accused or sources & spoilt:
            continue
        elif _fails(exam, role, k, place in read):
            kind, text = _lone(exam, role, k)
            if beside and role == "deceleration" and k in beside.cells:
                place, expected, text = beside.cells[k], None, beside.says
            place, text = _converting(exam, place, text)
        else:
            continue
        value = exam.rows.columns[role].get(k)
        if value and expected and math.isclose(value, expected, rel_tol=1e-9):
            text += "; it gives the right value here"
        wrong[place] = kind, text, exam.shown(role, expected)
    wrong |= {place: (*why, None) for place, why in odd.items()}
    # Neighbours whose explanations differ only in numbers are one difference.
    number = r"\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
    causes = {place: (kind, re.sub(number, "#", text)) for place, (kind, text, _) in wrong.items()}
    for run in runs(causes, exam.table.across):
        kind, text, expected = wrong[run[0]]
        exam.add(kind, run, expected, text)


def _converting(exam: Examination, place: Position, text: str) -> tuple[Position, str]:
    """Return the cell to accuse for a wrong one, and the explanation.

    If a first velocity only shows what a formula beside the table makes of the impact velocity,
    it is that formula; else it is the cell itself, with its own explanation.
    """
    role, k = exam.table.places.get(place, ("", 0))
    if not role.startswith("velocity") or k > 1:
        return place, text
    calculation = exam.calculation
    chain = reversed(calculation.chain(place))
    cell = next((source for source in chain if source in calculation.formulas), place)
    sources = calculation.corners(cell)
    if cell in exam.table.places or exam.inputs["velocity"].place not in sources:
        return place, text
    return cell, f"{title('velocity')} does not follow from {address(sources[0])}"


def _spoilt(exam: Examination, wrong: set[Position]) -> set[Position]:
    """Return the cells whose readers are not to blame.

    They are the `wrong` cells beside the table, cells of the table that hold a text or a truth
    value, cells that are not computed, and cells beside the table that read any of these.
    """
    order, values = exam.calculation.order, exam.calculation.values
    spoilt = wrong | {p for p in exam.table.places if isinstance(values.get(p), str | bool)}
    spoilt |= exam.calculation.texts.keys() | exam.calculation.unknown
    cells = {place for line in exam.table.helpers for place in line.cells}
    for place in sorted(cells & order.keys(), key=order.__getitem__):
        if not spoilt.isdisjoint(exam.calculation.corners(place)):
            spoilt.add(place)
    return spoilt


_TYPE_NAMES = {str: "a text", bool: "a truth value"}


def irregular(line: Line, table: Table) -> Iterator[tuple[Position, tuple[str, str]]]:
    """Yield the cells of a line that are unlike most of it, with kind and explanation.

    Rows 0 and 1 start the scheme, so their formulas may differ from the others.
    """
    rows = [table.zero + k for k in range(2, table.steps + 1)]
    places = [line.place(at) for at in rows if line.follows(at)]
    calculation = line.calculation
    formulas = {p: calculation.formulas[p] for p in places if p in calculation.formulas}
    starts = formulas.keys() >= set(places[:3])  # formulas that go on in typed numbers
    if len(formulas) < max(3, 0.5 * len(places) * (not starts)):
        return
    # If no shape is usual, compare shapes without numbers: some people type the row's number.
    for masked in (False, True):
        shapes = {
            place: tuple(
                "#" if masked and piece.kind == "number" else shape
                for piece, shape in zip(formula.pieces, formula.shape, strict=True)
            )
            for place, formula in formulas.items()
        }
        counts = Counter(shapes.values())
        usual, frequency = counts.most_common(1)[0]
        if frequency >= 0.5 * len(formulas):
            break
    else:
        return
    patterns = {shape: formulas[place] for place, shape in reversed(shapes.items())}
    pattern = patterns[usual]
    for shape, number in counts.items():
        if number >= 0.1 * len(formulas) and _reads_for(patterns[shape], pattern, calculation):
            usual, pattern = shape, patterns[shape]
    for place in places:
        if place in formulas:
            if shapes[place] != usual:
                yield place, _odd(formulas[place], pattern, calculation)
        elif (typed := calculation.values.get(place)) is not None:
            kind = str if place in calculation.texts else type(typed)
            usual_formula = _filled(pattern, place, calculation)
            content = _TYPE_NAMES.get(kind, "a number")
            yield place, ("typed number", f"{content} is typed where {usual_formula} would stand")


def _reads_for(formula: Formula, typed: Formula, calculation: Calculation) -> bool:
    """Whether a formula is like another one but reads cells whose numbers that one has typed."""
    if len(formula.pieces) != len(typed.pieces):
        return False
    pairs = zip(formula.pieces, typed.pieces, strict=True)
    unlike = [(a, b) for a, b in pairs if (a.shape or a.text) != (b.shape or b.text)]
    return bool(unlike) and all(
        a.area and b.kind == "number" and calculation.number(a.area.corner) == float(b.text)
        for a, b in unlike
    )


def _odd(formula: Formula, pattern: Formula, calculation: Calculation) -> tuple[str, str]:
    """Return kind and explanation for a formula unlike the pattern of its column.

    It may have a number where the pattern reads a cell or has a name.
    """
    text = calculation.book[formula.place].formula
    usual = _filled(pattern, formula.place, calculation)
    typed = Counter(formula.typed) - Counter(pattern.typed)
    has_fewer_cells = len(formula.areas) < len(pattern.areas)
    if typed and (has_fewer_cells or pattern.names - formula.names):
        numbers = " and ".join(f"{number:g}" for number in typed)
        read = "reads a cell" if has_fewer_cells else "has a name"
        return "typed constant", f"{text} has {numbers} where its column {read}: {usual}"
    return "odd formula", f"{text} is unlike its column, where {usual} would stand"


def _filled(pattern: Formula, place: Position, calculation: Calculation) -> str:
    """Return the text of a formula as it would be if filled into another cell."""
    from openpyxl.formula.translate import Translator, TranslatorError

    text = calculation.book[pattern.place].formula or ""
    with suppress(TranslatorError):  # where it would reach beyond the sheet's edge
        text = str(Translator(text, address(pattern.place)).translate_formula(address(place)))
    return text


def _unlike(exam: Examination, beside: Beside | None) -> dict[Position, tuple[str, str]]:
    """Return the cells unlike their column, with kind and explanation.

    If other formulas of the column are wrong, an unlike one that is right is not accused.
    """
    odd = {p: why for line in exam.table.every_line for p, why in irregular(line, exam.table)}
    for role in {exam.table.places[place][0] for place in odd.keys() & exam.table.places.keys()}:
        fails = {
            place: _fails(exam, role, k)
            for k, place in enumerate(exam.cells(role, 1), 1)
            if place in exam.calculation.formulas and exam.rows.wanted(role, k) is not None
        }
        if any(fails[place] for place in fails.keys() - odd.keys()):
            odd = {place: why for place, why in odd.items() if fails.get(place, True)}
    if beside:
        right = set(beside.line.cells) - set(beside.cells.values())
        odd = {place: why for place, why in odd.items() if place not in right}
    return odd


def _fails(exam: Examination, role: str, k: int, is_read: bool = False) -> bool:
    """Whether a cell does not hold what it should; `is_read` if another cell of the table reads it.

    A blank cell may end a column, unless it is read.
    """
    column, place = exam.rows.columns[role], exam.table.place(role, k)
    value, expected = column.get(k), exam.rows.wanted(role, k)
    if value is None:
        if expected is not None and not math.isfinite(expected):
            return False  # the right formula gives an error, too
        needed = 0 < k < max(column, default=0) or (is_read and k > 0)
        return needed or _is_text(exam, place, k) or bool(exam.calculation.error(place))
    # A time may be computed from the row's number instead of the time before.
    numbered = role == "time" and math.isclose(value, k * exam.case.step, rel_tol=NEAR)
    if expected is None or numbered:
        return False
    size = abs(expected)
    if role.startswith("velocity"):
        size = max(size, abs(exam.rows("velocity_initial", max(k - 1, 0)) or 0.0))
    if abs(value - expected) <= NEAR * size or _rests(exam, role, value, expected):
        return False
    # A first row that is the report's may be unlike the others, which follow another rule.
    part = FILLS.get(role, "advance")
    return k != 1 or part == "advance" or not exam.follows(part, REPORT[part], 1)


def _rests(exam: Examination, role: str, value: float | None, expected: float) -> bool:
    """Whether a final velocity is 0 instead of below the stop, so that nothing is thrown back."""
    return role == "velocity_final" and value == 0 and expected < exam.case.stop_velocity


def _is_text(exam: Examination, place: Position, k: int) -> bool:
    """Whether a text or truth value is typed into a cell of row k, which is not part of a head."""
    value = exam.calculation.values.get(place)
    if not isinstance(value, str | bool) or place in exam.calculation.formulas:
        return False
    return (k > 0 and value != "") or is_spoiling(place, exam.calculation, exam.table.across)


def _lone(exam: Examination, role: str, k: int) -> tuple[str, str]:
    """Return kind and explanation for a single cell that does not follow from those before it."""
    place, cell = exam.table.place(role, k), f"{title(role)} of row {k}"
    value, expected = exam.rows.columns[role].get(k), exam.rows.wanted(role, k)
    typed = place not in exam.calculation.formulas
    kind = "typed number" if typed else "odd formula"
    if error := exam.calculation.error(place):
        return "odd formula", f"{cell} gives {error}, as do all cells that read it"
    if value is None and _is_text(exam, place, k):
        return kind, f"{cell} is {_TYPE_NAMES[type(exam.calculation.values[place])]}, not a number"
    if value is None:
        return "odd formula", f"{cell} is {'blank' if typed else 'no number'}"
    if role == "time" and k == 1 and value == 0:
        return "other scheme", "the times are those at the beginning of the rows"
    text = f"{cell} is not what the cells before it give"
    if power := power_of_ten(value / expected) if expected else None:
        return "unit", f"{text}: a factor of 1e{abs(power)}"
    if role == "depth" and k == 1 and not typed:
        return "other scheme", "the first depth is neither half a step nor a whole one"
    beyond = (exam.rows("depth", k) or 0.0) >= exam.case.radius
    if role == "deceleration" and beyond and exam.follows("brake", BEYOND, k):
        return "other scheme", f"{BEYOND.name}: {BEYOND.says}"
    return kind, text


def judge_order(exam: Examination) -> None:
    """Report columns whose last digits differ from every order of the report's operations.

    Nothing is reported if units are converted or another scheme is followed: that costs last
    digits, too.
    """
    factors = {entry.factor for entry in (*exam.inputs.values(), *exam.derived.values())}
    if any(exam.powers.values()) or factors != {Fraction(1)} or exam.rows.rules != REPORT:
        return
    if any(_power(column.right) for column in _beside(exam)):
        return
    # A mass that no cell holds is tried as any order of its product may give it.
    masses = [exam.case.mass]
    for limit in (0.0, math.inf) if "mass" not in exam.derived else ():
        mass = exam.case.mass
        masses += [mass := math.nextafter(mass, limit) for _ in range(4)]
    cases = [replace(exam.case, own_mass=mass) for mass in masses]
    exempt = exam.accused | exam.calculation.uncomputed.keys()
    computed = exam.calculation.formulas.keys() - exempt
    # Velocities do not tell the order of a deceleration that no column holds.
    shown = "deceleration" in exam.rows.columns
    for role in ("depth", "deceleration", "velocity_final") if shown else ("depth",):
        column = exam.rows.columns.get(role, {})
        rows = [k for k in column if k and exam.table.place(role, k) in computed
                and not _fails(exam, role, k)]  # fmt: skip
        by_mass = []
        for case in cases:
            values = {k: _orders(exam, role, k, case) for k in rows}
            by_mass.append({k: x for k, x in values.items() if x and column[k] not in x})
        if differing := min(by_mass, key=len):
            k, allowed = next(iter(differing.items()))
            expected = min(allowed, key=lambda value: abs(value - column[k]))
            ulps = round(abs(expected - column[k]) / math.ulp(expected))
            text = f"the last digits of {len(differing)} of {len(rows)} cells of {title(role)} "
            text += f"differ, here by {ulps} ulp: another order of operations, "
            text += "on which no printed digit depends"
            cells = [exam.table.place(role, row) for row in differing]
            exam.add("operation order", cells, exam.shown(role, expected), text)


def _orders(exam: Examination, role: str, k: int, case: Case) -> set[float]:
    """Return the values that a cell may hold, depending on the order of operations."""
    value = exam.rows.wanted(role, k)
    if value is None or _rests(exam, role, exam.rows(role, k), value):
        return set()
    if role == "deceleration":
        return orders(case, exam.rows["depth", k], exam.rows["velocity_initial", k])
    return {value}

"""Each cell of a table, by what the cells before it give and by what its column is.

So a wrong one is found where it stands, and what follows from it is not accused.
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

# ---- references and areas: what beside the columns of the scheme spoils them


_BLOCK = 12
"""Inputs that stand below one another, at most; more numbers are a column."""


def drifting(f: Examination) -> None:
    """References to a cell beside the table that move on from row to row, as no $ fixes them."""
    lines, number = f.table.every_line, f.calculation.number
    inputs = {entry.place for entry in (*f.inputs.values(), *f.derived.values(), *f.unread)}
    for line in lines:
        formulas = list(filter(None, map(f.calculation.formulas.get, line.cells)))
        alike = [formula for formula in formulas if formula.shape == formulas[-1].shape]
        begin = formulas.index(alike[0]) if alike else 0
        first = formulas[begin - 1] if begin else None
        for pieces in zip(*(formula.pieces for formula in alike), strict=True):
            read = [piece.area.corner for piece in pieces if piece.area and piece.area.cells == 1]
            if len(read) > 1:  # a first row of another formula may have the right one
                (sheet, *here), (_, *there) = read[:2]
                row, column = (2 * a - b for a, b in zip(here, there, strict=True))
                if first and first.reads((sheet, row, column)):
                    read.insert(0, (sheet, row, column))
            beside = [p for p in read if not any(each.covers(p) for each in lines)]
            moves = len(read) > 1 and read[0] != read[1] and read[:1] == beside[:1]
            # Soon it reads a blank, a text or an input; else it reads a column of numbers.
            strays = None in map(number, beside[:_BLOCK]) or inputs & set(beside[1:])
            if moves and strays and number(read[0]) is not None:
                cells = [formula.place for formula in alike[1 - len(read) :]]
                cell, here = (address(p, p[0] != line.sheet) for p in read[:2])
                along, across = ("row", "column") if line.across else ("column", "row")
                text = f"its {along} reads {cell}, which no $ fixes: this {across} reads {here}"
                text += ", and so on"
                f.add("odd formula", cells, None, text, f.calculation.book[cells[0]].formula)


class Wrong(NamedTuple):
    """A column beside the table that the rows brake by, and its wrong cells by row."""

    line: Line
    cells: dict[int, Position]
    says: str


class Beside(NamedTuple):
    """A quantity that the rows brake by: what, its unit, and two numbers a row, in SI.

    They are what it would have to be for the row's deceleration, and what it should be.
    """

    name: str
    of: str
    unit: str
    needed: dict[int, tuple[float, float]]


def _beside(f: Examination) -> Iterator[tuple[Beside, Line, dict[int, float]]]:
    """Contact areas, pressures and forces, each with every line beside the table that may be it."""
    if not f.table.helpers or "deceleration" not in f.rows.columns:
        return
    area, pressure, force = (dict[int, tuple[float, float]]() for _ in range(3))
    for k in range(1, f.table.steps + 1):
        x, v, a = (f.rows(role, k) for role in ("depth", "velocity_initial", "deceleration"))
        right = math.pi * contact(f.case, x or 0.0)  # 0 at touch, and at depths such as 5E-324 m
        if right and v is not None and a is not None:
            taken = a * f.case.mass
            stress = 0.5 * f.case.target_density * v * v + f.case.resistance
            area[k], pressure[k] = (taken / stress, right), (taken / right, stress)
            force[k] = taken, stress * right
    quantities = (
        Beside("area", "of the contact at the depth", "m^2", area),
        Beside("pressure", "at the velocity", "Pa", pressure),
        Beside("force", "at the depth and the velocity", "N", force),
    )
    for each, line in product(quantities, f.table.helpers):
        numbers = {k: number for k in each.needed if (number := line.at(f.table.zero + k))}
        if len(numbers) >= LEAST:
            yield each, line, numbers


def _powers_beside(f: Examination) -> Iterator[tuple[Beside, Line, int]]:
    """The right ones among these lines, and the power of ten that their unit is."""
    for each, line, numbers in _beside(f):
        rights = {number: each.needed[k][1] for k, number in numbers.items()}
        power = power_of_ten(next(right / number for number, right in rights.items()))
        if power is not None and all(near(n * 10.0**power, right) for n, right in rights.items()):
            yield each, line, power


def units_beside(f: Examination) -> None:
    """Units in heads of contact areas, pressures and forces that their numbers contradict."""
    for each, line, power in _powers_beside(f):
        if line.unit is None or not same_dimension(line.unit, each.unit):
            continue
        if slip := (unit_power(line.unit) or 0) - power:
            size = f"in which it is {times_too(slip)}"
            text = f"the head gives the {each.name} in {line.unit}, {size}"
            f.add("unit", [line.unit_place or line.place(line.first)], None, text, line.unit)


def wrong_beside(f: Examination) -> Wrong | None:
    """The column of contact areas, pressures or forces because of which decelerations are wrong."""
    for (name, of, _, needed), line, numbers in _beside(f):
        units = [needed[k][0] / number for k, number in numbers.items()]
        if power_of_ten(units[0]) is None:
            continue
        if all(power_of_ten(needed[k][1] / number) is not None for k, number in numbers.items()):
            continue  # it is right, in whatever unit
        wrong = {k: line.place(f.table.zero + k) for k in numbers if not near(*needed[k])}
        if wrong and all(near(unit, units[0]) for unit in units):
            return Wrong(line, wrong, f"this {name} is not that {of} of its row")
    return None


# ---- each cell, by what the cells before it give and by what its column is


def each_cell(f: Examination) -> None:
    """Every cell that is not what those before it give, and every cell unlike its column."""
    beside = wrong_beside(f)
    odd = _unlike(f, beside)
    areas = (area for place in f.table.places for area in f.calculation.areas(place))
    read = {area.corner for area in areas if area.cells == 1}
    spoilt, accused = _spoilt(f, odd.keys() - f.table.places.keys()), f.accused
    wrong: dict[Position, tuple[str, str, float | None]] = {}
    for place, (role, k) in f.table.places.items():
        expected = f.rows.wanted(role, k)
        if place in odd:
            kind, text = odd.pop(place)
            if error := f.calculation.error(place):
                kind, text = "odd formula", f"{text}; it gives {error}"
            elif reason := f.calculation.uncomputed.get(place):
                kind, text = "odd formula", f"{text}; it is not computed here: {reason}"
        elif place in accused or any(
            area.corner in spoilt and area.corner != place for area in f.calculation.areas(place)
        ):
            continue
        elif _fails(f, role, k, expected, place in read):
            kind, text = _lone(f, role, k, expected)
            if beside and role == "deceleration" and k in beside.cells:
                place, expected, text = beside.cells[k], None, beside.says
            place, text = _converting(f, place, text)
        else:
            continue
        value = f.rows.columns[role].get(k)
        if value and expected and math.isclose(value, expected, rel_tol=1e-9):
            text += "; it gives the right value here"
        wrong[place] = kind, text, f.shown(role, expected)
    wrong |= {place: (*why, None) for place, why in odd.items()}
    # Those of neighbours with the same kind and cause, but for numbers, are one.
    number = r"\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
    causes = {place: (kind, re.sub(number, "#", text)) for place, (kind, text, _) in wrong.items()}
    for run in runs(causes, f.table.across):
        kind, text, shown = wrong[run[0]]
        f.add(kind, run, shown, text)


def _converting(f: Examination, place: Position, text: str) -> tuple[Position, str]:
    """The formula beside the table that computes what a first velocity only shows, and what of it.

    Of other cells, themselves, and the text that says what is wrong with them.
    """
    role, k = f.table.places.get(place, ("", 0))
    is_first = role.startswith("velocity") and k <= 1
    chain = f.calculation.chain(place) if is_first else []
    cell = next((each for each in reversed(chain) if each in f.calculation.formulas), place)
    sources = [area.corner for area in f.calculation.areas(cell)]
    if not is_first or cell in f.table.places or f.inputs["velocity"].place not in sources:
        return place, text
    return cell, f"{title('velocity')} does not follow from {address(sources[0])}"


def _spoilt(f: Examination, wrong: set[Position]) -> set[Position]:
    """Cells whose readers are not to blame, and those beside the table that read them.

    They are `wrong` cells beside the table, those of the table that hold no number, or a text, and
    all that are not computed.
    """
    order, values = f.calculation.order, f.calculation.values
    spoilt = wrong | {p for p in f.table.places if isinstance(values.get(p), str | bool)}
    spoilt |= f.calculation.texts.keys() | f.calculation.unknown
    cells = {place for line in f.table.helpers for place in line.cells}
    for place in sorted(cells & order.keys(), key=order.__getitem__):
        if any(area.corner in spoilt for area in f.calculation.areas(place)):
            spoilt.add(place)
    return spoilt


_WHAT = {str: "a text", bool: "a truth value"}


def irregular(line: Line, table: Table) -> Iterator[tuple[Position, tuple[str, str]]]:
    """Cells of a line, from row 2 on, that are unlike most of it: place, kind and explanation.

    Rows 0 and 1 start the scheme, so theirs are unlike the others by right.
    """
    rows = [table.zero + k for k in range(2, table.steps + 1)]
    places = [line.place(at) for at in rows if line.follows(at)]
    calculation = line.calculation
    formulas = {p: calculation.formulas[p] for p in places if p in calculation.formulas}
    begins = formulas.keys() >= set(places[:3])  # and goes on in numbers
    if len(formulas) < max(3, 0.5 * len(places) * (not begins)):
        return
    # Some people type the number of the row into each formula: then the shapes without numbers.
    for masked in (False, True):
        shapes = {
            place: tuple(
                "#" if masked and piece.kind == "number" else shape
                for piece, shape in zip(formula.pieces, formula.shape, strict=True)
            )
            for place, formula in formulas.items()
        }
        counts = Counter(shapes.values())
        usual, often = counts.most_common(1)[0]
        if often >= 0.5 * len(formulas):
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
            what = _WHAT.get(kind, "a number")
            stand = f"{what} is typed where {_filled(pattern, place, calculation)} would stand"
            yield place, ("typed number", stand)


def _reads_for(formula: Formula, typed: Formula, calculation: Calculation) -> bool:
    """Whether a formula is another one, but reads cells that hold what is typed there."""
    if len(formula.pieces) != len(typed.pieces):
        return False
    pairs = zip(formula.pieces, typed.pieces, strict=True)
    unlike = [(a, b) for a, b in pairs if (a.shape or a.text) != (b.shape or b.text)]
    return bool(unlike) and all(
        a.area and b.kind == "number" and calculation.number(a.area.corner) == float(b.text)
        for a, b in unlike
    )


def _odd(formula: Formula, pattern: Formula, calculation: Calculation) -> tuple[str, str]:
    """Whether a formula unlike its column has a number where the others have a reference."""
    text = calculation.book[formula.place].formula
    usual = _filled(pattern, formula.place, calculation)
    typed = Counter(formula.typed) - Counter(pattern.typed)
    cells, names = (len(pattern.areas) - len(formula.areas), len(pattern.names - formula.names))
    if typed and (cells > 0 or names):
        numbers = " and ".join(f"{number:g}" for number in typed)
        read = "reads a cell" if cells > 0 else "has a name"
        return "typed constant", f"{text} has {numbers} where its column {read}: {usual}"
    return "odd formula", f"{text} is unlike its column, where {usual} would stand"


def _filled(pattern: Formula, place: Position, calculation: Calculation) -> str:
    """The formula of another cell, filled into this one."""
    from openpyxl.formula.translate import Translator, TranslatorError

    text = calculation.book[pattern.place].formula or ""
    with suppress(TranslatorError):  # where it would reach beyond the sheet's edge
        text = str(Translator(text, address(pattern.place)).translate_formula(address(place)))
    return text


def _unlike(f: Examination, beside: Wrong | None) -> dict[Position, tuple[str, str]]:
    """Cells unlike their column, with kind and explanation; but not right ones among wrong ones."""
    odd = {p: why for line in f.table.every_line for p, why in irregular(line, f.table)}
    for role in {f.table.places[place][0] for place in odd.keys() & f.table.places.keys()}:
        fails = {
            place: _fails(f, role, k, expected)
            for k, place in enumerate(f.cells(role, 1), 1)
            if place in f.calculation.formulas
            if (expected := f.rows.wanted(role, k)) is not None
        }
        if any(fails[place] for place in fails.keys() - odd.keys()):
            odd = {place: why for place, why in odd.items() if fails.get(place, True)}
    if beside:
        right = set(beside.line.cells) - set(beside.cells.values())
        odd = {place: why for place, why in odd.items() if place not in right}
    return odd


def _fails(f: Examination, role: str, k: int, expected: float | None, read: bool = False) -> bool:
    """Whether a cell is not what it should hold. `read`: whether a cell of the table reads it."""
    column, place = f.rows.columns[role], f.table.place(role, k)
    value = column.get(k)
    if value is None:
        needed = 0 < k < max(column, default=0) or (read and k > 0)
        beyond = expected is not None and not math.isfinite(expected)  # so it gives an error
        wrong = needed or _is_text(f, place, k) or f.calculation.error(place)
        return bool(wrong) and not beyond
    numbered = role == "time" and math.isclose(value, k * f.case.step, rel_tol=NEAR)
    if expected is None or numbered:  # by the number of the row, not from the time before
        return False
    size = abs(expected)
    if role.startswith("velocity"):
        size = max(size, abs(f.rows("velocity_initial", max(k - 1, 0)) or 0.0))
    if abs(value - expected) <= NEAR * size or _rests(f, role, value, expected):
        return False
    # A first row that is the report's may be unlike the others, which follow another rule.
    part = FILLS.get(role, "advance")
    return k != 1 or part == "advance" or not f.follows(part, REPORT[part], 1)


def _rests(f: Examination, role: str, value: float | None, expected: float) -> bool:
    """Whether a last velocity is 0 instead of below the stop: the particle is not thrown back."""
    return role == "velocity_final" and value == 0 and expected < f.case.stop_velocity


def _is_text(f: Examination, place: Position, k: int) -> bool:
    """Whether a text or a truth value is typed into a cell of row k, below the table's heads."""
    value = f.calculation.values.get(place)
    if not isinstance(value, str | bool) or place in f.calculation.formulas:
        return False
    return (k > 0 and value != "") or is_spoiling(place, f.calculation, f.table.across)


def _lone(f: Examination, role: str, k: int, expected: float | None) -> tuple[str, str]:
    """The kind of a cell that alone is not what the cells before it give."""
    place, cell = f.table.place(role, k), f"{title(role)} of row {k}"
    value = f.rows.columns[role].get(k)
    typed = place not in f.calculation.formulas
    alone = "typed number" if typed else "odd formula"
    if error := f.calculation.error(place):
        return "odd formula", f"{cell} gives {error}, as do all cells that read it"
    if value is None and _is_text(f, place, k):
        return alone, f"{cell} is {_WHAT[type(f.calculation.values[place])]}, not a number"
    if value is None:
        return "odd formula", f"{cell} is {'blank' if typed else 'no number'}"
    if role == "time" and k == 1 and value == 0:
        return "other scheme", "the times are those at the beginning of the rows"
    what = f"{cell} is not what the cells before it give"
    if power := power_of_ten(value / expected) if expected else None:
        return "unit", f"{what}: a factor of 1e{abs(power)}"
    if role == "depth" and k == 1 and not typed:
        return "other scheme", "the first depth is neither half a step nor a whole one"
    beyond = (f.rows("depth", k) or 0.0) >= f.case.radius
    if role == "deceleration" and beyond and f.follows("brake", BEYOND, k):
        return "other scheme", f"{BEYOND.name}: {BEYOND.says}"
    return alone, what


def order(f: Examination) -> None:
    """Columns whose last digits no order of the report's operations gives."""
    factors = {entry.factor for entry in (*f.inputs.values(), *f.derived.values())}
    if any(f.powers.values()) or factors != {Fraction(1)} or f.rows.rules != REPORT:
        return  # converting units costs last digits, too
    if any(power for *_, power in _powers_beside(f)):
        return
    # The mass as its cell has it; without a cell, as any order of its product gives it.
    masses = [f.case.mass]
    for way in (0.0, math.inf) if "mass" not in f.derived else ():
        mass = f.case.mass
        masses += [mass := math.nextafter(mass, way) for _ in range(4)]
    cases = [replace(f.case, own_mass=mass) for mass in masses]
    accused = f.accused
    # Without a column of its own the deceleration's order is not known by the velocity's.
    shown = "deceleration" in f.rows.columns
    for role in ("depth", "deceleration", "velocity_final") if shown else ("depth",):
        column = f.rows.columns.get(role, {})
        rows = [k for k in column if k and f.table.place(role, k) not in accused
                and f.table.place(role, k) in f.calculation.formulas
                and f.table.place(role, k) not in f.calculation.uncomputed
                and not _fails(f, role, k, f.rows.wanted(role, k))]  # fmt: skip
        by_mass = []
        for case in cases:
            ways = {k: _ordered(f, role, k, case) for k in rows}
            by_mass.append({k: way for k, way in ways.items() if way and column[k] not in way})
        if differ := min(by_mass, key=len):
            k, ways_there = next(iter(differ.items()))
            value = column[k]
            wanted = min(ways_there, key=lambda way: abs(way - value))
            ulps = round(abs(wanted - value) / math.ulp(wanted))
            text = f"the last digits of {len(differ)} of {len(rows)} cells of {title(role)}, here "
            text += f"{ulps} ulp, are those of another order, on which no printed digit depends"
            cells = [f.table.place(role, row) for row in differ]
            f.add("operation order", cells, f.shown(role, wanted), text)


def _ordered(f: Examination, role: str, k: int, case: Case) -> set[float]:
    """What a cell may hold, by the order of the operations."""
    value = f.rows.wanted(role, k)
    if value is None or _rests(f, role, f.rows(role, k), value):
        return set()
    if role == "deceleration":
        return orders(case, f.rows["depth", k], f.rows["velocity_initial", k])
    return {value}

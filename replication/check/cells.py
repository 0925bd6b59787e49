"""Each cell of a table, by what the cells before it give and by what its column is.

So a wrong one is found where it stands, and what follows from it is not accused.
"""

import math
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

from replication.check.examination import NEAR, Examination, Input, joined
from replication.check.scheme import BEYOND, FILLS, REPORT, Case, orders
from replication.check.table import Line, Table, address
from replication.check.words import power_of_ten, title
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation, Formula


def each_cell(f: Examination) -> None:
    """Every cell that is not what those before it give, and every cell unlike its column."""
    odd = {p: why for line in f.table.every_line for p, why in _irregular(line, f.table)}
    areas = (area for place in f.table.places for area in f.calculation.areas(place))
    read = {area.corner for area in areas if area.cells == 1}
    wrong = _beside(f, odd.keys() - f.table.places.keys())
    accused, before = f.accused, len(f.differences)
    for role, column in f.rows.columns.items():
        for k in range(f.table.steps + 1):
            place, expected = f.table.place(role, k), f.rows.wanted(role, k)
            if place in odd:
                kind, text = odd.pop(place)
                if error := f.calculation.error(place):
                    kind, text = "odd formula", f"{text}; it gives {error}"
                elif reason := f.calculation.uncomputed.get(place):
                    kind, text = "odd formula", f"{text}; it is not computed here: {reason}"
            elif place in accused or any(a.corner in wrong for a in f.calculation.areas(place)):
                continue
            elif _fails(f, role, k, expected, place in read):
                kind, text = _lone(f, role, k, expected)
            else:
                continue
            shown, value = f.shown(role, expected), column.get(k)
            if value and expected and math.isclose(value, expected, rel_tol=1e-9):
                text += "; it gives the right value here"
            f.add(kind, [place], shown, text)
    for place, (kind, text) in odd.items():
        f.add(kind, [place], None, text)
    f.differences[before:] = joined(f.differences[before:], f.table.across)


def _beside(f: Examination, wrong: set[Position]) -> set[Position]:
    """Wrong cells beside the table, and those beside it that read them, through others or not."""
    order = f.calculation.order
    cells = {line.place(at) for line in f.table.helpers for at in range(line.first, line.last + 1)}
    for place in sorted(cells & order.keys(), key=order.__getitem__):
        if any(area.corner in wrong for area in f.calculation.areas(place)):
            wrong = wrong | {place}
    return wrong


_WHAT = {str: "a text", bool: "a truth value"}


def _irregular(line: Line, table: Table) -> Iterator[tuple[Position, tuple[str, str]]]:
    """Cells of a line, from row 2 on, that are unlike most of it: place, kind and explanation.

    Rows 0 and 1 start the scheme, so theirs are unlike the others by right.
    """
    rows = [table.zero + k for k in range(2, table.steps + 1)]
    places = [line.place(at) for at in rows if line.follows(at)]
    calculation = line.calculation
    formulas = {p: calculation.formulas[p] for p in places if p in calculation.formulas}
    if len(formulas) < max(3, 0.5 * len(places)):
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
        usual, often = Counter(shapes.values()).most_common(1)[0]
        if often >= 0.5 * len(formulas):
            break
    else:
        return
    pattern = next(formulas[place] for place, shape in shapes.items() if shape == usual)
    for place in places:
        if place in formulas:
            if shapes[place] != usual:
                yield place, _odd(formulas[place], pattern, calculation)
        elif (typed := calculation.values.get(place)) is not None:
            what = _WHAT.get(type(typed), "a number")
            stand = f"{what} is typed where {_filled(pattern, place, calculation)} would stand"
            yield place, ("typed number", stand)


def _odd(formula: Formula, pattern: Formula, calculation: Calculation) -> tuple[str, str]:
    """Whether a formula unlike its column has a number where the others have a reference."""
    text = _short(calculation.book[formula.place].formula or "")
    usual = _filled(pattern, formula.place, calculation)
    typed = Counter(formula.literals) - Counter(pattern.literals)
    if typed and len(formula.areas) < len(pattern.areas):
        numbers = " and ".join(f"{number:g}" for number in typed)
        are = "is" if len(typed) == 1 else "are"
        where = f"{numbers} {are} typed where its column reads a cell: {text}, not {usual}"
        return "typed constant", where
    return "odd formula", f"{text} is unlike its column, where {usual} would stand"


def _filled(pattern: Formula, place: Position, calculation: Calculation) -> str:
    """The formula of another cell, filled into this one."""
    from openpyxl.formula.translate import Translator, TranslatorError

    text = calculation.book[pattern.place].formula or ""
    with suppress(TranslatorError):  # where it would reach beyond the sheet's edge
        text = str(Translator(text, address(pattern.place)).translate_formula(address(place)))
    return _short(text)


def _short(text: str) -> str:
    """A formula, cut where it would fill the screen."""
    return text if len(text) <= 90 else f"{text[:87]}..."


def types(formula: Formula, own: Input, calculation: Calculation) -> bool:
    """Whether a formula has an input's value as a number, and does not read its cell."""
    value = calculation.number(own.place)
    if not formula.literals or value is None or own.role == "beta":
        return False
    if own.role == "stop_velocity":
        texts = [piece.text for piece in formula.pieces]
        pairs = pairwise(texts)
        typed = any(sign in ("<", "<=", ">", ">=") and to == f"{value:g}" for sign, to in pairs)
    else:
        values = {own.si, value} | ({value / 2, own.si / 2} if own.role == "step" else set())
        typed = any(
            math.isclose(number, wanted, rel_tol=1e-12)
            for wanted in values
            if math.isfinite(wanted) and not _plain(wanted)
            for number in formula.literals
        )
    read = (calculation.source(area.corner) for area in formula.areas if area.cells == 1)
    return typed and all(cell != own.place for cell in read)


def _plain(value: float) -> bool:
    """Whether a number stands in formulas for itself: small whole ones, halves, powers of ten."""
    power = math.log10(abs(value)) if value else 0.0
    small = float(value).is_integer() and abs(value) <= 10
    return small or value in (0.5, 1.5, 12.0) or abs(power - round(power)) < 1e-12


def _fails(f: Examination, role: str, k: int, expected: float | None, read: bool) -> bool:
    """Whether a cell is not what it should hold. `read`: whether a cell of the table reads it."""
    column, place = f.rows.columns[role], f.table.place(role, k)
    value = column.get(k)
    if value is None:
        needed = 0 < k < max(column, default=0) or (read and k > 0)
        wrong = needed or _text(f, place) or f.calculation.error(place)
        beyond = expected is not None and not math.isfinite(expected)  # so it gives an error
        return bool(wrong) and not beyond and not _passed_on(f, place)
    numbered = role == "time" and math.isclose(value, k * f.case.step, rel_tol=NEAR)
    if expected is None or numbered:  # by the number of the row, not from the time before
        return False
    size = abs(expected)
    if role.startswith("velocity"):
        size = max(size, abs(f.rows("velocity_initial", max(k - 1, 0)) or 0.0))
    if abs(value - expected) <= NEAR * size:
        return False
    # A first row that is the report's may be unlike the others, which follow another rule.
    part = FILLS.get(role, "advance")
    return k != 1 or part == "advance" or not f.follows(part, getattr(REPORT, part), 1)


def _text(f: Examination, place: Position) -> bool:
    """Whether a text or a truth value is typed into a cell of the table, below its heads."""
    value = f.calculation.values.get(place)
    _, k = f.table.places.get(place, ("", 0))
    typed = (k > 0 and value != "") or place in f.calculation.spoiling
    return typed and isinstance(value, str | bool) and place not in f.calculation.formulas


def _passed_on(f: Examination, place: Position) -> bool:
    """Whether a formula gives no number because another cell of the table holds none.

    It may read that cell through others beside the table, which come before it.
    """
    order = f.calculation.order
    cells = {area.corner for area in f.calculation.areas(place) if area.cells == 1} - {place}
    if any(
        isinstance(f.calculation.values.get(p), str | bool) for p in cells & f.table.places.keys()
    ):
        return True
    beside = (p for p in cells if any(line.covers(p) for line in f.table.helpers))
    return any(_passed_on(f, p) for p in beside if order.get(p, math.inf) < order.get(place, 0))


def _lone(f: Examination, role: str, k: int, expected: float | None) -> tuple[str, str]:
    """The kind of a cell that alone is not what the cells before it give."""
    place = f.table.place(role, k)
    value = f.rows.columns[role].get(k)
    typed = place not in f.calculation.formulas
    alone = "typed number" if typed else "odd formula"
    what = f"{title(role)} of row {k} is not what the cells before it give"
    if error := f.calculation.error(place):
        text = f"{title(role)} of row {k} gives {error}, as do all cells that read it"
        return "odd formula", text
    if value is None and _text(f, place):
        is_typed = _WHAT[type(f.calculation.values[place])]
        return alone, f"{title(role)} of row {k} is {is_typed}, not a number"
    if value is None:
        blank = ": the cell is blank" if typed else ""
        return "odd formula", f"no number in {title(role)} of row {k}{blank}"
    if role == "time" and k == 1 and value == 0:
        return "other scheme", "the times are those at the beginning of the rows"
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
    factors = {own.factor for own in (*f.inputs.values(), *f.derived.values())}
    if any(f.powers.values()) or factors != {Fraction(1)} or f.rules != REPORT:
        return  # converting units costs last digits, too
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
                and not _fails(f, role, k, f.rows.wanted(role, k), False)]  # fmt: skip
        others = [
            [k for k in rows if column[k] not in (_ordered(f, role, k, case) or {column[k]})]
            for case in cases
        ]
        if differ := min(others, key=len):
            value = column[differ[0]]
            wanted = min(_ordered(f, role, differ[0], f.case), key=lambda v: abs(v - value))
            cells = [f.table.place(role, k) for k in differ]
            ulps = round(abs(wanted - value) / math.ulp(wanted))
            text = (
                f"{len(differ)} of {len(rows)} cells of {title(role)} differ in the last digits, "
                f"this one by {ulps} ulp: the formula calculates in another order, on which no "
                "printed digit depends"
            )
            f.add("operation order", cells, f.shown(role, wanted), text)


def _ordered(f: Examination, role: str, k: int, case: Case) -> set[float]:
    """What a cell may hold, by the order of the operations."""
    rows = f.rows
    x, v = rows("depth", k), rows("velocity_initial", k)
    if role == "deceleration":
        return set() if x is None or v is None else orders(case, x, v)
    value = rows.wanted(role, k)
    return set() if value is None else {value}

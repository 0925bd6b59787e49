"""Formulas that are not what their neighbours are, and numbers where a reference should stand."""

import math
from collections import Counter
from collections.abc import Iterator

from replication.check.inputs import Input
from replication.check.lines import Line, address
from replication.check.table import Table
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation
from spreadsheets.references import Formula

__all__ = ["irregular", "short", "types"]


def irregular(
    line: Line, table: Table, calculation: Calculation
) -> Iterator[tuple[Position, tuple[str, str]]]:
    """Cells of a line, from row 2 on, that are unlike most of it: place, kind and explanation.

    Rows 0 and 1 start the scheme, so theirs are unlike the others by right.
    """
    places = [line.place(table.zero + k) for k in range(2, table.steps + 1)]
    formulas = {p: calculation.formulas[p] for p in places if p in calculation.formulas}
    if len(formulas) < max(3, 0.5 * len(places)):
        return
    for shape in (_exact, _masked):
        shapes = {place: shape(formula) for place, formula in formulas.items()}
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
        elif calculation.number(place) is not None:
            usual_text = _filled(pattern, place, calculation)
            yield (
                place,
                ("typed number", f"a number is typed where {short(usual_text)} would stand"),
            )


def _exact(formula: Formula) -> tuple[str, ...]:
    return formula.shape


def _masked(formula: Formula) -> tuple[str, ...]:
    """Without numbers: some people type the number of the row into each formula."""
    pairs = zip(formula.pieces, formula.shape, strict=True)
    return tuple("#" if piece.kind == "number" else shape for piece, shape in pairs)


def _odd(formula: Formula, pattern: Formula, calculation: Calculation) -> tuple[str, str]:
    """Whether a formula unlike its column has a number where the others have a reference."""
    text = short(calculation.book[formula.place].formula or "")
    usual = short(_filled(pattern, formula.place, calculation))
    typed = Counter(formula.literals) - Counter(pattern.literals)
    if typed and len(formula.areas) < len(pattern.areas):
        numbers = " and ".join(f"{number:g}" for number in typed)
        return (
            "typed constant",
            f"{numbers} is typed where its column reads a cell: {text}, not {usual}",
        )
    return "odd formula", f"{text} is unlike its column, where {usual} would stand"


def _filled(pattern: Formula, place: Position, calculation: Calculation) -> str:
    """The formula of another cell, filled into this one."""
    from openpyxl.formula.translate import Translator, TranslatorError

    text = calculation.book[pattern.place].formula or ""
    try:
        return str(Translator(text, address(pattern.place)).translate_formula(address(place)))
    except TranslatorError:
        return text


def short(text: str) -> str:
    """A formula, cut where it would fill the screen."""
    return text if len(text) <= 90 else f"{text[:87]}..."


def types(formula: Formula, own: Input, calculation: Calculation) -> bool:
    """Whether a formula has an input's value as a number, and does not read its cell."""
    if not formula.literals or own.place is None or own.role == "beta":
        return False
    value = calculation.number(own.place)
    if value is None:
        return False
    if own.role == "stop_velocity":
        texts = [piece.text for piece in formula.pieces]
        typed = any(
            sign in ("<", "<=", ">", ">=") and texts[i + 1] == f"{value:g}"
            for i, sign in enumerate(texts[:-1])
        )
    else:
        values = {own.si, value} | ({value / 2, own.si / 2} if own.role == "step" else set())
        typed = any(
            math.isclose(number, wanted, rel_tol=1e-12)
            for wanted in values
            if math.isfinite(wanted) and not _plain(wanted)
            for number in formula.literals
        )
    return typed and not any(
        own.place == area.corner or _converts(area.corner, own.place, calculation)
        for area in formula.areas
        if area.cells == 1
    )


def _converts(place: Position, source: Position, calculation: Calculation) -> bool:
    """Whether a cell only brings an input into another unit."""
    formula = calculation.formulas.get(place)
    return formula is not None and [area.corner for area in formula.areas] == [source]


def _plain(value: float) -> bool:
    """Whether a number stands in formulas for itself: small whole ones, halves, powers of ten."""
    power = math.log10(abs(value)) if value else 0.0
    small = float(value).is_integer() and abs(value) <= 10
    return small or value in (0.5, 1.5, 12.0) or abs(power - round(power)) < 1e-12

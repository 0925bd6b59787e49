"""Labels of cells: a text left of a number or above it, with a unit; and the names of cells."""

import re
from collections.abc import Iterator

from replication.check.words import input_roles, is_unit, unit_in
from spreadsheets.evaluate import Evaluator, parse_formula, shape_key
from spreadsheets.foreign import Position

_NUMBER = re.compile(r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[Ee][-+]?[0-9]{1,3})?")
_SIDEWAYS = 4
"""How far from a number its label may stand."""
_SURE = re.compile(r"[\[(].+[\])]|\bin \S+$| / |/\S+$|, ")
"""How a text states a unit so that it is no word: in brackets, after "in", a slash or a comma."""


def is_sure(text: str) -> bool:
    """Whether the unit in a text cannot be a word by chance."""
    return bool(is_unit(text) or _SURE.search(text))


def label_of(place: Position, evaluator: Evaluator) -> tuple[str, str | None, bool]:
    """The label of a cell, its unit if one is stated, and whether that is sure.

    A text at its left is its label; or else the nearest text that names an input, or the nearest.
    """
    sheet, row, column = place
    left, above, right = (
        _typed_text((sheet, r, c), evaluator)
        for r, c in ((row, column - 1), (row - 1, column), (row, column + 1))
    )
    units = [text for text in (right, left, above) if text and is_unit(text)]
    if left in units and type(evaluator.values.get((sheet, row, column - 2))) is float:
        units.remove(left)  # it is the unit of the number before it
    unit = is_unit(units[0]) if units else None
    texts = [text for text in (left, above) if text and not is_unit(text)]
    texts += _further(place, evaluator, above is not None and is_unit(above) is not None)
    if right and not texts and not is_unit(right):
        texts.append(right)
    named = [text for text in texts if input_roles(text, unit)] if left not in texts else []
    label = (named or texts or [""])[0]
    if unit is not None:
        return label, unit, True
    if label and label in (left, above, right):
        unit = unit_in(label)
    return label, unit, unit is not None and is_sure(label)


def _typed_text(place: Position, evaluator: Evaluator) -> str | None:
    """The text typed into a cell, if any."""
    value = evaluator.values.get(place)
    if isinstance(value, str) and value.strip() and place not in evaluator.formulas:
        return str(value)
    return None


def _further(place: Position, evaluator: Evaluator, upwards: bool) -> Iterator[str]:
    """Texts further left; and further up, where a unit stands above."""
    sheet, row, column = place
    is_formula = place in evaluator.formulas
    for distance in range(2, _SIDEWAYS + 1):
        beside = type(evaluator.values.get((sheet, row, column - distance + 1))) is float
        if beside and not is_formula:
            return  # the text further left is the label of the number between
        cells = [(sheet, row, column - distance)]
        cells += [(sheet, row - distance, column)] if upwards else []
        for cell in cells:
            text = _typed_text(cell, evaluator)
            if text and not is_unit(text):
                yield text


def idle_numbers(evaluator: Evaluator) -> dict[str, float]:
    """The defined names that stand for a number and that no formula uses."""
    used = {name for shape in evaluator.formulas.values() for name in shape.names}
    numbers = {}
    for name, meaning in evaluator.book.names.items():
        own = name.rpartition("!")[2]
        match = _NUMBER.fullmatch(meaning.removeprefix("="))
        if match and own.upper() not in used:
            numbers[own] = float(match[0])
    return numbers


def cell_names(evaluator: Evaluator) -> dict[Position, str]:
    """The defined names of single cells."""
    first = next(iter(evaluator.book.sheets))
    names = {}
    for name, meaning in evaluator.book.names.items():
        text = f"={meaning.removeprefix('=')}"
        shape = parse_formula(text, first, evaluator.book, shape_key(text, 1, 1))
        if len(shape.references) == 1 and not shape.literals and all(shape.references[0].fixed):
            area = shape.references[0].at(1, 1)
            if area.cells == 1:
                names[area.corner] = name.rpartition("!")[2]
    return names

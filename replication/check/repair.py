"""References that lack their $: filled down or across, they slip away from the cell of an input.

They are looked for before the tables, since a column that reads blank cells from its second row on
is no column of the scheme any more. The workbook is then judged as it was meant.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import takewhile

from spreadsheets.evaluate import CellReference, Evaluator, Shape, column_letters, formula_text
from spreadsheets.foreign import Book, Position, StoredCell
from spreadsheets.scalars import Scalar

_LEAST = 5
"""A formula must be filled into so many cells."""


@dataclass(frozen=True)
class Slipped:
    """Cells with one formula, whose reference slips away from a cell; and the formulas meant."""

    cells: tuple[Position, ...]
    meant: Position
    formulas: Mapping[Position, str]


def slipped(evaluator: Evaluator) -> Iterator[Slipped]:
    """The references of a workbook that lack their $."""
    groups: dict[tuple[Shape, bool, int], list[Position]] = {}
    for place, shape in evaluator.formulas.items():
        if any(_is_loose(ref) for ref in shape.references):
            groups.setdefault((shape, False, place[2]), []).append(place)
            groups.setdefault((shape, True, place[1]), []).append(place)
    fixed = {
        (ref.sheet, ref.rows[0], ref.columns[0])
        for shape in set(evaluator.formulas.values()) for ref in shape.references
        if all(ref.fixed) and ref.rows[0] == ref.rows[1] and ref.columns[0] == ref.columns[1]
    }  # fmt: skip
    for (shape, across, _), cells in groups.items():
        if len(cells) < _LEAST:
            continue
        for ref in shape.references:
            if not _is_loose(ref) or ref.fixed[1 if across else 0]:
                continue
            meant = _cell_meant(evaluator, ref, cells, across, fixed)
            if meant is not None:
                yield Slipped(
                    tuple(cells), meant, {p: _with_dollars(shape, ref, meant, p) for p in cells}
                )
                break


def _is_loose(ref: CellReference) -> bool:
    """Whether a reference to a single cell moves when it is filled."""
    single = ref.rows[0] == ref.rows[1] and ref.columns[0] == ref.columns[1]
    return single and not (ref.fixed[0] and ref.fixed[1])


def _cell_meant(
    evaluator: Evaluator, ref: CellReference, cells: list[Position], across: bool,
    fixed: set[Position],
) -> Position | None:  # fmt: skip
    """The cell that a reference was meant to read in all rows; None if it slips from none.

    Most of the cells that it reads are blank or texts; or some are, and other formulas fix the cell
    that is meant. That is the first that it reads, or the one before: the first row may have a
    formula of its own.
    """
    read, own = [], set(cells)
    for _, row, column in cells:
        area = ref.at(row, column)
        read.append((area.sheet, area.top, area.left))
    # A reference to the column itself slips from a cell if others stand between that and the rows.
    before_rows = list(takewhile(lambda p: p not in own, read)) if own.intersection(read) else read
    numbers = sum(
        type(evaluator.values.get(p)) is float or p in evaluator.formulas for p in before_rows
    )
    blank = len(before_rows) - numbers
    sheet, row, column = read[0]
    before = (sheet, row, column - 1) if across else (sheet, row - 1, column)
    candidates = [p for p in (before, read[0]) if type(evaluator.values.get(p)) is float]
    for place in candidates:
        if place in fixed and blank:
            return place
    return candidates[-1] if candidates and 0 < numbers <= len(before_rows) / 2 else None


def _with_dollars(shape: Shape, ref: CellReference, meant: Position, place: Position) -> str:
    """The formula of a cell with the reference fixed to the cell that is meant."""
    loose = formula_text(_reference_key(ref), place[1], place[2])
    fixed = f"${column_letters(meant[2])}${meant[1]}"
    text = formula_text(shape.key, place[1], place[2])
    return text.replace(loose, fixed)


def _reference_key(ref: CellReference) -> str:
    """A reference as the key of a shape has it, without its sheet."""
    row = f"{ref.rows[0]}" if ref.fixed[0] else f"[{ref.rows[0]}]"
    column = f"{ref.columns[0]}" if ref.fixed[1] else f"[{ref.columns[0]}]"
    return f"\x02{row},{column};{row},{column}\x03"


_MOST_TRIED = 20
"""So many cells are tried where no table moves."""


@dataclass(frozen=True)
class Still:
    """A cell of a column that is blank or zero, so that nothing moves, and the formula meant."""

    place: Position
    formula: str
    value: Scalar


def still_cells(evaluator: Evaluator) -> Iterator[Still]:
    """The cells that may keep all rows from moving: a velocity that is blank, or a typed zero.

    Such a cell stands in a column between a number and a formula, and a formula reads it. It may
    have been meant to repeat the cell before it.
    """
    values, formulas = evaluator.values, evaluator.formulas
    read = {a.corner for p in formulas for a in evaluator.areas(p) if a.cells == 1}
    tried = 0
    for place in sorted(read - formulas.keys()):
        value = values.get(place)
        if value is not None and value != 0:
            continue
        sheet, row, column = place
        for down, right in ((1, 0), (0, 1)):
            before = (sheet, row - down, column - right)
            after = (sheet, row + down, column + right)
            if type(values.get(before)) is float and values[before] and after in formulas:
                tried += 1
                yield Still(place, f"={column_letters(before[2])}{before[1]}", value)
        if tried >= _MOST_TRIED:
            return


def moving(book: Book, still: Still) -> Book:
    """The book with the formula that was meant in a cell."""
    sheet, row, column = still.place
    cells = dict(book.sheets[sheet])
    cells[row, column] = StoredCell(still.formula, None)
    return replace(book, sheets={**book.sheets, sheet: cells})


def with_dollars(book: Book, slips: list[Slipped]) -> Book:
    """The book with the formulas that were meant, which have no stored values."""
    sheets = {name: dict(cells) for name, cells in book.sheets.items()}
    for slip in slips:
        for (sheet, row, column), text in slip.formulas.items():
            cell = sheets[sheet][row, column]
            sheets[sheet][row, column] = cell._replace(formula=text)
    return replace(book, sheets=sheets)

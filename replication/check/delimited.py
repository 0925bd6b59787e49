"""Read a table that a program wrote as text (CSV and the like) as a workbook of one sheet.

Row and column of a cell are the line of the file and the column in it. Separators are commas,
semicolons, tabs or blanks, whichever gives most lines that are nothing but numbers; decimal marks
are points or commas. Lines that begin with a mark of comments are skipped, but for heads right
above the numbers. The digits of each number are kept as they are printed: they are its uncertainty.
"""

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path

from replication.check.words import is_unit
from replication.separated import (
    Rows,
    cell_number,
    commented_heads,
    file_text,
    heads_by_blanks,
    plain_number,
    separated_rows,
)
from replication.user_input import place as named
from spreadsheets.foreign import (
    MAX_CELLS,
    MAX_FILE,
    MAX_TEXT,
    Book,
    Position,
    StoredCell,
    Value,
    read,
)

SUFFIXES = frozenset({".csv", ".tsv", ".tab", ".txt", ".dat"})
_WORKBOOKS = (b"PK\x03\x04", bytes.fromhex("D0CF11E0A1B11AE1"))
"""How workbooks begin, by whatever name."""
_ABSENT = frozenset({"", "-", "nan", "na", "n/a", "none", "null"})
"""How programs write that there is no number."""
_LEAST = 4
"""The fewest rows of numbers."""


def read_any(path: Path) -> Book:
    """Read a workbook, or by its name a text file. Raises OSError, WorkbookError or ValueError."""
    if path.suffix.lower() not in SUFFIXES or not path.is_file():
        return read(path)
    with path.open("rb") as file:
        content = file.read(MAX_FILE + 1)
    if content.startswith(_WORKBOOKS):
        return read(path)
    with named(str(path)):
        if len(content) > MAX_FILE:
            raise ValueError(f"has more than {MAX_FILE >> 20} MB")
        return _book(path, file_text(content))


def where(book: Book, place: Position) -> str:
    """Where a cell of a text file stands."""
    return f"line {place[1]}, {column_at(book, place[2])}"


def column_at(book: Book, column: int) -> str:
    """The column of a text file by its head, or by its number if it has none."""
    head = (book.heads or {}).get(column)
    return f"column {head!r}" if head else f"column {column}"


def _book(path: Path, text: str) -> Book:
    lines = text.splitlines()
    rows, separator = separated_rows(lines, _worth)
    numeric = [line for line, cells in rows.items() if _is_row(cells)]
    if len(numeric) < _LEAST:
        some = f"only {len(numeric)}" if numeric else "none"
        raise ValueError(f"holds no table: of its lines {some} consist of two or more numbers")
    width = Counter(len(rows[line]) for line in numeric).most_common(1)[0][0]
    first = next(line for line in numeric if len(rows[line]) == width)
    _add_heads(rows, lines, first, width, separator)
    cells: dict[tuple[int, int], StoredCell] = {}
    digits: dict[tuple[int, int], tuple[int, int]] = {}
    for line, texts in rows.items():
        for column, given in enumerate(texts, 1):
            if given.lower() in _ABSENT:
                continue
            value: Value | None = cell_number(given)
            if value is None:
                value = given[:MAX_TEXT]
            else:
                digits[line, column] = _printed_digits(given)
            cells[line, column] = StoredCell(None, value)
        if len(cells) > MAX_CELLS:
            raise ValueError(f"holds more than {MAX_CELLS:,} numbers")
    heads = {column: head for column in range(1, width + 1)
             if (head := _head_above(cells, first, column))}  # fmt: skip
    return Book(path, {path.stem: cells}, {}, digits={path.stem: digits}, heads=heads)


# ---- lines and cells


def _worth(rows: Rows, _: str) -> tuple[int, int]:
    """How many lines of numbers a separator gives, and how many cells they have."""
    counts = [len(cells) for cells in rows.values() if _is_row(cells)]
    return len(counts), sum(counts)


def _is_row(cells: Sequence[str]) -> bool:
    """Whether a line is a row of two or more numbers, some of which may be absent."""
    numbers = sum(cell_number(cell) is not None for cell in cells)
    absent = sum(cell.lower() in _ABSENT for cell in cells)
    return numbers > 1 and numbers + absent == len(cells)


def _printed_digits(text: str) -> tuple[int, int]:
    """The number of digits of a number as it is printed, and the power of ten of the last one.

    >>> [_printed_digits(text) for text in ("500.00", "0.050", "1.20e-05", "3000")]
    [(5, -2), (2, -3), (3, -7), (4, 0)]
    """
    mantissa, *exponent = re.split("[Ee]", plain_number(text).replace(",", "."))
    whole, _, decimals = mantissa.lstrip("+-").partition(".")
    power = int(exponent[0]) if exponent else 0
    return len((whole + decimals).lstrip("0")), power - len(decimals)


# ---- heads


def _add_heads(rows: Rows, lines: Sequence[str], first: int, width: int, separator: str) -> None:
    """Put the heads above their columns, where they stand in a comment or are shifted."""
    above = [line for line in rows if line < first]
    if separator == " ":
        for line in above:
            heads = heads_by_blanks(lines[line - 1])
            if len(heads) in (width, width - 1):
                rows[line] = heads
    if not above or max(above) < first - 1:
        commented = commented_heads(lines, first, width, separator)
        rows |= dict([commented]) if commented else {}
    head = max((line for line in rows if line < first), default=None)
    counted = [cell_number(cells[0]) for line, cells in rows.items() if line >= first][:_LEAST]
    if head is not None and len(rows[head]) == width - 1 and _counts(counted):
        rows[head] = ["", *rows[head]]  # row numbers mostly have no head


def _counts(values: Sequence[float | None]) -> bool:
    """Whether some numbers count the rows."""
    known = [value for value in values if value is not None]
    return all(b - a == 1 for a, b in pairwise(known))


def _head_above(cells: Mapping[tuple[int, int], StoredCell], first: int, column: int) -> str:
    """The farthest text right above the numbers of a column; a unit may stand below it."""
    texts = []
    for line in range(first - 1, max(0, first - 6), -1):
        cell = cells.get((line, column))
        if cell is not None and isinstance(cell.value, str):
            texts.append(cell.value)
        elif texts:
            break
    return next((text for text in texts if not is_unit(text)), "")

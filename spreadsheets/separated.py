r"""Cells of a text file of separated values (CSV), as a spreadsheet would show them.

Cells are separated by commas, semicolons or tabs, whichever the first row has most of. A cell that
is a number in Python's spelling is one; where commas do not separate, a decimal comma is read, too.
All else is text. Row numbers are the lines of the file; rows that begin with `#` are left out.

>>> cells_of(b"t [s];x [um]\n0;0,05\n", 100)[2, 2]
0.05
"""

import csv
import math
import re
from collections.abc import Mapping

SUFFIXES = frozenset({".csv", ".tsv"})

_COMMA = re.compile(r"[-+]?\d+,\d+(?:[eE][-+]?\d+)?")


def cells_of(content: bytes, most: int) -> Mapping[tuple[int, int], float | str]:
    """Return the cells that are not empty, at most `most`, by line and column from 1.

    Raises ValueError if the content is not UTF-8 text, is not CSV, or has more cells.
    """
    try:
        lines = content.decode("utf-8-sig").splitlines(keepends=True)
    except UnicodeDecodeError as error:
        raise ValueError("is not UTF-8 text: save it as CSV in UTF-8") from error
    first = next((line for line in lines if line.strip() and line.lstrip()[0] != "#"), "")
    delimiter = max(",;\t", key=re.sub('"[^"]*"', "", first).count)
    reader = csv.reader(lines, delimiter=delimiter, skipinitialspace=True)
    cells: dict[tuple[int, int], float | str] = {}
    try:
        for row in reader:
            if row and row[0].startswith("#"):
                continue
            for column, text in enumerate(row, 1):
                if text.strip():
                    cells[reader.line_num, column] = _value(text.strip(), delimiter)
            if len(cells) > most:
                raise ValueError(f"has more than {most:,} cells")
    except csv.Error as error:
        raise ValueError(f"line {reader.line_num} is not CSV: {error}") from error
    return cells


def _value(text: str, delimiter: str) -> float | str:
    if delimiter != "," and _COMMA.fullmatch(text):
        text = text.replace(",", ".")
    if "_" in text or len(text) > 400:
        return text
    try:
        number = float(text)
    except ValueError:
        return text
    return number if math.isfinite(number) else text

"""Split formulas into words and references, as far as comparing two of them needs.

The text alone is read, from left to right, in one pass: nothing is looked up and nothing computed.
"""

import re
from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

from openpyxl.utils.cell import column_index_from_string

from spreadsheets.foreign import LAST_COLUMN, LAST_ROW, Position


class TextReference(NamedTuple):
    """The cells that a formula refers to; their sheet is "" if it names none.

    `fixed` has a letter for each end that a $ fixes: t(op), l(eft), b(ottom), r(ight).
    """

    sheet: str
    top: int
    left: int
    bottom: int
    right: int
    fixed: str

    @property
    def whole_columns(self) -> bool:
        """Whether it refers to whole columns, such as B:D."""
        return self.top == 1 and self.bottom == LAST_ROW

    @property
    def whole_rows(self) -> bool:
        """Whether it refers to whole rows, such as 2:4."""
        return self.left == 1 and self.right == LAST_COLUMN

    def seen_from(self, place: Position) -> "TextReference":
        """The cells that it means in a formula at a place, if it is written for cell A1."""
        sheet, row, column = place
        down, right = row - 1, column - 1
        return TextReference(
            self.sheet or sheet,
            self.top + down * ("t" not in self.fixed), self.left + right * ("l" not in self.fixed),
            self.bottom + down * ("b" not in self.fixed),
            self.right + right * ("r" not in self.fixed), self.fixed,
        )  # fmt: skip


Word = str | TextReference
"""A piece of a formula: a reference, or a word (an operator, a number, a name, a text)."""

_COLUMN, _ROW = r"(\$?)([A-Za-z]{1,3})", r"(\$?)([1-9][0-9]{0,6})"
_QUOTED = r"'(?:[^']|'')*+'?+"
_WORDS = re.compile(
    rf"""(?P<text>"(?:[^"]|"")*+"?+)
    |(?P<reference>(?:(?P<sheet>{_QUOTED}|[^\W\d][\w.]*+)!)?
      (?:{_COLUMN}{_ROW}(?::{_COLUMN}{_ROW})?|{_COLUMN}:{_COLUMN}|{_ROW}:{_ROW})(?![\w(.!\[]))
    |(?P<number>(?:[0-9]+\.?[0-9]*+|\.[0-9]++)(?:[Ee][-+]?[0-9]++)?)
    |(?P<error>\#[A-Z]++[A-Z/0]*+[!?]?)
    |(?P<name>{_QUOTED}|\[[^\[\]]*+\]?+|[^\W\d][\w.]*+)
    |(?P<blank>\s++)
    |(?P<sign>[<>]=|<>|.)""",
    re.VERBOSE | re.DOTALL,
)


@lru_cache(maxsize=64)
def words(formula: str) -> tuple[Word, ...]:
    """The words of a formula, written in one way, without blanks that mean nothing.

    >>> words("=abs( x ) * 2")
    ('=', 'ABS', '(', 'X', ')', '*', '2.0')
    >>> words("='my sheet'!$B$7/Yld1")[1:]
    (TextReference(sheet='my sheet', top=7, left=2, bottom=7, right=2, fixed='tlbr'), '/', 'YLD1')
    """
    return tuple(_formula_words(formula))


def _formula_words(formula: str) -> Iterator[Word]:
    last, blank = "", False
    for match in _WORDS.finditer(formula):
        kind, text = str(match.lastgroup), match[0]
        if match["reference"] is not None:
            kind = "reference"
        if kind == "blank":
            blank = True
            continue
        # A blank between two references is an operator: the cells that both have.
        if blank and last in ("reference", "name", ")") and kind in ("reference", "name"):
            yield " "
        blank, last = False, text if text == ")" else kind
        if kind == "reference":
            yield _reference(match) or text.upper()
        elif kind == "number":
            yield repr(float(text)) if len(text) < 300 else text
        else:
            yield text if kind == "text" else text.upper().removeprefix("_XLFN.")


def _reference(match: "re.Match[str]") -> TextReference | None:
    """The reference that a piece of a formula is; None if no sheet has such cells."""
    sheet = match["sheet"] or ""
    if sheet.startswith("'"):
        sheet = sheet[1:-1].replace("''", "'")
    ends = match.groups()[3:-5]  # of each end a $ and its text: a cell, columns, or rows
    cell, columns, rows = ends[:8], ends[8:12], ends[12:16]
    if cell[1]:
        l_, left, t_, top, r_, right, b_, bottom = cell
        if right is None:
            r_, right, b_, bottom = l_, left, t_, top
    elif columns[1]:
        l_, left, r_, right = columns
        t_, top, b_, bottom = "$", "1", "$", str(LAST_ROW)
    else:
        t_, top, b_, bottom = rows
        l_, left, r_, right = "$", "A", "$", "XFD"
    numbers = int(top), column_index_from_string(left), int(bottom), column_index_from_string(right)
    if max(numbers[::2]) > LAST_ROW or max(numbers[1::2]) > LAST_COLUMN:
        return None
    flags = zip((t_, l_, b_, r_), "tlbr", strict=True)
    return TextReference(sheet, *numbers, "".join(letter for dollar, letter in flags if dollar))


def outline(formula: str) -> str:
    """What is the same in formulas that do the same with other cells and numbers.

    >>> outline("=2*B7+$C$1"), outline("=#REF!*3+x")
    ('=n*@+@', '=@*n+X')
    """
    return _WORDS.sub(_outlined, formula)


def _outlined(match: "re.Match[str]") -> str:
    if match["reference"] or match["error"] == "#REF!":
        return "@"
    if match["number"]:
        return "n"
    return match[0] if match["text"] else match[0].strip().upper()

"""Write results as text: JSON and CSV with all digits, and rounded numbers and tables for reading.

Rounding never makes a proven range narrower.
"""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from itertools import zip_longest
from textwrap import fill, wrap
from typing import Any, NamedTuple

from reference.units import superscript, written


def json_text(record: Any) -> str:
    r"""Write a JSON document, floats with all digits; raise ValueError if one is not finite.

    >>> json_text({"depth": 1e-06})
    '{\n  "depth": 1e-06\n}\n'
    """
    import json

    import msgspec

    compact = json.dumps(msgspec.to_builtins(record), ensure_ascii=False, allow_nan=False)
    # A file name that is no UTF-8 holds lone surrogates, which are no text: they are spelled out.
    spelled = re.sub("[\ud800-\udfff]", lambda match: f"\\\\u{ord(match[0]):04x}", compact)
    return msgspec.json.format(spelled.encode(), indent=2).decode() + "\n"


def rows_csv(rows: Sequence[Mapping[str, Any]]) -> str:
    r"""Write records as CSV: floats with all digits, None as an empty field, bools in lower case.

    >>> rows_csv([{"depth": 1e-06, "beyond_radius": False, "gap": None}])
    'depth,beyond_radius,gap\n1e-06,false,\n'
    """
    import csv
    import io

    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(rows[0])
    for row in rows:
        writer.writerow(str(x).lower() if isinstance(x, bool) else x for x in row.values())
    return buffer.getvalue()


def number(value: float | Fraction, digits: int = 6) -> str:
    """Round a number to some significant digits.

    >>> number(7.669556888793411), number(3.5e9)
    ('7.66956', '3.5e+09')
    """
    return f"{float(value):.{digits}g}"


def with_error(value: float, error: float) -> str:
    """Write a value and its standard error, this to two digits, with as many decimals each.

    >>> with_error(1.12166, 0.0103), with_error(1234.5, 121.9), with_error(3.69806e12, 3.9e11)
    ('1.122 ± 0.010', '1230 ± 120', '(3.70 ± 0.39)×10¹²')
    >>> with_error(3.5, 1.2e-16)
    '3.5 ± 1.2e-16'
    """
    if not 0 < error < math.inf or error < 1e-9 * abs(value):
        return f"{number(value, 9)} ± {number(error, 2)}"
    power = int(f"{max(abs(value), error):e}".partition("e")[2])
    if not -4 <= power < 6:
        scale = 10.0**power
        return f"({with_error(value / scale, error / scale)})×10{superscript(str(power))}"
    decimals = 1 - int(f"{error:.1e}".partition("e")[2])
    shown = (f"{round(x, decimals):.{max(decimals, 0)}f}" for x in (value, error))
    return " ± ".join(shown)


def in_percent(share: float, digits: int = 3) -> str:
    """Write a share as per cent, rounded to some significant digits, without a power of ten.

    Only from a million per cent on, where nobody counts the zeros, there is one.

    >>> in_percent(5.9), in_percent(214.3), in_percent(0.01234), in_percent(3e7)
    ('590 %', '21400 %', '1.23 %', '3e+09 %')
    """
    text = number(100 * share, digits)
    is_long = "e+" in text and abs(share) < 1e4
    return f"{float(text):.0f} %" if is_long else f"{text} %"


def powers_of_ten(text: str) -> str:
    """Write the exponents in a text as powers of ten.

    >>> powers_of_ten("from 7.6e+09 to 1e-07")
    'from 7.6×10⁹ to 1×10⁻⁷'
    """
    return re.sub(r"(?<=\d)e([-+]\d+)", lambda match: f"×10{superscript(str(int(match[1])))}", text)


def with_unit(text: str, unit: str) -> str:
    """Append a unit as it is typed; the unit "1" adds nothing.

    >>> with_unit("7.67", "um"), with_unit("0.70", "1")
    ('7.67 um', '0.70')
    """
    return text if unit == "1" else f"{text} {unit}"


def quantity(text: str, unit: str) -> str:
    """Append a unit as it is printed; the unit "1" adds nothing.

    >>> quantity("7.67", "um"), quantity("0.70", "1")
    ('7.67 µm', '0.70')
    """
    return f"{text} {written(unit)}".strip()


def between(ends: Sequence[float | Fraction | None], digits: int = 10, inward: bool = False) -> str:
    """Write an interval with its ends rounded outward, or inward to stay inside the interval.

    An end within `_ROUNDOFF` of a short decimal number is written as that number.

    >>> between((0.12374472967338257, 0.13081477249718315))
    '0.1237447296 to 0.1308147725'
    >>> between((7839.582511570033, 7863.3048443432035), 8, inward=True)
    '7839.5826 to 7863.3048'
    >>> between((0.057999999999999996, 0.058))
    '0.058'
    """
    texts = []
    for end, is_up in zip(ends, (inward, not inward), strict=True):
        assert end is not None
        text = number(end + 0, digits)  # -0.0 + 0 is 0.0, so that a zero has no sign
        if abs(Fraction(text) - Fraction(end)) > _ROUNDOFF * abs(Fraction(end)):
            text = rounded(Fraction(end), digits, ROUND_CEILING if is_up else ROUND_FLOOR)
        texts.append(text)
    return " to ".join(dict.fromkeys(texts))


_ROUNDOFF = Fraction(1, 2**51)
"""The greatest relative difference between a double and the exact end it stands for: up to 2^-52
from rounding it to one side, and up to 2^-53 from converting it to another unit."""


def rounded(value: Fraction, digits: int, rounding: str) -> str:
    """Round a number to some significant digits; `rounding` is a mode of the module `decimal`.

    >>> rounded(Fraction(2, 3), 3, ROUND_FLOOR)
    '0.666'
    """
    context = Context(prec=digits, rounding=rounding)
    quotient = context.divide(Decimal(value.numerator), Decimal(value.denominator))
    return number(float(quotient), digits)


class Table(NamedTuple):
    """A table with its caption and column heads; the first cell of each row is the row's head."""

    caption: str
    heads: tuple[str, ...]
    rows: Sequence[tuple[str, ...]]


def aligned(
    rows: Sequence[tuple[str, ...]], widths: Sequence[int] = (), right: bool = False
) -> list[str]:
    """Write rows of texts as lines, with columns of these widths or as wide as their widest text.

    right: align all columns but the first to the right.

    >>> aligned([("a", "bc"), ("def", "g")])
    ['a    bc', 'def  g']
    """
    widths = widths or [max(map(len, column)) for column in zip(*rows, strict=True)]
    sides = ["<", *(">" if right else "<") * len(widths)]
    return ["  ".join(map("{:{}{}}".format, row, sides, widths)).rstrip() for row in rows]


def numbers(heads: tuple[str, ...], rows: Iterable[Iterable[float | None]]) -> list[str]:
    """Write numbers, to nine digits, as lines in columns under their heads; None is left blank.

    >>> numbers(("row", "x", "v"), [(0, 0.5, None), (1, 0.25, 40.0)])
    ['row     x   v', '0     0.5', '1    0.25  40']
    """
    texts = (tuple("" if x is None else number(x, 9) for x in row) for row in rows)
    return aligned([heads, *texts], right=True)


def prose(text: str, width: int, indent: str = "", hanging: str = "") -> str:
    """Wrap a text to lines of a width, between words only.

    indent and hanging: blanks before the first line, and before the others.

    >>> print(prose("slow, 1 m/s: refused", 10, hanging="  "))
    slow, 1
      m/s:
      refused
    """
    return fill(
        text, width, initial_indent=indent, subsequent_indent=hanging, break_on_hyphens=False,
        break_long_words=False,
    )  # fmt: skip


def columns(rows: Sequence[tuple[str, ...]], width: int) -> str:
    """Write rows in columns that together fit a width; cells that are too long are wrapped.

    Columns are narrowed one character at a time. Those that are wide only because of the first row,
    the heads, are narrowed first, then the widest. Words are broken only if nothing else is left.

    >>> print(columns([("a", "one two three"), ("bc", "four")], 14))
    a   one two
        three
    bc  four
    """
    texts = list(zip(*rows, strict=True))
    longest_words = [max(map(len, " ".join(cells).split() or [""])) for cells in texts]
    body_widths = [
        max([word, *map(len, cells[1:])]) for word, cells in zip(longest_words, texts, strict=True)
    ]
    widths = [max(map(len, cells)) for cells in texts]

    def readiness(k: int) -> tuple[bool, bool, int]:
        """How readily column k is narrowed."""
        return widths[k] > body_widths[k], widths[k] > longest_words[k], widths[k]

    while sum(widths) > width - 2 * (len(widths) - 1) and max(widths) > 1:
        widths[max(range(len(widths)), key=readiness)] -= 1
    lines = []
    for row in rows:
        cells = [
            wrap(cell, max(w, 1), break_on_hyphens=False)
            for cell, w in zip(row, widths, strict=True)
        ]
        lines += aligned([*zip_longest(*cells, fillvalue="")], widths) or [""]
    return "\n".join(lines)


def table_text(table: Table, width: int) -> str:
    """Write a table, without its caption, so that it fits a width and no word of it is broken.

    Where the words are too long for columns side by side, each row becomes a list: one line for
    each cell, with the head of its column before it.

    >>> print(table_text(Table("", ("what", "id"), [("depth", "depth-beta-5")]), 18))
    what  depth
    id    depth-beta-5
    """
    rows = [table.heads, *table.rows]
    longest = [max(len(word) for cell in cells for word in [*cell.split(), ""])
               for cells in zip(*rows, strict=True)]  # fmt: skip
    if sum(longest) + 2 * (len(longest) - 1) <= width:
        return columns(rows, width)
    lists = (
        columns([pair for pair in zip(table.heads, row, strict=True) if pair[1]], width)
        for row in table.rows
    )
    return "\n\n".join(lists)

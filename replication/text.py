"""Results as text: JSON and CSV with every digit; shortened numbers and tables for reading.

A proven range never becomes narrower by being shortened.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from itertools import zip_longest
from textwrap import wrap
from typing import Any, NamedTuple

from reference.units import superscript, written


def json_text(record: Any) -> str:
    r"""One JSON document, every float with all its digits; ValueError for one that is not finite.

    >>> json_text({"depth": 1e-06})
    '{\n  "depth": 1e-06\n}\n'
    """
    import json

    import msgspec

    compact = json.dumps(msgspec.to_builtins(record), ensure_ascii=False, allow_nan=False)
    # A file's name may hold what no encoding has; escaped, it is JSON again.
    return msgspec.json.format(compact.encode(errors="backslashreplace"), indent=2).decode() + "\n"


def rows_csv(rows: Sequence[Mapping[str, Any]]) -> str:
    r"""Records as CSV; floats keep all digits, None is an empty field, truth is true or false.

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
    """A number for reading, to some significant digits.

    >>> number(7.669556888793411), number(3.5e9)
    ('7.66956', '3.5e+09')
    """
    return f"{float(value):.{digits}g}"


def powers_of_ten(text: str) -> str:
    """Numbers in a text with their powers of ten written out.

    >>> powers_of_ten("from 7.6e+09 to 1e-07")
    'from 7.6×10⁹ to 1×10⁻⁷'
    """
    return re.sub(r"(?<=\d)e([-+]\d+)", lambda power: f"×10{superscript(str(int(power[1])))}", text)


def with_unit(text: str, unit: str) -> str:
    """Text followed by its unit, if it has one.

    >>> with_unit("7.67", "um"), with_unit("0.70", "1")
    ('7.67 um', '0.70')
    """
    return text if unit == "1" else f"{text} {unit}"


def quantity(text: str, unit: str) -> str:
    """Text with its unit, as a page shows it.

    >>> quantity("7.67", "um"), quantity("0.70", "1")
    ('7.67 µm', '0.70')
    """
    return f"{text} {written(unit)}".strip()


def between(ends: Sequence[float | Fraction | None], digits: int = 10, inward: bool = False) -> str:
    """An interval as words, its ends rounded outward; or inward, so that all between lies inside.

    An end that is a short decimal number but for the rounding of doubles is shown as that number.

    >>> between((0.12374472967338257, 0.13081477249718315))
    '0.1237447296 to 0.1308147725'
    >>> between((7839.582511570033, 7863.3048443432035), 8, inward=True)
    '7839.5826 to 7863.3048'
    >>> between((0.057999999999999996, 0.058))
    '0.058'
    """
    shown = []
    for end, up in zip(ends, (inward, not inward), strict=True):
        assert end is not None
        text = number(end + 0, digits)  # no sign on a zero
        if abs(Fraction(text) - Fraction(end)) > _OFF * abs(Fraction(end)):
            text = rounded(Fraction(end), digits, ROUND_CEILING if up else ROUND_FLOOR)
        shown.append(text)
    return " to ".join(dict.fromkeys(shown))


_OFF = Fraction(1, 2**51)
"""By how much of itself a double may be off the exact end that it stands for: one that was rounded
to a side by up to 2^-52, and in another unit by 2^-53 more."""


def rounded(value: Fraction, digits: int, rounding: str) -> str:
    """A number to some significant digits, rounded as one of the modes of `decimal` says.

    >>> rounded(Fraction(2, 3), 3, ROUND_FLOOR)
    '0.666'
    """
    context = Context(prec=digits, rounding=rounding)
    shortened = context.divide(Decimal(value.numerator), Decimal(value.denominator))
    return f"{float(shortened):.{digits}g}"


class Table(NamedTuple):
    """A table; the first cell of a row is its head."""

    caption: str
    heads: tuple[str, ...]
    rows: Sequence[tuple[str, ...]]


def aligned(
    rows: Sequence[tuple[str, ...]], widths: Sequence[int] = (), right: bool = False
) -> list[str]:
    """Rows of texts as lines, each column as wide as its widest text if no widths are given.

    `right`: all columns but the first stand to the right.

    >>> aligned([("a", "bc"), ("def", "g")])
    ['a    bc', 'def  g']
    """
    widths = widths or [max(map(len, column)) for column in zip(*rows, strict=True)]
    ways = ["<", *(">" if right else "<") * len(widths)]
    return ["  ".join(map("{:{}{}}".format, row, ways, widths)).rstrip() for row in rows]


def numbers(heads: tuple[str, ...], rows: Iterable[Iterable[float | None]]) -> list[str]:
    """Numbers to nine digits as lines, in columns under their heads.

    >>> numbers(("row", "x", "v"), [(0, 0.5, None), (1, 0.25, 40.0)])
    ['row     x   v', '0     0.5', '1    0.25  40']
    """
    texts = (tuple("" if x is None else number(x, 9) for x in row) for row in rows)
    return aligned([heads, *texts], right=True)


def columns(rows: Sequence[tuple[str, ...]], width: int) -> str:
    """Rows as columns within a width; what is too long goes on in the next line.

    Heads give way first, then the widest column; words only where nothing else is left.

    >>> print(columns([("a", "one two three"), ("bc", "four")], 14))
    a   one two
        three
    bc  four
    """
    texts = list(zip(*rows, strict=True))
    words = [max(len(word) for cell in column for word in cell.split() or [""]) for column in texts]
    below = [max([word, *map(len, cells[1:])]) for word, cells in zip(words, texts, strict=True)]
    widths, room = [max(map(len, column)) for column in texts], width - 2 * (len(texts) - 1)

    def ease(k: int) -> tuple[bool, bool, int]:
        """How readily a column gives way."""
        return widths[k] > below[k], widths[k] > words[k], widths[k]

    while sum(widths) > room and max(widths) > 1:
        widest = max(range(len(widths)), key=ease)
        widths[widest] -= 1
    lines = []
    for row in rows:
        cells = [
            wrap(cell, w or 1, break_on_hyphens=False) for cell, w in zip(row, widths, strict=True)
        ]
        lines += aligned([*zip_longest(*cells, fillvalue="")], widths) or [""]
    return "\n".join(lines)

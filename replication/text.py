"""Numbers as text for reading: shortened, but never so that a proven range becomes narrower."""

import re
from collections.abc import Sequence
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction

from reference.units import superscript


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


def outward(low: Fraction, high: Fraction, digits: int = 6) -> str:
    """An interval shortened to some significant digits, never made narrower.

    Ends that are the same double are shown as one number.

    >>> outward(Fraction(1, 3), Fraction(2, 3), 3)
    '[0.333, 0.667]'
    """
    if float(low) == float(high):
        return number(low, digits)
    return f"[{rounded(low, digits, ROUND_FLOOR)}, {rounded(high, digits, ROUND_CEILING)}]"


def inward(low: Fraction, high: Fraction, digits: int = 6) -> str:
    """An interval shortened to some significant digits, never made wider.

    >>> inward(Fraction(1, 3), Fraction(2, 3), 3)
    '[0.334, 0.666]'
    """
    return f"[{rounded(low, digits, ROUND_CEILING)}, {rounded(high, digits, ROUND_FLOOR)}]"


def rounded(value: Fraction, digits: int, rounding: str) -> str:
    """A number to some significant digits, rounded as one of the modes of `decimal` says.

    >>> rounded(Fraction(2, 3), 3, ROUND_FLOOR)
    '0.666'
    """
    context = Context(prec=digits, rounding=rounding)
    shortened = context.divide(Decimal(value.numerator), Decimal(value.denominator))
    return f"{float(shortened):.{digits}g}"


def aligned(rows: Sequence[tuple[str, ...]]) -> list[str]:
    """Rows of texts as lines, each column as wide as its widest text.

    >>> aligned([("a", "bc"), ("def", "g")])
    ['a    bc', 'def  g']
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    padded = (zip(row, widths, strict=True) for row in rows)
    return ["  ".join(f"{text:{width}}" for text, width in row).rstrip() for row in padded]

"""Printed text: the exact interval of the values that print like it, and where it stands.

A printed number is text: "7.67" stands for every value from 7.665 up to 7.675, "700" for one to
three significant digits. All arithmetic is rational; no binary float is involved. How a value
becomes text is a convention (`Rounding`); fractions ("7/3") and number words ("three") are exact.
"""

import re
from decimal import Context, Decimal, Inexact
from enum import Enum
from fractions import Fraction
from functools import cache, cached_property, lru_cache
from math import inf

import msgspec


class Rounding(Enum):
    """How a value becomes printed text; the ends of the interval follow from it."""

    AWAY = "to nearest, ties away from zero"
    EVEN = "to nearest, ties to even"
    CUT = "cut off"


class Interval(msgspec.Struct, frozen=True, dict=True):
    """An interval of rationals; an end that is None is infinite.

    Raises ValueError if it is empty.

    >>> print(Interval(Fraction("7.665"), Fraction("7.675"), upper_closed=False))
    [7.665, 7.675)
    """

    lower: Fraction | None
    upper: Fraction | None
    lower_closed: bool = True
    upper_closed: bool = True

    def __post_init__(self) -> None:
        if self._starts > self._stops:
            raise ValueError(f"the interval from {self.lower} to {self.upper} is empty")

    @cached_property
    def _starts(self) -> tuple[Fraction | float, int]:
        """Where it starts, for comparisons: an open end lies a little further in."""
        return (-inf if self.lower is None else self.lower), 1 - self.lower_closed

    @cached_property
    def _stops(self) -> tuple[Fraction | float, int]:
        return (inf if self.upper is None else self.upper), self.upper_closed - 1

    @classmethod
    def point(cls, value: Fraction) -> "Interval":
        """The interval of one value."""
        return cls(value, value)

    @property
    def is_point(self) -> bool:
        """Whether it holds one value only."""
        return self.lower is not None and self.lower == self.upper

    @property
    def ends(self) -> tuple[Fraction, Fraction]:
        """The lower and the upper end. Raises ValueError where one is infinite."""
        if self.lower is None or self.upper is None:
            raise ValueError(f"{self} has no end on one side")
        return self.lower, self.upper

    def contains(self, value: Fraction) -> bool:
        """Whether the value lies inside; an open end does not belong to the interval."""
        return self.encloses(value, value)

    def encloses(self, lower: Fraction, upper: Fraction) -> bool:
        """Whether every value from lower to upper lies inside."""
        return self._starts <= (lower, 0) and (upper, 0) <= self._stops

    def excludes(self, lower: Fraction, upper: Fraction) -> bool:
        """Whether no value from lower to upper lies inside."""
        return (upper, 0) < self._starts or self._stops < (lower, 0)

    def decides(self, lower: Fraction, upper: Fraction) -> bool:
        """Whether all values from lower to upper lie inside, or none."""
        return self.encloses(lower, upper) or self.excludes(lower, upper)

    def meets(self, another: "Interval") -> bool:
        """Whether some value lies in both."""
        return self._starts <= another._stops and another._starts <= self._stops

    def scaled(self, factor: Fraction) -> "Interval":
        """The interval times a positive factor (a change of unit)."""
        lower = None if self.lower is None else self.lower * factor
        upper = None if self.upper is None else self.upper * factor
        return Interval(lower, upper, self.lower_closed, self.upper_closed)

    def __str__(self) -> str:
        if self.is_point and self.lower is not None:
            return decimal_text(self.lower)
        left = "(-inf" if self.lower is None else "(["[self.lower_closed] + decimal_text(self.lower)
        right = "inf)" if self.upper is None else decimal_text(self.upper) + ")]"[self.upper_closed]
        return f"{left}, {right}"


def decimal_text(value: Fraction) -> str:
    """A rational as a decimal where that ends, else as a fraction.

    >>> decimal_text(Fraction(3115, 1000) * 10**8), decimal_text(Fraction(1, 3))
    ('3.115E+8', '1/3')
    """
    digits = len(str(abs(value.numerator))) + 4 * len(str(value.denominator))
    context = Context(prec=digits, traps=[Inexact])
    try:
        exact = context.divide(Decimal(value.numerator), Decimal(value.denominator))
    except Inexact:
        return str(value)
    exact = exact.normalize(context)
    return f"{exact:f}" if -5 <= exact.adjusted() < 6 else f"{exact:E}"


class Printed(msgspec.Struct, frozen=True):
    """A printed number: its text, the value that the text spells, the place of its last digit.

    `quanta` are the units that the last significant digit may have: one where the text is decimal,
    several where an integer ends in zeros, 0 for exact text. `floating` says that the digits
    before an exponent were counted, as in "1.00E+03", and not the decimals.
    """

    text: str
    value: Fraction
    quanta: tuple[Fraction, ...] = (Fraction(0),)
    floating: bool = False

    @property
    def quantum(self) -> Fraction:
        """Unit of the last printed digit, all digits taken as significant; 0 if exact."""
        return self.quanta[0]

    def interval(
        self, rounding: Rounding = Rounding.AWAY, quantum: Fraction | None = None
    ) -> Interval:
        """The values that print like this, for a rounding rule and a place of the last digit.

        >>> print(parse("700").interval(), parse("700").interval(quantum=Fraction(100)))
        [699.5, 700.5) [650, 750)
        >>> print(parse("100").interval(quantum=Fraction(100)), parse("1.0E+02").interval())
        [95, 150) [99.5, 105)
        >>> print(parse("7.67").interval(Rounding.EVEN), parse("7.67").interval(Rounding.CUT))
        (7.665, 7.675) [7.67, 7.68)
        """
        quantum = self.quantum if quantum is None else quantum
        if quantum == 0:
            return Interval.point(self.value)
        size = abs(self.value)
        if rounding is Rounding.CUT:
            low, high, low_closed, high_closed = size, size + quantum, True, False
        else:
            # Just below a power of ten, digits that are counted stand ten times closer.
            counted = self.floating or (self.quantum and quantum != self.quantum)
            closer = counted and re.fullmatch("10*", str(size / quantum))
            below = quantum / 10 if closer else quantum
            low, high = size - below / 2, size + quantum / 2
            even = size / quantum % 2 == 0
            # Below a power of ten the neighbor ends in 9, which is odd.
            low_closed = rounding is Rounding.AWAY or even or below != quantum
            high_closed = rounding is Rounding.EVEN and even
        if self.value == 0:
            return Interval(-high, high, high_closed, high_closed)
        if self.value < 0:
            return Interval(-high, -low, high_closed, low_closed)
        return Interval(low, high, low_closed, high_closed)

    def about(self) -> Interval:
        """The values that an author may call "about" this: the fewest digits the text allows.

        Exact text stands for the values that are nearer to it than to its neighbors among the
        whole numbers, or among the unit fractions. Raises ValueError for any other fraction.

        >>> print(parse("700").about(), parse("third").about(), parse("twice").about())
        [650, 750) [7/24, 5/12] [1.5, 2.5)
        """
        if self.quantum or self.value == 0:
            return self.interval(quantum=self.quanta[-1])
        whole, parts = self.value.as_integer_ratio()
        if parts == 1:
            return self.interval(quantum=Fraction(1))
        if whole != 1:
            raise ValueError(f"{self.text!r} is no whole number and no unit fraction")
        below, above = (Fraction(1, n) for n in (parts + 1, parts - 1))
        return Interval((below + self.value) / 2, (self.value + above) / 2)


_WORDS = {
    "one": "1", "two": "2", "three": "3", "four": "4", "five": "5", "twice": "2", "thrice": "3",
    "several times": "2",  # in a bound: more than two
    "half": "1/2", "third": "1/3", "one-fifth": "1/5", "one-sixth": "1/6",
}  # fmt: skip
_TEN = r"10\^(?P<power>[-+]?\d{1,4}|\{[-+]?\d{1,4}\})"
_DECIMAL = re.compile(
    r"(?P<sign>[-+]?)(?P<whole>\d{1,3}(?:,\d{3})+|\d+)(?:[.·](?P<part>\d+))?"
    rf"(?:[Ee](?P<e>[-+]?\d{{1,4}})|\s*(?:×|x|\\times)\s*{_TEN})?"
)
_FRACTION = re.compile(r"(\d+)/([1-9]\d*)|\\frac\{(\d+)\}\{([1-9]\d*)\}")


@lru_cache(4096)
def parse(text: str) -> Printed:
    """Read one printed number.

    Decimals ("7.67", "5,575", "8·9"), exponents ("3.11E+08", "9.13 × 10^9"), a leading "~" (taken
    as its number, at its fewest digits by the ledger), powers of ten ("10^7"), fractions ("7/3")
    and number words ("three"), the last three exact. Raises ValueError for anything else.

    >>> parse("3.11E+08").interval().upper
    Fraction(311500000, 1)
    >>> [str(parse("9.13 × 10^9").interval()), str(parse("10.0").interval())]
    ['[9.125E+9, 9.135E+9)', '[9.95, 10.05)']
    """
    bare = text.strip().removeprefix("~").strip()
    if word := _WORDS.get(bare.lower()):
        return Printed(text, Fraction(word))
    if match := _FRACTION.fullmatch(bare):
        return Printed(text, Fraction(*(int(part) for part in match.groups() if part)))
    if match := re.fullmatch(_TEN, bare):
        return Printed(text, Fraction(10) ** int(match["power"].strip("{}")))
    match = _DECIMAL.fullmatch(bare)
    if match is None:
        raise ValueError(f"cannot read {text!r} as a printed number")
    whole, part = match["whole"].replace(",", ""), match["part"] or ""
    exponent = int((match["e"] or match["power"] or "0").strip("{}"))
    scale = Fraction(10) ** (exponent - len(part))
    value = int(match["sign"] + whole + part) * scale
    floating = match["e"] is not None or match["power"] is not None
    digits = "" if part or floating else whole.lstrip("0")
    zeros = len(digits) - len(digits.rstrip("0"))
    return Printed(text, value, tuple(scale * 10**n for n in range(zeros + 1)), floating)


class Place(msgspec.Struct, frozen=True):
    """Where something stands: characters and line of the text, section, equation, table cell."""

    start: int = 0
    end: int = 0
    line: int = 0
    section: str = ""
    equation: str | None = None
    cell: str | None = None

    def __str__(self) -> str:
        if self.cell:
            return f"Table A-1, cell {self.cell}"
        where = f"{self.section}, line {self.line}"
        return f"{where}, Eq. {self.equation}" if self.equation else where


def place_of(text: str, quote: str, cell: str | None = None) -> Place:
    """Where the marked words of a quote stand. Raises ValueError unless they stand there once."""
    before, marked, after = re.split("[⟦⟧]", quote)
    words = before + marked + after
    if (times := text.count(words)) != 1:
        raise ValueError(f"the report has {words!r} {times} times, not once")
    start = text.index(words) + len(before)
    section = next(name for at, name in reversed(_sections(text)) if at <= start)
    equation = next((name for at, end, name in _displays(text) if at <= start < end), None)
    line = text.count("\n", 0, start) + 1
    return Place(start, start + len(marked), line, section, equation, cell)


@cache
def _sections(text: str) -> list[tuple[int, str]]:
    """Where the parts of the report begin, and what they are called."""
    headings = re.finditer(r"(?m)^ ?(?:\d+\. (ABSTRACT)|(\d)\. [A-Z]|(Appendix)\.)", text)
    named = ((h.start(), f"section {h[2]}" if h[2] else (h[1] or h[3]).lower()) for h in headings)
    return [(0, "title"), *named]


@cache
def _displays(text: str) -> list[tuple[int, int, str]]:
    """Where the numbered equations stand, and their numbers."""
    numbered = r"\$\$(?:(?!\$\$).)*?\\quad \((?:\\text\{)?([-A\d]+)\}?\)"
    return [(*match.span(), match[1]) for match in re.finditer(numbered, text, re.DOTALL)]

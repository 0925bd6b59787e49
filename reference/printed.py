"""Printed numbers: the exact interval of the values that print as a text, and its place.

A printed number is a text: "7.67" stands for every value from 7.665 up to 7.675, and "700" may have
one, two or three significant digits. All arithmetic is rational; no binary float is involved.
`Rounding` is the rule by which a value becomes text. Fractions ("7/3"), number words ("three") and
powers of ten ("10^7") are exact.
"""

import re
from decimal import Context, Decimal, Inexact
from enum import Enum
from fractions import Fraction
from functools import cache, cached_property, lru_cache
from math import inf

import msgspec


class Rounding(Enum):
    """The rule by which a value is rounded to the printed text."""

    AWAY = "to nearest, ties away from zero"
    EVEN = "to nearest, ties to even"
    CUT = "cut off"


class Interval(msgspec.Struct, frozen=True, dict=True):
    """A non-empty interval of rational numbers; an end that is None is infinite.

    Raises ValueError if it would be empty.

    >>> print(Interval(Fraction("7.665"), Fraction("7.675"), upper_closed=False))
    [7.665, 7.675)
    """

    lower: Fraction | None
    upper: Fraction | None
    lower_closed: bool = True
    upper_closed: bool = True

    def __post_init__(self) -> None:
        if self._lower_key > self._upper_key:
            raise ValueError(f"the interval from {self.lower} to {self.upper} is empty")

    @cached_property
    def _lower_key(self) -> tuple[Fraction | float, int]:
        """The lower end as a key to compare with (value, 0): an open end ranks just inside."""
        return (-inf if self.lower is None else self.lower), 1 - self.lower_closed

    @cached_property
    def _upper_key(self) -> tuple[Fraction | float, int]:
        """The upper end, likewise."""
        return (inf if self.upper is None else self.upper), self.upper_closed - 1

    @classmethod
    def point(cls, value: Fraction) -> "Interval":
        """Return the interval that contains a single value."""
        return cls(value, value)

    @property
    def is_point(self) -> bool:
        """Whether the interval contains a single value."""
        return self.lower is not None and self.lower == self.upper

    @property
    def ends(self) -> tuple[Fraction, Fraction]:
        """The lower and the upper end. Raises ValueError if either is infinite."""
        if self.lower is None or self.upper is None:
            raise ValueError(f"{self} has no end on one side")
        return self.lower, self.upper

    def contains(self, value: Fraction) -> bool:
        """Return whether a value lies in the interval; an open end does not."""
        return self.encloses(value, value)

    def encloses(self, lower: Fraction, upper: Fraction) -> bool:
        """Return whether every value from lower to upper lies in the interval."""
        return self._lower_key <= (lower, 0) and (upper, 0) <= self._upper_key

    def excludes(self, lower: Fraction, upper: Fraction) -> bool:
        """Return whether no value from lower to upper lies in the interval."""
        return (upper, 0) < self._lower_key or self._upper_key < (lower, 0)

    def decides(self, lower: Fraction, upper: Fraction) -> bool:
        """Return whether all values from lower to upper lie in the interval, or none does."""
        return self.encloses(lower, upper) or self.excludes(lower, upper)

    def meets(self, another: "Interval") -> bool:
        """Return whether the two intervals have a value in common."""
        return self._lower_key <= another._upper_key and another._lower_key <= self._upper_key

    def scaled(self, factor: Fraction) -> "Interval":
        """Return the interval times a positive factor, as for a change of unit."""
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
    """Return a rational number as a decimal if that terminates, and otherwise as a fraction.

    >>> decimal_text(Fraction(3115, 1000) * 10**8), decimal_text(Fraction(1, 3))
    ('3.115E+8', '1/3')
    """
    # If p/q terminates, q divides 10^n, n <= log2(q): p/q has no more digits than p and n.
    digits = len(str(abs(value.numerator))) + 4 * len(str(value.denominator))
    context = Context(prec=digits, traps=[Inexact])
    try:
        exact = context.divide(Decimal(value.numerator), Decimal(value.denominator))
    except Inexact:
        return str(value)
    exact = exact.normalize(context)
    return f"{exact:f}" if -5 <= exact.adjusted() < 6 else f"{exact:E}"


class Printed(msgspec.Struct, frozen=True):
    """A printed number: its text, the value of that text, and the place of its last digit.

    `quanta` are the possible units of the last significant digit: several for an integer that ends
    in zeros, otherwise one, which is 0 for an exact text. `floating` says that the author fixed the
    number of significant digits, as in "1.00E+03", not the number of decimals.
    """

    text: str
    value: Fraction
    quanta: tuple[Fraction, ...] = (Fraction(0),)
    floating: bool = False

    @property
    def quantum(self) -> Fraction:
        """The unit of the last printed digit, taken as significant; 0 for an exact text."""
        return self.quanta[0]

    def interval(
        self, rounding: Rounding = Rounding.AWAY, quantum: Fraction | None = None
    ) -> Interval:
        """Return the values that a rounding rule prints as this text.

        `quantum` is the unit of the last significant digit, by default that of the last digit.

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
            # With a fixed number of significant digits, the numbers that can be printed lie ten
            # times closer together below a power of ten than above it.
            digits_are_fixed = self.floating or (self.quantum and quantum != self.quantum)
            closer = digits_are_fixed and re.fullmatch("10*", str(size / quantum))
            below = quantum / 10 if closer else quantum
            low, high = size - below / 2, size + quantum / 2
            even = size / quantum % 2 == 0
            # The neighbor below a power of ten ends in 9, which is odd: a tie goes to the power.
            low_closed = rounding is Rounding.AWAY or even or below != quantum
            high_closed = rounding is Rounding.EVEN and even
        if self.value == 0:
            return Interval(-high, high, high_closed, high_closed)
        if self.value < 0:
            return Interval(-high, -low, high_closed, low_closed)
        return Interval(low, high, low_closed, high_closed)

    def about(self) -> Interval:
        """Return the values of which an author may say "about" this number.

        They are those that round to it at the fewest significant digits that the text allows. For
        an exact text they are those closer to it than to the next whole numbers, or to the
        next unit fractions. Raises ValueError for any other fraction.

        >>> print(parse("700").about(), parse("third").about(), parse("twice").about())
        [650, 750) [7/24, 5/12] [1.5, 2.5)
        """
        if self.quantum or self.value == 0:
            return self.interval(quantum=self.quanta[-1])
        whole, parts = self.value.as_integer_ratio()
        if parts == 1:
            return self.interval(quantum=Fraction(1))
        if whole != 1:
            raise ValueError(f"{self.text!r} is neither a whole number nor a unit fraction")
        below, above = (Fraction(1, n) for n in (parts + 1, parts - 1))
        return Interval((below + self.value) / 2, (self.value + above) / 2)


_WORDS = {
    "one": "1", "two": "2", "three": "3", "four": "4", "five": "5", "twice": "2", "thrice": "3",
    "several times": "2",  # in a bound: more than two
    "half": "1/2", "third": "1/3", "one-fifth": "1/5", "one-sixth": "1/6",
}  # fmt: skip
_TEN = r"10\^(?P<power>[-+]?\d{1,4}|\{[-+]?\d{1,4}\})"
_DECIMAL = re.compile(
    r"(?P<sign>[-+]?)(?=[.·]?\d)(?P<whole>\d{1,3}(?:,\d{3})+|\d*)(?:[.·](?P<decimals>\d*))?"
    rf"(?:[Ee](?P<e>[-+]?\d{{1,4}})|\s*(?:[×x*·]|\\times|\\cdot)\s*{_TEN})?(?P<percent>\s*\\?%)?"
)
_RAISED = re.compile("[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+")
_LOWERED = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "+-0123456789")
_FRACTION = re.compile(r"(\d+)/([1-9]\d*)|\\frac\{(\d+)\}\{([1-9]\d*)\}")


def in_ascii(number: str) -> str:
    """Return a number's text with a hyphen for the minus sign and "^" for raised digits.

    >>> in_ascii("\N{MINUS SIGN}7.6×10⁻⁹")
    '-7.6×10^-9'
    """
    raised = _RAISED.sub(lambda power: "^" + power[0].translate(_LOWERED), number)
    return raised.replace("\N{MINUS SIGN}", "-")


@lru_cache(4096)
def parse(text: str) -> Printed:
    """Read one printed number. Raises ValueError for any other text.

    It may be a decimal ("7.67", "5,575", "8·9", ".278", "5."), have an exponent ("3.11E+08",
    "9.13 × 10^9", "7.6×10⁹") or a percent sign ("16 %" is 0.16). Either minus sign is read.
    Powers of ten ("10^7"), fractions ("7/3") and number words ("three") are read as exact. A
    leading "~" is ignored, as the kind of such a claim says that it is an approximation.

    >>> parse("3.11E+08").interval().upper
    Fraction(311500000, 1)
    >>> [str(parse("9.13 × 10^9").interval()), str(parse("10.0").interval())]
    ['[9.125E+9, 9.135E+9)', '[9.95, 10.05)']
    >>> [str(parse(text).interval()) for text in (".278", "16 %", "7.6×10⁹")]
    ['[0.2775, 0.2785)', '[0.155, 0.165)', '[7.55E+9, 7.65E+9)']
    """
    bare = in_ascii(text.strip().removeprefix("~").strip())
    if word := _WORDS.get(bare.lower()):
        return Printed(text, Fraction(word))
    if match := _FRACTION.fullmatch(bare):
        return Printed(text, Fraction(*(int(part) for part in match.groups() if part)))
    if match := re.fullmatch(_TEN, bare):
        return Printed(text, Fraction(10) ** int(match["power"].strip("{}")))
    match = _DECIMAL.fullmatch(bare)
    if match is None:
        raise ValueError(f"cannot read {text!r} as a printed number")
    whole, decimals = match["whole"].replace(",", ""), match["decimals"] or ""
    exponent = int((match["e"] or match["power"] or "0").strip("{}"))
    scale = Fraction(10) ** (exponent - len(decimals) - (2 if match["percent"] else 0))
    value = int(match["sign"] + whole + decimals) * scale
    floating = match["e"] is not None or match["power"] is not None
    # A decimal point says that the zeros before it are significant, as in "700.".
    digits = "" if match["decimals"] is not None or floating else whole.lstrip("0")
    zeros = len(digits) - len(digits.rstrip("0"))
    return Printed(text, value, tuple(scale * 10**n for n in range(zeros + 1)), floating)


class Place(msgspec.Struct, frozen=True):
    """A place in the report: characters of its text, line, section, equation and table cell."""

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
    """Return where a quote's words in ⟦⟧ stand. Raises ValueError unless it occurs once."""
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
    """Return where each section of the report begins, and its name."""
    headings = re.finditer(r"(?m)^ ?(?:\d+\. (ABSTRACT)|(\d)\. [A-Z]|(Appendix)\.)", text)
    named = ((h.start(), f"section {h[2]}" if h[2] else (h[1] or h[3]).lower()) for h in headings)
    return [(0, "title"), *named]


@cache
def _displays(text: str) -> list[tuple[int, int, str]]:
    """Return where each numbered equation begins and ends, and its number."""
    numbered = r"\$\$(?:(?!\$\$).)*?\\quad \((?:\\text\{)?([-A\d]+)\}?\)"
    return [(*match.span(), match[1]) for match in re.finditer(numbered, text, re.DOTALL)]

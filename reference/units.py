"""Units of measurement, converted in exact rational arithmetic.

A unit is a product or a quotient of the units listed here with small integer powers, such as
"kg/m^3" or "m s^-1"; no other unit is accepted. The factors are `Fraction`s, so that a conversion
never rounds: an inch is 254/10000 m, and a pound-force 0.45359237 * 9.80665 N.
"""

import re
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from fractions import Fraction
from functools import cache

import msgspec


class UnitError(ValueError):
    """The unit is unknown, or it measures another kind of quantity than the one required."""


class DimensionError(ValueError):
    """Quantities of different dimensions are added, or the logarithm of a dimension is taken."""


class Dimension(msgspec.Struct, frozen=True):
    """The dimension of a physical quantity, as powers of kilogram, metre and second."""

    powers: tuple[Fraction, ...] = (Fraction(0), Fraction(0), Fraction(0))

    def __neg__(self) -> "Dimension":
        return self

    def __add__(self, other: "Dimension") -> "Dimension":
        if other != self:
            raise DimensionError(f"{self} and {other} are added")
        return self

    def __mul__(self, other: "Dimension") -> "Dimension":
        pairs = zip(self.powers, other.powers, strict=True)
        return Dimension(tuple(a + b for a, b in pairs))

    def __truediv__(self, other: "Dimension") -> "Dimension":
        return self * other**-1

    def __pow__(self, exponent: Fraction | int) -> "Dimension":
        return Dimension(tuple(power * exponent for power in self.powers))

    def __str__(self) -> str:
        units = zip(("kg", "m", "s"), self.powers, strict=True)
        shown = (unit if power == 1 else f"{unit}^{power}" for unit, power in units if power)
        return " ".join(shown) or "a pure number"


_POUND, _GRAVITY, _INCH = Fraction("0.45359237"), Fraction("9.80665"), Fraction("0.0254")
_NUMBER = Dimension()
_MASS, _LENGTH, _TIME = (
    Dimension(tuple(map(Fraction, powers))) for powers in ((1, 0, 0), (0, 1, 0), (0, 0, 1))
)
_FORCE = _MASS * _LENGTH / _TIME**2
_PRESSURE = _FORCE / _LENGTH**2
_BASES: dict[str, tuple[Fraction, Dimension, str]] = {
    # names: factor to SI, dimension, the metric prefixes that they accept
    "1": (Fraction(1), _NUMBER, ""),
    "percent %": (Fraction(1, 100), _NUMBER, ""),
    "g": (Fraction(1, 1000), _MASS, "n u m k"),
    "lb": (_POUND, _MASS, ""),
    "m": (Fraction(1), _LENGTH, "n u m c k"),
    "in inch": (_INCH, _LENGTH, ""),
    "mil thou": (_INCH / 1000, _LENGTH, ""),
    "ft": (12 * _INCH, _LENGTH, ""),
    "cc": (Fraction(1, 10**6), _LENGTH**3, ""),
    "s": (Fraction(1), _TIME, "p n u m"),
    "N": (Fraction(1), _FORCE, "m k"),
    "dyn": (Fraction(1, 10**5), _FORCE, ""),
    "gf": (_GRAVITY / 1000, _FORCE, "k"),
    "gram_force": (_GRAVITY / 1000, _FORCE, ""),
    "lbf": (_POUND * _GRAVITY, _FORCE, ""),
    "Pa": (Fraction(1), _PRESSURE, "k M G"),
    "bar": (Fraction(10**5), _PRESSURE, "k M"),
    "psi": (_POUND * _GRAVITY / _INCH**2, _PRESSURE, "k"),
    "ksi": (1000 * _POUND * _GRAVITY / _INCH**2, _PRESSURE, ""),
}
_PREFIXES = {"": 0, "p": -12, "n": -9, "u": -6, "m": -3, "c": -2, "k": 3, "M": 6, "G": 9}
_UNITS = {
    prefix + name: (factor * Fraction(10) ** _PREFIXES[prefix], dimension)
    for names, (factor, dimension, prefixes) in _BASES.items()
    for name in names.split()
    for prefix in ["", *prefixes.split()]
}
_FACTOR = re.compile(
    r"\s*(?P<over>[*/·]?)\s*(?P<name>[A-Za-z_]+|%|1(?![\s\d]*\d))(?:(?:\^|\*\*)?(?P<power>-?[1-9]))?"
)
_SAME = str.maketrans("µμ\N{MINUS SIGN}⁻¹²³⁴⁵⁶⁷⁸⁹", "uu--123456789")
_LONGEST = 40


@cache
def _factors(unit: str) -> list[tuple[str, int]] | None:
    """The names of known units in a product, each with its power; None if one is unknown."""
    text = unit.translate(_SAME)
    matches = list(_FACTOR.finditer(text[:_LONGEST]))
    is_complete = matches and "".join(match[0] for match in matches) == text
    if not is_complete or not all(match["name"] in _UNITS for match in matches):
        return None
    return [
        (match["name"], int(match["power"] or 1) * (-1 if match["over"] == "/" else 1))
        for match in matches
    ]


@cache
def _unit(unit: str) -> tuple[Fraction, Dimension]:
    """Return a unit's factor to SI and its dimension. Raises UnitError for an unknown unit."""
    factors = _factors(unit)
    if factors is None:
        raise _unknown(unit)
    factor, dimension = Fraction(1), Dimension()
    for name, power in factors:
        base, base_dimension = _UNITS[name]
        factor *= base**power
        dimension *= base_dimension**power
    return factor, dimension


def is_known(unit: str) -> bool:
    """Return whether a text is a unit that is known here.

    >>> is_known("m/s"), is_known("Time")
    (True, False)
    """
    return _factors(unit) is not None


def _unknown(unit: str, expected: str | None = None) -> UnitError:
    """Return the error for an unknown unit; `expected` has the dimension that it should have."""
    return UnitError(f"unknown unit {unit[:_LONGEST]!r}: {_advice(unit, expected)}")


def _advice(unit: str, expected: str | None = None) -> str:
    """Say which units an unknown one is probably meant to be, in capitals or not.

    If the `expected` dimension is known, a unit that measures it may be less similar.
    """
    if known := _named_in(_OTHER_NAMES, unit):
        return f"did you mean {known}?"
    if known := _named_in(_CONVERTIBLE, unit):
        return f"convert it to {known}"
    meant = [] if expected is None else _similar(unit, _units_like(expected), cutoff=0.5)
    if meant := meant or _similar(unit, [*_UNITS], cutoff=0.7):
        return f"did you mean {' or '.join(meant)}?"
    return "take one such as um, ns, m/s, kg/m^3, MPa or ksi"


_OTHER_NAMES = {
    "um": "micron microns micrometer micrometers micrometre micrometres",
    "ns": "nanosecond nanoseconds nsec",
    "us": "microsecond microseconds usec",
    "s": "second seconds sec",
    "m": "meter meters metre metres",
    "m/s": "mps m/sec",
    "in": "inches",
    "ft": "feet foot",
    "Pa": "pascal pascals",
    "MPa": "megapascal megapascals",
    "GPa": "gigapascal gigapascals",
}
"""How else users write units that are known here, in small letters."""

_CONVERTIBLE = {"m/s": "mph mi/h km/h kmh kph knots", "Pa": "atm torr mmhg", "s": "h min"}
"""Units that are not known here, in small letters, by one that measures the same."""


def _named_in(names: Mapping[str, str], unit: str) -> str:
    """Return the unit that has this name among its others, or ""."""
    name = unit[:_LONGEST].lower()
    return next((known for known, others in names.items() if name in others.split()), "")


def _units_like(expected: str) -> list[str]:
    """Return the usual units that measure what the expected one does.

    Those of one letter are left out, as that letter is in many words.
    """
    dimension = unit_dimension(expected)
    simple = [name for name, (_, of) in _UNITS.items() if of == dimension and len(name) > 1]
    return simple + [unit for unit in _QUOTIENTS if unit_dimension(unit) == dimension]


_QUOTIENTS = ("m/s", "km/s", "kg/m^3", "g/cm^3")
"""The usual units of velocity and density."""


def _similar(unit: str, units: Sequence[str], cutoff: float) -> list[str]:
    """Return those of some units that are written like this one, in capitals or not."""
    names: dict[str, list[str]] = {}
    for name in units:
        names.setdefault(name.lower(), []).append(name)
    text = unit[:_LONGEST].lower()
    similar = [text] if text in names else get_close_matches(text, names, n=2, cutoff=cutoff)
    return [name for lower in similar for name in names[lower]]


def to_si(unit: str) -> Fraction:
    """Return the factor from a unit to SI base units. Raises UnitError for an unknown unit.

    >>> to_si("um"), float(to_si("ksi")), to_si("m·s⁻¹")
    (Fraction(1, 1000000), 6894757.293168361, Fraction(1, 1))
    """
    return _unit(unit)[0]


def unit_dimension(unit: str) -> Dimension:
    """Return the dimension of what a unit measures. Raises UnitError for an unknown unit.

    >>> print(unit_dimension("MPa"))
    kg m^-1 s^-2
    """
    return _unit(unit)[1]


def same_dimension(first: str, second: str) -> bool:
    """Return whether two units measure the same kind of quantity.

    Raises UnitError if the first is unknown, with units that measure what the second does.

    >>> same_dimension("ksi", "MPa"), same_dimension("um", "MPa")
    (True, False)
    """
    if not is_known(first):
        raise _unknown(first, second)
    return unit_dimension(first) == unit_dimension(second)


def superscript(power: str) -> str:
    """Return an exponent in superscript characters.

    >>> superscript("-10")
    '⁻¹⁰'
    """
    return power.translate(str.maketrans("-0123456789n", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹ⁿ"))


def raised(text: str) -> str:
    """Return a text with every integer exponent ("^-2") in superscript characters.

    >>> raised("kg m^-1 s^-2")
    'kg m⁻¹ s⁻²'
    """
    return re.sub(r"\^(-?\d+)", lambda power: superscript(power[1]), text)


def written(unit: str) -> str:
    """Return a unit as it is shown to readers; the unit of a pure number is the empty text.

    >>> written("um^3"), written("kg/m^3"), written("percent"), written("1")
    ('µm³', 'kg/m³', '%', '')
    """
    text = {"1": "", "percent": "%", "gram_force": "gf"}.get(unit, unit)
    return raised(re.sub(r"\bu(?=[a-z])", "µ", text))

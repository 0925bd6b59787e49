"""Units of measurement, in exact rational arithmetic.

Pint knows the units and their dimensions; with `Fraction` numbers its conversions are exact (an
inch is 254/10000 m, a pound-force 0.45359237 * 9.80665 N), so a conversion never rounds.
"""

import re
from fractions import Fraction
from functools import cache
from typing import Any

__all__ = ["UnitError", "quantity", "same_dimension", "to_si"]


class UnitError(ValueError):
    """An unknown unit, or one of another dimension than is asked for."""


@cache
def _registry() -> Any:
    import pint  # a quarter of a second that plain SI numbers need not wait for

    return pint.UnitRegistry(non_int_type=Fraction)


_NAME = r"[^\W\d]\w*(?:(?:\^|\*\*)-?[1-9])?"
_UNIT = re.compile(rf"1|(?:1\s*/\s*)?{_NAME}(?:(?:\s*[*/]\s*|\s+){_NAME})*")
"""Names with powers, times or over each other: all that a unit needs of pint's expressions."""


@cache
def _base(unit: str) -> tuple[Fraction, str]:
    """The factor to SI base units, and the dimension as comparable text."""
    import pint

    if not _UNIT.fullmatch(unit):
        raise UnitError(f"{unit!r} is no unit such as 'um', 'MPa' or 'kg/m^3'")
    registry = _registry()
    text = "dimensionless" if unit == "1" else unit
    try:
        base = registry.Quantity(Fraction(1), registry.parse_units(text)).to_base_units()
    except (pint.errors.PintError, AttributeError) as error:
        raise UnitError(f"unknown unit {unit!r}") from error
    factor = base.magnitude
    nothing = registry.Quantity(Fraction(0), base.units if unit == "1" else text)
    if not isinstance(factor, Fraction) or nothing.to_base_units().magnitude != 0:
        raise UnitError(f"unit {unit!r} has no exact factor to SI")
    dimension = sorted((name, str(power)) for name, power in base.dimensionality.items())
    return factor, repr(dimension)


def to_si(unit: str) -> Fraction:
    """The factor from a unit to SI base units.

    Raises UnitError for an unknown unit.

    >>> to_si("um"), float(to_si("ksi"))
    (Fraction(1, 1000000), 6894757.293168361)
    """
    return _base(unit)[0]


def same_dimension(one: str, other: str) -> bool:
    """Whether two units measure the same kind of quantity.

    >>> same_dimension("ksi", "MPa"), same_dimension("um", "MPa")
    (True, False)
    """
    return _base(one)[1] == _base(other)[1]


_QUANTITY = re.compile(r"(?P<number>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,4})?)\s*(?P<unit>.*)")


def quantity(text: str, unit: str) -> Fraction:
    """A number with or without a unit, as SI; without, it is taken to be SI already.

    `unit` is the unit whose dimension is expected. Raises UnitError or ValueError.

    >>> quantity("11 um", "m"), quantity("1.1e-5", "m")
    (Fraction(11, 1000000), Fraction(11, 1000000))
    """
    match = _QUANTITY.fullmatch(text.strip())
    if match is None:
        raise ValueError(f"{text!r} is no finite number with or without a unit, such as '1 {unit}'")
    value, own = Fraction(match["number"]), match["unit"]
    if not own:
        return value
    if not same_dimension(own, unit):
        raise UnitError(f"{text!r}: {own} does not measure what {unit} does")
    return value * to_si(own)

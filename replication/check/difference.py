"""One difference between a workbook and the report's sheet, and the words for what it concerns."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from replication.check.words import COLUMNS, INPUTS
from spreadsheets.foreign import Position

__all__ = [
    "KINDS", "NO_FAULT", "Difference", "count", "power_of_ten", "quantity", "scaled", "title",
    "unit_text",
]  # fmt: skip

KINDS = (
    "stale value", "typed number", "odd formula", "typed constant", "operation order",
    "other scheme", "other input", "unit", "printed number", "not calculated",
)  # fmt: skip
NO_FAULT = frozenset({"other input", "not calculated"})
"""Kinds that are said, and leave a workbook clean."""


@dataclass(frozen=True)
class Difference:
    """One way in which a workbook parts from the report's sheet, at one place.

    `cells` are all that it concerns, the first of them `place`. `rank` orders differences as their
    cells are calculated. `effect` is the final depth [m] that this difference alone would give.
    """

    place: Position
    kind: str
    expected: float | str | None
    found: float | str | None
    explanation: str
    cells: tuple[Position, ...]
    rank: tuple[float, ...]
    effect: float | None = None


_TITLES = {
    "time": "the time", "velocity_initial": "the initial velocity", "depth": "the depth",
    "deceleration": "the deceleration", "velocity_final": "the final velocity",
    "velocity": "the impact velocity", "radius": "the radius", "diameter": "the diameter",
    "particle_density": "the particle density", "target_density": "the target density",
    "mass": "the mass", "beta": "beta", "flow_stress": "the flow stress",
    "resistance": "the target resistance", "step": "the time step",
    "stop_velocity": "the stop velocity",
}  # fmt: skip


def title(role: str) -> str:
    """What a column or an input is called in a sentence."""
    return _TITLES[role]


def titles(roles: Iterable[str]) -> str:
    """Some of them, joined."""
    return " and ".join(map(title, roles))


def quantity(value: float, role: str) -> str:
    """A value in SI units with its unit.

    >>> quantity(11e-6, "radius"), quantity(5.0, "beta")
    ('1.1e-05 m', '5')
    """
    unit = {**COLUMNS, **INPUTS}[role]
    return f"{value:.10g}" if unit == "1" else f"{value:.10g} {unit}"


_NAMED = {
    "s": {-3: "ms", -6: "us", -9: "ns", -12: "ps"},
    "m": {-2: "cm", -3: "mm", -6: "um", -9: "nm"},
    "m/s": {3: "km/s", -3: "mm/s", -2: "cm/s"},
    "m/s^2": {3: "km/s^2", -2: "cm/s^2", 12: "um/ns^2"},
    "kg/m^3": {3: "g/cm^3"},
    "Pa": {3: "kPa", 6: "MPa", 9: "GPa"},
    "kg": {-3: "g", -6: "mg", -9: "ug", -12: "ng", -15: "pg"},
}


def unit_text(role: str, power: int) -> str:
    """The unit of a role that is a power of ten of the SI unit.

    >>> unit_text("depth", -6), unit_text("depth", 0), unit_text("radius", 5)
    ('um', 'm', '1e5 m')
    """
    unit = {**COLUMNS, **INPUTS}[role]
    return unit if power == 0 else _NAMED.get(unit, {}).get(power, f"1e{power} {unit}")


def power_of_ten(ratio: float) -> int | None:
    """The power of ten that a ratio is, None if it is none.

    >>> power_of_ten(1e-6), power_of_ten(1.0), power_of_ten(2.0)
    (-6, 0, None)
    """
    if not 0 < ratio < math.inf:
        return None
    power = math.log10(ratio)
    return round(power) if abs(power - round(power)) < 1e-9 else None


def scaled(value: float, factor: Fraction) -> float:
    """A number times a factor, as the decimal that the number was typed as; inf beyond doubles.

    >>> scaled(11.0, Fraction(1, 1_000_000)) == 11e-6
    True
    """
    if factor == 1 or not math.isfinite(value):
        return value
    try:
        return float(Fraction(repr(value)) * factor)
    except OverflowError:
        return math.copysign(math.inf, value)


def count(number: int, what: str) -> str:
    """A number of things.

    >>> count(1, "cell"), count(2, "cell")
    ('1 cell', '2 cells')
    """
    return f"{number:,} {what}" if number == 1 else f"{number:,} {what}s"

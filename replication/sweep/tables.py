"""What stands for an input in a plan, checked: a value, a list, or a table of some kind."""

import math
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from typing import Any

from replication.case import INPUTS, read_number
from replication.impact import checked
from replication.sweep.draws import Random
from replication.sweep.sources import ByMass, Listed, Source, Spaced

__all__ = ["check_keys", "place", "read_source", "whole_number"]


@contextmanager
def place(name: str) -> Iterator[None]:
    """Say where it was that something was wrong."""
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from error


def check_keys(table: dict[str, Any], wanted: Collection[str], allowed: Collection[str]) -> None:
    """Refuse a table with other keys than wanted and allowed, or without one that is wanted."""
    known = [*wanted, *allowed]
    for key in table:
        if key not in known:
            raise ValueError(f"there is no {key!r} here: choose of {', '.join(known)}")
    for key in wanted:
        if key not in table:
            raise ValueError(f"{key!r} is missing")


def whole_number(key: str, value: Any, least: int, greatest: float = math.inf) -> int:
    """An integer of TOML between two ends."""
    if type(value) is not int or not least <= value <= greatest:
        end = "" if greatest == math.inf else f" to {greatest}"
        raise ValueError(
            f"{key} is {value!r}: it must be a whole number, {least}{end or ' or more'}, "
            "without point or exponent"
        )
    return value


def read_source(name: str, value: Any) -> Source:
    """The source of an input, all of whose values are such as the input may have.

    Raises ValueError that names the key, what is wrong and what would be right.

    >>> read_source("radius", {"from": "1 um", "to": "5 um", "points": 3})
    Spaced(first=1e-06, last=5e-06, count=3, log=False)
    """
    source = _table_source(name, value) if isinstance(value, dict) else _listed(name, value)
    if not isinstance(source, ByMass):
        for number in source.values if isinstance(source, Listed) else source.bounds:
            checked(name, number)
    return source


def _listed(name: str, value: Any) -> Listed:
    values = value if isinstance(value, list) else [value]
    if not values:
        raise ValueError("the list is empty: give one value or more")
    return Listed(tuple(_read(item, INPUTS[name]) for item in values))


def _read(value: Any, unit: str) -> float:
    """A number of TOML, or one in a text with its unit, as SI."""
    if not isinstance(value, str | int):
        raise ValueError(f"{value} is no finite number, such as 1.1e-5 or '11 um'")
    return read_number(str(value), unit)


def _table_source(name: str, table: dict[str, Any]) -> Source:
    forms: dict[str, Callable[[str, dict[str, Any]], Source]] = {
        "distribution": _random,
        "from": _spaced,
        "average_mass": _by_mass,
    }
    for key, read in forms.items():
        if key in table:
            return read(name, table)
    raise ValueError("wants from, to, points; or distribution; or, by Eq. 1, average_mass")


def _number(table: dict[str, Any], key: str, unit: str) -> float:
    with place(key):
        number = _read(table[key], unit)
        if not math.isfinite(number):
            raise ValueError(f"{number!r} is not finite")
    return number


def _spaced(name: str, table: dict[str, Any]) -> Spaced:
    check_keys(table, ["from", "to", "points"], ["scale"])
    scale = table.get("scale", "linear")
    if scale not in ("linear", "log"):
        raise ValueError(f"scale is {scale!r}: choose linear or log")
    first, last = (_number(table, key, INPUTS[name]) for key in ("from", "to"))
    if scale == "log" and min(first, last) <= 0:
        raise ValueError("a log scale wants from and to greater than zero")
    return Spaced(first, last, whole_number("points", table["points"], 2), scale == "log")


NORMAL, UNIFORM = ("normal", "lognormal"), ("uniform", "loguniform")


def _random(name: str, table: dict[str, Any]) -> Random:
    kind = table["distribution"]
    if kind not in (*NORMAL, *UNIFORM):
        raise ValueError(f"there is no {kind!r}: choose one of {', '.join((*NORMAL, *UNIFORM))}")
    shape, ends = ["mean", "deviation"], ["lower", "upper"]
    wanted, allowed = (shape, ends) if kind in NORMAL else (ends, [])
    check_keys(table, ["distribution", *wanted], allowed)
    numbers = {key: _number(table, key, INPUTS[name]) for key in table if key != "distribution"}
    for key in ("deviation", *(wanted if kind.startswith("log") else [])):
        if numbers.get(key, 1.0) <= 0:
            raise ValueError(f"{key} must be greater than zero")
    lowest = -math.inf if kind == "normal" else 0.0
    source = Random(**{"lower": lowest, "upper": math.inf, **numbers}, log=kind.startswith("log"))
    _refuse_empty(source)
    return source


def _refuse_empty(source: Random) -> None:
    if source.lower >= source.upper:
        raise ValueError("lower must be less than upper")
    if source.mean is not None and source.kept < 1e-6:
        raise ValueError("less than a millionth of the distribution is between lower and upper")
    if source.bounds[0] < 0:
        raise ValueError(f"values down to {source.bounds[0]:.3g} would be drawn: give a lower end")


def _by_mass(name: str, table: dict[str, Any]) -> ByMass:
    if name != "velocity":
        raise ValueError("only the velocity follows from the mass, by Eq. 1")
    check_keys(table, ["average_velocity", "average_mass"], [])
    units = {"average_velocity": "m/s", "average_mass": "kg"}
    return ByMass(*(checked(key, _number(table, key, unit)) for key, unit in units.items()))

"""The TOML file of a sweep, checked at the door (format: docs/sweeps/README.md)."""

import hashlib
import math
from collections.abc import Collection
from pathlib import Path
from typing import Any

from replication.cases import CASES, INPUTS
from replication.models.impact import check
from replication.reading import name_of, parse_toml, place, quoted, read_file, read_number
from replication.sweep.plan import EXTRAS, MAX_CASES, Plan
from replication.sweep.sources import ByMass, Listed, Random, Source, Spaced

Table = dict[str, Any]


def read_plan(path: Path) -> Plan:
    """The plan that a TOML file describes.

    Raises OSError, or ValueError that names the file, the table, the key and what would be right.
    """
    content = read_file(path)
    with place(name_of(path)):
        document = parse_toml(content)
        _check_keys(document, ["inputs"], ["sweep"])
        for name, table in document.items():
            if not isinstance(table, dict):
                raise ValueError(f"{name} must be a table, [{name}]")
        settings = document.get("sweep", {})
        with place("[sweep]"):
            _check_keys(settings, [], ["case", "samples", "seed", "outputs"])
            base, extras = _base(settings), _extras(settings)
        with place("[inputs]"):
            sources = _sources(document["inputs"], base)
        with place("[sweep]"):
            samples, seed = _sampling(settings, sources)
        return Plan(sources, samples, seed, extras, hashlib.sha256(content).hexdigest())


def _base(settings: Table) -> dict[str, float]:
    name = settings.get("case", "beta-5")
    if not isinstance(name, str) or name not in CASES:
        raise ValueError(f"there is no case {name!r}: choose one of {', '.join(CASES)}")
    values = {key: getattr(CASES[name], key) for key in INPUTS}
    return {key: value for key, value in values.items() if value is not None}


def _extras(settings: Table) -> tuple[str, ...]:
    asked = settings.get("outputs", [])
    if not isinstance(asked, list) or any(name not in EXTRAS for name in asked):
        raise ValueError(f"outputs must be a list of {', '.join(EXTRAS)}; the depths always come")
    return tuple(name for name in EXTRAS if name in asked)


def _sampling(settings: Table, sources: dict[str, Source]) -> tuple[int, int]:
    if any(isinstance(source, Random) for source in sources.values()):
        if "samples" not in settings:
            raise ValueError("samples is missing: how many cases to draw")
        seed = _whole_number("seed", settings.get("seed", 0), 0, 2**64 - 1)
        return _whole_number("samples", settings["samples"], 1, MAX_CASES), seed
    for key in ("samples", "seed"):
        if key in settings:
            raise ValueError(f"{key} is for distributions, and no input has one")
    return 1, 0


def _sources(table: Table, base: dict[str, float]) -> dict[str, Source]:
    _check_keys(table, [], INPUTS)
    if "resistance" in table:
        base = {name: base[name] for name in base if name not in ("beta", "flow_stress")}
    sources: dict[str, Source] = {name: Listed((value,)) for name, value in base.items()}
    for name, value in table.items():
        sources.pop(name, None)  # so that the order is the file's
        with place(name):
            sources[name] = read_source(name, value)
    return sources


def read_source(name: str, value: Any) -> Source:
    """The source of an input, all of whose values are such as the input may have.

    Raises ValueError that names the key, what is wrong and what would be right.

    >>> read_source("radius", {"from": "1 um", "to": "5 um", "points": 3})
    Spaced(first=1e-06, last=5e-06, count=3, log=False)
    """
    source: Source
    if not isinstance(value, dict):
        source = _listed(name, value)
    elif "distribution" in value:
        source = _random(name, value)
    elif "from" in value:
        source = _spaced(name, value)
    elif "average_mass" in value:
        source = _by_mass(name, value)
    else:
        raise ValueError("give from, to and points; or distribution; or, by Eq. 1, average_mass")
    if not isinstance(source, ByMass):
        for number in source.values if isinstance(source, Listed) else source.bounds:
            check({name: number})
    return source


def _listed(name: str, value: Any) -> Listed:
    values = value if isinstance(value, list) else [value]
    if not values:
        raise ValueError("the list is empty: give one value or more")
    return Listed(tuple(_read(item, INPUTS[name]) for item in values))


def _spaced(name: str, table: Table) -> Spaced:
    _check_keys(table, ["from", "to", "points"], ["scale"])
    scale = table.get("scale", "linear")
    if scale not in ("linear", "log"):
        raise ValueError(f"scale is {scale!r}: choose linear or log")
    first, last = (_number(table, key, INPUTS[name]) for key in ("from", "to"))
    if scale == "log" and min(first, last) <= 0:
        raise ValueError("a log scale needs from and to greater than zero")
    points = _whole_number("points", table["points"], 2, MAX_CASES)
    return Spaced(first, last, points, scale == "log")


NORMAL, UNIFORM = ("normal", "lognormal"), ("uniform", "loguniform")


def _random(name: str, table: Table) -> Random:
    kind = table["distribution"]
    if kind not in (*NORMAL, *UNIFORM):
        raise ValueError(f"there is no {kind!r}: choose one of {', '.join((*NORMAL, *UNIFORM))}")
    shape, ends = ["mean", "deviation"], ["lower", "upper"]
    wanted, allowed = (shape, ends) if kind in NORMAL else (ends, [])
    _check_keys(table, ["distribution", *wanted], allowed)
    numbers = {key: _number(table, key, INPUTS[name]) for key in table if key != "distribution"}
    for key in ("deviation", *(wanted if kind.startswith("log") else [])):
        if numbers.get(key, 1.0) <= 0:
            raise ValueError(f"{key} must be greater than zero")
    lowest = -math.inf if kind == "normal" else 0.0
    source = Random(**{"lower": lowest, "upper": math.inf, **numbers}, log=kind.startswith("log"))
    if source.lower >= source.upper:
        raise ValueError("lower must be less than upper")
    if source.mean is not None and source.kept < 1e-6:
        raise ValueError("less than a millionth of the distribution is between lower and upper")
    if source.bounds[0] < 0:
        raise ValueError(f"values down to {source.bounds[0]:.3g} would be drawn: give a lower end")
    return source


def _by_mass(name: str, table: Table) -> ByMass:
    if name != "velocity":
        raise ValueError("only the velocity follows from the mass, by Eq. 1")
    units = {"average_velocity": "m/s", "average_mass": "kg"}
    _check_keys(table, list(units), [])
    numbers = {key: _number(table, key, unit) for key, unit in units.items()}
    check(numbers)
    return ByMass(**numbers)


def _check_keys(table: Table, wanted: Collection[str], allowed: Collection[str]) -> None:
    known = [*wanted, *allowed]
    for key in table:
        if key not in known:
            raise ValueError(f"there is no {key!r} here: choose of {', '.join(known)}")
    for key in wanted:
        if key not in table:
            raise ValueError(f"{key!r} is missing")


def _whole_number(key: str, value: Any, least: int, greatest: int) -> int:
    if type(value) is not int or not least <= value <= greatest:
        raise ValueError(
            f"{key} is {quoted(value)}: it must be a whole number from {least} to {greatest:,}, "
            "without point or exponent"
        )
    return value


def _number(table: Table, key: str, unit: str) -> float:
    with place(key):
        return _read(table[key], unit)


def _read(value: Any, unit: str) -> float:
    """A number of TOML, or one in a text with its unit, as SI."""
    if not isinstance(value, str | int):
        raise ValueError(f"{quoted(value)} is no finite number, such as 1.1e-5 or '11 um'")
    return read_number(str(value), unit)

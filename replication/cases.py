"""The report's two cases, and a case as the user names it: from a file, by inputs with units."""

import tomllib
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from replication.models.impact import Impact

__all__ = [
    "BETA_3",
    "BETA_5",
    "CASES",
    "INPUTS",
    "inputs_of",
    "parse_toml",
    "read_case",
    "read_number",
]

INPUTS = {
    "velocity": "m/s",
    "radius": "m",
    "particle_density": "kg/m^3",
    "target_density": "kg/m^3",
    "beta": "1",
    "flow_stress": "Pa",
    "resistance": "Pa",
    "step": "s",
    "stop_velocity": "m/s",
}
"""Every input of a case and the SI unit that a plain number is taken to be in."""


def _report_case(beta: float) -> Impact:
    # The report prints no target density. 7850 kg/m^3 is the handbook value of plain carbon steel
    # that Table A-1 admits; the audit infers the interval and tests hold this value inside it.
    return Impact(
        velocity=500.0,
        radius=11e-6,
        particle_density=8900.0,
        target_density=7850.0,
        beta=beta,
        flow_stress=700e6,
    )


BETA_3 = _report_case(3.0)
BETA_5 = _report_case(5.0)
CASES = {"beta-3": BETA_3, "beta-5": BETA_5}


def read_case(name: str, file: Path | None, given: Mapping[str, str]) -> Impact:
    """The named case, changed by what the file gives, changed by what is given singly.

    Inputs are texts such as "11 um" or "1.1e-5". A resistance takes the place of beta and flow
    stress, and the other way round. Raises ValueError or OSError with a message for the user.

    >>> read_case("beta-5", None, {"radius": "5 um"}).radius
    5e-06
    """
    if name not in CASES:
        raise ValueError(f"there is no case {name!r}: choose one of {', '.join(CASES)}")
    from_file = {} if file is None else _displaced(_file(file), given)
    places = {**dict.fromkeys(from_file, f"{file}: "), **dict.fromkeys(given, "")}
    values: dict[str, Any] = {}
    for key, text in {**from_file, **given}.items():
        try:
            values[key] = read_number(text, INPUTS[key])
        except ValueError as error:
            raise ValueError(f"{places[key]}{key}: {error}") from error
    if "resistance" in values:
        values = {"beta": None, "flow_stress": None, **values}
    try:
        return replace(CASES[name], **values)
    except ValueError as error:
        raise ValueError(f"{file}: {error}" if from_file else str(error)) from error


_PRODUCT = {"beta", "flow_stress"}


def _displaced(from_file: Mapping[str, str], given: Mapping[str, str]) -> dict[str, str]:
    """What the file gives, less what the inputs given singly take the place of."""
    gone = _PRODUCT if "resistance" in given else set()
    gone = {"resistance"} if _PRODUCT & set(given) else gone
    return {key: text for key, text in from_file.items() if key not in gone}


def read_number(text: str, unit: str) -> float:
    """A number with or without a unit, as SI; `unit` tells what it must measure.

    >>> read_number("0.5 ns", "s")
    5e-10
    """
    with suppress(ValueError):
        return float(text)
    from reference.units import quantity  # needed only where a unit is written

    try:
        return float(quantity(text, unit))
    except OverflowError as error:
        raise ValueError(f"{text!r} is beyond the range of doubles") from error


class _Float(str):
    """A float as it is written; unlike a text it is shown without quotes."""

    __slots__ = ()
    __repr__ = str.__str__


def parse_toml(content: bytes) -> dict[str, Any]:
    """A TOML document, its floats as they are written. Raises ValueError if it is none."""
    try:
        # Notepad and others put a byte order mark before it.
        return tomllib.loads(content.decode("utf-8-sig"), parse_float=_Float)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"is no TOML file: {error}") from error


def _file(path: Path) -> dict[str, str]:
    try:
        document = parse_toml(path.read_bytes())
    except ValueError as error:
        raise ValueError(f"{path} {error}") from error
    table = document.get("impact")
    if not isinstance(table, dict) or set(document) != {"impact"}:
        raise ValueError(f"{path}: wants one table, [impact], with inputs such as velocity")
    unknown = sorted(set(table) - set(INPUTS))
    if unknown:
        raise ValueError(f"{path}: no such input as {unknown[0]!r}: choose of {', '.join(INPUTS)}")
    return {name: str(value) for name, value in table.items()}


def inputs_of(impact: Impact) -> dict[str, float | None]:
    """The inputs of a case in SI, with the resistance that follows from them."""
    given = {field.name: getattr(impact, field.name) for field in fields(impact)}
    return {**given, "resistance": impact.target_resistance}

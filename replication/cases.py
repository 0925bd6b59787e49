"""The report's two cases, and a case as the user names it: from a file, by inputs with units."""

from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from reference.ledger import claims_of_case, load
from replication.models.impact import Impact
from replication.reading import name_of, parse_toml, place, quoted, read_file, read_number

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


BETA_3, BETA_5 = (
    Impact(**{name: float(load().value(claim)) for name, claim in claims_of_case(beta).items()})
    for beta in (3, 5)
)
CASES = {"beta-3": BETA_3, "beta-5": BETA_5}


def read_case(name: str, file: Path | None, given: Mapping[str, str]) -> Impact:
    """The named case, changed by what the file gives, changed by what is given singly.

    Inputs are texts such as "11 um" or "1.1e-5". A resistance takes the place of beta and flow
    stress, and the other way round. Raises ValueError or OSError with a message for the user.

    >>> read_case("beta-5", None, {"radius": "5 um"}).radius
    5e-06
    """
    if name not in CASES:
        raise ValueError(f"there is no case {quoted(name)}: choose one of {', '.join(CASES)}")
    from_file = {} if file is None else _file(file)
    for group, instead in ((_PRODUCT, {"resistance"}), ({"resistance"}, _PRODUCT)):
        if group & set(given):  # displaces in the file what stands instead of it
            from_file = {key: text for key, text in from_file.items() if key not in instead}
    places = {**dict.fromkeys(from_file, f"{name_of(file)}: "), **dict.fromkeys(given, "")}
    values: dict[str, Any] = {}
    for key, text in {**from_file, **given}.items():
        with place(f"{places[key]}{key}"):
            values[key] = read_number(text, INPUTS[key])
    if "resistance" in values:
        values = {"beta": None, "flow_stress": None, **values}
    try:
        return replace(CASES[name], **values)
    except ValueError as error:
        raise ValueError(f"{name_of(file)}: {error}" if from_file else str(error)) from error


_PRODUCT = {"beta", "flow_stress"}


def _file(path: Path) -> dict[str, str]:
    content = read_file(path)
    try:
        document = parse_toml(content)
    except ValueError as error:
        raise ValueError(f"{name_of(path)} {error}") from error
    table = document.get("impact")
    if not isinstance(table, dict) or set(document) != {"impact"}:
        raise ValueError(f"{name_of(path)}: give one table, [impact], of inputs such as velocity")
    if unknown := sorted(set(table) - set(INPUTS)):
        known = ", ".join(INPUTS)
        raise ValueError(
            f"{name_of(path)}: no such input as {quoted(unknown[0])}: choose of {known}"
        )
    return {name: str(value) for name, value in table.items()}


def inputs_of(impact: Impact) -> dict[str, float | None]:
    """The inputs of a case in SI, with the resistance that follows from them."""
    given = {field.name: getattr(impact, field.name) for field in fields(impact)}
    return {**given, "resistance": impact.target_resistance}

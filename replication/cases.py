"""The report's two cases, and reading a user's case from names, files and inputs with units."""

from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from reference.ledger import claims_of_case, load
from replication.models.impact import Impact
from replication.reading import quoted, read_numbers, tables_of

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
"""The inputs of a case, with the SI unit of a number without one."""

BETA_3, BETA_5 = (
    Impact(**{name: float(load().value(claim)) for name, claim in claims_of_case(beta).items()})
    for beta in (3, 5)
)
CASES = {"beta-3": BETA_3, "beta-5": BETA_5}


def read_case(name: str, file: Path | None, given: Mapping[str, str]) -> Impact:
    """Return the named case with the inputs of the file and then the given ones replaced.

    Inputs are texts such as "11 um" or "1.1e-5". Raises ValueError or OSError.

    >>> read_case("beta-5", None, {"radius": "5 um"}).radius
    5e-06
    """
    if name not in CASES:
        raise ValueError(f"there is no case {quoted(name)}: choose one of {', '.join(CASES)}")
    impact = CASES[name]
    if file is not None:
        with tables_of(file, ["impact"]) as (tables, _):
            impact = changed(impact, read_numbers(tables["impact"], INPUTS))
    return changed(impact, read_numbers(given, INPUTS))


def changed(impact: Impact, values: Mapping[str, float]) -> Impact:
    """Return the case with some inputs replaced; raises ValueError as `Impact` does.

    A resistance replaces beta and flow stress, and either of these replaces a resistance.

    >>> changed(BETA_5, {"resistance": 2e9}).target_resistance
    2000000000.0
    """
    changes: dict[str, Any] = dict(values)
    if "resistance" in values:
        changes = {"beta": None, "flow_stress": None, **values}
    elif "beta" in values or "flow_stress" in values:
        changes = {"resistance": None, **values}
    return replace(impact, **changes)


def inputs_of(impact: Impact) -> dict[str, float | None]:
    """Return the inputs of a case in SI units, including the resistance that follows from them."""
    return {**asdict(impact), "resistance": impact.target_resistance}

"""The report's two cases, and reading a user's case from names, files and inputs with units.

`DEPTH_MODELS` are the models of the final depth that a case can be asked about.
"""

from collections.abc import Collection, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from pathlib import Path
from typing import Any, NamedTuple

from reference.ledger import claims_of_case, load
from replication.models.alternatives import (
    ConstantPressure,
    DepthModel,
    FrankZook,
    FrankZookAsPrinted,
    Rigid,
)
from replication.models.impact import Impact, InputError
from replication.reading import advice, place, quoted, read_number, read_numbers, tables_of
from replication.text import number, with_unit

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

    The given inputs are texts of options, such as "11 um" or "1.1e-5", and messages name them so.
    Raises ValueError or OSError.

    >>> read_case("beta-5", None, {"radius": "5 um"}).radius
    5e-06
    >>> read_case("beta-5", None, {"flow_stress": "0"})
    Traceback (most recent call last):
    replication.models.impact.InputError: --flow-stress is 0.0: it must be a finite number \
greater than zero
    """
    if name not in CASES:
        raise ValueError(f"there is no case {quoted(name)}: {advice(name, CASES)}")
    impact = CASES[name]
    if file is not None:
        with tables_of(file, ["impact"]) as (tables, _):
            impact = changed(impact, read_numbers(tables["impact"], INPUTS))
    values = {}
    for key, text in given.items():
        with place(option(key)):
            values[key] = read_number(text, INPUTS[key])
    if "resistance" in given and ("beta" in given or "flow_stress" in given):
        instead = "--resistance stands instead of --beta and --flow-stress"
        raise ValueError(f"{instead}: give it or those two, not both")
    try:
        return changed(impact, values)
    except InputError as error:
        key = "resistance" if error.name == "target resistance" else error.name
        raise InputError(option(key) if key in given else error.name, error.problem) from error


def option(name: str) -> str:
    """Return the option that gives an input.

    >>> option("flow_stress")
    '--flow-stress'
    """
    return f"--{name.replace('_', '-')}"


class Expected(NamedTuple):
    """The values of an input that an impact can have, and the unit in which it is mostly said."""

    least: float
    greatest: float
    unit: str


_DENSITY = Expected(23, 23_000, "g/cm^3")
"""Up to osmium, the densest metal, 22.6 g/cm^3. What is below 23 kg/m^3 is a number in g/cm^3."""

_STRENGTH = Expected(1e4, 1e12, "MPa")
"""From soft gels, some 10 kPa, to ten times the hardness of diamond."""

EXPECTED = {
    "velocity": Expected(1e-3, 1e5, "m/s"),  # meteors reach 7e4 m/s
    "radius": Expected(1e-9, 1.0, "um"),  # from a few atoms to larger than anything that is shot
    "particle_density": _DENSITY,
    "target_density": _DENSITY,
    "beta": Expected(0.1, 100.0, "1"),  # hardness over flow stress is about 3
    "flow_stress": _STRENGTH,
    "resistance": _STRENGTH,
}
"""What somebody who asks for an impact can mean. Other values are computed, with a warning."""


def doubts(impact: Impact, given: Collection[str] = ()) -> list[str]:
    """Return a warning for every input that no impact has: mostly its unit was left out.

    `given` are the inputs that options gave; the warning names them as they were typed.

    >>> doubts(read_case("beta-5", None, {"radius": "11"}), ["radius"])
    ['--radius is 11 m: from 1e-09 to 1 m is expected; did you mean "11 um"?']
    """
    warnings = []
    for name, (least, greatest, usual) in EXPECTED.items():
        value, unit = getattr(impact, name), INPUTS[name]
        if value is None or least <= value <= greatest:
            continue
        said = with_unit(number(value, 12), unit)
        named = option(name) if name in given else name.replace("_", " ")
        range_ = with_unit(f"{number(least)} to {number(greatest)}", unit)
        meant = f"{number(value, 12)} {usual}"
        advised = usual != unit and least <= read_number(meant, unit) <= greatest
        question = f'; did you mean "{meant}"?' if advised else ""
        warnings.append(f"{named} is {said}: from {range_} is expected{question}")
    return warnings


def in_words(impact: Impact, *, step: bool = False, stop: bool = False) -> str:
    """Return the inputs of a case as one line, in the symbols of the report.

    step, stop: with the time step dt, with the stop velocity; they concern the sheet alone.

    >>> in_words(BETA_5)
    'V 500 m/s, R 11 um, rho_p 8900, rho_t 7850 kg/m^3, R_t 5 x 700 MPa'
    """
    resistance = f"{number(impact.target_resistance / 1e9)} GPa"
    if impact.beta is not None and impact.flow_stress is not None:
        resistance = f"{number(impact.beta)} x {number(impact.flow_stress / 1e6)} MPa"
    parts = [
        f"V {number(impact.velocity)} m/s",
        f"R {number(impact.radius * 1e6)} um",
        f"rho_p {number(impact.particle_density)}",
        f"rho_t {number(impact.target_density)} kg/m^3",
        f"R_t {resistance}",
    ]
    if step:
        parts.append(f"dt {number(impact.step * 1e9)} ns")
    if stop:
        parts.append(f"stop {number(impact.stop_velocity)} m/s")
    return ", ".join(parts)


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


# The models of the final depth

OWN_INPUTS = {"resistance": "Pa", "length_ratio": "1", "k_1": "1", "k_t": "1"}
"""The inputs that a model may have apart from the case, with their SI units."""


@dataclass(frozen=True, slots=True)
class Declaration:
    """A model of the final depth, and those of its inputs whose defaults are not the case's.

    `own` has the claim, by its id in the ledger, that each of these defaults is printed in.
    """

    model: type[DepthModel]
    own: Mapping[str, str] = field(default_factory=dict)

    @property
    def inputs(self) -> tuple[str, ...]:
        """The names of all inputs that the model takes."""
        return tuple(field.name for field in fields(self.model))


_OF_SECTION_3 = {
    "resistance": "fz-resistance-rha",
    "length_ratio": "sphere-length-ratio",
    "k_1": "fz-k1",
    "k_t": "fz-kt",
}
DEPTH_MODELS = {
    "rigid": Declaration(Rigid),
    "constant-pressure": Declaration(ConstantPressure),
    "frank-zook": Declaration(FrankZook, _OF_SECTION_3),
    "frank-zook-printed": Declaration(FrankZookAsPrinted, _OF_SECTION_3),
}


@dataclass(frozen=True, slots=True)
class ModelledCase:
    """A model with all its inputs, and where each comes from: `sources`, by the input's name.

    A source is "given", "case", or the claim and its place in the report.
    """

    model: DepthModel
    sources: Mapping[str, str]


def modelled(name: str, impact: Impact, given: Mapping[str, float] = {}) -> ModelledCase:
    """Return the model of this name for a case.

    `given` are inputs of `OWN_INPUTS` that replace the case's or the report's. A resistance that
    the case has is not that of a model with a resistance of its own: it must be given for it.
    Raises ValueError for a name or an input that there is not, and as the model does.

    >>> f"{modelled('frank-zook', BETA_5).model.normalized_depth:.3f}"
    '0.255'
    >>> modelled("frank-zook", BETA_5).sources["k_1"]
    'fz-k1: section 3, line 141, Eq. 17'
    >>> f"{modelled('frank-zook', BETA_5, {'resistance': 7.6e9}).model.normalized_depth:.3f}"
    '0.300'
    """
    if name not in DEPTH_MODELS:
        raise ValueError(f"there is no model {quoted(name)}: {advice(name, DEPTH_MODELS)}")
    declaration, ledger = DEPTH_MODELS[name], load()
    for key in given:
        if key not in declaration.inputs:
            own = [key for key in declaration.inputs if key in OWN_INPUTS]
            raise ValueError(f"the model {name} takes no {quoted(key)}: {advice(key, own)}")
    values, sources = {}, {}
    for key in declaration.inputs:
        if key in given:
            values[key], sources[key] = float(given[key]), "given"
        elif key in declaration.own:
            claim = declaration.own[key]
            values[key] = float(ledger.value(claim))
            sources[key] = f"{claim}: {ledger.claims[claim].place}"
        else:
            values[key], sources[key] = impact.motion[key], "case"
    return ModelledCase(declaration.model(**values), sources)

"""The report's two cases, and reading a user's case from names, files and inputs with units.

`DEPTH_MODELS` are the models of the final depth that a case can be asked about.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from reference.ledger import claims_of_case, load
from replication.models.alternatives import (
    ConstantPressure,
    DepthModel,
    FrankZook,
    FrankZookAsPrinted,
    Rigid,
)
from replication.models.impact import Impact, InputError
from replication.user_input import (
    KeyedError,
    advice,
    place,
    quoted,
    read_number,
    read_numbers,
    tables_of,
    within,
)

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
        with tables_of(file, ["impact"]) as (tables, _), within("impact"):
            numbers = read_numbers(tables["impact"], INPUTS)
            try:
                impact = changed(impact, numbers)
            except InputError as error:
                key = _input_of(error)
                raise KeyedError(str(error), (key,) if key in numbers else ()) from error
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
        key = _input_of(error)
        raise InputError(option(key) if key in given else error.name, error.problem) from error


def _input_of(error: InputError) -> str:
    """Return the input that an error of `Impact` is about, or what it computes from inputs."""
    return "resistance" if error.name == "target resistance" else error.name


def option(name: str) -> str:
    """Return the option that gives an input.

    >>> option("flow_stress")
    '--flow-stress'
    """
    return f"--{name.replace('_', '-')}"


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


OTHER_FACTOR = {"beta": "flow_stress", "flow_stress": "beta"}
"""By what the resistance is to be divided, R_t = beta Y_t (Eq. 7)."""


def other_factor(impact: Impact, quantity: str) -> float:
    """Return by what the case's resistance is divided to give its beta or its flow stress.

    Raises ValueError if the case does not have it.

    >>> other_factor(BETA_5, "beta")
    700000000.0
    """
    divisor = OTHER_FACTOR[quantity]
    factor: float | None = getattr(impact, divisor)
    if factor is None:
        words, divisor = quantity.replace("_", " "), divisor.replace("_", " ")
        raise ValueError(f"the {words} is the resistance over the {divisor}: give the {divisor}")
    return factor


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


def modelled(name: str, impact: Impact, given: Mapping[str, float] | None = None) -> ModelledCase:
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
    given = given or {}
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

"""The options that name a case and change its inputs; a case in a line, and what is odd in it."""

import argparse
from collections.abc import Collection
from typing import NamedTuple

from replication.cases import BETA_5, CASES, INPUTS, option, read_case
from replication.cli.options import path
from replication.models.impact import Impact
from replication.reading import read_number
from replication.text import number, with_unit

OF_THE_SHEET = ("step", "stop_velocity")
"""The inputs that act only where time is stepped."""


def add_inputs(
    parser: argparse.ArgumentParser, *, default: str = "beta-5", with_sheet: bool = True
) -> None:
    """Add --case, --case-file and every input of a case; `default` says which case is the default.

    with_sheet: the sheet's step and stop velocity act on the result. If they do not, they are still
    accepted and checked, so that one set of options serves all commands, but the help leaves them
    out.
    """
    group = parser.add_argument_group(
        "the case",
        "Inputs not given are those of the named case. A plain number is in the unit shown; "
        'others are understood, such as "11 um", "98 ksi" and "0.2 ns".',
    )
    group.add_argument(
        "--case", metavar="NAME", help=f"{' or '.join(reversed(CASES))} (default: {default})"
    )
    group.add_argument("--case-file", type=path, metavar="FILE", help="TOML, table [impact]")
    for name, unit in INPUTS.items():
        value = getattr(BETA_5, name)
        has = "instead of beta and flow stress" if value is None else f"beta-5: {number(value)}"
        meaning = name.replace("_", " ") + ("" if unit == "1" else f" [{unit}]")
        acts = with_sheet or name not in OF_THE_SHEET
        text = f"{meaning} ({has})" if acts else argparse.SUPPRESS
        group.add_argument(option(name), metavar="X", help=text)


def case_of(options: argparse.Namespace) -> tuple[Impact, list[str]]:
    """Return the case that the options describe, and a warning for every input that is odd.

    Raises ValueError or OSError.
    """
    given = _given(options)
    name = "beta-5" if options.case is None else options.case
    case = read_case(name, options.case_file, given)
    return case, doubts(case, given)


def is_given(options: argparse.Namespace) -> bool:
    """Return whether any option names or changes a case."""
    named = options.case is not None or options.case_file is not None
    return named or bool(_given(options))


def _given(options: argparse.Namespace) -> dict[str, str]:
    values = {name: getattr(options, name) for name in INPUTS}
    return {name: value for name, value in values.items() if value is not None}


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

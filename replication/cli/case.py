"""The options that name a case and change its inputs; a case in a line, and what is odd in it."""

import argparse
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from fractions import Fraction
from typing import NamedTuple, NoReturn

from reference.units import to_si
from replication.cases import BETA_5, CASES, INPUTS, inputs_of, option, read_case
from replication.cli.options import path
from replication.models.impact import Impact
from replication.text import between, number, with_unit
from replication.user_input import read_number, typed_unit

OF_THE_SHEET = ("step", "stop_velocity")
"""The inputs that act only where time is stepped."""


def add_inputs(
    parser: argparse.ArgumentParser,
    *,
    default: str = "beta-5",
    with_sheet: bool = True,
    without: Collection[str] = (),
) -> None:
    """Add --case, --case-file and every input of a case; `default` says which case is the default.

    with_sheet: the sheet's step and stop velocity act on the result. If they do not, they are still
    accepted and checked, so that one set of options serves all commands, but the help leaves them
    out and `case_of` warns. without: further inputs that the help leaves out, as the command
    refuses them.
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
        acts = (with_sheet or name not in OF_THE_SHEET) and name not in without
        text = f"{meaning} ({has})" if acts else argparse.SUPPRESS
        group.add_argument(option(name), metavar="X", help=text)
    parser.set_defaults(idle=() if with_sheet else OF_THE_SHEET)
    group.add_argument("--diameter", type=_half_of, help=argparse.SUPPRESS)


def _half_of(text: str) -> NoReturn:
    """Refuse a diameter, and say which radius it is."""
    radius = "11 um"
    with suppress(ValueError):
        read_number(text, "m")
        unit = typed_unit(text)
        value = float(text.strip().removesuffix(unit))
        radius = f"{number(value / 2, 12)} {unit}".strip()
    raise argparse.ArgumentTypeError(f'give the radius, which is half: --radius "{radius}"')


def case_of(options: argparse.Namespace) -> tuple[Impact, list[str]]:
    """Return the case that the options describe, and a warning for every input that is odd.

    An option that the command accepts but that does not act on its result is warned of, too. Raises
    ValueError or OSError.
    """
    given = given_inputs(options)
    name = "beta-5" if options.case is None else options.case
    case = read_case(name, options.case_file, given)
    idle = [
        f"{option(name)} has no say here: it acts only where time is stepped, as in `sheet`"
        for name in options.idle
        if name in given
    ]
    return case, doubts(case, given) + idle


@contextmanager
def doubted(warnings: Sequence[str]) -> Iterator[None]:
    """Let an error in the block end with what is odd in the case, which may be its reason.

    >>> with doubted(["--radius is 11 m"]):
    ...     raise ValueError("too many steps")
    Traceback (most recent call last):
    ValueError: too many steps; --radius is 11 m
    """
    try:
        yield
    except ValueError as error:
        if not warnings:
            raise
        raise ValueError(f"{error}; {warnings[0]}") from error


def is_given(options: argparse.Namespace) -> bool:
    """Return whether any option names or changes a case."""
    named = options.case is not None or options.case_file is not None
    return named or bool(given_inputs(options))


def given_inputs(options: argparse.Namespace) -> dict[str, str]:
    """Return the inputs that options give, as they were typed."""
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
    "velocity": Expected(1.0, 1e5, "m/s"),  # the sheet stops at 1 m/s; meteors reach 7e4 m/s
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
    for name in EXPECTED:
        value = getattr(impact, name)
        named = option(name) if name in given else name.replace("_", " ")
        warnings += [] if value is None else doubt(name, value, named)
    return warnings


def doubt(name: str, value: float, named: str, *, typed: bool = True) -> list[str]:
    """Return a warning if no impact has this value of an input, or else none.

    `named` is what the warning calls it: an option, or a cell of a file. typed: somebody wrote the
    value, and may have left out its unit.

    >>> doubt("velocity", 5e5, "line 3: velocity")
    ['line 3: velocity is 500000 m/s: from 1 to 100000 m/s is expected']
    """
    (least, greatest, usual), unit = EXPECTED[name], INPUTS[name]
    if least <= value <= greatest:
        return []
    said = with_unit(number(value, 12), unit)
    range_ = with_unit(f"{number(least)} to {number(greatest)}", unit)
    meant = f"{number(value, 12)} {usual}"
    advised = typed and usual != unit and least <= read_number(meant, unit) <= greatest
    question = f'; did you mean "{meant}"?' if advised else ""
    return [f"{named} is {said}: from {range_} is expected{question}"]


def in_words(impact: Impact, *, step: bool = False, stop: bool = False) -> str:
    """Return the inputs of a case as one line, in the symbols of the report.

    step, stop: with the time step dt, with the stop velocity; they concern the sheet alone.

    >>> in_words(BETA_5)
    'V 500 m/s, R 11 um, rho_p 8900, rho_t 7850 kg/m^3, R_t 5 x 700 MPa'
    """
    parts = [inputs_in_words(inputs_of(impact))]
    if step:
        parts.append(f"dt {number(impact.step * 1e9)} ns")
    if stop:
        parts.append(f"stop {number(impact.stop_velocity)} m/s")
    return ", ".join(parts)


def inputs_in_words(inputs: Mapping[str, float | None]) -> str:
    """Return some inputs of a case [SI] as one line, in the symbols of the report.

    A resistance is said by its factors if they are there.

    >>> inputs_in_words({"radius": 11e-6, "particle_density": 8900.0, "flow_stress": 7e8})
    'R 11 um, rho_p 8900 kg/m^3, Y_t 700 MPa'
    """
    known = {name: value for name, value in inputs.items() if value is not None}
    parts = []
    if "velocity" in known:
        parts.append(f"V {number(known['velocity'])} m/s")
    if "radius" in known:
        parts.append(f"R {number(known['radius'] * 1e6)} um")
    densities = [
        f"{symbol} {number(known[name])}"
        for name, symbol in (("particle_density", "rho_p"), ("target_density", "rho_t"))
        if name in known
    ]
    if densities:
        parts.append(f"{', '.join(densities)} kg/m^3")
    if "beta" in known and "flow_stress" in known:
        parts.append(f"R_t {number(known['beta'])} x {number(known['flow_stress'] / 1e6)} MPa")
    elif "beta" in known:
        parts.append(f"beta {number(known['beta'])}")
    elif "flow_stress" in known:
        parts.append(f"Y_t {number(known['flow_stress'] / 1e6)} MPa")
    elif "resistance" in known:
        parts.append(f"R_t {number(known['resistance'] / 1e9)} GPa")
    return ", ".join(parts)


def shown_in(name: str) -> str:
    """Return the unit in which an input is shown: that of the report, for most inputs SI.

    >>> shown_in("resistance"), shown_in("velocity")
    ('GPa', 'm/s')
    """
    return {"radius": "um", "resistance": "GPa", "flow_stress": "MPa"}.get(name, INPUTS[name])


def input_in_words(name: str, value: float, digits: int = 8) -> str:
    """Return a value (SI) of an input to some digits as it is read, and with all digits.

    >>> input_in_words("resistance", 3.5e9), input_in_words("beta", 5.0)
    ('3.5 GPa (3500000000.0 Pa)', '5 (5.0)')
    """
    return f"{input_rounded(name, value, digits)} ({with_unit(repr(value), INPUTS[name])})"


def input_rounded(name: str, value: float, digits: int) -> str:
    """Return a value (SI) of an input to some digits, in the unit in which it is shown.

    >>> input_rounded("resistance", 3.4600308e9, 4)
    '3.46 GPa'
    """
    unit = shown_in(name)
    return with_unit(number(Fraction(value) / to_si(unit), digits), unit)


def range_in_words(name: str, ends: tuple[float, float]) -> str:
    """Return a range (SI) of an input as it is read, to five digits; it is rounded outward.

    >>> range_in_words("resistance", (17.3333333e9, 18.4444444e9))
    '17.333 to 18.445 GPa'
    """
    unit = shown_in(name)
    return with_unit(between([Fraction(end) / to_si(unit) for end in ends], 5), unit)


def refuse_sought(quantity: str, given: Mapping[str, str], what_is_done: str) -> None:
    """Raise ValueError if an option gives the quantity that is sought, or has no say in it.

    R_t = beta Y_t (Eq. 7), so where one of the three is sought, the resistance is not given, and
    for the resistance neither of its factors.

    >>> refuse_sought("velocity", {"velocity": "500"}, "solved for")
    Traceback (most recent call last):
    ValueError: --velocity is what is solved for: leave it out
    >>> refuse_sought("beta", {"resistance": "3.5 GPa"}, "fitted")
    Traceback (most recent call last):
    ValueError: --resistance has no say where the beta is fitted: leave it out
    """
    without_say = {
        "resistance": ("beta", "flow_stress"),
        "beta": ("resistance",),
        "flow_stress": ("resistance",),
    }
    for name in given:
        if name == quantity:
            raise ValueError(f"{option(name)} is what is {what_is_done}: leave it out")
        if name in without_say.get(quantity, ()):
            sought = f"the {quantity.replace('_', ' ')} is {what_is_done}"
            raise ValueError(f"{option(name)} has no say where {sought}: leave it out")

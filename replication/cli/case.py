"""The options that name a case and change its inputs."""

import argparse

from replication.cases import BETA_5, CASES, INPUTS, doubts, option, read_case
from replication.cli.options import path
from replication.models.impact import Impact
from replication.text import number

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
    case = read_case(options.case or "beta-5", options.case_file, given)
    return case, doubts(case, given)


def is_given(options: argparse.Namespace) -> bool:
    """Return whether any option names or changes a case."""
    return bool(options.case or options.case_file or _given(options))


def _given(options: argparse.Namespace) -> dict[str, str]:
    values = {name: getattr(options, name) for name in INPUTS}
    return {name: value for name, value in values.items() if value is not None}

"""The options that name a case and change its inputs."""

import argparse

from replication.cases import CASES, INPUTS, read_case
from replication.cli.options import path
from replication.models.impact import Impact


def add_inputs(parser: argparse.ArgumentParser, default: str = "beta-5") -> None:
    """Add --case, --case-file and every input of a case; `default` says which case is the default.

    A command checks every input that is given, also those that do not act on its result.
    """
    group = parser.add_argument_group(
        "the case",
        "Inputs not given are those of the named case. A resistance replaces beta and flow "
        "stress. Step and stop velocity concern the sheet. A plain number is in the unit shown; "
        'others are understood, such as "11 um", "98 ksi" and "0.2 ns".',
    )
    group.add_argument(
        "--case", metavar="NAME", help=f"{' or '.join(reversed(CASES))} (default: {default})"
    )
    group.add_argument("--case-file", type=path, metavar="FILE", help="TOML, table [impact]")
    for name, unit in INPUTS.items():
        meaning = name.replace("_", " ") + ("" if unit == "1" else f" [{unit}]")
        group.add_argument(f"--{name.replace('_', '-')}", metavar="X", help=meaning)


def case_of(options: argparse.Namespace) -> Impact:
    """Return the case that the options describe. Raises ValueError or OSError."""
    return read_case(options.case or "beta-5", options.case_file, _given(options))


def is_given(options: argparse.Namespace) -> bool:
    """Return whether any option names or changes a case."""
    return bool(options.case or options.case_file or _given(options))


def _given(options: argparse.Namespace) -> dict[str, str]:
    values = {name: getattr(options, name) for name in INPUTS}
    return {name: value for name, value in values.items() if value is not None}

"""What the commands share: options for a case and for output, and how they print."""

import argparse
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from replication.cases import INPUTS, read_case
from replication.models.impact import Impact

__all__ = ["case", "given", "input_options", "output_options", "path", "print_json", "warn"]


def path(text: str) -> Path:
    """A path from the command line; an unset variable must not mean this folder."""
    if not text:
        raise argparse.ArgumentTypeError("a path is wanted, not an empty text")
    return Path(text)


def output_options(
    command: argparse.ArgumentParser, csv: bool = False, quiet: str = "no warnings"
) -> None:
    """--json and --quiet; and --csv, of a command that prints a table."""
    form = command.add_mutually_exclusive_group()
    if csv:
        form.add_argument("--csv", action="store_true", help="print CSV")
    form.add_argument("--json", action="store_true", help="print JSON")
    command.add_argument("--quiet", action="store_true", help=quiet)


def input_options(command: argparse.ArgumentParser, default: str = "beta-5") -> None:
    """--case, --case-file and every input of a case."""
    command.add_argument("--case", metavar="NAME", help=f"beta-5 or beta-3 (default: {default})")
    command.add_argument("--case-file", type=path, metavar="FILE", help="TOML, table [impact]")
    for name, unit in INPUTS.items():
        flag = "--" + name.replace("_", "-")
        shown = "" if unit == "1" else f" in {unit}, or with its unit"
        help_text = f"{name.replace('_', ' ')}{shown}"
        command.add_argument(flag, dest=name, metavar="X", help=help_text)


def given(options: argparse.Namespace) -> dict[str, str]:
    """The inputs that stand on the command line."""
    values = {name: getattr(options, name) for name in INPUTS}
    return {name: value for name, value in values.items() if value is not None}


def case(options: argparse.Namespace) -> Impact:
    """The case that the options name."""
    name = "beta-5" if options.case is None else options.case
    return read_case(name, options.case_file, given(options))


def print_json(record: Any) -> None:
    """One JSON document on standard output."""
    from replication.reports.plain import json_text

    sys.stdout.write(json_text(record))


def warn(options: argparse.Namespace, warnings: Iterable[str]) -> None:
    """Warnings on standard error, unless quiet."""
    if not options.quiet:
        for warning in warnings:
            print(f"coldspray {options.command}: warning: {warning}", file=sys.stderr)

"""What the commands share: options for a case and for output, and how they print."""

import argparse
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from replication.case import INPUTS, read_case
from replication.impact import Impact

if TYPE_CHECKING:
    from replication.check.difference import Difference
    from spreadsheets.recalculation import Calculation

__all__ = [
    "case", "finding_files", "finding_options", "given", "input_options", "output_options", "path",
    "print_json", "put_findings", "warn",
]  # fmt: skip


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


def finding_options(command: argparse.ArgumentParser) -> None:
    """--json, --html, --junit and --quiet: how what was found in a workbook is given."""
    command.add_argument("--json", action="store_true", help="print JSON")
    command.add_argument(
        "--html", type=path, metavar="F", help="write a page with the cells marked"
    )
    command.add_argument("--junit", type=path, metavar="F", help="write a JUnit file")
    command.add_argument("--quiet", action="store_true", help="print nothing; the status tells")


def finding_files(options: argparse.Namespace) -> list[Path]:
    """The files that are to be written, checked before the work: OSError where that cannot be."""
    from spreadsheets.safely import check_target

    files = [file for file in (options.html, options.junit) if file is not None]
    targets = [check_target(file) for file in files]
    if len(set(targets)) < len(targets):
        raise ValueError(f"--html and --junit both name {files[0]}: give each its own file")
    return files


def put_findings(
    options: argparse.Namespace,
    record: dict[str, Any],
    differences: "Sequence[Difference]",
    calculation: "Calculation",
    kinds: Sequence[str],
) -> None:
    """Write the files that were asked for, then print the record as JSON or as text."""
    from replication.check import junit, page, terminal
    from spreadsheets.safely import write_bytes

    if options.html is not None:
        write_bytes(options.html, page.html(record, differences, calculation).encode())
    if options.junit is not None:
        write_bytes(options.junit, junit.junit(record, kinds).encode())
    if options.json:
        print_json(record)
    elif not options.quiet:
        print(terminal.text(record))


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

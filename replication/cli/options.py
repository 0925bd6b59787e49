"""What the commands share: options for a case and for output, and how they print."""

import argparse
import os
import shutil
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from replication.cases import INPUTS, read_case
from replication.models.impact import Impact
from replication.reading import one_line, place, quoted, read_number
from replication.text import json_text, rows_csv


def path(text: str) -> Path:
    """A path from the command line; an unset variable must not mean this folder."""
    if not text or "\0" in text:
        raise argparse.ArgumentTypeError(f"give a path, not {quoted(text)}")
    return Path(text)


def whole(least: int, most: int) -> Callable[[str], int]:
    """A reader of whole numbers within bounds, for argparse.

    >>> whole(1, 40)("8")
    8
    """

    def read(text: str) -> int:
        digits = text.strip()
        if digits.isascii() and digits.isdigit() and len(digits) <= 20:
            number = int(digits)
            if least <= number <= most:
                return number
        raise argparse.ArgumentTypeError(
            f"give a whole number from {least:,} to {most:,}, not {quoted(text)}"
        )

    return read


def whole_option(
    command: "argparse._ActionsContainer", flag: str, least: int, most: int,
    told: str, default: int | None = None,
) -> None:  # fmt: skip
    """An option that takes a whole number within bounds."""
    command.add_argument(flag, type=whole(least, most), default=default, metavar="N", help=told)


def times(flag: str, text: str, most: int) -> list[float]:
    """The times [s] that an option lists, such as "0 ns,5 ns"; at most so many."""
    texts, values = [time.strip() for time in text.split(",")], []
    if len(texts) > most:
        raise ValueError(f"{flag}: give at most {most:,} values, not {len(texts):,}")
    for at, time in enumerate(texts, 1):
        with place(f"{flag}, value {at}"):
            values.append(read_number(time, "s"))
            if not 0 <= values[-1] <= 1e250:
                raise ValueError(f"{quoted(time)} is not from 0 to 1e250 s")
    return values


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
        measured = "" if unit == "1" else f" in {unit}, or with its unit"
        told = f"{name.replace('_', ' ')}{measured}"
        command.add_argument(f"--{name.replace('_', '-')}", metavar="X", help=told)


def scheme_option(command: argparse.ArgumentParser) -> None:
    """--scheme."""
    told = "published (default) or centered"
    command.add_argument("--scheme", metavar="NAME", default="published", help=told)


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
    sys.stdout.write(json_text(record))


def put(
    options: argparse.Namespace,
    record: Any,
    text: Callable[[], str],
    rows: Sequence[Mapping[str, Any]] = (),
    warnings: Iterable[object] = (),
) -> int:
    """Print what a command found as JSON, as rows of CSV or as text, as it was asked to; 0.

    Warnings go to standard error, but not beside JSON: they stand in the record.
    """
    if options.json:
        print_json(record)
        return 0
    if "csv" in options and options.csv:
        sys.stdout.write(rows_csv(rows))
    else:
        print(text())
    warn(options, warnings)
    return 0


def width(piped: int = 80) -> int:
    """The columns of the terminal; where output goes elsewhere, so many."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else piped


def may_emphasize() -> bool:
    """Whether output may be bold: to a terminal that can, and NO_COLOR is not set."""
    is_able = sys.stdout.isatty() and os.environ.get("TERM") != "dumb"
    return is_able and not os.environ.get("NO_COLOR")


def progress(options: argparse.Namespace, **settings: Any) -> Any:
    """A progress bar, unless quiet; none without a terminal, which is what None asks for."""
    from tqdm import tqdm

    return tqdm(**settings, disable=options.quiet or None)


def warn(options: argparse.Namespace, warnings: Iterable[object]) -> None:
    """Warnings on standard error, unless quiet."""
    if not options.quiet:
        for warning in warnings:
            print(one_line(f"coldspray {options.command}: warning: {warning}"), file=sys.stderr)

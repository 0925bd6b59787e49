"""What the commands take, as `options.toml` lists it, and how its texts are read."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

from replication.cases import INPUTS, read_case
from replication.models.impact import Impact
from replication.reading import place, quoted, read_number


def declare(command: argparse.ArgumentParser, takes: dict[str, Any]) -> None:
    """Declare what a command takes, as its table of `options.toml` says."""
    groups: dict[str, argparse._ActionsContainer] = {"": command}
    for option, said in takes.items():
        if option == "inputs":
            _declare_inputs(command, said)
        if option in ("does", "inputs"):
            continue
        settings = {"help": said} if isinstance(said, str) else dict(said)
        either, within = settings.pop("either", ""), settings.pop("within", ())
        *names, last = option.split()
        if last.startswith("-"):
            settings["action"] = "store_true"
            names.append(last)
        else:
            settings |= {"type": _whole(*within) if within else _READERS.get(last, str)}
            settings.setdefault("metavar", last)
        if either not in groups:
            groups[either] = command.add_mutually_exclusive_group()
        groups[either].add_argument(*names, **settings)


def _declare_inputs(command: argparse.ArgumentParser, default: str) -> None:
    """--case, --case-file and every input of a case."""
    command.add_argument("--case", metavar="NAME", help=f"beta-5 or beta-3 (default: {default})")
    command.add_argument("--case-file", type=_path, metavar="FILE", help="TOML, table [impact]")
    for name, unit in INPUTS.items():
        measured = "" if unit == "1" else f" in {unit}, or with its unit"
        told = f"{name.replace('_', ' ')}{measured}"
        command.add_argument(f"--{name.replace('_', '-')}", metavar="X", help=told)


# Readers of what is given, for argparse


def _path(text: str) -> Path:
    """A path from the command line; an unset variable must not mean this folder."""
    if not text or "\0" in text:
        raise argparse.ArgumentTypeError(f"give a path, not {quoted(text)}")
    return Path(text)


def _share(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if not 0 <= number <= 1:
        raise argparse.ArgumentTypeError(f"give a number from 0 to 1, not {quoted(text)}")
    return number


def _whole(least: int, most: int) -> Callable[[str], int]:
    """A reader of whole numbers within bounds.

    >>> _whole(1, 40)("8")
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


_READERS = dict.fromkeys(("FILE", "DIR", "A.xlsx", "B.xlsx"), _path) | {"SHARE": _share}


# What several options mean together


def given(options: argparse.Namespace) -> dict[str, str]:
    """The inputs that stand on the command line."""
    values = {name: getattr(options, name) for name in INPUTS}
    return {name: value for name, value in values.items() if value is not None}


def case_of(options: argparse.Namespace) -> Impact:
    """The case that the options name."""
    name = "beta-5" if options.case is None else options.case
    return read_case(name, options.case_file, given(options))


def times_of(flag: str, text: str, most: int) -> list[float]:
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

"""Options that several commands have, and readers of the texts that users give them."""

import argparse
import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TypeVar

from reference.scheme import Scheme
from replication.user_input import advice, place, quoted, read_number, typed_unit

Name = TypeVar("Name", bound=str)

Group = argparse._ActionsContainer
"""What options are added to: a parser, or a group of options in one."""


def add_json(group: Group, text: str = "print JSON") -> None:
    """Add --json."""
    group.add_argument("--json", action="store_true", help=text)


def add_csv_and_json(parser: argparse.ArgumentParser, csv: str = "print CSV") -> None:
    """Add --csv and --json, of which only one may be given."""
    forms = parser.add_mutually_exclusive_group()
    forms.add_argument("--csv", action="store_true", help=csv)
    add_json(forms)


def add_quiet(parser: argparse.ArgumentParser, text: str = "no warnings") -> None:
    """Add --quiet."""
    parser.add_argument("--quiet", action="store_true", help=text)


def add_scheme(parser: argparse.ArgumentParser) -> None:
    """Add --scheme."""
    parser.add_argument(
        "--scheme", metavar="NAME", default=Scheme.PUBLISHED, type=one_of("scheme", Scheme),
        help="drag at the initial velocity of a step: published; at its middle: centered "
        "(default: %(default)s)",
    )  # fmt: skip


def one_of(what: str, known: Iterable[Name]) -> Callable[[str], Name]:
    """Return a reader of one of the known names; `what` is what they name."""
    names = {str(name): name for name in known}

    def read(text: str) -> Name:
        if text not in names:
            hint = advice(text, names)
            raise argparse.ArgumentTypeError(f"there is no {what} {quoted(text)}: {hint}")
        return names[text]

    return read


def path(text: str) -> Path:
    """Read a path. An empty text, as from an unset variable, must not mean the current folder."""
    if not text or "\0" in text:
        raise argparse.ArgumentTypeError(f"give a path, not {quoted(text)}")
    return Path(text)


def number_up_to_1(text: str) -> float:
    """Read a number from 0 to 1."""
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if not 0 <= number <= 1:
        raise argparse.ArgumentTypeError(f"give a number from 0 to 1, not {quoted(text)}")
    return number


def whole(least: int, most: int) -> Callable[[str], int]:
    """Return a reader of whole numbers from `least` to `most`."""

    def read(text: str) -> int:
        # Thousands of digits would take int() long; no option takes more than twenty.
        if re.fullmatch(r"\s*[0-9]{1,20}\s*", text) and least <= int(text) <= most:
            return int(text)
        allowed = f"from {least:,} to {most:,}"
        raise argparse.ArgumentTypeError(f"give a whole number {allowed}, not {quoted(text)}")

    return read


def times(option: str, text: str, most: int) -> list[float]:
    """Read the times [s] that an option lists, such as "0 ns,5 ns"; at most `most` of them.

    >>> times("--times", "0 ns, 5 ns", 10)
    [0.0, 5e-09]
    """
    texts, values = [time.strip() for time in text.split(",")], list[float]()
    if len(texts) > most:
        raise ValueError(f"{option}: give at most {most:,} values, not {len(texts):,}")
    _check_units(option, texts)
    for position, time in enumerate(texts, 1):
        with place(f"{option}, value {position}"):
            values.append(read_number(time, "s"))
            if values[-1] < 0:
                raise ValueError(f"{quoted(time)} is negative: give a time of zero or more")
            if values[-1] > 1e250:
                raise ValueError(f"{quoted(time)} is not between 0 and 1e250 s")
    return values


def _check_units(option: str, texts: Sequence[str]) -> None:
    """Raise ValueError if some of the numbers have a unit and others, which are not 0, have none.

    >>> _check_units("--times", ["0", "5", "10 ns"])
    Traceback (most recent call last):
    ValueError: --times: '5' has no unit, and others have one: write "0 ns,5 ns,10 ns"
    """
    units = [typed_unit(text) for text in texts]
    plain = [
        text
        for text, unit in zip(texts, units, strict=True)
        if not unit and re.search("[1-9]", text)
    ]
    if plain and any(units):
        last = [unit for unit in units if unit][-1]
        meant = [text if typed_unit(text) else f"{text} {last}" for text in texts[:8]]
        listed = ",".join([*meant, "..."] if len(texts) > len(meant) else meant)
        raise ValueError(
            f'{option}: {quoted(plain[0])} has no unit, and others have one: write "{listed}"'
        )

"""Reading what a user wrote (files, TOML, numbers with units), and quoting it in one line."""

import re
import sys
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import Any

from reference.units import same_dimension, to_si


def quoted(text: object, longest: int = 60) -> str:
    r"""What a user wrote, as a message may show it: one line, texts with quotes, shortened.

    >>> quoted("\x1b[31m5 m\n")
    "'\\x1b[31m5 m\\n'"
    """
    # Python refuses to write out whole numbers of thousands of decimal digits.
    shown = hex(text) if isinstance(text, int) and abs(text) >= 10**longest else str(text)
    part = shown[:longest]
    end = "" if part == shown else "..."
    return f"{repr(part) if type(text) is str else one_line(part)}{end}"


def one_line(message: str, longest: int = 340) -> str:
    r"""A message as one line without control characters; if it is too long, without its middle.

    Its end says what would be right, and is kept; what the user wrote, maybe long, stands before.

    >>> one_line("no file\x07 of\nthis name"), one_line("no " + 99 * "x" + ": choose one", 30)
    ('no file\\x07 of this name', 'no xxxxxxxxxx...xx: choose one')
    """
    text = " ".join(message.split())
    safe = printable(text)
    kept = (longest - 3) // 2
    return safe if len(safe) <= longest else f"{safe[:kept]}...{safe[-kept - 1 :]}"


def printable(text: str) -> str:
    r"""Text in which Python's escapes stand for all that moves a terminal, or is not seen.

    >>> printable("a\nb\x1b[31m")
    'a\\nb\\x1b[31m'
    """
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


@contextmanager
def place(name: str) -> Iterator[None]:
    """Put before the message of a ValueError where it was that something was wrong.

    >>> with place("--step"):
    ...     read_number("x", "s")
    Traceback (most recent call last):
    ValueError: --step: 'x' is not a finite number with or without a unit, such as '1 s'
    """
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from error


_SIZE = 2**20
_DOTTED = re.compile(rb"""(?:\.[ \t]*(?:[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*){20}""")
"""A key of more than twenty parts; one of a megabyte would take hours to read."""


def _parsed(content: bytes) -> dict[str, Any]:
    if _DOTTED.search(content):
        raise ValueError("is nested too deep")
    try:
        # Notepad and others put a byte order mark before it.
        return tomllib.loads(content.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise ValueError("is not a TOML file: it is not UTF-8 text") from error
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"is not a TOML file: {one_line(str(error), 200)}") from error
    except RecursionError as error:
        raise ValueError("is nested too deep") from error
    except ValueError as error:
        most = sys.get_int_max_str_digits()
        raise ValueError(f"holds a whole number of more than {most} digits") from error


@contextmanager
def tables_of(
    path: Path, wanted: Sequence[str], allowed: Sequence[str] = ()
) -> Iterator[tuple[dict[str, dict[str, Any]], bytes]]:
    """The tables of a TOML file by name, and its bytes; a ValueError in the block names the file.

    Raises OSError, or ValueError for what is no TOML or has other tables than these, or is large.
    """
    if path.is_char_device():
        raise ValueError(f"{path} is a device, not a file")
    try:
        with path.open("rb") as file:
            content = file.read(_SIZE + 1)
    except OSError as error:
        error.filename = str(path)  # an error of reading, unlike one of opening, does not name it
        raise
    if len(content) > _SIZE:
        raise ValueError(f"{path} is larger than {_SIZE:,} bytes")
    with place(str(path)):
        document = _parsed(content)
        for name, table in document.items():
            if not isinstance(table, dict):
                raise ValueError(f"{quoted(name)} is not a table: begin with a line [{wanted[0]}]")
        check_keys(document, wanted, allowed)
        yield document, content


def check_keys(
    table: Mapping[str, Any], wanted: Iterable[str] = (), allowed: Iterable[str] = ()
) -> None:
    """Raise ValueError for a key that is neither wanted nor allowed, and for a missing one."""
    known = [*wanted, *allowed]
    for key in table:
        if key not in known:
            raise ValueError(f"there is no {quoted(key)} here: choose one of {', '.join(known)}")
    for key in wanted:
        if key not in table:
            raise ValueError(f"{quoted(key)} is missing")


_NUMBER = re.compile(
    r"(?P<number>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,4})?)\s*"
    r"(?P<unit>(?![\s.]|[eE]?[-+]?\d).*)"
)


def read_number(text: str, unit: str) -> float:
    """A number with or without a unit, as SI; `unit` tells what it must measure.

    Without a unit it is SI. Raises ValueError for no finite number, or one with another unit.

    >>> read_number("0.5 ns", "s"), read_number("1.1e-5", "m")
    (5e-10, 1.1e-05)
    """
    text = text.replace("\N{MINUS SIGN}", "-")  # as word processors write it
    match = _NUMBER.fullmatch(text.strip()) if len(text) < 400 else None
    if match is None:
        raise ValueError(
            f"{quoted(text, 40)} is not a finite number with or without a unit, such as '1 {unit}'"
        )
    given_unit = match["unit"]
    if given_unit[:1] == ",":
        raise ValueError(
            f"{text!r}: write a decimal comma as a point, and thousands without a comma"
        )
    if given_unit and not same_dimension(given_unit, unit):
        wrong = f"{given_unit} does not measure what {unit} does"
        raise ValueError(f"{text!r}: {'give no unit' if unit == '1' else wrong}")
    try:
        return float(Fraction(match["number"]) * to_si(given_unit or "1"))
    except OverflowError as error:
        raise ValueError(f"{quoted(text)} is not a finite number that a double can hold") from error


def read_numbers(table: Mapping[str, Any], units: Mapping[str, str]) -> dict[str, float]:
    """The numbers of a table as SI; `units` has the keys that it may have, and what they measure.

    Raises ValueError that names the key.

    >>> read_numbers({"step": "0.5 ns"}, {"radius": "m", "step": "s"})
    {'step': 5e-10}
    """
    check_keys(table, allowed=units)
    numbers = {}
    for key, value in table.items():
        with place(key):
            numbers[key] = read_number(str(value), units[key])
    return numbers

"""What a user wrote: files, TOML, numbers with units, read within bounds and quoted in one line."""

import math
import re
import sys
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from reference.units import quantity

_SIZE = 2**20
_DEPTH = 20
_QUOTED = 60
_NAME = 255


def quoted(text: object, longest: int = _QUOTED) -> str:
    r"""What a user wrote, as a message may show it: one line, texts with quotes, shortened.

    >>> quoted("\x1b[31m5 m\n")
    "'\\x1b[31m5 m\\n'"
    """
    shown = str(text)
    part = shown[:longest]
    end = "" if part == shown else "..."
    return f"{repr(part) if type(text) is str else one_line(part)}{end}"


def name_of(path: object) -> str:
    """The name of a file, as a message may show it: one line, and its end if it is very long."""
    name = str(path)
    return one_line(name if len(name) <= _NAME else f"...{name[-_NAME:]}")


def one_line(message: str, longest: int = 340) -> str:
    r"""A message as one line without control characters; if it is too long, without its middle.

    It ends with what would be right, and what a user wrote, however long, stands before that.

    >>> one_line("no file\x07 of\nthis name"), one_line("no " + 99 * "x" + ": choose one", 30)
    ('no file\\x07 of this name', 'no xxxxxxxxxx...xx: choose one')
    """
    text = " ".join(message.split())
    safe = "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)
    kept = (longest - 3) // 2
    return safe if len(safe) <= longest else f"{safe[:kept]}...{safe[-kept - 1 :]}"


def read_file(path: Path, largest: int = _SIZE) -> bytes:
    """The bytes of a file or a pipe, at most so many.

    Raises ValueError for a larger one and for a device, OSError where it cannot be read.
    """
    if path.is_char_device():
        raise ValueError(f"{name_of(path)} is a device, not a file")
    try:
        with path.open("rb") as file:
            content = file.read(largest + 1)
    except OSError as error:
        error.filename = str(path)  # an error of reading, unlike one of opening, does not name it
        raise
    if len(content) > largest:
        raise ValueError(f"{name_of(path)} is larger than {largest:,} bytes")
    return content


@contextmanager
def place(name: str) -> Iterator[None]:
    """Say where it was that something was wrong.

    >>> with place("--step"):
    ...     read_number("x", "s")
    Traceback (most recent call last):
    ValueError: --step: 'x' is no finite number with or without a unit, such as '1 s'
    """
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from error


class _Float(str):
    """A float as it is written; unlike a text it is shown without quotes."""

    __slots__ = ()
    __repr__ = str.__str__


_DOTTED = re.compile(rb"""(?:\.[ \t]*(?:[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*){%d}""" % _DEPTH)
"""A key of so many parts, which nests as deep; one of a megabyte would take hours to read."""


def parse_toml(content: bytes) -> dict[str, Any]:
    r"""A TOML document, its floats as they are written. Raises ValueError if it is none.

    >>> parse_toml(b"[impact]\nvelocity = 450.0")
    {'impact': {'velocity': 450.0}}
    """
    deepest = depth = 0
    for byte in content:
        depth += (byte in b"[{") - (byte in b"]}")
        deepest = max(deepest, depth)
    if deepest > _DEPTH or _DOTTED.search(content):
        raise ValueError(f"is nested more than {_DEPTH} deep")
    try:
        # Notepad and others put a byte order mark before it.
        return tomllib.loads(content.decode("utf-8-sig"), parse_float=_Float)
    except UnicodeDecodeError as error:
        raise ValueError("is no TOML file: it is not UTF-8 text") from error
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"is no TOML file: {one_line(str(error), 200)}") from error
    except ValueError as error:
        most = sys.get_int_max_str_digits()
        raise ValueError(f"holds a whole number of more than {most} digits") from error


def read_tables(
    path: Path, wanted: Sequence[str], allowed: Sequence[str] = ()
) -> tuple[dict[str, dict[str, Any]], bytes]:
    """The tables of a TOML file by name, and its bytes.

    Raises OSError, or ValueError that names the file: for what is no TOML, one table too many or
    too few, or what is no table.
    """
    content = read_file(path)
    with place(name_of(path)):
        document = parse_toml(content)
        for name, table in document.items():
            if not isinstance(table, dict):
                raise ValueError(f"{quoted(name)} is no table: begin with a line [{wanted[0]}]")
        check_keys(document, wanted, allowed)
    return document, content


def check_keys(
    table: Mapping[str, Any], wanted: Iterable[str] = (), allowed: Iterable[str] = ()
) -> None:
    """Raise ValueError for a key that is neither, or is wanted and missing."""
    known = [*wanted, *allowed]
    for key in table:
        if key not in known:
            raise ValueError(f"there is no {quoted(key)} here: choose of {', '.join(known)}")
    for key in wanted:
        if key not in table:
            raise ValueError(f"{quoted(key)} is missing")


def read_number(text: str, unit: str) -> float:
    """A number with or without a unit, as SI; `unit` tells what it must measure.

    Raises ValueError for what is no number, is not finite, or has another unit.

    >>> read_number("0.5 ns", "s")
    5e-10
    """
    try:
        number = float(text) if len(text) <= _QUOTED else math.nan
    except ValueError:
        number = math.nan
    if math.isnan(number) and text.strip().lower() not in ("nan", "+nan", "-nan"):
        try:
            number = float(quantity(text, unit))
        except OverflowError:
            number = math.inf
    if not math.isfinite(number):
        raise ValueError(f"{quoted(text)} is no finite number that a double can hold")
    return number

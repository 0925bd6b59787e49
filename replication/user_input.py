"""Read what a user wrote (files, TOML, numbers with units), and quote it in one line."""

import re
import sys
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from fractions import Fraction
from pathlib import Path
from typing import Any

from reference.printed import Interval, in_ascii, parse
from reference.units import same_dimension, to_si


def quoted(text: object, longest: int = 60) -> str:
    r"""Quote what a user wrote in a message: shortened, on one line, texts in quotation marks.

    >>> quoted("\x1b[31m5 m\n")
    "'\\x1b[31m5 m\\n'"
    """
    # Python refuses to convert integers of thousands of digits to decimal text.
    whole = hex(text) if isinstance(text, int) and abs(text) >= 10**longest else str(text)
    start = whole[:longest]
    return (repr(start) if type(text) is str else one_line(start)) + "..." * (start != whole)


def one_line(message: str, longest: int = 340) -> str:
    r"""Write a message as one line without control characters; cut the middle if it is too long.

    The end is kept, as it says what would be right. The user's own text, maybe long, comes before.

    >>> one_line("no file\x07 of\nthis name"), one_line("no " + 99 * "x" + ": choose one", 30)
    ('no file\\x07 of this name', 'no xxxxxxxxxx...xx: choose one')
    """
    text = " ".join(message.split())
    safe = printable(text)
    kept = (longest - 3) // 2
    return safe if len(safe) <= longest else f"{safe[:kept]}...{safe[-kept - 1 :]}"


def printable(text: str) -> str:
    r"""Replace characters that are invisible, or that control a terminal, by Python's escapes.

    >>> printable("a\nb\x1b[31m")
    'a\\nb\\x1b[31m'
    """
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


def advice(text: str, known: Iterable[str], otherwise: str | None = None) -> str:
    """Say which of the known names a user probably meant by an unknown one.

    Without a similar one it is `otherwise`, or all of them.

    >>> advice("velocty", ["velocity", "radius"]), advice("x", ["velocity", "radius"])
    ('did you mean velocity?', 'choose one of velocity, radius')
    """
    names = list(known)
    if similar := get_close_matches(text[:80], names, n=3):
        return f"did you mean {' or '.join(similar)}?"
    return f"choose one of {', '.join(names)}" if otherwise is None else otherwise


class KeyedError(ValueError):
    """An error in a value of a TOML file, with the keys that lead to it: the table, its key, ..."""

    def __init__(self, message: str, keys: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.keys = keys


@contextmanager
def place(name: str) -> Iterator[None]:
    """Prefix the message of any ValueError raised in the block with the name of the place.

    >>> with place("--step"):
    ...     read_number("x", "s")
    Traceback (most recent call last):
    ValueError: --step: 'x' is not a finite number with or without a unit, such as '1 s'
    """
    try:
        yield
    except KeyedError as error:
        raise KeyedError(f"{name}: {error}", error.keys) from error
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from error


@contextmanager
def within(*keys: str) -> Iterator[None]:
    """Let any ValueError raised in the block know that it is about the value of these keys."""
    try:
        yield
    except ValueError as error:
        inner = error.keys if isinstance(error, KeyedError) else ()
        raise KeyedError(str(error), (*keys, *inner)) from error


_LARGEST_FILE = 2**20
_DEEP_KEY = re.compile(rb"""(?:\.[ \t]*(?:[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*){20}""")
"""A dotted key of more than twenty parts: `tomllib` would take hours to read one of a megabyte."""


def _parsed(content: bytes) -> dict[str, Any]:
    if _DEEP_KEY.search(content):
        raise ValueError("is nested too deep")
    try:
        return tomllib.loads(content.decode("utf-8-sig"))  # some editors write a byte order mark
    except UnicodeDecodeError as error:
        raise ValueError("is not a TOML file: it is not UTF-8 text") from error
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"is not a TOML file: {one_line(str(error), 200)}") from error
    except RecursionError as error:
        raise ValueError("is nested too deep") from error
    except ValueError as error:  # from int()
        digits = sys.get_int_max_str_digits()
        raise ValueError(f"holds a whole number of more than {digits} digits") from error


def line_of(text: str, keys: Sequence[str]) -> int | None:
    r"""Return the line of a TOML text, counted from 1, on which the statement of these keys begins.

    No library that the project has says where a value stands, so the text is read statement by
    statement until one has the keys, or those of them that the head of its table has left. None if
    none has them, or if a statement goes on for so long that this would take too much time.

    >>> line_of("[impact]\n# in um\nradius = 11\nbeta = 3", ["impact", "beta"])
    4
    """
    if not keys:
        return None
    lines = text.replace("\r\n", "\n").split("\n")
    below_head: tuple[str, ...] | None = tuple(keys)
    first, tries = 0, 0
    for last, line in enumerate(lines):
        if last == first and (not line.strip() or line.lstrip().startswith("#")):
            first += 1
            continue
        if last > first and not _CLOSING.search(line):
            continue  # within a statement of several lines
        statement = "\n".join(lines[first : last + 1])
        try:
            table = tomllib.loads(statement)
        except ValueError:
            tries += 1
            if tries > _MOST_TRIES:
                return None
            continue
        is_head = statement.lstrip().startswith("[")
        left = _left_below(table, tuple(keys) if is_head else below_head)
        if left == ():
            return first + 1
        if is_head:
            below_head = left
        first, tries = last + 1, 0
    return None


def _left_below(table: Any, keys: tuple[str, ...] | None) -> tuple[str, ...] | None:
    """Return what is left of the keys at an empty table; () if all lead on, None if one does not.

    >>> _left_below({"inputs": {}}, ("inputs", "beta")), _left_below({"sweep": {}}, ("inputs",))
    (('beta',), None)
    """
    if keys is None:
        return None
    for count, key in enumerate(keys):
        if table == {}:
            return keys[count:]
        if not isinstance(table, dict) or key not in table:
            return None
        table = table[key]
    return ()


_CLOSING = re.compile(r"""[]}]|\"{3}|'{3}""")
"""What a line has with which a statement of several lines ends."""

_MOST_TRIES = 100


def content_of(path: Path, most: int) -> bytes:
    """Return the bytes of a file; if there are more than `most`, one more than that.

    Raises OSError that names the file, or ValueError for a device, which might never end.
    """
    if path.is_char_device():
        raise ValueError(f"{path} is a device, not a file")
    try:
        with path.open("rb") as file:
            return file.read(most + 1)
    except OSError as error:
        error.filename = str(path)  # an error while reading does not name the file by itself
        raise


@contextmanager
def tables_of(
    path: Path, wanted: Sequence[str], allowed: Sequence[str] = ()
) -> Iterator[tuple[dict[str, dict[str, Any]], bytes]]:
    """Read the tables of a TOML file, and its bytes; a ValueError in the block names the file.

    It names the line, too, if the error says `within` which keys it is. The file must have every
    table of `wanted`, and may have those of `allowed`. Raises OSError, or ValueError if the file is
    too large, is not TOML, or has other tables.
    """
    content = content_of(path, _LARGEST_FILE)
    if len(content) > _LARGEST_FILE:
        raise ValueError(f"{path} is larger than {_LARGEST_FILE:,} bytes")
    try:
        document = _parsed(content)
        for name, table in document.items():
            if not isinstance(table, dict):
                problem = f"{quoted(name)} is not a table: begin with a line [{wanted[0]}]"
                raise KeyedError(problem, (name,))
        check_keys(document, wanted, allowed)
        yield document, content
    except KeyedError as error:
        text, keys = content.decode("utf-8-sig"), error.keys
        line = line_of(text, keys) or line_of(text, keys[:-1])
        where = str(path) if line is None else f"{path}, line {line}"
        raise ValueError(f"{where}: {error}") from error
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def check_keys(
    table: Mapping[str, Any], wanted: Iterable[str] = (), allowed: Iterable[str] = ()
) -> None:
    """Raise ValueError if a key is neither wanted nor allowed, or if a wanted one is missing."""
    known = [*wanted, *allowed]
    for key in table:
        if key not in known:
            raise KeyedError(f"there is no {quoted(key)} here: {advice(key, known)}", (key,))
    for key in wanted:
        if key not in table:
            raise ValueError(f"{quoted(key)} is missing")


_NUMBER = re.compile(
    r"(?P<number>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,4})?)\s*"
    r"(?P<unit>(?![\s.]|[eE]?[-+]?\d).*)"
)
_TIMES_TEN = re.compile(r"(?<=[\d.])\s*(?:[×x*·]|\\times|\\cdot)\s*10\^([-+]?\d{1,4})")
"""A power of ten as it is printed, such as "×10^9"."""


def number_parts(text: str) -> tuple[str, str] | None:
    """Return a number and the unit with which it is written ("" for none), or None if it is none.

    The unit may be any text, known or not.

    >>> number_parts("5 ns"), number_parts("7.6×10⁹"), number_parts("ns")
    (('5', 'ns'), ('7.6e9', ''), None)
    """
    plain = _TIMES_TEN.sub(r"e\1", in_ascii(text.strip())) if len(text) < 400 else ""
    match = _NUMBER.fullmatch(plain)
    return None if match is None else (match["number"], match["unit"].strip())


def typed_unit(text: str) -> str:
    """Return the unit with which a number is written, known or not; "" for none.

    >>> typed_unit("5 ns"), typed_unit("5e-9"), typed_unit("ns")
    ('ns', '', '')
    """
    parts = number_parts(text)
    return parts[1] if parts else ""


def _number_and_unit(text: str, unit: str, usual: str = "") -> tuple[str, str]:
    """Return a number and its unit, or the usual one, or "1"; errors are those of `read_number`."""
    parts = number_parts(text)
    if parts is None:
        example = "" if unit == "1" else f" with or without a unit, such as '1 {usual or unit}'"
        raise ValueError(f"{quoted(text, 40)} is not a finite number{example}")
    number, given_unit = parts
    if given_unit[:1] == ",":
        raise ValueError(
            f"{text!r}: write a decimal comma as a point, and thousands without a comma"
        )
    if given_unit and not same_dimension(given_unit, unit):
        mismatch = f"{given_unit} does not measure what {unit} does"
        raise ValueError(f"{text!r}: {'give no unit' if unit == '1' else mismatch}")
    return number, given_unit or usual or "1"


def read_number(text: str, unit: str, usual: str = "") -> float:
    """Read a number, with or without a unit, and convert it to SI.

    Without a unit it is in the usual one, if that is given, and else taken as SI. `unit` is an SI
    unit of the quantity expected. Raises ValueError if the text is not a finite number, or its unit
    measures another quantity.

    >>> read_number("0.5 ns", "s"), read_number("1.1e-5", "m"), read_number("7.6×10⁹ Pa", "Pa")
    (5e-10, 1.1e-05, 7600000000.0)
    >>> read_number("11", "m", "um")
    1.1e-05
    """
    number, given_unit = _number_and_unit(text, unit, usual)
    try:
        return float(Fraction(number) * to_si(given_unit))
    except OverflowError as error:
        raise ValueError(f"{quoted(text)} is not a finite number that a double can hold") from error


def read_printed(text: str, unit: str) -> list[Interval]:
    """Read a number, with or without a unit, as printed text: all values (SI) that print like it.

    The first interval takes the last digit as significant, a zero, too. An integer that ends in
    zeros may have fewer significant digits: each further interval takes one less of them. `unit`
    and errors are as for `read_number`.

    >>> print(*read_printed("3.3 um", "m"), "and", *read_printed("700 MPa", "Pa"))
    [3.25E-6, 3.35E-6) and [6.995E+8, 7.005E+8) [6.95E+8, 7.05E+8) [6.5E+8, 7.5E+8)
    """
    number, given_unit = _number_and_unit(text, unit)
    printed, factor = parse(number), to_si(given_unit)
    return [printed.interval(quantum=quantum).scaled(factor) for quantum in printed.quanta]


def read_numbers(table: Mapping[str, Any], units: Mapping[str, str]) -> dict[str, float]:
    """Read the numbers of a table and convert them to SI; `units` has a unit for every allowed key.

    Raises ValueError, which names the key.

    >>> read_numbers({"step": "0.5 ns"}, {"radius": "m", "step": "s"})
    {'step': 5e-10}
    """
    check_keys(table, allowed=units)
    numbers = {}
    for key, value in table.items():
        with within(key), place(key):
            numbers[key] = read_number(str(value), units[key])
    return numbers

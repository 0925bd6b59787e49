"""Two maps of values, by sheet and address -> the list of cells in which they differ."""

import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from spreadsheets.plan import Place, Value

__all__ = ["Difference", "Values", "compare", "ulps_apart"]

Values = Mapping[str, Mapping[str, Value]]
"""Sheet -> address -> value; a blank cell is absent or holds the empty text."""


@dataclass(frozen=True, slots=True)
class Difference:
    """One cell that differs. None stands for a blank; `ulps` is None unless both are numbers."""

    sheet: str
    cell: str
    expected: Value | None
    found: Value | None
    ulps: int | None

    def __str__(self) -> str:
        apart = "" if self.ulps is None else f" ({self.ulps} ulp)"
        return f"{self.sheet}!{self.cell}: expected {self.expected!r}, found {self.found!r}{apart}"


def compare(
    expected: Values, found: Values, tolerances: Mapping[Place, float] | None = None
) -> list[Difference]:
    """The cells of either map whose values are not the same, in the order of `expected`.

    Numbers must be the same double, except where `tolerances` allows a cell (sheet, address) a
    distance. A sheet that only one map has differs in each of its cells.
    """
    allowed = tolerances or {}
    return [
        Difference(sheet, cell, wanted, got, _ulps(wanted, got))
        for sheet, cell, wanted, got in _pairs(expected, found)
        if not _same(wanted, got, allowed.get((sheet, cell), 0.0))
    ]


def ulps_apart(first: float, second: float) -> int:
    """How many steps from double to double lie between two finite numbers.

    >>> ulps_apart(1.0, 1.0000000000000002), ulps_apart(-0.0, 0.0)
    (1, 0)
    """
    return abs(_position(first) - _position(second))


def _pairs(
    expected: Values, found: Values
) -> Iterator[tuple[str, str, Value | None, Value | None]]:
    for sheet in dict.fromkeys([*expected, *found]):
        wanted, got = expected.get(sheet, {}), found.get(sheet, {})
        for cell in dict.fromkeys([*wanted, *got]):
            # Engines cannot tell a blank cell from a formula that gives the empty text.
            yield sheet, cell, _or_none(wanted.get(cell)), _or_none(got.get(cell))


def _or_none(value: Value | None) -> Value | None:
    return None if value == "" else value


def _same(wanted: Value | None, got: Value | None, distance: float) -> bool:
    if isinstance(wanted, float) and isinstance(got, float):
        return wanted == got or abs(wanted - got) <= distance
    # LibreOffice hands out TRUE as 1.0, which Python takes as equal.
    return wanted == got


def _ulps(wanted: Value | None, got: Value | None) -> int | None:
    if isinstance(wanted, float) and isinstance(got, float):
        return ulps_apart(wanted, got)
    return None


def _position(number: float) -> int:
    """The place of a double in the row of all doubles, zero at 0.0."""
    bits: int = struct.unpack("<q", struct.pack("<d", number))[0]
    return bits if bits >= 0 else -(bits & 0x7FFF_FFFF_FFFF_FFFF)

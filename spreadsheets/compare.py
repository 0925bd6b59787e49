"""Two maps of values, by sheet and address -> the list of cells in which they differ."""

import math
import struct
from collections.abc import Mapping
from dataclasses import dataclass

from spreadsheets.plan import Place, Value

Values = Mapping[str, Mapping[str, Value]]
"""Sheet -> address -> value; a blank cell is absent or holds the empty text."""


@dataclass(frozen=True, slots=True)
class Difference:
    """One cell that differs. None stands for a blank."""

    sheet: str
    cell: str
    expected: Value | None
    found: Value | None

    @property
    def distance(self) -> float:
        """How far the two lie apart; infinite where they are not both numbers, but not the same."""
        # LibreOffice hands out TRUE as 1.0, which Python takes as equal.
        if self.expected == self.found:
            return 0.0
        if isinstance(self.expected, float) and isinstance(self.found, float):
            return abs(self.expected - self.found)
        return math.inf

    @property
    def ulps(self) -> int | None:
        """The same in doubles; None unless both are numbers."""
        if isinstance(self.expected, float) and isinstance(self.found, float):
            return ulps_apart(self.expected, self.found)
        return None

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
    allowed, differences = tolerances or {}, []
    for sheet in dict.fromkeys([*expected, *found]):
        wanted, got = expected.get(sheet, {}), found.get(sheet, {})
        for cell in dict.fromkeys([*wanted, *got]):
            # Engines cannot tell a blank cell from a formula that gives the empty text.
            pair = (None if (v := held.get(cell)) == "" else v for held in (wanted, got))
            left = Difference(sheet, cell, *pair)
            if left.distance > allowed.get((sheet, cell), 0.0):
                differences.append(left)
    return differences


def ulps_apart(first: float, second: float) -> int:
    """How many steps from double to double lie between two finite numbers.

    >>> ulps_apart(1.0, 1.0000000000000002), ulps_apart(-0.0, 0.0)
    (1, 0)
    """
    return abs(_position(first) - _position(second))


def _position(number: float) -> int:
    """The place of a double in the row of all doubles, zero at 0.0."""
    bits: int = struct.unpack("<q", struct.pack("<d", number))[0]
    return bits if bits >= 0 else -(bits & 0x7FFF_FFFF_FFFF_FFFF)

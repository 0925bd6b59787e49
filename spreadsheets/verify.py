"""An .xlsx file and the values it must have -> what every engine on this machine makes of it."""

import math
import struct
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from spreadsheets.engines import Engine, EngineError, repairs_wrong_value
from spreadsheets.plan import Place, Value, WorkbookPlan

Values = Mapping[str, Mapping[str, Value]]
"""Sheet -> address -> value; a blank cell is absent or holds the empty text."""

OF_FUNCTIONS = 32 * 2.0**-52
"""How far a transcendental cell may lie from its value, relative to it.

LN, SIN, ASIN and a cube root are within one ulp in any C library, and flip the last digit of each
operation after them. The longest chain is the crater's: ASIN, SIN, SIN and twelve products, with
condition numbers of at most 2, so less than 32 ulp."""


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
            pair = (None if (v := values.get(cell)) == "" else v for values in (wanted, got))
            left = Difference(sheet, cell, *pair)
            if left.distance > allowed.get((sheet, cell), 0.0):
                differences.append(left)
    return differences


def ulps_apart(first: float, second: float) -> int:
    """How many steps from double to double lie between two finite numbers.

    >>> ulps_apart(1.0, 1.0000000000000002), ulps_apart(-0.0, 0.0)
    (1, 0)
    """

    def position(number: float) -> int:
        """The place in the row of all doubles, zero at 0.0."""
        bits: int = struct.unpack("<q", struct.pack("<d", number))[0]
        return bits if bits >= 0 else -(bits & 0x7FFF_FFFF_FFFF_FFFF)

    return abs(position(first) - position(second))


def tolerances(
    plan: WorkbookPlan, expected: Values, long_doubles: float = 0.0
) -> dict[Place, float]:
    """How far the value of a formula may lie from the expected one, where it may at all.

    long_doubles: for an engine of 80-bit long doubles, the bound on the rounding errors of our
    doubles, relative to the largest number of a cell's column, or to the cell's own where it stands
    alone.
    """
    sizes: dict[str, float] = {}
    numbers = [
        (place, cell, abs(value))
        for place, cell in plan.cells()
        if cell.formula and isinstance(value := expected[place[0]].get(place[1]), float)
    ]
    for _, cell, number in numbers:
        sizes[cell.column] = max(sizes.get(cell.column, 0.0), number)
    allowed = {
        place: OF_FUNCTIONS * number * cell.transcendental
        + long_doubles * (sizes[cell.column] if cell.column else number)
        for place, cell, number in numbers
    }
    return {place: distance for place, distance in allowed.items() if distance}


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetCheck:
    """One sheet in one engine. `cells` counts its formulas, which are all compared.

    tolerated: cells that pass through a function and lie within its tolerance. explained: cells
    that differ by no more than our doubles may lie from an engine's long doubles. unexplained:
    cells that differ by more, or in kind.
    """

    sheet: str
    cells: int
    tolerated: list[Difference] = field(default_factory=list)
    explained: list[Difference] = field(default_factory=list)
    unexplained: list[Difference] = field(default_factory=list)

    @property
    def counts(self) -> dict[str, int]:
        """How many cells there are of each kind, and the largest distance of any two numbers.

        differ: by more than the tolerance of a function.
        """
        distances = (d.ulps or 0 for d in self.tolerated + self.explained + self.unexplained)
        return {
            "cells": self.cells,
            "differ": len(self.explained) + len(self.unexplained),
            "explained": len(self.explained),
            "largest_ulps": max(distances, default=0),
            "tolerated": len(self.tolerated),
        }


@dataclass(frozen=True, slots=True, kw_only=True)
class EngineCheck:
    """What one engine makes of the file.

    `outcome` is "verified"; "differs", if any cell is unexplained; "missing"; "echoes", if it gives
    stored values back and so verifies nothing; or "failed". `reason` says more of the last three.
    seconds: of one recalculation, from the file to the values.
    """

    engine: str
    outcome: str
    version: str = ""
    reason: str = ""
    seconds: float = 0.0
    sheets: tuple[SheetCheck, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether there is nothing to complain of; a missing engine is no complaint."""
        return self.outcome in ("verified", "missing")


def verify(
    path: Path,
    plan: WorkbookPlan,
    expected: Values,
    engines: Sequence[Engine],
    *,
    long_doubles: float,
) -> list[EngineCheck]:
    """Recalculate a file in every engine and compare every cell with the value it must have.

    Numbers must be the same double, but for the `tolerances`.
    """
    return [_check(engine, path, plan, expected, long_doubles) for engine in engines]


def _check(
    engine: Engine, path: Path, plan: WorkbookPlan, expected: Values, long_doubles: float
) -> EngineCheck:
    made = partial(EngineCheck, engine=engine.name)
    if (reason := engine.missing()) is not None:
        return made(outcome="missing", reason=reason)
    try:
        made = partial(made, version=engine.version())
        with TemporaryDirectory(prefix="coldspray-") as folder:
            if not repairs_wrong_value(engine, Path(folder)):
                reason = "It verifies nothing: it gives stored values back, right or wrong."
                return made(outcome="echoes", reason=reason)
        start = time.perf_counter()
        found = engine.recalculate(path)
        seconds = time.perf_counter() - start
    except EngineError as error:
        return EngineCheck(engine=engine.name, outcome="failed", reason=str(error))
    formulas = Counter(sheet for (sheet, _), cell in plan.cells() if cell.formula)
    # The sheets that the file should have, or has got from the engine.
    sheets = {
        sheet: SheetCheck(sheet=sheet, cells=formulas[sheet])
        for sheet in dict.fromkeys([*expected, *found])
    }
    of_functions = tolerances(plan, expected)
    of_doubles = tolerances(plan, expected, long_doubles if engine.long_doubles else 0.0)
    for left in compare(expected, found):
        check, place = sheets[left.sheet], (left.sheet, left.cell)
        if left.distance <= of_functions.get(place, 0.0):
            check.tolerated.append(left)
        elif left.distance <= of_doubles.get(place, 0.0):
            check.explained.append(left)
        else:
            check.unexplained.append(left)
    outcome = "differs" if any(check.unexplained for check in sheets.values()) else "verified"
    return made(outcome=outcome, seconds=seconds, sheets=tuple(sheets.values()))

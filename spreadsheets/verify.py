"""An .xlsx file and the values it must have -> what every engine on this machine makes of it."""

import math
import struct
import time
from collections import Counter
from collections.abc import Mapping
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


@dataclass(slots=True)
class Difference:
    """One cell that differs, by so many doubles where both are numbers. None stands for a blank."""

    sheet: str
    cell: str
    expected: Value | None
    found: Value | None
    ulps: int | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        if isinstance(self.expected, float) and isinstance(self.found, float):
            self.ulps = ulps_apart(self.expected, self.found)

    @property
    def distance(self) -> float:
        """How far the two lie apart; infinite where they are not both numbers, but not the same."""
        # LibreOffice hands out TRUE as 1.0, which Python takes as equal.
        if self.expected == self.found:
            return 0.0
        if isinstance(self.expected, float) and isinstance(self.found, float):
            return abs(self.expected - self.found)
        return math.inf

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


@dataclass(slots=True, kw_only=True)
class SheetCheck:
    """One sheet in one engine. `cells` counts its formulas, which are all compared.

    differ: by more than the tolerance of a function. explained: differ by no more than our doubles
    may lie from an engine's long doubles. unexplained: differ by more, or in kind. tolerated: pass
    through a function and lie within its tolerance. largest_ulps: the distance of any two numbers.
    """

    sheet: str
    cells: int
    differ: int = 0
    explained: int = 0
    largest_ulps: int = 0
    tolerated: int = 0
    unexplained: list[Difference] = field(default_factory=list)

    def add(self, left: Difference, of_functions: float, of_doubles: float) -> None:
        """Count a difference; the bounds are those of its cell."""
        self.largest_ulps = max(self.largest_ulps, left.ulps or 0)
        if left.distance <= of_functions:
            self.tolerated += 1
            return
        self.differ += 1
        if left.distance <= of_doubles:
            self.explained += 1
        else:
            self.unexplained.append(left)


@dataclass(frozen=True, slots=True, kw_only=True)
class EngineCheck:
    """What one engine makes of the file.

    `outcome` is "verified"; "differs", if any cell is unexplained; "missing"; "echoes", if it gives
    stored values back and so verifies nothing; or "failed". `reason` says more of the last three.
    seconds: of one recalculation, from the file to the values.
    """

    engine: str
    version: str | None = None
    outcome: str
    reason: str | None = None
    seconds: float | None = None
    sheets: tuple[SheetCheck, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether there is nothing to complain of; a missing engine is no complaint."""
        return self.outcome in ("verified", "missing")


def verify(
    path: Path, plan: WorkbookPlan, expected: Values, engine: Engine, *, long_doubles: float
) -> EngineCheck:
    """Recalculate a file in an engine and compare every cell with the value it must have.

    Numbers must be the same double, but for the `tolerances`.
    """
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
        recalculated = engine.recalculate(path)
        seconds = time.perf_counter() - start
    except EngineError as error:
        return EngineCheck(engine=engine.name, outcome="failed", reason=str(error))
    formulas = Counter(sheet for (sheet, _), cell in plan.cells() if cell.formula)
    # The sheets that the file should have, or has got from the engine.
    sheets = {
        sheet: SheetCheck(sheet=sheet, cells=formulas[sheet])
        for sheet in dict.fromkeys([*expected, *recalculated])
    }
    of_functions = tolerances(plan, expected)
    of_doubles = tolerances(plan, expected, long_doubles if engine.long_doubles else 0.0)
    for left in compare(expected, recalculated):
        place = left.sheet, left.cell
        sheets[left.sheet].add(left, of_functions.get(place, 0.0), of_doubles.get(place, 0.0))
    outcome = "differs" if any(sheet.unexplained for sheet in sheets.values()) else "verified"
    return made(outcome=outcome, seconds=seconds, sheets=tuple(sheets.values()))

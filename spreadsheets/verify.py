"""An .xlsx file and the values it must have -> what every engine on this machine makes of it."""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from spreadsheets.compare import Difference, Values, compare
from spreadsheets.engines import ENGINES, Engine, EngineError, Recalculated, repairs_wrong_value
from spreadsheets.plan import Place, WorkbookPlan

__all__ = ["EngineCheck", "SheetCheck", "tolerances", "verify"]

OF_FUNCTIONS = 32 * 2.0**-52
"""How far a transcendental cell may lie from its value, relative to it.

LN, SIN, ASIN and a cube root are within one ulp in any C library, and flip the last digit of each
operation after them. The longest chain is the crater's: ASIN, SIN, SIN and twelve products, with
condition numbers of at most 2, so less than 32 ulp."""


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
        (place, cell, float(value))
        for place, cell in plan.cells()
        if cell.formula and isinstance(value := expected[place[0]].get(place[1]), float)
    ]
    for _, cell, number in numbers:
        sizes[cell.column] = max(sizes.get(cell.column, 0.0), abs(number))
    allowed = {}
    for place, cell, number in numbers:
        size = sizes[cell.column] if cell.column else abs(number)
        of_functions = OF_FUNCTIONS * abs(number) if cell.transcendental else 0.0
        if distance := of_functions + long_doubles * size:
            allowed[place] = distance
    return allowed


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetCheck:
    """One sheet in one engine. `cells` counts its formulas, which are all compared.

    tolerated: cells that pass through a function and lie within its tolerance. explained: cells
    that differ by no more than our doubles may lie from an engine's long doubles. unexplained:
    cells that differ by more, or in kind.
    """

    sheet: str
    cells: int
    tolerated: tuple[Difference, ...] = ()
    explained: tuple[Difference, ...] = ()
    unexplained: tuple[Difference, ...] = ()

    @property
    def differ(self) -> int:
        """How many cells differ by more than the tolerance of a function."""
        return len(self.explained) + len(self.unexplained)

    @property
    def largest_ulps(self) -> int:
        """The largest distance of any two numbers, tolerated ones included."""
        groups = (self.tolerated, self.explained, self.unexplained)
        return max((left.ulps or 0 for group in groups for left in group), default=0)


@dataclass(frozen=True, slots=True, kw_only=True)
class EngineCheck:
    """What one engine makes of the file.

    `outcome` is "verified"; "differs", if any cell is unexplained; "missing"; "echoes", if it gives
    stored values back and so verifies nothing; or "failed". `reason` says more of the last three.
    """

    engine: str
    outcome: str
    version: str = ""
    reason: str = ""
    seconds: float = 0.0
    """Time of one recalculation, from the file to the values."""
    sheets: tuple[SheetCheck, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether there is nothing to complain of; a missing engine is no complaint."""
        return self.outcome in ("verified", "missing")


def verify(
    path: Path,
    plan: WorkbookPlan,
    expected: Values,
    engines: Sequence[Engine] = ENGINES,
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
    reason = engine.missing()
    if reason is not None:
        return EngineCheck(engine=engine.name, outcome="missing", reason=reason)
    try:
        version = engine.version()
        if not _computes(engine):
            return EngineCheck(
                engine=engine.name,
                outcome="echoes",
                version=version,
                reason="It verifies nothing: it gives stored values back, right or wrong.",
            )
        start = time.perf_counter()
        found = engine.recalculate(path)
        seconds = time.perf_counter() - start
    except EngineError as error:
        return EngineCheck(engine=engine.name, outcome="failed", reason=str(error))
    sheets = _sheets(plan, expected, found, long_doubles if engine.long_doubles else 0.0)
    return EngineCheck(
        engine=engine.name,
        outcome="differs" if any(sheet.unexplained for sheet in sheets) else "verified",
        version=version,
        seconds=seconds,
        sheets=sheets,
    )


def _computes(engine: Engine) -> bool:
    with TemporaryDirectory(prefix="coldspray-") as folder:
        return repairs_wrong_value(engine, Path(folder))


def _sheets(
    plan: WorkbookPlan, expected: Values, found: Recalculated, long_doubles: float
) -> tuple[SheetCheck, ...]:
    """One check for each sheet that the file should have, or has got from the engine."""
    formulas = {
        sheet.name: sum(bool(cell.formula) for cell in sheet.cells.values())
        for sheet in plan.sheets
    }
    groups: dict[str, dict[str, list[Difference]]] = {
        sheet: {} for sheet in dict.fromkeys([*expected, *found])
    }
    beyond_functions = _places(compare(expected, found, tolerances(plan, expected)))
    beyond = _places(compare(expected, found, tolerances(plan, expected, long_doubles)))
    for left in compare(expected, found):
        place = left.sheet, left.cell
        group = "tolerated" if place not in beyond_functions else "explained"
        group = "unexplained" if place in beyond else group
        groups[left.sheet].setdefault(group, []).append(left)
    return tuple(
        SheetCheck(
            sheet=sheet,
            cells=formulas.get(sheet, 0),
            **{group: tuple(differences) for group, differences in of_sheet.items()},
        )
        for sheet, of_sheet in groups.items()
    )


def _places(differences: Sequence[Difference]) -> set[Place]:
    return {(left.sheet, left.cell) for left in differences}

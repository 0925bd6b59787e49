"""An .xlsx file and the values it must have -> what every engine on this machine makes of it."""

import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory

from spreadsheets.compare import Difference, Values, compare
from spreadsheets.engines import ENGINES, Engine, EngineError, Recalculated, repairs_wrong_value
from spreadsheets.plan import Place, WorkbookPlan

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
    tolerated: list[Difference] = field(default_factory=list)
    explained: list[Difference] = field(default_factory=list)
    unexplained: list[Difference] = field(default_factory=list)

    @property
    def counts(self) -> dict[str, int]:
        """How many cells there are of each kind, and the largest distance of any two numbers.

        differ: by more than the tolerance of a function.
        """
        groups = (self.tolerated, self.explained, self.unexplained)
        return {
            "cells": self.cells,
            "differ": len(self.explained) + len(self.unexplained),
            "explained": len(self.explained),
            "largest_ulps": max((left.ulps or 0 for left in chain(*groups)), default=0),
            "tolerated": len(self.tolerated),
        }


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
    made = partial(EngineCheck, engine=engine.name)
    reason = engine.missing()
    if reason is not None:
        return made(outcome="missing", reason=reason)
    try:
        made = partial(made, version=engine.version())
        with TemporaryDirectory(prefix="coldspray-") as folder:
            computes = repairs_wrong_value(engine, Path(folder))
        if not computes:
            reason = "It verifies nothing: it gives stored values back, right or wrong."
            return made(outcome="echoes", reason=reason)
        start = time.perf_counter()
        found = engine.recalculate(path)
        seconds = time.perf_counter() - start
    except EngineError as error:
        return EngineCheck(engine=engine.name, outcome="failed", reason=str(error))
    sheets = _sheets(plan, expected, found, long_doubles if engine.long_doubles else 0.0)
    outcome = "differs" if any(sheet.unexplained for sheet in sheets) else "verified"
    return made(outcome=outcome, seconds=seconds, sheets=sheets)


def _sheets(
    plan: WorkbookPlan, expected: Values, found: Recalculated, long_doubles: float
) -> tuple[SheetCheck, ...]:
    """One check for each sheet that the file should have, or has got from the engine."""
    formulas = Counter(sheet for (sheet, _), cell in plan.cells() if cell.formula)
    checks = {
        sheet: SheetCheck(sheet=sheet, cells=formulas[sheet])
        for sheet in dict.fromkeys([*expected, *found])
    }
    of_functions = tolerances(plan, expected)
    of_doubles = tolerances(plan, expected, long_doubles)
    for left in compare(expected, found):
        check, place = checks[left.sheet], (left.sheet, left.cell)
        if left.distance <= of_functions.get(place, 0.0):
            check.tolerated.append(left)
        elif left.distance <= of_doubles.get(place, 0.0):
            check.explained.append(left)
        else:
            check.unexplained.append(left)
    return tuple(checks.values())

"""Check that spreadsheet engines give the values that a workbook's cells must have."""

import math
import re
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from spreadsheets.engines import Engine, EngineError, SheetValues
from spreadsheets.plan import CellPlace, ShownValue, WorkbookPlan


def repairs_wrong_value(engine: Engine) -> bool:
    """Whether an engine corrects a wrong value that a file stores with a formula."""
    import xlsxwriter

    with TemporaryDirectory(prefix="coldspray-") as folder:
        path = Path(folder, "planted.xlsx")
        with xlsxwriter.Workbook(path) as workbook:
            sheet = workbook.add_worksheet("planted")
            sheet.write_number("A1", 6)
            sheet.write_formula("A2", "=A1*7", value=41)
        return engine.recalculate(path).get("planted", {}).get("A2") == 42


def inexact(plan: WorkbookPlan) -> set[CellPlace]:
    """Return the cells whose value depends on LN, EXP, SIN, ASIN, a cube root or ROUND.

    Their last digits depend on the program; all other values are the same double everywhere.
    """
    functions = re.compile(r"LN\(|EXP\(|SIN\(|\^|ROUND\(")
    sources = [place for place, cell in plan.cells.items() if functions.search(cell.formula)]
    return plan.dependents(sources)


OF_FUNCTIONS = 32 * 2.0**-52
"""Relative tolerance of the cells that `inexact` lists.

LN, EXP, SIN, ASIN and a cube root are within one ulp in any C library, and flip the last digit of
each operation after them. The longest chains are the crater's (ASIN, SIN, SIN, twelve products) and
the one back to the depth on the sheet Solve (EXP, LN, LN, ASIN, SIN, SIN, twenty products), with
condition numbers of at most 2 for the first and 1 for the second, so less than 32 ulp."""


@dataclass(frozen=True, slots=True)
class CellDifference:
    """A cell whose value is not the expected one. None stands for a blank cell."""

    sheet: str
    cell: str
    expected: ShownValue | None
    found: ShownValue | None


def compare(
    expected: SheetValues,
    recalculated: SheetValues,
    tolerances: Mapping[CellPlace, float] | None = None,
) -> list[CellDifference]:
    """Return the cells, of either map, whose values differ, in the order of `expected`.

    Numbers must be the same double, except in cells for which `tolerances` gives the largest
    absolute difference allowed. A sheet that only one map has differs in every cell.
    """
    allowed, differences = tolerances or {}, []
    for sheet in dict.fromkeys([*expected, *recalculated]):
        expected_cells, cells = expected.get(sheet, {}), recalculated.get(sheet, {})
        for cell in dict.fromkeys([*expected_cells, *cells]):
            # Engines cannot tell a blank cell from a formula that gives the empty text.
            pair = expected_cells.get(cell), cells.get(cell)
            right, value = (None if value == "" else value for value in pair)
            if right == value:  # also if True comes back as 1.0, as from LibreOffice
                continue
            distance = math.inf
            if isinstance(right, float) and isinstance(value, float):
                distance = abs(right - value)
            if distance > allowed.get((sheet, cell), 0.0):
                differences.append(CellDifference(sheet, cell, right, value))
    return differences


def tolerances(
    plan: WorkbookPlan, expected: SheetValues, long_doubles: float = 0.0
) -> dict[CellPlace, float]:
    """Return the allowed absolute error of every formula that gives a number; zero for most.

    long_doubles: for an engine that computes in long doubles, the bound on the rounding errors of
    our doubles. It is relative to the largest number among cells of `like` size, or to the number
    itself if it has no such cells.
    """
    numbers = [
        (place, cell.like or cell.key, abs(value))
        for place, cell in plan.cells.items()
        if cell.formula and isinstance(value := expected[place[0]].get(place[1]), float)
    ]
    largest: dict[str, float] = {}
    for _, like, number in numbers:
        largest[like] = max(largest.get(like, 0.0), number)
    functions = inexact(plan)
    return {
        place: OF_FUNCTIONS * number * (place in functions) + long_doubles * largest[like]
        for place, like, number in numbers
    }


def rounding_bound(steps: int, velocity: float, duration: float, depth: float) -> float:
    """Bound the rounding error of a sheet in doubles, relative to the largest number of a column.

    For n steps, impact velocity V [m/s], duration T [s] and final depth X [m] of the sheet, and
    u = 2^-53:

    - the inputs are rounded: that changes the deceleration a by at most 26 u (16 by the mass);
    - a row computes a dt in 12 operations, with a relative error of u each, and subtracts it from
      v. As all a dt add up to V, the error of the velocity is at most (n + 38) u V;
    - a row adds v dt to x: the errors of these sums are at most (n + 3) u X in all;
    - an error in v changes x by up to T times as much. Relative to X, that is T V / X times the
      error of v relative to V. An error in x changes a, which grows with x by at most a/x, by the
      same relative amount. The resistance damps both errors;
    - a depends on the squared velocity and on the area, with factors of at most 4.

    So no column has an error above 4 (2n + 41) max(1, T V / X) u of its largest number. Results
    take fewer than the 41 operations that are counted beside the rows.

    >>> f"{rounding_bound(131, 500.0, 2.62e-8, 7.669557e-6):.1e}"
    '2.3e-13'
    """
    stretch = duration * velocity / depth if depth else 1.0
    return 4 * (2 * steps + 41) * max(1.0, stretch) * 2.0**-53


@dataclass(frozen=True, slots=True)
class EngineCheck:
    """The result of verifying a file with one engine.

    outcome: "verified"; "differs" if any cell is wrong; "missing" if the engine is not installed;
    "echoes" if it returns stored values, so that it verifies nothing; or "failed". reason: explains
    the last three. seconds: time of one recalculation. cells: number of formulas. rounded: number
    of cells that differ within their tolerance. wrong: those that differ by more, or in kind.
    """

    engine: str
    version: str | None = None
    outcome: str = "verified"
    reason: str | None = None
    seconds: float | None = None
    cells: int = 0
    rounded: int = 0
    wrong: list[CellDifference] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        """Whether nothing speaks against the file; a missing engine does not."""
        return self.outcome in ("verified", "missing")


def verify(
    path: Path, plan: WorkbookPlan, expected: SheetValues, engine: Engine, *, long_doubles: float
) -> EngineCheck:
    """Recalculate a file with an engine and compare every cell, within its tolerance.

    long_doubles: as in `tolerances`, for an engine that computes in long doubles.
    """
    if (reason := engine.missing()) is not None:
        return EngineCheck(engine.name, outcome="missing", reason=reason)
    version = None
    try:
        version = engine.version()
        if not repairs_wrong_value(engine):
            reason = "It verifies nothing: it gives stored values back, right or wrong."
            return EngineCheck(engine.name, version, "echoes", reason)
        start = time.perf_counter()
        recalculated = engine.recalculate(path)
        seconds = time.perf_counter() - start
    except EngineError as error:
        return EngineCheck(engine.name, version, "failed", error.reason)
    allowed = tolerances(plan, expected, long_doubles if engine.long_doubles else 0.0)
    wrong = compare(expected, recalculated, allowed)
    formulas = sum(bool(cell.formula) for cell in plan.cells.values())
    rounded = len(compare(expected, recalculated)) - len(wrong)
    outcome = "differs" if wrong else "verified"
    return EngineCheck(engine.name, version, outcome, None, seconds, formulas, rounded, wrong)

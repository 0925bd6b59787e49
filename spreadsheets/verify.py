"""Whether real engines give the values that the cells of a workbook must have."""

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from spreadsheets.engines import Engine, EngineError, Values
from spreadsheets.plan import Place, Value, WorkbookPlan


def repairs_wrong_value(engine: Engine) -> bool:
    """Plant a wrong stored value beside a formula and tell whether the engine puts it right."""
    import xlsxwriter

    with TemporaryDirectory(prefix="coldspray-") as folder:
        path = Path(folder, "planted.xlsx")
        with xlsxwriter.Workbook(path) as workbook:
            sheet = workbook.add_worksheet("planted")
            sheet.write_number("A1", 6)
            sheet.write_formula("A2", "=A1*7", value=41)
        return engine.recalculate(path).get("planted", {}).get("A2") == 42


OF_FUNCTIONS = 32 * 2.0**-52
"""How far an inexact cell of the plan may lie from its value, relative to it.

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


def compare(
    expected: Values, recalculated: Values, tolerances: Mapping[Place, float] | None = None
) -> list[Difference]:
    """The cells of either map whose values are not the same, in the order of `expected`.

    Numbers must be the same double, except where `tolerances` allows a cell (sheet, address) a
    distance. A sheet that only one map has differs in each of its cells.
    """
    allowed, differences = tolerances or {}, []
    for sheet in dict.fromkeys([*expected, *recalculated]):
        right_values, values = expected.get(sheet, {}), recalculated.get(sheet, {})
        for cell in dict.fromkeys([*right_values, *values]):
            # Engines cannot tell a blank cell from a formula that gives the empty text.
            pair = right_values.get(cell), values.get(cell)
            right, given = (None if value == "" else value for value in pair)
            if right == given:  # TRUE, too, which LibreOffice hands out as 1.0
                continue
            distance = math.inf
            if isinstance(right, float) and isinstance(given, float):
                distance = abs(right - given)
            if distance > allowed.get((sheet, cell), 0.0):
                differences.append(Difference(sheet, cell, right, given))
    return differences


def tolerances(
    plan: WorkbookPlan, expected: Values, long_doubles: float = 0.0
) -> dict[Place, float]:
    """How far the number of a formula may lie from the expected one; for most, not at all.

    long_doubles: of an engine that computes in them, the bound on the rounding errors of our
    doubles, relative to the largest number of a cell's column, or to its own if it stands alone.
    """
    sizes: dict[str, float] = {}
    numbers = [
        (place, cell, abs(value))
        for place, cell in plan.cells()
        if cell.formula and isinstance(value := expected[place[0]].get(place[1]), float)
    ]
    for _, cell, number in numbers:
        sizes[cell.like] = max(sizes.get(cell.like, 0.0), number)
    return {
        place: OF_FUNCTIONS * number * (place in plan.inexact)
        + long_doubles * (sizes[cell.like] if cell.like else number)
        for place, cell, number in numbers
    }


def rounding_bound(steps: int, velocity: float, duration: float, depth: float) -> float:
    """How far a sheet in doubles may lie from exact arithmetic, relative to a column's largest.

    For n steps, impact velocity V [m/s], duration T [s] and final depth X [m] of the sheet, and
    u = 2^-53:

    - the inputs are rounded: that changes the deceleration a by at most 26 u (16 by the mass);
    - a row takes 12 operations to a dt, with a relative error of u each, and subtracts it from v.
      As all a dt together make V, the velocity is off by at most (n + 38) u V;
    - a row adds v dt to x: that is at most (n + 3) u X in all;
    - an error in v changes x by T times as much, so relative to X by T V / X times what it is
      relative to V; an error in x changes a, which rises with x by at most a/x, by the same
      relative amount; the resistance damps both;
    - a depends on the squared velocity and on the area, with factors of at most 4.

    So no column is off by more than 4 (2n + 41) max(1, T V / X) u of its largest number. Results
    take fewer than the 41 operations that are counted beside the rows.

    >>> f"{rounding_bound(131, 500.0, 2.62e-8, 7.669557e-6):.1e}"
    '2.3e-13'
    """
    stretch = duration * velocity / depth if depth else 1.0
    return 4 * (2 * steps + 41) * max(1.0, stretch) * 2.0**-53


@dataclass(frozen=True, slots=True)
class EngineCheck:
    """The result of verifying a file in one engine.

    `outcome` is "verified"; "differs", if any cell is wrong; "missing"; "echoes", if it gives
    stored values back and so verifies nothing; or "failed". `reason` says more of the last three.
    seconds: of one recalculation. cells: formulas compared. rounded: those that differ within their
    tolerance. wrong: those beyond, and those of another kind.
    """

    engine: str
    version: str | None = None
    outcome: str = "verified"
    reason: str | None = None
    seconds: float | None = None
    cells: int = 0
    rounded: int = 0
    wrong: list[Difference] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        """Whether the file is verified; an engine that is missing is no failure."""
        return self.outcome in ("verified", "missing")


def verify(
    path: Path, plan: WorkbookPlan, expected: Values, engine: Engine, *, long_doubles: float
) -> EngineCheck:
    """Recalculate a file in an engine and compare every cell, within the `tolerances`."""
    if (reason := engine.missing()) is not None:
        return EngineCheck(engine.name, outcome="missing", reason=reason)
    known = None
    try:
        known = engine.version()
        if not repairs_wrong_value(engine):
            reason = "It verifies nothing: it gives stored values back, right or wrong."
            return EngineCheck(engine.name, known, "echoes", reason)
        start = time.perf_counter()
        recalculated = engine.recalculate(path)
        seconds = time.perf_counter() - start
    except EngineError as error:
        return EngineCheck(engine.name, known, "failed", error.reason)
    allowed = tolerances(plan, expected, long_doubles if engine.long_doubles else 0.0)
    wrong = compare(expected, recalculated, allowed)
    formulas = sum(bool(cell.formula) for _, cell in plan.cells())
    rounded = len(compare(expected, recalculated)) - len(wrong)
    outcome = "differs" if wrong else "verified"
    return EngineCheck(engine.name, known, outcome, None, seconds, formulas, rounded, wrong)

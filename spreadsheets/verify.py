"""An .xlsx file and the values it must have -> what every engine on this machine makes of it."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory

from spreadsheets.compare import Difference, Values, compare, ulps_apart
from spreadsheets.engines import ENGINES, Engine, EngineError, Recalculated, repairs_wrong_value
from spreadsheets.plan import Place
from spreadsheets.readback import read
from spreadsheets.replica import has_long_doubles, replicate

__all__ = ["EngineCheck", "SheetCheck", "verify"]

_OF_LONG_DOUBLES = 1
"""How many ulps an engine's long doubles may lie from the replica's, both as doubles. The engine
hands out decimal digits, which are read as doubles: rounding twice can take the neighbor of the
double that rounding once takes, never another."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetCheck:
    """One sheet in one engine. `cells` counts its formulas, which are all compared.

    `tolerated` are the cells within a tolerance of their own, though not the same double.
    `explained` differ, and by no more than the engine's arithmetic makes them; `unbounded` differ,
    and this machine cannot tell by how much they may; `unexplained` differ for no such reason.
    """

    sheet: str
    cells: int
    tolerated: tuple[Difference, ...] = ()
    explained: tuple[Difference, ...] = ()
    unbounded: tuple[Difference, ...] = ()
    unexplained: tuple[Difference, ...] = ()

    @property
    def differ(self) -> int:
        """How many cells differ by more than a tolerance of their own."""
        return len(self.explained) + len(self.unbounded) + len(self.unexplained)

    @property
    def largest_ulps(self) -> int:
        """The largest distance of any two numbers, tolerated ones included."""
        groups = (self.tolerated, self.explained, self.unbounded, self.unexplained)
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
    expected: Values,
    tolerances: Mapping[Place, float] | None = None,
    engines: Sequence[Engine] = ENGINES,
) -> list[EngineCheck]:
    """Recalculate a file in every engine and compare every cell with the value it must have.

    `tolerances` allows cells (sheet, address) a relative distance; all others must be the same
    double. In an engine of long doubles a number may differ where two things hold: the formula
    as it stands in the file gives the expected double when calculated in doubles, and the engine's
    number, to an ulp, when calculated in long doubles. So the arithmetic is all that differs.
    """
    truth = _Truth(path, expected, tolerances or {})
    return [_check(engine, truth) for engine in engines]


@dataclass(frozen=True)
class _Truth:
    """What the file must give, and what its formulas give in other arithmetics, once asked for."""

    path: Path
    expected: Values
    tolerances: Mapping[Place, float]

    @cached_property
    def formulas(self) -> Mapping[str, int]:
        """Sheet -> number of formulas."""
        return {sheet: len(cells) for sheet, cells in read(self.path).formulas.items()}

    @cached_property
    def in_doubles_also(self) -> frozenset[Place]:
        """The cells whose formulas, calculated in doubles, give what is expected."""
        found = replicate(self.path)
        wrong = compare(self.expected, found, self.tolerances)
        places = {(sheet, cell) for sheet, cells in found.items() for cell in cells}
        return frozenset(places - {(left.sheet, left.cell) for left in wrong})

    @cached_property
    def in_long_doubles(self) -> Values:
        """All cells calculated in long doubles."""
        return replicate(self.path, "long double")


def _check(engine: Engine, truth: _Truth) -> EngineCheck:
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
        found = engine.recalculate(truth.path)
        seconds = time.perf_counter() - start
    except EngineError as error:
        return EngineCheck(engine=engine.name, outcome="failed", reason=str(error))
    sheets = tuple(_sheets(engine, truth, found))
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


def _sheets(engine: Engine, truth: _Truth, found: Recalculated) -> list[SheetCheck]:
    """One check for each sheet that the file has, should have, or has got from the engine."""
    beyond = {(left.sheet, left.cell) for left in compare(truth.expected, found, truth.tolerances)}
    groups: dict[str, dict[str, list[Difference]]] = {
        sheet: {} for sheet in dict.fromkeys([*truth.formulas, *truth.expected, *found])
    }
    for left in compare(truth.expected, found):
        tolerated = (left.sheet, left.cell) not in beyond
        group = "tolerated" if tolerated else _group(engine, truth, left)
        groups[left.sheet].setdefault(group, []).append(left)
    return [
        SheetCheck(
            sheet=sheet,
            cells=truth.formulas.get(sheet, 0),
            **{group: tuple(differences) for group, differences in held.items()},
        )
        for sheet, held in groups.items()
    ]


def _group(engine: Engine, truth: _Truth, left: Difference) -> str:
    """Where a difference belongs that no tolerance allows."""
    if not engine.long_doubles or left.ulps is None:
        return "unexplained"
    if (left.sheet, left.cell) not in truth.in_doubles_also:
        return "unexplained"
    if not has_long_doubles():
        return "unbounded"
    replica = truth.in_long_doubles.get(left.sheet, {}).get(left.cell)
    assert isinstance(left.found, float)  # it has a distance in ulps
    near = isinstance(replica, float) and ulps_apart(left.found, replica) <= _OF_LONG_DOUBLES
    return "explained" if near else "unexplained"

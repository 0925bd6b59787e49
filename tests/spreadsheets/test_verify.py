"""Verifying a file: what each engine makes of it, and which differences an arithmetic explains."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from spreadsheets import emit
from spreadsheets.engines import Engine, EngineError
from spreadsheets.engines.base import Cell as EngineCell
from spreadsheets.plan import Cell, SheetPlan, WorkbookPlan
from spreadsheets.verify import EngineCheck, SheetCheck, verify

SMALL = 0.1 + 0.2 - 0.29
CELLS = {
    "A1": Cell(key="a"),
    "B1": Cell(key="small", formula="=A1+0.2-0.29", column="like"),
    "B2": Cell(key="half", formula="=5*A1", column="like"),
    "B3": Cell(key="log", formula="=LN(A1)", transcendental=True),
    "B4": Cell(key="alone", formula="=A1*3"),
}
PLAN = WorkbookPlan(
    sheets=(
        SheetPlan(name="S", cells=CELLS, widths={}),
        SheetPlan(name="Empty", cells={}, widths={}),
    ),
    title="t",
)
VALUES = {"a": 0.1, "small": SMALL, "half": 0.5, "log": math.log(0.1), "alone": 0.1 * 3}
EXPECTED = emit.cell_values(PLAN, VALUES)
BOUND = 1e-14
"""Of half, the largest of its column, 5e-15: so much may SMALL be off, too."""


@pytest.fixture
def path(tmp_path: Path) -> Path:
    emit.write(tmp_path / "w.xlsx", emit.to_bytes(PLAN, VALUES))
    return tmp_path / "w.xlsx"


@dataclass
class Fake(Engine):
    """An engine that gives what is right, but for the cells it is told to give."""

    told: dict[str, float | str | None] = field(default_factory=dict)
    long_doubles: bool = False
    echoes: bool = False
    reason: str | None = None
    failure: str = ""
    name = "fake"

    def missing(self) -> str | None:
        return self.reason

    def _version(self) -> str:
        return "1.0"

    def _cells(self, path: Path) -> Iterator[EngineCell]:
        if path.name.startswith("planted"):
            yield "planted", "A2", 41.0 if self.echoes else 42.0
            return
        if self.failure:
            raise EngineError(self.name, self.failure)
        for address, value in ({**EXPECTED["S"], **self.told}).items():
            yield "S", address, value


def check(path: Path, engine: Engine) -> EngineCheck:
    (found,) = verify(path, PLAN, EXPECTED, [engine], long_doubles=BOUND)
    return found


def groups(found: EngineCheck) -> dict[str, list[str]]:
    """The addresses in each group of the first sheet."""
    names = ("tolerated", "explained", "unexplained")
    held = {name: [left.cell for left in getattr(found.sheets[0], name)] for name in names}
    return {name: cells for name, cells in held.items() if cells}


def test_an_engine_that_agrees_is_verified(path: Path) -> None:
    found = check(path, Fake())
    assert (found.outcome, found.version, found.passed) == ("verified", "1.0", True)
    assert found.seconds > 0
    assert found.sheets == (SheetCheck(sheet="S", cells=4), SheetCheck(sheet="Empty", cells=0))


def test_engines_of_this_machine(path: Path, engine: Engine) -> None:
    found = check(path, engine)
    assert found.outcome == "verified"
    assert found.sheets[0].differ == len(groups(found).get("explained", []))
    assert engine.long_doubles or found.sheets[0].differ == 0


@pytest.mark.parametrize(
    "told",
    [
        {"B2": 0.5 + 6e-15},
        {"B1": SMALL + 6e-15},
        {"B4": 0.3 + 4e-15},
        {"B2": None},
        {"B2": "0.5"},
        {"B2": "#NUM!"},
        {"A1": 0.1 + 2e-17},
        {"Z9": 1.0},
        {"B3": math.log(0.1) * (1 + 2e-14)},
    ],
    ids=str,
)
@pytest.mark.parametrize("long_doubles", [False, True])
def test_one_wrong_cell_is_enough(
    path: Path, told: dict[str, float | str | None], long_doubles: bool
) -> None:
    """Just beyond the bound, of another kind, an input, or a cell that nobody planned."""
    found = check(path, Fake(told, long_doubles))
    assert (found.outcome, found.passed) == ("differs", False)
    assert groups(found) == {"unexplained": list(told)}
    assert found.sheets[0].differ == 1


def test_one_ulp_is_a_difference(path: Path) -> None:
    found = check(path, Fake({"B2": math.nextafter(0.5, 1.0)}))
    assert (found.outcome, groups(found)) == ("differs", {"unexplained": ["B2"]})
    assert found.sheets[0].largest_ulps == 1


def test_a_transcendental_cell_does_not_differ(path: Path) -> None:
    found = check(path, Fake({"B3": math.nextafter(math.log(0.1), 0.0)}))
    assert (found.outcome, groups(found)) == ("verified", {"tolerated": ["B3"]})
    assert (found.sheets[0].differ, found.sheets[0].largest_ulps) == (0, 1)


def test_long_doubles_explain_what_is_small_for_its_column_or_itself(path: Path) -> None:
    near = {"B1": SMALL + 4e-15, "B2": 0.5 - 4e-15, "B4": 0.3 + 2e-15}
    found = check(path, Fake(near, long_doubles=True))
    assert (found.outcome, groups(found)) == ("verified", {"explained": list(near)})
    assert (found.sheets[0].differ, found.sheets[0].largest_ulps > 100) == (3, True)
    assert check(path, Fake(near)).outcome == "differs"


def test_an_echo_verifies_nothing(path: Path) -> None:
    found = check(path, Fake(echoes=True))
    assert (found.outcome, found.passed, found.sheets) == ("echoes", False, ())
    assert "verifies nothing" in found.reason


def test_a_missing_engine_is_no_failure(path: Path) -> None:
    found = check(path, Fake(reason="Install it."))
    assert (found.outcome, found.reason, found.passed) == ("missing", "Install it.", True)


def test_an_engine_that_fails_is_a_failure(path: Path) -> None:
    found = check(path, Fake(failure="out of luck"))
    assert (found.outcome, found.reason, found.passed) == ("failed", "fake: out of luck", False)


def test_a_sheet_that_is_lost_or_new_is_seen(path: Path) -> None:
    lost = {**EXPECTED, "Lost": {"A1": 1.0}}
    (found,) = verify(path, PLAN, lost, [Fake()], long_doubles=BOUND)
    assert [(s.sheet, s.differ) for s in found.sheets] == [("S", 0), ("Empty", 0), ("Lost", 1)]
    none = {"S": {}, "Empty": {}}
    (found,) = verify(path, PLAN, none, [Fake()], long_doubles=BOUND)
    assert [left.cell for left in found.sheets[0].unexplained] == ["A1", "B1", "B2", "B3", "B4"]

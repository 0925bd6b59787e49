"""Comparing values, every difference named; and what each engine makes of a file."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from workbooks import Fake

from spreadsheets import emit
from spreadsheets.engines import Engine
from spreadsheets.plan import Cell, SheetPlan, WorkbookPlan
from spreadsheets.verify import (
    Difference,
    EngineCheck,
    SheetCheck,
    Values,
    compare,
    ulps_apart,
    verify,
)

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


def fake(told: dict[str, Any] | None = None, **more: Any) -> Fake:
    """An engine that gives what is right, but for the cells it is told to give."""
    told = told or {}
    surplus = tuple(("S", address, told[address]) for address in told.keys() - CELLS.keys())
    cells = {**EXPECTED["S"], **told}
    return Fake(lambda s, at, value: cells[at] if s == "S" else value, surplus=surplus, **more)


def check(path: Path, engine: Engine) -> EngineCheck:
    return verify(path, PLAN, EXPECTED, engine, long_doubles=BOUND)


def groups(result: EngineCheck) -> dict[str, int]:
    """How many cells there are in each group of the first sheet."""
    sheet = result.sheets[0]
    counts = {"tolerated": sheet.tolerated, "explained": sheet.explained}
    counts |= {"unexplained": len(sheet.unexplained)}
    return {name: count for name, count in counts.items() if count}


def test_an_engine_that_agrees_is_verified(path: Path) -> None:
    result = check(path, fake())
    assert (result.outcome, result.version, result.passed) == ("verified", "1.0", True)
    assert result.seconds is not None
    assert result.seconds > 0
    assert result.sheets == (SheetCheck(sheet="S", cells=4), SheetCheck(sheet="Empty", cells=0))


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
def test_one_wrong_cell_is_enough(path: Path, told: dict[str, Any], long_doubles: bool) -> None:
    """Just beyond the bound, of another kind, an input, or a cell that nobody planned."""
    result = check(path, fake(told, long_doubles=long_doubles))
    assert (result.outcome, result.passed) == ("differs", False)
    assert groups(result) == {"unexplained": 1}
    assert [left.cell for left in result.sheets[0].unexplained] == list(told)
    assert result.sheets[0].differ == 1


@pytest.mark.parametrize(
    ("told", "long_doubles", "outcome", "group", "differ"),
    [
        ({"B2": math.nextafter(0.5, 1.0)}, False, "differs", "unexplained", 1),
        ({"B3": math.nextafter(math.log(0.1), 0.0)}, False, "verified", "tolerated", 0),
        ({"B1": SMALL + 4e-15, "B2": 0.5 - 4e-15}, True, "verified", "explained", 2),
        ({"B4": 0.3 + 2e-15}, True, "verified", "explained", 1),
        ({"B4": 0.3 + 2e-15}, False, "differs", "unexplained", 1),
    ],
)
def test_functions_are_tolerated_and_long_doubles_explained(
    path: Path,
    told: dict[str, Any],
    long_doubles: bool,
    outcome: str,
    group: str,
    differ: int,
) -> None:
    """What is small for its column, or for itself; one ulp of any other cell is a difference."""
    result = check(path, fake(told, long_doubles=long_doubles))
    assert (result.outcome, groups(result)) == (outcome, {group: len(told)})
    largest = max(ulps_apart(value, float(EXPECTED["S"][at])) for at, value in told.items())
    assert (result.sheets[0].differ, result.sheets[0].largest_ulps) == (differ, largest)


@pytest.mark.parametrize(
    ("engine", "outcome", "passed", "reason"),
    [
        (Fake(told=lambda *_: 41.0), "echoes", False, "It verifies nothing: it gives stored"),
        (Fake(reason="Install it."), "missing", True, "Install it."),
        (Fake(failure="out of luck"), "failed", False, "fake: out of luck"),
    ],
)
def test_an_engine_that_gives_no_values(
    path: Path, engine: Fake, outcome: str, passed: bool, reason: str
) -> None:
    result = check(path, engine)
    assert (result.outcome, result.passed, result.sheets) == (outcome, passed, ())
    assert result.reason is not None
    assert result.reason.startswith(reason)


def test_a_sheet_that_is_lost_or_new_is_seen(path: Path) -> None:
    def cells(expected: dict[str, Any], engine: Fake | None = None) -> dict[str, list[str]]:
        result = verify(path, PLAN, expected, engine or fake(), long_doubles=BOUND)
        return {s.sheet: [left.cell for left in s.unexplained] for s in result.sheets}

    lost = {**EXPECTED, "Lost": {"A1": 1.0}}
    assert cells(lost) == {"S": [], "Empty": [], "Lost": ["A1"]}
    added = replace(fake(), surplus=(("New", "A1", 1.0),))
    assert cells(EXPECTED, added) == {"S": [], "Empty": [], "New": ["A1"]}
    assert cells({"S": {}, "Empty": {}}) == {"S": ["A1", "B1", "B2", "B3", "B4"], "Empty": []}


# Two maps of values


def test_one_ulp_is_a_difference_and_empty_text_none() -> None:
    values: Values = {"S": {"A1": 1.0, "A2": "text", "A3": True}}
    assert compare(values, {"S": {**values["S"], "B1": ""}}) == []
    result = compare(values, {"S": {**values["S"], "A1": math.nextafter(1.0, 2.0)}})
    assert result == [Difference("S", "A1", 1.0, math.nextafter(1.0, 2.0))]
    assert str(result[0]) == "S!A1: expected 1.0, found 1.0000000000000002 (1 ulp)"


def test_only_named_cells_are_allowed_a_distance() -> None:
    expected, result = {"S": {"A1": 10.0, "A2": 10.0}}, {"S": {"A1": 10.1, "A2": 10.1}}
    (left,) = compare(expected, result, {("S", "A1"): 0.2})
    assert left.cell == "A2"
    assert len(compare(expected, result, {("S", "A1"): 0.05})) == 2  # it is not relative


@given(st.floats(allow_nan=False, allow_infinity=False, max_value=1e308))
def test_neighbors_are_one_ulp_apart(number: float) -> None:
    above = math.nextafter(number, math.inf)
    assert ulps_apart(number, above) == ulps_apart(above, number) == 1
    assert ulps_apart(-5e-324, 5e-324) == 2

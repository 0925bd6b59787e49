"""Verifying a file: what each engine makes of it, and which differences an arithmetic explains."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest
import xlsxwriter

from spreadsheets import verify as module
from spreadsheets.engines import Engine, EngineError
from spreadsheets.engines.base import Cell
from spreadsheets.replica import has_long_doubles, replicate
from spreadsheets.verify import EngineCheck, SheetCheck, verify

SMALL = 0.1 + 0.2 - 0.29
EXPECTED = {"S": {"A1": 0.1, "B1": SMALL, "B2": 0.5, "B3": math.log(0.1)}, "Empty": {}}
TOLERANCES = {("S", "B3"): 1e-15}

needs_long_doubles = pytest.mark.skipif(
    not has_long_doubles(), reason="NumPy has no 80-bit long doubles here"
)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return written(tmp_path / "w.xlsx", "=A1+0.2-0.29")


def written(path: Path, formula: str) -> Path:
    with xlsxwriter.Workbook(path) as book:
        sheet = book.add_worksheet("S")
        sheet.write_number("A1", 0.1)
        sheet.write_formula("B1", formula, value=SMALL)
        sheet.write_formula("B2", "=5*A1", value=0.5)
        sheet.write_formula("B3", "=LN(A1)", value=math.log(0.1))
        book.add_worksheet("Empty")
    return path


@dataclass
class Fake(Engine):
    """An engine that calculates with the replica, but for the cells it is told to give."""

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

    def _cells(self, path: Path) -> Iterator[Cell]:
        if path.name.startswith("planted"):
            yield "planted", "A2", 41.0 if self.echoes else 42.0
            return
        if self.failure:
            raise EngineError(self.name, self.failure)
        for address, value in ({**replicate(path)["S"], **self.told}).items():
            yield "S", address, value


def check(path: Path, engine: Engine) -> EngineCheck:
    (found,) = verify(path, EXPECTED, TOLERANCES, [engine])
    return found


def groups(found: EngineCheck) -> dict[str, list[str]]:
    """The addresses in each group of the first sheet."""
    names = ("tolerated", "explained", "unbounded", "unexplained")
    held = {name: [left.cell for left in getattr(found.sheets[0], name)] for name in names}
    return {name: cells for name, cells in held.items() if cells}


def test_an_engine_that_agrees_is_verified(path: Path) -> None:
    found = check(path, Fake())
    assert (found.outcome, found.version, found.passed) == ("verified", "1.0", True)
    assert found.seconds > 0
    assert found.sheets == (SheetCheck(sheet="S", cells=3), SheetCheck(sheet="Empty", cells=0))


def test_engines_of_this_machine(path: Path, engine: Engine) -> None:
    found = check(path, engine)
    assert found.outcome == "verified"
    assert found.sheets[0].differ == (1 if engine.long_doubles else 0)


@pytest.mark.parametrize(
    "told",
    [
        {"B2": 0.5 + 2**-52},
        {"B2": None},
        {"B2": "0.5"},
        {"B2": "#NUM!"},
        {"A1": 0.2},
        {"Z9": 1.0},
        {"B3": math.log(0.1) * (1 + 2e-15)},
    ],
    ids=str,
)
@pytest.mark.parametrize("long_doubles", [False, True])
def test_one_wrong_cell_is_enough(
    path: Path, told: dict[str, float | str | None], long_doubles: bool
) -> None:
    found = check(path, Fake(told, long_doubles))
    assert (found.outcome, found.passed) == ("differs", False)
    assert groups(found) == {"unexplained": list(told)}
    assert found.sheets[0].differ == 1


def test_one_ulp_is_a_difference(path: Path) -> None:
    found = check(path, Fake({"B2": math.nextafter(0.5, 1.0)}))
    assert (found.outcome, groups(found)) == ("differs", {"unexplained": ["B2"]})
    assert found.sheets[0].largest_ulps == 1


def test_a_cell_with_a_tolerance_does_not_differ(path: Path) -> None:
    found = check(path, Fake({"B3": math.nextafter(math.log(0.1), 0.0)}))
    assert (found.outcome, groups(found)) == ("verified", {"tolerated": ["B3"]})
    assert (found.sheets[0].differ, found.sheets[0].largest_ulps) == (0, 1)


@needs_long_doubles
def test_long_doubles_explain_what_they_give_and_no_more(path: Path) -> None:
    right = replicate(path, "long double")["S"]["B1"]
    assert isinstance(right, float)
    found = check(path, Fake({"B1": right}, long_doubles=True))
    assert (found.outcome, groups(found)) == ("verified", {"explained": ["B1"]})
    assert found.sheets[0].differ == 1
    assert found.sheets[0].largest_ulps > 10
    assert check(path, Fake({"B1": right})).outcome == "differs"
    near = math.nextafter(right, 1.0)
    assert check(path, Fake({"B1": near}, long_doubles=True)).outcome == "verified"
    off = math.nextafter(near, 1.0)
    assert check(path, Fake({"B1": off}, long_doubles=True)).outcome == "differs"


@needs_long_doubles
def test_a_wrong_formula_is_not_explained_by_long_doubles(
    tmp_path: Path, usable: Callable[[str], Engine]
) -> None:
    """Gnumeric and the replica agree on it; but in doubles it does not give what is expected."""
    wrong = written(tmp_path / "w.xlsx", "=A1+0.2-0.4")
    found = check(wrong, usable("gnumeric"))
    assert (found.outcome, groups(found)["unexplained"]) == ("differs", ["B1"])


def test_a_formula_that_the_replica_lacks_is_not_explained(
    tmp_path: Path, usable: Callable[[str], Engine]
) -> None:
    lacking = written(tmp_path / "w.xlsx", "=SUM(A1,0.2)-0.29")
    assert check(lacking, usable("gnumeric")).outcome == "differs"


def test_without_long_doubles_nothing_is_bounded(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "has_long_doubles", lambda: False)
    found = check(path, Fake({"B1": 0.0}, long_doubles=True))
    assert (found.outcome, groups(found)) == ("verified", {"unbounded": ["B1"]})
    assert check(path, Fake({"B1": "x"}, long_doubles=True)).outcome == "differs"


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
    (found,) = verify(path, {**EXPECTED, "Lost": {"A1": 1.0}}, TOLERANCES, [Fake()])
    assert [(s.sheet, s.differ) for s in found.sheets] == [("S", 0), ("Empty", 0), ("Lost", 1)]
    (found,) = verify(path, {}, {}, [Fake()])
    assert [left.cell for left in found.sheets[0].unexplained] == ["A1", "B1", "B2", "B3"]

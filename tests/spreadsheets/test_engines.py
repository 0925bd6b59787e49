"""Every engine recalculates, gives exact values of documented types, and fails in one line.

`verify` says whether an engine gives the values that a workbook must have.
"""

import math
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import xlsxwriter
from workbooks import BY_NAME, Fake, usable

from spreadsheets import emit, engines
from spreadsheets.engines import Engine, EngineError, SheetValues
from spreadsheets.plan import Cell, SheetPlan, WorkbookPlan
from spreadsheets.verify import CellDifference, EngineCheck, compare, verify

WRONG = 12345
"""Stored with every formula, so that an engine that gives the right value has computed it."""


INPUTS = {"A1": 0.1, "A2": 0.2, "A3": 6e-10, "A4": 1.25e-05, "A5": 7670.0, "A6": 3.0}
NUMBERS = {
    "B1": ("=A1+A2", 0.1 + 0.2),
    "B2": ("=1/A6", 1 / 3.0),
    "B3": ("=A3*A6", 6e-10 * 3.0),
    "B4": ("=A5*4/3*PI()*A4*A4", 7670.0 * 4 / 3 * math.pi * 1.25e-05 * 1.25e-05),
    "B5": ("=B4*A1", 7670.0 * 4 / 3 * math.pi * 1.25e-05 * 1.25e-05 * 0.1),
    "B6": ("=SQRT(A6)", math.sqrt(3.0)),
    "B7": ("=A1*1E300*1E-300", 0.1 * 1e300 * 1e-300),
}
"""Formulas of numbers, with Python's doubles for the same operations in the same order."""

OTHERS: dict[str, tuple[str, Any]] = {
    "C1": ('="cold "&"spray"', "cold spray"),
    "C2": ('="1"&"2"', "12"),
    "C3": ("=A6=3", True),
    "C4": ("=A6=4", False),
    "C5": ("=1/0", "#DIV/0!"),
    "C6": ("=NA()", "#N/A"),
    "C7": ('=""+1', "#VALUE!"),
    "C8": ("=nobody", "#NAME?"),
    "C9": ("=1E300*1E10*A6", "#NUM!"),
    "C10": ('=IF(ISNUMBER(A6),"","no")', None),
    "C11": ("=COUNT(A1:A99)", 6.0),
    "C12": ("=steps*2", 6.0),
}
"""Formulas with their documented values; None means no value."""

NOT_AVAILABLE = {
    "D11": ("=C6*2", "#N/A"),
    "D12": ("=IF(A6=3,1,C6)", 1.0),
    "D13": ("=IF(C6=3,1,2)", "#N/A"),
    "D14": ("=COUNT(C6,A6)", 1.0),
    "D15": ('=COUNTIF(C6:C6,"other")', 0.0),
    "D16": ('=IFERROR(C6,"not computed")', "not computed"),
    "D17": ("=ISNUMBER(C6)", False),
    "D18": ("=MIN(C6,A6)", "#N/A"),
    "D19": ("=INDEX(A1:A6,C6)", "#N/A"),
}
"""How #N/A is carried on, on which our own workbook relies."""

OTHERS |= NOT_AVAILABLE

LONG_DOUBLE_ERROR = 1e-15
"""Debian's Gnumeric rounds once, on reading its result; Python rounds each input and each step.
No chain above has more than nine roundings in all, and each is at most 2**-53 = 1.11e-16."""


@pytest.fixture(scope="module")
def workbook(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write a workbook with the formulas above, an odd name, an empty sheet and a chart sheet."""
    path = tmp_path_factory.mktemp("engines") / "formulas with spaces é.xlsx"
    with xlsxwriter.Workbook(path) as book:
        sheet = book.add_worksheet("Formulas")
        for place, number in INPUTS.items():
            sheet.write_number(place, number)
        for place, (formula, _) in (NUMBERS | OTHERS).items():
            sheet.write_formula(place, formula, value=WRONG)
        sheet.write_string("D1", "<b> & 'c'\nd ")
        sheet.write_boolean("D2", True)
        sheet.write_number("D3", 45000, book.add_format({"num_format": "yyyy-mm-dd"}))
        sheet.write_string("D4", "12")
        sheet.write_blank("Z99", None, book.add_format({"bold": True}))
        book.define_name("steps", "=Formulas!$A$6")
        book.add_worksheet("It's & <odd>").write_formula("AB30", "=Formulas!A6*2", value=WRONG)
        book.add_worksheet("Nothing")
        chart = book.add_chart({"type": "scatter"})
        chart.add_series({"categories": "=Formulas!$A$1:$A$6", "values": "=Formulas!$B$1:$B$6"})
        book.add_chartsheet("Chart").set_chart(chart)
    return path


@pytest.fixture(scope="module")
def recalculated(engine: Engine, workbook: Path) -> SheetValues:
    """Recalculate that workbook, once for each engine; the file and its folder do not change."""
    before = workbook.read_bytes()
    result = engine.recalculate(workbook)
    assert workbook.read_bytes() == before
    assert list(workbook.parent.iterdir()) == [workbook]
    return result


def test_an_engine_gives_each_value_as_documented(
    engine: Engine, recalculated: SheetValues
) -> None:
    """Numbers are exact, and a chart sheet has no values."""
    major, minor, *_ = engine.version().split(".")
    assert (major + minor).isdigit()
    assert list(recalculated) == ["Formulas", "It's & <odd>"]
    assert recalculated["It's & <odd>"] == {"AB30": 6.0}
    sheet, error = recalculated["Formulas"], LONG_DOUBLE_ERROR if engine.long_doubles else 0.0
    for place, (_, expected) in NUMBERS.items():
        assert abs(sheet[place] - expected) <= error * expected, place
    others = {place: value for place, (_, value) in OTHERS.items() if value is not None}
    typed = INPUTS | {"D1": "<b> & 'c'\nd ", "D2": True, "D3": 45000.0, "D4": "12"}
    assert {at: value for at, value in sheet.items() if at not in NUMBERS} == others | typed
    assert {type(sheet[place]) for place in (*INPUTS, *NUMBERS, "C11", "D3")} == {float}
    boolean = float if engine.name == "libreoffice" else bool
    assert {type(sheet[place]) for place in ("C3", "C4", "D2", "D17")} == {boolean}


def test_unreadable_file_is_a_one_line_error(
    engine: Engine, tmp_path: Path, workbook: Path
) -> None:
    path = tmp_path / "damaged.xlsx"
    for content in (b"a,b\n1,2\n", workbook.read_bytes()[:2000]):
        path.write_bytes(content)
        with pytest.raises(EngineError, match=f"^{engine.name}: [^\n]+$"):
            engine.recalculate(path)


def test_missing_engine_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    fake = Fake(reason="Fake is not installed: install it.")
    with pytest.raises(EngineError, match=r"^fake: Fake is not installed: install it\.$"):
        fake.recalculate(tmp_path / "any.xlsx")
    monkeypatch.setenv("PATH", "")
    for name in ("libreoffice", "gnumeric"):
        assert "install the system package" in (BY_NAME[name].missing() or "")


def test_libreoffice_that_fails_or_hangs_is_an_error_and_it_may_want_a_restart(
    workbook: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A script stands in for ``soffice``. No file is left behind."""
    engine, real = usable("libreoffice"), shutil.which("soffice")
    temporary, program, started = (tmp_path / name for name in ("temporary", "soffice", "started"))
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    for script, limit, reason in (
        ("echo chatter >&2; exit 3", 600, "soffice ended with status 3 before it answered"),
        # The test waits for the end of the process, so that it would hang if that was not killed.
        ("sleep 600", 1, "no answer within 1 s"),
        (f'[ -e {started} ] && exec {real} "$@"\ntouch {started}; exit 81', 120, ""),
    ):
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
        monkeypatch.setattr(engines, "TIME_LIMIT_S", limit)
        if reason:
            with pytest.raises(EngineError, match=f"^libreoffice: {reason}$"):
                engine.recalculate(workbook)
    assert engine.recalculate(workbook)["Formulas"]["B1"] == 0.1 + 0.2
    assert not list(temporary.iterdir())


# Verification of a workbook whose values are known

SMALL, LOG = 0.1 + 0.2 - 0.29, math.log(0.1)
CELLS = {
    "A1": Cell(key="a"),
    "B1": Cell(key="small", formula="=A1+0.2-0.29", like="half"),
    "B2": Cell(key="half", formula="=5*A1", like="half"),
    "B3": Cell(key="log", formula="=LN(A1)"),
    "B4": Cell(key="alone", formula="=A1*3"),
}
PLAN = WorkbookPlan(sheets=(SheetPlan(name="S", cells=CELLS), SheetPlan(name="Empty")))
VALUES = {"a": 0.1, "small": SMALL, "half": 0.5, "log": LOG, "alone": 0.1 * 3}
EXPECTED = emit.cell_values(PLAN, VALUES)
BOUND = 1e-14
"""Relative to "half", the largest number of its column: 5e-15, which is also allowed for SMALL."""


@pytest.fixture
def check(tmp_path: Path) -> Callable[..., EngineCheck]:
    """Return a function that verifies an engine which gives right values except in some cells."""
    path = tmp_path / "w.xlsx"
    path.write_bytes(emit.to_bytes(PLAN, VALUES))

    def check(
        given: dict[str, Any], expected: dict[str, Any] = EXPECTED, **more: Any
    ) -> EngineCheck:
        surplus = tuple(("S", address, given[address]) for address in given.keys() - CELLS.keys())
        cells = {**EXPECTED["S"], **given}
        engine = Fake(
            lambda s, at, value: cells[at] if s == "S" else value, **{"surplus": surplus, **more}
        )
        return verify(path, PLAN, expected, engine, long_doubles=BOUND)

    return check


@pytest.mark.parametrize(
    ("cell", "value", "outcomes"),
    [
        pytest.param("B2", 0.5 + 6e-15, ("differs", "differs"), id="above the bound"),
        pytest.param("B1", SMALL + 6e-15, ("differs", "differs"), id="above that of its column"),
        pytest.param("B4", 0.3 + 4e-15, ("differs", "differs"), id="above its own bound"),
        pytest.param("B2", None, ("differs", "differs"), id="blank"),
        pytest.param("B2", "0.5", ("differs", "differs"), id="a text"),
        pytest.param("B2", "#NUM!", ("differs", "differs"), id="an error"),
        pytest.param("A1", 0.1 + 2e-17, ("differs", "differs"), id="an input"),
        pytest.param("Z9", 1.0, ("differs", "differs"), id="a cell too many"),
        pytest.param("B3", LOG * (1 + 2e-14), ("differs", "differs"), id="a wrong logarithm"),
        pytest.param("B3", math.nextafter(LOG, 0.0), ("verified", "verified"), id="1 ulp of LN"),
        pytest.param("B2", math.nextafter(0.5, 1.0), ("differs", "verified"), id="1 ulp"),
        pytest.param("B4", 0.3 + 2e-15, ("differs", "verified"), id="below its own bound"),
    ],
)
def test_one_wrong_cell_is_enough(
    cell: str, value: Any, outcomes: tuple[str, str], check: Callable[..., EngineCheck]
) -> None:
    """One ulp is a difference, except in a cell of a function or in an engine of long doubles.

    outcomes: for an engine that computes in doubles, and for one that computes in long doubles.
    """
    for long_doubles, outcome in zip((False, True), outcomes, strict=True):
        result, good = check({cell: value}, long_doubles=long_doubles), outcome == "verified"
        assert (result.outcome, result.passed) == (outcome, good)
        assert [left.cell for left in result.wrong] == ([] if good else [cell])
        assert (result.version, result.cells, result.rounded) == ("1.0", 4, int(good))


def test_no_wrong_cell_and_several_rounded_ones(check: Callable[..., EngineCheck]) -> None:
    assert check({}).passed
    rounded = {"B1": SMALL + 4e-15, "B2": 0.5 - 4e-15}
    assert check(rounded, long_doubles=True).rounded == 2
    assert len(check(rounded, long_doubles=False).wrong) == 2


def test_a_sheet_that_is_lost_or_new_is_seen(check: Callable[..., EngineCheck]) -> None:
    lost = {**EXPECTED, "Lost": {"A1": 1.0}}
    assert check({}, lost).wrong == [CellDifference("Lost", "A1", 1.0, None)]
    assert check({}, surplus=(("New", "A1", 1.0),)).wrong == [
        CellDifference("New", "A1", None, 1.0)
    ]


def test_empty_text_is_blank_and_only_named_cells_are_allowed_a_distance() -> None:
    expected = {"S": {"A1": 10.0, "A2": 10.0, "A3": True}}
    result = {"S": {"A1": 10.1, "A2": 10.1, "A3": True, "B1": ""}}
    (left,) = compare(expected, result, {("S", "A1"): 0.2})
    assert left == CellDifference("S", "A2", 10.0, 10.1)
    assert len(compare(expected, result, {("S", "A1"): 0.05})) == 2  # it is not relative

"""`coldspray diff`: what changed between two workbooks, and what only moved."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from foreign import layouts, writers
from foreign.layouts import Foreign, moved

from replication.cases import BETA_5
from replication.check.diff import KINDS, Tolerance

Run = Callable[..., tuple[int, str, str]]
Diff = Callable[..., tuple[int, dict]]


@pytest.fixture
def diff(coldspray: Run, tmp_path: Path) -> Diff:
    """Compare table A-1 with a changed copy: the status and the record."""

    def run(change: Callable[[Foreign], None], *options: str) -> tuple[int, dict]:
        f, g = layouts.table_a1(BETA_5), layouts.table_a1(BETA_5)
        change(g)
        a = writers.with_openpyxl(f, tmp_path / "a.xlsx")
        b = writers.with_openpyxl(g, tmp_path / "b.xlsx")
        status, out, err = coldspray("diff", a, b, "--json", *options)
        assert err == ""
        return status, json.loads(out)

    return run


def kinds(record: dict) -> list[tuple[str, str, int]]:
    return [(d["kind"], d["cell"], d["count"]) for d in record["differences"]]


def test_a_formula_and_what_follows_are_told_apart(diff: Diff) -> None:
    def change(f: Foreign) -> None:
        f.put("Sheet1", "D60", "=D59+C60*0.0000000003")

    assert set(diff(change)[1]["summary"]) == {"formula", "value"}
    assert set(diff(change, "--values-only")[1]["summary"]) == {"value"}


def test_an_inserted_column_is_one_move_and_what_it_holds(diff: Diff) -> None:
    def insert(f: Foreign) -> None:
        moved(f, lambda r: r, lambda c: c + (c >= 4))
        for r in range(8, 140):
            f.put("Sheet1", f"D{r}", f"=C{r}*C{r}")

    _, record = diff(insert)
    assert sorted(kinds(record)) == [("added", "D8", 132), ("moved", "E1", 1)]


def test_a_reference_that_stays_behind_is_a_changed_formula(diff: Diff) -> None:
    def half(f: Foreign) -> None:
        moved(f, lambda r: r + 3 * (r >= 7), lambda c: c)
        f.put("Sheet1", "F50", "=C49-E50*0.0000000002")

    _, record = diff(half)
    assert ("formula", "F50", 1) in kinds(record)


def test_sheets_that_are_gone_renamed_and_new_come_in_their_order(
    coldspray: Run, tmp_path: Path
) -> None:
    f, g = layouts.table_a1(BETA_5), layouts.table_a1(BETA_5)
    for book, sheets in ((f, ("Gone", "Before")), (g, ("After", "New"))):
        for name, text in zip(
            sheets, ("this", "that") if book is f else ("that", "else"), strict=True
        ):
            for row in range(1, 20):
                book.put(name, f"A{row}", f"{text} {row}")
    a, b = (writers.with_openpyxl(x, tmp_path / f"{n}.xlsx") for x, n in ((f, "a"), (g, "b")))
    record = json.loads(coldspray("diff", a, b, "--json")[1])
    said = [(d["sheet"], d["explanation"]) for d in record["differences"]]
    assert said == [
        ("Gone", "the sheet is gone"),
        ("After", "the sheet is renamed"),
        ("New", "the sheet is new"),
    ]


def test_tolerances(diff: Diff) -> None:
    def nudge(f: Foreign) -> None:
        f.put("Sheet1", "B1", 1.1e-5 * (1 + 1e-14))

    assert diff(nudge)[0] == 1
    assert diff(nudge, "--relative", "1e-11")[0] == 0
    assert diff(nudge, "--digits", "9")[0] == 0
    assert diff(nudge, "--digits", "17")[0] == 1
    assert Tolerance(ulp=1).equal(1.0, 1.0 + 2**-52)
    assert not Tolerance(ulp=1).equal(1.0, 1.0 + 2**-51)
    assert not Tolerance(digits=3).equal(7.664, 7.666)
    assert Tolerance(digits=15).equal(10.037311494880546, 10.0373114948806)
    assert not Tolerance(digits=15).equal(10.0373114948805, 10.0373114948806)


@pytest.mark.parametrize(
    "option", [("--ulp", "x"), ("--ulp", "1.5"), ("--relative", "-1"), ("--relative", "nan"),
               ("--digits", "0"), ("--digits", "1e400"), ("--ulp", "9" * 400)],
)  # fmt: skip
def test_a_tolerance_that_is_none_is_explained(
    coldspray: Run, tmp_path: Path, option: tuple[str, str]
) -> None:
    a = writers.with_openpyxl(layouts.pasted(BETA_5), tmp_path / "a.xlsx")
    status, out, err = coldspray("diff", a, a, *option)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert option[0] in err
    assert "give a" in err


def test_text_page_and_junit_are_those_of_check(coldspray: Run, tmp_path: Path) -> None:
    f = layouts.french(BETA_5)
    a = writers.with_openpyxl(f, tmp_path / "a.xlsx")
    f.put("Données", "C8", 450)
    b = writers.with_openpyxl(f, tmp_path / "b.xlsx")
    assert coldspray("diff", a, b, "--html", b)[0] == 2
    page, junit = tmp_path / "d.html", tmp_path / "d.xml"
    status, out, _ = coldspray("diff", a, b, "--html", page, "--junit", junit)
    assert status == 1
    assert "Données!C8, value\n    was 500.0, is 450.0" in out
    assert "c0-C8" in page.read_text("utf-8")
    assert all(f'name="{kind}"' in junit.read_text("utf-8") for kind in KINDS)


def test_an_unreadable_file_is_named(coldspray: Run, tmp_path: Path) -> None:
    a = writers.with_openpyxl(layouts.pasted(BETA_5), tmp_path / "a.xlsx")
    status, _, err = coldspray("diff", a, tmp_path / "none.xlsx")
    assert status == 2
    assert "none.xlsx: there is no such file" in err

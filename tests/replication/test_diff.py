"""`coldspray diff`: what changed between two workbooks, and what only moved."""

import json
from pathlib import Path

import pytest
from foreign import writers
from foreign.layouts import made
from running import coldspray

from replication.cases import BETA_5
from replication.check.diff import KINDS, Tolerance


@pytest.mark.parametrize(
    ("options", "kinds"),
    [
        ("", {"formula", "value"}),
        ("--values-only", {"value"}),
        ("--values-only --relative 1e-11", set()),
        ("--values-only --digits 9", set()),
        ("--values-only --digits 17", {"value"}),
    ],
)
def test_options_say_what_is_compared(tmp_path: Path, options: str, kinds: set[str]) -> None:
    paths = []
    for name, formula in (("a.xlsx", "=2*B1"), ("b.xlsx", "=2*B1*(1+1E-14)")):
        f = made("table-a1", BETA_5)
        f.put("Sheet1", "B4", formula)
        paths.append(writers.with_openpyxl(f, tmp_path / name))
    status, out, err = coldspray("diff", *paths, "--json", *options.split())
    assert (status, err) == (bool(kinds), "")
    assert set(json.loads(out)["summary"]) == kinds


def test_tolerances() -> None:
    assert Tolerance(ulp=1).equal(1.0, 1.0 + 2**-52)
    assert not Tolerance(ulp=1).equal(1.0, 1.0 + 2**-51)
    assert not Tolerance(digits=3).equal(7.664, 7.666)
    assert Tolerance(digits=15).equal(10.037311494880546, 10.0373114948806)
    assert not Tolerance(digits=15).equal(10.0373114948805, 10.0373114948806)


def test_text_page_and_junit_are_those_of_check(tmp_path: Path) -> None:
    f = made("french", BETA_5)
    a = writers.with_openpyxl(f, tmp_path / "a.xlsx")
    f.put("Données", "C8", 450)
    b = writers.with_openpyxl(f, tmp_path / "b.xlsx")
    page, junit = tmp_path / "d.html", tmp_path / "d.xml"
    status, out, _ = coldspray("diff", a, b, "--html", page, "--junit", junit)
    assert status == 1
    assert "Données!C8, value\n    was 500.0, is 450.0" in out
    assert "c0-C8" in page.read_text("utf-8")
    assert all(f'name="{kind}"' in junit.read_text("utf-8") for kind in KINDS)

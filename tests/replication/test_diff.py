"""`coldspray diff`: what changed between two workbooks, and what only moved."""

import json
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from foreign import writers
from foreign.layouts import Foreign, made

from replication.cases import BETA_5
from replication.check.diff import KINDS, Tolerance

Run = Callable[..., tuple[int, str, str]]
Diff = Callable[..., tuple[int, dict]]


@pytest.fixture
def diff(coldspray: Run, tmp_path: Path) -> Diff:
    """Compare table A-1 with a changed copy: the status and the record."""

    def run(change: Callable[[Foreign], None], *options: str) -> tuple[int, dict]:
        f, g = made("table-a1", BETA_5), made("table-a1", BETA_5)
        change(g)
        a = writers.with_openpyxl(f, tmp_path / "a.xlsx")
        b = writers.with_openpyxl(g, tmp_path / "b.xlsx")
        status, out, err = coldspray("diff", a, b, "--json", *options)
        assert err == ""
        return status, json.loads(out)

    return run


def test_values_only(diff: Diff) -> None:
    changed = partial(Foreign.put, sheet="Sheet1", address="D60", content="=D59+C60*0.0000000003")
    assert set(diff(changed)[1]["summary"]) == {"formula", "value"}
    assert set(diff(changed, "--values-only")[1]["summary"]) == {"value"}


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


def test_text_page_and_junit_are_those_of_check(coldspray: Run, tmp_path: Path) -> None:
    f = made("french", BETA_5)
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

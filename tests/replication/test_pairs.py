"""`coldspray diff`: two workbooks, of which the second was made from the first by known changes."""

import json
from pathlib import Path

import pytest
from foreign import writers
from foreign.byhand import made
from foreign.pairs import PAIRS, Pair
from running import coldspray

from replication.cases import BETA_5
from replication.check.diff import Tolerance


@pytest.mark.parametrize("pair", PAIRS, ids=lambda pair: pair.title)
def test_the_first_difference_is_where_something_was_changed(pair: Pair, tmp_path: Path) -> None:
    paths = pair.written(tmp_path)
    status, out, err = coldspray("diff", *paths, *pair.options, "--json")
    assert (status, err) == (pair.status, "")
    first = json.loads(out)["first"] or {}
    # What is within a tolerance may still change what follows from it.
    if first.get("kind") in ("formula", "value") and not pair.options and pair.changed:
        assert f"{first['sheet']}!{first['cell']}" in pair.changed


@pytest.mark.parametrize(("options", "kinds"), [
    pytest.param((), ["formula", "value"], id="everything"),
    pytest.param(("--values-only",), ["value"], id="values"),
    pytest.param(("--values-only", "--relative=1e-11"), [], id="values within 1e-11"),
    pytest.param(("--values-only", "--digits=9"), [], id="nine digits"),
    pytest.param(("--values-only", "--digits=17"), ["value"], id="all digits"),
])  # fmt: skip
def test_options_say_what_is_compared(
    options: tuple[str, ...], kinds: list[str], tmp_path: Path
) -> None:
    """Of two sheets, one with a diameter 1e-14 times larger."""
    paths = []
    for name, formula in (("a.xlsx", "=2*B1"), ("b.xlsx", "=2*B1*(1+1E-14)")):
        f = made("table-a1", BETA_5)
        f.put("Sheet1", "B4", formula)
        paths.append(writers.with_xlsxwriter(f, tmp_path / name, writers.calculated(f)))
    status, out, err = coldspray("diff", *paths, "--json", *options)
    assert (status, err) == (int(bool(kinds)), "")
    assert list(json.loads(out)["summary"]) == kinds


@pytest.mark.parametrize(("tolerance", "a", "b", "equal"), [
    pytest.param(Tolerance(ulp=1), 1.0, 1.0 + 2**-52, True, id="one ulp"),
    pytest.param(Tolerance(ulp=1), 1.0, 1.0 + 2**-51, False, id="two ulp"),
    pytest.param(Tolerance(digits=3), 7.664, 7.666, False, id="7.66 and 7.67"),
    pytest.param(Tolerance(digits=15), 10.037311494880546, 10.0373114948806, True,
                 id="one is the other, rounded, but for its own last bit"),
    pytest.param(Tolerance(digits=15), 10.0373114948805, 10.0373114948806, False,
                 id="two fifteenth digits"),
])  # fmt: skip
def test_a_tolerance_says_when_numbers_are_equal(
    tolerance: Tolerance, a: float, b: float, equal: bool
) -> None:
    assert tolerance.equal(a, b) is equal


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
    assert 'name="value"' in junit.read_text("utf-8")

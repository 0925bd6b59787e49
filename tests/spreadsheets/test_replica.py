"""Workbooks calculated in doubles and in long doubles, against engines that do the same."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest
import xlsxwriter

from replication import workbook
from spreadsheets.compare import compare, ulps_apart
from spreadsheets.engines import Engine
from spreadsheets.replica import has_long_doubles, replicate

FORMULAS = [
    "=A1+A2*A3-A4/A5", "=A1^A3", "=(A1*A1)^(1/3)", "=-A1", "=+A1", "=A9", "=A9+1", "=SQRT(A3)",
    "=LN(A3)", "=LOG10(A3)", "=EXP(A2)", "=SIN(A2)", "=ASIN(A2)", "=ABS(-A1)", "=INT(-A2)",
    "=MIN(A1:A6)", "=MAX(A1:A6)", "=MAX(A9)", "=PI()", "=COUNT(A1:A9)", '=COUNTIF(A1:A9,"YES")',
    "=INDEX(A1:A6,3)", "=ROW(A5)", "=ISNUMBER(A6)", "=ISNUMBER(A1)", "=ISNUMBER(A9)",
    "=ISNUMBER(1/0)", '=IF(A1<A2,"less","more")', "=IF(A1=A2,1)", '=IF(ISNUMBER(A6),1/0,"")',
    "=AND(A1<A2,A3>A4)", "=OR(A1<A2,A3>A4)", "=NOT(A1<A2)", "=IFERROR(1/0,7)", "=IFERROR(A1,7)",
    '=A6&" or "&"no"', '=A6="YES"', '=A6<>"no"', '=A6>"no"', '=A6>=A1', '=A9=""', "=A9=0",
    "=A1<=A1", "=1/0", "=SQRT(-1)", '=""+1', "=A6+1", "=nobody", "=INDEX(A1:A6,9)", "=1/0&A6",
    "=two*2", "=TRUE", "=IF(1/0,1,2)", "=MIN(A1,1/0)", "=(1/0)=1", "=AND(A6)",
    "=ROUND(A2,0)", "=ROUND(-A5/2,0)", "=ROUND(-A1*A5/3,3)", "=ROUND(A5*1000/3,-2)",
]  # fmt: skip
"""Over A1 to A5 numbers, A6 "yes" and A9 blank."""

REFUSED = ["=NOW()", "=A1:A6", "=A1&A2", "=SIN(A1,A2)", '=COUNTIF(A1:A6,">0")', "=-A1:A6", "=1%"]


@pytest.fixture(scope="module")
def formulas(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("replica") / "formulas.xlsx"
    with xlsxwriter.Workbook(path) as book:
        sheet = book.add_worksheet("S")
        sheet.write_column("A1", [0.1, 0.7, 3.0, 1e-10, 7.0])
        sheet.write_string("A6", "yes")
        for column, texts in (("B", FORMULAS), ("C", REFUSED)):
            for row, formula in enumerate(texts, 1):
                sheet.write_formula(f"{column}{row}", formula, value=12345)
        sheet.write_formula("D1", "=D2")
        sheet.write_formula("D2", "=D1")
        book.define_name("two", "=S!$B$35")
        book.define_name("three", "=S!$A$3")
    return path


def test_functions_are_those_of_an_engine(formulas: Path, usable: Callable[[str], Engine]) -> None:
    found = usable("ironcalc").recalculate(formulas)["S"]
    ours = replicate(formulas)["S"]
    for row, formula in enumerate(FORMULAS, 1):
        one, other = ours.get(f"B{row}"), found.get(f"B{row}")
        if isinstance(one, float) and isinstance(other, float):
            # NumPy's functions are its own or the C library's, an engine's another's: an ulp each.
            assert math.isclose(one, other, rel_tol=2 * 2**-52), formula
        else:
            assert one == other, formula


def test_what_is_not_written_here_is_left_out(formulas: Path) -> None:
    assert not [cell for cell in replicate(formulas)["S"] if cell[0] in "CD"]


def test_workbook_in_doubles_is_that_of_an_engine(
    tmp_path: Path, usable: Callable[[str], Engine]
) -> None:
    """Functions of the C library too: here both call the same one."""
    path = tmp_path / "workbook.xlsx"
    workbook.write(path)
    found, ours = usable("ironcalc").recalculate(path), replicate(path)
    plan, _ = workbook.build()
    tolerances = dict.fromkeys(plan.transcendental, workbook.relative_tolerance())
    assert compare(found, ours, tolerances) == []


@pytest.mark.skipif(not has_long_doubles(), reason="NumPy has no 80-bit long doubles here")
def test_workbook_in_long_doubles_is_gnumerics(
    tmp_path: Path, usable: Callable[[str], Engine]
) -> None:
    path = tmp_path / "workbook.xlsx"
    workbook.write(path)
    found, ours = usable("gnumeric").recalculate(path), replicate(path, "long double")
    apart = compare(found, ours)
    assert {left.ulps for left in apart} <= {1}
    # The same formulas in doubles lie far off: the replica has not merely been lenient.
    assert max(left.ulps or 0 for left in compare(found, replicate(path))) > 1000


def test_a_constant_is_the_long_double_nearest_to_its_digits(tmp_path: Path) -> None:
    path = tmp_path / "w.xlsx"
    with xlsxwriter.Workbook(path) as book:
        sheet = book.add_worksheet("S")
        sheet.write_number("A1", 0.1)
        sheet.write_formula("A2", "=(A1+0.2-0.3)*10000000000")
    in_doubles = (0.1 + 0.2 - 0.3) * 1e10
    assert replicate(path)["S"]["A2"] == in_doubles
    if has_long_doubles():
        found = replicate(path, "long double")["S"]["A2"]
        assert isinstance(found, float)
        assert abs(found) < in_doubles / 1000
        assert ulps_apart(found, in_doubles) > 1000

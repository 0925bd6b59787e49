"""Formulas as their cells see them."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from openpyxl.formula.translate import Translator

from spreadsheets.foreign import LAST_COLUMN, LAST_ROW, Book
from spreadsheets.recalculation import Area, parse

NAMES = {"dt": "'my sheet'!$B$7", "HALF": "2E-10/2", "Loop": "LOOP+1", "'S'!OWN": "S!$A$1"}
BOOK = Book(Path("book.xlsx"), {"S": {}, "my sheet": {}, "Données": {}}, NAMES)


def shape(text: str, row: int = 9, column: int = 4) -> tuple[str, ...]:
    return parse(text, ("S", row, column), BOOK).shape


@pytest.mark.parametrize(
    ("text", "area"),
    [
        ("=C9", Area("S", 9, 3, 9, 3)),
        ("=$c$9", Area("S", 9, 3, 9, 3)),
        ("='my sheet'!B2:$D$4", Area("my sheet", 2, 2, 4, 4)),
        ("=Données!D4:B2", Area("Données", 2, 2, 4, 4)),
        ("=SUM(B:C)", Area("S", 1, 2, LAST_ROW, 3)),
        ("=SUM(3:4)", Area("S", 3, 1, 4, LAST_COLUMN)),
        ("=dt*2", Area("my sheet", 7, 2, 7, 2)),
        ("=own", Area("S", 1, 1, 1, 1)),
    ],
)
def test_what_a_formula_refers_to(text: str, area: Area) -> None:
    formula = parse(text, ("S", 9, 4), BOOK)
    assert formula.areas == (area,)
    assert formula.obstacle is None


def test_a_name_may_stand_for_a_calculation() -> None:
    formula = parse("=C9*half", ("S", 9, 4), BOOK)
    assert formula.for_engine({"S": "S0"}) == "=S0!C9*(2E-10/2)"
    assert formula.literals == (2e-10, 2.0)


@pytest.mark.parametrize("text", ["=loop", "=nowhere", "=Other!A1", "=A1048577", "=", "=1E"])
def test_what_cannot_be_followed_is_an_obstacle(text: str) -> None:
    assert parse(text, ("S", 9, 4), BOOK).obstacle is not None or text == "="


FORMULAS = ("=D8+C9*$B$7", "=(0.5*$B$4*C9^2+$B$6)*PI()*($B$4*D9-D9^2)/B$3", "=SUM(A1:$B9)-dt")


@given(st.sampled_from(FORMULAS), st.integers(20, 900), st.integers(9, 90))
def test_filling_keeps_the_shape(text: str, row: int, column: int) -> None:
    from openpyxl.utils.cell import get_column_letter

    place = f"{get_column_letter(column)}{row}"
    moved = Translator(text, "E9").translate_formula(place)
    assert shape(moved, row, column) == shape(text, 9, 5)


def test_another_reference_or_number_is_another_shape() -> None:
    assert shape("=D8+C9*$B$7") == shape("=D8 + C9*$B$7")
    assert shape("=D8+C9*$B$7") != shape("=D7+C9*$B$7")
    assert shape("=D8+C9*$B$7") != shape("=D8+C9*B7")
    assert shape("=D8*2") != shape("=D8*3")


@given(st.text(alphabet="ABCabc019$!:'\"(){}[]+-*/^&,;.%#@ \t\nµ€", max_size=60))
def test_no_text_is_too_odd(text: str) -> None:
    parse(f"={text}", ("S", 9, 4), BOOK)

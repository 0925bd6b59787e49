"""Formulas as their cells see them."""

from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st
from kept import kept
from openpyxl.formula.translate import Translator

from spreadsheets.foreign import Book
from spreadsheets.recalculation import parse

NAMES = {"dt": "'my sheet'!$B$7", "HALF": "2E-10/2", "Loop": "LOOP+1", "'S'!OWN": "S!$A$1"}
BOOK = Book(Path("book.xlsx"), {"S": {}, "my sheet": {}, "Données": {}}, NAMES)


def shape(text: str, row: int = 9, column: int = 4) -> tuple[str, ...]:
    return parse(text, ("S", row, column), BOOK).shape


@kept("spreadsheets/kept.txt", "Formulas in D9, as an engine is given them")
def test_what_a_formula_refers_to(question: str, answer: str) -> None:
    formula = parse(question, ("S", 9, 4), BOOK)
    told = f"not computed: {formula.obstacle}"
    if formula.obstacle is None:
        cells = "; ".join(
            f"rows {a.top} to {a.bottom}, columns {a.left} to {a.right} of {a.sheet}"
            for a in formula.areas
        )
        short = {"S": "S0", "my sheet": "S1", "Données": "S2"}
        numbers = f", numbers {formula.literals}" if formula.literals else ""
        told = f"{formula.for_engine(short)}, reads {cells or 'nothing'}{numbers}"
    assert told == answer


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

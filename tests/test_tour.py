"""The tour for a class: each cell of `docs/tour.ipynb` runs, and gives what the notebook shows.

To renew what it shows, run `python tests/notebook.py`.
"""

import re
from collections.abc import Iterator
from typing import Any

import matplotlib as mpl
import pytest
from matplotlib.figure import Figure
from notebook import TOUR, Output, executed

Cell = tuple[dict[str, Any], list[Output], Any]

TINY = re.compile(r"\d(?:\.\d+)?e-(?:0[5-9]|1\d)\b")
"""Sizes of rounding errors, which depend on the logarithm and the sine of the machine."""


@pytest.fixture(scope="module")
def cells() -> Iterator[list[Cell]]:
    """The cells of code; two seconds, most of which Matplotlib and Numba take to load."""
    with mpl.rc_context({"backend": "agg"}):
        from matplotlib import pyplot as plt

        yield list(executed(TOUR))
        plt.close("all")


def texts(outputs: list[Output]) -> list[str]:
    """Return what outputs say: printed texts and values, tables of HTML; not pictures."""
    parts = []
    for output in outputs:
        parts += output.get("text", [])
        for form in ("text/plain", "text/html"):
            parts += output.get("data", {}).get(form, [])
    return [TINY.sub("tiny", part) for part in parts]


def test_each_cell_gives_what_the_notebook_shows(cells: list[Cell]) -> None:
    assert len(cells) > 10
    for cell, outputs, _ in cells:
        assert texts(outputs) == texts(cell["outputs"]), "".join(cell["source"])


def test_figures_have_axes_with_units(cells: list[Cell]) -> None:
    figures = [value for _, _, value in cells if isinstance(value, Figure)]
    assert len(figures) == 3
    for figure in figures:
        (axes,) = figure.axes
        for label in (axes.get_xlabel(), axes.get_ylabel()):
            assert re.fullmatch(r"[A-Z].* \[\S+\]", label)


def test_it_tells_of_all_five_parts_and_answers_what_it_asks(cells: list[Cell]) -> None:
    text = TOUR.read_text("utf-8")
    heads = re.findall(r"## (\d)\. ([A-Za-z ]+)", text)
    assert [head for head, _ in heads] == ["1", "2", "3", "4", "5"]
    _, *questions = text.split("**Question.**")
    assert [question.count("<summary>Answer</summary>") for question in questions] == [1] * 6

"""What `coldspray check` says about a few dozen workbooks, for people to read.

    python tests/foreign/messages.py > tests/foreign/messages.txt

writes the file that a test compares. Read every line that changes before you keep it. Numbers have
at most seven digits, so that the file is the same on every machine.
"""

import re
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
# The project must come first: folders of tests have the names of its packages.
sys.path.insert(0, str(Path(__file__).parents[2]))

from foreign.edits import Case, case
from foreign.spoiled import SECTIONS
from foreign.truth import CLEAN
from running import coldspray

KEPT = Path(__file__).with_suffix(".txt")

IN_FULL = (case("table-a1", CLEAN, layout="table-a1"), case("german", CLEAN, layout="german"))
"""Right workbooks of which the whole answer is kept."""

SHOWN = {
    "inputs": (
        "target density in g/cm3", "label of the radius in mm, the formulas take m",
        "resistance typed", "beta 4", "mass without a third", "mass with pi 3.14",
        "target density 8000", "radius negative", "impact velocity a text",
        "target density in the rows, not of its cell",
    ),
    "cells": (
        "D20 abc", "D20", "D20 =1/0", "C20 400", "two faults", "A20 abc", "A9 true", "C9", "C9 0.0",
        "C9 400", "D9", "D60", "F9 abc", "F20 =NA()", "a row gone",
        "first velocity ten times too large", "time of row 12 with the step typed",
        "labels of both results",
        "the largest depth of too few rows", "final depth by way of a column of X/R, in mm",
        "final X/R of the row before the last of a column",
        "deceleration with the wrong sign of x² in row 12",
    ),
    "columns": (
        "no half step", "depth by the row before", "drag without 1/2",
        "drag in the middle of the step", "area without x²", "velocity grows",
    ),
    "rows": ("rows 51", "rows 53", "a pasted depth", "8 um"),
    "tables": ("a steady motion", "a budget", "a velocity of the right table typed"),
    "given": ("map step=A1", "map depth=D8:D10", "numbers of a block"),
}  # fmt: skip
"""Changed workbooks of which the answer is kept up to its first difference."""


def all_of_them() -> Iterator[str]:
    """The lines of the file."""
    for each in IN_FULL:
        yield from _said(each, whole=True)
    for section, titles in SHOWN.items():
        by_title = {each.title: each for each in SECTIONS[section]}
        for title in titles:
            yield from _said(by_title[title], whole=False)


MOST = 9
"""So many lines of an answer are kept, up to the first difference and what is said of it."""


def _said(each: Case, *, whole: bool) -> Iterator[str]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "book.xlsx")
        each.written(path)
        options = [f"--map={name}={cells}" for name, cells in each.given.items()]
        status, out, err = coldspray("check", path, *options)
    text = (out + err).replace(str(path), "book.xlsx").rstrip("\n")
    lines = text.split("\n")
    yield f"## {each.title} -> {status}"
    yield from (_shown(line) for line in (lines if whole else lines[:MOST]))
    yield ""


def _shown(line: str) -> str:
    """A line with seven digits of each number."""
    number = r"(?<![\w.])\d+\.\d+(?:[eE][-+]?\d+)?(?!\w)"
    return re.sub(number, lambda m: f"{float(m[0]):.7g}", line).rstrip()


if __name__ == "__main__":
    print(*all_of_them(), sep="\n")

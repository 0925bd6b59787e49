"""Measure how well `coldspray check` does on workbooks that it has not made.

`python tests/foreign/rates.py` prints the tables of docs/check.md; the tests measure them again.
"""

import math
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator
from functools import cache, partial
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
# The project must come first: folders of tests have the names of its packages.
sys.path.insert(0, str(Path(__file__).parents[2]))

from foreign import writers
from foreign.drawn import drawn
from foreign.faults import FAULTS, Planted
from foreign.layouts import BY_HAND, Foreign, made

from replication.cases import BETA_3, BETA_5
from replication.check.workbook import Check, check
from replication.models.impact import Impact
from replication.models.sheet import run

DRAWN = range(24)
AFRESH = range(3000, 3040)
"""The seeds that the tests use, and those of `main` alone: nobody tuned the program to these."""
CASES = (BETA_5, BETA_3)


def by_hand(impact: Impact) -> list[Foreign]:
    """Every layout, filled with that impact."""
    return [made(layout, impact) for layout in BY_HAND]


def workbooks(made_by: str) -> list[Foreign]:
    """The right workbooks that a program writes; fewer for LibreOffice, which is slow."""
    if made_by.startswith("LibreOffice"):
        return by_hand(BETA_5)[: 20 if made_by.endswith("xlsx") else 8]
    books = [f for impact in CASES for f in by_hand(impact)]
    return books + [drawn(seed, CASES[seed % 2]) for seed in DRAWN if made_by == "openpyxl"]


def clean(f: Foreign, path: Path) -> bool:
    """Whether a right workbook is clean, and each column and input taken for what it is."""
    result = check(path)
    examination = result.examinations[0]
    columns = all(
        role in examination.table.lines and examination.table.place(role, k) == place
        for (role, k), place in f.where.items()
    )
    inputs = all(examination.inputs[name].place == place for name, place in f.inputs.items())
    return result.first is None and columns and inputs


@cache
def to_spoil() -> list[tuple[Foreign, writers.Values]]:
    """The workbooks that faults are planted in, with the values of their formulas."""
    books = by_hand(BETA_5) + [drawn(seed, CASES[seed % 2]) for seed in DRAWN[:6]]
    return [(f, writers.calculated(f)) for f in books]


def planted(
    fault: str, folder: Path, books: Iterable[tuple[Foreign, writers.Values]]
) -> Iterator[tuple[str, bool, bool]]:
    """Plant a fault in every workbook that can have it, and yield its name, found, and alone.

    Found: `_found`. Alone: nothing else is accused.
    """
    for f, values in books:
        if spoiled := FAULTS[fault](f, values):
            path = folder / "spoiled.xlsx"
            done = check(writers.written(spoiled.workbook, path, values, spoiled.wrong))
            yield f.name, _found(spoiled, done), len(done.causes) <= 1


def _found(spoiled: Planted, done: Check) -> bool:
    """Whether the kind, the cell, the order and the depth that should be are all right."""
    right = run(spoiled.workbook.impact).final_depth
    depths = [examination.right_depth for examination in done.examinations]
    if not any(depth and math.isclose(depth, right, rel_tol=1e-9) for depth in depths):
        return False
    accused = [done.first] if spoiled.status else done.differences
    is_named = any(d and d.kind == spoiled.kind and d.place in spoiled.cells for d in accused)
    return is_named and (done.first is not None) == spoiled.status


WRITERS = ("openpyxl", "like Excel", "LibreOffice .xlsx", "LibreOffice .ods", "LibreOffice .xls")
Row = tuple[str, list[str]]
"""A row of one of the two tables, and the names of the workbooks that failed."""


def right_row(made_by: str, folder: Path) -> Row:
    """Count the right workbooks that are clean."""
    books = workbooks(made_by)
    paths = [folder / f"{number}.xlsx" for number in range(len(books))]
    for f, path in zip(books, paths, strict=True):
        if made_by == "like Excel":
            writers.with_xlsxwriter(f, path, writers.calculated(f))
        else:
            writers.with_openpyxl(f, path)
    if made_by.startswith("LibreOffice"):
        paths = writers.with_libreoffice(paths, folder, made_by.rpartition(".")[2])
    missed = [f.name for f, path in zip(books, paths, strict=True) if not clean(f, path)]
    return f"| {made_by} | {len(books)} | {len(books) - len(missed)} |", missed


def planted_row(fault: str, folder: Path) -> Row:
    """Count the workbooks in which a fault is found."""
    result = list(planted(fault, folder, to_spoil()))
    missed = [name for name, good, _ in result if not good]
    alone = sum(lone for *_, lone in result)
    return f"| {fault} | {len(result)} | {len(result) - len(missed)} | {alone} |", missed


TABLES: dict[str, dict[str, Callable[[Path], Row]]] = {
    "| made by | right workbooks | clean |\n|---|---|---|":
        {made_by: partial(right_row, made_by) for made_by in WRITERS},
    "| planted | workbooks | found, named and placed | nothing else accused |\n|---|---|---|---|":
        {fault: partial(planted_row, fault) for fault in FAULTS},
}  # fmt: skip


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for head, rows in TABLES.items():
            print(f"\n{head}")
            for made_by, row in rows.items():
                if shutil.which("soffice") or not made_by.startswith("LibreOffice"):
                    print(row(folder)[0], flush=True)
        books = [drawn(seed, CASES[seed % 2]) for seed in AFRESH]
        good = sum(clean(f, writers.with_openpyxl(f, folder / "drawn.xlsx")) for f in books)
        some = [(f, writers.calculated(f)) for f in books[:10]]
        result = [entry for fault in FAULTS for entry in planted(fault, folder, some)]
        print(f"\nDrawn afresh: {good} of {len(books)} clean, "
              f"{sum(entry[1] for entry in result)} of {len(result)} faults found")  # fmt: skip


if __name__ == "__main__":
    main()

"""What `coldspray check` says of some five hundred workbooks, against the file that a person read.

`python tests/foreign/said.py > tests/foreign/said.txt` makes that file anew. How well it does on
foreign workbooks is measured against the tables that docs/check.md prints.
"""

from collections.abc import Callable
from pathlib import Path

import pytest
from foreign import rates, said
from workbooks import usable

BEFORE = Path(said.__file__).with_suffix(".txt").read_text("utf-8")
DOCUMENT = (Path(__file__).parents[2] / "docs" / "check.md").read_text("utf-8")
ROWS = {name: row for rows in rates.TABLES.values() for name, row in rows.items()}


def test_the_file_has_every_section() -> None:
    heads = [line[3:] for line in BEFORE.splitlines() if line.startswith("## ")]
    assert heads == list(said.SECTIONS)


@pytest.mark.parametrize("name", said.SECTIONS)
def test_it_says_what_it_said(name: str) -> None:
    head, _, rest = said.section(name).partition("\n")
    before = BEFORE.partition(f"{head}\n")[2].partition("\n## ")[0]
    assert rest.rstrip("\n").splitlines() == before.rstrip("\n").splitlines()


@pytest.mark.slow
@pytest.mark.parametrize("name", ROWS)
def test_it_does_as_well_as_the_page_says(name: str, tmp_path: Path) -> None:
    row: Callable[[Path], rates.Row] = ROWS[name]
    if name.startswith("LibreOffice"):
        usable("libreoffice")
    line, missed = row(tmp_path)
    assert not missed
    assert line in DOCUMENT


def test_the_corpus_is_as_large_as_the_page_says() -> None:
    layouts = len(rates.workbooks("like Excel")) // 2
    assert f"{layouts} by hand" in DOCUMENT
    assert f"{len(rates.DRAWN)} drawn" in DOCUMENT

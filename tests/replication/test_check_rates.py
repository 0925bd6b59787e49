"""How well `check` does on foreign workbooks, against the tables that docs/check.md prints."""

from collections.abc import Callable
from pathlib import Path

import pytest
from foreign import rates
from workbooks import usable

pytestmark = pytest.mark.slow

DOCUMENT = (Path(__file__).parents[2] / "docs" / "check.md").read_text("utf-8")
ROWS = {name: row for rows in rates.TABLES.values() for name, row in rows.items()}


@pytest.mark.parametrize(("name", "row"), ROWS.items(), ids=list(ROWS))
def test_it_does_as_well_as_the_page_says(
    name: str, row: Callable[[Path], rates.Row], tmp_path: Path
) -> None:
    if name.startswith("LibreOffice"):
        usable("libreoffice")
    line, missed = row(tmp_path)
    assert not missed
    assert line in DOCUMENT


def test_the_corpus_is_as_large_as_the_page_says() -> None:
    layouts = len(rates.workbooks("like Excel")) // 2
    assert f"{layouts} by hand" in DOCUMENT
    assert f"{len(rates.DRAWN)} drawn" in DOCUMENT

"""How well `check` does on foreign workbooks, against the tables that docs/check.md prints."""

from collections.abc import Callable
from pathlib import Path

import pytest
from foreign import rates
from foreign.faults import FAULTS, Planted
from workbooks import usable

pytestmark = pytest.mark.slow

DOCUMENT = (Path(__file__).parents[2] / "docs" / "check.md").read_text("utf-8")


@pytest.mark.parametrize("made_by", rates.WRITERS)
def test_right_workbooks_are_clean(made_by: str, tmp_path: Path) -> None:
    if made_by.startswith("LibreOffice"):
        usable("libreoffice")
    row, missed = rates.right_row(made_by, tmp_path)
    assert not missed
    assert row in DOCUMENT


@pytest.mark.parametrize("plant", FAULTS, ids=lambda plant: plant.__name__)
def test_planted_faults_are_found(plant: Callable[..., Planted | None], tmp_path: Path) -> None:
    row, missed = rates.planted_row(plant, tmp_path)
    assert not missed
    assert row in DOCUMENT


def test_the_corpus_is_as_large_as_the_page_says() -> None:
    layouts = len(rates.workbooks("like Excel")) // 2
    assert f"{layouts} by hand" in DOCUMENT
    assert f"{len(rates.DRAWN)} drawn" in DOCUMENT

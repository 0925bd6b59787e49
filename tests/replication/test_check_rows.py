"""`coldspray check FILE.csv`: the rows that somebody's own program wrote, right to their digits."""

import json
from pathlib import Path

import pytest
from running import coldspray

from replication import BETA_5, run
from spreadsheets.separated import cells_of

EXAMPLE = Path(__file__).parents[2] / "docs" / "rows.csv"


def written(depth_factor: float = 1.0, row: int = 0) -> str:
    """Return the rows of the sheet for beta = 5 as a program might print them.

    The depth of one row is multiplied by a factor.
    """
    lines = ["time [ns],velocity [m/s],depth [um]"]
    for k, (time, velocity, depth, *_) in enumerate(run(BETA_5).rows):
        factor = depth_factor if k == row else 1.0
        lines.append(f"{time * 1e9:.1f},{velocity:.3f},{depth * 1e6 * factor:.5f}")
    return "\n".join(lines) + "\n"


def test_the_example_is_clean_in_digits_that_the_sheet_rounds_to() -> None:
    assert EXAMPLE.read_text("utf-8") == written()
    status, out, err = coldspray("check", EXAMPLE)
    assert (status, err) == (0, "")
    assert "Clean: the report's sheet" in out


def test_a_wrong_row_is_named_by_its_line(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text(written(1.01, 40), "utf-8")  # row 0 is line 2
    status, out, _ = coldspray("check", file, "--json")
    assert status == 1
    assert json.loads(out)["first"]["cell"] == "C42"


def test_what_excel_writes_with_a_decimal_comma_is_clean_too(tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_text("\ufeff" + written().replace(",", ";").replace(".", ","), "utf-8")
    assert coldspray("check", file)[0] == 0


@pytest.mark.parametrize(
    ("content", "line"),
    [
        (b"\xff\xfe", "is not UTF-8 text: save it as CSV in UTF-8"),
        (b"time,depth\n1,2\n", "no table of depth and velocity is found: say where"),
    ],
)  # fmt: skip
def test_what_is_no_table_is_refused(content: bytes, line: str, tmp_path: Path) -> None:
    file = tmp_path / "mine.csv"
    file.write_bytes(content)
    status, out, err = coldspray("check", file)
    assert (status, out) == (2, "")
    assert err.startswith(f"coldspray check: {file}: {line}")


@pytest.mark.parametrize(
    ("text", "cells"),
    [
        ("a,b\n1,2e3\n", {(1, 1): "a", (1, 2): "b", (2, 1): 1.0, (2, 2): 2000.0}),
        ("# made by hand\na;b\n1,5;x\n", {(2, 1): "a", (2, 2): "b", (3, 1): 1.5, (3, 2): "x"}),
        ("a\tb\n\n1_0\tnan\n", {(1, 1): "a", (1, 2): "b", (3, 1): "1_0", (3, 2): "nan"}),
        ('"x, um",v\n1,\n', {(1, 1): "x, um", (1, 2): "v", (2, 1): 1.0}),
    ],
)
def test_cells_are_numbers_or_texts_by_line_and_column(
    text: str, cells: dict[tuple[int, int], float | str]
) -> None:
    assert cells_of(text.encode(), 100) == cells


def test_too_many_cells_are_refused() -> None:
    with pytest.raises(ValueError, match=r"^has more than 3 cells$"):
        cells_of(b"1,2\n3,4\n", 3)

"""What `coldspray check` says of some five hundred workbooks, against the file that a person read.

`python tests/foreign/said.py > tests/foreign/said.txt` makes that file anew.
"""

from pathlib import Path

import pytest
from foreign import said

BEFORE = Path(said.__file__).with_suffix(".txt").read_text("utf-8")


def test_the_file_has_every_section() -> None:
    heads = [line[3:] for line in BEFORE.splitlines() if line.startswith("## ")]
    assert heads == list(said.SECTIONS)


@pytest.mark.parametrize("name", said.SECTIONS)
def test_it_says_what_it_said(name: str) -> None:
    head, _, rest = said.section(name).partition("\n")
    before = BEFORE.partition(f"{head}\n")[2].partition("\n## ")[0]
    assert rest.rstrip("\n").splitlines() == before.rstrip("\n").splitlines()

"""The report's workbook; and a folder of files that are hard to read."""

import io
import os
import zipfile
from contextlib import chdir
from pathlib import Path

import pytest
from running import coldspray

from replication.audit.record import Record
from replication.workbook import build_workbook

FILES = {
    "deep.toml": "[impact]\nradius = " + 5000 * "[",
    "empty.toml": "",
    "own.toml": '[impact]\nvelocity = 450\nradius = "22 um"\nbeta = 3.0\n',
    "plan.csv": "[inputs]",
}


@pytest.fixture(scope="session")
def our_own(record: Record) -> bytes:
    """The report's workbook, as `coldspray workbook` writes it."""
    return build_workbook(record=record).to_bytes()


@pytest.fixture(scope="session")
def hostile(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder: FILES, other texts, links in circles, a pipe, and broken workbooks.

    Tests may write `case.toml` in it. `own.xlsx` is a workbook as coldspray wrote it.
    """
    own = tmp_path_factory.mktemp("hostile")
    for name, text in FILES.items():
        (own / name).write_text(text, "utf-8")
    (own / "large.toml").write_bytes(b"#" * (2**20 + 1))
    (own / "binary.toml").write_bytes(b"\xff\xfe\0")
    (own / "loop.xlsx").symlink_to("loop.xlsx")
    (own / "loop.toml").symlink_to("loop.toml")
    (own / "loop").symlink_to("loop")
    (own / "link.xml").symlink_to("own.xlsx")
    os.mkfifo(own / "pipe.csv")
    with chdir(own):
        assert coldspray("workbook", "--velocity", "500", "--quiet", "-o", "own.xlsx")[0] == 0
    # Broken copies of that workbook: cut off, with entities or deep nesting, or expanding too far.
    whole = (own / "own.xlsx").read_bytes()
    (own / "zero.xlsx").write_bytes(b"")
    (own / "cut.xlsx").write_bytes(whole[: len(whole) // 2])
    with zipfile.ZipFile(own / "nothing.xlsx", "w"):
        pass
    entity = b'<!DOCTYPE a [<!ENTITY b "' + b"c" * 100 + b'">]><a>' + b"&b;" * 100 + b"</a>"
    parts = zipfile.ZipFile(io.BytesIO(whole))
    for name, content, times in (
        ("entity.xlsx", entity, 1),
        ("deep.xlsx", 100_000 * b"<a>", 1),
        ("bomb.xlsx", b" " * 2**19, 1000),
    ):
        with zipfile.ZipFile(own / name, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            for part in parts.namelist():
                sheet = part == "xl/worksheets/sheet1.xml"
                with archive.open(part, "w") as file:
                    file.writelines([content] * times if sheet else [parts.read(part)])
    return own

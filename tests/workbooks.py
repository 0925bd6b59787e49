"""Shared by the tests of workbooks: reading and changing files, usable engines, a fake engine."""

import io
import os
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from openpyxl import load_workbook

from spreadsheets.engines import ENGINES, AddressedValue, Engine, EngineError


def stored(path: Path, *, formulas: bool = False) -> dict[str, dict[str, Any]]:
    """Return the stored values of a file, or its formulas, by sheet and address; no blank cells."""
    return {
        sheet.title: {
            cell.coordinate: float(cell.value) if type(cell.value) is int else cell.value
            for row in sheet.iter_rows()
            for cell in row
            if (cell.data_type == "f" if formulas else cell.value not in (None, ""))
        }
        for sheet in load_workbook(path, data_only=not formulas).worksheets
    }


def rewritten(
    content: bytes, change: Callable[[str, bytes], bytes], compression: int | None = None
) -> bytes:
    """Return a zip file with each part changed; a part that becomes empty is left out.

    `compression` is that of all parts, by default as it was: to compress takes most of the time.
    """
    buffer = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as before, zipfile.ZipFile(buffer, "w") as after:
        for info in before.infolist():
            if part := change(info.filename, before.read(info)):
                after.writestr(info, part, compression)
    return buffer.getvalue()


BY_NAME = {engine.name: engine for engine in ENGINES}

FROM_PIP = ("ironcalc", "formualizer")
"""Engines that the tests require, since pip installs them; the system installs the others."""

FASTEST = "formualizer"
"""The engine for what need not be asked of every program."""


def usable(name: str) -> Engine:
    """Return an engine, or skip or fail the test if it is missing."""
    engine = BY_NAME[name]
    if (reason := engine.missing()) is None:
        return engine
    if name in FROM_PIP or os.environ.get("COLDSPRAY_REQUIRE_ENGINES") == "1":
        pytest.fail(reason)
    pytest.skip(reason)


@dataclass
class Fake(Engine):
    """IronCalc, except that it gives wrong values, fails, or cannot be used.

    told: returns the value that it gives for a cell, from sheet, address and right value.
    surplus: further cells that it gives. failure: the reason why it fails on every file but the one
    by which `verify` finds out whether it repairs wrong values. reason: why it is missing.
    """

    told: Callable[[str, str, Any], Any] = lambda _sheet, _address, value: value
    long_doubles: bool = False
    reason: str | None = None
    failure: str = ""
    surplus: tuple[AddressedValue, ...] = ()
    name = "fake"

    def missing(self) -> str | None:
        return self.reason

    def version(self) -> str:
        return "1.0"

    def _cells(self, path: Path) -> Iterator[AddressedValue]:
        if self.failure and not path.name.startswith("planted"):
            raise EngineError(self.name, self.failure)
        for sheet, cells in BY_NAME["ironcalc"].recalculate(path).items():
            for address, value in cells.items():
                yield sheet, address, self.told(sheet, address, value)
        if not path.name.startswith("planted"):
            yield from self.surplus

"""What the tests of workbooks share: files read and changed without the program, a false engine."""

import io
import os
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from openpyxl import load_workbook

from spreadsheets.engines import ENGINES, Cell, Engine, EngineError


def stored(path: Path, *, formulas: bool = False) -> dict[str, dict[str, Any]]:
    """The values that a file stores, or its formulas; by sheet and address, blank cells absent."""
    return {
        sheet.title: {
            cell.coordinate: float(cell.value) if type(cell.value) is int else cell.value
            for row in sheet.iter_rows()
            for cell in row
            if (cell.data_type == "f" if formulas else cell.value not in (None, ""))
        }
        for sheet in load_workbook(path, data_only=not formulas).worksheets
    }


def rewritten(content: bytes, change: Callable[[str, bytes], bytes]) -> bytes:
    """A file with its parts changed, packed as they were; one that becomes empty is left out."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as before, zipfile.ZipFile(buffer, "w") as after:
        for info in before.infolist():
            if part := change(info.filename, before.read(info)):
                after.writestr(info, part)
    return buffer.getvalue()


BY_NAME = {engine.name: engine for engine in ENGINES}

FROM_PIP = ("ironcalc", "formualizer")
"""Required for the tests, so a missing one fails; the others come from the system."""


def usable(name: str) -> Engine:
    """An engine; skips or fails the test when it is missing."""
    result = BY_NAME[name]
    if (reason := result.missing()) is None:
        return result
    if name in FROM_PIP or os.environ.get("COLDSPRAY_REQUIRE_ENGINES") == "1":
        pytest.fail(reason)
    pytest.skip(reason)


@dataclass
class Fake(Engine):
    """IronCalc, but that it tells falsehoods, fails, or cannot be used.

    told: what it says of a cell, by sheet, address and right value. surplus: cells of its own.
    failure: of any file but the one that an engine is tried with.
    """

    told: Callable[[str, str, Any], Any] = lambda _sheet, _address, value: value
    long_doubles: bool = False
    reason: str | None = None
    failure: str = ""
    surplus: tuple[Cell, ...] = ()
    name = "fake"

    def missing(self) -> str | None:
        return self.reason

    def version(self) -> str:
        return "1.0"

    def _cells(self, path: Path) -> Iterator[Cell]:
        if self.failure and not path.name.startswith("planted"):
            raise EngineError(self.name, self.failure)
        for sheet, cells in BY_NAME["ironcalc"].recalculate(path).items():
            for address, value in cells.items():
                yield sheet, address, self.told(sheet, address, value)
        if not path.name.startswith("planted"):
            yield from self.surplus

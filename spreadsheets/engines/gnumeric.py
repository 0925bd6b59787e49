"""Gnumeric, through its converter ``ssconvert``.

Its own file format keeps formulas but not their values, and CSV cannot tell a number from text, so
the recalculated workbook is written as .xlsx, with all digits, and read by openpyxl.
Debian's Gnumeric computes in long doubles, which are rounded to doubles only on reading.
"""

from __future__ import annotations

import math
import re
import shutil
import warnings
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from spreadsheets.engines.base import Cell, EngineError, SystemEngine, Value

FORMAT = "Gnumeric_Excel:xlsx"


class Gnumeric(SystemEngine):
    """Converts the workbook with ``--recalc``; without it, stored values would come back."""

    name = "gnumeric"
    long_doubles = True

    def missing(self) -> str | None:
        if shutil.which("ssconvert") is not None:
            return None
        return "The command ssconvert is not installed: install the system package gnumeric."

    def _version(self) -> str:
        found = re.search(r"version '(.+)'", self._run(["ssconvert", "--version"]))
        if found is None:
            raise EngineError(self.name, "ssconvert does not tell its version")
        return found[1]

    def _cells(self, path: Path) -> Iterator[Cell]:
        from openpyxl import load_workbook

        with TemporaryDirectory(prefix="coldspray-") as folder:
            converted = Path(folder, "converted.xlsx")
            # Without the importer's name, ssconvert would take any text file for a table.
            formats = f"--import-type={FORMAT}", f"--export-type={FORMAT}"
            self._run(["ssconvert", "--recalc", *formats, str(path.resolve()), str(converted)])
            with warnings.catch_warnings(action="ignore"):  # Gnumeric names no default style
                book = load_workbook(converted, data_only=True)
            for sheet in book.worksheets:
                for cell in chain.from_iterable(sheet.iter_rows()):
                    yield sheet.title, cell.coordinate, _value(cell.value)


def _value(content: Any) -> Value | None:
    """A value as Gnumeric stores it; one beyond all doubles is the error that engines give."""
    from openpyxl.utils.datetime import to_excel

    if content is None or isinstance(content, str | bool):
        return content
    serial = content if isinstance(content, float | int) else to_excel(content)  # type: ignore[no-untyped-call]
    number = float(serial)
    return number if math.isfinite(number) else "#NUM!"

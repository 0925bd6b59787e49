"""Gnumeric, through its converter ``ssconvert``.

Its own file format keeps formulas but not their values, and CSV cannot tell a number from text, so
the recalculated workbook is written as .xlsx and parsed here: Gnumeric writes all digits there.
Debian's Gnumeric computes in long doubles, which are rounded to doubles only on reading.
"""

from __future__ import annotations

import math
import re
import shutil
import subprocess
import zipfile
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree import ElementTree as ET

from spreadsheets.engines.base import Cell, Engine, EngineError, Value, read_part, worksheets

FORMAT = "Gnumeric_Excel:xlsx"
TIME_LIMIT_S = 120
STRINGS = "xl/sharedStrings.xml"


class Gnumeric(Engine):
    """Converts the workbook with ``--recalc``; without it, stored values would come back."""

    name = "gnumeric"
    long_doubles = True

    def missing(self) -> str | None:
        if shutil.which("ssconvert") is not None:
            return None
        return "The command ssconvert is not installed: install the system package gnumeric."

    def _version(self) -> str:
        found = re.search(r"version '(.+)'", self._ssconvert("--version"))
        if found is None:
            raise EngineError(self.name, "ssconvert does not tell its version")
        return found[1]

    def _cells(self, path: Path) -> Iterator[Cell]:
        with TemporaryDirectory(prefix="coldspray-") as folder:
            converted = Path(folder, "converted.xlsx")
            # Without the importer's name, ssconvert would take any text file for a table.
            formats = f"--import-type={FORMAT}", f"--export-type={FORMAT}"
            self._ssconvert("--recalc", *formats, str(path.resolve()), str(converted))
            with zipfile.ZipFile(converted) as archive:
                yield from _read(archive)

    def _ssconvert(self, *arguments: str) -> str:
        """Run ssconvert and return what it prints."""
        command = ["ssconvert", *arguments]
        try:
            done = subprocess.run(
                command, capture_output=True, text=True, timeout=TIME_LIMIT_S, check=False
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            raise EngineError(self.name, str(error)) from error
        if done.returncode != 0:
            raise EngineError(self.name, f"ssconvert failed: {done.stderr or done.returncode}")
        return done.stdout


def _read(archive: zipfile.ZipFile) -> Iterator[Cell]:
    """Yield the cells of the converted workbook."""
    strings: list[str] = []
    if STRINGS in archive.namelist():
        strings = [_text(item) for item in read_part(archive, STRINGS)]
    for sheet, part in worksheets(archive).items():
        for cell in read_part(archive, part).iterfind("{*}sheetData/{*}row/{*}c"):
            yield sheet, cell.attrib["r"], _value(cell, strings)


def _value(cell: ET.Element, strings: list[str]) -> Value | None:
    """Read a cell by its type: s shared string, b boolean, e error, str or inlineStr text."""
    kind = cell.get("t", "n")
    if kind == "inlineStr":
        return _text(cell)
    text = cell.findtext("{*}v")
    if text is None or kind in ("str", "e"):
        return text
    if kind == "s":
        return strings[int(text)]
    return bool(int(text)) if kind == "b" else _double(text)


def _double(text: str) -> float | str:
    """Round a long double; one beyond all doubles is the error that double engines give."""
    number = float(text)
    return number if math.isfinite(number) else "#NUM!"


def _text(element: ET.Element) -> str:
    """Join the runs of a string."""
    return "".join(run.text or "" for run in element.iterfind(".//{*}t"))

"""What every engine has in common: interface, errors, the shape of its answer, a test of itself."""

from __future__ import annotations

import os
import signal
import subprocess
import zipfile
import zlib
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from urllib.parse import urljoin
from xml.etree import ElementTree as ET

Value = float | str | bool

Recalculated = dict[str, dict[str, Value]]
"""Worksheet name -> address such as "B7" -> value.

- Every worksheet is a key, even one without values. Chart sheets are left out.
- A number is a float, and so is a date (its serial number).
- A boolean is a bool; LibreOffice stores booleans as numbers and gives 1.0 and 0.0, which compare
  equal to True and False.
- A blank cell is absent, and so is one whose formula gives the empty string.
- An error is the text that stands for it, such as "#VALUE!". LibreOffice has errors of its own
  ("Err:502"). Text that merely spells an error cannot be told from it.
"""

Cell = tuple[str, str, Value | None]
"""Worksheet name, address and value; None where the cell holds nothing."""


TIME_LIMIT_S = 120
"""So long may a program take for one workbook."""


class EngineError(Exception):
    """An engine is missing, failed, or could not read the workbook. Its message is one line."""

    def __init__(self, engine: str, reason: str) -> None:
        super().__init__(f"{engine}: {' '.join(reason.split())}")


class Engine(ABC):
    """A program that recalculates workbooks."""

    name: str
    long_doubles = False
    """Whether it computes in 80-bit long doubles, so that its last digits are others by design."""

    @abstractmethod
    def missing(self) -> str | None:
        """Return None when the engine can be used, or else a sentence on what to install."""

    @abstractmethod
    def _version(self) -> str:
        """Return the version; only called when the engine is not missing."""

    @abstractmethod
    def _cells(self, path: Path) -> Iterator[Cell]:
        """Recalculate a sound workbook and yield its cells, blank ones included or not."""

    def version(self) -> str:
        """Return the version of the program that would be used."""
        self._require()
        return self._version()

    def recalculate(self, path: Path) -> Recalculated:
        """Compute every formula of an .xlsx file again; the file itself stays as it is."""
        (recalculated,) = self.recalculate_many([path])
        return recalculated

    def recalculate_many(self, paths: Sequence[Path]) -> list[Recalculated]:
        """The same for several files, in one run of the program where that saves time."""
        self._require()
        sheets = [self._worksheets(path) for path in paths]
        return [
            self._recalculated(path, names, cells)
            for path, names, cells in zip(paths, sheets, self._cells_of_each(paths), strict=True)
        ]

    def _cells_of_each(self, paths: Sequence[Path]) -> Iterable[Iterator[Cell]]:
        """Give the cells of each workbook, as `_cells` does for one."""
        return map(self._cells, paths)

    def _recalculated(self, path: Path, sheets: list[str], cells: Iterator[Cell]) -> Recalculated:
        recalculated: Recalculated = {sheet: {} for sheet in sheets}
        for sheet, place, value in cells:
            if value is None or value == "":
                continue
            if sheet not in recalculated:
                raise EngineError(self.name, f"{path} has no worksheet {sheet!r}, yet it has cells")
            recalculated[sheet][place] = value
        return recalculated

    def _require(self) -> None:
        reason = self.missing()
        if reason is not None:
            raise EngineError(self.name, reason)

    def _worksheets(self, path: Path) -> list[str]:
        """List the worksheets once every part is well formed: some engines load damaged files."""
        try:
            with zipfile.ZipFile(path) as archive:
                for part in archive.namelist():
                    if part.endswith((".xml", ".rels")):
                        parsed(archive, part)
                sheets = worksheets(archive)
                for part in sheets.values():
                    archive.getinfo(part)
                return list(sheets)
        except (OSError, KeyError, zipfile.BadZipFile, zlib.error, ET.ParseError) as error:
            raise EngineError(self.name, f"cannot read {path}: {error}") from error


class PipEngine(Engine):
    """An engine that is a Python package of the same name."""

    def missing(self) -> str | None:
        if find_spec(self.name) is not None:
            return None
        return f"The Python package {self.name} is not installed: run pip install {self.name}."

    def _version(self) -> str:
        return version(self.name)


class SystemEngine(Engine):
    """An engine that is a program of its own."""

    def _run(self, command: list[str], workbooks: int = 1) -> str:
        """Run a command in a group of its own and leave none of its processes behind."""
        limit = TIME_LIMIT_S * workbooks
        pipe = subprocess.PIPE
        with subprocess.Popen(
            command, stdout=pipe, stderr=pipe, text=True, start_new_session=True
        ) as process:
            try:
                output, complaint = process.communicate(timeout=limit)
            except subprocess.TimeoutExpired as error:
                raise EngineError(self.name, f"no answer within {limit} s") from error
            finally:
                _end_group(process)
        if process.returncode != 0:
            # The last line says why; those before it are the program's own chatter.
            raise EngineError(self.name, (complaint.strip() or "no reason given").splitlines()[-1])
        return output


def _end_group(process: subprocess.Popen[str]) -> None:
    """Kill what is left of a process group and wait until all of it is gone."""
    with suppress(ProcessLookupError):  # the good case: nothing is left
        os.killpg(process.pid, signal.SIGKILL)
    process.communicate()  # its pipes end with the last process that holds them


def address(row: int, column: int) -> str:
    """Name the cell in that row and column, both counted from 1: (7, 2) is B7."""
    from openpyxl.utils import get_column_letter

    return f"{get_column_letter(column)}{row}"


def repairs_wrong_value(engine: Engine, folder: Path) -> bool:
    """Plant a wrong stored value beside a formula and tell whether the engine puts it right.

    One that gives stored values back verifies nothing.
    """
    import xlsxwriter

    path = folder / f"planted-{engine.name}.xlsx"
    with xlsxwriter.Workbook(path) as workbook:
        sheet = workbook.add_worksheet("planted")
        sheet.write_number("A1", 6)
        sheet.write_formula("A2", "=A1*7", value=41)
    return engine.recalculate(path)["planted"].get("A2") == 42


# The parts of an .xlsx file: enough to find its worksheets and their cells.


def worksheets(archive: zipfile.ZipFile) -> dict[str, str]:
    """Map each worksheet's name, in the workbook's order, to the part that holds its cells."""
    parts = {
        # A target is relative to xl/ unless it starts at the root.
        relation.attrib["Id"]: urljoin("/xl/", relation.attrib["Target"])[1:]
        for relation in parsed(archive, "xl/_rels/workbook.xml.rels")
        if relation.attrib["Type"].endswith("/worksheet")  # and not "/chartsheet"
    }
    related = {
        # The namespace of r:id differs between the two kinds of Office Open XML.
        sheet.attrib["name"]: next(v for k, v in sheet.attrib.items() if k.endswith("}id"))
        for sheet in parsed(archive, "xl/workbook.xml").iterfind("{*}sheets/{*}sheet")
    }
    return {name: parts[relation] for name, relation in related.items() if relation in parts}


def parsed(archive: zipfile.ZipFile, part: str) -> ET.Element:
    """Parse one XML part of the file."""
    return ET.fromstring(archive.read(part))

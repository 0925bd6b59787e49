"""Save a workbook of another format as .xlsx with LibreOffice, within bounds.

LibreOffice itself has none: an .ods file of a kilobyte may say that a cell is repeated a billion
times. What such a file unpacks to is therefore counted first.
"""

import shutil
import subprocess
import zipfile
from collections import deque
from pathlib import Path
from xml.etree import ElementTree as ET

from spreadsheets.engines import office, run_program
from spreadsheets.package import Package, WorkbookError, name_of, open_archive, too_much

FORMATS = (".xls", ".xlsb", ".ods")
"""The endings of the files that are converted."""
_SECONDS, _CPU_SECONDS = 60, 20
_DATA, _ADDRESSES, _FILE = 768 * 2**20, 4 * 2**30, 64 * 2**20
"""Bytes that LibreOffice may write to, address, and put into a file; it starts with a quarter."""


def converted(path: Path, folder: Path, most_cells: int) -> Path:
    """Save a workbook as .xlsx in a folder. LibreOffice runs in a new profile, without macros.

    Raises WorkbookError if the file has more than `most_cells` cells, cannot be converted within
    the limits of this module, or if there is no LibreOffice.
    """
    if (soffice := office()) is None:
        ways = "by way of LibreOffice, which is not installed; save it as .xlsx"
        raise WorkbookError(f"{path.suffix} files are read {ways}")
    if zipfile.is_zipfile(path):
        with open_archive(path) as archive:
            package = Package(archive)
            for part in package.parts:
                deque(package.chunks(part), maxlen=0)
            if "content.xml" in package:
                counter = _CellCounter(most_cells)
                Package(archive).stream("content.xml", **{"table-row": counter.take_row})
    source = shutil.copyfile(path, folder / f"workbook{path.suffix.lower()}")
    command = [
        soffice, "--headless", "--norestore",
        f"-env:UserInstallation={(folder / 'profile').as_uri()}",
        "--convert-to", "xlsx", "--outdir", str(folder / "out"), str(source),
    ]  # fmt: skip
    for _ in range(2):  # the first run in a new profile may only ask to be started again
        try:
            run_program(command, _SECONDS, _limit_resources)
        except subprocess.TimeoutExpired as error:
            reason = f"LibreOffice did not open it within {_SECONDS} s; save it as .xlsx"
            raise WorkbookError(reason) from error
        if (folder / "out" / "workbook.xlsx").is_file():
            return folder / "out" / "workbook.xlsx"
    raise WorkbookError("LibreOffice cannot open it; save it as .xlsx")


class _CellCounter:
    """Count the cells with contents of an .ods file, each as often as it is repeated."""

    def __init__(self, most: int) -> None:
        self.most, self.cells = most, 0

    def take_row(self, row: ET.Element) -> None:
        """Count the cells of a row."""
        cells = sum(
            _repeated(cell, "number-columns-repeated")
            for cell in row
            if len(cell) or any(key.endswith(("}value", "}formula")) for key in cell.attrib)
        )
        self.cells += cells * _repeated(row, "number-rows-repeated")
        if self.cells > self.most:
            raise too_much(f"it has more than {self.most:,} cells, counting repeated ones")


def _repeated(element: ET.Element, attribute: str) -> int:
    """How often a row or a cell is repeated."""
    numbers = (text for key, text in element.attrib.items() if key.endswith(f"}}{attribute}"))
    number = next(numbers, "1")
    if not (number.isdecimal() and len(number) < 10):
        raise WorkbookError(f"is damaged: a <{name_of(element)}> is repeated {number[:20]!r} times")
    return int(number)


def _limit_resources() -> None:
    """Limit memory, time and the size of files of the process that calls this."""
    import resource

    for limit, most in (
        (resource.RLIMIT_DATA, _DATA),
        (resource.RLIMIT_AS, _ADDRESSES),
        (resource.RLIMIT_CPU, _CPU_SECONDS),
        (resource.RLIMIT_FSIZE, _FILE),
    ):
        resource.setrlimit(limit, (most, most))

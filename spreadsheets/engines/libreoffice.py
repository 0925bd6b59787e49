"""LibreOffice, through UNO, its programming interface: the only way to its exact doubles.

What LibreOffice saves is rounded to 15 digits, so nothing is read from a saved file. The UNO
bindings belong to one certain Python, seldom the one that runs this; ``uno_script.py`` runs in the
first of these that can import them: this Python, ``python3`` on the PATH, ``/usr/bin/python3``, and
the Python that some LibreOffice packages bring along.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from spreadsheets.engines.base import Cell, EngineError, SystemEngine, address

SCRIPT = Path(__file__).with_name("uno_script.py")


class LibreOffice(SystemEngine):
    """Starts an office of its own, which takes one to two seconds; several workbooks share it."""

    name = "libreoffice"

    def missing(self) -> str | None:
        try:
            _python(_soffice())
        except LookupError as reason:
            return str(reason)
        return None

    def _version(self) -> str:
        found = re.search(r"LibreOffice\S* (\S+)", self._run([_soffice(), "--version"]))
        if found is None:
            raise EngineError(self.name, "soffice does not tell its version")
        return found[1]

    def _cells(self, path: Path) -> Iterator[Cell]:
        (cells,) = self._cells_of_each([path])
        return cells

    def _cells_of_each(self, paths: Sequence[Path]) -> Iterable[Iterator[Cell]]:
        return map(_read, self._office(paths).splitlines())

    def _office(self, paths: Sequence[Path]) -> str:
        """Run the script on copies, since LibreOffice puts a lock file beside what it opens."""
        with TemporaryDirectory(prefix="coldspray-") as folder:
            copies = [
                str(shutil.copyfile(path, Path(folder, f"workbook{number}.xlsx")))
                for number, path in enumerate(paths)
            ]
            soffice = _soffice()
            command = [_python(soffice), str(SCRIPT), soffice, f"{folder}/profile", *copies]
            return self._run(command, len(paths))


def _read(line: str) -> Iterator[Cell]:
    for sheet, rows in json.loads(line).items():
        for row, values in enumerate(rows, start=1):
            for column, value in enumerate(values, start=1):
                yield sheet, address(row, column), value


def _soffice() -> str:
    soffice = shutil.which("soffice") or shutil.which("libreoffice")
    if soffice is None:
        raise LookupError(
            "LibreOffice is not installed: install the system package libreoffice-calc."
        )
    return soffice


@cache
def _python(soffice: str) -> str:
    bundled = str(Path(soffice).resolve().with_name("python"))
    for python in (sys.executable, shutil.which("python3"), "/usr/bin/python3", bundled):
        if python is None or not Path(python).is_file():
            continue
        probe = [python, "-c", "import uno; uno.getComponentContext"]
        if subprocess.run(probe, capture_output=True, check=False).returncode == 0:
            return python
    raise LookupError("No Python here can import uno: install the system package python3-uno.")

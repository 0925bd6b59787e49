"""LibreOffice, through UNO, its programming interface: the only way to its exact doubles.

What LibreOffice saves is rounded to 15 digits, so nothing is read from a saved file. The UNO
bindings belong to one certain Python, seldom the one that runs this; ``uno_script.py`` runs in the
first of these that can import them: this Python, ``python3`` on the PATH, ``/usr/bin/python3``, and
the Python that some LibreOffice packages bring along.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from spreadsheets.engines.base import Cell, Engine, EngineError, address

SCRIPT = Path(__file__).with_name("uno_script.py")
TIME_LIMIT_S = 120


class LibreOffice(Engine):
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
            # The last line is the script's; those before it are soffice's own chatter.
            raise EngineError(self.name, (complaint.strip() or "no reason given").splitlines()[-1])
        return output


def _read(line: str) -> Iterator[Cell]:
    """Yield the cells of one workbook from the line that the script printed for it."""
    for sheet, rows in json.loads(line).items():
        for row, values in enumerate(rows, start=1):
            for column, value in enumerate(values, start=1):
                yield sheet, address(row, column), value


def _end_group(process: subprocess.Popen[str]) -> None:
    """Kill what is left of a process group and wait until all of it is gone."""
    with suppress(ProcessLookupError):  # the good case: nothing is left
        os.killpg(process.pid, signal.SIGKILL)
    process.communicate()  # its pipes end with the last process that holds them


def _soffice() -> str:
    """Find LibreOffice's program, or raise a LookupError that says what to install."""
    soffice = shutil.which("soffice") or shutil.which("libreoffice")
    if soffice is None:
        raise LookupError(
            "LibreOffice is not installed: install the system package libreoffice-calc."
        )
    return soffice


@cache
def _python(soffice: str) -> str:
    """Find a Python that can import the UNO bindings, or raise a LookupError."""
    bundled = str(Path(soffice).resolve().with_name("python"))
    for python in (sys.executable, shutil.which("python3"), "/usr/bin/python3", bundled):
        if python is None or not Path(python).is_file():
            continue
        probe = [python, "-c", "import uno; uno.getComponentContext"]
        if subprocess.run(probe, capture_output=True, check=False).returncode == 0:
            return python
    raise LookupError("No Python here can import uno: install the system package python3-uno.")

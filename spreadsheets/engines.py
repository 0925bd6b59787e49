"""Real spreadsheet engines behind one small interface.

    IronCalc().recalculate(Path("workbook.xlsx"))["Sheet1"]["B7"]

An engine recalculates every formula of a workbook and returns the `SheetValues`. Two engines are
installed with pip, two with the system. Their libraries are imported only when an engine is used.
"""

import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import warnings
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from functools import cache
from importlib.metadata import version
from importlib.util import find_spec
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from spreadsheets.plan import ShownValue

SheetValues = dict[str, dict[str, ShownValue]]
"""Worksheet name -> address such as "B7" -> value.

Blank cells, formulas that give the empty string, and sheets without values are left out. A number
is a float, as is a date (its serial number). A boolean is a bool, but 1.0 or 0.0 from LibreOffice.
An error is its text, such as "#VALUE!", or "Err:502" from LibreOffice.
"""

AddressedValue = tuple[str, str, ShownValue | None]
"""Worksheet name, address and value; None for a blank cell."""

TIME_LIMIT_S = 120
"""How many seconds a program may take for one workbook."""


class EngineError(Exception):
    """An engine is missing, fails, or cannot read the workbook. The message is one line."""

    def __init__(self, engine: str, reason: str) -> None:
        self.reason = " ".join(reason.split())
        super().__init__(f"{engine}: {self.reason}")


class Engine(ABC):
    """A program that recalculates workbooks."""

    name: str
    long_doubles = False
    """Whether it computes in 80-bit long doubles, so that its last digits differ from ours."""

    @abstractmethod
    def missing(self) -> str | None:
        """Return None if the engine can be used, else a sentence that says what to install."""

    @abstractmethod
    def version(self) -> str:
        """Return the version of the engine; called only if it is not missing."""

    def _cells(self, path: Path) -> Iterator[AddressedValue]:
        """Yield the recalculated cells of a workbook; blank cells may be left out.

        An engine that takes several workbooks at once overrides `_cells_of_many` instead.
        """
        raise NotImplementedError

    def _cells_of_many(self, paths: Sequence[Path]) -> Iterator[Iterator[AddressedValue]]:
        return map(self._cells, paths)

    def recalculate(self, path: Path) -> SheetValues:
        """Recalculate every formula of an .xlsx file; the file itself is not changed."""
        return self.recalculate_many([path])[0]

    def recalculate_many(self, paths: Sequence[Path]) -> list[SheetValues]:
        """Recalculate every formula of several .xlsx files; return the values of each, in order."""
        if (reason := self.missing()) is not None:
            raise EngineError(self.name, reason)
        recalculated: list[SheetValues] = []
        for cells in self._cells_of_many(paths):
            recalculated.append({})
            for sheet, place, value in cells:
                if value is not None and value != "":
                    recalculated[-1].setdefault(sheet, {})[place] = value
        return recalculated

    def _run(self, command: list[str], workbooks: int = 1) -> str:
        """Return the output of a program; the time limit grows with the number of workbooks."""
        limit = TIME_LIMIT_S * workbooks
        try:
            status, output, errors = run_program(command, limit)
        except subprocess.TimeoutExpired as error:
            raise EngineError(self.name, f"no answer within {limit} s") from error
        if status != 0:
            # The last line gives the reason; the lines before it are warnings and progress.
            raise EngineError(self.name, (errors.strip() or "no reason given").splitlines()[-1])
        return output

    def _version_of(self, program: str) -> str:
        match = re.search(r"\d+(\.\d+)+", self._run([program, "--version"]))
        return match[0] if match else "of no known version"


def address(row: int, column: int) -> str:
    """Return the address of a cell; row and column count from 1, so that (7, 2) is B7."""
    from openpyxl.utils import get_column_letter

    return f"{get_column_letter(column)}{row}"


def in_quotes(sheet: str) -> str:
    """Return the name of a sheet as a reference quotes it.

    >>> in_quotes("It's odd")
    "'It''s odd'"
    """
    return "'" + sheet.replace("'", "''") + "'"


# Engines that pip installs


class FromPip(Engine):
    """An engine that is a Python package of the same name."""

    def missing(self) -> str | None:
        reason = f"The Python package {self.name} is not installed: run pip install {self.name}."
        return None if find_spec(self.name) else reason

    def version(self) -> str:
        return version(self.name)


class IronCalc(FromPip):
    """IronCalc; its unformatted getter gives exact doubles, while the formatted ones round."""

    name = "ironcalc"

    def _cells(self, path: Path) -> Iterator[AddressedValue]:
        import ironcalc

        try:
            model = ironcalc.load_from_xlsx(str(path))
        except ironcalc.WorkbookError as error:
            raise EngineError(self.name, f"cannot read {path}: {error}") from error
        model.evaluate()
        names = [sheet["name"] for sheet in model.get_worksheets_properties()]
        for sheet, row, column in model.get_all_cells():
            yield names[sheet], address(row, column), model.get_cell_value(sheet, row, column)


class Formualizer(FromPip):
    """Formualizer, the fastest: it takes an eighth of the time of IronCalc."""

    name = "formualizer"

    def _cells(self, path: Path) -> Iterator[AddressedValue]:
        import formualizer

        try:
            workbook = formualizer.load_workbook(str(path))
            workbook.set_temporal_egress("serial")  # dates as numbers, as in other engines
            workbook.evaluate_all()
        except (OSError, formualizer.ExcelEvaluationError) as error:
            raise EngineError(self.name, f"cannot read {path}: {error}") from error
        named = {"Div": "#DIV/0!", "Na": "#N/A", "Name": "#NAME?"}
        for sheet in workbook.sheet_names:
            used = formualizer.RangeAddress(sheet, 1, 1, *_used(workbook, sheet))
            for row, values in enumerate(workbook.sheet(sheet).get_values(used), start=1):
                for column, value in enumerate(values, start=1):
                    if isinstance(value, dict):  # an error
                        value = named.get(value["kind"], f"#{value['kind'].upper()}!")
                    yield sheet, address(row, column), value


def _used(workbook: Any, sheet: str) -> tuple[int, int]:
    """Return the last row and column that are used on a sheet of Formualizer, at least 1 and 1.

    It tells them as it cuts whole columns to the rows in use, and whole rows to the columns.
    """
    from openpyxl.utils.cell import coordinate_to_tuple

    rows, columns = (
        workbook.range_page(f"{in_quotes(sheet)}!{whole}", limit=1, include_values=False).resolved
        for whole in ("A:XFD", "1:1048576")
    )
    if rows is None or columns is None:
        return 1, 1
    row, _ = coordinate_to_tuple(rows.rpartition(":")[2])
    _, column = coordinate_to_tuple(columns.rpartition(":")[2])
    return row, column


# Engines that the system installs


def run_program(
    command: list[str], seconds: float, before: Callable[[], None] | None = None
) -> tuple[int, str, str]:
    """Run a command; return its exit status, standard output and standard error.

    The command runs in a process group of its own, of which nothing is left running at the end.
    before: is called in the new process, before the command (not on Windows). Raises
    TimeoutExpired after so many seconds.
    """
    posix, pipe = os.name == "posix", subprocess.PIPE
    with subprocess.Popen(
        command, stdout=pipe, stderr=pipe, text=True, errors="replace", start_new_session=True,
        preexec_fn=before if posix else None,
    ) as process:  # fmt: skip
        try:
            output, errors = process.communicate(timeout=seconds)
        finally:
            with suppress(ProcessLookupError):  # as usual, no process of the group is left
                os.killpg(process.pid, signal.SIGKILL) if posix else process.kill()
            process.communicate()  # the pipes close with the last process that holds them
    return process.returncode, output, errors


class LibreOffice(Engine):
    """LibreOffice, driven through UNO, its programming interface.

    A file that LibreOffice saves would have only 15 digits. The UNO bindings belong to one certain
    Python, seldom the one that runs this program: `uno_script.py` runs in the first Python that can
    import them. LibreOffice starts in a second or two, once for several workbooks.
    """

    name = "libreoffice"

    def missing(self) -> str | None:
        if (soffice := office()) is None:
            return "LibreOffice is not installed: install the system package libreoffice-calc."
        if _uno_python(soffice) is None:
            return "No Python here can import uno: install the system package python3-uno."
        return None

    def version(self) -> str:
        return self._version_of(str(office()))

    def _cells_of_many(self, paths: Sequence[Path]) -> Iterator[Iterator[AddressedValue]]:
        soffice, script = str(office()), str(Path(__file__).with_name("uno_script.py"))
        with TemporaryDirectory(prefix="coldspray-") as folder:
            # LibreOffice opens copies, since it puts a lock file beside each file that it opens.
            copies = [
                str(shutil.copyfile(path, Path(folder, f"workbook{number}.xlsx")))
                for number, path in enumerate(paths)
            ]
            command = [str(_uno_python(soffice)), script, soffice, f"{folder}/profile", *copies]
            output = self._run(command, len(paths))
        for line in output.splitlines():
            yield (
                (sheet, address(row, column), value)
                for sheet, rows in json.loads(line).items()
                for row, values in enumerate(rows, start=1)
                for column, value in enumerate(values, start=1)
            )


def office() -> str | None:
    """Return the path of the LibreOffice program, or None if it is not installed."""
    return shutil.which("soffice") or shutil.which("libreoffice")


@cache
def _uno_python(soffice: str) -> str | None:
    bundled = str(Path(soffice).resolve().with_name("python"))
    for python in (sys.executable, shutil.which("python3"), "/usr/bin/python3", bundled):
        if python is not None and Path(python).is_file():
            probe = [python, "-c", "import uno; uno.getComponentContext"]
            if subprocess.run(probe, capture_output=True, check=False).returncode == 0:
                return python
    return None


class Gnumeric(Engine):
    """Gnumeric, driven through its converter `ssconvert`.

    It writes the recalculated workbook as .xlsx, with all digits. Debian's Gnumeric computes in
    long doubles, which are rounded to doubles only when that file is read.
    """

    name = "gnumeric"
    long_doubles = True

    def missing(self) -> str | None:
        reason = "The command ssconvert is not installed: install the system package gnumeric."
        return None if shutil.which("ssconvert") else reason

    def version(self) -> str:
        return self._version_of("ssconvert")

    def _cells(self, path: Path) -> Iterator[AddressedValue]:
        from openpyxl import load_workbook
        from openpyxl.utils.datetime import to_excel

        with TemporaryDirectory(prefix="coldspray-") as folder:
            converted = Path(folder, "converted.xlsx")
            # Without --recalc it would keep the stored values; without the importer's name it would
            # import any text file as a table.
            formats = (f"--{way}port-type=Gnumeric_Excel:xlsx" for way in ("im", "ex"))
            self._run(["ssconvert", "--recalc", *formats, str(path.resolve()), str(converted)])
            with warnings.catch_warnings(action="ignore"):  # about the missing default style
                book = load_workbook(converted, data_only=True)
        for sheet in book.worksheets:
            for cell in chain.from_iterable(sheet.iter_rows()):
                value: Any = cell.value
                if not isinstance(value, str | bool | None):
                    number = float(value if isinstance(value, float | int) else to_excel(value))  # type: ignore[no-untyped-call]
                    # A long double beyond the range of doubles: other engines give this error.
                    value = number if math.isfinite(number) else "#NUM!"
                yield sheet.title, cell.coordinate, value


ENGINES: tuple[Engine, ...] = (IronCalc(), Formualizer(), LibreOffice(), Gnumeric())

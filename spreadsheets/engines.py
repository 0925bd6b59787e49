"""Real spreadsheet engines, all behind one small interface.

    IronCalc().recalculate(Path("workbook.xlsx"))["Sheet1"]["B7"]

An engine computes every formula of a workbook again and gives the `Values`. Two engines come with
pip, two from the system. Their libraries are imported only when an engine is used.
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

from spreadsheets.plan import Value

Values = dict[str, dict[str, Value]]
"""Worksheet name -> address such as "B7" -> value.

Absent are blank cells, formulas that give the empty string, and sheets without values. A number or
a date (its serial number) is a float; a boolean a bool, of LibreOffice 1.0 or 0.0; an error the
text that stands for it, such as "#VALUE!", or "Err:502" of LibreOffice.
"""

Cell = tuple[str, str, Value | None]
"""Worksheet name, address and value; None where the cell holds nothing."""

TIME_LIMIT_S = 120
"""How long a program may take for one workbook."""


class EngineError(Exception):
    """An engine is missing, failed, or could not read the workbook. Its message is one line."""

    def __init__(self, engine: str, reason: str) -> None:
        self.reason = " ".join(reason.split())
        super().__init__(f"{engine}: {self.reason}")


class Engine(ABC):
    """A program that recalculates workbooks."""

    name: str
    long_doubles = False
    """Whether it computes in 80-bit long doubles, so that its last digits are others by design."""

    @abstractmethod
    def missing(self) -> str | None:
        """None when the engine can be used, or else a sentence on what to install."""

    @abstractmethod
    def version(self) -> str:
        """The version of the program that would be used; not asked for when it is missing."""

    def _cells(self, path: Path) -> Iterator[Cell]:
        """The cells of a workbook, recalculated; blank ones included or not."""
        raise NotImplementedError  # of an engine that has the other one

    def _cells_of_each(self, paths: Sequence[Path]) -> Iterator[Iterator[Cell]]:
        return map(self._cells, paths)

    def recalculate(self, path: Path) -> Values:
        """Compute every formula of an .xlsx file again; the file itself stays as it is."""
        (recalculated,) = self.recalculate_many([path])
        return recalculated

    def recalculate_many(self, paths: Sequence[Path]) -> list[Values]:
        """Compute every formula of several .xlsx files again, in their order."""
        if (reason := self.missing()) is not None:
            raise EngineError(self.name, reason)
        recalculated: list[Values] = []
        for cells in self._cells_of_each(paths):
            recalculated.append({})
            for sheet, place, value in cells:
                if value is not None and value != "":
                    recalculated[-1].setdefault(sheet, {})[place] = value
        return recalculated

    def _run(self, command: list[str], workbooks: int = 1) -> str:
        """The output of a program that recalculates so many workbooks."""
        limit = TIME_LIMIT_S * workbooks
        try:
            status, output, complaint = run_program(command, limit)
        except subprocess.TimeoutExpired as error:
            raise EngineError(self.name, f"no answer within {limit} s") from error
        if status != 0:
            # The last line says why; those before it are the program's own chatter.
            raise EngineError(self.name, (complaint.strip() or "no reason given").splitlines()[-1])
        return output

    def _version_of(self, program: str) -> str:
        match = re.search(r"\d+(\.\d+)+", self._run([program, "--version"]))
        return match[0] if match else "of no known version"


def address(row: int, column: int) -> str:
    """The cell in that row and column, both counted from 1: (7, 2) is B7."""
    from openpyxl.utils import get_column_letter

    return f"{get_column_letter(column)}{row}"


# From pip


class IronCalc(Engine):
    """Exact doubles, booleans and error texts, by the unformatted getter; the others round."""

    name = "ironcalc"

    def missing(self) -> str | None:
        reason = f"The Python package {self.name} is not installed: run pip install {self.name}."
        return None if find_spec(self.name) else reason

    def version(self) -> str:
        return version(self.name)

    def _cells(self, path: Path) -> Iterator[Cell]:
        import ironcalc

        try:
            model = ironcalc.load_from_xlsx(str(path))
        except ironcalc.WorkbookError as error:
            raise EngineError(self.name, f"cannot read {path}: {error}") from error
        model.evaluate()
        names = [sheet["name"] for sheet in model.get_worksheets_properties()]
        for sheet, row, column in model.get_all_cells():
            yield names[sheet], address(row, column), model.get_cell_value(sheet, row, column)


class Formualizer(IronCalc):
    """Exact doubles and booleans; it cannot be asked which cells there are, so IronCalc is."""

    name = "formualizer"

    def _cells(self, path: Path) -> Iterator[Cell]:
        import formualizer
        from openpyxl.utils.cell import coordinate_to_tuple

        try:
            workbook = formualizer.load_workbook(str(path))
            workbook.set_temporal_egress("serial")  # dates as numbers, like the other engines
            workbook.evaluate_all()
        except (OSError, formualizer.ExcelEvaluationError) as error:
            raise EngineError(self.name, f"cannot read {path}: {error}") from error
        spelled = {"Div": "#DIV/0!", "Na": "#N/A", "Name": "#NAME?"}
        for sheet, place, _ in super()._cells(path):
            value = workbook.get_value(sheet, *coordinate_to_tuple(place))
            if isinstance(value, dict):  # an error
                value = spelled.get(value["kind"], f"#{value['kind'].upper()}!")
            yield sheet, place, value


# From the system


def run_program(
    command: list[str], seconds: float, before: Callable[[], None] | None = None
) -> tuple[int, str, str]:
    """Run a command in a group of its own; give its status, output and complaint.

    None of its processes is left behind. before: called in the new process. Raises TimeoutExpired.
    """
    posix, pipe = os.name == "posix", subprocess.PIPE
    with subprocess.Popen(
        command, stdout=pipe, stderr=pipe, text=True, errors="replace", start_new_session=True,
        preexec_fn=before if posix else None,
    ) as process:  # fmt: skip
        try:
            output, complaint = process.communicate(timeout=seconds)
        finally:
            with suppress(ProcessLookupError):  # the good case: nothing is left
                os.killpg(process.pid, signal.SIGKILL) if posix else process.kill()
            process.communicate()  # its pipes end with the last process that holds them
    return process.returncode, output, complaint


class LibreOffice(Engine):
    """LibreOffice through UNO, its programming interface; what it saves is rounded to 15 digits.

    The UNO bindings belong to one certain Python, seldom this one: `uno_script.py` runs in the
    first that can import them. An office starts in a second or two; several workbooks share it.
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

    def _cells_of_each(self, paths: Sequence[Path]) -> Iterator[Iterator[Cell]]:
        soffice, script = str(office()), str(Path(__file__).with_name("uno_script.py"))
        with TemporaryDirectory(prefix="coldspray-") as folder:
            # Copies, since LibreOffice puts a lock file beside what it opens.
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
    """The path of LibreOffice's program, if it is installed."""
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
    """Gnumeric through its converter `ssconvert`.

    It writes the recalculated workbook as .xlsx, with all digits. Debian's computes in long
    doubles, which are rounded to doubles only on reading.
    """

    name = "gnumeric"
    long_doubles = True

    def missing(self) -> str | None:
        reason = "The command ssconvert is not installed: install the system package gnumeric."
        return None if shutil.which("ssconvert") else reason

    def version(self) -> str:
        return self._version_of("ssconvert")

    def _cells(self, path: Path) -> Iterator[Cell]:
        from openpyxl import load_workbook
        from openpyxl.utils.datetime import to_excel

        with TemporaryDirectory(prefix="coldspray-") as folder:
            converted = Path(folder, "converted.xlsx")
            # Without --recalc stored values would come back; without the importer's name, it would
            # take any text file for a table.
            formats = (f"--{way}port-type=Gnumeric_Excel:xlsx" for way in ("im", "ex"))
            self._run(["ssconvert", "--recalc", *formats, str(path.resolve()), str(converted)])
            with warnings.catch_warnings(action="ignore"):  # Gnumeric names no default style
                book = load_workbook(converted, data_only=True)
        for sheet in book.worksheets:
            for cell in chain.from_iterable(sheet.iter_rows()):
                value: Any = cell.value
                if not isinstance(value, str | bool | None):
                    number = float(value if isinstance(value, float | int) else to_excel(value))  # type: ignore[no-untyped-call]
                    # One beyond all doubles is the error that the other engines give.
                    value = number if math.isfinite(number) else "#NUM!"
                yield sheet.title, cell.coordinate, value


ENGINES: tuple[Engine, ...] = (IronCalc(), Formualizer(), LibreOffice(), Gnumeric())

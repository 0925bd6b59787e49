"""Recalculate workbooks in LibreOffice and print the values of each as a line of JSON.

Run by `engines.py` as `PYTHON uno_script.py SOFFICE PROFILE WORKBOOK...` with a Python that has the
UNO bindings, perhaps an old one: only `uno` and the standard library can be imported here. On
failure the last line of standard error says why. The JSON maps each sheet's name to its rows from
A1 on: numbers with all their digits, text ("" where a cell is blank) and errors as text.
"""

from __future__ import annotations

import importlib
import json
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from typing import Any
from uuid import uuid4

if __name__ == "__main__":  # tests and documentation import this file under another Python
    uno: Any = importlib.import_module("uno")

START_LIMIT_S = 60
RESTART = 81  # how soffice leaves when it has set up a new profile and wants to start again
ERRORS = {
    503: "#NUM!", 519: "#VALUE!", 521: "#NULL!", 524: "#REF!", 525: "#NAME?", 532: "#DIV/0!",
    32767: "#N/A",
}  # fmt: skip
"""Error numbers with a text of their own. The cells show the same, but in the user's language."""


def start(soffice: str, profile: str) -> tuple[subprocess.Popen[bytes], Any]:
    """Start LibreOffice with a private profile and pipe; return its process and its desktop."""
    pipe = f"pipe,name=coldspray{uuid4().hex};urp;"
    options = ["--headless", "--norestore", "--nologo", "--nodefault", f"--accept={pipe}"]
    command = [soffice, *options, f"-env:UserInstallation={Path(profile).as_uri()}"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    services = uno.getComponentContext().ServiceManager
    resolver = services.createInstance("com.sun.star.bridge.UnoUrlResolver")
    deadline = time.monotonic() + START_LIMIT_S
    while time.monotonic() < deadline:
        with suppress(uno.getClass("com.sun.star.connection.NoConnectException")):
            services = resolver.resolve(f"uno:{pipe}StarOffice.ServiceManager")
            return process, services.createInstance("com.sun.star.frame.Desktop")
        status = process.poll()
        if status == RESTART:
            process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        elif status is not None:
            sys.exit(f"soffice ended with status {status} before it answered")
        time.sleep(0.05)
    sys.exit(f"soffice did not answer within {START_LIMIT_S} s")


def rows(sheet: Any) -> list[list[float | str]]:
    """All cells from A1 to the end of the used area; the data array gives an error as None."""
    cursor = sheet.createCursor()
    cursor.gotoEndOfUsedArea(False)
    end = cursor.RangeAddress
    data = sheet.getCellRangeByPosition(0, 0, end.EndColumn, end.EndRow).getDataArray()

    def error(row: int, column: int) -> str:
        number = sheet.getCellByPosition(column, row).getError()
        return ERRORS.get(number, f"Err:{number}")

    return [
        [error(row, column) if value is None else value for column, value in enumerate(line)]
        for row, line in enumerate(data)
    ]


def main() -> None:
    """Recalculate the workbooks named on the command line."""
    soffice, profile, *workbooks = sys.argv[1:]
    process, desktop = start(soffice, profile)
    # Without a window; only as .xlsx, or any text would do for a document.
    options = tuple(
        uno.createUnoStruct("com.sun.star.beans.PropertyValue", Name=name, Value=value)
        for name, value in (("Hidden", True), ("FilterName", "Calc MS Excel 2007 XML"))
    )
    try:
        for workbook in workbooks:
            document = desktop.loadComponentFromURL(Path(workbook).as_uri(), "_blank", 0, options)
            if document is None:
                sys.exit("cannot load the workbook")
            document.calculateAll()  # loading alone would keep the stored values
            print(json.dumps({sheet.Name: rows(sheet) for sheet in document.Sheets}))
            document.close(True)
    finally:
        # It may hang up before it has answered the request to end.
        with suppress(uno.getClass("com.sun.star.lang.DisposedException")):
            desktop.terminate()
        process.wait()


if __name__ == "__main__":
    main()

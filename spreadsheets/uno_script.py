"""Recalculate workbooks in LibreOffice and print the values of each as one line of JSON.

`engines.py` runs this as `PYTHON uno_script.py SOFFICE PROFILE WORKBOOK...`, with a Python that has
the UNO bindings and may be old: import only `uno` and the standard library here. On failure the
last line of standard error says why. The JSON maps the name of each sheet to its rows from A1 on:
numbers with all their digits, texts ("" for a blank cell), and errors as texts.
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

if __name__ == "__main__":  # tests and documentation import this file with a Python without UNO
    uno: Any = importlib.import_module("uno")

START_LIMIT_S = 60
RESTART = 81  # exit status of soffice when it has set up a new profile and must be started again
ERRORS = {
    503: "#NUM!", 519: "#VALUE!", 521: "#NULL!", 524: "#REF!", 525: "#NAME?", 532: "#DIV/0!",
    32767: "#N/A",
}  # fmt: skip
"""Error codes that have a name. A cell's own text would be in the user's language."""


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
    """Return the values from A1 to the end of the used area, row by row."""
    cursor = sheet.createCursor()
    cursor.gotoEndOfUsedArea(False)
    end = cursor.RangeAddress
    data = sheet.getCellRangeByPosition(0, 0, end.EndColumn, end.EndRow).getDataArray()

    def error(row: int, column: int) -> str:
        number = sheet.getCellByPosition(column, row).getError()
        return ERRORS.get(number, f"Err:{number}")

    return [  # the data array holds None for an error
        [error(row, column) if value is None else value for column, value in enumerate(values)]
        for row, values in enumerate(data)
    ]


def main() -> None:
    """Recalculate the workbooks named on the command line."""
    soffice, profile, *workbooks = sys.argv[1:]
    process, desktop = start(soffice, profile)
    # The filter is named, since LibreOffice would otherwise open any text file as a document.
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
        # LibreOffice may close the connection before it has answered the request to end.
        with suppress(uno.getClass("com.sun.star.lang.DisposedException")):
            desktop.terminate()
        process.wait()


if __name__ == "__main__":
    main()

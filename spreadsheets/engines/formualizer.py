"""formualizer, from the Python package of that name: exact doubles and booleans."""

from __future__ import annotations

import zipfile
from collections.abc import Iterator
from pathlib import Path

from spreadsheets.engines.base import Cell, EngineError, PipEngine, Value, parsed, worksheets

ERRORS = {"Div": "#DIV/0!", "Na": "#N/A", "Name": "#NAME?"}
"""Kinds of error whose text is more than the kind in capitals between # and !."""


class Formualizer(PipEngine):
    """Loads, evaluates everything, and reads each cell that the file has."""

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
        with zipfile.ZipFile(path) as archive:
            for sheet, part in worksheets(archive).items():
                # It cannot be asked which cells there are.
                for cell in parsed(archive, part).iterfind("{*}sheetData/{*}row/{*}c"):
                    row, column = coordinate_to_tuple(cell.attrib["r"])
                    value = workbook.get_value(sheet, row, column)
                    yield sheet, cell.attrib["r"], _value(value)


def _value(value: Value | dict[str, str] | None) -> Value | None:
    """Spell an error as a cell shows it; all other values are the right ones already."""
    if not isinstance(value, dict):
        return value
    kind = value["kind"]
    return ERRORS.get(kind, f"#{kind.upper()}!")

"""formualizer, from the Python package of that name: exact doubles and booleans."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from spreadsheets.engines.base import Cell, EngineError, PipEngine, Value, address

if TYPE_CHECKING:
    from formualizer import Workbook

ERRORS = {"Div": "#DIV/0!", "Na": "#N/A", "Name": "#NAME?"}
"""Kinds of error whose text is more than the kind in capitals between # and !."""


class Formualizer(PipEngine):
    """Loads, evaluates everything, and reads each sheet's used range."""

    name = "formualizer"

    def _cells(self, path: Path) -> Iterator[Cell]:
        import formualizer

        try:
            workbook = formualizer.load_workbook(str(path))
            workbook.set_temporal_egress("serial")  # dates as numbers, like the other engines
            workbook.evaluate_all()
        except (OSError, formualizer.ExcelEvaluationError) as error:
            raise EngineError(self.name, f"cannot read {path}: {error}") from error
        for sheet in workbook.sheet_names:
            rows, columns = _used(workbook, sheet)
            for row in range(1, rows + 1):
                for column in range(1, columns + 1):
                    value = _value(workbook.get_value(sheet, row, column))
                    yield sheet, address(row, column), value


def _used(workbook: Workbook, sheet: str) -> tuple[int, int]:
    """Count the rows and columns in use; an open range is cut only where it is open."""
    quoted = "'" + sheet.replace("'", "''") + "'"
    rows, _ = _end(workbook, f"{quoted}!A:XFD")
    _, columns = _end(workbook, f"{quoted}!1:{max(rows, 1)}")
    return rows, columns


def _end(workbook: Workbook, area: str) -> tuple[int, int]:
    """Return the last row and column of an area after its open ends are cut to the used range."""
    from openpyxl.utils.cell import coordinate_to_tuple

    resolved = workbook.range_page(area, limit=1).resolved
    if resolved is None:
        return 0, 0
    corners = resolved.rpartition("!")[2]
    return coordinate_to_tuple(corners.rpartition(":")[2])


def _value(value: Value | dict[str, str] | None) -> Value | None:
    """Spell an error as a cell shows it; all other values are the right ones already."""
    if not isinstance(value, dict):
        return value
    kind = value["kind"]
    return ERRORS.get(kind, f"#{kind.upper()}!")

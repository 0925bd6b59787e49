"""An .xlsx file -> its formulas and the values stored beside them, by sheet and address."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from spreadsheets.plan import Place, Value

__all__ = ["Readback", "read"]


@dataclass(frozen=True, slots=True)
class Readback:
    """What a file holds: formulas with their "=", and values as stored, blank cells absent.

    Numbers are float. A formula that gives the empty text counts as blank.
    """

    formulas: dict[str, dict[str, str]]
    values: dict[str, dict[str, Value]]


def read(path: Path) -> Readback:
    """Read a workbook without recalculating it. Raises what openpyxl raises for a damaged file."""
    sheets, cells = _contents(path, data_only=False)
    formulas: dict[str, dict[str, str]] = {name: {} for name in sheets}
    for (sheet, address), content in cells:
        if isinstance(content, str) and content.startswith("="):
            formulas[sheet][address] = content
    sheets, cells = _contents(path, data_only=True)
    values: dict[str, dict[str, Value]] = {name: {} for name in sheets}
    for (sheet, address), content in cells:
        if content is not None and content != "":
            values[sheet][address] = _value(content)
    return Readback(formulas, values)


def _contents(path: Path, *, data_only: bool) -> tuple[list[str], Iterator[tuple[Place, Any]]]:
    from openpyxl import load_workbook

    book = load_workbook(path, data_only=data_only)
    cells = (
        ((sheet.title, cell.coordinate), cell.value)
        for sheet in book.worksheets
        for row in sheet.iter_rows()
        for cell in row
    )
    return [sheet.title for sheet in book.worksheets], cells


def _value(content: Any) -> Value:
    if isinstance(content, bool | str):
        return content
    return float(content)

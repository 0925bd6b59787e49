"""Whether an engine computes at all: one that echoes stored values verifies nothing."""

from __future__ import annotations

from pathlib import Path

from spreadsheets.engines.base import Engine

SHEET = "planted"


def repairs_wrong_value(engine: Engine, folder: Path) -> bool:
    """Plant a wrong stored value beside a formula and tell whether the engine put it right."""
    path = folder / f"planted-{engine.name}.xlsx"
    _plant(path)
    return engine.recalculate(path)[SHEET].get("A2") == 42


def _plant(path: Path) -> None:
    """Write a workbook that claims that 6 times 7 is 41."""
    import xlsxwriter

    with xlsxwriter.Workbook(path) as workbook:
        sheet = workbook.add_worksheet(SHEET)
        sheet.write_number("A1", 6)
        sheet.write_formula("A2", "=A1*7", value=41)

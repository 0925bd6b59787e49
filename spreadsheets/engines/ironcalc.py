"""IronCalc, from the Python package ``ironcalc``: exact doubles, booleans and error texts."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from spreadsheets.engines.base import Cell, EngineError, PipEngine, address


class IronCalc(PipEngine):
    """Loads, evaluates and reads through the unformatted getter; the formatted ones round."""

    name = "ironcalc"

    def _cells(self, path: Path) -> Iterator[Cell]:
        import ironcalc

        try:
            model = ironcalc.load_from_xlsx(str(path))
        except ironcalc.WorkbookError as error:
            raise EngineError(self.name, f"cannot read {path}: {error}") from error
        model.evaluate()
        sheets = [sheet["name"] for sheet in model.get_worksheets_properties()]
        for sheet, row, column in model.get_all_cells():
            value = model.get_cell_value(sheet, row, column)
            yield sheets[sheet], address(row, column), value

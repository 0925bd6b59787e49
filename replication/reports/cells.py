"""Which cell of the report's workbook a claim is computed in."""

from replication.workbook import report_plan
from spreadsheets.sheets.audit_cells import CELLS

__all__ = ["workbook_cell"]


def workbook_cell(name: str, cell: str | None) -> str | None:
    """The cell that computes a claim, given its id, or the claim's own cell of Table A-1.

    >>> workbook_cell("depth-beta-5", None)
    'Sheet beta 5!K22'
    """
    if name in CELLS:
        return "!".join(report_plan().where[CELLS[name]])
    return f"Table A-1!{cell}" if cell else None

"""Which cell of the report's workbook a claim is computed in."""

from typing import Any

from replication.workbook import report_plan
from spreadsheets.sheets.audit_cells import CELLS

__all__ = ["workbook_cell"]


def workbook_cell(claim: dict[str, Any]) -> str | None:
    """The cell that computes a claim, given its record, or the claim's own cell of Table A-1.

    >>> workbook_cell({"id": "depth-beta-5", "cell": None})
    'Sheet beta 5!K22'
    """
    if claim["id"] in CELLS:
        return "!".join(report_plan().where[CELLS[claim["id"]]])
    return f"Table A-1!{claim['cell']}" if claim["cell"] else None

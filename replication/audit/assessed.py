"""The verdict on a claim of the ledger, by its name, found once."""

from collections.abc import Mapping
from functools import cache

from reference.ledger import Ledger
from replication.audit.verdict import Assessment, assess
from spreadsheets.plan import Cell

__all__ = ["assess_claim"]


@cache
def assess_claim(ledger: Ledger, name: str) -> Assessment:
    """The verdict on one claim, blank cells included."""
    return assess(ledger, ledger.claims[name], _cell_is_blank)


def _cell_is_blank(address: str) -> bool:
    cell = _table_cells().get(address)
    return cell is None or not (cell.text.strip() or cell.key)


@cache
def _table_cells() -> Mapping[str, Cell]:
    from replication import workbook  # the proof of one number need not wait for its code

    return next(s.cells for s in workbook.report_plan().sheets if s.name == "Table A-1")

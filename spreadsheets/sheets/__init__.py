"""The sheets of the workbook, one module each, and their order."""

from collections.abc import Sequence

from spreadsheets.plan import WorkbookPlan
from spreadsheets.sheets import (
    contents,
    crater,
    frank_zook,
    inputs,
    resistance,
    steps,
    table_a1,
)
from spreadsheets.sheets.case import CaseSheet

__all__ = ["workbook_plan"]


def workbook_plan(cases: Sequence[CaseSheet]) -> WorkbookPlan:
    """The whole workbook for one or two cases; `Table A-1` shows the last of them."""
    cases = tuple(cases)
    return WorkbookPlan(
        sheets=(
            contents.sheet(cases),
            inputs.sheet(cases),
            table_a1.sheet(cases[-1]),
            *map(steps.sheet, cases),
            frank_zook.sheet(),
            crater.sheet(),
            resistance.sheet(cases),
        ),
        title=f"{contents.REPORT}: the model as a workbook",
        author=f"after {contents.AUTHOR}",
        subject="Replication with live formulas, each beside its computed value",
    )

"""The sheets of the workbook, one module each, and their order."""

from collections.abc import Sequence

from spreadsheets.plan import Place, SheetPlan, WorkbookPlan
from spreadsheets.sheets import (
    audit,
    contents,
    convergence,
    crater,
    equations,
    figure_3,
    figure_5,
    frank_zook,
    inputs,
    resistance,
    steps,
    table_a1,
    table_check,
)
from spreadsheets.sheets.case import CaseSheet

__all__ = ["workbook_plan"]


def workbook_plan(cases: Sequence[CaseSheet], coarse: Sequence[CaseSheet] = ()) -> WorkbookPlan:
    """The whole workbook for one or two cases; `Table A-1` shows the last of them.

    With `coarse`, the same cases with the coarser step, it is the report's workbook, with all that
    is about the report alone: those sheets, the checks against what is printed, and Figure 5.
    """
    cases, coarse = tuple(cases), tuple(coarse)
    table = table_a1.sheet(cases[-1], bool(coarse))
    sheets = [inputs.sheet(cases, bool(coarse)), table]
    if coarse:
        sheets.append(table_check.sheet(table))
    sheets += [*map(steps.sheet, (*cases, *coarse)), figure_3.sheet(cases)]
    if coarse:
        sheets += [figure_5.sheet(cases[-1]), convergence.sheet(cases)]
    sheets += [frank_zook.sheet(), crater.sheet(), resistance.sheet(cases)]
    if coarse:
        sheets.append(equations.sheet(cases))
        sheets.append(audit.sheet(_where(sheets)))
    return WorkbookPlan(
        sheets=(contents.sheet(cases, [sheet.name for sheet in sheets]), *sheets),
        title=f"{contents.REPORT}: the model as a workbook",
        author=f"after {contents.AUTHOR}",
        subject="Replication with live formulas, each beside its computed value",
        keywords="cold spray, penetration, replication, audit",
        comments="Written by coldspray. No macros, no links to other files.",
    )


def _where(sheets: Sequence[SheetPlan]) -> dict[str, Place]:
    return {
        cell.key: (sheet.name, address)
        for sheet in sheets
        for address, cell in sheet.cells.items()
        if cell.key
    }

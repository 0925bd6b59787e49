"""The sheets of the workbook and their order: which cell holds what, and by which formula."""

from collections.abc import Mapping, Sequence

from reference.ledger import Ledger
from spreadsheets.plan import SheetPlan, WorkbookPlan, place_of
from spreadsheets.sheets import audit, figures, inputs, models, overview, steps, table_a1
from spreadsheets.sheets.audit import Findings
from spreadsheets.sheets.steps import CaseSheet


def workbook_plan(
    ledger: Ledger,
    cases: Sequence[CaseSheet],
    coarse: Sequence[CaseSheet] = (),
    findings: Findings | None = None,
    *,
    version: str,
    warning_limits: tuple[float, float],
    shown: Mapping[str, str],
) -> WorkbookPlan:
    """The whole workbook for one or two cases; `Table A-1` and `Figure 5` show the last of them.

    With `coarse`, the same cases with the coarser step, and `findings`, the result of the audit, it
    is the report's own workbook, with all that is about the report alone. version: the program's.
    warning_limits: see `inputs.sheet`. shown: sheet -> what its chart shows as written, in words.
    Raises ValueError where the ledger has a claim computed by a cell that is none.
    """
    report = findings is not None
    table = table_a1.sheet(ledger, cases[-1], report)
    sheets = [
        (
            inputs.sheet(ledger, cases, report, warning_limits),
            "Every physical number: yours and the report’s, unit, check, limits, name",
        ),
        (table, "The five rows that the report’s appendix prints, cell for cell"),
    ]
    if report:
        check = "Printed, computed in full, and the difference in the last digit"
        sheets.append((table_a1.check_sheet(ledger, table), check))
    for case in (*cases, *coarse):
        what = "All rows of the scheme down to the stop, and its final depth (appendix)"
        again = "The same with the coarser time step, and what that changes (section 3)"
        sheets.append((steps.sheet(ledger, case), again if case.coarse else what))
    sheets += [
        (figures.figure_3(cases, shown["Figure 3"]), "Depth against time, with its chart"),
        (
            figures.figure_5(cases[-1], shown["Figure 5"]),
            "Normalized depth against velocity, with its chart (section 4)",
        ),
        (
            figures.convergence(cases, shown["Convergence"]),
            "Final depth at eight time steps against the depth at rest, with its chart",
        ),
        (models.frank_zook(ledger), "Eq. 16 as printed and as derived (Eqs. 14 to 17)"),
        (
            models.crater(ledger),
            "Section 2: crater volume, depth and contact diameter; particle velocities",
        ),
        (
            models.resistance(ledger, cases),
            "β by three routes, grain strengths, centerline stress, strain rate",
        ),
    ]
    if findings is not None:
        everything = "Every printed number: what prints like it, computed value, verdict, its cell"
        sheets.append((audit.sheet(ledger, findings), everything))
        _require_cells(ledger, [sheet for sheet, _ in sheets])
    described = {sheet.name: what for sheet, what in sheets}
    first = overview.sheet(ledger, cases, described, version, findings)
    return WorkbookPlan(
        sheets=(first, *(sheet for sheet, _ in sheets)),
        title=f"{ledger.report.title}: the model as a workbook",
        properties={
            "author": f"coldspray {version}",
            "subject": f"The model of a report by {ledger.report.author} "
            f"({ledger.report.year}), as live formulas beside their computed values",
            "keywords": "cold spray, penetration, replication, audit",
            "comments": "No macros, no links to other files, no dates: the same inputs give the "
            "same file.",
        },
    )


def _require_cells(ledger: Ledger, sheets: Sequence[SheetPlan]) -> None:
    """Raise ValueError unless every claim's cell is one that is computed."""
    cells = {sheet.name: sheet.cells for sheet in sheets}
    for claim in audit.computed_claims(ledger):
        sheet, address = place_of(str(claim.entry.workbook))
        cell = cells.get(sheet, {}).get(address)
        if cell is None or not cell.formula:
            raise ValueError(
                f"claim {claim.id!r}: the workbook computes nothing in {sheet}!{address}"
            )

"""The sheets of the workbook and their order: which cell holds what, and by which formula."""

from collections.abc import Mapping, Sequence

from reference.ledger import Ledger
from spreadsheets.plan import WorkbookPlan, place_of
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
    report, last = findings is not None, cases[-1]
    table = table_a1.sheet(ledger, last, report)
    sheets = [inputs.sheet(ledger, cases, report, warning_limits), table]
    sheets += [table_a1.check_sheet(ledger, table)] if report else []
    sheets += [steps.sheet(ledger, case) for case in (*cases, *coarse)]
    sheets += [
        figures.figure_3(cases, shown["Figure 3"]),
        figures.figure_5(last, shown["Figure 5"]),
        figures.convergence(cases, shown["Convergence"]),
        models.frank_zook(ledger),
        models.crater(ledger),
        models.resistance(ledger, cases),
    ]
    if findings is not None:
        sheets.append(audit.sheet(ledger, findings))
        cells = {sheet.name: sheet.cells for sheet in sheets}
        for claim in audit.computed_claims(ledger):
            name, address = place_of(str(claim.workbook))
            cell = cells.get(name, {}).get(address)
            if cell is None or not cell.formula:
                raise ValueError(
                    f"claim {claim.id!r}: the workbook computes nothing in {name}!{address}"
                )
    said = {sheet.name: _SAID.get(sheet.name, "") for sheet in sheets}
    said |= {case.name: _SHEET for case in cases} | {case.name: _COARSE for case in coarse}
    first = overview.sheet(ledger, cases, said, version, findings)
    return WorkbookPlan(
        sheets=(first, *sheets),
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


_SAID = {
    "Inputs": "Every physical number: yours and the report’s, unit, check, limits, name",
    "Table A-1": "The first rows of the scheme, laid out as the report’s appendix prints them",
    "Table A-1 check": "Printed, computed in full, and the difference in the last digit",
    "Figure 3": "Depth against time, with its chart",
    "Figure 5": "Normalized depth against velocity, with its chart (section 4)",
    "Convergence": "Final depth at eight time steps against the depth at rest, with its chart",
    "Frank-Zook": "Eq. 16 as printed and as derived (Eqs. 14 to 17)",
    "Crater": "Section 2: crater volume, depth and contact diameter; particle velocities",
    "Resistance": "β by three routes, grain strengths, centerline stress, strain rate",
    "Audit": "Every printed number: what prints like it, computed value, verdict, its cell",
}
_SHEET = "All rows of the scheme down to the stop, and its final depth (appendix)"
_COARSE = "The same with the time step of the comparison, and what that changes (section 3)"
"""What each sheet shows, for the first of them; those of the cases apart."""

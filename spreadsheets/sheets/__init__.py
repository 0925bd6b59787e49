"""The sheets of the workbook, one module each, and the workbook that they form.

A module has one function that returns the plan of its sheet. A quantity is one line of it: symbol,
meaning, formula, unit, and the claim that its cell computes.
"""

from collections.abc import Mapping, Sequence
from functools import cache
from re import findall

from reference.ledger import Ledger, load
from reference.scheme import Scheme
from spreadsheets.plan import Rule, SheetPlan, WorkbookPlan
from spreadsheets.sheets.audit import AuditResult, audit_sheet
from spreadsheets.sheets.case import CaseSheet, case_sheet
from spreadsheets.sheets.convergence import convergence
from spreadsheets.sheets.crater import crater
from spreadsheets.sheets.figures import figures
from spreadsheets.sheets.inputs import inputs_sheet
from spreadsheets.sheets.overview import overview, program, title_of
from spreadsheets.sheets.resistance import resistance
from spreadsheets.sheets.solve import solve
from spreadsheets.sheets.table_a1 import TABLE_ROWS, table_a1


def workbook_plan(
    ledger: Ledger, cases: Sequence[CaseSheet], audited: AuditResult | None = None
) -> WorkbookPlan:
    """Plan the workbook for one or two cases; `Table A-1` and Figure 5 show the last of them.

    With `audited` it is the report's own workbook, and also has what concerns only the report;
    `cases` must then have each case with the coarser step, too.
    """
    report, fine = audited is not None, [case for case in cases if not case.coarse]
    sheets = [inputs_sheet(ledger, fine, report), table_a1(ledger, fine[-1], report)]
    sheets += [case_sheet(ledger, case) for case in cases]
    sheets += [figures(ledger, fine), convergence(ledger, fine), crater(ledger)]
    sheets += [resistance(ledger, fine), solve(ledger, fine)]
    computed_in = WorkbookPlan(sheets=tuple(sheets)).claims
    sheets += [audit_sheet(ledger, audited, computed_in)] if audited else []
    sheets = [overview(ledger, cases, sheets, audited, computed_in), *sheets]
    for sheet in sheets:
        sheet.rules.append(_faint_where_not_available(sheet))
    return WorkbookPlan(sheets=tuple(sheets), properties=_properties(ledger))


def _faint_where_not_available(sheet: SheetPlan) -> Rule:
    """Return the rule by which cells are faint that show #N/A, as an input cannot be used."""
    last_column = max(address[0] for address in sheet.cells)
    last_row = max(int(findall(r"\d+", address)[0]) for address in sheet.cells)
    return Rule(f"A1:{last_column}{last_row}", "=ISERROR(A1)", "faint")


def _properties(ledger: Ledger) -> dict[str, str]:
    """Return the properties of the file."""
    report = ledger.report
    return {
        "title": title_of(ledger),
        "author": program(),
        "subject": f"The model of a report by {report.author} ({report.year}), as live formulas"
        " beside their computed values",
        "keywords": "cold spray, penetration, replication, audit",
        "comments": "No macros, no links to other files, no dates: the same inputs give the same"
        " file.",
    }


def report_cases() -> list[CaseSheet]:
    """Return the sheets of the report's two cases, with no more rows than Table A-1 shows."""
    return [
        CaseSheet(
            name=f"Sheet beta {beta}", slug=slug, label=f"β = {beta}", scheme=Scheme.PUBLISHED,
            beta=beta, is_reports=True, resistance_given=False, rows=TABLE_ROWS - 1,
        )
        for slug, beta in (("low", "3"), ("high", "5"))
    ]  # fmt: skip


@cache
def cells_of_claims() -> Mapping[str, str]:
    """Return the cell of the report's workbook that computes a claim, by the claim's id.

    >>> cells_of_claims()["sphere-length-ratio"]
    'Resistance and Frank-Zook!C37'
    """
    ledger = load()
    cases = report_cases()
    sheets = (
        inputs_sheet(ledger, cases, report=True),
        table_a1(ledger, cases[-1], report=True),
        *(case_sheet(ledger, case) for case in cases),
        crater(ledger),
        resistance(ledger, cases),
    )
    places = WorkbookPlan(sheets=sheets).claims
    return {claim: f"{sheet}!{address}" for claim, (sheet, address) in places.items()}

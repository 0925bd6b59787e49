"""The sheets of the workbook and their order; the first, `Overview`, tells what the others show.

It has the results, whether they can be trusted, what the audit found, and the sheets.
"""

from collections.abc import Mapping, Sequence
from importlib.metadata import version
from itertools import zip_longest
from textwrap import wrap

from reference.ledger import Ledger
from spreadsheets.plan import (
    HOME,
    Rule,
    SheetPlan,
    WorkbookPlan,
    formula,
    place_of,
    printed,
    recorded,
    text,
)
from spreadsheets.sheets import audit, figures, inputs, models, steps, table_a1
from spreadsheets.sheets.audit import KINDS, Findings
from spreadsheets.sheets.steps import SCHEMES, CaseSheet

PROGRAM = f"coldspray {version('coldspray')}"


def workbook_plan(
    ledger: Ledger,
    cases: Sequence[CaseSheet],
    coarse: Sequence[CaseSheet] = (),
    findings: Findings | None = None,
) -> WorkbookPlan:
    """The whole workbook for one or two cases; `Table A-1` and `Figure 5` show the last of them.

    With `coarse`, the same cases with the coarser step, and `findings`, the result of the audit, it
    is the report's own workbook, with all that is about the report alone. Raises ValueError where
    the ledger has a claim computed by a cell that is none.
    """
    report, last = findings is not None, cases[-1]
    table = table_a1.sheet(ledger, last, report)
    sheets = [inputs.sheet(ledger, cases, report), table]
    sheets += [table_a1.check_sheet(ledger, table)] if report else []
    sheets += [steps.sheet(ledger, case) for case in (*cases, *coarse)]
    sheets += [
        figures.figure_3(cases),
        figures.figure_5(last),
        figures.convergence(cases),
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
    first = _overview(ledger, cases, said, findings)
    return WorkbookPlan(
        sheets=(first, *sheets),
        title=f"{ledger.report.title}: the model as a workbook",
        properties={
            "author": PROGRAM,
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


# Overview

_HOW = (
    ("input", "Blue on yellow: an input. Change it on the sheet Inputs, and every sheet follows."),
    ("inferred", "Blue on orange: an input that the report never prints, inferred from others."),
    ("number", "Black: a formula, stored with the value that coldspray computed for it."),
    ("printed", "Gray: what the report prints, or what was computed once. It follows no change."),
)


def _block(page: SheetPlan, *words: str, right: str = "") -> None:
    """The heads of a table, after a blank row."""
    page.row += 1
    page.heads("ABCDEF", [*words, *[""] * (6 - len(words))], right)


def _overview(
    ledger: Ledger,
    cases: Sequence[CaseSheet],
    sheets: Mapping[str, str],
    findings: Findings | None,
) -> SheetPlan:
    """The first sheet; `sheets` says what each of the others shows."""
    report, scheme = ledger.report, cases[0].scheme
    page = SheetPlan(name=HOME, widths={"A": 38.0, **dict.fromkeys("BCDE", 17.0), "F": 54.0})
    page.put(A=text(f"{report.title}: the model as a workbook", "title"))
    page.say(
        f"After the report by {report.author} ({report.year}). Written by {PROGRAM}; "
        f"{scheme} scheme: {SCHEMES[scheme]}.",
        style="body",
    )
    if findings is not None:
        page.say(findings.headline, style="headline", width=140)
    _results(page, ledger, cases)
    if findings is not None:
        _what_fails(page, ledger, findings)
        page.page_break = page.row
    _block(page, "Sheets")
    for name, what in sheets.items():
        page.put(A=text(name, "link", link=(name, "A1")), B=text(what))
    _block(page, "How to read it")
    for style, what in _HOW:
        page.put(A=text("1.23", f"{style} sample"), B=text(what, "text"))
    page.print_area = f"A1:F{page.row - 1}"
    return page


def _results(page: SheetPlan, ledger: Ledger, cases: Sequence[CaseSheet]) -> None:
    _block(
        page, "Results with the inputs in use", "Final depth [µm]", "The report prints",
        "Depth over radius", "The report prints", "State of the run", right="BCDE",
    )  # fmt: skip
    for case in cases:
        like = {"unit": "um", "column": f"{case.part}.depth_um"}
        cells = {"A": text(case.name, "link", link=(case.name, "A1"))}
        for column, what, style, more in (
            ("B", "depth_um", "result", like | {"number_format": "0.0000"}),
            ("D", "normalized_depth", "result", {"number_format": "0.0000"}),
            ("F", "message", "state", {}),
        ):
            shown = f"={case.result(what)}"
            if column == "F" and not case.resistance_given:
                # Beside the name of a sheet for another beta: the beta in use.
                there = f"'{case.name}'!"
                shown = f'=IF({there}I2="","",{there}I1&": ")&{shown[1:]}'
            cells[column] = formula(f"overview.{case.slug}.{what}", shown, style, **more)
        if case.is_reports:
            cells["C"] = printed(ledger, case.claim("depth"), "um")
            cells["E"] = printed(ledger, case.claim("ratio"))
        page.rules += case.rules(f"F{page.row}")
        page.put(**cells)
    for words, name in (
        ("Inputs that are not the report’s", "inputs_changed"),
        ("Inputs that cannot be used", "inputs_unusable"),
    ):
        page.rules.append(Rule(f"B{page.row}", f"={name}>0", "warning"))
        count = formula(f"overview.{name}", f"={name}", "result")
        page.put(A=text(words, "link", link=("Inputs", "A1")), B=count)


def _what_fails(page: SheetPlan, ledger: Ledger, findings: Findings) -> None:
    heads = ("The report prints", "Inputs in use", "Why, with the report’s inputs")
    for head, names in (
        ("What does not follow from the report", findings.failing),
        ("What public sources give otherwise", findings.differing),
    ):
        _block(page, head, *heads, right="BC")
        for name in names:
            claim = ledger.claims[name]
            first, *more = wrap(findings.explanations[name], 100)
            cells = {"A": text(claim.title), "B": printed(ledger, name), "D": text(first, "text")}
            if claim.workbook:
                there = "='{}'!{}".format(*place_of(claim.workbook))
                shown = "0.0" if ledger.value(name) > 100 else "0.0000"
                cells["C"] = formula(
                    f"overview.{name}", there, "result", number_format=shown, transcendental=True
                )
            page.put(**cells)
            for line in more:
                page.put(D=text(line, "text"))
    _block(page, "Verdicts of the audit", "Numbers", "", "Live verdicts", "Cells", right="BDE")
    given = [(verdict, count) for verdict, count in findings.counts.items() if count]
    for (verdict, count), kind in zip_longest(given, KINDS[: len(given)]):
        cells = {"A": text(verdict, "link", link=("Audit", "A1")), "B": recorded(float(count))}
        if kind:
            cells["D"] = text(kind[0], "number")
            cells["E"] = formula(f"overview.audit_{kind[1]}", f"=audit_{kind[1]}", "result")
        page.put(**cells)
    page.say(
        "Verdicts of the audit are about the report. Live verdicts tell which computed cells print "
        "as the report does with the inputs in use."
    )

"""The sheet `Overview`: results, whether they can be trusted, what the audit found, all sheets."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import zip_longest
from textwrap import wrap

from reference.ledger import Ledger
from spreadsheets.plan import (
    HOME,
    ROW_HEIGHT,
    Cell,
    CellPlace,
    Rule,
    SheetPlan,
    formula,
    printed,
    recorded,
)
from spreadsheets.sheets.audit import LIVE_VERDICTS, AuditResult
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.figures import FIGURES


def program() -> str:
    """Return the name and the version of the program that writes the workbook."""
    from importlib.metadata import version  # here, as it loads Python's parts for e-mail

    return f"coldspray {version('coldspray')}"


def overview(
    ledger: Ledger, cases: Sequence[CaseSheet], sheets: Sequence[SheetPlan],
    audited: AuditResult | None, computed_in: Mapping[str, CellPlace],
) -> SheetPlan:  # fmt: skip
    """Plan the first sheet; `sheets` are the others, to which it links.

    computed_in: the cell that computes a claim, by the claim's id.
    """
    report, scheme = ledger.report, cases[0].scheme
    sheet = SheetPlan(ledger=ledger, name=HOME, portrait=True, most_pages=1)
    sheet.widths = {"A": 33, "B": 15.5, "C": 16, "D": 9, "E": 15, "F": 9, "G": 47}
    sheet.put(A=Cell(title_of(ledger), "title"))
    sheet.say(
        f"After the report by {report.author} ({report.year}). Written by {program()}; {scheme}"
        f" scheme: the drag is taken at the {scheme.drag_at} velocity of a row.",
        style="body",
    )
    if audited is not None:
        sheet.say(audited.headline, style="headline", width=140)
    _results(sheet, cases)
    _figure(sheet, sheets)
    if audited is not None:
        _failures(sheet, audited, computed_in)
    _heads(sheet, "Sheets")
    for listed in sheets:
        link = Cell(listed.name, "link", link=(listed.name, "A1"))
        sheet.put(A=link, B=Cell(listed.about))
    _how_to_read(sheet)
    sheet.print_area = f"A1:G{sheet.row - 1}"
    return sheet


def title_of(ledger: Ledger) -> str:
    """Return the title of the workbook."""
    return f"{ledger.report.title}: the model as a workbook"


def _heads(sheet: SheetPlan, *heads: str, right: str = "") -> None:
    """Add the heads of a table, after a blank row."""
    sheet.row += 1
    sheet.heads("ABCDEFG", [*heads, *[""] * (7 - len(heads))], right)


def _results(sheet: SheetPlan, cases: Sequence[CaseSheet]) -> None:
    """Add the final depth of every case, the exact one, the state of its run, and counts of inputs.

    The exact depth is the one at rest, without time steps.
    """
    _heads(
        sheet, "Results with the inputs in use", "Final depth [µm]", "Exact depth [µm]",
        "It prints", "X/R of the sheet", "It prints", "State of the run", right="BCDEF",
    )  # fmt: skip
    for case in cases:
        key, s = f"overview.{case.part}", case.suffix
        claimed = case.is_reports and not case.coarse
        depth, ratio = f"depth-beta-{case.beta}", f"ratio-beta-{case.beta}"
        sheet.rules += case.rules(f"G{sheet.row}")
        sheet.put(
            A=Cell(case.name, "link", link=(case.name, "A1")),
            B=formula(
                f"{key}.depth_um", f"=depth_um{s}", "result", shown="0.0000", unit="um",
                like=f"{case.part}.depth_um",
            ),
            C=formula(
                f"{key}.exact_um", f"=X_rest{s}", "result", shown="0.0000", unit="um",
                like=f"{case.part}.depth_um",
            ),
            D=printed(sheet.ledger, depth, "um") if claimed else None,
            E=formula(
                f"{key}.normalized_depth", f"=normalized_depth{s}", "result", shown="0.0000"
            ),
            F=printed(sheet.ledger, ratio) if claimed else None,
            # A sheet keeps its name if beta is changed, so the state begins with the beta in use.
            G=formula(f"{key}.message", f'=label{s}&": "&message{s}', "state"),
        )  # fmt: skip
    for name, label in (
        ("inputs_changed", "Inputs in use that are not the report’s"),
        ("inputs_unusable", "Inputs that cannot be used"),
    ):
        sheet.rules.append(Rule(f"B{sheet.row}", f"={name}>0", "warning"))
        count = formula(f"overview.{name}", f"={name}", "result")
        sheet.put(A=Cell(label, "link", link=("Inputs", "A1")), B=count)


_FIGURE_ROWS = 20
"""The rows that the chart covers."""


def _figure(sheet: SheetPlan, sheets: Sequence[SheetPlan]) -> None:
    """Add the chart of the sheet Figure 3, which also holds its curves."""
    chart = next(drawn for drawn in sheets if drawn.name == FIGURES).charts[0]
    height = int(_FIGURE_ROWS * ROW_HEIGHT * 96 / 72) - 5
    sheet.row += 1
    sheet.charts = [replace(chart, at=f"A{sheet.row}", size=(1040, height))]
    sheet.row += _FIGURE_ROWS


def _failures(sheet: SheetPlan, audited: AuditResult, computed_in: Mapping[str, CellPlace]) -> None:
    """Add the claims that fail, each with its explanation, and the counts of all verdicts."""
    beside = "The report prints", "Inputs in use", "Why, with the report’s inputs"
    _heads(sheet, "What does not follow from the report", *beside, right="BC")
    for name in audited.failing:
        _failure(sheet, name, audited, computed_in)
    if audited.differing:
        _heads(sheet, "Where public sources differ", *beside, right="BC")
    for name in audited.differing:
        _failure(sheet, name, audited, computed_in)
    _heads(sheet, "Verdicts of the audit", "Entries", "", "Live verdicts", "Cells", right="BDE")
    counted = [(verdict, count) for verdict, count in audited.counts.items() if count]
    for (verdict, count), live in zip_longest(counted, [*LIVE_VERDICTS.items()][: len(counted)]):
        cells = {"A": Cell(verdict, "link", link=("Audit", "A1")), "B": recorded(float(count))}
        if live:
            words, name = live
            cells["D"] = Cell(words, "number")
            cells["E"] = formula(f"overview.{name}", f"={name}", "result")
        sheet.put(**cells)
    sheet.say(
        "Verdicts of the audit are about the report. Live verdicts tell which computed cells, with"
        " the inputs in use, round to what the report prints, or keep to its bound."
    )


def _failure(
    sheet: SheetPlan, name: str, audited: AuditResult, computed_in: Mapping[str, CellPlace]
) -> None:
    ledger = sheet.ledger
    first, *more = wrap(audited.explanations[name], 92)
    cells = {
        "A": Cell(ledger.claims[name].title),
        "B": printed(ledger, name),
        "D": Cell(first, "text"),
    }
    if name in computed_in:
        sheet_name, address = computed_in[name]
        shown = "0.0" if ledger.value(name) > 100 else "0.0000"
        computed = f"='{sheet_name}'!{address}"
        cells["C"] = formula(f"overview.{name}", computed, "result", shown=shown)
    sheet.put(**cells)
    for line in more:
        sheet.put(D=Cell(line, "text"))


def _how_to_read(sheet: SheetPlan) -> None:
    _heads(sheet, "How to read it")
    for style, meaning in (
        (
            "input",
            "Blue on yellow: an input. Change it on the sheet Inputs, and every sheet follows.",
        ),
        (
            "inferred",
            "Blue on orange: an input that the report never prints, inferred from others.",
        ),
        ("number", "Black: a formula, stored with the value that coldspray computed for it."),
        (
            "printed",
            "Gray: what the report prints, or what was computed once. It does not change with the"
            " inputs.",
        ),
    ):
        sheet.put(A=Cell("1.23", f"{style} sample"), B=Cell(meaning, "text"))
    sheet.put(
        A=Cell("Faint #N/A", "number sample"),
        B=Cell(
            "Not computed: an input that it depends on cannot be used (Inputs, column E).", "text"
        ),
    )
    sheet.put(
        A=Cell("Protection", "number sample"),
        B=Cell(
            "Formulas are protected, without a password; nothing else is. To free them: Review >"
            " Unprotect Sheet (LibreOffice: Tools).",
            "text",
        ),
    )

"""The sheet `Overview`: results, whether they can be trusted, what the audit found, the sheets."""

from collections.abc import Mapping, Sequence
from itertools import zip_longest
from textwrap import wrap

from reference.ledger import Ledger
from spreadsheets.plan import HOME, Rule, SheetPlan, formula, place_of, printed, recorded, text
from spreadsheets.sheets.audit import KINDS, Findings
from spreadsheets.sheets.steps import SCHEMES, CaseSheet

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


def sheet(
    ledger: Ledger,
    cases: Sequence[CaseSheet],
    sheets: Mapping[str, str],
    version: str,
    findings: Findings | None,
) -> SheetPlan:
    """The first sheet; `sheets` says what each of the others shows."""
    report, scheme = ledger.report, cases[0].scheme
    page = SheetPlan(name=HOME, widths={"A": 38.0, **dict.fromkeys("BCDE", 17.0), "F": 54.0})
    page.put(A=text(f"{report.title}: the model as a workbook", "title"))
    page.say(
        f"After the report by {report.author} ({report.year}). Written by coldspray {version}; "
        f"{scheme} scheme: {SCHEMES[scheme]}.",
        style="body",
    )
    if findings is not None:
        page.say(findings.headline, style="headline", width=140)
    _results(page, ledger, cases)
    if findings is not None:
        _audit(page, ledger, findings)
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
        if case.depth_claim:
            cells["C"] = printed(ledger, case.depth_claim, "um")
            cells["E"] = printed(ledger, case.ratio_claim)
        page.rules += case.rules(f"F{page.row}")
        page.put(**cells)
    for words, name in (
        ("Inputs that are not the report’s", "inputs_changed"),
        ("Inputs that cannot be used", "inputs_unusable"),
    ):
        page.rules.append(Rule(cells=f"B{page.row}", formula=f"={name}>0", style="warning"))
        count = formula(f"overview.{name}", f"={name}", "result")
        page.put(A=text(words, "link", link=("Inputs", "A1")), B=count)


def _audit(page: SheetPlan, ledger: Ledger, findings: Findings) -> None:
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

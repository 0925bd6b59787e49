"""The sheets of the workbook and their order; `Overview`, `Audit` and those of closed formulas.

`Overview`, the first, has the results, whether they can be trusted, what the audit found, and the
sheets. `Audit` has every claim of the ledger, with a live verdict where a cell computes it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from itertools import zip_longest
from textwrap import wrap

from reference.ledger import Claim, Ledger
from spreadsheets.plan import (
    HOME,
    NOT_COMPUTED,
    Cell,
    Line,
    Rule,
    SheetPlan,
    WorkbookPlan,
    formula,
    lines_of,
    log1p,
    place_of,
    printed,
    recorded,
    tables,
    text,
    unit_text,
)
from spreadsheets.sheets import figures, inputs, steps
from spreadsheets.sheets.steps import SCHEMES, CaseSheet

PROGRAM = f"coldspray {version('coldspray')}"


AS_PRINTED, OTHERWISE = "as printed", "not as printed"
KINDS = ((AS_PRINTED, "as_printed"), (OTHERWISE, "otherwise"), (NOT_COMPUTED, "none"))
"""Live verdicts, and what the names of their counts end with."""


@dataclass(frozen=True, slots=True)
class Findings:
    """What a finished audit tells the workbook; texts and numbers only.

    counts: verdict -> how many numbers have it. verdicts, explanations: by claim. failing: claims
    that do not follow from what the report says. differing: those that public sources contradict.
    """

    headline: str
    counts: Mapping[str, int]
    verdicts: Mapping[str, str]
    explanations: Mapping[str, str]
    failing: Sequence[str]
    differing: Sequence[str]


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
    table = steps.table_a1(ledger, last, report)
    sheets = [inputs.sheet(ledger, cases, report), table]
    sheets += [steps.table_a1_check(ledger, table)] if report else []
    sheets += [steps.sheet(ledger, case) for case in (*cases, *coarse)]
    sheets += [
        figures.figure_3(cases),
        figures.figure_5(last),
        figures.convergence(cases),
        _frank_zook(ledger),
        _crater(ledger),
        _resistance(ledger, cases),
    ]
    if findings is not None:
        sheets.append(_audit(ledger, findings))
        cells = {sheet.name: sheet.cells for sheet in sheets}
        for claim in computed_claims(ledger):
            name, address = place_of(str(claim.workbook))
            cell = cells.get(name, {}).get(address)
            if cell is None or not cell.formula:
                raise ValueError(
                    f"claim {claim.id!r}: the workbook computes nothing in {name}!{address}"
                )
    kinds = {case.name: "of a case" for case in cases} | {case.name: "coarse" for case in coarse}
    said = {sheet.name: tables()["shows"][kinds.get(sheet.name, sheet.name)] for sheet in sheets}
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
    for style, what in tables()["how_to_read"].items():
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


# The report's closed formulas


def _formulas(
    ledger: Ledger, name: str, heading: str, said: Sequence[str], lines: Sequence[Line | str]
) -> SheetPlan:
    """One table under notes; its keys begin with the sheet's name."""
    columns = zip("ABCDEF", tables()["columns"]["lines"], strict=True)
    page = SheetPlan(name=name, widths={letter: width for letter, (_, width) in columns})
    page.title(heading)
    page.say(*said)
    page.row += 1
    page.repeated_rows, page.frozen = (page.row, page.row), f"A{page.row + 1}"
    page.lines(ledger, name.lower().replace("-", "_"), lines)
    return page


def _crater(ledger: Ledger) -> SheetPlan:
    """Section 2's geometry of a sphere pressed into a flat surface, and Eq. 1."""
    said = (
        "A crater of depth X ≤ R is a cap of the sphere: CV/PV = y² (3 - y)/4 with y = X/R. "
        "Its root is y = 4 sin(h) sin(h + π/3) with h = asin(√(CV/PV))/3."
    )
    lines = lines_of("crater", {"third": str(ledger.value("observed-third"))})
    return _formulas(ledger, "Crater", "Crater and particle", [said], lines)


def _resistance(ledger: Ledger, cases: Sequence[CaseSheet]) -> SheetPlan:
    """Beta by three routes, grain strengths, centerline stress, strain rate."""
    words = [{"slug": c.slug, "sheet": c.name, "R_t": c.named("R_t")} for c in cases]
    return _formulas(ledger, "Resistance", "Target resistance", [], lines_of("resistance", *words))


def _frank_zook(ledger: Ledger) -> SheetPlan:
    """Eq. 16 as it is printed, and as it follows from Eqs. 14 and 15."""
    said = (
        "Eqs. 14 and 15, integrated from V to rest, give the right side of Eq. 16 for the depth in "
        "diameters, X/D. Eq. 16 prints X/R in front of it. Both readings stand here: the derived "
        "one is twice the printed one."
    )
    logarithms = {f"log_{which}": log1p(f"{{{which}_pressure}}") for which in ("rha", "lower")}
    heading = "Frank-Zook depth of a noneroding penetrator"
    return _formulas(ledger, "Frank-Zook", heading, [said], lines_of("frank_zook", logarithms))


# Audit

_HEAD_ROW = 11


def computed_claims(ledger: Ledger) -> list[Claim]:
    """The claims that a cell of the workbook computes."""
    return [claim for claim in ledger.claims.values() if claim.workbook]


def _audit(ledger: Ledger, findings: Findings) -> SheetPlan:
    """The sheet. Each claim's entry in the ledger names the cell that computes it."""
    last = _HEAD_ROW + len(ledger.claims)
    verdicts = f"F{_HEAD_ROW + 1}:F{last}"
    page = SheetPlan(name="Audit", print_area=f"A1:I{last}", filtered=f"A{_HEAD_ROW}:L{last}")
    page.title("Audit: every number that the report prints")
    page.say(
        "Live verdict: whether the computed cell, with the inputs in use, prints as the report "
        "does; From and To are the values that print so. The audit’s verdict is about the report: "
        "it does not follow the inputs, and its proof is printed by coldspray claims ID.",
        width=150,
    )
    page.row = 6
    page.put(A=text("Live verdicts", "block"))
    for words, what in KINDS:
        count = f'=COUNTIF({verdicts},"{words}")'
        counted = formula(f"audit.{what}", count, "message", name=f"audit_{what}")
        page.put(A=text(words, "text"), B=counted)
    page.row = _HEAD_ROW
    page.table("audit", "CEHI", "B")
    for claim in ledger.claims.values():
        page.put(**_row(ledger, claim, findings, page.row))
    page.color(verdicts, {AS_PRINTED: "good", OTHERWISE: "warning", NOT_COMPUTED: "changed"})
    return page


def _row(ledger: Ledger, claim: Claim, findings: Findings, row: int) -> dict[str, Cell]:
    """A claim, and where a cell computes it the live verdict with the ends of what prints so."""
    cells = {
        "A": text(claim.id),
        "B": text(claim.title, wrap=True),
        "C": printed(ledger, claim.id, claim.unit, wrap=True),
        "D": unit_text(claim.unit),
        "G": text(findings.verdicts[claim.id], "text", wrap=True),
        "J": text(str(claim.place), "unit"),
        "L": text(findings.explanations[claim.id], "unit"),
    }
    if not claim.workbook:
        return cells | {"F": text("–", "text")}
    # Fixed decimals for most, powers of ten where those would be long.
    size = 0 if claim.printed is None else abs(claim.printed.value)
    shown = "0.0000E+00" if claim.place.cell or size >= 10**5 else "0.0000"
    key, place, interval = f"audit.{claim.id}", place_of(claim.workbook), claim.interval()
    for column, end in (("H", interval.lower), ("I", interval.upper)):
        if end is not None:
            cells[column] = recorded(float(end), number_format=shown, claim=claim.id)
    return cells | {
        "E": formula(
            f"{key}.computed", "='{}'!{}".format(*place), number_format=shown, unit=claim.unit,
            transcendental=True,  # it may hand on a value that is
        ),
        "F": formula(f"{key}.verdict", _inside(claim, row), "text"),
        "K": text(claim.workbook, "link", link=place),
    }  # fmt: skip


def _inside(claim: Claim, row: int) -> str:
    """Whether E lies between H and I, ends counted as they are closed or open."""
    interval = claim.interval()
    verdict = f'"{AS_PRINTED}"'
    if interval.is_point:
        # To nine digits: no program holds 2/3, and not all round it alike.
        near = f"ABS(E{row}-H{row})*1000000000<=ABS(H{row})"
        verdict = f'IF({near},{verdict},"{OTHERWISE}")'
    else:
        if interval.upper is not None:
            sign = "<=" if interval.upper_closed else "<"
            verdict = f'IF(E{row}{sign}I{row},{verdict},"{OTHERWISE}")'
        if interval.lower is not None:
            sign = ">=" if interval.lower_closed else ">"
            verdict = f'IF(E{row}{sign}H{row},{verdict},"{OTHERWISE}")'
    return f'=IF(ISNUMBER(E{row}),{verdict},"{NOT_COMPUTED}")'

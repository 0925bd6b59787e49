"""The sheet `Overview`: the results, what can be trusted, what the audit found, where things are."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from textwrap import wrap

from reference.ledger import Ledger
from reference.units import written
from spreadsheets.plan import Cell, Place, Rule, SheetPlan, place_of
from spreadsheets.sheets.audit import AS_PRINTED, OTHERWISE, Findings
from spreadsheets.sheets.lines import HOME, NOT_COMPUTED, printed
from spreadsheets.sheets.steps import SCHEMES, CaseSheet

__all__ = ["sheet"]

_HOW = (
    ("input", "Blue on yellow: an input. Change it on the sheet Inputs, and every sheet follows."),
    ("inferred", "Blue on orange: an input that the report never prints, inferred from others."),
    ("number", "Black: a formula, stored with the value that coldspray computed for it."),
    ("printed", "Gray: what the report prints, or what was computed once. It follows no change."),
)
_WIDTH = 128
"""Characters of a line of running text."""


@dataclass
class _Page:
    """The cells so far, and the row where the next go."""

    cells: dict[str, Cell]
    row: int = 1

    def put(self, **cells: Cell) -> None:
        """One row, by column."""
        self.cells |= {f"{column}{self.row}": cell for column, cell in cells.items()}
        self.row += 1

    def say(self, text: str, style: str = "body", width: int = _WIDTH, column: str = "A") -> None:
        """Running text, broken into lines."""
        for line in wrap(text, width):
            self.put(**{column: Cell(text=line, style=style)})

    def block(self, *heads: str) -> None:
        """The heads of a table, after a blank row."""
        self.row += 1
        styles = ("head", "head right", "head right", "head right", "head right", "head unit")
        self.put(
            **{
                column: Cell(text=text, style=style)
                for column, text, style in zip("ABCDEF", heads, styles, strict=False)
            }
        )


def sheet(
    ledger: Ledger,
    cases: Sequence[CaseSheet],
    sheets: Mapping[str, str],
    version: str,
    findings: Findings | None,
) -> SheetPlan:
    """The first sheet; `sheets` says what each of the others shows."""
    report, scheme = ledger.report, cases[0].scheme
    page = _Page({})
    page.put(A=Cell(text=f"{report.title}: the model as a workbook", style="title"))
    page.say(
        f"After the report by {report.author} ({report.year}). Written by coldspray {version}; "
        f"{scheme} scheme: {SCHEMES[scheme]}."
    )
    if findings is not None:
        page.say(findings.headline, "headline", 112)
    rules = _results(page, ledger, cases)
    if findings is not None:
        _audit(page, ledger, findings)
    page.block("Sheets", *[""] * 5)
    for name, what in sheets.items():
        page.put(A=Cell(text=name, style="link", link=(name, "A1")), B=Cell(text=what))
    page.block("How to read it", *[""] * 5)
    for style, what in _HOW:
        page.put(A=Cell(text="1.23", style=f"{style} sample"), B=Cell(text=what, style="text"))
    widths = dict(zip("ABCDEF", (34.0, 17.0, 17.0, 17.0, 17.0, 46.0), strict=True))
    return SheetPlan(
        name=HOME,
        cells=page.cells,
        widths=widths,
        rules=rules,
        print_area=f"A1:F{page.row - 1}",
    )


def _results(page: _Page, ledger: Ledger, cases: Sequence[CaseSheet]) -> tuple[Rule, ...]:
    """Final depths with the state of each run, and the inputs in use."""
    page.block(
        "Results with the inputs in use", "Final depth [µm]", "The report prints",
        "Depth over radius", "The report prints", "State of the run",
    )  # fmt: skip
    rules: list[Rule] = []
    for case in cases:
        part = f"overview.{case.slug}"
        cells = {
            "A": Cell(text=case.name, style="link", link=(case.name, "A1")),
            "F": Cell(
                key=f"{part}.message", formula=f"={case.result('message')}", style="message"
            ),
        }
        for column, what, unit, claim in (
            ("B", "depth_um", "um", case.depth_claim),
            ("D", "normalized_depth", "1", case.ratio_claim),
        ):
            cells[column] = Cell(
                key=f"{part}.{what}",
                formula=f"={case.result(what)}",
                style="result",
                number_format="0.0000",
                unit=unit,
                column=f"{case.part}.depth_um" if unit == "um" else "",
            )
            if claim:
                cells["C" if column == "B" else "E"] = printed(ledger, claim, unit)
        rules += case.rules(f"F{page.row}")
        page.put(**cells)
    for text, name in (
        ("Inputs that are not the report’s", "inputs_changed"),
        ("Inputs that cannot be used", "inputs_unusable"),
    ):
        rules.append(Rule(cells=f"B{page.row}", formula=f"={name}>0", style="warning"))
        page.put(
            A=Cell(text=text, style="link", link=("Inputs", "A1")),
            B=Cell(key=f"overview.{name}", formula=f"={name}", style="result"),
        )
    return tuple(rules)


def _audit(page: _Page, ledger: Ledger, findings: Findings) -> None:
    """What fails, and how many numbers have which verdict."""
    page.block(
        "What does not follow", "The report prints", "Computed", "", "", "Why"
    )  # fmt: skip
    for failing in findings.failing:
        claim = ledger.claims[failing.claim]
        cells = {"A": Cell(text=claim.title), "B": printed(ledger, claim.id, claim.unit)}
        if claim.entry.workbook:
            cells["C"] = _reference(f"overview.{claim.id}", place_of(claim.entry.workbook))
            cells["D"] = Cell(text=written(claim.unit), style="unit")
        lines = wrap(failing.why, 82)
        page.put(**cells, E=Cell(text=lines[0]))
        for line in lines[1:]:
            page.put(E=Cell(text=line))
    page.block("Verdicts of the audit", "Numbers", "", "Live verdicts", "Cells", "")
    live = ((AS_PRINTED, "as_printed"), (OTHERWISE, "otherwise"), (NOT_COMPUTED, "none"))
    for at, (verdict, count) in enumerate(findings.counts.items()):
        cells = {
            "A": Cell(text=verdict, style="link", link=("Audit", "A1")),
            "B": Cell(number=float(count), style="recorded"),
        }
        if at < len(live):
            text, what = live[at]
            cells["D"] = Cell(text=text, style="printed")
            cells["E"] = Cell(
                key=f"overview.audit_{what}", formula=f"=audit_{what}", style="result"
            )
        page.put(**cells)
    page.say(
        "Verdicts of the audit are about the report. Live verdicts tell which computed cells print "
        "as the report does with the inputs in use.",
        "note",
    )


def _reference(key: str, place: Place) -> Cell:
    """A cell that shows another."""
    return Cell(
        key=key,
        formula="='{}'!{}".format(*place),
        style="result",
        number_format="0.0000",
        transcendental=True,
    )

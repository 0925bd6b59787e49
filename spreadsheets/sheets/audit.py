"""The sheet `Audit`: every claim of the ledger, with a live verdict where a cell computes it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reference.ledger import Claim, Ledger
from reference.units import written
from spreadsheets.plan import Cell, Rule, SheetPlan, place_of
from spreadsheets.sheets.lines import NOT_COMPUTED, column_heads, notes, printed, title

__all__ = ["AS_PRINTED", "OTHERWISE", "Failing", "Findings", "computed_claims", "sheet"]

AS_PRINTED, OTHERWISE = "as printed", "not as printed"


@dataclass(frozen=True, slots=True)
class Failing:
    """A claim that does not follow from what the report says, and why in one sentence."""

    claim: str
    why: str


@dataclass(frozen=True, slots=True)
class Findings:
    """What a finished audit tells the workbook; texts and numbers only.

    counts: verdict -> how many numbers have it. verdicts, explanations: by claim.
    """

    headline: str
    counts: Mapping[str, int]
    verdicts: Mapping[str, str]
    explanations: Mapping[str, str]
    failing: Sequence[Failing]


_HEADS = (
    ("Claim", "head"),
    ("What", "head"),
    ("Printed", "head right"),
    ("Unit", "head unit"),
    ("Computed", "head right"),
    ("Live verdict", "head unit"),
    ("The audit’s verdict", "head unit"),
    ("From", "head right"),
    ("To", "head right"),
    ("Where", "head unit"),
    ("Computed in", "head unit"),
    ("Explanation", "head unit"),
)
_COLUMNS = "ABCDEFGHIJKL"
_WIDTHS = (25.0, 33.0, 15.0, 8.0, 12.0, 15.0, 20.0, 12.0, 12.0, 16.0, 20.0, 60.0)
_HEAD_ROW = 11


def computed_claims(ledger: Ledger) -> list[Claim]:
    """The claims that a cell of the workbook computes."""
    return [claim for claim in ledger.claims.values() if claim.entry.workbook]


def sheet(ledger: Ledger, findings: Findings) -> SheetPlan:
    """The sheet. Each claim's entry in the ledger names the cell that computes it."""
    first = _HEAD_ROW + 1
    last = _HEAD_ROW + len(ledger.claims)
    cells = title("Audit: every number that the report prints") | notes(
        3,
        "Live verdict: whether the computed cell, with the inputs in use, prints as the report "
        "does; From and To are the values that print so. The audit’s verdict is about the report: "
        "it does not follow the inputs, and its proof is printed by coldspray claims ID.",
        width=118,
    )
    cells |= _counts(first, last)
    cells |= column_heads(_HEAD_ROW, _COLUMNS, _HEADS)
    for row, claim in enumerate(ledger.claims.values(), start=first):
        here = _claim(ledger, claim, findings, row)
        if claim.entry.workbook:
            here |= _live(claim, row)
        cells |= {f"{column}{row}": cell for column, cell in here.items()}
    live = f"F{first}:F{last}"
    return SheetPlan(
        name="Audit",
        cells=cells,
        widths=dict(zip(_COLUMNS, _WIDTHS, strict=True)),
        frozen=f"B{first}",
        repeated_rows=(_HEAD_ROW, _HEAD_ROW),
        print_area=f"A1:I{last}",
        filtered=f"A{_HEAD_ROW}:L{last}",
        rules=tuple(
            Rule(cells=live, formula=f'=$F{first}="{text}"', style=style)
            for text, style in (
                (AS_PRINTED, "good"),
                (OTHERWISE, "warning"),
                (NOT_COMPUTED, "changed"),
            )
        ),
    )


def _counts(first: int, last: int) -> dict[str, Cell]:
    """How many live verdicts there are of each kind."""
    cells = {"A6": Cell(text="Live verdicts", style="block")}
    kinds = ((AS_PRINTED, "as_printed"), (OTHERWISE, "otherwise"), (NOT_COMPUTED, "none"))
    for row, (text, what) in enumerate(kinds, start=7):
        cells[f"A{row}"] = Cell(text=text, style="text")
        cells[f"B{row}"] = Cell(
            key=f"audit.{what}",
            formula=f'=COUNTIF(F{first}:F{last},"{text}")',
            style="message",
            name=f"audit_{what}",
        )
    return cells


def _claim(ledger: Ledger, claim: Claim, findings: Findings, row: int) -> dict[str, Cell]:
    """What the ledger and the audit say of a claim, by column."""
    cells = {
        "A": Cell(text=claim.id, wrap=True),
        "B": Cell(text=claim.title, wrap=True),
        "C": printed(ledger, claim.id, claim.unit),
        "D": Cell(text=written(claim.unit) or "–", style="unit"),
        "G": Cell(text=findings.verdicts[claim.id], style="text", wrap=True),
        "J": Cell(text=str(claim.place), style="unit", wrap=True),
        "L": Cell(text=findings.explanations[claim.id], style="unit"),
    }
    cells["C"] = Cell(text=cells["C"].text, style="printed", claim=claim.id, wrap=True)
    if not claim.entry.workbook:
        cells["F"] = Cell(text="–", style="text")
    return cells


def _live(claim: Claim, row: int) -> dict[str, Cell]:
    """The computed value, the ends of what prints like the text, and the verdict, by column."""
    assert claim.entry.workbook
    place, interval = place_of(claim.entry.workbook), claim.interval()
    key, shown = f"audit.{claim.id}", "0.0000E+00" if claim.place.cell else "0.00##"
    cells = {
        column: Cell(number=float(end), style="recorded", number_format=shown, claim=claim.id)
        for column, end in (("H", interval.lower), ("I", interval.upper))
        if end is not None
    }
    # It may hand on a value that is transcendental.
    cells["E"] = Cell(
        key=f"{key}.computed",
        formula="='{}'!{}".format(*place),
        style="number",
        number_format=shown,
        unit=claim.unit,
        transcendental=True,
    )
    cells["F"] = Cell(key=f"{key}.verdict", formula=_inside(claim, row), style="text")
    cells["K"] = Cell(text=claim.entry.workbook, style="link", link=place)
    return cells


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

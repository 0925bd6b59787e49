"""The sheet `Audit`: every claim of the ledger, with a live verdict if a cell computes it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reference.ledger import Claim, Ledger
from spreadsheets.plan import (
    NOT_COMPUTED,
    YES_OR_NO,
    Cell,
    CellPlace,
    Rule,
    SheetPlan,
    formula,
    printed,
    recorded,
    unit_text,
)

AS_PRINTED, OTHERWISE = "as printed", "not as printed"
LIVE_VERDICTS = {
    AS_PRINTED: "audit_as_printed",
    OTHERWISE: "audit_otherwise",
    NOT_COMPUTED: "audit_none",
}
"""Each live verdict, and the name of the cell that counts it."""


@dataclass(frozen=True, slots=True)
class AuditResult:
    """What the workbook shows of a finished audit, as texts and numbers.

    counts: number of entries by verdict. verdicts, explanations: by claim. failing: claims that do
    not follow from what the report says. differing: claims that public sources contradict.
    """

    headline: str
    counts: Mapping[str, int]
    verdicts: Mapping[str, str]
    explanations: Mapping[str, str]
    failing: Sequence[str]
    differing: Sequence[str]


_HEAD_ROW = 11
_HEADS = (
    ("Claim", 25), ("What", 54), ("Printed", 23), ("Unit", 7), ("Computed", 12),
    ("Live verdict", 13.5), ("The audit’s verdict", 24), ("From", 11), ("To", 11),
    ("Number", 13), ("Above From", 12), ("Below To", 12), ("Prints so?", 15), ("Where", 34),
    ("Computed in", 20), ("Explanation", 60),
)  # fmt: skip


def row_of(ledger: Ledger, claim: str) -> int:
    """Return the row in which the sheet lists a claim."""
    return _HEAD_ROW + 1 + list(ledger.claims).index(claim)


def verdict_colors(cells: str) -> list[Rule]:
    """Return the rules that color the live verdicts in these cells of one column."""
    first = cells.partition(":")[0]
    styles = {AS_PRINTED: "good", OTHERWISE: "warning", NOT_COMPUTED: "changed"}
    return [Rule(cells, f'=${first}="{words}"', style) for words, style in styles.items()]


def audit_sheet(
    ledger: Ledger, audited: AuditResult, computed_in: Mapping[str, CellPlace]
) -> SheetPlan:
    """Plan the sheet of all claims; `computed_in` is the cell that computes a claim, by its id."""
    about = "Every printed number: what prints like it, computed value, verdict, its cell"
    sheet = SheetPlan(ledger=ledger, name="Audit", about=about)
    last = _HEAD_ROW + len(ledger.claims)
    verdicts = f"F{_HEAD_ROW + 1}:F{last}"
    sheet.begin("Audit: every number that the report prints")
    sheet.say(
        "Live verdict: whether the computed cell, with the inputs in use, rounds to what the report"
        " prints, or keeps to its bound; From and To are the values that do. The audit’s verdict is"
        " about the report: it does not follow the inputs, and its proof is printed by coldspray"
        " claims ID.",
        width=150,
    )
    sheet.print_area, sheet.portrait, sheet.most_pages = f"A1:G{last}", True, 3
    sheet.row_height = 12
    sheet.filtered = f"A{_HEAD_ROW}:P{last}"
    sheet.row = 6
    sheet.block("Live verdicts")
    for verdict, name in LIVE_VERDICTS.items():
        count = formula(name, f'=COUNTIF({verdicts},"{verdict}")', "message", named=True)
        sheet.put(A=Cell(verdict, "text"), B=count)
    sheet.row = _HEAD_ROW
    sheet.table(_HEADS, right="CEHIJKL", scrolling="B")
    for claim in ledger.claims.values():
        cells = _claim_row(ledger, claim, audited)
        if claim.id in computed_in:
            cells |= _live(claim, computed_in[claim.id], sheet.row)
        sheet.put(**cells)
    sheet.rules = verdict_colors(verdicts)
    return sheet


def _claim_row(ledger: Ledger, claim: Claim, audited: AuditResult) -> dict[str, Cell]:
    """Return a claim's row without what is live."""
    return {
        "A": Cell(claim.id),
        "B": Cell(claim.title, "text", wrap=True),
        "C": printed(ledger, claim.id, claim.unit, wrap=True),
        "D": unit_text(claim.unit),
        "F": Cell("–", "text"),
        "G": Cell(audited.verdicts[claim.id], "text", wrap=True),
        "N": Cell(str(claim.place), "unit"),
        "P": Cell(audited.explanations[claim.id], "unit"),
    }


def _live(claim: Claim, place: CellPlace, row: int) -> dict[str, Cell]:
    """Return the value of the cell that computes a claim, the printed interval and the verdict."""
    # Fixed decimals for most numbers, powers of ten for those that would be long.
    size = 0 if claim.printed is None else abs(claim.printed.value)
    shown = "0.0000E+00" if claim.place.cell or size >= 10**5 else "0.0000"
    key, interval, (sheet, address) = f"audit.{claim.id}", claim.interval(), place
    ends = {
        column: recorded(float(end), shown=shown, claim=claim.id)
        for column, end in (("H", interval.lower), ("I", interval.upper))
        if end is not None
    }
    computed = f"='{sheet}'!{address}"
    return {
        "E": formula(f"{key}.computed", computed, shown=shown, unit=claim.unit),
        "F": formula(f"{key}.verdict", f'=IFERROR(M{row},"{NOT_COMPUTED}")', "text"),
        **_conditions(claim, row, shown),
        "O": Cell(f"{sheet}!{address}", "link", link=place),
        **ends,
    }


def _conditions(claim: Claim, row: int, shown: str) -> dict[str, Cell]:
    """Return the cells that compare E with H and I, which are open or closed ends.

    A blank cell of Table A-1 is no number, but it would be greater than any, so J is #N/A for it.
    """
    interval, key = claim.interval(), f"audit.{claim.id}"
    above = below = ""
    if interval.is_point:
        # Not to the last digit, since no double is 2/3 and programs round it differently.
        above = f"ABS(J{row}-H{row})<=same_within*ABS(H{row})"
    else:
        if interval.lower is not None:
            above = f"J{row}{'>=' if interval.lower_closed else '>'}H{row}"
        if interval.upper is not None:
            below = f"J{row}{'<=' if interval.upper_closed else '<'}I{row}"
    cells = {"J": formula(f"{key}.number", f"=IF(ISNUMBER(E{row}),E{row},NA())", shown=shown)}
    if above:
        cells["K"] = formula(f"{key}.above", f"=IF({above},1,0)", shown=YES_OR_NO)
    if below:
        cells["L"] = formula(f"{key}.below", f"=IF({below},1,0)", shown=YES_OR_NO)
    # The smaller of both is 1 if both hold: with AND, what says the verdict would test two things.
    inside = f"MIN(K{row},L{row})" if above and below else f"K{row}" if above else f"L{row}"
    verdict = f'=IF({inside}=1,"{AS_PRINTED}","{OTHERWISE}")'
    return cells | {"M": formula(f"{key}.prints_so", verdict, "text")}

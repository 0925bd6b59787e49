"""The sheet `Audit`: every claim of the ledger, with a live verdict where a cell computes it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reference.ledger import Claim, Ledger
from spreadsheets.plan import (
    NOT_COMPUTED,
    Cell,
    SheetPlan,
    formula,
    place_of,
    printed,
    recorded,
    text,
    unit_text,
)

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


_COLUMNS = (
    ("Claim", 24.0), ("What", 50.0), ("Printed", 15.0), ("Unit", 8.0), ("Computed", 13.0),
    ("Live verdict", 14.0), ("The audit’s verdict", 25.0), ("From", 11.0), ("To", 11.0),
    ("Where", 34.0), ("Computed in", 20.0), ("Explanation", 60.0),
)  # fmt: skip
_HEAD_ROW = 11


def computed_claims(ledger: Ledger) -> list[Claim]:
    """The claims that a cell of the workbook computes."""
    return [claim for claim in ledger.claims.values() if claim.workbook]


def sheet(ledger: Ledger, findings: Findings) -> SheetPlan:
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
    page.table(_COLUMNS, "CEHI", "B")
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

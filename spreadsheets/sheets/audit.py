"""The sheet `Audit`: every claim of the ledger; those that a cell computes with a live verdict."""

from collections.abc import Mapping

from reference.ledger import Claim, load
from spreadsheets.plan import Cell, Place, Rule, SheetPlan
from spreadsheets.sheets.audit_cells import CELLS, SCALES

__all__ = ["FAILED", "REPRODUCED", "UNITS", "sheet"]

REPRODUCED = "reproduced"
FAILED = "not as printed"

_NOTES = (
    "Each number that the report prints, in its order. Computed refers to the cell that the link "
    "on the right leads to; the verdict compares it with the values that print like the text.",
    "The verdict is about the inputs as they stand. Whether other inputs that print like the "
    "report’s would do, and the proof, is in audit.json, which coldspray audit writes.",
)
_HEAD = 5
_HEADS = (
    ("Claim", "head"),
    ("Where", "head"),
    ("What", "head"),
    ("Printed", "head right"),
    ("Unit", "head unit"),
    ("From", "head right"),
    ("To", "head right"),
    ("Computed", "head right"),
    ("Verdict", "head unit"),
    ("Computed in", "head unit"),
)
_WIDTHS = (26.0, 28.0, 52.0, 28.0, 9.0, 13.0, 13.0, 14.0, 16.0, 26.0)
UNITS = {
    "um": "µm",
    "um^3": "µm³",
    "kg/m^3": "kg/m³",
    "m/s^2": "m/s²",
    "gram_force": "gf",
    "us": "µs",
    "1": "–",
}


def sheet(where: Mapping[str, Place]) -> SheetPlan:
    """The sheet; `where` tells the place of a key on the other sheets."""
    claims = load().claims
    live = [claim for name, claim in claims.items() if name in CELLS]
    rest = [claim for name, claim in claims.items() if name not in CELLS]
    cells = {"A1": Cell(text="Audit: every number that the report prints", style="title")}
    for row, note in enumerate(_NOTES, start=2):
        cells[f"A{row}"] = Cell(text=note, style="note")
    for column, (text, style) in zip("ABCDEFGHIJ", _HEADS, strict=True):
        cells[f"{column}{_HEAD}"] = Cell(text=text, style=style)
    for row, claim in enumerate(live, start=_HEAD + 1):
        cells |= _what(claim, row, "body") | _verdict(claim, row, where[CELLS[claim.id]])
    last = _HEAD + len(live)
    cells[f"A{last + 2}"] = Cell(text="Claims that no cell computes, and why", style="block")
    for row, claim in enumerate(rest, start=last + 3):
        cells |= _what(claim, row, "printed label")
        cells[f"F{row}"] = Cell(text=_reason(claim), style="printed label")
    return SheetPlan(
        name="Audit",
        cells=cells,
        widths=dict(zip("ABCDEFGHIJ", _WIDTHS, strict=True)),
        frozen=f"B{_HEAD + 1}",
        repeated_rows=(_HEAD, _HEAD),
        rules=tuple(
            Rule(
                cells=f"I{_HEAD + 1}:I{last}",
                formula=f'=$I{_HEAD + 1}{sign}"{REPRODUCED}"',
                style=style,
            )
            for sign, style in (("=", "good"), ("<>", "warning"))
        ),
    )


def _what(claim: Claim, row: int, style: str) -> dict[str, Cell]:
    texts = (
        ("A", claim.id, style),
        ("B", str(claim.place), style),
        ("C", claim.title, style),
        ("D", claim.text, "printed"),
        ("E", UNITS.get(claim.unit, claim.unit), "unit"),
    )
    return {f"{column}{row}": Cell(text=text, style=how) for column, text, how in texts if text}


def _verdict(claim: Claim, row: int, place: Place) -> dict[str, Cell]:
    key, there = f"audit.{claim.id}", "'{}'!{}".format(*place)
    assert claim.interval is not None
    shown = "0.0000E+00" if claim.place.cell else "0.0###"
    cells = {
        f"{column}{row}": Cell(key=f"{key}.{end}", style="printed", number_format=shown)
        for column, end in (("F", "lower"), ("G", "upper"))
        if getattr(claim.interval, end) is not None
    }
    scale = SCALES.get(claim.id, "")
    value = f"=IF(ISNUMBER({there}),{there}{scale},{there})" if scale else f"={there}"
    cells[f"H{row}"] = Cell(
        key=f"{key}.computed",
        formula=value,
        style="number",
        number_format=shown.replace("#", "0"),
        # It may refer to a value that is.
        transcendental=True,
    )
    cells[f"I{row}"] = Cell(key=f"{key}.verdict", formula=_inside(claim, row), style="text")
    cells[f"J{row}"] = Cell(text="{}!{}".format(*place), style="link", link=place)
    return cells


def _inside(claim: Claim, row: int) -> str:
    """Whether H lies between F and G, ends counted as they are closed or open."""
    interval = claim.interval
    assert interval is not None
    verdict = f'"{REPRODUCED}"'
    if interval.lower == interval.upper:
        # To nine digits: no program holds 2/3, and not all round it alike.
        near = f"ABS(H{row}-F{row})*1000000000<=ABS(F{row})"
        return f'=IF(ISNUMBER(H{row}),IF({near},{verdict},"{FAILED}"),"{FAILED}")'
    if interval.upper is not None:
        sign = "<=" if interval.upper_closed else "<"
        verdict = f'IF(H{row}{sign}G{row},{verdict},"{FAILED}")'
    if interval.lower is not None:
        sign = ">=" if interval.lower_closed else ">"
        verdict = f'IF(H{row}{sign}F{row},{verdict},"{FAILED}")'
    return f'=IF(ISNUMBER(H{row}),{verdict},"{FAILED}")'


def _reason(claim: Claim) -> str:
    """Why no cell computes a claim, in a few words."""
    if claim.kind == "blank":
        return "a blank cell: blank on the sheet Table A-1, too"
    if claim.computation is None:
        return f"not checkable: {claim.given}"
    if claim.computation.name == "same_as":
        (names,) = claim.inputs.values()
        return f"repeats {' × '.join(names)}"
    if claim.computation.name == "count":
        return "counts what the report lists"
    return f"decided outside the workbook: coldspray claims {claim.id}"

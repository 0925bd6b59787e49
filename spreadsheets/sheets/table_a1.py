"""The sheet `Table A-1`, which has the report's table in the same cells, A1:F12.

Each number format gives the text that the report prints; "6E-10" needs General. The printed texts
themselves stand from column H on. Below, each printed number stands beside the one computed.
"""

from collections.abc import Mapping

from reference.ledger import Claim, Ledger
from reference.scheme import Scheme
from spreadsheets.plan import HOME, Cell, SheetPlan, formula, printed, recorded, unit_text
from spreadsheets.sheets.audit import row_of, verdict_colors
from spreadsheets.sheets.case import (
    FIRST_ROW,
    ROW_COLUMNS,
    CaseSheet,
    if_in_use,
    step_formulas,
)

NAME = "Table A-1"

TABLE_ROWS = 5
"""Number of rows, including row 0, the impact itself."""

DECIMALS = 4
"""Decimals of a difference; rounding makes 0 of 3 times 0.2 ns minus 0.6 ns."""

NO_DIFFERENCE = "–"
"""Stands for a difference to a blank cell: the table has fewer rows."""

ABOVE = {
    "radius": "R =",
    "particle_density": "Density =",
    "mass": "M =",
    "diameter": "D =",
    "velocity": "Initial vel =",
    "resistance": "Rt =",
}
"""Label of each cell above the rows, by the end of its key."""

_FIRST = 8
_MIDDLE = "G"
"""The column of middle velocities, if there are any; below, that of all digits."""

_CHECK_HEADS = (
    "Cell", "Quantity", "", "Unit", "The report prints", "Last digit", "Computed", "Difference",
    "Live verdict",
)  # fmt: skip


def claims_in_table(ledger: Ledger) -> dict[str, Claim]:
    """Return the claims of Table A-1 by their address in the table."""
    return {claim.place.cell: claim for claim in ledger.claims.values() if claim.place.cell}


def table_a1(ledger: Ledger, case: CaseSheet, report: bool) -> SheetPlan:
    """Plan Table A-1 for a case; the report's own is for beta = 5.

    report: whether the printed texts stand beside it, in columns H to M, and the check below.
    """
    claims, centered = claims_in_table(ledger), case.scheme is Scheme.CENTERED
    about = "The first rows of the scheme, laid out as the report’s appendix prints them"
    about += "; each number checked" if report else ""
    sheet = SheetPlan(ledger=ledger, name=NAME, about=about, most_pages=1)
    sheet.wide("ABCDFHIJKLM", 13)
    sheet.wide("E", 17)
    sheet.wide(_MIDDLE, 25 if report else 13 if centered else 4)

    def live(address: str, key: str, expression: str) -> None:
        """Add a formula, with the unit and number format of the claim that is printed there."""
        claim = claims.get(address)
        shown = "0.00E+00" if claim is None or "." in claim.text else "General"
        unit = "m/s" if claim is None else claim.unit
        sheet.cells[address] = formula(f"table.{key}", expression, shown=shown, unit=unit)
        if claim:
            sheet.claims[claim.id] = address

    names = "R_p", "rho_p", "M_p", "D_p", "V_impact", case.resistance
    for row, ((key, label), name) in enumerate(zip(ABOVE.items(), names, strict=True), start=1):
        sheet.cells[f"A{row}"] = Cell(label)
        live(f"B{row}", key, f"={name}")
    for column, head in _heads(centered).items():
        style = "head right" if head else "head"
        sheet.cells[f"{column}{_FIRST - 1}"] = Cell(head, style)
    # A reference to a row that is not prepared would show 0.
    for step in range(min(TABLE_ROWS, case.rows + 1)):
        for column, expression in _row(case, step).items():
            key = {"A": "time", _MIDDLE: "velocity_middle"}.get(column) or ROW_COLUMNS[column].key
            live(f"{column}{_FIRST + step}", f"row.{key}[{step}]", expression)
    if report:
        sheet.cells |= _as_printed(ledger, claims)
    sheet.row = 14
    last = _MIDDLE if centered else "F"
    beside = " Columns H to M are the report’s text." if report else ""
    sheet.say(
        f"Table A-1, rigid body penetration. Columns A to {last} are live, with the inputs of"
        f" {case.name}.{beside}"
    )
    sheet.say(
        "M is Eq. 3 times the density, Rt is Eqs. 7 and A-2, d²x/dt² is Eqs. 13, A-1 and A-3."
    )
    sheet.put(A=Cell(f"Back to {HOME}", "link", link=(HOME, "A1")))
    if report:
        _check(sheet)
    return sheet


def _heads(centered: bool) -> dict[str, str]:
    heads = {"A": "Time", "B": "", **{letter: ROW_COLUMNS[letter].head for letter in "CDEF"}}
    return heads | ({_MIDDLE: ROW_COLUMNS["H"].head} if centered else {})


def _row(case: CaseSheet, step: int) -> dict[str, str]:
    """Return the formulas of a row by column; its first column is the time, not the row number.

    The time is that of the case's own sheet, which is blank below the stop.
    """
    row = _FIRST + step
    time = {"A": f"='{case.name}'!B{FIRST_ROW + step}"}
    if step == 0:
        values = {"C": "V_impact", "D": "0", "E": "0"}
        return time | {column: if_in_use(row, text) for column, text in values.items()}
    return time | step_formulas(case, row, step, middle=_MIDDLE)


def _as_printed(ledger: Ledger, claims: Mapping[str, Claim]) -> dict[str, Cell]:
    """Return the table as the report prints it, in columns H to M."""
    shifted = dict(zip("ABCDEF", "HIJKLM", strict=True))
    cells = {f"H{row}": Cell(label, "unit") for row, label in enumerate(ABOVE.values(), start=1)}
    for column, head in _heads(centered=False).items():
        if head:
            cells[f"{shifted[column]}{_FIRST - 1}"] = Cell(head, "unit right")
    for address, claim in claims.items():
        cells[f"{shifted[address[0]]}{address[1:]}"] = printed(ledger, claim.id, claim.unit)
    return cells


def _check(sheet: SheetPlan) -> None:
    """Add each number that the table prints beside the one computed."""
    sheet.row += 1
    sheet.block("Printed and computed")
    sheet.say(
        "Computed: the live cell above, with all its digits. Difference: computed minus printed, in"
        " units of the last printed digit. Live verdict: as on the sheet Audit."
    )
    sheet.row += 1
    sheet.heads("ABCDEFGHI", _CHECK_HEADS, right="EFGH")
    first = sheet.row
    for address, claim in claims_in_table(sheet.ledger).items():
        number = claim.number
        row, key = sheet.row, f"table_check.{address}"
        difference = f"ROUND((G{row}-E{row})/F{row},{DECIMALS})"
        if claim.is_exact:
            difference = f"G{row}-E{row}"
        difference = f'=IF(ISNUMBER(G{row}),{difference},"{NO_DIFFERENCE}")'
        sheet.put(
            A=Cell(address, "link", link=(NAME, address)),
            B=Cell(claim.title, "text"),
            D=unit_text(claim.unit),
            E=recorded(float(number.value), claim=claim.id, shown=sheet.cells[address].shown),
            F=recorded(float(number.quantum), shown="0E+00"),
            G=formula(
                f"{key}.computed", f"={address}", shown="0.0000000000000000E+00", unit=claim.unit
            ),
            H=formula(f"{key}.difference", difference, "result", shown="0.0000"),
            I=formula(f"{key}.verdict", f"='Audit'!F{row_of(sheet.ledger, claim.id)}", "text"),
        )  # fmt: skip
    sheet.rules = verdict_colors(f"I{first}:I{sheet.row - 1}")

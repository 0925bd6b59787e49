"""The sheet `Table A-1 check`: each number that Table A-1 prints beside the one computed."""

from reference.ledger import Ledger
from spreadsheets.plan import Cell, SheetPlan, formula, recorded, unit_text
from spreadsheets.sheets.audit import row_of, verdict_colors
from spreadsheets.sheets.table_a1 import claims_in_table

DECIMALS = 4
"""Decimals of a difference; rounding makes 0 of 3 times 0.2 ns minus 0.6 ns."""

NO_DIFFERENCE = "–"
"""Stands for a difference to a blank cell: the table has fewer rows."""

_HEADS = (
    ("Cell", 8), ("Quantity", 26), ("Unit", 9), ("The report prints", 17), ("Computed", 25),
    ("Difference", 12), ("Live verdict", 18), ("Last printed digit", 17),
)  # fmt: skip


def table_a1_check(ledger: Ledger, table: SheetPlan) -> SheetPlan:
    """Plan the comparison of each number that Table A-1 prints with the one computed."""
    about = "Printed, computed in full, and the difference in the last digit"
    sheet = SheetPlan(ledger=ledger, name="Table A-1 check", about=about)
    sheet.begin("Table A-1: printed and computed")
    sheet.say(
        "Computed: the live cell of the sheet Table A-1, with all its digits. Difference: computed"
        " minus printed, in units of the last printed digit. Live verdict: as on the sheet Audit."
    )
    sheet.row = 6
    sheet.table(_HEADS, right="DEFH", scrolling="B")
    first = sheet.row
    for address, claim in claims_in_table(ledger).items():
        number = claim.number
        row, key = sheet.row, f"table_check.{address}"
        difference = f"ROUND((E{row}-D{row})/H{row},{DECIMALS})"
        if claim.is_exact:
            difference = f"E{row}-D{row}"
        difference = f'=IF(ISNUMBER(E{row}),{difference},"{NO_DIFFERENCE}")'
        shown = table.cells[address].shown
        sheet.put(
            A=Cell(address, "link", link=(table.name, address)),
            B=Cell(claim.title),
            C=unit_text(claim.unit),
            D=recorded(float(number.value), claim=claim.id, shown=shown),
            E=formula(
                f"{key}.computed", f"='{table.name}'!{address}",
                shown="0.0000000000000000E+00", unit=claim.unit,
            ),
            F=formula(f"{key}.difference", difference, "result", shown="0.0000"),
            G=formula(f"{key}.verdict", f"='Audit'!F{row_of(ledger, claim.id)}", "text"),
            H=recorded(float(number.quantum), shown="0E+00"),
        )  # fmt: skip
    sheet.rules = verdict_colors(f"G{first}:G{sheet.row - 1}")
    return sheet

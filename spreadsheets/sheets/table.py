"""What the sheets that are one table of quantities have in common."""

from reference.ledger import Ledger
from spreadsheets.plan import LINE_HEADS, SheetPlan


def table_of_lines(
    ledger: Ledger, *, name: str, about: str, title: str, note: str = ""
) -> SheetPlan:
    """Begin a sheet that is a table with one quantity in each line: title, note and heads."""
    sheet = SheetPlan(ledger=ledger, name=name, about=about)
    sheet.widths = dict(zip(sheet.columns, (width for _, width in LINE_HEADS), strict=True))
    sheet.portrait, sheet.most_pages = True, 1
    sheet.begin(title)
    sheet.say(note)
    sheet.row += 1
    sheet.headed = "A", sheet.row, sheet.row
    sheet.line_heads()
    return sheet

"""The sheet `Table A-1 check`: each printed number of the table beside the computed one."""

from collections.abc import Iterator

from spreadsheets.plan import Cell, Place, SheetPlan
from spreadsheets.sheets.table_a1 import PRINTED

__all__ = ["DIGITS", "compared_cells", "sheet"]

DIGITS = 4
"""Decimals kept of a difference, so that 0 is 0: 3 times 0.2 ns is not 0.6 ns to the last bit."""

_FIRST = 6
_FULL = "0.0000000000000000E+00"
_NOTE = (
    "Computed: the live cell of the sheet Table A-1 with all its digits. The difference is "
    "computed minus printed, in units of the last printed digit: up to 0.5 prints the same."
)
_HEADS = (
    ("Cell", "head"),
    ("Quantity", "head"),
    ("Unit", "head"),
    ("The report prints", "head right"),
    ("Computed", "head right"),
    ("Last printed digit", "head right"),
    ("Difference in it", "head right"),
)
_HEADER = ("R", "ρ_p", "M", "D", "V", "R_t")
_UNITS = ("m", "kg/m³", "kg", "m", "m/s", "Pa")
_COLUMNS = {
    "A": ("time", "s"),
    "C": ("dx/dt initial", "m/s"),
    "D": ("x", "m"),
    "E": ("d²x/dt²", "m/s²"),
    "F": ("dx/dt final", "m/s"),
}


def compared_cells() -> Iterator[tuple[str, str, str, str]]:
    """Address, quantity, unit and printed text of every number in Table A-1.

    >>> list(compared_cells())[-1]
    ('F12', 'dx/dt final, row 4', 'm/s', '4.99E+02')
    """
    for row, (quantity, unit) in enumerate(zip(_HEADER, _UNITS, strict=True), start=1):
        yield f"B{row}", quantity, unit, PRINTED[row - 1][1]
    for row in range(len(_HEADER) + 2, len(PRINTED) + 1):
        for column, (quantity, unit) in _COLUMNS.items():
            if text := PRINTED[row - 1]["ABCDEF".index(column)]:
                yield f"{column}{row}", f"{quantity}, row {row - len(_HEADER) - 2}", unit, text


def sheet(table: SheetPlan) -> SheetPlan:
    """The sheet, for the sheet `Table A-1`."""
    cells = {
        "A1": Cell(text="Table A-1: printed and computed", style="title"),
        "A2": Cell(text=_NOTE, style="note"),
    }
    for column, (head, style) in zip("ABCDEFG", _HEADS, strict=True):
        cells[f"{column}{_FIRST - 2}"] = Cell(text=head, style=style)
    for row, entry in enumerate(compared_cells(), start=_FIRST - 1):
        cells |= _line(row, entry, (table.name, entry[0]), table.cells[entry[0]].number_format)
    widths = dict(zip("ABCDEFG", (8.0, 24.0, 9.0, 19.0, 27.0, 19.0, 18.0), strict=True))
    return SheetPlan(name="Table A-1 check", cells=cells, widths=widths, frozen=f"A{_FIRST - 1}")


def _line(
    row: int, entry: tuple[str, str, str, str], place: Place, number_format: str
) -> dict[str, Cell]:
    address, quantity, unit, _ = entry
    key, live = f"table_check.{address}", f"'{place[0]}'!{address}"
    difference = f"ROUND(({live}-D{row})/F{row},{DIGITS})"
    return {
        f"A{row}": Cell(text=address, style="link", link=place),
        f"B{row}": Cell(text=quantity, style="body"),
        f"C{row}": Cell(text=unit, style="unit"),
        f"D{row}": Cell(key=f"{key}.printed", style="printed", number_format=number_format),
        f"E{row}": Cell(
            key=f"{key}.computed", formula=f"={live}", style="number", number_format=_FULL
        ),
        f"F{row}": Cell(key=f"{key}.last_digit", style="printed", number_format="0E+00"),
        f"G{row}": Cell(
            key=f"{key}.difference",
            formula=f'=IF(ISNUMBER({live}),{difference},"–")',
            style="result",
            number_format="0.0000",
            # Rounding is done by each program in its own way: it may cost a last digit.
            transcendental=True,
        ),
    }

"""The sheets `Table A-1` and `Table A-1 check`: the report's table, as formulas and as printed.

`Table A-1` has it cell for cell in A1:F12; every number format gives the text that the report
prints, `6E-10` in General included. From column H on stands the printed text itself.
"""

from reference.ledger import Claim, Ledger
from spreadsheets.plan import Cell, SheetPlan
from spreadsheets.sheets.lines import (
    NOT_COMPUTED,
    colored,
    formula,
    heads,
    notes,
    printed,
    row_of,
    text,
    title,
    unit_text,
)
from spreadsheets.sheets.steps import FIRST_ROW, CaseSheet, step_formulas

ROWS = 5
"""Rows of the table, row 0 (the impact itself) included."""

_FIRST = 8
_LABELS = ("R =", "Density =", "M =", "D =", "Initial vel =", "Rt =")
_HEADS = ("Time", "", "dx/dt initial", "x", "d²x/dt²", "dx/dt final", "dx/dt middle")
_HEADER = {
    "B1": ("radius", "R_p"),
    "B2": ("particle_density", "rho_p"),
    "B3": ("mass", "M_p"),
    "B4": ("diameter", "D_p"),
    "B5": ("velocity", "V_impact"),
    "B6": ("resistance", "R_t"),
}
_COLUMNS = {
    "A": "time",
    "C": "velocity_initial",
    "D": "depth",
    "E": "deceleration",
    "F": "velocity_final",
    "G": "velocity_middle",
}


_SCIENTIFIC = "0.00E+00"


def _claims(ledger: Ledger) -> dict[str, Claim]:
    """Address in the table -> the claim that is printed there."""
    return {claim.place.cell: claim for claim in ledger.claims.values() if claim.place.cell}


def sheet(ledger: Ledger, case: CaseSheet, report: bool) -> SheetPlan:
    """The table for a case: the report's is the one of beta = 5.

    report: with the printed text beside it.
    """
    claims, resistance, centered = _claims(ledger), case.named("R_t"), case.scheme == "centered"

    def live(address: str, what: str, expression: str) -> Cell:
        """A cell in the unit of what is printed there, and as it is: "6E-10" or "2.00E-10"."""
        claim = claims.get(address)
        shown = _SCIENTIFIC if claim is None or "." in claim.text else "General"
        unit = "m/s" if claim is None else claim.unit
        return formula(f"table.{what}", expression, number_format=shown, unit=unit)

    cells = {f"A{row}": text(words) for row, words in enumerate(_LABELS, start=1)}
    for address, (what, symbol) in _HEADER.items():
        cells[address] = live(address, what, f"={resistance if symbol == 'R_t' else symbol}")
    for column, words in zip("ABCDEFG"[: 7 if centered else 6], _HEADS, strict=False):
        style = "head" if column in "AB" else "head right"
        cells[f"{column}{_FIRST - 1}"] = text(words, style)
    for step in range(ROWS):
        row = _FIRST + step
        if step:
            time = f"(ROW(A{row - 1})-ROW(A${_FIRST})+1)*{case.step_name}"
            middle = "G" if centered else ""
            formulas = step_formulas(row, step == 1, time, resistance, case.step_name, middle)
        else:
            starts = {"A": "0", "C": "V_impact", "D": "0", "E": "0"}
            ready = f"ISNUMBER('{case.name}'!A{FIRST_ROW})"
            formulas = {column: f'=IF({ready},{text},"")' for column, text in starts.items()}
        for column, expression in formulas.items():
            address = f"{column}{row}"
            cells[address] = live(address, f"row[{step}].{_COLUMNS[column]}", expression)
    if report:
        cells |= _beside(ledger, claims)
    cells |= notes(
        14,
        f"Table A-1, rigid body penetration. Columns A to {'G' if centered else 'F'} are live, "
        f"with the inputs of {case.name}."
        + (" Columns H to M are the report’s text." if report else ""),
        "M is Eq. 3 times the density, Rt is Eqs. 7 and A-2, d²x/dt² is Eqs. 13, A-1 and A-3.",
    )
    cells["A18"] = title("")["A2"]
    widths = dict.fromkeys("ABCDEFGHIJKLM", 13.0) | ({} if centered else {"G": 4.0})
    return SheetPlan(name="Table A-1", cells=cells, widths=widths)


def _beside(ledger: Ledger, claims: dict[str, Claim]) -> dict[str, Cell]:
    """The table as printed, in columns H to M."""
    shifted = dict(zip("ABCDEF", "HIJKLM", strict=True))
    cells = {f"H{row}": text(words, "unit") for row, words in enumerate(_LABELS, start=1)}
    for column, words in zip(shifted.values(), _HEADS, strict=False):
        if words:
            cells[f"{column}{_FIRST - 1}"] = text(words, "unit right")
    for address, claim in claims.items():
        cells[f"{shifted[address[0]]}{address[1:]}"] = printed(ledger, claim.id, claim.unit)
    return cells


# The check

DIGITS = 4
"""Decimals kept of a difference, so that 0 is 0: 3 times 0.2 ns is not 0.6 ns to the last bit."""

_HEAD_ROW = 6
_CHECK_HEADS = (
    "Cell", "Quantity", "Unit", "The report prints", "Computed", "Difference", "",
    "Last printed digit",
)  # fmt: skip
_FULL = "0.0000000000000000E+00"
SAME_TEXT, OTHER_TEXT = "prints the same", "prints otherwise"


def check_sheet(ledger: Ledger, table: SheetPlan) -> SheetPlan:
    """Each number of the table as printed and as computed, for the sheet `Table A-1`."""
    cells = title("Table A-1: printed and computed") | notes(
        3,
        "Computed: the live cell of the sheet Table A-1, with all its digits. Difference: computed "
        "minus printed, in units of the last printed digit; up to 0.5 it prints the same.",
    )
    cells |= heads(_HEAD_ROW, "ABCDEFGH", _CHECK_HEADS, "DEFH")
    first = _HEAD_ROW + 1
    for row, (address, claim) in enumerate(_claims(ledger).items(), start=first):
        cells |= row_of(row, _check(claim, address, row, table))
    widths = (8.0, 26.0, 9.0, 17.0, 25.0, 12.0, 18.0, 17.0)
    return SheetPlan(
        name="Table A-1 check",
        cells=cells,
        widths=dict(zip("ABCDEFGH", widths, strict=True)),
        frozen=f"B{first}",
        repeated_rows=(_HEAD_ROW, _HEAD_ROW),
        rules=colored(f"G{first}:G{row}", {SAME_TEXT: "good", OTHER_TEXT: "warning"}),
    )


def _check(claim: Claim, address: str, row: int, table: SheetPlan) -> dict[str, Cell]:
    assert claim.printed is not None
    key, there = f"table_check.{address}", f"'{table.name}'!{address}"
    difference = f"ROUND((E{row}-D{row})/H{row},{DIGITS})"
    verdict = f'IF(ABS(F{row})<=0.5,"{SAME_TEXT}","{OTHER_TEXT}")'
    if claim.is_exact:
        difference = f"E{row}-D{row}"
        verdict = f'IF(F{row}=0,"{SAME_TEXT}","{OTHER_TEXT}")'
    difference = f'=IF(ISNUMBER(E{row}),{difference},"–")'
    verdict = f'=IF(ISNUMBER(E{row}),{verdict},"{NOT_COMPUTED}")'
    shown = table.cells[address].number_format
    number = Cell(
        number=float(claim.printed.value), style="recorded", number_format=shown, claim=claim.id
    )
    digit = Cell(number=float(claim.printed.quantum), style="recorded", number_format="0E+00")
    return {
        "A": text(address, "link", link=(table.name, address)),
        "B": text(claim.title),
        "C": unit_text(claim.unit),
        "D": number,
        "E": formula(f"{key}.computed", f"={there}", number_format=_FULL, unit=claim.unit),
        # Rounding is done by each program in its own way: it may cost a last digit.
        "F": formula(
            f"{key}.difference", difference, "result", number_format="0.0000", transcendental=True
        ),
        "G": formula(f"{key}.verdict", verdict, "text"),
        "H": digit,
    }

"""The sheets `Table A-1` and `Table A-1 check`: the report's table, as formulas and as printed.

`Table A-1` has it cell for cell in A1:F12; every number format gives the text that the report
prints, `6E-10` in General included. From column H on stands the printed text itself.
"""

from reference.ledger import Claim, Ledger
from spreadsheets.plan import (
    HOME,
    NOT_COMPUTED,
    Cell,
    SheetPlan,
    formula,
    printed,
    recorded,
    text,
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

    columns = "ABCDEFG" if centered else "ABCDEF"
    widths = dict.fromkeys("ABCDEFGHIJKLM", 13.0) | ({} if centered else {"G": 4.0})
    page = SheetPlan(name="Table A-1", widths=widths)
    cells = page.cells
    for row, words in enumerate(_LABELS, start=1):
        cells[f"A{row}"] = text(words)
    for address, (what, symbol) in _HEADER.items():
        cells[address] = live(address, what, f"={resistance if symbol == 'R_t' else symbol}")
    for column, words in zip(columns, _HEADS, strict=False):
        cells[f"{column}{_FIRST - 1}"] = text(words, "head" if column in "AB" else "head right")
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
    page.row = 14
    page.say(
        f"Table A-1, rigid body penetration. Columns A to {columns[-1]} are live, "
        f"with the inputs of {case.name}."
        + (" Columns H to M are the report’s text." if report else ""),
        "M is Eq. 3 times the density, Rt is Eqs. 7 and A-2, d²x/dt² is Eqs. 13, A-1 and A-3.",
    )
    cells["A18"] = text(f"Back to {HOME}", "link", link=(HOME, "A1"))
    return page


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

_CHECK_COLUMNS = (
    ("Cell", 8.0), ("Quantity", 26.0), ("Unit", 9.0), ("The report prints", 17.0),
    ("Computed", 25.0), ("Difference", 12.0), ("", 18.0), ("Last printed digit", 17.0),
)  # fmt: skip
_FULL = "0.0000000000000000E+00"
SAME_TEXT, OTHER_TEXT = "prints the same", "prints otherwise"


def check_sheet(ledger: Ledger, table: SheetPlan) -> SheetPlan:
    """Each number of the table as printed and as computed, for the sheet `Table A-1`."""
    page = SheetPlan(name="Table A-1 check")
    page.title("Table A-1: printed and computed")
    page.say(
        "Computed: the live cell of the sheet Table A-1, with all its digits. Difference: computed "
        "minus printed, in units of the last printed digit; up to 0.5 it prints the same."
    )
    page.row = 6
    page.table(_CHECK_COLUMNS, "DEFH", "B")
    first = page.row
    for address, claim in _claims(ledger).items():
        page.put(**_check(claim, address, page.row, table))
    verdicts = f"G{first}:G{page.row - 1}"
    page.color(verdicts, {SAME_TEXT: "good", OTHER_TEXT: "warning"})
    return page


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
    number = recorded(float(claim.printed.value), number_format=shown, claim=claim.id)
    digit = recorded(float(claim.printed.quantum), number_format="0E+00")
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

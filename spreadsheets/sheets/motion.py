"""The formulas of one time step (appendix, Eqs. A-1 to A-3, both branches of Eq. 13).

Columns C to F hold dx/dt initial, x, d²x/dt² and dx/dt final, on the sheet that copies Table A-1
as on those that run to the stop. The order of the operations is fixed: it decides the last digit.
"""

from spreadsheets.plan import Cell

__all__ = ["guarded", "impact_index", "moves_on", "step_cells", "step_formulas"]


def guarded(row: int, expression: str) -> str:
    """A formula that is blank where column A, the row's number or time, is blank."""
    # A test for "" instead of a number fails in two spreadsheet programs.
    return f'=IF(ISNUMBER(A{row}),{expression},"")'


def impact_index() -> str:
    """Column A of row 0: blank, and with it every row below, while an input is out of range."""
    return '=IF(inputs_ok=1,0,"")'


def moves_on(row: int, first: bool, expression: str) -> str:
    """Column A: the expression while the row above has not fallen below the stop velocity."""
    velocity = "C" if first else "F"
    return f'=IF(ISNUMBER(A{row - 1}),IF({velocity}{row - 1}<v_stop,"",{expression}),"")'


def step_formulas(row: int, first: bool, resistance: str, step: str) -> dict[str, str]:
    """The formulas of columns C to F; `first` marks the one after row 0, with its half step.

    `resistance` and `step` are the defined names of R_t and the time step.
    """
    above = row - 1
    v, x, a = f"C{row}", f"D{row}", f"E{row}"
    area_over_pi = f"IF({x}<R_p,D_p*{x}-{x}*{x},R_p*R_p)"
    return {
        "C": guarded(row, f"C{above}" if first else f"F{above}"),
        "D": guarded(row, f"{v}*({step}/2)" if first else f"D{above}+{v}*{step}"),
        "E": guarded(row, f"(0.5*rho_t*{v}*{v}+{resistance})*PI()*{area_over_pi}/M_p"),
        "F": guarded(row, f"{v}-{a}*{step}"),
    }


def step_cells(
    row: int, first: bool, names: tuple[str, str], key: str, formats: dict[str, str]
) -> dict[str, Cell]:
    """Columns C to F of one row; `key` is the row's ("low.row[17]"), `formats` by column.

    `names` are those of the target resistance and the time step.
    """
    quantities = {"C": "velocity_initial", "D": "depth", "E": "deceleration", "F": "velocity_final"}
    units = {"C": "m/s", "D": "m", "E": "m/s²", "F": "m/s"}
    return {
        f"{column}{row}": Cell(
            key=f"{key}.{quantities[column]}",
            formula=formula,
            style="number",
            number_format=formats[column],
            unit=units[column],
            source="Eqs. A-1 to A-3; Eq. 13",
        )
        for column, formula in step_formulas(row, first, *names).items()
    }

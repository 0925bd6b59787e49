"""The block beside the rows of a sheet: inputs, result, and the depth without time steps."""

from spreadsheets.plan import Cell
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.lines import Line, heads, live, place

__all__ = [
    "INVALID",
    "NO_STOP",
    "STOPPED",
    "WIDTHS",
    "out_of_rows",
    "rest_depth_formula",
    "results",
]

STOPPED = "Stopped: the final row is in sight"
INVALID = "CHECK THE INPUTS: one is out of range, see the sheet Inputs"
NO_STOP = "no stop"
"""What stands in place of every result while the rows do not suffice."""

YES_NO = '"yes";;"no"'
"""Shows 1 and 0; a truth value would show as TRUE in one program and as 1 in another."""

_COLUMNS = "IJKLMN"
WIDTHS = dict(zip(_COLUMNS, (8.0, 31.0, 12.0, 7.0, 16.0, 32.0), strict=True))


def out_of_rows(rows: int) -> str:
    """The message of a sheet whose rows end before the particle stops.

    >>> out_of_rows(400)
    'OUT OF ROWS: 400 do not reach the stop. For more: coldspray workbook --step'
    """
    return f"OUT OF ROWS: {rows} do not reach the stop. For more: coldspray workbook --step"


def results(case: CaseSheet, first: int, last: int) -> dict[str, Cell]:
    """The block, from `first` down, for rows `first` (row 0) to `last` of the sheet."""
    lines: list[Line | str] = [
        "Inputs of this sheet",
        *_inputs(case),
        "Result of the sheet",
        *_result(case, first, last),
        "Without time steps: Eqs. 12-13 separated and integrated to rest",
        *_exact(case),
    ]
    if case.coarse:
        lines += ["Against the sheet with the step dt_s", *_against_fine(case)]
    return heads(first, _COLUMNS) | place(lines, first + 1, _COLUMNS)


def _inputs(case: CaseSheet) -> list[Line]:
    inputs = (
        ("radius", "R", "particle radius", "R_p", "m"),
        ("particle_density", "ρ_p", "particle density", "rho_p", "kg/m³"),
        ("mass", "M", "particle mass", "M_p", "kg"),
        ("diameter", "D", "particle diameter", "D_p", "m"),
        ("velocity", "V", "impact velocity", "V_impact", "m/s"),
        ("resistance", "R_t", "target resistance", case.named("R_t"), "Pa"),
        ("target_density", "ρ_t", "target density", "rho_t", "kg/m³"),
        ("step", "Δt", "time step", case.step_named, "s"),
        ("stop_velocity", "v_stop", "stop velocity", "v_stop", "m/s"),
    )
    return [
        live(
            f"{case.part}.{what}", symbol, meaning, f"={name}", unit, "Inputs",
            number_format="0.0000E+00",
        )
        for what, symbol, meaning, name, unit in inputs
    ]  # fmt: skip


def _result(case: CaseSheet, first: int, last: int) -> list[Line]:
    def final(column: str) -> str:
        return f"INDEX({column}{first}:{column}{last},COUNT(A{first}:A{last}))"

    def result(
        what: str, symbol: str, meaning: str, expression: str, unit: str, shown: str, text: str = ""
    ) -> Line:
        formula = f'=IF({{stopped}}=1,{expression},"{NO_STOP}")'
        return live(
            f"{case.part}.{what}", symbol, meaning, formula, unit, "Appendix",
            printed=text, number_format=shown, name=case.result_named(what),
        )  # fmt: skip

    none = out_of_rows(case.rows)
    message = f'=IF(inputs_ok=1,IF({{stopped}}=1,"{STOPPED}","{none}"),"{INVALID}")'
    # COUNT calculates the rows from the top; LibreOffice loses itself if asked for the last first.
    stopped = f"=IF(inputs_ok=1,IF({final('F')}<v_stop,1,0),0)"
    micrometers, ratio = case.printed
    return [
        live(f"{case.part}.stopped", "", "the rows suffice", stopped, number_format=YES_NO,
             name=case.result_named("stopped")),
        live(f"{case.part}.message", "", "which means", message, style="message"),
        result("final_depth", "X", "final penetration depth", final("D"), "m", "0.0000E+00"),
        result("depth_um", "X", "the same", "{final_depth}*1000000", "µm", "0.0000", micrometers),
        result("normalized_depth", "X/R", "normalized depth", "{final_depth}/R_p", "1", "0.0000",
               ratio),
        result("steps", "", "steps taken", f"COUNT(A{first}:A{last})-1", "1", "0"),
        result("stop_time", "t", "time of the final row", final("B"), "s", "0.0000E+00"),
        result("final_velocity", "v", "velocity that ends it",
               f"IF({{steps}}>0,{final('F')},V_impact)", "m/s", "0.0000"),
    ]  # fmt: skip


def _exact(case: CaseSheet) -> list[Line]:
    c, depth = rest_depth_formula("V_impact", case.named("R_t"), "{c}")
    lines = (
        ("c", "c", "(4ρ_p/3ρ_t) ln(1 + ρ_t V²/2R_t)", c, "1",
         "Eq. 13, separated"),
        ("exact_normalized_depth", "X/R", "normalized depth at rest",
         depth, "1", "Root of y² - y³/3 = c, or 1/3 + c"),
        ("exact_depth_um", "X", "penetration depth at rest",
         "={exact_normalized_depth}*R_p*1000000", "µm", "R times the line above"),
    )  # fmt: skip
    return [
        live(
            f"{case.part}.{what}", symbol, meaning, formula, unit, source,
            transcendental=True, name=case.result_named(what) if unit == "µm" else "",
        )
        for what, symbol, meaning, formula, unit, source in lines
    ]  # fmt: skip


def rest_depth_formula(velocity: str, resistance: str, c: str) -> tuple[str, str]:
    """The formulas of c, and of X/R at rest from the cell that holds c."""
    pressure = f"rho_t*{velocity}*{velocity}/2/{resistance}"
    angle = f"ASIN(SQRT(3*{c})/2)/3"
    shallow = f"4*SIN({angle})*SIN({angle}+PI()/3)"
    return f"=4*rho_p/(3*rho_t)*LN(1+{pressure})", f"=IF({c}<=2/3,{shallow},1/3+{c})"


def _against_fine(case: CaseSheet) -> list[Line]:
    """The final depth beside that of the finer step, counted in the last digit printed."""
    part, fine = case.part, case.named("depth_um")
    source = "Section 3: “did not change significantly”"

    def compared(expression: str) -> str:
        both = f"{{stopped}}*{case.named('stopped')}=1"
        return f'=IF({both},{expression},"{NO_STOP}")'

    return [
        live(f"{part}.fine_depth_um", "X", "final depth with dt_s", f"={fine}", "µm", "Appendix",
             printed=case.printed[0]),
        live(f"{part}.change_um", "ΔX", "change with the step of this sheet",
             compared(f"{{depth_um}}-{fine}"), "µm", source),
        Line(symbol="", meaning="the last digit that is printed",
             cell=Cell(key=f"{part}.last_digit", style="number", unit="µm", source="Section 3")),
        live(f"{part}.change_digits", "", "change in units of that digit",
             compared("{change_um}/{last_digit}"), "1", source, number_format="0.00"),
    ]  # fmt: skip

"""The block beside the rows of a sheet: inputs, result, and the depth without time steps."""

from spreadsheets.plan import Cell
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.lines import Line, heads, live, place

__all__ = ["NO_STOP", "OUT_OF_ROWS", "STOPPED", "WIDTHS", "results"]

STOPPED = "Stopped: the final row is in sight"
OUT_OF_ROWS = "OUT OF ROWS before the stop: take a larger step"
NO_STOP = "no stop"
"""What stands in place of every result while the rows do not suffice."""

YES_NO = '"yes";;"no"'
"""Shows 1 and 0; a truth value would show as TRUE in one program and as 1 in another."""

_COLUMNS = "IJKLMN"
WIDTHS = dict(zip(_COLUMNS, (8.0, 31.0, 12.0, 7.0, 16.0, 32.0), strict=True))


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
        ("step", "Δt", "time step", "dt_s", "s"),
        ("stop_velocity", "v_stop", "stop velocity", "v_stop", "m/s"),
    )
    return [
        live(
            f"{case.slug}.{what}", symbol, meaning, f"={name}", unit, "Inputs",
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
        formula = f'=IF({{stopped}},{expression},"{NO_STOP}")'
        return live(
            f"{case.slug}.{what}", symbol, meaning, formula, unit, "Appendix",
            printed=text, number_format=shown, name=case.named(what),
        )  # fmt: skip

    message = f'=IF({{stopped}},"{STOPPED}","{OUT_OF_ROWS}")'
    # COUNT calculates the rows from the top; LibreOffice loses itself if asked for the last first.
    stopped = f"=IF({final('F')}<v_stop,1,0)"
    micrometers, ratio = case.printed
    return [
        live(f"{case.slug}.stopped", "", "the rows suffice", stopped, number_format=YES_NO),
        live(f"{case.slug}.message", "", "which means", message, style="message"),
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
    pressure = f"rho_t*V_impact*V_impact/2/{case.named('R_t')}"
    angle = "ASIN(SQRT(3*{c})/2)/3"
    shallow = f"4*SIN({angle})*SIN({angle}+PI()/3)"
    lines = (
        ("c", "c", "(4ρ_p/3ρ_t) ln(1 + ρ_t V²/2R_t)", f"=4*rho_p/(3*rho_t)*LN(1+{pressure})", "1",
         "Eq. 13, separated"),
        ("exact_normalized_depth", "X/R", "normalized depth at rest",
         f"=IF({{c}}<=2/3,{shallow},1/3+{{c}})", "1", "Root of y² - y³/3 = c, or 1/3 + c"),
        ("exact_depth_um", "X", "penetration depth at rest",
         "={exact_normalized_depth}*R_p*1000000", "µm", "R times the line above"),
    )  # fmt: skip
    return [
        live(f"{case.slug}.{what}", symbol, meaning, formula, unit, source, transcendental=True)
        for what, symbol, meaning, formula, unit, source in lines
    ]

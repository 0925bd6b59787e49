"""The sheet `Inputs`: every physical number of the workbook, typed once, as printed."""

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal

from spreadsheets.plan import Cell, SheetPlan
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.lines import WIDTHS, Line, heads, live, place

__all__ = ["INPUTS", "Input", "sheet"]

NUMBER = "0.0####E+00"
"""For lengths, times and stresses: up to six digits, so that what was typed can be read."""


@dataclass(frozen=True, slots=True)
class Input:
    """One number: `text` in the report's unit, times ten to the `exponent`, in the SI `unit`.

    `name` is the cell's defined name and, after "inputs.", its key; `printed` quotes the report,
    and is empty for a number that the report does not print.
    """

    name: str
    symbol: str
    meaning: str
    text: str
    exponent: int
    unit: str
    printed: str
    source: str

    @property
    def si(self) -> float:
        """The double nearest to the decimal number in the SI unit.

        >>> INPUTS["Y_t"].si, INPUTS["dt_s"].si
        (700000000.0, 2e-10)
        """
        return float(Decimal(self.text).scaleb(self.exponent))


_INFERRED = "INFERRED from Table A-1: a handbook value of plain carbon steel"
_A1 = "Table A-1"
_FZ = "Section 3, Eq. 17 (fitted by Frank and Zook)"

_IMPACT = (
    Input("V_impact", "V", "impact velocity", "500", 0, "m/s", "500", f"{_A1}; section 3"),
    Input("R_p", "R", "particle radius", "1.10E-05", 0, "m", "1.10E-05", f"{_A1}; 22 µm / 2"),
    Input("rho_p", "ρ_p", "particle density (copper)", "8.90E+03", 0, "kg/m³", "8.90E+03", _A1),
    Input("rho_t", "ρ_t", "target density (steel)", "7850", 0, "kg/m³", "", _INFERRED),
    Input("dt_s", "Δt", "time step", "0.2", -9, "s", "0.2 ns", "Appendix; section 3"),
    Input("v_stop", "v_stop", "stop velocity", "1", 0, "m/s", "1 m/s", "Appendix"),
)
_FLOW_STRESS = Input("Y_t", "Y_t", "target flow stress", "700", 6, "Pa", "700 MPa", "Section 3")
_BETAS = (
    Input("beta_low", "β", "resistance over flow stress, low", "3", 0, "1", "3", "Section 3"),
    Input("beta_high", "β", "resistance over flow stress, high", "5", 0, "1", "5", "Section 3"),
)
_COARSE = Input(
    "dt_coarse", "Δt", "coarser time step (not used in the sheets)", "0.5", -9, "s", "0.5 ns",
    "Section 3: “did not change significantly”. Type it into dt_s to see",
)  # fmt: skip
_CRATER = (
    Input("CV_PV", "CV/PV", "crater volume over particle volume, least", "0.06", 0, "1", "0.06",
          "Section 2, above Eq. 4"),
    Input("CV_PV_line", "CV/PV", "slope of the line in figure 1", "0.058", 0, "1", "0.058",
          "Section 2"),
    Input("d_min", "d", "smallest particle diameter", "10", -6, "m", "10 μm", "Section 2"),
    Input("d_max", "d", "largest particle diameter", "30", -6, "m", "30 μm", "Section 2"),
)  # fmt: skip
_RESISTANCE = (
    Input("q_Y", "q/Y_t", "Goodier's pressure over flow stress", "2.77", 0, "1", "2.77 Y_t",
          "Section 3, below Eq. 8"),
    Input("E_t", "E_t", "Young's modulus of the target", "200", 9, "Pa", "200 GPa",
          "Section 3, below Eq. 11"),
    Input("Y_steel", "Y", "yield strength of stainless steel", "215", 6, "Pa", "215 MPa",
          "Section 3, below Eq. 11"),
    Input("HB_ratio", "HB/UTS", "Brinell hardness over tensile strength", "3", 0, "1",
          "“three times”", "Section 3"),
    Input("S_feathery", "S", "strength, feathery grains", "110", 0, "ksi", "110 ksi", "Section 3"),
    Input("S_clear", "S", "strength, clear grains", "98", 0, "ksi", "98 ksi", "Section 3"),
    Input("S_bulk", "S", "strength, bulk material", "30", 0, "ksi", "~30 ksi", "Section 3"),
    Input("Y_copper", "Y_p", "yield strength of annealed copper", "90", 6, "Pa", "90 MPa",
          "Section 3"),
    Input("L_typ", "L", "typical dimension for the strain rate", "20", -6, "m", "20 μm",
          "Section 3"),
)  # fmt: skip
_FRANK_ZOOK = (
    Input("k_1", "k_1", "unsteady-motion parameter", "0.557", 0, "1", "0.557", _FZ),
    Input("k_t", "k_t", "inertia parameter (instead of 1/2)", "1.046", 0, "1", "1.046", _FZ),
    Input("R_t_RHA", "R_t", "target resistance, rolled homogeneous armor", "9.13", 9, "Pa",
          "9.13 × 10^9 Pa", _FZ),
    Input("R_t_lower", "R_t", "target resistance, lower", "7.6", 9, "Pa", "7.6 × 10^9 Pa",
          "Section 3, below Eq. 17"),
)  # fmt: skip
_UNITS = (
    Input("lbf_N", "lbf", "pound-force", "4.4482216152605", 0, "N", "", "Exact, by definition"),
    Input("inch_m", "in", "inch", "0.0254", 0, "m", "", "Exact, by definition"),
)

_BLOCKS = {
    "Impact": (*_IMPACT, _COARSE),
    "Target resistance of the sheets": (_FLOW_STRESS, *_BETAS),
    "Crater data": _CRATER,
    "Material data": _RESISTANCE,
    "Frank-Zook": _FRANK_ZOOK,
    "Unit conversion": _UNITS,
}
INPUTS = {entry.name: entry for block in _BLOCKS.values() for entry in block}
"""Every input by its name."""


def sheet(cases: tuple[CaseSheet, ...]) -> SheetPlan:
    """The sheet for these cases, which share every input but the target resistance."""
    cells = {
        "A1": Cell(text="Inputs", style="title"),
        "A2": Cell(
            text="Change a blue number on yellow; every other sheet follows. SI units, except the "
            "strengths in ksi. Gray text is about the report's own case.",
            style="note",
        ),
    }
    cells |= heads(4) | place(list(_lines(cases)), 5)
    named = {address: cell.name for address, cell in cells.items() if cell.name}
    cells |= {f"G{address[1:]}": Cell(text=name, style="source") for address, name in named.items()}
    cells["G4"] = Cell(text="Name in formulas", style="head unit")
    widths = dict(zip("ABCDEFG", (*WIDTHS, 18.0), strict=True))
    return SheetPlan(name="Inputs", cells=cells, widths=widths, frozen="A5", repeated_rows=(4, 4))


def _lines(cases: tuple[CaseSheet, ...]) -> Iterator[Line | str]:
    for title, entries in _BLOCKS.items():
        yield title
        if _FLOW_STRESS in entries:
            yield from _resistance_lines(cases)
        else:
            yield from map(_line, entries)
    yield "Derived"
    yield _derived("D_p", "D", "particle diameter", "=2*R_p", "m", "2.20E-05", "Below Eq. 12")
    yield _derived(
        "M_p", "M", "particle mass", "=rho_p*4/3*PI()*R_p*R_p*R_p", "kg", "4.96E-11", "Table A-1"
    )


def _resistance_lines(cases: tuple[CaseSheet, ...]) -> Iterator[Line]:
    if cases[0].resistance_given:
        yield from map(_given_resistance, cases)
        return
    yield _line(_FLOW_STRESS)
    yield from map(_beta, cases)
    for case in cases:
        printed = "3.50E+09" if case.slug == "high" else ""
        formula = f"={case.named('beta')}*Y_t"
        yield _derived(
            case.named("R_t"), "R_t", f"target resistance, {case.name}", formula, "Pa", printed,
            "Eq. 7; Eq. A-2",
        )  # fmt: skip


def _beta(case: CaseSheet) -> Line:
    name = case.named("beta")
    if name in INPUTS:
        return _line(INPUTS[name])
    return _input(name, "β", "resistance over flow stress", "1", "3 and 5", "Section 3")


def _given_resistance(case: CaseSheet) -> Line:
    note = "Given instead of β and Y_t (the report: Eq. 7)"
    meaning = f"target resistance, {case.name}"
    return _input(case.named("R_t"), "R_t", meaning, "Pa", "", note)


def _line(entry: Input) -> Line:
    style = "input" if entry.source != _INFERRED else "inferred"
    return _input(
        entry.name, entry.symbol, entry.meaning, entry.unit, entry.printed, entry.source, style
    )


def _input(
    name: str,
    symbol: str,
    meaning: str,
    unit: str,
    printed: str,
    source: str,
    style: str = "input",
) -> Line:
    cell = Cell(
        key=f"inputs.{name}",
        style=style,
        number_format=NUMBER if unit in ("m", "s", "Pa") else "General",
        name=name,
        unit=unit,
        source=source,
    )
    return Line(symbol=symbol, meaning=meaning, cell=cell, printed=printed or "not printed")


def _derived(
    name: str, symbol: str, meaning: str, formula: str, unit: str, printed: str, source: str
) -> Line:
    return live(
        f"inputs.{name}", symbol, meaning, formula, unit, source,
        printed=printed, number_format="0.00E+00", name=name,
    )  # fmt: skip

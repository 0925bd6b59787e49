"""The sheet `Inputs`: every physical number of the workbook, typed once, as printed."""

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal

from spreadsheets.plan import Cell, Limits, Rule, SheetPlan
from spreadsheets.sheets.case import CaseSheet
from spreadsheets.sheets.lines import WIDTHS, Line, heads, live, place

__all__ = ["ALL_VALID", "INPUTS", "REPORT_INPUTS", "Input", "sheet"]

NUMBER = "0.0####E+00"
"""For lengths, times and stresses: up to six digits, so that what was typed can be read."""


_POSITIVE = Limits()


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
    limits: Limits = _POSITIVE

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
    Input("v_stop", "v_stop", "stop velocity", "1", 0, "m/s", "1 m/s", "Appendix",
          Limits(closed=True)),
)  # fmt: skip
_FLOW_STRESS = Input("Y_t", "Y_t", "target flow stress", "700", 6, "Pa", "700 MPa", "Section 3")
_BETAS = (
    Input("beta_low", "β", "resistance over flow stress, low", "3", 0, "1", "3", "Section 3"),
    Input("beta_high", "β", "resistance over flow stress, high", "5", 0, "1", "5", "Section 3"),
)
_COARSE = Input(
    "dt_coarse", "Δt", "coarser time step", "0.5", -9, "s", "0.5 ns",
    "Section 3: “did not change significantly”",
)  # fmt: skip
_CRATER = (
    Input("CV_PV", "CV/PV", "crater volume over particle volume, least", "0.06", 0, "1", "0.06",
          "Section 2, above Eq. 4", Limits(most=0.5)),
    Input("CV_PV_line", "CV/PV", "slope of the line in figure 1", "0.058", 0, "1", "0.058",
          "Section 2", Limits(most=0.5)),
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

_FIGURE_5 = (
    Input("V_from", "V", "least velocity of figure 5", "400", 0, "m/s", "400", "Section 4"),
    Input("V_to", "V", "greatest velocity of figure 5", "500", 0, "m/s", "500 m/s", "Section 4"),
)
_EQUATIONS = (
    Input("D_mean", "D", "mean particle diameter of the powder", "22", -6, "m", "22 μm",
          "Section 2"),
    Input("observed_ratio", "X/R", "observed normalized depth", "0.3", 0, "1", "0.3",
          "Section 4: “0.9 or 0.7 vs. 0.3”"),
)  # fmt: skip

_BLOCKS = {
    "Impact": (*_IMPACT, _COARSE),
    "Figure 5": _FIGURE_5,
    "Target resistance of the sheets": (_FLOW_STRESS, *_BETAS),
    "Crater data": _CRATER,
    "Material data": _RESISTANCE,
    "Frank-Zook": _FRANK_ZOOK,
    "Equations": _EQUATIONS,
    "Unit conversion": _UNITS,
}
INPUTS = {entry.name: entry for block in _BLOCKS.values() for entry in block}
"""Every input by its name."""

REPORT_INPUTS = {_COARSE.name, *(entry.name for entry in (*_FIGURE_5, *_EQUATIONS))}
"""What only sheets about the report take, and other workbooks leave out."""

ALL_VALID = "All inputs are in range."
_NOT_VALID = "CHECK THE INPUTS: column I tells which one is out of range."
_CHECKED = '"ok";;"out of range"'
"""Shows 1 and 0."""


def sheet(cases: tuple[CaseSheet, ...], report: bool) -> SheetPlan:
    """The sheet for these cases, which share every input but the target resistance.

    `report`: the workbook is the report's, and has the sheets that are about it alone.
    """
    cells = {
        "A1": Cell(text="Inputs", style="title"),
        "A2": Cell(
            text="Change a blue number on yellow; every other sheet follows. SI units, except the "
            "strengths in ksi. To restore the report's values, copy column H and paste values into "
            "column C.",
            style="note",
        ),
    }
    cells |= heads(5) | place(list(_lines(cases, report)), 6)
    named = {address: cell.name for address, cell in cells.items() if cell.name}
    cells |= {f"G{address[1:]}": Cell(text=name, style="source") for address, name in named.items()}
    checks = _checks(cells)
    for column, head in (("G", "Name in formulas"), ("H", "Report's value"), ("I", "Check")):
        cells[f"{column}5"] = Cell(text=head, style="head" if column == "G" else "head right")
    cells |= checks | _report_values(cells) | _status(checks)
    widths = dict(zip("ABCDEFGHI", (*WIDTHS, 18.0, 15.0, 12.0), strict=True))
    warning = Rule(cells="A3", formula="=$I$3=0", style="warning")
    failed = Rule(cells=f"I3:I{_last(checks)}", formula="=AND(ISNUMBER(I3),I3=0)", style="warning")
    return SheetPlan(
        name="Inputs",
        cells=cells,
        widths=widths,
        frozen="A6",
        repeated_rows=(5, 5),
        rules=(warning, failed),
    )


def _checks(cells: dict[str, Cell]) -> dict[str, Cell]:
    """Column I: 1 beside an input that is a number in range, 0 beside another.

    Beside the mass: whether it is one that doubles can hold.
    """
    checks = {}
    for address, cell in cells.items():
        if cell.limits:
            formula = f"=IF(ISNUMBER({address}),{_in_range(address, cell.limits)},0)"
        elif cell.name == "M_p":
            formula = "=IFERROR(IF(rho_p*R_p*R_p*R_p>0,1,0),0)"
        else:
            continue
        checks[f"I{address[1:]}"] = Cell(
            key=f"inputs.{cell.name}.check",
            formula=formula,
            style="number",
            number_format=_CHECKED,
        )
    return checks


def _in_range(address: str, limits: Limits) -> str:
    above = f"{address}{'>=' if limits.closed else '>'}{limits.least:g}"
    if limits.most is None:
        return f"IF({above},1,0)"
    return f"IF({above},IF({address}<={limits.most:g},1,0),0)"


def _last(checks: dict[str, Cell]) -> int:
    return max(int(address[1:]) for address in checks)


def _report_values(cells: dict[str, Cell]) -> dict[str, Cell]:
    """Column H: the report's own value of each input, to be copied back."""
    return {
        f"H{address[1:]}": Cell(
            key=f"inputs.{cell.name}.report", style="printed", number_format=cell.number_format
        )
        for address, cell in cells.items()
        if cell.limits and cell.name in INPUTS
    }


def _status(checks: dict[str, Cell]) -> dict[str, Cell]:
    """The one cell that every guard asks, and what it means."""
    rows = [int(address[1:]) for address in checks]
    return {
        "A3": Cell(
            key="inputs.message",
            formula=f'=IF(inputs_ok=1,"{ALL_VALID}","{_NOT_VALID}")',
            style="message",
        ),
        "I3": Cell(
            key="inputs.ok",
            formula=f"=MIN(I{min(rows)}:I{max(rows)})",
            style="result",
            number_format=_CHECKED,
            name="inputs_ok",
        ),
    }


def _lines(cases: tuple[CaseSheet, ...], report: bool) -> Iterator[Line | str]:
    for title, entries in _BLOCKS.items():
        kept = [entry for entry in entries if report or entry.name not in REPORT_INPUTS]
        if not kept:
            continue
        yield title
        if _FLOW_STRESS in kept:
            yield from _resistance_lines(cases)
        else:
            yield from map(_line, kept)
    yield "Derived"
    yield _derived("D_p", "D", "particle diameter", "=2*R_p", "m", "2.20E-05", "Below Eq. 12")
    yield _derived(
        "M_p", "M", "particle mass", "=rho_p*4/3*PI()*R_p*R_p*R_p", "kg", "4.96E-11", "Table A-1"
    )
    yield _derived("half_step", "Δt/2", "half step to start", "=dt_s/2", "s", "0.1 ns", "Appendix")


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
    return _line(
        Input(name, "β", "resistance over flow stress", "", 0, "1", "3 and 5", "Section 3")
    )


def _given_resistance(case: CaseSheet) -> Line:
    meaning = f"target resistance, {case.name}"
    note = "Given instead of β and Y_t (the report: Eq. 7)"
    return _line(Input(case.named("R_t"), "R_t", meaning, "", 0, "Pa", "", note))


def _line(entry: Input) -> Line:
    cell = Cell(
        key=f"inputs.{entry.name}",
        style="input" if entry.source != _INFERRED else "inferred",
        number_format=NUMBER if entry.unit in ("m", "s", "Pa") else "General",
        name=entry.name,
        unit=entry.unit,
        source=entry.source,
        limits=entry.limits,
    )
    printed = entry.printed or "not printed"
    return Line(symbol=entry.symbol, meaning=entry.meaning, cell=cell, printed=printed)


def _derived(
    name: str, symbol: str, meaning: str, formula: str, unit: str, printed: str, source: str
) -> Line:
    return live(
        f"inputs.{name}", symbol, meaning, formula, unit, source,
        printed=printed, number_format="0.00E+00", name=name,
    )  # fmt: skip

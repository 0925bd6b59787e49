"""The sheet `Inputs`: every physical number, typed into a yellow cell in the report's unit.

Beside each stand the value in use in SI units, the report's value, and the limits within which a
number is accepted. A number that cannot be used makes its cell in use #N/A, and so all that hangs
on it.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from reference.ledger import INFERRED, Ledger
from reference.units import to_si
from spreadsheets.plan import (
    YES_OR_NO,
    Cell,
    Rule,
    SheetPlan,
    formula,
    printed,
    recorded,
    said_while,
    unit_text,
)
from spreadsheets.sheets import messages
from spreadsheets.sheets.case import CaseSheet

_LIMITS: Mapping[str, tuple[float, float]] = {
    "m/s": (1e-6, 1e6),
    "um": (1e-4, 1e6),
    "ns": (1e-6, 1e6),
    "kg/m^3": (25.0, 1e5),
    "Pa": (1e5, 1e15),
    "MPa": (1e-3, 1e6),
    "GPa": (1e-4, 1e5),
    "ksi": (1e-3, 1e5),
    "1": (1e-4, 1e4),
}
"""What may be typed, by unit. The limits admit any impact, but not a number in SI units where the
sheet asks for another unit (2E-10 for 0.2 ns, 7E8 for 700 MPa), or 8.9 for 8900 kg/m³."""

_UP_TO_HALF_A_SPHERE = (1e-4, 0.5)


class InputLine(NamedTuple):
    """A number to be typed in: its defined name, symbol, unit, and what it is.

    source: the claim that prints it, or an inferred input. attribute: the attribute of an impact
    that it gives, if it belongs to a case. case: the slug of that case, if it belongs to one only.
    own_limits: if they are not those of the unit.
    """

    name: str
    symbol: str
    source: str
    unit: str = "1"
    meaning: str = ""
    attribute: str = ""
    case: str = ""
    own_limits: tuple[float, float] | None = None

    @property
    def limits(self) -> tuple[float, float]:
        """The least and the greatest number that may be typed."""
        return self.own_limits or _LIMITS[self.unit]

    @property
    def is_inferred(self) -> bool:
        """Whether the report never prints it."""
        return self.source.startswith(INFERRED)

    @property
    def whose(self) -> str:
        """What the check says of the report's number."""
        return INFERRED_VALUE if self.is_inferred else OF_REPORT

    def of_report(self, ledger: Ledger) -> float:
        """Return the report's number in this unit."""
        return float(ledger.value(self.source) / to_si(self.unit))


def unit_in_use(unit: str) -> str:
    """Return the SI unit of an input that is typed in this unit."""
    return {"um": "m", "ns": "s", "MPa": "Pa", "GPa": "Pa", "ksi": "Pa"}.get(unit, unit)


def in_si(expression: str, unit: str) -> str:
    """Return the expression of a typed number in SI units.

    Division by a power of ten rounds once; multiplication by 1E-6 would round twice.

    >>> in_si("C12", "um"), in_si("C12", "m/s")
    ('C12/1000000', 'C12')
    """
    match unit:
        case "um":
            return f"{expression}/1000000"
        case "ns":
            return f"{expression}/1000000000"
        case "MPa":
            return f"{expression}*1000000"
        case "GPa":
            return f"{expression}*1000000000"
        case "ksi":
            return f"{expression}*ksi_Pa"
        case _:
            return expression


def input_lines(cases: Sequence[CaseSheet], report: bool) -> dict[str, list[InputLine]]:
    """Return the inputs of a workbook of these cases, by block.

    report: whether it is the report's own workbook.
    """
    stop_limits = (0.0, 1e6)
    impact = [
        InputLine("V_impact", "V", "a1-initial-velocity", "m/s", attribute="velocity"),
        InputLine("R_p", "R", "a1-radius", "um", attribute="radius"),
        InputLine("rho_p", "ρ_p", "a1-density", "kg/m^3", attribute="particle_density"),
        InputLine(
            "rho_t", "ρ_t", f"{INFERRED}target-density", "kg/m^3", attribute="target_density"
        ),
        InputLine("dt_s", "Δt", "a-step", "ns", attribute="step"),
        InputLine(
            "v_stop", "v_stop", "a-stop-velocity", "m/s", attribute="stop_velocity",
            own_limits=stop_limits,
        ),
    ]  # fmt: skip
    if report:
        impact.append(InputLine("dt_coarse", "Δt", "coarse-step", "ns"))
    given = "target resistance, given instead of β and Y_t"
    resistance = [InputLine("R_t", "R_t", "a1-resistance", "Pa", given, attribute="resistance")]
    if not cases[0].resistance_given:
        over = "target resistance over flow stress"
        resistance = [
            InputLine("Y_t", "Y_t", "flow-stress", "MPa", attribute="flow_stress"),
            *(
                InputLine(
                    f"beta{case.input_suffix}", "β", f"depth-beta-{case.beta}-beta",
                    meaning=f"{over}, {case.name}", attribute="beta", case=case.slug,
                )
                for case in cases
            ),
        ]  # fmt: skip
    return {"Impact": impact, "Target resistance": resistance, **_OF_NO_CASE}


_OF_NO_CASE: Mapping[str, list[InputLine]] = {
    "Velocities of Figure 5": [
        InputLine("V_from", "V", "figure-5-velocity-least", "m/s", "velocity of the first point"),
        InputLine("V_to", "V", "figure-5-velocity-greatest", "m/s", "velocity of the last point"),
    ],
    "Craters and particles": [
        InputLine("CV_PV", "CV/PV", "volume-ratio", own_limits=_UP_TO_HALF_A_SPHERE),
        InputLine("CV_PV_line", "CV/PV", "volume-ratio-line", own_limits=_UP_TO_HALF_A_SPHERE),
        InputLine("D_mean", "D", "mean-diameter", "um"),
        InputLine(
            "d_min", "d_min", "particle-size-least", "um", "a particle’s diameter, for Eq. 1"
        ),
        InputLine(
            "d_max", "d_max", "particle-size-greatest", "um",
            "another particle’s diameter, for Eq. 1",
        ),
        InputLine("observed_ratio", "X/R", "discussion-observed"),
    ],
    "Materials": [
        InputLine("q_Y", "q/Y_t", "goodier-q"),
        InputLine("E_t", "E_t", "elastic-modulus", "GPa"),
        InputLine("Y_steel", "Y", "yield-strength", "MPa"),
        InputLine("HB_ratio", "HB/UTS", "brinell-ratio"),
        InputLine("S_feathery", "S", "strength-feathery", "ksi"),
        InputLine("S_clear", "S", "strength-clear", "ksi"),
        InputLine("S_bulk", "S", "strength-bulk", "ksi"),
        InputLine(
            "Y_copper", "Y_p", "copper-yield", "MPa", "yield strength of copper at room temperature"
        ),
        InputLine("L_typ", "L", "strain-rate-length", "um"),
    ],
    "Frank and Zook": [
        InputLine("k_1", "k_1", "fz-k1"),
        InputLine("k_t", "k_t", "fz-kt"),
        InputLine("R_t_RHA", "R_t", "fz-resistance-rha", "MPa"),
        InputLine("R_t_lower", "R_t", "fz-resistance-stainless", "MPa"),
    ],
}  # fmt: skip

CONSTANTS = {
    "pi_": ("circumference over diameter, π", "1"),
    "ksi_Pa": ("1000 pound-force per square inch", "Pa"),
    "L_most": ("e^L is computed for L below this", "1"),
    "series_below": ("for x below this, ln(1 + x) and e^x - 1 are series", "1"),
    "um3_per_m3": ("cubic micrometers in a cubic meter", "1"),
    "same_within": ("numbers that differ by this share are the same", "1"),
    "travel_most": ("a step may pass this share of the radius", "1"),
    "excess_most": ("the sheet may exceed the exact depth by", "1"),
    "off_stop_most": ("the sheet may be off the exact depth at v_stop by", "1"),
}
"""Meanings and units of numbers that depend on no input. Programs differ in the digits of their own
pi, so it stands in a cell. So do very large and small numbers: some programs cannot read 1E-8 in a
formula, and 0.00000001 is hard to read. The last three are limits beyond which a run is not to be
trusted; the command warns beyond the same ones."""

_HEADS = (
    ("Symbol", 9), ("Quantity", 42), ("Type here", 12), ("Unit", 7), ("Check", 11), ("In use", 13),
    ("Unit", 7), ("The report’s", 11), ("It prints", 13), ("Where", 23), ("Least", 10),
    ("Greatest", 12), ("Name", 14), ("Number typed", 14), ("Taken", 14), ("Below least?", 14),
    ("Above most?", 14), ("Fault", 14), ("Accepted", 14), ("Whose", 14),
)  # fmt: skip

OF_REPORT, INFERRED_VALUE, YOURS = "the report’s", "as inferred", "yours"
TOO_SMALL, TOO_LARGE, NO_NUMBER = "too small", "too large", "no number"
"""What the column Check says of an input."""


def inputs_sheet(ledger: Ledger, cases: Sequence[CaseSheet], report: bool) -> SheetPlan:
    """Plan the sheet `Inputs` for these cases, which share all inputs but the target resistance."""
    about = "Every physical number: yours and the report’s, unit, check, limits, name"
    sheet = SheetPlan(ledger=ledger, name="Inputs", about=about, columns="ABFGIJ")
    sheet.begin("Inputs")
    sheet.say(
        "Type into the yellow cells, in the unit beside them; every sheet follows. On orange: an"
        " input that the report never prints, inferred from Table A-1."
    )
    sheet.row = 9
    sheet.table(_HEADS, right="CFHIKLNOS", scrolling="C")
    first = sheet.row
    for block, inputs in input_lines(cases, report).items():
        sheet.block(block)
        for line in inputs:
            sheet.put(**_input(ledger, line, sheet.row))
        sheet.row += 1
    checks = f"E{first}:E{sheet.row - 2}"
    _summary(sheet, checks)
    _derived(sheet, cases)
    _constants(sheet)
    sheet.print_area, sheet.portrait, sheet.most_pages = f"A1:J{sheet.row - 1}", True, 1
    faults = ",".join(f'$E{first}="{fault}"' for fault in (TOO_SMALL, TOO_LARGE, NO_NUMBER))
    sheet.rules = [
        Rule(checks, f"=OR({faults})", "warning"),
        Rule(checks, f'=$E{first}="{YOURS}"', "changed"),
        Rule("A7", "=inputs_unusable>0", "warning"),
    ]
    return sheet


def _input(ledger: Ledger, line: InputLine, row: int) -> dict[str, Cell]:
    """Return the cells of an input's row."""
    if line.is_inferred:
        style, place = "inferred", "inferred from Table A-1"
        prints = Cell("nowhere", "recorded")
    else:
        style, place = "input", str(ledger.claims[line.source].place)
        prints = printed(ledger, line.source, line.unit)
    si, unit = in_si(f"S{row}", line.unit), unit_in_use(line.unit)
    shown = "General" if unit == line.unit else "0.0####E+00"
    return {
        "A": Cell(line.symbol, "text"),
        "B": Cell(line.meaning or ledger.title(line.source), "text"),
        "C": Cell(key=f"{line.name}.typed", style=style, unit=line.unit, limits=line.limits),
        "D": unit_text(line.unit),
        "E": formula(f"{line.name}.check", f"=IFERROR(T{row},R{row})", "text"),
        "F": formula(line.name, f"={si}", named=True, unit=unit, shown=shown),
        "G": unit_text(unit),
        "H": recorded(line.of_report(ledger)),
        "I": prints,
        "J": Cell(place, "unit"),
        "K": recorded(line.limits[0]),
        "L": recorded(line.limits[1]),
        "M": Cell(line.name, "unit"),
        "N": formula(f"{line.name}.number", f"=IF(ISNUMBER(C{row}),C{row},NA())"),
        "O": formula(f"{line.name}.taken", f'=IF(inputs_from="report",H{row},N{row})'),
        **within_limits(line.name, row, number="O", limits="KL", columns="PQRS"),
        "T": formula(f"{line.name}.whose", f'=IF(S{row}=H{row},"{line.whose}","{YOURS}")', "text"),
    }


def within_limits(key: str, row: int, *, number: str, limits: str, columns: str) -> dict[str, Cell]:
    """Return the cells that check a number, one condition in each.

    number, limits: the columns of the number, and of the least and the greatest accepted one.
    columns: where it says whether the number is too small, whether it is too large, and what is
    wrong with it; the last is the number if nothing is.
    """
    least, most = tuple(limits)
    below, above, fault, accepted = tuple(columns)
    checks = {
        below: ("below", f'=IF({number}{row}<{least}{row},"{TOO_SMALL}","")', "text"),
        above: ("above", f'=IF({number}{row}>{most}{row},"{TOO_LARGE}","")', "text"),
        fault: ("fault", f'=IFERROR({below}{row}&{above}{row},"{NO_NUMBER}")', "text"),
        accepted: ("accepted", f'=IF({fault}{row}="",{number}{row},NA())', "number"),
    }
    return {
        column: formula(f"{key}.{end}", expression, style)
        for column, (end, expression, style) in checks.items()
    }


def _summary(sheet: SheetPlan, checks: str) -> None:
    """Add the choice of inputs, and what the checks in these cells say as a whole."""
    unusable = "+".join(
        f'COUNTIF({checks},"{fault}")' for fault in (TOO_SMALL, TOO_LARGE, NO_NUMBER)
    )
    # An error may be typed as the choice.
    chosen, no_choice = '=IF(C4="report","report","yours")', messages.NO_CHOICE
    unlike = f'=IF(C4=inputs_from,"","{no_choice}")'
    changed = f'=COUNTIF({checks},"{YOURS}")'
    chain = "&".join(f"says_{name}" for name in messages.INPUTS_SAY)
    sheet.cells |= {
        "B4": Cell("Inputs to use: yours, or the report’s", "text"),
        "C4": Cell(key="inputs.choice", style="input", choices=["yours", "report"]),
        "E4": Cell("in use:", "unit"),
        "F4": formula("inputs_from", '=IFERROR(N1,"yours")', named=True),
        "G4": formula("inputs.no_choice", f'=IFERROR(N2,"{no_choice}")', "message"),
        "B5": Cell("Inputs in use that are not the report’s", "text"),
        "C5": formula("inputs_changed", changed, "result", named=True),
        "B6": Cell("Inputs that cannot be used", "text"),
        "C6": formula("inputs_unusable", f"={unusable}", "result", named=True),
        "A7": formula("inputs.message", f"={chain}", "message"),
        "M1": Cell("chosen", "unit"),
        "N1": formula("inputs.chosen", chosen, "text"),
        "M2": Cell("no choice", "unit"),
        "N2": formula("inputs.unlike", unlike, "text"),
        "N3": Cell("Which one of these does A7 say?", "block"),
    }

    def state(row: int, name: str, expression: str) -> None:
        """Add whether a state holds, of which one does, and what A7 says while it holds."""
        sheet.cells |= {
            f"M{row}": Cell(name, "unit"),
            f"N{row}": formula(f"is_{name}", expression, named=True, shown=YES_OR_NO),
            f"O{row}": said_while(name, messages.INPUTS_SAY[name]),
        }

    # The report's inputs can all be used, and none of them is changed.
    state(4, "unusable", "=IF(inputs_unusable>0,1,0)")
    state(5, "changed", "=IF(AND(inputs_unusable=0,inputs_changed>0),1,0)")
    state(6, "ignored", '=IF(inputs_from="report",1,0)')
    unchanged = 'AND(inputs_unusable=0,inputs_changed=0,inputs_from="yours")'
    state(7, "unchanged", f"=IF({unchanged},1,0)")


def _derived(sheet: SheetPlan, cases: Sequence[CaseSheet]) -> None:
    """Add the numbers that follow from the inputs."""
    shown = "0.0####E+00"
    sheet.block("What follows from them")
    sheet.line("D_p", "D", "particle diameter", "=2*R_p", "m", beside="a1-diameter", shown=shown)
    sheet.line(
        "M_p", "M", "particle mass", "=rho_p*4/3*pi_*R_p*R_p*R_p", "kg", beside="a1-mass",
        shown=shown,
    )  # fmt: skip
    for case in cases:
        if not case.resistance_given:
            sheet.line(
                case.resistance, "R_t", f"target resistance, {case.name}",
                f"=beta{case.input_suffix}*Y_t", "Pa",
                beside="a1-resistance" if case.slug == "high" else "", shown=shown,
            )  # fmt: skip
    sheet.line(
        "half_step", "Δt/2", "half step to start", "=dt_s/2*1000000000", "ns",
        claim="a-half-step", shown="General",
    )  # fmt: skip
    sheet.line(
        "mean_radius", "R", "radius of the mean particle", "=D_mean/2*1000000", "um",
        claim="particle-radius", shown="General",
    )  # fmt: skip
    sheet.row += 1


def _constants(sheet: SheetPlan) -> None:
    """Add the numbers that depend on no input."""
    sheet.block("Constants")
    for name, (meaning, unit) in CONSTANTS.items():
        sheet.put(
            B=Cell(meaning, "text"),
            F=recorded(name, named=True, unit=unit),
            G=unit_text(unit),
            M=Cell(name, "unit"),
        )

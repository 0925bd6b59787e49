"""The sheet of one case: its rows down to the stop, and its results.

Rows below the stop stay blank until changed inputs need them. The sheet says so if there are too
few rows, or if the time step is too long for the motion.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil
from typing import NamedTuple

from reference.ledger import Ledger
from reference.scheme import Scheme
from spreadsheets.plan import YES_OR_NO, Rule, SheetPlan, formula
from spreadsheets.sheets import messages
from spreadsheets.sheets.formulas import cap_angle, depth, log1p

FIRST_ROW = 10
"""The row of the sheet that holds row 0 of the scheme, the impact itself."""

_ROW_HEIGHT = 11.25
"""In points: the report's two runs take two pages each."""

_ROWS_OF_A_PAGE = 96
"""The rows of the sheet that a page has room for, in type of 6.8 points."""

_HEADS = 2
"""The rows of heads, which every page repeats."""

MAX_ROWS = 20_000
"""The most rows of a sheet; to write them takes half a minute and gigabytes of memory."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseSheet:
    """What the sheet of one case is: its name, its length, and how it relates to the report.

    slug: "low" or "high" for the lower and higher beta of two cases, "case" for a single one; part
    of keys and defined names. label: distinguishes the cases on the sheets, as written ("β = 5").
    steps, rows: rows in use and rows prepared, not counting row 0. beta: "3" or "5", for the case
    of the report that this one is compared with. is_reports: whether it is that case itself.
    resistance_given: whether the target resistance is an input, rather than the product of beta and
    the flow stress. coarse: whether the time step is `dt_coarse` instead of `dt_s`.
    """

    name: str
    slug: str
    label: str
    scheme: Scheme
    beta: str
    is_reports: bool
    resistance_given: bool
    steps: int = 0
    rows: int = 0
    coarse: bool = False

    @property
    def input_suffix(self) -> str:
        """The ending of the defined names of its inputs: "_low" as in R_t_low, or nothing."""
        return "" if self.slug == "case" else f"_{self.slug}"

    @property
    def part(self) -> str:
        """The start of the keys of its sheet: "low", "low_coarse", or "case"."""
        return f"{self.slug}_coarse" if self.coarse else self.slug

    @property
    def suffix(self) -> str:
        """The ending of the defined names of its results: "_low", "_low_coarse", or nothing."""
        return "" if self.slug == "case" else f"_{self.part}"

    @property
    def resistance(self) -> str:
        """The defined name of its target resistance."""
        return f"R_t{self.input_suffix}"

    @property
    def time_step(self) -> str:
        """The defined name of its time step."""
        return "dt_coarse" if self.coarse else "dt_s"

    def cells(self, column: str) -> str:
        """Return the cells of a column of its rows, such as "A10:A410"."""
        return f"{column}{FIRST_ROW}:{column}{FIRST_ROW + self.rows}"

    def rules(self, cells: str) -> list[Rule]:
        """Return the rule by which cells show in color that the run cannot be trusted.

        That the last step reverses the velocity is no warning: the sheet stops at the first row
        below the stop velocity, which in most cases is below zero.
        """
        return [Rule(cells, f"=trust{self.suffix}=0", "warning")]


def prepared_rows(steps: int, wanted: int | None = None) -> int:
    """Return how many rows to prepare for a number of steps: as wanted, or else by default.

    The default is twice the steps, rounded up to full hundreds, with at least a hundred blank rows
    for other inputs. Raises ValueError for too few rows, or more than `MAX_ROWS`.

    >>> prepared_rows(178), prepared_rows(3), prepared_rows(178, 1000)
    (400, 200, 1000)
    """
    if steps > MAX_ROWS:
        raise ValueError(
            f"the workbook would need {steps:,} rows, more than {MAX_ROWS:,}: take a larger step"
        )
    if wanted is None:
        return min(-(-max(2 * steps, steps + 100) // 100) * 100, MAX_ROWS)
    if not (least := max(steps, 1)) <= wanted <= MAX_ROWS:
        raise ValueError(f"{wanted:,} rows will not do: give {least:,} to {MAX_ROWS:,}")
    return wanted


# The rows (appendix, Eqs., both cases of Eq. 13). Row 0 is the impact itself; row 1 has
# the half step. Only the centered scheme has a column of middle velocities. Do not change the order
# of operations: it decides the last digit.


def next_index(row: int, step: int) -> str:
    """Return the formula of column A: the number of the row, down to the one below v_stop.

    To compare a blank cell with "" instead of asking ISNUMBER fails in two spreadsheet programs.
    """
    above = row - 1
    velocity = f"C{above}" if step == 1 else f"F{above}"  # row 0 has no final velocity
    return f'=IF(ISNUMBER(A{above}),IF({velocity}<v_stop,"",A{above}+1),"")'


def step_formulas(case: CaseSheet, row: int, step: int, middle: str) -> dict[str, str]:
    """Return the formulas of columns C to F of a time step, and of the column `middle`.

    row: of the sheet. step: counts from 1. Cells are blank where column A has no number.
    """
    above, dt, resistance = row - 1, case.time_step, case.resistance
    area = f"pi_*IF(D{row}<R_p,D_p*D{row}-D{row}*D{row},R_p*R_p)"

    def deceleration(velocity: str) -> str:
        return f"(0.5*rho_t*{velocity}*{velocity}+{resistance})*{area}/M_p"

    centered = case.scheme is Scheme.CENTERED
    formulas = {
        "C": f"C{above}" if step == 1 else f"F{above}",
        "D": f"C{row}*({dt}/2)" if step == 1 else f"D{above}+C{row}*{dt}",
        "E": deceleration(f"{middle}{row}" if centered else f"C{row}"),
        "F": f"C{row}-E{row}*{dt}",
    }
    if centered:
        formulas[middle] = f"C{row}-{deceleration(f'C{row}')}*({dt}/2)"
    return {column: if_in_use(row, text) for column, text in formulas.items()}


def if_in_use(row: int, expression: str) -> str:
    """Return the formula of a cell that is blank where column A has no number."""
    return f'=IF(ISNUMBER(A{row}),{expression},"")'


class RowColumn(NamedTuple):
    """A column of the rows: its head, the end of its keys, unit, number format and `Cell.like`."""

    head: str
    key: str
    unit: str = ""
    shown: str = "General"
    like: str = ""


ROW_COLUMNS: Mapping[str, RowColumn] = {
    "A": RowColumn("Row", "index"),
    "B": RowColumn("Time", "time", "s", "0.00E+00"),
    "C": RowColumn("dx/dt initial", "velocity_initial", "m/s", "0.000", "velocity"),
    "D": RowColumn("x", "depth", "m", "0.0000E+00", "depth"),
    "E": RowColumn("d²x/dt²", "deceleration", "m/s^2", "0.0000E+00", "deceleration"),
    "F": RowColumn("dx/dt final", "velocity_final", "m/s", "0.000", "velocity"),
    "G": RowColumn("x", "depth_um", "um", "0.0000", "depth_um"),
    # After the number comes the room of two digits, since the results stand beside this column.
    "H": RowColumn("dx/dt middle", "velocity_middle", "m/s", "0.000_0_0", "velocity"),
}
"""The columns of the rows, by letter; H is that of the centered scheme only."""


def _impact_formulas(case: CaseSheet) -> dict[str, str]:
    """Return the formulas of row 0: its index is a number only if all inputs can be used."""
    needed = f"V_impact,R_p,rho_p,rho_t,{case.resistance},{case.time_step},v_stop,D_p,M_p"
    values = {"B": "0", "C": "V_impact", "D": "0", "E": "0", "G": f"D{FIRST_ROW}*1000000"}
    index = f'=IF(COUNT({needed})=9,0,"")'
    return {"A": index, **{column: if_in_use(FIRST_ROW, text) for column, text in values.items()}}


def _row_formulas(case: CaseSheet, step: int) -> dict[str, str]:
    """Return the formulas of the row of a time step, by column."""
    if step == 0:
        return _impact_formulas(case)
    row = FIRST_ROW + step
    return {
        "A": next_index(row, step),
        "B": if_in_use(row, f"A{row}*{case.time_step}"),
        **step_formulas(case, row, step, middle="H"),
        "G": if_in_use(row, f"D{row}*1000000"),
    }


def _rows(sheet: SheetPlan, case: CaseSheet) -> str:
    """Add the rows of the scheme, and return the last of their columns."""
    letters = "ABCDEFGH" if case.scheme is Scheme.CENTERED else "ABCDEFG"
    rows = [_row_formulas(case, step) for step in range(case.rows + 1)]
    for letter in letters:
        column = ROW_COLUMNS[letter]
        cells = [
            formula(
                f"{case.part}.row.{column.key}[{step}]", formulas[letter],
                # The zeros of row 0 are shown as such.
                shown="General" if step == 0 and letter != "C" else column.shown,
                unit=column.unit or "1",
                like=f"{case.part}.{column.like}" if column.like else "",
            ) if letter in formulas else None
            for step, formulas in enumerate(rows)
        ]  # fmt: skip
        sheet.column(letter, column.head, column.unit, cells)
    return letters[-1]


# What stands beside the rows


def case_sheet(ledger: Ledger, case: CaseSheet) -> SheetPlan:
    """Plan the sheet of one case: title with the live β, state of the run, notes, rows, results."""
    about = "The scheme row by row, as far as rows are prepared, and its final depth (appendix)"
    if case.coarse:
        about = "The same with the time step of the comparison, and what that changes (section 3)"
    sheet = SheetPlan(ledger=ledger, name=case.name, about=about, columns="IJKLMN")
    sheet.widths = {"A": 4.5, "B": 8.5, "G": 8, "I": 8.5, "J": 33, "K": 10.5, "L": 7, "N": 26}
    sheet.wide("M", 22 if case.coarse else 15)
    sheet.wide("CF", 10.5)
    sheet.wide("DE", 11)
    sheet.wide("H", 11 if case.scheme is Scheme.CENTERED else 3)
    sheet.begin("Rigid-body penetration, row by row" + (", coarse step" if case.coarse else ""))
    _label(sheet, case)
    s = case.suffix
    message = f'=IFERROR(says_both{s}&says_rows{s}&says_run{s},"{messages.NO_RUN}")'
    sheet.cells["A3"] = formula(f"message{s}", message, "message", named=True)
    sheet.row = 4
    sheet.say(
        "Row 1 takes x = v Δt/2 (half a step), every later row x + v Δt. d²x/dt² is printed"
        f" positive, with the drag at the {case.scheme.drag_at} velocity of a row"
        f" ({case.scheme} scheme). Eqs. 13, A-1 to A-3.",
        width=180,
    )
    sheet.say(
        f"The run stops with the first row below v_stop. {case.rows} rows are prepared; coldspray"
        f" workbook prepares N, up to {MAX_ROWS}, with the same options and --rows N.",
        width=160,
    )
    top = sheet.row = FIRST_ROW - _HEADS
    last_column = _rows(sheet, case)
    sheet.row = top - 1  # above the heads of the rows, so that not every page repeats theirs
    sheet.line_heads()
    _inputs(sheet, case)
    _results(sheet, case)
    _exact(sheet, case)
    _state(sheet, case)
    _said(sheet, case)
    if not case.resistance_given:
        _renamed(sheet, case)
    if case.coarse:
        _comparison(sheet, case)
    sheet.headed = "A", top, FIRST_ROW - 1
    # It ends where the run of this workbook ends. A print area that is a formula, and follows a run
    # that is changed later, is not understood by every program.
    last = max(FIRST_ROW + case.steps, sheet.row - 1)
    sheet.print_area, sheet.portrait = f"A1:M{last}", True
    # The row of the title is higher. All pages but the first repeat the heads.
    sheet.most_pages = ceil((last + 0.5 - _HEADS) / (_ROWS_OF_A_PAGE - _HEADS))
    sheet.row_height = _ROW_HEIGHT
    used = f"A{FIRST_ROW}:{last_column}{FIRST_ROW + case.rows}"
    sheet.rules = [
        Rule(used, f"=ISNUMBER($A{FIRST_ROW})", "ruled"),
        Rule("I2", "=ISTEXT($I$2)", "changed"),
        *case.rules("A3"),
    ]
    return sheet


def _label(sheet: SheetPlan, case: CaseSheet) -> None:
    """Add the label of the case in I1, and in I2 what the name of the sheet does not tell."""
    s = case.suffix
    if case.resistance_given:
        label = f'=IF(inputs_from="report","{messages.AS_REPORTED}","{messages.AS_GIVEN}")'
    else:
        label = f'=IFERROR({_beta(case)},"{messages.NO_BETA}")'
        says = f"says_finer{s}&says_renamed{s}" if case.coarse else f"says_renamed{s}"
        sheet.cells["I2"] = formula(f"{case.part}.renamed", f'=IFERROR({says},"")', "message")
    sheet.cells["I1"] = formula(f"label{s}", label, "title", named=True)


def _beta(case: CaseSheet) -> str:
    """Return the expression of the text that names β.

    Programs write a number that is joined to a text with 15 or 17 digits; Gnumeric writes the
    digits of a long double, even if the number is rounded.
    """
    return f'"β = "&ROUND(beta{case.input_suffix},6)'


def _inputs(sheet: SheetPlan, case: CaseSheet) -> None:
    """Repeat the inputs of the run."""
    sheet.row = FIRST_ROW
    for key, symbol, meaning, name, unit in (
        ("radius", "R", "particle radius", "R_p", "m"),
        ("particle_density", "ρ_p", "particle density", "rho_p", "kg/m^3"),
        ("mass", "M", "particle mass", "M_p", "kg"),
        ("diameter", "D", "particle diameter", "D_p", "m"),
        ("velocity", "V", "impact velocity", "V_impact", "m/s"),
        ("resistance", "R_t", "target resistance", case.resistance, "Pa"),
        ("target_density", "ρ_t", "target density", "rho_t", "kg/m^3"),
        ("step", "Δt", "time step", case.time_step, "s"),
        ("stop_velocity", "v_stop", "stop velocity", "v_stop", "m/s"),
    ):
        key = f"{case.part}.{key}"
        sheet.repeat(key, symbol, meaning, name, unit, shown="0.0000E+00")


def _results(sheet: SheetPlan, case: CaseSheet) -> None:
    """Add the results that the report reads from the last row."""
    s, part, report = case.suffix, case.part, case.is_reports and not case.coarse
    a, b, d, f = (case.cells(column) for column in "ABDF")
    depth_claim = f"depth-beta-{case.beta}" if report else ""
    ratio_claim = f"ratio-beta-{case.beta}" if report else ""
    again = [f"discussion-ratio-beta-{case.beta}"] if report else []
    from_appendix = "" if report else "Appendix"
    # Without any row, or without a stop, all that follows is #N/A.
    sheet.row += 1
    sheet.block("Result of the sheet")
    sheet.line(
        f"rows_used{s}", "", "rows in use, with row 0", f"=IF(COUNT({a})>0,COUNT({a}),NA())",
        shown="0",
    )  # fmt: skip
    # Without a stop, what is said of a whole run is not available.
    of_a_run = [name for name in messages.RUN_SAYS if name not in ("both", "rows")]
    chain = "&".join(f"says_{name}{s}" for name in of_a_run)
    says = formula(f"says_run{s}", f'=IF(stopped{s}=1,{chain},"")', "text", named=True)
    sheet.cells[f"N{sheet.row}"] = says
    sheet.line(
        f"stopped{s}", "", "the rows reach the stop",
        f"=IF(INDEX({f},rows_used{s})<v_stop,1,0)", shown=YES_OR_NO,
    )  # fmt: skip
    sheet.line(
        f"final_depth{s}", "X", "final penetration depth",
        f"=IF(stopped{s}=1,INDEX({d},rows_used{s}),NA())", "m",
        source="Appendix", shown="0.0000E+00", like=f"{part}.depth",
    )  # fmt: skip
    sheet.line(
        f"depth_um{s}", "X", "the same", f"=final_depth{s}*1000000", "um",
        claim=depth_claim, source=from_appendix, like=f"{part}.depth_um",
    )  # fmt: skip
    sheet.line(
        f"normalized_depth{s}", "X/R", "normalized depth", f"=final_depth{s}/R_p",
        claim=ratio_claim, also=again, source=from_appendix,
    )  # fmt: skip
    sheet.line(
        f"steps{s}", "", "steps taken", f"=IF(stopped{s}=1,rows_used{s}-1,NA())",
        source="Appendix", shown="0",
    )  # fmt: skip
    sheet.line(
        f"stop_time{s}", "t", "time of the final row",
        f"=IF(stopped{s}=1,INDEX({b},rows_used{s}),NA())", "s",
        source="Appendix", shown="0.0000E+00",
    )  # fmt: skip
    sheet.line(
        f"final_velocity{s}", "v", "velocity that ends it",
        f"=IF(steps{s}>0,INDEX({f},rows_used{s}),V_impact)", "m/s",
        source="Appendix", like=f"{part}.velocity",
    )  # fmt: skip
    # The report compares the final depth for beta = 5 with the observed one.
    its_own = report and case.beta == "5"
    sheet.line(
        f"excess{s}", "", "X/R over the observed X/R", f"=normalized_depth{s}/observed_ratio",
        claim="excess" if its_own else "", beside="excess", shown="0.00",
    )  # fmt: skip


def _exact(sheet: SheetPlan, case: CaseSheet) -> None:
    """Add the depth without time steps: at rest, and at the stop velocity."""
    s, resistance = case.suffix, case.resistance
    sheet.row += 1
    sheet.block("Without time steps: Eqs. 12 and 13 integrated to rest")
    sheet.line(
        f"p_rest{s}", "p", "dynamic pressure over R_t",
        f"=rho_t*V_impact*V_impact/2/{resistance}", source="ρ_t V²/2R_t", shown="0.0000E+00",
    )  # fmt: skip
    lines_of_depth(sheet, f"rest{s}", " at rest")
    sheet.line(
        f"X_rest{s}", "X", "penetration depth at rest", f"=X_R_rest{s}*R_p*1000000", "um",
        source="R times the line above",
    )  # fmt: skip
    sheet.row += 1
    sheet.block("The same down to v_stop")
    sheet.line(
        f"p_stop{s}", "p", "pressure lost, over R_t and that left",
        "=IF(v_stop<V_impact,rho_t*(V_impact-v_stop)*(V_impact+v_stop)"
        f"/(2*{resistance}+rho_t*v_stop*v_stop),0)",
        source="ρ_t (V² - v²)/(2R_t + ρ_t v²)", shown="0.0000E+00",
    )  # fmt: skip
    lines_of_depth(sheet, f"stop{s}", " at v_stop")
    sheet.line(
        f"stop_share{s}", "", "depth at v_stop over that at rest", f"=X_R_stop{s}/X_R_rest{s}"
    )


def lines_of_depth(sheet: SheetPlan, end: str, where: str = "") -> None:
    """Add the normalized depth of a pressure over R_t, which has the name `p_` and then `end`.

    So go on the two blocks above, and one of the sheet `Solve`; `where` says of which depth.
    """
    sheet.line(
        f"ln_{end}", "ln(1 + p)", "right for slow impacts, too", log1p(f"p_{end}"),
        shown="0.0000E+00",
    )  # fmt: skip
    sheet.line(
        f"c_{end}", "c", "work over the particle’s inertia", f"=4*rho_p/(3*rho_t)*ln_{end}",
        source="(4ρ_p/3ρ_t) ln(1 + p)", shown="0.0000E+00",
    )  # fmt: skip
    sheet.line(
        f"h_{end}", "h", "angle of the depth", cap_angle(f"c_{end}"),
        source="asin(√(3c)/2)/3, c at most 2/3",
    )  # fmt: skip
    sheet.line(
        f"X_R_{end}", "X/R", f"normalized depth{where}", depth(f"c_{end}", f"h_{end}"),
        source="root of y² - y³/3 = c, or 1/3 + c",
    )  # fmt: skip


def _state(sheet: SheetPlan, case: CaseSheet) -> None:
    """Add what tells whether the run can be trusted, one condition in each line."""
    s = case.suffix
    sheet.row += 1
    sheet.block("Can the run be trusted?")
    sheet.line(
        f"travel{s}", "Δt V/R", "radii passed in one step at V", f"={case.time_step}*V_impact/R_p"
    )
    sheet.line(
        f"too_long{s}", "", "the time step is too long",
        # By more than the rounding of decimal inputs.
        f"=IF(travel{s}>travel_most*(1+same_within),1,0)",
        source="Δt V/R above travel_most", shown=YES_OR_NO,
    )  # fmt: skip
    sheet.line(
        f"over_rest{s}", "", "depth over the depth at rest", f"=normalized_depth{s}/X_R_rest{s}"
    )
    sheet.line(
        f"too_deep{s}", "", "deeper than at rest", f"=IF(over_rest{s}>1+excess_most,1,0)",
        source="above 1 + excess_most", shown=YES_OR_NO,
    )  # fmt: skip
    sheet.line(
        f"over_stop{s}", "", "depth over the depth at v_stop",
        f"=IF(X_R_stop{s}>0,normalized_depth{s}/X_R_stop{s},NA())",
    )  # fmt: skip
    sheet.line(
        f"off_stop{s}", "", "off the depth at v_stop",
        f"=IF(ABS(normalized_depth{s}-X_R_stop{s})>off_stop_most*X_R_stop{s},1,0)",
        source="beyond 1 ± off_stop_most", shown=YES_OR_NO,
    )  # fmt: skip
    sheet.line(
        f"doubts{s}", "", "reasons not to trust it",
        f"=too_long{s}+too_deep{s}+off_stop{s}+is_no_steps{s}", shown="0",
    )  # fmt: skip
    sheet.line(f"sound{s}", "", "no reason against it", f"=IF(doubts{s}>0,0,1)", shown=YES_OR_NO)
    sheet.line(
        f"reverses{s}", "", "the last step reverses the velocity",
        f"=IF(final_velocity{s}<-v_stop,1,0)", source="faster than v_stop", shown=YES_OR_NO,
    )  # fmt: skip
    sheet.line(
        f"early{s}", "", "v_stop ends it before rest", f"=IF(stop_share{s}<1-excess_most,1,0)",
        source="share below 1 - excess_most", shown=YES_OR_NO,
    )  # fmt: skip
    sheet.line(
        f"trust{s}", "", "it can be trusted", f"=IFERROR(sound{s},0)", shown=YES_OR_NO,
    )  # fmt: skip


def _said(sheet: SheetPlan, case: CaseSheet) -> None:
    """Add the states of which one holds, each with what A3 says of it.

    Without a stop, only the first two have values. Programs differ in AND(0=1,#N/A), so the first
    condition of an AND is always one that is #N/A if any of them is.
    """
    s = case.suffix
    sheet.row += 1
    sheet.block("Which one of these does A3 say?")

    def state(name: str, meaning: str, expression: str) -> None:
        sheet.state(f"{name}{s}", meaning, expression, messages.RUN_SAYS[name])

    state("both", "out of rows; step too long", f"=IF(AND(stopped{s}=0,too_long{s}=1),1,0)")
    state("rows", "out of rows", f"=IF(AND(stopped{s}=0,too_long{s}=0),1,0)")
    state("no_steps", "no step is taken", f"=IF(steps{s}=0,1,0)")
    state("one_step", "doubtful: a single step", f"=IF(AND(steps{s}=1,sound{s}=0),1,0)")
    doubtful, sound = f"steps{s}>1,sound{s}=0", f"sound{s}=1"
    state("coarse", "doubtful: time step too long", f"=IF(AND({doubtful},too_long{s}=1),1,0)")
    state("off", "doubtful: depth is off", f"=IF(AND({doubtful},too_long{s}=0),1,0)")
    state("reversed", "sound; velocity reversed", f"=IF(AND({sound},reverses{s}=1),1,0)")
    not_reversed = f"{sound},reverses{s}=0"
    state("early", "sound; ends before rest", f"=IF(AND({not_reversed},early{s}=1),1,0)")
    state("done", "sound; complete", f"=IF(AND({not_reversed},early{s}=0),1,0)")


def _renamed(sheet: SheetPlan, case: CaseSheet) -> None:
    """Add whether β is still the one that gave the sheet its name, and what I2 says of it."""
    s = case.suffix
    sheet.row += 1
    sheet.block("Is β the one of the sheet’s name?")
    is_another = f'=IF({_beta(case)}="{case.label}",0,1)'
    sheet.line(f"other_beta{s}", "", "β is another one", is_another, shown=YES_OR_NO)
    # That its time step is not longer matters more. No AND: either of the two may be #N/A alone.
    renamed = f"=IF(longer{s}=1,other_beta{s},0)" if case.coarse else f"=other_beta{s}"
    sheet.state(f"renamed{s}", "I2 says so", renamed, messages.KEEPS_NAME)


def _comparison(sheet: SheetPlan, case: CaseSheet) -> None:
    """Compare the final depth with that of the sheet with the shorter time step."""
    s, fine = case.suffix, f"depth_um{case.input_suffix}"
    sheet.row += 1
    sheet.block("Against the sheet with the step dt_s")
    longer = "=IF(dt_coarse>dt_s,1,0)"
    sheet.line(f"longer{s}", "", "its time step is longer", longer, shown=YES_OR_NO)
    sheet.state(f"finer{s}", "it is not; I2 says so", f"=IF(longer{s}=0,1,0)", messages.NOT_COARSER)
    sheet.line(
        f"fine_depth_um{s}", "X", "final depth with dt_s", f"={fine}", "um",
        beside=f"depth-beta-{case.beta}" if case.is_reports else "",
    )  # fmt: skip
    sheet.line(
        f"over_fine{s}", "", "depth of this sheet over that",
        f"=IF({fine}>0,depth_um{s}/{fine},NA())", beside="coarse-step-remark", shown="0.00%",
    )  # fmt: skip

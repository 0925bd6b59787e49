"""The sheets of a case: the scheme row by row to the stop, its result, and the report's Table A-1.

Below the stop follow rows that stay blank until an input needs them. If even they do not suffice,
the sheet says so instead of giving a depth; if the time step is too long for the motion, too.
"""

from dataclasses import dataclass

from reference.ledger import Claim, Ledger
from reference.units import written
from spreadsheets.plan import (
    HOME,
    NOT_COMPUTED,
    Cell,
    Line,
    Rule,
    SheetPlan,
    formula,
    lines_of,
    log1p,
    printed,
    recorded,
    tables,
    text,
    unit_text,
)

FIRST_ROW = 10
"""Row 0 of the scheme, the impact itself, stands in this row of the sheet."""

MAX_ROWS = 20_000
"""A sheet of more rows is refused: writing it takes half a minute and gigabytes of memory."""

SPARE_ROWS = 100
"""At least so many rows stay blank after the stop, for inputs that need more steps."""

SCHEMES = {
    "published": "the drag is taken at the velocity with which a row begins",
    "centered": "the drag is taken at the velocity in the middle of a row",
}
"""The two readings of the appendix, and what each does."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseSheet:
    """One case: what its sheet is called, how long it is, and what of the report is its own.

    slug: "low" or "high" where two cases stand side by side, "case" where one is alone; its keys
    and defined names carry it. label: what tells it from the other, as written ("β = 5"). steps,
    rows: those in use and those prepared, after row 0. beta: the beta, "3" or "5", of the report's
    case beside which it stands. is_reports: it is that case. resistance_given: the target
    resistance is an input and not the product of beta and the flow stress. coarse: with the step
    `dt_coarse`.
    """

    name: str
    slug: str
    label: str
    scheme: str
    beta: str
    is_reports: bool
    resistance_given: bool
    steps: int = 0
    rows: int = 0
    coarse: bool = False

    def claim(self, what: str) -> str:
        """Where the report prints the "depth" or "ratio" of this case, if it is the report's."""
        return f"{what}-beta-{self.beta}" if self.is_reports else ""

    def named(self, symbol: str) -> str:
        """The defined name of this case's `symbol`: R_t_low beside R_t_high, or R_t alone."""
        return symbol if self.slug == "case" else f"{symbol}_{self.slug}"

    @property
    def part(self) -> str:
        """What the keys of its sheet begin with: "low", or "low_coarse"."""
        return f"{self.slug}_coarse" if self.coarse else self.slug

    def result(self, what: str) -> str:
        """The defined name of a result of its sheet: depth_um_low, or depth_um_low_coarse."""
        return f"{self.named(what)}_coarse" if self.coarse else self.named(what)

    def rules(self, cells: str) -> list[Rule]:
        """How cells look that say whether the run can be trusted."""
        return [
            Rule(cells, f"={self.result('trust')}={state}", style)
            for state, style in ((0, "warning"), (1, "changed"))
        ]

    @property
    def step_name(self) -> str:
        """The defined name of its time step."""
        return "dt_coarse" if self.coarse else "dt_s"

    @property
    def last_row(self) -> int:
        """The last prepared row of its sheet."""
        return FIRST_ROW + self.rows


def prepared_rows(steps: int, wanted: int | None = None) -> int:
    """Rows to prepare for so many steps: as wanted, or twice as many, in full hundreds.

    Raises ValueError where that is too few for the steps or more than `MAX_ROWS`.

    >>> prepared_rows(178), prepared_rows(3), prepared_rows(178, 1000)
    (400, 200, 1000)
    """
    if steps > MAX_ROWS:
        raise ValueError(
            f"the workbook would need {steps:,} rows, more than {MAX_ROWS:,}: take a larger step"
        )
    if wanted is None:
        return min(-(-max(2 * steps, steps + SPARE_ROWS) // 100) * 100, MAX_ROWS)
    if not max(steps, 1) <= wanted <= MAX_ROWS:
        raise ValueError(f"{wanted:,} rows will not do: give {steps:,} to {MAX_ROWS:,}")
    return wanted


_WIDTHS = {"I": 8.0, "J": 33.0, "K": 13.0, "L": 7.0, "M": 24.0, "N": 26.0}


def sheet(ledger: Ledger, case: CaseSheet) -> SheetPlan:
    """The sheet of one case."""
    columns = "ABCDEFGH" if case.scheme == "centered" else "ABCDEFG"
    widths = {"A": 5.0, **dict.fromkeys("BCDEF", 11.0), "G": 8.0, **_WIDTHS}
    page = SheetPlan(name=case.name, widths={**widths, "H": 13.0 if "H" in columns else 3.0})
    _head(page, case, columns)
    page.row = FIRST_ROW - 2
    page.lines(ledger, case.part, _results(case), "IJKLMN")
    last = max(FIRST_ROW + case.steps, page.row - 1)
    for step in range(case.rows + 1):
        page.cells |= _row(step, case)
    used = f"A{FIRST_ROW}:{columns[-1]}{case.last_row}"
    page.frozen, page.repeated_rows = f"A{FIRST_ROW}", (FIRST_ROW - 2, FIRST_ROW - 1)
    page.print_area = f"A1:M{last}"
    page.rules = [
        Rule(used, f"=ISNUMBER($A{FIRST_ROW})", "ruled"),
        Rule("I2", "=ISTEXT($I$2)", "changed"),
        *case.rules("A3"),
    ]
    return page


def _head(page: SheetPlan, case: CaseSheet, columns: str) -> None:
    """The title with the live β, the state of the run, notes, and the heads of the columns."""
    page.title("Rigid-body penetration, row by row")
    state = formula(f"{case.part}.message", _message(case), "message", name=case.result("message"))
    page.put(A=state)
    page.say(
        "Row 1 takes x = v Δt/2 (half a step), every later row x + v Δt. d²x/dt² is printed "
        f"positive; {SCHEMES[case.scheme]} (scheme: {case.scheme}). Appendix, Eqs. 13, A-1 to A-3.",
        "The run stops with the first row below v_stop; printed pages end with the last row as "
        f"written. {case.rows} rows are prepared; coldspray workbook prepares N, up to {MAX_ROWS}, "
        "with the same options and --rows N.",
        width=205,
    )
    page.cells["I1"] = text(case.label, "title")
    if not case.resistance_given:
        beta = case.named("beta")
        # Programs join a number to a text with 15 digits or 17; Gnumeric, even a rounded one, with
        # those of a long double.
        label = f'="β = "&IF(ISNUMBER({beta}),ROUND({beta},6),{beta})'
        renamed = f'=IF(ISNUMBER({beta}),IF(I1="{case.label}","","{KEPT_NAME}"),"")'
        page.cells["I1"] = formula(f"{case.part}.label", label, "title")
        page.cells["I2"] = formula(f"{case.part}.renamed", renamed, "message")
    page.row = FIRST_ROW - 2
    rows = [tables()["rows"][column] for column in columns]
    units = [written(row["unit"]) or None for row in rows]
    page.heads(columns, [row["head"] for row in rows], columns, units)


def step_formulas(
    row: int, first: bool, counted: str, resistance: str, step: str, middle: str = ""
) -> dict[str, str]:
    """The formulas of one time step, by column (appendix, Eqs. A-1 to A-3, both cases of Eq. 13).

    Columns C to F hold dx/dt initial, x, d²x/dt² and dx/dt final; `first` marks the row after row
    0, with its half step. counted: what stands in column A until the stop. resistance, step: names
    of R_t and the time step. middle: the centered scheme's column of the velocity in mid-row. The
    order of the operations is fixed: it decides the last digit.
    """
    above = row - 1
    reached = f"C{above}" if first else f"F{above}"
    v, x, a = f"C{row}", f"D{row}", f"E{row}"
    area = f"IF({x}<R_p,D_p*{x}-{x}*{x},R_p*R_p)"

    def deceleration(velocity: str) -> str:
        return f"(0.5*rho_t*{velocity}*{velocity}+{resistance})*pi_*{area}/M_p"

    formulas = {
        "C": reached,
        "D": f"{v}*({step}/2)" if first else f"D{above}+{v}*{step}",
        "E": deceleration(f"{middle}{row}" if middle else v),
        "F": f"{v}-{a}*{step}",
    }
    if middle:
        formulas[middle] = f"{v}-{deceleration(v)}*({step}/2)"
    going = f'=IF(ISNUMBER(A{above}),IF({reached}<v_stop,"",{counted}),"")'
    return {"A": going} | {column: where_running(row, text) for column, text in formulas.items()}


def where_running(row: int, expression: str) -> str:
    """A formula of a row, blank below the stop.

    A test for "" instead of a number fails in two spreadsheet programs.
    """
    return f'=IF(ISNUMBER(A{row}),{expression},"")'


def _row(step: int, case: CaseSheet) -> dict[str, Cell]:
    """One row of the sheet; row 0 is the impact itself, with no final velocity."""
    row, dt, resistance = FIRST_ROW + step, case.step_name, case.named("R_t")
    if step:
        middle = "H" if case.scheme == "centered" else ""
        formulas = step_formulas(row, step == 1, f"A{row - 1}+1", resistance, dt, middle)
    else:
        needed = ("V_impact", "R_p", "rho_p", "rho_t", resistance, dt, "v_stop", "M_p")
        formulas = {"A": f'=IF(COUNT({",".join(needed)})={len(needed)},0,"")'}
        starts = {"C": "V_impact", "D": "0", "E": "0"}
        formulas |= {column: where_running(row, text) for column, text in starts.items()}
    formulas["B"] = where_running(row, f"A{row}*{dt}" if step else "0")
    formulas["G"] = where_running(row, f"D{row}*1000000")
    cells = {}
    for column, expression in formulas.items():
        shown = tables()["rows"][column]
        cells[f"{column}{row}"] = formula(
            f"{case.part}.row[{step}].{shown['key']}",
            expression,
            number_format=shown["shown"] if step or column == "C" else "General",
            unit=shown["unit"],
            column=shown["column"] and f"{case.part}.{shown['column']}",
        )
    return cells


# The block beside the rows

KEPT_NAME = "The sheet keeps the name with which it was written."
COMPLETE = "Complete: the velocity is below v_stop."
REVERSED = "Complete, but the last step reverses the velocity."
DOUBTFUL = "DO NOT TRUST THIS RUN: the time step is too long."
NO_STEPS = "NO STEPS: the impact velocity is below v_stop."
OUT_OF_ROWS = "OUT OF ROWS: the rows end before the particle stops."
INVALID = "NOT COMPUTED: an input cannot be used, see Inputs."
"""What is said of a run: `Overview` prints at most 60 letters, some of them for β."""


def _message(case: CaseSheet) -> str:
    stopped, steps, trust = (case.result(what) for what in ("stopped", "steps", "trust"))
    run = f'IF({trust}=2,"{COMPLETE}",IF({trust}=1,"{REVERSED}","{DOUBTFUL}"))'
    run = f'IF({stopped}=1,IF({steps}=0,"{NO_STEPS}",{run}),"{OUT_OF_ROWS}")'
    return f'=IF(ISNUMBER({stopped}),{run},"{INVALID}")'


_RESULTS = (
    "stopped", "final_depth", "depth_um", "normalized_depth", "steps", "stop_time",
    "final_velocity", "exact_depth_um", "trust",
)  # fmt: skip
"""The lines with defined names."""


def _results(case: CaseSheet) -> list[Line | str]:
    """The lines of the block, from `sheets.toml`."""
    own = case.is_reports and not case.coarse
    work, rest = rest_depth("{pressure}", "{c}")
    words = {
        **{name: case.result(name) for name in _RESULTS},
        **{column: f"{column}{FIRST_ROW}:{column}{case.last_row}" for column in "ABDF"},
        "part": case.part,
        "first": f"A{FIRST_ROW}",
        "R_t": case.named("R_t"),
        "step": case.step_name,
        "work": work,
        "rest": rest,
        "depth_claim": case.claim("depth") if own else "",
        "ratio_claim": case.claim("ratio") if own else "",
        "unclaimed": "" if own else "Appendix",
        "fine": case.named("depth_um"),
        "fine_claim": case.claim("depth"),
    }
    return lines_of("case", words) + (lines_of("coarse", words) if case.coarse else [])


def rest_depth(pressure: str, c: str) -> tuple[str, str]:
    """The formulas of c from the cell of rho_t V²/2R_t, and of X/R at rest from the cell of c."""
    angle = f"ASIN(SQRT(3*{c})/2)/3"
    shallow = f"4*SIN({angle})*SIN({angle}+pi_/3)"
    return f"=4*rho_p/(3*rho_t)*{log1p(pressure)}", f"=IF({c}<=2/3,{shallow},1/3+{c})"


# Table A-1: the report has it cell for cell in A1:F12; every number format gives the text that the
# report prints, 6E-10 in General included. From column H on stands the printed text itself.

TABLE_ROWS = 5
"""Rows of the table, row 0 (the impact itself) included."""

_FIRST = 8


def _claims(ledger: Ledger) -> dict[str, Claim]:
    """Address in the table -> the claim that is printed there."""
    return {claim.place.cell: claim for claim in ledger.claims.values() if claim.place.cell}


def table_a1(ledger: Ledger, case: CaseSheet, report: bool) -> SheetPlan:
    """The table for a case: the report's is the one of beta = 5.

    report: with the printed text beside it, in columns H to M.
    """
    claims, resistance, centered = _claims(ledger), case.named("R_t"), case.scheme == "centered"
    columns = "ABCDEFG" if centered else "ABCDEF"
    widths = dict.fromkeys("ABCDEFGHIJKLM", 13.0) | ({} if centered else {"G": 4.0})
    page = SheetPlan(name="Table A-1", widths=widths)
    cells = page.cells

    def live(address: str, what: str, expression: str) -> None:
        """A cell in the unit of what is printed there, and as it is: "6E-10" or "2.00E-10"."""
        claim = claims.get(address)
        shown = "0.00E+00" if claim is None or "." in claim.text else "General"
        unit = "m/s" if claim is None else claim.unit
        cells[address] = formula(f"table.{what}", expression, number_format=shown, unit=unit)

    above, heads = tables()["table_a1"]["above"], tables()["table_a1"]["columns"]
    for row, (label, (what, symbol)) in enumerate(above.items(), start=1):
        cells[f"A{row}"] = text(label)
        live(f"B{row}", what, f"={resistance if symbol == 'R_t' else symbol}")
    for column in columns:
        head = heads[column]["head"]
        cells[f"{column}{_FIRST - 1}"] = text(head, "head" if column in "AB" else "head right")
    for step in range(TABLE_ROWS):
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
            live(f"{column}{row}", f"row[{step}].{heads[column]['key']}", expression)
    if report:
        cells |= _as_printed(ledger, claims)
    page.row = 14
    page.say(
        f"Table A-1, rigid body penetration. Columns A to {columns[-1]} are live, "
        f"with the inputs of {case.name}."
        + (" Columns H to M are the report’s text." if report else ""),
        "M is Eq. 3 times the density, Rt is Eqs. 7 and A-2, d²x/dt² is Eqs. 13, A-1 and A-3.",
    )
    cells["A18"] = text(f"Back to {HOME}", "link", link=(HOME, "A1"))
    return page


def _as_printed(ledger: Ledger, claims: dict[str, Claim]) -> dict[str, Cell]:
    """The table as the report prints it, in columns H to M."""
    shifted = dict(zip("ABCDEF", "HIJKLM", strict=True))
    table = tables()["table_a1"]
    cells = {f"H{row}": text(label, "unit") for row, label in enumerate(table["above"], start=1)}
    for column, there in shifted.items():
        if head := table["columns"][column]["head"]:
            cells[f"{there}{_FIRST - 1}"] = text(head, "unit right")
    for address, claim in claims.items():
        cells[f"{shifted[address[0]]}{address[1:]}"] = printed(ledger, claim.id, claim.unit)
    return cells


DIGITS = 4
"""Decimals kept of a difference, so that 0 is 0: 3 times 0.2 ns is not 0.6 ns to the last bit."""

SAME_TEXT, OTHER_TEXT = "prints the same", "prints otherwise"


def table_a1_check(ledger: Ledger, table: SheetPlan) -> SheetPlan:
    """Each number of the table as printed and as computed, for the sheet `Table A-1`."""
    page = SheetPlan(name="Table A-1 check")
    page.title("Table A-1: printed and computed")
    page.say(
        "Computed: the live cell of the sheet Table A-1, with all its digits. Difference: computed "
        "minus printed, in units of the last printed digit; up to 0.5 it prints the same."
    )
    page.row = 6
    page.table("table_a1_check", "DEFH", "B")
    first = page.row
    for address, claim in _claims(ledger).items():
        page.put(**_check(claim, address, page.row, table))
    verdicts = f"G{first}:G{page.row - 1}"
    page.color(verdicts, {SAME_TEXT: "good", OTHER_TEXT: "warning"})
    return page


def _check(claim: Claim, address: str, row: int, table: SheetPlan) -> dict[str, Cell]:
    assert claim.printed is not None
    key, there = f"table_check.{address}", f"='{table.name}'!{address}"
    difference, same = f"ROUND((E{row}-D{row})/H{row},{DIGITS})", f"ABS(F{row})<=0.5"
    if claim.is_exact:
        difference, same = f"E{row}-D{row}", f"F{row}=0"
    verdict = f'IF({same},"{SAME_TEXT}","{OTHER_TEXT}")'
    cells = (
        text(address, "link", link=(table.name, address)),
        text(claim.title),
        unit_text(claim.unit),
        recorded(
            float(claim.printed.value), claim=claim.id,
            number_format=table.cells[address].number_format,
        ),
        formula(
            f"{key}.computed", there, number_format="0.0000000000000000E+00", unit=claim.unit
        ),
        # Rounding is done by each program in its own way: it may cost a last digit.
        formula(
            f"{key}.difference", f'=IF(ISNUMBER(E{row}),{difference},"–")', "result",
            number_format="0.0000", transcendental=True,
        ),
        formula(f"{key}.verdict", f'=IF(ISNUMBER(E{row}),{verdict},"{NOT_COMPUTED}")', "text"),
        recorded(float(claim.printed.quantum), number_format="0E+00"),
    )  # fmt: skip
    return dict(zip("ABCDEFGH", cells, strict=True))

"""Plans of the sheets `Inputs` and `Table A-1`, and of the sheet of each case.

`Inputs` has every physical number, typed into a yellow cell in the report's unit. Beside each stand
the value in use in SI units, the report's value, and the limits within which a number is accepted.
The sheet of a case has its rows down to the stop, and its results. Rows below the stop stay blank
until changed inputs need them. The sheet says so if there are too few rows, or if the time step is
too long for the motion.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

from reference.ledger import INFERRED, Claim, Ledger
from reference.units import to_si
from spreadsheets.plan import (
    FIRST_ROW,
    HOME,
    TABLES,
    Cell,
    Rule,
    SheetPlan,
    filled,
    filled_in,
    formula,
    printed,
    recorded,
    row_formulas,
    unit_text,
)

MAX_ROWS = 20_000
"""The most rows of a sheet; to write them takes half a minute and gigabytes of memory."""

SCHEMES = {
    "published": "the drag is taken at the velocity with which a row begins",
    "centered": "the drag is taken at the velocity in the middle of a row",
}
"""The two readings of the appendix, and what distinguishes them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseSheet:
    """The sheet of one case: its name, its length, and how the case relates to the report.

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
    scheme: str
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

    def rules(self, cells: str) -> list[Rule]:
        """Return the rules by which cells show in color whether the run can be trusted."""
        trust = f"=trust{self.suffix}="
        return [Rule(cells, f"{trust}0", "warning"), Rule(cells, f"{trust}1", "changed")]

    @property
    def words(self) -> dict[str, str]:
        """The names, cells and claims that replace the words in braces in `sheets.toml`."""
        depth, ratio = (f"{kind}-beta-{self.beta}" for kind in ("depth", "ratio"))
        claimed = self.is_reports and not self.coarse
        return {
            "slug": self.slug, "part": self.part, "sheet": self.name, "label": self.label,
            "beta": self.beta, "input_suffix": self.input_suffix, "suffix": self.suffix,
            "dt": "dt_coarse" if self.coarse else "dt_s",
            "not_longer": "IF(ISNUMBER(dt_s),dt_coarse<=dt_s,1=0)" if self.coarse else "1=0",
            **{column: f"{column}{FIRST_ROW}:{column}{FIRST_ROW + self.rows}" for column in "ABDF"},
            "first": f"A{FIRST_ROW}",
            "depth_claim": depth if claimed else "",
            "ratio_claim": ratio if claimed else "",
            "unclaimed": "" if claimed else "Appendix",
            "fine_claim": depth if self.is_reports else "",
            "resistance_claim": "a1-resistance" if self.slug == "high" else "",
        }  # fmt: skip


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


class Input(NamedTuple):
    """A number to be typed in: its defined name, symbol, unit, and least and greatest value.

    source: the claim that prints it, or an inferred input. attribute: the attribute of an impact
    that it gives, if it belongs to a case. unit_in_use, factor: the unit of the value in use, if it
    is another, and the operation that converts to it, such as "/1000000".
    """

    name: str
    symbol: str
    source: str
    unit: str
    limits: tuple[float, float]
    meaning: str = ""
    attribute: str = ""
    unit_in_use: str = ""
    factor: str = ""

    def of_report(self, ledger: Ledger) -> float:
        """Return the report's number in this unit."""
        return float(ledger.value(self.source) / to_si(self.unit))


def inputs_of(cases: Sequence[CaseSheet], report: bool) -> dict[str, list[Input]]:
    """Return the inputs of a workbook of these cases, by block.

    report: whether it is the report's own workbook.
    """
    left_out = {"Y_t", "beta{input_suffix}"} if cases[0].resistance_given else {"R_t"}
    left_out |= set() if report else {"dt_coarse"}
    blocks: dict[str, list[Input]] = {}
    for block, entries in TABLES["inputs"].items():
        named: dict[str, Input] = {}
        for case, (name, entry) in product(cases, entries.items()):
            if name not in left_out:
                fields = {"name": name, "unit": "1", **entry}
                fields = filled_in(TABLES["units"][fields["unit"]] | fields, case.words)
                fields["limits"] = tuple(fields["limits"])
                named[fields["name"]] = Input(**fields)
        blocks[block] = [*named.values()]
    return blocks


def inputs_sheet(ledger: Ledger, cases: Sequence[CaseSheet], report: bool) -> SheetPlan:
    """Plan the sheet `Inputs` for these cases, which share all inputs but the target resistance."""
    page = SheetPlan.begun("Inputs")
    page.row = 9
    page.table("CFHIKL", "C")
    first = page.row
    for block, inputs in inputs_of(cases, report).items():
        page.put(A=Cell(block, "block"))
        for typed in inputs:
            page.put(**_input(ledger, typed, page.row))
        page.row += 1
    page.put(A=Cell("What follows from them", "block"))
    derived = dict(TABLES["derived"])
    if cases[0].resistance_given:
        del derived["target"]
    first_derived, words = page.row, [case.words for case in cases]
    page.lines(ledger, "inputs", derived, words, "ABFGIJ", headed=False)
    for row in range(first_derived, page.row):
        in_use = page.cells[f"F{row}"]
        page.cells[f"E{row}"] = _check(in_use, row, '""', named=bool(in_use.name))
    page.row += 1
    page.put(A=Cell("Constants", "block"), H=Cell("as written", "recorded"))
    for name, entry in TABLES["constants"].items():
        key, unit, name_text = f"inputs.{name}", entry["unit"], Cell(name, "unit")
        check = f'=IF(F{page.row}=H{page.row},"","typed over")'
        page.put(
            B=Cell(entry["meaning"]),
            E=formula(f"{key}.check", check, "text"),
            F=recorded(key, name=name, unit=unit),
            G=unit_text(unit),
            H=recorded(f"{key}.written"),
            J=name_text,
            M=name_text,
        )
    checks = f"E{first}:E{page.row}"
    page.single_cells(checks=checks)
    page.print_area = f"A1:J{page.row - 1}"
    faults = "too small", "too large", "no number", "typed over"
    faulty = ",".join(f'$E{first}="{fault}"' for fault in faults)
    page.rules = [
        Rule(checks, f"=OR({faulty})", "warning"),
        Rule(checks, f'=$E{first}="yours"', "changed"),
        Rule("A7", "=inputs_unusable>0", "warning"),
    ]
    return page


def _check(in_use: Cell, row: int, unless_overtyped: str, named: bool) -> Cell:
    """Return the check in column E: "typed over" if column F no longer holds its formula's value.

    unless_overtyped: the formula, without "=", of what is shown otherwise. named: whether the check
    has a defined name, by which the sheets of the cases refer to it.
    """
    check = f'=IF(F{row}={in_use.formula[1:]},{unless_overtyped},"typed over")'
    name = f"{in_use.name}_check" if named else ""
    return formula(f"{in_use.key}.check", check, "text", name=name)


def _input(ledger: Ledger, entry: Input, row: int) -> dict[str, Cell]:
    """Return the cells of an input's row."""
    key, unit = f"inputs.{entry.name}", entry.unit_in_use or entry.unit
    if entry.source.startswith(INFERRED):
        style, same, place = "inferred", "as inferred", "inferred from Table A-1"
        prints = Cell("nowhere", "recorded")
    else:
        style, same, place = "input", "the report’s", str(ledger.claims[entry.source].place)
        prints = printed(ledger, entry.source, entry.unit)
    texts = filled_in(TABLES["input"], {"row": row, "factor": entry.factor, "same": same})
    shown = "0.0####E+00" if entry.factor else "General"
    in_use = formula(key, texts["in_use"], name=entry.name, unit=unit, shown=shown)
    return {
        "A": Cell(entry.symbol, "text"),
        "B": Cell(entry.meaning or ledger.title(entry.source)),
        "C": Cell(key=f"{key}.typed", style=style, unit=entry.unit, limits=entry.limits),
        "D": unit_text(entry.unit),
        "E": _check(in_use, row, texts["check"], named=entry.attribute == "resistance"),
        "F": in_use,
        "G": unit_text(unit),
        "H": recorded(entry.of_report(ledger)),
        "I": prints,
        "J": Cell(place, "unit"),
        "K": recorded(entry.limits[0]),
        "L": recorded(entry.limits[1]),
        "M": Cell(entry.name, "unit"),
    }


def case_sheet(ledger: Ledger, case: CaseSheet) -> SheetPlan:
    """Plan the sheet of one case: title with the live β, state of the run, notes, rows, results."""
    centered, top = case.scheme == "centered", FIRST_ROW - 2
    columns = dict(TABLES["rows"])
    if not centered:
        del columns["H"]
    page = SheetPlan.begun(
        "of a case", case.name,
        scheme=case.scheme, drag=SCHEMES[case.scheme], rows=case.rows, most=MAX_ROWS,
    )  # fmt: skip
    if case.coarse:
        page.entry = {**page.entry, "shows": page.entry["shows_coarse"]}
    page.widths = {**page.widths, "H": 13.0 if centered else page.widths["H"]}
    page.single_cells(**case.words)
    if case.resistance_given:
        label = filled(page.entry["label_given"], {})
        page.cells["I1"] = formula(f"{case.part}.label", label, "title")
        del page.cells["I2"]
    page.row = top
    words = case.words | {"drag": "H" if centered else "C"}
    page.grid(columns, f"{case.part}.row", words, case.rows + 1)
    page.row = top
    results = TABLES["case"] | (TABLES["coarse"] if case.coarse else {})
    page.lines(ledger, case.part, results, [case.words], "IJKLMN")
    page.headed = "A", top, top + 1
    page.print_area = f"A1:M{max(FIRST_ROW + case.steps, page.row - 1)}"
    used = f"A{FIRST_ROW}:{max(columns)}{FIRST_ROW + case.rows}"
    page.rules = [
        Rule(used, f"=ISNUMBER($A{FIRST_ROW})", "ruled"),
        Rule("I2", "=ISTEXT($I$2)", "changed"),
        *case.rules("A3"),
    ]
    return page


# Table A-1 has the report's table in the same cells, A1:F12. Each number format gives the text that
# the report prints; "6E-10" needs General. The printed texts themselves stand from column H on.

TABLE_ROWS = 5
"""Number of rows, including row 0, the impact itself."""

ABOVE_TABLE: Mapping[str, Sequence[str]] = TABLES["table_a1"]["above"]
"""Label and input of each cell above the rows, by the end of its key."""

_FIRST = 8


def claims_in_table(ledger: Ledger) -> dict[str, Claim]:
    """Return the claims of Table A-1 by their address in the table."""
    return {claim.place.cell: claim for claim in ledger.claims.values() if claim.place.cell}


def table_a1(ledger: Ledger, case: CaseSheet, report: bool) -> SheetPlan:
    """Plan Table A-1 for a case; the report's own is for beta = 5.

    report: whether the printed texts stand beside it, in columns H to M.
    """
    claims, centered = claims_in_table(ledger), case.scheme == "centered"
    page = SheetPlan.begun("Table A-1")
    page.widths = {**page.widths, "G": 13.0 if centered else page.widths["G"]}
    entries, heads, cells = TABLES["rows"], TABLES["table_a1"]["heads"], page.cells
    if centered:
        heads = {**heads, "G": entries["H"]["head"]}

    def live(address: str, key: str, expression: str) -> None:
        """Add a formula, with the unit and number format of the claim that is printed there."""
        claim = claims.get(address)
        shown = "0.00E+00" if claim is None or "." in claim.text else "General"
        unit = "m/s" if claim is None else claim.unit
        cells[address] = formula(f"table.{key}", expression, shown=shown, unit=unit)

    for row, (key, (label, symbol)) in enumerate(ABOVE_TABLE.items(), start=1):
        cells[f"A{row}"] = Cell(label)
        live(f"B{row}", key, f"={symbol}".format_map(case.words))
    words = case.words | {"drag": "G" if centered else "C"}
    entries = {**entries, "A": TABLES["table_a1"]["time"], "B": {}, "G": entries["H"]}
    for column, head in heads.items():
        cells[f"{column}{_FIRST - 1}"] = Cell(head, "head" if column in "AB" else "head right")
        entry = entries[column]
        if "start" in entry:
            start = f"=IF(ISNUMBER('{case.name}'!A{FIRST_ROW}),{entry['start']},\"\")"
            entry = {**entry, "start": start}
        for k, expression in row_formulas(entry, words, _FIRST, TABLE_ROWS):
            live(f"{column}{_FIRST + k}", f"row.{entry['key']}[{k}]", expression)
    if report:
        cells |= _as_printed(ledger, claims)
    page.row = 14
    live_columns = f"Columns A to {max(heads)} are live, with the inputs of {case.name}."
    beside = " Columns H to M are the report’s text." if report else ""
    page.say(f"Table A-1, rigid body penetration. {live_columns}{beside}")
    page.say("M is Eq. 3 times the density, Rt is Eqs. 7 and A-2, d²x/dt² is Eqs. 13, A-1 and A-3.")
    cells["A18"] = Cell(f"Back to {HOME}", "link", link=(HOME, "A1"))
    return page


def _as_printed(ledger: Ledger, claims: dict[str, Claim]) -> dict[str, Cell]:
    """Return the table as the report prints it, in columns H to M."""
    shifted = dict(zip("ABCDEF", "HIJKLM", strict=True))
    labels = enumerate((label for label, _ in ABOVE_TABLE.values()), start=1)
    cells = {f"H{row}": Cell(label, "unit") for row, label in labels}
    for column, head in TABLES["table_a1"]["heads"].items():
        if head:
            cells[f"{shifted[column]}{_FIRST - 1}"] = Cell(head, "unit right")
    for address, claim in claims.items():
        cells[f"{shifted[address[0]]}{address[1:]}"] = printed(ledger, claim.id, claim.unit)
    return cells

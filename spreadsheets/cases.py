"""The sheets `Inputs`, of each case (its rows to the stop, its result), and `Table A-1`.

`Inputs` has every physical number, typed into yellow cells in the report's units; beside each the
value in use in SI units, the report's, and the limits within which a number is accepted. On the
sheet of a case, rows below the stop stay blank until an input needs them. If they do not suffice,
or the time step is too long for the motion, the sheet says so.
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
    Cell,
    Rule,
    SheetPlan,
    filled,
    filled_in,
    formula,
    printed,
    recorded,
    row_formulas,
    tables,
    unit_text,
)

MAX_ROWS = 20_000
"""A sheet of more rows is refused: writing it takes half a minute and gigabytes of memory."""

SCHEMES = {
    "published": "the drag is taken at the velocity with which a row begins",
    "centered": "the drag is taken at the velocity in the middle of a row",
}
"""The two readings of the appendix, and what each does."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseSheet:
    """One case: what its sheet is called, how long it is, and what of the report is its own.

    slug: "low" or "high" of two cases, "case" of one alone; its keys and defined names carry it.
    label: what tells it from the other, as written ("β = 5"). steps, rows: those in use and those
    prepared, after row 0. beta: the beta, "3" or "5", of the report's case beside which it stands.
    is_reports: it is that case. resistance_given: the target resistance is an input and not the
    product of beta and the flow stress. coarse: with the step `dt_coarse`.
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
    def of(self) -> str:
        """What the defined names of its own inputs end with: "_low" in R_t_low, or nothing."""
        return "" if self.slug == "case" else f"_{self.slug}"

    @property
    def part(self) -> str:
        """What the keys of its sheet begin with: "low", "low_coarse", or "case"."""
        return f"{self.slug}_coarse" if self.coarse else self.slug

    @property
    def suffix(self) -> str:
        """What the defined names of its results end with: "_low", "_low_coarse", or nothing."""
        return "" if self.slug == "case" else f"_{self.part}"

    def rules(self, cells: str) -> list[Rule]:
        """The styles of cells that tell whether the run can be trusted."""
        trust = f"=trust{self.suffix}="
        return [Rule(cells, f"{trust}0", "warning"), Rule(cells, f"{trust}1", "changed")]

    @property
    def words(self) -> dict[str, str]:
        """What the words of `sheets.toml` stand for in this case: names, cells and claims."""
        depth, ratio = (f"{kind}-beta-{self.beta}" for kind in ("depth", "ratio"))
        claimed = self.is_reports and not self.coarse
        return {
            "slug": self.slug, "part": self.part, "of": self.of, "suffix": self.suffix,
            "sheet": self.name, "label": self.label, "beta": self.beta,
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
    """Rows to prepare for so many steps: as wanted, or twice as many, in full hundreds.

    At least a hundred stay blank below the stop, for other inputs. Raises ValueError where the rows
    are too few for the steps or more than `MAX_ROWS`.

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
    """A number that is typed: its defined name, symbol, unit, and the limits of what is taken.

    source: the claim that prints it, or an inferred input. attribute: what it is of an impact, if
    it belongs to a case. unit_in_use, factor: another unit, and what brings the number to it.
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
        """The report's number in this unit."""
        return float(ledger.value(self.source) / to_si(self.unit))


def inputs_of(cases: Sequence[CaseSheet], report: bool) -> dict[str, list[Input]]:
    """The inputs of a workbook of these cases, in blocks; `report`: it is the report's own."""
    left_out = {"Y_t", "beta{of}"} if cases[0].resistance_given else {"R_t"}
    left_out |= set() if report else {"dt_coarse"}
    blocks: dict[str, list[Input]] = {}
    for block, entries in tables()["inputs"].items():
        named: dict[str, Input] = {}
        for case, (name, entry) in product(cases, entries.items()):
            if name not in left_out:
                fields = {"name": name, "unit": "1", **entry}
                fields = filled_in(tables()["units"][fields["unit"]] | fields, case.words)
                fields["limits"] = tuple(fields["limits"])
                named[fields["name"]] = Input(**fields)
        blocks[block] = [*named.values()]
    return blocks


def inputs_sheet(ledger: Ledger, cases: Sequence[CaseSheet], report: bool) -> SheetPlan:
    """The sheet for these cases, which share every input but the target resistance."""
    page = SheetPlan.begun("Inputs")
    page.row = 9
    page.table("CFHIKL", "C")
    first = page.row
    for block, entries in inputs_of(cases, report).items():
        page.put(A=Cell(block, "block"))
        for entry in entries:
            page.put(**_input(ledger, entry, page.row))
        page.row += 1
    page.put(A=Cell("What follows from them", "block"))
    derived, words = dict(tables()["derived"]), [case.words for case in cases]
    if cases[0].resistance_given:
        del derived["target"]
    after = page.row
    page.lines(ledger, "inputs", derived, words, "ABFGIJ", headed=False)
    for row in range(after, page.row):
        in_use = page.cells[f"F{row}"]
        page.cells[f"E{row}"] = _check(in_use, row, '""', asked=bool(in_use.name))
    page.row += 1
    page.put(A=Cell("Constants", "block"), H=Cell("as written", "recorded"))
    for name, entry in tables()["constants"].items():
        key, unit, named = f"inputs.{name}", entry["unit"], Cell(name, "unit")
        check = f'=IF(F{page.row}=H{page.row},"","typed over")'
        page.put(
            B=Cell(entry["meaning"]),
            E=formula(f"{key}.check", check, "text"),
            F=recorded(key, name=name, unit=unit),
            G=unit_text(unit),
            H=recorded(f"{key}.written"),
            J=named,
            M=named,
        )
    checks = f"E{first}:E{page.row}"
    page.single_cells(checks=checks)
    page.print_area = f"A1:J{page.row - 1}"
    wrong = "too small", "too large", "no number", "typed over"
    bad = ",".join(f'$E{first}="{word}"' for word in wrong)
    page.rules = [
        Rule(checks, f"=OR({bad})", "warning"),
        Rule(checks, f'=$E{first}="yours"', "changed"),
        Rule("A7", "=inputs_unusable>0", "warning"),
    ]
    return page


def _check(in_use: Cell, row: int, words: str, asked: bool) -> Cell:
    """What column E says of a cell in use: a formula's `words`, while it holds its own formula.

    asked: the sheets of the cases ask for it by name.
    """
    check = f'=IF(F{row}={in_use.formula[1:]},{words},"typed over")'
    name = f"{in_use.name}_check" if asked else ""
    return formula(f"{in_use.key}.check", check, "text", name=name)


def _input(ledger: Ledger, entry: Input, row: int) -> dict[str, Cell]:
    key, unit = f"inputs.{entry.name}", entry.unit_in_use or entry.unit
    if entry.source.startswith(INFERRED):
        style, same, place = "inferred", "as inferred", "inferred from Table A-1"
        prints = Cell("nowhere", "recorded")
    else:
        style, same, place = "input", "the report’s", str(ledger.claims[entry.source].place)
        prints = printed(ledger, entry.source, entry.unit)
    texts = filled_in(tables()["input"], {"row": row, "factor": entry.factor, "same": same})
    shown = "0.0####E+00" if entry.factor else "General"
    in_use = formula(key, texts["in_use"], name=entry.name, unit=unit, shown=shown)
    return {
        "A": Cell(entry.symbol, "text"),
        "B": Cell(entry.meaning or ledger.title(entry.source)),
        "C": Cell(key=f"{key}.typed", style=style, unit=entry.unit, limits=entry.limits),
        "D": unit_text(entry.unit),
        "E": _check(in_use, row, texts["check"], asked=entry.attribute == "resistance"),
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
    """The sheet of one case: title with the live β, state of the run, notes, rows, results."""
    centered, top = case.scheme == "centered", FIRST_ROW - 2
    columns = dict(tables()["rows"])
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
    results = tables()["case"] | (tables()["coarse"] if case.coarse else {})
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


# Table A-1: the report has it cell for cell in A1:F12; every number format gives the text that the
# report prints, 6E-10 in General included. From column H on stands the printed text itself.

TABLE_ROWS = 5
"""Rows of the table, row 0 (the impact itself) included."""

ABOVE_TABLE: Mapping[str, Sequence[str]] = tables()["table_a1"]["above"]
"""What stands above them, by the ends of the keys: label and input."""

_FIRST = 8


def claims_in_table(ledger: Ledger) -> dict[str, Claim]:
    """Address in the table -> the claim that is printed there."""
    return {claim.place.cell: claim for claim in ledger.claims.values() if claim.place.cell}


def table_a1(ledger: Ledger, case: CaseSheet, report: bool) -> SheetPlan:
    """The table for a case: the report's is the one of beta = 5.

    report: with the printed text beside it, in columns H to M.
    """
    claims, centered = claims_in_table(ledger), case.scheme == "centered"
    page = SheetPlan.begun("Table A-1")
    page.widths = {**page.widths, "G": 13.0 if centered else page.widths["G"]}
    entries, heads, cells = tables()["rows"], tables()["table_a1"]["heads"], page.cells
    if centered:
        heads = {**heads, "G": entries["H"]["head"]}

    def live(address: str, key: str, expression: str) -> None:
        """A cell in the unit of what is printed there, and as it is: "6E-10" or "2.00E-10"."""
        claim = claims.get(address)
        shown = "0.00E+00" if claim is None or "." in claim.text else "General"
        unit = "m/s" if claim is None else claim.unit
        cells[address] = formula(f"table.{key}", expression, shown=shown, unit=unit)

    for row, (key, (label, symbol)) in enumerate(ABOVE_TABLE.items(), start=1):
        cells[f"A{row}"] = Cell(label)
        live(f"B{row}", key, f"={symbol}".format_map(case.words))
    words = case.words | {"drag": "G" if centered else "C"}
    entries = {**entries, "A": tables()["table_a1"]["time"], "B": {}, "G": entries["H"]}
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
    """The table as the report prints it, in columns H to M."""
    shifted = dict(zip("ABCDEF", "HIJKLM", strict=True))
    labels = enumerate((label for label, _ in ABOVE_TABLE.values()), start=1)
    cells = {f"H{row}": Cell(label, "unit") for row, label in labels}
    for column, head in tables()["table_a1"]["heads"].items():
        if head:
            cells[f"{shifted[column]}{_FIRST - 1}"] = Cell(head, "unit right")
    for address, claim in claims.items():
        cells[f"{shifted[address[0]]}{address[1:]}"] = printed(ledger, claim.id, claim.unit)
    return cells

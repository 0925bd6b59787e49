"""What a workbook holds, cell by cell, before any file exists.

A cell holds a text, a number that is known when the workbook is planned, or something whose value
is supplied later under the cell's *key* (`high.row.depth[17]`): an input, or a formula. Whoever
supplies the values never sees the formulas, so that the two can be compared.
"""

import re
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import product
from pathlib import Path
from string import ascii_uppercase
from textwrap import wrap
from typing import Any, Literal, NamedTuple

from reference.ledger import Ledger
from reference.units import written

NOT_COMPUTED = "not computed"
"""What stands in place of a value that hangs on an input that cannot be used."""

HOME = "Overview"
"""The first sheet, to which a link leads back from every other."""

FIRST_ROW = 10
"""Row 0 of the scheme, the impact itself, stands in this row of the sheet of a case."""

Value = float | str | bool
"""What a cell shows: numbers are float; the empty string is what a formula leaves for blank."""

Place = tuple[str, str]
"""Sheet name and address: ("Crater", "C5"). No sheet has more columns than there are letters."""


class Cell(NamedTuple):
    """One cell: a `text`, a `number`, an input (a `key` alone), or a `formula` with a key.

    shown: the number format. name: what formulas call it. unit: of its value, spelled as in the
    ledger. claim: the claim whose printed text, or number, it shows. like: names a set of cells of
    like size; their rounding errors are as large as the largest of them allows. link: where a click
    on the text leads. limits, choices: what may be typed, the least and the greatest number in its
    unit, or one of these texts. wrap: long text takes two lines.
    """

    text: str = ""
    style: str = "body"
    number: float | None = None
    key: str = ""
    formula: str = ""
    shown: str = "General"
    name: str = ""
    unit: str = "1"
    claim: str = ""
    like: str = ""
    link: Place | None = None
    limits: tuple[float, float] | None = None
    choices: Sequence[str] = ()
    wrap: bool = False


def formula(key: str, expression: str, style: str = "number", **more: Any) -> Cell:
    """A cell with a formula, given with its "="; its value is supplied under the key."""
    return Cell(key=key, formula=expression, style=style, **more)


def recorded(number: float | str, **more: Any) -> Cell:
    """A cell with a number that follows no change of the inputs, or the key of such a number."""
    if isinstance(number, str):
        return Cell(key=number, style="recorded", **more)
    return Cell(number=number, style="recorded", **more)


def unit_text(unit: str) -> Cell:
    """The unit beside a number."""
    return Cell(written(unit) or "–", "unit")


_SIGNS = {"<": "<", "<=": "≤", ">": ">", ">=": "≥"}


def printed(ledger: Ledger, name: str, unit: str = "1", **more: Any) -> Cell:
    """The text of a claim as the report prints it, with its unit where that is another.

    A bound has its sign before it; "several" is one by itself.
    """
    claim = ledger.claims[name]
    claim_unit = "" if claim.unit == unit else f" {written(claim.unit)}"
    bound = claim.kind == "bound" and "several" not in claim.text
    sign = f"{_SIGNS[claim.relation]} " if bound and claim.relation else ""
    return Cell(f"{sign}{claim.shown}{claim_unit}".rstrip(), "printed", claim=name, **more)


class Rule(NamedTuple):
    """A style that a range of cells takes while a formula, written for its first cell, is true."""

    cells: str
    formula: str
    style: str


class Curve(NamedTuple):
    """A curve of a chart: the cell with its name, and the cells of its x and y: "A5:A25"."""

    name: Place
    x: str
    y: str


@cache
def tables() -> dict[str, Any]:
    """The tables of `sheets.toml`."""
    return tomllib.loads(Path(__file__).with_name("sheets.toml").read_text(encoding="utf-8"))


MESSAGES: Mapping[str, str] = tables()["messages"]
"""What the workbook says of its inputs and of a run, by short names."""


def filled(text: str, words: Mapping[str, object]) -> str:
    """A text of `sheets.toml` with functions, messages and these words in place of braces.

    >>> filled("={rest_depth:{c}}", {"c": "B7"})[:18]
    '=IF(B7<=2/3,4*SIN('
    """

    def called(match: re.Match[str]) -> str:
        return re.sub(r"\bx\b", match[2], tables()["functions"][match[1]])

    text = re.sub(r"\{(\w+):((?:\w|\{\w+\})+)\}", called, text)
    return text.format_map({**MESSAGES, "none": NOT_COMPUTED, **words})


def filled_in(entry: Mapping[str, Any], words: Mapping[str, object]) -> dict[str, Any]:
    """An entry of `sheets.toml` with all its texts filled; what is no text stays as it is."""
    return {
        key: filled(value, words) if isinstance(value, str) else value
        for key, value in entry.items()
    }


@dataclass(slots=True, kw_only=True)
class SheetPlan:
    """One sheet: cells by address, column widths in characters, and how it scrolls and prints.

    row: where the next cells go. entry: what `sheets.toml` says of it. headed: the first column
    that scrolls, and the first and last row of heads, which do not, and head every printed page.
    page_break: the last row of page 1. filtered: a table with a filter. curves: those of its chart.
    written: what that shows, in words, with values by key as written: "{high.depth_um:.4g}".
    """

    name: str
    cells: dict[str, Cell] = field(default_factory=dict)
    widths: Mapping[str, float] = field(default_factory=dict)
    row: int = 1
    entry: Mapping[str, Any] = field(default_factory=dict)
    headed: tuple[str, int, int] | None = None
    rules: list[Rule] = field(default_factory=list)
    curves: Sequence[Curve] = ()
    written: str = ""
    print_area: str = ""
    page_break: int | None = None
    filtered: str = ""

    @classmethod
    def begun(cls, kind: str, name: str = "", **words: object) -> "SheetPlan":
        """A sheet as `sheets.toml` has it under `pages`, down to its notes, with these words."""
        entry = tables()["pages"][kind]
        widths = {c: width for letters, width in entry.get("widths", {}).items() for c in letters}
        page = cls(
            name=name or kind, entry=entry, widths=widths,
            print_area=entry.get("print_area", ""), page_break=entry.get("page_break"),
        )  # fmt: skip
        if "title" in entry:
            page.put(A=Cell(entry["title"], "title"))
            page.put(A=Cell(f"Back to {HOME}", "link", link=(HOME, "A1")))
        page.row = entry.get("at", page.row)
        for note in entry.get("notes", ()):
            page.say(filled(note, words), width=entry.get("width", 165))
        return page

    def single_cells(self, **words: object) -> None:
        """The single cells of its entry, with these words."""
        for address, cell in self.entry["cells"].items():
            self.cells[address] = Cell(**filled_in(cell, words))

    def put(self, **cells: Cell | Literal[""] | None) -> None:
        """One row, by column; where there is no cell, nothing."""
        self.cells |= {f"{column}{self.row}": cell for column, cell in cells.items() if cell}
        self.row += 1

    def say(self, words: str, style: str = "note", width: int = 165) -> None:
        """A running text, broken into lines that fit a page."""
        for line in wrap(words, width, break_on_hyphens=False):
            self.put(A=Cell(line, style))

    def grid(
        self, columns: Mapping[str, Mapping[str, Any]], part: str, words: Mapping[str, object],
        count: int, finish: Callable[[str], str] = str,
    ) -> None:  # fmt: skip
        """Columns of `sheets.toml`, by letter: heads, units, and `count` cells below one another.

        part: what the keys begin with; they end with the number of the cell in its column:
        "high.row.depth[1]". finish: what is made of each formula.
        """
        letters = "".join(columns)
        self.heads(letters, [entry["head"] for entry in columns.values()], letters)
        first = self.row + 1
        self.row = first + count
        for column, entry in columns.items():
            unit = entry.get("under", written(entry.get("unit", "1")) or None)
            if unit is not None:
                self.cells[f"{column}{first - 1}"] = Cell(unit, "unit right")
            looks = ("unit", "shown", "like")
            look = filled_in({name: entry[name] for name in looks if name in entry}, words)
            at_start = {**look, "shown": entry.get("start_shown", "General")}
            formulas = dict(row_formulas(entry, {**words, "column": column}, first, count))
            for k in range(count):
                key = f"{part}.{entry['key']}[{k}]" if "key" in entry else ""
                if k in formulas:
                    look_here = at_start if k == 0 and "start" in entry else look
                    cell = formula(key, finish(formulas[k]), **look_here)
                elif not key:
                    cell = Cell(number=float(k), style="number")
                elif not formulas:
                    cell = recorded(key, **look)
                else:
                    continue
                self.cells[f"{column}{first + k}"] = cell

    def heads(self, columns: str, words: Sequence[str], right: str) -> None:
        """Heads of columns; `right` names the columns of numbers."""
        for column, head in zip(columns, words, strict=True):
            style = "head right" if column in right else "head" if column == "A" else "head unit"
            self.cells[f"{column}{self.row}"] = Cell(head, style)
        self.row += 1

    def table(self, right: str, scrolling: str) -> None:
        """The heads of its entry; `right`: the columns of numbers, `scrolling`: as of `headed`."""
        heads = dict(zip(ascii_uppercase, self.entry["heads"], strict=False))
        self.widths = {column: width for column, (_, width) in heads.items()}
        self.headed = scrolling, self.row, self.row
        self.heads("".join(heads), [words for words, _ in heads.values()], right)

    def description(self, values: Mapping[str, Value]) -> str:
        """What its chart shows, in words, with these values."""
        written = re.sub("{(.+?):(.+?)}", lambda at: format(values[at[1]], at[2]), self.written)
        return str(self.entry["chart"]["description"]).format(written=written)

    def lines(
        self, ledger: Ledger, part: str, blocks: Mapping[str, Any],
        cases: Sequence[Mapping[str, object]], columns: str = "ABCDEF", headed: bool = True,
    ) -> None:  # fmt: skip
        """Write blocks of `sheets.toml`, one quantity a line; that file says what a line may hold.

        part: what the keys begin with. cases: the words of each. columns: of symbol, meaning,
        value, unit, printed text, source. headed: with heads of columns and blocks.
        """
        if headed:
            self.heads(columns, [words for words, _ in tables()["lines"]], columns[2] + columns[4])
        addresses: dict[str, str] = {}
        for number, (head, block) in enumerate(blocks.items()):
            if headed:
                self.row += number > 0
                self.put(**{columns[0]: Cell(head, "block")})
            pairs = product(cases, block.items())
            lines = {key.format_map(words): (words, line) for words, (key, line) in pairs}
            for key, (words, line) in lines.items():
                entry = filled_in(line, {**words, **addresses})
                symbol, meaning, source, claim = (
                    entry.pop(name, "") for name in ("symbol", "meaning", "source", "claim")
                )
                place = source or (str(ledger.claims[claim].place) if claim else "")
                expression, cell = entry.pop("formula"), f"{columns[2]}{self.row}"
                value = formula(
                    f"{part}.{key}",
                    guarded(expression) if entry.pop("guard", True) else expression,
                    shown=entry.pop("shown", "0.0000"),
                    **entry,
                )
                addresses[key.rpartition(".")[2]] = cell
                cells = (
                    symbol and Cell(symbol, "text"),
                    meaning and Cell(meaning),
                    value,
                    unit_text(value.unit),
                    claim and printed(ledger, claim, value.unit),
                    place and Cell(place, "unit"),
                )
                self.put(**dict(zip(columns, cells, strict=True)))


@dataclass(frozen=True, kw_only=True)
class WorkbookPlan:
    """The sheets in order. No key stands twice, nor does a defined name, in whatever case."""

    sheets: tuple[SheetPlan, ...]
    properties: Mapping[str, str] = field(default_factory=dict)

    def cells(self) -> Iterator[tuple[Place, Cell]]:
        """Every cell with its place, sheet by sheet."""
        for sheet in self.sheets:
            for address, cell in sheet.cells.items():
                yield (sheet.name, address), cell

    def cell(self, place: Place) -> Cell:
        """The cell in a place, an empty one where nothing is planned."""
        cells = next((sheet.cells for sheet in self.sheets if sheet.name == place[0]), {})
        return cells.get(place[1], Cell())

    @cached_property
    def where(self) -> Mapping[str, Place]:
        """Key -> the place of the cell that holds it."""
        return {cell.key: place for place, cell in self.cells() if cell.key}

    @cached_property
    def inexact(self) -> Set[Place]:
        """The cells whose value passes through LN, SIN, ASIN, a cube root or ROUND.

        Its last digits depend on the program; all other values are the same double everywhere.
        """
        from openpyxl.utils.cell import coordinate_to_tuple

        from spreadsheets import engines, foreign
        from spreadsheets.recalculation import Calculation, parse

        sheets = {
            sheet.name: {
                coordinate_to_tuple(address): foreign.Cell(cell.formula or None, None)
                for address, cell in sheet.cells.items()
            }
            for sheet in self.sheets
        }
        names = {cell.name: "'{}'!{}".format(*place) for place, cell in self.cells() if cell.name}
        book = foreign.Book(Path(), sheets, names)
        texts = {place: cell.formula for place, cell in book.cells() if cell.formula}
        formulas = {place: parse(text, place, book) for place, text in texts.items()}
        rounded = {at for at, text in texts.items() if re.search(r"LN\(|SIN\(|\^|ROUND\(", text)}
        inexact = Calculation(book, formulas, {}).needing(rounded)
        return {(sheet, engines.address(row, column)) for sheet, row, column in inexact}


def place_of(text: str) -> Place:
    """A place that is written as in a formula, without quotes.

    >>> place_of("Table A-1!B3")
    ('Table A-1', 'B3')
    """
    sheet, _, address = text.rpartition("!")
    return sheet, address


def row_formulas(
    entry: Mapping[str, str], words: Mapping[str, object], first: int, count: int
) -> Iterator[tuple[int, str]]:
    """The formulas of a column of `sheets.toml`, with their numbers: those of `count` rows.

    `each` is that of every row; or `start` that of row `first` of the sheet, `first` that of the
    row below it (else `then`), and `then` that of all others. What is no formula by itself, without
    "=", is blank where column A is no number; a test for "" fails in two spreadsheet programs.
    """
    then = entry.get("then")
    kinds = entry.get("start"), entry.get("first", then), then
    for k in range(count):
        if expression := entry.get("each") or kinds[min(k, 2)]:
            if expression[0] != "=":
                expression = f'=IF(ISNUMBER(A{{row}}),{expression},"")'
            rows = {"row": first + k, "above": first + k - 1, "case_row": FIRST_ROW + k}
            yield k, filled(expression, {**words, **rows})


_REFERENCE = re.compile(
    r"""(?P<skip>"[^"]*"|(?:'[^']*'!)?\$?[A-Z]{1,2}\$?\d+:\$?[A-Z]{1,2}\$?\d+|[A-Za-z]\w*\()
    |(?P<cell>(?:'[^']*'!)?\$?\b[A-Z]{1,2}\$?\d+\b|\b[A-Za-z]\w*\b)""",
    re.VERBOSE,
)


def guarded(expression: str) -> str:
    """The formula, calculated where all that it refers to are numbers.

    Elsewhere it says that nothing was computed. A mere reference is left as it is.

    >>> guarded("=2*R_p"), guarded("=R_p")
    ('=IF(COUNT(R_p)=1,2*R_p,"not computed")', '=R_p')
    """
    called = [match["cell"] for match in _REFERENCE.finditer(expression)]
    names = list(dict.fromkeys(name for name in called if name))
    if not names or expression == f"={names[0]}":
        return expression
    return f'=IF(COUNT({",".join(names)})={len(names)},{expression[1:]},"{NOT_COMPUTED}")'

"""The plan of a workbook: what every cell holds, before any file exists.

A cell holds a text, a number that is known when the workbook is planned, or something whose value
is supplied later under the *key* of the cell (`high.row.depth[17]`): an input, or the result of a
formula. Whoever supplies the values never sees the formulas, so that the two can be compared.
"""

import re
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from string import ascii_uppercase
from textwrap import wrap
from typing import Any, Literal, NamedTuple

from reference.ledger import Ledger
from reference.units import written

NOT_COMPUTED = "not computed"
"""What a formula gives if it depends on an input that cannot be used."""

HOME = "Overview"
"""The first sheet; every other sheet has a link back to it."""

FIRST_ROW = 10
"""The row of a case's sheet that holds row 0 of the scheme, the impact itself."""

Value = float | str | bool
"""What a cell shows. A number is a float; a formula that leaves its cell blank gives ""."""

Place = tuple[str, str]
"""Sheet name and address: ("Crater", "C5"). A column is a single letter on every sheet."""


class Cell(NamedTuple):
    """One cell: a `text`, a `number`, an input (a `key` alone), or a `formula` with a key.

    shown: number format. name: defined name, by which formulas refer to the cell. unit: of the
    value, spelled as in the ledger. claim: id of the claim whose printed text, or number, the cell
    shows. like: name of a set of cells with values of like size; the largest of them limits the
    rounding error of each. link: the place that a click on the text leads to. limits, choices: what
    may be typed, from the least to the greatest number in the cell's unit, or one of these texts.
    wrap: whether a long text takes two lines.
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
    """Return a cell with a formula, which starts with "="; its value is supplied under the key."""
    return Cell(key=key, formula=expression, style=style, **more)


def recorded(number: float | str, **more: Any) -> Cell:
    """Return a cell with a number, or the key of a number, that no change of an input affects."""
    if isinstance(number, str):
        return Cell(key=number, style="recorded", **more)
    return Cell(number=number, style="recorded", **more)


def unit_text(unit: str) -> Cell:
    """Return the cell beside a number that shows its unit."""
    return Cell(written(unit) or "–", "unit")


_SIGNS = {"<": "<", "<=": "≤", ">": ">", ">=": "≥"}


def printed(ledger: Ledger, name: str, unit: str = "1", **more: Any) -> Cell:
    """Return a cell with the text of a claim as the report prints it, such as "≥ 6" for a bound.

    The unit of the claim follows if it is not `unit`, which stands beside the cell.
    """
    claim = ledger.claims[name]
    claim_unit = "" if claim.unit == unit else f" {written(claim.unit)}"
    # "several" says by itself that it is a bound.
    bound = claim.kind == "bound" and "several" not in claim.text
    sign = f"{_SIGNS[claim.relation]} " if bound and claim.relation else ""
    return Cell(f"{sign}{claim.shown}{claim_unit}".rstrip(), "printed", claim=name, **more)


class Rule(NamedTuple):
    """A style that a range of cells takes while a formula, written for its first cell, is true."""

    cells: str
    formula: str
    style: str


class Curve(NamedTuple):
    """A curve of a chart: the place of its name, and the ranges of x and y, such as "A5:A25"."""

    name: Place
    x: str
    y: str


TABLES: Mapping[str, Any] = tomllib.loads(
    Path(__file__).with_name("sheets.toml").read_text(encoding="utf-8")
)
"""The tables of `sheets.toml`."""

MESSAGES: Mapping[str, str] = TABLES["messages"]
"""The messages of the workbook about its inputs and runs, by short names."""


def filled(text: str, words: Mapping[str, object]) -> str:
    """Replace the braces in a text of `sheets.toml` by functions, messages and the given words.

    >>> filled("={rest_depth:{c}}", {"c": "B7"})[:18]
    '=IF(B7<=2/3,4*SIN('
    """

    def called(match: re.Match[str]) -> str:
        return re.sub(r"\bx\b", match[2], TABLES["functions"][match[1]])

    text = re.sub(r"\{(\w+):((?:\w|\{\w+\})+)\}", called, text)
    return text.format_map({**MESSAGES, "none": NOT_COMPUTED, **words})


def filled_in(entry: Mapping[str, Any], words: Mapping[str, object]) -> dict[str, Any]:
    """Return an entry of `sheets.toml` with all its texts `filled`."""
    return {
        key: filled(value, words) if isinstance(value, str) else value
        for key, value in entry.items()
    }


@dataclass(slots=True, kw_only=True)
class SheetPlan:
    """One sheet: its cells by address, column widths in characters, and how it scrolls and prints.

    row: where the next cells go. entry: the table of the sheet in `sheets.toml`. headed: the first
    column that scrolls, and the first and last row of heads; heads do not scroll, and are repeated
    on every printed page. page_break: the last row of page 1. filtered: the cells of a table that
    has a filter. curves: those of the sheet's chart. written: what the chart shows, in words that
    refer to values by key: "{high.depth_um:.4g}".
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
        """Begin a sheet with what `sheets.toml` has under `pages`: title, link home and notes."""
        entry = TABLES["pages"][kind]
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
        """Add the single cells of the sheet's entry, filled with these words."""
        for address, cell in self.entry["cells"].items():
            self.cells[address] = Cell(**filled_in(cell, words))

    def put(self, **cells: Cell | Literal[""] | None) -> None:
        """Add a row of cells, given by column; those that are None or "" are left out."""
        self.cells |= {f"{column}{self.row}": cell for column, cell in cells.items() if cell}
        self.row += 1

    def say(self, words: str, style: str = "note", width: int = 165) -> None:
        """Add a paragraph, broken into lines of at most `width` letters."""
        for line in wrap(words, width, break_on_hyphens=False):
            self.put(A=Cell(line, style))

    def grid(
        self, columns: Mapping[str, Mapping[str, Any]], part: str, words: Mapping[str, object],
        count: int, finish: Callable[[str], str] = str,
    ) -> None:  # fmt: skip
        """Add columns of `sheets.toml`, given by letter: heads, units and `count` cells each.

        part: what the keys begin with. They end with the number of the cell in its column, from 0:
        "high.row.depth[1]". finish: is applied to every formula.
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
            start_look = {**look, "shown": entry.get("start_shown", "General")}
            formulas = dict(row_formulas(entry, {**words, "column": column}, first, count))
            for k in range(count):
                key = f"{part}.{entry['key']}[{k}]" if "key" in entry else ""
                if k in formulas:
                    at_start = k == 0 and "start" in entry
                    cell = formula(key, finish(formulas[k]), **(start_look if at_start else look))
                elif not key:
                    cell = Cell(number=float(k), style="number")
                elif not formulas:
                    cell = recorded(key, **look)
                else:
                    continue
                self.cells[f"{column}{first + k}"] = cell

    def heads(self, columns: str, heads: Sequence[str], right: str) -> None:
        """Add a row of column heads; `right` lists the columns of numbers."""
        for column, head in zip(columns, heads, strict=True):
            style = "head right" if column in right else "head" if column == "A" else "head unit"
            self.cells[f"{column}{self.row}"] = Cell(head, style)
        self.row += 1

    def table(self, right: str, scrolling: str) -> None:
        """Begin the table whose heads and widths the sheet's entry lists.

        right: the columns of numbers. scrolling: the first column that scrolls.
        """
        columns = ascii_uppercase[: len(self.entry["heads"])]
        heads, widths = zip(*self.entry["heads"], strict=True)
        self.widths = dict(zip(columns, widths, strict=True))
        self.headed = scrolling, self.row, self.row
        self.heads(columns, heads, right)

    def description(self, values: Mapping[str, Value]) -> str:
        """Describe the sheet's chart in words, with these values."""
        written = re.sub("{(.+?):(.+?)}", lambda at: format(values[at[1]], at[2]), self.written)
        return str(self.entry["chart"]["description"]).format(written=written)

    def lines(
        self, ledger: Ledger, part: str, blocks: Mapping[str, Any],
        cases: Sequence[Mapping[str, object]], columns: str = "ABCDEF", headed: bool = True,
    ) -> None:  # fmt: skip
        """Add blocks of `sheets.toml`, one line for each quantity; that file explains its entries.

        part: what the keys begin with. cases: the words of each case. columns: for symbol, meaning,
        value, unit, printed text and source. headed: whether columns and blocks have heads.
        """
        if headed:
            self.heads(columns, [head for head, _ in TABLES["lines"]], columns[2] + columns[4])
        addresses: dict[str, str] = {}
        for number, (head, block) in enumerate(blocks.items()):
            if headed:
                self.row += number > 0
                self.put(**{columns[0]: Cell(head, "block")})
            # A line whose key has no word of a case is the same for all cases, and stands once.
            lines = {
                key.format_map(words): (line, words)
                for words in cases
                for key, line in block.items()
            }
            for key, (line, words) in lines.items():
                entry = {"shown": "0.0000", **filled_in(line, {**words, **addresses})}
                symbol, meaning, source, claim = (
                    entry.pop(name, "") for name in ("symbol", "meaning", "source", "claim")
                )
                expression = entry.pop("formula")
                if entry.pop("guard", True):
                    expression = guarded(expression)
                value = formula(f"{part}.{key}", expression, **entry)
                addresses[key.rpartition(".")[2]] = f"{columns[2]}{self.row}"
                place = source or (str(ledger.claims[claim].place) if claim else "")
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
    """The sheets in order. Keys are unique, and so are defined names, even if case is ignored."""

    sheets: tuple[SheetPlan, ...]
    properties: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def cells(self) -> Mapping[Place, Cell]:
        """Every cell by its place, sheet by sheet."""
        return {
            (sheet.name, address): cell
            for sheet in self.sheets
            for address, cell in sheet.cells.items()
        }

    @cached_property
    def where(self) -> Mapping[str, Place]:
        """The place of the cell with each key."""
        return {cell.key: place for place, cell in self.cells.items() if cell.key}

    @cached_property
    def inexact(self) -> Set[Place]:
        """The cells whose value depends on LN, SIN, ASIN, a cube root or ROUND.

        Their last digits depend on the program; all other values are the same double everywhere.
        """
        from openpyxl.utils.cell import coordinate_to_tuple

        from spreadsheets import engines, foreign
        from spreadsheets.evaluate import Evaluator

        sheets: dict[str, dict[tuple[int, int], foreign.Cell]] = {}
        for (sheet, address), cell in self.cells.items():
            position = coordinate_to_tuple(address)
            sheets.setdefault(sheet, {})[position] = foreign.Cell(cell.formula or None, None)
        names = {cell.name: "'{}'!{}".format(*at) for at, cell in self.cells.items() if cell.name}
        book = foreign.Book(Path(), sheets, names)
        texts = {position: cell.formula for position, cell in book.cells() if cell.formula}
        inexact = {at for at, text in texts.items() if re.search(r"LN\(|SIN\(|\^|ROUND\(", text)}
        evaluator = Evaluator(book)
        for place in sorted(texts, key=evaluator.order.__getitem__):
            if not inexact.isdisjoint(evaluator.precedents(place)):
                inexact.add(place)
        return {(sheet, engines.address(row, column)) for sheet, row, column in inexact}


def place_of(text: str) -> Place:
    """Return the place that a text names as a formula does, but without quotes.

    >>> place_of("Table A-1!B3")
    ('Table A-1', 'B3')
    """
    sheet, _, address = text.rpartition("!")
    return sheet, address


def row_formulas(
    entry: Mapping[str, str], words: Mapping[str, object], first: int, count: int
) -> Iterator[tuple[int, str]]:
    """Yield the formulas of `count` cells of a column of `sheets.toml`, with their numbers from 0.

    An entry has one formula for all cells (`each`); or one for the first cell, in row `first` of
    the sheet (`start`), one for the second (`first`, if it is special), and one for all others
    (`then`). A formula that does not begin with "=" is left blank where column A has no number; to
    compare column A with "" instead fails in two spreadsheet programs.
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
    """Return a formula that is computed only if all cells that it refers to hold numbers.

    Otherwise it gives "not computed". A formula that only repeats a cell is returned unchanged.

    >>> guarded("=2*R_p"), guarded("=R_p")
    ('=IF(COUNT(R_p)=1,2*R_p,"not computed")', '=R_p')
    """
    cells = [match["cell"] for match in _REFERENCE.finditer(expression)]
    names = list(dict.fromkeys(filter(None, cells)))
    if not names or expression == f"={names[0]}":
        return expression
    return f'=IF(COUNT({",".join(names)})={len(names)},{expression[1:]},"{NOT_COMPUTED}")'

"""The plan of a workbook: what every cell holds, before any file exists.

A cell holds a text, a number that is known when the workbook is planned, or something whose value
is supplied later under the *key* of the cell (`high.row.depth[17]`): an input, or the result of a
formula. Whoever supplies the values never sees the formulas, so that the two can be compared.

A quantity has a defined name, and its key is that name: formulas read `=4*rho_p/(3*rho_t)*ln_rest`.
"""

import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from string import ascii_uppercase
from textwrap import wrap
from typing import Any, Literal, NamedTuple

from reference.ledger import Ledger, load
from reference.units import written

NOT_COMPUTED = "not computed"
"""What a verdict says if it depends on an input that cannot be used."""

NOT_AVAILABLE = "#N/A"
"""The value of a cell that depends on an input that cannot be used, or on rows that are missing."""

ROW_HEIGHT = 13.5
"""Height of a row in points, for type of 10 points; a sheet of many rows may take less."""

YES_OR_NO = '"yes";;"no"'
"""The number format that shows 1 as yes, and 0 as no."""

HOME = "Overview"
"""The first sheet; every other sheet has a link back to it."""

ShownValue = float | str | bool
"""What a cell shows. A number is a float; a formula that leaves its cell blank gives ""."""

CellPlace = tuple[str, str]
"""Sheet name and address: ("Crater", "C5"). A column is a single letter on every sheet."""


class Cell(NamedTuple):
    """One cell: a `text`, a `number`, an input (a `key` alone), or a `formula` with a key.

    shown: number format. named: whether the key is also a defined name, by which formulas refer to
    the cell. unit: of the value, spelled as in the ledger. claim: id of the claim whose printed
    text, or number, the cell shows. like: name of a set of cells with values of like size; the
    largest of them limits the rounding error of each. link: the place that a click on the text
    leads to. limits, choices: what may be typed, from the least to the greatest number in the
    cell's unit, or one of these texts. wrap: whether a long text takes two lines.
    """

    text: str = ""
    style: str = "body"
    number: float | None = None
    key: str = ""
    formula: str = ""
    shown: str = "General"
    named: bool = False
    unit: str = "1"
    claim: str = ""
    like: str = ""
    link: CellPlace | None = None
    limits: tuple[float, float] | None = None
    choices: Sequence[str] = ()
    wrap: bool = False


def formula(key: str, expression: str, style: str = "number", **more: Any) -> Cell:
    """Return a cell with a formula, which starts with "="; its value is supplied under the key."""
    return Cell(key=key, formula=expression, style=style, **more)


def said_while(name: str, words: str) -> Cell:
    """Return the cell `says_<name>`: its words while `is_<name>` is 1, or nothing."""
    return formula(f"says_{name}", f'=IF(is_{name}=1,"{words}","")', "text", named=True)


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


class ChartCurve(NamedTuple):
    """A curve of a chart: the place of its name, and the ranges of x and y, such as "A5:A25".

    beta: "3" or "5", of the report's case that it shows or is compared with: it sets the look.
    """

    name: CellPlace
    x: str
    y: str
    beta: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Chart:
    """The chart of a sheet, with its upper left corner in the cell `at` and its size in pixels.

    sheet: the sheet with the cells of the curves, if it is another one. describe: says in words,
    from the values by key, what the chart shows as written.
    """

    at: str
    title: str
    x_title: str
    y_title: str
    size: tuple[int, int]
    curves: Sequence[ChartCurve]
    describe: Callable[[Mapping[str, ShownValue]], str]
    logarithmic: bool = False
    sheet: str = ""


LINE_HEADS = (
    ("Symbol", 9), ("Quantity", 44), ("Value", 14), ("Unit", 8), ("The report prints", 20),
    ("Equation or place", 46),
)  # fmt: skip
"""The heads and column widths of a table with one quantity in each line."""


@dataclass(slots=True, kw_only=True)
class SheetPlan:
    """One sheet: its cells by address, column widths in characters, and how it scrolls and prints.

    about: what the sheet shows, for `Overview`. row: where the next cells go. columns: those of
    symbol, meaning, value, unit, printed text and source in a `line`. headed: the first column that
    scrolls, and the first and last row of heads; heads do not scroll, and are repeated on every
    printed page. portrait, most_pages: how it is printed; the columns always fit the width of a
    page, and the rows so many pages (0: as many as they take). row_height: in points. filtered: the
    cells of a table that has a filter.
    claims: the address of the cell that computes a claim, by the claim's id.
    """

    name: str
    about: str = ""
    ledger: Ledger = field(default_factory=load)
    cells: dict[str, Cell] = field(default_factory=dict)
    widths: dict[str, float] = field(default_factory=dict)
    row: int = 1
    columns: str = "ABCDEF"
    headed: tuple[str, int, int] | None = None
    rules: list[Rule] = field(default_factory=list)
    charts: list[Chart] = field(default_factory=list)
    print_area: str = ""
    portrait: bool = False
    most_pages: int = 0
    row_height: float = ROW_HEIGHT
    filtered: str = ""
    claims: dict[str, str] = field(default_factory=dict)

    def begin(self, title: str) -> None:
        """Add the title of the sheet and the link back to `Overview`."""
        self.put(A=Cell(title, "title"))
        self.put(A=Cell(f"Back to {HOME}", "link", link=(HOME, "A1")))

    def wide(self, columns: str, width: float) -> None:
        """Set the width, in characters, of the columns with these letters."""
        self.widths |= dict.fromkeys(columns, width)

    def put(self, **cells: Cell | Literal[""] | None) -> None:
        """Add a row of cells, given by column; those that are None or "" are left out."""
        self.cells |= {f"{column}{self.row}": cell for column, cell in cells.items() if cell}
        self.row += 1

    def say(self, words: str, style: str = "note", width: int = 165) -> None:
        """Add a paragraph, broken into lines of at most `width` letters."""
        for line in wrap(words, width, break_on_hyphens=False):
            self.put(A=Cell(line, style))

    def heads(self, columns: str, heads: Sequence[str], right: str) -> None:
        """Add a row of column heads; `right` lists the columns of numbers."""
        for column, head in zip(columns, heads, strict=True):
            style = "head right" if column in right else "head" if column == "A" else "head unit"
            self.cells[f"{column}{self.row}"] = Cell(head, style)
        self.row += 1

    def table(self, heads: Sequence[tuple[str, float]], right: str, scrolling: str) -> None:
        """Begin a table in columns A, B, C, ... with these heads and widths.

        right: the columns of numbers. scrolling: the first column that scrolls.
        """
        columns = ascii_uppercase[: len(heads)]
        texts, widths = zip(*heads, strict=True)
        self.widths |= dict(zip(columns, widths, strict=True))
        self.headed = scrolling, self.row, self.row
        self.heads(columns, texts, right)

    def column(self, letter: str, head: str, unit: str, cells: Sequence[Cell | None]) -> None:
        """Add a column from the current row on: its head, its unit or the text "", its cells.

        The current row stays as it is, so that another column can be added beside this one.
        """
        self.cells[f"{letter}{self.row}"] = Cell(head, "head" if letter == "A" else "head right")
        if unit:
            text = unit if unit == "–" else written(unit)
            self.cells[f"{letter}{self.row + 1}"] = Cell(text, "unit right")
        for row, cell in enumerate(cells, start=self.row + 2):
            if cell:
                self.cells[f"{letter}{row}"] = cell

    def block(self, head: str) -> None:
        """Add the head of a block of lines."""
        self.put(**{self.columns[0]: Cell(head, "block")})

    def line(
        self, name: str, symbol: str, meaning: str, expression: str, unit: str = "1", *,
        claim: str = "", also: Sequence[str] = (), beside: str = "", source: str = "",
        shown: str = "0.0000", like: str = "",
    ) -> None:  # fmt: skip
        """Add a line for one quantity, computed by a formula in the cell that gets this name.

        claim: the claim that the cell computes; its printed text stands beside it, and its place in
        the report if no other `source` is given. also: other claims that the cell computes. beside:
        the claim whose printed text stands beside the cell though another cell computes it.
        """
        computed = [claim, *also] if claim else also
        self.claims |= dict.fromkeys(computed, f"{self.columns[2]}{self.row}")
        value = formula(name, expression, named=True, unit=unit, shown=shown, like=like)
        self._line(symbol, meaning, value, claim or beside, source)

    def state(self, name: str, meaning: str, expression: str, words: str) -> None:
        """Add a line for a state that holds (1) or not (0), and what is said while it holds.

        The two cells are named `is_` and `says_`, and then `name`. The chain of all cells that say
        something is the message of the sheet; only one of them is not blank.
        """
        self.cells[f"{self.columns[5]}{self.row}"] = said_while(name, words)
        self.line(f"is_{name}", "", meaning, expression, shown=YES_OR_NO)

    def repeat(
        self, key: str, symbol: str, meaning: str, name: str, unit: str = "1", *,
        beside: str = "", source: str = "", shown: str = "0.0000",
    ) -> None:  # fmt: skip
        """Add a line that repeats the quantity with this name, in a cell without a name."""
        value = formula(key, f"={name}", unit=unit, shown=shown)
        self._line(symbol, meaning, value, beside, source)

    def _line(self, symbol: str, meaning: str, value: Cell, claim: str, source: str) -> None:
        """Add a line; `claim` is the one whose printed text stands beside the value."""
        if claim and not source:
            source = str(self.ledger.claims[claim].place)
        cells = (
            symbol and Cell(symbol, "text"),
            meaning and Cell(meaning, "text"),
            value,
            unit_text(value.unit),
            claim and printed(self.ledger, claim, value.unit),
            source and Cell(source, "unit"),
        )
        self.put(**dict(zip(self.columns, cells, strict=True)))

    def line_heads(self) -> None:
        """Add the heads of a table of lines."""
        texts = [head for head, _ in LINE_HEADS]
        self.heads(self.columns, texts, right=self.columns[2] + self.columns[4])


_REFERENCE = re.compile(
    r"""(?:'(?P<sheet>[^']*)'!)?\$?(?P<column>[A-Z])\$?(?P<first>\d+)(?::[A-Z](?P<last>\d+))?\b
    |(?P<name>[A-Za-z]\w*)\b(?!\()""",
    re.VERBOSE,
)
"""A cell or a range of one column, or a defined name, in a formula of a plan."""


@dataclass(frozen=True, kw_only=True)
class WorkbookPlan:
    """The sheets in order. Keys are unique, and so are defined names, even if case is ignored."""

    sheets: tuple[SheetPlan, ...]
    properties: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def cells(self) -> Mapping[CellPlace, Cell]:
        """Every cell by its place, sheet by sheet."""
        return {
            (sheet.name, address): cell
            for sheet in self.sheets
            for address, cell in sheet.cells.items()
        }

    @cached_property
    def where(self) -> Mapping[str, CellPlace]:
        """The place of the cell with each key."""
        return {cell.key: place for place, cell in self.cells.items() if cell.key}

    @cached_property
    def claims(self) -> Mapping[str, CellPlace]:
        """The place of the cell that computes a claim, by the claim's id."""
        return {
            claim: (sheet.name, address)
            for sheet in self.sheets
            for claim, address in sheet.claims.items()
        }

    def references(self, place: CellPlace) -> Iterator[CellPlace]:
        """Yield the cells that the formula of a cell refers to: by address, range or name."""
        own_sheet, text = place[0], re.sub(r'"[^"]*"', "", self.cells[place].formula)
        for match in _REFERENCE.finditer(text):
            if match["name"]:
                yield self.where[match["name"]]
            else:
                first = int(match["first"])
                for row in range(first, int(match["last"] or first) + 1):
                    yield match["sheet"] or own_sheet, f"{match['column']}{row}"

    @cached_property
    def readers(self) -> Mapping[CellPlace, Sequence[CellPlace]]:
        """The cells whose formulas refer to a cell, by its place."""
        readers: dict[CellPlace, list[CellPlace]] = {}
        for place, cell in self.cells.items():
            for reference in self.references(place) if cell.formula else ():
                readers.setdefault(reference, []).append(place)
        return readers

    def dependents(self, sources: Collection[CellPlace]) -> set[CellPlace]:
        """Return these cells, and all whose formulas depend on one of them, however indirectly."""
        reached, waiting = set(sources), list(sources)
        while waiting:
            new = set(self.readers.get(waiting.pop(), ())) - reached
            reached |= new
            waiting += new
        return reached

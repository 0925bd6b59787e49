"""What a workbook holds, cell by cell, before any file exists.

A cell holds a text, a number that is known when the workbook is planned, or something whose value
is supplied later under the cell's *key* (`high.row[17].depth`): an input, or a formula. Whoever
supplies the values never sees the formulas, so that the two can be compared.
"""

import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path
from string import Template
from textwrap import wrap
from typing import Any, Literal, NamedTuple

from reference.ledger import Ledger
from reference.units import written

NOT_COMPUTED = "not computed"
"""What stands in place of a value that hangs on an input that cannot be used."""

HOME = "Overview"
"""The first sheet, to which a link leads back from every other."""

Value = float | str | bool
"""What a cell shows: numbers are float; the empty string is what a formula leaves for blank."""

Place = tuple[str, str]
"""Sheet name and address: ("Crater", "C5")."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """One cell.

    It holds a `text`, a `number`, an input (a `key` alone), or a `formula` with a key; or nothing
    but a style.

    name: what formulas call it. unit: of its value, spelled as in the ledger. claim: the id of the
    claim whose printed text, or printed number, it shows. transcendental: its value passes through
    LN, SIN, ASIN or a cube root, whose last digits depend on the program; all other values are the
    same double everywhere. column: names a set of cells of like size, such as the velocities of a
    sheet; their rounding errors are as large as the largest of them allows. link: where a click on
    the text leads. limits, choices: what may be typed, the least and the greatest number in its
    unit, or one of these texts. wrap: long text takes several lines.
    """

    text: str = ""
    number: float | None = None
    key: str = ""
    formula: str = ""
    style: str = "body"
    number_format: str = "General"
    name: str = ""
    unit: str = "1"
    claim: str = ""
    transcendental: bool = False
    column: str = ""
    link: Place | None = None
    limits: tuple[float, float] | None = None
    choices: tuple[str, ...] = ()
    wrap: bool = False


def text(words: str, style: str = "body", **more: Any) -> Cell:
    """A cell with a text."""
    return Cell(text=words, style=style, **more)


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
    return text(written(unit) or "–", "unit")


def printed(ledger: Ledger, name: str, unit: str = "1", **more: Any) -> Cell:
    """The text of a claim as the report prints it, with its unit where that is another."""
    claim = ledger.claims[name]
    own = "" if claim.unit == unit else f" {written(claim.unit)}"
    return text(f"{claim.shown}{own}".rstrip(), "printed", claim=name, **more)


class Rule(NamedTuple):
    """A style that a range of cells takes while a formula, written for its first cell, is true."""

    cells: str
    formula: str
    style: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Chart:
    """Curves of the sheet's own cells, drawn with the upper left corner in the cell `at`.

    series: for each, the cell with its name and the cells of its x and y, such as "A5:A25". With
    `logarithmic` both axes are. description: says in words what the chart shows, with values by key
    as written: "{high.depth_um:.4g}".
    """

    at: str
    title: str
    description: str
    x_title: str
    y_title: str
    series: list[tuple[Place, str, str]]
    logarithmic: bool = False
    size: Sequence[int] = (820, 470)

    def described(self, values: Mapping[str, Value]) -> str:
        """The description with its values."""
        return re.sub("{(.+?):(.+?)}", lambda of: format(values[of[1]], of[2]), self.description)


@dataclass(frozen=True, slots=True)
class Line:
    """One quantity: its key, symbol, meaning, formula, unit, and the equation that it comes from.

    The key is that within its sheet: "rha.derived". The formula calls lines above it in its table
    by their `id` in braces; `guard`: see `guarded`. claim: where the report prints the value.
    shown: the number format. Others: as in `Cell`.
    """

    key: str
    formula: str
    symbol: str = ""
    meaning: str = ""
    unit: str = "1"
    source: str = ""
    claim: str = ""
    shown: str = "0.0000"
    name: str = ""
    column: str = ""
    guard: bool = True

    @property
    def id(self) -> str:
        """What formulas call it: "rha.derived" is {rha_derived}."""
        return self.key.replace(".", "_")


@cache
def tables() -> dict[str, Any]:
    """The tables of `sheets.toml`."""
    return tomllib.loads(Path(__file__).with_name("sheets.toml").read_text(encoding="utf-8"))


def lines_of(table: str, *cases: Mapping[str, str]) -> list[Line | str]:
    """The lines of a table of `sheets.toml`, after the head of each block.

    cases: what the words that begin with "$" stand for, in each case. A line whose key has none of
    them stands once.
    """
    lines: list[Line | str] = []
    for head, block in tables()[table].items():
        filled: dict[str, Line] = {}
        for case in cases or ({},):
            words = {"none": NOT_COMPUTED, **case}
            for entry in ({"key": key, **fields} for key, fields in block.items()):
                guard = entry.pop("guard", True)
                texts = {name: Template(x).substitute(words) for name, x in entry.items()}
                filled.setdefault(texts["key"], Line(**texts, guard=guard))
        lines += [head, *filled.values()]
    return lines


@dataclass(slots=True, kw_only=True)
class SheetPlan:
    """One sheet: cells by address, column widths in characters, and how it scrolls and prints.

    It is filled from the top; `row` is where the next cells go. frozen: the first cell that
    scrolls. repeated_rows: first and last row that head every printed page. print_area: the cells
    printed, all by default. page_break: the last row of page 1. filtered: a table with a filter.
    """

    name: str
    cells: dict[str, Cell] = field(default_factory=dict)
    widths: Mapping[str, float] = field(default_factory=dict)
    row: int = 1
    frozen: str = ""
    repeated_rows: tuple[int, int] | None = None
    rules: list[Rule] = field(default_factory=list)
    chart: Chart | None = None
    print_area: str = ""
    page_break: int | None = None
    filtered: str = ""

    def put(self, **cells: Cell | Literal[""] | None) -> None:
        """One row, by column; where there is no cell, nothing."""
        self.cells |= {f"{at}{self.row}": cell for at, cell in cells.items() if cell}
        self.row += 1

    def say(self, *texts: str, style: str = "note", width: int = 165) -> None:
        """Running texts, each broken into lines that fit a page."""
        for words in texts:
            for line in wrap(words, width, break_on_hyphens=False):
                self.put(A=text(line, style))

    def title(self, words: str) -> None:
        """The first two rows: the title, and the way back."""
        self.put(A=text(words, "title"))
        self.put(A=text(f"Back to {HOME}", "link", link=(HOME, "A1")))

    def heads(
        self, columns: str, words: Sequence[str], right: str, units: Sequence[str | None] = ()
    ) -> None:
        """Heads of columns, and units under them; `right` names the columns of numbers."""
        styles = ("right" if c in right else "unit" if c != "A" else "" for c in columns)
        cells = (text(w, f"head {style}".rstrip()) for w, style in zip(words, styles, strict=True))
        self.put(**dict(zip(columns, cells, strict=True)))
        if units:
            under = (None if unit is None else text(unit, "unit right") for unit in units)
            self.put(**dict(zip(columns, under, strict=True)))

    def table(self, name: str, right: str, frozen: str) -> None:
        """Heads with their columns' widths: they stay in sight and head every printed page.

        name: among the `columns` of `sheets.toml`. frozen: the first column that scrolls.
        """
        columns = tables()["columns"][name]
        letters = "ABCDEFGHIJKLM"[: len(columns)]
        self.widths = {letter: width for letter, (_, width) in zip(letters, columns, strict=True)}
        self.repeated_rows, self.frozen = (self.row, self.row), f"{frozen}{self.row + 1}"
        self.heads(letters, [words for words, _ in columns], right)

    def draw(self, series: list[tuple[Place, str, str]], written: str) -> None:
        """The sheet's chart of `sheets.toml`; `written` is the "$written" of its description."""
        settings = tables()["charts"][self.name]
        description = Template(settings["description"]).substitute(written=written)
        self.chart = Chart(**{**settings, "description": description}, series=series)

    def color(self, cells: str, styles: Mapping[str, str]) -> None:
        """The style that each text has in these cells of one column."""
        first = cells.partition(":")[0]
        for words, style in styles.items():
            self.rules.append(Rule(cells, f'=${first}="{words}"', style))

    def lines(
        self, ledger: Ledger, part: str, lines: Sequence[Line | str], columns: str = "ABCDEF"
    ) -> None:
        """A table of one quantity a line; a plain string heads a block, after a blank row.

        part: what its keys begin with. columns: of symbol, meaning, value, unit, printed text,
        source. A line is transcendental that calls such a function or such a line above it.
        """
        heads = [words for words, _ in tables()["columns"]["lines"]]
        self.heads(columns, heads, columns[2] + columns[4])
        addresses: dict[str, str] = {}
        transcendental: set[str] = set()
        for number, line in enumerate(lines):
            if isinstance(line, str):
                self.row += number > 0
                self.put(**{columns[0]: text(line, "block")})
                continue
            called = set(re.findall(r"{(\w+)}", line.formula))
            if re.search(r"LN\(|SIN\(|\^", line.formula) or called & transcendental:
                transcendental.add(line.id)
            expression = line.formula.format_map(addresses)
            addresses[line.id] = f"{columns[2]}{self.row}"
            value = formula(
                f"{part}.{line.key}", guarded(expression) if line.guard else expression,
                number_format=line.shown, name=line.name, unit=line.unit, column=line.column,
                transcendental=line.id in transcendental,
            )  # fmt: skip
            source = line.source or (str(ledger.claims[line.claim].place) if line.claim else "")
            cells = (
                line.symbol and text(line.symbol, "text"),
                line.meaning and text(line.meaning),
                value,
                unit_text(line.unit),
                line.claim and printed(ledger, line.claim, line.unit),
                source and text(source, "unit"),
            )
            self.put(**dict(zip(columns, cells, strict=True)))


@dataclass(frozen=True, kw_only=True)
class WorkbookPlan:
    """The sheets in order. No key stands twice, nor does a defined name, in whatever case."""

    sheets: tuple[SheetPlan, ...]
    title: str
    properties: Mapping[str, str] = field(default_factory=dict)

    def cells(self) -> Iterator[tuple[Place, Cell]]:
        """Every cell with its place, sheet by sheet."""
        for sheet in self.sheets:
            for address, cell in sheet.cells.items():
                yield (sheet.name, address), cell

    @cached_property
    def where(self) -> Mapping[str, Place]:
        """Key -> the place of the cell that holds it."""
        return {cell.key: place for place, cell in self.cells() if cell.key}


def place_of(text: str) -> Place:
    """A place that is written as in a formula, without quotes.

    >>> place_of("Table A-1!B3")
    ('Table A-1', 'B3')
    """
    sheet, _, address = text.rpartition("!")
    return sheet, address


# Formulas

_REFERENCE = re.compile(
    r"""(?P<skip>"[^"]*"|(?:'[^']*'!)?\$?[A-Z]{1,2}\$?\d+:\$?[A-Z]{1,2}\$?\d+|[A-Za-z]\w*\()
    |(?P<cell>(?:'[^']*'!)?\$?\b[A-Z]{1,2}\$?\d+\b|\b[A-Za-z]\w*\b)""",
    re.VERBOSE,
)


def guarded(expression: str) -> str:
    """The formula, calculated where all that it refers to are numbers.

    Elsewhere it says that nothing was computed. A mere reference is left as it is: it shows what it
    refers to.

    >>> guarded("=2*R_p"), guarded("=R_p")
    ('=IF(COUNT(R_p)=1,2*R_p,"not computed")', '=R_p')
    """
    called = [match["cell"] for match in _REFERENCE.finditer(expression)]
    names = list(dict.fromkeys(name for name in called if name))
    if not names or expression == f"={names[0]}":
        return expression
    return f'=IF(COUNT({",".join(names)})={len(names)},{expression[1:]},"{NOT_COMPUTED}")'


def log1p(x: str) -> str:
    """The formula of ln(1 + x) for the cell x > 0, to the last digits however small x is.

    Where 1 + x is rounded to u, ln(u) is right for u: times x/(u - 1) it is right for x. Below 1e-8
    the series is, whose third term is less than the last digit of the first.
    """
    return f"IF({x}<0.00000001,{x}-{x}*{x}/2,{x}*LN(1+{x})/((1+{x})-1))"

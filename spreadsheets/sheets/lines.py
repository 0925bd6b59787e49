"""The table that most sheets are made of: one quantity a line, its value, unit and source."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from textwrap import wrap

from reference.ledger import Ledger
from reference.units import written
from spreadsheets.plan import Cell

__all__ = [
    "HOME",
    "NOT_COMPUTED",
    "WIDTHS",
    "Line",
    "column_heads",
    "guarded",
    "heads",
    "live",
    "log1p",
    "notes",
    "place",
    "printed",
    "title",
]

NOT_COMPUTED = "not computed"
"""What stands in place of a value that hangs on an input that cannot be used."""

HOME = "Overview"
"""The first sheet, to which a link leads back from every other."""

HEADS = ("Symbol", "Quantity", "Value", "Unit", "The report prints", "Equation or place")
WIDTHS = (9.0, 44.0, 14.0, 8.0, 20.0, 46.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """One quantity; `claim` is where the report prints it, `source` what tells more than that.

    Formulas call other lines of the same table by their `id` in braces. `guard`: they are
    calculated only where all that they refer to are numbers.
    """

    symbol: str
    meaning: str
    cell: Cell
    claim: str = ""
    source: str = ""
    guard: bool = True

    @property
    def id(self) -> str:
        """The key without its sheet: "frank_zook.rha.derived" is called {rha_derived}."""
        return self.cell.key.partition(".")[2].replace(".", "_")


def live(
    key: str,
    symbol: str,
    meaning: str,
    formula: str,
    unit: str = "1",
    source: str = "",
    *,
    claim: str = "",
    number_format: str = "0.0000",
    style: str = "number",
    name: str = "",
    transcendental: bool = False,
    column: str = "",
    guard: bool = True,
) -> Line:
    """A line whose value is a formula."""
    cell = Cell(
        key=key,
        formula=formula,
        style=style,
        number_format=number_format,
        name=name,
        unit=unit,
        transcendental=transcendental,
        column=column,
    )
    return Line(
        symbol=symbol, meaning=meaning, cell=cell, claim=claim, source=source, guard=guard
    )


_REFERENCE = re.compile(
    r"""(?P<skip>"[^"]*"|(?:'[^']*'!)?\$?[A-Z]{1,2}\$?\d+:\$?[A-Z]{1,2}\$?\d+|[A-Za-z]\w*\()
    |(?P<cell>(?:'[^']*'!)?\$?\b[A-Z]{1,2}\$?\d+\b|\b[A-Za-z]\w*\b)""",
    re.VERBOSE,
)


def guarded(formula: str) -> str:
    """The formula, calculated where all that it refers to are numbers.

    Elsewhere it says that nothing was computed. A mere reference is left as it is: it shows what it
    refers to.

    >>> guarded("=2*R_p"), guarded("=R_p")
    ('=IF(COUNT(R_p)=1,2*R_p,"not computed")', '=R_p')
    """
    found = [match["cell"] for match in _REFERENCE.finditer(formula)]
    names = list(dict.fromkeys(name for name in found if name))
    if not names or formula == f"={names[0]}":
        return formula
    counted = f"COUNT({','.join(names)})={len(names)}"
    return f'=IF({counted},{formula[1:]},"{NOT_COMPUTED}")'


def log1p(x: str) -> str:
    """The formula of ln(1 + x) for the cell x > 0, to the last digits however small x is.

    Where 1 + x is rounded to u, ln(u) is right for u: times x/(u - 1) it is right for x. Below 1e-8
    the series is, whose third term is less than the last digit of the first.
    """
    return f"IF({x}<0.00000001,{x}-{x}*{x}/2,{x}*LN(1+{x})/((1+{x})-1))"


def printed(ledger: Ledger, name: str, unit: str = "1", style: str = "printed") -> Cell:
    """The text of a claim as the report prints it, with its unit where that is another."""
    claim = ledger.claims[name]
    own = "" if claim.unit == unit else f" {written(claim.unit)}"
    return Cell(text=f"{claim.shown}{own}".rstrip(), style=style, claim=name)


def title(text: str) -> dict[str, Cell]:
    """The first two rows of a sheet: its title, and the way back."""
    back = Cell(text=f"Back to {HOME}", style="link", link=(HOME, "A1"))
    return {"A1": Cell(text=text, style="title"), "A2": back}


def notes(row: int, *texts: str, width: int = 130, column: str = "A") -> dict[str, Cell]:
    """Texts from `row` down, broken into lines that fit a page."""
    lines = [line for text in texts for line in wrap(text, width)]
    return {f"{column}{at}": Cell(text=line, style="note") for at, line in enumerate(lines, row)}


def heads(row: int, columns: str = "ABCDEF") -> dict[str, Cell]:
    """The column heads of the table, in that row."""
    styles = ("head", "head", "head right", "head unit", "head right", "head unit")
    return column_heads(row, columns, list(zip(HEADS, styles, strict=True)))


def column_heads(
    row: int, columns: Sequence[str], texts: Sequence[tuple[str, str]]
) -> dict[str, Cell]:
    """Column heads, given as text and style."""
    return {
        f"{column}{row}": Cell(text=text, style=style)
        for column, (text, style) in zip(columns, texts, strict=True)
    }


def place(
    ledger: Ledger, lines: Sequence[Line | str], row: int, columns: str = "ABCDEF"
) -> dict[str, Cell]:
    """Lay out lines from `row` down; a plain string heads a block, after a blank row.

    `columns` names the six columns taken: symbol, meaning, value, unit, printed text, source.
    """
    rows = _rows(lines, row)
    addresses = {
        line.id: f"{columns[2]}{at}" for at, line in rows.items() if isinstance(line, Line)
    }
    cells: dict[str, Cell] = {}
    for at, line in rows.items():
        if isinstance(line, str):
            cells[f"{columns[0]}{at}"] = Cell(text=line, style="block")
        else:
            cells |= _line(ledger, line, at, columns, addresses)
    return cells


def _rows(lines: Sequence[Line | str], row: int) -> dict[int, Line | str]:
    rows: dict[int, Line | str] = {}
    for line in lines:
        if isinstance(line, str) and rows:
            row += 1
        rows[row] = line
        row += 1
    return rows


def _line(
    ledger: Ledger, line: Line, row: int, columns: str, addresses: dict[str, str]
) -> dict[str, Cell]:
    value = line.cell
    if value.formula:
        formula = value.formula.format_map(addresses)
        value = replace(value, formula=guarded(formula) if line.guard else formula)
    source = line.source or (str(ledger.claims[line.claim].place) if line.claim else "")
    texts = (
        (0, line.symbol, "text"),
        (1, line.meaning, "body"),
        (3, written(value.unit) or ("–" if value.style == "number" else ""), "unit"),
        (5, source, "unit"),
    )
    cells = {f"{columns[at]}{row}": Cell(text=t, style=style) for at, t, style in texts if t}
    if line.claim:
        cells[f"{columns[4]}{row}"] = printed(ledger, line.claim, value.unit)
    return cells | {f"{columns[2]}{row}": value}

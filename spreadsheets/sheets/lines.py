"""What sheets are made of: cells, notes, and tables of one quantity a line."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import Any

from reference.ledger import Ledger
from reference.units import written
from spreadsheets.plan import Cell, Rule, SheetPlan

NOT_COMPUTED = "not computed"
"""What stands in place of a value that hangs on an input that cannot be used."""

HOME = "Overview"
"""The first sheet, to which a link leads back from every other."""


def text(words: str, style: str = "body", **more: Any) -> Cell:
    """A cell with a text."""
    return Cell(text=words, style=style, **more)


def formula(key: str, expression: str, style: str = "number", **more: Any) -> Cell:
    """A cell with a formula, given with its "="; its value is supplied under the key."""
    return Cell(key=key, formula=expression, style=style, **more)


def row_of(row: int, cells: dict[str, Cell]) -> dict[str, Cell]:
    """Cells by address, given by column."""
    return {f"{column}{row}": cell for column, cell in cells.items()}


def heads(
    row: int, columns: Iterable[str], texts: Iterable[str], right: str = ""
) -> dict[str, Cell]:
    """Column heads; `right` names the columns of numbers, which are aligned to the right."""
    return {
        f"{column}{row}": text(
            words, "head right" if column in right else "head" if column == "A" else "head unit"
        )
        for column, words in zip(columns, texts, strict=True)
    }


def title(words: str) -> dict[str, Cell]:
    """The first two rows of a sheet: its title, and the way back."""
    return {"A1": text(words, "title"), "A2": text(f"Back to {HOME}", "link", link=(HOME, "A1"))}


def notes(row: int, *texts: str, width: int = 165, column: str = "A") -> dict[str, Cell]:
    """Texts from `row` down, broken into lines that fit a page."""
    lines = [line for words in texts for line in wrap(words, width, break_on_hyphens=False)]
    return {f"{column}{at}": text(line, "note") for at, line in enumerate(lines, row)}


def printed(ledger: Ledger, name: str, unit: str = "1", **more: Any) -> Cell:
    """The text of a claim as the report prints it, with its unit where that is another."""
    claim = ledger.claims[name]
    own = "" if claim.unit == unit else f" {written(claim.unit)}"
    return text(f"{claim.shown}{own}".rstrip(), "printed", claim=name, **more)


def colored(cells: str, styles: Mapping[str, str]) -> tuple[Rule, ...]:
    """The style that each text has in these cells of one column."""
    first = cells.partition(":")[0]
    return tuple(
        Rule(cells=cells, formula=f'=${first}="{words}"', style=style)
        for words, style in styles.items()
    )


def unit_text(unit: str) -> Cell:
    """The unit beside a number."""
    return text(written(unit) or "–", "unit")


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
    found = [match["cell"] for match in _REFERENCE.finditer(expression)]
    names = list(dict.fromkeys(name for name in found if name))
    if not names or expression == f"={names[0]}":
        return expression
    return f'=IF(COUNT({",".join(names)})={len(names)},{expression[1:]},"{NOT_COMPUTED}")'


def log1p(x: str) -> str:
    """The formula of ln(1 + x) for the cell x > 0, to the last digits however small x is.

    Where 1 + x is rounded to u, ln(u) is right for u: times x/(u - 1) it is right for x. Below 1e-8
    the series is, whose third term is less than the last digit of the first.
    """
    return f"IF({x}<0.00000001,{x}-{x}*{x}/2,{x}*LN(1+{x})/((1+{x})-1))"


@dataclass(frozen=True, slots=True)
class Line:
    """One quantity: its key, symbol, meaning, formula, unit, and the equation that it comes from.

    The key is that within its sheet: "rha.derived". The formula calls other lines of its table by
    their `id` in braces; `guard`: see `guarded`. claim: where the report prints the value. shown:
    the number format. Others: as in `Cell`.
    """

    key: str
    symbol: str
    meaning: str
    formula: str
    unit: str = "1"
    source: str = ""
    claim: str = ""
    shown: str = "0.0000"
    style: str = "number"
    name: str = ""
    column: str = ""
    guard: bool = True

    @property
    def id(self) -> str:
        """What formulas call it: "rha.derived" is {rha_derived}."""
        return self.key.replace(".", "_")


def place(
    ledger: Ledger, part: str, lines: Sequence[Line | str], row: int, columns: str = "ABCDEF"
) -> dict[str, Cell]:
    """A table with its heads in `row`; a plain string heads a block, after a blank row.

    part: what its keys begin with. columns: of symbol, meaning, value, unit, printed text, source.
    A line is transcendental that calls such a function or such a line above it.
    """
    words = ("Symbol", "Quantity", "Value", "Unit", "The report prints", "Equation or place")
    cells = heads(row, columns, words, columns[2] + columns[4])
    rows: dict[int, Line | str] = {}
    for line in lines:
        row += 2 if isinstance(line, str) and rows else 1
        rows[row] = line
    addresses = {line.id: f"{columns[2]}{at}" for at, line in rows.items() if type(line) is Line}
    transcendental: set[str] = set()
    for at, line in rows.items():
        if isinstance(line, str):
            cells[f"{columns[0]}{at}"] = text(line, "block")
            continue
        called = set(re.findall(r"{(\w+)}", line.formula))
        if re.search(r"LN\(|SIN\(|\^", line.formula) or called & transcendental:
            transcendental.add(line.id)
        expression = line.formula.format_map(addresses)
        value = formula(
            f"{part}.{line.key}",
            guarded(expression) if line.guard else expression,
            line.style,
            number_format=line.shown,
            name=line.name,
            unit=line.unit,
            column=line.column,
            transcendental=line.id in transcendental,
        )
        source = line.source or (str(ledger.claims[line.claim].place) if line.claim else "")
        of_line = {
            columns[0]: text(line.symbol, "text") if line.symbol else None,
            columns[1]: text(line.meaning) if line.meaning else None,
            columns[2]: value,
            columns[3]: unit_text(line.unit) if line.style == "number" else None,
            columns[4]: printed(ledger, line.claim, line.unit) if line.claim else None,
            columns[5]: text(source, "unit") if source else None,
        }
        cells |= {f"{column}{at}": cell for column, cell in of_line.items() if cell}
    return cells


def sheet_of_lines(
    ledger: Ledger, name: str, heading: str, said: Sequence[str], lines: Sequence[Line | str]
) -> SheetPlan:
    """A sheet of one table under notes; its keys begin with its name."""
    above = title(heading) | notes(3, *said)
    row = 2 + len(above)
    return SheetPlan(
        name=name,
        cells=above | place(ledger, name.lower().replace("-", "_"), lines, row),
        widths=dict(zip("ABCDEF", (9.0, 44.0, 14.0, 8.0, 20.0, 46.0), strict=True)),
        frozen=f"A{row + 1}",
        repeated_rows=(row, row),
    )

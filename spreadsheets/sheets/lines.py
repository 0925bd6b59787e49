"""The table that most sheets are made of: one quantity a line, its value, unit and source."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from spreadsheets.plan import Cell

__all__ = ["CHECK_INPUTS", "HEADS", "WIDTHS", "Line", "heads", "live", "place", "valid_only"]

CHECK_INPUTS = "check the inputs"
"""What stands in place of a value while an input is out of range."""

HEADS = ("Symbol", "Quantity", "Value", "Unit", "The report prints", "Equation or section")
WIDTHS = (9.0, 41.0, 15.0, 8.0, 17.0, 54.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """One quantity. Formulas call other lines of the same table by their `id` in braces."""

    symbol: str
    meaning: str
    cell: Cell
    printed: str = ""

    @property
    def id(self) -> str:
        """The key without its sheet: "frank_zook.RHA.derived" is called {RHA_derived}."""
        return self.cell.key.partition(".")[2].replace(".", "_")


def live(
    key: str,
    symbol: str,
    meaning: str,
    formula: str,
    unit: str = "",
    source: str = "",
    *,
    printed: str = "",
    number_format: str = "0.0000",
    style: str = "number",
    name: str = "",
    transcendental: bool = False,
) -> Line:
    """A line whose value is a formula, calculated while all inputs are in range."""
    cell = Cell(
        key=key,
        formula=valid_only(formula),
        style=style,
        number_format=number_format,
        name=name,
        unit=unit,
        source=source,
        transcendental=transcendental,
    )
    return Line(symbol=symbol, meaning=meaning, cell=cell, printed=printed)


def valid_only(formula: str) -> str:
    """The formula, with a message in place of its value while an input is out of range.

    A mere reference is left as it is: it shows what it refers to.

    >>> valid_only("=2*R_p"), valid_only("=R_p")
    ('=IF(inputs_ok=1,2*R_p,"check the inputs")', '=R_p')
    """
    if re.fullmatch(r"=\w+", formula) or "inputs_ok" in formula:
        return formula
    return f'=IF(inputs_ok=1,{formula[1:]},"{CHECK_INPUTS}")'


def heads(row: int, columns: str = "ABCDEF") -> dict[str, Cell]:
    """The column heads, in that row."""
    styles = ("head", "head", "head right", "head unit", "head right", "head unit")
    return {
        f"{column}{row}": Cell(text=text, style=style)
        for column, text, style in zip(columns, HEADS, styles, strict=True)
    }


def place(lines: Sequence[Line | str], row: int, columns: str = "ABCDEF") -> dict[str, Cell]:
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
            cells |= {f"{columns[0]}{at}": Cell(text=line, style="block")}
        else:
            cells |= _line(line, at, columns, addresses)
    return cells


def _rows(lines: Sequence[Line | str], row: int) -> dict[int, Line | str]:
    rows: dict[int, Line | str] = {}
    for line in lines:
        if isinstance(line, str) and rows:
            row += 1
        rows[row] = line
        row += 1
    return rows


def _line(line: Line, row: int, columns: str, addresses: dict[str, str]) -> dict[str, Cell]:
    value = line.cell
    if value.formula:
        value = replace(value, formula=value.formula.format_map(addresses))
    unit = "–" if value.unit == "1" else value.unit
    texts = (line.symbol, line.meaning, "", unit, line.printed, value.source)
    styles = ("symbol", "body", "", "unit", "printed", "source")
    cells = {
        f"{column}{row}": Cell(text=text, style=style)
        for column, text, style in zip(columns, texts, styles, strict=True)
        if text
    }
    return cells | {f"{columns[2]}{row}": value}

"""Workbooks in which other people lay out the report's sheet, before they are files.

Rows are numbered as in the report: row 0 is the impact, row 1 the first step. `byhand.py` has the
layouts, `faults.py` plants faults in the workbooks, `writers.py` writes them to files.
"""

import re
from collections.abc import Callable
from dataclasses import asdict, dataclass, field, replace
from decimal import Decimal
from functools import cache

from openpyxl.formula.translate import Translator
from openpyxl.utils.cell import coordinate_to_tuple, get_column_letter, range_boundaries

from replication.models.impact import Impact
from replication.models.sheet import Sheet, run

Place = tuple[str, int, int]
"""Sheet, row and column, both counted from 1."""
Content = str | float | None
"""What a cell holds; None leaves it blank."""

TIME = "time"
START = "velocity_initial"
DEPTH = "depth"
BRAKE = "deceleration"
END = "velocity_final"

letters = get_column_letter


def place(sheet: str, address: str) -> Place:
    """The place of a cell that is written as B7."""
    return (sheet, *coordinate_to_tuple(address))


@dataclass
class Foreign:
    """A workbook before it is a file: its cells, and where its columns and inputs are."""

    name: str
    impact: Impact
    cells: dict[Place, str | float] = field(default_factory=dict)
    where: dict[tuple[str, int], Place] = field(default_factory=dict)
    inputs: dict[str, Place] = field(default_factory=dict)
    names: dict[str, str] = field(default_factory=dict)
    rows: int | None = None
    """The number of rows of its tables, if not as many as the impact needs."""
    si: bool = True
    """Whether all cells are in SI units, so that last digits can be judged."""

    @property
    def steps(self) -> int:
        return calculated(self.impact).steps

    @property
    def another(self) -> Impact:
        """The impact of the second table, if there is one: of the report's other beta."""
        return replace(self.impact, beta=3.0 if self.impact.beta == 5 else 5.0)

    def put(self, sheet: str, address: str, content: str | float) -> None:
        self.cells[place(sheet, address)] = content


@cache
def calculated(impact: Impact) -> Sheet:
    """The report's sheet of an impact."""
    return run(impact)


@dataclass(frozen=True)
class Input:
    """The cell of an input, which holds so many units for one SI unit."""

    role: str
    per: float = 1.0


@dataclass(frozen=True)
class Own:
    """The scheme's own numbers of a column, as a program writes them, in this format."""

    role: str
    per: float = 1.0
    form: str = ""


def decimal(number: float) -> str:
    """A number without an exponent, as some type it into a formula."""
    return format(Decimal(repr(number)), "f").removesuffix(".0")


def printed(number: float) -> float:
    """A number with the digits of the report's table."""
    return float(f"{number:.2e}")


class Page:
    """A sheet that is being filled."""

    def __init__(self, f: Foreign, sheet: str) -> None:
        self.f, self.sheet = f, sheet

    def row(self, address: str, *contents: Content | Input) -> None:
        """Fill cells side by side from an address on."""
        impact = self.f.impact
        values = asdict(impact) | {
            "diameter": impact.diameter, "mass": impact.mass,
            "resistance": impact.target_resistance,
        }  # fmt: skip
        sheet, row, column = place(self.sheet, address)
        for i, content in enumerate(contents):
            at = (sheet, row, column + i)
            if isinstance(content, Input):
                self.f.inputs[content.role] = at
                self.f.cells[at] = float(f"{values[content.role] * content.per:.12g}")
            elif content is not None:
                self.f.cells[at] = content

    def table(
        self, zero: int, *, heads: int | None = None, steps: int | None = None,
        across: bool = False, another: bool = False,
    ) -> "Table":  # fmt: skip
        """A table with the impact in row (or column) `zero`; `another` has the other beta."""
        impact = self.f.another if another else self.f.impact
        count = self.f.rows or steps or calculated(impact).steps
        return Table(self.f, self.sheet, zero, heads or zero - 1, count, across, not another)


@dataclass
class Table:
    """A table; `own`: its steps are those of the impact."""

    f: Foreign
    sheet: str
    zero: int
    heads: int
    steps: int
    across: bool = False
    own: bool = True

    @property
    def last(self) -> int:
        return self.zero + self.steps

    def place(self, line: str, k: int) -> Place:
        """The cell of step k in a line of the table."""
        if self.across:
            return self.sheet, int(line), self.zero + k
        return place(self.sheet, f"{line}{self.zero + k}")

    def column(
        self, line: str, head: str, role: str, zero: Content,
        rest: Content | Own | Callable[[int], Content], first: Content = None,
    ) -> None:  # fmt: skip
        """Fill a line: row 0; row 1 if it is special; the rest, from its first formula on.

        The formula moves as a spreadsheet fills it; a function gives the content of step k.
        """
        if head:
            self.f.put(self.sheet, f"{line}{self.heads}", head)
        begin = 1 if first is None else 2
        for k in range(self.steps + 1):
            at = self.place(line, k)
            content = zero if k == 0 else first if k < begin else self._rest(rest, k, begin)
            if k == 0 and isinstance(content, Own):
                content = self._rest(content, 0, 0)
            if content is not None:
                self.f.cells[at] = content
                if role and self.own and k <= self.f.steps:
                    self.f.where[role, k] = at

    def _rest(
        self, rest: "Content | Own | Callable[[int], Content]", k: int, begin: int
    ) -> Content:
        if isinstance(rest, Own):
            value = getattr(calculated(self.f.impact).rows[k], rest.role)
            return float(f"{value * rest.per:{rest.form}}")
        if callable(rest):
            return rest(k)
        if isinstance(rest, str) and rest.startswith("="):
            return filled(rest, *((0, k - begin) if self.across else (k - begin, 0)))
        return rest


@cache
def filled(formula: str, down: int, right: int = 0) -> str:
    """A formula copied so many rows down and columns to the right."""
    to = f"{letters(1 + right)}{9999 + down}"
    return str(Translator(formula, origin="A9999").translate_formula(to))


def insert(f: Foreign, at: str, count: int) -> None:
    """Insert rows before a row, or columns before a column."""
    if at.isdigit():
        move(f, at, count, 0)
    else:
        move(f, f"{at}1:ZZ99999", 0, count)


def move(f: Foreign, cells: str, down: int, right: int) -> None:
    """Cut an area, or all cells from a row on, and paste it elsewhere, over what is there."""
    area = f"A{cells}:ZZ99999" if cells.isdigit() else cells
    left, top, last, bottom = range_boundaries(area)

    def to(row: int, column: int) -> tuple[int, int]:
        inside = top <= row <= bottom and left <= column <= last
        return (row + down, column + right) if inside else (row, column)

    over = {to(r, c) for _, r, c in f.cells if to(r, c) != (r, c)}
    f.cells = {p: v for p, v in f.cells.items() if p[1:] not in over or to(*p[1:]) != p[1:]}
    relocate(f, to)


def relocate(f: Foreign, to: Callable[[int, int], tuple[int, int]]) -> None:
    """Move cells of the only sheet, as a spreadsheet does, together with the references to them."""

    def address(match: re.Match[str]) -> str:
        row, column = to(*place("", f"{match[2]}{match[4]}")[1:])
        return f"{match[1]}{letters(column)}{match[3]}{row}"

    def content(c: str | float) -> str | float:
        if isinstance(c, str) and c.startswith("="):
            return re.sub(r"(\$?)\b([A-Z]{1,2})(\$?)(\d+)\b(?!\()", address, c)
        return c

    f.cells = {(s, *to(r, c)): content(v) for (s, r, c), v in f.cells.items()}

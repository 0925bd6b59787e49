"""Workbooks in which other people lay out the report's sheet, as described in `layouts.txt`.

Rows are numbered as in the report: row 0 is the impact, row 1 the first step. `faults.py` plants
faults in the workbooks, `writers.py` writes them to files.
"""

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

from openpyxl.utils.cell import (
    column_index_from_string,
    coordinate_to_tuple,
    get_column_letter,
    range_boundaries,
)

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
    si: bool = True
    """Whether all cells are in SI units, so that last digits can be judged."""

    @property
    def steps(self) -> int:
        return calculated(self.impact).steps

    def put(self, sheet: str, address: str, content: str | float) -> None:
        self.cells[place(sheet, address)] = content


@cache
def calculated(impact: Impact) -> Sheet:
    """The report's sheet of an impact."""
    return run(impact)


TEXTS = {
    block.partition("\n")[0]: block.splitlines()[2:]
    for block in Path(__file__).with_name("layouts.txt").read_text("utf-8").split("\n## ")[1:]
}
"""The lines of each layout, without its name and the line that describes it."""

BY_HAND = tuple(name for name in TEXTS if name not in ("plain", "middle", "empty"))


class Table(NamedTuple):
    """A table with row 0 in row (or column) `zero`; `own`: its steps are those of the impact."""

    zero: int
    heads: int
    steps: int
    across: bool
    own: bool

    def place(self, sheet: str, line: str, k: int) -> Place:
        """The cell of step k in a line of the table."""
        if self.across:
            return sheet, int(line), self.zero + k
        return place(sheet, f"{line}{self.zero + k}")


def made(layout: str, impact: Impact, rows: int | None = None) -> Foreign:
    """Fill a layout with an impact, in as many rows as that needs, or in a given number."""
    f, sheet, table = Foreign(layout, impact), "", Table(0, 0, 0, False, False)
    resistance, another = impact.target_resistance, 3.0 if impact.beta == 5 else 5.0
    numbers = asdict(impact) | {
        "diameter": impact.diameter, "mass": impact.mass, "resistance": resistance,
        "gpa": resistance / 1e9, "dyn": resistance * 10, "another": another,
    }  # fmt: skip
    for line in filter(None, TEXTS[layout]):
        word, _, rest = line.partition(" ")
        first, *parts = (part.strip() for part in line.split("|"))
        if first[-1].isdigit() and first[0].isalpha() and parts:
            _, row, column = place(sheet, first)
            for c, text in enumerate(parts, column):
                role, colon, own = text.partition(":")
                if colon and role in numbers:
                    f.inputs[role], text = (sheet, row, c), own.strip() or f"{{{role}}}"
                content = filled(text, **numbers, last=table.zero + table.steps)
                if content is not None:
                    f.cells[sheet, row, c] = content
        elif parts:
            add_column(f, sheet, table, first, *parts)
        elif word == "table":
            options = dict(re.findall(r"(heads|steps) (\d+)", rest))
            start, across = rest.split()[0], "across" in rest
            zero = column_index_from_string(start) if across else int(start)
            own = "another" not in rest
            steps = f.steps if own else calculated(replace(impact, beta=another)).steps
            table = Table(zero, int(options.get("heads", zero - 1)),
                          rows or int(options.get("steps", steps)), across, own)  # fmt: skip
        elif word == "sheet":
            sheet = rest
        elif word == "name":
            name, _, meaning = rest.partition(" ")
            f.names[name] = meaning.format(**numbers)
        else:
            f.si = False
    return f


def add_column(
    f: Foreign, sheet: str, table: Table, line: str, head: str, role: str, zero: str, rest: str,
    first: str = "",
) -> None:  # fmt: skip
    """Fill a column of a table: row 0, then the first row if it is special, then the rest."""
    if head:
        f.put(sheet, f"{line}{table.heads}", head)
    steps = calculated(f.impact).rows
    for k in range(table.steps + 1):
        cell, before = table.place(sheet, line, k), table.place(sheet, line, k - 1)
        own, previous = (letters(at[2]) if table.across else at[1] for at in (cell, before))
        row = {}
        if k < len(steps):
            row = dict(zip(("t", "v0", "x", "a", "v1"), steps[k], strict=True))
            row |= {"t_ns": row["t"] * 1e9, "x_um": row["x"] * 1e6}
        text = zero if k == 0 else first if k == 1 and first else rest
        content = filled(text, r=own, p=previous, k=k, **row)
        if content is not None:
            f.cells[cell] = content
            if role and table.own and k <= f.steps:
                f.where[role, k] = cell


def filled(text: str, **values: object) -> Content:
    """Fill values into a content; if it is then JSON, read it: a number, a truth value, a text."""
    text = text.format(**values)
    try:
        return json.loads(text or "null")
    except ValueError:
        return text


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


def change(f: Foreign, address: str, text: str) -> None:
    """Give cells other contents, as `contents` reads them; an empty text clears them."""
    for cell, content in contents(f, address, text):
        if content is None:
            f.cells.pop(cell, None)
        else:
            f.cells[cell] = content


def contents(f: Foreign, address: str, text: str) -> Iterator[tuple[Place, Content]]:
    """The cells that an address of `cases.txt` stands for, and what each of them is to hold."""
    sheet, _, cells = address.rpartition("!")
    sheet = sheet or next((at[0] for at in f.cells), "Sheet1")
    first, *until = cells.split(":")
    _, row, column = place(sheet, first)
    last = row
    if until:
        last = int(until[0] or max(at[1] for at in f.cells if at[0] == sheet))
    rows = dict(enumerate(calculated(f.impact).rows))
    for r in range(row, last + 1, int(until[1]) if until[1:] else 1):
        known = {"r": r, "p": r - 1, "k": r - 8, "t": (r - 8) * 5e-10}
        if scheme := rows.get(r - 8):
            known |= {"v0": scheme.velocity_initial, "v1": scheme.velocity_final}
            known |= {"x": scheme.depth, "a": scheme.deceleration}
        for c, part in enumerate(text.split(" / "), column):
            yield (sheet, r, c), filled(part, **known)

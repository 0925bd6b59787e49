"""Changes to a workbook, as somebody makes them in a spreadsheet; and a right workbook changed so.

A cell is written B5 on the first sheet, else Sheet!B5. Formulas are filled down as a spreadsheet
does it: references without $ move with the row.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from foreign import writers
from foreign.byhand import BY_HAND, made
from foreign.drawn import drawn
from foreign.layouts import Content, Foreign, Place, calculated, filled, insert, move, place
from foreign.truth import Truth
from openpyxl.utils.cell import range_boundaries

from replication.cases import BETA_5

COARSE = replace(BETA_5, step=5e-10)
"""The report's other step: 53 rows, so that many workbooks take little time."""

Edit = Callable[[Foreign], None]
"""Changes a workbook."""


def cell(f: Foreign, address: str) -> Place:
    """The place of an address; without a sheet's name, on the first sheet."""
    sheet, _, own = address.rpartition("!")
    return place(sheet or next((at[0] for at in f.cells), "Sheet1"), own)


def put(address: str, *contents: Content) -> Edit:
    """Type contents into a cell and those at its right; None clears a cell."""

    def edit(f: Foreign) -> None:
        sheet, row, column = cell(f, address)
        for i, content in enumerate(contents):
            f.cells.pop((sheet, row, column + i), None)
            if content is not None:
                f.cells[sheet, row, column + i] = content

    return edit


def clear(*areas: str) -> Edit:
    """Clear areas."""

    def edit(f: Foreign) -> None:
        for area in areas:
            for at in _area(f, area):
                f.cells.pop(at, None)

    return edit


def fill(area: str, *formulas: Content, every: int = 1) -> Edit:
    """Fill formulas (or numbers, texts) down from the first row of an area of one column.

    Several are filled side by side. `every` fills only every so many rows.
    """

    def edit(f: Foreign) -> None:
        for sheet, row, column in _area(f, area)[::every]:
            for i, formula in enumerate(formulas):
                f.cells[sheet, row, column + i] = _moved(formula, row - _area(f, area)[0][1])

    return edit


def rows(area: str, content: Callable[[int], Content], *, every: int = 1) -> Edit:
    """Type into each row of an area of one column what a function gives for its number."""

    def edit(f: Foreign) -> None:
        for sheet, row, column in _area(f, area)[::every]:
            f.cells[sheet, row, column] = content(row)  # type: ignore[assignment]

    return edit


def numbers(area: str, role: str, form: str = "", *, every: int = 1) -> Edit:
    """Paste the scheme's own numbers of a column; row 8 of a plain sheet is the impact."""

    def edit(f: Foreign) -> None:
        steps = calculated(f.impact).rows
        for sheet, row, column in _area(f, area)[::every]:
            f.cells[sheet, row, column] = float(f"{getattr(steps[row - 8], role):{form}}")

    return edit


def name(own: str, meaning: str) -> Edit:
    """Define a name."""
    return lambda f: f.names.__setitem__(own, meaning)


def inserted(at: str, count: int) -> Edit:
    """Insert rows before a row, or columns before a column."""
    return lambda f: insert(f, at, count)


def moved(area: str, down: int, right: int) -> Edit:
    """Cut an area, or all from a row on, and paste it elsewhere, over what is there."""
    return lambda f: move(f, area, down, right)


def renamed(sheet: str) -> Edit:
    """Give the only sheet another name; its formulas do not say the old one."""

    def edit(f: Foreign) -> None:
        f.cells = {(sheet, r, c): content for (_, r, c), content in f.cells.items()}

    return edit


def copied(sheet: str) -> Edit:
    """Copy the only sheet."""

    def edit(f: Foreign) -> None:
        f.cells |= {(sheet, r, c): content for (_, r, c), content in f.cells.items()}

    return edit


def _area(f: Foreign, area: str) -> list[Place]:
    """The cells of an area, column by column."""
    sheet, _, own = area.rpartition("!")
    left, top, right, bottom = range_boundaries(own)
    sheet = sheet or cell(f, "A1")[0]
    return [(sheet, r, c) for c in range(left, right + 1) for r in range(top, bottom + 1)]


def _moved(content: Content, down: int) -> Content:
    """A content as it is filled down; only formulas change."""
    return filled(content, down) if isinstance(content, str) and content[:1] == "=" else content


@dataclass(frozen=True)
class Case:
    """A right workbook, the changes to it, and what is then true.

    `given` is --map, `stored` are stored values that are not what the formulas give.
    """

    title: str
    truth: Truth
    edits: tuple[Edit, ...] = ()
    layout: str = "plain"
    steps: int | None = None
    inputs: Mapping[str, float] = field(default_factory=dict)
    given: Mapping[str, str] = field(default_factory=dict)
    stored: Mapping[str, object] = field(default_factory=dict)

    def book(self) -> Foreign:
        """The workbook."""
        f = right(self.layout, self.steps, **self.inputs)
        for edit in self.edits:
            edit(f)
        return f

    def written(self, path: Path) -> Foreign:
        """Write the workbook to a file: with stored values only if some are false."""
        f = self.book()
        false = {cell(f, address): value for address, value in self.stored.items()}
        if false:
            writers.with_xlsxwriter(f, path, writers.calculated(f) | false)
        else:
            writers.barely(f, path)
        return f


def right(layout: str, steps: int | None = None, **inputs: float) -> Foreign:
    """The right workbook that a case starts from: of 0.5 ns if plain, else of 0.2 ns."""
    impact = BETA_5 if layout in BY_HAND else COARSE
    if layout.startswith("random-"):
        return drawn(int(layout.removeprefix("random-")), impact)
    return made(layout, replace(impact, **inputs), steps)


def case(
    title: str, truth: Truth, *edits: Edit, layout: str = "plain", steps: int | None = None,
    given: Mapping[str, str] | None = None, stored: Mapping[str, object] | None = None,
    **inputs: float,
) -> Case:  # fmt: skip
    """A case; inputs are those of the impact, in SI units."""
    return Case(title, truth, edits, layout, steps, inputs, given or {}, stored or {})

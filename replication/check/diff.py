"""Two workbooks side by side: what was inserted, removed or moved, then formulas, then values.

Rows and columns are aligned by what their cells are, not by what they hold: a heading by its text,
a formula by its operations, a number by being one. So a changed input is one difference, an
inserted row is one, and each formula is compared with where its references have gone.
"""

import math
from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from difflib import SequenceMatcher
from itertools import groupby, takewhile
from pathlib import Path

from openpyxl.utils.cell import get_column_letter

from replication.check.examination import Difference
from replication.check.table import runs, span
from replication.check.words import count
from spreadsheets.foreign import Position, Value, read
from spreadsheets.recalculation import Calculation, Formula, Piece, calculate, parse

KINDS = ("added", "removed", "moved", "name", "formula", "value")
"""What `diff` calls the differences that it finds."""

LAST = "only the last digits of the values differ"
_LAST_DIGITS = 1e-14
"""Relative distance within which that is said: files may keep 15 of them."""

_MAX_BLOCKS = 200
"""Blocks to look for elsewhere."""

Cell = tuple[int, int]


@dataclass(frozen=True)
class Tolerance:
    """How far apart two numbers may be and still be called equal; any of them suffices."""

    ulp: int = 0
    relative: float = 0.0
    digits: int | None = None

    def equal(self, a: float, b: float) -> bool:
        """Whether two numbers are.

        >>> Tolerance(digits=3).equal(7.6696, 7.6701), Tolerance(ulp=1).equal(1.0, 1.0 + 2**-52)
        (True, True)
        """
        if a == b or abs(a - b) <= self.relative * max(abs(a), abs(b)):
            return True
        if self.ulp and abs(a - b) <= self.ulp * math.ulp(max(abs(a), abs(b))):
            return True
        if self.digits is None:
            return False
        texts = [f"{number:.{self.digits - 1}e}" for number in (a, b)]
        # One may be the other rounded, ties either way; that may itself differ in its last bits.
        half = Decimal(f"0.5e{int(texts[0].partition('e')[2]) + 1 - self.digits}")
        near = abs(Decimal(repr(a)) - Decimal(repr(b))) <= half + 4 * Decimal(math.ulp(a))
        rounded = float(texts[0]) == a or float(texts[1]) == b
        return texts[0] == texts[1] or (rounded and near)


def diff(
    a: Path, b: Path, *, values_only: bool = False, allowed: Tolerance | None = None
) -> "Comparison":
    """Compare two workbooks. Raises WorkbookError for what cannot be read."""
    comparison = Comparison(calculate(read(a)), calculate(read(b)), allowed or Tolerance())
    comparison.layout()
    where = comparison.where
    pairs = sorted(where.items(), key=lambda pair: (pair[1][0], pair[1][2], pair[1][1]))
    if not values_only:
        comparison.names()
        comparison.group(pairs, comparison.formulas, "formula")
    comparison.group(pairs, comparison.values, "value")
    comparison.differences.sort(key=lambda d: d.rank)
    return comparison


class Comparison:
    """What `coldspray diff` has found, in order of calculation, and where.

    `where` is where each cell of the first workbook is in the second. Places of differences are
    those of the second workbook, if it has them.
    """

    def __init__(self, before: Calculation, after: Calculation, tolerance: Tolerance) -> None:
        self.before, self.after, self.tolerance = before, after, tolerance
        self.where: dict[Position, Position] = {}
        self.there: set[Position] = set()
        self.differences: list[Difference] = []

    def add(
        self, kind: str, cells: Sequence[Position], was: Value | None, now: Value | None, text: str
    ) -> None:
        """Add a difference at the first of some cells; layout first, last digits last."""
        place, sheets = cells[0], list(self.after.book.sheets)
        rank: tuple[float, ...] = (0, sheets.index(place[0]) if place[0] in sheets else 0)
        if kind in ("formula", "value"):  # typed cells, then formulas in order of calculation
            rank = (1, self.after.order.get(place, -1), kind == "value")
        if text.startswith(LAST):
            rank = (2, *rank)
        self.differences.append(Difference(kind, tuple(cells), was, now, text, rank))

    # ---- where each cell has gone

    def layout(self) -> None:
        """Match the sheets, then the rows and columns of each."""
        sheets = _same_sheets(self.before, self.after)
        for name in self.before.book.sheets:
            if name not in sheets:
                self.add("removed", [(name, 1, 1)], name, None, "the sheet is gone")
        for name in self.after.book.sheets:
            if name not in sheets.values():
                self.add("added", [(name, 1, 1)], None, name, "the sheet is new")
        for name, partner in sheets.items():
            if name != partner:
                self.add("moved", [(partner, 1, 1)], name, partner, "the sheet is renamed")
            self.align(name, partner)

    def align(self, name: str, partner: str) -> None:
        """Match the rows and columns of two sheets, then what was moved elsewhere."""
        old, new = _skeletons(self.before, name), _skeletons(self.after, partner)
        columns = _matched(_profiles(old), _profiles(new))
        rows = _matched(_lines(old, 0, columns.keys()), _lines(new, 0, set(columns.values())))
        left, free = dict(old), dict(new)

        def put(cell: Cell, there: Cell) -> None:
            self.where[name, *cell] = (partner, *there)
            self.there.add((partner, *there))
            del left[cell], free[there]

        for row, column in old:
            there = (rows.get(row, 0), columns.get(column, 0))
            kinds = old[row, column][0], new.get(there, "")[:1]
            # It may be the same cell, changed; but texts stay texts.
            if there in new and (kinds[0] == kinds[1] or "'" not in kinds):
                put((row, column), there)
        by_form: dict[frozenset[tuple[int, int, str]], list[Cell]] = {}
        for block in _blocks(free)[:_MAX_BLOCKS]:
            by_form.setdefault(_form(block, free), block)
        for block in _blocks(left)[:_MAX_BLOCKS]:
            # It stands elsewhere if the same cells are there at the same distances.
            new_block = by_form.pop(_form(block, left), None)
            for cell, there in zip(block, new_block or (), strict=False):
                put(cell, there)
        self.moves(name, partner)
        self.left_over("removed", name, left, "gone")
        self.left_over("added", partner, free, "new")

    def left_over(self, kind: str, sheet: str, cells: Mapping[Cell, str], what: str) -> None:
        """Cells that only one of two sheets has, block by block."""
        for block in _blocks(cells):
            was, now = (None, span(block)) if kind == "added" else (span(block), None)
            are = "is" if len(block) == 1 else "are"
            text = f"{count(len(block), 'cell')} {are} {what}"
            self.add(kind, [(sheet, *cell) for cell in block], was, now, text)

    def moves(self, name: str, sheet: str) -> None:
        """Cells that stand elsewhere: whole rows and columns of a sheet, or blocks."""
        groups: dict[Cell, list[Cell]] = {}  # by how far they moved
        ways: dict[tuple[int, int], set[int]] = {}  # of all cells in a row (0) or column (1)
        for (own, *old), (_, *new) in self.where.items():
            if own == name:
                distance = (new[0] - old[0], new[1] - old[1])
                groups.setdefault(distance, []).append((old[0], old[1]))
                for axis in (0, 1):
                    ways.setdefault((axis, old[axis]), set()).add(distance[axis])
        whole = {
            distance: cells
            for distance, cells in groups.items()
            if all(len(ways[axis, cell[axis]]) == 1 for cell in cells for axis in (0, 1))
        }
        for axis, what, show in ((0, "rows", str), (1, "columns", get_column_letter)):
            lines = {cell[axis]: by[axis] for by, cells in whole.items() for cell in cells}
            self.shifts(name, sheet, lines, what, show)
        for distance in sorted(groups.keys() - whole.keys() - {(0, 0)}):
            self.blocks(name, sheet, sorted(groups[distance]), distance)

    def shifts(
        self, name: str, sheet: str, lines: Mapping[int, int], what: str, show: Callable[[int], str]
    ) -> None:
        """Rows or columns that stand so much further down or right, each run of them once."""
        for by, pairs in groupby(sorted(lines.items()), key=lambda pair: pair[1]):
            if by:
                run = [old for old, _ in pairs]
                was, now = (f"{show(run[0] + d)} to {show(run[-1] + d)}" for d in (0, by))
                at = run[0] + by
                place = (sheet, at, 1) if what == "rows" else (sheet, 1, at)
                self.add("moved", [place], was, now, f"{what} {was} of {name!r} are now {now}")

    def blocks(self, name: str, sheet: str, cells: Sequence[Cell], distance: Cell) -> None:
        """Cells that moved together: one block, if nothing else stood among them."""
        rows, columns = ((min(each), max(each)) for each in zip(*cells, strict=True))
        among = [
            (row, column)
            for row, column in self.before.book.sheets[name]
            if rows[0] <= row <= rows[1] and columns[0] <= column <= columns[1]
        ]
        for block in [cells] if len(among) == len(cells) else _blocks(dict.fromkeys(cells, "")):
            moved = [(row + distance[0], column + distance[1]) for row, column in block]
            was, now = span(block), span(moved)
            self.add("moved", [(sheet, *c) for c in moved], was, now, f"{was} now stands at {now}")

    # ---- what names stand for, and what the cells hold

    def names(self) -> None:
        """Names that are new, gone, or stand for something else."""
        books = self.before.book, self.after.book
        first = [(next(iter(book.sheets)), 1, 1) for book in books]
        for name, shown in {n.upper(): n for book in books for n in book.names}.items():
            was, now = (book.meanings.get(name) for book in books)
            meanings = zip((was, now), first, books, strict=True)
            a, b = (parse(f"={text}", place, book) for text, place, book in meanings)
            what = "stands for something else"
            if was is None or now is None:
                what = "is new" if was is None else "is gone"
            elif self.alike(a, b):
                continue
            place = b.areas[0].corner if b.areas else first[1]
            self.add("name", [place], was, now, f"the name {shown} {what}")

    def group(
        self,
        pairs: Sequence[tuple[Position, Position]],
        compare: Callable[[Position, Position], tuple[Value | None, Value | None, str] | None],
        kind: str,
    ) -> None:
        """Differences of one kind, those of neighbouring cells in a column as one."""
        differing = {new: differs for old, new in pairs if (differs := compare(old, new))}
        for run in runs({place: text for place, (*_, text) in differing.items()}):
            was, now, text = differing[run[0]]
            after = count(len(run) - 1, "cell")
            more = f", also in {after} after it" if len(run) > 1 else ""
            self.add(kind, run, was, now, text + more)

    def formulas(
        self, old: Position, new: Position
    ) -> tuple[Value | None, Value | None, str] | None:
        a, b = self.before.formulas.get(old), self.after.formulas.get(new)
        texts = self.before.book[old].formula, self.after.book[new].formula
        if a and b:
            text = "the text is the same, but means something else"
            text = text if texts[0] == texts[1] else "the formulas differ"
            return None if self.alike(a, b) else (*texts, text)
        if b:
            return self.before.values.get(old), texts[1], "a formula stands in place of a value"
        if a:
            return texts[0], self.after.values.get(new), "a value stands in place of a formula"
        return None

    def alike(self, a: Formula, b: Formula) -> bool:
        """Whether two formulas are the same, piece by piece."""
        pairs = zip(a.pieces, b.pieces, strict=False)
        return len(a.pieces) == len(b.pieces) and all(self.same(p, q) for p, q in pairs)

    def same(self, p: Piece, q: Piece) -> bool:
        """Whether two pieces are the same, and read the same cells, wherever they are now."""
        if p.kind == q.kind == "number":
            return float(p.text) == float(q.text)
        if p.area is None or q.area is None:
            texts = [each.text.upper() if each.kind == "function" else each.text for each in (p, q)]
            return p.kind == q.kind and texts[0] == texts[1]
        return all(
            self.where[old] == new if old in self.where else self.replaced(old, new)
            for old, new in zip(p.area.ends, q.area.ends, strict=True)
        )

    def replaced(self, old: Position, new: Position) -> bool:
        """Whether a cell that is gone, or was blank, is where another is read now."""
        return old not in self.before.values or (old == new and new not in self.there)

    def values(self, old: Position, new: Position) -> tuple[Value | None, Value | None, str] | None:
        a, b = _value(self.before, old), _value(self.after, new)
        if isinstance(a, float) and isinstance(b, float):
            resolution = max(self.before.book.resolution, self.after.book.resolution)
            if self.tolerance.equal(a, b) or abs(a - b) <= resolution:
                return None
            small = math.isclose(a, b, rel_tol=_LAST_DIGITS)
            return a, b, LAST if small else "the values differ"
        return None if a == b else (a, b, "the contents differ")


def _value(calculation: Calculation, place: Position) -> Value | None:
    """The value stored; the computed one where none is."""
    stored = calculation.book[place].value
    value = calculation.values.get(place) if stored is None else stored
    return None if value == "" else value


def _same_sheets(before: Calculation, after: Calculation) -> dict[str, str]:
    """Sheets by name; the ones left over by what they hold."""
    same = {name: name for name in before.book.sheets if name in after.book.sheets}
    for name in [name for name in before.book.sheets if name not in same]:
        own = _skeletons(before, name)
        free = (left for left in after.book.sheets if left not in same.values())
        if own and (like := next((o for o in free if _skeletons(after, o) == own), None)):
            same[name] = like
    return same


def _skeletons(calculation: Calculation, sheet: str) -> dict[Cell, str]:
    """What each cell is: its text, its operations, or that it is a number."""
    skeletons = {}
    for (row, column), cell in calculation.book.sheets[sheet].items():
        formula = calculation.formulas.get((sheet, row, column))
        if formula is not None:
            pieces = (
                "@" if p.area else "n" if p.kind == "number" else p.text for p in formula.pieces
            )
            skeletons[row, column] = "=" + "".join(pieces)
        elif isinstance(cell.value, str):
            skeletons[row, column] = f"'{cell.value}"
        else:
            skeletons[row, column] = "n"
    return skeletons


def _lines(
    cells: Mapping[Cell, str], axis: int, kept: Container[int]
) -> dict[int, tuple[str, ...]]:
    """Each row (axis 0) or column (axis 1) as what stands in some columns."""
    lines: dict[int, list[str]] = {}
    for cell in sorted(cells):
        line = lines.setdefault(cell[axis], [])
        if cell[1] in kept:
            line.append(cells[cell])
    return {i: tuple(line) for i, line in sorted(lines.items())}


def _profiles(cells: Mapping[Cell, str]) -> dict[int, tuple[str, ...]]:
    """Each column as what stands in it, repetitions left out."""
    columns = _lines(cells, 1, {column for _, column in cells})
    return {i: tuple(what for what, _ in groupby(line)) for i, line in columns.items()}


def _matched(
    old: Mapping[int, tuple[str, ...]], new: Mapping[int, tuple[str, ...]]
) -> dict[int, int]:
    """Which line became which. What is not found again but stands between the same is the same."""
    a, b = list(old), list(new)
    lines = [old[i] for i in a], [new[i] for i in b]
    start = _alike_first(*lines)
    end = min(_alike_first(*(own[::-1] for own in lines)), min(len(a), len(b)) - start)
    pairs = [(i, i) for i in range(start)] + [(len(a) - i, len(b) - i) for i in range(1, end + 1)]
    gone, come = (own[start : len(own) - end] for own in lines)
    for tag, i1, i2, j1, j2 in SequenceMatcher(None, gone, come).get_opcodes():
        if tag == "equal" or (tag == "replace" and i2 - i1 == j2 - j1):
            pairs += [(start + i1 + k, start + j1 + k) for k in range(i2 - i1)]
    return {a[i]: b[j] for i, j in sorted(pairs)}


def _alike_first(a: Sequence[object], b: Sequence[object]) -> int:
    """How many entries two lists have in common before the first that differs."""
    return len(list(takewhile(lambda pair: pair[0] == pair[1], zip(a, b, strict=False))))


def _blocks(cells: Mapping[Cell, str]) -> list[list[Cell]]:
    """Cells that touch each other, block by block."""
    left, blocks = set(cells), []
    while left:
        start = min(left)
        left.remove(start)
        block, edge = [start], [start]
        while edge:
            row, column = edge.pop()
            for near in ((row + i, column + j) for i in (-1, 0, 1) for j in (-1, 0, 1)):
                if near in left:
                    left.remove(near)
                    block.append(near)
                    edge.append(near)
        blocks.append(sorted(block))
    return sorted(blocks)


def _form(block: Sequence[Cell], cells: Mapping[Cell, str]) -> frozenset[tuple[int, int, str]]:
    """A block by its cells' distances from its corner and what they are."""
    top, left = block[0][0], min(column for _, column in block)
    return frozenset((row - top, column - left, cells[row, column]) for row, column in block)

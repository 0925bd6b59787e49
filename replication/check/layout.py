"""Where the cells of one workbook stand in another: what was added, removed and moved."""

from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from openpyxl.utils.cell import get_column_letter

from replication.check.difference import Difference, counted, span
from replication.check.matching import RowAndColumn, in_order, matched, same_sheets
from replication.check.references import TextReference
from spreadsheets.foreign import LAST_COLUMN, LAST_ROW, Book, Position, Value
from spreadsheets.foreign import StoredCell as Contents

_KINDS = {"removed": ("is gone", "are gone"), "added": ("is new", "are new")}


class AlignedLines:
    """The rows, or the columns, of a sheet, with their places in the other workbook.

    `used` are those that hold anything; the last number is that of the sheet's last line.
    """

    def __init__(self, places: Mapping[int, int], used: Iterable[int], last: int) -> None:
        self.used, self.last = frozenset(used), last
        self.places = {line: to for line, to in sorted(places.items()) if line in self.used}
        self.numbers = list(self.places)
        pairs = list(self.places.items())
        self.kept = in_order(pairs)
        self.is_reordered = len(self.kept) < len(pairs)
        self.is_in_place = all(line == to for line, to in pairs)

    def may_be(self, line: int, new: int, is_end: bool) -> bool:
        """Whether a line may have this new number; `is_end`: it is the first or last of several.

        A blank line moves as far as the used lines beside it, or by a distance between theirs. So
        does a line that is gone, if a range ends there.
        """
        if self.is_in_place or line in self.places:
            return self.places.get(line, line) == new
        if line in self.used and not is_end:
            return False
        at = bisect_left(self.numbers, line)
        near = self.numbers[max(at - 1, 0) : at + 1]
        shifts = [self.places[number] - number for number in near]
        if at == 0 or not near:
            shifts.append(0)
        return min(shifts) <= new - line <= max(shifts) or line == new == self.last


class Layout:
    """The sheets of two workbooks, and where each cell of the first stands in the second."""

    def __init__(self, before: Book, after: Book) -> None:
        self.before, self.after = before, after
        self.partners = same_sheets(before, after)
        self.places: dict[str, dict[RowAndColumn, RowAndColumn]] = {}
        self.lines: dict[str, tuple[AlignedLines, AlignedLines]] = {}
        self.differences = list(self._sheets())
        for name, partner in self.partners.items():
            old, new = before.sheets[name], after.sheets[partner]
            way = matched(old, new)
            self.lines[name] = (
                AlignedLines(way.rows, (row for row, _ in old), LAST_ROW),
                AlignedLines(way.columns, (column for _, column in old), LAST_COLUMN),
            )
            places = {cell: to for cell, to in way.cells(old).items() if to in new}
            self.places[name] = places
            gone, come = [], []
            for axis, lines in zip(AXES, self.lines[name], strict=True):
                gone.append(sorted(lines.used - lines.places.keys()))
                used = {cell[axis.number] for cell in new}
                come.append(sorted(used.difference(lines.places.values())))
                self.differences += _moved(partner, axis, lines, come[-1])
            left = set(old).difference(places), set(new).difference(places.values())
            self.differences += _unmatched("removed", name, old, left[0], gone)
            self.differences += _unmatched("added", partner, new, left[1], come)
        self.is_in_place = all(old == new for old, new in self.partners.items()) and all(
            lines.is_in_place for pair in self.lines.values() for lines in pair
        )

    def _sheets(self) -> Iterator[Difference]:
        for name in self.before.sheets:
            if name not in self.partners:
                yield Difference("removed", ((name, 1, 1),), name, None, "the sheet is gone")
        for name in self.after.sheets:
            if name not in self.partners.values():
                yield Difference("added", ((name, 1, 1),), None, name, "the sheet is new")
        for name, partner in self.partners.items():
            if name != partner:
                place = (partner, 1, 1)
                yield Difference("moved", (place,), name, partner, "the sheet is renamed")

    def follows(self, a: TextReference, b: TextReference, old: Position, new: Position) -> bool:
        """Whether a reference in a cell `b` of the second workbook is that of the same cell before.

        Where lines are in another order, formulas that programs have sorted refer as far as they
        did, or to what they did.
        """
        sheet, partner = (
            book.called.get(reference.sheet.upper(), reference.sheet) if reference.sheet else at[0]
            for book, reference, at in ((self.before, a, old), (self.after, b, new))
        )
        if sheet not in self.lines:
            return (sheet, a[1:5]) == (partner, b[1:5])
        rows, columns = self.lines[sheet]
        if self.partners[sheet] != partner:
            return False
        is_range = a[1:3] != a[3:5]
        if (a.whole_columns and b.whole_columns) or (
            rows.may_be(a.top, b.top, is_range) and rows.may_be(a.bottom, b.bottom, is_range)
        ):
            if a.whole_rows and b.whole_rows:
                return True
            if columns.may_be(a.left, b.left, is_range) and columns.may_be(
                a.right, b.right, is_range
            ):
                return True
        if rows.is_reordered or columns.is_reordered:
            return a[1:5] == b[1:5] or _distance(a, old) == _distance(b, new)
        return False


def _distance(reference: TextReference, place: Position) -> tuple[int, ...]:
    """How far the ends of a reference are from a cell."""
    _, row, column = place
    return (
        reference.top - row, reference.left - column,
        reference.bottom - row, reference.right - column,
    )  # fmt: skip


# ---- what moved, is gone or is new, line by line


class _Axis:
    """How rows or columns are counted and written."""

    def __init__(self, number: int, name: str, letters: Callable[[int], str]) -> None:
        self.number, self.name, self.letters = number, name, letters

    def shown(self, lines: Sequence[int]) -> str:
        """Some lines, one after the other, as a sentence has them."""
        first, last = self.letters(lines[0]), self.letters(lines[-1])
        return f"{self.name} {first}" if len(lines) == 1 else f"{self.name}s {first} to {last}"

    def place(self, sheet: str, line: int) -> Position:
        """The first cell of a line."""
        return (sheet, 1, line) if self.number else (sheet, line, 1)


AXES = (_Axis(0, "row", str), _Axis(1, "column", get_column_letter))


def _moved(
    sheet: str, axis: _Axis, lines: AlignedLines, come: Sequence[int]
) -> Iterator[Difference]:
    """The lines of a sheet that moved, other than by lines with contents before them.

    `come` are the new lines with contents. A changed order is said once.
    """
    pairs, kept = list(lines.places.items()), set(lines.kept)
    moved = [pair for pair in pairs if pair not in kept]
    if not moved:
        yield from _shifted_lines(sheet, axis, lines, come)
        return
    old, new = ([pair[k] for pair in moved] for k in (0, 1))
    targets = sorted(lines.places.values())
    if _are_neighbours(old, lines.numbers) and _are_neighbours(new, targets):
        yield _now_at(sheet, axis, old, new)
        return
    first, last = min(old + new), max(old + new)
    before = {to: line for line, to in pairs}
    order = ", ".join(axis.letters(before[to]) for to in targets if first <= to <= last)
    text = f"{axis.shown([first, last])} of {sheet!r} are in another order"
    was, now = axis.shown([first, last]), f"{axis.name}s {order}"
    yield Difference("moved", (axis.place(sheet, first),), was, now, text)


def _are_neighbours(some: Sequence[int], of: Sequence[int]) -> bool:
    """Whether some lines follow each other among all; both are sorted, unless `some` are not."""
    first = bisect_left(of, some[0])
    return list(of[first : first + len(some)]) == list(some)


def _shifted_lines(
    sheet: str, axis: _Axis, lines: AlignedLines, come: Sequence[int]
) -> Iterator[Difference]:
    """The lines that kept their order and moved by blank ones that were inserted or deleted."""
    gone = sorted(lines.used - lines.places.keys())
    runs: list[tuple[list[int], list[int]]] = []
    shift, is_moving = 0, False
    for line, to in lines.places.items():
        passed = bisect_left(come, to) - bisect_left(gone, line)
        if to - line == shift + passed:
            # Lines with contents were added or removed before it, which is said of those.
            is_moving = is_moving and to - line == runs[-1][1][0] - runs[-1][0][0]
        else:
            runs.append(([], []))
            is_moving, shift = True, to - line - passed
        if is_moving:
            runs[-1][0].append(line)
            runs[-1][1].append(to)
    for old, new in runs:
        yield _now_at(sheet, axis, old, new)


def _now_at(sheet: str, axis: _Axis, old: Sequence[int], new: Sequence[int]) -> Difference:
    """The difference for lines that stand elsewhere."""
    was, now = axis.shown(old), axis.shown(new)
    verb = "is" if len(old) == 1 else "are"
    text = f"{was} of {sheet!r} {verb} now {now}"
    return Difference("moved", (axis.place(sheet, new[0]),), was, now, text)


def _unmatched(
    kind: str,
    sheet: str,
    cells: Mapping[RowAndColumn, Contents],
    left: set[RowAndColumn],
    lines: list[list[int]],
) -> Iterator[Difference]:
    """The cells that only one of two sheets has: by whole lines, then block by block.

    `left` are these cells, `lines` the rows and the columns that the other sheet does not have.
    """
    for axis, unknown in zip(AXES, lines, strict=True):
        by_line: dict[int, list[RowAndColumn]] = {}
        for cell in left:
            by_line.setdefault(cell[axis.number], []).append(cell)
        for run in consecutive([line for line in unknown if line in by_line]):
            block = sorted(cell for line in run for cell in by_line[line])
            left = left.difference(block)
            text = f"{axis.shown(run)} of {sheet!r} {_KINDS[kind][len(run) > 1]}"
            yield _only_in_one(kind, sheet, cells, block, text)
    for block in touching(left):
        text = f"{counted(len(block), 'cell')} {_KINDS[kind][len(block) > 1]}"
        yield _only_in_one(kind, sheet, cells, block, text)


def _only_in_one(
    kind: str,
    sheet: str,
    cells: Mapping[RowAndColumn, Contents],
    block: Sequence[RowAndColumn],
    text: str,
) -> Difference:
    """The difference for cells that only one of two sheets has."""
    shown: Value | None = span(block)
    if len(block) == 1:
        contents = cells[block[0]]
        shown = contents.formula or contents.value
    was, now = (shown, None) if kind == "removed" else (None, shown)
    return Difference(kind, tuple((sheet, *cell) for cell in block), was, now, text)


def consecutive(lines: Iterable[int]) -> list[list[int]]:
    """Group sorted numbers that follow each other.

    >>> consecutive([1, 2, 4])
    [[1, 2], [4]]
    """
    runs: list[list[int]] = []
    for line in lines:
        if runs and line == runs[-1][-1] + 1:
            runs[-1].append(line)
        else:
            runs.append([line])
    return runs


def touching(cells: Iterable[RowAndColumn]) -> list[list[RowAndColumn]]:
    """Group cells into blocks of cells that touch each other, be it at a corner.

    >>> touching([(1, 1), (2, 2), (4, 4)])
    [[(1, 1), (2, 2)], [(4, 4)]]
    """
    left, blocks = set(cells), []
    for start in sorted(left):
        block, edge = [], [start]
        while edge:
            row, column = cell = edge.pop()
            if cell in left:
                left.remove(cell)
                block.append(cell)
                edge += [(row + i, column + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
        if block:
            blocks.append(sorted(block))
    return blocks

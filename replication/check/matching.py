"""Which sheets and which cells of two workbooks are the same, wherever they stand.

Cells are matched by what they are: a text, the operations of a formula, a number.
"""

from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Container, Hashable, Iterable, Iterator, Mapping, Sequence
from difflib import SequenceMatcher
from itertools import chain, groupby, takewhile
from operator import itemgetter
from typing import TypeVar

from spreadsheets.foreign import LAST_COLUMN, LAST_ROW, Position
from spreadsheets.recalculation import Calculation

_MAX_BLOCKS, _MAX_TRIES = 200, 8
"""Blocks to look for elsewhere; distances that are tried for each."""
_MAX_LINES, _MAX_SHEETS = 4_000, 100
"""Changed lines, and sheets of other names, that are compared each with each."""

Cell = tuple[int, int]
T = TypeVar("T")
K = TypeVar("K", Cell, int)


def same_sheets(before: Calculation, after: Calculation) -> dict[str, str]:
    """Sheets by name; the ones left over by what they hold, if most of it is the same."""
    same = {name: name for name in before.book.sheets if name in after.book.sheets}
    left, free = ([n for n in each.book.sheets if n not in same] for each in (before, after))
    gone = {name: _likeness(before, name) for name in left[:_MAX_SHEETS]}
    come = {name: _likeness(after, name) for name in free[:_MAX_SHEETS]}
    shares = (
        ((gone[a] & come[b]).total() / max(gone[a].total(), come[b].total(), 1), a, b)
        for a in gone
        for b in come
    )
    for share, a, b in sorted(shares, key=lambda entry: -entry[0]):
        if share > 1 / 2 and a not in same and b not in same.values():
            same[a] = b
    return same


def _likeness(calculation: Calculation, sheet: str) -> Counter[str]:
    """What a sheet holds, and what its cells are."""
    cells = _cells(calculation, sheet).values()
    return Counter([*cells, *map(_kind, cells)])


def _cells(calculation: Calculation, sheet: str) -> dict[Cell, str]:
    """What each cell is: its text, its operations, or its number."""
    cells = {}
    for (row, column), cell in calculation.book.sheets[sheet].items():
        formula = calculation.formulas.get((sheet, row, column))
        if formula is None:
            cells[row, column] = ("'" if isinstance(cell.value, str) else "n") + str(cell.value)
        else:
            pieces = (
                "@" if p.area else "n" if p.kind == "number" else p.text for p in formula.pieces
            )
            cells[row, column] = "=" + "".join(pieces)
    return cells


def _kind(cell: str) -> str:
    """What a cell is, whichever number it may be."""
    return "n" if cell.startswith("n") else cell


def pairings(
    before: Calculation, name: str, after: Calculation, partner: str
) -> Iterator[dict[Cell, Cell]]:
    """In which ways the cells of two sheets may be the same: old places and new ones.

    With their rows and columns, in place, along one of these, or in rows of another order.
    """
    old, new = _cells(before, name), _cells(after, partner)
    a, b = ({cell: _kind(what) for cell, what in cells.items()} for cells in (old, new))
    columns = _matched(_profiles(a), _profiles(b))
    rows = _matched(_rows(a, columns.keys()), _rows(b, set(columns.values())))
    ways = [{(r, c): (rows[r], columns[c]) for r, c in a if r in rows and c in columns}]
    ways.append({cell: cell for cell in a})
    for axis in (1, 0):
        here, there = (_by(cells, itemgetter(axis)) for cells in (a, b))
        way: dict[Cell, Cell] = {}
        for line in here.keys() & there.keys():
            way |= _matched({c: a[c] for c in here[line]}, {c: b[c] for c in there[line]}, 0)
        ways.append(way)
    rows = _sorted(old, new)
    ways.append({(r, c): (rows[r], c) for r, c in old if r in rows})
    return (_paired(old, new, way) for i, way in enumerate(ways) if way not in ways[:i])


def _sorted(old: Mapping[Cell, str], new: Mapping[Cell, str]) -> dict[int, int]:
    """Where each row is now that holds the same, all of it, in whatever order they stand.

    What is in none of the other sheet's rows stays where it is.
    """
    by_content = []
    for cells in (old, new):
        rows = _by(cells, itemgetter(0))
        lines = {row: tuple((c, cells[r, c]) for r, c in line) for row, line in rows.items()}
        by_content.append(_by(lines, lines.__getitem__))
    before, after = by_content
    pairs = (zip(before[line], after[line], strict=False) for line in before if line in after)
    where = dict(chain.from_iterable(pairs))
    taken = set(where.values())
    return {row: row for row, _ in old if row not in taken} | where


def _by(cells: Iterable[K], key: Callable[[K], T]) -> dict[T, list[K]]:
    """Cells, or lines, in their order, by what they have in common."""
    by: dict[T, list[K]] = {}
    for cell in sorted(cells):
        by.setdefault(key(cell), []).append(cell)
    return by


def _paired(
    old: Mapping[Cell, str], new: Mapping[Cell, str], way: Mapping[Cell, Cell]
) -> dict[Cell, Cell]:
    """Where each cell is now: where it may be, if it is the same; in a block elsewhere; changed."""
    pairs = {cell: there for cell, there in way.items() if new.get(there) == old[cell]}
    taken = set(pairs.values())
    left = {cell: what for cell, what in old.items() if cell not in pairs}
    free = {cell: what for cell, what in new.items() if cell not in taken}
    changed = {cell: there for cell, there in way.items() if cell in left and there in free}
    numbers = {c: to for c, to in changed.items() if left[c][0] == free[to][0] == "n"}
    pairs |= _elsewhere(left, free, numbers)
    return pairs | {c: to for c, to in changed.items() if c in left and to in free}


def _elsewhere(
    left: dict[Cell, str], free: dict[Cell, str], numbers: Mapping[Cell, Cell]
) -> dict[Cell, Cell]:
    """Blocks that stand elsewhere: where half of a block is found again, or more, all of it is.

    They are taken out of what is `left` and `free`. Some `numbers` may only have changed where
    they are: they go along with texts and formulas.
    """
    blocks, reserved = touching(left)[:_MAX_BLOCKS], set(numbers.values())
    number = {cell: k for k, block in enumerate(blocks) for cell in block}
    gone, new = _by(number.keys() - numbers.keys(), left.__getitem__), _by(free, free.__getitem__)
    votes: Counter[tuple[int, Cell]] = Counter()  # for a block and how far it moved
    for what in gone.keys() & new.keys():
        a, b = gone[what], new[what]
        for old, there in (*zip(a, b, strict=False), *zip(a[::-1], b[::-1], strict=False)):
            votes[number[old], (there[0] - old[0], there[1] - old[1])] += old != there
    pairs, tries = dict[Cell, Cell](), Counter[int]()
    for (k, (down, right)), _ in sorted((+votes).items(), key=lambda entry: (-entry[1], entry[0])):
        tries[k] += 1
        if tries[k] > _MAX_TRIES:
            continue
        to = {c: (c[0] + down, c[1] + right) for c in blocks[k]}
        to = {c: there for c, there in to.items() if c in left and there in free}
        if all(left[c][0] == "n" for c in to if left[c] == free[to[c]]):
            to = {c: there for c, there in to.items() if there not in reserved}
        same = {c for c in to if left[c] == free[to[c]]}
        telling = to.keys() - numbers.keys()
        others = [left[c][0] for c in telling - same]
        if len(others) - others.count("n") < len(telling & same) >= len(others):
            for cell in same | telling:
                pairs[cell] = to[cell]
                del left[cell], free[to[cell]]
    return pairs


def _rows(cells: Mapping[Cell, str], kept: Container[int]) -> dict[int, tuple[str, ...]]:
    """Each row as what stands in some columns."""
    rows = _by(cells, itemgetter(0)).items()
    return {i: tuple(cells[cell] for cell in row if cell[1] in kept) for i, row in rows}


def _profiles(cells: Mapping[Cell, str]) -> dict[int, tuple[str, ...]]:
    """Each column as what stands in it, repetitions left out."""
    columns = sorted(_by(cells, itemgetter(1)).items())
    return {i: tuple(what for what, _ in groupby(cells[c] for c in line)) for i, line in columns}


def _matched(
    old: Mapping[T, Hashable], new: Mapping[T, Hashable], most: int = _MAX_LINES
) -> dict[T, T]:
    """Which line became which. What is not found again but stands between the same is the same.

    So is a line after deleted ones, to which its references are lost.
    """
    a, b = list(old), list(new)
    lines = [old[i] for i in a], [new[i] for i in b]
    start = _alike_first(*lines)
    end = min(_alike_first(*(line[::-1] for line in lines)), min(len(a), len(b)) - start)
    pairs = [(i, i) for i in range(start)] + [(len(a) - i, len(b) - i) for i in range(1, end + 1)]
    gone, come = (line[start : len(line) - end] for line in lines)
    between: Iterable[tuple[str, int, int, int, int]] = [("replace", 0, len(gone), 0, len(come))]
    if len(gone) + len(come) <= most:
        between = SequenceMatcher(None, gone, come).get_opcodes()
    for tag, i1, i2, j1, j2 in between:
        if tag == "equal" or (tag == "replace" and i2 - i1 == j2 - j1):
            pairs += [(start + i1 + k, start + j1 + k) for k in range(i2 - i1)]
        elif i1 < i2 and j1 < j2 and str(come[j2 - 1]).replace("#REF!", "@") == str(gone[i2 - 1]):
            pairs.append((start + i2 - 1, start + j2 - 1))
    return {a[i]: b[j] for i, j in sorted(pairs)}


def _alike_first(a: Sequence[object], b: Sequence[object]) -> int:
    """How many entries two lists have in common before the first that differs."""
    return len(list(takewhile(lambda pair: pair[0] == pair[1], zip(a, b, strict=False))))


class Shifts:
    """How far the rows (axis 0) and columns (axis 1) of each sheet moved, by the cells matched."""

    def __init__(self, where: Mapping[Position, Position]) -> None:
        moved: dict[tuple[str, str, int], dict[int, set[int]]] = {}
        for (sheet, *old), (partner, *new) in where.items():
            for axis in (0, 1):
                by_line = moved.setdefault((sheet, partner, axis), {0: {0}})
                by_line.setdefault(old[axis], set()).add(new[axis] - old[axis])
        # For two sheets and an axis: each line, and the least and most that its cells moved.
        self.lines = {
            key: sorted((line, min(by), max(by)) for line, by in by_line.items())
            for key, by_line in moved.items()
        }

    def allow(self, old: Position, new: Position) -> bool:
        """Whether a blank cell may be there now.

        A row or column moves as its cells do. One without cells moves as far as the nearest with
        cells on either side, or by a number between.
        """
        each = zip((LAST_ROW, LAST_COLUMN), old[1:], new[1:], strict=True)
        for axis, (last, line, to) in enumerate(each):
            lines = self.lines.get((old[0], new[0], axis))
            if lines is None:
                return False
            first, end = (bisect_left(lines, (number,)) for number in (line, line + 1))
            near = lines[first:end] or lines[first - 1 : first + 1]
            _, least, most = zip(*near, strict=True)
            if not min(least) <= to - line <= max(most) and not line == to == last:
                return False
        return True


def touching(cells: Iterable[Cell]) -> list[list[Cell]]:
    """Cells that touch each other, block by block."""
    left, blocks = set(cells), list[list[Cell]]()
    for start in sorted(left):
        block, edge = list[Cell](), [start]
        while edge:
            row, column = cell = edge.pop()
            if cell in left:
                left.remove(cell)
                block.append(cell)
                edge += [(row + i, column + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
        if block:
            blocks.append(sorted(block))
    return blocks

"""Which sheets and which cells of two workbooks are the same, wherever they stand.

Cells are matched by their signatures: a text by itself, a formula by its operations, a number by
its value or, less strictly, by being a number.
"""

from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Container, Hashable, Iterable, Iterator, Mapping, Sequence
from difflib import SequenceMatcher
from itertools import chain, groupby, product, takewhile
from operator import itemgetter
from typing import TypeVar

from spreadsheets.foreign import LAST_COLUMN, LAST_ROW, Position
from spreadsheets.recalculation import Calculation

_MAX_BLOCKS, _MAX_TRIES = 200, 8
"""How many blocks are looked for elsewhere, and how many distances are tried for each."""
_MAX_LINES, _MAX_SHEETS = 4_000, 100
"""How many changed lines, and sheets without a namesake, are compared each with each."""

Cell = tuple[int, int]
T = TypeVar("T")
K = TypeVar("K", Cell, int)


def same_sheets(before: Calculation, after: Calculation) -> dict[str, str]:
    """Match sheets by name, and the others by their contents, if more than half is the same."""
    same = {name: name for name in before.book.sheets if name in after.book.sheets}
    old, new = (
        {
            name: _counted(calculation, name)
            for name in [n for n in calculation.book.sheets if n not in same][:_MAX_SHEETS]
        }
        for calculation in (before, after)
    )
    shares = (
        ((old[a] & new[b]).total() / max(old[a].total(), new[b].total(), 1), a, b)
        for a, b in product(old, new)
    )
    for share, a, b in sorted(shares, key=lambda entry: -entry[0]):
        if share > 1 / 2 and a not in same and b not in same.values():
            same[a] = b
    return same


def _counted(calculation: Calculation, sheet: str) -> Counter[str]:
    """How often a sheet holds each signature, with the numbers and without."""
    signatures = _signatures(calculation, sheet).values()
    return Counter([*signatures, *map(_without_number, signatures)])


def _signatures(calculation: Calculation, sheet: str) -> dict[Cell, str]:
    """The signature of each cell: its text, the operations of its formula, or its number."""
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


def _without_number(signature: str) -> str:
    """The signature of a cell, the same for all numbers."""
    return "n" if signature.startswith("n") else signature


def pairings(
    before: Calculation, name: str, after: Calculation, partner: str
) -> Iterator[dict[Cell, Cell]]:
    """Yield the ways in which the cells of two sheets may be the same: old cells to new ones.

    They may have moved with their rows and columns, be where they were, have moved along their
    columns or along their rows, or stand in rows of another order.
    """
    old, new = _signatures(before, name), _signatures(after, partner)
    a, b = ({cell: _without_number(s) for cell, s in cells.items()} for cells in (old, new))
    columns = _matched(_profiles(a), _profiles(b))
    rows = _matched(_rows(a, columns.keys()), _rows(b, set(columns.values())))
    ways = [{(r, c): (rows[r], columns[c]) for r, c in a if r in rows and c in columns}]
    ways.append({cell: cell for cell in a})
    for axis in (1, 0):
        old_lines, new_lines = (_by(cells, itemgetter(axis)) for cells in (a, b))
        way: dict[Cell, Cell] = {}
        for line in old_lines.keys() & new_lines.keys():
            way |= _matched(
                {c: a[c] for c in old_lines[line]}, {c: b[c] for c in new_lines[line]}, 0
            )
        ways.append(way)
    rows = _reordered_rows(old, new)
    ways.append({(r, c): (rows[r], c) for r, c in old if r in rows})
    return (_paired(old, new, way) for i, way in enumerate(ways) if way not in ways[:i])


def _reordered_rows(old: Mapping[Cell, str], new: Mapping[Cell, str]) -> dict[int, int]:
    """Where the rows are now, matched by equal contents in whatever order they stand.

    A row without an equal stays where it is, unless another row has moved there.
    """
    by_content = []
    for cells in (old, new):
        rows = _by(cells, itemgetter(0))
        contents = {row: tuple((c, cells[r, c]) for r, c in line) for row, line in rows.items()}
        by_content.append(_by(contents, contents.__getitem__))
    before, after = by_content
    pairs = (zip(before[line], after[line], strict=False) for line in before if line in after)
    where = dict(chain.from_iterable(pairs))
    taken = set(where.values())
    return {row: row for row, _ in old if row not in taken} | where


def _by(cells: Iterable[K], key: Callable[[K], T]) -> dict[T, list[K]]:
    """Cells, or lines, sorted and grouped by a key."""
    by: dict[T, list[K]] = {}
    for cell in sorted(cells):
        by.setdefault(key(cell), []).append(cell)
    return by


def _paired(
    old: Mapping[Cell, str], new: Mapping[Cell, str], way: Mapping[Cell, Cell]
) -> dict[Cell, Cell]:
    """Pair the cells of two sheets, given where each may have gone.

    First come cells that are the same there, then blocks found elsewhere, then cells that changed.
    """
    pairs = {cell: to for cell, to in way.items() if new.get(to) == old[cell]}
    taken = set(pairs.values())
    left = {cell: signature for cell, signature in old.items() if cell not in pairs}
    free = {cell: signature for cell, signature in new.items() if cell not in taken}
    changed = {cell: to for cell, to in way.items() if cell in left and to in free}
    numbers = {c: to for c, to in changed.items() if left[c][0] == free[to][0] == "n"}
    pairs |= _elsewhere(left, free, numbers)
    return pairs | {c: to for c, to in changed.items() if c in left and to in free}


def _elsewhere(
    left: dict[Cell, str], free: dict[Cell, str], numbers: Mapping[Cell, Cell]
) -> dict[Cell, Cell]:
    """Pair blocks of the old cells `left` with `free` new ones elsewhere, and remove both.

    A block is taken as moved if at least half of it is found again. `numbers` are those that may
    only have changed in place: they alone show no move, but go along with texts and formulas.
    """
    blocks, reserved = touching(left)[:_MAX_BLOCKS], set(numbers.values())
    block_of = {cell: k for k, block in enumerate(blocks) for cell in block}
    gone = _by(block_of.keys() - numbers.keys(), left.__getitem__)
    new = _by(free, free.__getitem__)
    votes: Counter[tuple[int, Cell]] = Counter()  # for a block and how far it moved
    for signature in gone.keys() & new.keys():
        a, b = gone[signature], new[signature]
        # Equal cells are paired from the first on and from the last back.
        for old, to in (*zip(a, b, strict=False), *zip(a[::-1], b[::-1], strict=False)):
            votes[block_of[old], (to[0] - old[0], to[1] - old[1])] += old != to
    pairs, tries = dict[Cell, Cell](), Counter[int]()
    for (k, (down, right)), _ in sorted((+votes).items(), key=lambda entry: (-entry[1], entry[0])):
        tries[k] += 1
        if tries[k] > _MAX_TRIES:
            continue
        moved = {c: (c[0] + down, c[1] + right) for c in blocks[k]}
        moved = {c: to for c, to in moved.items() if c in left and to in free}
        if all(left[c][0] == "n" for c, to in moved.items() if left[c] == free[to]):
            moved = {c: to for c, to in moved.items() if to not in reserved}
        same = {c for c, to in moved.items() if left[c] == free[to]}
        evidence = moved.keys() - numbers.keys()
        unlike = [left[c][0] for c in evidence - same]
        if len(unlike) - unlike.count("n") < len(evidence & same) >= len(unlike):
            for cell in same | evidence:
                pairs[cell] = moved[cell]
                del left[cell], free[moved[cell]]
    return pairs


def _rows(cells: Mapping[Cell, str], kept: Container[int]) -> dict[int, tuple[str, ...]]:
    """The signatures in each row, only those in the columns that are kept."""
    rows = _by(cells, itemgetter(0)).items()
    return {i: tuple(cells[cell] for cell in row if cell[1] in kept) for i, row in rows}


def _profiles(cells: Mapping[Cell, str]) -> dict[int, tuple[str, ...]]:
    """The signatures in each column, without repetitions of the one before."""
    columns = sorted(_by(cells, itemgetter(1)).items())
    return {i: tuple(s for s, _ in groupby(cells[c] for c in line)) for i, line in columns}


def _matched(
    old: Mapping[T, Hashable], new: Mapping[T, Hashable], most: int = _MAX_LINES
) -> dict[T, T]:
    """Match lines, in their order, by their contents: old lines to new ones.

    Changed lines between matched ones are matched if they are as many as before. So is the first
    line after deleted ones, whose references to these are lost. More than `most` changed lines are
    not compared with each other.
    """
    a, b = list(old), list(new)
    lines = [old[i] for i in a], [new[i] for i in b]
    start = _common(*lines)
    end = min(_common(*(line[::-1] for line in lines)), min(len(a), len(b)) - start)
    pairs = [(i, i) for i in range(start)] + [(len(a) - i, len(b) - i) for i in range(1, end + 1)]
    gone, come = (line[start : len(line) - end] for line in lines)
    edits: Iterable[tuple[str, int, int, int, int]] = [("replace", 0, len(gone), 0, len(come))]
    if len(gone) + len(come) <= most:
        edits = SequenceMatcher(None, gone, come).get_opcodes()
    for tag, i1, i2, j1, j2 in edits:
        if tag == "equal" or (tag == "replace" and i2 - i1 == j2 - j1):
            pairs += [(start + i1 + k, start + j1 + k) for k in range(i2 - i1)]
        elif i1 < i2 and j1 < j2 and str(come[j2 - 1]).replace("#REF!", "@") == str(gone[i2 - 1]):
            pairs.append((start + i2 - 1, start + j2 - 1))
    return {a[i]: b[j] for i, j in sorted(pairs)}


def _common(a: Sequence[object], b: Sequence[object]) -> int:
    """How many entries two lists have in common before the first that differs."""
    return len(list(takewhile(lambda pair: pair[0] == pair[1], zip(a, b, strict=False))))


class Shifts:
    """How far rows (axis 0) and columns (axis 1) of each sheet moved, by their matched cells."""

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
        """Whether a blank cell `old` of the first workbook may be `new` in the second.

        A row or column moves as far as its cells do. A blank one moves as far as the nearest lines
        with cells on its two sides, or by a distance between these. The last line may stay.
        """
        axes = zip((LAST_ROW, LAST_COLUMN), old[1:], new[1:], strict=True)
        for axis, (last, line, to) in enumerate(axes):
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
    """Group cells into blocks of cells that touch each other, be it at a corner."""
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

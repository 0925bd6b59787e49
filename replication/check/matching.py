"""Which sheets, rows and columns of two workbooks are the same, wherever they stand.

A line (a row or a column) is known by its contents: by its texts and numbers, and by what its
formulas do. Equal lines are matched first, then similar ones, then those that stand between matched
neighbours. Lines need not keep their order.
"""

from bisect import bisect_left
from collections import Counter, defaultdict, deque
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from itertools import pairwise, product
from typing import Any

from replication.check.references import outline
from spreadsheets.foreign import Book
from spreadsheets.foreign import StoredCell as Contents

RowAndColumn = tuple[int, int]
"""Row and column."""
LineContents = tuple[Any, ...]
"""What a row or a column holds."""

_RARE = 20
"""A content that more lines have does not tell lines apart; it also bounds the work."""
_SHARED = 1 / 3
"""Similar lines share more than this part of what is rare in the one that has less of it."""
_TEXT, _NUMBER = 3, 1
"""How much a text counts, and how much a number or formula, which often repeats by chance."""
_STABLE = 0.9
"""A column keeps its contents, in whatever order, if this part of its cells is found again."""
_MAX_COMPARED, _MAX_SIMILAR = 250_000, 1_000_000
"""Pairs of lines that are compared: where equal lines repeat, and for what similar ones share."""
_MAX_SHEETS = 100
"""Sheets without a namesake that are compared each with each."""


def same_sheets(before: Book, after: Book) -> dict[str, str]:
    """Match sheets by name, and the others by their contents, if more than half is the same."""
    same = {name: name for name in before.sheets if name in after.sheets}
    old, new = (
        {
            name: Counter(keys(book.sheets[name]).values())
            for name in [name for name in book.sheets if name not in same][:_MAX_SHEETS]
        }
        for book in (before, after)
    )
    shares = [
        ((old[a] & new[b]).total() / max(old[a].total(), new[b].total(), 1), a, b)
        for a in old
        for b in new
    ]
    for share, a, b in sorted(shares, key=lambda entry: -entry[0]):
        if share > 1 / 2 and a not in same and b not in same.values():
            same[a] = b
    return same


def keys(cells: Mapping[RowAndColumn, Contents]) -> dict[RowAndColumn, str]:
    """What each cell is known by: its text or number, or what its formula does."""
    return {place: _content_key(cell) for place, cell in cells.items()}


def _content_key(cell: Contents) -> str:
    if cell.formula is not None:
        return outline(cell.formula)
    return f"'{cell.value}" if isinstance(cell.value, str) else f"n{cell.value}"


@dataclass(frozen=True)
class Matched:
    """The rows and columns of a sheet, each with its place in the other workbook."""

    rows: Mapping[int, int]
    columns: Mapping[int, int]

    def cells(self, cells: Iterable[RowAndColumn]) -> dict[RowAndColumn, RowAndColumn]:
        """These cells, each with its place in the other workbook; without those that are gone."""
        rows, columns = self.rows, self.columns
        return {(r, c): (rows[r], columns[c]) for r, c in cells if r in rows and c in columns}


def matched(old: Mapping[RowAndColumn, Contents], new: Mapping[RowAndColumn, Contents]) -> Matched:
    """Match the rows and columns of two sheets.

    If as many cells are the same where they were, nothing counts as moved.
    """
    rows, columns = ({cell[axis] for cell in old} & {cell[axis] for cell in new} for axis in (0, 1))
    in_place = Matched({row: row for row in rows}, {column: column for column in columns})
    if _unchanged(old, new):
        return in_place
    a, b = keys(old), keys(new)
    columns_of = [_line_contents(contents, 1) for contents in (a, b)]
    old_columns, new_columns = (
        {c: tuple(dict.fromkeys(line)) for c, line in lines.items()} for lines in columns_of
    )
    by_columns = _align(old_columns, new_columns)
    renamed = {(r, by_columns[c]): key for (r, c), key in a.items() if c in by_columns}
    arriving = set(by_columns.values())
    kept = {(r, c): key for (r, c), key in b.items() if c in arriving}
    by_rows = _align(_numbered(renamed), _numbered(kept), _stable(renamed, kept))
    moved = Matched(by_rows, by_columns)
    return moved if _cells_matched(moved, a, b) > _cells_matched(in_place, a, b) else in_place


def _unchanged(old: Mapping[RowAndColumn, Contents], new: Mapping[RowAndColumn, Contents]) -> bool:
    """Whether all cells hold the same, apart from the values of formulas."""
    return old.keys() == new.keys() and all(
        cell.formula == new[place].formula
        and (cell.formula is not None or cell.value == new[place].value)
        for place, cell in old.items()
    )


def _cells_matched(
    way: Matched, old: Mapping[RowAndColumn, str], new: Mapping[RowAndColumn, str]
) -> int:
    """How many cells hold the same where they are said to be."""
    return sum(new.get(to) == old[cell] for cell, to in way.cells(old).items())


def _line_contents(contents: Mapping[RowAndColumn, str], axis: int) -> dict[int, list[str]]:
    """The contents of each row (axis 0) or column (axis 1), in order."""
    lines: dict[int, list[str]] = defaultdict(list)
    for cell in sorted(contents):
        lines[cell[axis]].append(contents[cell])
    return lines


def _numbered(contents: Mapping[RowAndColumn, str]) -> dict[int, tuple[tuple[int, str], ...]]:
    """The contents of each row, each with the number of its column."""
    rows: dict[int, list[tuple[int, str]]] = defaultdict(list)
    for (row, column), key in sorted(contents.items()):
        rows[row].append((column, key))
    return {row: tuple(line) for row, line in rows.items()}


def _stable(old: Mapping[RowAndColumn, str], new: Mapping[RowAndColumn, str]) -> frozenset[int]:
    """The columns that hold the same on both sides, in whatever order."""
    a, b = ({c: Counter(line) for c, line in _line_contents(x, 1).items()} for x in (old, new))
    return frozenset(
        column
        for column in a.keys() & b.keys()
        if (a[column] & b[column]).total() >= _STABLE * max(a[column].total(), b[column].total())
    )


# ---- lines


def _align(
    old: Mapping[int, LineContents],
    new: Mapping[int, LineContents],
    stable: frozenset[int] | None = None,
) -> dict[int, int]:
    """Match lines by their contents: the numbers of old lines to those of new ones.

    `stable` are columns that identify rows even where all rows have changed in other columns.
    """
    alignment = _Alignment(old, new)
    alignment.equal(alignment.a, alignment.b)
    if stable is not None:
        alignment.equal(
            *(
                [tuple(entry for entry in line if entry[0] in stable) for line in lines]
                for lines in (alignment.a, alignment.b)
            )
        )
    alignment.repeated()
    alignment.similar()
    alignment.between()
    return {alignment.old[i]: alignment.new[j] for i, j in sorted(alignment.pairs.items())}


class _Alignment:
    """Lines of two sheets, and the pairs found so far, by their indices from 0."""

    def __init__(self, old: Mapping[int, LineContents], new: Mapping[int, LineContents]) -> None:
        self.old, self.new = sorted(old), sorted(new)
        self.a, self.b = [old[line] for line in self.old], [new[line] for line in self.new]
        self.pairs: dict[int, int] = {}
        self.taken: set[int] = set()

    def add(self, i: int, j: int) -> None:
        self.pairs[i] = j
        self.taken.add(j)

    def left(self) -> tuple[list[int], list[int]]:
        """The lines without a partner."""
        return (
            [i for i in range(len(self.a)) if i not in self.pairs],
            [j for j in range(len(self.b)) if j not in self.taken],
        )

    def equal(self, a: Sequence[LineContents], b: Sequence[LineContents]) -> None:
        """Match lines with the same contents that no third line has, and equal neighbours."""
        once = []
        for lines, left in zip((a, b), self.left(), strict=True):
            counts = Counter(lines[k] for k in left)
            once.append({lines[k]: k for k in left if lines[k] and counts[lines[k]] == 1})
        for line, i in once[0].items():
            if line in once[1]:
                self.add(i, once[1][line])
        for i, j in [(-1, -1), *sorted(self.pairs.items())]:
            self.extend(a, b, i, j, 1)
        for i, j in [(len(a), len(b)), *sorted(self.pairs.items(), reverse=True)]:
            self.extend(a, b, i, j, -1)

    def extend(
        self, a: Sequence[LineContents], b: Sequence[LineContents], i: int, j: int, step: int
    ) -> None:
        """Match the neighbours of a pair on one side, as far as they are equal."""
        i, j = i + step, j + step
        while 0 <= i < len(a) and 0 <= j < len(b) and a[i] == b[j] != ():
            if i in self.pairs or j in self.taken:
                break
            self.add(i, j)
            i, j = i + step, j + step

    def gaps(self) -> list[tuple[list[int], list[int], bool]]:
        """The lines without a partner, between those that have one and kept their order.

        If most lines are in another order, all are in one gap, which is not in order.
        """
        pairs = sorted(self.pairs.items())
        kept = in_order(pairs)
        if 2 * len(kept) < len(pairs):
            return [(*self.left(), False)]
        ends = [(-1, -1), *kept, (len(self.a), len(self.b))]
        gaps = []
        for (i, j), (i_end, j_end) in pairwise(ends):
            old = [k for k in range(i + 1, i_end) if k not in self.pairs]
            new = [k for k in range(j + 1, j_end) if k not in self.taken]
            if old and new:
                gaps.append((old, new, True))
        return gaps

    def repeated(self) -> None:
        """Match equal lines of which there are several."""
        work = 0
        for old, new, is_ordered in self.gaps():
            work += len(old) * len(new)
            a, b = [self.a[i] for i in old], [self.b[j] for j in new]
            if is_ordered and work <= _MAX_COMPARED:
                for i, j, size in SequenceMatcher(None, a, b, False).get_matching_blocks():
                    for k in range(size):
                        self.add(old[i + k], new[j + k])
                continue
            places: dict[LineContents, deque[int]] = defaultdict(deque)
            for line, j in zip(b, new, strict=True):
                places[line].append(j)
            for line, i in zip(a, old, strict=True):
                if places[line]:
                    self.add(i, places[line].popleft())

    def similar(self) -> None:
        """Match lines that share much of what is rare in them, the most similar first."""
        old_left, new_left = self.left()
        old, new = _places(self.a, old_left), _places(self.b, new_left)
        shared: dict[tuple[int, int], float] = defaultdict(float)
        old_total: dict[int, float] = defaultdict(float)
        new_total: dict[int, float] = defaultdict(float)
        for content in {**old, **new}:
            have, get = old.get(content, ()), new.get(content, ())
            most = max(len(have), len(get))
            if most > _RARE or len(shared) > _MAX_SIMILAR:
                continue
            weight = _weight(content) / most
            for i in have:
                old_total[i] += weight
            for j in get:
                new_total[j] += weight
            for pair in product(have, get):
                shared[pair] += weight
        ranked = sorted(shared.items(), key=lambda e: (-e[1], abs(e[0][0] - e[0][1]), e[0]))
        for (i, j), weight in ranked:
            enough = weight > _SHARED * min(old_total[i], new_total[j])
            if enough and i not in self.pairs and j not in self.taken:
                self.add(i, j)

    def between(self) -> None:
        """Match lines that stand between the same neighbours, if they are as many as before."""
        for old, new, is_ordered in self.gaps():
            if is_ordered and len(old) == len(new):
                for i, j in zip(old, new, strict=True):
                    self.add(i, j)


def _places(lines: Sequence[LineContents], left: Iterable[int]) -> dict[Hashable, list[int]]:
    """In which of some lines each content stands."""
    places: dict[Hashable, list[int]] = defaultdict(list)
    for k in left:
        for content in dict.fromkeys(lines[k]):
            places[content].append(k)
    return places


def _weight(content: Hashable) -> int:
    """How much a content tells about a line."""
    key = content[1] if isinstance(content, tuple) else content
    return _TEXT if str(key).startswith("'") else _NUMBER


def in_order(pairs: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
    """The most of these pairs, sorted by their first numbers, in which the second ones rise, too.

    >>> in_order([(1, 5), (2, 1), (3, 2), (4, 4), (5, 3)])
    [(2, 1), (3, 2), (5, 3)]
    """
    ends: list[int] = []  # the least second number at which a rising list of each length ends
    at: list[int] = []  # the index of that pair
    before: list[int | None] = []
    for index, (_, to) in enumerate(pairs):
        length = bisect_left(ends, to)
        before.append(at[length - 1] if length else None)
        ends[length : length + 1], at[length : length + 1] = [to], [index]
    rising, last = [], at[-1] if at else None
    while last is not None:
        rising.append(pairs[last])
        last = before[last]
    return rising[::-1]

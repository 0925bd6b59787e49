"""Two workbooks side by side: what was inserted, removed or moved, then formulas, then values.

Rows and columns are aligned by what their cells are, not by what they hold: a heading by its text,
a formula by its operations, a number by being one. So a changed input is one difference, an
inserted row is one, and each formula is compared with where its references have gone.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from difflib import SequenceMatcher
from pathlib import Path

from replication.check.findings import Difference
from replication.check.lines import address, area_of
from spreadsheets.foreign import Position, Value, read
from spreadsheets.recalculation import Calculation, calculate
from spreadsheets.references import Formula, Piece

__all__ = ["KINDS", "Comparison", "Tolerance", "diff"]

KINDS = ("added", "removed", "moved", "formula", "value")
"""What `diff` calls the differences that it finds."""

_MAX_BLOCKS = 200
_MAX_SIMILAR = 2_500
"""Blocks to look for elsewhere, and pairs of lines to compare with each other."""

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
        return self.digits is not None and _print_alike(a, b, self.digits)


def _print_alike(a: float, b: float, digits: int) -> bool:
    """Whether two numbers have the same digits, or one is the other rounded, ties either way.

    >>> _print_alike(9.476105709802965e-07, 9.47610570980297e-07, 15)
    True
    """
    texts = [f"{number:.{digits - 1}e}" for number in (a, b)]
    half = Decimal(f"0.5e{int(texts[0].partition('e')[2]) + 1 - digits}")
    rounded = float(texts[0]) == a or float(texts[1]) == b
    near = abs(Decimal(repr(a)) - Decimal(repr(b))) <= half
    return texts[0] == texts[1] or (rounded and near)


@dataclass
class Comparison:
    """What `coldspray diff` has found; places are those of the second workbook, if it has them."""

    paths: tuple[Path, Path]
    calculations: tuple[Calculation, Calculation]
    differences: list[Difference] = field(default_factory=list)

    @property
    def first(self) -> Difference | None:
        """The first difference in order of calculation."""
        return min(self.differences, key=lambda d: d.rank, default=None)


def diff(
    a: Path, b: Path, *, values_only: bool = False, allowed: Tolerance | None = None
) -> Comparison:
    """Compare two workbooks. Raises WorkbookError for what cannot be read."""
    before, after = calculate(read(a)), calculate(read(b))
    found = _Diff(before, after, values_only, allowed or Tolerance())
    found.run()
    return Comparison((a, b), (before, after), sorted(found.differences, key=lambda d: d.rank))


class _Diff:
    def __init__(
        self, before: Calculation, after: Calculation, values_only: bool, tolerance: Tolerance
    ) -> None:
        self.before, self.after = before, after
        self.values_only, self.tolerance = values_only, tolerance
        self.where: dict[Position, Position] = {}
        self.differences: list[Difference] = []

    def run(self) -> None:
        sheets = _same_sheets(self.before, self.after)
        for name in self.before.book.sheets:
            if name not in sheets:
                self.add((name, 1, 1), "removed", name, None, "the sheet is gone")
            elif sheets[name] != name:
                self.add((sheets[name], 1, 1), "moved", name, sheets[name], "the sheet is renamed")
        for name in self.after.book.sheets:
            if name not in sheets.values():
                self.add((name, 1, 1), "added", None, name, "the sheet is new")
        for name, other in sheets.items():
            self.align(name, other)
        pairs = sorted(self.where.items(), key=lambda pair: (pair[1][0], pair[1][2], pair[1][1]))
        self.group(pairs, self.formulas, "formula")
        self.group(pairs, self.values, "value")

    def add(
        self, place: Position, kind: str, expected: object, found: object, text: str,
        cells: Sequence[Position] = (),
    ) -> None:  # fmt: skip
        rank = self.rank(place, kind)
        shown = [
            v if isinstance(v, float | str) or v is None else str(v) for v in (expected, found)
        ]
        self.differences.append(
            Difference(place, kind, shown[0], shown[1], text, tuple(cells) or (place,), rank)
        )

    def rank(self, place: Position, kind: str) -> tuple[float, ...]:
        """Layout first, then typed cells, then formulas in order of calculation."""
        if kind not in ("formula", "value"):
            return (
                0,
                list(self.after.book.sheets).index(place[0])
                if place[0] in self.after.book.sheets
                else 0,
            )
        return (1, self.after.order.get(place, -1), kind == "value")

    # ---- where each cell has gone

    def align(self, name: str, other: str) -> None:
        """Match the rows and columns of two sheets, then what was moved elsewhere."""
        old = _skeletons(self.before, name)
        new = _skeletons(self.after, other)
        columns = _matched(_profiles(old, 1), _profiles(new, 1))
        rows = _matched(_lines(old, columns.keys()), _lines(new, columns.values()))
        for (row, column), what in old.items():
            there = rows.get(row), columns.get(column)
            if there[0] and there[1] and _alike(what, new.get((there[0], there[1]))):
                self.where[name, row, column] = (other, there[0], there[1])
        taken = {(p[1], p[2]) for p in self.where.values() if p[0] == other}
        left = {c: w for c, w in old.items() if (name, *c) not in self.where}
        free = {c: w for c, w in new.items() if c not in taken}
        self.moved(name, other, left, free)
        self.shifts(name, other, rows, columns)
        for block in _blocks(left):
            cells = [(name, *c) for c in block]
            self.add(cells[0], "removed", _span(cells), None, f"{len(cells)} cells are gone", cells)
        for block in _blocks(free):
            cells = [(other, *c) for c in block]
            self.add(cells[0], "added", None, _span(cells), f"{len(cells)} cells are new", cells)

    def moved(self, name: str, other: str, left: dict[Cell, str], free: dict[Cell, str]) -> None:
        """Blocks that stand elsewhere: the same cells at the same distances."""
        by_form: dict[frozenset[tuple[int, int, str]], list[Cell]] = {}
        for block in _blocks(free)[:_MAX_BLOCKS]:
            by_form.setdefault(_form(block, free), block)
        for block in _blocks(left)[:_MAX_BLOCKS]:
            there = by_form.pop(_form(block, left), None)
            if there is None:
                continue
            down, right = (
                _corner(there)[0] - _corner(block)[0],
                _corner(there)[1] - _corner(block)[1],
            )
            for row, column in block:
                self.where[name, row, column] = (other, row + down, column + right)
                del left[row, column]
                del free[row + down, column + right]
            old = _span([(name, *c) for c in block])
            cells = [(other, *c) for c in sorted(there)]
            self.add(
                cells[0], "moved", old, _span(cells), f"{old} now stands at {_span(cells)}", cells
            )

    def shifts(
        self, name: str, other: str, rows: Mapping[int, int], columns: Mapping[int, int]
    ) -> None:
        """Rows and columns that stand further down or right, each run of them once."""
        for what, places in (("rows", rows), ("columns", columns)):
            for first, last, by in _shifted(places):
                show = (lambda n: str(n)) if what == "rows" else _letter
                was, now = (
                    f"{show(first)} to {show(last)}",
                    f"{show(first + by)} to {show(last + by)}",
                )
                place = (other, first + by, 1) if what == "rows" else (other, 1, first + by)
                self.add(place, "moved", was, now, f"{what} {was} of {name!r} are now {now}")

    # ---- what the cells hold

    def group(
        self,
        pairs: Sequence[tuple[Position, Position]],
        compare: Callable[[Position, Position], tuple[object, object, str] | None],
        kind: str,
    ) -> None:
        """Differences of one kind, those of neighbouring cells in a column as one."""
        run: list[Position] = []
        head: tuple[object, object, str] | None = None

        def close() -> None:
            if run and head is not None:
                more = f", and in {len(run) - 1} cells after it" if len(run) > 1 else ""
                self.add(run[0], kind, head[0], head[1], head[2] + more, tuple(run))

        for old, new in pairs:
            found = compare(old, new)
            if found is None:
                continue
            below = run and run[-1] == (new[0], new[1] - 1, new[2])
            if not below or head is None or found[2] != head[2]:
                close()
                run, head = [], found
            run.append(new)
        close()

    def formulas(self, old: Position, new: Position) -> tuple[object, object, str] | None:
        if self.values_only:
            return None
        a, b = self.before.formulas.get(old), self.after.formulas.get(new)
        texts = self.before.book[old].formula, self.after.book[new].formula
        if (a is None) != (b is None):
            if a is None:
                return self.before.values.get(old), texts[1], "a formula stands in place of a value"
            return texts[0], self.after.values.get(new), "a value stands in place of a formula"
        if a is None or b is None or self.same(a, b):
            return None
        return texts[0], texts[1], "the formulas differ"

    def same(self, a: Formula, b: Formula) -> bool:
        """Whether a formula reads the same cells in the same way, wherever they are now."""
        if len(a.pieces) != len(b.pieces):
            return False
        return all(self.same_piece(p, q) for p, q in zip(a.pieces, b.pieces, strict=True))

    def same_piece(self, p: Piece, q: Piece) -> bool:
        if p.area is None or q.area is None:
            same = p.text.upper() == q.text.upper() if p.kind == "function" else p.text == q.text
            return p.kind == q.kind and same
        ends = [((p.area.top, p.area.left), (q.area.top, q.area.left)),
                ((p.area.bottom, p.area.right), (q.area.bottom, q.area.right))]  # fmt: skip
        for old, new in ends:
            gone = self.where.get((p.area.sheet, *old))
            if gone is not None and gone != (q.area.sheet, *new):
                return False
            if gone is None and (p.area.sheet, *old) in self.before.values:
                return False
        return True

    def values(self, old: Position, new: Position) -> tuple[object, object, str] | None:
        a, b = _value(self.before, old), _value(self.after, new)
        if isinstance(a, float) and isinstance(b, float) and not isinstance(a, bool):
            if self.tolerance.equal(a, b):
                return None
            return a, b, "the values differ"
        return None if a == b else (a, b, "the contents differ")


def _value(calculation: Calculation, place: Position) -> Value | None:
    """The value stored; the computed one where none is."""
    stored = calculation.book[place].value
    value = calculation.values.get(place) if stored is None else stored
    return None if value == "" else value


def _same_sheets(before: Calculation, after: Calculation) -> dict[str, str]:
    """Sheets by name; the ones left over by what they hold."""
    same = {name: name for name in before.book.sheets if name in after.book.sheets}
    left = [name for name in before.book.sheets if name not in same]
    free = [name for name in after.book.sheets if name not in same]
    for name in left:
        own = _skeletons(before, name)
        for other in free:
            if own and own == _skeletons(after, other):
                same[name] = other
                free.remove(other)
                break
    return same


def _skeletons(calculation: Calculation, sheet: str) -> dict[Cell, str]:
    """What each cell is: its text, its operations, or that it is a number."""
    found = {}
    for (row, column), cell in calculation.book.sheets[sheet].items():
        formula = calculation.formulas.get((sheet, row, column))
        if formula is not None:
            pieces = (
                "@" if p.area else "n" if p.kind == "number" else p.text for p in formula.pieces
            )
            found[row, column] = "=" + "".join(pieces)
        elif isinstance(cell.value, str):
            found[row, column] = f"'{cell.value}"
        else:
            found[row, column] = "n"
    return found


def _alike(a: str, b: str | None) -> bool:
    """Whether two cells may be the same one, changed: neither is gone, and texts stay texts."""
    if b is None:
        return False
    return a == b or not (a.startswith("'") or b.startswith("'")) or (a[0] == b[0])


def _profiles(cells: Mapping[Cell, str], axis: int) -> dict[int, tuple[str, ...]]:
    """Each column as what stands in it, repetitions left out."""
    found: dict[int, list[str]] = {}
    for cell in sorted(cells):
        line = found.setdefault(cell[axis], [])
        if not line or line[-1] != cells[cell]:
            line.append(cells[cell])
    return {i: tuple(line) for i, line in sorted(found.items())}


def _lines(cells: Mapping[Cell, str], columns: object) -> dict[int, tuple[str, ...]]:
    """Each row as what stands in some columns."""
    kept = set(columns)  # type: ignore[call-overload]
    found: dict[int, list[str]] = {}
    for row, column in sorted(cells):
        line = found.setdefault(row, [])
        if column in kept:
            line.append(cells[row, column])
    return {i: tuple(line) for i, line in sorted(found.items())}


def _matched(
    old: Mapping[int, tuple[str, ...]], new: Mapping[int, tuple[str, ...]]
) -> dict[int, int]:
    """Which line became which. What is not found again but stands between the same is the same."""
    a, b = list(old), list(new)
    keys = [old[i] for i in a], [new[i] for i in b]
    start = 0
    while start < min(len(a), len(b)) and keys[0][start] == keys[1][start]:
        start += 1
    end = 0
    while end < min(len(a), len(b)) - start and keys[0][-1 - end] == keys[1][-1 - end]:
        end += 1
    pairs = [(i, i) for i in range(start)] + [(len(a) - i, len(b) - i) for i in range(1, end + 1)]
    middle = keys[0][start : len(a) - end], keys[1][start : len(b) - end]
    for tag, i1, i2, j1, j2 in SequenceMatcher(None, *middle).get_opcodes():
        if tag == "equal" or (tag == "replace" and i2 - i1 == j2 - j1):
            pairs += [(start + i1 + k, start + j1 + k) for k in range(i2 - i1)]
        elif tag == "replace" and (i2 - i1) * (j2 - j1) <= _MAX_SIMILAR:
            similar = _similar(middle[0][i1:i2], middle[1][j1:j2])
            pairs += [(start + i1 + i, start + j1 + j) for i, j in similar]
    return {a[i]: b[j] for i, j in sorted(pairs)}


def _similar(
    old: Sequence[tuple[str, ...]], new: Sequence[tuple[str, ...]]
) -> Iterator[tuple[int, int]]:
    """Lines of two lists that are mostly the same, in their order."""
    after = 0
    for i, line in enumerate(old):
        for j in range(after, len(new)):
            if line and SequenceMatcher(None, line, new[j]).ratio() > 0.5:
                yield i, j
                after = j + 1
                break


def _shifted(places: Mapping[int, int]) -> Iterator[tuple[int, int, int]]:
    """First, last and distance of each run that stands elsewhere."""
    run: list[int] = []
    by = 0
    for old, new in [*sorted(places.items()), (None, None)]:
        if old is not None and new is not None and new - old == by and run:
            run.append(old)
            continue
        if run and by:
            yield run[0], run[-1], by
        run, by = ([old], new - old) if old is not None and new is not None else ([], 0)


def _blocks(cells: Mapping[Cell, str]) -> list[list[Cell]]:
    """Cells that touch each other, block by block."""
    left, found = set(cells), []
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
        found.append(sorted(block))
    return sorted(found)


def _form(block: Sequence[Cell], cells: Mapping[Cell, str]) -> frozenset[tuple[int, int, str]]:
    """A block by its cells' distances from its corner and what they are."""
    top, left = _corner(block)
    return frozenset((row - top, column - left, cells[row, column]) for row, column in block)


def _corner(block: Sequence[Cell]) -> Cell:
    return min(row for row, _ in block), min(column for _, column in block)


def _span(cells: Sequence[Position]) -> str:
    rows, columns = [c[1] for c in cells], [c[2] for c in cells]
    sheet = cells[0][0]
    return area_of((sheet, min(rows), min(columns)), (sheet, max(rows), max(columns)))


def _letter(column: int) -> str:
    return address(("", 1, column)).rstrip("1")

"""Two workbooks side by side: what was inserted, removed or moved, then formulas, then values.

Rows and columns are aligned by what their cells are, not by what they hold: a heading by its text,
a formula by its operations, a number by being one. So a changed input is one difference, an
inserted row is one, and each formula is compared with where its references have gone. Where cells
can be matched in several ways, the one that leaves the fewest differences is told.
"""

import math
import re
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from itertools import groupby, product
from pathlib import Path
from unicodedata import normalize

from openpyxl.utils.cell import get_column_letter

from replication.check.examination import Difference
from replication.check.matching import Cell, Shifts, pairings, same_sheets, touching
from replication.check.table import runs, span
from replication.check.words import count
from spreadsheets.foreign import Position, Value, read
from spreadsheets.recalculation import Area, Calculation, Formula, Piece, calculate, parse

KINDS = ("added", "removed", "moved", "name", "formula", "value")
"""What `diff` calls the differences that it finds."""

LAST = "only the last digits of the values differ"
_LAST_DIGITS = 1e-14
"""Relative distance within which that is said: files may keep 15 of them."""
FOLLOWS = "the values differ, as do "
"""How it begins where a value follows from another difference."""


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
        >>> Tolerance(digits=3).equal(0.0, 0.004), Tolerance(digits=17).equal(1.0, 1.0 + 2**-52)
        (False, False)
        """
        if a == b or abs(a - b) <= self.relative * max(abs(a), abs(b)):
            return True
        if self.ulp and abs(a - b) <= self.ulp * math.ulp(max(abs(a), abs(b))):
            return True
        if self.digits is None or 0 in (a, b):  # zero is no other number to so many digits
            return False
        texts = [f"{number:.{self.digits - 1}e}" for number in (a, b)]
        return texts[0] == texts[1] or self._rounds(a, b) or self._rounds(b, a)

    def _rounds(self, exact: float, rounded: float) -> bool:
        """Whether a number is another one rounded, ties either way.

        The other may itself differ in its last bits.
        """
        digits = self.digits or 1
        half = Decimal(f"5e{Decimal(exact).adjusted() - digits}")
        near = abs(Decimal(repr(exact)) - Decimal(repr(rounded)))
        is_rounded = float(f"{rounded:.{digits - 1}e}") == rounded
        return is_rounded and near <= half + min(4 * Decimal(math.ulp(exact)), half / 10)


def diff(
    a: Path, b: Path, *, values_only: bool = False, allowed: Tolerance | None = None
) -> "Comparison":
    """Compare two workbooks. Raises WorkbookError for what cannot be read."""
    comparison = Comparison(calculate(read(a)), calculate(read(b)), allowed or Tolerance())
    comparison.layout()
    formulas: _Differing = {}
    if not values_only:
        comparison.names()
        formulas = comparison.differing(comparison.formulas)
    comparison.group(formulas, "formula")
    values = comparison.differing(comparison.values)
    comparison.group(comparison.traced(values, formulas), "value")
    comparison.differences.sort(key=lambda d: d.rank)
    return comparison


class Comparison:
    """What `coldspray diff` has found, and where: causes in order of calculation, then the rest.

    `where` is where each cell of the first workbook is in the second. Places of differences are
    those of the second workbook, if it has them.
    """

    def __init__(self, before: Calculation, after: Calculation, tolerance: Tolerance) -> None:
        self.before, self.after, self.tolerance = before, after, tolerance
        self.matched({})
        self.differences: list[Difference] = []

    def matched(self, where: Mapping[Position, Position]) -> None:
        """Take cells of the two workbooks as the same."""
        self.where, self.there, self.shifts = {**where}, set(where.values()), Shifts(where)

    def add(
        self, kind: str, cells: Sequence[Position], was: Value | None, now: Value | None, text: str
    ) -> None:
        """Add a difference at the first of some cells; layout first, last digits last."""
        place, sheets = cells[0], list(self.after.book.sheets)
        rank: tuple[float, ...] = (0, sheets.index(place[0]) if place[0] in sheets else 0)
        if kind in ("formula", "value"):  # typed cells, then formulas in order of calculation
            rank = (1, self.after.order.get(place, -1), kind == "value")
        if text.startswith((FOLLOWS, LAST)):
            rank = (3 if text.startswith(LAST) else 2, *rank)
        self.differences.append(Difference(kind, tuple(cells), was, now, text, rank))

    # ---- where each cell has gone

    def layout(self) -> None:
        """Match the sheets, then the cells of each."""
        sheets = same_sheets(self.before, self.after)
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
        self.matched(self.where)

    def align(self, name: str, partner: str) -> None:
        """Match the cells of two sheets in the way that leaves the fewest that differ."""
        old, new = self.before.book.sheets[name], self.after.book.sheets[partner]
        least = math.inf
        for pairs in pairings(self.before, name, self.after, partner):
            trial = Comparison(self.before, self.after, self.tolerance)
            trial.matched({(name, *cell): (partner, *there) for cell, there in pairs.items()})
            trial.moves(name, partner)
            trial.left_over("removed", name, old.keys() - pairs.keys())
            trial.left_over("added", partner, new.keys() - set(pairs.values()))
            if (size := trial.size()) < least:
                best, least = trial, size
            if least <= 1:  # no other way can leave fewer
                break
        self.where |= best.where
        self.differences += best.differences

    def size(self) -> int:
        """How many cells differ, but for numbers; a text for another is one gone and one new."""
        texts = [now for _, now, _ in self.differing(self.values).values()]
        return (
            sum(1 if d.kind == "moved" else len(d.cells) for d in self.differences)
            + len(self.differing(self.formulas))
            + 2 * sum(not isinstance(now, float) for now in texts)
        )

    def left_over(self, kind: str, sheet: str, cells: Iterable[Cell]) -> None:
        """Cells that only one of two sheets has, block by block."""
        what = "new" if kind == "added" else "gone"
        for block in touching(cells):
            shown: Value | None = span(block)
            if len(block) == 1:
                cell = (self.after if kind == "added" else self.before).book[sheet, *block[0]]
                shown = cell.formula or cell.value
            was, now = (None, shown) if kind == "added" else (shown, None)
            are = "is" if len(block) == 1 else "are"
            text = f"{count(len(block), 'cell')} {are} {what}"
            self.add(kind, [(sheet, *cell) for cell in block], was, now, text)

    def moves(self, name: str, sheet: str) -> None:
        """Cells that stand elsewhere: whole rows and columns of a sheet, or blocks."""
        groups: dict[Cell, list[Cell]] = {}  # by how far they moved
        ways: dict[tuple[int, int], set[int]] = {}  # of a row (0) or column (1), and of a new one
        for (_, *old), (_, *new) in self.where.items():
            distance = (new[0] - old[0], new[1] - old[1])
            groups.setdefault(distance, []).append((old[0], old[1]))
            for axis in (0, 1):
                ways.setdefault((axis, old[axis]), set()).add(distance[axis])
                ways.setdefault((axis + 2, new[axis]), set()).add(distance[axis])
        whole = {
            distance: cells
            for distance, cells in groups.items()
            if all(
                len(ways[axis, cell[axis]]) == len(ways[axis + 2, cell[axis] + distance[axis]]) == 1
                for cell in cells
                for axis in (0, 1)
            )
        }
        for axis, what, show in ((0, "rows", str), (1, "columns", get_column_letter)):
            lines = {cell[axis]: by[axis] for by, cells in whole.items() for cell in cells}
            self.lines(name, sheet, lines, what, show)
        for distance in sorted(groups.keys() - whole.keys() - {(0, 0)}):
            self.blocks(name, sheet, sorted(groups[distance]), distance)

    def lines(
        self, name: str, sheet: str, lines: Mapping[int, int], what: str, show: Callable[[int], str]
    ) -> None:
        """Rows or columns that stand so much further down or right, each run of them once.

        Where all took each other's places, two runs are told as one, and more as another order.
        """
        grouped = groupby(sorted(lines.items()), key=lambda pair: pair[1])
        moved = [(by, [old for old, _ in pairs]) for by, pairs in grouped if by]
        came = {old + by: old for by, run in moved for old in run}
        in_turn = bool(moved) and came.keys() == set(came.values())
        if in_turn and len(moved) == 2 and len(moved[0][1]) != len(moved[1][1]):
            # The longer only gives way.
            moved, in_turn = [min(moved, key=lambda each: len(each[1]))], False

        def between(run: Sequence[int], by: int = 0) -> str:
            first, last = (show(end + by) for end in (run[0], run[-1]))
            return f"{what[:-1]} {first}" if len(run) == 1 else f"{what} {first} to {last}"

        def tell(at: int, was: str, now: str, text: str) -> None:
            place = (sheet, at, 1) if what == "rows" else (sheet, 1, at)
            self.add("moved", [place], was, now, text)

        if in_turn and len(moved) > 2:
            every = range(min(came), max(came) + 1)
            order = ", ".join(show(came.get(at, at)) for at in every)
            text = f"{between(every)} of {name!r} are in another order"
            tell(every[0], between(every), f"{what} {order}", text)
        elif in_turn:
            here, there = (between(run) for _, run in moved)
            text = f"{here} and {there} of {name!r} have changed places"
            tell(min(came), here, there, text)
        for by, run in () if in_turn else moved:
            was, now = between(run), between(run, by)
            are = "is" if len(run) == 1 else "are"
            tell(run[0] + by, was, now, f"{was} of {name!r} {are} now {now}")

    def blocks(self, name: str, sheet: str, cells: Sequence[Cell], distance: Cell) -> None:
        """Cells that moved together: one block, if nothing else stood among them."""
        for block in [cells] if self.alone(name, cells) else touching(cells):
            moved = [(row + distance[0], column + distance[1]) for row, column in block]
            was, now = span(block), span(moved)
            some = "" if self.alone(name, block) else f"{count(len(block), 'cell')} of "
            text = f"{some}{was} now stand{'' if some else 's'} at {now}"
            self.add("moved", [(sheet, *c) for c in moved], was, now, text)

    def alone(self, name: str, cells: Sequence[Cell]) -> bool:
        """Whether all that stood in the area of some cells is these cells."""
        sheet = self.before.book.sheets[name]
        rows, columns = (range(min(each), max(each) + 1) for each in zip(*cells, strict=True))
        area = product(rows, columns) if len(rows) * len(columns) < len(sheet) else sheet
        return len(cells) == sum(r in rows and c in columns and (r, c) in sheet for r, c in area)

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
            elif self.alike(a, b) and _fixed(a) == _fixed(b):
                continue
            gone = self.where.get(a.areas[0].corner, first[1]) if a.areas else first[1]
            place = b.areas[0].corner if b.areas else gone
            was, now = (text or "not defined" for text in (was, now))
            self.add("name", [place], was, now, f"the name {shown} {what}")

    def differing(self, compare: Callable[[Position, Position], "_Differs | None"]) -> "_Differing":
        """Cells that differ, by their places in the second workbook."""
        pairs = self.where.items()
        return {new: differs for old, new in pairs if (differs := compare(old, new))}

    def traced(self, values: "_Differing", formulas: "_Differing") -> "_Differing":
        """Values that differ; where they follow from other differences, that is said."""
        removed, added = (
            {cell for d in self.differences if d.kind == kind for cell in d.cells}
            for kind in ("removed", "added")
        )
        pairs = self.where.items()  # within a tolerance, too
        differ = {b for a, b in pairs if _value(self.before, a) != _value(self.after, b)}
        changed, gone = _Cells(added | differ), _Cells(removed)
        olds, traced = {new: old for old, new in pairs}, dict(values)
        for new, (was, now, text) in values.items():
            if text == LAST:
                continue
            if new in formulas:
                text = f"{FOLLOWS}the formulas"
            elif any(map(changed.touch, self.after.areas(new))) or any(
                map(gone.touch, self.before.areas(olds[new]))
            ):
                text = f"{FOLLOWS}the cells that they read"
            traced[new] = was, now, text
        return traced

    def group(self, differing: "_Differing", kind: str) -> None:
        """Differences of one kind, those of neighbouring cells in a column as one.

        Those in last digits are one.
        """
        every = list(runs({place: text for place, (*_, text) in differing.items()}))
        told = [run for run in every if differing[run[0]][2] != LAST]
        last = [place for run in every if differing[run[0]][2] == LAST for place in run]
        for run in filter(None, (*told, last)):
            was, now, text = differing[run[0]]
            where = "more" if text == LAST else "after it"
            more = f", also in {count(len(run) - 1, 'cell')} {where}" if len(run) > 1 else ""
            self.add(kind, run, was, now, text + more)

    def formulas(self, old: Position, new: Position) -> "_Differs | None":
        a, b = self.before.formulas.get(old), self.after.formulas.get(new)
        texts = self.before.book[old].formula, self.after.book[new].formula
        if a and b:
            if self.alike(a, b):
                by_name = not any("$" in str(text) for text in texts)
                but = "one of them by a name" if by_name else "$ fixes others of their references"
                text = f"the formulas read the same cells, but {but}"
                return None if _fixed(a) == _fixed(b) else (*texts, text)
            text = "the text is the same, but what it read is elsewhere now"
            return (*texts, text if texts[0] == texts[1] else "the formulas differ")
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
        stays = p.area == q.area and p.area.corner in p.area.ends  # no whole column or row
        return all(
            self.where[old] == new
            if old in self.where
            else (stays and new not in self.there)  # gone, or blank as before
            or (old not in self.before.values and self.shifts.allow(old, new))
            for old, new in zip(p.area.ends, q.area.ends, strict=True)
        )

    def values(self, old: Position, new: Position) -> "_Differs | None":
        a, b = _value(self.before, old), _value(self.after, new)
        if old in self.before.unknown or new in self.after.unknown:
            return None  # not computed: nothing to compare, as the notes say
        if isinstance(a, float) and isinstance(b, float):
            resolution = max(self.before.book.resolution, self.after.book.resolution)
            if self.tolerance.equal(a, b) or abs(a - b) <= resolution:
                return None
            small = math.isclose(a, b, rel_tol=_LAST_DIGITS)
            return a, b, LAST if small else "the values differ"
        if isinstance(a, str) and isinstance(b, str) and a != b:
            return a, b, _unlike(a, b)
        if type(a) is type(b):
            return None if a == b else (a, b, "the contents differ")
        # A text that spells a truth value is none.
        a, b = (
            f"'{x}'" if str(x).upper() in ("TRUE", "FALSE") and isinstance(x, str) else x
            for x in (a, b)
        )
        return a, b, "the contents differ"


_Differs = tuple[Value | None, Value | None, str]
"""What a cell was, what it is, and how the two differ."""
_Differing = Mapping[Position, _Differs]


class _Cells:
    """Some cells, column by column."""

    def __init__(self, cells: Iterable[Position]) -> None:
        self.rows: dict[tuple[str, int], list[int]] = {}
        for sheet, row, column in sorted(cells):
            self.rows.setdefault((sheet, column), []).append(row)

    def touch(self, area: Area) -> bool:
        """Whether one of them lies in an area."""
        return any(
            bisect_left(rows, area.top) < bisect_right(rows, area.bottom)
            for (sheet, column), rows in self.rows.items()
            if sheet == area.sheet and area.left <= column <= area.right
        )


def _value(calculation: Calculation, place: Position) -> Value | None:
    """The value stored; the computed one where none is."""
    stored = calculation.book[place].value
    value = calculation.values.get(place) if stored is None else stored
    return None if value == "" else value


def _unlike(a: str, b: str) -> str:
    """That two texts differ, and in which characters if nobody can see it.

    >>> _unlike("\N{MICRO SIGN}m", "\N{GREEK SMALL LETTER MU}m")
    'the texts look alike: U+00B5 is now U+03BC'
    """
    if len({" ".join(normalize("NFKC", text).split()) for text in (a, b)}) > 1:
        return "the contents differ"
    if len(a) != len(b):
        return "the texts look alike, but one is longer"
    p, q = next((p, q) for p, q in zip(a, b, strict=True) if p != q)
    return f"the texts look alike: U+{ord(p):04X} is now U+{ord(q):04X}"


def _fixed(formula: Formula) -> list[str]:
    """Which of its references $ fixes: in R1C1 notation these are the ones without brackets."""
    return [re.sub(r"-?\d+", "", p.shape.rpartition("!")[2]) for p in formula.pieces if p.area]

"""Compare two workbooks: first what was inserted, removed or moved, then formulas, then values.

Rows and columns are aligned by the kind of their cells, not by their values: a heading counts by
its text, a formula by its operations, a number by being a number. So a changed input is one
difference, an inserted row is one, and each formula is compared after its references have followed
the move. Where cells can be matched in several ways, the one that leaves the fewest differences is
reported.
"""

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from itertools import groupby, product
from operator import itemgetter
from pathlib import Path
from unicodedata import normalize

from openpyxl.utils.cell import get_column_letter

from replication.check.examination import Difference
from replication.check.matching import Cell, Shifts, pairings, same_sheets, touching
from replication.check.table import runs, span
from replication.check.words import count
from spreadsheets.foreign import Position, Value, read
from spreadsheets.recalculation import Calculation, Formula, Piece, calculate, parse

KINDS = ("added", "removed", "moved", "name", "formula", "value")
"""The kinds of differences that `diff` reports."""

LAST = "only the last digits of the values differ"
_LAST_DIGITS = 1e-14
"""Relative difference up to which `LAST` is said: some programs store only 15 digits."""
FOLLOWS = "the values differ, as do "
"""How the explanation of a value begins that follows from another difference."""


@dataclass(frozen=True)
class Tolerance:
    """How far apart two numbers may be and still count as equal; one criterion is enough."""

    ulp: int = 0
    relative: float = 0.0
    digits: int | None = None

    def equal(self, a: float, b: float) -> bool:
        """Whether two numbers count as equal.

        >>> Tolerance(digits=3).equal(7.6696, 7.6701), Tolerance(ulp=1).equal(1.0, 1.0 + 2**-52)
        (True, True)
        >>> Tolerance(digits=3).equal(0.0, 0.004), Tolerance(digits=17).equal(1.0, 1.0 + 2**-52)
        (False, False)
        """
        if a == b or abs(a - b) <= self.relative * max(abs(a), abs(b)):
            return True
        if self.ulp and abs(a - b) <= self.ulp * math.ulp(max(abs(a), abs(b))):
            return True
        if self.digits is None or 0 in (a, b):  # zero has no significant digits
            return False
        texts = {f"{number:.{self.digits - 1}e}" for number in (a, b)}
        return len(texts) == 1 or _rounds(a, b, self.digits) or _rounds(b, a, self.digits)


def _rounds(exact: float, rounded: float, digits: int) -> bool:
    """Whether `rounded` is `exact` rounded to so many digits, with ties going either way.

    `exact` may be off in its own last bits, so that a tie is not quite one.
    """
    half = Decimal(f"5e{Decimal(exact).adjusted() - digits}")
    distance = abs(Decimal(repr(exact)) - Decimal(repr(rounded)))
    is_rounded = float(f"{rounded:.{digits - 1}e}") == rounded
    return is_rounded and distance <= half + min(4 * Decimal(math.ulp(exact)), half / 10)


def diff(
    a: Path, b: Path, *, values_only: bool = False, allowed: Tolerance | None = None
) -> "Comparison":
    """Compare two workbooks. Raises WorkbookError for a file that cannot be read."""
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
    """The result of `coldspray diff`: causes in order of calculation, then what follows from them.

    `new_place` maps each cell of the first workbook to the same cell in the second. A difference is
    placed in the second workbook, or in the first if the second has no such cell.
    """

    def __init__(self, before: Calculation, after: Calculation, tolerance: Tolerance) -> None:
        self.before, self.after, self.tolerance = before, after, tolerance
        self.match({})
        self.differences: list[Difference] = []

    def match(self, new_place: Mapping[Position, Position]) -> None:
        """Take these cells of the two workbooks as the same."""
        self.new_place, self.shifts = {**new_place}, Shifts(new_place)
        self.matched = set(new_place.values())

    def add(
        self, kind: str, cells: Sequence[Position], was: Value | None, now: Value | None, text: str
    ) -> None:
        """Add a difference at the first of some cells; layout ranks first, last digits last."""
        place, sheets = cells[0], list(self.after.book.sheets)
        rank: tuple[float, ...] = (0, sheets.index(place[0]) if place[0] in sheets else 0)
        if kind in ("formula", "value"):  # typed cells, then formulas in order of calculation
            rank = (1, self.after.order.get(place, -1), kind == "value")
        if text.startswith((FOLLOWS, LAST)):
            rank = (3 if text.startswith(LAST) else 2, *rank)
        self.differences.append(Difference(kind, tuple(cells), was, now, text, rank))

    # ---- where each cell has gone

    def layout(self) -> None:
        """Match the sheets, then the cells of each pair of sheets."""
        partners = same_sheets(self.before, self.after)
        for name in self.before.book.sheets:
            if name not in partners:
                self.add("removed", [(name, 1, 1)], name, None, "the sheet is gone")
        for name in self.after.book.sheets:
            if name not in partners.values():
                self.add("added", [(name, 1, 1)], None, name, "the sheet is new")
        for name, partner in partners.items():
            if name != partner:
                self.add("moved", [(partner, 1, 1)], name, partner, "the sheet is renamed")
            self.align(name, partner)
        self.match(self.new_place)

    def align(self, name: str, partner: str) -> None:
        """Match the cells of two sheets in the way that leaves the fewest differences."""
        old, new = self.before.book.sheets[name], self.after.book.sheets[partner]
        least = math.inf
        for pairs in pairings(self.before, name, self.after, partner):
            trial = Comparison(self.before, self.after, self.tolerance)
            trial.match({(name, *cell): (partner, *to) for cell, to in pairs.items()})
            trial.moves(name, partner)
            trial.unmatched("removed", name, old.keys() - pairs.keys())
            trial.unmatched("added", partner, new.keys() - set(pairs.values()))
            if (size := trial.size()) < least:
                best, least = trial, size
            if least <= 1:  # no other way can leave fewer
                break
        self.new_place |= best.new_place
        self.differences += best.differences

    def size(self) -> int:
        """How many cells differ, not counting numbers that only have another value.

        A cell whose text is replaced counts twice: as one removed and one added.
        """
        contents = [now for _, now, _ in self.differing(self.values).values()]
        return (
            sum(1 if d.kind == "moved" else len(d.cells) for d in self.differences)
            + len(self.differing(self.formulas))
            + 2 * sum(not isinstance(now, float) for now in contents)
        )

    def unmatched(self, kind: str, sheet: str, cells: Iterable[Cell]) -> None:
        """Report cells that only one of two sheets has, block by block."""
        is_new = kind == "added"
        for block in touching(cells):
            shown: Value | None = span(block)
            if len(block) == 1:
                cell = (self.after if is_new else self.before).book[sheet, *block[0]]
                shown = cell.formula or cell.value
            was, now = (None, shown) if is_new else (shown, None)
            verb = "is" if len(block) == 1 else "are"
            text = f"{count(len(block), 'cell')} {verb} {'new' if is_new else 'gone'}"
            self.add(kind, [(sheet, *cell) for cell in block], was, now, text)

    def moves(self, name: str, partner: str) -> None:
        """Report cells of a sheet that moved: whole rows and columns first, then blocks."""
        groups: dict[Cell, list[Cell]] = {}  # cells by how far down and right they moved
        # How far the cells of each row (0) and column (1) moved, by its old and its new number.
        by_old: dict[Cell, set[int]] = {}
        by_new: dict[Cell, set[int]] = {}
        for (_, *old), (_, *new) in self.new_place.items():
            shift = (new[0] - old[0], new[1] - old[1])
            groups.setdefault(shift, []).append((old[0], old[1]))
            for axis in (0, 1):
                by_old.setdefault((axis, old[axis]), set()).add(shift[axis])
                by_new.setdefault((axis, new[axis]), set()).add(shift[axis])
        whole = {
            shift: cells
            for shift, cells in groups.items()
            if all(
                len(by_old[axis, cell[axis]]) == len(by_new[axis, cell[axis] + shift[axis]]) == 1
                for cell, axis in product(cells, (0, 1))
            )
        }
        for axis in (0, 1):
            shifts = {cell[axis]: shift[axis] for shift, cells in whole.items() for cell in cells}
            self.moved_lines(name, partner, axis, shifts)
        for shift in sorted(groups.keys() - whole.keys() - {(0, 0)}):
            self.moved_blocks(name, partner, sorted(groups[shift]), shift)

    def moved_lines(self, name: str, partner: str, axis: int, shifts: Mapping[int, int]) -> None:
        """Report rows (axis 0) or columns (axis 1) that moved; `shifts` says how far each did.

        Lines that moved together are one difference. So are two groups of lines that have changed
        places, and more than two that are only in another order.
        """
        lines, show = (("rows", str), ("columns", get_column_letter))[axis]
        grouped = groupby(sorted(shifts.items()), key=itemgetter(1))
        moved = [(shift, [line for line, _ in pairs]) for shift, pairs in grouped if shift]
        old_number = {line + shift: line for shift, run in moved for line in run}
        is_reordered = bool(moved) and old_number.keys() == set(old_number.values())
        if is_reordered and len(moved) == 2 and len(moved[0][1]) != len(moved[1][1]):
            # The shorter group moved; the longer one only made room for it.
            moved, is_reordered = [min(moved, key=lambda group: len(group[1]))], False

        def shown(run: Sequence[int], shift: int = 0) -> str:
            first, last = (show(end + shift) for end in (run[0], run[-1]))
            return f"{lines[:-1]} {first}" if len(run) == 1 else f"{lines} {first} to {last}"

        def report(line: int, was: str, now: str, text: str) -> None:
            place = (partner, 1, line) if axis else (partner, line, 1)
            self.add("moved", [place], was, now, text)

        if is_reordered and len(moved) > 2:
            every = range(min(old_number), max(old_number) + 1)
            order = ", ".join(show(old_number.get(line, line)) for line in every)
            text = f"{shown(every)} of {name!r} are in another order"
            report(every[0], shown(every), f"{lines} {order}", text)
        elif is_reordered:
            first, second = (shown(run) for _, run in moved)
            text = f"{first} and {second} of {name!r} have changed places"
            report(min(old_number), first, second, text)
        else:
            for shift, run in moved:
                was, now = shown(run), shown(run, shift)
                verb = "is" if len(run) == 1 else "are"
                report(run[0] + shift, was, now, f"{was} of {name!r} {verb} now {now}")

    def moved_blocks(self, name: str, partner: str, cells: Sequence[Cell], shift: Cell) -> None:
        """Report cells that moved together, as one block if nothing else stood among them."""
        for block in [cells] if self.fill_area(name, cells) else touching(cells):
            moved = [(row + shift[0], column + shift[1]) for row, column in block]
            was, now = span(block), span(moved)
            text = f"{was} now stands at {now}"
            if not self.fill_area(name, block):
                text = f"{count(len(block), 'cell')} of {was} now stand at {now}"
            self.add("moved", [(partner, *cell) for cell in moved], was, now, text)

    def fill_area(self, name: str, cells: Sequence[Cell]) -> bool:
        """Whether the smallest area around some cells of the first workbook holds nothing else."""
        sheet = self.before.book.sheets[name]
        rows, columns = (range(min(axis), max(axis) + 1) for axis in zip(*cells, strict=True))
        area = product(rows, columns) if len(rows) * len(columns) < len(sheet) else sheet
        return len(cells) == sum(r in rows and c in columns and (r, c) in sheet for r, c in area)

    # ---- what names stand for, and what the cells hold

    def names(self) -> None:
        """Report names that are new, gone, or stand for something else."""
        books = self.before.book, self.after.book
        corners = [(next(iter(book.sheets)), 1, 1) for book in books]
        for name, shown in {n.upper(): n for book in books for n in book.names}.items():
            was, now = (book.meanings.get(name) for book in books)
            meanings = zip((was, now), corners, books, strict=True)
            a, b = (parse(f"={text}", corner, book) for text, corner, book in meanings)
            what = "stands for something else"
            if was is None or now is None:
                what = "is new" if was is None else "is gone"
            elif self.alike(a, b) and _fixed(a) == _fixed(b):
                continue
            old = self.new_place.get(a.areas[0].corner, corners[1]) if a.areas else corners[1]
            place = b.areas[0].corner if b.areas else old
            was, now = (text or "not defined" for text in (was, now))
            self.add("name", [place], was, now, f"the name {shown} {what}")

    def differing(self, compare: Callable[[Position, Position], "_Differs | None"]) -> "_Differing":
        """The cells that differ, by their places in the second workbook."""
        pairs = self.new_place.items()
        return {new: differs for old, new in pairs if (differs := compare(old, new))}

    def traced(self, values: "_Differing", formulas: "_Differing") -> "_Differing":
        """The values that differ, each with the other difference that it follows from, if any."""
        removed, added = (
            {cell for d in self.differences if d.kind == kind for cell in d.cells}
            for kind in ("removed", "added")
        )
        old_place = {new: old for old, new in self.new_place.items()}
        # A value that differs within the tolerance may still make others differ beyond it.
        changed = added | {
            new
            for new, old in old_place.items()
            if _value(self.before, old) != _value(self.after, new)
        }
        traced = {}
        for new, (was, now, text) in values.items():
            if text != LAST and new in formulas:
                text = f"{FOLLOWS}the formulas"
            elif text != LAST and not (
                changed.isdisjoint(self.after.precedents(new))
                and removed.isdisjoint(self.before.precedents(old_place[new]))
            ):
                text = f"{FOLLOWS}the cells that they read"
            traced[new] = was, now, text
        return traced

    def group(self, differing: "_Differing", kind: str) -> None:
        """Add differences of one kind; equal ones in neighbouring cells of a column are one.

        All that differ only in last digits are one.
        """
        every = list(runs({place: text for place, (*_, text) in differing.items()}))
        groups = [run for run in every if differing[run[0]][2] != LAST]
        last = [place for run in every if differing[run[0]][2] == LAST for place in run]
        for run in filter(None, (*groups, last)):
            was, now, text = differing[run[0]]
            where = "more" if text == LAST else "after it"
            more = f", also in {count(len(run) - 1, 'cell')} {where}" if len(run) > 1 else ""
            self.add(kind, run, was, now, text + more)

    def formulas(self, old: Position, new: Position) -> "_Differs | None":
        """How two cells differ in their formulas, if they do."""
        a, b = self.before.formulas.get(old), self.after.formulas.get(new)
        texts = self.before.book[old].formula, self.after.book[new].formula
        if a and b:
            if self.alike(a, b):
                by_name = not any("$" in str(text) for text in texts)
                but = "one of them by a name" if by_name else "$ fixes different references"
                text = f"the formulas read the same cells, but {but}"
                return None if _fixed(a) == _fixed(b) else (*texts, text)
            text = "the text is the same, but it no longer reads the same cells"
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
        """Whether two pieces of formulas are the same, and read the same cells if they read any."""
        if p.kind == q.kind == "number":
            return float(p.text) == float(q.text)
        if p.area is None or q.area is None:
            texts = {r.text.upper() if r.kind == "function" else r.text for r in (p, q)}
            return p.kind == q.kind and len(texts) == 1
        stays = p.area == q.area and p.area.corner in p.area.ends  # no whole column or row
        return all(
            self.new_place[old] == new
            if old in self.new_place
            else (stays and new not in self.matched)  # gone, or blank as before
            or (old not in self.before.values and self.shifts.allow(old, new))
            for old, new in zip(p.area.ends, q.area.ends, strict=True)
        )

    def values(self, old: Position, new: Position) -> "_Differs | None":
        """How two cells differ in their values, if they do."""
        if old in self.before.unknown or new in self.after.unknown:
            return None  # not computed, so there is nothing to compare: the notes say so
        a, b = _value(self.before, old), _value(self.after, new)
        if isinstance(a, float) and isinstance(b, float):
            resolution = max(self.before.book.resolution, self.after.book.resolution)
            if self.tolerance.equal(a, b) or abs(a - b) <= resolution:
                return None
            small = math.isclose(a, b, rel_tol=_LAST_DIGITS)
            return a, b, LAST if small else "the values differ"
        if type(a) is type(b) and a == b:
            return None
        if isinstance(a, str) and isinstance(b, str):
            return a, b, _how_texts_differ(a, b)
        # Quotes tell the text 'TRUE' from the truth value.
        a, b = (
            f"'{x}'" if isinstance(x, str) and x.upper() in ("TRUE", "FALSE") else x for x in (a, b)
        )
        return a, b, "the contents differ"


_Differs = tuple[Value | None, Value | None, str]
"""What a cell held, what it holds now, and how the two differ."""
_Differing = Mapping[Position, _Differs]


def _value(calculation: Calculation, place: Position) -> Value | None:
    """The stored value of a cell, or the computed one where none is stored."""
    stored = calculation.book[place].value
    value = calculation.values.get(place) if stored is None else stored
    return None if value == "" else value


def _how_texts_differ(a: str, b: str) -> str:
    """Say that two texts differ, and by which characters where they look alike.

    >>> _how_texts_differ("\N{MICRO SIGN}m", "\N{GREEK SMALL LETTER MU}m")
    'the texts look alike: U+00B5 is now U+03BC'
    """
    if len({" ".join(normalize("NFKC", text).split()) for text in (a, b)}) > 1:
        return "the contents differ"
    if len(a) != len(b):
        return "the texts look alike, but one is longer"
    p, q = next((p, q) for p, q in zip(a, b, strict=True) if p != q)
    return f"the texts look alike: U+{ord(p):04X} is now U+{ord(q):04X}"


def _fixed(formula: Formula) -> list[str]:
    """Which of its references are fixed by $: in R1C1 notation those have no brackets."""
    return [re.sub(r"-?\d+", "", p.shape.rpartition("!")[2]) for p in formula.pieces if p.area]

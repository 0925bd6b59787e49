"""Compare two workbooks: first what was inserted, removed or moved, then formulas, then values.

`matching.py` finds out which sheets, rows and columns are the same; `layout.py` says what moved,
and whether a reference in a formula has followed. Only what the files store is compared: nothing is
calculated. A value that is not stored is given by its formula and by the cells that this reads.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from unicodedata import normalize

from replication.check.difference import Difference, counted
from replication.check.following import CellsRead, calculation_order
from replication.check.layout import Layout
from replication.check.references import TextReference, words
from spreadsheets.foreign import Book, Position, StoredCell, Value, read, without_zeros

DIFFERENCE_KINDS = ("setting", "added", "removed", "moved", "name", "formula", "value")
"""The kinds of differences that `diff` reports."""

LAST = "only the last digits of the values differ"
_LAST_DIGITS = 1e-14
"""Relative difference up to which `LAST` is said: some programs store only 15 digits."""
FOLLOWS = "the values differ, as do "
"""How the explanation of a value begins that follows from another difference."""
_DAYS = 1462
"""Days between 1 January 1900, as Excel counts, and 1904: the day 0 of the other date system."""


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
) -> "BookComparison":
    """Compare two workbooks. Raises WorkbookError for a file that cannot be read.

    `values_only`: formulas are compared only where one of the files stores no value.
    """
    before, after = (without_zeros(read(path)) for path in (a, b))
    return BookComparison(before, after, values_only, allowed or Tolerance())


def not_stored(book: Book) -> list[Position]:
    """The formulas for which a book stores no value."""
    return [place for place, cell in book.cells() if cell.formula and cell.value is None]


_Differs = tuple[Value | None, Value | None, str]
"""What a cell held, what it holds now, and how the two differ."""
_Differing = Mapping[Position, _Differs]
"""The cells that differ, by their places in the second workbook."""


class BookComparison:
    """The result of `coldspray diff`: causes in order of calculation, then what follows from them.

    A difference is placed in the second workbook, or in the first if the second has no such cell.
    """

    def __init__(self, before: Book, after: Book, values_only: bool, tolerance: Tolerance) -> None:
        self.before, self.after, self.tolerance = before, after, tolerance
        self.layout = Layout(before, after)
        self.old_place = {new: old for old, new in self.pairs()}
        formulas = {
            new: differs
            for new, old in self.old_place.items()
            if (not values_only or _has_no_value(before[old], after[new]))
            and (differs := self.formula(old, new))
        }
        values = {
            new: differs for new, old in self.old_place.items() if (differs := self.value(old, new))
        }
        self.differences = [
            *self.settings(),
            *self.layout.differences,
            *(() if values_only else self.names()),
            *self.contents(formulas, values),
        ]

    def pairs(self) -> Iterator[tuple[Position, Position]]:
        """The cells that both workbooks have, except those that surely hold the same."""
        for sheet, places in self.layout.places.items():
            partner = self.layout.partners[sheet]
            old, new = self.before.sheets[sheet], self.after.sheets[partner]
            for cell, to in places.items():
                same = old[cell] == new[to] and (
                    self.layout.is_in_place or old[cell].formula is None
                )
                if not same:
                    yield (sheet, *cell), (partner, *to)

    def settings(self) -> Iterator[Difference]:
        """Report date systems that differ: the same number is then another date."""
        systems = [1904 if book.date1904 else 1900 for book in (self.before, self.after)]
        if systems[0] != systems[1]:
            was, now = (f"dates from {year}" for year in systems)
            place = (next(iter(self.after.sheets)), 1, 1)
            text = f"the date system differs: the same number is a date {_DAYS:,} days apart"
            yield Difference("setting", (place,), was, now, text)

    def names(self) -> Iterator[Difference]:
        """Report names that are new, gone, or stand for something else."""
        books = self.before, self.after
        corners = [(next(iter(book.sheets)), 1, 1) for book in books]
        for name, shown in {n.upper(): n for book in books for n in book.names}.items():
            was, now = (book.meanings.get(name) for book in books)
            what = "stands for something else"
            if was is None or now is None:
                what = "is new" if was is None else "is gone"
            elif self.how_formulas_differ(f"={was}", f"={now}", *corners) is None:
                continue
            place = self._place_of(now or was or "")
            was, now = (text or "not defined" for text in (was, now))
            yield Difference("name", (place,), was, now, f"the name {shown} {what}")

    def _place_of(self, meaning: str) -> Position:
        """The first cell that a name stands for, or the first of the workbook."""
        corner = (next(iter(self.after.sheets)), 1, 1)
        areas = (word for word in words(f"={meaning}") if isinstance(word, TextReference))
        area = next(areas, None)
        sheet = None if area is None else self.after.called.get(area.sheet.upper())
        return corner if area is None or sheet is None else (sheet, area.top, area.left)

    # ---- cell by cell

    def formula(self, old: Position, new: Position) -> _Differs | None:
        """How two cells differ in their formulas, if they do."""
        a, b = self.before[old], self.after[new]
        if a.formula is None and b.formula is None:
            return None
        shown = _shown_formula(a), _shown_formula(b)
        if a.formula is None:
            return *shown, "a formula stands in place of a value"
        if b.formula is None:
            return *shown, "a value stands in place of a formula"
        if (a.array is None) != (b.array is None):
            kinds = ("an array formula", "an ordinary formula")[:: 1 if b.array else -1]
            return *shown, f"{kinds[0]} stands in place of {kinds[1]}"
        if a.array and b.array and _area_size(a.array) != _area_size(b.array):
            return *shown, "the array formula fills another number of rows or columns"
        text = self.how_formulas_differ(a.formula, b.formula, old, new)
        return (*shown, text) if text else None

    def how_formulas_differ(self, a: str, b: str, old: Position, new: Position) -> str | None:
        """Say how two formulas differ that stand in what is the same cell; None if they do not."""
        if a == b and self.layout.is_in_place:
            return None
        p, q = words(a), words(b)
        are_alike = len(p) == len(q) and all(
            self.same(x, y, old, new) for x, y in zip(p, q, strict=True)
        )
        if not are_alike:
            moved = "the text is the same, but it no longer reads the same cells"
            return moved if a == b else "the formulas differ"
        fixed = ([word.fixed for word in x if isinstance(word, TextReference)] for x in (p, q))
        if next(fixed) != next(fixed):
            return "the formulas read the same cells, but $ fixes different references"
        return None

    def same(
        self, a: str | TextReference, b: str | TextReference, old: Position, new: Position
    ) -> bool:
        """Whether two words of formulas are the same, and read the same cells if they read any."""
        if isinstance(a, TextReference) and isinstance(b, TextReference):
            return self.layout.follows(a, b, old, new)
        return a == b

    def value(self, old: Position, new: Position) -> _Differs | None:
        """How two cells differ in their stored values, if they do."""
        p, q = self.before[old], self.after[new]
        if _has_no_value(p, q):
            return None
        a, b = (None if cell.value == "" else cell.value for cell in (p, q))
        if type(a) is type(b) and a == b and p.error == q.error:
            return None
        if isinstance(a, float) and isinstance(b, float):
            return self.numbers(a, b)
        if p.error == q.error and isinstance(a, str) and isinstance(b, str):
            return a, b, _how_texts_differ(a, b)
        text = "the contents differ"
        if isinstance(a, str) and isinstance(b, str):
            kinds = ("an error", "a text") if q.error else ("a text", "an error")
            text = f"{kinds[0]} stands in place of {kinds[1]}"
        return _quoted(p), _quoted(q), text

    def numbers(self, a: float, b: float) -> _Differs | None:
        """How two numbers differ, if they do."""
        resolution = max(self.before.resolution, self.after.resolution)
        if self.tolerance.equal(a, b) or abs(a - b) <= resolution:
            return None
        if math.isclose(a, b, rel_tol=_LAST_DIGITS):
            return a, b, LAST
        if self.before.date1904 != self.after.date1904 and abs(a - b) == _DAYS:
            return a, b, "the values differ; as dates they are the same, in the other date system"
        return a, b, "the values differ"

    # ---- in order of calculation

    def contents(self, formulas: _Differing, values: _Differing) -> Iterator[Difference]:
        """Report formulas and values: causes, then what follows from them, then last digits."""
        traced = self.traced(formulas, values)
        reading = CellsRead(self.after, {**formulas, **traced})
        number = {sheet: k for k, sheet in enumerate(self.after.sheets)}
        typed_first = sorted(
            {**formulas, **traced},
            key=lambda at: (self.after[at].formula is not None, number[at[0]], at[1:]),
        )
        order = calculation_order(typed_first, reading)
        differences = [*_grouped("formula", formulas), *_grouped("value", traced)]

        def rank(difference: Difference) -> tuple[int, int, bool]:
            text = difference.explanation
            follows = 2 if text.startswith(LAST) else int(text.startswith(FOLLOWS))
            return follows, order[difference.place], difference.kind == "value"

        yield from sorted(differences, key=rank)

    def traced(self, formulas: _Differing, values: _Differing) -> _Differing:
        """The values that differ, each with the other difference that it follows from, if any."""
        removed, added = (
            [cell for d in self.layout.differences if d.kind == kind for cell in d.cells]
            for kind in ("removed", "added")
        )
        # A value that differs within the tolerance may still make others differ beyond it.
        changed = [
            new
            for new, old in self.old_place.items()
            if self.before[old].value != self.after[new].value
        ]
        now, was = (
            CellsRead(self.after, {*added, *changed, *formulas}),
            CellsRead(self.before, removed),
        )
        traced = {}
        for new, (a, b, text) in values.items():
            if text != LAST and new in formulas:
                text = f"{FOLLOWS}the formulas"
            elif text != LAST and (any(now.read_by(new)) or any(was.read_by(self.old_place[new]))):
                text = f"{FOLLOWS}the cells that they read"
            traced[new] = a, b, text
        return traced


def _has_no_value(a: StoredCell, b: StoredCell) -> bool:
    """Whether one of two cells holds a formula for which no value is stored."""
    return any(cell.formula is not None and cell.value is None for cell in (a, b))


def _shown_formula(cell: StoredCell) -> Value | None:
    """The formula of a cell, in braces if it is an array formula; or else its value."""
    if cell.formula is None:
        return _quoted(cell)
    return f"{{{cell.formula}}}" if cell.array else cell.formula


def _area_size(area: tuple[int, int, int, int]) -> tuple[int, int]:
    top, left, bottom, right = area
    return bottom - top, right - left


def _quoted(cell: StoredCell) -> Value | None:
    """The value of a cell; quotes tell a text that spells a truth value or an error from one."""
    text = cell.value
    if isinstance(text, str) and not cell.error:
        if text.upper() in ("TRUE", "FALSE") or text.startswith("#"):
            return f"'{text}'"
        return text or None
    return text


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


def _grouped(kind: str, differing: _Differing) -> Iterator[Difference]:
    """Yield differences of one kind; equal ones in neighbouring cells of a column are one.

    All that differ only in last digits are one.
    """
    runs: list[list[Position]] = []
    last: list[Position] = []
    for place in sorted(differing, key=lambda place: (place[0], place[2], place[1])):
        sheet, row, column = place
        above, text = (sheet, row - 1, column), differing[place][2]
        if text == LAST:
            last.append(place)
        elif runs and runs[-1][-1] == above and differing[above][2] == text:
            runs[-1].append(place)
        else:
            runs.append([place])
    for run in filter(None, (*runs, last)):
        was, now, text = differing[run[0]]
        where = "more" if text == LAST else "after it"
        more = f", also in {counted(len(run) - 1, 'cell')} {where}" if len(run) > 1 else ""
        yield Difference(kind, tuple(run), was, now, text + more)

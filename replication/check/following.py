"""Which differences follow from others, and in which order cells are calculated."""

from bisect import bisect_left
from collections.abc import Collection, Iterable, Iterator, Mapping

from replication.check.references import TextReference, words
from spreadsheets.foreign import Book, Position

_MAX_WORK = 1_000_000
"""Steps of the search for what formulas read; beyond, a cause may be taken for a consequence."""


class CellsRead:
    """Which of some cells of a book its formulas read."""

    def __init__(self, book: Book, cells: Iterable[Position]) -> None:
        self.book, self.work = book, 0
        self.rows: dict[str, dict[int, list[int]]] = {}
        for sheet, row, column in sorted(cells):
            self.rows.setdefault(sheet, {}).setdefault(column, []).append(row)

    def read_by(self, place: Position) -> Iterator[Position]:
        """The cells, among those given, that the formula of a cell reads."""
        for area in self._areas(place):
            name = self.book.called.get(area.sheet.upper(), area.sheet) if area.sheet else place[0]
            columns = self.rows.get(name, {})
            wanted: Collection[int] = range(area.left, area.right + 1)
            for column in columns if len(columns) < len(wanted) else wanted:
                self.work += 1
                if self.work > _MAX_WORK:
                    return
                if column in wanted and column in columns:
                    rows = columns[column]
                    first, end = (bisect_left(rows, row) for row in (area.top, area.bottom + 1))
                    self.work += end - first
                    yield from ((name, row, column) for row in rows[first:end])

    def _areas(self, place: Position) -> Iterator[TextReference]:
        """The cells that a formula refers to, also by names."""
        cell = self.book[place]
        for word in words(cell.formula or ""):
            if isinstance(word, TextReference):
                yield word
            elif meaning := self.book.meanings.get(word):
                for inner in words(f"={meaning.removeprefix('=')}"):
                    if isinstance(inner, TextReference):
                        yield inner.seen_from(place)
        if cell.array and (cell.formula or "").startswith("=TABLE("):
            # A what-if table also follows the formulas above it and at its left.
            top, left, bottom, right = cell.array
            yield TextReference("", max(top - 1, 1), left, max(top - 1, 1), right, "")
            yield TextReference("", max(top - 1, 1), max(left - 1, 1), bottom, max(left - 1, 1), "")


def calculation_order(cells: Iterable[Position], reading: CellsRead) -> Mapping[Position, int]:
    """The rank of each of some cells, after all of them that it reads.

    `cells` come in the order that they have otherwise. Those that read each other in a circle come
    in no particular order.
    """
    order: dict[Position, int] = {}
    started: set[Position] = set()
    for place in cells:
        stack = [] if place in started else [(place, reading.read_by(place))]
        started.add(place)
        while stack:
            current, read = stack[-1]
            first = next((cell for cell in read if cell not in started), None)
            if first is None:
                order[current] = len(order)
                stack.pop()
            else:
                started.add(first)
                stack.append((first, reading.read_by(first)))
    return order

"""The result of `diff`: one JSON document, and the text and page of it."""

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

from replication import page
from replication.check.diff import FOLLOWS, LAST, BookComparison, not_stored
from replication.check.difference import Difference, counted
from replication.check.shown import (
    NO_LIMIT,
    JsonObject,
    anchor,
    drawn,
    fitted,
    safe,
    whereabouts,
    wrapped,
)
from replication.user_input import printable
from spreadsheets.foreign import Book, Position

_MOST, _MOST_LISTED = 12, 1_000
"""How many differences the text and the page show: with more, the first matter most."""
_SHEETS = 12
"""How many sheets are drawn."""


# ---- for a program


def diff_record(comparison: BookComparison) -> dict[str, Any]:
    """The document of `coldspray diff --json`; `expected` is what the first workbook holds."""
    differences, books = comparison.differences, (comparison.before, comparison.after)
    notes = [note for book in books for note in book.notes]
    for book in books:
        if without := not_stored(book):
            formulas = sum(cell.formula is not None for _, cell in book.cells())
            some = f"{len(without):,} of {counted(formulas, 'formula')}"
            said = "no value is stored: the formulas are compared, not their values"
            notes.append(f"{printable(str(book.path))}: for {some} {said}")
    return {
        "file": " and ".join(printable(str(book.path)) for book in books),
        "verdict": _diff_verdict(comparison),
        "clean": not differences,
        "summary": dict(Counter(d.kind for d in differences)),
        "first": differences[0].record() if differences else None,
        "differences": [d.record() for d in differences],
        "notes": notes,
    }


def _diff_verdict(comparison: BookComparison) -> str:
    """The result in one sentence."""
    differences = comparison.differences
    if not differences:
        equal = "Equal: every cell holds the same"
        is_partial = not_stored(comparison.before) or not_stored(comparison.after)
        return f"{equal}, as far as values are stored." if is_partial else f"{equal}."
    cells = {cell for d in differences if d.kind in ("formula", "value") for cell in d.cells}
    last = {cell for d in differences if d.explanation.startswith(LAST) for cell in d.cells}
    verdict = counted(len(differences), "difference")
    if follow := sum(d.explanation.startswith(FOLLOWS) for d in differences):
        others = "others" if follow < len(differences) else "what is within the tolerance"
        verdict += f", {follow:,} of which follow{'s' * (follow == 1)} from {others}"
    verdict += f", in the contents of {counted(len(cells), 'cell')}" if cells else ""
    if last:
        where = "" if last == cells else f" in {len(last):,} of them"
        verdict += f"; only the last digits differ{where}: --relative 1e-14 takes these as equal"
    return f"{verdict}."


# ---- for a person at a terminal


def change_contents(difference: JsonObject) -> str:
    """Say what a cell held and what it holds now.

    >>> change_contents({"kind": "value", "expected": 500.0, "found": None})
    'was 500.0, is blank'
    >>> change_contents({"kind": "value", "expected": 11.0, "found": "11"})
    "was 11.0, is '11'"
    """
    values = difference["expected"], difference["found"]
    was, now = ("blank" if value is None else safe(value, 120) for value in values)
    if {type(value) for value in values} == {float, str} and difference["kind"] == "value":
        was, now = (
            f"'{shown}'" if isinstance(value, str) and not _is_plain(value) else shown
            for value, shown in zip(values, (was, now), strict=True)
        )
    if difference["kind"] in ("added", "removed"):
        return now if values[0] is None else was
    return f"was {was}, is {now}"


def _is_plain(text: str) -> bool:
    """Whether a text needs no quotes: an error, a truth value, or one that has them already."""
    return text.startswith(("#", "'")) or text in ("TRUE", "FALSE")


def diff_text(record: JsonObject, width: int = NO_LIMIT) -> str:
    """The result for a terminal of this width, the most important first."""
    return fitted(_diff_lines(record), width)


def _diff_lines(record: JsonObject) -> Iterator[str]:
    yield record["verdict"]
    yield ""
    yield safe(record["file"], 200)
    yield from (f"  {safe(note, 300)}" for note in record["notes"])
    differences = record["differences"]
    for number, difference in enumerate(differences[:_MOST]):
        if number < 2:
            yield from ("", "Then" if number else "First in order of calculation")
        yield f"  {whereabouts(difference)}, {difference['kind']}"
        yield f"    {change_contents(difference)}"
        yield wrapped(safe(difference["explanation"], 400), "    ")
    if len(differences) > _MOST:
        yield f"  and {len(differences) - _MOST} more, which --json lists"


# ---- for a browser


def diff_page(record: JsonObject, differences: Sequence[Difference], book: Book) -> str:
    """The page of a record, without scripts and with nothing loaded from outside.

    `differences` are those of the record, with their cells in the book that is drawn.
    """
    sheets, shown = list(book.sheets), differences[:_MOST_LISTED]
    marked = [name for name in sheets if any(d.place[0] == name for d in shown)][:_SHEETS]
    notes = list(record["notes"])
    if len(shown) < len(differences):
        notes.append(f"{len(differences) - len(shown):,} more differences: --json lists them")
    pairs = zip(record["differences"], shown, strict=False)
    parts = {
        **record,
        "notes": notes,
        "head": page.head("replication.report", "replication.check"),
        "listed": [(entry, anchor(d.place, marked)) for entry, d in pairs],
        "sheets": [_drawn_pair(name, marked, shown, book) for name in marked],
    }
    filters = {"safe": safe, "contents": change_contents}
    return page.from_template("replication.check", "diff.html.j2", parts, filters)


def _drawn_pair(
    name: str, sheets: Sequence[str], differences: Sequence[Difference], book: Book
) -> JsonObject:
    """A sheet with its differences marked, with the values that are stored."""

    def content(at: Position) -> tuple[object, str | None]:
        return book[at].value, book[at].formula

    return drawn(name, sheets, differences, book.sheets[name], content)

"""The result of `diff`: one JSON document, and the text, page and JUnit file of it."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from textwrap import fill
from typing import Any
from xml.etree import ElementTree as ET

from openpyxl.utils.cell import get_column_letter

from replication import page
from replication.check.diff import FOLLOWS, LAST, Comparison, not_stored
from replication.check.difference import Difference, counted
from replication.reading import printable
from spreadsheets.engines import address
from spreadsheets.foreign import Book

_MOST, _MOST_LISTED = 12, 1_000
"""How many differences the text and the page show: with more, the first matter most."""
_ROWS, _COLUMNS, _SHEETS = 400, 40, 12
"""How many rows and columns of a sheet are drawn, beyond which only those near marked cells are;
and how many sheets."""
_NEAR = 3
"""How far from a marked cell is near."""

Record = Mapping[str, Any]


# ---- for a program


def diff_record(comparison: Comparison) -> dict[str, Any]:
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
        "verdict": _verdict(comparison),
        "clean": not differences,
        "summary": dict(Counter(d.kind for d in differences)),
        "first": differences[0].record() if differences else None,
        "differences": [d.record() for d in differences],
        "notes": notes,
    }


def _verdict(comparison: Comparison) -> str:
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


def safe(text: object, limit: int = 90) -> str:
    r"""Text from a file made safe to show: one line, no control characters, not too long.

    >>> safe("a\nb\x1b[31m"), safe("abcdef", 5), safe("abcde", 5)
    ('a\\nb\\x1b[31m', 'ab...', 'abcde')
    """
    plain = printable(str(text)[: limit + 1])
    return plain if len(plain) <= limit else f"{plain[: limit - 3]}..."


def contents(difference: Record) -> str:
    """Say what a cell held and what it holds now.

    >>> contents({"kind": "value", "expected": 500.0, "found": None})
    'was 500.0, is blank'
    >>> contents({"kind": "value", "expected": 11.0, "found": "11"})
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


def text(record: Record) -> str:
    """The result for a terminal, the most important first."""
    return "\n".join(_lines(record))


def _lines(record: Record) -> Iterator[str]:
    yield record["verdict"]
    yield ""
    yield safe(record["file"], 200)
    yield from (f"  {safe(note, 300)}" for note in record["notes"])
    differences = record["differences"]
    for number, difference in enumerate(differences[:_MOST]):
        if number < 2:
            yield from ("", "Then" if number else "First in order of calculation")
        more = f" ({difference['cells']})" if difference["count"] > 1 else ""
        yield f"  {safe(difference['sheet'], 40)}!{difference['cell']}{more}, {difference['kind']}"
        yield f"    {contents(difference)}"
        explanation, indent = safe(difference["explanation"], 400), "    "
        yield fill(
            explanation,
            100,
            initial_indent=indent,
            subsequent_indent=indent,
            break_on_hyphens=False,
        )
    if len(differences) > _MOST:
        yield f"  and {len(differences) - _MOST} more, which --json lists"


# ---- for a browser


def html(record: Record, differences: Sequence[Difference], book: Book) -> str:
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
        "listed": [(entry, _anchor(d.place, marked)) for entry, d in pairs],
        "sheets": [_drawn(name, marked.index(name), shown, book) for name in marked],
    }
    filters = {"safe": safe, "contents": contents}
    return page.from_template("replication.check", "diff.html.j2", parts, filters)


def _anchor(place: tuple[str, int, int], sheets: Sequence[str]) -> str:
    """The id of a drawn cell on the page; empty if its sheet is not drawn."""
    sheet, *cell = place
    return f"c{sheets.index(sheet)}-{address(*cell)}" if sheet in sheets else ""


def _drawn(name: str, number: int, differences: Sequence[Difference], book: Book) -> Record:
    """A sheet with its differences marked: its name, column letters, and rows of cells."""
    cells = book.sheets[name]
    origins: dict[tuple[int, int], int] = {}
    kinds: dict[tuple[int, int], str] = {}
    for index, difference in enumerate(differences, 1):
        if difference.place[0] == name:
            origins.setdefault(difference.place[1:], index)
        for sheet, *cell in difference.cells:
            if sheet == name:
                kinds.setdefault((cell[0], cell[1]), difference.kind)
    used = [*cells, *origins]
    rows = _kept({row for row, _ in used}, {row for row, _ in origins}, _ROWS)
    columns = _kept({column for _, column in used}, {column for _, column in origins}, _COLUMNS)

    def drawn(place: tuple[int, int]) -> Record:
        contents = cells.get(place)
        value = "" if contents is None or contents.value is None else contents.value
        is_number, kind = isinstance(value, float), kinds.get(place)
        classes = ("right" * is_number, kind and f"marked {kind}", "origin" * (place in origins))
        return {
            "text": f"{value:.6g}" if is_number else safe(value, 40),
            "formula": safe((contents.formula if contents else None) or "", 200),
            "classes": " ".join(filter(None, classes)),
            "number": origins.get(place),
            "id": f"c{number}-{address(*place)}" if place in origins else "",
        }

    return {
        "name": name,
        "heads": [get_column_letter(column) for column in columns],
        "rows": [(row, [drawn((row, column)) for column in columns]) for row in rows],
    }


def _kept(used: set[int], marked: set[int], most: int) -> list[int]:
    """The used lines; if there are too many, the first of them and those near marked ones."""
    near = {m + i for m in sorted(marked)[:20] for i in range(-_NEAR, _NEAR + 1)}
    lines = sorted(used)
    return lines if len(lines) <= most else sorted({*lines[: most // 4], *(near & used)})


# ---- for a machine that runs tests


def junit(record: Record, kinds: Sequence[str]) -> str:
    """A test suite with one test for each kind of difference: failed if there is one."""
    suite = ET.Element(
        "testsuite", name=f"coldspray {safe(record['file'], 200)}", tests=str(len(kinds)),
        failures=str(len(record["summary"])), errors="0", skipped="0",
    )  # fmt: skip
    for kind in kinds:
        case = ET.SubElement(suite, "testcase", classname="coldspray", name=kind)
        lines = [
            f"{safe(d['sheet'], 40)}!{d['cell']}: {safe(d['explanation'], 300)}"
            for d in record["differences"]
            if d["kind"] == kind
        ]
        if lines:
            message = f"{len(lines)} found, the first at {lines[0]}"
            ET.SubElement(case, "failure", message=message).text = "\n".join(lines)
    ET.indent(suite)
    declared = '<?xml version="1.0" encoding="UTF-8"?>\n'
    return declared + ET.tostring(suite, encoding="unicode") + "\n"

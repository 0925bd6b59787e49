"""What `show` and `diff_show` share: texts of a file made safe, sheets drawn, the JUnit file."""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from textwrap import fill
from typing import Any
from xml.etree import ElementTree as ET

from openpyxl.utils.cell import get_column_letter

from replication.check.difference import Difference
from replication.text import prose
from replication.user_input import printable
from spreadsheets.engines import address
from spreadsheets.foreign import Position

_ROWS, _COLUMNS = 400, 40
"""How many rows and columns of a sheet are drawn; beyond, only those near marked cells."""
_NEAR = 3
"""How far from a marked cell is near."""

JsonObject = Mapping[str, Any]
"""An entry of the JSON, or the whole document."""


def safe(text: object, limit: int = 90) -> str:
    r"""Text from a file made safe to show: one line, no control characters, not too long.

    >>> safe("a\nb\x1b[31m"), safe("abcdef", 5), safe("abcde", 5)
    ('a\\nb\\x1b[31m', 'ab...', 'abcde')
    """
    plain = printable(str(text)[: limit + 1])
    return plain if len(plain) <= limit else f"{plain[: limit - 3]}..."


NO_LIMIT = 10_000
"""The width where nobody reads on a terminal: no line is broken for it."""


def fitted(lines: Iterable[str], width: int) -> str:
    """Lines of text as one, with those that are too long for a terminal broken between words.

    >>> print(fitted(["  holds 499, should hold 495.1"], 20))
      holds 499, should
        hold 495.1
    """
    shown: list[str] = []
    for line in (part for text in lines for part in text.split("\n")):
        indent = " " * (len(line) - len(line.lstrip()))
        long = len(line) > width
        shown.append(prose(line.lstrip(), width, indent, f"{indent}  ") if long else line)
    return "\n".join(shown)


def wrapped(line: str, indent: str) -> str:
    """A line of text for a terminal, broken and indented."""
    return fill(line, 100, initial_indent=indent, subsequent_indent=indent, break_on_hyphens=False)


def _shown_place(difference: JsonObject) -> str:
    """The cell of a difference, or in a text file its line and column."""
    if "where" in difference:
        return safe(difference["where"])
    return f"{safe(difference['sheet'], 40)}!{difference['cell']}"


def whereabouts(difference: JsonObject) -> str:
    """Where a difference stands, with the other cells that it has."""
    more = ""
    if difference["count"] > 1:
        in_text = "where" in difference
        more = f" and {difference['count'] - 1} more" if in_text else f" ({difference['cells']})"
    return _shown_place(difference) + more


# ---- for a browser


def anchor(place: Position, sheets: Sequence[str]) -> str:
    """The id of a drawn cell on the page; empty if its sheet is not among those drawn."""
    sheet, *cell = place
    return f"c{sheets.index(sheet)}-{address(*cell)}" if sheet in sheets else ""


def drawn(
    name: str,
    sheets: Sequence[str],
    differences: Iterable[Difference],
    nonblank: Iterable[tuple[int, int]],
    content: Callable[[Position], tuple[object, str | None]],
) -> JsonObject:
    """A sheet with its differences marked: its name, column letters, and rows of cells.

    `nonblank` are its cells that are not blank, `content` gives the value and the formula of a
    cell.
    """
    origins: dict[tuple[int, int], int] = {}
    kinds: dict[tuple[int, int], str] = {}
    for number, difference in enumerate(differences, 1):
        if difference.place[0] == name:
            origins.setdefault(difference.place[1:], number)
        for sheet, row, column in difference.cells:
            if sheet == name:
                kinds.setdefault((row, column), difference.kind.replace(" ", "-"))
    used = {*nonblank, *origins}
    rows = _kept({row for row, _ in used}, {row for row, _ in origins}, _ROWS)
    columns = _kept({column for _, column in used}, {column for _, column in origins}, _COLUMNS)

    def cell(at: tuple[int, int]) -> JsonObject:
        place = (name, *at)
        value, formula = content(place)
        is_number, kind = isinstance(value, float), kinds.get(at)
        classes = ["right"] if is_number else []
        classes += [f"marked {kind}"] if kind else []
        classes += ["origin"] if at in origins else []
        return {
            "text": f"{value:.6g}" if is_number else safe("" if value is None else value, 40),
            "formula": safe(formula or "", 200),
            "classes": " ".join(classes),
            "number": origins.get(at),
            "id": anchor(place, sheets) if at in origins else "",
        }

    return {
        "name": name,
        "heads": [get_column_letter(column) for column in columns],
        "rows": [(row, [cell((row, column)) for column in columns]) for row in rows],
    }


def _kept(used: set[int], marked: set[int], most: int) -> list[int]:
    """The used lines; if there are too many, the first of them and those near marked ones."""
    near = {m + i for m in sorted(marked)[:20] for i in range(-_NEAR, _NEAR + 1)}
    lines = sorted(used)
    return lines if len(lines) <= most else sorted({*lines[: most // 4], *(near & used)})


# ---- for a machine that runs tests


def junit(record: JsonObject, kinds: Sequence[str], no_fault: Collection[str] = ()) -> str:
    """A test suite with one test for each kind: failed if it was found, skipped if not covered."""
    failed = record["summary"].keys() - no_fault
    suite = ET.Element(
        "testsuite", name=f"coldspray {safe(record['file'], 200)}", tests=str(len(kinds)),
        failures=str(len(failed)), errors="0",
        skipped=str(int("not calculated" in record["summary"])),
    )  # fmt: skip
    for kind in kinds:
        case = ET.SubElement(suite, "testcase", classname="coldspray", name=kind)
        lines = [
            f"{_shown_place(d)}: {safe(d['explanation'], 300)}"
            for d in record["differences"]
            if d["kind"] == kind
        ]
        if kind in failed:
            message = f"{len(lines)} found, the first at {lines[0]}"
            ET.SubElement(case, "failure", message=message).text = "\n".join(lines)
        elif kind == "not calculated" and lines:
            ET.SubElement(case, "skipped", message="\n".join(lines))
        elif lines:
            ET.SubElement(case, "system-out").text = "\n".join(lines)
    ET.indent(suite)
    declared = '<?xml version="1.0" encoding="UTF-8"?>\n'
    return declared + ET.tostring(suite, encoding="unicode") + "\n"

"""What `check` and `diff` found, shown: as text, as a page with the sheets drawn, as JUnit file."""

from base64 import b64encode
from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from importlib import resources
from itertools import pairwise
from textwrap import fill
from typing import Any
from xml.etree import ElementTree as ET

from openpyxl.utils.cell import get_column_letter

from reference.units import written
from replication.check.examination import KINDS, NO_FAULT, Difference
from replication.check.table import address
from replication.check.words import count
from replication.text import aligned, with_unit
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation

_MOST = 12
"""Entries of a list that are shown; whoever has more of one kind has other troubles first."""
_ROWS, _COLUMNS = 400, 40
"""More rows or columns of a sheet are drawn only around what is marked."""
_NEAR = 3

Record = Mapping[str, Any]


def safe(text: object, limit: int = 90) -> str:
    r"""Text from a file as it may be shown: one line, nothing that moves a terminal, not too long.

    >>> safe("a\nb\x1b[31m"), safe("abcdef", 5), safe("abcde", 5)
    ('a\\nb\\x1b[31m', 'ab...', 'abcde')
    """
    cut = str(text)[: limit + 1]
    plain = "".join(c if c.isprintable() else repr(c)[1:-1] for c in cut)
    return plain if len(plain) <= limit else f"{plain[: limit - 3]}..."


def contents(difference: Record) -> str:
    """What a cell holds and what it should hold; of `diff`, what it was and what it is.

    >>> contents({"kind": "value", "expected": 500.0, "found": None})
    'was 500.0, is blank'
    """
    values = difference["expected"], difference["found"]
    expected, found = ("blank" if value is None else safe(value, 120) for value in values)
    if difference["kind"] not in KINDS:
        if difference["kind"] in ("added", "removed"):
            return found if values[0] is None else expected
        return f"was {expected}, is {found}"
    if values[0] is not None:
        return f"holds {found}, should hold {expected}"
    return "" if values[1] is None else f"holds {found}"


# ---- for a person at a terminal


def text(record: Record) -> str:
    """All that was found, the most important first."""
    return "\n".join(_lines(record))


def _lines(record: Record) -> Iterator[str]:
    yield safe(record["file"], 200)
    yield from (f"  {safe(note, 200)}" for note in record["notes"])
    if record["taken"]:
        yield from ("", "What was taken for what")
    for before, taken in zip([None, *record["taken"]], record["taken"], strict=False):
        yield from _table(taken, before["inputs"] if before else {})
    yield from ("", record["verdict"])
    first, differences = record["first"], record["differences"]
    if first:
        yield from ("", "First in order of calculation", *_difference(first))
        for depth in record["final_depths"]:
            if depth["explained_by"]:
                differ = "differs" if depth["differing"] == 1 else "differ"
                cells = f"{count(depth['differing'], 'cell')} of its table {differ}"
                cell = safe(depth["explained_by"], 60)
                explains = f"{cell} alone explains the final depth; {cells} from the right run"
                yield _wrapped(explains, "    ")
    aside = {"other input": "Other inputs than the report's, which are no fault",
             "not calculated": "Not covered"}  # fmt: skip
    kinds = {*aside, "printed number"}  # which have a paragraph of their own
    rest = [d for d in differences if d != first and d["kind"] not in kinds]
    yield from _list("Then", [line for d in rest[:_MOST] for line in _difference(d)], len(rest))
    for kind, title in aside.items():
        of_kind = [d for d in differences if d["kind"] == kind]
        where = ["" if d["count"] > 1 else f"{_where(d)}: " for d in of_kind]
        said = [at + safe(d["explanation"], 300) for at, d in zip(where, of_kind, strict=True)]
        yield from _list(title, [_wrapped(line, "  ") for line in said[:_MOST]], len(of_kind))
    yield from _claims(record["claims"])


def _table(taken: Record, before: Record) -> Iterator[str]:
    """One table; of its inputs those that are not those of the table before."""
    scheme = taken["scheme"]
    named = "the report's scheme" if scheme == "the report's" else f"another scheme, {scheme}"
    sheet = repr(safe(taken["sheet"], 40))
    yield f"  sheet {sheet}: {taken['steps']} steps {taken['direction']}, {named}"
    columns = [
        (name, column["cells"], f"in {column['unit']}", _by(column, column["head"]))
        for name, column in taken["columns"].items()
    ]
    inputs = [
        (name, safe(own["cell"] or "-", 40), with_unit(f"{own['value']:.10g}", own["unit"]),
         _by(own, own["label"]))
        for name, own in taken["inputs"].items()
        if own != before.get(name)
    ]  # fmt: skip
    yield from aligned([(f"    {n.replace('_', ' ')}", *rest) for n, *rest in (*columns, *inputs)])
    if len(inputs) < len(taken["inputs"]):
        yield "    the other inputs are those above"


_WAYS = {
    "rows": "in no cell; solved back from the rows",
    "report": "in no cell; the report's, with which the rows agree",
    "assumed": "in no cell; the report's is assumed",
    "formulas": "in no cell; typed into the formulas",
    "values": "by its values",
    "value": "by its value",
    "--map": "as --map says",
}


def _by(entry: Record, said: str) -> str:
    """How something is known."""
    by = entry["by"]
    if by == "follows":
        return f"follows from {said}"
    return _WAYS.get(by) or f"{by} {safe(said, 40)!r}"


def _difference(difference: Record) -> Iterator[str]:
    yield f"  {_where(difference)}, {difference['kind']}"
    if line := contents(difference):
        yield f"    {line}"
    yield _wrapped(safe(difference["explanation"], 400), "    ")


def _where(difference: Record) -> str:
    more = f" ({difference['cells']})" if difference["count"] > 1 else ""
    return f"{safe(difference['sheet'], 40)}!{difference['cell']}{more}"


def _wrapped(line: str, indent: str) -> str:
    return fill(line, 100, initial_indent=indent, subsequent_indent=indent, break_on_hyphens=False)


def _list(title: str, lines: Sequence[str], of: int) -> Iterator[str]:
    if lines:
        yield from ("", title, *lines)
    if of > _MOST:
        yield f"  and {of - _MOST} more, which --json lists"


def _claims(claims: Sequence[Record]) -> Iterator[str]:
    if not claims:
        return
    shown = [claim for claim in claims if not claim["met"]]
    met = len(claims) - len(shown)
    shown = shown or [c for c in claims if c["id"].startswith(("depth-", "ratio-"))]
    rows = [
        (
            f"  {with_unit(claim['printed'], claim['unit'])}",
            safe(claim["cell"], 40),
            f"{claim['found']:.7g}",
            "as printed" if claim["met"] else f"not in {claim['interval']}",
            claim["title"],
        )
        for claim in shown[:_MOST]
    ]
    yield from ("", f"Of the report's printed numbers it holds {len(claims)}, {met} as printed")
    yield from aligned(rows) if rows else ()
    yield from _list("", [], len(shown))


# ---- for a browser


def html(record: Record, differences: Sequence[Difference], calculation: Calculation) -> str:
    """The page of a record: no script, nothing from outside, its style named by hash.

    `differences` are those of the record, with their cells in the workbook that is drawn.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined
    from markupsafe import Markup

    rooms = ("replication.report", "replication.check")
    style = "".join((resources.files(room) / "page.css").read_text("utf-8") for room in rooms)
    environment = Environment(
        loader=PackageLoader("replication.check", "."), autoescape=True, undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    environment.filters |= {"safe": safe, "contents": contents, "unit": written}
    sheets = list(calculation.book.sheets)
    return environment.get_template("page.html.j2").render(
        record,
        style=Markup(style),  # noqa: S704  (our own file)
        style_hash=b64encode(sha256(style.encode()).digest()).decode(),
        anchors=[_anchor(d.place, sheets) for d in differences],
        sheets=[
            _drawn(name, differences, calculation)
            for name in sheets
            if any(d.place[0] == name for d in differences)
        ],
    )


def _anchor(place: Position, sheets: Sequence[str]) -> str:
    return f"c{sheets.index(place[0])}-{address(place)}" if place[0] in sheets else ""


def _drawn(
    name: str, differences: Sequence[Difference], calculation: Calculation
) -> dict[str, Any]:
    """A sheet with its differences marked: its name, heads, and rows of cells."""
    origins = {d.place: number for number, d in reversed(list(enumerate(differences, 1)))}
    kinds = {place: d.kind for d in reversed(differences) for place in d.cells}
    used = [p for p in (*calculation.values, *origins) if p[0] == name]
    marked = [p for p in dict.fromkeys(d.place for d in differences) if p[0] == name]
    rows = _kept({p[1] for p in used}, {p[1] for p in marked}, _ROWS)
    columns = _kept({p[2] for p in used}, {p[2] for p in marked}, _COLUMNS)
    sheets = list(calculation.book.sheets)

    def cell(row: int | None, column: int | None) -> dict[str, Any] | None:
        if row is None or column is None:
            return None
        place = (name, row, column)
        value = calculation.values.get(place, "")
        number = isinstance(value, float)
        kind = kinds.get(place, "").replace(" ", "-")
        classes = ("right" * number, "marked" * bool(kind), kind, "origin" * (place in origins))
        return {
            "text": f"{value:.6g}" if number else safe(value, 40),
            "formula": safe(calculation.book[place].formula or "", 200),
            "classes": " ".join(filter(None, classes)),
            "number": origins.get(place),
            "id": _anchor(place, sheets) if place in origins else "",
        }

    return {
        "name": name,
        "heads": ["…" if column is None else get_column_letter(column) for column in columns],
        "rows": [("…" if row is None else row, [cell(row, c) for c in columns]) for row in rows],
    }


def _kept(used: set[int], marked: set[int], most: int) -> list[int | None]:
    """All lines, or the first and those around what is marked; None where some are left out."""
    lines = sorted(used)
    if len(lines) > most:
        near = {m + i for m in sorted(marked)[:20] for i in range(-_NEAR, _NEAR + 1)}
        lines = sorted({*lines[: most // 4], *lines[-_NEAR:], *(near & used)})
    kept: list[int | None] = [*lines[:1]]
    for before, line in pairwise(lines):
        gap = range(before + 1, line)
        kept += [*(gap if len(gap) <= _NEAR else [None]), line]
    return kept


# ---- for a machine that runs tests


def junit(record: Record, kinds: Sequence[str]) -> str:
    """A suite with one test for each kind: failed where it was found, skipped where not covered."""
    differences = record["differences"]
    failed = {d["kind"] for d in differences} - NO_FAULT
    suite = ET.Element(
        "testsuite",
        name=f"coldspray {safe(record['file'], 200)}",
        tests=str(len(kinds)),
        failures=str(len(failed)),
        errors="0",
        skipped=str(int("not calculated" in record["summary"])),
    )
    for kind in kinds:
        case = ET.SubElement(suite, "testcase", classname="coldspray", name=kind)
        lines = [
            f"{safe(d['sheet'], 40)}!{d['cell']}: {safe(d['explanation'], 300)}"
            for d in differences
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

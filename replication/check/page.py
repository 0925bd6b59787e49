"""What was found, for a browser, with the sheets drawn and the cells marked; and as JUnit file."""

from base64 import b64encode
from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from importlib import resources
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

from openpyxl.utils.cell import get_column_letter

from reference.units import written
from replication.check.findings import NO_FAULT, Difference
from replication.check.lines import address
from replication.check.record import held, safe
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation

_ROWS, _COLUMNS = 400, 40
"""More rows or columns of a sheet are drawn only around what is marked."""
_NEAR = 3


class _Drawn(NamedTuple):
    name: str
    heads: list[str]
    rows: list[tuple[str, list[dict[str, Any] | None]]]


def html(
    record: Mapping[str, Any], differences: Sequence[Difference], calculation: Calculation
) -> str:
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
    environment.filters |= {"safe": safe, "held": held, "unit": written}
    sheets = list(calculation.book.sheets)
    return environment.get_template("page.html.j2").render(
        record,
        style=Markup(style),  # noqa: S704  (our own file)
        style_hash=b64encode(sha256(style.encode()).digest()).decode(),
        anchors=[_anchor(d.place, sheets) for d in differences],
        sheets=list(_drawn(differences, calculation)),
    )


def _anchor(place: Position, sheets: Sequence[str]) -> str:
    return f"c{sheets.index(place[0])}-{address(place)}" if place[0] in sheets else ""


def _drawn(differences: Sequence[Difference], calculation: Calculation) -> Iterator[_Drawn]:
    """Every sheet with a difference in it."""
    kinds: dict[Position, str] = {}
    origins: dict[Position, int] = {}
    for number, difference in enumerate(differences, 1):
        origins.setdefault(difference.place, number)
        for place in difference.cells:
            kinds.setdefault(place, difference.kind)
    for name in calculation.book.sheets:
        if any(place[0] == name for place in origins):
            yield _sheet(name, kinds, origins, calculation)


def _sheet(
    name: str,
    kinds: Mapping[Position, str],
    origins: Mapping[Position, int],
    calculation: Calculation,
) -> _Drawn:
    used = [p for p in (*calculation.values, *origins) if p[0] == name]
    marked = [p for p in origins if p[0] == name]
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

    heads = ["…" if c is None else get_column_letter(c) for c in columns]
    lines = [("…" if row is None else str(row), [cell(row, c) for c in columns]) for row in rows]
    return _Drawn(name, heads, lines)


def _kept(used: set[int], marked: set[int], most: int) -> list[int | None]:
    """All lines, or the first and those around what is marked; None where some are left out."""
    everything = sorted(used)
    if len(everything) > most:
        near = {m + i for m in sorted(marked)[:20] for i in range(-_NEAR, _NEAR + 1)}
        everything = sorted({*everything[: most // 4], *everything[-_NEAR:], *(near & used)})
    kept: list[int | None] = []
    for line in everything:
        gap = range(kept[-1] + 1, line) if kept and kept[-1] is not None else range(0)
        kept += list(gap) if len(gap) <= _NEAR else [None]
        kept.append(line)
    return kept


def junit(record: Mapping[str, Any], kinds: Sequence[str]) -> str:
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
        found = [d for d in differences if d["kind"] == kind]
        text = "\n".join(_line(d) for d in found)
        if kind in failed:
            message = f"{len(found)} found, the first at {_line(found[0])}"
            ET.SubElement(case, "failure", message=message).text = text
        elif kind == "not calculated" and found:
            ET.SubElement(case, "skipped", message=text)
        elif found:
            ET.SubElement(case, "system-out").text = text
    ET.indent(suite)
    declared = '<?xml version="1.0" encoding="UTF-8"?>\n'
    return declared + ET.tostring(suite, encoding="unicode") + "\n"


def _line(difference: Mapping[str, Any]) -> str:
    where = f"{safe(difference['sheet'], 40)}!{difference['cell']}"
    return f"{where}: {safe(difference['explanation'], 300)}"

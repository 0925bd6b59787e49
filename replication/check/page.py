"""One file for a browser: what was found, and the sheets drawn with the cells marked."""

from base64 import b64encode
from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from importlib import resources
from typing import Any, NamedTuple

from replication.check.difference import Difference
from replication.check.lines import address
from replication.check.record import safe
from spreadsheets.foreign import Position
from spreadsheets.recalculation import Calculation

__all__ = ["html"]

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

    style = (resources.files("replication.check") / "page.css").read_text("utf-8")
    environment = Environment(
        loader=PackageLoader("replication.check", "."), autoescape=True, undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    environment.filters |= {"safe": safe, "shown": _shown}
    sheets = list(calculation.book.sheets)
    return environment.get_template("page.html.j2").render(
        record,
        style=Markup(style),  # noqa: S704  (our own file)
        style_hash=b64encode(sha256(style.encode()).digest()).decode(),
        anchors=[_anchor(d.place, sheets) for d in differences],
        sheets=list(_drawn(differences, calculation)),
    )


def _shown(value: object) -> str:
    if value is None:
        return "nothing"
    return repr(value) if isinstance(value, float) else safe(value, 300)


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

    heads = ["…" if c is None else address((name, 1, c)).rstrip("1") for c in columns]
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

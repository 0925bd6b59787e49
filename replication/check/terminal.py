"""What `check` and `diff` print for a person."""

from collections.abc import Iterator, Mapping, Sequence
from textwrap import fill
from typing import Any

from replication.check.record import held, safe
from replication.check.words import count
from replication.text import aligned, with_unit

_MOST = 12
"""Entries of a list that are shown; whoever has more of one kind has other troubles first."""
_ASIDE = {"other input", "not calculated", "printed number"}
"""Kinds that have a paragraph of their own."""

Record = Mapping[str, Any]


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
    first = record["first"]
    if first:
        yield from ("", "First in order of calculation")
        yield from _difference(first)
        yield from _explained(record["final_depths"])
    rest = [d for d in record["differences"] if d != first and d["kind"] not in _ASIDE]
    yield from _list("Then", [line for d in rest[:_MOST] for line in _difference(d)], len(rest))
    for kind, title in (
        ("other input", "Other inputs than the report's, which are no fault"),
        ("not calculated", "Not covered"),
    ):
        found = [d for d in record["differences"] if d["kind"] == kind]
        lines = [_wrapped(_said(d), "  ") for d in found[:_MOST]]
        yield from _list(title, lines, len(found))
    yield from _claims(record["claims"])


def _said(difference: Record) -> str:
    where = "" if difference["count"] > 1 else f"{_where(difference)}: "
    return f"{where}{safe(difference['explanation'], 300)}"


def _list(title: str, lines: Sequence[str], of: int) -> Iterator[str]:
    if lines:
        yield from ("", title, *lines)
    yield from _more(of)


def _more(of: int) -> Iterator[str]:
    if of > _MOST:
        yield f"  and {of - _MOST} more, which --json lists"


def _table(taken: Record, before: Record) -> Iterator[str]:
    """One table; of its inputs those that are not those of the table before."""
    scheme = taken["scheme"]
    named = "the report's scheme" if scheme == "the report's" else f"another scheme, {scheme}"
    sheet = repr(safe(taken["sheet"], 40))
    yield f"  sheet {sheet}: {taken['steps']} steps {taken['direction']}, {named}"
    columns = [
        (name, column["cells"], f"in {column['unit']}", _by(column, "head"))
        for name, column in taken["columns"].items()
    ]
    inputs = [
        (name, safe(own["cell"] or "-", 40), with_unit(f"{own['value']:.10g}", own["unit"]),
         _by(own, "label"))
        for name, own in taken["inputs"].items()
        if own != before.get(name)
    ]  # fmt: skip
    rows = [(f"    {name.replace('_', ' ')}", *entry) for name, *entry in (*columns, *inputs)]
    yield from aligned(rows)
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


def _by(entry: Record, word: str) -> str:
    """How something is known."""
    by = entry["by"]
    if by == "follows":
        return f"follows from {entry[word]}"
    return _WAYS.get(by) or f"{by} {safe(entry[word], 40)!r}"


def _explained(depths: Sequence[Record]) -> Iterator[str]:
    for depth in depths:
        if depth["explained_by"]:
            differ = "differs" if depth["differing"] == 1 else "differ"
            cells = f"{count(depth['differing'], 'cell')} of its table {differ} from the right run"
            cell = safe(depth["explained_by"], 60)
            yield _wrapped(f"{cell} alone explains the final depth; {cells}", "    ")


def _difference(difference: Record) -> Iterator[str]:
    yield f"  {_where(difference)}, {difference['kind']}"
    if line := held(difference):
        yield f"    {line}"
    yield _wrapped(safe(difference["explanation"], 400), "    ")


def _wrapped(line: str, indent: str) -> str:
    return fill(line, 100, initial_indent=indent, subsequent_indent=indent, break_on_hyphens=False)


def _where(difference: Record) -> str:
    more = f" ({difference['cells']})" if difference["count"] > 1 else ""
    return f"{safe(difference['sheet'], 40)}!{difference['cell']}{more}"


def _claims(claims: Sequence[Record]) -> Iterator[str]:
    met = sum(claim["met"] for claim in claims)
    if not claims:
        return
    yield from ("", f"Of the report's printed numbers it holds {len(claims)}, {met} as printed")
    shown = [claim for claim in claims if not claim["met"]]
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
    yield from aligned(rows) if rows else ()
    yield from _more(len(shown))

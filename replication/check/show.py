"""The result of `check`: one JSON document, and the text and page of it."""

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Any

from reference.units import written
from replication import page
from replication.check.delimited import column_at, where
from replication.check.difference import counted
from replication.check.examination import NO_FAULT, Departure, Examination
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
from replication.check.table import Line, SchemeTable, cell_name
from replication.check.taken import report_case, six_in_si
from replication.check.words import COLUMNS, INPUT_UNITS, is_unit, unit_name
from replication.check.workbook import Checked
from replication.text import columns, quantity, with_unit
from spreadsheets.evaluate import Evaluator
from spreadsheets.foreign import Book, Position

_MOST = 12
"""How many entries of a list the text shows: with more of one kind, the first matter most."""

# ---- for a program


def check_record(check: Checked) -> dict[str, Any]:
    """The document of `coldspray check --json`; a number beyond doubles is null."""
    exams, first, book = check.examinations, check.first, check.evaluator.book
    return {
        "file": str(book.path),
        "verdict": _check_verdict(check),
        "clean": first is None,
        "summary": dict(Counter(d.kind for d in check.differences)),
        "first": first and _entry(first, book),
        "differences": [_entry(d, book) for d in check.differences],
        "taken": [_taken(exam) for exam in exams],
        "final_depths": [_finite(_final_depths(exam)) for exam in exams],
        "claims": [
            {
                "id": number.claim.id, "title": number.claim.title,
                "place": str(number.claim.place), "printed": number.claim.shown,
                "unit": number.claim.unit, "interval": str(number.claim.interval()),
                "cell": cell_name(number.place, True), "found": number.value, "met": number.met,
                **({"where": where(book, number.place)} if book.is_text else {}),
            }
            for number in check.numbers
        ],
        "notes": [*book.notes, *check.others],
    }  # fmt: skip


def _entry(difference: Departure, book: Book) -> JsonObject:
    """The entry of a difference; of a text file it has the line and the column, too, by `where`."""
    entry = _finite(difference.record())
    return {**entry, "where": where(book, difference.place)} if book.is_text else entry


def _finite(record: JsonObject) -> JsonObject:
    """The record with null for numbers that JSON cannot hold."""
    infinite = (float("inf"), float("-inf"))
    return {k: None if v in infinite or v != v else v for k, v in record.items()}


def _check_verdict(check: Checked) -> str:
    """The result in one sentence."""
    causes, faults, exams = check.causes, check.faults, check.examinations
    if not faults:
        others = sum(d.kind == "other input" for d in check.differences)
        inputs = f", with {counted(others, 'other input')}" if others else ""
        extent = "" if any(exam.ends for exam in exams) else " as far as it goes"
        places = {place for exam in exams for place in exam.table.places}
        formulas = check.evaluator.formulas
        numbers = "" if places & formulas.keys() else ", in numbers, no formulas"
        lines = {
            line.place(i) for exam in exams for line in exam.table.helpers for i in line.values
        }
        left = (places | lines) & check.evaluator.reasons.keys()
        if left:
            numbers += f"; {len(left):,} of its formulas not computed"
        if check.evaluator.book.is_text:
            return f"Clean{extent}: {_rows_verdict(exams)}."
        return f"Clean{extent}: the report's sheet{inputs}, cell by cell{numbers}."
    if not causes:
        return (
            f"The sheet is right, with {counted(len(faults), 'number')} beside it not as printed."
        )
    sentence = f"{counted(len(causes), 'difference')} from the report's sheet"
    if unmet := len(faults) - len(causes):
        sentence += f", {counted(unmet, 'printed number')} not met"
    for exam in exams:
        if (depths := _wrong_depth(exam)) is not None:
            reached, right = (f"{depth * 1e6:.7g} um" for depth in depths)
            table = _which_table(exam.table.sheet, exam.table.area("depth"), len(exams))
            return f"{sentence}; the final depth{table} is {reached}, and should be {right}."
    if all(exam.right_depth and exam.final_depth and exam.ends for exam in exams):
        tables = "the table ends" if len(exams) == 1 else "every table ends"
        return f"{sentence}; {tables} at the right depth all the same."
    return f"{sentence}."


def _rows_verdict(exams: Sequence[Examination]) -> str:
    """Say of right rows that a program wrote whether their inputs are the report's, too."""
    others = list(dict.fromkeys(text for exam in exams for text in exam.other_inputs))
    if others:
        listed = "; ".join(others)
        return f"the report's scheme, row by row, to its digits, with other inputs: {listed}"
    if all(report_case(six_in_si(exam), exam.fitted) for exam in exams):
        return "the report's sheet, row by row, to its digits"
    return (
        "the report's scheme, row by row, to its digits, which do not tell whether all inputs are "
        "the report's"
    )


def _wrong_depth(exam: Examination) -> tuple[float, float] | None:
    """The final depth [m] and what it should be, if these differ; None for an excerpt."""
    reached, right = exam.final_depth, exam.right_depth
    if reached is None or right is None or not exam.ends:
        return None
    line = exam.table.lines["depth"]
    close = 1e-9 * abs(right)
    if exam.fitted.probe is None:  # as exactly as the digits of numbers tell
        last = exam.table.number("depth", exam.table.steps) or 0.0
        close += exam.fitted.digits * abs(right)
        close += line.rounding(last) * 10.0 ** exam.units.get("depth", 0.0)
    return None if abs(reached - right) <= close else (reached, right)


def _final_depths(exam: Examination) -> JsonObject:
    """The final depth, and what it should be. An excerpt has no final depth."""
    return {"sheet": exam.table.sheet, "cells": exam.table.area("depth"),
            "found": exam.final_depth if exam.ends else None,
            "expected": exam.right_depth}  # fmt: skip


def _which_table(sheet: str, cells: str, tables: int) -> str:
    """Say which table a final depth is of, if there are several."""
    return f" of {safe(sheet, 40)}!{cells}" if tables > 1 else ""


def _taken(exam: Examination) -> JsonObject:
    """What was taken for what in a table: its scheme, its columns and its inputs."""
    table = exam.table
    return {
        "sheet": table.sheet,
        "direction": "to the right" if table.across else "down",
        "steps": table.steps,
        "scheme": exam.scheme,
        "columns": {
            role: {"cells": table.area(role), "head": line.head, **_lines_of(table, line),
                   "unit": _shown_unit(role, exam.units.get(role, 0.0)),
                   "by": "--map" if line.given else "head" if role in line.roles else "values"}
            for role in COLUMNS if (line := table.lines.get(role)) is not None
        },
        "inputs": {
            role: {"value": entry.si, "unit": INPUT_UNITS[role],
                   "cell": cell_name(entry.place, True) if entry.place else None,
                   "label": entry.label or None, "by": entry.how,
                   **_line_of(table.evaluator.book, entry.place)}
            for role in INPUT_UNITS
            if (entry := exam.inputs.get(role)) is not None
        },
    }  # fmt: skip


def _line_of(book: Book, cell: Position | None) -> dict[str, str]:
    """Where a cell of a text file stands: its line and column."""
    return {"where": where(book, cell)} if book.is_text and cell is not None else {}


def _lines_of(table: SchemeTable, line: Line) -> dict[str, str]:
    """Where a column of a text file stands: the lines and the column."""
    book = table.evaluator.book
    if not book.is_text:
        return {}
    rows = table.rows
    stretch = f"lines {rows[min(rows)]} to {rows[table.steps]}"
    return {"where": f"{column_at(book, line.number)}, {stretch}"}


def _shown_unit(role: str, power: float) -> str:
    """The unit of a column by its decimal logarithm."""
    if abs(power - round(power)) < 1e-9:
        return unit_name(role, round(power))
    return f"{10.0**power:.6g} {COLUMNS[role]}"


# ---- for a person at a terminal


def fault_contents(difference: JsonObject) -> str:
    """Say what a cell holds and should hold.

    >>> fault_contents({"kind": "printed number", "expected": "7.67 um", "found": 7.68e-06})
    'holds 7.68e-06, the report prints 7.67 um'
    >>> fault_contents({"kind": "unit", "expected": "m", "found": "mm"})
    'stated in mm, is in m'
    >>> fault_contents({"kind": "odd formula", "expected": 500.0, "found": None})
    'is blank, should hold 500.0'
    """
    values = difference["expected"], difference["found"]
    expected, content = ("blank" if value is None else safe(value, 120) for value in values)
    if difference["kind"] == "printed number":  # in the report's unit, not the cell's
        return f"holds {content}, the report prints {expected}"
    if difference["kind"] == "unit" and isinstance(values[0], str):
        return f"stated in {content}, is in {expected}" if is_unit(content) else f"is in {expected}"
    if values[0] is None or expected == content:
        return "" if values[1] is None else f"holds {content}"
    if values[1] is None:
        return f"is blank, should hold {expected}"
    reads = content.startswith("=") and isinstance(values[0], str) and expected[:1] != "="
    return f"holds {content}, should {'read' if reads else 'hold'} {expected}"


def check_text(record: JsonObject, width: int = NO_LIMIT) -> str:
    """The result for a terminal of this width, the most important first."""
    return fitted(_check_lines(record, width), width)


def _told_aside(difference: JsonObject) -> str:
    """What a difference that is no fault is, after its place if it has a single one."""
    explanation = safe(difference["explanation"], 300)
    return f"{whereabouts(difference)}: {explanation}" if difference["count"] == 1 else explanation


def _check_lines(record: JsonObject, width: int) -> Iterator[str]:
    yield from (record["verdict"], safe(record["file"], 200))
    first, differences = record["first"], record["differences"]
    if first:
        yield from ("", "First in order of calculation", *_told_difference(first))
    aside = {"other input": "Other inputs than the report's, which are no fault",
             "not calculated": "Not covered"}  # fmt: skip
    apart = {*aside, "printed number"}  # these kinds have a paragraph of their own
    rest = [d for d in differences if d != first and d["kind"] not in apart]
    yield from _paragraph(
        "Then", [line for d in rest[:_MOST] for line in _told_difference(d)], len(rest)
    )
    for kind, title in aside.items():
        of_kind = [d for d in differences if d["kind"] == kind]
        lines = [wrapped(_told_aside(d), "  ") for d in of_kind[:_MOST]]
        yield from _paragraph(title, lines, len(of_kind))
    tables = [line for taken in record["taken"] for line in _taken_lines(taken, width)]
    yield from _paragraph("What was taken for what", tables)
    yield from _paragraph("Notes", [f"  {safe(note, 200)}" for note in record["notes"]])
    claims = record["claims"]
    unmet = [claim for claim in claims if not claim["met"]]
    shown = unmet or [c for c in claims if c["id"].startswith(("depth-", "ratio-"))]
    rows = [
        (
            f"  {with_unit(claim['printed'], claim['unit'])}",
            safe(claim.get("where", claim["cell"]), 60),
            with_unit(f"{claim['found']:.7g}", claim["unit"]),
            "as printed" if claim["met"] else f"not in {claim['interval']}",
            claim["title"],
        )
        for claim in shown[:_MOST]
    ]
    if claims:
        met = f"{len(claims)}, {len(claims) - len(unmet)} as printed"
        yield from ("", f"Of the report's printed numbers it holds {met}")
        yield columns(rows, width)
    yield from _paragraph("", [], len(shown))


def _taken_lines(taken: JsonObject, width: int) -> Iterator[str]:
    """What was taken for what in a table, as lines."""
    scheme = taken["scheme"]
    named = "the report's scheme" if scheme == "the report's" else f"another scheme, {scheme}"
    sheet = repr(safe(taken["sheet"], 40))
    yield f"  sheet {sheet}: {taken['steps']} steps {taken['direction']}, {named}"
    entries = [
        (name, safe(column.get("where", column["cells"]), 60), f"in {column['unit']}",
         _known_by(column["by"], column["head"]))
        for name, column in taken["columns"].items()
    ] + [
        (name, safe(entry.get("where", entry["cell"]) or "-", 60),
         with_unit(f"{entry['value']:.10g}", entry["unit"]),
         _known_by(entry["by"], entry["label"]))
        for name, entry in taken["inputs"].items()
    ]  # fmt: skip
    yield columns([(f"    {name.replace('_', ' ')}", *rest) for name, *rest in entries], width)


_KNOWN_BY = {
    "rows": "in no cell; solved back from the rows",
    "report": "in no cell; the report's, with which the rows agree",
    "formulas": "in no cell; typed into the formulas",
    "values": "by its values",
    "response": "by its response",
    "unread": "by its label; no formula of the table reads it",
    "--map": "as --map says",
}


def _known_by(how: str, label: str) -> str:
    """Say how a column or an input was recognized."""
    if how == "follows":
        return f"follows from {label}"
    return _KNOWN_BY.get(how) or f"{how} {safe(label, 40)!r}"


def _told_difference(difference: JsonObject) -> Iterator[str]:
    yield f"  {whereabouts(difference)}, {difference['kind']}"
    if line := fault_contents(difference):
        yield f"    {line}"
    yield wrapped(safe(difference["explanation"], 400), "    ")


def _paragraph(title: str, lines: Sequence[str], total: int = 0) -> Iterator[str]:
    """A paragraph of lines under a title, if any; `total` counts the entries that there are."""
    if lines:
        yield from ("", title, *lines)
    if total > _MOST:
        yield f"  and {total - _MOST} more, which --json lists"


# ---- for a browser


def check_page(record: JsonObject, differences: Sequence[Departure], evaluator: Evaluator) -> str:
    """The page of a record, without scripts and with nothing loaded from outside.

    `differences` are those of the record, with their cells in the workbook that is drawn.
    """
    sheets = list(evaluator.book.sheets)
    marked = {d.place[0] for d in differences}
    pairs = zip(differences, record["differences"], strict=True)
    listed = sorted(pairs, key=lambda pair: _list_of(pair[1]))  # numbered in this order
    differences = [d for d, _ in listed]
    numbered = [(n, shown, anchor(d.place, sheets)) for n, (d, shown) in enumerate(listed, 1)]
    parts = {
        **record,
        "head": page.head("replication.report", "replication.check"),
        "lists": [
            (*_LISTS[k], list(entries))
            for k, entries in groupby(numbered, key=lambda entry: _list_of(entry[1]))
        ],
        "sheets": [
            _drawn_sheet(name, sheets, differences, evaluator) for name in sheets if name in marked
        ],
    }
    filters = {"safe": safe, "contents": fault_contents, "unit": written, "quantity": quantity,
               "known_by": _known_by}  # fmt: skip
    return page.from_template("replication.check", "page.html.j2", parts, filters)


_LISTS = (
    ("differences", "What differs"),
    ("unmet", "Printed numbers that it does not meet"),
    ("notes", "No fault by itself"),
)
"""The lists of differences on the page: the name and the title of each."""


def _list_of(difference: JsonObject) -> int:
    """The index in `_LISTS` of the list that a difference belongs to."""
    kind = difference["kind"]
    return 2 if kind in NO_FAULT else int(kind == "printed number")


def _drawn_sheet(
    name: str, sheets: Sequence[str], differences: Sequence[Departure], evaluator: Evaluator
) -> JsonObject:
    """A sheet with its differences marked, with the values that were calculated."""
    values, book = evaluator.values, evaluator.book
    nonblank = {place[1:] for place in values if place[0] == name}
    return drawn(name, sheets, differences, nonblank, lambda at: (values.get(at), book[at].formula))

"""What `check` and `diff` found, as one JSON document; text, page and JUnit file show that."""

import math
from collections import Counter
from typing import Any

from replication.check.diff import Comparison
from replication.check.examination import Examination
from replication.check.table import address
from replication.check.words import INPUTS, count, unit_text
from replication.check.workbook import Check, HeldNumber


def check_record(check: Check) -> dict[str, Any]:
    """The document of `coldspray check --json`; a number beyond doubles is null."""
    record = {
        "file": str(check.calculation.book.path),
        "verdict": _verdict(check),
        "clean": check.first is None,
        "summary": check.summary,
        "first": check.first and check.first.record(),
        "differences": [d.record() for d in check.differences],
        "taken": [_taken(f) for f in check.examinations],
        "final_depths": [_depth(f) for f in check.examinations],
        "claims": [_claim(number) for number in check.numbers],
        "notes": list(check.calculation.book.notes),
    }
    return {name: _finite(entry) for name, entry in record.items()}


def diff_record(comparison: Comparison) -> dict[str, Any]:
    """The document of `coldspray diff --json`; `expected` is the first workbook's."""
    differences = comparison.differences
    cells = sum(len(d.cells) for d in differences if d.kind in ("formula", "value"))
    verdict = f"{count(len(differences), 'difference')}, in the contents of {count(cells, 'cell')}"
    if last := len(comparison.last_digits):
        verdict += f"; {last:,} of them, listed last, in the last digits only (1e-14 of the number)"
    return {
        "file": " and ".join(str(c.book.path) for c in comparison.calculations),
        "verdict": f"{verdict}." if differences else "Equal: every cell holds the same.",
        "clean": not differences,
        "summary": dict(Counter(d.kind for d in differences)),
        "first": differences[0].record() if differences else None,
        "differences": [d.record() for d in differences],
        "taken": [],
        "final_depths": [],
        "claims": [],
        "notes": [note for c in comparison.calculations for note in c.book.notes],
    }


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [_finite(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _verdict(check: Check) -> str:
    """One sentence for all of it."""
    causes, faults = check.causes, check.faults
    if not faults:
        others = check.summary.get("other input", 0)
        inputs = f", with {count(others, 'other input')}" if others else ""
        if any(f.ends for f in check.examinations):
            return f"Clean: the report's sheet{inputs}, cell by cell."
        return f"Clean as far as it goes: its rows are the report's sheet{inputs}, cell by cell."
    if not causes:
        are = "is" if len(faults) == 1 else "are"
        return f"The sheet is right; {count(len(faults), 'number')} beside it {are} not as printed."
    if all(d.kind == "operation order" for d in causes):
        return "The report's sheet but for last digits: it calculates in another order."
    sentence = f"{count(len(causes), 'difference')} from the report's sheet"
    for f in check.examinations:
        if (depths := _apart(f)) is not None:
            own, right = (f"{depth * 1e6:.7g} um" for depth in depths)
            return f"{sentence}; the final depth is {own}, and should be {right}."
    if all(v.right_depth and v.final_depth and v.ends for v in check.examinations):
        return f"{sentence}; the final depth is right all the same."
    return f"{sentence}."


def _apart(f: Examination) -> tuple[float, float] | None:
    """The final depth and what it should be, where these differ."""
    own, right = f.final_depth, f.right_depth
    if own is None or right is None or not f.ends or abs(own - right) <= 1e-9 * abs(right):
        return None
    return own, right


def _depth(f: Examination) -> dict[str, Any]:
    """The final depth, what it should be, and the one difference that alone explains it, if any."""
    explains = None
    if (depths := _apart(f)) is not None:
        own, right = depths
        effects = {d: abs(d.effect - own) for d in f.differences if d.effect is not None}
        nearest = min(effects, key=lambda d: effects[d], default=None)
        if nearest and effects[nearest] < 0.05 * abs(own - right):
            explains = address(nearest.place, True)
    return {
        "found": f.final_depth,
        "expected": f.right_depth,
        "explained_by": explains,
        "differing": f.differing,
    }


def _taken(f: Examination) -> dict[str, Any]:
    """What was taken for what."""
    table = f.table
    return {
        "sheet": table.sheet,
        "direction": "to the right" if table.across else "down",
        "steps": table.steps,
        "scheme": f.rows.rules.name,
        "columns": {
            role: {
                "cells": table.area(role),
                "head": line.head,
                "unit": unit_text(role, f.powers[role]),
                "by": "--map" if line.given else "head" if role in line.roles else "values",
            }
            for role, line in table.lines.items()
        },
        "inputs": {
            role: {
                "value": own.si,
                "unit": INPUTS[role],
                "cell": address(own.place, True) if own.place else None,
                "label": own.label or None,
                "by": own.how,
            }
            for role in INPUTS
            if (own := f.inputs.get(role)) is not None
        },
    }


def _claim(number: HeldNumber) -> dict[str, Any]:
    return {
        "id": number.claim.id,
        "title": number.claim.title,
        "where": str(number.claim.place),
        "printed": number.claim.shown,
        "unit": number.claim.unit,
        "interval": str(number.claim.interval()),
        "cell": address(number.place, True),
        "found": number.found,
        "met": number.met,
    }

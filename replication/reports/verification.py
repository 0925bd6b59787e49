"""What the engines make of the workbook, as `coldspray workbook --verify` prints it."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from replication.text import aligned
from spreadsheets.compare import Difference
from spreadsheets.verify import EngineCheck, SheetCheck

__all__ = ["verification_record", "verification_text"]

_SHOWN = 5
"""So many unexplained cells of an engine are printed; the JSON has them all."""

_HEADS = ("sheet", "cells", "differ", "explained", "largest", "in tolerance")
_UNITS = ("", "", "", "", "[ulp]", "")


def verification_record(path: Path, checks: Sequence[EngineCheck]) -> dict[str, Any]:
    """The JSON of `coldspray workbook --verify`."""
    return {
        "file": str(path),
        "passed": all(check.passed for check in checks),
        "engines": [_engine_record(check) for check in checks],
    }


def _engine_record(check: EngineCheck) -> dict[str, Any]:
    return {
        "engine": check.engine,
        "version": check.version or None,
        "outcome": check.outcome,
        "reason": check.reason or None,
        "seconds": check.seconds if check.sheets else None,
        "sheets": [_sheet_record(sheet) for sheet in check.sheets],
    }


def _sheet_record(sheet: SheetCheck) -> dict[str, Any]:
    return {
        "sheet": sheet.sheet,
        "cells": sheet.cells,
        "differ": sheet.differ,
        "explained": len(sheet.explained),
        "unbounded": len(sheet.unbounded),
        "largest_ulps": sheet.largest_ulps,
        "tolerated": len(sheet.tolerated),
        "unexplained": [_difference_record(left) for left in sheet.unexplained],
    }


def _difference_record(left: Difference) -> dict[str, Any]:
    return {
        "cell": left.cell,
        "expected": left.expected,
        "found": left.found,
        "ulps": left.ulps,
    }


def verification_text(checks: Sequence[EngineCheck]) -> str:
    """A table for each engine, then what the columns mean and the outcome."""
    blocks = ["\n".join(_engine_lines(check)) for check in checks]
    return "\n\n".join([*blocks, _LEGEND, _summary(checks)])


_LEGEND = """\
Cells are formulas. Those that differ but are explained are what the workbook's own formulas give in
the engine's long doubles, to an ulp. Those in tolerance pass through LN, SIN, ASIN or a cube root:
they lie within the rounding error of that chain, and do not count as different. The largest
distance is that of any two numbers, these and those."""


def _engine_lines(check: EngineCheck) -> list[str]:
    head = f"{check.engine} {check.version}".rstrip()
    if not check.sheets:
        return [f"{head}: {check.outcome}", f"  {check.reason}"]
    rows = [_HEADS, _UNITS, *map(_sheet_row, check.sheets), _total(check.sheets)]
    lines = [f"{head}: {check.outcome}, {check.seconds:.2f} s", *_table(rows)]
    unbounded = sum(len(sheet.unbounded) for sheet in check.sheets)
    if unbounded:
        lines.append(f"  {unbounded} not bounded here: NumPy has no 80-bit long doubles")
    wrong = [left for sheet in check.sheets for left in sheet.unexplained]
    lines += [f"  {left}" for left in wrong[:_SHOWN]]
    if len(wrong) > _SHOWN:
        lines.append(f"  and {len(wrong) - _SHOWN} more")
    return lines


def _sheet_row(sheet: SheetCheck) -> tuple[str, ...]:
    counts = (
        sheet.cells,
        sheet.differ,
        len(sheet.explained),
        sheet.largest_ulps,
        len(sheet.tolerated),
    )
    return (sheet.sheet, *map(str, counts))


def _total(sheets: Sequence[SheetCheck]) -> tuple[str, ...]:
    counts = (
        sum(sheet.cells for sheet in sheets),
        sum(sheet.differ for sheet in sheets),
        sum(len(sheet.explained) for sheet in sheets),
        max(sheet.largest_ulps for sheet in sheets),
        sum(len(sheet.tolerated) for sheet in sheets),
    )
    return ("all", *map(str, counts))


def _table(rows: Sequence[tuple[str, ...]]) -> list[str]:
    """Names to the left of their column, numbers to the right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)][1:]
    right = [
        (name, *(f"{text:>{width}}" for text, width in zip(texts, widths, strict=True)))
        for name, *texts in rows
    ]
    return [f"  {line}" for line in aligned(right)]


def _summary(checks: Sequence[EngineCheck]) -> str:
    ran = [check for check in checks if check.outcome != "missing"]
    good = [check for check in ran if check.passed]
    return f"{len(good)} of {len(ran)} engines on this machine give the values of the workbook"

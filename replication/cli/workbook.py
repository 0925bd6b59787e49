"""`coldspray workbook`: the live workbook of the report, or of a case."""

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from replication.cli import options as shared
from replication.reading import one_line
from replication.text import aligned

if TYPE_CHECKING:
    from spreadsheets.engines import EngineCheck


def workbook_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    output = Path("workbook.xlsx")
    command.add_argument(
        "-o", "--output", type=shared.path, default=output, metavar="FILE", help=f"{output}"
    )
    flag = partial(command.add_argument, action="store_true")
    flag("--force", help="write over a file that is not as coldspray wrote it")
    prepared = "time steps to prepare (default: twice those needed)"
    shared.whole_option(command, "--rows", 1, 10**6, prepared)
    flag("--verify", help="recalculate it in every engine; status 1 if they err")
    shared.output_options(command, quiet="no warnings and no other words")
    shared.scheme_option(command)
    shared.input_options(command, "the report's two cases")


def run_workbook(options: argparse.Namespace) -> int:
    """Write, and verify if asked to."""
    from replication import workbook
    from spreadsheets import emit, engines
    from spreadsheets.safely import write_bytes

    emit.check(options.output, force=options.force)
    if options.output.suffix.lower() != ".xlsx":
        raise ValueError(f"{options.output}: a workbook's name ends in .xlsx")
    own = options.case is not None or options.case_file is not None or shared.given(options)
    case = shared.case(options) if own else None
    book = workbook.build(case, options.scheme, options.rows)
    if options.verify and all(engine.missing() for engine in engines.ENGINES):
        raise ValueError("no spreadsheet engine here: run pip install ironcalc formualizer")
    write_bytes(options.output, book.to_bytes())
    checks = [
        engines.verify(options.output, book.plan, book.cells, engine, long_doubles=book.rounding)
        for engine in (engines.ENGINES if options.verify else ())
    ]
    passed = all(check.passed for check in checks)
    if options.json:
        shared.print_json(
            {
                "file": str(options.output),
                "passed": passed if options.verify else None,
                "long_double_bound": book.rounding,
                "engines": list(map(asdict, checks)),
                "warnings": list(book.warnings),
            }
        )
    elif not options.quiet:
        print(f"Written: {one_line(str(options.output))}")
        if checks:
            print("", *_text(checks, book.rounding), sep="\n")
        shared.warn(options, book.warnings)
    return 0 if passed else 1


# What the engines make of the workbook

_SHOWN = 5
"""So many wrong cells of an engine are printed; the JSON has them all."""

_LEGEND = """\
Cells are formulas. Rounded are those that differ in their last digits only: those that pass through
LN, SIN, ASIN or a cube root, within the rounding of that chain; and, of an engine of long doubles,
those within {bound:.1e} of the largest number of their column, a proven bound on our rounding."""


def _text(checks: "Sequence[EngineCheck]", bound: float) -> Iterator[str]:
    """A line for each engine, what is wrong with it, what the columns mean, and the outcome."""
    rows: list[tuple[str, ...]] = [("engine", "outcome", "seconds", "cells", "rounded", "wrong")]
    for check in checks:
        seconds = "" if check.seconds is None else f"{check.seconds:.2f}"
        counts = map(str, (check.cells, check.rounded, len(check.wrong)))
        rows.append((f"{check.engine} {check.version or ''}", check.outcome, seconds, *counts))
    yield from aligned(rows, right=True)
    for check in checks:
        wrong = [
            f"{left.sheet}!{left.cell}: expected {left.expected!r}, found {left.found!r}"
            for left in check.wrong
        ]
        if len(wrong) > _SHOWN:
            wrong[_SHOWN:] = [f"and {len(wrong) - _SHOWN} more"]
        yield from (f"{check.engine}: {words}" for words in (check.reason, *wrong) if words)
    yield from ("", _LEGEND.format(bound=bound), "")
    ran = [check for check in checks if check.outcome != "missing"]
    good = sum(check.passed for check in ran)
    yield f"{good} of {len(ran)} engines on this machine give the values of the workbook"

"""`coldspray workbook`: the live workbook of the report, or of a case."""

import argparse
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from replication.cli import options as shared
from replication.reading import name_of
from replication.text import aligned

if TYPE_CHECKING:
    from spreadsheets.verify import EngineCheck

HELP = "write the live workbook"


def options(command: argparse.ArgumentParser) -> None:
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


def run(options: argparse.Namespace) -> int:
    """Write, and verify if asked to."""
    from replication import workbook
    from spreadsheets import emit, engines
    from spreadsheets.verify import verify

    emit.check(options.output, force=options.force)
    if options.output.suffix.lower() != ".xlsx":
        raise ValueError(f"{name_of(options.output)}: a workbook's name ends in .xlsx")
    own = options.case is not None or options.case_file is not None or shared.given(options)
    case = shared.case(options) if own else None
    book = workbook.build(case, options.scheme, options.rows)
    if options.verify and all(engine.missing() for engine in engines.ENGINES):
        raise ValueError("no spreadsheet engine here: run pip install ironcalc formualizer")
    emit.write(options.output, book.to_bytes(), force=options.force)
    said, checks = [f"Written: {name_of(options.output)}"], []
    if options.verify:
        compared = partial(
            verify, options.output, book.plan, book.cells, long_doubles=book.rounding
        )
        checks = list(map(compared, engines.ENGINES))
        said += ["", _text(checks, book.rounding)]
    passed = all(check.passed for check in checks)
    if options.json:
        shared.print_json(
            {
                "file": str(options.output),
                "passed": passed if options.verify else None,
                "long_double_bound": book.rounding,
                "engines": _engine_records(checks),
                "warnings": list(book.warnings),
            }
        )
    elif not options.quiet:
        print(*said, sep="\n")
        shared.warn(options, book.warnings)
    return 0 if passed else 1


# What the engines make of the workbook


def _engine_records(checks: "Sequence[EngineCheck]") -> list[dict[str, Any]]:
    import msgspec

    records: list[dict[str, Any]] = msgspec.to_builtins(checks)
    for left in (d for of in records for sheet in of["sheets"] for d in sheet["unexplained"]):
        del left["sheet"]  # it stands above
    return records


_SHOWN = 5
"""So many unexplained cells of an engine are printed; the JSON has them all."""

_HEADS = ("sheet", "cells", "differ", "explained", "largest", "in tolerance")
_UNITS = ("", "", "", "", "[ulp]", "")

_LEGEND = """\
Cells are formulas. Explained are those that an engine computes in long doubles and that lie within
{bound:.1e} of the largest number of their column, a proven bound on the rounding of doubles. In
tolerance are those that pass through LN, SIN, ASIN or a cube root, within the rounding of that
chain; they do not count as different. Largest is the greatest distance of two numbers."""


def _text(checks: "Sequence[EngineCheck]", bound: float) -> str:
    """A table for each engine, then what the columns mean and the outcome."""
    blocks = ["\n".join(_engine_lines(check)) for check in checks]
    ran = [check for check in checks if check.outcome != "missing"]
    good = sum(check.passed for check in ran)
    outcome = f"{good} of {len(ran)} engines on this machine give the values of the workbook"
    return "\n\n".join([*blocks, _LEGEND.format(bound=bound), outcome])


def _engine_lines(check: "EngineCheck") -> Iterator[str]:
    head = f"{check.engine} {check.version or ''}".rstrip()
    if not check.sheets:
        yield from (f"{head}: {check.outcome}", f"  {check.reason}")
        return
    yield f"{head}: {check.outcome}, {check.seconds:.2f} s"
    rows = [
        (s.sheet, s.cells, s.differ, s.explained, s.largest_ulps, s.tolerated) for s in check.sheets
    ]
    _, *columns = zip(_HEADS, *rows, strict=True)
    total = ("all", *((max if head == "largest" else sum)(of) for head, *of in columns))
    texts = [tuple(map(str, row)) for row in (*rows, total)]
    yield from (f"  {line}" for line in aligned([_HEADS, _UNITS, *texts], right=True))
    wrong = [left for sheet in check.sheets for left in sheet.unexplained]
    yield from (f"  {left}" for left in wrong[:_SHOWN])
    if len(wrong) > _SHOWN:
        yield f"  and {len(wrong) - _SHOWN} more"

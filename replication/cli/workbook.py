"""`coldspray workbook`: write the live workbook of the report, or of a case."""

import argparse
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from replication.cli.case import add_inputs, case_of, is_given
from replication.cli.options import add_json, add_quiet, add_scheme, path, whole
from replication.cli.output import put
from replication.text import aligned
from replication.user_input import one_line

if TYPE_CHECKING:
    from spreadsheets.verify import EngineCheck

HELP = "write the live workbook of the report, or of a case"
EXAMPLE = "coldspray workbook --radius '15 um' -o larger.xlsx"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "-o", "--output", metavar="FILE", type=path, default=path("workbook.xlsx"),
        help="file to write (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--force",
        action="store_true",
        help="overwrite even a file that is not as coldspray wrote it",
    )
    parser.add_argument(
        "--rows", metavar="N", type=whole(1, 1_048_576),
        help="time steps to prepare (default: twice those needed)",
    )  # fmt: skip
    parser.add_argument(
        "--verify", action="store_true",
        help="recalculate it in every engine; status 1 if a cell is wrong",
    )  # fmt: skip
    add_scheme(parser)
    add_json(parser)
    add_quiet(parser, "print nothing but errors")
    add_inputs(parser, default="the report's two cases")


def run(options: argparse.Namespace) -> int:
    """Write the workbook of the report, or of a case if one is named, and verify it if asked to."""
    from replication import workbook
    from spreadsheets import emit, engines
    from spreadsheets.safely import write_bytes
    from spreadsheets.verify import verify

    emit.check_writable(options.output, force=options.force)
    if options.output.suffix.lower() != ".xlsx":
        raise ValueError(f"{options.output}: a workbook's name ends in .xlsx")
    case, warnings = case_of(options) if is_given(options) else (None, list[str]())
    book = workbook.build_workbook(case, options.scheme, options.rows)
    write_bytes(options.output, book.to_bytes())
    checks = [
        verify(options.output, book.plan, book.cells, engine, long_doubles=book.rounding)
        for engine in (engines.ENGINES if options.verify else ())
    ]
    warnings += book.warnings
    passed = all(check.passed for check in checks)
    record = {
        "file": str(options.output),
        "passed": passed if options.verify else None,
        "long_double_bound": book.rounding,
        "engines": checks,
        "warnings": warnings,
    }
    verified = ["", *_verified(checks, book.rounding)] if checks else []
    text = "\n".join([f"Written: {one_line(str(options.output))}", *verified])
    put(options, record, lambda: text, warnings=warnings, quietly=True)
    return 0 if passed else 1


_LEGEND = """\
Cells: formulas. Rounded: those that differ in their last digits only. Either they pass through LN,
SIN, ASIN or a cube root and differ within the rounding of that chain, or the engine computes in
long doubles and they differ by at most {bound:.1e} of the largest number of their column, a proven
bound on our rounding."""


def _verified(checks: "Sequence[EngineCheck]", bound: float) -> Iterator[str]:
    """Yield a table of engines, their wrong cells, what the columns mean, and the outcome."""
    rows: list[tuple[str, ...]] = [("engine", "outcome", "seconds", "cells", "rounded", "wrong")]
    for check in checks:
        seconds = "" if check.seconds is None else f"{check.seconds:.2f}"
        counts = map(str, (check.cells, check.rounded, len(check.wrong)))
        rows.append((f"{check.engine} {check.version or ''}", check.outcome, seconds, *counts))
    yield from aligned(rows, right=True)
    for check in checks:
        wrong = [
            f"{cell.sheet}!{cell.cell}: expected {cell.expected!r}, found {cell.found!r}"
            for cell in check.wrong
        ]
        if len(wrong) > 5:  # the JSON has them all
            wrong[5:] = [f"and {len(wrong) - 5} more"]
        yield from (f"{check.engine}: {words}" for words in (check.reason, *wrong) if words)
    yield from ("", _LEGEND.format(bound=bound), "")
    ran = [check for check in checks if check.outcome != "missing"]
    good = sum(check.passed for check in ran)
    yield f"{good} of {len(ran)} engines on this machine give the values of the workbook"

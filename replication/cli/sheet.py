"""`coldspray sheet`: the Excel scheme's rows for a case."""

import argparse
from typing import TYPE_CHECKING

from replication.cases import inputs_of
from replication.cli import options as shared
from replication.text import number, numbers

if TYPE_CHECKING:
    from replication.models.sheet import Sheet

HELP = "the Excel scheme's rows for a case"


def options(command: argparse.ArgumentParser) -> None:
    shared.input_options(command)
    shared.scheme_option(command)
    shared.output_options(command, csv=True)


def run(options: argparse.Namespace) -> int:
    from replication.error import warnings
    from replication.models.sheet import run

    sheet = run(shared.case(options), options.scheme)
    rows = [row._asdict() for row in sheet.rows] if options.json or options.csv else []
    doubts = list(warnings(sheet).values())
    record = {
        "inputs": inputs_of(sheet.impact),
        "scheme": sheet.scheme,
        "rows": rows,
        "final_depth": sheet.final_depth,
        "normalized_depth": sheet.normalized_depth,
        "steps": sheet.steps,
        "warnings": doubts,
    }
    return shared.put(options, record, lambda: _text(sheet), rows, doubts)


_HEADS = ("time [ns]", "initial [m/s]", "x [um]", "deceleration [m/s2]", "final [m/s]")


def _text(sheet: "Sheet") -> str:
    """The rows, then what the report reads off the last."""
    rows = ((time * 1e9, v, x * 1e6, a, final) for time, v, x, a, final in sheet.rows)
    lines = numbers(_HEADS, rows)
    return "\n".join(
        [
            *(f"{k:>5}{line}" for k, line in zip(("row", *range(len(lines))), lines, strict=False)),
            "",
            f"final depth       {number(sheet.final_depth * 1e6, 8)} um",
            f"normalized depth  {number(sheet.normalized_depth, 8)}",
            f"steps             {sheet.steps}",
        ]
    )

"""`coldspray sheet`: the Excel scheme's rows for a case."""

import argparse
import sys
from typing import TYPE_CHECKING

from replication.cases import inputs_of
from replication.cli import options as shared
from replication.text import number

if TYPE_CHECKING:
    from replication.models.sheet import Row, Sheet

HELP = "the Excel scheme's rows for a case"


def options(command: argparse.ArgumentParser) -> None:
    shared.input_options(command)
    shared.scheme_option(command)
    shared.output_options(command, csv=True)


def run(options: argparse.Namespace) -> int:
    from replication.error import warnings
    from replication.models.sheet import run

    sheet = run(shared.case(options), options.scheme)
    doubts = [warning.text for warning in warnings(sheet)]
    if options.json:
        record = {
            "inputs": inputs_of(sheet.impact),
            "scheme": sheet.scheme,
            "rows": [row._asdict() for row in sheet.rows],
            "final_depth": sheet.final_depth,
            "normalized_depth": sheet.normalized_depth,
            "steps": sheet.steps,
            "warnings": doubts,
        }
        shared.print_json(record)
        return 0
    if options.csv:
        from replication.text import rows_csv

        sys.stdout.write(rows_csv([row._asdict() for row in sheet.rows]))
    else:
        print(_text(sheet))
    shared.warn(options, doubts)
    return 0


_HEADS = ("row", "time [ns]", "initial [m/s]", "x [um]", "deceleration [m/s2]", "final [m/s]")


def _text(sheet: "Sheet") -> str:
    """The rows, then what the report reads off the last."""
    lines = ["".join(f"{head:>21}" if i else f"{head:>5}" for i, head in enumerate(_HEADS))]
    lines += [_line(k, row) for k, row in enumerate(sheet.rows)]
    lines += [
        "",
        f"final depth       {number(sheet.final_depth * 1e6, 8)} um",
        f"normalized depth  {number(sheet.normalized_depth, 8)}",
        f"steps             {sheet.steps}",
    ]
    return "\n".join(lines)


def _line(k: int, row: "Row") -> str:
    final = "" if row.velocity_final is None else number(row.velocity_final, 9)
    values = (row.time * 1e9, row.velocity_initial, row.depth * 1e6, row.deceleration)
    return f"{k:>5}" + "".join(f"{number(v, 9):>21}" for v in values) + f"{final:>21}"

"""`coldspray sheet`: print the rows of the Excel sheet for a case."""

import argparse

from replication.cases import inputs_of
from replication.cli.case import add_inputs, case_of
from replication.cli.options import add_csv_and_json, add_quiet, add_scheme
from replication.cli.output import put
from replication.models.sheet import Sheet
from replication.text import number, numbers

HELP = "print the rows of the Excel sheet for a case"
EXAMPLE = "coldspray sheet --case beta-3 --step '1 ns'"


def add_options(parser: argparse.ArgumentParser) -> None:
    add_scheme(parser)
    add_csv_and_json(parser)
    add_quiet(parser)
    add_inputs(parser)


def run(options: argparse.Namespace) -> int:
    """Print the rows of the sheet, and the results that the report reads from the last one."""
    from replication.error import warnings
    from replication.models import sheet

    result = sheet.run(case_of(options), options.scheme)
    rows = [row._asdict() for row in result.rows] if options.json or options.csv else []
    doubts = list(warnings(result).values())
    record = {
        "inputs": inputs_of(result.impact),
        "scheme": result.scheme,
        "rows": rows,
        "final_depth": result.final_depth,
        "normalized_depth": result.normalized_depth,
        "steps": result.steps,
        "warnings": doubts,
    }
    return put(options, record, lambda: _text(result), rows, doubts)


def _text(sheet: Sheet) -> str:
    heads = "row", "time [ns]", "initial [m/s]", "x [um]", "deceleration [m/s2]", "final [m/s]"
    rows = enumerate(sheet.rows)
    table = ((k, time * 1e9, v, x * 1e6, a, final) for k, (time, v, x, a, final) in rows)
    results = (
        f"final depth       {number(sheet.final_depth * 1e6, 8)} um\n"
        f"normalized depth  {number(sheet.normalized_depth, 8)}\n"
        f"steps             {sheet.steps}"
    )
    return "\n".join([*numbers(heads, table), "", results])

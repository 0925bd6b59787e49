"""`coldspray sheet`: print the rows of the Excel sheet for a case."""

import argparse
from typing import TYPE_CHECKING

from replication.cases import inputs_of
from replication.cli.case import add_inputs, case_of, doubted, in_words
from replication.cli.options import add_csv_and_json, add_quiet, add_scheme
from replication.cli.output import paragraph, put
from replication.cli.picture import (
    add_plot,
    checked,
    notes_on,
    points_of_motion,
    write_picture,
)
from replication.models.sheet import Sheet
from replication.text import number, numbers

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from replication.plots import Points

HELP = "print the rows of the Excel sheet for a case"
EXAMPLE = "coldspray sheet --case beta-3 --step '1 ns'"


def add_options(parser: argparse.ArgumentParser) -> None:
    add_scheme(parser)
    add_csv_and_json(parser)
    add_quiet(parser)
    add_plot(parser, data="time, and depth or velocity")
    add_inputs(parser)


def run(options: argparse.Namespace) -> int:
    """Print the rows of the sheet, and the results that the report reads from the last one."""
    from replication import error
    from replication.models import sheet

    case, warnings = case_of(options)
    points = checked(options, lambda file: points_of_motion(file, case), options.case_file)
    with doubted(warnings):
        result = sheet.run(case, options.scheme)
    write_picture(options, lambda: _sheet_figure(result, points))
    rows = [row._asdict() for row in result.rows] if options.json or options.csv else []
    doubts = error.warnings(result)
    notes = [words for kind, words in doubts.items() if kind in error.NOTES] + notes_on(points)
    warnings += [words for kind, words in doubts.items() if kind not in error.NOTES]
    record = {
        "inputs": inputs_of(case),
        "scheme": result.scheme,
        "rows": rows,
        "final_depth": result.final_depth,
        "normalized_depth": result.normalized_depth,
        "steps": result.steps,
        "warnings": warnings,
        "notes": notes,
    }
    return put(options, record, lambda: _sheet_text(result), rows, warnings, notes)


def _sheet_text(sheet: Sheet) -> str:
    heads = "row", "time [ns]", "initial [m/s]", "x [um]", "deceleration [m/s2]", "final [m/s]"
    rows = enumerate(sheet.rows)
    table = ((k, time * 1e9, v, x * 1e6, a, final) for k, (time, v, x, a, final) in rows)
    results = (
        f"final depth       {number(sheet.final_depth * 1e6, 8)} um\n"
        f"normalized depth  {number(sheet.normalized_depth, 8)}\n"
        f"steps             {sheet.steps}"
    )
    case = paragraph(in_words(sheet.impact, step=True, stop=True))
    return "\n".join([case, "", *numbers(heads, table), "", results])


def _sheet_figure(sheet: Sheet, points: "Points | None") -> "Figure":
    from replication.plots import plot_sheet

    return plot_sheet(sheet, in_words(sheet.impact, step=True, stop=True), points)

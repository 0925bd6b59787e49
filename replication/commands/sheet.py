"""`coldspray sheet`: the Excel scheme's rows for a case."""

import argparse
import sys

from replication.cases import inputs_of
from replication.commands import shared

HELP = "the Excel scheme's rows for a case"


def options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    shared.input_options(command)
    scheme_option(command)
    shared.output_options(command, csv=True)


def scheme_option(command: argparse.ArgumentParser) -> None:
    """--scheme."""
    command.add_argument(
        "--scheme", metavar="NAME", default="published", help="published (default) or centered"
    )


def run(options: argparse.Namespace) -> int:
    """Run the sheet and print it."""
    from replication.analysis.warnings import warnings
    from replication.models.sheet import run

    sheet = run(shared.case(options), options.scheme)
    if options.json:
        shared.print_json(
            {
                "inputs": inputs_of(sheet.impact),
                "scheme": sheet.scheme,
                "rows": [row._asdict() for row in sheet.rows],
                "final_depth": sheet.final_depth,
                "normalized_depth": sheet.normalized_depth,
                "steps": sheet.steps,
                "warnings": [warning.text for warning in warnings(sheet)],
            }
        )
        return 0
    if options.csv:
        from replication.reports.plain import rows_csv

        sys.stdout.write(rows_csv([row._asdict() for row in sheet.rows]))
    else:
        from replication.reports.sheet import sheet_table

        print(sheet_table(sheet))
    shared.warn(options, (warning.text for warning in warnings(sheet)))
    return 0

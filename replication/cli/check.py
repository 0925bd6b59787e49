"""`coldspray check`: check somebody's own workbook of the report's sheet, or rows of numbers."""

import argparse
from functools import partial

from replication.cli.differences import add_files, check_files, put_differences
from replication.cli.options import path

HELP = "check somebody's own workbook, or CSV, of the report's sheet"
EXAMPLE = "coldspray check mine.xlsx --map 'depth=Sheet1!D8:D139'"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "file", metavar="FILE", type=path,
        help="an .xlsx file; or .xlsm, .xls, .xlsb, .ods; or rows as text: .csv, .tsv, .txt, .dat",
    )  # fmt: skip
    parser.add_argument(
        "--map", metavar="NAME=RANGE", action="append", default=[],
        help="where a column or an input is: depth=Sheet1!D8:D139, radius=B4; may be repeated",
    )  # fmt: skip
    add_files(parser)


def run(options: argparse.Namespace) -> int:
    """Check a workbook and print the differences; status 1 if it is not the report's sheet."""
    check_files(options, options.file)
    from replication.check import show
    from replication.check.examination import DEPARTURE_KINDS, NO_FAULT
    from replication.check.shown import junit
    from replication.check.workbook import check_workbook

    checked = check_workbook(options.file, _mapping(options.map))
    record = show.check_record(checked)
    page = partial(show.check_page, record, checked.differences, checked.evaluator)
    tests = partial(junit, kinds=DEPARTURE_KINDS, no_fault=NO_FAULT)
    return put_differences(options, record, show.check_text, page, tests)


def _mapping(texts: list[str]) -> dict[str, str]:
    """Return the range that each --map gives for a name."""
    mapping: dict[str, str] = {}
    for text in texts:
        name, _, where = text.partition("=")
        if not where:
            raise ValueError(f"--map {text[:60]!r}: give NAME=RANGE, such as depth=D8:D139")
        name = name.strip().replace("-", "_")
        if name in mapping:
            raise ValueError(f"--map {name[:40]}: it is given twice")
        mapping[name] = where.strip()
    return mapping

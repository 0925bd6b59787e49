"""`coldspray check`: somebody's own workbook of the scheme, against the report's sheet."""

import argparse
from collections.abc import Sequence

from replication.commands import shared

HELP = "check somebody's own workbook of the scheme"


def options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.add_argument("file", type=shared.path, metavar="FILE", help="an .xlsx or .xlsm file")
    command.add_argument(
        "--map", action="append", default=[], metavar="NAME=RANGE",
        help="where a column or an input is: depth=Sheet1!D8:D139, radius=B4",
    )  # fmt: skip
    shared.finding_options(command)


def run(options: argparse.Namespace) -> int:
    """Check, and say what was found: 1 if the workbook is not the report's sheet."""
    from replication.check.difference import KINDS
    from replication.check.record import check_record
    from replication.check.workbook import check

    shared.finding_files(options)
    found = check(options.file, _mapping(options.map))
    record = check_record(found)
    shared.put_findings(options, record, found.differences, found.calculation, KINDS)
    return 0 if record["clean"] else 1


def _mapping(given: Sequence[str]) -> dict[str, str]:
    mapping = {}
    for text in given:
        name, _, where = text.partition("=")
        if not where:
            raise ValueError(f"--map {text[:60]!r}: NAME=RANGE is wanted, such as depth=D8:D139")
        mapping[name.strip().replace("-", "_")] = where.strip()
    return mapping

"""`coldspray audit`: every number of the report, and the files that say so."""

import argparse
import gc
import sys
from functools import partial
from pathlib import Path

from replication.cli import options as shared
from replication.reading import name_of

HELP = "audit every number the report prints"


def options(command: argparse.ArgumentParser) -> None:
    folder = Path("coldspray-audit")
    command.add_argument(
        "--out", type=shared.path, default=folder, metavar="DIR", help=f"default: {folder}/"
    )
    flag = partial(command.add_argument, action="store_true")
    flag("--exit-code", help="status 1 if any claim is not reproduced")
    flag("--force", help="write over a workbook.xlsx that was changed, too")
    flag("--json", help="print audit.json instead of text")
    flag("--schema", help="print the schema of audit.json")
    flag("--quiet", help="write the files, print nothing")


def run(options: argparse.Namespace) -> int:
    if options.schema:
        from replication.audit.record import schema

        shared.print_json(schema())
        return 0
    from replication import report
    from spreadsheets import emit

    report.check(options.out)
    workbook = options.out / "workbook.xlsx"
    if workbook.exists():
        emit.check(workbook, force=options.force)
    from replication.audit.audit import audit
    from replication.error import hard_cases
    from replication.workbook import build

    gc.disable()  # to look for garbage would take a twentieth of the time
    try:
        record = audit()
        random, outcomes = hard_cases.worst_of(1000, seed=1), hard_cases.outcomes()
        beside = {
            "workbook.xlsx": build(record=record).to_bytes(),
            "hard-cases.txt": hard_cases.text(outcomes, random).encode(),
        }
        written = report.write(record, options.out, beside)
    finally:
        gc.enable()
    if options.json:
        sys.stdout.write(written["audit.json"].decode())
    elif not options.quiet:
        print(report.summary(record, shared.width(), shared.may_emphasize()), end="\n\n")
        print(f"Written to {name_of(options.out)}/; start with audit.html")
    return 1 if options.exit_code and record.counts.failing else 0

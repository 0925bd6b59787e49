"""`coldspray audit`: audit every number of the report, and write the folder of its files."""

import argparse
import gc
from functools import partial

from replication.cli.options import add_json, add_quiet, path
from replication.cli.output import may_emphasize, progress, put_json, width
from replication.user_input import one_line

HELP = "audit every number the report prints"
EXAMPLE = "coldspray audit --out audited --exit-code"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--out", metavar="DIR", type=path, default=path("coldspray-audit"),
        help="folder to write to (default: %(default)s/)",
    )  # fmt: skip
    parser.add_argument("--exit-code", action="store_true", help="status 1 if any claim fails")
    parser.add_argument(
        "--force", action="store_true", help="overwrite even a workbook.xlsx that was changed"
    )
    add_json(parser, "print audit.json instead of text")
    parser.add_argument("--schema", action="store_true", help="print the schema of audit.json")
    add_quiet(parser, "write the files, print nothing")


def run(options: argparse.Namespace) -> int:
    """Audit, write the files and print a summary; status 1 if a claim fails and --exit-code."""
    if options.schema:
        from replication.report.document import schema_text

        put_json(schema_text())
        return 0
    # The audit makes little garbage; looking for it often would take a tenth of the time.
    gc.set_threshold(1_000_000)
    from replication import report
    from replication.audit.audit import audit
    from replication.error import hard_cases
    from replication.workbook import build_workbook
    from spreadsheets import emit
    from spreadsheets.safely import check_folder, write_folder

    check_folder(options.out, report.FILES)
    workbook = options.out / "workbook.xlsx"
    if workbook.exists():
        emit.check_writable(workbook, force=options.force)
    record = audit(progress=partial(progress, options, unit=" claims", leave=False))
    beside = {
        "workbook.xlsx": build_workbook(record=record).to_bytes(),
        "hard-cases.txt": hard_cases.hard_cases_text(hard_cases.record(1000, seed=1)).encode(),
    }
    written = report.contents(record, beside)
    write_folder(options.out, written)
    if options.json:
        put_json(written["audit.json"].decode())
    elif not options.quiet:
        print(f"Written to {one_line(str(options.out))}/; start with audit.html", end="\n\n")
        print(report.summary(record, width(), may_emphasize()))
    return 1 if options.exit_code and record.counts.failing else 0

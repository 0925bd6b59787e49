"""`coldspray audit`: every number of the report, and the files that say so."""

import argparse
from pathlib import Path

from replication.commands import shared

HELP = "audit every number the report prints"


def options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    folder = Path("coldspray-audit")
    command.add_argument(
        "--out", type=shared.path, default=folder, metavar="DIR", help=f"default: {folder}/"
    )
    command.add_argument(
        "--exit-code", action="store_true", help="status 1 if any claim is not reproduced"
    )
    command.add_argument("--json", action="store_true", help="print audit.json instead of text")
    command.add_argument("--quiet", action="store_true", help="write the files, print nothing")


def run(options: argparse.Namespace) -> int:
    """Audit, write, summarize."""
    from replication.audit import Verdict, audit
    from replication.reports.files import check_folder, write_audit
    from replication.reports.records import audit_record
    from replication.reports.terminal import audit_summary

    check_folder(options.out)
    done = audit()
    record = audit_record(done)
    paths = write_audit(done, record, options.out)
    if options.json:
        shared.print_json(record)
    elif not options.quiet:
        print(audit_summary(done), *("", "Written:", *(f"  {path}" for path in paths)), sep="\n")
    return 1 if options.exit_code and done.with_verdict(Verdict.NOT_REPRODUCED) else 0

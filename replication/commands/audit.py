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
    from replication.audit import Verdict
    from replication.reports.files import FILES, write_audit
    from replication.reports.terminal import audit_summary
    from spreadsheets.safely import check_folder

    check_folder(options.out, FILES)
    done = write_audit(options.out)
    if options.json:
        print((options.out / "audit.json").read_text("utf-8"), end="")
    elif not options.quiet:
        top = dict.fromkeys(Path(name).parts[0] for name in FILES)
        print(audit_summary(done), "", f"Written to {options.out}/: {', '.join(top)}", sep="\n")
    return 1 if options.exit_code and done.with_verdict(Verdict.NOT_REPRODUCED) else 0

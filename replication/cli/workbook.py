"""`coldspray workbook`: the live workbook of the report, or of a case."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from replication.cli import options as shared

if TYPE_CHECKING:
    from replication.workbook import Cases

HELP = "write the live workbook"


def options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    output = Path("workbook.xlsx")
    command.add_argument(
        "-o", "--output", type=shared.path, default=output, metavar="FILE", help=f"{output}"
    )
    command.add_argument("--quiet", action="store_true", help="do not say what was written")
    command.add_argument(
        "--verify", action="store_true", help="recalculate it in every engine; status 1 if they err"
    )
    command.add_argument("--json", action="store_true", help="with --verify: print JSON")
    shared.input_options(command, "the report's two cases")


def run(options: argparse.Namespace) -> int:
    """Write, and verify if asked to."""
    from replication import workbook

    own = options.case is not None or options.case_file is not None or shared.given(options)
    cases = {"Sheet": shared.case(options)} if own else workbook.REPORT
    if options.verify:
        return _verified(options, cases)
    if options.json:
        raise ValueError("--json is for what --verify finds: give both")
    workbook.write(options.output, cases)
    if not options.quiet:
        print(f"Written: {options.output}")
    return 0


def _verified(options: argparse.Namespace, cases: "Cases") -> int:
    from replication import workbook
    from replication.reports.verification import verification_record, verification_text

    checks = workbook.write_verified(options.output, cases)
    if options.json:
        shared.print_json(verification_record(options.output, checks))
    elif not options.quiet:
        print(f"Written: {options.output}", "", verification_text(checks), sep="\n")
    return 0 if all(check.passed for check in checks) else 1

"""The commands about the report: audit; claims, one by one; power, what the audit would notice."""

import argparse
import gc
import sys
from functools import partial
from pathlib import Path
from typing import Any

from replication.cli import options as shared
from replication.reading import one_line, quoted
from replication.text import aligned, columns, quantity


def audit_options(command: argparse.ArgumentParser) -> None:
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


def run_audit(options: argparse.Namespace) -> int:
    if options.schema:
        from replication.audit.record import schema

        shared.print_json(schema())
        return 0
    gc.disable()  # to look for garbage would take a tenth of the time
    try:
        from replication import report
        from replication.audit.audit import audit
        from replication.error import hard_cases
        from replication.workbook import build
        from spreadsheets import emit

        report.check(options.out)
        workbook = options.out / "workbook.xlsx"
        if workbook.exists():
            emit.check(workbook, force=options.force)
        record = audit()
        beside = {
            "workbook.xlsx": build(record=record).to_bytes(),
            "hard-cases.txt": hard_cases.text(hard_cases.record(1000, seed=1)).encode(),
        }
        written = report.write(record, options.out, beside)
    finally:
        gc.freeze()  # what is left over ends with the process
        gc.enable()
    if options.json:
        sys.stdout.write(written["audit.json"].decode())
    elif not options.quiet:
        print(report.summary(record, shared.width(), shared.may_emphasize()), end="\n\n")
        print(f"Written to {one_line(str(options.out))}/; start with audit.html")
    return 1 if options.exit_code and record.counts.failing else 0


def claims_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("id", nargs="?", metavar="ID", help="prove this claim")
    shared.output_options(command)


def run_claims(options: argparse.Namespace) -> int:
    """List the ledger, without verdicts; or prove one claim."""
    from reference.ledger import load

    ledger = load()
    if options.id is None:
        record = [
            {
                **{name: getattr(claim, name) for name in ("id", "title", "unit", "kind")},
                **{name: getattr(claim.place, name) for name in ("line", "section", "cell")},
                "where": str(claim.place),
                "quote": " ".join(claim.quote.split()),
                "printed": claim.text,
            }
            for claim in ledger.claims.values()
        ]
        rows = [
            (claim.id, quantity(claim.shown, claim.unit), claim.kind, str(claim.place))
            for claim in ledger.claims.values()
        ]
        return shared.put(options, record, lambda: columns(rows, shared.width(piped=10_000)))
    if options.id not in ledger.claims:
        from difflib import get_close_matches

        near = ", ".join(get_close_matches(options.id[:80], list(ledger.claims), cutoff=0.4))
        hint = f"near it: {near}" if near else "`coldspray claims` lists them"
        raise ValueError(f"there is no claim {quoted(options.id)}; {hint}")
    from replication.audit.audit import Audit
    from replication.report import proof

    claim, strong = Audit(ledger).claim(ledger.claims[options.id]), shared.may_emphasize()
    return shared.put(options, claim, lambda: proof(claim, ledger, shared.width(), strong))


def power_options(command: argparse.ArgumentParser) -> None:
    shared.whole_option(command, "--sample", 1, 10**6, "misprints (500)", default=500)
    shared.whole_option(command, "--seed", 0, 2**64 - 1, "of the sample (1)", default=1)
    shared.output_options(command, quiet="no progress")


def run_power(options: argparse.Namespace) -> int:
    """Print the rates, whole, by kind of entry and by kind of edit, then what passes."""
    from reference.ledger import load
    from replication.power import power

    def bar(plants: Any) -> Any:
        return shared.progress(options, iterable=plants, unit=" misprints", leave=False)

    result = power(load(), options.sample, options.seed, bar)
    table = result.table()
    lines = [
        f"{result.planted} misprints, one at a time; {result.invisible} cannot be seen, as every",
        "number still rounds as printed. Of the others, in percent:",
        "",
        *aligned([table.heads, *table.rows]),
    ]
    if result.unnoticed:
        lines += ["", "Visible, and not noticed:"]
        lines += [f"  {x['entry']}: {x['true']!r} as {x['text']!r}" for x in result.unnoticed]
    return shared.put(options, result, lambda: "\n".join(lines))

"""`coldspray claims`: the ledger, or one claim with its proof."""

import argparse
from collections.abc import Iterable

from replication.commands import shared

HELP = "list the claims, or prove one"


def options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.add_argument("id", nargs="?", metavar="ID", help="prove this claim")
    command.add_argument("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> int:
    """List, or prove."""
    from reference.ledger import load
    from replication.reports import records, terminal

    ledger = load()
    if options.id is None:
        claims = list(ledger.claims.values())
        if options.json:
            shared.print_json([records.ledger_record(claim) for claim in claims])
        else:
            print(terminal.ledger_table(claims))
        return 0
    if options.id not in ledger.claims:
        raise ValueError(f"there is no claim {options.id!r}{_nearest(options.id, ledger.claims)}")
    from replication.audit import assess_claim

    assessment = assess_claim(ledger, options.id)
    if options.json:
        shared.print_json(records.claim_record(ledger, assessment))
    else:
        print(terminal.claim_proof(ledger, assessment))
    return 0


def _nearest(name: str, known: Iterable[str]) -> str:
    from difflib import get_close_matches

    near = get_close_matches(name, list(known), n=3, cutoff=0.4)
    return f"; near it: {', '.join(near)}" if near else "; `coldspray claims` lists them"

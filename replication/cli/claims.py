"""`coldspray claims`: the ledger, or one claim with its proof."""

import argparse
from collections.abc import Iterable
from typing import Any

from replication.cli import options as shared
from replication.reading import quoted
from replication.text import columns

HELP = "list the claims, or prove one"


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("id", nargs="?", metavar="ID", help="prove this claim")
    shared.output_options(command)


def run(options: argparse.Namespace) -> int:
    from reference.ledger import load

    ledger = load()
    if options.id is None:
        if options.json:
            shared.print_json([_listed(claim) for claim in ledger.claims.values()])
        else:
            from replication.audit.wording import quantity

            rows = [
                (claim.id, quantity(claim.shown, claim.unit), claim.kind, str(claim.place))
                for claim in ledger.claims.values()
            ]
            print(columns(rows, shared.width(piped=10_000)))
        return 0
    if options.id not in ledger.claims:
        near = _nearest(options.id, ledger.claims)
        raise ValueError(f"there is no claim {quoted(options.id)}{near}")
    from replication.audit.audit import audit_claim

    claim = audit_claim(options.id)
    if options.json:
        shared.print_json(claim)
    else:
        from replication.report.render import proof

        print(proof(claim, ledger, shared.width(), shared.may_emphasize()))
    return 0


def _listed(claim: Any) -> dict[str, Any]:
    """What the ledger says of a claim, without a verdict."""
    return {
        "id": claim.id,
        "title": claim.title,
        "where": str(claim.place),
        "line": claim.place.line,
        "section": claim.place.section,
        "cell": claim.place.cell,
        "quote": " ".join(claim.quote.split()),
        "printed": claim.text,
        "unit": claim.unit,
        "kind": claim.kind,
    }


def _nearest(name: str, known: Iterable[str]) -> str:
    from difflib import get_close_matches

    near = get_close_matches(name[:80], list(known), n=3, cutoff=0.4)
    return f"; near it: {', '.join(near)}" if near else "; `coldspray claims` lists them"

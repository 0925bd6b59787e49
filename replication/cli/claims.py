"""`coldspray claims`: the ledger, or one claim with its proof."""

import argparse
from typing import Any

from replication.cli import options as shared
from replication.reading import quoted
from replication.text import columns, quantity

HELP = "list the claims, or prove one"


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("id", nargs="?", metavar="ID", help="prove this claim")
    shared.output_options(command)


def run(options: argparse.Namespace) -> int:
    from reference.ledger import load

    ledger = load()
    if options.id is None:
        claims = ledger.claims.values()
        rows = [(c.id, quantity(c.shown, c.unit), c.kind, str(c.place)) for c in claims]
        record = [_listed(claim) for claim in claims]
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


def _listed(claim: Any) -> dict[str, Any]:
    """What the ledger says of a claim, without a verdict."""
    own = {name: getattr(claim, name) for name in ("id", "title", "unit", "kind")}
    place = {name: getattr(claim.place, name) for name in ("line", "section", "cell")}
    quote = " ".join(claim.quote.split())
    return {**own, **place, "where": str(claim.place), "quote": quote, "printed": claim.text}

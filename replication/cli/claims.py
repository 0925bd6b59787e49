"""`coldspray claims`: list the numbers that the report prints, or prove one."""

import argparse
from difflib import get_close_matches
from functools import partial

from replication.cli.options import add_json, add_quiet
from replication.cli.output import may_emphasize, put, width
from replication.reading import quoted
from replication.text import columns, quantity

HELP = "list the numbers that the report prints, or prove one"
EXAMPLE = "coldspray claims frank-zook-rha"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("id", metavar="ID", nargs="?", help="prove this one")
    add_json(parser)
    add_quiet(parser)


def run(options: argparse.Namespace) -> int:
    """List the claims of the ledger, without verdicts, or prove one claim."""
    from reference.ledger import load

    ledger = load()
    claims = ledger.claims
    if options.id is None:
        record = [
            {
                **{name: getattr(claim, name) for name in ("id", "title", "unit", "kind")},
                **{name: getattr(claim.place, name) for name in ("line", "section", "cell")},
                "where": str(claim.place),
                "quote": " ".join(claim.quote.split()),
                "printed": claim.text,
            }
            for claim in claims.values()
        ]
        rows = [
            (claim.id, quantity(claim.shown, claim.unit), claim.kind, str(claim.place))
            for claim in claims.values()
        ]
        return put(options, record, lambda: columns(rows, width(piped=10_000)))
    if options.id in claims:
        from replication.audit.audit import Audit
        from replication.audit.findings import findings_on
        from replication.report import proof
        from replication.report.document import claim_document

        audit = Audit(ledger)
        proven, on_it = audit.claim(options.id), findings_on(audit, options.id)
        text = partial(proof, proven, on_it, ledger, width(), may_emphasize())
        return put(options, claim_document(proven), text)
    similar = ", ".join(get_close_matches(options.id[:80], list(claims), cutoff=0.4))
    hint = f"similar ones: {similar}" if similar else "`coldspray claims` lists them"
    if options.id in ledger.equations:
        hint = "it is an equation: the page of `coldspray audit` has it"
    raise ValueError(f"there is no claim {quoted(options.id)}; {hint}")

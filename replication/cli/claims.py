"""`coldspray claims`: list the numbers that the report prints, or prove one."""

import argparse
import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from replication.cli.options import add_json, add_quiet, one_of
from replication.cli.output import may_emphasize, put, width
from replication.text import columns, quantity, with_unit
from replication.user_input import advice, quoted

if TYPE_CHECKING:
    from reference.ledger import Claim, Ledger
    from replication.audit.assessment import Verdict

HELP = "list the numbers that the report prints, or prove one"
EXAMPLE = "coldspray claims frank-zook-rha"


def add_options(parser: argparse.ArgumentParser) -> None:
    from replication.audit.assessment import Verdict

    parser.add_argument(
        "id", metavar="ID", nargs="?",
        help="prove this claim or equation; or list the claims that print this text, such as 7.67",
    )  # fmt: skip
    parser.add_argument(
        "--verdict", metavar="VERDICT", type=one_of("verdict", Verdict),
        help=f"list only claims with this verdict: {', '.join(Verdict)}",
    )  # fmt: skip
    add_json(parser)
    add_quiet(parser, argparse.SUPPRESS)  # accepted everywhere; here nothing would be left out


def run(options: argparse.Namespace) -> int:
    """List the claims of the ledger, or prove one claim or equation."""
    from reference.ledger import load

    ledger, wanted = load(), options.id
    if wanted is not None:
        wanted = _id_of_equation(wanted) or wanted
    if options.verdict and wanted in {*ledger.claims, *ledger.equations}:
        raise ValueError(f"--verdict selects from a list: leave it out to prove {wanted}")
    if wanted in ledger.claims or wanted in ledger.equations:
        return _prove(wanted, options, ledger)
    with_point = None if wanted is None else re.sub(r"(?<=\d),(?=\d)", ".", wanted)
    listed = [
        claim
        for claim in ledger.claims.values()
        if wanted is None or {wanted, with_point}.intersection(_texts(claim))
    ]
    if not listed:
        hint = advice(wanted, [*ledger.claims, *ledger.equations], "`coldspray claims` lists them")
        raise ValueError(f"there is no claim {quoted(wanted)}, and none prints that; {hint}")
    return _list(options, ledger, listed)


def _id_of_equation(text: str) -> str:
    """Return the id of an equation that is named as people do, or "".

    >>> _id_of_equation("Eq. 16"), _id_of_equation("eq A-3"), _id_of_equation("7.67")
    ('eq16', 'eqA-3', '')
    """
    named = re.fullmatch(r"eq(?:uation)?\.?\s*((?:A-)?\d+)", text.strip(), re.IGNORECASE)
    return f"eq{named[1].upper()}" if named else ""


def _texts(claim: "Claim") -> tuple[str, ...]:
    """Return the texts by which a claim is found: as printed, as shown, and both with the unit."""
    texts = (claim.text, claim.shown)
    units = (with_unit(text, claim.unit) for text in texts)
    return (*texts, *units, quantity(claim.shown, claim.unit))


def _list(options: argparse.Namespace, ledger: "Ledger", listed: "Iterable[Claim]") -> int:
    """Print these claims; with --verdict those that have it, and the verdict in the JSON."""
    if options.verdict:
        from replication.audit.verdict import Judge

        judge = Judge(ledger)
        listed = [claim for claim in listed if judge.assess(claim).verdict == options.verdict]
    record = [_record(claim, options.verdict) for claim in listed]
    rows = [
        (claim.id, quantity(claim.shown, claim.unit), claim.kind, _where(claim)) for claim in listed
    ]
    heads = ("id", "printed", "kind", "line")
    nothing = f"no such claim is {options.verdict}"
    text = columns([heads, *rows], width(piped=10_000)) if rows else nothing
    return put(options, record, lambda: text)


def _where(claim: "Claim") -> str:
    """Return where a claim stands, so short that most rows fit a terminal: without the section."""
    place = claim.place
    if place.cell:
        return f"cell {place.cell}"
    return f"{place.line}, Eq. {place.equation}" if place.equation else str(place.line)


def _record(claim: "Claim", verdict: "Verdict | None") -> dict[str, Any]:
    record = {
        "id": claim.id,
        "title": claim.title,
        "unit": claim.unit,
        "kind": claim.kind,
        "line": claim.place.line,
        "section": claim.place.section,
        "cell": claim.place.cell,
        "where": str(claim.place),
        "quote": " ".join(claim.quote.split()),
        "printed": claim.text,
    }
    return record | ({"verdict": verdict} if verdict else {})


def _prove(name: str, options: argparse.Namespace, ledger: "Ledger") -> int:
    """Print what the verdict on a claim or an equation rests on."""
    from replication.audit.audit import Audit

    audit, is_claim = Audit(ledger), name in ledger.claims
    if options.json:
        from replication.report.document import claim_document, equation_document

        if is_claim:
            return put(options, claim_document(audit.claim(name)), str)
        return put(options, equation_document(audit.equation(name)), str)
    from replication.audit.findings import findings_on
    from replication.report import equation_proof, proof

    on_it, settings = findings_on(audit, name), (audit.judge, width(), may_emphasize())
    if is_claim:
        print(proof(audit.claim(name), on_it, *settings))
    else:
        print(equation_proof(audit.equation(name), on_it, *settings))
    return 0

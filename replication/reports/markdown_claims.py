"""Every claim in Markdown: one line where it is reproduced, its whole proof where it is not."""

from collections.abc import Iterable, Iterator
from itertools import groupby
from typing import Any

from reference.ledger import Ledger
from replication.audit import Audit
from replication.audit.explanations import explain_claim
from replication.audit.explanations.sentences import (
    alternative_text,
    back_solved_text,
    misprint_text,
)
from replication.reports.shown import capital, is_open, off_by, plain, proven, section, witness
from replication.text import number, with_unit

__all__ = ["every_claim", "ids", "proof"]


def ids(names: Iterable[str]) -> str:
    """Ids of claims in a row."""
    return ", ".join(f"`{name}`" for name in names)


def proof(audit: Audit, record: dict[str, Any]) -> Iterator[str]:
    """The claims that are not plainly reproduced, each with its proof and with what was tried."""
    claims = {claim["id"]: claim for claim in record["claims"]}
    for claim in filter(is_open, claims.values()):
        yield f"### `{claim['id']}`: {claim['title']}"
        yield f"{claim['where']}: {_quote(claim)}. **{capital(claim['verdict'])}.**"
        yield claim["explanation"]
        yield "\n".join(f"- {fact}" for fact in _facts(claim, claims))
        yield from _tried(audit.ledger, claim["id"])


def every_claim(record: dict[str, Any]) -> Iterator[str]:
    """The claims by section of the report, in its order."""
    claims = {claim["id"]: claim for claim in record["claims"]}
    for name, members in groupby(claims.values(), section):
        group = list(members)
        lines = [_line(claim, claims) for claim in group if claim["kind"] != "blank"]
        blanks = [claim for claim in group if claim["kind"] == "blank"]
        lines += [_blanks(blanks)] if blanks else []
        yield f"### {name}\n\n" + "\n".join(lines)


def _line(claim: dict[str, Any], claims: dict[str, Any]) -> str:
    head = f"- `{claim['id']}` {claim['title']}. {capital(claim['where'])}: {_quote(claim)}. "
    verdict = f"**{capital(claim['verdict'])}**"
    if is_open(claim):
        return f"{head}{verdict}, with its proof above."
    facts = "; ".join(_facts(claim, claims))
    given = f". {claim['explanation']}" if claim["computed"] is None else "."
    return f"{head}{verdict}{': ' if facts else ''}{facts}{given}"


def _blanks(blanks: list[dict[str, Any]]) -> str:
    told = (
        f"`{one['id']}`" + (f" **{one['verdict']}**" if one["verdict"] != "reproduced" else "")
        for one in blanks
    )
    return f"- Cells left blank, in our copy of the table unless said otherwise: {', '.join(told)}."


def _quote(claim: dict[str, Any]) -> str:
    return f"`{claim['quote']}`"


def _facts(claim: dict[str, Any], claims: dict[str, Any]) -> Iterator[str]:
    """What a verdict rests on, as short texts."""
    unit = claim["unit"]
    if claim["interval"]:
        yield f"agrees {with_unit(claim['interval_text'], unit)}"
    if claim["computed"] is not None:
        yield f"computed {with_unit(number(claim['computed'], 10), unit)}"
        yield f"proven range {proven(claim['enclosure'])}"
    if off_by(claim):
        yield f"off by {off_by(claim)}"
    for one in claim["readings"]:
        yield (
            f"read as {one['name']} {number(one['computed'], 10)}, {one['verdict']}, "
            f"proven range {proven(one['enclosure'])}"
        )
        if one["witness"]:
            yield f"so read, for instance (SI) {witness(one['witness'])}"
    if claim["rests_on"]:
        yield f"inputs {', '.join(_inputs(claim, claims))}"
    if claim["witness"]:
        yield f"for instance (SI) {witness(claim['witness'])}"
    if claim["assumes"]:
        yield f"assumes {'; '.join(claim['assumes'])}"
    if claim["workbook"]:
        yield f"workbook cell {claim['workbook']}"


def _inputs(claim: dict[str, Any], claims: dict[str, Any]) -> Iterator[str]:
    for key, names in claim["rests_on"].items():
        yield f"{key.replace('_', ' ')} {' × '.join(_entry(name, claims) for name in names)}"


def _entry(name: str, claims: dict[str, Any]) -> str:
    if name not in claims:
        return f"{name.removeprefix('inferred:')} (inferred)"
    return f"{with_unit(plain(claims[name]['printed']), claims[name]['unit'])} (`{name}`)"


def _tried(ledger: Ledger, name: str) -> list[str]:
    """For a failing claim: single inputs, misprints and readings that would give its number."""
    found, unit = explain_claim(ledger, name), ledger.claims[name].unit
    readings = [a for a in found.listed(name) if a.explains(name)]
    blocks = [
        ("Single inputs that would give it", map(back_solved_text, found.back_solved)),
        ("Misprints that would", (misprint_text(m, unit) for m in found.misprints)),
        ("Other readings that would", (alternative_text(a, name) for a in readings)),
    ]
    lists = [(head, "\n".join(f"- {line}" for line in lines)) for head, lines in blocks]
    return [f"{head}:\n\n{listed}" for head, listed in lists if listed]

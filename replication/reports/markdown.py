"""The audit as Markdown, for people who read it in a repository."""

from collections.abc import Iterator, Mapping
from typing import Any

from replication.audit import Audit
from replication.reports.failing import failing
from replication.reports.glossary import KINDS, SYMBOLS, VERDICTS
from replication.reports.markdown_claims import every_claim, ids, proof
from replication.reports.markdown_physics import hard_cases, physics, provenance
from replication.reports.shown import NOTHING_OPEN, admitted, answer, capital, evidence, proven
from replication.text import number, pipe_table, with_unit

__all__ = ["markdown"]


def markdown(audit: Audit, record: dict[str, Any]) -> str:
    """The whole audit, `record` its numbers as `reports.records.audit_record` gives them.

    The same as on the page: summary, findings, inferred inputs, failed claims with their proof,
    joint questions, the physics, every claim in short, hard cases, provenance.
    """
    report = record["report"]
    blocks = [
        f"# Audit of {report['author']}, *{report['title']}* ({report['year']})",
        "Every number that the report prints, and whether it follows from what the report says. "
        "Computed values are those of the re-run sheet and formulas; a proven range is proven "
        "by interval arithmetic and rounded outwards. Quotes stand as in the text that was read, "
        "the printed number between ⟦ and ⟧.",
        *_summary(record),
        "## Findings",
        *(_finding(finding) for finding in record["findings"]),
        "## Inferred inputs",
        *(_inferred(one) for one in record["inferred"]),
        "## Claims that are not plainly reproduced",
        *proof(audit, record),
        "## Claims tested together",
        "\n".join(_joint(one) for one in record["joint"]),
        *physics(record),
        "## Every claim",
        *every_claim(record),
        *hard_cases(record["stability"]),
        *provenance(record["provenance"]),
    ]
    return "\n\n".join(blocks) + "\n"


def _summary(record: dict[str, Any]) -> Iterator[str]:
    yield pipe_table(("verdict", "claims"), ((v, str(n)) for v, n in record["summary"].items()))
    kinds = (f"{count} are {kind}" for kind, count in record["reproduced"].items())
    yield f"Of the reproduced ones {', '.join(kinds)}."
    heads = ("not plainly reproduced", "the report prints", "what follows", "why")
    yield pipe_table(
        heads,
        (
            (
                f"`{one.claim['id']}` {one.claim['title']}: {one.claim['verdict']}",
                one.printed,
                one.follows,
                one.finding["title"] if one.finding else "",
            )
            for one in failing(record)
        ),
    )
    yield _terms(VERDICTS | KINDS)
    yield f"Symbols:\n\n{_terms(SYMBOLS)}"


def _terms(terms: Mapping[str, str]) -> str:
    return "\n".join(f"- `{term}`: {meaning}" for term, meaning in terms.items())


def _finding(finding: dict[str, Any]) -> str:
    lines = [f"### {finding['title']}"]
    if not finding["holds"]:
        lines.append(
            "**Its evidence has changed: the text below is not what this audit computes.**"
        )
    lines += [
        f"*{capital(finding['kind'])}, {finding['status']}*: {ids(finding['claims'])}",
        finding["statement"],
    ]
    lines += [f"By hand: {finding['by_hand']}"] if finding["by_hand"] else []
    if finding["settle"] != NOTHING_OPEN:
        lines.append(f"What would settle it: {finding['settle']}")
    lines.append(
        pipe_table(("evidence", "asserted", "computed"), map(_evidence, finding["evidence"]))
    )
    return "\n\n".join(lines)


def _evidence(piece: dict[str, Any]) -> tuple[str, ...]:
    unit = piece["unit"]
    return piece["meaning"], with_unit(piece["asserted"], unit), with_unit(evidence(piece), unit)


def _inferred(one: dict[str, Any]) -> str:
    possible = proven(one["possible_with_rounded_inputs"])
    rows = ((book["name"], number(book["value"]), book["verdict"]) for book in one["handbook"])
    return (
        f"{capital(one['title'])}, printed nowhere; computed with {number(one['nominal'])} "
        f"{one['unit']} ({one['nominal_source']}). With the header of Table A-1 exactly as "
        f"printed, its numbers admit {admitted(one['interval'])} {one['unit']}; if the header's "
        f"numbers are themselves rounded, none outside {possible}. Evidence: "
        f"{ids(one['evidence'])}.\n\n"
        + pipe_table(("handbook value", one["unit"], "verdict"), rows)
    )


def _joint(one: dict[str, Any]) -> str:
    return (
        f"- **{capital(one['outcome'])}**: {one['question']} ({ids(one['claims'])}) {answer(one)}"
    )

"""The audit as Markdown, for people who read it in a repository."""

from collections.abc import Iterable
from typing import Any

from replication.audit import Audit
from replication.audit.explain import assumptions, explanation
from replication.audit.explanations import explain_claim
from replication.audit.explanations.joint import JointAnswer
from replication.audit.explanations.sentences import (
    alternative_text,
    back_solved_text,
    misprint_text,
)
from replication.audit.inference import infer
from replication.audit.verdict import Assessment, Verdict
from replication.reports.markdown_physics import physics, provenance
from replication.text import number, outward, pipe_table, with_unit

__all__ = ["markdown"]


def markdown(audit: Audit, record: dict[str, Any]) -> str:
    """The whole audit, `record` its numbers as `reports.records.audit_record` gives them.

    Summary, findings, inferred inputs, failed claims, error budget, hard cases, then every claim.
    """
    ledger = audit.ledger
    blocks = [
        f"# Audit of {ledger.author}, *{ledger.title}* ({ledger.year})",
        "Every number that the report prints, and whether it follows from what the report says. "
        "Computed values are those of the re-run sheet and formulas; a range in brackets is proven "
        "by interval arithmetic and rounded outwards.",
        pipe_table(("verdict", "claims"), ((v, str(n)) for v, n in audit.summary.items())),
        "Of the reproduced ones "
        + ", ".join(f"{count} are {kind}" for kind, count in audit.reproduced_kinds.items())
        + ".",
        "## Findings",
        *(_finding(finding) for finding in record["findings"]),
        "## Inferred inputs",
        *(_inferred(audit, name) for name in ledger.inferred),
        "## Claims that are not plainly reproduced",
        *(_proof(audit, a) for a in audit.assessments.values() if _is_open(a)),
        "## Claims tested together",
        "\n".join(_joint(answer) for answer in audit.joint),
        *physics(record),
        "## Every claim",
        *_sections(audit),
        *provenance(record["provenance"]),
    ]
    return "\n\n".join(blocks) + "\n"


def _is_open(assessment: Assessment) -> bool:
    return assessment.verdict not in (Verdict.REPRODUCED, Verdict.NOT_CHECKABLE)


def _finding(finding: dict[str, Any]) -> str:
    lines = [f"### {finding['title']}"]
    if not finding["holds"]:
        lines.append(
            "**Its evidence has changed: the text below is not what this audit computes.**"
        )
    lines += [
        f"*{_capital(finding['kind'])}, {finding['status']}*: {_claims(finding['claims'])}",
        finding["statement"],
    ]
    lines += [f"By hand: {finding['by_hand']}"] if finding["by_hand"] else []
    lines += [
        f"What would settle it: {finding['settle']}",
        pipe_table(("evidence", "asserted", "computed"), map(_evidence, finding["evidence"])),
    ]
    return "\n\n".join(lines)


def _evidence(piece: dict[str, Any]) -> tuple[str, ...]:
    computed = piece["computed"]
    shown = ("no", "yes")[computed] if isinstance(computed, bool) else number(computed, 7)
    unit = piece["unit"]
    return piece["meaning"], with_unit(piece["asserted"], unit), with_unit(shown, unit)


def _claims(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _inferred(audit: Audit, name: str) -> str:
    inference = infer(audit.ledger, name)
    rows = [(n, p.text, verdict) for n, (p, verdict) in inference.handbook.items()]
    entry = inference.entry
    return (
        f"{_capital(entry.title)}, {number(entry.nominal)} {entry.unit} ({entry.nominal_source}); "
        f"evidence: {_claims(entry.evidence)}. How it was found is told under the finding above."
        "\n\n" + pipe_table(("handbook value", entry.unit, "verdict"), rows)
    )


def _proof(audit: Audit, assessment: Assessment) -> str:
    claim = assessment.claim
    lines = [
        f"### `{claim.id}`: {claim.title}",
        f"{claim.place}: “{_text(assessment)}”. **{_capital(assessment.verdict.value)}.**",
        explanation(audit.ledger, assessment),
    ]
    lines += [f"Assumes: {'; '.join(a)}." for a in [assumptions(audit.ledger, assessment)] if a]
    return "\n\n".join([*lines, *_tried(audit, claim.id)])


def _tried(audit: Audit, name: str) -> list[str]:
    """For a failing claim: single inputs, misprints and readings that would give its number."""
    found, unit = explain_claim(audit.ledger, name), audit.ledger.claims[name].unit
    readings = [a for a in found.listed(name) if a.explains(name)]
    blocks = [
        ("Single inputs that would give it", map(back_solved_text, found.back_solved)),
        ("Misprints that would", (misprint_text(m, unit) for m in found.misprints)),
        ("Other readings that would", (alternative_text(a, name) for a in readings)),
    ]
    lists = [(head, "\n".join(f"- {line}" for line in lines)) for head, lines in blocks]
    return [f"{head}:\n\n{listed}" for head, listed in lists if listed]


def _joint(answer: JointAnswer) -> str:
    claims = _claims(answer.question.claims)
    text = f"- **{_capital(answer.outcome)}**: {answer.question.question} ({claims}) {answer.bound}"
    return text.rstrip()


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _text(assessment: Assessment) -> str:
    claim = assessment.claim
    return claim.text if claim.printed is None else with_unit(claim.text, claim.unit)


def _sections(audit: Audit) -> list[str]:
    sections: dict[str, list[Assessment]] = {}
    for assessment in audit.assessments.values():
        place = assessment.claim.place
        sections.setdefault("Table A-1" if place.cell else _capital(place.section), []).append(
            assessment
        )
    heads = ("claim", "where", "printed", "computed", "proven range", "verdict")
    return [
        f"### {name}\n\n" + pipe_table(heads, (_row(assessment) for assessment in assessments))
        for name, assessments in sections.items()
    ]


def _row(assessment: Assessment) -> tuple[str, ...]:
    claim, reading = assessment.claim, assessment.reading
    where = str(claim.place).partition(", ")[2]
    text = _text(assessment) or "*blank*"
    head = f"`{claim.id}` {claim.title}"
    if reading is None:
        return head, where, text, "", claim.given or "", assessment.verdict.value
    proven = outward(*reading.enclosure)
    computed = with_unit(number(reading.computed), claim.unit)
    return head, where, text, computed, proven, assessment.verdict.value

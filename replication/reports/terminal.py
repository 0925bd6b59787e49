"""What `coldspray audit` and `coldspray claims` print for a person."""

from collections.abc import Sequence
from textwrap import fill, shorten

from reference import findings
from reference.findings import FindingText
from reference.ledger import Claim, Ledger
from replication.audit import Audit
from replication.audit.explain import assumptions, explanation
from replication.audit.explanations import explain_claim
from replication.audit.explanations.sentences import (
    alternative_text,
    back_solved_text,
    misprint_text,
)
from replication.audit.findings import Finding
from replication.audit.verdict import Assessment, Verdict
from replication.reports.cells import workbook_cell
from replication.text import aligned, number, with_unit

__all__ = ["audit_summary", "claim_proof", "ledger_table"]

_HEADLINES = (
    "depth-beta-3", "depth-beta-5", "ratio-beta-3", "ratio-beta-5", "observed-depth-ratio",
    "observed-depth", "goodier-beta", "walker-anderson-beta",
)  # fmt: skip


def audit_summary(audit: Audit) -> str:
    """The audit on one screen: counts, the best-known numbers, all that fail, the findings."""
    failed = audit.with_verdict(Verdict.NOT_REPRODUCED)
    shown = [audit.assessments[name] for name in _HEADLINES]
    shown += failed
    lines = [
        f"{audit.ledger.author}, {audit.ledger.title} ({audit.ledger.year})",
        f"{len(audit.assessments)} claims",
        *aligned([(f"{n:5d} {verdict}", note) for verdict, n, note in _counts(audit) if n]),
        "",
        *aligned([("", "printed", "computed", "verdict"), *map(_headline, shown)]),
        "",
        "Findings",
        *_findings(audit.findings),
    ]
    return "\n".join(lines)


_WEIGHTIEST = 8
"""Findings that one screen has room for, besides those whose evidence has changed."""


def _findings(findings: Sequence[Finding]) -> list[str]:
    shown = [f for k, f in enumerate(findings) if k < _WEIGHTIEST or not f.holds]
    more = len(findings) - len(shown)
    return [*map(_finding_line, shown), *([f"  and {more} more in audit.html"] if more else [])]


def _finding_line(finding: Finding) -> str:
    changed = "" if finding.holds else " (ITS EVIDENCE HAS CHANGED)"
    return f"  {finding.text.id}: {finding.title}{changed}"


def _counts(audit: Audit) -> list[tuple[str, int, str]]:
    """Verdict, count, and for the reproduced ones what they amount to."""
    kinds = audit.reproduced_kinds
    note = ", ".join(f"{count} {kind}" for kind, count in kinds.items())
    notes = {Verdict.REPRODUCED.value: f"({note})"}
    return [(verdict, count, notes.get(verdict, "")) for verdict, count in audit.summary.items()]


def _headline(assessment: Assessment) -> tuple[str, ...]:
    claim, reading = assessment.claim, assessment.reading
    computed = "" if reading is None else with_unit(number(reading.computed), claim.unit)
    printed = shorten(_printed(claim), 16, placeholder="…")
    return shorten(claim.title, 40, placeholder="…"), printed, computed, assessment.verdict.value


def _printed(claim: Claim) -> str:
    """The printed text with its unit, if it is a number."""
    return with_unit(claim.text, claim.unit) if claim.printed else claim.text


def claim_proof(ledger: Ledger, assessment: Assessment) -> str:
    """One claim with everything that its verdict rests on."""
    claim, reading = assessment.claim, assessment.reading
    rows = [
        ("claim", f"{claim.id}: {claim.title} ({claim.kind})"),
        ("where", str(claim.place)),
        ("quote", claim.quote),
        ("printed", _printed(claim) or "(blank)"),
        ("agrees", "" if claim.interval is None else with_unit(str(claim.interval), claim.unit)),
        ("rests on", ", ".join(f"{k} = {' * '.join(v)}" for k, v in claim.inputs.items())),
    ]
    if reading is not None:
        rows += [
            ("computed", with_unit(repr(reading.computed), claim.unit)),
            ("reference", with_unit(reading.reference, claim.unit)),
        ]
    rows += [
        ("verdict", assessment.verdict.value),
        ("because", explanation(ledger, assessment)),
        ("assumes", "; ".join(assumptions(ledger, assessment))),
        ("workbook", workbook_cell(claim.id, claim.place.cell) or ""),
    ]
    rows += [("finding", f"{f.id}: {f.filled(f.title)}") for f in _touching(claim)]
    rows += _tried(ledger, claim)
    return "\n".join(_labeled(label, text) for label, text in rows if text)


def _touching(claim: Claim) -> list[FindingText]:
    """The findings that touch a claim; `coldspray audit` computes their evidence."""
    return [finding for finding in findings.load().values() if claim.id in finding.claims]


def _tried(ledger: Ledger, claim: Claim) -> list[tuple[str, str]]:
    """What was tried where a reading fails, a line for each attempt."""
    found = explain_claim(ledger, claim.id)
    rows = [("solved for", back_solved_text(b)) for b in found.back_solved]
    rows += [("misprint", misprint_text(m, claim.unit)) for m in found.misprints]
    rows += [("read as", alternative_text(a, claim.id)) for a in found.listed(claim.id)]
    return [
        (label if k == 0 or label != rows[k - 1][0] else "-", t)
        for k, (label, t) in enumerate(rows)
    ]


def _labeled(label: str, text: str) -> str:
    indent = " " * 11
    shown = " ".join(text.split())
    return fill(f"{label:<11}{shown}", width=96, subsequent_indent=indent, break_on_hyphens=False)


def ledger_table(claims: list[Claim]) -> str:
    """The ledger, one line a claim."""
    rows = [(c.id, _printed(c), c.kind, str(c.place)) for c in claims]
    return "\n".join(aligned(rows))

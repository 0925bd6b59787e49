"""What `coldspray audit` and `coldspray claims` print for a person."""

from collections.abc import Sequence
from textwrap import fill

from reference.ledger import Claim, Ledger
from replication.audit import Audit
from replication.audit.explain import assumptions, explanation
from replication.audit.verdict import Assessment, Verdict
from replication.text import number, with_unit

__all__ = ["audit_summary", "claim_proof", "ledger_table"]

_HEADLINES = (
    "depth-beta-3", "depth-beta-5", "ratio-beta-3", "ratio-beta-5", "observed-depth-ratio",
    "observed-depth", "goodier-beta", "walker-anderson-beta",
)  # fmt: skip


def audit_summary(audit: Audit) -> str:
    """The audit on one screen: counts, the best-known numbers, all that fail, the findings."""
    counts = [f"{count:5d} {verdict}" for verdict, count in audit.summary.items() if count]
    blank = sum(a.claim.kind == "blank" for a in audit.assessments.values())
    shown = [audit.assessments[name] for name in _HEADLINES]
    shown += audit.with_verdict(Verdict.NOT_REPRODUCED)
    lines = [
        f"{audit.ledger.author}, {audit.ledger.title} ({audit.ledger.year})",
        f"{len(audit.assessments)} claims, {blank} of them blank cells of Table A-1",
        *counts,
        "",
        *_aligned([("", "printed", "computed", "verdict"), *map(_headline, shown)]),
        "",
        "Findings",
        *(f"  {finding.id}: {finding.title}" for finding in audit.findings),
    ]
    return "\n".join(lines)


def _headline(assessment: Assessment) -> tuple[str, ...]:
    claim, reading = assessment.claim, assessment.reading
    computed = "" if reading is None else with_unit(number(reading.computed), claim.unit)
    printed = with_unit(claim.text, claim.unit) if claim.printed else f"“{claim.text}”"
    return claim.title, printed, computed, assessment.verdict.value


def _aligned(rows: Sequence[tuple[str, ...]]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    padded = (zip(row, widths, strict=True) for row in rows)
    return ["  ".join(f"{text:{width}}" for text, width in row).rstrip() for row in padded]


def claim_proof(ledger: Ledger, assessment: Assessment) -> str:
    """One claim with everything that its verdict rests on."""
    claim, reading = assessment.claim, assessment.reading
    rows = [
        ("claim", f"{claim.id}: {claim.title} ({claim.kind})"),
        ("where", f"{claim.place} (line {claim.place.line} of the text)"),
        ("quote", claim.quote),
        ("printed", with_unit(claim.text, claim.unit) or "(blank)"),
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
    ]
    return "\n".join(_labeled(label, text) for label, text in rows if text)


def _labeled(label: str, text: str) -> str:
    indent = " " * 11
    shown = " ".join(text.split())
    return fill(f"{label:<11}{shown}", width=96, subsequent_indent=indent, break_on_hyphens=False)


def ledger_table(claims: list[Claim]) -> str:
    """The ledger, one line a claim."""
    rows = [(c.id, with_unit(c.text, c.unit), c.kind, str(c.place)) for c in claims]
    return "\n".join(_aligned(rows))

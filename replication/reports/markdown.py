"""The audit as Markdown, for people who read it in a repository."""

from collections.abc import Iterable
from typing import Any

from replication.audit import Audit
from replication.audit.explain import assumptions, explanation
from replication.audit.inference import infer
from replication.audit.verdict import Assessment, Verdict
from replication.reports.numerics import WHY
from replication.text import number, outward, with_unit

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
        _table(("verdict", "claims"), ((v, str(n)) for v, n in audit.summary.items())),
        "Of the reproduced ones "
        + ", ".join(f"{count} are {kind}" for kind, count in audit.reproduced_kinds.items())
        + ".",
        "## Findings",
        *(_finding(finding) for finding in record["findings"]),
        "## Inferred inputs",
        *(_inferred(audit, name) for name in ledger.inferred),
        "## Claims that are not plainly reproduced",
        *(_proof(audit, a) for a in audit.assessments.values() if _is_open(a)),
        "## Where the error of the sheet comes from",
        "Final depth of the sheet minus the exact depth at rest, and its parts [µm]; the parts are "
        "computed each on its own and add up.",
        _budgets(record["error_budget"]),
        WHY["published"] + " The stop rule and the half step by which x trails v nearly cancel. "
        "`coldspray converge` runs the ladder of steps, `--scheme centered` the other variant.",
        "## Hard cases",
        "The sheet, the closed form (error in units of its last place) and the reference.",
        _hard_cases(record["stability"]),
        "## Every claim",
        *_sections(audit),
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
        _table(("evidence", "asserted", "computed"), map(_evidence, finding["evidence"])),
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
        "\n\n" + _table(("handbook value", entry.unit, "verdict"), rows)
    )


def _proof(audit: Audit, assessment: Assessment) -> str:
    claim = assessment.claim
    lines = [
        f"### `{claim.id}`: {claim.title}",
        f"{claim.place}: “{_text(assessment)}”. **{_capital(assessment.verdict.value)}.**",
        explanation(audit.ledger, assessment),
    ]
    lines += [f"Assumes: {'; '.join(a)}." for a in [assumptions(audit.ledger, assessment)] if a]
    return "\n\n".join(lines)


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _text(assessment: Assessment) -> str:
    claim = assessment.claim
    return claim.text if claim.printed is None else with_unit(claim.text, claim.unit)


_PARTS = ("total", "time_step", "stop_rule", "half_step", "rounding")


def _budgets(budgets: list[dict[str, Any]]) -> str:
    heads = ("beta", "step [ns]", "steps", *(part.replace("_", " ") for part in _PARTS))
    rows = (
        (
            number(b["beta"]),
            number(b["step"] * 1e9),
            str(b["steps"]),
            *(number(b[part] * 1e6, 4) for part in _PARTS),
        )
        for b in budgets
    )
    return _table(heads, rows)


def _hard_cases(stability: dict[str, Any]) -> str:
    heads = ("case", "steps", "sheet off by", "closed form [m]", "ulp", "reference [m]", "remarks")
    worst = stability["random"]
    inputs = ", ".join(f"{name} {value!r}" for name, value in worst["inputs"].items())
    return (
        _table(heads, (_hard_case(case) for case in stability["cases"]))
        + f"\n\nOver {worst['cases']} random cases (seed 1) the closed form is at worst "
        f"{worst['ulps']:.2f} ulp off, at {inputs}."
    )


def _hard_case(case: dict[str, Any]) -> tuple[str, ...]:
    off = "" if case["sheet_error"] is None else f"{100 * case['sheet_error']:+.3g} %"
    depth = "" if case["closed_form"] is None else repr(case["closed_form"])
    ulps = "" if case["ulps"] is None else f"{case['ulps']:+.2f}"
    remarks = [r for r in (case["refused"], case["sheet_refused"], *case["warnings"]) if r]
    steps = "" if case["steps"] is None else str(case["steps"])
    return case["name"], steps, off, depth, ulps, case["reference"], "; ".join(remarks)


def _sections(audit: Audit) -> list[str]:
    sections: dict[str, list[Assessment]] = {}
    for assessment in audit.assessments.values():
        place = assessment.claim.place
        sections.setdefault("Table A-1" if place.cell else _capital(place.section), []).append(
            assessment
        )
    heads = ("claim", "where", "printed", "computed", "proven range", "verdict")
    return [
        f"### {name}\n\n" + _table(heads, (_row(assessment) for assessment in assessments))
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


def _table(heads: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    lines = [heads, ("---",) * len(heads), *rows]
    return "\n".join(f"| {' | '.join(map(_escaped, line))} |" for line in lines)


def _escaped(cell: str) -> str:
    return cell.replace("|", "\\|")

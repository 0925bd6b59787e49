"""One test for every finding, by its id: its evidence is computed, and is as asserted."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest

from reference import findings as texts
from replication.audit import Audit, audit
from replication.audit.findings import Evidence, Finding
from replication.audit.findings.scheme import EVIDENCE as SCHEME
from replication.cases import BETA_5
from replication.models.sheet import run
from replication.reports.markdown import markdown
from replication.reports.records import audit_record, finding_record
from replication.reports.terminal import audit_summary


@pytest.fixture(scope="module")
def whole() -> Audit:
    return audit()


@pytest.fixture(scope="module")
def evidence(whole: Audit) -> dict[tuple[str, str], float]:
    return {
        (finding.text.id, piece.assertion.name): float(piece.computed)
        for finding in whole.findings
        for piece in finding.evidence
    }


@pytest.mark.parametrize("name", texts.load())
def test_finding(name: str, whole: Audit) -> None:
    finding = next(f for f in whole.findings if f.text.id == name)
    assert [piece.assertion.name for piece in finding.evidence if not piece.holds] == []
    record = finding_record(finding)
    assert "{" not in record["statement"] + record["by_hand"] + record["settle"] + record["title"]


def test_findings_come_in_the_order_of_their_weight(whole: Audit) -> None:
    assert [finding.text.id for finding in whole.findings] == list(texts.load())


def test_changed_evidence_is_shown_in_every_report(whole: Audit) -> None:
    first = whole.findings[0]
    piece = first.evidence[0]
    wrong = Evidence(replace(piece.assertion, text="9", relation=">="), piece.computed)
    changed = Finding(first.text, (wrong, *first.evidence[1:]))
    assert not changed.holds
    again = replace(whole, findings=(changed, *whole.findings[1:]))
    record = audit_record(again)
    assert record["findings"][0]["holds"] is False
    assert "ITS EVIDENCE HAS CHANGED" in audit_summary(again)
    assert "Its evidence has changed" in markdown(again, record)
    assert "ITS EVIDENCE HAS CHANGED" not in audit_summary(whole)


# Checks of the evidence by other routes than those that computed it.


def test_the_pair_ratio_falls_with_the_drag(evidence: dict) -> None:
    ratios = [math.log1p(z / 7.6) / math.log1p(z / 9.13) for z in (0.01, 2.053, 20, 200, 1e5)]
    assert ratios == sorted(ratios, reverse=True)
    assert ratios[1] > evidence["frank-zook-pair", "hand"] > evidence["frank-zook-pair", "least"]
    assert evidence["frank-zook-pair", "printed"] == 0.2975 / 0.2775


def test_the_pair_could_be_met_only_beyond_the_proven_velocity(evidence: dict) -> None:
    # Bisection for the drag at which the ratio is the greatest that the printed pair allows.
    low, high = 1e9, 1e12
    for _ in range(100):
        middle = math.sqrt(low * high)
        ratio = math.log1p(middle / 7.6e9) / math.log1p(middle / 9.13e9)
        low, high = (middle, high) if ratio > 0.2975 / 0.2775 else (low, middle)
    velocity = math.sqrt(low / (1.046 * 7850))
    assert evidence["frank-zook-pair", "velocity"] < velocity


@pytest.mark.parametrize(("name", "printed"), [("rha", 0.278), ("stainless", 0.297)])
def test_back_solved_inputs_give_the_printed_values(
    name: str, printed: float, evidence: dict
) -> None:
    from replication.models.frank_zook import depth_derived

    strength = {"rha": 9.13e9, "stainless": 7.6e9}[name]
    solved = evidence["frank-zook-values", f"{name}_resistance"] * 1e9
    velocity = evidence["frank-zook-values", f"{name}_velocity"]
    fixed = (2 / 3, 8900.0, 7850.0, 0.557, 1.046)
    assert depth_derived(*fixed, solved, 500.0) == pytest.approx(printed, rel=1e-12)
    assert depth_derived(*fixed, strength, velocity) == pytest.approx(printed, rel=1e-12)


def test_the_observed_depth_comes_with_the_found_beta(evidence: dict) -> None:
    from replication.models.depth import normalized_depth

    beta, velocity = (evidence["observed-beta", key] for key in ("beta", "velocity"))
    assert normalized_depth(500.0, 8900.0, 7850.0, beta * 700e6) == pytest.approx(0.3, rel=1e-12)
    assert normalized_depth(velocity, 8900.0, 7850.0, 3.5e9) == pytest.approx(0.3, rel=1e-12)


def test_the_sheet_depends_on_the_step_in_radii_alone() -> None:
    for factor in (0.5, 4.0):
        scaled = replace(BETA_5, radius=factor * BETA_5.radius, step=factor * BETA_5.step)
        assert run(scaled).normalized_depth == run(BETA_5).normalized_depth


def test_the_depth_at_a_row_s_time_is_not_the_row_s(whole: Audit) -> None:
    from replication.audit.findings.known import Known

    found = SCHEME["meaning-of-x"](Known(whole.ledger, whole.assessments))
    # One row on, x stands at 0.3 ns: what it has at 0.2 ns lies half way, but for the slowing down.
    rows = run(BETA_5).rows
    assert found["exact"] == pytest.approx((rows[1].depth + rows[2].depth) / 2, rel=1e-3)
    assert found["lag"] == Fraction(5, 10**8)

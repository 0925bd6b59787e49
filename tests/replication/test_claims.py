"""One test for every number that the report prints, by its id."""

from fractions import Fraction

import pytest

from reference.ledger import load
from replication.audit import Audit, Verdict, assess_claim, audit
from replication.audit.explain import explanation
from replication.audit.inference import infer
from replication.audit.verdict import assess

LEDGER = load()

NOT_REPRODUCED = {
    # The value that the report's words give, and why it is not the printed one.
    "frank-zook-rha": (0.12727, "Eq. 16 as printed gives X/D"),
    "frank-zook-stainless": (0.15005, "Eq. 16 as printed gives X/D"),
    "eq16-denominator": (1.0, "Eqs. 14 and 15 give X/R without the 2"),
    "coarse-step-beta-5": (-0.0092576, "7.67 becomes 7.66 at 0.5 ns"),
}

SHEET_ROUNDING = 1e-12
"""131 to 178 rows of a dozen roundings of 1.1e-16 each, amplified less than ten times."""
FORMULA_ROUNDING = 2e-15
"""Fewer than ten roundings of 1.1e-16 each."""
CANCELLATION = 1000
"""The coarse step changes a depth by about a thousandth of itself."""


@pytest.mark.parametrize("name", LEDGER.claims)
def test_claim(name: str) -> None:
    claim = LEDGER.claims[name]
    assessment = assess_claim(LEDGER, name)
    reading = assessment.reading
    if claim.given is not None:
        assert assessment.verdict is Verdict.NOT_CHECKABLE
        assert claim.given in explanation(LEDGER, assessment)
        return
    if name in NOT_REPRODUCED:
        value, _ = NOT_REPRODUCED[name]
        assert assessment.verdict is Verdict.NOT_REPRODUCED
        assert reading is not None
        assert reading.computed == pytest.approx(value, rel=1e-4)  # as many digits as are above
    else:
        assert assessment.verdict is Verdict.REPRODUCED
    if reading is not None:
        assert reading.robust is not False, "the verdict hangs on the choice of target density"
        assert reading.computed == pytest.approx(float(reading.reference), rel=_bound(name), abs=0)


def _bound(name: str) -> float:
    computation = LEDGER.claims[name].computation
    assert computation is not None
    if "change" in computation.name:
        return SHEET_ROUNDING * CANCELLATION
    return SHEET_ROUNDING if computation.name.startswith(("sheet", "row")) else FORMULA_ROUNDING


def test_frank_zook_as_derived_reaches_only_the_second_value() -> None:
    armor, stainless = (
        assess_claim(LEDGER, name).others[0] for name in ("frank-zook-rha", "frank-zook-stainless")
    )
    assert armor.verdict is Verdict.NOT_REPRODUCED
    assert armor.computed == pytest.approx(0.25455, rel=1e-4)
    assert stainless.verdict is Verdict.WITHIN_ROUNDING
    assert stainless.computed == pytest.approx(0.30009, rel=1e-4)


def test_a_witness_is_one_of_the_inputs_that_print_alike_and_gives_the_number() -> None:
    claim = LEDGER.claims["frank-zook-stainless"]
    reading = assess_claim(LEDGER, claim.id).others[0]
    assert reading.witness is not None
    from replication.audit.replica import REPLICA

    value = REPLICA["frank_zook_derived"](**{k: float(v) for k, v in reading.witness.items()})
    assert f"{value:.3f}" == claim.text
    for name, entries in claim.inputs.items():
        if not entries[0].startswith("inferred:"):
            assert LEDGER.claims[entries[0]].as_input().contains(reading.witness[name])


def test_a_sheet_with_something_in_a_blank_cell_is_not_the_reports() -> None:
    claim = LEDGER.claims["a1-blank-F8"]
    assert assess(LEDGER, claim, lambda _: False).verdict is Verdict.NOT_REPRODUCED


def test_the_target_density_is_between_7839_and_7864() -> None:
    inference = infer(LEDGER, "target-density")
    inner, outer = inference.inner, inference.outer
    assert inner.lower is not None
    assert inner.upper is not None
    assert outer.encloses(inner.lower, inner.upper)
    # Its ends are where single cells begin to print otherwise; found here by another route.
    assert float(inner.lower) == pytest.approx(
        _density_where("a1-deceleration-2", 929.5e6), rel=1e-6
    )
    assert float(inner.upper) == pytest.approx(
        _density_where("a1-deceleration-1", 311.5e6), rel=1e-6
    )
    admitted = {name for name, (_, admits) in inference.handbook.items() if admits}
    assert admitted == {"plain carbon steel", "rolled homogeneous armor, common in hydrocodes"}


def _density_where(name: str, deceleration: float) -> float:
    """The target density at which the sheet's cell has a value, by bisection in doubles."""
    from dataclasses import replace

    from replication.impact import BETA_5
    from replication.midpoint import run

    row = LEDGER.claims[name].row
    assert row is not None
    low, high = 7000.0, 9000.0
    for _ in range(60):
        middle = (low + high) / 2
        cell = run(replace(BETA_5, target_density=middle)).rows[row].deceleration
        low, high = (middle, high) if cell < deceleration else (low, middle)
    return low


@pytest.fixture(scope="module")
def whole() -> Audit:
    return audit()


def test_summary_counts_every_claim_once(whole: Audit) -> None:
    assert sum(whole.summary.values()) == len(LEDGER.claims) == len(whole.assessments)
    assert whole.summary["not reproduced"] == len(NOT_REPRODUCED)


def test_findings_touch_claims_and_show_numbers(whole: Audit) -> None:
    for finding in whole.findings:
        assert set(finding.claims) <= set(LEDGER.claims)
        assert any(character.isdigit() for character in finding.evidence)


def test_no_one_set_of_inputs_gives_both_frank_zook_values(whole: Audit) -> None:
    finding = next(f for f in whole.findings if f.id == "frank-zook-pair")
    assert "no one set of inputs gives both" in finding.evidence
    # ln(1 + z / 7.6) / ln(1 + z / 9.13) with z = k_t rho_t V^2 in GPa; 0.297 / 0.278 is 1.068.
    assert "[1.16312, 1.19498]" in finding.evidence


def test_the_coarse_step_prints_7_66(whole: Audit) -> None:
    finding = next(f for f in whole.findings if f.id == "coarse-step")
    assert "from 10.0 to 10.0" in finding.evidence
    assert "from 7.67 to 7.66" in finding.evidence


def test_errors_are_in_units_of_the_last_printed_digit(whole: Audit) -> None:
    depth = whole.assessments["depth-beta-5"]
    assert depth.reading is not None
    expected = (Fraction(depth.reading.computed) - Fraction("7.67")) / Fraction("0.01")
    assert depth.error_in_last_digit == float(expected)
    assert whole.assessments["a1-blank-F8"].error_in_last_digit is None

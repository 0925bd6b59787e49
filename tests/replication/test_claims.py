"""One test for every number that the report prints, by its id: the story of the audit."""

import re
from fractions import Fraction as F

import pytest

from reference.ledger import Claim, load
from replication.audit.record import ClaimRecord, Record

LEDGER = load()

# What is not plainly reproduced, with the value that the report's words give.

NOT_REPRODUCED = {
    "frank-zook-rha": 0.127273,  # Eq. 16 as printed; 0.254546 from Eqs. 14 and 15
    "frank-zook-stainless": 0.150046,  # 0.300092 from Eqs. 14 and 15
    "eq16-denominator": 1,  # for X/R; 2 belongs to X/D
}
SOURCES = {
    # What public sources print, in the claim's unit, and whether one of them agrees.
    "yield-strength": ([(214.5, 215.5)], True),
    "elastic-modulus": ([(192.5, 200.5), (192.5, 193.5)], True),
    "strength-bulk": ([(29.5, 30.5)], True),
    "copper-yield": ([(89.95, 90.05)], True),
    "autodyne-copper-yield": ([(115, 125)], True),
    "autodyne-steel-yield": ([(335, 345)], False),
    "a1-density": ([(8885, 8895), (8915, 8925), (8959.95, 8960.05), (8850, 8950)], True),
}
SHOWN = {
    # A choice, and the values for which what is computed from it comes out as printed.
    "goodier-q": (2.7096, 2.7882),
    "flow-stress": (699, 701),
    "depth-beta-3-beta": (2.9892, 3.0460),
    "depth-beta-5-beta": (4.9932, 5.0057),
    "a-step": (0.199875, 0.200125),
    "a1-initial-velocity": (499.562, 500.057),
}
TAKEN_OVER = {"eq1-power", "eq8-multiple", "eq10-factor"}
"""Constants of equations that the report does not derive and that no check settles."""


def expected(claim: Claim) -> str:
    if claim.id in NOT_REPRODUCED:
        return "not reproduced"
    if claim.kind == "remark":
        return "remark, quantified"
    if claim.id in SOURCES:
        return (
            "agrees with public sources" if SOURCES[claim.id][1] else "differs from public sources"
        )
    if claim.id in SHOWN or (claim.computation is not None and claim.computation.restates):
        return "consistent"
    if claim.computation is not None or (claim.within and claim.id not in TAKEN_OVER):
        return "reproduced"
    return "not checkable"


SHEET_ROUNDING = 1e-12
"""131 to 178 rows of a dozen roundings of 1.1e-16 each, amplified less than ten times."""
FORMULA_ROUNDING = 2e-15
"""Fewer than ten roundings of 1.1e-16 each."""


@pytest.mark.parametrize("claim", LEDGER.claims.values(), ids=lambda claim: claim.id)
def test_claim(claim: Claim, record: Record) -> None:
    judged = record.claim(claim.id)
    assert judged.verdict == expected(claim)
    assert judged.explanation
    assert (judged.printed, judged.unit, judged.where) == (claim.text, claim.unit, str(claim.place))
    if judged.computed is not None:
        assert judged.reference is not None
        bound = SHEET_ROUNDING if claim.by_scheme else FORMULA_ROUNDING
        assert judged.computed == pytest.approx(float(judged.reference), rel=bound, abs=0)
        if judged.computed not in (0, 2 / 3):  # exact text, of which a double is a rounding
            inside = claim.interval().contains(F(judged.computed))
            assert inside == (judged.verdict == "reproduced")
    if claim.id in NOT_REPRODUCED and judged.computed is not None:
        assert judged.computed == pytest.approx(NOT_REPRODUCED[claim.id], rel=1e-5)
    if judged.verdict == "not checkable" and claim.given:
        assert claim.given in judged.explanation


def test_nothing_is_expected_that_is_not_there() -> None:
    assert {*NOT_REPRODUCED, *SOURCES, *SHOWN, *TAKEN_OVER} <= set(LEDGER.claims)
    assert {c.id for c in LEDGER.claims.values() if c.shown_by} - set(SHOWN) == {
        "yield-strength", "elastic-modulus", "a1-density",
    }  # fmt: skip


@pytest.mark.parametrize("name", SHOWN)
def test_choices_are_shown_by_the_digits_of_what_is_computed(name: str, record: Record) -> None:
    shown = record.claim(name).shown_by
    assert shown is not None
    assert shown.interval == pytest.approx(SHOWN[name], rel=2e-5)


@pytest.mark.parametrize("name", SOURCES)
def test_public_sources(name: str, record: Record) -> None:
    ranges, agrees = SOURCES[name]
    claim = LEDGER.claims[name]
    sources = record.claim(name).sources
    assert any(source.agrees for source in sources) == agrees
    for source, (low, high) in zip(sources, ranges, strict=True):
        ends = LEDGER.sources[source.id].interval.scaled(1 / claim.si).ends
        assert ends == pytest.approx((low, high), rel=1e-9)
        assert source.agrees == claim.interval().meets(
            LEDGER.sources[source.id].interval.scaled(1 / claim.si)
        )
        assert source.says in record.claim(name).explanation


def failing(record: Record) -> list[ClaimRecord]:
    return [claim for claim in record.claims if claim.verdict in ("not reproduced", "inconsistent")]


def test_counts_and_summary(record: Record) -> None:
    assert [claim.id for claim in record.claims] == list(LEDGER.claims)
    assert sum(record.summary.values()) == len(record.claims) == record.counts.numbers + 2
    assert {claim.id for claim in failing(record)} == set(NOT_REPRODUCED)
    counts = record.counts
    assert (counts.failing, counts.blank_cells, counts.equations) == (3, 31, 20)
    assert counts.reproduced == record.summary["reproduced"]
    assert counts.calculations < counts.reproduced, "0.3 is printed five times"
    assert counts.equations_derived == 13
    assert record.culprit is None


def test_a_failing_number_shows_its_formula_bound_and_hand_calculation(record: Record) -> None:
    for claim in failing(record):
        if claim.computed is None:
            continue
        assert claim.formula is not None
        assert f"{claim.computed:.3g}" in claim.formula
        assert claim.mathml is not None
        assert claim.enclosure is not None
        assert claim.interval is not None
        assert claim.enclosure[1] < claim.interval[0]
        assert re.search("Proven for all inputs .* all of it below", claim.explanation)
        assert {entry for names in claim.rests_on.values() for entry in names} <= {
            *LEDGER.claims, "inferred:target-density",
        }  # fmt: skip


def test_errors_are_in_units_of_the_last_printed_digit(record: Record) -> None:
    depth = record.claim("depth-beta-5")
    assert depth.computed is not None
    assert depth.error_in_last_digit == float((F(depth.computed) - F("7.67")) / F("0.01"))
    assert record.claim("observed-ratio").error_in_last_digit == pytest.approx(-0.02, abs=1e-3)
    for name in ("contact-diameter-bound", "sphere-length-ratio", "copper-yield-bound"):
        assert not record.claim(name).error_in_last_digit


def test_the_remark_has_figures_and_accuses_nobody(record: Record) -> None:
    remark = record.claim("coarse-step-remark")
    assert remark.quote == "the results ⟦did not change significantly⟧ when"
    figures = {figure.means: figure.value for figure in remark.figures}
    initial, middle = (
        figures[f"change, beta = 5, drag at the {where} velocity"]
        for where in ("initial", "middle")
    )
    assert initial == pytest.approx(-0.12, abs=5e-3)
    assert middle == pytest.approx(-0.007, abs=5e-4)
    assert len(figures) == 12
    assert remark.id not in {claim.id for claim in failing(record)}
    depths = [figure.value for figure in remark.figures if figure.unit == "um"]
    assert {round(depth, 1) for depth in depths} == {10.0, 7.7}

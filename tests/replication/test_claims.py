"""One test for every number that the report prints, by its id: the story of the audit."""

from fractions import Fraction as F

import pytest

from reference.ledger import Claim, load
from replication.audit.record import Record

LEDGER = load()

# What is not plainly reproduced, with the value that the report's words give.

NOT_REPRODUCED = {
    "frank-zook-rha": 0.127273,  # Eq. 16 as printed; 0.254546 from Eqs. 14 and 15
    "frank-zook-stainless": 0.150046,  # 0.300092 from Eqs. 14 and 15
    "eq16-denominator": 1,  # for X/R; 2 belongs to X/D
}
SOURCES = {
    # What the report derives from nothing, and whether a public source agrees.
    **dict.fromkeys(("yield-strength", "elastic-modulus", "strength-bulk", "copper-yield"), True),
    **dict.fromkeys(("autodyne-copper-yield", "a1-density"), True),
    "autodyne-steel-yield": False,
}
SHOWN = {
    "goodier-q", "flow-stress", "depth-beta-3-beta", "depth-beta-5-beta", "a-step",
    "a1-initial-velocity",
}  # fmt: skip
"""Choices that are shown by the digits of what is computed from them."""
TAKEN_OVER = {"eq1-power", "eq8-multiple", "eq10-factor"}
"""Constants of equations that the report does not derive and that no check settles."""


def expected(claim: Claim) -> str:
    if claim.id in NOT_REPRODUCED:
        return "not reproduced"
    if claim.kind == "remark":
        return "remark, quantified"
    if claim.id in SOURCES:
        return f"{'agrees with' if SOURCES[claim.id] else 'differs from'} public sources"
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
    assert {c.id for c in LEDGER.claims.values() if c.shown_by} - SHOWN == {
        "yield-strength", "elastic-modulus", "a1-density",
    }  # fmt: skip

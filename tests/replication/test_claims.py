"""One test for every number that the report prints, by its id."""

import re
from fractions import Fraction as F

import pytest

from reference.ledger import INFERRED, Claim, Convention, load
from replication.audit.assessment import Ground, Verdict
from replication.audit.audit import Audit
from replication.audit.record import Record

LEDGER = load()

# The numbers that are not reproduced, with the values that the report's words give

NOT_REPRODUCED = {
    "frank-zook-rha": 0.127273,  # Eq. 16 as printed; 0.254546 from Eqs. 14 and 15
    "frank-zook-stainless": 0.150046,  # 0.300092 from Eqs. 14 and 15
    "eq16-denominator": 1,  # for X/R; 2 belongs to X/D
}
SOURCES = {
    # The numbers that the report does not derive, and whether a public source agrees
    **dict.fromkeys(("yield-strength", "elastic-modulus", "strength-bulk", "copper-yield"), True),
    **dict.fromkeys(("autodyne-copper-yield", "a1-density"), True),
    "autodyne-steel-yield": True,  # as one digit
}
SHOWN = {
    "goodier-q", "flow-stress", "depth-beta-3-beta", "depth-beta-5-beta", "a-step",
    "a1-initial-velocity",
}  # fmt: skip
"""Choices of the author that the numbers computed from them confirm."""
TAKEN_OVER = {"eq1-power", "eq10-factor", "eq5-factor-particle", "eq5-factor-target"}
"""Constants that no check settles, in equations that the report quotes."""
REPEATED = {
    "diameter-radii", "eqa1-power-left", "eqa1-factor", "eqa1-power-velocity", "eqa1-power-right",
    "eqa3-power-radius", "eqa3-power-depth",
}  # fmt: skip
"""Constants of equations that repeat others, or define a symbol."""
COMPARED = {
    # Numbers that nothing computes, but that can be compared
    "outlier-volume": "consistent",  # 24.3 um wide, within 10 to 30
    "autodyne-time": "consistent",  # 88 ns, 3.4 stop times
    "brinell-ratio": "agrees with public sources",  # 2.80 to 2.84 by rules for steels
    "initial-depth": "consistent",  # a definition
    "eq8-multiple": "consistent",  # a definition: 2a is a diameter
}


def expected(claim: Claim) -> str:
    if claim.id in NOT_REPRODUCED:
        return "not reproduced"
    if claim.kind == "remark":
        return "remark, quantified"
    if claim.id in SOURCES:
        return f"{'agrees with' if SOURCES[claim.id] else 'differs from'} public sources"
    if claim.id in COMPARED:
        return COMPARED[claim.id]
    if claim.id in SHOWN | REPEATED or claim.restates:
        return "consistent"
    if claim.computation is not None or (claim.within and claim.id not in TAKEN_OVER):
        return "reproduced"
    return "not checkable"


SHEET_ROUNDING = 1e-12
"""131 to 178 rows with a dozen roundings of 1.1e-16 each, amplified less than ten times."""
FORMULA_ROUNDING = 2e-15
"""Fewer than ten roundings of 1.1e-16 each."""


@pytest.mark.parametrize("claim", LEDGER.claims.values(), ids=lambda claim: claim.id)
def test_claim(claim: Claim, record: Record) -> None:
    judged = record.claim(claim.id)
    assert judged.claim is claim
    assert judged.verdict == expected(claim)
    assert judged.explanation.endswith(".")
    known = LEDGER.claims.keys() | {INFERRED + key for key in LEDGER.inferred}
    assert set(claim.input_ids) <= known
    assert len(judged.scopes) == len(judged.assessment.readings)
    assert all(scope.endswith(".") for scope in judged.scopes)
    if judged.as_printed is not None:
        computed, (low, high) = F(judged.as_printed.computed), judged.as_printed.judgements[0].ends
        bound = SHEET_ROUNDING if claim.by_scheme else FORMULA_ROUNDING
        reference = float(judged.as_printed.reference)
        assert judged.computed == pytest.approx(reference, rel=bound, abs=0)
        slack = abs(computed) / 10**12  # rounding may place a double outside the range
        assert low - slack <= computed <= high + slack
        if judged.computed not in (0, 2 / 3):  # the text is exact, the double is rounded
            inside = claim.interval().contains(computed)
            assert inside == (judged.verdict is Verdict.REPRODUCED)
        conventions = [judgement.convention for judgement in judged.as_printed.judgements]
        assert conventions[0] == Convention(), "the usual one comes first"
        assert len(set(conventions)) == len(conventions)
    if claim.id in NOT_REPRODUCED and claim.within is None:
        assert judged.computed == pytest.approx(NOT_REPRODUCED[claim.id], rel=1e-5)
        assert judged.back_solved
        assert judged.slips
    if judged.verdict is Verdict.NOT_CHECKABLE and claim.why:
        assert claim.why in judged.explanation


SAYS = {
    (Ground.WORDS, "remark, quantified"): r"A remark, not a number|It says again",
    (Ground.REPETITION, "consistent"): r"The report lists|It repeats or compares with",
    (Ground.COMPUTATION, "reproduced"): r"(?!.*\bnot (in|as)\b).*\b(in|as) ",
    (Ground.COMPUTATION, "not reproduced"): r".*\bnot (in|as) ",
    (Ground.EQUATION, "reproduced"): r"With this number, and no other that was tried, the equation",
    (Ground.EQUATION, "consistent"): r"With this number, and no other that was tried, the equation",
    (Ground.EQUATION, "not reproduced"): r"With .* instead of .* the equation follows",
    (Ground.EQUATION, "not checkable"): r"Dimensions, limits and signs do not decide it",
    (Ground.SOURCES, "agrees with public sources"): r".* It agrees with",
    (Ground.OTHERS, "consistent"): r".* out as printed: ",
    (Ground.COMPARISON, "consistent"): r"A sphere of that volume|Scaled to a particle",
    (Ground.COMPARISON, "agrees with public sources"): r"By the rules that public sources print",
    (Ground.DEFINITION, "consistent"): r"Nothing to compute: ",
    (Ground.NOTHING, "not checkable"): r"Nothing in the report decides it: ",
}
"""How the explanation of a claim begins, by the ground and the verdict; no others occur."""


@pytest.mark.parametrize("claim", LEDGER.claims)
def test_the_explanation_tells_the_ground_of_the_verdict(claim: str, record: Record) -> None:
    judged = record.claim(claim)
    assert re.match(SAYS[judged.assessment.ground, judged.verdict.value], judged.explanation)
    assert ("decide" in judged.explanation) == (judged.verdict is Verdict.NOT_CHECKABLE)


def test_every_ground_is_tested(record: Record) -> None:
    assert {claim.assessment.ground for claim in record.claims} == {*Ground} - {Ground.NO_VALUE}


def test_nothing_is_expected_that_is_not_there() -> None:
    listed = {*NOT_REPRODUCED, *SOURCES, *SHOWN, *TAKEN_OVER, *REPEATED, *COMPARED}
    assert listed <= set(LEDGER.claims)
    assert {c.id for c in LEDGER.claims.values() if c.shown_by} - SHOWN == {
        "yield-strength", "elastic-modulus", "a1-density",
    }  # fmt: skip


def test_a_formula_that_a_misprint_leaves_without_a_value_ends_no_audit() -> None:
    ledger = LEDGER.misprint("fz-resistance-rha", "0")
    spoiled = Audit(ledger, every_convention=False).record()
    armor = spoiled.claim("frank-zook-rha")
    assert (armor.verdict.value, armor.assessment.ground) == ("not reproduced", Ground.NO_VALUE)
    assert armor.explanation == (
        "With the numbers as printed it cannot be computed: it divides by zero."
    )
    assert {f.id for f in spoiled.findings if not f.holds} >= {"equation-16", "frank-zook-values"}
    approaches = [a for a in spoiled.approaches if a.claim == "frank-zook-rha"]
    assert [a.computed for a in approaches] == [None, None]


def test_a_claim_that_there_is_not_says_where_the_ids_are(record: Record) -> None:
    with pytest.raises(KeyError, match="there is no claim 'xyz'; `coldspray claims` lists the ids"):
        record.claim("xyz")

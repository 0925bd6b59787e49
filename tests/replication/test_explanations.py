"""What would explain a failing number, and which claims go together."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference.conjectures import load as load_conjectures
from reference.enclosure import Solutions
from reference.ledger import load
from reference.printed import Interval
from replication.audit.assessed import assess_claim
from replication.audit.entries import replica_of, rounding
from replication.audit.explanations import Explanation, explain_claim
from replication.audit.explanations.backsolve import BackSolved, back_solve
from replication.audit.explanations.edits import KINDS, edits
from replication.audit.explanations.joint import JointAnswer, consistency
from replication.audit.explanations.misprints import misprints
from replication.audit.verdict import Verdict
from replication.models.frank_zook import depth_derived

LEDGER, CONJECTURES = load(), load_conjectures()
FAILING = [
    (name, reading.name)
    for name in LEDGER.claims
    for assessment in [assess_claim(LEDGER, name)]
    for reading in (assessment.reading, *assessment.others)
    if reading is not None and reading.verdict is not Verdict.REPRODUCED
]
DERIVED = "derived from Eqs. 14 and 15"


def solved(claim: str, reading: str, entry: str) -> BackSolved:
    found = explain_claim(LEDGER, claim).back_solved
    return next(b for b in found if (b.reading, b.entry) == (reading, entry))


# Back-solving


def test_these_readings_fail() -> None:
    assert set(FAILING) == {
        ("coarse-step-beta-5", ""),
        ("eq16-denominator", ""),
        ("frank-zook-rha", ""),
        ("frank-zook-rha", DERIVED),
        ("frank-zook-stainless", ""),
        ("frank-zook-stainless", DERIVED),
        ("excess-beta-5", "excess over the observed value"),
    }


@pytest.mark.parametrize(("name", "reading"), FAILING)
def test_solutions_give_the_number_and_what_is_excluded_does_not(name: str, reading: str) -> None:
    claim = LEDGER.claims[name]
    assert claim.interval is not None
    assert claim.computation is not None
    target = claim.interval.scaled(claim.si)
    computation = claim.readings.get(reading, claim.computation)
    replica = replica_of(LEDGER, claim, computation)
    for found in (b for b in explain_claim(LEDGER, name).back_solved if b.reading == reading):
        for part in found.solutions.inner:
            assert part.lower is not None
            assert part.upper is not None
            for share in (Fraction(1, 100), Fraction(1, 2), Fraction(99, 100)):
                point = part.lower + share * (part.upper - part.lower)
                assert target.contains(Fraction(replica({found.entry: point}))), found.entry
        low, high = found.solutions.search
        for k in range(21):
            point = low * Fraction(float(high / low) ** (k / 20))
            if not any(part.contains(point) for part in found.solutions.outer):
                assert not target.contains(Fraction(replica({found.entry: point}))), found.entry


@pytest.mark.parametrize(
    ("claim", "entry", "value"),
    [
        # By hand, from X/R = inertia / k_t ln(1 + z / R_t).
        ("frank-zook-rha", "fz-resistance-rha", 8.279e9),
        ("frank-zook-rha", "a1-initial-velocity", 525.1),
        ("frank-zook-rha", "fz-k1", 0.678),
        ("frank-zook-rha", "a1-density", 10324),
        ("frank-zook-rha", "sphere-length-ratio", 0.7734),
        ("frank-zook-stainless", "fz-resistance-stainless", 7.689e9),
        ("frank-zook-stainless", "a1-initial-velocity", 497.1),
    ],
)
def test_what_eq_16_as_derived_would_need(claim: str, entry: str, value: float) -> None:
    found = solved(claim, DERIVED, entry)
    assert found.value == pytest.approx(value, rel=2e-4)
    assert found.proof == "proven inside, and none beyond"
    assert not found.rounding, "no input within its own rounding gives it"


def test_the_resistance_that_is_wanted_gives_the_number() -> None:
    wanted = solved("frank-zook-rha", DERIVED, "fz-resistance-rha").value
    assert wanted is not None
    assert depth_derived(2 / 3, 8900, 7850, 0.557, 1.046, wanted, 500) == pytest.approx(
        0.278, rel=1e-12
    )


def test_no_metal_is_dense_enough_for_eq_16_as_printed() -> None:
    found = solved("frank-zook-stainless", "", "a1-density")
    assert (found.value, found.solutions.outer) == (None, ())
    assert found.proof == "proven: none in the range does"


def test_of_a_comparison_only_what_the_other_claim_does_not_share_is_tried() -> None:
    # Any other input would change the depth at 0.2 ns, too, with which that at 0.5 ns is compared.
    found = explain_claim(LEDGER, "coarse-step-beta-5")
    assert [b.entry for b in found.back_solved] == ["coarse-step"]
    assert {m.what for m in found.misprints} == {"coarse-step"}


def test_a_handbook_value_that_would_serve_is_named() -> None:
    stainless = solved("frank-zook-stainless", DERIVED, "fz-resistance-stainless")
    inside = replace(
        assess_claim(LEDGER, "frank-zook-stainless").claim,
        interval=Interval(Fraction("0.3"), Fraction("0.3003")),
    )
    assessment = assess_claim(LEDGER, "frank-zook-stainless")
    reading = next(r for r in assessment.others)
    found = back_solve(LEDGER, CONJECTURES, inside, reading)
    density = next(b for b in found if b.entry == "inferred:target-density")
    assert "plain carbon steel" in [mark.name for mark in density.marks]
    assert not stainless.rounding


def test_a_number_out_of_reach_has_no_solution() -> None:
    assessment = assess_claim(LEDGER, "frank-zook-rha")
    far = replace(assessment.claim, interval=Interval(Fraction(90), Fraction(91)))
    assert assessment.reading is not None
    found = back_solve(LEDGER, CONJECTURES, far, assessment.reading)
    k_t = next(b for b in found if b.entry == "fz-kt")
    assert (k_t.solutions.inner, k_t.solutions.outer, k_t.value) == ((), (), None)


def test_what_was_not_decided_is_not_called_proven() -> None:
    found = solved("coarse-step-beta-5", "", "coarse-step")
    open_ = Solutions(found.solutions.search, (), (Interval(*found.solutions.search),))
    assert replace(found, solutions=open_).proof == "undecided"


# Misprints

NUMBERS = st.one_of(
    st.decimals(0, 9999, places=3, allow_nan=False).map(str),
    st.integers(1, 9999).map(str),
    st.tuples(st.integers(100, 999), st.integers(-20, 20)).map(
        lambda pair: f"{pair[0] / 100:.2f}E{pair[1]:+03d}"
    ),
)


@settings(deadline=None)
@given(text=NUMBERS)
def test_every_edit_is_one_slip_away_and_stands_once(text: str) -> None:
    found = edits(text)
    texts = [edit.text for edit in found]
    assert len(set(texts)) == len(texts)
    assert text not in texts
    for edit in found:
        assert edit.kind in KINDS
        if edit.kind == "exponent off by one":
            mantissa, _, power = text.partition("E")
            other, _, shifted = edit.text.partition("E")
            assert (mantissa, abs(int(power) - int(shifted))) == (other, 1)
        else:
            assert _distance(text, edit.text) == 1


def _distance(one: str, other: str) -> int:
    """Damerau and Levenshtein's: changes, insertions, deletions, and swaps of neighbors."""
    rows = {(i, -1): i + 1 for i in range(-1, len(one))}
    rows |= {(-1, j): j + 1 for j in range(-1, len(other))}
    for i, a in enumerate(one):
        for j, b in enumerate(other):
            ways = [rows[i - 1, j] + 1, rows[i, j - 1] + 1, rows[i - 1, j - 1] + (a != b)]
            if i and j and a == other[j - 1] and b == one[i - 1]:
                ways.append(rows[i - 2, j - 2] + 1)
            rows[i, j] = min(ways)
    return rows[len(one) - 1, len(other) - 1]


def test_edits_of_the_reports_way_to_write_powers() -> None:
    found = {edit.text: edit.kind for edit in edits(r"9.13 \times 10^9")}
    assert found[r"9.13 \times 10^8"] == "exponent off by one"
    assert found[r"9.31 \times 10^9"] == "digits swapped"
    assert not any(text.endswith(r"\times 11^9") for text in found)


def test_no_misprint_explains_0_278() -> None:
    assert explain_claim(LEDGER, "frank-zook-rha").misprints == ()


def test_0_297_needs_another_resistance_or_k_t() -> None:
    found = explain_claim(LEDGER, "frank-zook-stainless").misprints
    assert found[0].edit.text == "7.7×10^9"
    assert {(m.what, m.reading) for m in found} == {
        ("fz-resistance-stainless", DERIVED),
        ("fz-kt", DERIVED),
    }


def test_k_t_of_another_print_does_not_help_the_other_number() -> None:
    inputs = (2 / 3, 8900, 7850, 0.557, 1.146)
    assert depth_derived(*inputs, 7.6e9, 500) == pytest.approx(0.297, abs=5e-4)
    assert depth_derived(*inputs, 9.13e9, 500) < 0.2775


def test_the_2_of_eq_16_may_be_a_1() -> None:
    (only,) = explain_claim(LEDGER, "eq16-denominator").misprints
    assert (only.edit.text, only.what) == ("1", "eq16-denominator")


def test_another_density_would_break_the_printed_mass() -> None:
    found = explain_claim(LEDGER, "excess-beta-5").misprints
    density = next(m for m in found if m.what == "a1-density")
    assert "a1-mass" in density.breaks
    assert [m.rank for m in found] == sorted(m.rank for m in found)


def test_an_edited_result_that_contradicts_what_rests_on_it_says_so() -> None:
    # Were 0.278 the text of a claim computed to be 0.298, 0.298 would not be less than 0.298.
    assessment = assess_claim(LEDGER, "frank-zook-rha")
    assert assessment.reading is not None
    reading = replace(assessment.reading, reference="0.298")
    found = misprints(LEDGER, CONJECTURES, assessment.claim, reading)
    edited = next(m for m in found if m.edit.text == "0.298")
    assert edited.breaks == ("frank-zook-below-observed",)


# Readings


@pytest.fixture(scope="module")
def tried() -> Explanation:
    return explain_claim(LEDGER, "frank-zook-rha")


def test_no_reading_with_up_to_two_slips_gives_both_numbers(tried: Explanation) -> None:
    assert tried.alternatives is not None
    assert len(tried.alternatives.tried) > 1000
    assert [a.name for a in tried.alternatives.tried if a.explains_all is not False] == []
    assert "none gives both frank-zook-rha and frank-zook-stainless" in tried.alternatives.sentence


def test_some_readings_give_one_number_and_are_not_taken_for_an_explanation(
    tried: Explanation,
) -> None:
    assert tried.alternatives is not None
    for claim in ("frank-zook-rha", "frank-zook-stainless"):
        ones = [a for a in tried.alternatives.tried if a.explains(claim)]
        assert ones
        assert not any(a.explains_all for a in ones)
    # As derived, without any slip, 0.297 is within the rounding of its inputs, and 0.278 is not.
    derived = next(a for a in tried.alternatives.tried if a.name == DERIVED)
    assert derived.explains("frank-zook-stainless")
    assert not derived.explains("frank-zook-rha")


def test_slips_are_what_they_say(tried: Explanation) -> None:
    assert tried.alternatives is not None
    values = {a.name: a.computed["frank-zook-rha"] for a in tried.alternatives.tried}
    inertia, z = 2 / 3 * 8900 / 7850 + 0.557, 1.046 * 7850 * 500**2 / 9.13e9
    printed = inertia / (2 * 1.046) * math.log1p(z)
    expected = {
        "as printed": printed,
        DERIVED: 2 * printed,
        "as printed, logarithm to base 10": printed / math.log(10),
        "as printed, k_1 left out": printed * (inertia - 0.557) / inertia,
        "as printed, 2 k_t in the logarithm": printed * math.log1p(2 * z) / math.log1p(z),
        f"{DERIVED}, velocity 521": 2 * printed * math.log1p(z * 1.042**2) / math.log1p(z),
        f"{DERIVED}, no 1 in the logarithm": 2 * printed * math.log(z) / math.log1p(z),
    }
    for name, value in expected.items():
        assert values[name] == pytest.approx(value, rel=1e-12), name


# Claims tested together


def answer(name: str) -> JointAnswer:
    return consistency(LEDGER, next(q for q in CONJECTURES.joint if q.id == name))


@pytest.mark.parametrize(
    ("name", "outcome"),
    [
        ("frank-zook-pair", "impossible"),
        ("depths-and-table", "possible"),
        ("two-steps", "possible"),
        ("coarse-step-and-table", "impossible"),
        ("mass-radius-density", "possible"),
        ("observed-with-0.06", "possible"),
        ("observed-with-0.058", "impossible"),
    ],
)
def test_claims_go_together_or_not(name: str, outcome: str) -> None:
    found = answer(name)
    assert found.outcome == outcome
    assert bool(found.bound) == (outcome == "impossible" or "as printed" in found.bound)
    assert (found.witness is not None) == (outcome == "possible")


def test_the_witness_prints_7_67_at_both_steps_and_is_no_other_number() -> None:
    found = answer("two-steps")
    assert found.witness is not None
    for name in ("depth-beta-5", "coarse-step-beta-5"):
        claim = LEDGER.claims[name]
        assert claim.computation is not None
        depth = replica_of(LEDGER, claim, claim.computation)(found.witness)
        assert 7.665e-6 <= depth <= 7.675e-6
    for name, value in found.witness.items():
        if not name.startswith("inferred:"):
            low, high = rounding(LEDGER, name)
            assert low <= value <= high


def test_the_ratio_of_the_pair_falls_with_z() -> None:
    def ratio(z: float) -> float:
        return math.log1p(z / 7.65) / math.log1p(z / 9.125)

    assert ratio(2.053) > ratio(20) > ratio(60) > 0.2975 / 0.2775


def test_a_pair_that_is_compatible_is_not_called_impossible() -> None:
    question = next(q for q in CONJECTURES.joint if q.id == "frank-zook-pair")
    assert question.ratio is not None
    wider = replace(question.ratio, common=(Fraction(10**7), Fraction(10**12)))
    found = consistency(LEDGER, replace(question, ratio=wider))
    assert found.outcome == "possible"
    assert found.witness is not None

"""Witnesses of verdicts, what the evidence says of the target density, and misprints judged."""

import math
import re
from collections.abc import Iterator
from fractions import Fraction as F
from functools import cache
from itertools import pairwise

import pytest

from reference.enclosure import Satisfiability, satisfying
from reference.ledger import Convention, load
from reference.scheme import Scheme
from replication.audit import wording
from replication.audit.assessment import Assessment, Judgement, Standing, Verdict
from replication.audit.audit import Audit
from replication.audit.inference import Inference
from replication.audit.record import Record
from replication.audit.replica import replica
from replication.audit.verdict import Judge, assess_equation, follows, is_consistent

LEDGER = load()


def witnesses(judge: Judge) -> Iterator[tuple[str, str, Judgement]]:
    """Every judgement with a witness, with its claim and its reading."""
    for claim in judge.ledger.claims.values():
        if claim.is_computed:
            for reading in judge.assess(claim).readings:
                for judgement in reading.judgements:
                    if judgement.witness is not None:
                        yield claim.id, reading.name, judgement


def test_a_witness_prints_like_the_report_and_gives_the_number(audit: Audit) -> None:
    result = list(witnesses(audit.judge))
    assert len(result) > 10
    for name, reading, judgement in result:
        claim, convention, witness = LEDGER.claims[name], judgement.convention, judgement.witness
        assert witness is not None
        for entry in claim.stated:
            assert LEDGER.claims[entry].as_input(convention).contains(witness[entry]), (name, entry)
        computation = claim.computations[reading]
        inputs = {
            key: math.prod(float(witness[entry]) for entry in entries)
            for key, entries in claim.inputs.items()
        }
        settings: dict[str, object] = {"row": claim.row} if computation.by_row else {}
        if computation.by_scheme:
            settings["scheme"] = convention.scheme
        value = F(replica(computation.name, inputs, **settings))
        margin = abs(value) * F(1, 10**12)  # rounding may place a double just outside an end
        target = claim.target(convention.rounding)
        assert not target.excludes(value - margin, value + margin), name
        for entry in claim.inferred:
            inference = audit.judge.inference(entry, scheme=convention.scheme)
            constraints, box = inference.joint(convention, {entry: (witness[entry],) * 2})
            at_witness = {name: (witness.get(name, low), witness.get(name, high))
                          for name, (low, high) in box.items()}  # fmt: skip
            assert satisfying(constraints, at_witness)[0] is Satisfiability.SHOWN, name


def test_a_witness_has_the_mass_where_the_radius_is_computed_from_it() -> None:
    """7.66 follows if the header of Table A-1 is rounded: then mass and density give the radius."""
    ledger = LEDGER.misprint("depth-beta-5", "7.66")
    claim = ledger.claims["depth-beta-5"]
    (reading,) = Judge(ledger, every_convention=False).assess(claim).readings
    (judgement,) = reading.judgements
    witness = judgement.witness
    assert witness is not None
    assert ledger.claims["a1-mass"].as_input(judgement.convention).contains(witness["a1-mass"])
    volume = float(witness["a1-mass"] / witness["a1-density"])
    point = {**witness, "a1-radius": F(math.cbrt(3 * volume / (4 * math.pi)))}
    inputs = {
        key: math.prod(float(point[entry]) for entry in entries)
        for key, entries in claim.inputs.items()
    }
    depth = F(replica("final_sheet_depth", inputs, scheme=Scheme.PUBLISHED))
    margin = depth * F(1, 10**12)  # rounding may place a double just outside an end
    assert not claim.target().excludes(depth - margin, depth + margin)


def test_models_and_reference_take_another_power_of_goodiers_force_alike() -> None:
    """With n = 3 Eqs. 8 and 9 give q (2a)^3 = pi a^2 R_t: at a = 1 twice what n = 2 gives."""
    judge = Judge(LEDGER.misprint("goodier-power", "3"), every_convention=False)
    claim, expected = judge.ledger.claims["goodier-beta"], pytest.approx(8 * 2.77 / math.pi)
    (reading,) = judge.assess(claim).readings
    assert (judge.modelled(claim), float(reading.reference)) == (expected, expected)


def test_a_number_of_unclear_digits_says_which_were_taken(record: Record) -> None:
    (taken,) = [text for text in record.claim("a1-velocity-initial-1").assumes if "digits" in text]
    assert taken == "all digits of 500 taken as significant; the verdict does not depend on that"


# The target densities that Table A-1 admits

DENSITY = "inferred:target-density"


@cache
def inference(scheme: Scheme = Scheme.PUBLISHED) -> Inference:
    return Inference(LEDGER, DENSITY, scheme=scheme)


def test_rounded_inputs_widen_the_range_of_densities_that_table_a_1_admits() -> None:
    for own in map(inference, Scheme):
        assert own.odd == ()
        (low, high), (outer_low, outer_high) = own.inner.ends, own.outer.ends
        assert outer_low <= low < high <= outer_high
        assert high - low > (outer_high - outer_low) * (1 - F(1, 10**9))
    own = inference()
    with_mass = own.with_mass.ends
    assert [float(end) for end in with_mass] == pytest.approx([7825.14, 7848.857], abs=0.01)
    ranges = [own.inner, own.admitted(Convention()), own.admitted(Convention(choices_exact=False))]
    for narrow, wide in pairwise(ranges):
        assert wide.ends[0] <= narrow.ends[0] < narrow.ends[1] <= wide.ends[1]
    assert own.admitted(Convention(header_exact=True)) == own.outer


def serves(convention: Convention, point: dict[str, F]) -> bool:
    """Whether the evidence can hold at a point, with the other inputs within their rounding."""
    density = point.pop(DENSITY)
    constraints, box = inference().joint(convention, {DENSITY: (density, density)})
    outcome, _ = satisfying(constraints, {**box, **{name: (x, x) for name, x in point.items()}})
    assert outcome is not Satisfiability.UNDECIDED
    return outcome is Satisfiability.SHOWN


def test_a_number_that_contradicts_the_evidence_is_not_said_to_lie_outside_its_range() -> None:
    """Some density gives 2.17E+09 in row 4, but it does not give the other cells."""
    ledger = LEDGER.misprint("a1-deceleration-4", "2.17E+09")
    judge, claim = Judge(ledger, every_convention=False), ledger.claims["a1-deceleration-4"]
    assessed = judge.assess(claim)
    judgement = assessed.readings[0].judgements[0]
    assert judgement.verdict is Verdict.NOT_REPRODUCED
    assert judgement.against_evidence
    assert not claim.interval().excludes(*judgement.ends)
    explanation = wording.explanation(judge, claim, assessed)
    assert "no inputs that give this number also give the numbers" in explanation
    assert "all of it" not in explanation
    assert "none of it" not in explanation


# Misprints judged


@cache
def judge(name: str, text: str) -> Judge:
    """A judge of the report with a misprint."""
    return Judge(LEDGER.misprint(name, text))


def judged(name: str, text: str, claim: str) -> Assessment:
    return judge(name, text).assess(judge(name, text).ledger.claims[claim])


@pytest.mark.parametrize(
    ("name", "text", "claim", "verdict"),
    [
        ("depth-beta-5", "7.76", "depth-beta-5", Verdict.NOT_REPRODUCED),
        ("velocity-521", "522", "figure-1-velocity", Verdict.INCONSISTENT),
        ("mean-diameter", "26", "strain-rate-length", Verdict.INCONSISTENT),
        ("copper-yield", "101", "copper-yield-bound", Verdict.INCONSISTENT),
        ("a1-deceleration-3", "1.45E+09", "a1-deceleration-3", Verdict.NOT_REPRODUCED),
        ("a1-initial-velocity", "400", "a1-velocity-final-1", Verdict.NOT_REPRODUCED),
        ("eq12", r"\pi a^2 = \pi(Dx - D^2)", "contact-diameter-bound", Verdict.NOT_REPRODUCED),
    ],
)
def test_a_misprint_is_noticed(name: str, text: str, claim: str, verdict: Verdict) -> None:
    assert judged(name, text, claim).verdict is verdict


@pytest.mark.parametrize(
    ("claim", "verdict"),
    [
        pytest.param("a1-deceleration-3", Verdict.NOT_REPRODUCED, id="the row itself"),
        pytest.param("a1-deceleration-2", Verdict.REPRODUCED, id="the row before"),
        pytest.param("a1-velocity-final-4", Verdict.REPRODUCED, id="the row after"),
        pytest.param("depth-beta-5", Verdict.REPRODUCED, id="the final depth"),
    ],
)
def test_a_misprinted_row_accuses_no_other_number(claim: str, verdict: Verdict) -> None:
    """Table A-1, row 3: 1.54E+09 m/s^2 is printed with a wrong power of ten."""
    assert judged("a1-deceleration-3", "1.54E+08", claim).verdict is verdict


def test_a_number_repeated_with_fewer_digits_is_consistent() -> None:
    assert is_consistent(LEDGER, LEDGER.claims["figure-1-velocity"])


def test_an_open_bound_does_not_contain_its_end() -> None:
    assert not LEDGER.claims["copper-yield-bound"].target().contains(F(10**8))


def test_a_value_that_cannot_be_computed_says_why() -> None:
    """With Dx - D^2 the contact area of Eq. 12 is negative."""
    assessed = judged("eq12", r"\pi a^2 = \pi(Dx - D^2)", "contact-diameter-bound")
    assert assessed.no_value == "a negative number has no real logarithm, and no real root"


def test_a_length_is_twice_as_many_radii_as_diameters() -> None:
    """Eq. 16 with L/R = 4/3 in the place of L/D = 2/3 gives 0.2005, by hand."""
    text = LEDGER.printed_text("eq16").replace("L/D", "L/R")
    low, high = judged("eq16", text, "frank-zook-rha").readings[0].judgements[0].ends
    assert F("0.199") < low <= F("0.2005") <= high < F("0.202")


def test_a_choice_that_its_claims_no_longer_confirm_has_no_range() -> None:
    own = judge("depth-beta-5", "7.76")
    assert own.confirmed_range(own.ledger.claims["depth-beta-5-beta"]) is None


# The density with misprints in its evidence

CELLS = [
    *(f"a1-deceleration-{row}" for row in range(1, 5)),
    *(f"a1-velocity-final-{row}" for row in range(1, 5)),
]


@pytest.mark.parametrize("text", ["1.45E+09", "1.54E+08"])
def test_a_misprinted_cell_is_the_odd_one(text: str) -> None:
    own = judge("a1-deceleration-3", text).inference(DENSITY)
    assert own.odd == ("a1-deceleration-3",)
    assert own.agreeing == tuple(cell for cell in CELLS if cell not in own.odd)


def test_a_misprinted_cell_leaves_the_nominal_density() -> None:
    own = judge("a1-deceleration-3", "1.54E+08")
    assert own.assumed[DENSITY] == 7850
    assert own.moved == set()


def test_a_misprinted_resistance_moves_the_density() -> None:
    own = judge("a1-resistance", "3.48E+09")
    assert own.moved == {DENSITY}
    assert 7980 < own.assumed[DENSITY] < 8030
    assert own.inference(DENSITY).odd == ()


def test_a_misprinted_velocity_leaves_no_evidence_and_the_nominal_density() -> None:
    own = judge("a1-initial-velocity", "400")
    inferred = own.inference(DENSITY)
    assert (inferred.agreeing, len(inferred.odd)) == ((), len(CELLS))
    assert own.assumed[DENSITY] == 7850
    assert inferred.admitted(Convention()).ends == inferred.entry.search


def test_evidence_without_a_value_bounds_nothing() -> None:
    """A mass of zero leaves none; with a stray symbol in one equation the others remain."""
    without_mass = judge("a1-mass", "0").inference(DENSITY)
    assert without_mass.admitted(Convention()).ends == without_mass.entry.search
    stray = judge("diameter", "D = 2x").inference(DENSITY)
    assert stray.admitted(Convention()) == inference().admitted(Convention())


HEADER = {
    "a1-resistance": F(35 * 10**8), "a1-density": F(8900), "a1-mass": F("4.962e-11"),
}  # fmt: skip
"""The header of Table A-1 as printed, and the sphere's mass."""
SLOWER = {**HEADER, "a1-initial-velocity": F("499.8"), "a-step": F(2, 10**10)}


@pytest.mark.parametrize(
    ("convention", "point", "is_possible"),
    [
        (Convention(), {DENSITY: F(7700)}, False),
        (Convention(), {DENSITY: F(7850)}, True),
        pytest.param(
            Convention(), {DENSITY: F(7900)}, True, id="by hand: R_t = 3.4951E+09 Pa gives it"
        ),
        (Convention(), {DENSITY: F(7850), **HEADER}, True),
        (Convention(), {DENSITY: F(7872), **HEADER}, False),
        pytest.param(
            Convention(choices_exact=False), {DENSITY: F(7850), **SLOWER}, False,
            id="a slower impact needs a denser target",
        ),
        (Convention(choices_exact=False), {DENSITY: F(7872), **SLOWER}, True),
    ],
)  # fmt: skip
def test_the_evidence_holds_at_some_points(
    convention: Convention, point: dict[str, F], is_possible: bool
) -> None:
    assert serves(convention, point) is is_possible


def test_four_steps_narrow_a_rounded_step() -> None:
    """ "0.2 ns" alone would be 0.15 to 0.25, but four steps print 8.00E-10 s."""
    assert inference().rounded("a-step", Convention()) == (F(2, 10**10), F(2, 10**10))
    low, high = inference().rounded("a-step", Convention(choices_exact=False))
    assert float(low) == pytest.approx(1.99875e-10, rel=1e-9, abs=0)
    assert float(high) == pytest.approx(2.00125e-10, rel=1e-9, abs=0)


# Equations with misprints


def test_a_misprint_in_a_premise_reaches_what_is_derived_from_it() -> None:
    ledger = LEDGER.misprint("eq6", r"\Sigma = \frac{1}{2} \rho_t v^3 + R_t")
    failing = [
        name for name in ledger.equations if assess_equation(ledger, name).verdict.is_failure
    ]
    assert failing == ["eq6", "eq13-shallow", "eq13-deep", "eq16", "eqA-1"]


def test_an_equation_that_cannot_be_read_fails() -> None:
    ledger = LEDGER.misprint("eq6", r"\Sigma = \frac{1}{2} \rho_t v^2 + (")
    assert assess_equation(ledger, "eq6").verdict is Verdict.NOT_REPRODUCED
    assert not follows(ledger, "eq6")


@pytest.mark.parametrize(
    "text",
    [
        pytest.param(
            r"X/D = ((L/D \rho_p/\rho_t + k_1)/2kt)\ln(1+k_t\rho_t V^2/R_t)", id="in diameters"
        ),
        pytest.param(
            r"X/R = ((L/D \rho_p/\rho_t + k_1)/kt)\ln(1+k_t\rho_t V^2/R_t)", id="without the 2"
        ),
        pytest.param(
            r"X/R = ((2L/D \rho_p/\rho_t + 2k_1)/2kt)\ln((R_t + k_t\rho_t V^2)/R_t)",
            id="written otherwise",
        ),
    ],
)
def test_equation_16_without_its_fault_follows(text: str) -> None:
    assert follows(LEDGER.misprint("eq16", text), "eq16")


def test_with_two_wrong_constants_none_can_be_accused() -> None:
    ledger = LEDGER.misprint("eq3-factor", "7/3").misprint("eq3-power", "4")
    assessed = assess_equation(ledger, "eq3")
    assert assessed.verdict is Verdict.NOT_REPRODUCED
    verdicts = {constant.verdict for constant in assessed.constants.values()}
    assert verdicts == {Verdict.UNDECIDED}


# Sentences


def test_a_sentence_says_under_which_conventions_a_verdict_becomes_another(
    record: Record,
) -> None:
    for judged in record.claims:
        for reading, scope in zip(judged.assessment.readings, judged.scopes, strict=True):
            holds, _, becomes = scope.partition("; under ")
            assert re.search(" holds under (three|both) ways of rounding", holds)
            assert "becomes" not in holds
            assert bool(becomes) == bool(reading.otherwise), judged.id
            for judgement in reading.otherwise:
                assert f'it becomes "{judgement.verdict}"' in becomes


def test_a_verdict_is_not_said_to_hold_under_what_alone_makes_it_another(record: Record) -> None:
    printed = record.claim("frank-zook-stainless")
    assert printed.scopes[1] == (
        "The verdict holds under three ways of rounding, the author's choices exact and the header "
        "of Table A-1 exact or rounded; under rounded choices of the author it becomes "
        '"reproduced within input rounding".'
    )


# What a reproduced number tells

BY_DEFINITION = {
    "goodier-power", "beta-range-least", "beta-range-greatest", "sphere-length-ratio",
    "particle-radius", "general-sixth", "a-half-step", "a1-radius", "a1-diameter", "a1-resistance",
    "a1-deceleration-0", *(f"a1-time-{row}" for row in range(5)),
    *(f"a1-velocity-initial-{row}" for row in range(1, 5)),
}  # fmt: skip
"""Each scales, multiplies or selects printed numbers: halves, times k dt, 5 times 700."""
REPEATS = {
    "observed-third", "observed-ratio", "discussion-observed", "general-ratio", "general-third",
    "summary-ratio",
}  # fmt: skip
"""0.298 rounded again."""


def test_what_a_reproduced_number_tells(record: Record) -> None:
    told = {c.id: c.assessment.standing for c in record.claims if c.assessment.standing}
    assert {name for name, s in told.items() if s is Standing.BY_DEFINITION} == BY_DEFINITION
    assert {name for name, s in told.items() if s is Standing.REPEATS} == REPEATS
    assert {name for name, s in told.items() if s is Standing.EVIDENCE} == set(CELLS)
    independent = {name for name, s in told.items() if s is Standing.INDEPENDENT}
    assert len(independent) == record.counts.independent == 19
    one_sided = {"contact-diameter-bound", "strength-multiple", "strain-rate", "excess"}
    assert {n for n in independent if "inf" in str(record.claim(n).claim.interval())} == one_sided
    assert record.counts.bounds == len(one_sided)
    assert independent >= {"depth-beta-3", "depth-beta-5", "a1-mass", "observed-depth-ratio"}
    assert len(told) == record.counts.computed


def test_only_what_is_reproduced_tells_something(record: Record) -> None:
    assert record.claim("frank-zook-rha").assessment.standing is None
    assert record.claim("eq2-factor").assessment.standing is None


@pytest.mark.parametrize(
    ("name", "text", "verdict"),
    [
        ("outlier-volume", "750", Verdict.CONSISTENT),  # 11.3 um
        ("outlier-volume", "500", Verdict.INCONSISTENT),  # 9.8 um
        ("outlier-volume", "75000", Verdict.INCONSISTENT),  # 52 um
        ("autodyne-time", "4", Verdict.INCONSISTENT),  # 8.8 ns, before the stop at 26
        ("autodyne-time", "400", Verdict.CONSISTENT),
    ],
)
def test_a_number_that_nothing_computes_is_compared(name: str, text: str, verdict: Verdict) -> None:
    assert judged(name, text, name).verdict is verdict


def test_a_number_differs_from_a_source_only_if_no_reading_of_its_digits_agrees() -> None:
    """300 MPa read as one digit stands for 250 to 350, where 340 lies; 500 does not reach it."""
    assert judged("autodyne-steel-yield", "300", "autodyne-steel-yield").verdict is Verdict.AGREES
    assert judged("autodyne-steel-yield", "500", "autodyne-steel-yield").verdict is Verdict.DIFFERS


def test_a_law_that_is_quoted_is_not_derived_but_a_misprint_in_it_is_told() -> None:
    assert assess_equation(LEDGER, "eq5").verdict is Verdict.NOT_CHECKABLE
    spoiled = assess_equation(LEDGER.misprint("eq5-factor-particle", "1/3"), "eq5")
    assert spoiled.verdict is Verdict.NOT_REPRODUCED
    assert spoiled.constants["eq5-factor-particle"].verdict is Verdict.NOT_REPRODUCED

"""Witnesses of verdicts, what the evidence says of the target density, and misprints judged."""

from collections.abc import Iterator
from fractions import Fraction as F
from functools import cache
from itertools import pairwise
from math import prod

import pytest
from kept import calls

from reference.enclosure import satisfying
from reference.ledger import Convention, load
from reference.scheme import Scheme
from replication.audit import verdict, wording
from replication.audit.inference import Inference
from replication.audit.record import Record, Verdict
from replication.audit.replica import replica
from replication.audit.verdict import Assessment, Judge, Judgement

LEDGER = load()
JUDGE = Judge(LEDGER)


def witnesses() -> Iterator[tuple[str, str, Judgement]]:
    """Every judgement with a witness, with its claim and its reading."""
    for claim in LEDGER.claims.values():
        if claim.is_computed:
            for reading in JUDGE.assess(claim).readings:
                for judgement in reading.judgements:
                    if judgement.witness is not None:
                        yield claim.id, reading.name, judgement


def test_a_witness_prints_like_the_report_and_gives_the_number() -> None:
    result = list(witnesses())
    assert len(result) > 10
    for name, reading, judgement in result:
        claim, convention, witness = LEDGER.claims[name], judgement.convention, judgement.witness
        assert witness is not None
        for entry in claim.stated:
            assert LEDGER.claims[entry].as_input(convention).contains(witness[entry]), (name, entry)
        computation = claim.computations[reading]
        inputs = {
            key: prod(float(witness[entry]) for entry in entries)
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
            inference = JUDGE.inference(entry, scheme=convention.scheme)
            constraints, box = inference.joint(convention, {entry: (witness[entry],) * 2})
            at_witness = {name: (witness.get(name, low), witness.get(name, high))
                          for name, (low, high) in box.items()}  # fmt: skip
            assert satisfying(constraints, at_witness)[0] is True, name


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


def serves(convention: Convention, point: dict[str, F]) -> bool | None:
    """Whether the evidence can hold at a point, with the other inputs within their rounding."""
    density = point.pop(DENSITY)
    constraints, box = inference().joint(convention, {DENSITY: (density, density)})
    return satisfying(constraints, {**box, **{name: (x, x) for name, x in point.items()}})[0]


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


@cache
def judge(name: str, text: str) -> Judge:
    """A judge of the report with a misprint."""
    return Judge(LEDGER.misprint(name, text))


def judged(name: str, text: str, claim: str) -> Assessment:
    return judge(name, text).assess(judge(name, text).ledger.claims[claim])


test_what_evidence_allows_and_how_misprints_are_judged = calls(
    "replication/kept.txt", "Evidence, and misprints judged", vars(verdict) | globals()
)

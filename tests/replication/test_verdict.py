"""A verdict names the conventions under which it holds, and inputs for which it does."""

import random
from collections.abc import Iterator
from fractions import Fraction as F
from functools import cache

from reference.enclosure import enclose, satisfying
from reference.ledger import Convention, load
from replication.audit.record import Record
from replication.audit.replica import REPLICA, replica
from replication.audit.verdict import Judge, Judgement, Reading, restates

LEDGER = load()
JUDGE = Judge(LEDGER)


@cache
def readings(name: str) -> dict[str, Reading]:
    return {r.name: r for r in JUDGE.assess(LEDGER.claims[name]).readings}


# Witnesses


def witnesses() -> Iterator[tuple[str, str, Judgement]]:
    for claim in LEDGER.claims.values():
        if claim.computation is not None and not claim.computation.restates:
            for reading in readings(claim.id).values():
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
        inputs = {}
        for key, entries in claim.inputs.items():
            inputs[key] = 1.0
            for entry in entries:
                inputs[key] *= float(witness[entry])
        settings: dict[str, object] = {"row": claim.row} if computation.by_row else {}
        if computation.by_scheme:
            settings["scheme"] = "centered" if convention.centered else "published"
        value = F(replica(computation.name, inputs, **settings))
        margin = abs(value) * F(1, 10**12)  # a double may fall a rounding short of an end
        target = claim.target(convention.rounding)
        assert not target.excludes(value - margin, value + margin), name
        for entry in claim.inferred:
            inference = JUDGE.inference(entry, centered=convention.centered)
            constraints, box = inference.joint(convention, {entry: (witness[entry],) * 2})
            there = {name: (witness.get(name, low), witness.get(name, high))
                     for name, (low, high) in box.items()}  # fmt: skip
            assert satisfying(constraints, there)[0] is True, name


def test_no_inputs_drawn_at_random_give_what_is_called_impossible() -> None:
    draw = random.Random(2006)
    for name in ("frank-zook-rha", "frank-zook-stainless"):
        for reading in readings(name).values():
            claim, computation = LEDGER.claims[name], LEDGER.claims[name].computations[reading.name]
            for judgement in reading.judgements:
                whole = JUDGE.box(claim, judgement.convention)
                for _ in range(50):
                    at = {
                        key: float(draw.choice([low, high, low + (high - low) * F(draw.random())]))
                        for key, (low, high) in whole.items()
                    }
                    inputs = {key: at[entry] for key, (entry,) in claim.inputs.items()}
                    value = F(REPLICA[computation.name](**inputs))
                    slack = value * F(1, 10**14)
                    assert judgement.ends[0] - slack <= value <= judgement.ends[1] + slack


def test_a_number_of_unclear_digits_says_which_were_taken(record: Record) -> None:
    (said,) = [text for text in record.claim("a1-velocity-initial-1").assumes if "digits" in text]
    assert said == "all digits of 500 taken as significant; the verdict does not depend on that"


# Other numbers than the report's


def test_a_wrong_depth_lies_outside_what_any_inputs_give() -> None:
    wrong = LEDGER.misprint("depth-beta-5", "7.76")
    claim = wrong.claims["depth-beta-5"]
    result = enclose(wrong.function(claim), Judge(wrong).box(claim, Convention()))
    assert claim.target().excludes(*result.ends)


def test_restatements_agree_if_some_value_prints_like_both() -> None:
    claim = LEDGER.claims["figure-1-velocity"]
    assert restates(LEDGER, claim, {})
    assert not restates(LEDGER, claim, {"velocity-521": F(522)})
    about = LEDGER.claims["strain-rate-length"]  # about 20 um; the mean is 22
    assert not restates(LEDGER, about, {"mean-diameter": F(26, 10**6)})
    assert not restates(LEDGER, LEDGER.claims["copper-yield-bound"], {"copper-yield": F(10**8)})

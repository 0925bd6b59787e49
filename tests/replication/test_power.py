"""What the audit notices of planted misprints, and that a quick judgement is that of the whole."""

import random

import pytest

from reference.ledger import load
from replication.audit.audit import Audit
from replication.audit.verdict import OPEN, Verdict
from replication.power import Plant, measured, plants, power, trial

LEDGER = load()
EVERYTHING = list(plants(LEDGER))
TRUTH = Audit(LEDGER, every_convention=False)


def plant(entry: str, text: str) -> Plant:
    return next(p for p in EVERYTHING if (p.entry, p.text) == (entry, text))


def test_every_number_and_every_equation_gets_misprints() -> None:
    numbers = {claim.id for claim in LEDGER.claims.values() if claim.printed is not None}
    without = {"strength-multiple"}  # "several times" has no other word in its place
    assert {p.entry for p in EVERYTHING} == (numbers | set(LEDGER.equations)) - without


def test_a_misprint_that_no_digit_tells_is_invisible() -> None:
    outcome = trial(TRUTH, plant("autodyne-time", "41"))
    assert not outcome.visible
    assert not outcome.failing


@pytest.mark.slow
def test_the_rates_on_the_page_are_measured_again() -> None:
    rates = measured()
    assert power(LEDGER, rates.planted, rates.seed, lambda plants: plants) == rates


@pytest.mark.slow
def test_judging_what_depends_on_a_plant_is_judging_everything() -> None:
    """On 50 plants: no claim or equation elsewhere fails because of one."""
    for first in random.Random(3).sample(EVERYTHING, 50):
        outcome = trial(TRUTH, first)
        audit = Audit(LEDGER.misprint(first.entry, first.text), every_convention=False)
        worse = {*OPEN, Verdict.DIFFERS}
        everything = {
            name
            for name, claim in audit.ledger.claims.items()
            if audit.assessment(claim).verdict in worse
            and TRUTH.assessment(LEDGER.claims[name]).verdict not in worse
        }
        everything |= {
            name
            for name in audit.ledger.equations
            if audit.equation(name).verdict.is_failure
            and audit.equation(name).checks != TRUTH.equation(name).checks
        }
        assert everything == outcome.failing, first


def test_the_rates_of_a_small_sample_hold() -> None:
    result = power(LEDGER, sample=60, seed=1, progress=lambda plants: plants)
    assert result.planted == 60 == result.visible + result.invisible
    assert result.detected == result.visible
    assert result.repaired >= 0.95 * result.visible
    assert result.repaired_first >= 0.8 * result.visible
    assert result.unnoticed == []
    assert sum(counts.planted for counts in result.by_kind.values()) == 60
    assert sum(counts.planted for counts in result.by_edit.values()) == 60

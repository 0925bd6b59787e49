"""What the audit notices of planted misprints, and that a quick judgement is that of the whole.

The rates of a small sample stand in `said.txt`.
"""

import random

import pytest
from kept import kept

from reference.ledger import load
from replication.audit.audit import Audit
from replication.power import Plant, measured, plants, power, trial

LEDGER = load()
EVERYTHING = list(plants(LEDGER))
TRUTH = Audit(LEDGER, every_convention=False)


def test_every_number_and_every_equation_gets_misprints() -> None:
    numbers = {claim.id for claim in LEDGER.claims.values() if claim.printed is not None}
    without = {"strength-multiple"}  # "several times" has no other word in its place
    assert {p.entry for p in EVERYTHING} == (numbers | set(LEDGER.equations)) - without


@kept("replication/kept.txt", "Planted misprints, and what fails by them")
def test_a_planted_misprint_is_noticed_where_it_should_be(question: str, answer: str) -> None:
    name, text = question.split(": ")
    failing, counts = trial(TRUTH, Plant(name, LEDGER.printed_text(name), text, ""))
    assert ", ".join(sorted(failing)) == answer.removesuffix("nothing")
    assert counts.visible == bool(failing)


@pytest.mark.slow
def test_the_rates_on_the_page_are_measured_again() -> None:
    rates = measured()
    assert power(LEDGER, rates.planted, rates.seed, lambda plants: plants) == rates


@pytest.mark.slow
def test_judging_what_depends_on_a_plant_is_judging_everything() -> None:
    """On 50 plants: no claim or equation elsewhere fails because of one."""
    for first in random.Random(3).sample(EVERYTHING, 50):
        failing, _ = trial(TRUTH, first)
        audit = Audit(LEDGER.misprint(first.entry, first.text), every_convention=False)
        everything = {
            name
            for name, claim in audit.ledger.claims.items()
            if audit.assessment(claim).verdict.is_doubtful
            and not TRUTH.assessment(LEDGER.claims[name]).verdict.is_doubtful
        }
        everything |= {
            name
            for name in audit.ledger.equations
            if audit.equation(name).verdict.is_failure
            and audit.equation(name).checks != TRUTH.equation(name).checks
        }
        assert everything == failing, first

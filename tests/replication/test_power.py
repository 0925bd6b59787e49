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


def test_every_number_and_every_equation_gets_misprints() -> None:
    numbers = {claim.id for claim in LEDGER.claims.values() if claim.printed is not None}
    without = {"strength-multiple"}  # "several times" has no other word in its place
    assert {p.entry for p in EVERYTHING} == (numbers | set(LEDGER.equations)) - without


PLANTED = {
    # In a number of the text, a result, an exponent, a fraction, a word, the table, an equation.
    ("mean-diameter", "32"): {
        "a1-radius", "contact-diameter-bound", "figure-3-diameter", "observed-depth-diameter",
        "particle-radius", "particle-volume-diameter", "strain-rate-length",
    },
    ("particle-volume", "7555"): {"particle-volume"},
    ("a1-mass", "4.96E-12"): {"a1-mass"},
    ("goodier-q", "2.97"): {"goodier-q", "goodier-beta"},
    ("time-step", "0.3"): {"time-step"},
    ("a1-velocity-final-2", "5.01E+02"): {"a1-velocity-final-2"},
    ("velocity-count", "Five"): {"velocity-count"},
    ("general-sixth", "one-fifth"): set(),  # "less than": true of a fifth, too
    ("autodyne-time", "41"): set(),  # no digit tells
    ("strength-multiple", "four"): {"strength-multiple"},
    ("copper-yield-bound", "80"): {"copper-yield-bound"},
    ("observed-depth-ratio", "0.277"): {"observed-depth-ratio", "frank-zook-below-observed"},
    ("sphere-length-ratio", "1/2"): {"sphere-length-ratio"},
    ("initial-depth", "1"): {"eq2-domain", "eq13-domain", "a1-depth-0", "a1-deceleration-0"},
    ("eq8-multiple", "3"): {"goodier-q", "goodier-beta"},
    ("eq10-factor", "3/3"): {"walker-anderson-beta"},
    ("eq11-power", "1/2"): {
        "eq11", "eq11-power", "walker-anderson-alpha", "walker-anderson-beta",
    },
    ("eq3-power", "2"): {"eq3", "eq3-power", "particle-volume", "a1-mass"},
    ("eqA-3", r"\pi a^2 = \pi(Dx + x^2)"): {"eqA-3"},  # its area at x = 0 is 0 all the same
}  # fmt: skip


@pytest.mark.parametrize(("name", "text"), PLANTED)
def test_a_planted_misprint_is_noticed_where_it_should_be(name: str, text: str) -> None:
    outcome = trial(TRUTH, Plant(name, LEDGER.printed_text(name), text, ""))
    assert outcome.failing == PLANTED[name, text]
    assert outcome.visible == bool(outcome.failing)


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

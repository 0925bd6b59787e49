"""Misprints: in equations they are noticed, in numbers explained; the rate is measured."""

import random
import re
from fractions import Fraction as F

import pytest
from kept import kept

from reference.equations import EquationError
from reference.ledger import Ledger, load
from replication.audit.audit import Audit, audit
from replication.audit.explain import (
    EQUATION_EDITS,
    Explainer,
    edits,
    equation_edits,
)
from replication.audit.record import Verdict
from replication.audit.verdict import Judge, assess_equation, disagreeing, follows
from replication.power import Plant, measured, new_failures, plants, power, trial

LEDGER = load()
PAIR = ("frank-zook-rha", "frank-zook-stainless")


@kept("replication/kept.txt", "Edits of a number's text, one slip each")
def test_edits_of_words_and_of_the_reports_powers(question: str, answer: str) -> None:
    assert ", ".join(f"{text} ({kind})" for text, kind in edits(question)) == answer


def test_edits_of_an_equation() -> None:
    result = dict(equation_edits(LEDGER, "eq16"))
    assert set(result.values()) == set(EQUATION_EDITS)
    sides = {text: LEDGER.misprint("eq16", text).sides["eq16"] for text in result}
    same = {text for text in result if sides[text] == LEDGER.sides["eq16"]}
    for text in same:  # an edit that leaves no equation has no effect
        with pytest.raises(EquationError):
            LEDGER.read(text)
    assert len(same) == 2
    assert r"X/R = ((L/D \rho_p/\rho_t + k_1)/kt)\ln(1+k_t\rho_t V^2/R_t)" in result


@kept("replication/kept.txt", "Misprints, and what mends the number that fails by them")
def test_the_original_mends_what_a_misprint_spoils(question: str, answer: str) -> None:
    name, text, failing = re.split(": | spoils ", question)
    ledger = LEDGER.misprint(name, text)
    result = Explainer(Judge(ledger)).repairs(failing)
    (repair,) = [r for r in result if (r.entry, r.text) == (name, LEDGER.claims[name].text)]
    assert set(repair.failing) <= {"eq16", *PAIR, "eq16-denominator"}
    left = [len(r.failing) for r in result if not r.reading]
    assert left == sorted(left)
    texts = [f"{r.entry}: {r.text}" + f" if {r.reading}" * bool(r.reading) for r in result]
    assert "; ".join(texts) == answer


def test_a_report_without_its_faults_has_none_and_one_fault_is_found_as_the_culprit() -> None:
    repaired = LEDGER.misprint("eq16-denominator", "1")
    for name, derived in zip(PAIR, ("0.255", "0.300"), strict=True):
        repaired = repaired.misprint(name, derived)
    sound = audit(repaired)
    assert sound.counts.failing == 0
    assert sound.culprit is None
    assert sound.headline == "0 numbers fail.", "the usual one has lost its evidence"
    spoiled = audit(repaired.misprint("fz-kt", "1.406"))
    assert spoiled.culprit is not None
    assert (spoiled.culprit.entry, spoiled.culprit.text) == ("fz-kt", "1.046")
    assert set(spoiled.failing) == set(PAIR)
    single = audit(repaired.misprint("a1-deceleration-4", "2.17E+09"))
    assert single.headline == "1 number fails."


def test_evidence_that_a_misprint_takes_away_leaves_its_findings_open() -> None:
    slip = next(text for text in dict(equation_edits(LEDGER, "eq16")) if r"\alpha" in text)
    findings = audit(LEDGER.misprint("eq16", slip)).findings
    assert {finding.id for finding in findings if not finding.holds} >= {"equation-16"}


# The checks of an equation notice all its misprints but those listed here

ASSUMED = {f"inferred:{name}": entry.nominal for name, entry in LEDGER.inferred.items()}


def state(ledger: Ledger, name: str) -> tuple[Verdict, *tuple[object, ...]]:
    """The verdict on an equation, its factor, and which of its checks hold."""
    assessed = assess_equation(ledger, name, constants=False)
    return assessed.verdict, assessed.factor, tuple(check.holds for check in assessed.checks)


# The edits that no check of their equation notices. The report takes these three equations from
# the literature, so nothing in it determines the exponent of Eq. 1, Goodier's q and (2a), and
# Walker and Anderson's 7/3. Each edit changes the meaning of its equation.
UNNOTICED = {
    "eq1": ["V_p = V(m_o/m)^{2/1}"],
    "eq8": [rf"F_r = {q} (2a)^n" for q in (r"\Sigma", "Y_p", "R_t", "Y_t", "E_t")]
    + [rf"F_r = q ({r})^n" for r in ("a", "2X", "2x", "2R", "2D", "2L")],
    "eq10": [r"\beta = 3/7 \ln(\alpha)", r"\beta = 7/3 \log(\alpha)"],
}


@pytest.mark.parametrize("name", LEDGER.equations)
def test_the_checks_of_an_equation_notice_every_other_edit(name: str) -> None:
    edits = {edit for edit, _ in equation_edits(LEDGER, name)}
    assert len(edits) >= 11
    printed = state(LEDGER, name)
    unnoticed = set()
    for edit in edits:
        changed = LEDGER.misprint(name, edit)
        edited = state(changed, name)
        assert follows(changed, name) == (not edited[0].is_failure)
        if edited == printed:
            unnoticed.add(edit)
    assert unnoticed == set(UNNOTICED.get(name, []))


@pytest.mark.parametrize(
    ("name", "computed"), [("eq8", "goodier-beta"), ("eq10", "walker-anderson-beta"), ("eq1", None)]
)
def test_a_claim_computed_with_the_equation_fails_by_the_rest(
    name: str, computed: str | None
) -> None:
    """No claim is computed with Eq. 1: its power is evidence of a finding only."""
    as_printed = disagreeing(LEDGER, LEDGER.claims, ASSUMED)
    for edit in UNNOTICED[name]:
        failing = disagreeing(LEDGER.misprint(name, edit), LEDGER.claims, ASSUMED)
        assert computed in failing if computed else failing == as_printed, edit


EXPECTED = {
    "eq16": "not reproduced",  # Eqs. 14 and 15 give twice the depth in radii that it prints
    **dict.fromkeys(("eq1", "eq8", "eq10", "eq14"), "not checkable"),  # taken over
    **dict.fromkeys(("eq7", "eqA-2"), "consistent"),  # definitions
}


@pytest.mark.parametrize("name", LEDGER.equations)
def test_equation(name: str) -> None:
    assessed = assess_equation(LEDGER, name)
    assert follows(LEDGER, name) != assessed.verdict.is_failure
    assert assessed.verdict == EXPECTED.get(name, "reproduced")
    assert assessed.factor == (F(1, 2) if name == "eq16" else None)
    assert set(assessed.constants) == set(LEDGER.constants_of(name))
    checks = [check.says for check in assessed.checks]
    assert len(set(checks)) == len(checks)
    assert checks or name == "eq8"


# Planted misprints; `said.txt` has the rates of a small sample

EVERYTHING = list(plants(LEDGER))
TRUTH = Audit(LEDGER, every_convention=False)


def test_every_number_and_every_equation_gets_misprints() -> None:
    numbers = {claim.id for claim in LEDGER.claims.values() if claim.printed is not None}
    without = {"strength-multiple"}  # no other word is tried for "several times"
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
    """Of 50 plants none makes a claim or an equation fail that does not depend on it."""
    for plant in random.Random(3).sample(EVERYTHING, 50):
        failing, _ = trial(TRUTH, plant)
        audit = Audit(LEDGER.misprint(plant.entry, plant.text), every_convention=False)
        assert new_failures(TRUTH, audit, LEDGER.claims, LEDGER.equations) == failing, plant

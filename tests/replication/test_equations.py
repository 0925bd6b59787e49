"""A misprint in an equation is seen, whatever it is; what is not seen is listed and judged."""

from fractions import Fraction as F

import pytest

from reference.ledger import Ledger, load
from replication.audit.explain import Screen, equation_edits
from replication.audit.verdict import Judge, Verdict, assess_equation, follows

LEDGER = load()
ASSUMED = {f"inferred:{name}": entry.nominal for name, entry in LEDGER.inferred.items()}


def state(ledger: Ledger, name: str) -> tuple[Verdict, *tuple[object, ...]]:
    assessed = assess_equation(ledger, name, constants=False)
    return assessed.verdict, assessed.factor, tuple(check.holds for check in assessed.checks)


# The edits that no check of their equation sees. All three equations are taken over from literature
# that the report does not derive: the exponent of Eq. 1, Goodier's q and (2a), and Walker and
# Anderson's 7/3 are theirs to say. None of the edits means the same as what is printed.
UNSEEN = {
    "eq1": ["V_p = V(m_o/m)^{2/1}"],
    "eq8": [rf"F_r = {q} (2a)^n" for q in (r"\Sigma", "Y_p", "R_t", "Y_t", "E_t")]
    + [rf"F_r = q ({r})^n" for r in ("a", "2X", "2x", "2R", "2D", "2L")],
    "eq10": [r"\beta = 3/7 \ln(\alpha)", r"\beta = 7/3 \log(\alpha)"],
}


@pytest.mark.parametrize("name", LEDGER.equations)
def test_the_checks_of_an_equation_see_every_other_edit(name: str) -> None:
    edits = {edit for edit, _ in equation_edits(LEDGER, name)}
    assert len(edits) >= 11
    printed = state(LEDGER, name)
    unseen = set()
    for edit in edits:
        changed = LEDGER.misprint(name, edit)
        edited = state(changed, name)
        # What remainders refuse quickly, polynomials refuse, and the other way round.
        assert follows(changed, name) == (not edited[0].is_failure)
        if edited == printed:
            unseen.add(edit)
    assert unseen == set(UNSEEN.get(name, []))


@pytest.mark.parametrize(
    ("name", "seen"), [("eq8", "goodier-beta"), ("eq10", "walker-anderson-beta"), ("eq1", None)]
)
def test_what_is_computed_with_an_equation_sees_the_rest(name: str, seen: str | None) -> None:
    """With Eq. 1 none is: only the finding on it has its power as evidence."""
    as_printed = Screen(LEDGER, ASSUMED).failing(LEDGER.claims)
    for edit in UNSEEN[name]:
        failing = Screen(LEDGER.misprint(name, edit), ASSUMED).failing(LEDGER.claims)
        assert seen in failing if seen else failing == as_printed, edit


def test_what_is_no_equation_at_all_follows_from_nothing() -> None:
    changed = LEDGER.misprint("eq6", r"\Sigma = \frac{1}{2} \rho_t v^2 + (")
    assert assess_equation(changed, "eq6").verdict.is_failure
    assert not follows(changed, "eq6")


def test_equation_16_would_follow_for_a_depth_in_diameters_or_without_the_2() -> None:
    for text in (
        r"X/D = ((L/D \rho_p/\rho_t + k_1)/2kt)\ln(1+k_t\rho_t V^2/R_t)",
        r"X/R = ((L/D \rho_p/\rho_t + k_1)/kt)\ln(1+k_t\rho_t V^2/R_t)",
        r"X/R = ((2L/D \rho_p/\rho_t + 2k_1)/2kt)\ln((R_t + k_t\rho_t V^2)/R_t)",
    ):
        assert follows(LEDGER.misprint("eq16", text), "eq16"), text


def test_a_premise_that_is_misprinted_is_missed_by_what_follows_from_it() -> None:
    changed = LEDGER.misprint("eq6", r"\Sigma = \frac{1}{2} \rho_t v^3 + R_t")
    for name in ("eq13-shallow", "eq13-deep", "eqA-1"):
        assert assess_equation(changed, name).verdict.is_failure
    assert not assess_equation(changed, "eq12").verdict.is_failure


# Verdicts

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
    said = [check.says for check in assessed.checks]
    assert len(set(said)) == len(said)
    assert said or name == "eq8"


def test_a_misprint_that_leaves_a_claim_without_a_value() -> None:
    changed = LEDGER.misprint("eq12", r"\pi a^2 = \pi(Dx - D^2)")  # the root of a negative number
    assessment = Judge(changed).assess(changed.claims["contact-diameter-bound"])
    assert assessment.verdict is Verdict.NOT_REPRODUCED
    assert "no real root" in assessment.reason


def test_two_misprints_in_one_equation_leave_its_constants_undecided() -> None:
    changed = LEDGER.misprint("eq3-factor", "7/3").misprint("eq3-power", "4")
    assessed = assess_equation(changed, "eq3")
    assert assessed.verdict.is_failure
    assert {c.verdict for c in assessed.constants.values()} == {"undecided"}

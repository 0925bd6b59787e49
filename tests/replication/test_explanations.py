"""What would explain a failing number: back-solved inputs, misprints, slips, a common culprit."""

import re
from fractions import Fraction as F
from functools import cache
from itertools import takewhile

import pytest
from hypothesis import given
from hypothesis import strategies as st
from kept import kept

from reference.enclosure import Solutions
from reference.equations import EquationError
from reference.ledger import Ledger, load
from replication.audit.audit import audit
from replication.audit.explain import (
    EQUATION_EDITS,
    NUMBER_EDITS,
    Explainer,
    edits,
    equation_edits,
)
from replication.audit.replica import replica
from replication.audit.verdict import Judge

LEDGER = load()
EXPLAINER = Explainer(Judge(LEDGER))
DERIVED = "derived from Eqs. 14 and 15"
PAIR = ("frank-zook-rha", "frank-zook-stainless")


@cache
def solved(claim: str) -> dict[tuple[str, str], Solutions]:
    own = LEDGER.claims[claim]
    return {
        (b.reading, b.entry): EXPLAINER.solutions(own, b.reading, b.entry)
        for b in EXPLAINER.back_solved(own)
    }


def value(claim: str, reading: str, entry: str, x: F) -> F:
    """The replica's answer with one entry changed."""
    own = LEDGER.claims[claim]
    inputs = {
        key: float(x if name == entry else EXPLAINER.judge.value(name))
        for key, (name,) in own.inputs.items()
    }
    return F(replica(own.computations[reading].name, inputs))


# Back-solving


@pytest.mark.parametrize("claim", PAIR)
def test_solutions_give_the_number_and_what_is_excluded_does_not(claim: str) -> None:
    target = LEDGER.claims[claim].target()
    assert set(solved(claim)) == {
        (reading, entry) for reading in ("", DERIVED) for entry in LEDGER.claims[claim].entries
    }
    for (reading, entry), result in solved(claim).items():
        for low, high in result.inner:
            for share in (F(1, 100), F(1, 2), F(99, 100)):
                x = low + share * (high - low)
                assert target.contains(value(claim, reading, entry, x)), entry
        low, high = result.search
        for k in range(21):
            x = low * F(float(high / low) ** (k / 20))
            if not any(a <= x <= b for a, b in result.outer):
                assert not target.contains(value(claim, reading, entry, x)), entry
        assert bool(result.inner) == bool(result.outer), "nothing is undecided"


def test_a_choice_whose_claims_disagree_is_shown_by_none() -> None:
    ledger = LEDGER.misprint("depth-beta-5", "7.76")
    assert Explainer(Judge(ledger)).shown(ledger.claims["depth-beta-5-beta"]) is None


# Edits

NUMBERS = st.one_of(
    st.decimals(0, 9999, places=3, allow_nan=False).map(str),
    st.integers(1, 9999).map(str),
    st.tuples(st.integers(100, 999), st.integers(-20, 20)).map(
        lambda pair: f"{pair[0] / 100:.2f}E{pair[1]:+03d}"
    ),
)


def common(a: str, b: str) -> int:
    """How many characters two texts begin with in common."""
    return len(list(takewhile(lambda pair: pair[0] == pair[1], zip(a, b, strict=False))))


def are_one_slip_apart(a: str, b: str) -> bool:
    """Whether, but for their beginning and end in common, a character or a swap is left."""
    a, b = a[common(a, b) :], b[common(a, b) :]
    end = common(a[::-1], b[::-1])
    a, b = a[: len(a) - end], b[: len(b) - end]
    return max(len(a), len(b)) <= 1 or (len(a) == 2 and a == b[::-1])


@given(NUMBERS)
def test_every_edit_of_a_number_is_one_slip_away_and_stands_once(text: str) -> None:
    result = list(edits(text))
    assert len({edited for edited, _ in result} | {text}) == len(result) + 1
    for edited, kind in result:
        mantissa, _, power = text.partition("E")
        another, _, shifted = edited.partition("E")
        if kind == "exponent changed":
            assert another == mantissa
            assert int(shifted) in (int(power) - 1, int(power) + 1, -int(power))
        else:
            assert shifted == power
            assert are_one_slip_apart(mantissa.replace(".", ""), another.replace(".", ""))
            assert kind in NUMBER_EDITS


@kept("replication/kept.txt", "Edits of a number's text, one slip each")
def test_edits_of_words_and_of_the_reports_powers(question: str, answer: str) -> None:
    assert ", ".join(f"{text} ({kind})" for text, kind in edits(question)) == answer


def test_edits_of_an_equation() -> None:
    result = dict(equation_edits(LEDGER, "eq16"))
    assert set(result.values()) == set(EQUATION_EDITS)
    sides = {text: LEDGER.misprint("eq16", text).sides["eq16"] for text in result}
    same = {text for text in result if sides[text] == LEDGER.sides["eq16"]}
    for text in same:  # only where the edit leaves no equation
        with pytest.raises(EquationError):
            LEDGER.read(text)
    assert len(same) == 2
    assert r"X/R = ((L/D \rho_p/\rho_t + k_1)/kt)\ln(1+k_t\rho_t V^2/R_t)" in result


# Misprints


@kept("replication/kept.txt", "Misprints, and what mends the number that fails by them")
def test_the_original_mends_what_a_misprint_spoils(question: str, answer: str) -> None:
    name, text, failing = re.split(": | spoils ", question)
    ledger = LEDGER.misprint(name, text)
    result = Explainer(Judge(ledger)).repairs(failing)
    (repair,) = [r for r in result if (r.entry, r.text) == (name, LEDGER.claims[name].text)]
    assert set(repair.failing) <= {"eq16", *PAIR, "eq16-denominator"}
    left = [len(r.failing) for r in result if not r.reading]
    assert left == sorted(left)
    told = [f"{r.entry}: {r.text}" + f" if {r.reading}" * bool(r.reading) for r in result]
    assert "; ".join(told) == answer


def repaired() -> Ledger:
    """The report with the factor of Eq. 16 and both values as derived."""
    return (
        LEDGER.misprint("eq16-denominator", "1")
        .misprint("frank-zook-rha", "0.255")
        .misprint("frank-zook-stainless", "0.300")
    )


def test_a_report_without_its_faults_has_none_and_one_fault_is_found_as_the_culprit() -> None:
    sound = audit(repaired())
    assert sound.counts.failing == 0
    assert sound.culprit is None
    assert sound.headline == "0 numbers fail.", "the usual one has lost its evidence"
    spoiled = audit(repaired().misprint("fz-kt", "1.406"))
    assert spoiled.culprit is not None
    assert (spoiled.culprit.entry, spoiled.culprit.text) == ("fz-kt", "1.046")
    assert set(spoiled.failing) == set(PAIR)


# Slips


def test_a_slip_that_fits_is_said_to() -> None:
    for text, fits in (
        ("0.328", "as printed"),
        ("0.327", "not excluded within rounding"),
        ("0.4", ""),
    ):
        ledger = LEDGER.misprint(PAIR[0], text)
        tried = Explainer(Judge(ledger)).slips(ledger.claims[PAIR[0]])
        assert next(t.fits for t in tried if t.name == "L/D = 1") == fits
    assert all(slip.reason for slip in LEDGER.slip)

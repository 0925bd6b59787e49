"""The family of slips in Eq. 16: generated from parts, counted, and compared with chance."""

from collections import Counter
from itertools import product
from math import log, log10

import pytest

from reference.ledger import load
from replication.audit.results import Results
from replication.audit.slips import (
    TYPED,
    Eq16Inputs,
    Member,
    Slip,
    base_10,
    densities_exchanged,
    density_ratio_inverted,
    density_ratio_on_k_1,
    divisor_left_out,
    doubled,
    drag_inverted,
    family,
    half_for_k_t,
    k_1_doubled,
    k_1_subtracted,
    length_ratio_inverted,
    multiplied_by_k_t,
    numbers_named,
    one_left_out,
    one_minus,
    sum_without_brackets,
    with_slips,
)

LEDGER = load()
RESULTS = Results(LEDGER)
ARMOR, STAINLESS = (LEDGER.claims[f"frank-zook-{target}"] for target in ("rha", "stainless"))
X = Eq16Inputs(L_D=2 / 3, rho_p=8900.0, rho_t=7850.0, k_1=0.557, k_t=1.046, V=500.0, R_t=9.13e9)
Y = Eq16Inputs(L_D=2 / 3, rho_p=8900.0, rho_t=7850.0, k_1=0.557, k_t=1.046, V=500.0, R_t=7.6e9)
SUM = 2 / 3 * 8900 / 7850 + 0.557
LN_ARMOR, LN_STEEL = (log(1 + 1.046 * 7850 * 500**2 / R_t) for R_t in (9.13e9, 7.6e9))


def test_without_a_slip_it_is_eq_16_as_printed() -> None:
    z = 1.046 * 7850 * 500**2 / 9.13e9
    printed = (2 / 3 * 8900 / 7850 + 0.557) / (2 * 1.046) * log(1 + z)
    assert with_slips(()).depth(X) == pytest.approx(printed, rel=1e-14, abs=0)


@pytest.mark.parametrize(
    ("member", "inputs", "value"),
    [
        ((multiplied_by_k_t, doubled), X, SUM * 1.046 * LN_ARMOR),
        ((multiplied_by_k_t,), X, SUM * 1.046 * LN_ARMOR / 2),
        ((multiplied_by_k_t, doubled), Y, SUM * 1.046 * LN_STEEL),
        ((density_ratio_on_k_1, doubled), Y, (2 / 3 + 0.557 * 8900 / 7850) / 1.046 * LN_STEEL),
        ((density_ratio_on_k_1, doubled), X, (2 / 3 + 0.557 * 8900 / 7850) / 1.046 * LN_ARMOR),
        ((base_10,), X, SUM / 2.092 * LN_ARMOR / log(10)),
        ((density_ratio_inverted, k_1_doubled), X,
         (2 / 3 * 7850 / 8900 + 1.114) / 2.092 * LN_ARMOR),
        ((length_ratio_inverted, k_1_subtracted), X,
         (1.5 * 8900 / 7850 - 0.557) / 2.092 * LN_ARMOR),
        ((multiplied_by_k_t, half_for_k_t), X, SUM / (2 / 0.5) * LN_ARMOR),
        ((drag_inverted, one_left_out), X, SUM / 2.092 * log(9.13e9 / (1.046 * 7850 * 500**2))),
        ((one_minus,), X, SUM / 2.092 * -log(1 - 1.046 * 7850 * 500**2 / 9.13e9)),
        ((sum_without_brackets, k_1_subtracted), X,
         2 / 3 * 8900 / 7850 - 0.557 / 2.092 * LN_ARMOR),
    ],
    ids=[
        "no brackets, doubled",
        "no brackets",
        "the same, steel",
        "on k_1, steel",
        "on k_1",
        "LOG",
        "two in the bracket",
        "two others in the bracket",
        "two in the divisor",
        "two in the logarithm",
        "a sign dropped",
        "a sum without brackets subtracted",
    ],
)  # fmt: skip
def test_slips_computed_apart(member: Member, inputs: Eq16Inputs, value: float) -> None:
    assert with_slips(member).depth(inputs) == pytest.approx(value, rel=1e-14, abs=0)


def test_a_slip_in_a_part_that_there_is_not_is_refused() -> None:
    with pytest.raises(TypeError, match="densty"):
        with_slips((Slip("densty", "no density", lambda x: 1.0),))


def test_every_slip_changes_the_value_and_only_two_do_it_alike() -> None:
    values = Counter(round(with_slips((slip,)).depth(X), 12) for slip in TYPED)
    assert round(with_slips(()).depth(X), 12) not in values
    # With 1/2 for k_t the divisor is 1, as if there were none.
    assert sum(values.values()) - len(values) == 1
    assert with_slips((half_for_k_t,)).depth(X) == pytest.approx(
        with_slips((divisor_left_out,)).depth(X), rel=1e-14
    )


def test_the_family_has_each_slip_each_pair_and_each_pair_doubled() -> None:
    slips = [*TYPED, *numbers_named(LEDGER, X)]
    members = family(LEDGER, X)
    parts = Counter(slip.part for slip in slips)
    pairs = (len(slips) ** 2 - sum(count**2 for count in parts.values())) // 2
    without_scale = [slip for slip in slips if slip.part != "scale"]
    rest = Counter(slip.part for slip in without_scale)
    doubled_pairs = (len(without_scale) ** 2 - sum(count**2 for count in rest.values())) // 2
    assert len(members) == 1 + len(slips) + pairs + doubled_pairs
    assert len(set(members)) == len(members)


def test_two_slips_within_one_bracket_are_members() -> None:
    members = {frozenset(member) for member in family(LEDGER, X)}
    within = [("density_ratio", "k_1"), ("length_ratio", "sign"), ("k_t_below", "divisor"),
              ("fraction", "argument"), ("k_t_above", "power"), ("terms", "k_1")]  # fmt: skip
    for parts in within:
        first, second = ([slip for slip in TYPED if slip.part == part] for part in parts)
        assert {frozenset(pair) for pair in product(first, second)} <= members


def test_a_number_in_use_is_no_slip() -> None:
    named = [slip.says for slip in numbers_named(LEDGER, X)]
    assert not any("9.13" in says for says in named)
    assert any("7.6" in says for says in named)


@pytest.mark.parametrize(
    ("claim", "name"),
    [
        (ARMOR, "/2*k_t typed without brackets, which multiplies by k_t; X/R is twice X/D"),
        (STAINLESS, "the density ratio on k_1 in place of L/D; X/R is twice X/D"),
    ],
    ids=["armor", "stainless"],
)
def test_the_slips_that_give_the_two_numbers_are_listed(claim: object, name: str) -> None:
    _, fitting = RESULTS.slips(claim)
    assert name in [slip.name for slip in fitting]
    assert [slip.departures for slip in fitting] == sorted(slip.departures for slip in fitting)


def test_as_many_fit_as_would_by_accident_and_none_fits_both() -> None:
    """Were the fits no accident, they would be many more than chance gives, or the same slips."""
    both = [RESULTS.slips(claim) for claim in (ARMOR, STAINLESS)]
    names = [{slip.name for slip in fitting} for _, fitting in both]
    assert not names[0] & names[1]
    for tried, fitting in both:
        assert tried.near + tried.members > 1000
        assert abs(len(fitting) - tried.expected) < 2 * tried.expected**0.5


def test_the_expected_number_of_accidents_counts_what_shifted_targets_meet() -> None:
    """Independently: move the target over the range, and count hits at the density taken."""
    values = []
    for member in family(LEDGER, X):
        try:
            values.append(with_slips(member).depth(X))
        except (ArithmeticError, ValueError):
            continue
    distinct = {f"{value:.12e}" for value in values if value > 0}
    near = [v for v in map(float, distinct) if 0.278 / 1.5 <= v <= 0.278 * 1.5]
    width = log10(0.2785 / 0.2775)
    targets = [0.278 / 1.5 * 1.5 ** (2 * k / 999) for k in range(1000)]
    hits = [sum(abs(log10(v / target)) < width / 2 for v in near) for target in targets]
    tried, _ = RESULTS.slips(ARMOR)
    assert tried.near == len(near)
    # The admitted densities move a member by some 0.2 %, beside the rounding interval of 0.36 %.
    assert sum(hits) / len(hits) < tried.expected < 2 * sum(hits) / len(hits)


def test_exchanged_densities_are_exchanged_in_both_places() -> None:
    exchanged = with_slips((densities_exchanged,)).depth(X)
    z = 1.046 * 8900 * 500**2 / 9.13e9
    by_hand = (2 / 3 * 7850 / 8900 + 0.557) / (2 * 1.046) * log(1 + z)
    assert exchanged == pytest.approx(by_hand, rel=1e-14, abs=0)


def test_a_misprinted_input_without_a_meaning_ends_no_search() -> None:
    results = Results(LEDGER.misprint("fz-k1", "0"))
    tried, fitting = results.slips(results.ledger.claims["frank-zook-rha"])
    assert tried.members > 100  # many are alike, as k_1 is zero
    assert all(slip.value > 0 for slip in fitting)

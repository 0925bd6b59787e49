"""The inverse question for a case: numbers, factors of the resistance, and printed texts."""

import re
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from replication import BETA_5, Impact, final_depth
from replication.solve import QUANTITIES, solve, solve_printed

RIGID = replace(BETA_5, beta=None, flow_stress=None, resistance=3.5e9)


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_the_value_gives_the_depth_in_the_case(quantity: str) -> None:
    depth = 3.3e-6
    answer = solve(BETA_5, quantity, depth)
    assert answer.value is not None
    changes: dict[str, float | None] = {quantity: answer.value}
    if quantity == "resistance":
        changes |= {"beta": None, "flow_stress": None}
    changed = replace(BETA_5, **changes)
    assert final_depth(**changed.motion) == pytest.approx(depth, rel=1e-14)
    assert answer.normalized_depth == pytest.approx(depth / changed.radius, rel=1e-15)
    assert quantity not in answer.inputs
    assert (answer.interval, answer.reason) == (None, "")


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_the_condition_is_the_change_of_the_value_for_one_of_the_depth(quantity: str) -> None:
    depth, h = 3.3e-6, 1e-5
    low, high, answer = (solve(BETA_5, quantity, depth * (1 + s * h)) for s in (-1, 1, 0))
    assert low.value is not None
    assert high.value is not None
    assert answer.value is not None
    slope = (high.value - low.value) / (2 * h * answer.value)
    assert answer.condition == pytest.approx(slope, rel=1e-8)  # h^2, and rounding over h


def test_the_factors_of_the_resistance() -> None:
    resistance, beta, stress = (
        solve(BETA_5, name, 3.3e-6) for name in ("resistance", "beta", "flow_stress")
    )
    assert resistance.value is not None
    assert beta.value == resistance.value / 700e6
    assert stress.value == resistance.value / 5
    assert resistance.inputs == {
        "velocity": 500.0, "radius": 11e-6, "particle_density": 8900.0, "target_density": 7850.0,
    }  # fmt: skip
    assert beta.inputs == resistance.inputs | {"flow_stress": 700e6}
    assert stress.inputs == resistance.inputs | {"beta": 5.0}


def test_no_solution_is_an_answer_with_its_reason() -> None:
    answer = solve(BETA_5, "target_density", 9e-6)
    assert (answer.value, answer.condition) == (None, None)
    assert answer.reason == (
        "target density has no value that gives 9 um: without any, at the constant pressure "
        "R_t, the depth is 8.273 um"
    )


@pytest.mark.parametrize(
    ("impact", "quantity", "depth", "message"),
    [
        (BETA_5, "step", 1e-6, "cannot solve for 'step': choose one of resistance, beta, "
         "flow_stress, velocity, radius, particle_density, target_density"),
        (RIGID, "beta", 1e-6,
         "the beta is the resistance over the flow stress: give the flow stress"),
        (RIGID, "flow_stress", 1e-6,
         "the flow stress is the resistance over the beta: give the beta"),
        (BETA_5, "velocity", 0.0, "depth is 0.0: it must be a finite number greater than zero"),
        (BETA_5, "velocity", 1.0, "velocity is inf for this depth: doubles carry 1e-250 to 1e250 "
         "safely (with depth 1.0, radius 1.1e-05, particle_density 8900.0, target_density 7850.0, "
         "resistance 3500000000.0)"),
    ],
)  # fmt: skip
def test_what_cannot_be_solved(impact: Impact, quantity: str, depth: float, message: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        solve(impact, quantity, depth)


# Printed texts


@pytest.mark.parametrize(
    ("quantity", "texts", "low", "high"),
    [
        # By hand: X/R from 0.295455 to 0.304545, W from 0.078696 to 0.083333, e^L - 1 from 0.053438
        # to 0.056673, so R_t from 17.314 to 18.362 GPa.
        pytest.param("resistance", {"depth": "3.3 um"}, 17.314e9, 18.362e9, id="a depth"),
        # W(0.3) = 0.081, e^L - 1 = 0.0550445, so 17.8265 GPa, times 0.999^2 and 1.001^2
        pytest.param("resistance", {"normalized_depth": "0.3000000", "velocity": "500"},
                     17.8265e9 * 0.999**2, 17.8265e9 * 1.001**2, id="a velocity of three digits"),
        pytest.param("beta", {"normalized_depth": "0.3000000", "flow_stress": "700 MPa"},
                     17.8265e9 / 7.005e8, 17.8265e9 / 6.995e8, id="a flow stress"),
        # Over y = 0.697721, which does not depend on the radius
        pytest.param("radius", {"depth": "3.3 um"}, 3.25e-6 / 0.697721, 3.35e-6 / 0.697721,
                     id="the radius"),
    ],
)  # fmt: skip
def test_intervals_by_hand(quantity: str, texts: dict[str, str], low: float, high: float) -> None:
    answer = solve_printed(BETA_5, quantity, texts)
    assert answer.interval is not None
    assert answer.value is not None
    assert answer.interval == pytest.approx((low, high), rel=5e-5)
    assert answer.interval[0] < answer.value < answer.interval[1]


@given(st.sampled_from([*QUANTITIES]), st.integers(20, 60), st.floats(0, 1))
@settings(max_examples=60, deadline=None)
def test_an_interval_contains_the_value_of_every_depth_that_prints_alike(
    quantity: str, tenths: int, share: float
) -> None:
    text = f"{tenths / 10} um"
    answer = solve_printed(BETA_5, quantity, {"depth": text})
    depth = float(Fraction(tenths, 10**7) + (Fraction(share) - Fraction(1, 2)) / 10**7)
    value = solve(BETA_5, quantity, depth).value
    assert answer.interval is not None
    assert value is not None
    # The value has rounding errors of its own, where the share is 0 or 1.
    assert answer.interval[0] * (1 - 1e-13) <= value <= answer.interval[1] * (1 + 1e-13)


@pytest.mark.parametrize(
    ("text", "interval_begins_at_zero", "value"),
    [
        pytest.param("8.2 um", False, True, id="of each depth that prints so there is one"),
        pytest.param("8.27 um", True, True, id="of some, and of this"),
        pytest.param("8.28 um", True, False, id="of some, but not of this"),
    ],
)
def test_an_interval_from_zero_says_that_there_is_not_always_a_value(
    text: str, interval_begins_at_zero: bool, value: bool
) -> None:
    """The limit is 8.2729 um: "8.27" may be 8.265 to 8.275, "8.28 um" with 500 m/s rounded less."""
    answer = solve_printed(BETA_5, "target_density", {"depth": text, "velocity": "500"})
    assert answer.interval is not None
    assert (answer.interval[0] == 0) == interval_begins_at_zero
    assert (answer.value is not None) == value


def test_of_no_depth_that_prints_so_is_there_a_solution() -> None:
    answer = solve_printed(BETA_5, "target_density", {"depth": "9.0 um"})
    assert (answer.value, answer.interval) == (None, None)
    assert "has no value that gives 9 um" in answer.reason


@pytest.mark.parametrize(
    ("quantity", "texts", "message"),
    [
        ("resistance", {}, "give either the depth or the normalized depth"),
        ("resistance", {"depth": "1 um", "normalized_depth": "0.1"},
         "give either the depth or the normalized depth"),
        ("radius", {"normalized_depth": "0.3"},
         "the normalized depth does not depend on the radius: give the depth"),
        ("resistance", {"depth": "3,3 um"},
         "depth: '3,3 um': write a decimal comma as a point, and thousands without a comma"),
        ("resistance", {"depth": "3 MPa"}, "depth: '3 MPa': MPa does not measure what m does"),
        ("resistance", {"depth": "0.0 um"},
         "depth: '0.0 um' may be the text of zero: give more digits"),
    ],
)  # fmt: skip
def test_texts_that_cannot_be_taken(quantity: str, texts: dict[str, str], message: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        solve_printed(BETA_5, quantity, texts)

"""Depth, velocity and time of one case, in plain floats, against the exact motion in 30 digits."""

from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference.motion import Trajectory
from replication.cases import BETA_5
from replication.models import crater, motion
from replication.models.depth import (
    depth_at_velocity,
    final_depth,
    normalized_depth,
    velocity_at_depth,
)
from replication.models.motion import stop_time, time_to_depth

ULP = 2.0**-52
CASE = tuple(BETA_5.motion.values())


def spread(low: float, high: float) -> st.SearchStrategy[float]:
    """Evenly over the logarithm."""
    powers = st.floats(0, 1)
    return powers.map(lambda power: low * (high / low) ** power)


CASES = st.tuples(
    spread(1e-6, 1e5), spread(1e-9, 1), spread(1, 1e5), spread(1, 1e5), spread(1e3, 1e13)
)
"""Shallow to hypervelocity, most of the deep ones beyond the radius."""


def exact(case: tuple[float, ...]) -> Trajectory:
    return Trajectory(*(Fraction(value) for value in case), digits=30)


def history(times: list[float], *case: float) -> tuple[list[float], list[float]]:
    depth, speed = [0.0] * len(times), [0.0] * len(times)
    motion.history(times, *case, depth, speed)  # type: ignore[misc, arg-type]
    return depth, speed


def roundings(truth: Trajectory) -> float:
    """64 ulp, and those of the exponent k W of v^2, each of which is relative to all of it."""
    return (64 + 16 * float(truth.context.log1p(truth.drag / truth.push))) * ULP


@given(case=CASES, share=st.floats(1e-6, 0.999))
@settings(max_examples=12, deadline=None)
def test_depth_velocity_and_time_follow_the_exact_motion(
    case: tuple[float, ...], share: float
) -> None:
    truth = exact(case)
    bound, v = roundings(truth), share * case[0]
    at = truth.depth_at_velocity(Fraction(v))
    depth = float(at)
    # A depth that is short of the last by a share s loses 1 / 2s of its ulps in v and time.
    near_rest = bound / max(float(1 - at / truth.final_depth), ULP)
    assert depth_at_velocity(v, *case) == pytest.approx(depth, rel=bound / (1 - share))
    stop = float(truth.stop_time(Fraction(v)))
    assert stop_time(*case, stop_velocity=v) == pytest.approx(stop, rel=bound / (1 - share))
    if depth < truth.final_depth:
        velocity = float(truth.velocity_at_depth(Fraction(depth)))
        assert velocity_at_depth(depth, *case) == pytest.approx(velocity, rel=near_rest)
        time = float(truth.time_to_depth(Fraction(depth)))
        assert time_to_depth(depth, *case) == pytest.approx(time, rel=near_rest)


def check_history(case: tuple[float, ...], share: float) -> None:
    """At the exact time of a depth, 1 - share^2 of the last, it is there to fourteen digits."""
    truth = exact(case)
    expected = truth.final_depth * (1 - truth.context.mpf(share) ** 2)
    # Rounding the time to a double moves the depth by half an ulp of v t, which is below x.
    (depth,), (speed,) = history([float(truth.time_to_depth(expected))], *case)
    assert abs(depth - float(expected)) <= 1e-14 * truth.final_depth
    assert abs(speed - float(truth.velocity_at_depth(expected))) <= 1e-14 * case[0]


@given(case=CASES, share=st.floats(0, 1))
@settings(max_examples=12)
def test_history_is_exact_to_fourteen_digits(case: tuple[float, ...], share: float) -> None:
    check_history(case, share)
    assert stop_time(*case) == pytest.approx(float(exact(case).stop_time()), rel=1e-14)


@given(case=CASES, shares=st.lists(st.floats(0, 1.5), min_size=2, max_size=5))
@settings(max_examples=60, deadline=None)
def test_histories_go_on_until_rest(case: tuple[float, ...], shares: list[float]) -> None:
    stop, final = stop_time(*case), final_depth(*case)
    times = sorted(share * stop for share in shares)
    depth, speed = history(times, *case)
    # Neighbouring times may differ by less than the roundings of a step.
    assert all(b - a >= -1e-14 * final for a, b in pairwise(depth))
    assert all(b - a <= 1e-14 * case[0] for a, b in pairwise(speed))
    for time, x, v in zip(times, depth, speed, strict=True):
        assert ((x, v) == (final, 0.0)) if time >= stop else (x <= final)
    backwards = history(times[::-1], *case)
    assert (backwards[0][::-1], backwards[1][::-1]) == (depth, speed)
    assert history([0.0, stop], *case) == ([0.0, final], [case[0], 0.0])


@pytest.mark.parametrize("crossing", [1 - 1e-9, 1 - 1e-15, 1.0, 1 + 1e-15, 1 + 1e-9, 1.5])
def test_motions_that_barely_cross_the_radius(crossing: float) -> None:
    # By its resistance a case is made to rest at y = crossing, there to 1e-14 of itself.
    low, high = 1e6, 1e12
    for _ in range(80):
        middle = (low + high) / 2
        deep = normalized_depth(500.0, 8900.0, 7850.0, middle) > crossing
        low, high = (middle, high) if deep else (low, middle)
    case = (500.0, 11e-6, 8900.0, 7850.0, high)
    for share in (0.7, 0.1, 1e-3, 1e-9):
        check_history(case, share)


def test_a_history_begins_before_a_tail_many_times_as_long() -> None:
    # From 1e30 m/s, rest takes 1e28 times as long as the first tenth of the radius.
    case = (1e30, *CASE[1:])
    depth, speed = history([1e-40, 1e-37], *case)
    assert depth == pytest.approx([1e-10, 1e-7], rel=1e-3)
    assert all(v < 1e30 for v in speed)


def test_stop_time_at_rest_when_the_last_digits_of_the_depth_disagree() -> None:
    case = (1.0, 1.0, 1.0, 1.0, 10.0**5.3515625)
    assert stop_time(*case) == pytest.approx(float(exact(case).stop_time()), rel=1e-14)


@given(st.floats(1e-6, 0.5))
def test_a_crater_has_the_volume_that_its_depth_came_from(ratio: float) -> None:
    """Depth y over radius, of a part y^2 (3 - y) / 4 of the sphere."""
    y = crater.depth_from_volume_ratio(ratio)
    assert y * y * (3 - y) / 4 == pytest.approx(ratio, rel=1e-14)

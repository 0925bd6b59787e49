"""The models in plain floats against the exact motion in many digits, and the sheet's errors."""

import math
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import Any
from unittest.mock import patch

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from reference.arithmetic import Reals
from reference.motion import Trajectory, sheet_rows
from reference.scheme import Scheme
from replication.cases import BETA_3, BETA_5, read_case
from replication.error import hard_cases, ladder, warnings
from replication.error.ladder import exact_motion
from replication.models import crater, motion
from replication.models.depth import (
    depth_at_velocity,
    elasticities,
    final_depth,
    normalized_depth,
    velocity_at_depth,
)
from replication.models.impact import Impact
from replication.models.motion import stop_time, time_to_depth
from replication.models.sheet import run
from spreadsheets.verify import rounding_bound


@given(st.floats(min_value=1e-100, max_value=1e100))
def test_plain_numbers_are_read_as_the_double_they_spell(value: float) -> None:
    assert read_case("beta-5", None, {"velocity": repr(value)}).velocity == value


# The sheet

IMPACTS = st.builds(
    Impact,
    velocity=st.floats(50, 2000),
    radius=st.floats(1e-6, 1e-4),
    particle_density=st.floats(1000, 20000),
    target_density=st.floats(1000, 20000),
    resistance=st.floats(1e8, 1e10),
    step=st.just(1.0),
    stop_velocity=st.floats(0, 2),
).map(lambda impact: replace(impact, step=impact.radius / impact.velocity / 50))


@given(IMPACTS, st.sampled_from(Scheme))
@settings(max_examples=60, deadline=None)
def test_the_sheet_differs_from_the_scheme_in_50_digits_by_rounding_only(
    impact: Impact, scheme: Scheme
) -> None:
    reals, sheet = Reals(50), run(impact, scheme)
    inputs = impact.motion | {"step": impact.step, "stop_velocity": impact.stop_velocity}
    numbers = {name: reals.number(Fraction(value)) for name, value in inputs.items()}
    exact = [*sheet_rows(reals, **numbers, scheme=scheme, most_rows=sheet.steps)]
    assert sheet.rows[0] == (0.0, impact.velocity, 0.0, 0.0, None)
    before = impact.velocity
    for k, row in enumerate(sheet.rows[1:], start=1):
        assert (row.time, row.velocity_initial) == (k * impact.step, before)
        assert row.velocity_final == before - row.deceleration * impact.step
        assert (row.velocity_final < impact.stop_velocity) == (k == sheet.steps)
        before = row.velocity_final
    bound = rounding_bound(sheet.steps, impact.velocity, sheet.rows[-1].time, sheet.final_depth)
    for column in exact[0]._fields:
        pairs = zip((getattr(row, column) for row in sheet.rows[1:]), exact, strict=True)
        parted = max(abs(double - getattr(row, column)) for double, row in pairs)
        # The last velocity is what is left of the impact velocity, and is rounded like that.
        first = impact.velocity if column.startswith("velocity") else 0.0
        largest = max(first, *(abs(getattr(row, column)) for row in exact))
        assert parted <= bound * largest


@given(IMPACTS, st.floats(0, 1), st.sampled_from(Scheme))
def test_a_sheet_of_the_greatest_number_of_steps_is_not_refused(
    impact: Impact, stop: float, scheme: Scheme
) -> None:
    impact = replace(impact, stop_velocity=stop * impact.velocity)
    sheet = run(impact, scheme)
    with patch("replication.models.sheet.MAX_STEPS", sheet.steps):
        assert run(impact, scheme) == sheet


@pytest.mark.parametrize(
    ("impact", "doubts"),
    [
        (BETA_5, ["reversed"]),
        (replace(BETA_5, step=2e-12), []),
        (replace(BETA_5, step=4e-9), ["reversed", "coarse", "shallow"]),
        (replace(BETA_5, step=1e-7), ["reversed", "coarse", "deep"]),
        (replace(BETA_5, step=2.21e-9, stop_velocity=499.0), ["coarse", "overrun", "short"]),
        (replace(BETA_5, step=2.19e-9, stop_velocity=480.0), ["shallow", "short"]),
        (replace(BETA_5, stop_velocity=499.9), ["overrun", "short"]),
        (replace(BETA_5, radius=1e-6), ["reversed"]),
        (replace(BETA_5, step=2e-12, stop_velocity=13.0), []),
        (replace(BETA_5, step=2e-12, stop_velocity=14.0), ["short"]),
        (replace(BETA_5, velocity=1.0), ["overrun", "short"]),
    ],
)
def test_warnings_of_a_run(impact: Impact, doubts: list[str]) -> None:
    sheet = run(impact)
    assert list(warnings(sheet)) == doubts
    assert ("deep" in doubts) == (sheet.final_depth > final_depth(**impact.motion) * 1.0005)


# The motion

ULP = 2.0**-52

approx = partial(pytest.approx, abs=0)
"""Times in seconds are so small that pytest's own absolute tolerance would allow anything."""


def spread(low: float, high: float) -> st.SearchStrategy[float]:
    """Draw floats uniformly in the logarithm."""
    powers = st.floats(0, 1)
    return powers.map(lambda power: low * (high / low) ** power)


CASES = st.tuples(
    spread(1e-6, 1e5), spread(1e-9, 1), spread(1, 1e5), spread(1, 1e5), spread(1e3, 1e13)
)
"""Inputs from shallow impacts to hypervelocity; most deep ones get beyond the radius."""


def exact(case: tuple[float, ...]) -> Trajectory:
    return Trajectory(*(Fraction(value) for value in case), digits=30)


def history(times: list[float], *case: float) -> tuple[list[float], list[float]]:
    depth, speed = [0.0] * len(times), [0.0] * len(times)
    motion.history(times, *case, depth, speed)  # type: ignore[misc, arg-type]
    return depth, speed


def roundings(truth: Trajectory) -> float:
    """Return 64 ulp, and 16 for each unit of the exponent of v^2, which exp magnifies."""
    return (64 + 16 * float(truth.context.log1p(truth.inertial / truth.strength))) * ULP


@given(CASES, st.sampled_from(list(BETA_5.motion)))
def test_elasticities_are_the_slopes_of_the_reference(case: tuple[float, ...], name: str) -> None:
    velocity, _, *materials = case
    if abs(normalized_depth(velocity, *materials) - 1) < 1e-6:
        return  # the second derivative jumps at y = 1, so differences across it are less accurate
    h = Fraction(1, 10**12)

    def log_depth(share: Fraction) -> Any:
        inputs = dict(zip(BETA_5.motion, map(Fraction, case), strict=True))
        inputs[name] *= 1 + share
        truth = Trajectory(**inputs, digits=50)
        return truth.context.log(truth.final_depth)

    slope = (log_depth(h) - log_depth(-h)) / 2 * h.denominator
    # The difference has an error of h^2; the closed form has rounding errors where q - 1 cancels.
    assert elasticities(velocity, *materials)[name] == pytest.approx(
        float(slope), rel=1e-9, abs=1e-12
    )


@given(case=CASES, share=st.floats(1e-6, 0.999))
@settings(max_examples=12, deadline=None)
def test_depth_velocity_and_time_follow_the_exact_motion(
    case: tuple[float, ...], share: float
) -> None:
    truth = exact(case)
    bound, v = roundings(truth), share * case[0]
    at = truth.depth_at_velocity(Fraction(v))
    depth = float(at)
    # At a share s before the final depth, an ulp of depth becomes 1 / 2s ulps of v and of time.
    near_rest = bound / max(float(1 - at / truth.final_depth), ULP)
    assert depth_at_velocity(v, *case) == approx(depth, rel=bound / (1 - share))
    stop = float(truth.stop_time(Fraction(v)))
    assert stop_time(*case, stop_velocity=v) == approx(stop, rel=bound / (1 - share))
    if depth < truth.final_depth:
        velocity = float(truth.velocity_at_depth(Fraction(depth)))
        assert velocity_at_depth(depth, *case) == approx(velocity, rel=near_rest)
        time = float(truth.time_to_depth(Fraction(depth)))
        assert time_to_depth(depth, *case) == approx(time, rel=near_rest)


def check_history(case: tuple[float, ...], share: float) -> None:
    """Check depth and velocity to 14 digits at the exact time of depth 1 - share^2 of the final."""
    truth = exact(case)
    expected = truth.final_depth * (1 - truth.context.mpf(share) ** 2)
    # Rounding the time to a double moves the depth by half an ulp of v t, which is below x.
    (depth,), (speed,) = history([float(truth.time_to_depth(expected))], *case)
    assert abs(depth - float(expected)) <= 1e-14 * truth.final_depth
    assert abs(speed - float(truth.velocity_at_depth(expected))) <= 1e-14 * case[0]


@given(case=CASES, share=st.floats(0, 1))
@example(
    case=(1.0, 1.0, 1.0, 1.0, 10.0**5.3515625), share=0.0
)  # ways to compute the final depth disagree
@settings(max_examples=12)
def test_history_is_exact_to_fourteen_digits(case: tuple[float, ...], share: float) -> None:
    check_history(case, share)
    assert stop_time(*case) == approx(float(exact(case).stop_time()), rel=1e-14)


@given(case=CASES, shares=st.lists(st.floats(0, 1.5), min_size=2, max_size=5))
@settings(max_examples=60, deadline=None)
def test_histories_go_on_until_rest(case: tuple[float, ...], shares: list[float]) -> None:
    stop, final = stop_time(*case), final_depth(*case)
    times = sorted(share * stop for share in shares)
    depth, speed = history(times, *case)
    # The depths of neighbouring times may differ by less than the rounding errors of a step.
    assert all(b - a >= -1e-14 * final for a, b in pairwise(depth))
    assert all(b - a <= 1e-14 * case[0] for a, b in pairwise(speed))
    for time, x, v in zip(times, depth, speed, strict=True):
        assert ((x, v) == (final, 0.0)) if time >= stop else (x <= final)
    backwards = history(times[::-1], *case)
    assert (backwards[0][::-1], backwards[1][::-1]) == (depth, speed)
    assert history([0.0, stop], *case) == ([0.0, final], [case[0], 0.0])


@pytest.mark.parametrize("velocity", [800.0, 900.0, 1000.0, 1500.0, 2000.0])
def test_at_the_time_of_the_radius_the_depth_is_the_radius(velocity: float) -> None:
    """Two formulas meet at that time: the sum of a series before it, a closed form from it on."""
    case = (velocity, 1.1e-5, 8900.0, 7850.0, 3.5e9)
    (depth,), (speed,) = history([time_to_depth(1.1e-5, *case)], *case)
    assert depth == approx(1.1e-5, rel=1e-13)
    assert speed == approx(velocity_at_depth(1.1e-5, *case), rel=1e-13)


@pytest.mark.parametrize("crossing", [1 - 1e-9, 1 - 1e-15, 1.0, 1 + 1e-15, 1 + 1e-9, 1.5])
def test_motions_that_end_near_the_radius(crossing: float) -> None:
    # Choose the resistance, to a relative 1e-14, so that the particle rests at y = crossing.
    resistance = brentq(
        lambda R_t: normalized_depth(500.0, 8900.0, 7850.0, R_t) - crossing, 1e6, 1e12, xtol=1e-6
    )
    case = (500.0, 11e-6, 8900.0, 7850.0, resistance)
    for share in (0.7, 0.1, 1e-3, 1e-9):
        check_history(case, share)


@given(CASES)
def test_the_time_down_to_a_tiny_velocity_is_that_to_rest(case: tuple[float, ...]) -> None:
    assert stop_time(*case, case[0] * 1e-200) == approx(stop_time(*case), rel=1e-14)


@pytest.mark.parametrize("light", [1e-2, 1e-6])
def test_times_in_a_light_target(light: float) -> None:
    """The velocity hardly falls near the radius, so that the depth must tell the time."""
    case = (500.0, 11e-6, 8900.0, 8900.0 * light, 3.5e5 * light)
    for depth in (11.1e-6, 1e-4):
        time = float(exact(case).time_to_depth(Fraction(depth)))
        assert time_to_depth(depth, *case) == approx(time, rel=1e-14)


def test_times_in_the_lightest_target() -> None:
    case = (500.0, 11e-6, 1e120, 1.0, 1.25e-115)  # b c is less than the least double
    # Almost all of the motion is beyond the radius: a quarter of the tangent's period.
    b, b_over_c = 0.375e-120, 0.5 * 500.0**2 / 1.25e-115
    stop = 11e-6 / 500.0 * math.pi / 2 * math.sqrt(b_over_c) / b
    assert stop_time(*case) == approx(stop, rel=1e-13)
    for depth in (0.0, 1e-6, 2e-5):
        assert velocity_at_depth(depth, *case) == approx(500.0, rel=1e-13)  # ln p is 280
        assert time_to_depth(depth, *case) == approx(depth / 500.0, rel=1e-13)


@given(st.floats(1e-6, 0.5))
def test_a_crater_has_the_volume_that_gave_its_depth(ratio: float) -> None:
    """A depth of y radii buries a share y^2 (3 - y) / 4 of the sphere."""
    y = crater.normalized_depth_from_volume_ratio(ratio)
    assert y * y * (3 - y) / 4 == pytest.approx(ratio, rel=1e-14)


# Error budget, convergence and hard cases


@pytest.mark.parametrize("scheme", Scheme)
@pytest.mark.parametrize("impact", [BETA_3, BETA_5, replace(BETA_5, velocity=1500.0)])
def test_the_time_step_part_has_the_order_of_the_scheme(impact: Impact, scheme: Scheme) -> None:
    result = ladder.converge(impact, ladder.ladder(1e-10, 7), scheme)
    assert result["levels"][-1]["time_step_order"] == pytest.approx(scheme.order, abs=0.02)


@pytest.mark.parametrize(
    ("order", "ratio", "assumed", "gci"),
    [
        (1, 2.0, 1, 1.25 * 0.25 / 5.25),
        (1, 3.0, 1, 1.25 * 0.25 / 5.25),
        (2, 2.0, 2, 1.25 * 0.25 / 5.25),
        (2, 3.0, 2, 1.25 * 0.25 / 5.25),
        pytest.param(4, 2.0, 1, 3 * 0.25 * (2**4 - 1) / 5.25, id="not of the assumed order"),
    ],
)
def test_depths_of_a_known_order_are_extrapolated_to_their_limit(
    order: int, ratio: float, assumed: int, gci: float
) -> None:
    """The depths are 5 + h^order/4. The index of Roache takes 1.25, or 3 if the order is doubted.

    With the assumed order p it is the factor times the last change over (ratio^p - 1), relative to
    the last depth: the last change is (ratio^order - 1)/4.
    """
    steps = [ratio**2, ratio, 1.0]
    result = ladder.extrapolated(steps, [5.0 + 0.25 * h**order for h in steps], assumed)
    assert result["limit"] == pytest.approx(5.0, rel=1e-11)
    assert result["observed_order"] == pytest.approx(order, rel=1e-11)
    assert result["gci"] == pytest.approx(gci, rel=1e-11)


@pytest.mark.parametrize(
    ("order", "time_step", "stop_rule", "half_step", "rounding", "regime"),
    [
        (1.0, 1.0, 0.0, 0.0, 0.2, "rounding floor"),
        (1.0, 1.0, 0.6, 0.6, 0.0, "stop-rule floor"),
        (1.05, 1.0, 0.1, 0.1, 0.0, "stop rule shows"),
        (0.95, 1.0, 0.31, -0.3, 0.0, "asymptotic"),
    ],
)
def test_what_governs_an_error(
    order: float,
    time_step: float,
    stop_rule: float,
    half_step: float,
    rounding: float,
    regime: str,
) -> None:
    parts = {
        "time_step": time_step, "stop_rule": stop_rule, "half_step": half_step,
        "rounding": rounding,
    }  # fmt: skip
    assert ladder.regime(1.0, parts, order, 1) == regime


# Stopped at 14 m/s, the centered sheet gives three digits at some steps and their halves only by
# accident: a quarter of the step does not.
@pytest.mark.parametrize(("digits", "stop"), [(1, 1.0), (2, 1.0), (3, 1.0), (4, 1.0), (3, 14.0)])
@pytest.mark.parametrize("scheme", Scheme)
def test_the_largest_step_for_digits_is_verified(digits: int, stop: float, scheme: Scheme) -> None:
    impact = replace(BETA_5, stop_velocity=stop)
    result = ladder.step_for_digits(impact, digits, scheme)
    rest = float(exact_motion(BETA_5).final_depth)
    allowed = 0.5 * 10.0 ** (-5 - digits)  # the depth is 7.67e-6 m
    step, fails = result["step"], result["fails"]

    def errors(step: float) -> list[float]:
        halved = (replace(impact, step=step / 2**k) for k in range(4))
        return [run(case, scheme).final_depth - rest for case in halved]

    assert result["error"] == errors(step)[0]
    assert all(abs(error) <= allowed for error in errors(step))
    assert any(abs(error) > allowed for error in errors(fails))
    assert step < fails <= 1.0101 * step


@pytest.mark.parametrize("name", hard_cases.HARD_CASES)
def test_the_closed_form_is_within_4_ulp_in_hard_cases_and_the_measure_sees_one_ulp(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The sheets of these cases, their warnings and the errors are in `printed/stability.txt`."""
    if (ulps := hard_cases.outcome(name)["ulps"]) is not None:
        assert abs(ulps) <= 4
        monkeypatch.setattr(
            hard_cases, "final_depth", lambda **case: math.nextafter(final_depth(**case), math.inf)
        )
        # An ulp doubles at powers of two.
        assert hard_cases.outcome(name)["ulps"] - ulps == pytest.approx(1, abs=0.51)


def test_the_worst_case_is_found_where_the_quick_measure_is_off_by_less_than_its_margin(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    cases = list(hard_cases.random_cases(100, 2))
    expected = max((hard_cases._ulps(final_depth(**case), case) for case in cases), key=abs)
    quick = hard_cases._about_ulps
    monkeypatch.setattr(hard_cases, "_MARGIN", 0.4)
    monkeypatch.setattr(hard_cases, "_about_ulps", lambda *case: abs(quick(*case)) - 0.3)
    assert hard_cases.worst_of(100, seed=2)["ulps"] == expected


def test_the_worst_random_case_is_found_by_fewer_digits() -> None:
    """Which case is the worst is seen by a measure that is right to a millionth of an ulp."""
    worst = hard_cases.worst_of(3000, seed=2)
    errors = [
        hard_cases._ulps(final_depth(**case), case) for case in hard_cases.random_cases(3000, 2)
    ]
    assert worst["ulps"] == max(errors, key=abs)


def test_the_closed_form_is_within_4_ulp_in_a_hundred_thousand_cases() -> None:
    worst = hard_cases.worst_of(100_000, seed=1)
    assert worst["skipped"] == 0
    assert 0.5 < abs(worst["ulps"]) <= 4, "and the measure is alive"

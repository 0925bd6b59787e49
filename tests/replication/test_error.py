"""Error budget, convergence and hard cases."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from replication.cases import BETA_3, BETA_5
from replication.error import hard_cases, ladder
from replication.error.ladder import exact_motion, split
from replication.models.depth import final_depth
from replication.models.impact import Impact
from replication.models.sheet import SCHEMES, run

SENSIBLE = st.builds(
    Impact,
    velocity=st.floats(10, 3000),
    radius=st.floats(1e-7, 1e-3),
    particle_density=st.floats(1000, 20000),
    target_density=st.floats(1000, 20000),
    resistance=st.floats(1e8, 1e11),
    step=st.just(1.0),
    stop_velocity=st.floats(0, 2),
)


def with_steps(impact: Impact, steps: float) -> Impact:
    return replace(impact, step=float(exact_motion(impact).stop_time()) / steps)


@given(SENSIBLE, st.floats(50, 500), st.sampled_from(["published", "centered"]))
@settings(max_examples=60, deadline=None)
def test_the_parts_of_the_budget_add_up(impact: Impact, steps: float, scheme: str) -> None:
    error, budget = split(run(with_steps(impact, steps), scheme))
    parts = [part for part in budget.values() if part is not None]
    assert len(parts) == 4
    # Each part is rounded to a double once, and so is the error.
    rounding = 2.0**-53 * (sum(map(abs, parts)) + abs(error))
    assert abs(math.fsum(parts) - error) <= rounding


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("impact", [BETA_3, BETA_5, replace(BETA_5, velocity=1500.0)])
def test_the_time_step_part_has_the_schemes_order(impact: Impact, scheme: str) -> None:
    result = ladder.converge(impact, ladder.ladder(1e-10, 7), scheme)
    assert result["levels"][-1]["time_step_order"] == pytest.approx(SCHEMES[scheme].order, abs=0.02)


@pytest.mark.parametrize(
    ("order", "ratio", "assumed", "gci"),
    [
        *((order, ratio, order, 1.25 * 0.25 / 5.25) for order in (1, 2) for ratio in (2.0, 3.0)),
        (4, 2.0, 1, 3 * 0.25 * 15 / 5.25),  # an order that is too good does not shrink the index
    ],
)
def test_richardson_on_depths_of_known_order(
    order: int, ratio: float, assumed: int, gci: float
) -> None:
    steps = [ratio**2, ratio, 1.0]
    result = ladder.extrapolated(steps, [5.0 + 0.25 * h**order for h in steps], assumed)
    assert result["observed_order"] == pytest.approx(order, rel=1e-12)
    assert order == 4 or result["limit"] == pytest.approx(5.0, rel=1e-14)
    assert result["gci"] == pytest.approx(gci, rel=1e-12)


def test_what_governs_an_error_at_the_edges_of_the_regimes() -> None:
    """The others stand in ladders of `said.txt`."""
    for parts, order, regime in (
        ((1.0, 0.0, 0.0, 0.2), 1.0, "rounding floor"),
        ((1.0, 0.6, 0.6, 0.0), 1.0, "stop-rule floor"),
        ((1.0, 0.1, 0.1, 0.0), 1.05, "stop rule shows"),
        ((1.0, 0.31, -0.3, 0.0), 0.95, "asymptotic"),
    ):
        budget = dict[str, float | None](zip(ladder._PARTS, parts, strict=True))
        assert ladder.regime(1.0, budget, order, 1) == regime


@pytest.mark.parametrize("digits", [1, 2, 3, 4])
@pytest.mark.parametrize("scheme", SCHEMES)
def test_the_largest_step_for_digits_is_verified(digits: int, scheme: str) -> None:
    result = ladder.step_for_digits(BETA_5, digits, scheme)
    rest = float(exact_motion(BETA_5).final_depth)
    allowed = 0.5 * 10.0 ** (-5 - digits)  # the depth is 7.67e-6 m
    step, fails = result["step"], result["fails"]

    def errors(step: float) -> list[float]:
        halved = (replace(BETA_5, step=step / 2**k) for k in range(4))
        return [run(case, scheme).final_depth - rest for case in halved]

    assert result["error"] == errors(step)[0]
    assert all(abs(error) <= allowed for error in errors(step))
    assert any(abs(error) > allowed for error in errors(fails))
    assert step < fails <= 1.0101 * step


@pytest.mark.parametrize("name", hard_cases.HARD_CASES)
def test_the_closed_form_holds_in_hard_cases(name: str) -> None:
    """The sheets beside it, their warnings and the refusals stand in `said.txt`."""
    assert abs(hard_cases.outcome(name)["ulps"] or 0) <= 4


def test_closed_form_keeps_within_4_ulp_over_a_hundred_thousand_cases() -> None:
    worst = hard_cases.worst_of(100_000, seed=1)
    assert worst["skipped"] == 0
    assert 0.5 < abs(worst["ulps"]) <= 4, "and the measure is alive"


def test_the_measure_of_ulps_sees_an_error() -> None:
    for case in hard_cases.random_cases(200, seed=3):
        depth = final_depth(**case)
        before = hard_cases._ulps(depth, case)
        after = hard_cases._ulps(math.nextafter(depth, math.inf), case)
        assert after - before == pytest.approx(1, abs=0.51)  # an ulp doubles at powers of two

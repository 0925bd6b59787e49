"""The sheet: rows, arrays and frame, and what stops it."""

import math
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference import exact
from replication import closed_form, midpoint
from replication.impact import BETA_3, BETA_5, Impact

IMPACTS = st.builds(
    Impact,
    velocity=st.floats(50, 2000),
    radius=st.floats(1e-6, 1e-4),
    particle_density=st.floats(1000, 20000),
    target_density=st.floats(1000, 20000),
    resistance=st.floats(1e8, 1e10),
    step=st.just(1.0),
    stop_velocity=st.just(1.0),
).map(lambda impact: replace(impact, step=impact.radius / impact.velocity / 50))


def test_the_report_needs_131_and_178_steps() -> None:
    assert midpoint.run(BETA_5).steps == 131
    assert midpoint.run(BETA_3).steps == 178


def test_row_0_is_the_impact_itself() -> None:
    first = midpoint.run(BETA_5).rows[0]
    assert first == (0.0, 500.0, 0.0, 0.0, None)


@given(
    IMPACTS, st.floats(-6, 3), st.floats(-1, 1).map(lambda power: 10.0**power * midpoint.MAX_STEPS)
)
@settings(max_examples=50, deadline=None)
def test_few_steps_are_few_by_the_exact_time(impact: Impact, slowest: float, steps: float) -> None:
    stop = min(10.0**slowest, 0.999 * impact.velocity)
    time = float(closed_form.stop_time(**impact.motion, stop_velocity=stop))
    impact = replace(impact, stop_velocity=stop, step=time / steps)
    if midpoint._few_steps(impact):
        assert steps <= midpoint.MAX_STEPS


def test_the_report_s_steps_are_seen_to_be_few() -> None:
    assert midpoint._few_steps(BETA_5)


def test_the_first_depth_is_half_a_step_and_later_ones_a_whole() -> None:
    rows = midpoint.run(BETA_5).rows
    assert rows[1].depth == 500.0 * 1e-10
    assert rows[2].depth == rows[1].depth + rows[2].velocity_initial * 2e-10


@given(IMPACTS)
@settings(max_examples=50, deadline=None)
def test_every_row_follows_from_the_one_before(impact: Impact) -> None:
    rows = midpoint.run(impact).rows
    for k, (before, row) in enumerate(pairwise(rows), start=1):
        assert row.time == k * impact.step
        expected = before.velocity_final if k > 1 else impact.velocity
        assert row.velocity_initial == expected
        slowed = row.velocity_initial - row.deceleration * impact.step
        assert row.velocity_final == slowed
    assert rows[-1].velocity_final < impact.stop_velocity
    assert all(row.velocity_final >= impact.stop_velocity for row in rows[1:-1])


@given(IMPACTS)
@settings(max_examples=25, deadline=None)
def test_rounding_is_all_that_parts_it_from_the_scheme_in_50_digits(impact: Impact) -> None:
    reals = exact.Reals(50)
    inputs = (
        impact.velocity,
        impact.radius,
        impact.particle_density,
        impact.target_density,
        impact.target_resistance,
        impact.step,
    )
    rows = exact.midpoint(reals, *(reals.number(Fraction(value)) for value in inputs))
    sheet = midpoint.run(impact)
    # A row has about a dozen roundings of 2^-53, each relative to a value of at most the impact's;
    # later rows amplify them by less than ten (cosh of the deceleration's growth over an impact).
    bound = 12 * 10 * sheet.steps * 2.0**-53
    for row, expected in zip(sheet.rows[1:], rows, strict=False):
        assert abs(row.depth - float(expected.depth)) <= bound * impact.radius
        assert row.velocity_final is not None
        assert abs(row.velocity_final - float(expected.velocity_final)) <= bound * impact.velocity


def test_beyond_the_radius_the_contact_area_stays_that_of_the_sphere() -> None:
    deep = replace(BETA_3, velocity=1500.0)
    rows = midpoint.run(deep).rows
    beyond = [row for row in rows if row.depth >= deep.radius]
    assert beyond, "the case must cross the radius to test it"
    for row in beyond:
        stress = 0.5 * deep.target_density * row.velocity_initial**2 + deep.target_resistance
        area = math.pi * deep.radius**2
        assert row.deceleration == pytest.approx(stress * area / deep.mass, rel=1e-15)


def test_below_the_stop_velocity_there_is_no_step_and_at_it_one() -> None:
    slow = midpoint.run(replace(BETA_5, velocity=0.5))
    assert (slow.steps, slow.final_depth) == (0, 0.0)
    assert midpoint.run(replace(BETA_5, velocity=1.0, stop_velocity=1.0)).steps == 1


def test_too_many_rows_are_refused() -> None:
    with pytest.raises(ValueError, match=r"about 2\.367e\+09 steps of 1e-15 s"):
        midpoint.run(replace(BETA_5, step=1e-15, radius=1e-3))


def test_arrays_and_frame_hold_the_rows() -> None:
    sheet = midpoint.run(BETA_5)
    arrays = sheet.arrays()
    assert {array.shape for array in arrays.values()} == {(132,)}
    assert {array.dtype for array in arrays.values()} == {np.dtype("float64")}
    frame = sheet.frame()
    assert list(frame.columns) == list(midpoint.Row._fields)
    assert frame.index.name == "row"
    for row, (_, line) in zip(sheet.rows[1:], frame.iloc[1:].iterrows(), strict=True):
        assert tuple(line) == tuple(row)
    assert math.isnan(frame.velocity_final.iloc[0])

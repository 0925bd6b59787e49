"""The sheet: rows, arrays and frame, what stops it, what to doubt; many at once the same."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference.arithmetic import Reals
from reference.motion import sheet_rows
from replication.cases import BETA_5
from replication.error import warnings
from replication.models.arrays import run_many
from replication.models.depth import final_depth
from replication.models.impact import Impact
from replication.models.sheet import SCHEMES, Row, _fewest_steps, run

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


@given(IMPACTS)
@settings(max_examples=50)
def test_rounding_is_all_that_parts_it_from_the_scheme_in_50_digits(impact: Impact) -> None:
    reals, sheet = Reals(50), run(impact)
    numbers = (reals.number(Fraction(value)) for value in (*impact.motion.values(), impact.step))
    exact = sheet_rows(reals, *numbers, most_rows=sheet.steps)
    assert sheet.rows[0] == (0.0, impact.velocity, 0.0, 0.0, None)
    # A row has about a dozen roundings of 2^-53, each relative to a value of at most the impact's;
    # later rows amplify them by less than ten (cosh of the deceleration's growth over an impact).
    bound = 12 * 10 * sheet.steps * 2.0**-53
    before = impact.velocity
    for k, (row, expected) in enumerate(zip(sheet.rows[1:], exact, strict=False), start=1):
        assert (row.time, row.velocity_initial) == (k * impact.step, before)
        assert row.velocity_final == before - row.deceleration * impact.step
        assert abs(row.depth - float(expected.depth)) <= bound * impact.radius
        assert abs(row.velocity_final - float(expected.velocity_final)) <= bound * impact.velocity
        assert (row.velocity_final < impact.stop_velocity) == (k == sheet.steps)
        before = row.velocity_final


def test_below_the_stop_velocity_there_is_no_step_and_at_it_one() -> None:
    slow = run(replace(BETA_5, velocity=0.5))
    assert (slow.steps, slow.final_depth) == (0, 0.0)
    at_stop = replace(BETA_5, velocity=1.0, stop_velocity=1.0)
    assert run(at_stop).steps == run_many(**at_stop.motion, stop_velocity=1.0)[1] == 1


@given(IMPACTS, st.floats(0, 1), st.sampled_from(SCHEMES))
def test_the_fewest_steps_are_no_more_than_are_taken(
    impact: Impact, stop: float, scheme: str
) -> None:
    impact = replace(impact, stop_velocity=stop * impact.velocity)
    inputs = (impact.step, impact.radius, impact.mass)
    target = (impact.target_density, impact.target_resistance)
    fewest = _fewest_steps(impact.velocity, impact.stop_velocity, *inputs, *target)
    assert fewest <= run(impact, scheme).steps


def test_a_frame_holds_the_rows() -> None:
    sheet = run(BETA_5)
    frame = sheet.frame()
    assert set(frame.dtypes) == {np.dtype("float64")}
    assert (list(frame.columns), frame.index.name) == (list(Row._fields), "row")
    assert [tuple(row) for row in frame.to_numpy().tolist()[1:]] == list(sheet.rows[1:])
    assert math.isnan(frame.velocity_final.iloc[0])


@pytest.mark.parametrize(
    ("changes", "kinds"),
    [
        ({}, ["reversed"]),
        ({"step": 2e-12}, []),
        ({"step": 4e-9}, ["reversed", "coarse"]),
        ({"step": 1e-7}, ["reversed", "coarse", "deep"]),
        ({"step": 2.21e-9, "stop_velocity": 499.0}, ["coarse"]),
        ({"step": 2.19e-9, "stop_velocity": 480.0}, []),
    ],
)
def test_what_speaks_for_too_long_a_step(changes: dict[str, float], kinds: list[str]) -> None:
    impact = replace(BETA_5, **changes)
    sheet = run(impact)
    assert list(warnings(sheet)) == kinds
    assert ("deep" in kinds) == (sheet.final_depth > final_depth(**impact.motion) * 1.0005)

"""The sheet: rows, arrays and frame, what stops it, what to doubt; many at once the same."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from kept import kept

from reference.arithmetic import Reals
from reference.motion import sheet_rows
from replication.cases import BETA_5
from replication.error import warnings
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


@given(IMPACTS, st.floats(0, 1), st.sampled_from(list(SCHEMES)))
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


@kept("replication/kept.txt", "Runs of beta-5 otherwise, and what they are warned of")
def test_warnings_of_a_run(question: str, answer: str) -> None:
    changes = dict(item.split(" = ") for item in question.split(", ") if item != "nothing")
    impact = replace(BETA_5, **{name: float(value) for name, value in changes.items()})
    sheet = run(impact)
    assert (", ".join(warnings(sheet)) or "nothing") == answer
    assert ("deep" in answer) == (sheet.final_depth > final_depth(**impact.motion) * 1.0005)

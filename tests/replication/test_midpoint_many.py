"""Many sheets at once: the same doubles as one at a time."""

from dataclasses import replace

import dask.array
import numpy as np
import pandas as pd
import pytest
import xarray
from hypothesis import given, settings
from hypothesis import strategies as st

from replication.impact import BETA_3, BETA_5, Impact
from replication.midpoint import SCHEMES, run
from replication.midpoint_many import run_many


@st.composite
def impacts(draw: st.DrawFn) -> Impact:
    """From a few steps to hundreds, some far too coarse, some crossing R or never starting."""
    case = Impact(
        velocity=draw(st.floats(0.5, 5000)),
        radius=draw(st.floats(1e-6, 1e-4)),
        particle_density=draw(st.floats(100, 20000)),
        target_density=draw(st.floats(100, 20000)),
        resistance=draw(st.floats(1e7, 1e11)),
        stop_velocity=draw(st.sampled_from([0.0, 1.0, 100.0])),
    )
    share = draw(st.floats(0.5, 100))
    return replace(case, step=case.radius / case.velocity / share)


def columns(cases: list[Impact]) -> dict[str, np.ndarray]:
    rows = [
        {**case.motion, "step": case.step, "stop_velocity": case.stop_velocity} for case in cases
    ]
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


@pytest.mark.parametrize("scheme", SCHEMES)
@given(cases=st.lists(impacts(), min_size=1, max_size=12))
@settings(max_examples=60, deadline=None)
def test_each_case_is_the_same_double_as_alone(scheme: str, cases: list[Impact]) -> None:
    depth, steps = run_many(**columns(cases), scheme=scheme)
    sheets = [run(case, scheme) for case in cases]
    assert depth.tolist() == [sheet.final_depth for sheet in sheets]
    assert steps.tolist() == [sheet.steps for sheet in sheets]


def test_cases_beyond_one_block_keep_their_places() -> None:
    velocities = np.linspace(2000, 0.5, 9001)
    depth, steps = run_many(velocities, 11e-6, 8900.0, 7850.0, 3.5e9, step=2e-9)
    for k in (0, 1, 4095, 4096, 8999, 9000):
        sheet = run(replace(BETA_5, velocity=float(velocities[k]), step=2e-9))
        assert (depth[k], steps[k]) == (sheet.final_depth, sheet.steps)


def test_cases_broadcast_and_a_single_one_is_a_scalar() -> None:
    depth, steps = run_many([[500.0], [400.0]], 11e-6, 8900.0, 7850.0, [2.1e9, 3.5e9])
    assert depth.shape == steps.shape == (2, 2)
    assert steps[0].tolist() == [run(BETA_3).steps, run(BETA_5).steps]
    assert run_many(**BETA_5.motion)[0] == run(BETA_5).final_depth


def test_too_many_steps_are_refused_by_index() -> None:
    with pytest.raises(ValueError, match=r"sheet\[1\] would take about 2\.6\d+e\+10 steps"):
        run_many(**BETA_5.motion, step=[2e-10, 1e-18])
    with pytest.raises(ValueError, match=r"radius\[0, 1\] is nan: it must be a finite"):
        run_many(500.0, [[1e-6, np.nan]], 8900.0, 7850.0, 3.5e9)
    with pytest.raises(ValueError, match="no scheme 'upwind': choose one of published"):
        run_many(**BETA_5.motion, scheme="upwind")


def test_containers_give_their_like() -> None:
    velocities, radii = np.linspace(300, 600, 12), np.linspace(5e-6, 2e-5, 12)
    rest = (8900.0, 7850.0, 3.5e9)
    depth, steps = run_many(velocities, radii, *rest, step=2e-9)
    series = run_many(pd.Series(velocities), pd.Series(radii[::-1], range(11, -1, -1)), *rest, 2e-9)
    lazy = run_many(dask.array.from_array(velocities, 5), radii, *rest, 2e-9)
    table = run_many(
        xarray.DataArray(velocities, dims="v"), xarray.DataArray(radii, dims="r"), *rest
    )
    for plain, one, other in zip((depth, steps), series, lazy, strict=True):
        assert isinstance(one, pd.Series)
        assert isinstance(other, dask.array.Array)
        assert other.dtype == plain.dtype
        np.testing.assert_array_equal(one, plain)
        np.testing.assert_array_equal(other.compute(), plain)
    assert table[0].dims == ("v", "r")
    assert table[1].values[3, 4] == run_many(velocities[3], radii[4], *rest)[1]
    with pytest.raises(ValueError, match=r"^the sheet\[b\] would take about"):
        run_many(500.0, 1e-6, *rest, step=pd.Series([2e-9, 1e-18], ["a", "b"]))


def test_parts_are_the_whole_and_refusals_keep_their_index(monkeypatch: pytest.MonkeyPatch) -> None:
    velocities, resistances = np.linspace(1, 900, 30)[:, None], np.array([2.1e9, 3.5e9])
    rest = (11e-6, 8900.0, 7850.0, resistances)
    whole = run_many(velocities, *rest, step=2e-9)
    monkeypatch.setattr("replication.midpoint_many._AT_ONCE", 7)
    for part, one in zip(run_many(velocities, *rest, step=2e-9), whole, strict=True):
        np.testing.assert_array_equal(part, one)
    steps = np.full((30, 2), 2e-9)
    steps[17, 1] = 1e-18
    with pytest.raises(ValueError, match=r"^the sheet\[17, 1\] would take about"):
        run_many(velocities, *rest, step=steps)

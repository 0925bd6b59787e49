"""The closed form over arrays, against the exact motion in 30 digits."""

import inspect
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import dask.array
import numpy as np
import pandas as pd
import pytest
import xarray
from hypothesis import given, settings
from hypothesis import strategies as st

from reference.trajectory import Trajectory
from replication import closed_form
from replication.impact import BETA_5
from replication.midpoint import run

ULP = 2.0**-52
CASE = (500.0, 11e-6, 8900.0, 7850.0, 3.5e9)


def spread(low: float, high: float) -> st.SearchStrategy[float]:
    """Evenly over the logarithm."""
    return st.floats(np.log10(low), np.log10(high)).map(lambda power: 10.0**power)


CASES = st.tuples(
    spread(1e-6, 1e5), spread(1e-9, 1), spread(1, 1e5), spread(1, 1e5), spread(1e3, 1e13)
)
"""Shallow to hypervelocity, most of the deep ones beyond the radius."""

SHARE = st.floats(1e-6, 0.999)


def exact(case: tuple[float, ...]) -> Trajectory:
    return Trajectory(*(Fraction(value) for value in case), digits=30)


def roundings(motion: Trajectory) -> float:
    """64 ulp, and those of the exponent k W of v^2, each of which is relative to all of it."""
    return (64 + 16 * float(2 * motion.drag * motion._c)) * ULP


@given(case=CASES, share=SHARE)
@settings(max_examples=12, deadline=None)
def test_depth_velocity_and_time_follow_the_exact_motion(
    case: tuple[float, ...], share: float
) -> None:
    motion = exact(case)
    bound, v = roundings(motion), share * case[0]
    depth = float(motion.depth_at_velocity(Fraction(v)))
    # A depth that is short of the last by a share s loses 1 / 2s of its ulps in v and time.
    left = max(float(1 - motion.depth_at_velocity(Fraction(v)) / motion.final_depth), ULP)
    near_rest = bound / left
    assert closed_form.depth_at_velocity(v, *case) == pytest.approx(depth, rel=bound / (1 - share))
    assert closed_form.stop_time(*case, stop_velocity=v) == pytest.approx(
        float(motion.stop_time(Fraction(v))), rel=bound / (1 - share)
    )
    if depth >= motion.final_depth:
        return
    assert closed_form.velocity_at_depth(depth, *case) == pytest.approx(
        float(motion.velocity_at_depth(Fraction(depth))), rel=near_rest
    )
    assert closed_form.time_to_depth(depth, *case) == pytest.approx(
        float(motion.time_to_depth(Fraction(depth))), rel=near_rest
    )


@given(case=CASES, share=st.floats(0, 1))
@settings(max_examples=12, deadline=None)
def test_history_is_exact_to_thirteen_digits(case: tuple[float, ...], share: float) -> None:
    motion = exact(case)
    stop = float(motion.stop_time())
    assert closed_form.stop_time(*case) == pytest.approx(stop, rel=roundings(motion))
    time = share * stop
    depth, velocity = closed_form.history(time, *case)
    expected = motion.depth_at_time(Fraction(time))
    assert abs(depth - float(expected)) <= 1e-13 * motion.final_depth
    assert abs(velocity - float(motion.velocity_at_depth(expected))) <= 1e-13 * case[0]


def test_history_from_touch_to_rest() -> None:
    for velocity in (1e-6, 500.0, 1500.0, 1e5):
        case = (velocity, *CASE[1:])
        stop = closed_form.stop_time(*case)
        depth, speed = closed_form.history([0.0, stop, 2 * stop, 1e9], *case)
        final = closed_form.final_depth(*case)
        assert (depth[0], speed[0]) == (0.0, velocity)
        assert depth[1:].tolist() == [final] * 3
        assert speed[1:].tolist() == [0.0] * 3


def test_histories_broadcast_in_any_order() -> None:
    velocities = np.geomspace(1, 5000, 150)
    times = np.linspace(0, 3e-8, 300)
    rows = closed_form.history(times, velocities[:, None], *CASE[1:])
    columns = closed_form.history(times[:, None], velocities, *CASE[1:])
    for row, column in zip(rows, columns, strict=True):
        assert row.shape == (150, 300)
        np.testing.assert_array_equal(row, column.T)
    for k in (0, 63, 64, 149):
        alone = closed_form.history(times, velocities[k], *CASE[1:])
        for part, whole in zip(alone, rows, strict=True):
            # A case alone is computed with plain floats; log1p may differ by an ulp.
            np.testing.assert_allclose(part, whole[k], rtol=0, atol=1e-13 * whole[k].max())


@pytest.mark.parametrize("size", [1, 7, 100])
def test_a_case_does_not_depend_on_those_beside_it(size: int) -> None:
    powers = np.random.default_rng(1).uniform(-1, 1, (6, 700))
    middle = (10.0, 1e-5, 1e3, 1e3, 1e9)
    case = [value * 10.0 ** (3 * power) for value, power in zip(middle, powers, strict=False)]
    share = abs(powers[-1])
    stop, final = closed_form.stop_time(*case), closed_form.final_depth(*case)
    calls: list[tuple[Callable[..., Any], list[Any]]] = [
        (closed_form.final_depth, case),
        (closed_form.stop_time, case),
        (closed_form.time_to_depth, [0.99 * share * final, *case]),
        (closed_form.history, [share * stop, *case]),
    ]
    for function, inputs in calls:
        whole = np.array(function(*inputs))
        blocks = [slice(first, first + size) for first in range(0, 700, size)]
        parts = [np.array(function(*(value[block] for value in inputs))) for block in blocks]
        np.testing.assert_array_equal(np.concatenate(parts, axis=-1), whole)


@given(case=CASES)
@settings(max_examples=100, deadline=None)
def test_at_the_stop_time_the_history_is_at_rest(case: tuple[float, ...]) -> None:
    depth, speed = closed_form.history(closed_form.stop_time(*case), *case)
    assert (depth, speed) == (closed_form.final_depth(*case), 0.0)


FUNCTIONS: dict[str, tuple[float, ...]] = {
    "final_depth": CASE,
    "normalized_depth": (CASE[0], *CASE[2:]),
    "depth_at_velocity": (100.0, *CASE),
    "velocity_at_depth": (4e-6, *CASE),
    "time_to_depth": (4e-6, *CASE),
    "stop_time": (*CASE, 1.0),
    "history": (5e-9, *CASE),
}
VARIED = np.linspace(1.0, 1.2, 40_000)


def columns(name: str) -> list[Any]:
    """Its arguments, the last three as arrays longer than a block."""
    values = FUNCTIONS[name]
    return [*values[:-3], *(value * VARIED for value in values[-3:])]


def both(results: Any) -> list[np.ndarray]:
    return [np.asarray(result) for result in (results if isinstance(results, tuple) else [results])]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_arrays_hold_what_single_cases_give(name: str) -> None:
    function = getattr(closed_form, name)
    some = [0, 1, 20_000, 39_999]
    short = [np.asarray(v)[some] if np.ndim(v) else v for v in columns(name)]
    for place in range(len(some)):
        alone = both(function(*(np.asarray(v)[place] if np.ndim(v) else v for v in short)))
        for one, all_of_them in zip(alone, both(function(*short)), strict=True):
            # Vector and scalar loops of log1p, tan and arcsin may differ by an ulp each.
            assert one == pytest.approx(all_of_them[place], rel=64 * ULP)


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if name != "history"])
def test_series_and_labeled_and_lazy_arrays(name: str) -> None:
    function: Callable[..., Any] = getattr(closed_form, name)
    plain = columns(name)
    expected = function(*plain)
    index = np.arange(len(VARIED))[::-1]
    series = function(*(pd.Series(v, index) if np.ndim(v) else v for v in plain))
    labeled = function(*(xarray.DataArray(v, dims="case") if np.ndim(v) else v for v in plain))
    lazy = function(*(dask.array.from_array(v, 16384) if np.ndim(v) else v for v in plain))
    both_kinds = function(
        *(xarray.DataArray(v, dims="case").chunk(case=16384) if np.ndim(v) else v for v in plain)
    )
    assert isinstance(series, pd.Series)
    assert series.index.tolist() == index.tolist()
    assert labeled.dims == ("case",)
    assert isinstance(lazy, dask.array.Array)
    assert isinstance(both_kinds.data, dask.array.Array)
    for result in (series, labeled, lazy, both_kinds):
        np.testing.assert_array_equal(np.asarray(result), expected)


def test_histories_of_series_and_lazy_arrays() -> None:
    times, velocities = np.linspace(0, 2e-8, 20), np.linspace(300, 900, 20)
    expected = closed_form.history(times, velocities, *CASE[1:])
    series = closed_form.history(pd.Series(times), pd.Series(velocities), *CASE[1:])
    lazy = closed_form.history(dask.array.from_array(times, 20), velocities, *CASE[1:])
    grid = closed_form.history(
        xarray.DataArray(times, dims="time"), xarray.DataArray(velocities, dims="case"), *CASE[1:]
    )
    for plain, one, other, table in zip(expected, series, lazy, grid, strict=True):
        assert isinstance(one, pd.Series)
        np.testing.assert_array_equal(one, plain)
        np.testing.assert_array_equal(other.compute(), plain)
        np.testing.assert_allclose(np.diag(table), plain, rtol=0, atol=1e-13 * plain.max())


@pytest.mark.parametrize("name", FUNCTIONS)
def test_bad_elements_are_named_by_index(name: str) -> None:
    function = getattr(closed_form, name)
    names = list(inspect.signature(function).parameters)
    for place, argument in enumerate(names):
        for bad in (np.nan, np.inf, -1.0):
            values: list[Any] = list(FUNCTIONS[name])
            values[place] = [[values[place], bad]]
            with pytest.raises(ValueError, match=rf"^{argument}\[0, 1\] is {bad}: it must be a"):
                function(*values)


@pytest.mark.parametrize(
    ("function", "first", "message"),
    [
        ("depth_at_velocity", [1.0, 501.0], r"at_velocity\[1\] is 501.*must not exceed the impact"),
        ("velocity_at_depth", [1e-6, 8e-6], r"at_depth\[1\] is 8e-06.*exceed the final depth"),
        ("time_to_depth", [1e-6, 8e-6], r"at_depth\[1\] is 8e-06.*exceed the final depth"),
    ],
)
def test_what_never_happens_is_refused(function: str, first: list[float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        getattr(closed_form, function)(first, *CASE)


def test_a_result_beyond_doubles_is_refused() -> None:
    with pytest.raises(ValueError, match=r"velocity\[1\] is 1e\+200.*beyond the range of doubles"):
        closed_form.final_depth([1.0, 1e200], *CASE[1:])


@pytest.mark.parametrize("velocity", [1e-200, 1e200])
def test_a_history_beyond_doubles_is_refused(velocity: float) -> None:
    with pytest.raises(ValueError, match=r"velocity\[1\] is 1e.200.*beyond the range of doubles"):
        closed_form.history(1e-9, [1.0, velocity, 500.0], *CASE[1:])


def test_a_history_begins_before_a_tail_many_times_as_long() -> None:
    # From 1e30 m/s, rest takes 1e28 times as long as the first tenth of the radius.
    time = np.array([1e-40, 1e-37])
    depth, speed = closed_form.history(time, [[1e30], [500.0]], *CASE[1:])
    np.testing.assert_allclose(depth, [1e30 * time, 500.0 * time], rtol=1e-3)
    assert (speed[0] < 1e30).all()


def test_nothing_in_nothing_out() -> None:
    assert closed_form.final_depth([], *CASE[1:]).shape == (0,)
    assert closed_form.stop_time(np.zeros((0, 3)), *CASE[1:]).shape == (0, 3)
    assert closed_form.history([], *CASE)[0].shape == (0,)


def test_the_sheet_stops_in_the_row_in_which_the_exact_motion_does() -> None:
    sheet = run(BETA_5)
    stop = closed_form.stop_time(**BETA_5.motion, stop_velocity=BETA_5.stop_velocity)
    assert sheet.rows[-2].time < stop < sheet.rows[-1].time


def test_stop_time_at_rest_when_the_last_digits_of_the_depth_disagree() -> None:
    case = (1.0, 1.0, 1.0, 1.0, 10.0**5.3515625)
    motion = exact(case)
    assert closed_form.stop_time(*case) == pytest.approx(float(motion.stop_time()), rel=1e-14)

"""The closed form over arrays, against the exact motion in 30 digits."""

import inspect
import pickle
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import dask.array
import numpy as np
import pandas as pd
import pint
import pytest
import xarray
from hypothesis import given, settings
from hypothesis import strategies as st
from reference.trajectory import Trajectory

from replication import closed_form
from replication.closed_form.checked import ElementError, checked
from replication.impact import BETA_5, Impact
from replication.midpoint import run
from replication.midpoint_many import run_many

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
        together = np.concatenate(parts, axis=-1)
        if size == 1:
            # One case alone is computed in plain floats, whose functions may differ by an ulp.
            # A history keeps to its 1e-13 of that.
            np.testing.assert_allclose(together, whole, rtol=1e-13)
        else:
            np.testing.assert_array_equal(together, whole)


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


def test_labels_units_and_names_of_the_inputs_are_not_the_results() -> None:
    velocity = xarray.DataArray([400.0, 500.0], {"case": ["a", "b"]}, name="velocity")
    velocity.attrs["units"] = "m/s"
    with xarray.set_options(keep_attrs=True):
        found = (
            closed_form.final_depth(velocity, *CASE[1:]),
            *closed_form.history(1e-9, velocity, *CASE[1:]),
        )
    for result in found:
        assert (result.name, result.attrs) == (None, {})
        assert result.case.values.tolist() == ["a", "b"]


def test_series_are_matched_by_label_and_bad_ones_named_by_it() -> None:
    velocity = pd.Series([400.0, 500.0], ["a", "b"])
    radius = pd.Series([2e-5, 1e-5], ["b", "a"])
    matched = closed_form.final_depth(velocity, radius, *CASE[2:])
    assert matched["b"] == closed_form.final_depth([500.0, 1.0], 2e-5, *CASE[2:])[0]
    refusals: list[tuple[Any, Any, type[Exception], str]] = [
        (
            pd.Series([1.0, -1.0], ["a", "b"]),
            radius,
            ValueError,
            r"^velocity\[b\] is -1\.0: it must",
        ),
        (
            pd.Series([1.0, 1.0], ["a", "c"]),
            radius,
            ValueError,
            "^velocity has nothing for the labe",
        ),
        (
            velocity,
            radius.iloc[:1],
            ValueError,
            "^radius has nothing for the label a, which others",
        ),
        (
            velocity,
            [1e-5],
            TypeError,
            r"^radius is a list of shape \(1,\): beside a Series give a S",
        ),
        (
            velocity,
            radius.to_frame(),
            TypeError,
            r"^radius is a DataFrame of shape \(2, 1\): beside",
        ),
        (velocity, -1.0, ValueError, r"^radius is -1\.0: it must be"),
        (velocity.to_frame(), 1e-5, TypeError, "a Series is wanted for each input: take columns"),
    ]
    for first, second, kind, message in refusals:
        with pytest.raises(kind, match=message):
            closed_form.final_depth(first, second, *CASE[2:])
    with pytest.raises(
        ValueError, match=r"^velocity\[b\] is 1\.0.*at_velocity must not|^at_velocity\[b"
    ):
        closed_form.depth_at_velocity(2.0, pd.Series([3.0, 1.0], ["a", "b"]), *CASE[1:])


def test_lazy_arrays_in_any_chunks_and_beside_others() -> None:
    velocity, radius = np.linspace(300, 900, 30), np.linspace(1e-6, 1e-4, 30)
    expected = closed_form.final_depth(velocity, radius, *CASE[2:])
    lazy = dask.array.from_array(velocity, 7)
    for other in (radius, dask.array.from_array(radius, 11), radius.tolist()):
        np.testing.assert_array_equal(closed_form.final_depth(lazy, other, *CASE[2:]), expected)
    table = closed_form.final_depth(lazy[:, None], dask.array.from_array(radius, 4), *CASE[2:])
    assert table.shape == (30, 30)
    np.testing.assert_array_equal(np.diag(table.compute()), expected)
    labeled = closed_form.final_depth(
        xarray.DataArray(lazy, dims="case"), xarray.DataArray(radius, dims="case"), *CASE[2:]
    )
    assert isinstance(labeled.data, dask.array.Array)
    np.testing.assert_array_equal(labeled, expected)


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (
            np.ma.masked_greater([400.0, 500.0], 450.0),
            "^velocity is a masked array: give the cases",
        ),
        (np.array([400.0 + 1j]), "^velocity is complex: real numbers are wanted"),
        (500 + 0j, "^velocity is complex: real numbers are wanted"),
        (
            pint.UnitRegistry().Quantity([400.0], "m/s"),
            "^velocity has units: give its magnitude in",
        ),
    ],
)
def test_what_is_no_real_number_is_refused(value: Any, message: str) -> None:
    for function in (closed_form.final_depth, run_many):
        with pytest.raises(TypeError, match=message):
            function(value, *CASE[1:])


def test_a_refusal_can_be_sent_to_another_process() -> None:
    error = pickle.loads(pickle.dumps(ElementError("radius{place} is 0", (3,))))
    assert (str(error), error.index) == ("radius[3] is 0", (3,))


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


@pytest.mark.parametrize(
    ("place", "bad", "formed"),
    [
        (0, 1e200, r"velocity squared\[1\] is inf"),
        (0, 1e-170, r"velocity squared\[1\] is 0.0"),
        (1, 1e130, r"particle mass\[1\] is inf"),
        (1, 1e-126, r"particle mass\[1\] is 0.0"),
        (2, 1e251, r"particle density\[1\] is 1e\+251"),
        (4, 1e-260, r"target resistance\[1\] is 1e-260"),
        (4, 1e260, r"target resistance\[1\] is 1e\+260"),
    ],
)
def test_what_would_leave_the_range_of_doubles_is_refused(
    place: int, bad: float, formed: str
) -> None:
    values: list[Any] = list(CASE)
    values[place] = [CASE[place], bad]
    with pytest.raises(ValueError, match=f"^{formed}: doubles carry 1e-250 to 1e250 safely .*is "):
        closed_form.final_depth(*values)
    with pytest.raises(ValueError, match="doubles carry 1e-250 to 1e250 safely"):
        closed_form.history(1e-9, *values)
    values[place] = bad
    with pytest.raises(ValueError, match="doubles carry 1e-250 to 1e250 safely"):
        closed_form.final_depth(*values)


INPUT = st.one_of(spread(1e-40, 1e40), spread(1e-300, 1e300))


@given(st.tuples(INPUT, INPUT, INPUT, INPUT, INPUT))
@settings(max_examples=500, deadline=None)
def test_the_range_is_that_of_a_single_impact(case: tuple[float, ...]) -> None:
    names = ("velocity", "radius", "particle_density", "target_density", "resistance")
    inputs = dict(zip(names, case, strict=True))

    def refused(function: Callable[..., Any], **inputs: Any) -> str:
        try:
            function(**inputs)
        except ValueError as error:
            return str(error)
        return ""

    one = refused(Impact, **inputs, step=1.0)
    assert bool(one) == bool(refused(closed_form.final_depth, **inputs))
    assert bool(one) == bool(refused(checked, inputs=inputs))
    if all(1e-40 <= value <= 1e40 for value in case):
        assert not one


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


@given(case=CASES)
@settings(max_examples=200, deadline=None)
def test_one_case_in_plain_floats_is_that_of_arrays(case: tuple[float, ...]) -> None:
    alone = closed_form.final_depth(*case)
    among = closed_form.final_depth(*(np.full(3, value) for value in case))
    assert type(alone) is float
    # The Newton step takes out what a tangent's last digit did; sums and product round once each.
    np.testing.assert_allclose(among, alone, rtol=4 * 2**-52)


def test_one_case_out_of_range_is_told_apart() -> None:
    with pytest.raises(ValueError, match=r"radius is -1\.0: it must be a finite number greater"):
        closed_form.final_depth(500.0, -1.0, 8900.0, 7850.0, 3.5e9)
    with pytest.raises(ValueError, match="velocity is 1e-200"):
        closed_form.final_depth(1e-200, 1e-5, 8900.0, 7850.0, 3.5e9)

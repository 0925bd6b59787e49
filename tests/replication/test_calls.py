"""Calls from Python at the edges of what they take: what they give, or why they are refused."""

import pickle
import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import dask.array
import numpy as np
import pandas as pd
import pint
import pytest
import xarray

from replication import (
    BETA_5,
    Impact,
    depth_at_velocity,
    final_depth,
    history,
    run,
    run_many,
    stop_time,
    time_to_depth,
    velocity_at_depth,
)
from replication.cases import changed, inputs_of, read_case
from replication.models.impact import InputError

CASE = (500.0, 11e-6, 8900.0, 7850.0, 3.5e9)
"""The five inputs of beta-5, the velocity first."""
VELOCITY, *REST = CASE
RADIUS, *MATERIALS = REST
METERS_PER_SECOND: Any = pint.UnitRegistry().meter_per_second

Call = Callable[..., Any]


def refused(kind: type[Exception], message: str, call: Call, *arguments: Any, **more: Any) -> None:
    """Check that a call raises an error with this message."""
    with pytest.raises(kind, match=f"^{re.escape(message)}$"):
        call(*arguments, **more)


# What is at the edge and has a value


def test_below_the_stop_velocity_no_step_is_taken() -> None:
    sheet = run(replace(BETA_5, velocity=0.5))
    assert (sheet.steps, sheet.final_depth) == (0, 0.0)


def test_at_the_stop_velocity_one_step_is_taken() -> None:
    assert run(replace(BETA_5, velocity=1.0, stop_velocity=1.0)).steps == 1
    assert run_many(1.0, *REST, stop_velocity=1.0)[1] == 1


def test_at_impact_time_and_depth_are_zero() -> None:
    assert stop_time(*CASE, stop_velocity=VELOCITY) == 0
    assert time_to_depth(0.0, *CASE) == 0
    assert depth_at_velocity(VELOCITY, *CASE) == 0
    rounding = 4 * 2.0**-52  # of a few operations
    assert velocity_at_depth(0.0, *CASE) == pytest.approx(VELOCITY, rel=rounding, abs=0)


def test_the_final_depth_is_reached_at_the_stop_time() -> None:
    assert time_to_depth(final_depth(*CASE), *CASE) == stop_time(*CASE)
    assert history(np.nextafter(stop_time(*CASE), 0), *CASE)[1] == 0


def test_at_1e30_m_per_s_rest_takes_1e28_times_as_long_as_the_first_tenth_of_the_radius() -> None:
    depths, velocities = history([1e-40, 1e-37], 1e30, *REST)
    assert depths == pytest.approx([1e-10, 1e-7], rel=1e-3, abs=0)
    assert (velocities < 1e30).all()


@pytest.mark.parametrize(
    ("call", "inputs", "shape"),
    [
        (final_depth, ([], *REST), (0,)),
        (stop_time, (np.zeros((0, 3)), *REST), (0, 3)),
        (history, ([], *CASE), (0,)),
        (history, (np.zeros((0, 1)), [500.0], *REST), (0, 1)),
        (run_many, ([], *REST), (0,)),
    ],
)
def test_no_cases_give_no_results(call: Call, inputs: Any, shape: tuple[int, ...]) -> None:
    results = call(*inputs)
    for result in results if isinstance(results, tuple) else (results,):
        assert result.shape == shape


def test_functions_name_their_inputs() -> None:
    names = "(velocity, radius, particle_density, target_density, resistance)"
    assert str(vars(final_depth)["__signature__"]) == names


# Containers


def test_a_series_beside_an_array_of_dask() -> None:
    shared = final_depth(pd.Series([400.0, 500.0]), 1e-5 * dask.array.ones(2), *MATERIALS)
    assert shared.compute().tolist() == final_depth([400.0, 500.0], 1e-5, *MATERIALS).tolist()


def test_an_index_of_pandas() -> None:
    assert final_depth(pd.Index([500.0]), *REST).tolist() == [final_depth(*CASE)]


def test_a_variable_of_xarray() -> None:
    assert final_depth(xarray.Variable("case", [500.0]), *REST).dims == ("case",)


def test_series_meet_by_their_labels() -> None:
    velocity = pd.Series([400.0, 500.0], ["a", "b"])
    radius = pd.Series([2e-5, 1e-5], ["b", "a"])
    assert final_depth(velocity, radius, *MATERIALS)["b"] == final_depth(500.0, 2e-5, *MATERIALS)


def test_series_with_the_same_labels_may_repeat_one() -> None:
    labels = ["a", "b", "b"]
    velocity = pd.Series([400.0, 500.0, 500.0], labels)
    radius = pd.Series([1e-5, 2e-5, 2e-5], labels)
    assert final_depth(velocity, radius, *MATERIALS).index.tolist() == labels


def test_a_run_as_a_frame() -> None:
    sheet = run(BETA_5)
    frame = sheet.frame()
    assert frame.index.name == "row"
    assert list(frame.columns) == [
        "time", "velocity_initial", "depth", "deceleration", "velocity_final",
    ]  # fmt: skip
    assert {str(kind) for kind in frame.dtypes} == {"float64"}
    assert frame.iloc[0].tolist()[:4] == [0.0, 500.0, 0.0, 0.0]
    assert np.isnan(frame.iloc[0]["velocity_final"])
    assert frame.to_numpy().tolist()[1:] == [list(row) for row in sheet.rows[1:]]


# Containers and kinds of numbers that are refused

REAL = "velocity must hold real numbers, in SI units"


@pytest.mark.parametrize("call", [final_depth, run_many])
@pytest.mark.parametrize(
    ("velocity", "message"),
    [
        pytest.param(
            np.ma.masked_greater([400.0, 500.0], 450.0),
            "velocity is a masked array: give the cases that are not masked",
            id="masked",
        ),
        pytest.param([400 + 1j], f"{REAL}, not complex128", id="complex list"),
        pytest.param(500 + 0j, f"{REAL}, not complex128", id="complex"),
        pytest.param(
            [400.0] * METERS_PER_SECOND,
            "velocity has units: give its magnitude in SI units",
            id="with unit",
        ),
    ],
)
def test_velocities_of_a_wrong_kind(call: Call, velocity: Any, message: str) -> None:
    refused(TypeError, message, call, velocity, *REST)


NO_FLOAT = f"{REAL}: float() argument must be a string or a real number, not"


@pytest.mark.parametrize(
    ("velocity", "message"),
    [
        pytest.param(pd.Timestamp("2020"), f"{NO_FLOAT} 'Timestamp'", id="time stamp"),
        pytest.param(None, f"{NO_FLOAT} 'NoneType'", id="none"),
        pytest.param(10**400, f"{REAL}: int too large to convert to float", id="too large"),
        pytest.param(pd.Series(["400", "500"]), f"{REAL}, not '400'", id="texts"),
        pytest.param(
            np.array([np.datetime64("2020")], object),
            f"{REAL}, not np.datetime64('2020')",
            id="dates",
        ),
        pytest.param(
            xarray.Dataset({"v": ("case", [500.0])}),
            "velocity is a Dataset: give its variables, each a DataArray",
            id="dataset",
        ),
        pytest.param(
            pd.DataFrame([1.0]),
            "velocity is a DataFrame: give its columns, each a Series",
            id="frame",
        ),
    ],
)
def test_what_is_no_column_of_numbers(velocity: Any, message: str) -> None:
    refused(TypeError, message, final_depth, velocity, *REST)


def test_an_input_given_twice() -> None:
    message = "final_depth() got multiple values for argument 'velocity'"
    refused(TypeError, message, final_depth, *CASE, velocity=100.0)


AB = pd.Series([1.0, 1.0], ["a", "b"])


@pytest.mark.parametrize(
    ("velocity", "radius", "kind", "message"),
    [
        pytest.param(
            pd.Series([1.0, -1.0], ["a", "b"]), pd.Series([2e-5, 1e-5], ["b", "a"]), InputError,
            "velocity[b] is -1.0: it must be a finite number greater than zero",
            id="named by label",
        ),
        pytest.param(
            pd.Series([1.0, 1.0, 1.0], ["a", "b", "c"]), pd.Series([2e-5, 1e-5], ["b", "a"]),
            ValueError, "radius must have the labels of the first Series, so c too",
            id="last label missing",
        ),
        pytest.param(
            AB, pd.Series([2e-5], ["b"]), ValueError,
            "radius must have the labels of the first Series, so a too", id="first label missing",
        ),
        pytest.param(
            AB, pd.Series([1e-5, 2e-5, 2e-5], ["a", "b", "b"]), ValueError,
            "radius has more than one value for the label b", id="label twice",
        ),
        pytest.param(
            AB, pd.DataFrame([2e-5]), TypeError,
            "radius is a DataFrame: give its columns, each a Series", id="frame",
        ),
        pytest.param(
            AB, -1.0, InputError, "radius is -1.0: it must be a finite number greater than zero",
            id="number beside a Series",
        ),
        pytest.param(
            pd.Series([1.0, 1.0]), np.ones((3, 2)), ValueError,
            "beside a Series of 2 values arrays must not make it (3, 2)", id="more dimensions",
        ),
        pytest.param(
            pd.Series([1.0, 1.0]), np.ones(3), ValueError,
            "arrays of these shapes do not broadcast: velocity (2,), radius (3,)", id="Series",
        ),
        pytest.param(
            dask.array.ones(2), np.ones(3), ValueError,
            "arrays of these shapes do not broadcast: velocity (2,), radius (3,)", id="dask",
        ),
        pytest.param(
            [400.0, 500.0], [1e-5, 2e-5, 3e-5], ValueError,
            "arrays of these shapes do not broadcast: velocity (2,), radius (3,)", id="lists",
        ),
        pytest.param(
            xarray.DataArray([4e2, 5e2]), pd.Series([2e-5, 1e-5]), TypeError,
            "radius is a pandas object: beside an xarray array give its values", id="xarray",
        ),
    ],
)  # fmt: skip
def test_columns_that_do_not_fit_each_other(
    velocity: Any, radius: Any, kind: type[Exception], message: str
) -> None:
    refused(kind, message, final_depth, velocity, radius, *MATERIALS)


def test_a_bad_number_in_a_chunk_of_dask() -> None:
    lazy = final_depth(dask.array.from_array(np.array([300.0, -900.0]), 1), *REST)
    message = "velocity[0] of its chunk is -900.0: it must be a finite number greater than zero"
    refused(InputError, message, lazy.compute)


# Numbers that are refused


@pytest.mark.parametrize(
    ("times", "kind", "message"),
    [
        (
            np.array([10], "m8[ns]"),
            TypeError,
            "time must hold real numbers, in SI units, not timedelta64[ns]",
        ),
        (
            np.array([0, 1j]),
            TypeError,
            "time must hold real numbers, in SI units, not complex128",
        ),
        (
            np.array([0, np.nan]),
            InputError,
            "time[1] is nan: it must be a finite number, zero or more",
        ),
        (
            np.array([0, np.inf]),
            InputError,
            "time[1] is inf: it must be a finite number, zero or more",
        ),
        (
            np.array([0, -1e-9]),
            InputError,
            "time[1] is -1e-09: it must be a finite number, zero or more",
        ),
    ],
)
def test_times_that_are_none(times: Any, kind: type[Exception], message: str) -> None:
    refused(kind, message, history, times, *CASE)


def test_a_bad_radius_beside_many_times() -> None:
    message = "radius is -1.0: it must be a finite number greater than zero"
    refused(InputError, message, history, np.array([0, 1e-9]), VELOCITY, -1.0, *MATERIALS)


@pytest.mark.parametrize(
    ("call", "reached", "message"),
    [
        (
            depth_at_velocity,
            [1.0, 501.0],
            "at_velocity[1] is 501.0: it must not exceed the impact velocity",
        ),
        (
            velocity_at_depth,
            [1e-6, 8e-6],
            "at_depth[1] is 8e-06: it must not exceed the final depth",
        ),
        (
            time_to_depth,
            [1e-6, 8e-6],
            "at_depth[1] is 8e-06: it must not exceed the final depth",
        ),
        (time_to_depth, 8e-6, "at_depth is 8e-06: it must not exceed the final depth"),
    ],
)
def test_what_is_never_reached(call: Call, reached: Any, message: str) -> None:
    refused(InputError, message, call, reached, *CASE)


def test_a_stop_velocity_above_the_impact_velocity() -> None:
    message = "stop_velocity is 501.0: it must not exceed the impact velocity"
    refused(InputError, message, stop_time, *CASE, stop_velocity=501)


EXTREME = [
    pytest.param(
        ([500.0, 1e200], *REST), "velocity squared[1] is inf: doubles carry 1e-250 to 1e250 safely",
        "velocity 1e+200, radius 1.1e-05, particle_density 8900.0, target_density 7850.0, "
        "resistance 3500000000.0", id="fast",
    ),
    pytest.param(
        ([500.0, 1e-170], *REST),
        "velocity squared[1] is 0.0: doubles carry 1e-250 to 1e250 safely",
        "velocity 1e-170, radius 1.1e-05, particle_density 8900.0, target_density 7850.0, "
        "resistance 3500000000.0", id="slow",
    ),
    pytest.param(
        (500.0, [1e-5, 1e130], *MATERIALS),
        "particle mass[1] is inf: it must be a number above zero",
        "velocity 500.0, radius 1e+130, particle_density 8900.0, target_density 7850.0, "
        "resistance 3500000000.0", id="large",
    ),
    pytest.param(
        (500.0, [1e-5, 1e-126], *MATERIALS),
        "particle mass[1] is 0.0: it must be a number above zero",
        "velocity 500.0, radius 1e-126, particle_density 8900.0, target_density 7850.0, "
        "resistance 3500000000.0", id="small",
    ),
    pytest.param(
        (*CASE[:4], [3.5e9, 1e260]),
        "target resistance[1] is 1e+260: doubles carry 1e-250 to 1e250 safely",
        "velocity 500.0, radius 1.1e-05, particle_density 8900.0, target_density 7850.0, "
        "resistance 1e+260", id="hard",
    ),
    pytest.param(
        (*CASE[:4], [3.5e9, 0.0]),
        "target resistance[1] is 0.0: nothing would bring the particle to rest",
        "velocity 500.0, radius 1.1e-05, particle_density 8900.0, target_density 7850.0, "
        "resistance 0.0", id="soft",
    ),
]  # fmt: skip
"""Inputs that doubles cannot carry through, what is said of them, and the case that is named."""


@pytest.mark.parametrize(("inputs", "what", "case"), EXTREME)
def test_inputs_too_extreme_for_a_depth(inputs: Any, what: str, case: str) -> None:
    refused(InputError, f"{what} (with {case})", final_depth, *inputs)


@pytest.mark.parametrize(("inputs", "what", "case"), EXTREME)
def test_inputs_too_extreme_for_a_history(inputs: Any, what: str, case: str) -> None:
    refused(InputError, f"{what} (with time 1e-09, {case})", history, 1e-9, *inputs)


@pytest.mark.parametrize(("inputs", "what", "case"), EXTREME)
def test_inputs_too_extreme_for_a_sheet(inputs: Any, what: str, case: str) -> None:
    message = f"{what} (with {case}, step 2e-10, stop_velocity 1.0)"
    refused(InputError, message, run_many, *inputs)


@pytest.mark.parametrize(("density", "ratio"), [(1e-160, "inf"), (1e160, "7.921e-313")])
def test_densities_too_unlike(density: float, ratio: str) -> None:
    message = (
        f"ratio of the densities squared is {ratio}: doubles carry 1e-250 to 1e250 safely (with "
        f"velocity 500.0, radius 1.1e-05, particle_density 8900.0, target_density {density}, "
        f"resistance {density}, stop_velocity 0.0)"
    )
    refused(InputError, message, stop_time, 500.0, 11e-6, 8900.0, density, density)


# Sheets that are refused


def too_long(step: str, stop: str, which: str = "") -> str:
    return (
        f"the sheet{which} takes more than 1,000,000 steps of {step} s down to {stop} m/s: take a "
        "larger step"
    )


@pytest.mark.parametrize(
    ("inputs", "settings", "message"),
    [
        (CASE, {"step": [1e-7, 1e-15], "stop_velocity": 1.0}, too_long("1e-15", "1.0", "[1]")),
        (
            (500.0, 1e-3, *MATERIALS),
            {"step": [1e-7, 1e-15]},
            too_long("1e-15", "1.0", "[1]"),
        ),
        (
            (*CASE[:4], 1.0),
            {"step": [1e-7, 2e-10], "stop_velocity": 0.01},
            too_long("2e-10", "0.01", "[1]"),
        ),
        (CASE, {"step": pd.Series([2e-9, 1e-18], ["a", "b"])}, too_long("1e-18", "1.0", "[b]")),
    ],
)
def test_one_sheet_of_many_that_takes_too_many_steps(
    inputs: Any, settings: dict[str, Any], message: str
) -> None:
    refused(InputError, message, run_many, *inputs, **settings)


@pytest.mark.parametrize(
    ("impact", "message"),
    [
        (replace(BETA_5, step=1e-15, radius=1e-3), too_long("1e-15", "1.0")),
        pytest.param(
            replace(BETA_5, beta=None, flow_stress=None, resistance=1.0, stop_velocity=0.01),
            too_long("2e-10", "0.01"),
            marks=pytest.mark.slow,
        ),
    ],
)
def test_a_sheet_that_takes_too_many_steps(impact: Impact, message: str) -> None:
    refused(InputError, message, run, impact)


def test_a_scheme_that_there_is_not() -> None:
    message = "there is no scheme 'upwind': choose one of published, centered"
    refused(ValueError, message, run, BETA_5, "upwind")
    refused(ValueError, message, run_many, *CASE, scheme="upwind")


def test_a_case_given_by_its_name() -> None:
    refused(TypeError, "give an Impact, such as BETA_5, not 'beta-5'", run, "beta-5")


# Cases


@pytest.mark.parametrize(
    ("velocity", "message"),
    [
        (None, "float() argument must be a string or a real number, not 'NoneType'"),
        ("500", "not '500'"),
        (True, "not True"),
    ],
)
def test_an_impact_has_numbers(velocity: Any, message: str) -> None:
    inputs = {**BETA_5.motion, "velocity": velocity}
    refused(InputError, f"velocity must be one number, in SI units: {message}", Impact, **inputs)


def test_an_impact_without_a_resistance() -> None:
    message = "give either resistance, or both beta and flow_stress"
    refused(ValueError, message, replace, BETA_5, beta=None)


def test_an_impact_by_its_resistance_has_no_beta_and_the_reports_step() -> None:
    assert inputs_of(Impact(**BETA_5.motion)) == {
        "velocity": 500.0, "radius": 1.1e-05, "particle_density": 8900.0, "target_density": 7850.0,
        "beta": None, "flow_stress": None, "resistance": 3.5e9, "step": 2e-10, "stop_velocity": 1.0,
    }  # fmt: skip


def test_whole_numbers_of_an_impact_become_doubles() -> None:
    impact = Impact(
        velocity=500, radius=1, particle_density=1, target_density=1, resistance=1, step=1
    )
    assert {type(value) for value in inputs_of(impact).values()} == {float, type(None)}
    assert impact.stop_velocity == BETA_5.stop_velocity


def test_a_resistance_takes_the_place_of_beta_and_flow_stress() -> None:
    case = read_case("beta-5", None, {"resistance": "2.1 GPa"})
    assert (case.beta, case.flow_stress, case.resistance) == (None, None, 2.1e9)
    assert {**inputs_of(case), "resistance": 3.5e9} == inputs_of(Impact(**BETA_5.motion))
    assert changed(case, {"beta": 3.0, "flow_stress": 7e8}).resistance is None


def test_inputs_in_other_units_are_the_same_case() -> None:
    texts = {"radius": "0.011 mm", "step": "0.2ns", "velocity": "0.5 km/s"}
    assert inputs_of(read_case("beta-5", None, texts)) == inputs_of(BETA_5)
    texts = {"target_density": "7.85 g/cm^3"}
    assert inputs_of(read_case("beta-5", None, texts)) == inputs_of(BETA_5)


def test_a_stress_in_ksi() -> None:
    """1 psi is 1 lbf/in^2: 4.4482216152605 N over (0.0254 m)^2."""
    stress = read_case("beta-5", None, {"flow_stress": "98 ksi"}).flow_stress
    assert stress == pytest.approx(98e3 * 4.4482216152605 / 0.0254**2, rel=1e-15, abs=0)


# Errors


def test_an_error_survives_pickling() -> None:
    error = pickle.loads(pickle.dumps(InputError("radius", "is 0", (3,))))
    assert str(error) == "radius[3] is 0"
    assert error.index == (3,)

"""Which input gives a depth: against many digits, against the depth itself, and where none does."""

import math
import warnings
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pandas as pd
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import replication
from reference.arithmetic import NoRootError, Reals
from reference.inverse import INVERSES
from reference.motion import Trajectory
from replication import final_depth
from replication.models import inverse
from replication.models.estimates import constant_pressure_depth
from replication.models.impact import InputError

NAMES = ("velocity", "radius", "particle_density", "target_density", "resistance")
BETA_5 = (500.0, 11e-6, 8900.0, 7850.0, 3.5e9)
ULP = 2.0**-52

THERE_AND_BACK = 12 * ULP
"""A value is right to 4 ulp of itself or of the depth, and no condition is below 1/2: this is 8 ulp
of the depth at most. The final depth of the value has 4 ulp of its own."""

Case = tuple[float, ...]


def spread(low: float, high: float) -> st.SearchStrategy[float]:
    """Draw floats uniformly in the logarithm."""
    return st.floats(0, 1).map(lambda power: low * (high / low) ** power)


CASES = st.tuples(
    spread(1e-6, 1e5), spread(1e-9, 1), spread(1, 1e5), spread(1, 1e5), spread(1e3, 1e13)
)
"""Inputs from shallow impacts to hypervelocity; most deep ones get beyond the radius."""

ALL_MAGNITUDES = st.tuples(*[spread(1e-40, 1e40)] * 5)
"""Whatever the formulas compute with unchecked."""


def but(name: str, case: Case) -> dict[str, float]:
    """Return the inputs of a case but one."""
    return {key: x for key, x in zip(NAMES, case, strict=True) if key != name}


def solved(name: str, depth: float, case: Case) -> float:
    """Return the input of this name that gives a depth, all else as the case."""
    function = getattr(replication, f"{name}_for_depth")
    return float(function(depth, **but(name, case)))


def condition(name: str, case: Case) -> float:
    velocity, _, *materials = case
    return abs(inverse.conditions(velocity, *materials)[name])


@pytest.mark.parametrize("name", NAMES)
@given(case=CASES)
@settings(max_examples=60, deadline=None)
def test_a_value_is_right_to_4_ulp_of_the_depth_and_of_itself(name: str, case: Case) -> None:
    """The depth is a double: half an ulp of it changes the value by half a condition."""
    depth = final_depth(*case)
    reals = Reals(40)
    numbers = {key: reals.number(Fraction(x)) for key, x in but(name, case).items()}
    try:
        exact = INVERSES[name](reals, reals.number(Fraction(depth)), **numbers)
    except NoRootError:
        return
    allowed = 4 * ULP * max(1.0, condition(name, case))
    if allowed < 1e-3:  # else no digit of a target density can be known
        assert abs(solved(name, depth, case) / exact - 1) <= allowed


@pytest.mark.parametrize("name", NAMES)
@given(case=ALL_MAGNITUDES)
@example(case=BETA_5)
@settings(max_examples=200, deadline=None)
def test_the_depth_of_the_value_is_the_depth_over_all_magnitudes(name: str, case: Case) -> None:
    """However ill-conditioned the value is."""
    depth = final_depth(*case)
    try:
        value = solved(name, depth, case)
    except InputError:  # the depth is to 4 ulp the limit, which tells nothing of the density
        velocity, radius, particle_density, _, resistance = case
        most = constant_pressure_depth(velocity, radius, particle_density, resistance)
        assert name == "target_density"
        assert depth == pytest.approx(most, rel=8 * ULP)
        return
    again = final_depth(**{**dict(zip(NAMES, case, strict=True)), name: value})
    assert again == pytest.approx(depth, rel=THERE_AND_BACK, abs=0)


@pytest.mark.parametrize("name", NAMES)
@given(case=CASES)
@settings(max_examples=60, deadline=None)
def test_the_condition_is_the_slope_of_the_reference(name: str, case: Case) -> None:
    velocity, _, *materials = case
    conditions = inverse.conditions(velocity, *materials)
    truth = Trajectory(*map(Fraction, case), digits=60)
    if abs(truth.final_depth / truth.radius - 1) < 1e-6:
        return  # the second derivative jumps at y = 1, so differences across it are less accurate
    reals, h = Reals(60), Fraction(1, 10**25)
    numbers = {key: reals.number(Fraction(x)) for key, x in but(name, case).items()}
    above, below = (
        (
            reals.log(
                INVERSES[name](reals, truth.final_depth * reals.number(1 + sign * h), **numbers)
            )
            for sign in (1, -1)
        )
        if abs(conditions[name]) < 1e12
        else (0, 0)
    )  # else one of them has no solution
    if above or below:
        slope = (above - below) / 2 * h.denominator
        assert conditions[name] == pytest.approx(float(slope), rel=1e-13)


def test_numbers_of_the_report_asked_backwards() -> None:
    """X/R = 0.3 of section 2 in the case of beta = 5, by hand: CV/PV = 0.09 2.7 / 4 = 0.06075."""
    logarithm = 0.06075 * 7850 / 8900
    resistance = 7850 * 500.0**2 / 2 / math.expm1(logarithm)
    assert solved("resistance", 3.3e-6, BETA_5) == pytest.approx(resistance, rel=1e-14)
    assert f"{resistance / 1e9:.1f} GPa" == "17.8 GPa"
    assert f"{solved('velocity', 3.3e-6, BETA_5):.1f} m/s" == "221.5 m/s"


# Without a solution, and out of range

MOST = constant_pressure_depth(500.0, 11e-6, 8900.0, 3.5e9)


@pytest.mark.parametrize("depth", [MOST * 1.001, 1e-5, 1.0])
def test_deeper_than_in_a_target_without_density_is_an_error_with_the_reason(depth: float) -> None:
    with pytest.raises(inverse.NoSolutionError) as raised:
        solved("target_density", depth, BETA_5)
    assert str(raised.value) == (
        f"target density has no value that gives {depth * 1e6:.8g} um: without any, at the "
        "constant pressure R_t, the depth is 8.273 um"
    )


def test_in_an_array_what_has_no_solution_is_nan() -> None:
    depths = pd.Series([MOST / 2, 1e-5, MOST * 2], ["a", "b", "c"])
    densities = replication.target_density_for_depth(depths, **but("target_density", BETA_5))
    assert densities.isna().to_dict() == {"a": False, "b": True, "c": True}
    assert densities["a"] == solved("target_density", MOST / 2, BETA_5)


def test_a_bad_input_beside_what_has_no_solution_is_named() -> None:
    given = but("target_density", BETA_5) | {"velocity": [500.0, -1.0]}
    with pytest.raises(ValueError, match=r"^velocity\[1\] is -1.0: it must be a finite number"):
        replication.target_density_for_depth([1e-5, 1e-6], **given)


@pytest.mark.parametrize(
    ("name", "depth", "message"),
    [
        pytest.param("resistance", 1e-2, "resistance is 0.0 for this depth: doubles carry",
                     id="the resistance of a target that is as good as empty"),
        pytest.param("velocity", 1e-2, "velocity is inf for this depth: doubles carry",
                     id="a velocity beyond all doubles"),
        pytest.param("resistance", 1e-140, "depth over radius squared is 8.26",
                     id="a depth whose square is near the least double"),
        pytest.param("radius", 0.0, "depth is 0.0: it must be a finite number greater than zero",
                     id="no depth"),
    ],
)  # fmt: skip
def test_what_doubles_cannot_hold_is_an_error(name: str, depth: float, message: str) -> None:
    for one_or_many in (depth, [depth]):
        with pytest.raises(InputError) as raised:
            getattr(replication, f"{name}_for_depth")(one_or_many, **but(name, BETA_5))
        assert str(raised.value).replace("[0]", "").startswith(message)


ANY = st.one_of(*(st.floats(-p, p).map(lambda power: 10.0**power) for p in (60, 150, 307)))


@pytest.mark.parametrize("name", NAMES)
@given(case=st.tuples(ANY, ANY, ANY, ANY, ANY), depth=ANY)
@settings(max_examples=300, deadline=None)
def test_no_input_gives_a_wrong_value_a_warning_or_another_error(
    name: str, case: Case, depth: float
) -> None:
    """What is returned is accepted by `final_depth`, and gives the depth."""
    given, answers = but(name, case), []
    function: Callable[..., Any] = getattr(replication, f"{name}_for_depth")
    for one_or_many in (depth, np.array([depth])):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                answers.append(float(np.asarray(function(one_or_many, **given)).flat[0]))
            except inverse.NoSolutionError:
                answers.append(math.nan)
            except InputError as error:
                answers.append(str(error).replace("[0]", ""))
    first, second = answers
    assert first == second or (math.isnan(first) and math.isnan(second))
    if isinstance(first, float) and not math.isnan(first):
        whole = {**dict(zip(NAMES, case, strict=True)), name: first}
        assert final_depth(**whole) == pytest.approx(depth, rel=THERE_AND_BACK, abs=0)

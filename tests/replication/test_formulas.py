"""Every closed formula of the replica against the reference, over its whole sensible range."""

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference import exact
from reference.computations import COMPUTATIONS
from replication.audit.replica import REPLICA
from replication.models import arrays, crater, frank_zook, resistance, stream

REALS = exact.Reals(50)

ULP = 2.0**-52
FEW_ROUNDINGS = 16 * ULP
"""Fewer than ten operations, each within an ulp, none with a condition number above two."""

POSITIVE = st.floats(1e-6, 1e6)
DENSITY = st.floats(1e2, 1e5)
STRESS = st.floats(1e6, 1e12)


def reference(name: str, **inputs: float) -> float:
    numbers = {key: REALS.number(Fraction(value)) for key, value in inputs.items()}
    return float(COMPUTATIONS[name].function(REALS, **numbers))


FORMULAS: dict[str, tuple[dict[str, Any], float]] = {
    "sphere_volume": ({"diameter": POSITIVE}, FEW_ROUNDINGS),
    "particle_mass": ({"radius": POSITIVE, "particle_density": DENSITY}, FEW_ROUNDINGS),
    "crater_normalized_depth": ({"volume_ratio": st.floats(1e-12, 0.5)}, FEW_ROUNDINGS),
    "contact_diameter": (
        {"normalized_depth": st.floats(1e-6, 1), "diameter": POSITIVE},
        FEW_ROUNDINGS,
    ),
    "goodier_beta": ({"q": POSITIVE}, FEW_ROUNDINGS),
    "walker_anderson_alpha": (
        {"elastic_modulus": STRESS, "flow_stress": STRESS},
        FEW_ROUNDINGS,
    ),
    "strain_rate": ({"velocity": POSITIVE, "length": POSITIVE}, FEW_ROUNDINGS),
    "frank_zook_as_printed": (
        {
            "length_ratio": st.floats(0.1, 10),
            "particle_density": DENSITY,
            "target_density": DENSITY,
            "k_1": st.floats(0.1, 2),
            "k_t": st.floats(0.1, 2),
            "resistance": STRESS,
            "velocity": st.floats(1, 5000),
        },
        # The formula is computed as it is printed, ln(1 + z): forming 1 + z costs 2^-53 / z.
        math.nan,
    ),
}


@pytest.mark.parametrize("name", FORMULAS)
@given(data=st.data())
@settings(max_examples=100, deadline=None)
def test_replica_agrees_with_reference(name: str, data: st.DataObject) -> None:
    strategies, bound = FORMULAS[name]
    inputs = {key: data.draw(strategy, key) for key, strategy in strategies.items()}
    if math.isnan(bound):
        drag = inputs["k_t"] * inputs["target_density"] * inputs["velocity"] ** 2
        bound = FEW_ROUNDINGS + ULP * max(1.0, inputs["resistance"] / drag)
    expected = reference(name, **inputs)
    assert abs(REPLICA[name](**inputs) - expected) <= bound * abs(expected)


def test_both_ways_answer_the_same_computations() -> None:
    assert set(REPLICA) == set(COMPUTATIONS)


@given(
    velocity=st.floats(1e-3, 1e4),
    radius=st.floats(1e-9, 1),
    densities=st.tuples(DENSITY, DENSITY),
    strength=STRESS,
)
@settings(max_examples=300, deadline=None)
def test_final_depth_agrees_with_the_energy_integral(
    velocity: float, radius: float, densities: tuple[float, float], strength: float
) -> None:
    inputs = (velocity, radius, *densities, strength)
    numbers = [REALS.number(Fraction(value)) for value in inputs]
    expected = float(exact.final_depth(REALS, *numbers))
    assert abs(arrays.final_depth(*inputs) - expected) <= 4 * math.ulp(expected)


def test_final_depth_takes_arrays_of_any_shape() -> None:
    velocities = np.array([[1.0], [500.0], [5000.0]])
    resistances = np.array([2.1e9, 3.5e9])
    depths = arrays.final_depth(velocities, 11e-6, 8900.0, 7850.0, resistances)
    assert depths.shape == (3, 2)
    one_by_one = [
        [arrays.final_depth(v, 11e-6, 8900.0, 7850.0, r) for r in resistances]
        for v in velocities[:, 0]
    ]
    np.testing.assert_array_equal(depths, one_by_one)


def test_normalized_depth_does_not_know_the_particles_size() -> None:
    small, large = (
        arrays.final_depth(500.0, r, 8900.0, 7850.0, 3.5e9) / r for r in (2.0**-20, 2.0**10)
    )
    assert small == large


def test_depth_is_continuous_where_the_sphere_is_half_buried() -> None:
    # c = 2/3 exactly where rho_p = rho_t / 2 and the logarithm is 1.
    pressure = math.expm1(1.0)
    depths = [
        arrays.normalized_depth(1.0, 1.0, 2.0, 1.0 / (pressure * (1 + e)))
        for e in (-1e-12, 0.0, 1e-12)
    ]
    assert depths == sorted(depths)
    assert depths[2] - depths[0] < 4e-12
    assert depths[1] == pytest.approx(1.0, abs=1e-14)


@given(st.floats(0, 0.5))
def test_crater_volume_and_its_inverse(ratio: float) -> None:
    depth = crater.depth_from_volume_ratio(ratio)
    assert 0 <= depth <= 1 + ULP
    assert crater.volume_ratio(depth) == pytest.approx(ratio, rel=FEW_ROUNDINGS, abs=1e-300)
    assert crater.cap_volume(depth, 1.0) / crater.volume(1.0) == pytest.approx(
        ratio, rel=FEW_ROUNDINGS, abs=1e-300
    )


@pytest.mark.parametrize("ratio", [-0.1, 0.6, math.nan])
def test_no_cap_has_such_a_volume(ratio: float) -> None:
    assert math.isnan(crater.depth_from_volume_ratio(ratio))


def test_lighter_particles_are_faster() -> None:
    velocities = [stream.particle_velocity(521.0, mass, 1.0) for mass in (0.25, 1.0, 4.0)]
    assert velocities == [1042.0, 521.0, 260.5]


def test_a_rigid_particle_needs_fifty_times_coppers_strength() -> None:
    needed = resistance.centerline_stress(7850.0, 500.0, 3.5e9)
    assert needed == 4.48125e9
    assert needed / 90e6 > 49


def test_equation_16_as_printed_is_half_of_what_it_follows_from() -> None:
    inputs = (2 / 3, 8900.0, 7850.0, 0.557, 1.046, 9.13e9, 500.0)
    assert frank_zook.depth_derived(*inputs) == 2 * frank_zook.depth_as_printed(*inputs)

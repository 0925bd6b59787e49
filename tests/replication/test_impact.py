from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from replication.cases import BETA_5, INPUTS, changed, inputs_of, read_case
from replication.models.impact import Impact


@pytest.mark.parametrize("name", [n for n in INPUTS if n != "resistance"])
@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf"), -1.0, 0.0])
def test_senseless_inputs_are_refused_by_name(name: str, value: float) -> None:
    if (name, value) == ("stop_velocity", 0.0):
        assert replace(BETA_5, stop_velocity=0.0).stop_velocity == 0
        return
    with pytest.raises(ValueError, match=f"{name} is .*: it must be a finite number"):
        replace(BETA_5, **{name: value})


def test_no_resistance_is_refused() -> None:
    with pytest.raises(ValueError, match="either resistance, or both"):
        replace(BETA_5, beta=None)


def test_inputs_are_doubles_whatever_was_given() -> None:
    impact = Impact(
        velocity=500, radius=1, particle_density=1, target_density=1, resistance=1, step=1
    )
    assert all(isinstance(value, float) for value in inputs_of(impact).values() if value)


@given(st.floats(min_value=1e-100, max_value=1e100))
def test_plain_numbers_are_read_as_the_double_they_spell(value: float) -> None:
    assert read_case("beta-5", None, {"velocity": repr(value)}).velocity == value


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("radius", "11 um", 11e-6),
        ("radius", "11um", 11e-6),
        ("radius", "0.011 mm", 11e-6),
        ("flow_stress", "700 MPa", 700e6),
        ("flow_stress", "98 ksi", 675686214.7304994),
        ("step", "0.2 ns", 2e-10),
        ("velocity", "0.5 km/s", 500.0),
        ("target_density", "7.85 g/cm^3", 7850.0),
    ],
)
def test_units_are_understood_without_rounding_twice(name: str, text: str, value: float) -> None:
    assert getattr(read_case("beta-5", None, {name: text}), name) == value


def test_resistance_takes_the_place_of_beta_and_flow_stress() -> None:
    impact = read_case("beta-5", None, {"resistance": "2.1 GPa"})
    assert (impact.beta, impact.flow_stress, impact.target_resistance) == (None, None, 2.1e9)
    assert changed(impact, {"beta": 3.0, "flow_stress": 7e8}).resistance is None

"""A case: what is refused by name, and how what a user writes becomes one."""

from contextlib import suppress
from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from replication.cases import BETA_5, INPUTS, changed, inputs_of, read_case
from replication.models.impact import Impact, InputError

POSITIVE = st.integers(-323, 308).map(lambda exponent: float(f"1e{exponent}"))


@given(st.fixed_dictionaries({name: POSITIVE for name in INPUTS if name != "resistance"}))
def test_numbers_of_any_size_make_a_case_or_are_refused(inputs: dict[str, float]) -> None:
    with suppress(InputError):
        Impact(**inputs)


def test_resistance_takes_the_place_of_beta_and_flow_stress() -> None:
    impact = read_case("beta-5", None, {"resistance": "2.1 GPa"})
    assert (impact.beta, impact.flow_stress, impact.target_resistance) == (None, None, 2.1e9)
    assert changed(impact, {"beta": 3.0, "flow_stress": 7e8}).resistance is None


def test_inputs_are_doubles_whatever_was_given() -> None:
    impact = Impact(
        velocity=500, radius=1, particle_density=1, target_density=1, resistance=1, step=1
    )
    assert all(isinstance(value, float) for value in inputs_of(impact).values() if value)


@given(st.floats(min_value=1e-100, max_value=1e100))
def test_plain_numbers_are_read_as_the_double_they_spell(value: float) -> None:
    assert read_case("beta-5", None, {"velocity": repr(value)}).velocity == value


def test_units_are_understood_without_rounding_twice() -> None:
    given = {"radius": "0.011 mm", "step": "0.2ns", "target_density": "7.85 g/cm^3"}
    given |= {"velocity": "0.5 km/s", "flow_stress": "98 ksi"}
    expected = replace(BETA_5, flow_stress=675686214.7304994)
    assert read_case("beta-5", None, given) == expected

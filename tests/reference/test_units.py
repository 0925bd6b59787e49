"""Units and quantities in exact rational arithmetic."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference.units import UnitError, quantity, same_dimension, to_si

POUND_FORCE = Fraction("4.4482216152605")
INCH = Fraction("0.0254")


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        ("1", 1),
        ("dimensionless", 1),
        ("m", 1),
        ("kg", 1),
        ("kg/m^3", 1),
        ("m/s^2", 1),
        ("1/s", 1),
        ("um", Fraction(1, 10**6)),
        ("μm", Fraction(1, 10**6)),
        ("mm", Fraction(1, 1000)),
        ("um^3", Fraction(1, 10**18)),
        ("ns", Fraction(1, 10**9)),
        ("us", Fraction(1, 10**6)),
        ("MPa", 10**6),
        ("GPa", 10**9),
        ("ksi", POUND_FORCE / INCH**2 * 1000),
        ("gram_force", Fraction("0.00980665")),
        ("MPa*um", 1),
    ],
)
def test_factors_to_si_are_exact(unit: str, factor: Fraction) -> None:
    assert to_si(unit) == factor
    assert isinstance(to_si(unit), Fraction)


@pytest.mark.parametrize("unit", ["foo", "umm", "m/foo", "2 m", "3"])
def test_an_unknown_unit_is_named(unit: str) -> None:
    with pytest.raises(UnitError) as caught:
        to_si(unit)
    assert repr(unit) in str(caught.value)


@pytest.mark.parametrize("unit", ["m/", "m^", "kg*", "()", "m)", "m*(", "'m'", "+"])
def test_a_unit_that_is_no_expression_is_an_unknown_unit(unit: str) -> None:
    with pytest.raises(UnitError):
        to_si(unit)


@pytest.mark.parametrize("unit", ["degC", "degF"])
def test_a_scale_with_an_offset_has_no_factor(unit: str) -> None:
    with pytest.raises(UnitError):
        to_si(unit)


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("ksi", "MPa", True),
        ("Pa", "kg/m/s^2", True),
        ("um^3", "m^3", True),
        ("1", "m/m", True),
        ("um", "MPa", False),
        ("m", "m^2", False),
        ("m/s", "s/m", False),
        ("1", "m", False),
        ("kg", "gram_force", False),
    ],
)
def test_dimensions(one: str, other: str, same: bool) -> None:
    assert same_dimension(one, other) is same
    assert same_dimension(other, one) is same


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("11um", "m", Fraction(11, 10**6)),
        ("11 um", "m", Fraction(11, 10**6)),
        ("  11  um ", "m", Fraction(11, 10**6)),
        ("11", "m", Fraction(11)),
        ("-2.5e3 mm", "m", Fraction(-5, 2)),
        ("5.m", "m", Fraction(5)),
        (".5 ns", "s", Fraction(5, 10**10)),
        ("+.5E+1 s", "s", Fraction(5)),
        ("1e-5", "m", Fraction(1, 10**5)),
        ("0.1", "1", Fraction(1, 10)),
        ("3.5 GPa", "Pa", Fraction(35 * 10**8)),
        ("110 ksi", "Pa", 110 * to_si("ksi")),
        ("500 m/s", "km/hour", Fraction(500)),
        ("1e-400 m", "m", Fraction(1, 10**400)),
    ],
)
def test_quantities_are_si(text: str, unit: str, value: Fraction) -> None:
    assert quantity(text, unit) == value


@pytest.mark.parametrize("text", ["", " ", "um", "nan", "inf", "-inf", "nan m", "e5", ".", "- 3 m"])
def test_text_without_a_number_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="no finite number") as caught:
        quantity(text, "m")
    assert repr(text) in str(caught.value)


@pytest.mark.parametrize("text", ["1e99999 m", "1e99999", "11 foo", "11 m m", "1.2.3 m", "1,000 m"])
def test_what_follows_the_number_must_be_a_unit(text: str) -> None:
    with pytest.raises(UnitError):
        quantity(text, "m")


def test_a_unit_of_another_dimension_is_refused_with_both_named() -> None:
    with pytest.raises(UnitError, match=r"'11 ns': ns does not measure what m does"):
        quantity("11 ns", "m")


@pytest.mark.parametrize("text", ["11 m/", "11 m)", "11 -", "11 (", "11 @"])
def test_a_quantity_with_a_broken_unit_is_a_unit_error(text: str) -> None:
    with pytest.raises(UnitError):
        quantity(text, "m")


@settings(deadline=None, max_examples=60)
@given(
    value=st.decimals(-(10**9), 10**9, places=6),
    unit=st.sampled_from(["m", "um", "mm", "inch", "nm"]),
    space=st.sampled_from(["", " ", "\t"]),
)
def test_a_quantity_is_its_number_times_its_unit(value: object, unit: str, space: str) -> None:
    assert quantity(f"{value}{space}{unit}", "m") == Fraction(str(value)) * to_si(unit)

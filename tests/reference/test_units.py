"""Units in exact rational arithmetic: those that are listed, and no others."""

from fractions import Fraction as F

import pytest

from reference.units import UnitError, to_si, unit_dimension

POUND_FORCE, INCH = F("4.4482216152605"), F("0.0254")


@pytest.mark.parametrize(
    ("unit", "factor", "dimension"),
    [
        ("1", 1, "a pure number"),
        ("percent", F(1, 100), "a pure number"),
        ("kg/m^3", 1, "kg m^-3"),
        ("g/cm^3", 1000, "kg m^-3"),
        ("m s^-1", 1, "m s^-1"),
        ("1/s", 1, "s^-1"),
        ("cm", F(1, 100), "m"),
        ("km", 1000, "m"),
        ("μm", F(1, 10**6), "m"),
        ("ns", F(1, 10**9), "s"),
        ("um**3", F(1, 10**18), "m^3"),
        ("mm²", F(1, 10**6), "m^2"),
        ("ps", F(1, 10**12), "s"),
        ("GPa", 10**9, "kg m^-1 s^-2"),
        ("ksi", POUND_FORCE / INCH**2 * 1000, "kg m^-1 s^-2"),
        ("kbar", 10**8, "kg m^-1 s^-2"),
        ("gram_force", F("0.00980665"), "kg m s^-2"),
        ("1 MPa*um", 1, "kg s^-2"),
        ("ft/s", 12 * INCH, "m s^-1"),
    ],
)
def test_factors_and_dimensions(unit: str, factor: F, dimension: str) -> None:
    assert to_si(unit) == factor
    assert str(unit_dimension(unit)) == dimension


@pytest.mark.parametrize(
    "unit",
    [
        *("", " ", "foo", "umm", "m/foo", "2 m", "3", "11", "1 1", "m/", "m^", "m^0", "m^10"),
        *("kg*", "()", "m)", "'m'", "+", "degC", "Mm", "kft"),
        "x" * 100_000,
        "m " * 100_000,
        "1" * 100_000,
    ],
)
def test_an_unknown_unit_is_named_and_the_units_that_there_are(unit: str) -> None:
    with pytest.raises(UnitError, match="take one such as um, ns") as caught:
        to_si(unit)
    assert len(str(caught.value)) < 200

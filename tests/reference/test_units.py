"""Units: their factor to SI, what they measure, and what is no unit."""

import re
from fractions import Fraction as F

import pytest

from reference.units import UnitError, same_dimension, to_si, unit_dimension


@pytest.mark.parametrize(
    ("unit", "factor", "dimension"),
    [
        ("1", F(1), "a pure number"),
        ("percent", F(1, 100), "a pure number"),
        ("kg/m^3", F(1), "kg m^-3"),
        ("g/cm^3", F(1000), "kg m^-3"),
        ("m s^-1", F(1), "m s^-1"),
        ("1/s", F(1), "s^-1"),
        ("cm", F(1, 100), "m"),
        ("km", F(1000), "m"),
        ("μm", F(1, 10**6), "m"),
        ("ns", F(1, 10**9), "s"),
        ("um**3", F(1, 10**18), "m^3"),
        ("mm²", F(1, 10**6), "m^2"),
        ("ps", F(1, 10**12), "s"),
        ("GPa", F(10**9), "kg m^-1 s^-2"),
        ("kbar", F(10**8), "kg m^-1 s^-2"),
        ("1 MPa*um", F(1), "kg s^-2"),
        ("ft/s", F("0.3048"), "m s^-1"),
        # a pound of 0.45359237 kg, g = 9.80665 m/s^2 and an inch of 0.0254 m, by definition
        ("ksi", 1000 * F("0.45359237") * F("9.80665") / F("0.0254") ** 2, "kg m^-1 s^-2"),
        ("gram_force", F("0.00980665"), "kg m s^-2"),
    ],
)
def test_a_unit_has_an_exact_factor_and_a_dimension(unit: str, factor: F, dimension: str) -> None:
    assert to_si(unit) == factor
    assert str(unit_dimension(unit)) == dimension


NO_UNITS = [
    "", " ", "foo", "m/foo", "2 m", "3", "11", "1 1", "m/", "m^", "m^0", "m^10", "()", "m)", "'m'",
    "+", "degC",
    *(pytest.param(letters * 100_000, id=f"long {letters}") for letters in ("x", "m ", "1")),
]  # fmt: skip


@pytest.mark.parametrize(("text", "known"), [("mph", "m/s"), ("km/h", "m/s"), ("atm", "Pa")])
def test_a_unit_that_is_not_known_is_answered_with_one_of_its_kind(text: str, known: str) -> None:
    message = f"unknown unit {text!r}: convert it to {known}"
    with pytest.raises(UnitError, match=f"^{re.escape(message)}$"):
        to_si(text)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("umm", "um or mm"),
        ("mpa", "MPa"),
        ("kg*", "kg"),
        ("Mm", "mm"),
        ("kft", "ft"),
        ("NS", "ns"),
        ("microns", "um"),
        ("Micrometer", "um"),
        ("inches", "in"),
        ("sec", "s"),
    ],
)
def test_a_unit_like_a_known_one_is_answered_with_that(text: str, meant: str) -> None:
    message = f"unknown unit {text!r}: did you mean {meant}?"
    with pytest.raises(UnitError, match=f"^{re.escape(message)}$"):
        to_si(text)


@pytest.mark.parametrize("text", NO_UNITS)
def test_what_is_no_unit_is_refused_in_one_short_line(text: str) -> None:
    message = f"unknown unit {text[:40]!r}: take one such as um, ns, m/s, kg/m^3, MPa or ksi"
    with pytest.raises(UnitError, match=f"^{re.escape(message)}$"):
        to_si(text)


@pytest.mark.parametrize(
    ("text", "expected", "meant"),
    [
        ("m/z", "m/s", "m/s or km/s"),
        ("kis", "Pa", "ksi or kpsi"),
        ("nz", "s", "ns"),
        ("gm/cm3", "kg/m^3", "g/cm^3 or kg/m^3"),
    ],
)
def test_a_misspelt_unit_is_sought_among_those_of_its_quantity(
    text: str, expected: str, meant: str
) -> None:
    message = f"unknown unit {text!r}: did you mean {meant}?"
    with pytest.raises(UnitError, match=f"^{re.escape(message)}$"):
        same_dimension(text, expected)

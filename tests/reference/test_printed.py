"""Printed text and the exact intervals of values that print like it."""

from decimal import ROUND_DOWN, ROUND_HALF_EVEN, ROUND_HALF_UP, Decimal, localcontext
from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from reference.printed import Interval, Rounding, decimal_text, parse

RELAXED = settings(deadline=None, max_examples=80)

FRACTIONS = st.fractions(min_value=-1000, max_value=1000, max_denominator=5000)
DECIMALS = st.decimals(min_value=-(10**6), max_value=10**6, places=6)
PLACES = st.integers(0, 5)


def tens(exponent: int) -> Fraction:
    return Fraction(10) ** exponent


@pytest.mark.parametrize(
    ("text", "value", "quanta"),
    [
        ("3.11E+08", 311 * tens(6), [tens(6)]),
        ("9.13 × 10^9", 913 * tens(7), [tens(7)]),
        ("7.6×10^9", 76 * tens(8), [tens(8)]),
        ("9.13 \\times 10^9", 913 * tens(7), [tens(7)]),
        ("9.13 x 10^{-9}", 913 * tens(-11), [tens(-11)]),
        ("700", 700, [1, 10, 100]),
        ("500", 500, [1, 10, 100]),
        ("403", 403, [1]),
        ("40", 40, [1, 10]),
        ("10.0", 10, [tens(-1)]),
        ("0.70", Fraction(7, 10), [tens(-2)]),
        ("~0.3", Fraction(3, 10), [tens(-1)]),
        ("~ 0.3", Fraction(3, 10), [tens(-1)]),
        ("~30", 30, [1, 10]),
        ("6E-10", 6 * tens(-10), [tens(-10)]),
        ("5.00E+02", 500, [1]),
        ("1E+02", 100, [100]),
        ("1e3", 1000, [1000]),
        ("5,575", 5575, [1]),
        ("1,234,500", 1234500, [1, 10, 100]),
        ("-3.0", -3, [tens(-1)]),
        ("-700", -700, [1, 10, 100]),
        ("+7", 7, [1]),
        ("0", 0, [1]),
        ("0.00", 0, [tens(-2)]),
        ("10^7", tens(7), [0]),
        ("10^{-3}", tens(-3), [0]),
        ("\\frac{1}{2}", Fraction(1, 2), [0]),
        ("1/3", Fraction(1, 3), [0]),
        ("7/3", Fraction(7, 3), [0]),
        ("one", 1, [0]),
        ("two", 2, [0]),
        ("twice", 2, [0]),
        ("three", 3, [0]),
        ("Four", 4, [0]),
        ("third", Fraction(1, 3), [0]),
        ("one-sixth", Fraction(1, 6), [0]),
        (" 7.67 ", Fraction(767, 100), [tens(-2)]),
    ],
)
def test_text_is_read_to_its_value_and_last_places(
    text: str, value: Fraction, quanta: list[Fraction]
) -> None:
    printed = parse(text)
    assert printed.text == text
    assert printed.value == value
    assert list(printed.quanta) == quanta
    assert printed.quantum == quanta[0]


@pytest.mark.parametrize(
    "text",
    [
        *("", " ", "~", "~~3", "abc", "1.2.3", "nan", "inf", "1e", "E5", "1E5.5", "7/0", "/3"),
        *("1/2/3", "1,00", "5,5750", ",575", "700.", ".5", "--3", "1 2", "10^", "3 × 10"),
        *("9.13 × 10^{9", "five", "a third", "3 μm", "0x10", "1_000"),
    ],
)
def test_other_text_is_refused_by_name(text: str) -> None:
    with pytest.raises(ValueError, match="as a printed number") as caught:
        parse(text)
    assert repr(text) in str(caught.value)


@pytest.mark.parametrize("text", ["7/3}", "1}{2", "\\frac{1/2", "\\frac{1}{2", "10^{7", "10^7}"])
def test_unbalanced_braces_are_refused(text: str) -> None:
    with pytest.raises(ValueError, match="as a printed number"):
        parse(text)


@pytest.mark.parametrize(
    ("text", "rounding", "expected"),
    [
        ("7.67", Rounding.NEAREST, "[7.665, 7.675]"),
        ("7.67", Rounding.HALF_AWAY, "[7.665, 7.675)"),
        ("7.67", Rounding.TRUNCATED, "[7.67, 7.68)"),
        ("-3.0", Rounding.NEAREST, "[-3.05, -2.95]"),
        ("-3.0", Rounding.HALF_AWAY, "(-3.05, -2.95]"),
        ("-3.0", Rounding.TRUNCATED, "(-3.1, -3]"),
        ("0", Rounding.NEAREST, "[-0.5, 0.5]"),
        ("0", Rounding.HALF_AWAY, "(-0.5, 0.5)"),
        ("0.0", Rounding.TRUNCATED, "(-0.1, 0.1)"),
        ("7/3", Rounding.NEAREST, "7/3"),
        ("three", Rounding.TRUNCATED, "3"),
        ("10^7", Rounding.HALF_AWAY, "1E+7"),
        ("3.11E+08", Rounding.NEAREST, "[3.105E+8, 3.115E+8]"),
        ("6E-10", Rounding.NEAREST, "[5.5E-10, 6.5E-10]"),
    ],
)
def test_the_rounding_rule_sets_the_ends(text: str, rounding: Rounding, expected: str) -> None:
    assert str(parse(text).interval(rounding)) == expected


def test_nearest_is_the_rule_unless_told_otherwise() -> None:
    assert parse("2.5").interval() == parse("2.5").interval(Rounding.NEAREST)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1.00E+03", "[999.5, 1005]"),
        ("1E-10", "[9.5E-11, 1.5E-10]"),
        ("-1.0 × 10^2", "[-105, -99.5]"),
        ("1.01E+03", "[1005, 1015]"),
        ("2.0E+02", "[195, 205]"),
        ("10.0", "[9.95, 10.05]"),
        ("100", "[99.5, 100.5]"),
    ],
)
def test_digits_that_are_counted_stand_closer_below_a_power_of_ten(
    text: str, expected: str
) -> None:
    assert str(parse(text).interval()) == expected


def test_a_power_of_ten_in_its_fewest_digits() -> None:
    assert str(parse("100").interval(quantum=Fraction(100))) == "[95, 150]"
    assert str(parse("100").interval(quantum=Fraction(10))) == "[99.5, 105]"
    assert str(parse("1.0E+02").interval(Rounding.TRUNCATED)) == "[100, 110)"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("700", "[650, 750]"),
        ("500", "[450, 550]"),
        ("20", "[15, 25]"),
        ("403", "[402.5, 403.5]"),
        ("~0.3", "[0.25, 0.35]"),
        ("0.52", "[0.515, 0.525]"),
        ("0", "[-0.5, 0.5]"),
        ("-700", "[-750, -650]"),
        ("5.00E+02", "[499.5, 500.5]"),
        ("one", "[0.5, 1.5]"),
        ("twice", "[1.5, 2.5]"),
        ("7/3", "[11/6, 17/6]"),
        ("third", "[7/24, 5/12]"),
        ("one-sixth", "[13/84, 11/60]"),
        ("1/2", "[5/12, 0.75]"),
    ],
)
def test_about_takes_the_fewest_digits(text: str, expected: str) -> None:
    assert str(parse(text).about()) == expected


MODES = {
    Rounding.NEAREST: ROUND_HALF_EVEN,
    Rounding.HALF_AWAY: ROUND_HALF_UP,
    Rounding.TRUNCATED: ROUND_DOWN,
}


@RELAXED
@given(value=DECIMALS, places=PLACES, rounding=st.sampled_from(Rounding))
def test_a_value_lies_in_the_interval_of_its_rounding(
    value: Decimal, places: int, rounding: Rounding
) -> None:
    text = f"{value.quantize(Decimal(1).scaleb(-places), MODES[rounding]):f}"
    assert parse(text).interval(rounding).contains(Fraction(value))


@RELAXED
@given(value=DECIMALS, places=PLACES, data=st.data())
def test_a_value_in_the_interval_rounds_to_the_text(
    value: Decimal, places: int, data: st.DataObject
) -> None:
    quantum = Decimal(1).scaleb(-places)
    printed = parse(f"{value.quantize(quantum, ROUND_HALF_UP):f}")
    for rounding in (Rounding.HALF_AWAY, Rounding.TRUNCATED):
        interval = printed.interval(rounding)
        share = data.draw(st.decimals(0, 1, places=4))
        inside = interval.lower + (interval.upper - interval.lower) * Fraction(share)
        with localcontext(prec=40):
            exact = Decimal(inside.numerator) / Decimal(inside.denominator)
        again = Fraction(exact.quantize(quantum, MODES[rounding]))
        assert (again == printed.value) == interval.contains(inside)


@RELAXED
@given(value=DECIMALS, places=PLACES)
def test_ends_belong_as_the_rule_says(value: Decimal, places: int) -> None:
    printed = parse(f"{value.quantize(Decimal(1).scaleb(-places), ROUND_HALF_UP):f}")
    nearest = printed.interval()
    assert nearest.contains(nearest.lower)
    assert nearest.contains(nearest.upper)
    assert nearest.upper - nearest.lower == printed.quantum
    assert nearest.lower + nearest.upper == 2 * printed.value
    away = printed.interval(Rounding.HALF_AWAY)
    assert (away.lower, away.upper) == (nearest.lower, nearest.upper)
    assert away.contains(away.lower) == (printed.value > 0)
    assert away.contains(away.upper) == (printed.value < 0)
    cut = printed.interval(Rounding.TRUNCATED)
    assert cut.contains(printed.value)
    assert not cut.contains(printed.value + printed.quantum)
    assert not cut.contains(printed.value - printed.quantum)


@RELAXED
@given(digits=st.integers(1, 9999), shift=st.integers(0, 3), exponent=st.integers(-20, 20))
def test_scientific_notation_is_a_scaled_plain_number(
    digits: int, shift: int, exponent: int
) -> None:
    assume(str(digits).strip("0") != "1")  # of those, counted digits stand closer below
    mantissa = f"{Decimal(digits).scaleb(-shift):f}"
    plain = parse(mantissa).interval().scaled(tens(exponent))
    for form in (f"{mantissa}E{exponent:+03d}", f"{mantissa} × 10^{exponent}"):
        assert parse(form).interval() == plain
        assert len(parse(form).quanta) == 1


@RELAXED
@given(value=DECIMALS, exponent=st.integers(-9, 9))
def test_python_writes_what_parse_reads(value: Decimal, exponent: int) -> None:
    scaled = value.scaleb(exponent)
    assert parse(f"{scaled:.8e}").value == Fraction(f"{scaled:.8e}")
    assert parse(f"{abs(value):,f}").value == abs(Fraction(value))


@RELAXED
@given(number=st.integers(1, 10**7))
def test_looser_readings_contain_stricter_ones(number: int) -> None:
    printed = parse(str(number))
    intervals = [printed.interval(quantum=quantum) for quantum in printed.quanta]
    for strict, loose in pairwise(intervals):
        assert loose.encloses(strict.lower, strict.upper)
        assert not strict.encloses(loose.lower, loose.upper)
    assert printed.about() == intervals[-1]
    assert all(number % quantum == 0 for quantum in printed.quanta)
    assert number % (10 * printed.quanta[-1]) != 0


BOUNDS = st.tuples(FRACTIONS, FRACTIONS).map(sorted)


@st.composite
def intervals(draw: st.DrawFn) -> Interval:
    low, high = draw(BOUNDS)
    return Interval(
        draw(st.sampled_from([None, low])),
        draw(st.sampled_from([None, high])),
        draw(st.booleans()),
        draw(st.booleans()),
    )


@st.composite
def near(draw: st.DrawFn, interval: Interval) -> Fraction:
    """A value, often an end of the interval."""
    ends = [end for end in (interval.lower, interval.upper) if end is not None]
    return draw(st.one_of(FRACTIONS, *map(st.just, ends)))


@RELAXED
@given(data=st.data())
def test_enclosing_and_excluding_agree_with_containing(data: st.DataObject) -> None:
    interval = data.draw(intervals())
    low, high = sorted([data.draw(near(interval)), data.draw(near(interval))])
    middle = low + (high - low) * data.draw(st.fractions(0, 1))
    if interval.encloses(low, high):
        assert interval.contains(middle)
    if interval.excludes(low, high):
        assert not interval.contains(middle)
    assert interval.encloses(middle, middle) == interval.contains(middle)
    if interval.lower != interval.upper or (interval.lower_closed and interval.upper_closed):
        assert interval.excludes(middle, middle) != interval.contains(middle)


@RELAXED
@given(data=st.data(), factor=st.fractions(Fraction(1, 1000), 1000))
def test_scaling_carries_members_along(data: st.DataObject, factor: Fraction) -> None:
    interval = data.draw(intervals())
    value = data.draw(near(interval))
    assert interval.scaled(factor).contains(value * factor) == interval.contains(value)


@pytest.mark.parametrize(
    ("lower_closed", "upper_closed", "expected"),
    [
        (True, True, "[1, 2]"),
        (False, True, "(1, 2]"),
        (True, False, "[1, 2)"),
        (False, False, "(1, 2)"),
    ],
)
def test_brackets_tell_open_from_closed(
    lower_closed: bool, upper_closed: bool, expected: str
) -> None:
    interval = Interval(Fraction(1), Fraction(2), lower_closed, upper_closed)
    assert str(interval) == expected
    assert interval.contains(Fraction(1)) == lower_closed
    assert interval.contains(Fraction(2)) == upper_closed
    assert interval.contains(Fraction(3, 2))
    assert interval.excludes(Fraction(0), Fraction(1)) == (not lower_closed)
    assert interval.excludes(Fraction(2), Fraction(3)) == (not upper_closed)
    assert interval.encloses(Fraction(1), Fraction(2)) == (lower_closed and upper_closed)
    assert not interval.excludes(Fraction(0), Fraction(3))


def test_an_infinite_end_bounds_nothing() -> None:
    above, below = Interval(Fraction(2), None), Interval(None, Fraction(2))
    assert (str(above), str(below)) == ("[2, inf)", "(-inf, 2]")
    assert above.encloses(Fraction(2), tens(99))
    assert below.encloses(-tens(99), Fraction(2))
    assert above.excludes(-tens(99), Fraction(1))
    assert below.excludes(Fraction(3), tens(99))
    assert str(Interval(None, None)) == "(-inf, inf)"
    assert above.scaled(Fraction(3)) == Interval(Fraction(6), None)


def test_a_point_contains_itself_alone() -> None:
    point = Interval.point(Fraction(7, 3))
    assert point.contains(Fraction(7, 3))
    assert not point.contains(Fraction(7, 3) + tens(-50))
    assert not point.contains(Fraction(7, 3) - tens(-50))


def test_ends_in_the_wrong_order_are_refused() -> None:
    with pytest.raises(ValueError, match="empty interval"):
        Interval(Fraction(2), Fraction(1))


@RELAXED
@given(value=st.one_of(FRACTIONS, DECIMALS.map(Fraction)), exponent=st.integers(-40, 40))
def test_decimal_text_is_the_rational_itself(value: Fraction, exponent: int) -> None:
    scaled = value * tens(exponent)
    assert Fraction(decimal_text(scaled)) == scaled


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (Fraction(0), "0"),
        (Fraction(100), "100"),
        (Fraction(-1, 2), "-0.5"),
        (Fraction(-1, 3), "-1/3"),
        (Fraction(1, 1024), "0.0009765625"),
        (Fraction(999999), "999999"),
        (Fraction(10**6), "1E+6"),
        (Fraction(1, 10**5), "0.00001"),
        (Fraction(1, 10**6), "1E-6"),
        (Fraction(1, 2**60), "8.67361737988403547205962240695953369140625E-19"),
    ],
)
def test_decimal_text_examples(value: Fraction, expected: str) -> None:
    assert decimal_text(value) == expected

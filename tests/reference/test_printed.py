"""Printed text, and the exact interval of the values that print like it."""

import decimal
import re
from fractions import Fraction as F
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference.printed import Interval, Rounding, decimal_text, parse, place_of

TENS = F(10)


EXACT_TEXT = (F(0),)
"""The unit of the last digit of a text that is no rounding of anything."""


@pytest.mark.parametrize(
    ("text", "value", "last_digits", "about"),
    [
        ("7.67", F("7.67"), (F("0.01"),), "[7.665, 7.675)"),
        ("0.0000121", F("0.0000121"), (F("1E-7"),), "[0.00001205, 0.00001215)"),
        ("0.00000121", F("1.21E-6"), (F("1E-8"),), "[1.205E-6, 1.215E-6)"),
        ("10.0", F(10), (F("0.1"),), "[9.95, 10.05)"),
        ("8·9", F("8.9"), (F("0.1"),), "[8.85, 8.95)"),
        ("3.11E+08", F("3.11E+8"), (F("1E+6"),), "[3.105E+8, 3.115E+8)"),
        ("6E-10", F("6E-10"), (F("1E-10"),), "[5.5E-10, 6.5E-10)"),
        ("1e3", F(1000), (F(1000),), "[950, 1500)"),
        ("9.13 × 10^9", F("9.13E+9"), (F("1E+7"),), "[9.125E+9, 9.135E+9)"),
        (r"9.13 \times 10^{-9}", F("9.13E-9"), (F("1E-11"),), "[9.125E-9, 9.135E-9)"),
        ("700", F(700), (F(1), F(10), F(100)), "[650, 750)"),
        ("-700", F(-700), (F(1), F(10), F(100)), "(-750, -650]"),
        ("403", F(403), (F(1),), "[402.5, 403.5)"),
        ("5,575", F(5575), (F(1),), "[5574.5, 5575.5)"),
        ("0", F(0), (F(1),), "(-0.5, 0.5)"),
        ("~ 0.3", F("0.3"), (F("0.1"),), "[0.25, 0.35)"),
        ("~0.3", F("0.3"), (F("0.1"),), "[0.25, 0.35)"),
        ("10^7", F("1E+7"), EXACT_TEXT, "[9.9999995E+6, 1.00000005E+7)"),
        # between the means of 1/1000 with 1/1001 and with 1/999
        ("10^{-3}", F("0.001"), EXACT_TEXT, "[2001/2002000, 1999/1998000]"),
        (r"\frac{1}{2}", F("0.5"), EXACT_TEXT, "[5/12, 0.75]"),
        ("1/2", F("0.5"), EXACT_TEXT, "[5/12, 0.75]"),
        ("one", F(1), EXACT_TEXT, "[0.5, 1.5)"),
        ("twice", F(2), EXACT_TEXT, "[1.5, 2.5)"),
        ("Four", F(4), EXACT_TEXT, "[3.5, 4.5)"),
        ("several times", F(2), EXACT_TEXT, "[1.5, 2.5)"),
        ("third", F(1, 3), EXACT_TEXT, "[7/24, 5/12]"),
        ("one-sixth", F(1, 6), EXACT_TEXT, "[13/84, 11/60]"),
    ],
)
def test_text_is_a_value_and_the_places_that_its_last_digit_may_have(
    text: str, value: F, last_digits: tuple[F, ...], about: str
) -> None:
    printed = parse(text)
    assert printed.text == text
    assert (printed.value, printed.quanta) == (value, last_digits)
    assert str(printed.about()) == about


@pytest.mark.parametrize("text", ["7/3", "2/3"])
def test_nobody_says_about_seven_thirds(text: str) -> None:
    assert (parse(text).value, parse(text).quanta) == (F(text), EXACT_TEXT)
    with pytest.raises(ValueError, match=f"^'{text}' is neither a whole number nor a unit"):
        parse(text).about()


NO_NUMBERS = [
    "", "~", "~~3", "abc", "1.2.3", "nan", "inf", "1e", "1E5.5", "1E99999", "7/0", "1/2/3", "1,00",
    ",575", "700.", ".5", "--3", "1 2", "10^", "10^{7", "10^7}", "3 × 10", "six", "9 × 10^{9",
    "1}{2", r"\frac{1}{2", "a third", "3 μm", "0x10", "1_000",
]  # fmt: skip


@pytest.mark.parametrize("text", NO_NUMBERS)
def test_what_is_no_printed_number_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(f'cannot read {text!r} as a printed')}"):
        parse(text)


@pytest.mark.parametrize(
    ("ends", "closed"),
    [
        pytest.param((F(2), F(1)), (True, True), id="from above to below"),
        pytest.param((F(1), F(1)), (False, True), id="a point that is left out, below"),
        pytest.param((F(1), F(1)), (True, False), id="a point that is left out, above"),
    ],
)
def test_an_interval_is_not_empty(ends: tuple[F, F], closed: tuple[bool, bool]) -> None:
    with pytest.raises(ValueError, match=r"^the interval from \d to 1 is empty$"):
        Interval(*ends, *closed)


def test_an_unbounded_interval_has_no_two_ends() -> None:
    with pytest.raises(ValueError, match=r"^\(-inf, 1\] has no end on one side$"):
        _ = Interval(None, F(1)).ends


def test_a_quote_must_occur_once() -> None:
    text = "It is 22. It is 22 again."
    with pytest.raises(ValueError, match=r"^the report has 'is 23' 0 times, not once$"):
        place_of(text, "is ⟦23⟧")
    with pytest.raises(ValueError, match=r"^the report has 'is 22' 2 times, not once$"):
        place_of(text, "is ⟦22⟧")


MODES = {
    Rounding.AWAY: decimal.ROUND_HALF_UP,
    Rounding.EVEN: decimal.ROUND_HALF_EVEN,
    Rounding.CUT: decimal.ROUND_DOWN,
}


@st.composite
def texts(draw: st.DrawFn) -> tuple[str, int, int | None]:
    """A printed number, the index of its quantum, and its significant digits if these are fixed."""
    forms = ["decimal", "whole", "{}E{:+03d}", "{} × 10^{}", r"-{} \times 10^{{{}}}"]
    form = draw(st.sampled_from(forms))
    digits = draw(st.integers(0, 9999) | st.sampled_from([1, 10, 100, 1000]))
    places = draw(st.integers(0, 3))
    if form == "decimal":
        return "-" * draw(st.booleans()) + f"{digits / 10**places:.{places}f}", 0, None
    digits = max(digits, 1)
    if form == "whole":  # zeros at its end may not be significant
        text = str(digits * 10**places)
        place = draw(st.integers(0, len(text) - len(text.rstrip("0"))))
        return text, place, len(text) - place if place else None
    count = len(str(digits))
    mantissa = f"{digits / 10 ** (count - 1):.{count - 1}f}"
    return form.format(mantissa, draw(st.integers(-12, 12))), 0, count


EXACT = decimal.Context(99, traps=[decimal.Inexact])
OFF = st.integers(-20, 20).flatmap(lambda k: st.sampled_from([F(k, 8), F(k, 80)]))
"""The distance of a value from the printed one, in units of the last digit: ends and others."""


@settings(max_examples=300)
@given(texts(), st.sampled_from(Rounding), OFF, st.sampled_from([F(0), F(1, 10**9), F(-1, 10**9)]))
def test_a_value_prints_as_the_text_if_and_only_if_it_lies_in_its_interval(
    printed_as: tuple[str, int, int | None], rounding: Rounding, off: F, more: F
) -> None:
    text, place, digits = printed_as
    printed = parse(text)
    quantum = printed.quanta[place]
    value = printed.value + (off + more) * quantum
    exact = EXACT.divide(value.numerator, value.denominator)
    if digits is None:
        assert quantum == TENS ** -len(text.partition(".")[2])
        last = EXACT.divide(1, quantum.denominator)
        own = exact.quantize(last, MODES[rounding], decimal.Context(99))
    else:
        own = decimal.Context(digits, MODES[rounding]).create_decimal(exact)
    assert printed.interval(rounding, quantum).contains(value) == (own == printed.value)
    for strict, loose in pairwise(printed.interval(quantum=q) for q in printed.quanta):
        assert loose.encloses(*strict.ends) or loose.ends[1] == strict.ends[1]


NUMBERS = st.sampled_from([F(k, 2) for k in range(-4, 5)])


@st.composite
def intervals(draw: st.DrawFn) -> Interval:
    low, high = sorted([draw(NUMBERS), draw(NUMBERS)])
    ends = draw(st.sampled_from([(low, high), (None, high), (low, None), (None, None)]))
    closed = (True, True) if low == high else (draw(st.booleans()), draw(st.booleans()))
    return Interval(*ends, *closed)


BETWEEN = [F(k, 8) for k in range(-20, 21)]
"""All ends of the intervals that are drawn, and values between and beyond them."""


@given(intervals(), intervals(), NUMBERS, NUMBERS)
def test_intervals_against_their_members(first: Interval, two: Interval, a: F, b: F) -> None:
    low, high = sorted([a, b])
    inside = [x for x in BETWEEN if low <= x <= high]
    assert first.encloses(low, high) == all(first.contains(x) for x in inside)
    assert first.excludes(low, high) == (not any(first.contains(x) for x in inside))
    assert first.meets(two) == any(first.contains(x) and two.contains(x) for x in BETWEEN)
    assert first.meets(two) == two.meets(first)
    assert first.scaled(F(3)).contains(3 * a) == first.contains(a)
    assert first.is_point == (sum(map(first.contains, BETWEEN)) == 1)


@given(st.fractions(max_denominator=10**6), st.integers(-40, 40))
def test_decimal_text_is_the_rational_itself(value: F, exponent: int) -> None:
    assert F(decimal_text(value * TENS**exponent)) == value * TENS**exponent

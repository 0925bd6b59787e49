"""Printed text, the exact interval of the values that print like it, and its unit."""

import decimal
from fractions import Fraction as F
from itertools import pairwise

from hypothesis import given, settings
from hypothesis import strategies as st
from kept import kept, said

from reference.printed import Interval, Rounding, decimal_text, parse
from reference.units import to_si, unit_dimension

TENS = F(10)


@kept("reference/kept.txt", "Printed numbers: value, place of the last digit, what is about it")
def test_text_is_a_value_and_the_places_that_its_last_digit_may_have(
    question: str, answer: str
) -> None:
    def shown() -> str:
        printed = parse(question)
        assert printed.text == question
        places = " or ".join(map(decimal_text, printed.quanta)) if any(printed.quanta) else "exact"
        return f"{decimal_text(printed.value)}, {places}, {said(printed.about)}"

    assert said(shown) == answer


@kept("reference/kept.txt", "Units: the factor to SI, and what they measure")
def test_factors_and_dimensions(question: str, answer: str) -> None:
    assert said(lambda: f"{to_si(question)}, {unit_dimension(question)}") == answer


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

"""Interval arithmetic encloses, and branch and bound concludes only what is proven."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import flint
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference import exact, intervals
from reference.computations import COMPUTATIONS
from reference.enclosure import (
    Exploration,
    admitted,
    evaluate,
    explore,
    extent,
    satisfying,
    solutions,
)
from reference.exact import Reals
from reference.intervals import Intervals
from reference.printed import Interval

RELAXED = settings(deadline=None, max_examples=60)
RATIONALS = st.fractions(-1000, 1000, max_denominator=999)
PAIRS = st.tuples(RATIONALS, RATIONALS).map(sorted)
SHARES = st.fractions(0, 1, max_denominator=64)

Ends = tuple[Fraction, Fraction]


def box(**ends: tuple[Any, Any]) -> dict[str, Ends]:
    return {name: (Fraction(low), Fraction(high)) for name, (low, high) in ends.items()}


# Arithmetic


@RELAXED
@given(x=RATIONALS, digits=st.integers(5, 40))
def test_a_rational_lies_in_its_number(x: Fraction, digits: int) -> None:
    ar = Intervals(digits)
    low, high = ar.ends(ar.number(x))
    assert low <= x <= high
    assert high - low <= abs(x) * Fraction(1, 10 ** (digits - 1))


@pytest.mark.parametrize("value", [10**60 + 1, -(10**60) - 1, Fraction(10**60 + 1, 3**200)])
def test_integers_longer_than_the_precision_are_rounded_outwards(value: Any) -> None:
    ar = Intervals(10)
    low, high = ar.ends(ar.number(value))
    assert low < value < high


@pytest.mark.parametrize(
    ("low", "high"), [(-7, -2), (-7, 2), (2, 7), (0, 0), (-7, 0), (0, 7), (-2, -2)]
)
def test_ends_keep_their_sign(low: int, high: int) -> None:
    ar = Intervals(20)
    half = Fraction(1, 2)
    interval = ar.interval(low * half, high * half)
    assert ar.ends(interval) == (low * half, high * half)
    assert ar.ends(-interval) == (-high * half, -low * half)
    assert ar.ends(interval - 1) == (low * half - 1, high * half - 1)


def test_negative_ends_are_rounded_outwards_too() -> None:
    ar = Intervals(20)
    low, high = ar.ends(ar.interval(Fraction(-2, 3), Fraction(-1, 3)))
    assert low < Fraction(-2, 3)
    assert high > Fraction(-1, 3)
    assert Fraction(high - low) < Fraction(1, 3) + Fraction(1, 10**18)


OPERATIONS: list[Callable[[Any, Any], Any]] = [
    lambda x, y: x + y,
    lambda x, y: x - y,
    lambda x, y: x * y,
    lambda x, y: x * x - 2 * x * y + y**2,
    lambda x, y: (x - y) ** 3 / 7,
    lambda x, y: x / (1 + y**2),
    lambda x, y: 3 / (x - 2000) + 1 / (2000 + y),
    lambda x, y: -(x**4) + (1 - y) ** 0,
]


@pytest.mark.parametrize("operation", OPERATIONS)
@RELAXED
@given(first=PAIRS, second=PAIRS, s=SHARES, t=SHARES)
def test_arithmetic_encloses_rationals(
    operation: Callable[[Any, Any], Any],
    first: list[Fraction],
    second: list[Fraction],
    s: Fraction,
    t: Fraction,
) -> None:
    x = first[0] + s * (first[1] - first[0])
    y = second[0] + t * (second[1] - second[0])
    ar = Intervals(15)
    low, high = ar.ends(operation(ar.interval(*first), ar.interval(*second)))
    assert low <= operation(x, y) <= high


@pytest.mark.parametrize("name", ["log", "exp", "sqrt"])
@RELAXED
@given(ends=st.tuples(*[st.fractions("0.001", 99, max_denominator=1000)] * 2).map(sorted), s=SHARES)
def test_functions_enclose_what_mpmath_gives(name: str, ends: list[Fraction], s: Fraction) -> None:
    low, high = evaluate(lambda ar, x: getattr(ar.context, name)(x), {"x": (ends[0], ends[1])})
    reals = Reals(50)
    values = [
        Fraction(*getattr(reals.context, name)(reals.number(x)).as_integer_ratio())
        for x in (ends[0], ends[0] + s * (ends[1] - ends[0]), ends[1])
    ]
    # mpmath's value is off by less than a hundredth of an enclosure's width to 30 digits.
    width = max(map(abs, values)) * Fraction(1, 10**27) + Fraction(1, 10**30)
    assert values[0] - width <= low <= values[0] + width / 100
    assert low <= values[1] + width / 100
    assert values[1] - width / 100 <= high
    assert values[2] - width / 100 <= high <= values[2] + width


@RELAXED
@given(first=PAIRS, second=PAIRS)
def test_least_greatest_and_hull_are_those_of_the_ends(
    first: list[Fraction], second: list[Fraction]
) -> None:
    ar = Intervals(20)
    x, y = ar.interval(*first), ar.interval(*second)
    (xl, xh), (yl, yh) = ar.ends(x), ar.ends(y)
    assert ar.ends(ar.least(x, y)) == (min(xl, yl), min(xh, yh))
    assert ar.ends(ar.greatest(x, y)) == (max(xl, yl), max(xh, yh))
    assert ar.ends(ar.hull([x, y])) == (min(xl, yl), max(xh, yh))


@RELAXED
@given(ends=st.tuples(*[st.fractions(0, 3, max_denominator=100)] * 2).map(sorted), s=SHARES)
def test_the_contact_share_is_enclosed_no_wider_than_it_is(
    ends: list[Fraction], s: Fraction
) -> None:
    ar = Intervals(20)
    with ar.working():
        low, high = ar.ends(exact.contact_share(ar, ar.interval(*ends)))
    least, between, greatest = (
        2 * y - y * y if y < 1 else Fraction(1)
        for y in (ends[0], ends[0] + s * (ends[1] - ends[0]), ends[1])
    )
    assert low <= least <= between <= greatest <= high
    assert high - low <= greatest - least + Fraction(1, 10**18)


@pytest.mark.parametrize(
    ("x", "bound", "may", "must"),
    [
        ((1, 2), (3, 4), True, True),
        ((1, 3), (2, 4), True, False),
        ((1, 2), (2, 4), True, False),
        ((3, 5), (1, 4), True, False),
        ((2, 4), (1, 2), False, False),
        ((3, 4), (1, 2), False, False),
        ((-4, -3), (-2, -1), True, True),
        ((2, 2), (2, 2), False, False),
    ],
)
def test_certain_is_not_possible(x: Ends, bound: Ends, may: bool, must: bool) -> None:
    ar = Intervals(20)
    one, other = (ar.interval(*map(Fraction, ends)) for ends in (x, bound))
    assert ar.may_be_below(one, other) is may
    assert ar.is_below(one, other) is must


def test_a_precision_of_its_own() -> None:
    before = flint.ctx.prec
    with Intervals(33).working():
        assert flint.ctx.dps == 33
        Intervals(20).cap_root(Intervals(40).interval(Fraction(1, 3), Fraction(1, 2)))
        assert flint.ctx.dps == 33
    assert flint.ctx.prec == before
    with pytest.raises(ZeroDivisionError, match="may be zero"):
        evaluate(lambda ar, x: 1 / x, box(x=(-1, 2)))
    assert flint.ctx.prec == before


UNDEFINED: dict[str, tuple[Callable[..., Any], Ends]] = {
    "log of a negative number": (lambda ar, x: ar.context.log(x), (Fraction(-2), Fraction(-1))),
    "log of what may be zero": (lambda ar, x: ar.context.log(x), (Fraction(0), Fraction(1))),
    "root of what may be negative": (lambda ar, x: ar.context.sqrt(x), (Fraction(-1), Fraction(1))),
    "over what may be zero": (lambda ar, x: 1 / x, (Fraction(-1), Fraction(1))),
    "over zero": (lambda ar, x: 1 / x, (Fraction(0), Fraction(0))),
    "too large": (lambda ar, x: ar.context.exp(ar.context.exp(x)), (Fraction(99), Fraction(10**6))),
    "least of nothing": (lambda ar, x: ar.least(ar.context.log(x), x), (Fraction(-1),) * 2),
    "compared": (lambda ar, x: ar.number(ar.may_be_below(1 / x, x)), (Fraction(0), Fraction(0))),
    "negative power": (lambda ar, x: x**-1, (Fraction(1), Fraction(2))),
}


@pytest.mark.parametrize("name", UNDEFINED)
def test_what_is_undefined_proves_nothing(name: str) -> None:
    function, ends = UNDEFINED[name]
    with pytest.raises((ArithmeticError, ValueError)):
        explore(function, {"x": ends}, target(None, None))


def test_wide_factors_keep_their_sign() -> None:
    """Arb's own product of two balls about [0, 2] would reach down to -2."""
    assert evaluate(lambda ar, x, y: x * y, box(x=(0, 2), y=(0, 2))) == (0, 4)


# Roots


@pytest.mark.parametrize("c", ["0", "1e-30", "0.08", "1/3", "0.66", "2/3"])
def test_the_root_is_enclosed_tightly(c: str) -> None:
    ar = Intervals(30)
    value = Fraction(c)
    low, high = ar.ends(ar.cap_root(ar.number(value)))

    def residual(y: Fraction) -> Fraction:
        return y**2 - y**3 / 3 - value

    assert residual(low) <= 0 <= residual(high)  # it rises on [0, 2], where both ends lie
    assert 0 <= low <= high < 2
    assert high - low <= high * Fraction(1, 10**20)


@RELAXED
@given(ends=st.tuples(*[st.fractions(0, Fraction(2, 3), max_denominator=10**6)] * 2).map(sorted))
def test_roots_of_an_interval_reach_from_root_to_root(ends: list[Fraction]) -> None:
    ar = Intervals(30)
    low, high = ar.ends(ar.cap_root(ar.interval(*ends)))
    assert low**2 - low**3 / 3 <= ends[0]
    assert high**2 - high**3 / 3 >= ends[1]
    low, high = low + Fraction(1, 10**20), max(high - Fraction(1, 10**20), Fraction(0))
    assert low**2 - low**3 / 3 >= ends[0]
    assert high**2 - high**3 / 3 <= ends[1]


@pytest.mark.parametrize("factor", [Fraction(1001, 1000), Fraction(999, 1000)])
def test_a_root_that_is_off_is_not_believed(
    factor: Fraction, monkeypatch: pytest.MonkeyPatch
) -> None:
    ar, true_root = Intervals(30), intervals._cap_root
    off = ar.number(factor).low
    monkeypatch.setattr(intervals, "_cap_root", lambda c: true_root(c) * off)
    with pytest.raises(ArithmeticError, match="could not be verified"):
        ar.cap_root(ar.number(Fraction(1, 3)))


# Functions of boxes


def around(value: str) -> st.SearchStrategy[Ends]:
    """Boxes of up to a tenth about a value."""
    middle, shares = Fraction(value), st.fractions(0, Fraction(1, 10), max_denominator=1000)
    return st.tuples(shares, shares).map(lambda s: (middle * (1 - s[0]), middle * (1 + s[1])))


IMPACT = {
    "velocity": around("500"),
    "radius": around("1.1e-5"),
    "particle_density": around("8900"),
    "target_density": around("7850"),
    "resistance": around("3.5e9"),
}
BETAS = {
    "q": around("2.77"),
    "elastic_modulus": around("2e11"),
    "flow_stress": around("215e6"),
    "hardness_ratio": around("3"),
}
FRANK_ZOOK = {
    "length_ratio": around("2/3"),
    "particle_density": around("8900"),
    "target_density": around("7850"),
    "k_1": around("0.557"),
    "k_t": around("1.046"),
    "resistance": around("9.13e9"),
    "velocity": around("500"),
}


def final_depth(ar: Any, **inputs: Any) -> Any:
    return exact.final_depth(ar, **inputs)


def row(name: str, number: int) -> Callable[..., Any]:
    return lambda ar, **inputs: COMPUTATIONS[name].function(ar, row=number, **inputs)


FUNCTIONS = {
    "final_depth": (final_depth, IMPACT),
    "soft final_depth": (final_depth, {**IMPACT, "resistance": around("7e8")}),
    "crater_depth": (
        COMPUTATIONS["crater_depth"].function,
        {"volume_ratio": around("0.06"), "diameter": around("2.2e-5")},
    ),
    "contact_diameter": (
        COMPUTATIONS["contact_diameter"].function,
        {"normalized_depth": around("0.3"), "diameter": around("2.2e-5")},
    ),
    "least_beta": (COMPUTATIONS["least_beta"].function, BETAS),
    "greatest_beta": (COMPUTATIONS["greatest_beta"].function, BETAS),
    "walker_anderson_alpha": (
        COMPUTATIONS["walker_anderson_alpha"].function,
        {"elastic_modulus": around("2e11"), "flow_stress": around("215e6")},
    ),
    "frank_zook_derived": (COMPUTATIONS["frank_zook_derived"].function, FRANK_ZOOK),
    "row 3 deceleration": (
        row("row_deceleration", 3),
        {**IMPACT, "step": around("2e-10")},
    ),
    "row 20 velocity": (
        row("row_velocity_final", 20),
        {**IMPACT, "step": around("2e-10")},
    ),
}


@pytest.mark.parametrize("name", FUNCTIONS)
@settings(deadline=None, max_examples=25)
@given(data=st.data())
def test_the_value_at_a_point_lies_in_the_range_over_the_box(
    name: str, data: st.DataObject
) -> None:
    function, strategies = FUNCTIONS[name]
    inputs = {key: data.draw(ends, key) for key, ends in strategies.items()}
    low, high = evaluate(function, inputs)
    ar = Reals(50)
    point = {key: ends[0] + data.draw(SHARES) * (ends[1] - ends[0]) for key, ends in inputs.items()}
    real = function(ar, **{key: ar.number(value) for key, value in point.items()})
    value = Fraction(*real.as_integer_ratio())
    # The value itself is rounded to 50 digits, the range to 30: only points could tell.
    slack = abs(value) * Fraction(1, 10**45)
    assert low - slack <= value <= high + slack


def test_the_sheet_over_a_box_holds_the_sheet_at_its_corners() -> None:
    function = COMPUTATIONS["sheet_depth"].function
    fixed = box(
        radius=("1.1e-5",) * 2,
        particle_density=(8900, 8900),
        target_density=(7850, 7850),
        step=("2e-10",) * 2,
        stop_velocity=(1, 1),
    )
    velocities = (Fraction(499), Fraction(501))
    resistances = (Fraction("3.49e9"), Fraction("3.5e9"))
    low, high = evaluate(function, {**fixed, "velocity": velocities, "resistance": resistances})
    for velocity in velocities:
        for resistance in resistances:
            corner = {"velocity": (velocity,) * 2, "resistance": (resistance,) * 2}
            inner = evaluate(function, {**fixed, **corner})
            assert low < inner[0] <= inner[1] < high


def test_a_number_known_exactly_is_its_own_range() -> None:
    assert evaluate(lambda _: Fraction(1, 3), {}) == (Fraction(1, 3), Fraction(1, 3))


# Branch and bound


def parabola(_: Any, x: Any) -> Any:
    """x^2 - x, as two terms: its range over a wide box comes out too wide."""
    return x * x - x


def identity(_: Any, x: Any) -> Any:
    return x


def target(low: Any, high: Any) -> Interval:
    return Interval(
        None if low is None else Fraction(low), None if high is None else Fraction(high)
    )


def conclusions(result: Exploration) -> tuple[bool, bool, bool]:
    return result.decided, result.always, result.never


def test_every_value_inside() -> None:
    # On [0, 1] the values are -1/4 to 0; the interval range of the whole is -1 to 1.
    result = explore(parabola, box(x=(0, 1)), target("-0.3", "0.1"))
    assert conclusions(result) == (True, True, False)
    assert result.inside is not None
    assert result.outside is None
    assert result.lower <= Fraction(-1, 4)
    assert result.upper >= 0


def test_no_value_inside() -> None:
    result = explore(parabola, box(x=(0, 1)), target("0.1", None))
    assert conclusions(result) == (True, False, True)
    assert result.inside is None
    assert result.outside is not None


def test_a_fixed_input_does_not_keep_the_others_from_being_cut() -> None:
    def shifted(_: Any, x: Any, shift: Any) -> Any:
        return x * x - x + shift

    assert explore(shifted, box(x=(0, 1), shift=(2, 2)), target("1.7", "2.1")).always
    assert explore(shifted, box(x=(0, 1), shift=(2, 2)), target(None, "1.7")).never


def test_some_values_inside_and_some_outside() -> None:
    result = explore(parabola, box(x=(0, 1)), target(None, "-0.2"))
    assert not result.always
    assert not result.never
    assert result.inside is not None
    assert result.outside is not None
    inside, outside = (point["x"] for point in (result.inside, result.outside))
    assert inside**2 - inside <= Fraction(-1, 5) < outside**2 - outside


def test_a_range_is_proven_even_where_the_search_stops_early() -> None:
    result = explore(parabola, box(x=(-3, 5)), target(None, "-0.2"), budget=6)
    assert result.lower <= Fraction(-1, 4)
    assert result.upper >= 20


@pytest.mark.parametrize(
    ("closed", "expected"), [(True, (True, True, False)), (False, (False, False, False))]
)
def test_values_that_reach_an_end_of_the_target(
    closed: bool, expected: tuple[bool, bool, bool]
) -> None:
    # The end 1 of the box is not outside a closed target; of an open one, no part next to it
    # is ever proven inside.
    to_one = Interval(Fraction(0), Fraction(1), True, closed)
    assert conclusions(explore(identity, box(x=(0, 1)), to_one, budget=100)) == expected


@pytest.mark.parametrize(
    ("closed", "expected"), [(False, (True, False, True)), (True, (False, False, False))]
)
def test_values_that_start_at_an_end_of_the_target(
    closed: bool, expected: tuple[bool, bool, bool]
) -> None:
    to_one = Interval(Fraction(0), Fraction(1), True, closed)
    result = explore(identity, box(x=(1, 2)), to_one, budget=100)
    assert conclusions(result) == expected
    assert result.outside is not None


def test_an_exhausted_budget_decides_nothing() -> None:
    # 0 is touched at x = 1/3, which no halving of [0, 1] meets.
    def square(_: Any, x: Any) -> Any:
        return (3 * x - 1) ** 2

    result = explore(square, box(x=(0, 1)), target(None, 0), budget=50)
    assert conclusions(result) == (False, False, False)
    assert result.inside is None
    assert result.outside is not None
    calls = []

    def counted(ar: Any, x: Any) -> Any:
        calls.append(x)
        return square(ar, x)

    explore(counted, box(x=(0, 1)), target(None, 0), budget=50)
    assert 50 <= len(calls) <= 54  # one cut, of two evaluations for each half, may overrun


def test_a_point_at_an_end_of_the_target_is_stuck() -> None:
    # sqrt(2) squared is 2 only up to rounding, so its enclosure straddles the end.
    def two(ar: Any, x: Any) -> Any:
        return ar.context.sqrt(x) ** 2

    result = explore(two, box(x=(2, 2)), target(2, 3))
    assert conclusions(result) == (False, False, False)
    assert result.inside is None
    assert result.outside is None
    assert result.lower < 2 < result.upper


def test_a_single_point_is_decided_at_once() -> None:
    assert explore(identity, box(x=(2, 2)), target(1, 3)).always
    assert explore(identity, box(x=(4, 4)), target(1, 3)).never


def test_an_input_free_function_is_decided_at_once() -> None:
    assert explore(lambda _: Fraction(1, 3), {}, target("1/3", "1/3")).always
    assert explore(lambda _: Fraction(1, 3), {}, target("1/2", None)).never


def bowl(_: Any, x: Any, y: Any) -> Any:
    return (10 * x - 7) ** 2 / 100 + (y + 3) ** 2


def dome(_: Any, x: Any, y: Any) -> Any:
    return -bowl(_, x, y)


@pytest.mark.parametrize(
    ("function", "hit"), [(bowl, target(None, "0.01")), (dome, target("-0.01", None))]
)
def test_a_small_hit_in_a_large_box_is_found_by_going_nearer(
    function: Callable[..., Any], hit: Interval
) -> None:
    # 56 evaluations; taking the parts as they come needs 80.
    result = explore(function, box(x=(-50, 50), y=(-40, 60)), hit, budget=60)
    assert result.inside is not None
    assert hit.contains(function(None, **result.inside))


def test_a_point_of_the_box_proves_what_is_said_of_it() -> None:
    inputs = box(x=(0, 3), y=(1, 2))
    result = explore(lambda _, x, y: x * y, inputs, target(1, 2))
    for point in (result.inside, result.outside):
        assert point is not None
        assert all(inputs[key][0] <= value <= inputs[key][1] for key, value in point.items())
    assert 1 <= result.inside["x"] * result.inside["y"] <= 2
    assert not 1 <= result.outside["x"] * result.outside["y"] <= 2


@RELAXED
@given(ends=PAIRS, bounds=PAIRS)
def test_conclusions_about_the_identity_are_true(
    ends: list[Fraction], bounds: list[Fraction]
) -> None:
    (low, high), (least, most) = ends, bounds
    result = explore(identity, {"x": (low, high)}, Interval(least, most), budget=60)
    if result.always:
        assert least <= low <= high <= most
    if result.never:
        assert high < least or most < low
    if result.inside is not None:
        assert least <= result.inside["x"] <= most
    if result.outside is not None:
        assert not least <= result.outside["x"] <= most
    assert result.lower <= low <= high <= result.upper


# Admitted values


def square(_: Any, x: Any) -> Any:
    return x * x


SEARCH = (Fraction(0), Fraction(10))
RESOLUTION = Fraction(1, 1000)


def test_the_inputs_that_square_to_two_or_three() -> None:
    inner, outer = admitted([(square, target(2, 3))], "x", SEARCH, RESOLUTION)
    assert outer.lower**2 < 2 <= inner.lower**2
    assert inner.upper**2 <= 3 < outer.upper**2
    assert inner.lower - outer.lower <= 2 * RESOLUTION
    assert outer.upper - inner.upper <= 2 * RESOLUTION
    assert outer.encloses(inner.lower, inner.upper)


def test_negative_inputs_as_well() -> None:
    search = (Fraction(-10), Fraction(0))
    inner, outer = admitted([(square, target(2, 3))], "x", search, RESOLUTION)
    assert inner.lower**2 <= 3 < outer.lower**2
    assert outer.upper**2 < 2 <= inner.upper**2


def test_every_constraint_must_hold() -> None:
    both = [(square, target(2, 3)), (square, target("2.5", 9))]
    for constraints in (both, both[::-1]):
        inner, _ = admitted(constraints, "x", SEARCH, RESOLUTION)
        assert inner.lower**2 >= Fraction("2.5") > (inner.lower - 2 * RESOLUTION) ** 2


@pytest.mark.parametrize("bounds", [(1, 9), (9, 101), (None, 9), (9, None)])
def test_a_search_that_is_too_narrow_is_an_error(bounds: tuple[Any, Any]) -> None:
    with pytest.raises(ValueError, match="reaches an end of the search"):
        admitted([(square, target(*bounds))], "x", (Fraction(2), Fraction(10)), RESOLUTION)


def test_none_admitted_is_an_error() -> None:
    with pytest.raises(ValueError, match="0 separate intervals of x"):
        admitted([(square, target(-3, -2))], "x", SEARCH, RESOLUTION)


def test_two_admitted_intervals_are_an_error() -> None:
    with pytest.raises(ValueError, match="2 separate intervals of x"):
        admitted([(square, target(2, 3))], "x", (Fraction(-9), Fraction(9)), RESOLUTION)


# Extents


def distance(_: Any, x: Any, y: Any) -> Any:
    """The square of the distance from (10, 10)."""
    return (x - 10) ** 2 + (y - 10) ** 2


DISC = [(distance, target(None, 4))]
SQUARE = box(x=("7.1", "15.2"), y=("6.3", 13))
CENTER = Fraction(10)
TOLERANCE = Fraction(1, 20)


def test_the_extent_of_a_disc() -> None:
    """Of radius 2 about (10, 10): x ranges from 8 to 12."""
    inner, outer = extent(DISC, "x", SQUARE, CENTER, TOLERANCE)
    assert outer.lower <= 8 <= inner.lower <= outer.lower + TOLERANCE
    assert outer.upper - TOLERANCE <= inner.upper <= 12 <= outer.upper


def test_the_extent_under_two_constraints() -> None:
    """On the disc and right of x = 11, y ranges from 10 - sqrt(3) to 10 + sqrt(3)."""
    right = (lambda _, x, y: x + 0 * y, target(11, None))
    inner, outer = extent([*DISC, right], "y", SQUARE, CENTER, TOLERANCE, budget=4000)
    assert (inner.upper - 10) ** 2 <= 3 <= (outer.upper - 10) ** 2
    assert (inner.lower - 10) ** 2 <= 3 <= (outer.lower - 10) ** 2
    assert inner.lower < 10 < inner.upper
    assert outer.upper - inner.upper <= TOLERANCE
    assert inner.lower - outer.lower <= TOLERANCE


@pytest.mark.parametrize("bounds", [("0.4", None), (None, "0.6"), (None, None)])
def test_the_box_bounds_the_extent_too(bounds: tuple[Any, Any]) -> None:
    low, high = Fraction(bounds[0] or 0), Fraction(bounds[1] or 1)
    inner, outer = extent(
        [(identity, target(*bounds))], "x", box(x=(0, 1)), Fraction(1, 2), TOLERANCE
    )
    assert outer.lower <= low <= inner.lower <= outer.lower + TOLERANCE
    assert outer.upper - TOLERANCE <= inner.upper <= high <= outer.upper


def test_a_short_budget_leaves_a_wider_extent() -> None:
    inner, outer = extent(DISC, "x", SQUARE, CENTER, Fraction(0), budget=60)
    assert outer.lower <= 8 <= inner.lower
    assert inner.upper <= 12 <= outer.upper


def test_an_input_that_reaches_zero_does_not_take_all_the_cuts() -> None:
    # Seen relatively, [0, h] is as wide as ever, however small h is.
    def beside_zero(_: Any, x: Any, y: Any) -> Any:
        return x + y * y - y

    assert explore(beside_zero, box(x=(0, "0.01"), y=(1, 2)), target("-0.1", "2.1")).always


# All solutions


def test_two_solutions_are_both_found() -> None:
    found = solutions([(square, target(4, 9))], "x", (Fraction(-9), Fraction(9)), RESOLUTION)
    assert len(found.inner) == len(found.outer) == 2
    for inner, outer, ends in zip(found.inner, found.outer, ((-3, -2), (2, 3)), strict=True):
        assert ends[0] <= inner.lower <= ends[0] + 2 * RESOLUTION
        assert outer.lower <= ends[0]
        assert ends[1] - 2 * RESOLUTION <= inner.upper <= ends[1] <= outer.upper
    assert not found.reaches_an_end


def test_no_solution_is_proven_by_an_empty_outer() -> None:
    found = solutions([(square, target(-3, -2))], "x", (Fraction(-9), Fraction(9)), RESOLUTION)
    assert (found.inner, found.outer) == ((), ())


def test_what_a_budget_leaves_open_is_not_excluded() -> None:
    search = (Fraction(-9), Fraction(0), Fraction(9))
    found = solutions([(square, target(4, 9))], "x", search, RESOLUTION, budget=2)
    assert found.inner == ()
    assert [(part.lower, part.upper) for part in found.outer] == [(-9, 9)]
    assert found.reaches_an_end


def test_the_point_that_satisfies_does() -> None:
    outcome, point = satisfying([(square, target(2, 3))], {"x": (Fraction(0), Fraction(9))})
    assert outcome is True
    assert point is not None
    assert 2 <= point["x"] ** 2 <= 3
    assert satisfying([(square, target(2, 3))], {"x": (Fraction(4), Fraction(9))}) == (False, None)

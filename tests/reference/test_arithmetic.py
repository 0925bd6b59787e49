"""Every arithmetic gives what the formulas need: derivatives, proven ranges, exact quotients."""

import re
from collections.abc import Callable
from fractions import Fraction as F
from typing import Any

import flint
import mpmath
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from reference.arithmetic import (
    Arithmetic,
    Duals,
    Floats,
    InexactError,
    RationalFunctions,
    Rationals,
    Reals,
)
from reference.intervals import Intervals

OPERATIONS: dict[str, Callable[[Any, Any, Any], Any]] = {
    "sum": lambda ar, x, y: x + y + 1,
    "difference": lambda ar, x, y: (x - y - 2) * (3 - x),
    "product": lambda ar, x, y: -x * y * 3,
    "quotient": lambda ar, x, y: x / y + 2 / x + y / 7,
    "powers": lambda ar, x, y: (x - y) ** 3 + x**2 - y**1 + x**0,
    "root": lambda ar, x, y: ar.power(x, F(3, 2)) + ar.power(y, F(-1, 3)) + ar.power(x, F(-2)),
    "logarithm": lambda ar, x, y: ar.log(x * y) + ar.pi * x,
    "least": lambda ar, x, y: ar.least(x, y) * 2,
    "greatest": lambda ar, x, y: ar.greatest(x, y) - x,
    "contact share": lambda ar, x, y: ar.contact_share(x / 3) * y,
    "cap root": lambda ar, x, y: ar.cap_root(x / 5) + y,
}
NUMBERS = st.fractions(F(1, 4), F(5, 2), max_denominator=999)
SHARES = st.fractions(0, 1, max_denominator=64)
REALS = Reals(50)


def exact(real: Any) -> F:
    return F(*real.as_integer_ratio())


@settings(max_examples=40)
@given(x=NUMBERS, y=NUMBERS)
def test_derivatives_are_those_of_finite_differences_and_floats_are_near(x: F, y: F) -> None:
    if abs(x - y) < F(1, 10**6):  # a kink has no derivative
        return
    step, duals = F(1, 10**15), Duals(REALS)
    variables = [duals.variable(REALS.number(value), name) for name, value in (("x", x), ("y", y))]
    for name, function in OPERATIONS.items():
        dual = function(duals, *variables)
        assert dual.value == function(REALS, REALS.number(x), REALS.number(y)), name
        # A dozen rounding errors, of 1e-16 relative to terms below 100 that may cancel.
        assert abs(function(Floats(), float(x), float(y)) - dual.value) < 1e-12, name
        for by, dx, dy in (("x", step, 0), ("y", 0, step)):
            below, above = (
                function(REALS, REALS.number(x + s * dx), REALS.number(y + s * dy)) for s in (-1, 1)
            )
            # The error is the third derivative, below 1e4 here, times the step's square, 1e-30.
            slope = (above - below) / (2 * REALS.number(step))
            assert abs(slope - dual.slopes.get(by, 0)) < 1e-25, name


@settings(max_examples=60)
@given(xs=st.tuples(NUMBERS, NUMBERS), ys=st.tuples(NUMBERS, NUMBERS), s=SHARES, t=SHARES)
def test_spans_contain_what_points_give(xs: tuple[F, F], ys: tuple[F, F], s: F, t: F) -> None:
    ar = Intervals(20)
    (x0, x1), (y0, y1) = sorted(xs), sorted(ys)
    assume(
        not x0 == x1 == y0 == y1
    )  # x - y is then a ball about 0, whose power Arb does not define
    point = REALS.number(x0 + s * (x1 - x0)), REALS.number(y0 + t * (y1 - y0))
    for name, function in OPERATIONS.items():
        with ar.working():
            low, high = ar.ends(function(ar, ar.interval(x0, x1), ar.interval(y0, y1)))
        value = exact(function(REALS, *point))
        slack = abs(value) * F(1, 10**45)  # the value has 50 digits, the span 20
        assert low - slack <= value <= high + slack, name


SIGNED = st.fractions(-9, 9, max_denominator=99)


@given(st.tuples(SIGNED, SIGNED), st.tuples(SIGNED, SIGNED))
def test_spans_of_any_sign_reach_from_end_to_end(xs: tuple[F, F], ys: tuple[F, F]) -> None:
    """Arb's own product of two balls about [0, 2] reaches down to -4."""
    ar = Intervals(20)
    (x0, x1), (y0, y1) = sorted(xs), sorted(ys)
    assume(
        not x0 == x1 == y0 == y1
    )  # x - y is then a ball about 0, whose power Arb does not define
    x, y = ar.interval(x0, x1), ar.interval(y0, y1)
    products = [a * b for a in (x0, x1) for b in (y0, y1)]
    quotients = [a / (b - 20) for a in (x0, x1) for b in (y0, y1)]
    squares = [0] * (x0 < 0 < x1) + [x0 * x0, x1 * x1]
    with ar.working():
        for span, values in (
            (x * y, products),
            (x / (y - 20), quotients),
            (2 * x + y - 1, (2 * x0 + y0 - 1, 2 * x1 + y1 - 1)),
            (1 - x - y, (1 - x1 - y1, 1 - x0 - y0)),
            (x**2 * -1, (-max(squares), -min(squares))),
            (x**3, (x0**3, x1**3)),
            (x**0 + y, (1 + y0, 1 + y1)),
            (ar.least(x, y), (min(x0, y0), min(x1, y1))),
            (ar.greatest(x, y), (max(x0, y0), max(x1, y1))),
            (ar.hull([x, y]), (min(x0, y0), max(x1, y1))),
        ):
            low, high = ar.ends(span)
            assert low <= min(values) <= low + F(1, 10**14)
            assert high - F(1, 10**14) <= max(values) <= high
    assert (ar.below(x, y) is True) <= (x1 < y0) <= (ar.below(y, x) is False)
    assert (ar.below(x, y) is not False) >= (x0 < y1)


@settings(max_examples=40)
@given(st.tuples(*[st.fractions(0, F(2, 3), max_denominator=10**6)] * 2))
def test_cap_roots_are_verified_and_tight(ends: tuple[F, F]) -> None:
    low, high = sorted(ends)
    ar = Intervals(30)
    least, greatest = ar.ends(ar.cap_root(ar.interval(low, high)))

    def share(y: F) -> F:  # increases on [0, 2]
        return y**2 - y**3 / 3

    assert share(least) <= low <= high <= share(greatest)
    if low > F(1, 10**5):
        assert share(least * (1 + F(1, 10**20))) >= low
        assert share(greatest * (1 - F(1, 10**20))) <= high


def test_a_wrong_root_is_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    root = Arithmetic.cap_root
    ar = Intervals(30)
    for off in (1 + 2.0**-20, 1 - 2.0**-20):
        monkeypatch.setattr(Arithmetic, "cap_root", lambda self, c, off=off: root(self, c) * off)
        with pytest.raises(ArithmeticError, match="could not be verified"):
            ar.cap_root(ar.number(F(1, 3)))


# What has no number


SPANS = Intervals(20)


def span(low: int, high: int) -> Any:
    return SPANS.interval(F(low), F(high))


def test_a_span_is_not_divided_by_zero() -> None:
    message = r"^division by \[-1.00000000000000, 1.00000000000000\], which may be zero$"
    with pytest.raises(ZeroDivisionError, match=message):
        1 / span(-1, 1)
    with pytest.raises(ZeroDivisionError, match=r"^division by \[0, 0\], which may be zero$"):
        span(-2, -1) / SPANS.number(0)


def test_the_power_of_a_span_is_natural() -> None:
    with pytest.raises(ValueError, match=r"^the power -1 of an interval is negative$"):
        span(-2, -1) ** -1


NEGATIVE = span(-2, -1)


@pytest.mark.parametrize(
    ("compute", "ends"),
    [
        pytest.param(lambda: SPANS.ends(SPANS.log(NEGATIVE)), "[nan, nan]", id="ends"),
        pytest.param(lambda: SPANS.ends(SPANS.log(span(0, 1))), "[nan, 0]", id="at zero"),
        pytest.param(
            lambda: SPANS.ends(SPANS.power(span(-1, 1), F(1, 2))),
            "[nan, 1.00000000000000]",
            id="root",
        ),
        pytest.param(lambda: SPANS.least(SPANS.log(NEGATIVE), NEGATIVE), "[nan, nan]", id="least"),
        pytest.param(
            lambda: SPANS.greatest(NEGATIVE, SPANS.log(NEGATIVE)), "[nan, nan]", id="greatest"
        ),
        pytest.param(lambda: SPANS.hull([NEGATIVE, SPANS.log(NEGATIVE)]), "[nan, nan]", id="hull"),
        pytest.param(lambda: SPANS.below(SPANS.log(NEGATIVE), NEGATIVE), "[nan, nan]", id="below"),
    ],
)
def test_an_undefined_span_is_refused_when_it_is_used(
    compute: Callable[[], Any], ends: str
) -> None:
    message = f"an enclosure is unbounded or undefined: {ends}"
    with pytest.raises(ArithmeticError, match=f"^{re.escape(message)}$"):
        compute()


def test_a_cap_root_of_negative_numbers_is_refused() -> None:
    with pytest.raises(ArithmeticError, match=r"^a root of .* = c could not be verified$"):
        SPANS.cap_root(NEGATIVE)


# Quotients of polynomials


RATIOS = RationalFunctions(["x", "y"])
X, Y = RATIOS.symbols["x"], RATIOS.symbols["y"]


@pytest.mark.parametrize(
    ("left", "right", "expected"),
    [
        pytest.param((X**2 - Y**2) / (X - Y), X + Y, True, id="reduced"),
        pytest.param((X**2 - Y**2) / (X - Y), X + 2 * Y, False, id="another sum"),
        pytest.param(1 / (1 / X + 1 / Y), X * Y / (X + Y), True, id="two stories"),
        pytest.param(X**-2, 1 / (X * X), True, id="negative power"),
        pytest.param(X - 2, -(2 - X), True, id="turned difference"),
        pytest.param(RATIOS.log(X * Y / Y), RATIOS.log(X), True, id="logarithms of the same"),
        pytest.param(RATIOS.log(X), RATIOS.log(Y), False, id="logarithms of two symbols"),
        pytest.param(
            RATIOS.power(X, F(1, 2)), RATIOS.power(X, F(1, 3)), False, id="roots of two degrees"
        ),
        pytest.param(RATIOS.power(X, F(1, 2)), RATIOS.log(X), False, id="root and logarithm"),
        pytest.param(RATIOS.power(X, F(-2)), 1 / X**2, True, id="power"),
        pytest.param(RATIOS.power(RATIOS.number(1), F(1, 2)), 1, True, id="root of one"),
        pytest.param(RATIOS.pi * X / X, RATIOS.pi, True, id="pi"),
    ],
)
def test_two_forms_are_equal_for_all_symbols_or_not(left: Any, right: Any, expected: bool) -> None:
    assert (left == right) is expected


@pytest.mark.parametrize(
    ("ratio", "expected"),
    [((2 * X + 2 * Y) / (3 * Y + 3 * X), F(2, 3)), (X / Y, None), ((X - X) / Y, F(0))],
)
def test_a_ratio_may_be_one_number(ratio: Any, expected: F | None) -> None:
    assert RATIOS.constant(ratio) == expected


def test_a_polynomial_that_is_zero_divides_nothing() -> None:
    with pytest.raises(ZeroDivisionError, match=r"^division by a polynomial that is zero$"):
        X / (Y - Y)


# Exact fractions, and single numbers


RATIONALS = Rationals()


def test_fractions_stay_exact() -> None:
    assert RATIONALS.number(F(1, 3)) * 3 == 1
    assert RATIONALS.power(F(2, 3), F(-2)) == F(9, 4)
    assert RATIONALS.contact_share(F(1, 3)) == F(5, 9)
    assert (RATIONALS.least(F(1), F(2)), RATIONALS.greatest(F(1), F(2))) == (1, 2)
    assert RATIONALS.hull([F(1)]) == 1


@pytest.mark.parametrize(
    "compute",
    [
        pytest.param(lambda: RATIONALS.pi, id="pi"),
        pytest.param(lambda: RATIONALS.log(F(2)), id="logarithm"),
        pytest.param(lambda: RATIONALS.power(F(2), F(1, 2)), id="root"),
        pytest.param(lambda: RATIONALS.cap_root(F(1, 2)), id="cap root"),
    ],
)
def test_what_is_not_rational_is_refused(compute: Callable[[], Any]) -> None:
    with pytest.raises(InexactError, match=r"^the value is not rational, or not known to be$"):
        compute()


@pytest.mark.parametrize("ar", [RATIONALS, Floats(), Reals(20)], ids=lambda ar: type(ar).__name__)
def test_below_is_strict(ar: Any) -> None:
    pairs = (1, 2), (2, 1), (1, 1)
    actual = [ar.below(ar.number(F(low)), ar.number(F(high))) for low, high in pairs]
    assert actual == [True, False, False]


def test_two_numbers_have_no_hull_but_in_intervals() -> None:
    with pytest.raises(ValueError, match="too many values"):
        Floats().hull([1.0, 2.0])


def test_negative_reals_have_powers_but_no_logarithms_or_roots() -> None:
    reals = Reals(20)
    assert reals.power(reals.number(-2), F(3)) == -8
    for compute in (reals.log, reals.cap_root, lambda x: reals.power(x, F(1, 2))):
        with pytest.raises(ArithmeticError, match=r"^a negative number has no real logarithm"):
            compute(reals.number(-2))
    with pytest.raises(ArithmeticError, match=r"^y\^2 - y\^3/3 is at most 4/3, at y = 2$"):
        reals.cap_root(reals.number(22))


def test_global_precision_is_left_alone() -> None:
    before = mpmath.mp.dps, flint.ctx.prec
    assert abs(exact(Reals(60).pi) - exact(Reals(40).pi)) < F(1, 10**39)
    with Intervals(33).working():
        assert flint.ctx.dps == 33
        Intervals(40).cap_root(Intervals(40).interval(F(1, 3), F(1, 2)))
        assert flint.ctx.dps == 33
    assert (mpmath.mp.dps, flint.ctx.prec) == before
    assert isinstance(Intervals(20).pi, flint.arb)

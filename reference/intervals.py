"""Interval arithmetic with Arb balls: it encloses the report's equations over boxes of inputs.

Arb's balls (a midpoint and a radius) are rigorous and fast, but too coarse for wide intervals: the
product of the balls [0, 2] and [0, 2] is [-2, 4], and a deceleration that may be negative makes the
sheet's rows diverge. A wide interval is therefore a `Span`: a ball for its lower end and a ball for
its upper end. Every operation is applied to the ends, where it is monotone, and Arb bounds the
rounding errors of both. A single number is one ball, and Arb alone computes with it.
"""

from collections.abc import Callable
from fractions import Fraction
from functools import reduce
from math import prod
from typing import Any

from flint import arb, ctx, fmpq

from reference.arithmetic import Arithmetic, Number, Operators


class Span(Operators):
    """The interval from the least number in the ball `low` to the greatest in the ball `high`."""

    __slots__ = ("high", "low")

    def __init__(self, low: arb, high: arb) -> None:
        self.low, self.high = low, high

    def __repr__(self) -> str:
        return f"[{self.low}, {self.high}]"

    def __neg__(self) -> "Span":
        return Span(-self.high, -self.low)

    def __add__(self, other: Number) -> "Span":
        low, high = _end_balls(other)
        return Span(self.low + low, self.high + high)

    def __mul__(self, other: Number) -> "Span":
        low, high = _end_balls(other)
        if self.low >= _ZERO and low >= _ZERO:
            return Span(self.low * low, self.high * high)
        corners = [x * y for x in (self.low, self.high) for y in (low, high)]
        return Span(reduce(arb.min, corners), reduce(arb.max, corners))

    def __truediv__(self, other: Number) -> Number:
        return self * _reciprocal(*_end_balls(other))

    def __rtruediv__(self, other: Number) -> Number:
        return _reciprocal(self.low, self.high) * other

    def __pow__(self, exponent: int) -> "Span":
        """Return a power with a natural exponent. Raises ValueError for a negative exponent."""
        if exponent < 0:
            raise ValueError(f"the power {exponent} of an interval is negative")
        low, high = self.low, self.high
        if exponent % 2 == 0 and not low >= _ZERO:
            low, high = low.max(-high).max(_ZERO), high.max(-low)
        # By repeated products: Arb's own real power is undefined for a ball that contains 0.
        return Span(prod([low] * exponent, start=_ONE), prod([high] * exponent, start=_ONE))


_ZERO, _ONE = arb(0), arb(1)


def _reciprocal(low: Any, high: Any) -> Number:
    if not (low > 0 or high < 0):
        raise ZeroDivisionError(f"division by [{low}, {high}], which may be zero")
    return _ONE / high if low is high else Span(_ONE / high, _ONE / low)


def _end_balls(x: Number) -> tuple[Any, Any]:
    """Return the balls (or the integers) at the lower and the upper end of a number."""
    return (x.low, x.high) if isinstance(x, Span) else (x, x)


def _bounded(x: Number) -> tuple[arb, arb]:
    """Return the balls at both ends. Raises ArithmeticError if one of them is not finite."""
    low, high = _end_balls(x)
    if not (low.is_finite() and high.is_finite()):
        raise ArithmeticError(f"an enclosure is unbounded or undefined: {x}")
    return low, high


def _increasing(function: Callable[[arb], arb], x: Number) -> Number:
    """Apply a function that increases all over x."""
    return Span(function(x.low), function(x.high)) if isinstance(x, Span) else function(x)


class Intervals(Arithmetic):
    """Balls and spans with a given number of decimal digits, rounded outwards.

    The operators work at flint's current precision, which `working` sets. The result is a proven
    enclosure at any precision, but only inside `working` is it as narrow as the digits allow. An
    enclosure that is unbounded or undefined (such as the logarithm of an interval that contains 0)
    raises ArithmeticError as soon as it is compared or its ends are asked for.

    >>> ar = Intervals(20)
    >>> low, high = ar.ends(ar.number(Fraction(1, 3)))
    >>> low < Fraction(1, 3) < high
    True
    >>> ar.ends(ar.interval(Fraction(-7, 2), Fraction(1)))
    (Fraction(-7, 2), Fraction(1, 1))
    """

    sqrt, sin, asin = staticmethod(arb.sqrt), staticmethod(arb.sin), staticmethod(arb.asin)

    def __init__(self, digits: int = 50) -> None:
        with ctx.workdps(digits):
            self._bits = ctx.prec  # setting bits takes half the time of setting digits
            self.pi = arb.pi()

    def working(self) -> Any:
        """Return a context manager in which the operators carry all the digits."""
        return ctx.workprec(self._bits)

    def number(self, value: Fraction | int) -> Number:
        if ctx.prec == self._bits:  # much faster than setting the precision again
            return _ball(value)
        with self.working():
            return _ball(value)

    def interval(self, lower: Fraction, upper: Fraction) -> Number:
        """Return an interval that contains every number from lower to upper."""
        if lower is upper or lower == upper:  # in this order, as comparing fractions is slow
            return self.number(lower)
        with self.working():
            return Span(_ball(lower).lower(), _ball(upper).upper())

    def ends(self, x: Number) -> tuple[Fraction, Fraction]:
        """Return the lower and the upper end, exactly."""
        low, high = _bounded(x)
        ends = (low.mid().fmpq() - low.rad().fmpq(), high.mid().fmpq() + high.rad().fmpq())
        lower, upper = (Fraction(int(end.p), int(end.q)) for end in ends)
        return lower, upper

    def log(self, x: Number) -> Number:
        return _increasing(arb.log, x)

    def log1p(self, x: Number) -> Number:
        return _increasing(arb.log1p, x)

    def expm1(self, x: Number) -> Number:
        return _increasing(arb.expm1, x)

    def root(self, x: Number, degree: int) -> Number:
        return _increasing(lambda end: end.root(degree), x)

    def least(self, x: Number, bound: Number) -> Number:
        if _end_balls(x)[1] <= _end_balls(bound)[0]:
            return x
        (low, high), (bound_low, bound_high) = _bounded(x), _bounded(bound)
        return Span(low.min(bound_low), high.min(bound_high))

    def contact_share(self, y: Number) -> Number:
        return _increasing(lambda end: end * (2 - end), y)

    def cap_root(self, c: Number) -> Number:
        """Return an interval that is verified to contain the root for every number in c."""
        with self.working():
            (least, greatest), margin = _bounded(c), arb(2) ** (20 - ctx.prec)
            low = (super().cap_root(least) * (1 - margin)).lower()
            high = (super().cap_root(greatest) * (1 + margin)).upper()
            # y^2 - y^3/3 increases on [0, 2]: at the ends it must be at most and at least c.
            if not (low**2 - low**3 / 3 <= least and high**2 - high**3 / 3 >= greatest):
                raise ArithmeticError("a root of y^2 - y^3/3 = c could not be verified")
        return Span(low, high)

    def cap_volume(self, y: Number) -> Number:
        return _increasing(lambda end: end * end * (3 - end) / 3, y)

    def exp_mean_root(self, k: Number) -> Number:
        """Return a verified interval of the roots for the numbers in k.

        A number below 1 has none, for which 0 is taken, the root of 1: so this stays a continuous
        function, and an interval whose upper end is 0 proves that there is none.
        """
        with self.working():
            least, greatest = _bounded(k)
            return Span(_exp_mean_bound(least, -1), _exp_mean_bound(greatest, 1))

    def exp_mean_slope(self, x: Number) -> Number:
        """Return an enclosure: the mean of t e^(t x) for t from 0 to 1 is from 1/2 to e^x / 2."""
        return Span(_ONE / 2, _bounded(x)[1].exp() / 2)

    def below(self, x: Number, bound: Number) -> bool | None:
        if _end_balls(x)[0] >= _end_balls(bound)[1]:
            return False
        return True if _bounded(x)[1] < _bounded(bound)[0] else None

    def sign(self, x: Number) -> int:
        """Return 1 if x is proven not to be negative, -1 if not to be positive, and else 0."""
        low, high = _end_balls(x)
        return 1 if low >= _ZERO else -1 if high <= _ZERO else 0

    def is_zero(self, x: Number) -> bool:
        """Return whether x is proven to be 0."""
        low, high = _end_balls(x)
        return bool(low == _ZERO == high)

    def hull(self, numbers: list[Number]) -> Number:
        lows, highs = zip(*map(_bounded, numbers), strict=True)
        return Span(reduce(arb.min, lows), reduce(arb.max, highs))


def _exp_mean_bound(k: arb, side: int) -> arb:
    """Return a number that is verified to be no greater (side -1) or no less (1) than the root x.

    (e^x - 1) / x = k increases with x from 1 at 0, and 2 ln k is at or above x. Newton's method for
    ln((e^x - 1) / x) = ln k, whose slope increases from 1/2 to 1, descends from there to x.
    """
    excess = (k - 1).upper() if side > 0 else (k - 1).lower()
    if not excess > 0:
        return _ZERO
    goal = excess.log1p().mid()
    x = 2 * goal
    for _ in range(100):
        mean = (x.expm1() / x).mid()
        lower = (x - (mean.log() - goal) / (1 + 1 / x.expm1() - 1 / x)).mid()
        if not _ZERO < lower < x:
            break
        x = lower
    margin = arb(2) ** (20 - ctx.prec)
    while margin < 1:
        bound = (x * (1 + side * margin)).mid()
        mean = bound.expm1() / bound - 1
        if mean >= excess if side > 0 else mean <= excess:
            return bound
        margin = margin * 16
    return _ZERO if side < 0 else (2 * excess.log1p()).upper()


def _ball(value: Fraction | int) -> arb:
    return arb(fmpq(value.numerator, value.denominator))

"""Intervals between Arb balls: the arithmetic in which the equations are proven over boxes.

Arb's balls are rigorous and fast, but too coarse for wide boxes: their product of [0, 2] and [0, 2]
is [-2, 4], and a deceleration that may be negative drives the sheet apart. So an interval is a
`Span` between two balls, its ends, to which each operation is applied where it is monotone; Arb
keeps the rounding errors of either end. A point is a ball, computed with by Arb alone.
"""

from collections.abc import Callable
from fractions import Fraction
from functools import reduce
from math import prod
from typing import Any

from flint import arb, ctx, fmpq

from reference.arithmetic import Arithmetic, Number, Operators


class Span(Operators):
    """All numbers from the least in the ball `low` to the greatest in the ball `high`."""

    __slots__ = ("high", "low")

    def __init__(self, low: arb, high: arb) -> None:
        self.low, self.high = low, high

    def __repr__(self) -> str:
        return f"[{self.low}, {self.high}]"

    def __neg__(self) -> "Span":
        return Span(-self.high, -self.low)

    def __add__(self, other: Number) -> "Span":
        low, high = _balls(other)
        return Span(self.low + low, self.high + high)

    def __mul__(self, other: Number) -> "Span":
        low, high = _balls(other)
        if self.low >= _ZERO and low >= _ZERO:
            return Span(self.low * low, self.high * high)
        corners = [x * y for x in (self.low, self.high) for y in (low, high)]
        return Span(reduce(arb.min, corners), reduce(arb.max, corners))

    def __truediv__(self, other: Number) -> Number:
        return self * _inverse(*_balls(other))

    def __rtruediv__(self, other: Number) -> Number:
        return _inverse(self.low, self.high) * other

    def __pow__(self, power: int) -> "Span":
        """A power with a natural exponent, as the equations have them."""
        if power < 0:
            raise ValueError(f"the power {power} of an interval is negative")
        low, high = self.low, self.high
        if power % 2 == 0 and not low >= _ZERO:
            low, high = low.max(-high).max(_ZERO), high.max(-low)
        # By products, as Arb's own real power knows nothing of a ball about 0.
        return Span(prod([low] * power, start=_ONE), prod([high] * power, start=_ONE))


_ZERO, _ONE = arb(0), arb(1)


def _inverse(low: Any, high: Any) -> Number:
    if not (low > 0 or high < 0):
        raise ZeroDivisionError(f"division by [{low}, {high}], which may be zero")
    return _ONE / high if low is high else Span(_ONE / high, _ONE / low)


def _balls(x: Number) -> tuple[Any, Any]:
    """The balls, or integers, at the least and the greatest end of a number."""
    return (x.low, x.high) if isinstance(x, Span) else (x, x)


def _increasing(function: Callable[[arb], arb], x: Number) -> Number:
    return Span(function(x.low), function(x.high)) if isinstance(x, Span) else function(x)


class Intervals(Arithmetic):
    """Balls and spans of a given number of decimal digits, rounded outwards.

    Operators work at flint's own precision, which `working` sets: a proof whatever it is, but only
    there as narrow as the digits allow. A number that is unbounded or undefined (a logarithm of
    zero, say, or a power of what is zero but for its rounding error) raises ArithmeticError where
    it would be compared or given out.

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
            self._bits = ctx.prec  # set in half the time that the digits take
            self.pi = arb.pi()

    def working(self) -> Any:
        """A context manager in which operators carry the digits."""
        return ctx.workprec(self._bits)

    def number(self, value: Fraction | int) -> Number:
        if ctx.prec == self._bits:
            return _ball(value)
        with self.working():
            return _ball(value)

    def interval(self, lower: Fraction, upper: Fraction) -> Number:
        """An interval that contains both rationals and all between."""
        if lower is upper or lower == upper:  # in this order, as rationals compare slowly
            return self.number(lower)
        with self.working():
            return Span(_ball(lower).lower(), _ball(upper).upper())

    def ends(self, x: Number) -> tuple[Fraction, Fraction]:
        """Both ends, as the rationals that they are."""
        low, high = _bounded(x)
        least = low.mid().fmpq() - low.rad().fmpq()
        greatest = high.mid().fmpq() + high.rad().fmpq()
        return Fraction(int(least.p), int(least.q)), Fraction(int(greatest.p), int(greatest.q))

    def log(self, x: Number) -> Number:
        return _increasing(arb.log, x)

    def power(self, x: Number, exponent: Fraction) -> Number:
        degree = exponent.denominator
        root = x if degree == 1 else _increasing(lambda end: end.root(degree), x)
        size = root ** abs(exponent.numerator)
        return size if exponent > 0 else 1 / size

    def least(self, x: Number, bound: Number) -> Number:
        if _balls(x)[1] <= _balls(bound)[0]:
            return x
        (low, high), (other_low, other_high) = _bounded(x), _bounded(bound)
        return Span(low.min(other_low), high.min(other_high))

    def contact_share(self, y: Number) -> Number:
        return _increasing(lambda end: end * (2 - end), y)

    def cap_root(self, c: Number) -> Number:
        """The roots for both ends, moved outwards and then verified by the residual's sign."""
        with self.working():
            (least, greatest), margin = _bounded(c), arb(2) ** (20 - ctx.prec)
            low = (super().cap_root(least) * (1 - margin)).lower()
            high = (super().cap_root(greatest) * (1 + margin)).upper()
            if not (low**2 - low**3 / 3 <= least and high**2 - high**3 / 3 >= greatest):
                raise ArithmeticError("a root of y^2 - y^3/3 = c could not be verified")
        return Span(low, high)

    def below(self, x: Number, bound: Number) -> bool | None:
        if _balls(x)[0] >= _balls(bound)[1]:
            return False
        return True if _bounded(x)[1] < _bounded(bound)[0] else None

    def sign(self, x: Number) -> int:
        """1 for a number that is proven not to be negative, -1 not positive, else 0."""
        low, high = _balls(x)
        return 1 if low >= _ZERO else -1 if high <= _ZERO else 0

    def is_zero(self, x: Number) -> bool:
        """Whether it is proven to be 0."""
        return bool(_balls(x)[0] == _ZERO == _balls(x)[1])

    def hull(self, numbers: list[Number]) -> Number:
        lows, highs = zip(*map(_bounded, numbers), strict=True)
        return Span(reduce(arb.min, lows), reduce(arb.max, highs))


def _ball(value: Fraction | int) -> arb:
    return arb(fmpq(value.numerator, value.denominator))


def _bounded(x: Number) -> tuple[arb, arb]:
    """The balls at both ends. Raises ArithmeticError if one is not finite: it proves nothing."""
    low, high = _balls(x)
    if not (low.is_finite() and high.is_finite()):
        raise ArithmeticError(f"an enclosure is unbounded or undefined: {x}")
    return low, high

"""The kinds of numbers in which the report's formulas, each written once, can be computed.

`Reals` are mpmath numbers of any precision, `reference.intervals.Intervals` proven intervals.
`Duals` carry the derivatives along in either of them. `RationalFunctions` are quotients of
polynomials, in which two forms of an equation are equal exactly or not at all.
"""

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import Any, Self

Number = Any
"""A number of the arithmetic in use; all of them have the operators + - * /."""

Function = Callable[..., Number | Fraction]
"""Takes an arithmetic and inputs by name; gives a Fraction where the value is known exactly."""


class Arithmetic:
    """The functions that the formulas need beyond the operators; the defaults are for points.

    `power` takes x > 0 unless the exponent is a whole number. `cap_root` is the y in [0, 1] with
    y^2 - y^3/3 = c, for c in [0, 2/3]. `below` is None where x < bound is possible, not certain.
    """

    pi: Number
    number: Callable[[Any], Number]
    log: Callable[[Any], Number]
    sqrt: Callable[[Any], Number]
    sin: Callable[[Any], Number]
    asin: Callable[[Any], Number]
    power: Callable[[Any, Fraction], Number]
    least: Callable[[Any, Any], Number] = staticmethod(min)
    below: Callable[[Any, Any], bool | None] = staticmethod(operator.lt)

    def greatest(self, x: Number, bound: Number) -> Number:
        return -self.least(-x, -bound)

    def cap_root(self, c: Number) -> Number:
        # By the triple angle of 1 - y, without cancellation.
        third = self.asin(self.sqrt(3 * c) / 2) / 3
        return 2 * self.sin(third) ** 2 + self.sqrt(self.number(3)) * self.sin(2 * third)

    def crater(self, volume_ratio: Number) -> Number:
        """X/R of a crater: CV/PV = y^2 (3 - y) / 4 = (3/4) (y^2 - y^3/3)."""
        return self.cap_root(4 * volume_ratio / 3)

    def contact_share(self, y: Number) -> Number:
        """y (2 - y), which increases on its domain, 0 <= y <= 1."""
        return y * (2 - y)

    def hull(self, numbers: list[Number]) -> Number:
        """A number that contains all of these."""
        (only,) = numbers
        return only


class Reals(Arithmetic):
    """mpmath numbers of a given number of decimal digits; no global precision is changed.

    >>> print(Reals(30).pi)
    3.14159265358979323846264338328
    """

    def __init__(self, digits: int = 50) -> None:
        self.context = _context(digits)
        self.pi = +self.context.pi

    def number(self, value: Fraction | int) -> Number:
        return self.context.mpf(value.numerator) / value.denominator

    def log(self, x: Number) -> Number:
        return self._real(self.context.log(x))

    def power(self, x: Number, exponent: Fraction) -> Number:
        root = x if exponent.denominator == 1 else self.context.root(x, exponent.denominator)
        return self._real(root) ** exponent.numerator

    def _real(self, x: Number) -> Number:
        if isinstance(x, self.context.mpc):
            raise ArithmeticError("a negative number has no real logarithm, and no real root")
        return x

    def cap_root(self, c: Number) -> Number:
        if 3 * c > 4:
            raise ArithmeticError("y^2 - y^3/3 is at most 4/3, at y = 2")
        # With y = s sqrt(c) the root s stays in [1, 1.23], however small c is.
        root = self._real(self.context.sqrt(c))
        return root * self.context.findroot(lambda s: s * s - root * s**3 / 3 - 1, (1, 1.2))


@cache
def _context(digits: int) -> Any:
    """An mpmath context, made once: that takes milliseconds, and the import many more."""
    import mpmath

    context = mpmath.MPContext()
    context.dps = digits
    return context


class InexactError(ArithmeticError):
    """A number is not rational, or not known to be."""


class Rationals(Arithmetic):
    """Exact fractions, for as long as a formula needs no other numbers."""

    number = Fraction

    def power(self, x: Number, exponent: Fraction) -> Number:
        return x ** int(exponent) if exponent.denominator == 1 else self._inexact()

    def _inexact(self, *_: Number) -> Number:
        raise InexactError("it is no fraction, or not known to be one")

    log = sqrt = asin = _inexact
    pi = property(_inexact)


class Floats(Arithmetic):
    """IEEE doubles: fast, but their results prove nothing."""

    pi = math.pi
    number: Callable[[Any], Number] = float
    log, power, sqrt = staticmethod(math.log), staticmethod(math.pow), staticmethod(math.sqrt)
    sin, asin = staticmethod(math.sin), staticmethod(math.asin)


class DiscontinuityError(ArithmeticError):
    """A function may jump where its derivatives are asked for, so it has none there."""


class Operators:
    """The operators that follow from `+`, `*`, `/` and the change of sign."""

    __slots__ = ()

    def _alike(self, x: Any) -> Self:
        """A number of this kind: x itself, or made of x."""
        return x if isinstance(x, type(self)) else type(self)(x)  # type: ignore[call-arg]

    def __radd__(self, other: Any) -> Any:
        return self + other

    def __sub__(self, other: Any) -> Any:
        return self + -other

    def __rsub__(self: Any, other: Any) -> Any:
        return -self + other

    def __rmul__(self, other: Any) -> Any:
        return self * other

    def __rtruediv__(self: Any, other: Any) -> Any:
        return self._alike(other) / self


class Dual(Operators):
    """A number with its derivatives by the variables it depends on: `slopes` by their names."""

    __slots__ = ("slopes", "value")

    def __init__(self, value: Number, slopes: Mapping[str, Number] = {}) -> None:
        self.value, self.slopes = value, slopes

    def scaled(self, value: Number, outer: Number) -> "Dual":
        """A function of this number, given the function's value and derivative there."""
        return Dual(value, {name: outer * slope for name, slope in self.slopes.items()})

    def __neg__(self) -> "Dual":
        return Dual(-self.value, {name: -slope for name, slope in self.slopes.items()})

    def __add__(self, other: Any) -> "Dual":
        other = self._alike(other)
        return Dual(self.value + other.value, _added(self.slopes, other.slopes))

    def __mul__(self, other: Any) -> "Dual":
        if not isinstance(other, Dual):
            return self.scaled(self.value * other, other)
        mine = {name: slope * other.value for name, slope in self.slopes.items()}
        others = {name: self.value * slope for name, slope in other.slopes.items()}
        return Dual(self.value * other.value, _added(mine, others))

    def __truediv__(self, other: Any) -> "Dual":
        other = self._alike(other)
        quotient = self.value / other.value
        slopes = _added(self.slopes, (-other).scaled(quotient, quotient).slopes)
        return Dual(quotient, {name: slope / other.value for name, slope in slopes.items()})

    def __pow__(self, exponent: int) -> "Dual":
        return self.scaled(self.value**exponent, self.value ** (exponent - 1) * exponent)


def _added(first: Mapping[str, Number], second: Mapping[str, Number]) -> Mapping[str, Number]:
    total = dict(first)
    for name, slope in second.items():
        total[name] = total[name] + slope if name in total else slope
    return total


class Duals(Arithmetic):
    """Numbers of another arithmetic with their derivatives.

    >>> ar = Duals(Reals(20))
    >>> x = ar.variable(ar.arithmetic.number(3), "x")
    >>> print((x * x + ar.log(x)).slopes["x"])
    6.3333333333333333333
    """

    def __init__(self, arithmetic: Any) -> None:
        self.arithmetic = arithmetic

    pi = property(lambda self: Dual(self.arithmetic.pi))

    def variable(self, value: Number, name: str) -> Dual:
        """A variable, by which derivatives are taken."""
        return Dual(value, {name: self.arithmetic.number(1)})

    def number(self, value: Fraction | int) -> Number:
        return Dual(self.arithmetic.number(value))

    def log(self, x: Dual) -> Dual:
        return x.scaled(self.arithmetic.log(x.value), 1 / x.value)

    def power(self, x: Dual, exponent: Fraction) -> Dual:
        value = self.arithmetic.power(x.value, exponent)
        return x.scaled(value, value / x.value * self.arithmetic.number(exponent))

    def least(self, x: Dual, bound: Dual) -> Dual:
        """The smaller number; where it is unclear which that is, its slopes contain both's."""
        value = self.arithmetic.least(x.value, bound.value)
        below = self.arithmetic.below(x.value, bound.value)
        if below is not None:
            return Dual(value, (x if below else bound).slopes)
        zero = self.arithmetic.number(0)
        slopes = {
            name: self.arithmetic.hull([x.slopes.get(name, zero), bound.slopes.get(name, zero)])
            for name in {**x.slopes, **bound.slopes}
        }
        return Dual(value, slopes)

    def contact_share(self, y: Dual) -> Dual:
        return y.scaled(self.arithmetic.contact_share(y.value), 2 - 2 * y.value)

    def cap_root(self, c: Dual) -> Dual:
        y = self.arithmetic.cap_root(c.value)
        return c.scaled(y, 1 / self.arithmetic.contact_share(y))

    def below(self, x: Dual, bound: Dual) -> bool:
        below: bool | None = self.arithmetic.below(x.value, bound.value)
        if below is None:
            raise DiscontinuityError("the last row of the sheet is not the same for all inputs")
        return below


class RationalFunction(Operators):
    """A quotient of two polynomials with rational coefficients."""

    __slots__ = ("denominator", "numerator")

    def __init__(self, numerator: Any, denominator: Any = 1) -> None:
        self.numerator, self.denominator = numerator, denominator

    def __neg__(self) -> Self:
        return type(self)(-self.numerator, self.denominator)

    def __add__(self, other: Any) -> Self:
        other = self._alike(other)
        sum_ = self.numerator * other.denominator + other.numerator * self.denominator
        return type(self)(sum_, self.denominator * other.denominator)

    def __mul__(self, other: Any) -> Self:
        other = self._alike(other)
        numerator = self.numerator * other.numerator
        return type(self)(numerator, self.denominator * other.denominator)

    def __truediv__(self, other: Any) -> Self:
        other = self._alike(other)
        if other.numerator == 0:
            raise ZeroDivisionError("division by a polynomial that is zero")
        return self * type(self)(other.denominator, other.numerator)

    def __pow__(self, exponent: int) -> Self:
        base, size = (self if exponent >= 0 else 1 / self), abs(exponent)
        return type(self)(base.numerator**size, base.denominator**size)

    def __eq__(self, other: object) -> bool:
        other = self._alike(other)
        return bool(self.numerator * other.denominator == other.numerator * self.denominator)


class RationalFunctions:
    """Quotients of polynomials in some symbols; a root or a logarithm gets a symbol of its own.

    >>> ar = RationalFunctions(["x", "y"])
    >>> x, y = ar.symbols["x"], ar.symbols["y"]
    >>> (x * x - y * y) / (x - y) == x + y
    True
    """

    def __init__(self, names: Sequence[str]) -> None:
        from flint import Ordering, fmpq_mpoly_ctx

        all_names = (*names, "pi", *(f"irrational_{k}" for k in range(8)))
        context = fmpq_mpoly_ctx.get(all_names, Ordering.lex)
        self._one = context.constant(1)
        symbols = [RationalFunction(symbol, self._one) for symbol in context.gens()]
        self.symbols: Mapping[str, RationalFunction] = dict(zip(names, symbols, strict=False))
        self.pi, *self._free = symbols[len(names) :]
        self._known: list[tuple[Fraction | None, RationalFunction]] = []

    def number(self, value: Fraction | int) -> RationalFunction:
        return RationalFunction(self._one * value.numerator, self._one * value.denominator)

    def log(self, x: RationalFunction) -> RationalFunction:
        return self.number(0) if x == 1 else self._symbol(None, x)

    def power(self, x: RationalFunction, exponent: Fraction) -> RationalFunction:
        if exponent.denominator == 1:
            return x ** int(exponent)
        return x if x == 1 else self._symbol(exponent, x)

    def _symbol(self, *irrational: Any) -> RationalFunction:
        """A symbol for a power of x, or for its logarithm: the same for the same x."""
        if irrational not in self._known:
            self._known.append(irrational)
        return self._free[self._known.index(irrational)]

    @staticmethod
    def constant(x: RationalFunction) -> Fraction | None:
        """The number that x is whatever the symbols stand for, or None if it varies with them."""
        if x.numerator == 0:
            return Fraction(0)
        value = x.numerator.leading_coefficient() / x.denominator.leading_coefficient()
        return Fraction(int(value.p), int(value.q)) if x == value else None

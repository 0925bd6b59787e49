"""The arithmetics in which the report's formulas, each written once, are evaluated.

`Floats` are IEEE doubles, `Reals` mpmath numbers of any precision, `Rationals` exact fractions, and
`reference.intervals.Intervals` proven enclosures. `Duals` add first derivatives to any of these.
`RationalFunctions` are quotients of polynomials, in which two forms of an equation are compared
exactly, for all values of their symbols.
"""

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache, cached_property
from typing import Any, Self

Number = Any
"""A number of the arithmetic in use; every kind of number has the operators + - * /."""

Function = Callable[..., Number | Fraction]
"""A function of an arithmetic and of inputs by name; a Fraction if its value is known exactly."""


class Arithmetic:
    """The functions that the formulas need besides the operators, by default for single numbers.

    `power` needs x > 0 unless the exponent is an integer. `cap_volume` is y^2 - y^3/3 for y in [0,
    1], the volume of a cap of height y R over pi R^3, and `cap_root` is the y with that value, for
    one in [0, 2/3]. `exp_mean_root` is the x >= 0
    at which (e^x - 1) / x, the mean of e^t for t from 0 to x, is k >= 1. `below` is whether
    x < bound; None if that is not known of all numbers in an interval.
    """

    pi: Number
    number: Callable[[Any], Number]
    log: Callable[[Any], Number]
    log1p: Callable[[Any], Number]
    expm1: Callable[[Any], Number]
    exp_mean_root: Callable[[Any], Number]
    sqrt: Callable[[Any], Number]
    root: Callable[[Any, int], Number]
    sin: Callable[[Any], Number]
    asin: Callable[[Any], Number]
    least: Callable[[Any, Any], Number] = staticmethod(min)
    below: Callable[[Any, Any], bool | None] = staticmethod(operator.lt)

    def greatest(self, x: Number, bound: Number) -> Number:
        return -self.least(-x, -bound)

    def power(self, x: Number, exponent: Fraction) -> Number:
        root = x if exponent.denominator == 1 else self.root(x, exponent.denominator)
        size = root ** abs(exponent.numerator)
        return size if exponent > 0 else 1 / size

    def cap_root(self, c: Number) -> Number:
        # The cubic's trigonometric solution, in a form without cancellation for small c.
        third = self.asin(self.sqrt(3 * c) / 2) / 3
        return 2 * self.sin(third) ** 2 + self.sqrt(self.number(3)) * self.sin(2 * third)

    def cap_volume(self, y: Number) -> Number:
        return y * y * (3 - y) / 3

    def exp_mean_slope(self, x: Number) -> Number:
        """Return the derivative of (e^x - 1) / x at x > 0."""
        mean = self.expm1(x) / x
        return mean + (1 - mean) / x

    def contact_share(self, y: Number) -> Number:
        """Return the contact area over pi R^2 at y = x/R: y (2 - y), which increases on [0, 1]."""
        return y * (2 - y)

    def hull(self, numbers: list[Number]) -> Number:
        """Return a number that contains all of these. A single number contains only itself."""
        (only,) = numbers
        return only


class Reals(Arithmetic):
    """mpmath numbers with a given number of decimal digits; no global precision is changed.

    >>> print(Reals(30).pi)
    3.14159265358979323846264338328
    """

    def __init__(self, digits: int = 50) -> None:
        self.digits = digits

    @cached_property
    def context(self) -> Any:
        """The numbers' mpmath context, made when the first of them is computed."""
        return _context(self.digits)

    @cached_property
    def pi(self) -> Number:
        """The number pi, rounded to the digits."""
        return +self.context.pi

    def number(self, value: Fraction | int) -> Number:
        return self.context.mpf(value.numerator) / value.denominator

    def log(self, x: Number) -> Number:
        return self._real(self.context.log(x))

    def log1p(self, x: Number) -> Number:
        return self._real(self.context.log1p(x))

    def expm1(self, x: Number) -> Number:
        return self.context.expm1(x)

    def exp_mean_root(self, k: Number) -> Number:
        """Return x by Lambert's function: h (1 + k x) = -W(-h e^-h) with h = 1/k, lower branch."""
        if k < 1:
            raise NoRootError("(e^x - 1) / x is at least 1")
        # Close to k = 1, at the branch point, half of the digits are lost twice.
        wide = _context(3 * self.context.dps)
        h = 1 / wide.convert(k)
        return self.context.convert(-h - wide.lambertw(-h * wide.exp(-h), -1).real)

    def root(self, x: Number, degree: int) -> Number:
        return self._real(self.context.root(x, degree))

    def _real(self, x: Number) -> Number:
        if isinstance(x, self.context.mpc):
            raise ArithmeticError("a negative number has no real logarithm, and no real root")
        return x

    def cap_root(self, c: Number) -> Number:
        """Return y in [0, 2] for c in [0, 4/3], by a root search: a check on the sines above."""
        if 3 * c > 4:
            raise ArithmeticError("y^2 - y^3/3 is at most 4/3, at y = 2")
        # With y = s sqrt(c), s stays within [1, 1.23] for c <= 2/3, however small c is.
        root = self._real(self.context.sqrt(c))
        return root * self.context.findroot(lambda s: s * s - root * s**3 / 3 - 1, (1, 1.2))


@cache
def _context(digits: int) -> Any:
    """Return an mpmath context, cached: making one takes milliseconds, and the import many more."""
    import mpmath

    context = mpmath.MPContext()
    context.dps = digits
    return context


class NoRootError(ArithmeticError):
    """No number in the argument has the root."""


class InexactError(ArithmeticError):
    """The value is not rational, or not known to be."""


class Rationals(Arithmetic):
    """Exact fractions. Raises InexactError where a formula needs any other number."""

    number = Fraction

    def _inexact(self, *_: Number) -> Number:
        raise InexactError("the value is not rational, or not known to be")

    log = log1p = expm1 = exp_mean_root = sqrt = root = asin = _inexact
    pi = property(_inexact)


class Floats(Arithmetic):
    """IEEE doubles: fast, but their results prove nothing."""

    pi = math.pi
    number: Callable[[Any], Number] = float
    log, sqrt = staticmethod(math.log), staticmethod(math.sqrt)
    log1p, expm1 = staticmethod(math.log1p), staticmethod(math.expm1)
    sin, asin = staticmethod(math.sin), staticmethod(math.asin)

    def power(self, x: Number, exponent: Fraction) -> Number:
        return x ** int(exponent) if exponent.denominator == 1 else math.pow(x, exponent)


class DiscontinuityError(ArithmeticError):
    """The function may jump inside the box, so that it has no derivative there."""


class Operators:
    """The operators that follow from addition, multiplication, division and negation."""

    __slots__ = ()

    def _alike(self, x: Any) -> Self:
        """Return x itself if it is of this class, else x as a number of this class."""
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
    """A number with its partial derivatives: `slopes`, by the names of the variables.

    A variable that is missing there has the derivative 0.
    """

    __slots__ = ("slopes", "value")

    def __init__(self, value: Number, slopes: Mapping[str, Number] = {}) -> None:
        self.value, self.slopes = value, slopes

    def scaled(self, value: Number, outer: Number) -> "Dual":
        """Return f(self) by the chain rule, given the value and the derivative of f at self."""
        return Dual(value, {name: outer * slope for name, slope in self.slopes.items()})

    def __neg__(self) -> "Dual":
        return Dual(-self.value, {name: -slope for name, slope in self.slopes.items()})

    def __add__(self, other: Any) -> "Dual":
        other = self._alike(other)
        return Dual(self.value + other.value, _added(self.slopes, other.slopes))

    def __mul__(self, other: Any) -> "Dual":
        if not isinstance(other, Dual):
            return self.scaled(self.value * other, other)
        left = {name: slope * other.value for name, slope in self.slopes.items()}
        right = {name: self.value * slope for name, slope in other.slopes.items()}
        return Dual(self.value * other.value, _added(left, right))

    def __truediv__(self, other: Any) -> "Dual":
        # (x/y)' = (x' - (x/y) y') / y
        other = self._alike(other)
        quotient = self.value / other.value
        slopes = _added(self.slopes, other.scaled(quotient, -quotient).slopes)
        return Dual(quotient, {name: slope / other.value for name, slope in slopes.items()})

    def __pow__(self, exponent: int) -> "Dual":
        slope = self.value ** (exponent - 1) * exponent if exponent else 0
        return self.scaled(self.value**exponent, slope)


def _added(first: Mapping[str, Number], second: Mapping[str, Number]) -> Mapping[str, Number]:
    shared = {name: first[name] + second[name] for name in first.keys() & second.keys()}
    return {**first, **second, **shared}


class Duals(Arithmetic):
    """The numbers of another arithmetic, with derivatives by the variables that are declared.

    >>> ar = Duals(Reals(20))
    >>> x = ar.variable(ar.arithmetic.number(3), "x")
    >>> print((x * x + ar.log(x)).slopes["x"])
    6.3333333333333333333
    """

    def __init__(self, arithmetic: Any) -> None:
        self.arithmetic = arithmetic

    pi = property(lambda self: Dual(self.arithmetic.pi))

    def variable(self, value: Number, name: str) -> Dual:
        """Return a variable, by which derivatives are taken."""
        return Dual(value, {name: self.arithmetic.number(1)})

    def number(self, value: Fraction | int) -> Number:
        return Dual(self.arithmetic.number(value))

    def log(self, x: Dual) -> Dual:
        return x.scaled(self.arithmetic.log(x.value), 1 / x.value)

    def log1p(self, x: Dual) -> Dual:
        return x.scaled(self.arithmetic.log1p(x.value), 1 / (1 + x.value))

    def expm1(self, x: Dual) -> Dual:
        value = self.arithmetic.expm1(x.value)
        return x.scaled(value, 1 + value)

    def exp_mean_root(self, k: Dual) -> Dual:
        x = self.arithmetic.exp_mean_root(k.value)
        return k.scaled(x, 1 / self.arithmetic.exp_mean_slope(x))

    def root(self, x: Dual, degree: int) -> Dual:
        value = self.arithmetic.power(x.value, Fraction(1, degree))
        return x.scaled(value, value / x.value / degree)

    def least(self, x: Dual, bound: Dual) -> Dual:
        """Return the smaller number; if either may be it, slopes that contain those of both."""
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

    def cap_volume(self, y: Dual) -> Dual:
        return y.scaled(self.arithmetic.cap_volume(y.value), self.arithmetic.contact_share(y.value))

    def cap_root(self, c: Dual) -> Dual:
        y = self.arithmetic.cap_root(c.value)
        return c.scaled(y, 1 / self.arithmetic.contact_share(y))  # as dc/dy = 2 y - y^2

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

    def __neg__(self) -> "RationalFunction":
        return RationalFunction(-self.numerator, self.denominator)

    def __add__(self, other: Any) -> "RationalFunction":
        other = self._alike(other)
        numerator = self.numerator * other.denominator + other.numerator * self.denominator
        return RationalFunction(numerator, self.denominator * other.denominator)

    def __mul__(self, other: Any) -> "RationalFunction":
        other = self._alike(other)
        numerator = self.numerator * other.numerator
        return RationalFunction(numerator, self.denominator * other.denominator)

    def __truediv__(self, other: Any) -> "RationalFunction":
        return self * self._alike(other) ** -1

    def __pow__(self, exponent: int) -> "RationalFunction":
        if exponent >= 0:
            return RationalFunction(self.numerator**exponent, self.denominator**exponent)
        if self.numerator == 0:
            raise ZeroDivisionError("division by a polynomial that is zero")
        return RationalFunction(self.denominator, self.numerator) ** -exponent

    def __eq__(self, other: object) -> bool:
        return bool((self - self._alike(other)).numerator == 0)


class RationalFunctions(Arithmetic):
    """Rational functions of given symbols, of pi, and of roots and logarithms.

    Every root and every logarithm that occurs becomes one more symbol, the same for the same
    argument. An equality that is found is therefore proven, but relations between irrational
    numbers, such as sqrt(x)^2 = x, are not known.

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
        self._irrationals: list[tuple[int | None, RationalFunction]] = []

    def number(self, value: Fraction | int) -> RationalFunction:
        return RationalFunction(self._one * value.numerator, self._one * value.denominator)

    def log(self, x: RationalFunction) -> RationalFunction:
        return self.number(0) if x == 1 else self._symbol(None, x)

    def root(self, x: RationalFunction, degree: int) -> RationalFunction:
        return x if x == 1 else self._symbol(degree, x)

    def _symbol(self, degree: int | None, x: RationalFunction) -> RationalFunction:
        """Return the symbol for the root of x of this degree or, without one, for ln x."""
        if (degree, x) not in self._irrationals:
            self._irrationals.append((degree, x))
        return self._free[self._irrationals.index((degree, x))]

    @staticmethod
    def constant(x: RationalFunction) -> Fraction | None:
        """Return the number that x equals for all values of its symbols, or None if x varies."""
        if x.numerator == 0:
            return Fraction(0)
        value = x.numerator.leading_coefficient() / x.denominator.leading_coefficient()
        return Fraction(int(value.p), int(value.q)) if x == value else None

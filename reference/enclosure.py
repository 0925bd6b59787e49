"""The report's equations over boxes of inputs, in interval arithmetic: bounds that are proven.

An interval computed here contains every value that the formula takes for inputs in the box; it may
be wider than that set. Where it is too wide to decide a question, the box is cut in halves until it
decides, or the question stays undecided: never a guess.
"""

import heapq
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from mpmath.ctx_iv import MPIntervalContext

from reference.exact import Number, Reals
from reference.printed import Interval

__all__ = ["Box", "Exploration", "Function", "Intervals", "admitted", "evaluate", "explore"]

Box = Mapping[str, tuple[Fraction, Fraction]]
"""Inputs by name: lower and upper end, rationals in SI units."""

Function = Callable[..., Number | Fraction]
"""Of an arithmetic and the inputs by name; a Fraction where the value is known exactly."""


class Intervals:
    """mpmath intervals of a given number of decimal digits, rounded outwards.

    >>> ar = Intervals(20)
    >>> low, high = ar.ends(ar.number(Fraction(1, 3)))
    >>> low < Fraction(1, 3) < high
    True
    >>> ar.ends(ar.number(Fraction(-7, 2)))
    (Fraction(-7, 2), Fraction(-7, 2))
    """

    def __init__(self, digits: int = 50) -> None:
        self.context = MPIntervalContext()
        self.context.dps = digits
        self._reals = Reals(digits)

    def number(self, value: Fraction | int) -> Number:
        return self.context.mpf(value.numerator) / self.context.mpf(value.denominator)

    def interval(self, lower: Fraction, upper: Fraction) -> Number:
        """An interval that contains both rationals and all between."""
        return self.hull([self.number(lower), self.number(upper)])

    def ends(self, x: Number) -> tuple[Fraction, Fraction]:
        """Both ends, as the rationals that they are."""
        low, high = self._ends(x)
        return Fraction(*low.as_integer_ratio()), Fraction(*high.as_integer_ratio())

    def _ends(self, x: Number) -> tuple[Any, Any]:
        return self._reals.context.mpf(x.a), self._reals.context.mpf(x.b)

    def least(self, x: Number, bound: Number) -> Number:
        pairs = zip(self._ends(x), self._ends(bound), strict=True)
        return self.context.mpf([min(pair) for pair in pairs])

    def positive_part(self, x: Number) -> Number:
        zero = self._reals.context.zero
        return self.context.mpf([max(end, zero) for end in self._ends(x)])

    def cap_root(self, c: Number) -> Number:
        """The roots for both ends, moved outwards and then verified by the residual's sign."""
        margin = self._reals.context.eps * 2**20
        low, high = (self._reals.cap_root(end) for end in self._ends(c))
        low, high = self.context.mpf(low * (1 - margin)), self.context.mpf(high * (1 + margin))
        below, above = low**2 - low**3 / 3 - c.a, high**2 - high**3 / 3 - c.b
        if self._ends(below)[1] > 0 or self._ends(above)[0] < 0:
            raise ArithmeticError("a root of y^2 - y^3/3 = c could not be verified")
        return self.hull([low, high])

    def may_be_below(self, x: Number, bound: Number) -> bool:
        return bool(self._ends(x)[0] < self._ends(bound)[1])

    def is_below(self, x: Number, bound: Number) -> bool:
        return bool(self._ends(x)[1] < self._ends(bound)[0])

    def hull(self, numbers: list[Number]) -> Number:
        lows, highs = zip(*map(self._ends, numbers), strict=True)
        return self.context.mpf([min(lows), max(highs)])


_INTERVALS = Intervals(30)
"""Thirty digits: twice a double's, so that the outward rounding never decides a verdict."""


def evaluate(function: Function, box: Box) -> tuple[Fraction, Fraction]:
    """A proven range of the function over the box, in SI units."""
    numbers = {name: _INTERVALS.interval(*ends) for name, ends in box.items()}
    value = function(_INTERVALS, **numbers)
    return (value, value) if isinstance(value, Fraction) else _INTERVALS.ends(value)


@dataclass(frozen=True, slots=True)
class Exploration:
    """What is proven of a function's values over a box, against a target interval.

    `lower`, `upper`: a range that holds all values. `inside`, `outside`: a point of the box whose
    value is proven inside or outside the target, if one was found. `decided`: no part of the box
    was left open.
    """

    lower: Fraction
    upper: Fraction
    inside: dict[str, Fraction] | None
    outside: dict[str, Fraction] | None
    decided: bool

    @property
    def always(self) -> bool:
        """Every value in the box is inside the target."""
        return self.decided and self.outside is None

    @property
    def never(self) -> bool:
        """No value in the box is inside the target."""
        return self.decided and self.inside is None


def explore(function: Function, box: Box, target: Interval, budget: int = 2000) -> Exploration:
    """Decide by branch and bound whether values over the box fall inside the target interval.

    The part whose middle comes nearest to the target is cut first, along its relatively widest
    side. It ends when points inside and outside are both known, when every part is decided, or
    after `budget` evaluations.
    """
    search = _Search(function, target)
    search.add(dict(box))
    while search.open and search.evaluations < budget and not search.split():
        for part in _halves(search.nearest()):
            search.add(part)
    return search.result()


class _Search:
    """The open parts of a box, and what the closed ones have proven."""

    def __init__(self, function: Function, target: Interval) -> None:
        self.function, self.target = function, target
        self.evaluations = 0
        self.stuck = False
        self.inside: dict[str, Fraction] | None = None
        self.outside: dict[str, Fraction] | None = None
        self.open: list[tuple[Fraction, int, dict[str, tuple[Fraction, Fraction]]]] = []
        self._open_ranges: dict[int, tuple[Fraction, Fraction]] = {}
        self._closed_ranges: list[tuple[Fraction, Fraction]] = []

    def split(self) -> bool:
        return self.inside is not None and self.outside is not None

    def add(self, part: dict[str, tuple[Fraction, Fraction]]) -> None:
        self.evaluations += 1
        ends = evaluate(self.function, part)
        middle = {name: (low + high) / 2 for name, (low, high) in part.items()}
        if self._note(ends, middle):
            self._closed_ranges.append(ends)
            return
        if all(low == high for low, high in part.values()):
            # Its enclosure straddles an end of the target: no cut can decide it.
            self.stuck = True
            self._closed_ranges.append(ends)
            return
        self.evaluations += 1
        at_middle = evaluate(self.function, {name: (x, x) for name, x in middle.items()})
        self._note(at_middle, middle)
        self._open_ranges[self.evaluations] = ends
        heapq.heappush(self.open, (self._distance(at_middle), self.evaluations, part))

    def _note(self, ends: tuple[Fraction, Fraction], point: dict[str, Fraction]) -> bool:
        """Record a proof for the point; whether there was one."""
        if self.target.encloses(*ends):
            self.inside = self.inside or point
            return True
        if self.target.excludes(*ends):
            self.outside = self.outside or point
            return True
        return False

    def _distance(self, ends: tuple[Fraction, Fraction]) -> Fraction:
        above = Fraction(0) if self.target.upper is None else ends[0] - self.target.upper
        below = Fraction(0) if self.target.lower is None else self.target.lower - ends[1]
        return max(above, below)

    def nearest(self) -> dict[str, tuple[Fraction, Fraction]]:
        _, number, part = heapq.heappop(self.open)
        del self._open_ranges[number]
        return part

    def result(self) -> Exploration:
        ranges = self._closed_ranges + list(self._open_ranges.values())
        return Exploration(
            min(low for low, _ in ranges),
            max(high for _, high in ranges),
            self.inside,
            self.outside,
            not self.open and not self.stuck,
        )


def _halves(
    part: dict[str, tuple[Fraction, Fraction]],
) -> list[dict[str, tuple[Fraction, Fraction]]]:
    name = max(part, key=lambda key: _relative_width(*part[key]))
    low, high = part[name]
    middle = (low + high) / 2
    return [{**part, name: (low, middle)}, {**part, name: (middle, high)}]


def _relative_width(low: Fraction, high: Fraction) -> Fraction:
    return (high - low) / max(abs(low), abs(high), Fraction(1, 10**30))


def admitted(
    constraints: Sequence[tuple[Function, Interval]],
    name: str,
    search: tuple[Fraction, Fraction],
    inputs: Box,
    resolution: Fraction,
) -> tuple[Interval, Interval]:
    """The values of one input for which every constraint holds: an inner and an outer interval.

    Every value of the inner interval is proven to satisfy all constraints, every value of `search`
    outside the outer one to violate some. Raises ValueError if no value is admitted, or if the
    admitted values are not one interval.
    """
    parts, inner, edge = [search], [], []
    while parts:
        part = parts.pop()
        verdict = _holds(constraints, {**inputs, name: part})
        if verdict:
            inner.append(part)
        elif verdict is None and part[1] - part[0] > resolution:
            middle = (part[0] + part[1]) / 2
            parts += [(part[0], middle), (middle, part[1])]
        elif verdict is None:
            edge.append(part)
    merged = _merged(inner)
    if len(merged) != 1:
        raise ValueError(f"{len(merged)} separate intervals of {name} are admitted, not one")
    outer = _merged(inner + edge)
    return Interval(*merged[0]), Interval(outer[0][0], outer[-1][1])


def _holds(constraints: Sequence[tuple[Function, Interval]], box: Box) -> bool | None:
    """True if all hold all over the box, False if one fails all over it, else None."""
    answer: bool | None = True
    for function, target in constraints:
        ends = evaluate(function, box)
        if target.excludes(*ends):
            return False
        if not target.encloses(*ends):
            answer = None
    return answer


def _merged(parts: list[tuple[Fraction, Fraction]]) -> list[tuple[Fraction, Fraction]]:
    merged: list[tuple[Fraction, Fraction]] = []
    for low, high in sorted(parts):
        if merged and merged[-1][1] == low:
            merged[-1] = (merged[-1][0], high)
        else:
            merged.append((low, high))
    return merged

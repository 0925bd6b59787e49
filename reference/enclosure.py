"""The report's equations over boxes of inputs, in interval arithmetic: bounds that are proven.

An interval computed here contains every value that the formula takes for inputs in the box; it may
be wider than that set. Where it is too wide to decide a question, the box is cut in halves until it
decides, or the question stays undecided: never a guess.
"""

import heapq
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

from reference.exact import Number
from reference.intervals import Intervals
from reference.printed import Interval

__all__ = [
    "Box",
    "Constraint",
    "Exploration",
    "Function",
    "admitted",
    "evaluate",
    "explore",
    "extent",
    "satisfiable",
]

Box = Mapping[str, tuple[Fraction, Fraction]]
"""Inputs by name: lower and upper end, rationals in SI units."""

Part = dict[str, tuple[Fraction, Fraction]]
"""A box that is cut from another."""

Function = Callable[..., Number | Fraction]
"""Of an arithmetic and the inputs by name; a Fraction where the value is known exactly."""


_INTERVALS = Intervals(30)
"""Thirty digits: twice a double's, so that the outward rounding never decides a verdict."""


def evaluate(function: Function, box: Box) -> tuple[Fraction, Fraction]:
    """A proven range of the function over the box, in SI units."""
    with _INTERVALS.working():
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
    search, scales = _Search(function, target), _scales(box)
    search.add(dict(box))
    while search.open and search.evaluations < budget and not search.split():
        for part in _halves(search.nearest(), scales):
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
        self.open: list[tuple[Fraction, int, Part]] = []
        self._open_ranges: dict[int, tuple[Fraction, Fraction]] = {}
        self._closed_ranges: list[tuple[Fraction, Fraction]] = []

    def split(self) -> bool:
        return self.inside is not None and self.outside is not None

    def add(self, part: Part) -> None:
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

    def nearest(self) -> Part:
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


def _scales(box: Box) -> dict[str, Fraction]:
    """What an input's width is measured by, so that unlike quantities can be compared."""
    sizes = {name: max(abs(low), abs(high)) for name, (low, high) in box.items()}
    return {name: size or Fraction(1) for name, size in sizes.items()}


def _halves(part: Part, scales: Mapping[str, Fraction]) -> list[Part]:
    name = max(part, key=lambda key: (part[key][1] - part[key][0]) / scales[key])
    low, high = part[name]
    middle = (low + high) / 2
    return [{**part, name: (low, middle)}, {**part, name: (middle, high)}]


Constraint = tuple[Function, Interval]
"""A function of the inputs in a box, and the interval that its value must fall in."""


def admitted(
    constraints: Sequence[Constraint],
    name: str,
    search: tuple[Fraction, Fraction],
    resolution: Fraction,
) -> tuple[Interval, Interval]:
    """The values of the one input for which every constraint holds: an inner and outer interval.

    Every value of the inner interval is proven to satisfy all constraints, every value of `search`
    outside the outer one to violate some. Raises ValueError if none is proven to satisfy them, if
    those that do are not one interval, or if they reach an end of `search`.
    """
    parts, inner, edge = [(search, constraints)], [], []
    while parts:
        part, remaining = parts.pop()
        undecided = _undecided(remaining, {name: part})
        if undecided is None:
            continue
        if not undecided:
            inner.append(part)
        elif part[1] - part[0] > resolution:
            middle = (part[0] + part[1]) / 2
            parts += [((part[0], middle), undecided), ((middle, part[1]), undecided)]
        else:
            edge.append(part)
    merged, outer = _merged(inner), _merged(inner + edge)
    if len(merged) != 1:
        raise ValueError(f"{len(merged)} separate intervals of {name} are admitted, not one")
    if outer[0][0] == search[0] or outer[-1][1] == search[1]:
        raise ValueError(f"the admitted {name} reaches an end of the search from {search[0]}")
    return Interval(*merged[0]), Interval(outer[0][0], outer[-1][1])


def extent(
    constraints: Sequence[Constraint],
    name: str,
    box: Box,
    start: Fraction,
    tolerance: Fraction,
    budget: int = 600,
) -> tuple[Interval, Interval]:
    """How far one input can range while the others may be anywhere in the box.

    An inner interval whose ends are attained (by some point of the box that satisfies every
    constraint; `start` must be one such value), and an outer one beyond which no value of the box
    is; apart by the tolerance, or by more if the budget of boxes runs out.
    """
    (low, least), (high, greatest) = (
        _extreme(constraints, name, box, sign, start, tolerance, budget) for sign in (-1, 1)
    )
    return Interval(low, high), Interval(least, greatest)


def satisfiable(constraints: Sequence[Constraint], box: Box, budget: int = 2000) -> bool | None:
    """Whether some point of the box satisfies every constraint: proven by one, or for all of it.

    None if the budget of boxes runs out.
    """
    queue, scales = deque([(dict(box), list(constraints))]), _scales(box)
    for _ in range(budget):
        if not queue:
            return False
        part, remaining = queue.popleft()
        undecided = _undecided(remaining, part)
        if undecided is None:
            continue
        middle = {name: ((low + high) / 2,) * 2 for name, (low, high) in part.items()}
        if not undecided or _undecided(undecided, middle) == []:
            return True
        queue += [(half, undecided) for half in _halves(part, scales)]
    return None


def _extreme(
    constraints: Sequence[Constraint],
    name: str,
    box: Box,
    sign: int,
    start: Fraction,
    tolerance: Fraction,
    budget: int,
) -> tuple[Fraction, Fraction]:
    """The best value attained, and a bound that no value passes, in the direction of the sign."""

    def end(part: Box) -> Fraction:
        return part[name][sign > 0]

    attained, scales = start, _scales(box)
    queue = [(-sign * end(box), 0, dict(box), list(constraints))]
    for count in range(1, budget + 1):
        if not queue or sign * (end(queue[0][2]) - attained) <= tolerance:
            break
        _, _, part, remaining = heapq.heappop(queue)
        undecided = _undecided(remaining, part)
        if undecided is None:
            continue
        for number, half in enumerate(_halves(part, scales)):
            heapq.heappush(queue, (-sign * end(half), 2 * count + number, half, undecided))
        near = part[name][sign < 0]
        sides = [ends if key != name else (near,) for key, ends in part.items()]
        corners = ({k: (x, x) for k, x in zip(part, c, strict=True)} for c in product(*sides))
        if sign * (near - attained) > 0 and any(_undecided(undecided, c) == [] for c in corners):
            attained = near
    return attained, end(queue[0][2]) if queue else attained


def _undecided(constraints: Sequence[Constraint], box: Box) -> list[Constraint] | None:
    """The constraints not proven to hold all over the box; None if one fails all over it."""
    undecided = []
    for function, target in constraints:
        ends = evaluate(function, box)
        if target.excludes(*ends):
            return None
        if not target.encloses(*ends):
            undecided.append((function, target))
    return undecided


def _merged(parts: list[tuple[Fraction, Fraction]]) -> list[tuple[Fraction, Fraction]]:
    merged: list[tuple[Fraction, Fraction]] = []
    for low, high in sorted(parts):
        if merged and merged[-1][1] == low:
            merged[-1] = (merged[-1][0], high)
        else:
            merged.append((low, high))
    return merged

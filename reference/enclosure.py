"""Proven bounds of functions over boxes of inputs, by interval arithmetic.

An enclosure contains every value that a function takes for inputs in the box. The derivatives are
enclosed as well: an input in which the function is proven to be monotone over the whole box is set
to its ends, which makes the bound sharp. If an enclosure is too wide to decide a question, the box
is halved again and again. If the budget runs out first, the question stays undecided.
"""

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from enum import Enum
from fractions import Fraction
from itertools import count
from math import inf, isinf

import msgspec

from reference.arithmetic import DiscontinuityError, Dual, Duals, Floats, Function
from reference.intervals import Intervals
from reference.printed import Interval

Ends = tuple[Fraction, Fraction]
"""The lower and the upper end of a closed interval."""

Box = Mapping[str, Ends]
"""The range of each input, by its name, in SI units."""

_INTERVALS = Intervals(30)
"""30 digits, about twice as many as a double has: outward rounding never decides a verdict."""
_DUALS = Duals(_INTERVALS)
_TANGENTS = Duals(Floats())


class Satisfiability(Enum):
    """Whether some point of a box satisfies every constraint."""

    SHOWN = "a point that does is known"
    REFUTED = "it is proven that none does"
    UNDECIDED = "the budget of boxes ran out"


class Range(msgspec.Struct, frozen=True):
    """An interval that is proven to contain every value of a function over a box.

    `signs` has, for every input that varies in the box, 1 if the function is proven nowhere to
    decrease as that input increases, -1 if nowhere to increase, and 0 if neither is proven. The
    function is proven not to depend on the inputs in `idle`.
    """

    ends: Ends
    signs: Mapping[str, int]
    idle: frozenset[str] = frozenset()

    @property
    def is_monotone(self) -> bool:
        """Whether it is proven monotone in every input: both ends are then sharp."""
        return all(self.signs.values())


def enclose(function: Function, box: Box) -> Range:
    """Return a proven range of the function over the box, in SI units.

    Raises ArithmeticError unless the function is known to have bounded values all over the box.

    >>> box = {"x": (Fraction(1), Fraction(2))}
    >>> [float(end) for end in enclose(lambda ar, x: x / (1 + x), box).ends]
    [0.5, 0.6666666666666666]
    """
    wide = [name for name, (low, high) in box.items() if low != high]
    tangent = _tangent(function, box, wide) if wide else None
    if tangent is None:
        return Range(_plain_range(function, box), dict.fromkeys(wide, 0))
    slopes = {name: tangent.slopes.get(name, _INTERVALS.number(0)) for name in wide}
    signs = {name: _INTERVALS.sign(slope) for name, slope in slopes.items()}
    idle = frozenset(name for name, slope in slopes.items() if _INTERVALS.is_zero(slope))
    if not any(signs.values()):
        # Intersect plain interval arithmetic with the mean-value form about the middle.
        low, high = _INTERVALS.ends(tangent.value)
        below, above = _plain_range(function, _points(_middle(box)))
        for name, slope in slopes.items():
            reach = max(map(abs, _INTERVALS.ends(slope))) * (box[name][1] - box[name][0]) / 2
            below, above = below - reach, above + reach
        return Range((max(low, below), min(high, above)), signs)
    lower, upper = (
        {**box, **_points({name: box[name][sign == side] for name, sign in signs.items() if sign})}
        for side in (-1, 1)
    )
    # With some inputs at an end, the sign of another derivative may become known: hence recursion.
    return Range((enclose(function, lower).ends[0], enclose(function, upper).ends[1]), signs, idle)


def _points(point: Mapping[str, Fraction]) -> Box:
    return {name: (value, value) for name, value in point.items()}


def _plain_range(function: Function, box: Box) -> Ends:
    """Return a proven range of the function over the box, without use of its derivatives."""
    with _INTERVALS.working():
        numbers = {name: _INTERVALS.interval(*ends) for name, ends in box.items()}
        value = function(_INTERVALS, **numbers)
    return (value, value) if isinstance(value, Fraction) else _INTERVALS.ends(value)


def _tangent(function: Function, box: Box, wide: list[str]) -> Dual | None:
    """Return enclosures, over the box, of the function and its derivatives by the `wide` inputs.

    None if the function may jump in the box, or if it may divide by zero there.
    """
    with _INTERVALS.working():
        numbers = {}
        for name, ends in box.items():
            span = _INTERVALS.interval(*ends)
            numbers[name] = _DUALS.variable(span, name) if name in wide else Dual(span)
        try:
            value = function(_DUALS, **numbers)
        except (DiscontinuityError, ZeroDivisionError):
            return None
    return Dual(value) if isinstance(value, Fraction) else value


def _middle(box: Box) -> dict[str, Fraction]:
    return {name: (low + high) / 2 for name, (low, high) in box.items()}


class SolutionSet(msgspec.Struct, frozen=True):
    """The values of one input, in the range `search`, for which a function lies in its target.

    Every value in the intervals `inner` is proven to be a solution, and every value of the search
    outside the intervals `outer` is proven to be none. An empty `outer` proves that there is none.
    """

    search: Ends
    inner: tuple[Ends, ...]
    outer: tuple[Ends, ...]

    @property
    def reaches_an_end(self) -> bool:
        """Whether there may be solutions up to an end of the search, and so beyond it."""
        low, high = self.search
        return any(part[0] == low or part[1] == high for part in self.outer)

    def admits(self, value: Fraction) -> bool:
        """Return whether a value is proven to be a solution."""
        return any(low <= value <= high for low, high in self.inner)


def find_solutions(
    function: Function,
    name: str,
    search: Ends,
    target: Interval,
    budget: int = 200,
    others: Mapping[str, Fraction] = {},
) -> SolutionSet:
    """Return the values of one input, the others given, for which the function lies in the target.

    A part of the search on which the function is proven monotone is solved by secants; any other
    undecided part is halved. At most `budget` parts are examined. What is then undecided belongs to
    the outer intervals, as do parts on which the function may have no value somewhere.

    >>> search, target = (Fraction(0), Fraction(9)), Interval(Fraction(2), Fraction(3))
    >>> others = {"y": Fraction(2)}
    >>> solutions = find_solutions(lambda ar, x, y: x * y, "x", search, target, others=others)
    >>> [f"{float(end):.3f}" for end in solutions.inner[0]]
    ['1.000', '1.500']
    """
    parts = [search]
    inner, outer, given = list[Ends](), list[Ends](), _points(others)

    def value(x: Fraction) -> Ends:
        return _plain_range(function, {**given, name: (x, x)})

    for tried, part in enumerate(parts, 1):  # the list grows while there is budget left
        try:
            range_ = enclose(function, {**given, name: part})
        except ArithmeticError:
            range_ = None
        if range_ is None or not (range_.is_monotone or target.decides(*range_.ends)):
            middle = (part[0] + part[1]) / 2
            (parts if tried < budget else outer).extend([(part[0], middle), (middle, part[1])])
        elif target.encloses(*range_.ends):
            inner.append(part)
            outer.append(part)
        elif not target.excludes(*range_.ends):
            rises = range_.signs[name] > 0
            at_ends = value(part[0]), value(part[1])
            first, last = (_crossing(value, part, at_ends, target, rises, end) for end in (0, 1))
            outer.append((first[0], last[1]))
            between = first[1], last[0]
            if between[0] <= between[1] and all(target.encloses(*value(x)) for x in between):
                inner.append(between)
    return SolutionSet(search, _union(inner), _union(outer))


def _crossing(
    value: Callable[[Fraction], Ends],
    part: Ends,
    at_ends: tuple[Ends, Ends],
    target: Interval,
    rises: bool,
    end: int,
) -> Ends:
    """Bracket the input at which a monotone function enters the target (end 0) or leaves it (1).

    `at_ends` are its values at the ends of the part. The Illinois method narrows the bracket: each
    new end is the zero of the secant between the ends, and where the same end moves twice, half the
    value is taken at the other. Every fourth time the bracket is halved, as secants can be slow;
    and from then on when a secant's zero cannot be told from the goal, as where the slope is zero.
    Each end is proven to lie on its side, however it was chosen.
    """
    at_lower = rises == (end == 0)
    goal = target.lower if at_lower else target.upper
    least, greatest = at_ends[end]
    # The function may lie in the target up to this end of the part.
    if goal is None or (least > goal if at_lower else greatest < goal):
        return part[end], part[end]
    # Twice the function less the goal, at both ends.
    at_low, at_high = (least + greatest - 2 * goal for least, greatest in at_ends)
    (low, high), width = part, (part[1] - part[0]) / 2**60  # so that all digits of a double hold
    moved, halved = "", False
    for attempt in count(1):
        if high - low <= width:
            break
        if halved or attempt % 4 == 0:
            # Not the exact middle, where a simple function might hit the goal.
            x = low + (high - low) * Fraction(49, 100)
        else:
            share = at_low / (at_low - at_high) if at_low != at_high else Fraction(1, 2)
            # Past the secant's zero by a little, so that the end which is farther away moves, too.
            x = low + share * (high - low) + (width / 3 if share < Fraction(1, 2) else -width / 3)
        x = x.limit_denominator(10**30)
        below, above = value(x)
        if not low < x < high:
            break
        if below <= goal <= above:
            if halved:
                break
            halved = True
            continue
        if (above < goal) == rises:
            low, at_low = x, below + above - 2 * goal
            at_high /= 2 if moved == "low" else 1
            moved = "low"
        else:
            high, at_high = x, below + above - 2 * goal
            at_low /= 2 if moved == "high" else 1
            moved = "high"
    return low, high


def _union(parts: list[Ends]) -> tuple[Ends, ...]:
    """Return the union of intervals as disjoint ones, sorted."""
    merged: list[Ends] = []
    for low, high in sorted(parts):
        if merged and merged[-1][1] >= low:
            merged[-1] = (merged[-1][0], max(high, merged[-1][1]))
        else:
            merged.append((low, high))
    return tuple(merged)


Constraint = tuple[Function, Interval]
"""A function of the inputs in a box, and the interval in which its value must lie."""


def bounds(constraints: Sequence[Constraint], name: str, box: Box) -> Ends:
    """Return bounds of one input outside which no point of the box satisfies all constraints.

    Each constraint that is proven monotone in every input bounds this input by itself: the others
    are set to those ends of the box that allow it the most extreme value. The result is the
    tightest of these bounds; the true range may be narrower.

    >>> product = (lambda ar, x, y: x * y, Interval(Fraction(2), Fraction(3)))
    >>> box = {"x": (Fraction(0), Fraction(9)), "y": (Fraction(1), Fraction(2))}
    >>> [f"{float(end):.3f}" for end in bounds([product], "x", box)]
    ['1.000', '3.000']
    """
    return _bounds(_monotone(constraints, box), name, box)


def _monotone(constraints: Sequence[Constraint], box: Box) -> list[tuple[Constraint, Range]]:
    """Return the constraints that are proven monotone in every input, each with its range."""
    monotone = []
    for function, target in constraints:
        with suppress(ArithmeticError):  # it may be undefined in part of the box: it bounds nothing
            range_ = enclose(function, box)
            if range_.is_monotone:
                monotone.append(((function, target), range_))
    return monotone


def _bounds(monotone: Sequence[tuple[Constraint, Range]], name: str, box: Box) -> Ends:
    """Return bounds of one input by constraints that are monotone in all of a box around `box`."""
    outer = list(box[name])
    for (function, target), range_ in monotone:
        for top in (0, 1):
            # For this input's greatest value, inputs with the same sign are low and others high.
            alike = {key: range_.signs.get(key, 1) == range_.signs.get(name, 1) for key in box}
            others = {key: ends[alike[key] != top] for key, ends in box.items() if key != name}
            if target.encloses(*_plain_range(function, _points({**others, name: outer[top]}))):
                continue  # the constraint holds even at the present bound
            if beyond := find_solutions(function, name, box[name], target, others=others).outer:
                bound = (beyond[0][0], beyond[-1][1])[top]
                outer[top] = min(bound, outer[1]) if top else max(bound, outer[0])
    return outer[0], outer[1]


def satisfying(
    constraints: Sequence[Constraint], box: Box, budget: int = 1000
) -> tuple[Satisfiability, dict[str, Fraction] | None]:
    """Return whether some point of the box satisfies every constraint, and such a point.

    In each box one point is tried, which the linearized constraints suggest. If that of the whole
    box does not satisfy them, `bounds` narrows every input: at corners only, as far as derivatives
    have a proven sign. Boxes that this leaves open are halved until each is excluded by a
    constraint. Constraints are tested in their order: it saves time to put cheap and narrow ones
    first.
    """
    queue = deque([(box, list(constraints))])
    sizes = {name: max(map(abs, ends)) or 1 for name, ends in box.items()}
    for tried in range(budget):
        if not queue:
            break
        part, remaining = queue.popleft()
        undecided = _undecided(remaining, part)
        if undecided is None:
            continue
        point = _candidate(undecided, part)
        if _undecided(undecided, _points(point)) == []:
            return Satisfiability.SHOWN, point
        if tried == 0:
            narrowed = _narrowed(undecided, part)
            queue += [(narrowed, undecided)] if narrowed else []
            continue
        # Halve the input whose range is widest relative to its largest magnitude in the whole box.
        name = max(part, key=lambda name: (part[name][1] - part[name][0]) / sizes[name])
        (low, high), middle = part[name], _middle(part)[name]
        queue += [({**part, name: half}, undecided) for half in ((low, middle), (middle, high))]
    return (Satisfiability.UNDECIDED if queue else Satisfiability.REFUTED), None


def _narrowed(constraints: Sequence[Constraint], box: Box) -> Box | None:
    """Return the part of a box that the bounds of its inputs leave; None if that is nothing."""
    monotone = _monotone(constraints, box)
    for name in [name for name, (low, high) in box.items() if low != high]:
        low, high = _bounds(monotone, name, box)
        if low > high:
            return None
        if low < high:  # a single value may be an open end, which does not belong to the box
            box = {**box, name: (low, high)}
    return box


def _candidate(constraints: Sequence[Constraint], box: Box) -> dict[str, Fraction]:
    """Return a point of the box at which the constraints, linearized in its middle, may hold.

    Doubles suffice, as this proves nothing. From the middle, the point is projected onto one
    linearized constraint after the other, in coordinates scaled by the widths of the box.
    """
    middle, shift = _middle(box), dict.fromkeys(box, 0.0)
    widths = {name: high - low for name, (low, high) in box.items()}
    numbers = {name: _TANGENTS.variable(float(value), name) for name, value in middle.items()}
    linearized = []
    for function, target in constraints:
        try:
            dual = function(_TANGENTS, **numbers)
        except (ArithmeticError, TypeError, ValueError):
            return middle  # the function has no value there, or a complex one
        if isinstance(dual, Fraction):
            continue  # the function is constant
        low = -inf if target.lower is None else float(target.lower)
        high = inf if target.upper is None else float(target.upper)
        margin = 0.0 if isinf(high - low) else (high - low) / 100
        slopes = {name: slope * float(widths[name]) for name, slope in dual.slopes.items()}
        if steepness := sum(slope * slope for slope in slopes.values()):
            linearized.append((dual.value, slopes, steepness, low + margin, high - margin))
    for _ in range(30):  # further rounds would hardly move the point
        for value, slopes, steepness, low, high in linearized:
            reached = value + sum(slope * shift[name] for name, slope in slopes.items())
            missing = max(low - reached, 0.0) + min(high - reached, 0.0)
            for name, slope in slopes.items() if missing else ():
                shift[name] = min(0.49, max(-0.49, shift[name] + missing * slope / steepness))
    return {name: value + widths[name] * Fraction(shift[name]) for name, value in middle.items()}


def _undecided(constraints: Sequence[Constraint], box: Box) -> list[Constraint] | None:
    """Return the constraints not proven to hold all over the box; None if one fails all over it."""
    undecided = []
    for function, target in constraints:
        try:
            ends = _plain_range(function, box)  # much faster than with derivatives
            if not target.decides(*ends):
                ends = enclose(function, box).ends
        except ArithmeticError:  # maybe undefined or unbounded in part of the box
            undecided.append((function, target))
            continue
        if target.excludes(*ends):
            return None
        if not target.encloses(*ends):
            undecided.append((function, target))
    return undecided

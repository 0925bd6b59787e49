"""Formulas over boxes of inputs, in interval arithmetic: bounds that are proven.

What is computed here contains every value that a formula takes for inputs in the box. The
derivatives are enclosed along with it: an input by which the formula is proven to rise or fall all
over the box is put at its ends, so that the bound is sharp. Where it is too wide to decide a
question, the box is cut in halves until it decides, or the question stays undecided: never a guess.
"""

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from math import inf, isinf

import msgspec

from reference.arithmetic import DiscontinuityError, Dual, Duals, Floats, Function
from reference.intervals import Intervals
from reference.printed import Interval

Ends = tuple[Fraction, Fraction]
"""The lower and the upper end of an interval."""

Box = Mapping[str, Ends]
"""Inputs by name, in SI units."""

_INTERVALS = Intervals(30)
"""Thirty digits: twice a double's, so that the outward rounding never decides a verdict."""
_DUALS = Duals(_INTERVALS)
_TANGENTS = Duals(Floats())


class Range(msgspec.Struct, frozen=True):
    """A proven range of a function over a box.

    `signs` tells of every input that has a width whether the function is proven to rise (1) or fall
    (-1) with it all over the box, or not (0); on the `idle` ones it is proven not to depend.
    """

    ends: Ends
    signs: Mapping[str, int]
    idle: frozenset[str] = frozenset()

    @property
    def is_monotone(self) -> bool:
        """Whether every input is proven to act in one direction; the ends are then attained."""
        return all(self.signs.values())


def enclose(function: Function, box: Box) -> Range:
    """A proven range of the function over the box, in SI units.

    >>> box = {"x": (Fraction(1), Fraction(2))}
    >>> [float(end) for end in enclose(lambda ar, x: x / (1 + x), box).ends]
    [0.5, 0.6666666666666666]
    """
    wide = [name for name, (low, high) in box.items() if low != high]
    tangent = _tangent(function, box, wide) if wide else None
    if tangent is None:
        return Range(_plain(function, box), dict.fromkeys(wide, 0))
    slopes = {name: tangent.slopes.get(name, _INTERVALS.number(0)) for name in wide}
    signs = {name: _INTERVALS.sign(slope) for name, slope in slopes.items()}
    idle = frozenset(name for name, slope in slopes.items() if _INTERVALS.is_zero(slope))
    fixed = {name: sign > 0 for name, sign in signs.items() if sign}
    if not fixed:
        # Plain interval arithmetic, cut to what the value in the middle and the slopes allow.
        low, high = _INTERVALS.ends(tangent.value)
        below, above = _plain(function, _points(_middle(box)))
        for name, slope in slopes.items():
            reach = max(map(abs, _INTERVALS.ends(slope))) * (box[name][1] - box[name][0]) / 2
            below, above = below - reach, above + reach
        return Range((max(low, below), min(high, above)), signs)
    lower, upper = (
        {**box, **_points({name: box[name][rises == top] for name, rises in fixed.items()})}
        for top in (False, True)
    )
    # An input that is put at an end may free another's sign; with all at ends the bound is sharp.
    return Range((enclose(function, lower).ends[0], enclose(function, upper).ends[1]), signs, idle)


def _points(point: Mapping[str, Fraction]) -> Box:
    return {name: (value, value) for name, value in point.items()}


def _plain(function: Function, box: Box) -> Ends:
    with _INTERVALS.working():
        numbers = {name: _INTERVALS.interval(*ends) for name, ends in box.items()}
        value = function(_INTERVALS, **numbers)
    return (value, value) if isinstance(value, Fraction) else _INTERVALS.ends(value)


def _tangent(function: Function, box: Box, wide: list[str]) -> Dual | None:
    """Numbers that contain the value, and every derivative, all over the box.

    None where the function may jump: then it has no derivatives.
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


class Solutions(msgspec.Struct, frozen=True):
    """The values of one input, within a search, for which a function meets its target.

    `inner`: intervals all of whose values are proven to; `outer`: those outside which every value
    of the search is proven not to. Empty `outer`: proven that none does.
    """

    search: Ends
    inner: tuple[Ends, ...]
    outer: tuple[Ends, ...]

    @property
    def reaches_an_end(self) -> bool:
        """Whether the solutions may go on beyond the search."""
        low, high = self.search
        return any(part[0] == low or part[1] == high for part in self.outer)

    def admits(self, value: Fraction) -> bool:
        """Whether the value is proven to be a solution."""
        return any(low <= value <= high for low, high in self.inner)


def solve(
    function: Function,
    name: str,
    search: Ends,
    target: Interval,
    budget: int = 200,
    others: Mapping[str, Fraction] = {},
) -> Solutions:
    """The values of one input, the others given, for which the function falls into the target.

    Parts of the search on which the function only rises or only falls are solved by bisection, the
    others are cut in halves, until the budget of parts runs out; what is still undecided then
    belongs to the outer intervals. So does what is left of parts on some of which the function has
    no value.

    >>> search, target = (Fraction(0), Fraction(9)), Interval(Fraction(2), Fraction(3))
    >>> found = solve(lambda ar, x, y: x * y, "x", search, target, others={"y": Fraction(2)})
    >>> [f"{float(end):.3f}" for end in found.inner[0]]
    ['1.000', '1.500']
    """
    parts = [search]
    inner, outer, given = list[Ends](), list[Ends](), _points(others)

    def value(x: Fraction) -> Ends:
        return _plain(function, {**given, name: (x, x)})

    for tried, part in enumerate(parts, 1):  # halves are added while there is a budget
        try:
            range_ = enclose(function, {**given, name: part})
        except ArithmeticError:  # no value, or no bounded one, on some of it
            range_ = None
        if range_ is None or not (range_.is_monotone or target.decides(*range_.ends)):
            middle = (part[0] + part[1]) / 2
            (parts if tried < budget else outer).extend([(part[0], middle), (middle, part[1])])
        elif target.encloses(*range_.ends):
            inner.append(part)
            outer.append(part)
        elif not target.excludes(*range_.ends):
            rises = range_.signs[name] > 0
            first, last = (_crossing(value, part, target, rises, end) for end in (0, 1))
            outer.append((first[0], last[1]))
            within = first[1], last[0]
            if within[0] <= within[1] and all(target.encloses(*value(x)) for x in within):
                inner.append(within)
    return Solutions(search, _merged(inner), _merged(outer))


def _crossing(
    value: Callable[[Fraction], Ends], part: Ends, target: Interval, rises: bool, end: int
) -> Ends:
    """Between which inputs a rising or falling function enters the target (end 0) or leaves it."""
    at_lower = rises == (end == 0)
    goal = target.lower if at_lower else target.upper
    least, greatest = value(part[end])
    # At the end of the part the target may be entered or left already.
    if goal is None or (least > goal if at_lower else greatest < goal):
        return part[end], part[end]
    (low, high), width = part, (part[1] - part[0]) / 2**44  # finer than any page shows
    while high - low > width:
        # Not in the middle: a goal that is hit exactly cannot be decided.
        x = (low + (high - low) * Fraction(49, 100)).limit_denominator(10**30)
        below, above = value(x)
        if below <= goal <= above or not low < x < high:
            break
        if (above < goal) == rises:
            low = x
        else:
            high = x
    return low, high


def _merged(parts: list[Ends]) -> tuple[Ends, ...]:
    merged: list[Ends] = []
    for low, high in sorted(parts):
        if merged and merged[-1][1] >= low:
            merged[-1] = (merged[-1][0], max(high, merged[-1][1]))
        else:
            merged.append((low, high))
    return tuple(merged)


Constraint = tuple[Function, Interval]
"""A function of the inputs in a box, and the interval that its value must fall in."""


def bounds(constraints: Sequence[Constraint], name: str, box: Box) -> Ends:
    """How far one input can range at most while the others may be anywhere in the box.

    Every constraint alone bounds the input, with all others at the ends that suit it best; these
    are the tightest of such bounds. No value beyond them satisfies all constraints.

    >>> product = (lambda ar, x, y: x * y, Interval(Fraction(2), Fraction(3)))
    >>> box = {"x": (Fraction(0), Fraction(9)), "y": (Fraction(1), Fraction(2))}
    >>> [f"{float(end):.3f}" for end in bounds([product], "x", box)]
    ['1.000', '3.000']
    """
    outer = list(box[name])
    for function, target in constraints:
        try:
            range_ = enclose(function, box)
        except ArithmeticError:  # no value, or no bounded one, on some of it: it bounds nothing
            continue
        for top in (0, 1) if range_.is_monotone else ():
            # To let this input go far up, those that act like it must be low, the others high.
            alike = {key: range_.signs.get(key, 1) == range_.signs.get(name, 1) for key in box}
            others = {key: ends[alike[key] != top] for key, ends in box.items() if key != name}
            if target.encloses(*_plain(function, _points({**others, name: outer[top]}))):
                continue  # it bounds the input farther out
            if beyond := solve(function, name, box[name], target, others=others).outer:
                bound = (beyond[0][0], beyond[-1][1])[top]
                outer[top] = min(bound, outer[1]) if top else max(bound, outer[0])
    return outer[0], outer[1]


def satisfying(
    constraints: Sequence[Constraint], box: Box, budget: int = 1000
) -> tuple[bool | None, dict[str, Fraction] | None]:
    """Whether some point of the box satisfies every constraint, with such a point if one is known.

    None if the budget of boxes runs out. Constraints are tried in their order: cheap and narrow
    ones first save time. In each box one point is tried, where the constraints' tangents aim.
    """
    queue = deque([(box, list(constraints))])
    sizes = {name: max(map(abs, ends)) or 1 for name, ends in box.items()}
    for _ in range(budget):
        part, remaining = queue.popleft()
        undecided = _undecided(remaining, part)
        if undecided is None:
            if not queue:
                return False, None
            continue
        point = _aimed(undecided, part)
        if _undecided(undecided, _points(point)) == []:
            return True, point
        # Cut in two across the side that is widest relative to the size of its input.
        name = max(part, key=lambda name: (part[name][1] - part[name][0]) / sizes[name])
        (low, high), middle = part[name], _middle(part)[name]
        queue += [({**part, name: half}, undecided) for half in ((low, middle), (middle, high))]
    return None, None


def _aimed(constraints: Sequence[Constraint], box: Box) -> dict[str, Fraction]:
    """A point of the box where the constraints probably hold, by their tangents in its middle.

    In doubles, as this proves nothing. From the middle the point is moved into one constraint after
    the other by the shortest way, in coordinates that are measured in widths of the box.
    """
    middle, moved = _middle(box), dict.fromkeys(box, 0.0)
    widths = {name: high - low for name, (low, high) in box.items()}
    numbers = {name: _TANGENTS.variable(float(value), name) for name, value in middle.items()}
    planes = []
    for function, target in constraints:
        try:
            dual = function(_TANGENTS, **numbers)
        except (ArithmeticError, TypeError, ValueError):
            return middle  # no value there, or only a complex one
        if isinstance(dual, Fraction):
            continue  # the same everywhere
        low = -inf if target.lower is None else float(target.lower)
        high = inf if target.upper is None else float(target.upper)
        margin = 0.0 if isinf(high - low) else (high - low) / 100
        slopes = {name: slope * float(widths[name]) for name, slope in dual.slopes.items()}
        if steepness := sum(slope * slope for slope in slopes.values()):
            planes.append((dual.value, slopes, steepness, low + margin, high - margin))
    for _ in range(30):  # more often moves the point too little to matter
        for value, slopes, steepness, low, high in planes:
            reached = value + sum(slope * moved[name] for name, slope in slopes.items())
            short = max(low - reached, 0.0) + min(high - reached, 0.0)
            for name, slope in slopes.items() if short else ():
                moved[name] = min(0.49, max(-0.49, moved[name] + short * slope / steepness))
    return {name: value + widths[name] * Fraction(moved[name]) for name, value in middle.items()}


def _undecided(constraints: Sequence[Constraint], box: Box) -> list[Constraint] | None:
    """The constraints not proven to hold all over the box; None if one fails all over it."""
    undecided = []
    for function, target in constraints:
        try:
            ends = _plain(function, box)  # what it decides needs no derivatives
            if not target.decides(*ends):
                ends = enclose(function, box).ends
        except ArithmeticError:  # no value, or no bounded one, on some of it
            undecided.append((function, target))
            continue
        if target.excludes(*ends):
            return None
        if not target.encloses(*ends):
            undecided.append((function, target))
    return undecided

"""Inputs that the report never prints, inferred from the numbers that it does print."""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache, cached_property

from reference.arithmetic import Arithmetic, Number
from reference.enclosure import Box, Constraint, Ends, Solutions, extent, holding, satisfying, solve
from reference.ledger import INFERRED, Convention, Function, Ledger
from reference.printed import Interval


class Inference:
    """The values of an input for which its evidence comes out as printed (SI units), by proof.

    `name` is its id with "inferred:" before it; `by_mass` takes the printed particle mass, not the
    sphere's. `each` gives the values for every piece of evidence alone, with the other inputs
    exactly as printed. `agreeing` is the largest set of evidence that one value can serve; `odd`
    the rest. Each value of `inner` is proven to serve the agreeing evidence, none outside `outer`
    does. Where no value serves any, all evidence is odd, and the value that the ledger takes stays.
    """

    def __init__(
        self, ledger: Ledger, name: str, *, centered: bool = False, by_mass: bool = False
    ) -> None:
        self.ledger, self.name, self.centered = ledger, name, centered
        self.entry = ledger.inferred[name.removeprefix(INFERRED)]
        self._narrowed, self._admitted = cache(self._narrow), cache(self._extent)
        self.each: dict[str, Solutions] = {}
        for claim in map(ledger.claims.__getitem__, self.entry.evidence):
            own = claim.resting_on(mass=self.entry.mass) if by_mass else claim
            printed = {key: ledger.value(key) for key in own.entries if key != name}
            function = holding(ledger.function(own, centered=centered), printed)
            self.each[claim.id] = solve(function, name, self.entry.search, claim.target())
        self.agreeing = _agreeing(self.each)
        self.odd = tuple(claim for claim in self.each if claim not in self.agreeing)
        serving = [self.each[claim] for claim in self.agreeing]
        outer = _intersection([self.entry.search], *(own.outer for own in serving))
        self.outer = Interval(outer[0][0], outer[-1][1])
        self.inner = Interval.point(ledger.value(name))
        if serving:
            self.inner = Interval(*_intersection(*(own.inner for own in serving))[0])
        self._joining = [ledger.claims[own] for own in (*self.entry.header, *self.agreeing)]

    @cached_property
    def inputs(self) -> set[str]:
        """What the evidence, and the header of Table A-1, rest on besides."""
        return {name for claim in self._joining for name in claim.entries} - {self.name}

    @cached_property
    def with_mass(self) -> Interval:
        """As `inner`, where the particle mass is the printed one."""
        return Inference(self.ledger, self.name, centered=self.centered, by_mass=True).inner

    def admitted(self, convention: Convention) -> tuple[Interval, Interval]:
        """The values that serve the evidence where inputs are rounded as a convention says.

        The printed mass and diameter are evidence, too. The first interval is the hull of values
        that were found, the second holds all that there are. How the evidence itself is rounded is
        no question: cut off, no value would serve it.
        """
        if (convention.choices_exact and convention.header_exact) or not self.agreeing:
            return self.inner, self.outer
        return self._admitted(convention.choices_exact, convention.header_exact)

    def _extent(self, choices_exact: bool, header_exact: bool) -> tuple[Interval, Interval]:
        convention = Convention(choices_exact=choices_exact, header_exact=header_exact)
        joint, box = self._joint(convention, by_mass=not header_exact)
        start = sum(self.inner.ends, Fraction(0)) / 2
        attained, bounds = extent(joint, self.name, box, start)
        return Interval(*attained), Interval(*bounds)

    def rounded(self, name: str, convention: Convention) -> Ends:
        """The values of an input that print like it, and for which what shows it alone does so.

        The times of the table are multiples of the step, and tell it better than "0.2 ns" does.
        """
        return self._narrowed(name, *self.ledger.claims[name].as_input(convention).ends)

    def _narrow(self, name: str, low: Fraction, high: Fraction) -> Ends:
        for shown in map(self.ledger.claims.__getitem__, self.ledger.claims[name].shown_by):
            if low != high and shown.entries == [name]:
                function = self.ledger.function(shown)
                allowed = solve(function, name, (low, high), shown.target()).outer
                low, high = (allowed[0][0], allowed[-1][1]) if allowed else (low, high)
        return low, high

    def _joint(
        self, convention: Convention, *, by_mass: bool, also: Sequence[Constraint] = ()
    ) -> tuple[list[Constraint], dict[str, Ends]]:
        """All evidence at once, and the box of those of its inputs that may be other than printed.

        The printed mass and density tell the radius more closely than its own print does: with
        `by_mass` the mass is free in its place.
        """
        radius, mass, density = self.entry.radius, self.entry.mass, self.entry.density

        def box(names: set[str]) -> dict[str, Ends]:
            ends = {name: self.rounded(name, convention) for name in sorted(names)}
            free = {name: (low, high) for name, (low, high) in ends.items() if low != high}
            return {**free, self.name: self.entry.search}

        def of_mass(function: Function) -> Function:
            def by_radius(ar: Arithmetic, **entries: Number) -> Number | Fraction:
                volume = entries[mass] / entries[density]
                own = ar.power(3 * volume / (4 * ar.pi), Fraction(1, 3))
                return function(ar, **{**entries, radius: own})

            return by_radius

        free, constraints = box(self.inputs), list[Constraint]()
        for claim in self._joining:
            function = self.ledger.function(claim, centered=self.centered)
            printed = {name: self.ledger.value(name) for name in claim.entries if name not in free}
            constraints.append((holding(function, printed), claim.target()))
        constraints += also
        if not by_mass:
            return constraints, free
        own = self.ledger.claims[radius].as_input(convention)
        constraints.append((lambda _, **entries: entries[radius], own))
        by_radius = [(of_mass(function), target) for function, target in constraints]
        return by_radius, box(self.inputs - {radius} | {mass})

    def holds_at(self, point: Mapping[str, Fraction], convention: Convention) -> bool:
        """Whether the evidence can hold at a point; other inputs are within their rounding."""
        by_mass = not convention.header_exact and self.entry.radius not in point
        joint, box = self._joint(convention, by_mass=by_mass)
        fixed = {name: (x, x) for name, x in point.items() if name in box}
        return satisfying(joint, {**box, **fixed})[0] is True

    def excludes(
        self, function: Function, target: Interval, convention: Convention, box: Box, budget: int
    ) -> bool:
        """Whether no inputs of the box give a number in the target and the evidence, too."""
        by_mass = not convention.header_exact
        joint, own = self._joint(convention, by_mass=by_mass, also=[(function, target)])
        whole = {**box, **own}
        if by_mass:
            whole.pop(self.entry.radius, None)
        return satisfying(joint, whole, budget)[0] is False

    def admits(self, value: Fraction, range_: Interval) -> str:
        """What the evidence says of a value that is printed, with its range, somewhere else."""
        if self.inner.contains(value):
            return "admitted"
        if not self.inner.excludes(*range_.ends):
            return "admitted only as a number that was rounded"
        rounded = {
            "admitted only if the header of Table A-1 is rounded": Convention(),
            "admitted only if what the author chose is rounded, too": Convention(
                choices_exact=False
            ),
        }
        for words, convention in rounded.items():
            joint, box = self._joint(convention, by_mass=True)
            admitted = satisfying(joint, {**box, self.name: range_.ends})[0]
            if admitted is not False:
                return words if admitted else "undecided"
        return "excluded as long as the mass is the sphere's"


def _agreeing(each: Mapping[str, Solutions]) -> tuple[str, ...]:
    """The largest set of evidence that one value serves; of several, that of the least value.

    Empty if no value of the search serves any of it.
    """
    best: tuple[str, ...] = ()
    for value in sorted({low for solutions in each.values() for low, _ in solutions.inner}):
        agreeing = tuple(name for name, solutions in each.items() if solutions.admits(value))
        best = max(best, agreeing, key=len)
    return best


def _intersection(first: Sequence[Ends], *others: Sequence[Ends]) -> list[Ends]:
    """What unions of intervals have in common, in order."""
    common = list(first)
    for union in others:
        pairs = ((max(a, c), min(b, d)) for a, b in common for c, d in union)
        common = [(low, high) for low, high in pairs if low <= high]
    return common

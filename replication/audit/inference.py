"""Inputs that the report never prints, inferred from the numbers that it does print."""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property

import msgspec

from reference.arithmetic import Arithmetic, Number
from reference.enclosure import Box, Constraint, Ends, Solutions, extent, holding, satisfying, solve
from reference.ledger import INFERRED, Convention, Function, Inferred, Ledger
from reference.printed import Interval


class Inference(msgspec.Struct, frozen=True, eq=False, dict=True):
    """The values of an input for which its evidence comes out as printed (SI units).

    `each` gives them for every piece of evidence alone, with the other inputs exactly as printed.
    `agreeing` is the largest set of evidence that one value can serve; `odd` the rest. Each value
    of `inner` is proven to serve the agreeing evidence, none outside `outer` does. Where no value
    serves any, all evidence is odd, and the value that the ledger takes is kept.
    """

    ledger: Ledger
    name: str
    centered: bool
    each: Mapping[str, Solutions]
    agreeing: tuple[str, ...]
    inner: Interval
    outer: Interval
    _admitted: dict[tuple[bool, bool], tuple[Interval, Interval]] = {}
    _rounded: dict[tuple[str, Ends], Ends] = {}

    @property
    def entry(self) -> Inferred:
        """The ledger's entry."""
        return self.ledger.inferred[self.name.removeprefix(INFERRED)]

    @property
    def odd(self) -> tuple[str, ...]:
        """The evidence that no value serves together with the agreeing one."""
        return tuple(name for name in self.each if name not in self.agreeing)

    @cached_property
    def inputs(self) -> set[str]:
        """What the evidence, and the header of Table A-1, rest on besides."""
        claims = (self.ledger.claims[name] for name in (*self.entry.header, *self.agreeing))
        return {name for claim in claims for name in claim.entries} - {self.name}

    @cached_property
    def with_mass(self) -> Interval:
        """As `inner`, where the particle mass is the printed one."""
        return infer(self.ledger, self.name, centered=self.centered, by_mass=True).inner

    def admitted(self, convention: Convention) -> tuple[Interval, Interval]:
        """The values that serve the evidence where inputs are rounded as a convention says.

        The printed mass and diameter are evidence, too. The first interval is the hull of values
        that were found, the second holds all that there are. How the evidence itself is rounded is
        no question: cut off, no value would serve it.
        """
        key = convention.choices_exact, convention.header_exact
        if key == (True, True) or not self.agreeing:
            return self.inner, self.outer
        if key not in self._admitted:
            start = sum(self.inner.ends, Fraction(0)) / 2
            by_mass = not convention.header_exact
            box = self._box(convention, by_mass=by_mass)
            joint = self._joint(convention, by_mass=by_mass)
            attained, bounds = extent(joint, self.name, box, start)
            self._admitted[key] = Interval(*attained), Interval(*bounds)
        return self._admitted[key]

    def _box(self, convention: Convention, *, by_mass: bool) -> dict[str, Ends]:
        """The inputs that the evidence rests on and that may be other than printed.

        The printed mass and density tell the radius more closely than its own print does: with
        `by_mass` the mass is free in its place.
        """
        names = self.inputs
        radius, mass = self.entry.radius, self.entry.mass
        if by_mass and radius in names:
            names = names - {radius} | {mass}
        ends = {name: self.rounded(name, convention) for name in sorted(names)}
        rounded = {name: both for name, both in ends.items() if both[0] != both[1]}
        return {**rounded, self.name: self.entry.search}

    def rounded(self, name: str, convention: Convention) -> Ends:
        """The values of an input that print like it, and for which what shows it alone does so.

        The times of the table are multiples of the step, and tell it better than "0.2 ns" does.
        """
        claim = self.ledger.claims[name]
        ends = claim.as_input(convention).ends
        if (name, ends) not in self._rounded:
            low, high = ends
            for shown in (self.ledger.claims[shown] for shown in claim.shown_by):
                if low != high and shown.entries == [name]:
                    function = self.ledger.function(shown)
                    allowed = solve(function, name, (low, high), shown.target()).outer
                    low, high = (allowed[0][0], allowed[-1][1]) if allowed else (low, high)
            self._rounded[name, ends] = low, high
        return self._rounded[name, ends]

    def _joint(
        self, convention: Convention, *, by_mass: bool, also: Sequence[Constraint] = ()
    ) -> list[Constraint]:
        free = self._box(convention, by_mass=False)
        claims = [self.ledger.claims[name] for name in (*self.entry.header, *self.agreeing)]
        constraints: list[Constraint] = []
        for claim in claims:
            function = self.ledger.function(claim, centered=self.centered)
            printed = {name: self.ledger.value(name) for name in claim.entries if name not in free}
            constraints.append((holding(function, printed), claim.target()))
        constraints += also
        if not by_mass:
            return constraints
        radius, mass, density = self.entry.radius, self.entry.mass, self.entry.density

        def of_mass(function: Function) -> Function:
            def by_radius(ar: Arithmetic, **entries: Number) -> Number | Fraction:
                volume = entries[mass] / entries[density]
                own = ar.power(3 * volume / (4 * ar.pi), Fraction(1, 3))
                return function(ar, **{**entries, radius: own})

            return by_radius

        own = self.ledger.claims[radius].as_input(convention)
        constraints.append((lambda _, **entries: entries[radius], own))
        return [(of_mass(function), target) for function, target in constraints]

    def holds_at(self, point: Mapping[str, Fraction], convention: Convention) -> bool:
        """Whether the evidence can hold at a point; other inputs are within their rounding."""
        by_mass = not convention.header_exact and self.entry.radius not in point
        box = self._box(convention, by_mass=by_mass)
        fixed = {name: (x, x) for name, x in point.items() if name in box}
        joint = self._joint(convention, by_mass=by_mass)
        return satisfying(joint, {**box, **fixed})[0] is True

    def excludes(
        self, function: Function, target: Interval, convention: Convention, box: Box, budget: int
    ) -> bool:
        """Whether no inputs of the box give a number in the target and the evidence, too."""
        by_mass = not convention.header_exact
        joint = self._joint(convention, by_mass=by_mass, also=[(function, target)])
        whole = {**box, **self._box(convention, by_mass=by_mass)}
        if by_mass:
            whole.pop(self.entry.radius, None)
        return satisfying(joint, whole, budget)[0] is False

    def admits(self, value: Fraction, range_: Interval) -> str:
        """What the evidence says of a value that is printed, with its range, somewhere else."""
        usual = Convention()
        if self.inner.contains(value):
            return "admitted"
        if not self.inner.excludes(*range_.ends):
            return "admitted only as a number that was rounded"
        if self.admitted(usual)[1].excludes(*range_.ends):
            return "excluded"
        words = {
            True: "admitted only if the other inputs are rounded",
            False: "excluded",
            None: "undecided",
        }
        box = {**self._box(usual, by_mass=True), self.name: range_.ends}
        return words[satisfying(self._joint(usual, by_mass=True), box)[0]]


def infer(ledger: Ledger, name: str, *, centered: bool = False, by_mass: bool = False) -> Inference:
    """Infer one input from its evidence, by proof (see `reference.enclosure`).

    `name` is its id with "inferred:" before it; `by_mass` takes the printed particle mass, not the
    sphere's. Evidence that no value serves together with the rest is left out; the Inference names
    it. If none of it admits any value, the nominal one stays.
    """
    entry = ledger.inferred[name.removeprefix(INFERRED)]
    search, each = entry.search, {}
    for claim in (ledger.claims[evidence] for evidence in entry.evidence):
        own = claim.resting_on(mass=entry.mass) if by_mass else claim
        printed = {key: ledger.value(key) for key in own.entries if key != name}
        function = holding(ledger.function(own, centered=centered), printed)
        each[claim.id] = solve(function, name, search, claim.target())
    agreeing = _agreeing(each)
    if not agreeing:
        nominal = Interval.point(ledger.value(name))
        return Inference(ledger, name, centered, each, (), nominal, Interval(*search))
    inner = _intersection([each[claim].inner for claim in agreeing])[0]
    outer = _intersection([each[claim].outer for claim in agreeing])
    whole = Interval(outer[0][0], outer[-1][1])
    return Inference(ledger, name, centered, each, agreeing, Interval(*inner), whole)


def _agreeing(each: Mapping[str, Solutions]) -> tuple[str, ...]:
    """The largest set of evidence that one value serves; of several, that of the least value.

    Empty if no value of the search serves any of it.
    """
    best: tuple[str, ...] = ()
    for value in sorted({low for solutions in each.values() for low, _ in solutions.inner}):
        agreeing = tuple(name for name, solutions in each.items() if solutions.admits(value))
        best = max(best, agreeing, key=len)
    return best


def _intersection(unions: list[tuple[Ends, ...]]) -> list[Ends]:
    """What unions of intervals have in common, in order."""
    common = list(unions[0])
    for union in unions[1:]:
        pairs = ((max(a, c), min(b, d)) for a, b in common for c, d in union)
        common = [(low, high) for low, high in pairs if low <= high]
    return common

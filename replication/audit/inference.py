"""Inputs that the report never prints, inferred from the numbers that it does print."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from reference.arithmetic import Arithmetic, Number
from reference.enclosure import Constraint, Solutions, enclose, extent, satisfying, solve
from reference.ledger import INFERRED, Convention, Function, Inferred, Ledger
from reference.printed import Interval

__all__ = ["Inference", "infer"]


@dataclass(frozen=True, eq=False)
class Inference:
    """The values of an input for which its evidence comes out as printed (SI units).

    `each` gives them for every piece of evidence alone, with the other inputs exactly as printed.
    `agreeing` is the largest set of evidence that one value can serve; `odd` the rest. Each value
    of `inner` is proven to serve the agreeing evidence, none outside `outer` does. With the other
    inputs anywhere within their rounding, and the printed mass and diameter as evidence, too:
    `attained` is the hull of values that were found, `possible` holds all that there are.
    """

    ledger: Ledger
    name: str
    centered: bool
    each: Mapping[str, Solutions]
    agreeing: tuple[str, ...]
    inner: Interval
    outer: Interval

    @property
    def entry(self) -> Inferred:
        """The ledger's entry."""
        return self.ledger.inferred[self.name.removeprefix(INFERRED)]

    @property
    def odd(self) -> tuple[str, ...]:
        """The evidence that no value serves together with the agreeing one."""
        return tuple(name for name in self.each if name not in self.agreeing)

    @cached_property
    def with_mass(self) -> Interval:
        """As `inner`, where the particle mass is the printed one."""
        mass = {"mass": self.ledger.value(self.entry.mass)}
        return _infer(self.ledger, self.name, self.centered, self.entry.evidence, mass).inner

    @property
    def attained(self) -> Interval:
        """The hull of the values that were found with rounded inputs."""
        return Interval(*self._extent[0])

    @property
    def possible(self) -> Interval:
        """An interval that holds every value that rounded inputs admit."""
        return Interval(*self._extent[1])

    @cached_property
    def _extent(self) -> tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]:
        start = sum(self.inner.ends, Fraction(0)) / 2
        return extent(self._joint(by_mass=True), self.name, self._box(by_mass=True), start)

    def _box(self, *, by_mass: bool) -> dict[str, tuple[Fraction, Fraction]]:
        """The inputs that the evidence rests on and that may be other than printed.

        The printed mass and density tell the radius more closely than its own print does: with
        `by_mass` the mass is free in its place.
        """
        claims = [self.ledger.claims[name] for name in self.entry.evidence]
        names = {name for claim in claims for name in claim.entries} - {self.name}
        radius, mass = self.entry.radius, self.entry.mass
        if by_mass and radius in names:
            names = names - {radius} | {mass}
        ends = {name: self.ledger.claims[name].as_input(Convention()).ends for name in names}
        rounded = {name: both for name, both in sorted(ends.items()) if both[0] != both[1]}
        return {**rounded, self.name: self.entry.search}

    def _joint(self, *, by_mass: bool) -> list[Constraint]:
        free = frozenset(self._box(by_mass=False))
        claims = [self.ledger.claims[name] for name in (*self.entry.header, *self.agreeing)]
        constraints: list[Constraint] = [
            (self.ledger.function(claim, free, centered=self.centered), claim.target())
            for claim in claims
        ]
        if not by_mass:
            return constraints
        radius, mass, density = self.entry.radius, self.entry.mass, self.entry.density

        def of_mass(function: Function) -> Function:
            def by_radius(ar: Arithmetic, **entries: Number) -> Number | Fraction:
                volume = entries[mass] / entries[density]
                own = ar.power(3 * volume / (4 * ar.pi), Fraction(1, 3))
                return function(ar, **{**entries, radius: own})

            return by_radius

        own = self.ledger.claims[radius].as_input(Convention())
        constraints.append((lambda _, **entries: entries[radius], own))
        return [(of_mass(function), target) for function, target in constraints]

    @cached_property
    def radius(self) -> tuple[str, tuple[Fraction, Fraction]]:
        """The radius, by name, and the values of it that its print and the printed mass admit."""
        name, mass, density = self.entry.radius, self.entry.mass, self.entry.density
        box = {key: self.ledger.claims[key].as_input(Convention()).ends for key in (mass, density)}

        def of_mass(ar: Arithmetic, **entries: Number) -> Number:
            volume = entries[mass] / entries[density]
            return ar.power(3 * volume / (4 * ar.pi), Fraction(1, 3))

        low, high = self.ledger.claims[name].as_input(Convention()).ends
        least, greatest = enclose(of_mass, box).ends
        if greatest < low or high < least:  # the mass contradicts it
            return name, (low, high)
        return name, (max(low, least), min(high, greatest))

    def holds_at(self, point: Mapping[str, Fraction]) -> bool:
        """Whether the evidence can hold at a point; other inputs are within their rounding."""
        by_mass = self.entry.radius not in point
        box = self._box(by_mass=by_mass)
        fixed = {name: (x, x) for name, x in point.items() if name in box}
        return satisfying(self._joint(by_mass=by_mass), {**box, **fixed})[0] is True

    def admits(self, value: Fraction, range_: Interval) -> str:
        """What the evidence says of a value that is printed, with its range, somewhere else."""
        if self.inner.contains(value):
            return "admitted"
        if not self.inner.excludes(*range_.ends):
            return "admitted only as a number that was rounded"
        if self.possible.excludes(*range_.ends):
            return "excluded"
        words = {
            True: "admitted only if the other inputs are rounded",
            False: "excluded",
            None: "undecided",
        }
        box = {**self._box(by_mass=True), self.name: range_.ends}
        return words[satisfying(self._joint(by_mass=True), box)[0]]


def infer(ledger: Ledger, name: str, *, centered: bool = False) -> Inference:
    """Infer one input from its evidence, by proof (see `reference.enclosure`).

    `name` is its id with "inferred:" before it. Evidence that no value serves together with the
    rest is left out; the Inference names it. If none of it admits any value, the nominal one stays.
    """
    evidence = ledger.inferred[name.removeprefix(INFERRED)].evidence
    return _infer(ledger, name, centered, evidence, {})


def _infer(
    ledger: Ledger,
    name: str,
    centered: bool,
    evidence: list[str],
    fixed: Mapping[str, Fraction],
) -> Inference:
    search = ledger.inferred[name.removeprefix(INFERRED)].search
    each = {}
    for claim in (ledger.claims[name] for name in evidence):
        function = ledger.function(claim, frozenset({name}), centered=centered, fixed=fixed)
        each[claim.id] = solve(function, name, search, claim.target())
    agreeing = _agreeing(each)
    if not agreeing:
        nominal = Interval.point(ledger.value(name))
        return Inference(ledger, name, centered, each, (), nominal, nominal)
    inner, outer = (
        _intersection([getattr(each[claim], which) for claim in agreeing])
        for which in ("inner", "outer")
    )
    return Inference(ledger, name, centered, each, agreeing, inner, outer)


def _agreeing(each: Mapping[str, Solutions]) -> tuple[str, ...]:
    """The largest set of evidence that one value serves; of several, that of the least value.

    Empty if no value of the search serves any of it.
    """
    best: tuple[str, ...] = ()
    for value in sorted({low for solutions in each.values() for low, _ in solutions.inner}):
        agreeing = tuple(name for name, solutions in each.items() if solutions.admits(value))
        best = max(best, agreeing, key=len)
    return best


def _intersection(parts: list[tuple[tuple[Fraction, Fraction], ...]]) -> Interval:
    """What the unions of intervals have in common, around one stretch of it."""
    common = [(low, high) for low, high in parts[0]]
    for others in parts[1:]:
        pairs = ((max(a, c), min(b, d)) for a, b in common for c, d in others)
        common = [(low, high) for low, high in pairs if low <= high]
    return Interval(*common[0])

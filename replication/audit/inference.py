"""Inputs that the report never prints, inferred from numbers that it does print."""

from collections.abc import Sequence
from enum import Enum
from fractions import Fraction
from functools import cache, cached_property

from msgspec.structs import replace

from reference.arithmetic import Arithmetic, Function, Number
from reference.enclosure import (
    Box,
    Constraint,
    Ends,
    Satisfiability,
    SolutionSet,
    bounds,
    find_solutions,
    satisfying,
)
from reference.ledger import INFERRED, Convention, Ledger
from reference.printed import Interval, Rounding
from reference.scheme import Scheme

DENSITY = INFERRED + "target-density"
"""The id of the one input that the report needs and does not print."""


class Admission(Enum):
    """Whether the evidence admits a value from a public source, and on what condition."""

    ADMITTED = "admitted"
    AS_ROUNDED = "admitted only as a number that was rounded"
    HEADER_ROUNDED = "admitted only if the header of Table A-1 is rounded"
    CHOICES_ROUNDED = "admitted only if what the author chose is rounded, too"
    UNDECIDED = "undecided"
    EXCLUDED = "excluded as long as the mass is the sphere's"


class Inference:
    """The values (SI) of an unprinted input for which its evidence comes out as printed.

    The evidence is a set of claims. `name` is the input's id with "inferred:" before it; `rounding`
    is the rule by which the evidence was printed; `by_mass` takes the printed particle mass instead
    of the mass of a sphere.

    `by_claim` holds the values that each piece of evidence admits by itself, with the other inputs
    exactly as printed. `agreeing` is the largest set of evidence that a single value satisfies (of
    several such sets, that of the least value), and `odd` is the rest. Every value in `inner` is
    proven to satisfy all agreeing evidence; no value outside `outer` does. If no value satisfies
    any evidence, all of it is odd, and `inner` is the ledger's nominal value.
    """

    def __init__(
        self,
        ledger: Ledger,
        name: str,
        *,
        scheme: Scheme = Scheme.PUBLISHED,
        rounding: Rounding = Rounding.AWAY,
        by_mass: bool = False,
    ) -> None:
        self.ledger, self.name, self.scheme, self.rounding = ledger, name, scheme, rounding
        self.entry = ledger.inferred[name.removeprefix(INFERRED)]
        self.rounded, self.admitted = cache(self._rounded), cache(self._admitted)
        self.admits = cache(self._admits)
        self.by_claim: dict[str, SolutionSet] = {}
        for claim in map(ledger.claims.__getitem__, self.entry.evidence):
            resting = claim.resting_on(mass=self.entry.mass) if by_mass else claim
            printed = {key: ledger.value(key) for key in resting.input_ids if key != name}
            function, search = ledger.function(resting, scheme=scheme), self.entry.search
            target = claim.target(rounding)
            self.by_claim[claim.id] = find_solutions(function, name, search, target, others=printed)
        values = sorted({low for own in self.by_claim.values() for low, _ in own.inner})
        sets = (tuple(c for c, own in self.by_claim.items() if own.admits(x)) for x in values)
        self.agreeing = max(sets, key=len, default=())
        self.odd = tuple(claim for claim in self.by_claim if claim not in self.agreeing)
        self.outer, self.inner = Interval(*self.entry.search), Interval.point(ledger.value(name))
        if self.agreeing:
            solutions = [self.by_claim[claim] for claim in self.agreeing]
            outer = _intersection([own.outer for own in solutions])
            self.outer = Interval(outer[0][0], outer[-1][1])
            self.inner = Interval(*_intersection([own.inner for own in solutions])[0])

    @cached_property
    def with_mass(self) -> Interval:
        """`inner` if the particle mass is the printed one."""
        return Inference(
            self.ledger, self.name, scheme=self.scheme, rounding=self.rounding, by_mass=True
        ).inner

    def _admitted(self, convention: Convention) -> Interval:
        """Return all values that may satisfy the evidence if a convention's inputs are rounded.

        The printed mass and diameter count as evidence, too. Everything is taken as rounded to
        nearest: if it were cut off, no value would satisfy the evidence.
        """
        if (convention.choices_exact and convention.header_exact) or not self.agreeing:
            return self.outer
        if convention.rounding is not Rounding.AWAY:
            return self.admitted(replace(convention, rounding=Rounding.AWAY))
        constraints, box = self.joint(convention, {self.name: self.entry.search})
        return Interval(*bounds(constraints, self.name, box))

    def _rounded(self, name: str, convention: Convention) -> Ends:
        """Return the values of an input that print like it and give what is computed from it alone.

        The times in Table A-1 are multiples of the step, so they narrow it further than "0.2 ns".
        """
        claim = self.ledger.claims[name]
        low, high = claim.as_input(convention).ends
        for shown in map(self.ledger.claims.__getitem__, claim.shown_by):
            if low != high and shown.input_ids == [name]:
                function = self.ledger.function(shown)
                allowed = find_solutions(function, name, (low, high), shown.target()).outer
                low, high = (allowed[0][0], allowed[-1][1]) if allowed else (low, high)
        return low, high

    def joint(
        self, convention: Convention, box: Box, also: Sequence[Constraint] = ()
    ) -> tuple[list[Constraint], Box]:
        """Return all evidence and the constraints `also`, with the box of all their inputs.

        The printed mass and density determine the radius more closely than its own digits do. So
        where the header is rounded, the mass varies and the radius is computed from it.
        """
        claims, entry = self.ledger.claims, self.entry
        evidence = [claims[key] for key in (*entry.header, *self.agreeing)]
        names = {name for claim in evidence for name in claim.input_ids} - {self.name}
        constraints: list[Constraint] = [
            (self.ledger.function(claim, scheme=self.scheme), claim.target()) for claim in evidence
        ]
        constraints += also
        if not convention.header_exact:
            printed = claims[entry.radius].as_input(convention)
            constraints.append((lambda _, **entries: entries[entry.radius], printed))
            constraints = [(self._of_mass(function), target) for function, target in constraints]
            names = names - {entry.radius} | {entry.mass}
            box = {name: ends for name, ends in box.items() if name != entry.radius}
        ranges = {name: self.rounded(name, convention) for name in sorted(names)}
        return constraints, {**box, **ranges}

    def _of_mass(self, function: Function) -> Function:
        """Turn a function of the particle's radius into one of its mass and density."""
        entry = self.entry

        def by_mass(ar: Arithmetic, **entries: Number) -> Number | Fraction:
            volume = entries[entry.mass] / entries[entry.density]
            radius = ar.power(3 * volume / (4 * ar.pi), Fraction(1, 3))
            return function(ar, **{**entries, entry.radius: radius})

        return by_mass

    def _admits(self, value: Fraction, range_: Interval) -> Admission:
        """Return whether the evidence admits a source's value, or the range that prints like it."""
        if self.inner.contains(value):
            return Admission.ADMITTED
        if not self.inner.excludes(*range_.ends):
            return Admission.AS_ROUNDED
        for admission, convention in (
            (Admission.HEADER_ROUNDED, Convention()),
            (Admission.CHOICES_ROUNDED, Convention(choices_exact=False)),
        ):
            (low, high), (least, greatest) = range_.ends, self.admitted(convention).ends
            if high < least or greatest < low:
                continue
            # The bounds hold for each piece of evidence by itself, and may admit too much.
            within = max(low, least), min(high, greatest)
            outcome, _ = satisfying(*self.joint(convention, {self.name: within}))
            if outcome is Satisfiability.SHOWN:
                return admission
            if outcome is Satisfiability.UNDECIDED:
                return Admission.UNDECIDED
        return Admission.EXCLUDED


def _intersection(unions: Sequence[Sequence[Ends]]) -> list[Ends]:
    """Return the intervals that unions of intervals have in common, in order."""
    common, *others = map(list, unions)
    for union in others:
        pairs = ((max(a, c), min(b, d)) for a, b in common for c, d in union)
        common = [(low, high) for low, high in pairs if low <= high]
    return common

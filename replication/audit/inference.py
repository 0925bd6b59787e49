"""Inputs that the report never prints, inferred from the numbers that it does print."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property

from reference.enclosure import Box, Constraint, admitted, extent, satisfiable
from reference.ledger import Inferred, Ledger
from reference.printed import Interval, Printed
from replication.audit.entries import function_of, rounding, value

__all__ = ["Inference", "infer", "possible"]


@dataclass(frozen=True, eq=False)
class Inference:
    """The values of an input that reproduce all of its evidence (SI units).

    With the other inputs exactly as printed: each value of `inner` is proven to, none outside
    `outer` does. `with_mass`: the same where the particle mass is the printed one. `with_results`:
    the values that serve the evidence and both final depths at once. With the other inputs anywhere
    within their rounding, and the printed mass and diameter as evidence, too: `attained` is the
    hull of values that were found, `possible` holds all that there are. What not every verdict asks
    for is computed when it is asked for.
    """

    ledger: Ledger
    entry: Inferred
    inner: Interval
    outer: Interval

    @cached_property
    def with_mass(self) -> Interval:
        mass = value(self.ledger, self.entry.mass)
        return _single(self.ledger, self.entry, self.entry.evidence, mass=mass)[0]

    @cached_property
    def with_results(self) -> Interval:
        claims = (*self.entry.evidence, *self.entry.results)
        return _single(self.ledger, self.entry, claims)[0]

    @property
    def attained(self) -> Interval:
        return self._extent[0]

    @property
    def possible(self) -> Interval:
        return self._extent[1]

    @cached_property
    def _extent(self) -> tuple[Interval, Interval]:
        start = self.entry.nominal
        return extent(self._joint, self._unknown, self._box, start, tolerance=Fraction(1))

    @property
    def _unknown(self) -> str:
        return f"inferred:{self.entry.id}"

    @cached_property
    def _box(self) -> Box:
        return {**_rounded_inputs(self.ledger, self.entry), self._unknown: self.entry.search}

    @cached_property
    def _joint(self) -> list[Constraint]:
        claims = (*self.entry.header, *self.entry.evidence)
        return _constraints(self.ledger, claims, frozenset(self._box))

    @cached_property
    def handbook(self) -> Mapping[str, tuple[Printed, str]]:
        """Handbook values, and what the evidence says of each, a rounded number itself."""
        return {
            name: (printed, self._verdict(printed.value, printed.interval()))
            for name, printed in self.entry.handbook.items()
        }

    def holds_at(self, point: Mapping[str, Fraction]) -> bool:
        """Whether the evidence can hold at a point; other inputs are within their rounding."""
        fixed = {name: (x, x) for name, x in point.items() if name in self._box}
        return satisfiable(self._joint, {**self._box, **fixed}) is True

    def _verdict(self, value: Fraction, handbook: Interval) -> str:
        ends = handbook.ends
        if self.inner.contains(value):
            return "admitted"
        if not self.inner.excludes(*ends):
            return "admitted only as a number that was rounded"
        if self.possible.excludes(*ends):
            return "excluded"
        words = {
            True: "admitted only if the other inputs are rounded",
            False: "excluded",
            None: "undecided",
        }
        return words[satisfiable(self._joint, {**self._box, self._unknown: ends})]


@cache
def infer(ledger: Ledger, name: str) -> Inference:
    """Infer one input from its evidence, by proof (see `reference.enclosure`).

    Raises ValueError if the nominal value of the ledger is not admitted.
    """
    entry = ledger.inferred[name]
    inner, outer = _single(ledger, entry, entry.evidence)
    if not inner.contains(entry.nominal):
        raise ValueError(f"the evidence does not admit {entry.title} {entry.nominal}: {inner}")
    return Inference(ledger, entry, inner, outer)


def possible(ledger: Ledger, name: str) -> tuple[Fraction, Fraction]:
    """The least and greatest value, in SI, of an entry: that prints like it, or is possible."""
    _, _, inferred = name.partition("inferred:")
    return infer(ledger, inferred).possible.ends if inferred else rounding(ledger, name)


def _single(
    ledger: Ledger, entry: Inferred, claims: tuple[str, ...], **fixed: Fraction
) -> tuple[Interval, Interval]:
    """What the claims admit of the input where all others are as printed, or fixed."""
    unknown = f"inferred:{entry.id}"
    alone = _constraints(ledger, claims, frozenset({unknown}), **fixed)
    return admitted(alone, unknown, entry.search, entry.resolution)


def _constraints(
    ledger: Ledger, claims: tuple[str, ...], free: frozenset[str], **fixed: Fraction
) -> list[Constraint]:
    return [
        (function_of(ledger, claim, claim.functions[""], free, **fixed), claim.target)
        for claim in (ledger.claims[name] for name in claims)
    ]


def _rounded_inputs(ledger: Ledger, entry: Inferred) -> Box:
    """The inputs that the evidence rests on and that may be other than printed."""
    names = {
        name
        for claim in entry.evidence
        for names in ledger.claims[claim].inputs.values()
        for name in names
        if not name.startswith("inferred:")
    }
    ends = {name: rounding(ledger, name) for name in sorted(names)}
    return {name: (low, high) for name, (low, high) in ends.items() if low != high}

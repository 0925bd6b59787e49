"""A quick look at a ledger in doubles: which claims agree with the inputs as printed.

It proves nothing. It tells which of many possible misprints are worth a proof, and how many claims
one of them would put wrong.
"""

from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import cache

from reference.arithmetic import Floats
from reference.ledger import INFERRED, Claim, Convention, Function, Ledger
from reference.printed import Interval

_FLOATS = Floats()
_CLOSE = Fraction(1, 10**9)
"""How near to exact text, such as 2/3, a double must come."""


class Screen:
    """Which claims of a ledger agree, its inferred inputs at given values (SI)."""

    def __init__(self, ledger: Ledger, assumed: Mapping[str, Fraction]) -> None:
        self.ledger, self.assumed = ledger, assumed
        self._prepared = cache(self._prepare)

    def agrees(
        self, claim: Claim, reading: str = "", changed: Mapping[str, Fraction] | None = None
    ) -> bool:
        """Whether a claim with a computation agrees, with some entries changed (SI)."""
        if claim.computations[reading].restates:
            return restates(self.ledger, claim, changed or {})
        function, values, target = self._prepared(claim, reading)
        if changed:
            values = {name: float(changed.get(name, value)) for name, value in values.items()}
        try:
            value = Fraction(function(_FLOATS, **values))
        except (ArithmeticError, ValueError, TypeError):
            return False  # no such input has a result, or only a complex one
        if target.is_point and target.lower is not None:
            return abs(value - target.lower) <= _CLOSE * abs(target.lower)
        return target.contains(value)

    def _prepare(self, claim: Claim, reading: str) -> tuple[Function, dict[str, float], Interval]:
        """What an agreement takes that no change of an entry changes."""
        known = self.assumed
        values = {
            name: float(known[name] if name in known else self.ledger.value(name))
            for name in claim.entries
        }
        return self.ledger.function(claim, reading=reading), values, claim.target()

    def failing(self, names: Iterable[str]) -> set[str]:
        """Those of the claims that do not agree."""
        claims = (self.ledger.claims[name] for name in names)
        return {c.id for c in claims if c.computation is not None and not self.agrees(c)}


def restates(ledger: Ledger, claim: Claim, changed: Mapping[str, Fraction]) -> bool:
    """Whether a claim that only repeats or counts agrees with what it repeats or counts.

    It does if some value prints like both texts and, of a bound, satisfies it. `changed` gives the
    repeated number another value (SI).
    """
    assert claim.computation is not None
    if claim.computation.name == "count":
        return claim.target().contains(Fraction(len(claim.inputs)))
    (name,) = claim.inputs["value"]
    # A choice or an exact number has one value; a bound or an "about" has its own interval.
    loose = claim.bound is not None or claim.kind == "approximation"
    own = claim.target() if loose else claim.as_input(Convention())
    if name in changed:
        return own.contains(changed[name])
    return own.meets(ledger.claims[name].as_input(Convention()))


def dependents(ledger: Ledger, name: str) -> set[str]:
    """The claims whose verdict may change with an entry or an equation, itself among them.

    Claims that depend on an inferred input depend on its evidence, and on all that this rests on;
    an input that others show to be right depends on them.
    """
    within = ledger.claims[name].within if name in ledger.claims else name
    direct = {
        claim.id
        for claim in ledger.claims.values()
        if claim.id == name
        or name in claim.entries
        or claim.against == name
        or within in claim.uses
    }
    for key, inferred in ledger.inferred.items():
        if direct & set(inferred.evidence):
            unknown = INFERRED + key
            direct |= {c.id for c in ledger.claims.values() if unknown in c.entries}
    return direct | {c.id for c in ledger.claims.values() if direct & set(c.shown_by)}

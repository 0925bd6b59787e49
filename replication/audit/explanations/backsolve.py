"""Back-solving: values of one input, the others as printed, that would give a printed number."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from reference.conjectures import Conjectures
from reference.enclosure import Solutions, solutions
from reference.ledger import Claim, Ledger
from reference.printed import Interval
from reference.units import same_dimension
from replication.audit.entries import entries_of, function_of, replica_of, title, value
from replication.audit.verdict import Reading

__all__ = ["BackSolved", "Mark", "back_solve"]

_PARTS = 1000
"""The proof goes down to such a part of the least value that is searched."""


@dataclass(frozen=True, slots=True)
class Mark:
    """A number known from elsewhere that would serve as the input; `value` in SI."""

    kind: str
    name: str
    value: Fraction


@dataclass(frozen=True, slots=True)
class BackSolved:
    """What one entry would have to be for a claim to agree; numbers in SI.

    `value` gives the middle of the printed interval (or its one end), in doubles; None if no value
    of the search does. `rounding`: whether a value that prints like the entry is admitted.
    """

    reading: str
    entry: str
    title: str
    unit: str
    reason: str
    solutions: Solutions
    printed: Fraction
    value: float | None
    rounding: bool
    marks: tuple[Mark, ...]

    @property
    def change(self) -> float | None:
        """By how much the value differs from the one printed, relatively."""
        return None if self.value is None else self.value / float(self.printed) - 1

    @property
    def proof(self) -> str:
        """What is proven, in a few words."""
        if not self.solutions.outer:
            return "proven: none in the range does"
        if not self.solutions.inner:
            return "undecided"
        if self.solutions.reaches_an_end:
            return "proven, up to an end of the range"
        return "proven inside, and none beyond"


def back_solve(
    ledger: Ledger, conjectures: Conjectures, claim: Claim, reading: Reading
) -> list[BackSolved]:
    """Each entry that the claim rests on, alone, solved for the printed interval."""
    entries = entries_of(ledger, claim)
    return [_solved(ledger, conjectures, claim, reading, name) for name in entries]


def _solved(
    ledger: Ledger, conjectures: Conjectures, claim: Claim, reading: Reading, name: str
) -> BackSolved:
    quantity, target = conjectures.quantity(name), claim.target
    search = _cuts(*(end * quantity.si for end in quantity.search))
    function = function_of(ledger, claim, claim.functions[reading.name], frozenset({name}))
    resolution = search[0] / _PARTS
    found = solutions([(function, target)], name, search, resolution, quantity.budget)
    replica = replica_of(ledger, claim, reading.computation)
    return BackSolved(
        reading.name, name, title(ledger, name), quantity.unit, quantity.reason, found,
        value(ledger, name),
        _middle(lambda x: replica({name: x}), found, target), _prints_like(ledger, name, found),
        tuple(_marks(ledger, conjectures, claim, name, found)),
    )  # fmt: skip


def _cuts(low: Fraction, high: Fraction) -> list[Fraction]:
    """The search cut at steps of a quarter: over more, a sheet's intervals say nothing."""
    cuts = [low]
    while cuts[-1] * 5 / 4 < high:
        cuts.append(cuts[-1] * 5 / 4)
    return [*cuts, high]


def _middle(function: Callable[[float], float], found: Solutions, target: Interval) -> float | None:
    """The value of the first solution that gives the middle of the target, by bisection."""
    ends = [float(end) for end in (target.lower, target.upper) if end is not None]
    goal = sum(ends) / len(ends)
    if not found.outer:
        return None
    low, high = (float(end) for end in (found.outer[0].lower, found.outer[0].upper) if end)
    rising = function(low) < function(high)
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if (function(middle) < goal) == rising else (low, middle)
    return next((x for x in (low, high) if target.contains(Fraction(function(x)))), None)


_BISECTIONS = 40
"""Of an interval that is itself a few per cent of the value: down to a double's rounding."""


def _prints_like(ledger: Ledger, name: str, found: Solutions) -> bool:
    """Whether a proven solution prints like the entry; an inferred one has no print."""
    if name.startswith("inferred:"):
        return False
    own = ledger.claims[name].as_input()
    ends = ((part.lower, part.upper) for part in found.inner)
    return any(not own.excludes(low, high) for low, high in ends if low and high)


def _marks(
    ledger: Ledger, conjectures: Conjectures, claim: Claim, name: str, found: Solutions
) -> list[Mark]:
    """Handbook values of the quantity and printed numbers of its dimension that would serve."""
    quantity = conjectures.quantity(name)
    known = [
        Mark("handbook", text, printed.value * quantity.si)
        for text, printed in quantity.handbook.items()
    ]
    known += [
        Mark("printed", other.id, other.printed.value * other.si)
        for other in ledger.claims.values()
        if other.printed is not None
        and other.kind != "constant"
        and other.id != claim.id
        and same_dimension(other.unit, quantity.unit)
    ]
    return [mark for mark in known if any(part.contains(mark.value) for part in found.inner)]

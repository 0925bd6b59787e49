"""Other readings of an equation: each slip alone, and each pair, on all the numbers it touches."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import combinations

from reference.conjectures import Conjectures, Family, Slip
from reference.enclosure import Box, Constraint, Function, evaluate, explore, satisfiable
from reference.exact import Arithmetic, Number
from reference.ledger import Claim, Ledger
from reference.slips import SLIPS
from replication.audit.entries import value
from replication.audit.inference import possible
from replication.audit.verdict import Verdict

__all__ = ["Alternative", "Alternatives", "alternatives"]


@dataclass(frozen=True, slots=True)
class Alternative:
    """A reading with one or two slips: what it makes of each claim, as printed and with rounding.

    `computed` and `verdicts` by claim id; `explains_all`: one set of inputs gives all of them (None
    if undecided).
    """

    name: str
    slips: int
    computed: Mapping[str, float]
    verdicts: Mapping[str, Verdict]
    explains_all: bool | None
    misses: Mapping[str, float]

    @property
    def miss(self) -> float:
        """How far the worst of its values is from the middle of what is printed, relatively."""
        return max(self.misses.values())

    def explains(self, claim: str) -> bool:
        """Whether it gives one of the numbers, with inputs as printed or as rounded."""
        return self.verdicts[claim] in (Verdict.REPRODUCED, Verdict.WITHIN_ROUNDING)


@dataclass(frozen=True, slots=True)
class Alternatives:
    """All readings that were tried of one family of claims."""

    family: Family
    tried: tuple[Alternative, ...]

    @property
    def nearest(self) -> Alternative:
        """The one whose worst value is the least off."""
        return min(self.tried, key=lambda alternative: alternative.miss)

    @property
    def sentence(self) -> str:
        """What came of it all."""
        numbers = " and ".join(self.family.claims)
        good = [a.name for a in self.tried if a.explains_all]
        found = f"{len(good)} give {numbers}: {'; '.join(good)}" if good else "none gives"
        if not good:
            open_ = sum(a.explains_all is None for a in self.tried)
            found += f" both {numbers}" + (f" ({open_} undecided)" if open_ else "")
        near = self.nearest
        values = ", ".join(f"{x:.4f}" for x in near.computed.values())
        return (
            f"Of {len(self.tried)} readings of {self.family.name}, with up to two slips each, "
            f"{found}. "
            f'The nearest is "{near.name}": {values}, {100 * near.miss:.1f} % off at worst.'
        )


@cache
def alternatives(ledger: Ledger, conjectures: Conjectures, family: Family) -> Alternatives:
    """Every reading of a family, alone, with one slip, and with two in different places."""
    slips = [s for slip in family.slips for s in _expanded(conjectures, ledger, family, slip)]
    tried = [
        _alternative(ledger, family, (reading, *added))
        for reading in family.readings
        for count in range(3)
        for added in combinations(slips, count)
        if _compatible((reading, *added))
    ]
    return Alternatives(family, tuple(tried))


def _expanded(
    conjectures: Conjectures, ledger: Ledger, family: Family, slip: Slip
) -> Iterator[Slip]:
    """A slip to handbook values is one for each of them."""
    if slip.handbook is None:
        yield slip
        return
    (entry,) = ledger.claims[family.claims[0]].inputs[slip.handbook]
    for name, printed in conjectures.quantity(entry).handbook.items():
        yield Slip(f"{slip.name}: {name}", slip.reason, {slip.handbook: printed.text})


def _compatible(slips: tuple[Slip, ...]) -> bool:
    places = [place for slip in slips for place in slip.places]
    return len(places) == len(set(places))


def _alternative(ledger: Ledger, family: Family, slips: tuple[Slip, ...]) -> Alternative:
    claims = [ledger.claims[name] for name in family.claims]
    places = {place: source for slip in slips for place, source in slip.places.items()}
    functions = {c.id: _function(family, c, places) for c in claims}
    boxes = {c.id: _box(ledger, c, places) for c in claims}
    points = {c.id: {n: (v, v) for n in boxes[c.id] for v in [_value(ledger, n)]} for c in claims}
    values = {c.id: evaluate(functions[c.id], points[c.id]) for c in claims}
    verdicts = {c.id: _verdict(c, functions[c.id], values[c.id], boxes[c.id]) for c in claims}
    computed = {name: float(low) for name, (low, _) in values.items()}
    constraints = [(functions[c.id], c.target) for c in claims]
    whole = {name: ends for box in boxes.values() for name, ends in box.items()}
    return Alternative(
        ", ".join(slip.name for slip in slips), len(slips) - 1, computed, verdicts,
        _all(constraints, list(verdicts.values()), whole),
        {c.id: abs(computed[c.id] / float(c.printed.value) - 1) for c in claims if c.printed},
    )  # fmt: skip


def _function(family: Family, claim: Claim, places: Mapping[str, str]) -> Function:
    """The family's function of the entries that its places take, for one claim."""
    sources = {**{place: name for place, (name,) in claim.inputs.items()}, **places}

    def of_entries(ar: Arithmetic, **entries: Number) -> Number:
        return SLIPS[family.function](ar, **{p: entries[name] for p, name in sources.items()})

    return of_entries


def _box(ledger: Ledger, claim: Claim, places: Mapping[str, str]) -> Box:
    names = {*(name for (name,) in claim.inputs.values()), *places.values()}
    return {name: _ends(ledger, name) for name in sorted(names)}


def _value(ledger: Ledger, name: str) -> Fraction:
    return Fraction(name) if name[0].isdigit() else value(ledger, name)


def _ends(ledger: Ledger, name: str) -> tuple[Fraction, Fraction]:
    """The values that print like an entry, or that the evidence allows; a plain number is exact."""
    if name[0].isdigit():
        return Fraction(name), Fraction(name)
    return possible(ledger, name)


def _verdict(
    claim: Claim, function: Function, at_printed: tuple[Fraction, Fraction], box: Box
) -> Verdict:
    target = claim.target
    if target.encloses(*at_printed):
        return Verdict.REPRODUCED
    if target.excludes(*evaluate(function, box)):
        return Verdict.NOT_REPRODUCED
    found = explore(function, box, target)
    if found.inside is not None:
        return Verdict.WITHIN_ROUNDING
    return Verdict.NOT_REPRODUCED if found.never else Verdict.UNDECIDED


def _all(constraints: list[Constraint], verdicts: list[Verdict], box: Box) -> bool | None:
    """Whether one set of inputs satisfies all; that none does follows where one claim fails."""
    if Verdict.NOT_REPRODUCED in verdicts:
        return False
    return satisfiable(constraints, box)

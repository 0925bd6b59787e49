"""Misprints: the texts one edit away from a result or an input that would make a claim agree."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from reference.conjectures import Conjectures
from reference.enclosure import evaluate
from reference.ledger import Claim, Ledger
from reference.printed import parse
from replication.audit.assessed import assess_claim
from replication.audit.entries import entries_of, function_of, replica_of
from replication.audit.explanations.edits import KINDS, Edit, edits
from replication.audit.verdict import Reading, Verdict

__all__ = ["Misprint", "misprints"]


@dataclass(frozen=True, slots=True)
class Misprint:
    """One edit that would make a claim agree under a reading, and what else it would change.

    `what` is the entry whose text is edited, the claim itself or an input; `computed` is the
    claim's value then, in its unit. `breaks` are the claims, reproduced as printed, that rest on
    the entry and would fail.
    """

    what: str
    printed: str
    edit: Edit
    reading: str
    computed: float
    breaks: tuple[str, ...]

    @property
    def rank(self) -> tuple[int, int, Fraction]:
        """By how many other claims it breaks, then by kind of edit, then by how far it moves."""
        return len(self.breaks), KINDS.index(self.edit.kind), self.distance

    @property
    def distance(self) -> Fraction:
        """How far the edited number is from the printed one, relative to the greater."""
        one, other = parse(self.printed).value, self.edit.printed.value
        return abs(one - other) / max(abs(one), abs(other))


def misprints(
    ledger: Ledger,
    conjectures: Conjectures,
    claim: Claim,
    reading: Reading,
) -> list[Misprint]:
    """Every one-edit misprint of the claim or of one of its inputs that would make it agree."""
    found = [*_of_result(ledger, claim, reading)]
    for name in entries_of(ledger, claim):
        if not name.startswith("inferred:"):
            found += _of_input(ledger, conjectures, claim, reading, name)
    return sorted(found, key=lambda misprint: (misprint.rank, misprint.what, misprint.edit.text))


def _of_result(ledger: Ledger, claim: Claim, reading: Reading) -> Iterator[Misprint]:
    if claim.printed is None or claim.relation:
        return
    for edit in edits(claim.text):
        if claim.reprinted(edit.printed).contains(Fraction(reading.reference)):
            broken = _broken(ledger, claim, claim.id, edit)
            yield Misprint(claim.id, claim.text, edit, reading.name, reading.computed, broken)


def _of_input(
    ledger: Ledger,
    conjectures: Conjectures,
    claim: Claim,
    reading: Reading,
    name: str,
) -> Iterator[Misprint]:
    entry, target = ledger.claims[name], claim.target
    low, high = (end * conjectures.quantity(name).si for end in conjectures.quantity(name).search)
    replica = replica_of(ledger, claim, reading.computation)
    for edit in edits(entry.text):
        number = edit.printed.value * entry.si
        # Beyond the search no sheet need come to an end.
        if not low <= number <= high or not target.contains(Fraction(replica({name: number}))):
            continue
        if _agrees(ledger, claim, reading.name, name, number):
            computed = float(Fraction(replica({name: number})) / claim.si)
            broken = _broken(ledger, claim, name, edit)
            yield Misprint(name, entry.text, edit, reading.name, computed, broken)


def _broken(ledger: Ledger, claim: Claim, name: str, edit: Edit) -> tuple[str, ...]:
    """Reproduced claims that rest on the entry and fail where it is the edited one."""
    number = edit.printed.value * ledger.claims[name].si
    return tuple(
        other.id
        for other in ledger.claims.values()
        if other.id != claim.id
        and any(name in names for names in other.inputs.values())
        and assess_claim(ledger, other.id).verdict is Verdict.REPRODUCED
        and not _agrees(ledger, other, "", name, number)
    )


def _agrees(ledger: Ledger, claim: Claim, reading: str, name: str, number: Fraction) -> bool:
    """Whether the claim is proven to agree where one entry has another value."""
    function = function_of(ledger, claim, claim.functions[reading], frozenset({name}))
    return claim.target.encloses(*evaluate(function, {name: (number, number)}))

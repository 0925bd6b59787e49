"""The ledger's entries as inputs: their values, their rounding, and functions of them."""

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import cache, reduce
from math import prod
from operator import mul

from reference.computations import Computation
from reference.enclosure import Function
from reference.exact import Arithmetic, Number
from reference.ledger import Claim, Ledger
from reference.units import to_si
from replication.audit.replica import REPLICA

__all__ = ["entries_of", "function_of", "replica_of", "rounding", "title", "value"]


@cache
def value(ledger: Ledger, name: str) -> Fraction:
    """An entry's value as printed, or the nominal one of an inferred input, in SI."""
    _, _, inferred = name.partition("inferred:")
    if inferred:
        entry = ledger.inferred[inferred]
        return entry.nominal * to_si(entry.unit)
    claim = ledger.claims[name]
    assert claim.printed is not None
    return claim.printed.value * claim.si


def entries_of(ledger: Ledger, claim: Claim) -> list[str]:
    """The entries that the claim rests on, of a comparison those that the other one does not."""
    shared = {} if claim.like is None else ledger.claims[claim.like].inputs
    known = {name for names in shared.values() for name in names}
    entries = dict.fromkeys(name for names in claim.inputs.values() for name in names)
    return [name for name in entries if name not in known]


def title(ledger: Ledger, name: str) -> str:
    """What an entry is, in words."""
    _, _, inferred = name.partition("inferred:")
    return ledger.inferred[inferred].title if inferred else ledger.claims[name].title


@cache
def rounding(ledger: Ledger, name: str, loose: bool = False) -> tuple[Fraction, Fraction]:
    """The least and greatest value, in SI, that prints like an entry."""
    return ledger.claims[name].as_input(loose).ends


def function_of(
    ledger: Ledger, claim: Claim, function: Function, free: frozenset[str], **fixed: Fraction
) -> Function:
    """A claim's computation as a function of the free entries, the others as printed.

    An entry that stands in several inputs is one variable. `fixed` gives inputs of the computation
    that the claim does not name.
    """
    used = {name for names in claim.inputs.values() for name in names}
    printed = {name: value(ledger, name) for name in used - free}

    @cache
    def known(ar: Arithmetic) -> tuple[dict[str, Number], dict[str, Number]]:
        entries, inputs = (
            {name: ar.number(number) for name, number in numbers.items()}
            for numbers in (printed, fixed)
        )
        return entries, inputs

    def of_entries(ar: Arithmetic, **entries: Number) -> Number | Fraction:
        others, inputs = known(ar)
        number = {**others, **entries}
        own = {k: reduce(mul, map(number.get, names)) for k, names in claim.inputs.items()}
        return function(ar, **own, **inputs)

    return of_entries


def replica_of(
    ledger: Ledger, claim: Claim, computation: Computation
) -> Callable[[Mapping[str, Fraction | float]], float]:
    """The replica's answer, in SI, as a function of changed entries; the others as printed."""
    row = {} if claim.row is None else {"row": claim.row}

    def answer(changed: Mapping[str, Fraction | float]) -> float:
        def number(name: str) -> Fraction:
            return Fraction(changed[name]) if name in changed else value(ledger, name)

        inputs = {key: float(prod(map(number, names))) for key, names in claim.inputs.items()}
        return float(REPLICA[computation.name](**row, **inputs))

    return answer

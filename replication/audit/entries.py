"""The ledger's entries as inputs: their values, their rounding, and functions of them."""

from fractions import Fraction
from math import prod

from reference.enclosure import Function
from reference.exact import Arithmetic, Number
from reference.ledger import Claim, Ledger
from reference.units import to_si

__all__ = ["function_of", "rounding", "value"]


def value(ledger: Ledger, name: str) -> Fraction:
    """An entry's value as printed, or the nominal one of an inferred input, in SI."""
    _, _, inferred = name.partition("inferred:")
    if inferred:
        entry = ledger.inferred[inferred]
        return entry.nominal * to_si(entry.unit)
    claim = ledger.claims[name]
    assert claim.printed is not None
    return claim.printed.value * claim.si


def rounding(ledger: Ledger, name: str, loose: bool = False) -> tuple[Fraction, Fraction]:
    """The least and greatest value, in SI, that prints like an entry."""
    ends = ledger.claims[name].as_input(loose)
    assert ends.lower is not None
    assert ends.upper is not None
    return ends.lower, ends.upper


def function_of(
    ledger: Ledger, claim: Claim, function: Function, free: frozenset[str], **fixed: Fraction
) -> Function:
    """A claim's computation as a function of the free entries, the others as printed.

    An entry that stands in several inputs is one variable. `fixed` gives inputs of the computation
    that the claim does not name.
    """
    used = {name for names in claim.inputs.values() for name in names}
    printed = {name: value(ledger, name) for name in used - free}

    def of_entries(ar: Arithmetic, **entries: Number) -> Number | Fraction:
        def number(name: str) -> Number:
            return entries[name] if name in free else ar.number(printed[name])

        inputs = {key: prod(map(number, names)) for key, names in claim.inputs.items()}
        inputs |= {key: ar.number(number) for key, number in fixed.items()}
        return function(ar, **inputs)

    return of_entries

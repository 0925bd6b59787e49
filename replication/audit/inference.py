"""Inputs that the report never prints, inferred from the numbers that it does print."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

from reference.enclosure import admitted
from reference.ledger import Inferred, Ledger
from reference.printed import Interval
from reference.units import to_si

__all__ = ["Inference", "infer"]


@dataclass(frozen=True, slots=True)
class Inference:
    """The values of an input that reproduce all of its evidence, other inputs as printed.

    `inner`: each of these values is proven to; `outer`: no value outside does. SI units.
    """

    entry: Inferred
    inner: Interval
    outer: Interval

    @property
    def handbook(self) -> Mapping[str, tuple[Fraction, bool | None]]:
        """Handbook values, and whether the evidence admits each (None: within the resolution)."""
        return {name: (value, self._admits(value)) for name, value in self.entry.handbook.items()}

    def _admits(self, value: Fraction) -> bool | None:
        if self.inner.contains(value):
            return True
        return None if self.outer.contains(value) else False


@cache
def infer(ledger: Ledger, name: str) -> Inference:
    """Infer one input from its evidence, by proof (see `reference.enclosure.admitted`).

    Raises ValueError if the nominal value of the ledger is not admitted.
    """
    entry = ledger.inferred[name]
    claims = [ledger.claims[evidence] for evidence in entry.evidence]
    constraints = []
    inputs: dict[str, tuple[Fraction, Fraction]] = {}
    for claim in claims:
        assert claim.interval is not None
        constraints.append((claim.functions[""], claim.interval.scaled(claim.si)))
        for parameter, names in claim.inputs.items():
            value = nominal(ledger, names)
            inputs[parameter] = (value, value)
    inner, outer = admitted(constraints, entry.parameter, entry.search, inputs, entry.resolution)
    if not inner.contains(entry.nominal):
        raise ValueError(f"the evidence does not admit {entry.title} {entry.nominal}: {inner}")
    return Inference(entry, inner, outer)


def nominal(ledger: Ledger, names: tuple[str, ...]) -> Fraction:
    """The product of the named entries' values as printed, in SI."""
    product = Fraction(1)
    for name in names:
        product *= _value(ledger, name)
    return product


def _value(ledger: Ledger, name: str) -> Fraction:
    kind, _, inferred = name.partition(":")
    if inferred:
        entry = ledger.inferred[inferred]
        return entry.nominal * to_si(entry.unit)
    claim = ledger.claims[kind]
    assert claim.printed is not None
    return claim.printed.value * claim.si

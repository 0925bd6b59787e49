"""Each computation: its inputs, its units, its value, and the printed equations that it uses."""

from collections.abc import Iterator, Mapping
from fractions import Fraction as F
from inspect import signature
from math import prod

import pytest

from reference.arithmetic import Floats, Reals
from reference.computations import COMPUTATIONS
from reference.enclosure import enclose
from reference.equations import Equations, Node
from reference.ledger import Claim, load
from reference.scheme import Scheme
from reference.units import unit_dimension

LEDGER = load()
CLAIMS = list(LEDGER.claims.values())
COMPUTED = [claim for claim in CLAIMS if claim.is_computed]


def test_every_computation_computes_a_claim() -> None:
    used = {own.name for claim in CLAIMS for own in claim.computations.values()}
    assert used == COMPUTATIONS.keys()


@pytest.mark.parametrize("name", COMPUTATIONS)
def test_a_computation_is_described_by_a_phrase(name: str) -> None:
    summary = COMPUTATIONS[name].summary
    assert summary
    assert summary == " ".join(summary.split()).rstrip(".")


class Asked(Mapping[str, tuple[Node, ...]]):
    """The sides of the equations, with the ids of those that were asked for."""

    def __init__(self) -> None:
        self.names: set[str] = set()

    def __getitem__(self, name: str) -> tuple[Node, ...]:
        self.names.add(name)
        return LEDGER.sides[name]

    def __iter__(self) -> Iterator[str]:
        return iter(LEDGER.sides)

    def __len__(self) -> int:
        return len(LEDGER.sides)


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.id)
def test_a_computation_takes_the_claims_inputs_and_uses_the_equations_that_it_names(
    claim: Claim,
) -> None:
    point = {name: float(LEDGER.value(name)) for name in claim.input_ids}
    for reading, computation in claim.computations.items():
        parameters = signature(computation.function).parameters.values()
        if not any(parameter.kind is parameter.VAR_KEYWORD for parameter in parameters):
            names = {parameter.name for parameter in parameters}
            assert names - {"ar", "eq", "row", "scheme"} == claim.inputs.keys()
        asked = Asked()
        function = LEDGER.function(claim, reading=reading, equations=Equations(asked))
        function(Floats(), **point)
        assert asked.names == set(computation.equations)


def in_other_units(unit: str) -> float:
    """The factor to units that are 1/2 kg, 1/3 m and 1/5 s."""
    powers = unit_dimension(unit).powers
    return prod(size ** float(power) for size, power in zip((2, 3, 5), powers, strict=True))


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.id)
def test_a_computation_gives_the_claims_unit(claim: Claim) -> None:
    """With every input in other units, the result is the same quantity in these units."""
    point = {name: float(LEDGER.value(name)) for name in claim.input_ids}
    changed = {name: x * in_other_units(LEDGER.unit(name)) for name, x in point.items()}
    for reading in claim.computations:
        function = LEDGER.function(claim, reading=reading)
        expected = float(function(Floats(), **point)) * in_other_units(claim.unit)
        assert float(function(Floats(), **changed)) == pytest.approx(expected, rel=1e-9, abs=0)


@pytest.mark.parametrize("claim", COMPUTED, ids=lambda claim: claim.id)
def test_reals_lie_within_narrow_intervals(claim: Claim) -> None:
    ar = Reals(50)
    point = {name: LEDGER.value(name) for name in claim.input_ids}
    for reading in claim.computations:
        for scheme in Scheme if claim.by_scheme else (Scheme.PUBLISHED,):
            function = LEDGER.function(claim, reading=reading, scheme=scheme)
            real = function(ar, **{name: ar.number(x) for name, x in point.items()})
            value = real if isinstance(real, F) else F(*real.as_integer_ratio())
            low, high = enclose(function, {name: (x, x) for name, x in point.items()}).ends
            assert low <= value <= high
            # Of 30 digits, the sheet's many rows and the verified root's margin leave 15.
            assert high - low <= abs(value) * F(1, 10**15)


def test_the_printed_equation_is_what_is_computed() -> None:
    """With 3 for 2 in Eq. 16 the depth is two thirds of it."""
    misprinted = LEDGER.misprint("eq16-denominator", "3")
    claim = LEDGER.claims["frank-zook-rha"]
    point = {name: float(LEDGER.value(name)) for name in claim.input_ids}
    printed = LEDGER.function(claim)(Floats(), **point)
    changed = misprinted.function(claim)(Floats(), **point)
    assert changed / printed == pytest.approx(2 / 3, rel=1e-14)

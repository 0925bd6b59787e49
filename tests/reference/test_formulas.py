"""Each computation of the ledger: its inputs, its units, its value."""

import re
from fractions import Fraction as F
from inspect import signature
from math import prod

import pytest

from reference.arithmetic import Floats, Reals
from reference.enclosure import enclose
from reference.formulas import FUNCTIONS, computing
from reference.ledger import Claim, load
from reference.units import unit_dimension

LEDGER = load()
COMPUTED = [
    claim
    for claim in LEDGER.claims.values()
    if claim.computation and not claim.computation.restates
]


def test_every_computation_is_a_formula_or_a_function_and_computes_something() -> None:
    computations = LEDGER.computations
    assert len(computations) == len(LEDGER.computation)
    assert FUNCTIONS.keys() == {name for name, own in computations.items() if own.formula is None}
    for name, function in FUNCTIONS.items():
        names = signature(function).parameters
        assert computations[name].by_row == ("row" in names)
        assert computations[name].by_scheme == ("centered" in names)
    assert not [own for own in computations.values() if own.summary.endswith(".")]
    used = {own.name for claim in LEDGER.claims.values() for own in claim.computations.values()}
    assert computations.keys() == used


def in_other_units(unit: str) -> float:
    """The factor to units of which the kilogram, metre and second hold 2, 3 and 5."""
    powers = unit_dimension(unit).powers
    return prod(size ** float(power) for size, power in zip((2, 3, 5), powers, strict=True))


@pytest.mark.parametrize("claim", LEDGER.claims.values(), ids=lambda claim: claim.id)
def test_a_computation_takes_the_claims_inputs_and_gives_its_unit(claim: Claim) -> None:
    """What measures something is the same in other units: each input, and so the result."""
    point = {name: float(LEDGER.value(name)) for name in claim.entries}
    changed = {name: x * in_other_units(LEDGER.unit(name)) for name, x in point.items()}
    for reading, own in claim.computations.items():
        texts = [text for premise in own.premises.values() for text in premise.put.values()]
        named = set(re.findall(r"\w+", " ".join([own.formula or "", *texts])))
        assert own.formula is None or named >= claim.inputs.keys()
        function = LEDGER.function(claim, reading=reading)
        expected = float(function(Floats(), **point)) * in_other_units(claim.unit)
        assert float(function(Floats(), **changed)) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("claim", COMPUTED, ids=lambda claim: claim.id)
def test_reals_lie_within_narrow_intervals(claim: Claim) -> None:
    ar = Reals(50)
    point = {name: LEDGER.value(name) for name in claim.entries}
    for reading in claim.computations:
        for centered in (False, True) if claim.by_scheme else (False,):
            function = LEDGER.function(claim, reading=reading, centered=centered)
            real = function(ar, **{name: ar.number(x) for name, x in point.items()})
            value = real if isinstance(real, F) else F(*real.as_integer_ratio())
            low, high = enclose(function, {name: (x, x) for name, x in point.items()}).ends
            assert low <= value <= high
            # 30 digits, of which the sheet's many rows and the verified root's margin leave 15.
            assert high - low <= abs(value) * F(1, 10**15)


FZ = {"length_ratio": 2 / 3, "particle_density": 8900, "target_density": 7850, "k_1": 0.557,
      "k_t": 1.046, "resistance": 9.13e9, "velocity": 500}  # fmt: skip


def test_lengths_of_equation_16_are_counted_in_diameters() -> None:
    of_radius = LEDGER.misprint("eq16", LEDGER.printed_text("eq16").replace("L/D", "L/R"))
    as_printed = LEDGER.computations["frank_zook_as_printed"]
    longer = {**FZ, "length_ratio": 2 * FZ["length_ratio"]}
    values = [
        computing(as_printed, sides, case)(Floats(), case)
        for sides, case in ((of_radius.sides, FZ), (LEDGER.sides, longer))
    ]
    assert values[0] == values[1]


def test_frank_zook_is_the_integral_of_eqs_14_and_15() -> None:
    """dx/dv = v / (dv/dt), by quadrature over v, with D = 1; X/R is twice X/D."""
    ar = Reals(30)
    case = {
        name: ar.number(F(str(x)) if name != "length_ratio" else F(2, 3)) for name, x in FZ.items()
    }
    inertia = case["length_ratio"] * case["particle_density"] + case["k_1"] * case["target_density"]
    depth = ar.context.quad(
        lambda v: inertia * v / (case["k_t"] * case["target_density"] * v * v + case["resistance"]),
        [0, case["velocity"] / 2, case["velocity"]],
    )
    derived = computing(LEDGER.computations["frank_zook_derived"], LEDGER.sides, case)
    assert abs(derived(ar, case) / (2 * depth) - 1) < 1e-27

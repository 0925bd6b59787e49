"""Each computation by name: its inputs and values, the printed equations that it uses."""

from fractions import Fraction as F
from inspect import signature
from math import prod

import pytest

from reference.arithmetic import Floats, Reals
from reference.computations import COMPUTATIONS, Formulas
from reference.enclosure import enclose
from reference.ledger import Claim, load
from reference.units import unit_dimension

LEDGER = load()
COMPUTED = [
    claim
    for claim in LEDGER.claims.values()
    if claim.computation and not claim.computation.restates
]


@pytest.mark.parametrize("name", COMPUTATIONS)
def test_what_is_said_of_a_computation_is_true(name: str) -> None:
    computation = COMPUTATIONS[name]
    assert computation.summary
    assert not computation.summary.endswith(".")
    assert set(computation.equations) <= set(LEDGER.equations)
    names = signature(computation.function).parameters
    assert computation.by_row == ("row" in names)
    assert computation.by_scheme == ("centered" in names)
    used = {c.name for claim in LEDGER.claims.values() for c in claim.computations.values()}
    assert name in used


def in_other_units(unit: str) -> float:
    """The factor to units of which the kilogram, metre and second hold 2, 3 and 5."""
    powers = unit_dimension(unit).powers
    return prod(size ** float(power) for size, power in zip((2, 3, 5), powers, strict=True))


@pytest.mark.parametrize("claim", LEDGER.claims.values(), ids=lambda claim: claim.id)
def test_a_computation_takes_the_claims_inputs_and_gives_its_unit(claim: Claim) -> None:
    """What measures something is the same in other units: each input, and so the result."""
    point = {name: float(LEDGER.value(name)) for name in claim.entries}
    changed = {name: x * in_other_units(LEDGER.unit(name)) for name, x in point.items()}
    for reading in claim.computations:
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
    printed = LEDGER.printed_text("eq16")
    of_radius = Formulas(Floats(), LEDGER.misprint("eq16", printed.replace("L/D", "L/R")).sides)
    as_printed = COMPUTATIONS["frank_zook_as_printed"].function
    longer = {**FZ, "length_ratio": 2 * FZ["length_ratio"]}
    assert as_printed(of_radius, **FZ) == as_printed(Formulas(Floats(), LEDGER.sides), **longer)


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
    derived = COMPUTATIONS["frank_zook_derived"].function(Formulas(ar, LEDGER.sides), **case)
    assert abs(derived / (2 * depth) - 1) < 1e-27


@pytest.mark.parametrize("claim", COMPUTED, ids=lambda claim: claim.id)
def test_a_computation_uses_the_equations_that_it_names_and_no_others(claim: Claim) -> None:
    """Another equation in the place of a printed one changes the value, or it is not named."""
    point = {name: float(LEDGER.value(name)) for name in claim.entries}
    for reading, computation in claim.computations.items():
        value = LEDGER.function(claim, reading=reading)(Floats(), **point)
        for equation in LEDGER.equations:
            left, _, right = LEDGER.printed_text(equation).rpartition("=")
            changed = LEDGER.misprint(equation, f"{left}= 3 ({right})")
            another = changed.function(claim, reading=reading)(Floats(), **point)
            if value:
                assert (another != value) == (equation in computation.equations), equation

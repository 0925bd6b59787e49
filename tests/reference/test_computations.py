"""Each computation by name: its units, its summary, its value over reals and over intervals."""

from collections.abc import Callable
from fractions import Fraction
from inspect import Parameter, signature
from math import isclose, log, pi, prod, sqrt
from typing import Any

import flint
import mpmath
import pytest

from reference import exact
from reference.computations import COMPUTATIONS, SAME, Computation
from reference.enclosure import evaluate
from reference.exact import Reals
from reference.intervals import Intervals
from reference.ledger import Claim, Ledger, load
from reference.units import to_si

LEDGER = load()
COMPUTED = [claim for claim in LEDGER.claims.values() if claim.computation is not None]

SHEET = {
    "velocity": Fraction(500),
    "radius": Fraction("1.1e-5"),
    "particle_density": Fraction(8900),
    "target_density": Fraction(7850),
    "resistance": Fraction(3_500_000_000),
    "step": Fraction("2e-10"),
}


@pytest.fixture(params=COMPUTATIONS.values(), ids=lambda computation: computation.name)
def computation(request: pytest.FixtureRequest) -> Computation:
    return request.param


def test_the_summary_is_one_line(computation: Computation) -> None:
    assert computation.summary
    assert computation.summary == computation.summary.strip()
    assert not computation.summary.endswith(".")
    assert (computation.function.__doc__ or "").strip() == computation.summary


def test_every_unit_is_known(computation: Computation) -> None:
    for unit in (computation.unit, *computation.inputs.values()):
        assert unit == SAME or to_si(unit)
    if computation.unit == SAME:
        assert SAME in computation.inputs.values()


def test_the_inputs_are_the_parameters(computation: Computation) -> None:
    arithmetic, *rest = signature(computation.function).parameters.values()
    named = {parameter.name for parameter in rest if parameter.kind is not Parameter.VAR_KEYWORD}
    assert arithmetic.annotation is exact.Arithmetic
    assert computation.by_row == ("row" in named)
    assert "row" not in computation.inputs
    if computation.any_number:
        assert not named
        assert len(computation.inputs) == 1
    elif len(named) == len(rest):
        assert named - {"row"} == set(computation.inputs)
    else:  # the others are handed on
        assert named - {"row"} <= set(computation.inputs)


def test_the_name_is_the_function_and_its_key(computation: Computation) -> None:
    assert COMPUTATIONS[computation.name] is computation


def test_each_computation_serves_a_claim_or_a_reading() -> None:
    used = {c.name for claim in COMPUTED for c in (claim.computation, *claim.readings.values())}
    assert used == set(COMPUTATIONS)


# What the ledger asks for


def nominal(ledger: Ledger, name: str) -> Fraction:
    _, _, inferred = name.partition("inferred:")
    if inferred:
        return ledger.inferred[inferred].nominal
    claim = ledger.claims[name]
    return claim.printed.value * claim.si


def inputs_of(claim: Claim) -> dict[str, Fraction]:
    return {
        key: prod((nominal(LEDGER, name) for name in names), start=Fraction(1))
        for key, names in claim.inputs.items()
    }


def real(function: Callable[..., Any], inputs: dict[str, Fraction], digits: int = 50) -> Fraction:
    ar = Reals(digits)
    value = function(ar, **{key: ar.number(value) for key, value in inputs.items()})
    return value if isinstance(value, Fraction) else Fraction(*value.as_integer_ratio())


@pytest.mark.parametrize("claim", COMPUTED, ids=lambda claim: claim.id)
def test_reals_lie_within_narrow_intervals(claim: Claim) -> None:
    inputs = inputs_of(claim)
    for function in claim.functions.values():
        value = real(function, inputs)
        low, high = evaluate(function, {key: (x, x) for key, x in inputs.items()})
        assert low <= value <= high
        # 30 digits, of which the sheet's many rows and the verified root's margin leave 15
        assert high - low <= abs(value) * Fraction(1, 10**15)


@pytest.mark.parametrize("claim", COMPUTED, ids=lambda claim: claim.id)
def test_precision_changes_nothing_that_is_printed(claim: Claim) -> None:
    inputs = inputs_of(claim)
    for function in claim.functions.values():
        few, many = real(function, inputs, 30), real(function, inputs, 60)
        assert abs(few - many) <= abs(many) * Fraction(1, 10**20)


def test_functions_fix_the_row_and_name_the_readings() -> None:
    row_2 = LEDGER.claims["a1-depth-2"]
    (function,) = row_2.functions.values()
    assert real(function, inputs_of(row_2)) == pytest.approx(Fraction("1.5e-7"), rel=1e-3)
    assert set(LEDGER.claims["frank-zook-rha"].functions) == {"", "derived from Eqs. 14 and 15"}
    assert LEDGER.claims["a1-density"].functions == {}


# Values, from plain formulas in doubles


def value(name: str, row: int | None = None, **inputs: Any) -> float:
    function = COMPUTATIONS[name].function
    fixed = {} if row is None else {"row": row}
    ar = Reals(30)
    numbers = {key: ar.number(Fraction(str(text))) for key, text in inputs.items()}
    return float(function(ar, **fixed, **numbers))


@pytest.mark.parametrize(
    ("name", "inputs", "expected"),
    [
        ("same_as", {"value": 7}, 7),
        ("half", {"value": 7}, 3.5),
        ("twice", {"value": 7}, 14),
        ("count", {"a": 5, "b": 5, "c": 9}, 3),
        ("count", {}, 0),
        ("cap_volume_factor", {}, 1 / 3),
        ("cap_volume_power", {}, 2),
        ("cap_volume_offset", {}, 3),
        ("sphere_volume_factor", {}, 4 / 3),
        ("sphere_volume_power", {}, 3),
        ("contact_area_power", {}, 2),
        ("sphere_length_ratio", {}, 2 / 3),
        ("frank_zook_denominator", {}, 1),
        ("frank_zook_denominator_for_diameters", {}, 2),
        ("ratio", {"numerator": 98, "denominator": 30}, 98 / 30),
        ("sphere_volume", {"diameter": 22}, 4 / 3 * pi * 11**3),
        ("crater_normalized_depth", {"volume_ratio": "1/2"}, 1),
        ("crater_depth", {"volume_ratio": "1/2", "diameter": 22}, 11),
        ("crater_depth_over_diameter", {"volume_ratio": "1/2"}, 0.5),
        ("contact_diameter", {"normalized_depth": 1, "diameter": 22}, 22),
        ("contact_diameter", {"normalized_depth": 0, "diameter": 22}, 0),
        ("contact_diameter", {"normalized_depth": "0.4", "diameter": 10}, 8),
        ("target_resistance", {"beta": 5, "flow_stress": 700}, 3500),
        ("goodier_beta", {"q": "2.77"}, 4 * 2.77 / pi),
        (
            "walker_anderson_alpha",
            {"elastic_modulus": 200_000, "flow_stress": 215},
            (2 * 200_000 / 3 / 215) ** (1 / 3),
        ),
        (
            "walker_anderson_beta",
            {"elastic_modulus": 200_000, "flow_stress": 215},
            7 / 3 * log((2 * 200_000 / 3 / 215) ** (1 / 3)),
        ),
        ("strain_rate", {"velocity": 500, "length": "2e-5"}, 2.5e7),
        (
            "particle_mass",
            {"radius": "1.1e-5", "particle_density": 8900},
            4 / 3 * pi * 1.1e-5**3 * 8900,
        ),
    ],
)
def test_values(name: str, inputs: dict[str, Any], expected: float) -> None:
    # A few roundings of doubles, on the right.
    assert isclose(value(name, **inputs), expected, rel_tol=2e-15)


@pytest.mark.parametrize(
    ("q", "modulus", "hardness", "least", "greatest"),
    [
        ("2.77", 200_000, 3, "hardness", "walker"),
        ("2.77", 200_000, 9, "goodier", "hardness"),
        ("9", 200_000, 3, "hardness", "goodier"),
        ("9", 200_000, 8, "walker", "goodier"),
        ("2", 200_000, 4, "goodier", "walker"),
        ("4", 200_000, "5.05", "walker", "goodier"),
        ("4", 200_000, 8, "walker", "hardness"),
    ],
)
def test_least_and_greatest_beta(
    q: str, modulus: int, hardness: Any, least: str, greatest: str
) -> None:
    betas = {
        "goodier": value("goodier_beta", q=q),
        "walker": value("walker_anderson_beta", elastic_modulus=modulus, flow_stress=215),
        "hardness": float(hardness),
    }
    assert min(betas, key=betas.__getitem__) == least  # the table above means what it says
    assert max(betas, key=betas.__getitem__) == greatest
    inputs = {"q": q, "elastic_modulus": modulus, "flow_stress": 215, "hardness_ratio": hardness}
    assert value("least_beta", **inputs) == betas[least]
    assert value("greatest_beta", **inputs) == betas[greatest]


@pytest.mark.parametrize("row", [1, 2, 7])
def test_row_computations_pick_their_row_and_column(row: int) -> None:
    ar = Reals(30)
    rows = exact.midpoint(ar, **{key: ar.number(x) for key, x in SHEET.items()})
    expected = [next(rows) for _ in range(row)][-1]
    assert value("row_time", row, step="2e-10") == float(expected.time)
    for column in ("velocity_initial", "depth", "deceleration", "velocity_final"):
        found = value(f"row_{column}", row, **SHEET)
        assert found == float(getattr(expected, column))


def test_nothing_decelerates_at_the_touch() -> None:
    inputs = {key: x for key, x in SHEET.items() if key != "step"}
    assert value("deceleration_at_touch", **inputs) == 0
    # ... and the deceleration of a first row tends to it as the step does
    decelerations = [
        value("row_deceleration", 1, **{**SHEET, "step": step}) for step in ("2e-12", "2e-14")
    ]
    assert isclose(decelerations[0] / decelerations[1], 100, rel_tol=1e-3)


def test_sheet_results_are_the_last_depth_in_their_own_terms() -> None:
    inputs = {**SHEET, "stop_velocity": 1}
    depth = value("sheet_depth", **inputs)
    assert isclose(value("sheet_normalized_depth", **inputs), depth / 1.1e-5, rel_tol=1e-14)
    over = value("sheet_over_observed", **inputs, observed="0.3")
    assert isclose(over, depth / 1.1e-5 / 0.3, rel_tol=1e-14)
    excess = value("sheet_excess_over_observed", **inputs, observed="0.3")
    assert isclose(excess, over - 1, rel_tol=1e-14)


def test_the_sheet_ends_near_the_energy_integral_and_nearer_with_a_smaller_step() -> None:
    ar = Reals(30)
    energy = exact.final_depth(
        ar, **{key: ar.number(x) for key, x in SHEET.items() if key != "step"}
    )
    depth = value("sheet_depth", **SHEET, stop_velocity=1)
    assert abs(depth - float(energy)) < 500 * 2e-10 / 2  # half of the first step
    finer = value("sheet_depth", **{**SHEET, "step": "5e-11"}, stop_velocity="1/4")
    assert abs(finer - float(energy)) < abs(depth - float(energy))


def test_frank_zook_by_hand() -> None:
    inputs = {
        "length_ratio": "2/3",
        "particle_density": 8900,
        "target_density": 7850,
        "k_1": "0.557",
        "k_t": "1.046",
        "resistance": 9_130_000_000,
        "velocity": 500,
    }
    eq_16 = (2 / 3 * 8900 / 7850 + 0.557) / (2 * 1.046) * log(1 + 1.046 * 7850 * 500**2 / 9.13e9)
    assert isclose(value("frank_zook_as_printed", **inputs), eq_16, rel_tol=1e-14)
    assert isclose(value("frank_zook_derived", **inputs), 2 * eq_16, rel_tol=1e-14)


def test_the_depth_of_a_third_has_the_contact_diameter_of_its_chord() -> None:
    third = value("contact_diameter", normalized_depth="1/3", diameter=22)
    assert isclose((third / 2) ** 2 + (11 - 11 / 3) ** 2, 11**2, rel_tol=1e-14)
    assert isclose(third, 22 * sqrt(5) / 3, rel_tol=1e-14)


def test_powers_that_are_none_are_errors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(exact, "cap_volume", lambda depth, radius: depth**2 + radius)
    with pytest.raises(ArithmeticError, match="is not a power of two"):
        COMPUTATIONS["sphere_volume_power"].function(Reals(20))


def test_computations_leave_global_precision_alone() -> None:
    before = mpmath.mp.dps, flint.ctx.prec
    ar = Intervals(20)
    COMPUTATIONS["walker_anderson_beta"].function(
        ar, elastic_modulus=ar.number(9), flow_stress=ar.number(2)
    )
    assert (mpmath.mp.dps, flint.ctx.prec) == before

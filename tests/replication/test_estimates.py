"""The other models of the depth, and the estimates for arrays: by hand, and in their limits."""

import math
import re
from collections.abc import Callable
from dataclasses import fields
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

import replication
from reference import computations, inverse
from reference.arithmetic import Number, Reals
from reference.equations import Equations
from reference.ledger import load
from replication.cases import BETA_3, BETA_5, DEPTH_MODELS, modelled
from replication.models import estimates
from replication.models.alternatives import ConstantPressure, DepthModel

LEDGER = load()
PRINTED = Equations(LEDGER.sides)
REALS = Reals(400)  # enough for 1 + p with a p of 1e-250


@pytest.mark.parametrize(
    ("name", "given", "ratio"),
    [
        # ln(1 + 2.0528/9.13) = 0.20281, (2/3 8900/7850 + 0.557) / (2 1.046) = 0.62755
        pytest.param("frank-zook", {}, 0.2545, id="armor, from Eqs. 14 and 15"),
        pytest.param("frank-zook-printed", {}, 0.1273, id="armor, by Eq. 16"),
        # ln(1 + 2.0528/7.6) = 0.23910
        pytest.param("frank-zook", {"resistance": 7.6e9}, 0.3001, id="stainless steel"),
        # CV/PV = 8900 500^2 / (2 3.5e9) = 0.31786 = 0.7521^2 (3 - 0.7521) / 4
        pytest.param("constant-pressure", {}, 0.7521, id="constant pressure"),
        pytest.param("rigid", {}, 0.6977, id="rigid, the closed form beside the sheet's 7.67 um"),
    ],
)
def test_the_reports_case_by_every_model(name: str, given: dict[str, float], ratio: float) -> None:
    assert modelled(name, BETA_5, given).model.normalized_depth == pytest.approx(ratio, abs=5e-5)


def test_a_model_has_its_own_resistance_whatever_the_case_has() -> None:
    armor = float(LEDGER.value("fz-resistance-rha"))
    for case in (BETA_3, BETA_5):
        assert modelled("frank-zook", case).model.resistance == armor
        assert modelled("rigid", case).model.resistance == case.target_resistance


@pytest.mark.parametrize("name", DEPTH_MODELS)
def test_every_input_says_where_it_is_from(name: str) -> None:
    given = {"resistance": 2e9}
    case = modelled(name, BETA_5, given)
    assert [*case.sources] == [field.name for field in fields(case.model)]
    assert case.sources["resistance"] == "given"
    assert case.sources["velocity"] == "case"
    claims = {key: claim for key, claim in DEPTH_MODELS[name].own.items() if key not in given}
    for key, claim in claims.items():
        assert case.sources[key] == f"{claim}: {LEDGER.claims[claim].place}"


@pytest.mark.parametrize(
    ("name", "given", "message"),
    [
        ("tate", {}, "there is no model 'tate': choose one of rigid, constant-pressure, "
         "frank-zook, frank-zook-printed"),
        ("rigid", {"k_1": 0.5}, "the model rigid takes no 'k_1': choose one of resistance"),
        ("frank-zook", {"k_t": -1.0}, "k_t is -1.0: it must be a finite number greater than zero"),
        ("frank-zook", {"k_t": 1e50}, "k_t is 1e+50: it is computed with from 1e-40 to 1e+40"),
    ],
)  # fmt: skip
def test_what_a_model_does_not_take(name: str, given: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        modelled(name, BETA_5, given)


def test_a_model_must_say_its_depth() -> None:
    model = DepthModel(velocity=1.0, radius=1.0, particle_density=1.0, resistance=1.0)
    with pytest.raises(NotImplementedError):
        model.normalized_depth  # noqa: B018


def test_the_forms_of_frank_and_zook() -> None:
    inputs = (500.0, 11e-6, 8900.0, 7850.0, 9.13e9, 2 / 3, 0.557, 1.046)
    derived, printed = (
        replication.frank_zook_depth(*inputs, form=f) for f in ("derived", "printed")
    )
    assert (derived, derived) == (2 * printed, replication.frank_zook_depth(*inputs))
    with pytest.raises(ValueError, match=r"^there is no form 'Eq\. 16': choose one of derived, pr"):
        replication.frank_zook_depth(*inputs, form="Eq. 16")


@given(st.floats(50, 2000), st.floats(1e3, 2e4), st.floats(1e8, 1e10))
def test_a_constant_pressure_is_the_limit_of_a_target_without_density(
    velocity: float, density: float, resistance: float
) -> None:
    limit = ConstantPressure(
        velocity=velocity, radius=1.0, particle_density=density, resistance=resistance
    )
    # By the target's density the depth falls by half of p = rho_t V^2 / 2 R_t at most: 2e-14 here.
    light = replication.final_depth(velocity, 1.0, density, 1e-12, resistance)
    assert light == pytest.approx(limit.final_depth, rel=1e-13)
    assert replication.final_depth(velocity, 1.0, density, 1e3, resistance) < limit.final_depth


@given(st.floats(1e-9, 1e3), st.floats(1e-9, 1.0))
def test_a_crater_has_the_depth_that_gave_its_volume(y: float, radius: float) -> None:
    """Eqs. 2 and 3 both ways; d ln depth / d ln volume is 1 at most."""
    ratio = replication.crater_volume_ratio(y * radius, radius)
    assert replication.crater_depth(ratio, radius) == pytest.approx(y * radius, rel=1e-14)


def test_volumes_of_craters_by_hand() -> None:
    """A hemisphere is half a sphere; a cylinder R long below it is 3/4 of a sphere."""
    assert replication.crater_volume_ratio([11e-6, 22e-6], 11e-6).tolist() == [0.5, 1.25]
    assert replication.crater_depth([0.5, 1.25]).tolist() == [1.0, 2.0]


@pytest.mark.parametrize(
    ("strength", "threshold"),
    [
        (90e6, math.sqrt(2 * (3.5e9 - 90e6) / 8900)),
        (0.0, math.sqrt(2 * 3.5e9 / 8900)),
        (3.5e9, 0.0),
        (4e9, 0.0),
    ],
)
def test_a_particle_penetrates_above_a_threshold_unless_it_is_stronger_than_the_target(
    strength: float, threshold: float
) -> None:
    """Eq. 5 with u = 0."""
    assert replication.penetration_threshold(strength, 3.5e9, 8900.0) == threshold
    stress = 8900.0 * threshold**2 / 2 + strength
    assert stress == pytest.approx(max(3.5e9, strength), rel=1e-15)


def test_betas_of_section_3() -> None:
    alpha = replication.walker_anderson_alpha(200e9, 215e6)
    assert f"{replication.goodier_beta(2.77):.1f}" == LEDGER.claims["goodier-beta"].text
    assert f"{alpha:.1f}" == LEDGER.claims["walker-anderson-alpha"].text
    beta = replication.walker_anderson_beta([alpha])
    assert beta.tolist() == [estimates.walker_anderson_beta(alpha)]
    assert f"{beta[0]:.1f}" == LEDGER.claims["walker-anderson-beta"].text


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: replication.goodier_beta([2.77, -1.0]),
         "q_over_flow_stress[1] is -1.0: it must be a finite number greater than zero"),
        (lambda: replication.crater_depth(1e41),
         "volume_ratio is 1e+41: it is computed with from 1e-40 to 1e+40"),
        (lambda: replication.penetration_threshold(-1.0, 3.5e9, 8900.0),
         "particle_strength is -1.0: it must be a finite number, zero or more"),
        (lambda: replication.constant_pressure_depth(500.0, 11e-6, 8900.0, [3.5e9, 0.0]),
         "target resistance[1] is 0.0: nothing would bring the particle to rest (with velocity "
         "500.0, radius 1.1e-05, particle_density 8900.0, resistance 0.0)"),
    ],
)  # fmt: skip
def test_bad_inputs_of_estimates(call: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        call()


# In many digits, by the reference package where it has the formula


def crater_depth(volume_ratio: Number, radius: Number) -> Number:
    return radius * inverse.depth_of_area_integral(REALS, 4 * volume_ratio / 3)


def crater_volume_ratio(depth: Number, radius: Number) -> Number:
    return 3 * inverse.area_integral(REALS, depth / radius) / 4


def goodier_beta(q_over_flow_stress: Number) -> Number:
    return computations.goodier_beta(REALS, PRINTED, q_over_flow_stress, Fraction(2))


def walker_anderson_alpha(elastic_modulus: Number, flow_stress: Number) -> Number:
    return computations.walker_anderson_alpha(REALS, PRINTED, elastic_modulus, flow_stress)


def walker_anderson_beta(alpha: Number) -> Number:
    return PRINTED["eq10"](REALS, alpha=alpha)


def penetration_threshold(
    particle_strength: Number, resistance: Number, particle_density: Number
) -> Number:
    """Eq. 5 with u = 0: rho_p v^2 / 2 + Y_p = R_t."""
    lacking = REALS.greatest(resistance - particle_strength, REALS.number(0))
    return REALS.power(2 * lacking / particle_density, Fraction(1, 2))


def constant_pressure_depth(
    velocity: Number, radius: Number, particle_density: Number, resistance: Number
) -> Number:
    """R_t CV = rho_p PV V^2 / 2."""
    return crater_depth(particle_density * velocity**2 / (2 * resistance), radius)


def frank_zook_depth(
    velocity: Number, radius: Number, particle_density: Number, target_density: Number,
    resistance: Number, length_ratio: Number, k_1: Number, k_t: Number,
) -> Number:  # fmt: skip
    inputs = length_ratio, particle_density, target_density, k_1, k_t, velocity, resistance
    return radius * computations.frank_zook_derived(REALS, *inputs)


MAGNITUDES = st.floats(-30, 30).map(lambda power: 10.0**power)
"""Of any unit; for these no product of eight inputs leaves the range of doubles."""


@pytest.mark.parametrize(
    ("model", "exact", "inputs", "error"),
    [
        (replication.crater_depth, crater_depth, 2, 1e-15),
        (replication.crater_volume_ratio, crater_volume_ratio, 2, 1e-15),
        (replication.goodier_beta, goodier_beta, 1, 1e-15),
        (replication.walker_anderson_alpha, walker_anderson_alpha, 2, 1e-15),
        (replication.walker_anderson_beta, walker_anderson_beta, 1, 1e-15),
        (replication.penetration_threshold, penetration_threshold, 3, 1e-15),
        (replication.constant_pressure_depth, constant_pressure_depth, 4, 1e-15),
        # Twelve roundings of 2^-53 each are 1.3e-15; the others have nine at most.
        (replication.frank_zook_depth, frank_zook_depth, 8, 2e-15),
    ],
)  # fmt: skip
@given(data=st.data())
def test_estimates_hold_the_digits_that_they_promise(
    model: Callable[..., float],
    exact: Callable[..., Number],
    inputs: int,
    error: float,
    data: st.DataObject,
) -> None:
    values = [data.draw(MAGNITUDES) for _ in range(inputs)]
    # Where a formula changes, or loses digits if it is written badly, both inputs are alike.
    if inputs in (2, 3) and data.draw(st.booleans()):
        values[0] = values[1] * data.draw(st.floats(0.25, 4))
    expected = exact(*map(REALS.number, map(Fraction, values)))
    assert abs(REALS.number(Fraction(model(*values))) - expected) <= abs(expected) * error
    assert f"below {error:g}" in " ".join((model.__doc__ or "").split())

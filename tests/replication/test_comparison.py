"""The approaches side by side, what the depth depends on, and what scatter does to it."""

from dataclasses import replace
from fractions import Fraction
from statistics import NormalDist

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.exact import Reals, final_depth
from replication.analysis.approaches import Approach, approaches
from replication.analysis.scatter import SHARES, scatter, stated_deviations, tied_particles
from replication.analysis.sensitivity import (
    INPUTS,
    elasticities,
    stated_effects,
    ten_percent_effects,
)

from reference.ledger import load
from replication.audit import assess_claim
from replication.cases import BETA_3, BETA_5
from replication.models import arrays
from replication.models.impact import Impact

OBSERVED = 0.29803390509065253
CLAIMS = (
    "observed-depth-ratio",
    "ratio-beta-3",
    "ratio-beta-5",
    "frank-zook-rha",
    "frank-zook-stainless",
)


@pytest.fixture(scope="module")
def rows() -> list[Approach]:
    ledger = load()
    return approaches(ledger, {name: assess_claim(ledger, name) for name in CLAIMS})


def test_every_approach_of_the_report_stands_in_the_table(rows: list[Approach]) -> None:
    kinds = [row.kind for row in rows]
    counts = {kind: kinds.count(kind) for kind in kinds}
    assert counts == {"observed": 2, "sheet": 2, "exact": 2, "Frank-Zook": 4, "hydrocode": 2}
    by_name = {f"{row.kind}, {row.name}": row.computed for row in rows}
    assert by_name["observed, CV/PV = 0.058, the line in Figure 1"] == pytest.approx(0.29274, 1e-4)
    assert by_name["Frank-Zook, armor, as printed"] == pytest.approx(0.12727, abs=5e-6)


def test_hydrocodes_are_quoted_and_marked_so(rows: list[Approach]) -> None:
    quoted = {row.name: row.printed for row in rows if not row.recomputable}
    assert quoted == {"CTH": "0.41", "Autodyne": "0.52"}
    assert all(row.computed is None for row in rows if not row.recomputable)


impacts = st.builds(
    Impact,
    velocity=st.floats(1, 5000),
    radius=st.floats(1e-7, 1e-2),
    particle_density=st.floats(500, 25000),
    target_density=st.floats(500, 25000),
    beta=st.floats(1, 8),
    flow_stress=st.floats(1e7, 5e9),
)


@given(impacts, st.sampled_from(INPUTS))
def test_elasticities_are_the_slopes_of_the_reference(impact: Impact, name: str) -> None:
    ar = Reals(50)
    if abs(float(arrays.final_depth(**impact.motion)) / impact.radius - 1) < 1e-6:
        return  # the second derivative jumps at y = 1, so that differences across it are coarser

    def log_depth(share: mpmath.mpf) -> mpmath.mpf:
        inputs = {key: ar.number(Fraction(getattr(impact, key))) for key in INPUTS}
        inputs[name] *= ar.context.exp(share)
        resistance = inputs.pop("beta") * inputs.pop("flow_stress")
        return ar.context.log(final_depth(ar, **inputs, resistance=resistance))

    h = ar.context.mpf(10) ** -12
    slope = (log_depth(h) - log_depth(-h)) / (2 * h)
    # The difference is off by its h^2, the closed form by rounding, most where q - 1 cancels.
    assert elasticities(impact)[name] == pytest.approx(float(slope), rel=1e-9, abs=1e-12)


def test_depth_is_proportional_to_size_and_the_ratio_does_not_depend_on_it() -> None:
    assert elasticities(BETA_5)["radius"] == 1.0
    (effect,) = (e for e in ten_percent_effects(BETA_5) if e.input == "radius")
    assert effect.ratios[0] == pytest.approx(effect.ratios[1], rel=1e-14)
    assert effect.depths[1] / effect.depths[0] == pytest.approx(1.1 / 0.9, rel=1e-14)


def test_stated_ranges_come_from_the_ledger() -> None:
    effects = {effect.input: effect for effect in stated_effects(BETA_5, load())}
    assert set(effects) == set(INPUTS)
    assert (effects["velocity"].low, effects["velocity"].high) == (450.0, 550.0)
    assert (effects["beta"].low, effects["beta"].high) == (3.0, 5.0)
    assert all(claim in load().claims for e in effects.values() for claim in e.sources)
    assert all(e.sources for e in effects.values())


def test_no_stated_range_alone_brings_the_depth_down_to_the_observed() -> None:
    for case in (BETA_3, BETA_5):
        lowest = min(min(effect.ratios) for effect in stated_effects(case, load()))
        assert lowest > 2 * OBSERVED


def test_quantiles_of_the_ratio_are_those_of_the_velocity() -> None:
    deviations = stated_deviations(load())
    _, independent = scatter(BETA_5, deviations, OBSERVED)
    whole = NormalDist(500.0, deviations["velocity"])
    for share, quantile in zip(SHARES, independent.ratio.quantiles, strict=True):
        there = replace(BETA_5, velocity=whole.inv_cdf(share))
        exact = float(arrays.final_depth(**there.motion)) / there.radius
        # Linear interpolation between points 0.04 deviations apart.
        assert quantile == pytest.approx(exact, rel=1e-4)


def test_tied_quantiles_are_those_of_the_size() -> None:
    tied, _ = scatter(BETA_5, stated_deviations(load()), OBSERVED)
    sizes = NormalDist(22e-6, 5.6e-6)
    for share, quantile in zip(SHARES, tied.velocity.quantiles, strict=True):
        assert quantile == pytest.approx(500 * (22e-6 / sizes.inv_cdf(1 - share)) ** 1.5, rel=3e-4)


def test_depths_of_independent_particles_against_drawn_ones() -> None:
    deviations = stated_deviations(load())
    _, independent = scatter(BETA_5, deviations, OBSERVED)
    random = np.random.default_rng(1)
    radius = random.normal(11e-6, deviations["diameter"] / 2, 200_000)
    velocity = random.normal(500.0, deviations["velocity"], 200_000)
    kept = (radius > 0) & (velocity > 0)
    depths = arrays.final_depth(velocity[kept], radius[kept], 8900.0, 7850.0, 3.5e9)
    # 200,000 draws tell a quantile to about 0.2 % in the middle, 0.4 % at the ends.
    drawn = np.quantile(depths, SHARES)
    assert np.allclose(independent.depth.quantiles, drawn, rtol=0.01)


def test_small_scatter_is_linear() -> None:
    for one in scatter(BETA_5, {"diameter": 22e-9, "velocity": 0.5}, OBSERVED):
        for spread in (one.depth, one.ratio, one.velocity):
            relative = spread.deviation / spread.quantiles[2]
            assert relative == pytest.approx(spread.first_order, rel=2e-3)


def test_the_velocity_for_the_observed_depth_gives_it() -> None:
    tied, independent = scatter(BETA_3, stated_deviations(load()), OBSERVED)
    needed = tied.velocity_for_observed
    there = replace(BETA_3, velocity=needed)
    assert float(arrays.final_depth(**there.motion)) / 11e-6 == pytest.approx(OBSERVED, 1e-13)
    assert independent.velocity_for_observed == needed
    assert independent.share_below_observed < 1e-6


def test_equation_1_sends_small_particles_far_above_the_stated_scatter() -> None:
    small, large, *_ = tied_particles(BETA_5, load())
    assert (small.diameter, large.diameter) == (10e-6, 30e-6)
    assert small.velocity == pytest.approx(500 * 2.2**1.5, rel=1e-14)
    assert large.velocity == pytest.approx(500 * (22 / 30) ** 1.5, rel=1e-14)
    tied, _ = scatter(BETA_5, stated_deviations(load()), OBSERVED)
    assert tied.velocity.deviation > 3 * stated_deviations(load())["velocity"]

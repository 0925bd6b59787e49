"""The approaches side by side, what the depth depends on, and what scatter does to it."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise, product
from statistics import NormalDist

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.ledger import load
from reference.motion import Trajectory
from replication.audit import comparison
from replication.audit.record import Level, Record
from replication.cases import BETA_5, CASES
from replication.models import depth
from replication.models.impact import Impact
from replication.models.sheet import SCHEMES, run

INPUTS = ("velocity", "radius", "particle_density", "target_density", "beta", "flow_stress")


def ratio(impact: Impact) -> float:
    return depth.final_depth(**impact.motion) / impact.radius


IMPACTS = st.builds(
    Impact,
    velocity=st.floats(1, 5000),
    radius=st.floats(1e-7, 1e-2),
    particle_density=st.floats(500, 25000),
    target_density=st.floats(500, 25000),
    beta=st.floats(1, 8),
    flow_stress=st.floats(1e7, 5e9),
)


@given(IMPACTS, st.sampled_from(INPUTS))
def test_elasticities_are_the_slopes_of_the_reference(impact: Impact, name: str) -> None:
    if abs(ratio(impact) - 1) < 1e-6:
        return  # the second derivative jumps at y = 1, so that differences across it are coarser
    h = Fraction(1, 10**12)

    def log_depth(share: Fraction) -> mpmath.mpf:
        inputs = {key: Fraction(getattr(impact, key)) for key in INPUTS}
        inputs[name] *= 1 + share
        resistance = inputs.pop("beta") * inputs.pop("flow_stress")
        return mpmath.log(Trajectory(**inputs, resistance=resistance, digits=50).final_depth)

    with mpmath.workdps(50):
        slope = (log_depth(h) - log_depth(-h)) / 2 * h.denominator
    # The difference is off by its h^2, the closed form by rounding, most where q - 1 cancels.
    assert comparison._elasticities(impact)[name] == pytest.approx(
        float(slope), rel=1e-9, abs=1e-12
    )


def test_quantiles_of_each_law(record: Record) -> None:
    laws = {law.law.partition(":")[0]: law for law in record.scatter}
    sizes = NormalDist(22, 5.6)
    for law, power in (("Eq. 1", 1.5), ("drag on a sphere", 0.5)):
        points = laws[law]
        for share, velocity, own in zip(
            points.shares, points.velocities, points.ratios, strict=True
        ):
            size = sizes.inv_cdf(1 - share)
            assert velocity == pytest.approx(500 * (22 / size) ** power, rel=1e-14)
            assert own == ratio(replace(BETA_5, velocity=velocity))
        small = 22 - 1e-4, 22 + 1e-4  # the law's own slope at the mean size
        faster, slower = (500 * (22 / size) ** power for size in small)
        slope = (faster - slower) / (small[1] - small[0])
        assert laws[law].standard_deviation == pytest.approx(slope * 5.6, rel=1e-9)


def test_each_step_of_the_sheets_error_is_half_of_the_last(record: Record) -> None:
    ladders = {(beta, scheme): list[Level]() for beta, scheme in product((3.0, 5.0), SCHEMES)}
    for level in record.ladders:
        ladders[level.beta, level.scheme].append(level)
    for (beta, scheme), levels in ladders.items():
        assert BETA_5.step in [level.step for level in levels]
        assert all(fine.step == coarse.step / 2 for coarse, fine in pairwise(levels))
        for level in levels:
            sheet = run(replace(CASES[f"beta-{beta:.0f}"], step=level.step), scheme)
            assert (level.depth, level.steps) == (sheet.final_depth, sheet.steps)


def test_figure_5_is_drawn_from_end_to_end(record: Record) -> None:
    ledger, curve = load(), record.velocity_curve
    ends = ("figure-5-velocity-least", "figure-5-velocity-greatest")
    assert [curve.velocity[0], curve.velocity[-1]] == [float(ledger.value(end)) for end in ends]

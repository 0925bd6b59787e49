"""The contents of the record besides verdicts: approaches to X/R, sensitivity, scatter, curves.

In a report with a misprint an input may make no sense, such as a velocity of zero. What cannot be
computed then is None, or left out of its list.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from math import isfinite
from statistics import NormalDist

from reference.ledger import READ_AS_PRINTED, Convention
from reference.scheme import Scheme
from replication.audit import record as r
from replication.audit.inference import DENSITY
from replication.audit.particle_sizes import Law, diameter_power, velocity_by_size
from replication.audit.results import (
    DERIVED,
    Results,
    case,
    constant_pressure_ratio,
    exact_ratio,
    of_beta,
)
from replication.models import depth, motion, sheet
from replication.models.crater import normalized_depth_from_volume_ratio
from replication.models.impact import Impact, InputError
from replication.text import with_unit

BETAS = (3, 5)

_NO_VALUE = (ArithmeticError, InputError)
"""What the models raise if an input makes no sense."""


def _value(compute: Callable[[], float]) -> float | None:
    """Return a computed number, or None if it has no value or no finite one."""
    try:
        value = compute()
    except _NO_VALUE:
        return None
    return value if isfinite(value) else None


def approaches(results: Results) -> list[r.Approach]:
    """Return X/R [1] by every approach of the report, and by one without the target's inertia."""
    claims = results.ledger.claims

    def of_case(
        kind: str, beta: int, compute: Callable[[Impact], float], claim: str | None = None
    ) -> r.Approach:
        return r.Approach(
            kind=kind, name=of_beta(results, beta), beta=beta,
            computed=_value(lambda: compute(case(results, beta))),
            claim=claim, shown=claims[claim].shown if claim else "",
        )  # fmt: skip

    def of_claim(kind: str, name: str, claim: str, reading: str = READ_AS_PRINTED) -> r.Approach:
        return r.Approach(
            kind=kind, name=name, claim=claim, shown=claims[claim].shown,
            computed=_value(lambda: results.reading(claim, reading).computed),
        )  # fmt: skip

    def of_code(name: str, claim: str) -> r.Approach:
        return r.Approach(kind="hydrocode", name=name, claim=claim, shown=claims[claim].shown)

    def in_sheet(impact: Impact) -> float:
        return sheet.run(impact).normalized_depth

    drawn, taken = (claims[name].text for name in ("volume-ratio-line", "volume-ratio"))
    line = results["volume-ratio-line"]
    armor, stainless = "frank-zook-rha", "frank-zook-stainless"
    return [
        r.Approach(
            kind="observed", name=f"CV/PV = {drawn}, the line in Figure 1",
            computed=_value(lambda: normalized_depth_from_volume_ratio(line)),
        ),
        of_claim("observed", f"CV/PV = {taken}, as taken for Eq. 4", "observed-depth-ratio"),
        *(of_case("sheet", beta, in_sheet, f"ratio-beta-{beta}") for beta in BETAS),
        *(of_case("exact", beta, exact_ratio) for beta in BETAS),
        *(of_case("constant pressure", beta, constant_pressure_ratio) for beta in BETAS),
        of_claim("Frank-Zook", "armor, Eq. 16 as printed", armor),
        of_claim("Frank-Zook", "armor, Eqs. 14 and 15", armor, DERIVED),
        of_claim("Frank-Zook", "stainless steel, Eq. 16 as printed", stainless),
        of_claim("Frank-Zook", "stainless steel, Eqs. 14 and 15", stainless, DERIVED),
        of_code("CTH", "cth-ratio"),
        of_code("Autodyne", "autodyne-ratio"),
    ]  # fmt: skip


# How the depth depends on its inputs


def sensitivity(results: Results) -> list[r.Sensitivity]:
    """Return how the exact final depth of both cases of the report depends on each input.

    The dependence is given by elasticities, and by the depths at both ends of the uncertainty that
    the report or its evidence states for an input.
    """
    shown = []
    for beta in BETAS:
        with suppress(*_NO_VALUE):
            shown.append(_sensitivity(results, beta))
    return shown


def _sensitivity(results: Results, beta: int) -> r.Sensitivity:
    impact = case(results, beta)
    by_input = depth.elasticities(
        impact.velocity, impact.particle_density, impact.target_density, impact.target_resistance
    )
    # The resistance is the product of beta and the flow stress, so both have its elasticity.
    by_input |= dict.fromkeys(("beta", "flow_stress"), by_input.pop("resistance"))
    spread, size = results["velocity-deviation"], results["diameter-deviation"] / 2
    printed = results.ledger.claims["a1-density"].target().ends
    chosen = (results.ledger.claims[name] for name in ("a1-initial-velocity", "a-step"))
    exact = ", ".join(with_unit(claim.shown, claim.unit) for claim in chosen)
    betas = results["beta-range-least"], results["beta-range-greatest"]
    strengths = results["strength-clear"], results["strength-feathery"]
    possible = results.judge.inference(DENSITY).admitted(Convention()).ends
    ranges = (
        ("velocity", impact.velocity - spread, impact.velocity + spread,
         "mean deviation in the stream"),
        ("radius", impact.radius - size, impact.radius + size, "standard deviation of the powder"),
        ("particle_density", *printed, "rounding of the print"),
        ("target_density", *possible, f"bounds by Table A-1 with the sphere's mass at {exact}"),
        ("beta", *betas, "the report's range"),
        ("flow_stress", *strengths, "two grain strengths"),
    )  # fmt: skip

    stated = []
    for name, low, high, why in ranges:
        with suppress(*_NO_VALUE):
            stated.append(_effect(impact, name, float(low), float(high), why))
    return r.Sensitivity(
        beta=float(beta),
        depth=depth.final_depth(**impact.motion),
        elasticities=by_input,
        stated=stated,
    )


def _effect(impact: Impact, name: str, low: float, high: float, why: str) -> r.Effect:
    """Return the exact final depth and X/R with one input at both ends of its range (SI)."""
    at_ends = [replace(impact, **{name: end}) for end in (low, high)]
    return r.Effect(
        input=name, low=low, high=high, why=why,
        depths=[depth.final_depth(**changed.motion) for changed in at_ends],
        ratios=[exact_ratio(changed) for changed in at_ends],
    )  # fmt: skip


# The scatter of the particle stream

SHARES = 0.05, 0.5, 0.95
"""The shares of the particles whose quantiles of velocity and X/R are given."""


def scatter(results: Results) -> list[r.Scatter]:
    """Return the quantiles of velocity and exact X/R (beta = 5) over the stream, by three laws.

    By two laws, Eq. 1 and the drag on a sphere, the velocity is a power of the particle's diameter,
    which is normally distributed. By the third the velocity itself is, with the "mean deviation"
    that the report states, taken literally as the mean absolute deviation.
    """
    shown = []
    with suppress(*_NO_VALUE):
        shown.append(_scatter_by_size(results, "Eq. 1: mass alone", Law.EQ_1))
    with suppress(*_NO_VALUE):
        shown.append(_scatter_by_size(results, "drag on a sphere: mass and area", Law.DRAG))
    with suppress(*_NO_VALUE):
        shown.append(_scatter_as_stated(results))
    return shown


_MEAN_TO_STANDARD = NormalDist().pdf(0) * 2
"""The mean deviation of a normal distribution over its standard deviation."""


def _scatter_by_size(results: Results, name: str, law: Law) -> r.Scatter:
    """Return the quantiles over particles whose diameters are normally distributed."""
    size, deviation, z = results["mean-diameter"], results["diameter-deviation"], _quantile
    average = results["a1-initial-velocity"]
    sizes = [size + deviation * z(1 - share) for share in SHARES]  # a small one is fast
    velocities = [velocity_by_size(results, average, diameter, law) for diameter in sizes]
    to_first_order = float(diameter_power(results, law)) * (deviation / size) * average
    return _scatter(results, name, to_first_order, velocities)


def _scatter_as_stated(results: Results) -> r.Scatter:
    """Return the quantiles over particles whose velocities are normally distributed."""
    average = results["a1-initial-velocity"]
    spread = results["velocity-deviation"] / _MEAN_TO_STANDARD
    velocities = [average + spread * _quantile(share) for share in SHARES]
    return _scatter(results, "as stated: normal", spread, velocities)


def _quantile(share: float) -> float:
    """Return the quantile of the normal distribution with mean 0 and standard deviation 1."""
    return NormalDist().inv_cdf(share)


def _scatter(results: Results, name: str, spread: float, velocities: list[float]) -> r.Scatter:
    """Return the exact X/R at these quantiles of the velocity [m/s], for beta = 5."""
    impacts = [case(results, 5, velocity=velocity) for velocity in velocities]
    return r.Scatter(
        law=name, standard_deviation=spread, mean_deviation=spread * _MEAN_TO_STANDARD,
        shares=list(SHARES), velocities=velocities, ratios=list(map(exact_ratio, impacts)),
    )  # fmt: skip


# The sheet and the exact motion


def curves(results: Results) -> list[r.Curve]:
    """Return depth against time, as in Figure 3: the sheet's rows and the exact motion to rest."""
    shown = []
    for beta in BETAS:
        with suppress(*_NO_VALUE):
            shown.append(_curve(results, beta))
    return shown


def _curve(results: Results, beta: int) -> r.Curve:
    """Return depth against time for one case of the report."""
    impact = case(results, beta)
    rows = sheet.run(impact).rows
    stop = motion.stop_time(**impact.motion)
    times = [stop * k / 100 for k in range(101)]
    depths, speeds = [0.0] * 101, [0.0] * 101
    motion.history(times, **impact.motion, depth=depths, speed=speeds)
    return r.Curve(
        beta=float(beta), sheet_time=[row.time for row in rows],
        sheet_depth=[row.depth for row in rows], exact_time=times, exact_depth=depths,
        shown=results.ledger.claims[f"depth-beta-{beta}"].shown,
    )  # fmt: skip


def velocity_curve(results: Results) -> r.VelocityCurve:
    """Return X/R against impact velocity, as in Figure 5: of the sheet and exact, for beta = 5."""
    low, high = results["figure-5-velocity-least"], results["figure-5-velocity-greatest"]
    velocities, in_sheet, exact = [], [], []
    for k in range(21):
        with suppress(*_NO_VALUE):
            impact = case(results, 5, velocity=low + (high - low) * k / 20)
            ratios = sheet.run(impact).normalized_depth, exact_ratio(impact)
            velocities.append(impact.velocity)
            in_sheet.append(ratios[0])
            exact.append(ratios[1])
    return r.VelocityCurve(velocity=velocities, sheet=in_sheet, exact=exact)


def ladders(results: Results) -> list[r.Level]:
    """Return the sheet's error against its time step, halved repeatedly, in both schemes."""
    shown = []
    for beta in BETAS:
        for scheme in Scheme:
            for halvings in range(-4, 3):
                with suppress(*_NO_VALUE):
                    shown.append(_level(results, beta, scheme, halvings))
    return shown


def _level(results: Results, beta: int, scheme: Scheme, halvings: int) -> r.Level:
    """Return the sheet's error with the report's time step halved so many times."""
    impact = case(results, beta, step=results["a-step"] * 2.0**-halvings)
    run, exact = sheet.run(impact, scheme), depth.final_depth(**impact.motion)
    return r.Level(
        beta=float(beta), scheme=scheme, step=impact.step, steps=run.steps,
        depth=run.final_depth, error=run.final_depth - exact,
    )  # fmt: skip

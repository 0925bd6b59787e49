"""The contents of the record besides verdicts: approaches to X/R, sensitivity, scatter, curves.

In a report with a misprint an input may make no sense, such as a velocity of zero. What cannot be
computed then is None, or left out of its list.
"""

from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import product
from math import isfinite
from statistics import NormalDist
from typing import Any, TypeVar

from reference.ledger import Convention
from reference.scheme import Scheme
from replication.audit import record as r
from replication.audit.inference import DENSITY
from replication.audit.results import DERIVED, Results, case, exact_ratio
from replication.models import depth, motion, sheet
from replication.models.crater import crater_depth, normalized_depth_from_volume_ratio
from replication.models.impact import InputError
from replication.text import with_unit

BETAS = (3, 5)

_Part = TypeVar("_Part")


def _value(compute: Callable[..., float], *arguments: Any) -> float | None:
    """Return a computed number, or None if it has no value or no finite one."""
    values = _parts(compute, [arguments])
    return values[0] if values and isfinite(values[0]) else None


def _parts(compute: Callable[..., _Part], rows: Iterable[tuple[Any, ...]]) -> list[_Part]:
    """Return the result for each row of arguments, leaving out rows that give none."""
    parts = []
    for row in rows:
        with suppress(ArithmeticError, InputError):
            parts.append(compute(*row))
    return parts


def approaches(results: Results) -> list[r.Approach]:
    """Return X/R [1] by every approach of the report, and by one without the target's inertia."""
    claims = results.ledger.claims

    def approach(
        kind: str, name: str, claim: str = "", *computation: Any, beta: int | None = None
    ) -> r.Approach:
        return r.Approach(
            kind=kind, name=name, beta=beta,
            computed=_value(*computation) if computation else None,
            claim=claim or None, shown=claims[claim].shown if claim else "",
        )  # fmt: skip

    def of_case(
        kind: str, beta: int, compute: Callable[[int], float], claim: str = ""
    ) -> r.Approach:
        return approach(kind, f"beta = {beta}", claim, compute, beta, beta=beta)

    def in_sheet(beta: int) -> float:
        return sheet.run(case(results, beta)).normalized_depth

    def exact(beta: int) -> float:
        return exact_ratio(case(results, beta))

    def cratered(beta: int) -> float:
        """X/R at the constant pressure R_t: the work R_t CV is the energy rho_p PV V^2 / 2."""
        impact = case(results, beta)
        energy = impact.particle_density * impact.velocity**2 / 2
        return crater_depth(energy / impact.target_resistance)

    def computed(claim: str, reading: str = "") -> float:
        return results.reading(claim, reading).computed

    observed, line = "observed-depth-ratio", results["volume-ratio-line"]
    drawn, taken = (claims[name].text for name in ("volume-ratio-line", "volume-ratio"))
    targets = ("armor", "frank-zook-rha"), ("stainless steel", "frank-zook-stainless")
    forms = ("Eq. 16 as printed", ""), ("Eqs. 14 and 15", DERIVED)
    return [
        approach("observed", f"CV/PV = {drawn}, the line in Figure 1", "",
                 normalized_depth_from_volume_ratio, line),
        approach("observed", f"CV/PV = {taken}, as taken for Eq. 4", observed, computed, observed),
        *(of_case("sheet", beta, in_sheet, f"ratio-beta-{beta}") for beta in BETAS),
        *(of_case("exact", beta, exact) for beta in BETAS),
        *(of_case("constant pressure", beta, cratered) for beta in BETAS),
        *(approach("Frank-Zook", f"{target}, {form}", claim, computed, claim, reading)
          for (target, claim), (form, reading) in product(targets, forms)),
        approach("hydrocode", "CTH", "cth-ratio"),
        approach("hydrocode", "Autodyne", "autodyne-ratio"),
    ]  # fmt: skip


# How the depth depends on its inputs


def sensitivity(results: Results) -> list[r.Sensitivity]:
    """Return how the exact final depth of both cases of the report depends on each input.

    The dependence is given by elasticities, and by the depths at both ends of the uncertainty that
    the report or its evidence states for an input.
    """
    return _parts(partial(_sensitivity, results), product(BETAS))


def _sensitivity(results: Results, beta: int) -> r.Sensitivity:
    impact = case(results, beta)
    velocity, radius = impact.velocity, impact.radius
    by_input = depth.elasticities(
        velocity, impact.particle_density, impact.target_density, impact.target_resistance
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
        ("velocity", velocity - spread, velocity + spread, "mean deviation in the stream"),
        ("radius", radius - size, radius + size, "standard deviation of the powder"),
        ("particle_density", *printed, "rounding of the print"),
        ("target_density", *possible, f"bounds by Table A-1 with the sphere's mass at {exact}"),
        ("beta", *betas, "the report's range"),
        ("flow_stress", *strengths, "two grain strengths"),
    )

    def effect(name: str, low: float, high: float, why: str) -> r.Effect:
        at_ends = [replace(impact, **{name: float(end)}) for end in (low, high)]
        return r.Effect(
            input=name, low=float(low), high=float(high), why=why,
            depths=[depth.final_depth(**changed.motion) for changed in at_ends],
            ratios=[exact_ratio(changed) for changed in at_ends],
        )  # fmt: skip

    return r.Sensitivity(
        beta=float(beta),
        depth=depth.final_depth(**impact.motion),
        elasticities=by_input,
        stated=_parts(effect, ranges),
    )


# The scatter of the particle stream

SHARES = 0.05, 0.5, 0.95
"""The shares of the particles whose quantiles of velocity and X/R are given."""


def scatter(results: Results) -> list[r.Scatter]:
    """Return the quantiles of velocity and exact X/R (beta = 5) over the stream, by three laws.

    By two laws, Eq. 1 and the drag on a sphere, the velocity is a power of the particle's diameter,
    which is normally distributed. By the third the velocity itself is, with the "mean deviation"
    that the report states, taken literally as the mean absolute deviation.
    """
    size, deviation = results["mean-diameter"], results["diameter-deviation"]
    mean_to_standard = NormalDist().pdf(0) * 2  # the ratio of the two deviations
    z = NormalDist().inv_cdf

    def law(name: str, power: float | None) -> r.Scatter:
        impact = case(results, 5)
        if power is None:
            spread = results["velocity-deviation"] / mean_to_standard
            velocities = [impact.velocity + spread * z(share) for share in SHARES]
        else:
            spread = power * (deviation / size) * impact.velocity
            sizes = (size + deviation * z(1 - share) for share in SHARES)
            velocities = [impact.velocity * (size / diameter) ** power for diameter in sizes]
        return r.Scatter(
            law=name, standard_deviation=spread, mean_deviation=spread * mean_to_standard,
            shares=list(SHARES), velocities=velocities,
            ratios=[exact_ratio(replace(impact, velocity=v)) for v in velocities],
        )  # fmt: skip

    laws = (
        ("Eq. 1: mass alone", 3 * results["eq1-power"]),  # a mass grows with the diameter's cube
        ("drag on a sphere: mass and area", 0.5),
        ("as stated: normal", None),
    )
    return _parts(law, laws)


# The sheet and the exact motion


def curves(results: Results) -> list[r.Curve]:
    """Return depth against time, as in Figure 3: the sheet's rows and the exact motion to rest."""

    def curve(beta: int) -> r.Curve:
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

    return _parts(curve, product(BETAS))


def velocity_curve(results: Results) -> r.VelocityCurve:
    """Return X/R against impact velocity, as in Figure 5: of the sheet and exact, for beta = 5."""
    low, high = results["figure-5-velocity-least"], results["figure-5-velocity-greatest"]

    def point(k: int) -> tuple[float, float, float]:
        impact = case(results, 5, velocity=low + (high - low) * k / 20)
        return impact.velocity, sheet.run(impact).normalized_depth, exact_ratio(impact)

    points = _parts(point, product(range(21)))
    velocity, in_sheet, exact = ([point[k] for point in points] for k in range(3))
    return r.VelocityCurve(velocity=velocity, sheet=in_sheet, exact=exact)


def ladders(results: Results) -> list[r.Level]:
    """Return the sheet's error against its time step, halved repeatedly, in both schemes."""

    def level(beta: int, scheme: Scheme, k: int) -> r.Level:
        impact = case(results, beta, step=results["a-step"] * 2.0**k)
        run, exact = sheet.run(impact, scheme), depth.final_depth(**impact.motion)
        return r.Level(
            beta=float(beta), scheme=scheme, step=impact.step, steps=run.steps,
            depth=run.final_depth, error=run.final_depth - exact,
        )  # fmt: skip

    return _parts(level, product(BETAS, Scheme, range(4, -3, -1)))

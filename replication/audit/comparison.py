"""What the record holds besides verdicts: all approaches to X/R, sensitivity, scatter, curves.

In a report with a misprint some inputs have no meaning, such as a velocity of zero: what cannot be
computed with them is None, or left out of its list.
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
from replication.audit import record as r
from replication.audit.findings import DENSITY, DERIVED, Known, case, exact_ratio
from replication.models import depth, motion, sheet
from replication.models.crater import crater_depth, depth_from_volume_ratio
from replication.models.impact import InputError
from replication.text import quantity, with_unit

BETAS = (3, 5)

_Part = TypeVar("_Part")


def _value(compute: Callable[..., float], *row: Any) -> float | None:
    """What is computed from a row of arguments, if it has a meaning."""
    values = _parts(compute, [row])
    return values[0] if values and isfinite(values[0]) else None


def _parts(compute: Callable[..., _Part], rows: Iterable[tuple[Any, ...]]) -> list[_Part]:
    """What is computed from each row of arguments, as far as it has a meaning."""
    parts = []
    for row in rows:
        with suppress(ArithmeticError, InputError):
            parts.append(compute(*row))
    return parts


def approaches(known: Known) -> list[r.Approach]:
    """Every approach to X/R [1] of the report, and one that leaves out the target's inertia."""
    claims = known.ledger.claims

    def computed(claim: str, reading: str = "") -> float:
        return known.reading(claim, reading).computed

    def in_sheet(beta: int) -> float:
        return sheet.run(case(known, beta)).normalized_depth

    def exact(beta: int) -> float:
        return exact_ratio(case(known, beta))

    def cratered(beta: int) -> float:
        """X/R at the constant pressure R_t: the work R_t CV is the energy rho_p PV V^2 / 2."""
        impact = case(known, beta)
        energy = impact.particle_density * impact.velocity**2 / 2
        return crater_depth(energy / impact.target_resistance)

    line = partial(depth_from_volume_ratio, known["volume-ratio-line"])
    drawn, taken = (claims[name].text for name in ("volume-ratio-line", "volume-ratio"))
    forms = (("Eq. 16 as printed", ""), ("Eqs. 14 and 15", DERIVED))
    rows: list[tuple[str, str, Callable[[], float] | None, str]] = [
        ("observed", f"CV/PV = {drawn}, the line in Figure 1", line, ""),
        ("observed", f"CV/PV = {taken}, as taken for Eq. 4",
         partial(computed, "observed-depth-ratio"), "observed-depth-ratio"),
        *((kind, f"beta = {beta}", partial(ratio, beta), claim and f"{claim}-{beta}")
          for kind, ratio, claim in (("sheet", in_sheet, "ratio-beta"), ("exact", exact, ""),
                                     ("constant pressure", cratered, ""))
          for beta in BETAS),
        *(("Frank-Zook", f"{name}, {form}", partial(computed, claim, reading), claim)
          for name, claim in (("armor", "frank-zook-rha"),
                              ("stainless steel", "frank-zook-stainless"))
          for form, reading in forms),
        ("hydrocode", "CTH", None, "cth-ratio"),
        ("hydrocode", "Autodyne", None, "autodyne-ratio"),
    ]  # fmt: skip
    return [
        r.Approach(kind=kind, name=name, computed=compute and _value(compute), claim=claim or None,
                   printed=claims[claim].shown if claim else "")
        for kind, name, compute, claim in rows
    ]  # fmt: skip


def figures(known: Known) -> list[r.Figure]:
    """What the remark can be judged by: the final depths at both steps, in both schemes."""

    def deep(beta: int, scheme: str, step: str) -> float:
        return sheet.run(case(known, beta, step=known[step]), scheme).final_depth

    def micrometers(beta: int, scheme: str, step: str) -> float:
        return deep(beta, scheme, step) * 1e6

    def change(beta: int, scheme: str) -> float:
        return 100 * (deep(beta, scheme, "coarse-step") / deep(beta, scheme, "a-step") - 1)

    figures = []
    for beta, (scheme, (_, drag_at)) in product(BETAS, sheet.SCHEMES.items()):
        what = f"beta = {beta}, drag at the {drag_at} velocity"
        for step in ("a-step", "coarse-step"):
            means = f"final depth at {quantity(known.ledger.claims[step].shown, 'ns')}, {what}"
            value = _value(micrometers, beta, scheme, step)
            figures.append(r.Figure(means=means, value=value, unit="um"))
        value = _value(change, beta, scheme)
        figures.append(r.Figure(means=f"change, {what}", value=value, unit="percent"))
    return figures


# What the depth depends on


def sensitivity(known: Known) -> list[r.Sensitivity]:
    """How the exact depth of the report's cases depends on each input.

    By derivatives, and over the uncertainty that the report or its evidence gives of each input.
    """
    return _parts(partial(_sensitivity, known), product(BETAS))


def _sensitivity(known: Known, beta: int) -> r.Sensitivity:
    impact = case(known, beta)
    velocity, radius, *materials = impact.motion.values()
    by_input = depth.elasticities(velocity, *materials)
    # The resistance is the product of beta and the flow stress.
    by_input |= dict.fromkeys(("beta", "flow_stress"), by_input.pop("resistance"))
    spread, size = known["velocity-deviation"], known["diameter-deviation"] / 2
    printed = known.ledger.claims["a1-density"].target().ends
    chosen = (known.ledger.claims[name] for name in ("a1-initial-velocity", "a-step"))
    exact = ", ".join(with_unit(claim.shown, claim.unit) for claim in chosen)
    possible = known.judge.inference(DENSITY).admitted(Convention()).ends
    ranges = (
        ("velocity", velocity - spread, velocity + spread, "mean deviation in the stream"),
        ("radius", radius - size, radius + size, "standard deviation of the powder"),
        ("particle_density", *printed, "rounding of the print"),
        ("target_density", *possible, f"bounds by Table A-1 with the sphere's mass at {exact}"),
        ("beta", known["beta-range-least"], known["beta-range-greatest"], "the report's range"),
        ("flow_stress", known["strength-clear"], known["strength-feathery"], "two grain strengths"),
    )

    def effect(name: str, low: float, high: float, why: str) -> r.Effect:
        cases = [replace(impact, **{name: float(end)}) for end in (low, high)]
        depths = [depth.final_depth(**case.motion) for case in cases]
        ratios = [x / case.radius for x, case in zip(depths, cases, strict=True)]
        ends = {"low": float(low), "high": float(high)}
        return r.Effect(input=name, **ends, depths=depths, ratios=ratios, why=why)

    return r.Sensitivity(
        beta=float(beta),
        depth=depth.final_depth(**impact.motion),
        elasticities=by_input,
        stated=_parts(effect, ranges),
    )


# What scatter does

SHARES = 0.05, 0.5, 0.95
"""Shares of the particles of the stream, at which velocity and X/R are given."""


def scatter(known: Known) -> list[r.Scatter]:
    """Velocity and exact X/R (beta = 5) over the particles of the stream, by three laws.

    By Eq. 1, and by drag on a sphere, a particle's velocity follows from its size, which is
    normally distributed; by the third law the velocity has the deviation that the report states.
    "Mean deviation" is taken literally, as the mean absolute deviation.
    """
    size, deviation = known["mean-diameter"], known["diameter-deviation"]
    mean = NormalDist().pdf(0) * 2  # mean absolute deviation over standard deviation
    z = NormalDist().inv_cdf

    def law(name: str, power: float | None) -> r.Scatter:
        impact = case(known, 5)
        if power is None:
            spread = known["velocity-deviation"] / mean
            velocities = [impact.velocity + spread * z(share) for share in SHARES]
        else:
            spread = power * (deviation / size) * impact.velocity
            sizes = (size + deviation * z(1 - share) for share in SHARES)
            velocities = [impact.velocity * (size / diameter) ** power for diameter in sizes]
        return r.Scatter(
            law=name, standard_deviation=spread, mean_deviation=spread * mean, shares=list(SHARES),
            velocities=velocities,
            ratios=[exact_ratio(replace(impact, velocity=v)) for v in velocities],
        )  # fmt: skip

    laws = (
        ("Eq. 1: mass alone", 1.5),
        ("drag on a sphere: mass and area", 0.5),
        ("as stated: normal", None),
    )
    return _parts(law, laws)


# The sheet and the exact motion


def curves(known: Known) -> list[r.Curve]:
    """Depth against time, as in Figure 3: the sheet's rows, and the exact motion to rest."""

    def curve(beta: int) -> r.Curve:
        impact = case(known, beta)
        rows = sheet.run(impact).rows
        stop = motion.stop_time(**impact.motion)
        times = [stop * k / 100 for k in range(101)]
        depths, speeds = [0.0] * 101, [0.0] * 101
        motion.history(times, **impact.motion, depth=depths, speed=speeds)
        return r.Curve(
            beta=float(beta), sheet_time=[row.time for row in rows],
            sheet_depth=[row.depth for row in rows], exact_time=times, exact_depth=depths,
            printed=known.ledger.claims[f"depth-beta-{beta}"].shown,
        )  # fmt: skip

    return _parts(curve, product(BETAS))


def velocity_curve(known: Known) -> r.VelocityCurve:
    """X/R against impact velocity, as in Figure 5: the sheet's and the exact one, for beta = 5."""
    low, high = known["figure-5-velocity-least"], known["figure-5-velocity-greatest"]

    def point(k: int) -> tuple[float, float, float]:
        impact = case(known, 5, velocity=low + (high - low) * k / 20)
        return impact.velocity, sheet.run(impact).normalized_depth, exact_ratio(impact)

    points = _parts(point, product(range(21)))
    velocity, in_sheet, exact = ([point[k] for point in points] for k in range(3))
    return r.VelocityCurve(velocity=velocity, sheet=in_sheet, exact=exact)


def ladders(known: Known) -> list[r.Level]:
    """The sheet's error against its time step, in both schemes, each step half of the last."""

    def level(beta: int, scheme: str, k: int) -> r.Level:
        impact = case(known, beta, step=known["a-step"] * 2.0**k)
        run, exact = sheet.run(impact, scheme), depth.final_depth(**impact.motion)
        return r.Level(
            beta=float(beta), scheme=scheme, step=impact.step, steps=run.steps,
            depth=run.final_depth, error=run.final_depth - exact,
        )  # fmt: skip

    return _parts(level, product(BETAS, sheet.SCHEMES, range(4, -3, -1)))

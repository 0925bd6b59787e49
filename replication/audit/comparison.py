"""What stands beside the verdicts: all approaches, what the depth depends on, what scatter does."""

import math
from contextlib import suppress
from dataclasses import replace
from statistics import NormalDist

from reference.ledger import Convention
from replication.audit import record as r
from replication.audit.findings import Known, case, constant_pressure_ratio, exact_ratio
from replication.models import depth, motion, sheet, stream
from replication.models.crater import depth_from_volume_ratio
from replication.models.impact import Impact

BETAS = (3, 5)


def approaches(known: Known) -> list[r.Approach]:
    """Every approach to X/R [1] of the report, and one that prices the target's inertia."""
    claims = known.ledger.claims

    def computed(kind: str, name: str, claim: str, reading: str = "") -> r.Approach:
        printed, value = claims[claim].shown, None
        with suppress(ArithmeticError):  # a formula without a value, in a report with a misprint
            value = known.reading(claim, reading).computed
        return r.Approach(kind=kind, name=name, computed=value, printed=printed, claim=claim)

    def quoted(name: str, claim: str) -> r.Approach:
        return r.Approach(kind="hydrocode", name=name, printed=claims[claim].shown, claim=claim)

    line = depth_from_volume_ratio(known["volume-ratio-line"])
    drawn, taken = (claims[name].text for name in ("volume-ratio-line", "volume-ratio"))
    armor, stainless = "frank-zook-rha", "frank-zook-stainless"
    forms = (("Eq. 16 as printed", ""), ("Eqs. 14 and 15", "derived from Eqs. 14 and 15"))
    models = [(beta, case(known, beta)) for beta in BETAS]
    return [
        r.Approach(kind="observed", name=f"CV/PV = {drawn}, the line in Figure 1", computed=line),
        computed("observed", f"CV/PV = {taken}, as taken for Eq. 4", "observed-depth-ratio"),
        *(r.Approach(kind="sheet", name=f"beta = {beta}",
                     computed=sheet.run(impact).normalized_depth,
                     printed=claims[f"ratio-beta-{beta}"].shown, claim=f"ratio-beta-{beta}")
          for beta, impact in models),
        *(r.Approach(kind="exact", name=f"beta = {beta}", computed=exact_ratio(impact))
          for beta, impact in models),
        *(r.Approach(kind="constant pressure", name=f"beta = {beta}",
                     computed=constant_pressure_ratio(impact)) for beta, impact in models),
        *(computed("Frank-Zook", f"{name}, {form}", claim, reading)
          for name, claim in (("armor", armor), ("stainless steel", stainless))
          for form, reading in forms),
        quoted("CTH", "cth-ratio"),
        quoted("Autodyne", "autodyne-ratio"),
    ]  # fmt: skip


# What the depth depends on


def sensitivity(known: Known, beta: int) -> r.Sensitivity:
    """How the exact depth of one of the report's cases depends on each input."""
    impact = case(known, beta)
    return r.Sensitivity(
        beta=float(beta),
        depth=depth.final_depth(**impact.motion),
        elasticities=_elasticities(impact),
        stated=_stated(known, impact),
    )


_INPUTS = ("velocity", "radius", "particle_density", "target_density", "beta", "flow_stress")


def _elasticities(impact: Impact) -> dict[str, float]:
    """d ln X / d ln input: so many percent of depth for one percent of the input.

    With c = (4 rho_p / 3 rho_t) ln(1 + p), p = rho_t V^2 / 2 R_t, and y^2 - y^3/3 = c (beyond R
    dy = dc): d ln y = s d ln c, where s = c / (y^2 (2 - y)), c/y beyond R; and
    d ln ln(1 + p) = q d ln p, where q = p / ((1 + p) ln(1 + p)).
    """
    p = impact.target_density * impact.velocity**2 / (2 * impact.target_resistance)
    c = 4 / 3 * impact.particle_density / impact.target_density * math.log1p(p)
    y = exact_ratio(impact)
    s = c / (y * y * (2 - y)) if y < 1 else c / y
    q = p / ((1 + p) * math.log1p(p))
    factors = (2 * q * s, 1.0, s, (q - 1) * s, -q * s, -q * s)
    return dict(zip(_INPUTS, factors, strict=True))


def _stated(known: Known, impact: Impact) -> list[r.Effect]:
    """What each input's own uncertainty does, as far as the report or its evidence states one."""
    possible = known.judge.inference("inferred:target-density").admitted(Convention())[1].ends
    velocity, spread = impact.velocity, known["velocity-deviation"]
    radius, size = impact.radius, known["diameter-deviation"] / 2
    density = known.ledger.claims["a1-density"].target().ends
    ranges = (
        ("velocity", velocity - spread, velocity + spread, "mean deviation in the stream"),
        ("radius", radius - size, radius + size, "standard deviation of the powder"),
        (
            "particle_density",
            *density,
            "rounding of the print",
        ),
        ("target_density", *possible, "all that Table A-1 allows"),
        ("beta", known["beta-range-least"], known["beta-range-greatest"], "the report's range"),
        ("flow_stress", known["strength-clear"], known["strength-feathery"], "two hardnesses"),
    )
    effects = []
    for name, low, high, why in ranges:
        ends = [replace(impact, **{name: float(end)}) for end in (low, high)]
        depths = [depth.final_depth(**end.motion) for end in ends]
        effects.append(
            r.Effect(input=name, low=float(low), high=float(high), depths=depths, why=why,
                     ratios=[x / end.radius for x, end in zip(depths, ends, strict=True)])
        )  # fmt: skip
    return effects


# What scatter does


SHARES = 0.05, 0.5, 0.95
"""Of the particles of the stream."""


def scatter(known: Known) -> list[r.Scatter]:
    """Velocity and exact X/R (beta = 5) over the particles of the stream, by three laws.

    By Eq. 1 and by drag on a sphere a particle's velocity follows from its size, which is normally
    distributed; by the third its deviation is the one that the report states. A "mean deviation" is
    taken as what it says, the mean absolute one.
    """
    impact = case(known, 5)
    size = NormalDist(known["mean-diameter"], known["diameter-deviation"])
    mean = NormalDist().pdf(0) * 2  # mean absolute deviation over the standard one
    stated = NormalDist(impact.velocity, known["velocity-deviation"] / mean)

    def by_eq1(share: float) -> float:
        diameter = size.inv_cdf(1 - share)
        return stream.particle_velocity(impact.velocity, diameter**3, size.mean**3)

    def by_drag(share: float) -> float:
        return impact.velocity * math.sqrt(size.mean / size.inv_cdf(1 - share))

    relative = size.stdev / size.mean
    laws = (
        ("Eq. 1: mass alone", by_eq1, 1.5 * relative * impact.velocity),
        ("drag on a sphere: mass and area", by_drag, 0.5 * relative * impact.velocity),
        ("as stated: normal", stated.inv_cdf, stated.stdev),
    )
    result = []
    for name, law, deviation in laws:
        velocities = [law(share) for share in SHARES]
        ratios = [exact_ratio(replace(impact, velocity=v)) for v in velocities]
        result.append(
            r.Scatter(law=name, standard_deviation=deviation, mean_deviation=deviation * mean,
                      shares=list(SHARES), velocities=velocities, ratios=ratios)
        )  # fmt: skip
    return result


# The sheet and the exact motion


def curves(known: Known) -> list[r.Curve]:
    """Depth against time, as in Figure 3: the sheet's rows, and the exact motion to rest."""
    drawn = []
    for beta in BETAS:
        impact = case(known, beta)
        rows = sheet.run(impact).rows
        stop = motion.stop_time(**impact.motion)
        times = [stop * k / 100 for k in range(101)]
        depths, speeds = [0.0] * 101, [0.0] * 101
        motion.history(times, **impact.motion, depth=depths, speed=speeds)
        drawn.append(
            r.Curve(
                beta=float(beta),
                sheet_time=[row.time for row in rows],
                sheet_depth=[row.depth for row in rows],
                exact_time=times,
                exact_depth=depths,
                printed=known.ledger.claims[f"depth-beta-{beta}"].shown,
            )
        )
    return drawn


def velocity_curve(known: Known) -> r.VelocityCurve:
    """X/R against impact velocity, as in Figure 5: the sheet's and the exact one, for beta = 5."""
    low, high = known["figure-5-velocity-least"], known["figure-5-velocity-greatest"]
    velocities = [low + (high - low) * k / 20 for k in range(21)]
    cases = [replace(case(known, 5), velocity=v) for v in velocities]
    return r.VelocityCurve(
        velocity=velocities,
        sheet=[sheet.run(impact).normalized_depth for impact in cases],
        exact=[exact_ratio(impact) for impact in cases],
    )


def ladders(known: Known) -> list[r.Level]:
    """The sheet's error against its time step, in both schemes, each step half of the last."""
    levels = []
    for beta in BETAS:
        exact = depth.final_depth(**case(known, beta).motion)
        for scheme in sheet.SCHEMES:
            for k in range(4, -3, -1):
                impact = case(known, beta, step=known["a-step"] * 2.0**k)
                run = sheet.run(impact, scheme)
                levels.append(
                    r.Level(beta=float(beta), scheme=scheme, step=impact.step, steps=run.steps,
                          depth=run.final_depth, error=run.final_depth - exact)
                )  # fmt: skip
    return levels

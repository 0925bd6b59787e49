"""What the record holds besides verdicts: all approaches to X/R, sensitivity, scatter, curves."""

from dataclasses import replace
from itertools import product
from statistics import NormalDist

from reference.ledger import Convention
from replication.audit import record as r
from replication.audit.findings import DENSITY, DERIVED, Known, case, exact_ratio
from replication.models import depth, motion, sheet
from replication.models.crater import crater_depth, depth_from_volume_ratio
from replication.models.impact import Impact
from replication.text import with_unit

BETAS = (3, 5)


def approaches(known: Known) -> list[r.Approach]:
    """Every approach to X/R [1] of the report, and one that leaves out the target's inertia."""
    claims = known.ledger.claims

    def computed(claim: str, reading: str = "") -> float | None:
        try:
            return known.reading(claim, reading).computed
        except ArithmeticError:  # a formula without a value, in a report with a misprint
            return None

    line = depth_from_volume_ratio(known["volume-ratio-line"])
    drawn, taken = (claims[name].text for name in ("volume-ratio-line", "volume-ratio"))
    forms = (("Eq. 16 as printed", ""), ("Eqs. 14 and 15", DERIVED))
    models = {beta: case(known, beta) for beta in BETAS}

    def cratered(impact: Impact) -> float:
        """X/R at the constant pressure R_t: the work R_t CV is the energy rho_p PV V^2 / 2."""
        energy = impact.particle_density * impact.velocity**2 / 2
        return crater_depth(energy / impact.target_resistance)

    rows = [
        ("observed", f"CV/PV = {drawn}, the line in Figure 1", line, ""),
        ("observed", f"CV/PV = {taken}, as taken for Eq. 4", computed("observed-depth-ratio"),
         "observed-depth-ratio"),
        *(("sheet", f"beta = {beta}", sheet.run(impact).normalized_depth, f"ratio-beta-{beta}")
          for beta, impact in models.items()),
        *(("exact", f"beta = {beta}", exact_ratio(impact), "") for beta, impact in models.items()),
        *(("constant pressure", f"beta = {beta}", cratered(impact), "")
          for beta, impact in models.items()),
        *(("Frank-Zook", f"{name}, {form}", computed(claim, reading), claim)
          for name, claim in (("armor", "frank-zook-rha"),
                              ("stainless steel", "frank-zook-stainless"))
          for form, reading in forms),
        ("hydrocode", "CTH", None, "cth-ratio"),
        ("hydrocode", "Autodyne", None, "autodyne-ratio"),
    ]  # fmt: skip
    return [
        r.Approach(kind=kind, name=name, computed=value, claim=claim or None,
                   printed=claims[claim].shown if claim else "")
        for kind, name, value, claim in rows
    ]  # fmt: skip


# What the depth depends on


def sensitivity(known: Known, beta: int) -> r.Sensitivity:
    """How the exact depth of one of the report's cases depends on each input.

    By derivatives, and over the uncertainty that the report or its evidence gives of each input.
    """
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
    stated = []
    for name, low, high, why in ranges:
        cases = [replace(impact, **{name: float(end)}) for end in (low, high)]
        depths = [depth.final_depth(**case.motion) for case in cases]
        ratios = [x / case.radius for x, case in zip(depths, cases, strict=True)]
        ends = {"low": float(low), "high": float(high)}
        stated.append(r.Effect(input=name, **ends, depths=depths, ratios=ratios, why=why))
    return r.Sensitivity(
        beta=float(beta),
        depth=depth.final_depth(**impact.motion),
        elasticities=by_input,
        stated=stated,
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
    impact = case(known, 5)
    size = NormalDist(known["mean-diameter"], known["diameter-deviation"])
    mean = NormalDist().pdf(0) * 2  # mean absolute deviation over standard deviation
    stated = NormalDist(impact.velocity, known["velocity-deviation"] / mean)

    laws = []
    for name, power in (("Eq. 1: mass alone", 1.5), ("drag on a sphere: mass and area", 0.5)):
        sizes = (size.inv_cdf(1 - share) for share in SHARES)
        velocities = [impact.velocity * (size.mean / diameter) ** power for diameter in sizes]
        laws.append((name, power * (size.stdev / size.mean) * impact.velocity, velocities))
    laws.append(("as stated: normal", stated.stdev, [stated.inv_cdf(share) for share in SHARES]))
    return [
        r.Scatter(law=name, standard_deviation=deviation, mean_deviation=deviation * mean,
                  shares=list(SHARES), velocities=velocities,
                  ratios=[exact_ratio(replace(impact, velocity=v)) for v in velocities])
        for name, deviation, velocities in laws
    ]  # fmt: skip


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
            r.Curve(beta=float(beta), sheet_time=[row.time for row in rows],
                    sheet_depth=[row.depth for row in rows], exact_time=times, exact_depth=depths,
                    printed=known.ledger.claims[f"depth-beta-{beta}"].shown)
        )  # fmt: skip
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
    for beta, scheme, k in product(BETAS, sheet.SCHEMES, range(4, -3, -1)):
        impact = case(known, beta, step=known["a-step"] * 2.0**k)
        run, exact = sheet.run(impact, scheme), depth.final_depth(**impact.motion)
        levels.append(
            r.Level(beta=float(beta), scheme=scheme, step=impact.step, steps=run.steps,
                    depth=run.final_depth, error=run.final_depth - exact)
        )  # fmt: skip
    return levels

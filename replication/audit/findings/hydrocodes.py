"""Findings on the hydrocodes Autodyne and CTH, with which the report compares (section 4)."""

from math import log, sqrt

from replication.audit.findings.evidence import calculated, concerning, conclude, prints
from replication.audit.findings.resistance import impact_pressure, resistances
from replication.audit.record import Finding
from replication.audit.results import Results, case, exact_ratio


@concerning(
    "autodyne-steel-yield",
    "autodyne-copper-yield",
    "flow-stress",
    "yield-strength",
    "copper-yield",
    "autodyne-ratio",
)
def unlike_strengths(results: Results) -> Finding:
    """Autodyne was given other strengths than the model."""
    text, exact = results.text, results.exact
    strength = exact("autodyne-steel-yield")
    ratios = {
        beta: exact_ratio(
            case(results, 5, resistance=float(exact(f"depth-beta-{beta}-beta") * strength))
        )
        for beta in (3, 5)
    }
    autodyne = exact("autodyne-ratio")
    low = prints("low", "1.45", ratios[3], "1", "exact X/R with Autodyne's strength, beta = 3")
    high = prints("high", "1.09", ratios[5], "1", "exact X/R with Autodyne's strength, beta = 5")
    times_low = prints(
        "times_low", "2.8", ratios[3] / autodyne, "1", "that over Autodyne's X/R, beta = 3"
    )
    times_high = prints(
        "times_high", "2.1", ratios[5] / autodyne, "1", "that over Autodyne's X/R, beta = 5"
    )
    density = exact("carbon-steel-density")
    steps = (
        calculated("1.5", exact("depth-beta-5-beta") * strength / 10**9),
        calculated("0.761", 4 * 8900 / (3 * density) * log(1 + 0.98125 / 1.5)),
        calculated("1.09", 1 + 0.7608 - 2 / 3),
    )
    steel = text("autodyne-steel-yield")
    return conclude(
        "unlike-strengths",
        "method",
        title='The "same calculation" in Autodyne had other strengths',
        statement=f"Steel is given {text('flow-stress')} MPa in the model, {steel} MPa in Autodyne "
        f"and {text('yield-strength')} MPa in Eq. 11; copper {text('copper-yield')} MPa in the "
        f"text and {text('autodyne-copper-yield')} MPa in Autodyne. With {steel} MPa the model's "
        f"exact X/R is {low} for beta = 3 and {high} for beta = 5, {times_low} and {times_high} "
        f"times Autodyne's {text('autodyne-ratio')}. The report says itself that the strengths in "
        "Autodyne may not be appropriate.",
        by_hand=f"R_t = {text('depth-beta-5-beta')} * {text('autodyne-steel-yield', 'GPa')} = "
        f"{steps[0]} GPa; c = 4 * 8900/(3 * {text('carbon-steel-density')}) * ln(1 + 0.98125/1.5) "
        f"= {steps[1]} is above 2/3, so X/R = 1 + 0.7608 - 2/3 = {steps[2]}.",
        settle="Nothing is open.",
        status="explained",
        evidence=(low, high, times_low, times_high),
        steps=steps,
    )  # fmt: skip


@concerning("autodyne-ratio", "autodyne-least-length", "autodyne-diameter")
def autodyne_cells(results: Results) -> Finding:
    """Autodyne's depth may be a few cells of its grid."""
    text, exact = results.text, results.exact
    cell_ratio = 2 * exact("autodyne-least-length") / exact("autodyne-diameter")
    cell = prints("cell", "0.2", cell_ratio, "1", "a cell of the least length over the radius")
    cells = prints(
        "cells", "2.6", exact("autodyne-ratio") / cell_ratio, "1",
        "Autodyne's X/R in cells of that length",
    )  # fmt: skip
    ratio, diameter = text("autodyne-ratio"), text("autodyne-diameter")
    millimeters = exact("autodyne-diameter") * 1000
    step = calculated("2.6", exact("autodyne-ratio") * millimeters / 2)
    return conclude(
        "autodyne-cells",
        "method",
        title=f"Autodyne's {ratio} may be a depth of {cells} cells or fewer",
        statement='The report says that this version "cannot formulate its cells with a length '
        f'scale smaller than 1 mm" and that the sphere was {diameter} mm wide. If cells of that '
        f"size were used, X/R = {ratio} is a depth of {cells} cells; the sentence may also mean "
        "only that lengths are entered in mm. The report gives neither the cell size nor a finer "
        f"run, so how much of {ratio} is the grid cannot be told.",
        by_hand=f"{ratio} * {diameter}/2 = {step} mm.",
        settle="The cell size, and a run with another.",
        status="open",
        evidence=(cell, cells),
        steps=(step,),
    )


def contact_velocity(results: Results) -> float:
    """Velocity [m/s] of the contact between flat plates of copper and 304 at CTH's velocity.

    The pressure on both sides of it is the same, by the shock relations U = c + s u.
    """
    V, rho_p, rho_t = (
        results[name] for name in ("cth-velocity", "a1-density", "304-density-kinslow")
    )
    c_p, s_p = results["copper-hugoniot-speed"], results["copper-hugoniot-slope"]
    c_t, s_t = results["304-hugoniot-speed"], results["304-hugoniot-slope"]
    # rho_t (c_t + s_t u) u = rho_p (c_p + s_p (V - u)) (V - u): square u^2 + linear u = still
    square = rho_t * s_t - rho_p * s_p
    linear = rho_t * c_t + rho_p * (c_p + 2 * s_p * V)
    still = rho_p * (c_p + s_p * V) * V
    return 2 * still / (linear + sqrt(linear**2 + 4 * square * still))


@concerning("cth-pressure", "cth-velocity", "cth-diameter", "a1-resistance")
def cth_pressure(results: Results) -> Finding:
    """CTH's greatest pressure against the model's and that of a plane shock."""
    text, exact = results.text, results.exact
    u = contact_velocity(results)
    plane = (
        results["304-density-kinslow"]
        * (results["304-hugoniot-speed"] + results["304-hugoniot-slope"] * u)
        * u
    )
    stress = {beta: impact_pressure(results) + R_t for beta, R_t in resistances(results).items()}
    shock = prints(
        "shock", "9.7", plane, "GPa", "pressure of a plane impact of copper on 304 at that velocity"
    )
    interface = prints("interface", "248", u, "m/s", "velocity of the contact then")
    times = prints("times", "1.9", plane / exact("cth-pressure"), "1", "that pressure over CTH's")
    radius, V = results["cth-diameter"] / 2, results["cth-velocity"]
    # The edge of the contact is at (2 R V t)^(1/2) and moves with R V over that: down to the speed
    # U of the shock in the steel at R V/U.
    shock_speed = results["304-hugoniot-speed"] + results["304-hugoniot-slope"] * u
    time = prints(
        "time", "0.13", radius * V / (2 * shock_speed**2), "ns",
        "time until the contact's edge is slower than the shock in the steel, R V/(2 U^2)",
    )  # fmt: skip
    edge = prints(
        "edge", "1.3", radius * V / shock_speed, "um", "distance of that edge from the axis, R V/U"
    )
    speed = prints("speed", "4.94", shock_speed / 1000, "1", "shock speed in the steel in km/s")
    flow_low = prints("flow_low", "3.08", stress[3], "GPa", "rho_t V^2/2 + R_t, beta = 3")
    flow_high = prints("flow_high", "4.48", stress[5], "GPa", "rho_t V^2/2 + R_t, beta = 5")
    steps = (
        calculated("252", exact("cth-velocity") - 248),
        calculated("9.7", 7.896 * (4.569 + 1.490 * 0.248) * 0.248),
        calculated("9.7", 8.9 * (3.940 + 1.489 * 0.252) * 0.252),
        calculated("0.13", 12.5 * 0.5 / (2 * 4.94**2)),
    )
    return conclude(
        "cth-pressure",
        "method",
        title=f"CTH's {text('cth-pressure')} GPa lies between the model's pressure and that of a "
        "plane shock",
        statement=f"Two flat plates of copper and 304 that meet at {text('cth-velocity')} m/s "
        f"press {shock} GPa on each other, by their published shock relations: {times} times CTH's "
        "greatest pressure. Where a sphere first touches, that lasts until the edge of the contact "
        f"is slower than the shock, {speed} km/s in the steel, and the pressure runs out: for "
        f"{time} ns, up to {edge} um from the axis of CTH's particle "
        f"({text('cth-diameter')} um). The model's own rho_t v^2/2 + R_t is "
        f"{flow_low} and {flow_high} GPa at the impact (beta = {text('depth-beta-3-beta')} and "
        f"{text('depth-beta-5-beta')}), and less after it. So {text('cth-pressure')} GPa "
        "contradicts neither, if the grid or the output interval of that calculation did not "
        "resolve the first instant; the report gives neither.",
        by_hand=f"At the contact both move with {interface} m/s into the steel and "
        f"{text('cth-velocity')} - {interface} = {steps[0]} into the copper: 7.896 * (4.569 + "
        f"1.490 * 0.248) * 0.248 = {steps[1]}, 8.9 * (3.940 + 1.489 * 0.252) * 0.252 = {steps[2]} "
        f"GPa. With R = 12.5 um R V/(2 U^2) is 12.5 * 0.5/(2 * 4.94^2) = {steps[3]} ns.",
        settle="CTH's cell size and the times of its output.",
        status="open",
        evidence=(shock, interface, times, time, edge, speed, flow_low, flow_high),
        steps=steps,
    )

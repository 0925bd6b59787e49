"""The sheet compared with the exact motion. This module warns about bad runs of the sheet."""

from replication.models.depth import depth_at_velocity, final_depth
from replication.models.sheet import Sheet
from replication.text import in_percent

COARSE = 0.1
"""The largest acceptable dt V / R, the share of the radius R covered by a step at the impact
velocity V. In the report's cases the published scheme then falls about 1 % short of the exact
depth; as it is first order, longer steps fall further short."""

OFF_STOP = 0.01
"""The largest acceptable relative error of a depth against the exact one at the stop velocity. In
the report's cases the published scheme reaches it when a step covers about `COARSE` R; a slow
impact of few steps reaches it with shorter steps."""

DIGITS = 5e-4
"""The share by which a depth may exceed the exact depth at rest, or the exact depth at the stop
velocity may fall short of it: half a unit of the third digit, the report's last, is at least this
much."""


NOTES = frozenset({"reversed"})
"""The kinds of warnings that only say how a sheet ends. It stops at the first row below the stop
velocity, which in most cases, the report's too, is below zero. A step so long that this matters is
warned of by other kinds."""


def too_long(travel: float) -> bool:
    """Return whether dt V / R exceeds `COARSE` by more than the rounding of decimal inputs."""
    return travel - COARSE > COARSE * 1e-12


def warnings(sheet: Sheet) -> dict[str, str]:
    """Return the warnings about a sheet: a sentence with figures for each kind that applies.

    "no steps": the impact velocity is below the stop velocity (then the only warning); "reversed":
    the last velocity is below zero by more than the stop velocity; "coarse": dt V is more than
    `COARSE` R; "deep": the depth exceeds the exact one at rest by more than `DIGITS`; "shallow" and
    "overrun": the depth is more than `OFF_STOP` below or above the exact one at the stop velocity;
    "short": the exact depth at the stop velocity is more than `DIGITS` below that at rest.

    >>> from dataclasses import replace
    >>> from replication.cases import BETA_5
    >>> from replication.models.sheet import run
    >>> list(warnings(run(replace(BETA_5, step=1e-7))))
    ['reversed', 'coarse', 'deep']
    """
    impact, last, result = sheet.impact, sheet.rows[-1], {}
    stop = f"the stop velocity {impact.stop_velocity!r} m/s"
    if last.velocity_final is None:
        return {"no steps": f"the velocity {impact.velocity!r} m/s is below {stop}: no steps"}
    if last.velocity_final < -impact.stop_velocity:
        share = in_percent(-last.velocity_final / impact.velocity, 2)
        text = f"the last step reverses the velocity to {last.velocity_final:.4g} m/s"
        result["reversed"] = f"{text}, {share} of the impact velocity"
    travel = impact.velocity * impact.step / impact.radius
    if too_long(travel):
        text = f"a step at the impact velocity covers {travel:.3g} of the radius"
        result["coarse"] = f"{text}: keep it to {COARSE} at most"
    rest = final_depth(**impact.motion)
    if last.depth > rest * (1 + DIGITS):
        text = f"the depth exceeds that of the exact solution at rest, {rest * 1e6:.6g} um"
        result["deep"] = f"{text}, by {in_percent(last.depth / rest - 1)}"
    at_stop = depth_at_velocity(impact.stop_velocity, **impact.motion)
    if abs(last.depth - at_stop) > OFF_STOP * at_stop and "deep" not in result:
        kind, relation = "overrun", "exceeds"
        if last.depth < at_stop:
            kind, relation = "shallow", "falls short of"
        text = f"the depth {relation} the exact one at the stop velocity, {at_stop * 1e6:.6g} um"
        by = f", by {in_percent(abs(1 - last.depth / at_stop))}" if at_stop else ""
        cure = "take a shorter step" if at_stop else "the run begins at the stop velocity"
        result[kind] = f"{text}{by}: {cure}"
    if 1 - at_stop / rest > DIGITS and last.depth < rest:
        # Of the depth that the sheet has reached, which may be far from that at the stop velocity.
        left = f"{in_percent(1 - last.depth / rest)} of the exact depth is still to come"
        result["short"] = f"{stop} ends the run before rest: {left}"
    return result

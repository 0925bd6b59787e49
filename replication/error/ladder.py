"""The sheet's final depth against its time step: error and its parts, observed order, limit."""

import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import islice, pairwise
from typing import Any

from reference.motion import Trajectory, sheet_rows
from reference.scheme import Scheme
from replication.cases import inputs_of
from replication.error import warnings
from replication.models.impact import Impact
from replication.models.motion import stop_time
from replication.models.sheet import MAX_STEPS, Sheet, run

Budget = dict[str, float | None]
LevelJson = dict[str, Any]


def exact_motion(impact: Impact) -> Trajectory:
    """Return the exact motion of a case to 50 digits, for its inputs as exact doubles."""
    inputs = {name: Fraction(value) for name, value in impact.motion.items()}
    return Trajectory(**inputs, digits=50)


def split(sheet: Sheet) -> tuple[float, Budget]:
    """Return the sheet's final depth minus the exact depth at rest [m], and its four parts [m].

    `time_step`: the scheme's depth, advanced by half a step, minus the depth at which the exact
    motion has the last row's velocity (Eq. 13 also describes the motion back out of the crater, so
    a negative velocity has such a depth). `stop_rule`: that depth minus the depth at rest.
    `half_step`: the effect of x lagging half a step behind its row's final velocity. `rounding`:
    doubles minus the same scheme in 50 digits. The parts are None if the last velocity exceeds the
    impact velocity in size, as the exact motion never has it. Each part is rounded to a double
    once, so that they add up to the error within a few units of the last digit of the largest.

    >>> from replication.cases import BETA_5
    >>> error, budget = split(run(BETA_5))
    >>> [f"{part * 1e6:.5f}" for part in (error, budget["time_step"], budget["stop_rule"])]
    ['-0.00538', '-0.00548', '-0.00023']
    """
    impact, motion = sheet.impact, exact_motion(sheet.impact)
    rest, real = motion.final_depth, motion.reals.number
    depth, step = real(Fraction(sheet.final_depth)), real(Fraction(impact.step))
    x, v, lag = real(0), motion.velocity, real(0)
    if sheet.steps:
        inputs = {name: real(Fraction(value)) for name, value in impact.motion.items()}
        rows = sheet_rows(
            motion.reals, **inputs, step=step, scheme=sheet.scheme, most_rows=sheet.steps
        )
        last = next(islice(rows, sheet.steps - 1, None))
        x, v, lag = last.depth, last.velocity_final, last.velocity_final * step / 2
    if abs(v) > motion.velocity:
        return float(depth - rest), dict.fromkeys(_PARTS)
    same_velocity = motion.depth_at_velocity(v)
    parts = x + lag - same_velocity, same_velocity - rest, -lag, depth - x
    return float(depth - rest), dict(zip(_PARTS, map(float, parts), strict=True))


_PARTS = ("time_step", "stop_rule", "half_step", "rounding")

# A ladder of steps


def ladder(step: float, levels: int) -> list[float]:
    """Return `levels` steps, each half of the one before, starting at 16 times the given step.

    >>> ladder(2e-10, 6)
    [3.2e-09, 1.6e-09, 8e-10, 4e-10, 2e-10, 1e-10]
    """
    return [step * 2.0 ** (4 - k) for k in range(levels)]


def converge(
    impact: Impact, steps: Sequence[float], scheme: str = Scheme.PUBLISHED
) -> dict[str, Any]:
    """Run the sheet at each step, coarsest first: the JSON of `coldspray converge`.

    Lengths are in m. For each level, `error` and `budget` are those of `split`, `order` is the
    `error_order` against the level before, `time_step_order` the same for the time-step part alone,
    and `regime` names what governs the error. `limit`, an estimate of the depth at the stop
    velocity, `observed_order` and `gci` come from the three finest depths, without the exact one;
    where they are None, `limit_undefined` says why. Raises ValueError for fewer than two steps, for
    steps that do not decrease, and where `run` does, which also says what `scheme` may be.

    >>> from replication.cases import BETA_5
    >>> finest = converge(BETA_5, [4e-10, 2e-10, 1e-10])["levels"][-1]
    >>> f"{finest['time_step_order']:.2f}", finest["regime"]
    ('1.02', 'asymptotic')
    """
    scheme = Scheme(scheme)
    if len(steps) < 2 or any(b >= a for a, b in pairwise(steps)):
        raise ValueError("convergence needs two steps or more, each shorter than the one before")
    for step in steps:  # if one needs too many rows, fail before the long work
        run(replace(impact, step=step), scheme)
    levels: list[LevelJson] = []
    for step in steps:  # again, as a million rows for every step would not fit into memory
        sheet = run(replace(impact, step=step), scheme)
        levels.append(_level(sheet, levels[-1] if levels else None))
    order, finest, motion = scheme.order, levels[-3:], exact_motion(impact)
    limit = extrapolated(steps[-3:], [level["depth"] for level in finest], order)
    meaningless = any(level["regime"] == "meaningless" for level in finest)
    if meaningless and not limit["limit_undefined"]:
        limit = dict.fromkeys(limit) | {"limit_undefined": "a depth of the three is meaningless"}
    at_stop = motion.depth_at_velocity(min(impact.stop_velocity, impact.velocity))
    return {
        "inputs": inputs_of(impact),
        "scheme": scheme,
        "nominal_order": order,
        "levels": levels,
        **limit,
        "exact": float(motion.final_depth),
        "exact_at_stop": float(at_stop),
    }


def _level(sheet: Sheet, coarse: LevelJson | None) -> LevelJson:
    step, (error, budget), doubts = sheet.impact.step, split(sheet), warnings(sheet)
    order = time_step_order = None
    if coarse:
        pair = coarse["steps"], coarse["step"] / step
        order = error_order(coarse["error"], error, *pair)
        time_step_order = error_order(coarse["budget"]["time_step"], budget["time_step"], *pair)
    return {
        "step": step,
        "steps": sheet.steps,
        "depth": sheet.final_depth,
        "error": error,
        "budget": budget,
        "warnings": list(doubts.values()),
        "warned_of": list(doubts),
        "order": order,
        "time_step_order": time_step_order,
        "regime": regime(error, budget, time_step_order, sheet.scheme.order),
    }


def error_order(
    coarse: float | None, fine: float | None, steps: int, ratio: float = 2.0
) -> float | None:
    """Return the order with which an error falls with the step.

    None if the error vanishes or changes sign, or if the coarse run has fewer than two `steps`: a
    single step ends at V dt/2, whatever the target is.

    >>> error_order(0.04, 0.01, 9)
    2.0
    """
    if coarse is None or fine is None or coarse * fine <= 0 or steps < 2:
        return None
    return math.log(coarse / fine) / math.log(ratio)


def regime(error: float, budget: Budget, time_step_order: float | None, order: int) -> str:
    """Return what governs the error: a key of `GOVERNED_BY`.

    A part of more than a tenth of the error shows in the observed order.
    """
    time_step, stop_rule, half_step, rounding = (budget[part] or 0.0 for part in _PARTS)
    if budget["time_step"] is None:
        return "meaningless"
    if abs(rounding) > abs(error) / 10:
        return "rounding floor"
    stop = abs(half_step + stop_rule)
    if time_step_order is None:
        return "stop-rule floor" if time_step == 0 < stop else "order unknown"
    if abs(time_step_order - order) > 0.1:
        return "not yet asymptotic"
    if stop > abs(time_step):
        return "stop-rule floor"
    return "stop rule shows" if stop > abs(time_step) / 10 else "asymptotic"


GOVERNED_BY = {
    "asymptotic": "the time step, of the order of the scheme (within 0.1)",
    "stop rule shows": "the time step; where the last row falls adds more than a tenth of it",
    "stop-rule floor": "where the last row falls adds more than the time step does",
    "not yet asymptotic": "the time step, not yet of the order of the scheme",
    "order unknown": "the first run, or one without an order of the time step's part",
    "rounding floor": "rounding, with more than a tenth of it",
    "meaningless": "the last velocity exceeds that of the impact in size",
}
"""The regimes of an error, and what each means."""


def extrapolated(steps: Sequence[float], depths: Sequence[float], nominal: int) -> dict[str, Any]:
    """Return Richardson's limit of three depths, its order and uncertainty, or why it has none."""
    result = dict.fromkeys(("limit", "limit_undefined", "observed_order", "gci"))
    if len(steps) < 3:
        return result | {"limit_undefined": "needs three levels"}
    (ratio, again), (coarse, middle, fine) = (a / b for a, b in pairwise(steps)), depths
    if not math.isclose(ratio, again, rel_tol=1e-9):
        return result | {"limit_undefined": "the steps have no constant ratio"}
    if coarse == middle or middle == fine:
        return result | {"limit_undefined": "two depths are equal"}
    shrink = (coarse - middle) / (middle - fine)
    if shrink <= 1:
        why = "the depths oscillate" if shrink < 0 else "the depths do not draw together"
        return result | {"limit_undefined": why}
    order = math.log(shrink) / math.log(again)
    # An observed order above the scheme's is accidental and would make the index too small.
    cautious = min(max(order, 0.5), nominal)
    # Roache's safety factors: 1.25 if the observed order is the scheme's within a tenth, else 3.
    factor = 1.25 if abs(order - nominal) <= 0.1 * nominal else 3.0
    gci = factor * abs((fine - middle) / fine) / (again**cautious - 1)
    limit = fine + (fine - middle) / (shrink - 1)
    return result | {"limit": limit, "observed_order": order, "gci": gci}


def step_for_digits(impact: Impact, digits: int, scheme: str = Scheme.PUBLISHED) -> dict[str, Any]:
    """Find a step that gives this many correct digits, as its halvings do; 1 % more does not.

    Correct means within half a unit of the last of these digits of the exact depth at rest. Where
    the last row falls is accidental, so other steps may do better or worse. Returns `digits`,
    `step`, `steps`, `depth`, `error`, and as `fails` the next longer step tried, which fails.
    Raises ValueError if no step succeeds: the error of the stop rule alone is too large, or too
    many rows are needed.
    """
    halvings = 3  # these must be correct, too, to show that the step is not so by accident
    motion = exact_motion(impact)
    rest = float(motion.final_depth)
    allowed = 0.5 * 10.0 ** (math.floor(math.log10(rest)) + 1 - digits)
    floor = rest - float(motion.depth_at_velocity(min(impact.stop_velocity, impact.velocity)))
    if floor > allowed:
        raise ValueError(
            f"no refinement gives {digits} digits: stopping at {impact.stop_velocity!r} m/s alone "
            f"leaves out {floor:.3g} m, more than {allowed:.3g} m; lower the stop velocity"
        )

    def keeps(step: float) -> bool:
        halved = (replace(impact, step=step / 2**k) for k in range(halvings + 1))
        return all(abs(run(case, scheme).final_depth - rest) <= allowed for case in halved)

    step = 2 * stop_time(**impact.motion)
    while not keeps(step):
        step /= 2
        if rest / impact.velocity / step > MAX_STEPS / 2**halvings:
            raise ValueError(f"{digits} digits need more than {MAX_STEPS:,} steps")
    while keeps(4 * step):
        step *= 4
    fails = 4 * step
    while not keeps(fails / 1.01):
        fails /= 1.01
    sheet = run(replace(impact, step=fails / 1.01), scheme)
    return {
        "digits": digits,
        "step": sheet.impact.step,
        "steps": sheet.steps,
        "depth": sheet.final_depth,
        "error": sheet.final_depth - rest,
        "fails": fails,
    }

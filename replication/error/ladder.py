"""The sheet's final depth against its time step: error, its parts, observed order, limit."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from itertools import islice, pairwise
from typing import Any

from reference.arithmetic import Number, Reals
from reference.motion import Trajectory, sheet_rows
from replication.cases import inputs_of
from replication.error import warnings
from replication.models.impact import Impact
from replication.models.motion import stop_time
from replication.models.sheet import MAX_STEPS, Sheet, run
from replication.text import aligned, number

# The error of one sheet


@dataclass(frozen=True, slots=True)
class Budget:
    """The sheet's final depth minus the exact depth at rest, `total`, and its parts [m].

    `rounding`: doubles against the same scheme in 50 digits. `half_step`: x stands half a step
    behind the velocity that closes its row. `time_step`: the scheme's depth, half a step on,
    against the depth at which the exact motion has that velocity (Eq. 13 holds for the motion back
    out of the crater, too, so a negative velocity has one). `stop_rule`: that depth against the
    depth at rest. The parts are None where the last velocity exceeds the impact's in size: no exact
    motion has it. Each is rounded to a double once, so that they add up to the total within a few
    units of the last digit of the largest.
    """

    total: float
    rounding: float | None = None
    half_step: float | None = None
    time_step: float | None = None
    stop_rule: float | None = None


def exact_motion(impact: Impact) -> Trajectory:
    """The exact motion for a case, its inputs taken as the doubles that they are; to 50 digits."""
    return _motion(*impact.motion.values())


@lru_cache(maxsize=8)  # the steps of a ladder share one motion
def _motion(*inputs: float) -> Trajectory:
    return Trajectory(*map(Fraction, inputs), digits=50)


def split(sheet: Sheet) -> Budget:
    """The error budget of a sheet.

    >>> from replication.cases import BETA_5
    >>> from replication.models.sheet import run
    >>> budget = split(run(BETA_5))
    >>> [f"{part * 1e6:.5f}" for part in (budget.total, budget.time_step, budget.stop_rule)]
    ['-0.00538', '-0.00548', '-0.00023']
    """
    motion = exact_motion(sheet.impact)
    rest = motion.final_depth
    total = motion.reals.number(Fraction(sheet.final_depth)) - rest
    x, v, lag = _last_row(motion.reals, sheet)
    if abs(v) > motion.velocity:
        return Budget(float(total))
    same_velocity = motion.depth_at_velocity(v)
    return Budget(
        total=float(total),
        rounding=float(motion.reals.number(Fraction(sheet.final_depth)) - x),
        half_step=float(-lag),
        time_step=float(x + lag - same_velocity),
        stop_rule=float(same_velocity - rest),
    )


def _last_row(reals: Reals, sheet: Sheet) -> tuple[Number, Number, Number]:
    """Depth, final velocity and half a step's travel in the scheme's last row, without rounding."""
    impact = sheet.impact
    if sheet.steps == 0:
        return reals.number(0), reals.number(Fraction(impact.velocity)), reals.number(0)
    step = reals.number(Fraction(impact.step))
    rows = sheet_rows(
        reals,
        **{name: reals.number(Fraction(value)) for name, value in impact.motion.items()},
        step=step,
        centered=sheet.scheme == "centered",
        most_rows=sheet.steps,
    )
    last = next(islice(rows, sheet.steps - 1, None))
    return last.depth, last.velocity_final, last.velocity_final * step / 2


# A ladder of steps

ORDER = {"published": 1, "centered": 2}
"""Of the time-step error; why, in `replication.models.sheet`."""

SAFETY, CAUTION = 1.25, 3.0
"""Factors of the grid convergence index (Roache): for three levels and more whose observed order is
within a tenth of the scheme's, and for others."""


@dataclass(frozen=True, slots=True)
class Level:
    """One run of the ladder; lengths in m.

    `order`: of the error against that of the level before (None where the error vanishes or changes
    sign); `time_step_order`: the same for the time-step part alone; `regime`: what governs the
    error. `observed_order`, `limit` and `gci` come from the depths of this level and the two before
    without knowledge of the exact one; None where undefined, with the reason in `undefined`.
    """

    step: float
    steps: int
    depth: float
    error: float
    budget: Budget
    warnings: tuple[str, ...]
    order: float | None
    time_step_order: float | None
    regime: str
    observed_order: float | None = None
    limit: float | None = None
    gci: float | None = None
    undefined: str | None = None


@dataclass(frozen=True, slots=True)
class Convergence:
    """A ladder of steps for one case; depths in m.

    `limit` is that of the finest three levels; it estimates the depth at the stop velocity.
    """

    impact: Impact
    scheme: str
    levels: tuple[Level, ...]
    exact: float
    exact_at_stop: float

    @property
    def limit(self) -> float | None:
        return self.levels[-1].limit


def ladder(step: float, levels: int) -> list[float]:
    """So many steps from 16 times the given one down by halves, coarsest first.

    >>> ladder(2e-10, 6)
    [3.2e-09, 1.6e-09, 8e-10, 4e-10, 2e-10, 1e-10]
    """
    return [step * 2.0 ** (4 - k) for k in range(levels)]


def converge(impact: Impact, steps: Sequence[float], scheme: str = "published") -> Convergence:
    """Run the sheet at each step, coarsest first.

    Raises ValueError for less than two steps, for steps that do not fall, and as `run` of a sheet.

    >>> from replication.cases import BETA_5
    >>> finest = converge(BETA_5, [4e-10, 2e-10, 1e-10]).levels[-1]
    >>> f"{finest.time_step_order:.2f}", finest.regime
    ('1.02', 'asymptotic')
    """
    if len(steps) < 2 or any(b >= a for a, b in pairwise(steps)):
        raise ValueError("convergence needs two steps or more, each shorter than the one before")
    motion = exact_motion(impact)
    levels: list[Level] = []
    for step in steps:
        levels.append(_level(replace(impact, step=step), scheme, levels))
    at_stop = motion.depth_at_velocity(min(impact.stop_velocity, impact.velocity))
    return Convergence(impact, scheme, tuple(levels), float(motion.final_depth), float(at_stop))


def _level(impact: Impact, scheme: str, before: Sequence[Level]) -> Level:
    sheet = run(impact, scheme)
    budget = split(sheet)
    order = time_step_order = None
    if before:
        ratio = before[-1].step / impact.step
        order = error_order(before[-1].error, budget.total, ratio)
        time_step_order = error_order(before[-1].budget.time_step, budget.time_step, ratio)
    level = Level(
        step=impact.step,
        steps=sheet.steps,
        depth=sheet.final_depth,
        error=budget.total,
        budget=budget,
        warnings=tuple(warning.text for warning in warnings(sheet)),
        order=order,
        time_step_order=time_step_order,
        regime=_regime(budget, time_step_order, ORDER[scheme]),
    )
    return _extrapolated([*before[-2:], level], ORDER[scheme])


def error_order(coarse: float | None, fine: float | None, ratio: float = 2.0) -> float | None:
    """The order by which an error falls with the step; None where it vanishes or changes sign.

    >>> error_order(0.04, 0.01)
    2.0
    """
    if coarse is None or fine is None or coarse * fine <= 0:
        return None
    return math.log(coarse / fine) / math.log(ratio)


def _regime(budget: Budget, time_step_order: float | None, order: int) -> str:
    """What governs the error. A tenth of it is where a part begins to show in the order."""
    if budget.time_step is None:
        return "meaningless"
    assert budget.rounding is not None
    assert budget.half_step is not None
    assert budget.stop_rule is not None
    if abs(budget.rounding) > abs(budget.total) / 10:
        return "rounding floor"
    if time_step_order is None:
        return "order unknown"
    if abs(time_step_order - order) > 0.1:
        return "not yet asymptotic"
    stop = abs(budget.half_step + budget.stop_rule)
    if stop > abs(budget.time_step):
        return "stop-rule floor"
    return "stop rule shows" if stop > abs(budget.time_step) / 10 else "asymptotic"


def _extrapolated(levels: Sequence[Level], nominal: int) -> Level:
    """The last level with what three depths alone tell (Richardson)."""
    last = levels[-1]
    if len(levels) < 3:
        return replace(last, undefined="needs three levels")
    coarse, middle, fine = (level.depth for level in levels)
    ratio = levels[-2].step / last.step
    if not math.isclose(levels[-3].step / levels[-2].step, ratio, rel_tol=1e-9):
        return replace(last, undefined="the steps have no constant ratio")
    if coarse == middle or middle == fine:
        return replace(last, undefined="two depths are equal")
    shrink = (coarse - middle) / (middle - fine)
    if shrink < 0:
        return replace(last, undefined="the depths oscillate")
    if shrink <= 1:
        return replace(last, undefined="the depths do not draw together")
    order = math.log(shrink) / math.log(ratio)
    # An observed order above the scheme's is chance, and would make the index too small.
    cautious = min(max(order, 0.5), nominal)
    factor = SAFETY if abs(order - nominal) <= 0.1 * nominal else CAUTION
    return replace(
        last,
        observed_order=order,
        limit=fine + (fine - middle) / (shrink - 1),
        gci=factor * abs((fine - middle) / fine) / (ratio**cautious - 1),
    )


@dataclass(frozen=True, slots=True)
class StepForDigits:
    """The largest step of a 1 % grid that gives so many correct digits of the depth at rest.

    `fails` is the next longer step of the grid, which does not.
    """

    digits: int
    step: float
    steps: int
    depth: float
    error: float
    fails: float


_HALVINGS = 3
"""So often a step is halved to see that it did not meet the digits by chance."""


def step_for_digits(impact: Impact, digits: int, scheme: str = "published") -> StepForDigits:
    """The largest step, of a grid of 1 %, that gives so many correct digits; so do its halvings.

    Correct means: within half a unit of that digit of the exact depth at rest. As the last row
    falls by chance, single steps between may do better or worse. Raises ValueError where no
    refinement gives them: the stop rule alone is off by more, or too many rows are needed.
    """
    if digits < 1:
        raise ValueError(f"{digits} digits cannot be met: ask for one or more")
    motion = exact_motion(impact)
    rest = float(motion.final_depth)
    allowed = 0.5 * 10.0 ** (math.floor(math.log10(rest)) + 1 - digits)
    floor = rest - float(motion.depth_at_velocity(min(impact.stop_velocity, impact.velocity)))
    if floor > allowed:
        raise ValueError(
            f"no refinement gives {digits} digits: stopping at {impact.stop_velocity!r} m/s alone "
            f"leaves out {floor:.3g} m, more than {allowed:.3g} m; lower the stop velocity"
        )

    def error(step: float) -> float:
        return run(replace(impact, step=step), scheme).final_depth - rest

    def keeps(step: float) -> bool:
        return all(abs(error(step / 2**k)) <= allowed for k in range(_HALVINGS + 1))

    longest = 2 * stop_time(**impact.motion)
    step = longest
    while not keeps(step):
        step /= 2
        if rest / impact.velocity / step > MAX_STEPS / 2**_HALVINGS:
            raise ValueError(f"{digits} digits need more than {MAX_STEPS:,} steps")
    while keeps(4 * step):
        step *= 4
    fails = 4 * step
    while not keeps(fails / 1.01):
        fails /= 1.01
    step = fails / 1.01
    final = run(replace(impact, step=step), scheme)
    return StepForDigits(digits, step, final.steps, final.final_depth, error(step), fails)


# As the command shows them


def record(result: Convergence, digits: StepForDigits | None) -> dict[str, Any]:
    """As JSON."""
    return {
        "inputs": inputs_of(result.impact),
        "scheme": result.scheme,
        "nominal_order": ORDER[result.scheme],
        "levels": result.levels,
        "limit": result.limit,
        "limit_undefined": result.levels[-1].undefined,
        "exact": result.exact,
        "exact_at_stop": result.exact_at_stop,
        "digits": digits,
    }


_WHY = {
    "published": (
        "The published scheme is first order: it takes a row's deceleration at the middle depth,\n"
        "but at the initial velocity, and drag depends on velocity."
    ),
    "centered": (
        "The centered scheme is second order: it takes a row's deceleration at the middle depth\n"
        "and at the middle velocity."
    ),
}


def _um(length: float | None, digits: int) -> str:
    return "-" if length is None else number(length * 1e6, digits)


def _shown(order: float | None) -> str:
    return "-" if order is None else f"{order:.2f}"


_COLUMNS: tuple[tuple[str, str, Callable[[Level], str]], ...] = (
    ("step", "[ns]", lambda level: number(level.step * 1e9, 5)),
    ("steps", "", lambda level: str(level.steps)),
    ("depth", "[um]", lambda level: _um(level.depth, 7)),
    ("error", "[um]", lambda level: _um(level.error, 3)),
    ("order", "", lambda level: _shown(level.order)),
    ("time step", "[um]", lambda level: _um(level.budget.time_step, 3)),
    ("order", "", lambda level: _shown(level.time_step_order)),
    ("stop rule", "[um]", lambda level: _um(level.budget.stop_rule, 3)),
    ("half step", "[um]", lambda level: _um(level.budget.half_step, 3)),
    ("rounding", "[um]", lambda level: _um(level.budget.rounding, 2)),
    ("governed by", "", lambda level: level.regime),
)
"""Head, unit and text of each column."""


def text(result: Convergence, digits: StepForDigits | None) -> str:
    """The ladder as a table, its limit, and where every part of the error comes from."""
    heads, units, writers = zip(*_COLUMNS, strict=True)
    rows = [tuple(write(level) for write in writers) for level in result.levels]
    last = result.levels[-1]
    limit = last.undefined or f"{_um(result.limit, 8)} um"
    if last.gci is not None:
        limit += f", observed order {last.observed_order:.2f}, grid convergence index "
        limit += f"{100 * last.gci:.2g} %"
    lines = [
        *aligned([heads, units, *rows]),
        "",
        f"exact, at rest            {_um(result.exact, 10)} um",
        f"exact, at stop velocity   {_um(result.exact_at_stop, 10)} um",
        f"limit of the last three   {limit}",
        "The error is the sum of the four parts: time step, stop rule, half step, rounding.",
        _WHY[result.scheme],
    ]
    if digits is not None:
        lines.append(
            f"{digits.digits} correct digits: largest step {number(digits.step * 1e9, 5)} ns "
            f"({digits.steps} steps, error {_um(digits.error, 3)} um); "
            f"{number(digits.fails * 1e9, 5)} ns fails."
        )
    return "\n".join(lines)

"""The error of the sheet's final depth, split into parts that are computed each on its own."""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import islice

from reference.arithmetic import Number, Reals
from reference.motion import Trajectory, sheet_rows
from replication.models.impact import Impact
from replication.models.sheet import Sheet


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
    rounding: float | None
    half_step: float | None
    time_step: float | None
    stop_rule: float | None


def exact_motion(impact: Impact, digits: int = 50) -> Trajectory:
    """The exact motion for a case, its inputs taken as the doubles that they are."""
    return _motion(tuple(impact.motion.values()), digits)


@lru_cache(maxsize=8)  # the steps of a ladder share one motion
def _motion(inputs: tuple[float, ...], digits: int) -> Trajectory:
    return Trajectory(*map(Fraction, inputs), digits=digits)


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
        return Budget(float(total), None, None, None, None)
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

"""The cases that are timed, each with its exact depths and an exact history."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from reference.arithmetic import Number
from reference.motion import Trajectory
from replication.error.hard_cases import HARD_CASES, impact_of
from replication.error.ladder import exact_motion
from replication.models.impact import Impact

CASES = {
    "beta-5": "the report's beta-5",
    "beta-3": "the report's beta-3",
    "crossing": "depth just above R",
    "shallow": "slow, 1 m/s",
    "hypervelocity": "hypervelocity, 1e4 m/s",
}
"""Names for the command line, and which of the hard cases they are."""

POINTS = 101
"""Times of a history, first and last included."""


@dataclass(frozen=True, slots=True)
class Case:
    """One case with the truth about it, to 50 digits.

    `times` [s], shape (POINTS,), run from the impact to rest; `depths` [m] are the exact ones.
    """

    name: str
    impact: Impact
    motion: Trajectory
    times: npt.NDArray[np.float64]
    depths: tuple[Number, ...]

    def depth_error(self, depth: float, at_velocity: float = 0.0) -> float:
        """Relative error of a depth [m], against the exact one at a velocity [m/s], 0 for rest."""
        return relative_error(depth, self.motion.depth_at_velocity(at_velocity))

    def history_error(self, depths: Sequence[float], until: float = math.inf) -> float:
        """The worst error of depths [m] at `times` up to one [s], relative to the depth at rest."""
        mpf, whole = self.motion.context.mpf, self.motion.final_depth
        triples = zip(self.times, depths, self.depths, strict=True)
        errors = [abs(mpf(float(x)) - exact) / whole for time, x, exact in triples if time <= until]
        return float(np.max([float(error) for error in errors]))


def build(name: str) -> Case:
    """One of `CASES`. Raises ValueError for another name.

    >>> case = build("beta-5")
    >>> f"{case.times[-1] * 1e9:.3f} ns", f"{case.depth_error(7.67e-6):.1e}"
    ('26.079 ns', '6.4e-04')
    """
    if name not in CASES:
        raise ValueError(f"there is no case {name!r} to time: choose of {', '.join(CASES)}")
    impact = impact_of(HARD_CASES[CASES[name]])
    motion = exact_motion(impact)
    times, depths = zip(*(_instant(motion, k) for k in range(POINTS)), strict=True)
    return Case(name, impact, motion, np.array(times), depths)


def _instant(motion: Trajectory, k: int) -> tuple[float, Number]:
    """The k-th time as a double, and the exact depth at that very double.

    Time is found for a depth, a single quadrature, where depth for a time would take a dozen.
    Depths X (1 - s^2) with s falling evenly are about evenly spaced in time. What rounding the time
    to a double leaves out, 1e-16 of the motion, one Taylor step makes up for but for 1e-32.
    """
    s = motion.reals.number(Fraction(POINTS - 1 - k, POINTS - 1))
    depth = motion.final_depth * (1 - s * s)
    exact = motion.time_to_depth(depth)
    time = float(exact)
    return time, depth + motion.velocity_at_depth(depth) * (motion.context.mpf(time) - exact)


def relative_error(depth: float, exact: Number) -> float:
    """Of a double [m], without rounding; NaN for one that is not finite."""
    return float(abs(exact.context.mpf(float(depth)) / exact - 1))

"""The cases that are timed, and how far an answer is off the truth to 50 digits."""

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from reference.arithmetic import Number
from reference.motion import Trajectory
from replication.error.hard_cases import HARD_CASES, impact_of
from replication.error.ladder import exact_motion
from replication.models.impact import Impact

Measure = Literal["depth", "history"]
MEASURES: dict[Measure, str] = {"depth": "final depth", "history": "history"}
"""What is asked of a method, and the title of that."""

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
    """One case with its exact motion.

    `times` [s], shape (POINTS,), run from the impact to rest; `depths` [m] are the exact ones.
    """

    name: str
    impact: Impact
    motion: Trajectory
    times: npt.NDArray[np.float64]
    depths: tuple[Number, ...]

    def columns(self, count: int) -> list[Any]:
        """The inputs of so many cases, their velocities within 10 % of this one in the middle."""
        spread = 0.1 * (count > 1) * np.linspace(-1, 1, count)
        velocity, *others = (np.full(count, value) for value in self.impact.motion.values())
        return [velocity * (1 + spread), *others]

    def error(self, measure: Measure, answer: Any, stop: float = 0.0) -> float:
        """The worst relative error of depths [m], measured down to a velocity [m/s], 0 for rest.

        Of a "depth", these are the final ones of `columns`, of which eleven are compared; of a
        "history", those at `times`, relative to the depth at rest; where there is a row for each of
        `columns`, the middle one is. Of several results, as of depth and velocity, the first is.
        """
        found = np.atleast_1d(answer[0] if isinstance(answer, tuple) else answer)
        if measure == "depth":
            some = np.unique(np.linspace(0, len(found) - 1, 11, dtype=int))
            velocities = self.columns(len(found))[0][some].tolist()
            motions = [exact_motion(replace(self.impact, velocity=v)) for v in velocities]
            exact = wholes = [motion.depth_at_velocity(stop) for motion in motions]
            found = found[some]
        else:
            end = self.motion.depth_at_velocity(stop)
            exact = [depth for depth in self.depths if stop == 0 or depth <= end]
            wholes = [self.motion.final_depth] * len(exact)
            found = (found if found.ndim == 1 else found[len(found) // 2])[: len(exact)]
        terms = zip(map(self.motion.context.mpf, found.tolist()), exact, wholes, strict=True)
        return float(np.max([float(abs(depth - true) / whole) for depth, true, whole in terms]))


def build(name: str) -> Case:
    """One of `CASES`. Raises ValueError for another name.

    >>> case = build("beta-5")
    >>> f"{case.times[-1] * 1e9:.3f} ns", f"{case.error('depth', 7.67e-6):.1e}"
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

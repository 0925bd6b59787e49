"""What the measured points say: the front, ratios at equal error, the method for N digits."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from replication.bench.measure import Timing
from replication.bench.task import Measure

__all__ = ["DIGITS", "HALF_ULP", "Choice", "Point", "choices", "error_for", "fastest", "front"]

HALF_ULP = 2.0**-53
"""The relative error of a correctly rounded answer. Being nearer is luck and earns nothing."""

DIGITS = (1, 2, 3, 4, 6, 8, 10, 12, 13, 14, 15)


@dataclass(frozen=True, slots=True)
class Point:
    """A method at a setting, measured: its error and the seconds a case, or the gap's reason."""

    method: str
    setting: str
    measure: Measure
    cases: int
    error: float | None = None
    timing: Timing | None = None
    gap: str = ""

    @property
    def seconds(self) -> float:
        """Best time a case; infinite for a gap."""
        return math.inf if self.timing is None else self.timing.best

    @property
    def met(self) -> float:
        """The error that counts: not less than half an ulp; infinite for a gap."""
        return math.inf if self.error is None else max(self.error, HALF_ULP)


def front(points: Iterable[Point]) -> list[Point]:
    """The points that no other beats in time without loss of accuracy; the fastest first.

    >>> points = [Point("a", "", "depth", 1, e, Timing(t, t, 1, 1)) for e, t in
    ...           ((1e-3, 1.0), (1e-6, 2.0), (1e-5, 3.0))]
    >>> [point.error for point in front(points)]
    [0.001, 1e-06]
    """
    kept: list[Point] = []
    for point in sorted(points, key=lambda point: (point.seconds, point.met)):
        if point.met < min((other.met for other in kept), default=math.inf):
            kept.append(point)
    return kept


def fastest(points: Iterable[Point], error: float) -> Point | None:
    """The fastest of those whose error is at most the given one; None if there is none."""
    able = [point for point in points if point.met <= error]
    return min(able, key=lambda point: (point.seconds, point.met), default=None)


def error_for(digits: int) -> float:
    """The greatest relative error that leaves so many digits correct.

    >>> error_for(3)
    0.0005
    """
    return 0.5 * 10.0**-digits


@dataclass(frozen=True, slots=True)
class Choice:
    """For so many digits: the fastest of all methods, of ours and of the peers; None where none is.

    A method's every setting competes, so that each side comes with its loosest one that will do.
    """

    digits: int
    best: Point | None
    ours: Point | None
    peer: Point | None

    @property
    def ratio(self) -> float | None:
        """How many times faster ours is than the peer, at equal or better error."""
        return self._lead(self.ours)

    @property
    def best_ratio(self) -> float | None:
        """How many times faster the best is than the peer, 1 where it is the peer."""
        return self._lead(self.best)

    def _lead(self, point: Point | None) -> float | None:
        if point is None or self.peer is None:
            return None
        return self.peer.seconds / point.seconds


def choices(points: Sequence[Point], ours: Iterable[str], peers: Iterable[str]) -> list[Choice]:
    """A choice for each of `DIGITS`, among the points of one case and one measure."""
    own, other = set(ours), set(peers)
    found = []
    for digits in DIGITS:
        error = error_for(digits)
        found.append(
            Choice(
                digits,
                fastest(points, error),
                fastest((point for point in points if point.method in own), error),
                fastest((point for point in points if point.method in other), error),
            )
        )
    return found

"""A small picture of a claim: the interval of its print, the value in it, the proven range."""

from collections.abc import Sequence
from dataclasses import dataclass

__all__ = ["Gauge", "gauge"]


@dataclass(frozen=True, slots=True)
class Gauge:
    """Positions from 0 to 100, left to right.

    `band` is the interval that agrees with the print, `proven` the proven range, `value` ours;
    `far` is -1 or 1 where the value lies outside the picture, on that side. `words` say it.
    """

    band: tuple[float, float]
    proven: tuple[float, float]
    value: float
    far: int
    words: str


def gauge(interval: Sequence[float | None], computed: float, enclosure: Sequence[float]) -> Gauge:
    """The picture of a claim's interval (an end may be None: unbounded), value, proven range.

    The band is the middle third; of an unbounded interval, all on its side of the bound; of an
    exact one, its point.

    >>> gauge((0.2775, 0.2785), 0.278, (0.2779, 0.2781)).band
    (33.3, 66.7)
    >>> gauge((7.0, 8.0), 9.5, (9.4, 9.6)).far
    1
    """
    left, right = _window(interval, computed)

    def place(x: float | None, open_end: float) -> float:
        share = open_end if x is None else (x - left) / (right - left)
        return round(100 * min(max(share, 0.0), 1.0), 1)

    low, high = interval
    return Gauge(
        band=(place(low, 0.0), place(high, 1.0)),
        proven=(place(enclosure[0], 0.0), place(enclosure[1], 1.0)),
        value=place(computed, 0.0),
        far=(computed > right) - (computed < left),
        words=_words(low, high, computed),
    )


def _window(interval: Sequence[float | None], computed: float) -> tuple[float, float]:
    """What the picture's ends stand for."""
    low, high = interval
    if low is not None and high is not None and low < high:
        return low - (high - low), high + (high - low)
    bound = high if low is None else low
    assert bound is not None
    reach = 1.5 * abs(computed - bound) or abs(bound) or 1.0
    return bound - reach, bound + reach


def _words(low: float | None, high: float | None, computed: float) -> str:
    if low is not None and computed < low:
        return f"{computed:.6g} is below {low:.6g}"
    if high is not None and computed > high:
        return f"{computed:.6g} is above {high:.6g}"
    ends = [f"{sign} {x:.6g}" for sign, x in (("≥", low), ("≤", high)) if x is not None]
    return f"{computed:.6g} agrees: " + " and ".join(ends)

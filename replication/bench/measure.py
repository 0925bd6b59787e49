"""How long a call takes: warmed up, repeated, within a limit."""

import _thread
import signal
import statistics
import threading
import timeit
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from types import FrameType
from typing import Any

__all__ = ["Stopwatch", "Timing", "time_limit"]

BATCH = 5e-3
"""A call is repeated without a look at the clock for about so many seconds: ten thousand times what
reading the clock costs."""


@dataclass(frozen=True, slots=True)
class Timing:
    """Seconds a call: the best and the median of `repeats` batches of `calls` calls."""

    best: float
    median: float
    repeats: int
    calls: int

    def per(self, cases: int) -> "Timing":
        """Seconds a case, for a call that does so many at once."""
        return replace(self, best=self.best / cases, median=self.median / cases)


class Stopwatch:
    """A call, warmed up, to be timed batch by batch, so that several can take turns.

    `answer` is what the call returned. Raises TimeoutError where two calls are not done within the
    limit [s], and whatever the call raises. Fewer batches than `repeat` are timed where so many
    would take longer than the limit.

    >>> watch = Stopwatch(lambda: sum(range(100)), repeat=3, limit=5.0)
    >>> for _ in range(5):
    ...     watch.batch()
    >>> watch.answer, watch.timing.repeats, 0 < watch.timing.best <= watch.timing.median
    (4950, 3, True)
    """

    def __init__(self, call: Callable[[], Any], repeat: int, limit: float) -> None:
        answers: list[Any] = []
        with time_limit(limit):
            # The first call pays for imports and caches. Both go through timeit because it turns
            # the garbage collector off, in whose callbacks the end of the time would be lost.
            timeit.timeit(lambda: answers.append(call()), number=1)
            once = timeit.timeit(call, number=1)
        self.answer, self._call = answers[0], call
        self._calls = max(1, round(BATCH / once))
        self._repeats = max(1, min(repeat, int(limit / (once * self._calls))))
        self._batches: list[float] = []

    def batch(self) -> None:
        """Time a batch, if all are not yet done."""
        if len(self._batches) < self._repeats:
            seconds = timeit.timeit(self._call, number=self._calls)
            self._batches.append(seconds / self._calls)

    @property
    def timing(self) -> Timing:
        """Of the batches so far."""
        best, median = min(self._batches), statistics.median(self._batches)
        return Timing(best, median, len(self._batches), self._calls)


@contextmanager
def time_limit(seconds: float) -> Iterator[None]:
    """Raise TimeoutError in the body when it takes longer; in the main thread only.

    It ends Python code and what calls back into it, as all peers do; a single long call into C is
    ended when it returns. The clock is good to the interpreter's switch between threads, 5 ms, so
    that what is done sooner is never late. A keyboard interrupt remains one.
    """
    late = threading.Event()
    before = signal.getsignal(signal.SIGINT)

    def ring() -> None:
        late.set()
        _thread.interrupt_main()

    def interrupted(number: int, frame: FrameType | None) -> None:
        if late.is_set():
            raise TimeoutError(f"not done in {seconds:g} s")
        if callable(before):
            before(number, frame)

    timer = threading.Timer(seconds, ring)
    signal.signal(signal.SIGINT, interrupted)
    timer.start()
    try:
        try:
            yield
        finally:
            timer.cancel()
            timer.join()  # no ring after this: one that was late is raised here, not later
    finally:
        signal.signal(signal.SIGINT, before)

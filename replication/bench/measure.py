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

__all__ = ["Timing", "measure", "time_limit"]

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


def measure(call: Callable[[], Any], repeat: int, limit: float) -> tuple[Any, Timing]:
    """What a call returns, and how long it takes once everything is warm.

    Raises TimeoutError where two calls are not done within the limit [s], and whatever the call
    raises. Fewer batches than `repeat` are timed where so many would take longer than the limit.

    >>> answer, timing = measure(lambda: sum(range(100)), repeat=3, limit=5.0)
    >>> answer, timing.repeats, 0 < timing.best <= timing.median
    (4950, 3, True)
    """
    answers: list[Any] = []
    with time_limit(limit):
        # The first call pays for imports and caches. Both go through timeit because it turns the
        # garbage collector off, in whose callbacks the end of the time would be lost.
        timeit.timeit(lambda: answers.append(call()), number=1)
        once = timeit.timeit(call, number=1)
    calls = max(1, round(BATCH / once))
    repeats = max(1, min(repeat, int(limit / (once * calls))))
    batches = timeit.repeat(call, repeat=repeats, number=calls)
    best, median = min(batches) / calls, statistics.median(batches) / calls
    return answers[0], Timing(best, median, repeats, calls)


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

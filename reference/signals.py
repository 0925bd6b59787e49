"""Signals that would end the program wait while something runs that must not be cut in two.

It stands here as the one package that all others may import.
"""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread

ENDING = [
    getattr(signal, name)
    for name in ("SIGINT", "SIGTERM", "SIGHUP")
    if hasattr(signal, name)  # Windows has no SIGHUP
]
"""The signals with which somebody, or the system, ends a program."""


@contextmanager
def postponed_signals() -> Iterator[None]:
    """Postpone signals that would end the program until the block ends.

    Only the main thread can do so; in any other thread nothing is postponed.

    >>> done = []
    >>> try:
    ...     with postponed_signals():
    ...         signal.raise_signal(signal.SIGINT)
    ...         done.append("work")
    ... except KeyboardInterrupt:
    ...     done.append("interrupted")
    >>> done
    ['work', 'interrupted']
    """
    if current_thread() is not main_thread():
        yield
        return
    received: list[int] = []
    handlers = {}
    for number in ENDING:
        if signal.getsignal(number) not in (signal.SIG_IGN, None):
            handlers[number] = signal.signal(number, lambda number, _: received.append(number))
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        for number in received[:1]:
            signal.raise_signal(number)

"""Other processes to compute in: spawned, deaf to Ctrl-C, and gone when their parent is."""

import os
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from functools import partial
from multiprocessing import get_context, parent_process
from typing import Any

__all__ = ["second_process", "spawned"]

Start = Callable[..., Callable[[], Any]]
"""Starts a function of some arguments; what it returns waits for the result, or its error."""


@contextmanager
def spawned(processes: int) -> Iterator[ProcessPoolExecutor]:
    """A pool of so many processes, which end with the block; work that waits then is dropped.

    Raises ChildProcessError where a process was killed from outside.
    """
    # Spawned, not forked: a fork of a process with threads, such as pyarrow's, may hang.
    pool = ProcessPoolExecutor(processes, get_context("spawn"), _prepare)
    try:
        yield pool
    except BrokenProcessPool as error:
        raise ChildProcessError("one of its processes was killed from outside") from error
    finally:
        pool.shutdown(cancel_futures=True)


@contextmanager
def second_process() -> Iterator[Start]:
    """Start functions beside this process, one after the other; on a single core, when asked for.

    >>> with second_process() as start:
    ...     seven = start(max, 3, 7)
    ...     seven()
    7
    """
    if (os.cpu_count() or 1) == 1:
        yield partial
        return
    with spawned(1) as pool:
        yield lambda function, *arguments: pool.submit(function, *arguments).result


def _prepare() -> None:
    """Ctrl-C and a hangup are the parent's to answer; without a parent nothing is left to do."""
    for name in ("SIGINT", "SIGHUP"):
        if hasattr(signal, name):  # Windows has no hangup
            signal.signal(getattr(signal, name), signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    # A killed parent cannot stop its pool (CPython issue 111873): the workers would wait for ever.
    parent = parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)

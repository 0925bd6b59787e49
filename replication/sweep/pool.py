"""Blocks computed in several processes, handed on in their order, few at a time."""

import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Generator, Iterable
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context, parent_process
from typing import TypeVar

__all__ = ["in_order", "worthwhile_processes"]

Piece = TypeVar("Piece")


def worthwhile_processes(blocks: int) -> int:
    """How many processes make a sweep faster: one for each eight blocks, up to one for each core.

    To start them takes half a second, a block 0.03 s (Parquet) to 0.25 s (CSV).
    """
    return max(1, min(os.cpu_count() or 1, blocks // 8))


def in_order(
    work: Callable[[int], Piece], numbers: Iterable[int], processes: int
) -> Generator[Piece, None, None]:
    """`map(work, numbers)`, by as many processes; no more than three results a process wait.

    Raises what `work` raises, and ChildProcessError where a process was killed from outside.
    """
    if processes == 1:
        yield from map(work, numbers)
        return
    # Spawned, not forked: a fork of a process with threads, such as pyarrow's, may hang.
    pool = ProcessPoolExecutor(processes, get_context("spawn"), _prepare)
    try:
        waiting: deque[Future[Piece]] = deque()
        for number in numbers:
            waiting.append(pool.submit(work, number))
            if len(waiting) > 3 * processes:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    except BrokenProcessPool as error:
        raise ChildProcessError("a process of the sweep was killed from outside") from error
    finally:
        pool.shutdown(cancel_futures=True)


def _prepare() -> None:
    """Ctrl-C is the parent's to answer; and without a parent there is nothing left to do."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    # A killed parent cannot stop its pool (CPython issue 111873): the workers would wait for ever.
    parent = parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)

"""Random numbers that belong to a case: the same in every block, process and machine."""

import numpy as np

from replication.sweep.sources import LEAST_SHARE, Floats

__all__ = ["uniform"]


def uniform(seed: int, stream: int, first: int, count: int) -> Floats:
    """Uniform numbers in (0, 1) of the cases from `first` on, shape (count,).

    Each is a function of the seed, the stream (one for each input) and the number of its case:
    Philox encrypts that number, four words at a time. 52 bits and a half leave neither 0 nor 1.

    >>> bool((uniform(1, 0, 0, 10)[7:] == uniform(1, 0, 7, 3)).all())
    True
    """
    philox = np.random.Philox(key=np.array([seed, stream], dtype=np.uint64), counter=first // 4)
    words = philox.random_raw(first % 4 + count)[first % 4 :]
    return ((words >> np.uint64(12)).astype(np.float64) + 0.5) * (2 * LEAST_SHARE)

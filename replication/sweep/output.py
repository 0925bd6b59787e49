"""A sweep's file, block after block: whole under its name, or not there."""

from collections.abc import Callable
from contextlib import closing
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from replication.sweep.compute import Block, block
from replication.sweep.formats import FORMATS
from replication.sweep.plan import BLOCK, Plan
from replication.sweep.pool import in_order
from spreadsheets.safely import check_target, draft_of

__all__ = ["check_output", "write"]


def write(
    plan: Plan,
    path: Path,
    *,
    numbers: range | None = None,
    processes: int = 1,
    done: Callable[[int], object] = lambda _: None,
) -> None:
    """Compute the blocks of these numbers (default: all) and write them to one file.

    The suffix of the path says which: .csv or .parquet. `done` is told the number of cases of each
    block that is written. The same plan and numbers make the same bytes, whatever the processes.
    Raises ValueError and OSError as `check_output` and `block` do, and leaves no file then.
    """
    check_output(path)
    form = FORMATS[path.suffix.lower()]
    numbers = range(plan.blocks) if numbers is None else numbers
    pieces = in_order(partial(_piece, form.piece, plan), numbers, processes)
    with closing(pieces), draft_of(path) as draft, form.open(draft, plan) as put:
        for number, piece in zip(numbers, pieces, strict=True):
            put(piece)
            done(min(BLOCK, plan.count - number * BLOCK))


def _piece(of: Callable[[Block], Any], plan: Plan, number: int) -> Any:
    return of(block(plan, number))


def check_output(path: Path) -> None:
    """Whether a sweep can be written there, before it is computed.

    Raises ValueError for another suffix and where Parquet's library is missing, OSError as
    `check_target` does.
    """
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise ValueError(f"{path}: the file's name must end in {' or '.join(FORMATS)}")
    if suffix == ".parquet" and find_spec("pyarrow") is None:
        raise ValueError("Parquet needs pyarrow: python -m pip install 'coldspray[parquet]'")
    check_target(path)

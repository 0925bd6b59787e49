"""The files that a sweep can become: CSV and Parquet."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy.typing as npt

from replication.sweep.compute import Block, columns
from replication.sweep.plan import BLOCK, Plan

__all__ = ["FORMATS", "Format", "csv_lines", "provenance"]


@dataclass(frozen=True, slots=True)
class Format:
    """`piece` makes of a block what `open`, a file to be, is then given to write, block by block.

    The first runs in the process that computes, the second in the one that writes.
    """

    piece: Callable[[Block], Any]
    open: Callable[[Path, Plan], AbstractContextManager[Callable[[Any], object]]]


def csv_lines(values: Block) -> bytes:
    r"""The lines of a block, numbers with all digits.

    A column of one value, as most inputs are, is spelt once: that halves the time, which is spent
    in spelling doubles.

    >>> import numpy as np
    >>> csv_lines({"beta": np.array([5.0, 5.0]), "radius": np.array([1e-6, 2e-6])})
    b'5.0,1e-06\n5.0,2e-06\n'
    """
    count = len(next(iter(values.values())))
    varying = {name for name, column in values.items() if (column != column[0]).any()}
    line = ",".join("%s" if name in varying else _spelt(values[name])[0] for name in values)
    texts = zip(*(_spelt(values[name]) for name in values if name in varying), strict=True)
    lines = map(f"{line}\n".__mod__, texts) if varying else [f"{line}\n"] * count
    return "".join(lines).encode("ascii")


def _spelt(column: npt.NDArray[Any]) -> list[str]:
    if column.dtype == bool:
        return ["true" if value else "false" for value in column.tolist()]
    return list(map(repr, column.tolist()))


@contextmanager
def _csv(path: Path, plan: Plan) -> Iterator[Callable[[bytes], object]]:
    heads = (f"{name} [{unit}]" if unit else name for name, (unit, _) in columns(plan).items())
    with path.open("wb") as file:
        file.write(f"{','.join(heads)}\n".encode("ascii"))
        yield file.write


def _as_it_is(values: Block) -> Block:
    return values


@contextmanager
def _parquet(path: Path, plan: Plan) -> Iterator[Callable[[Block], object]]:
    import pyarrow as pa
    from pyarrow.parquet import ParquetWriter

    types = {float: pa.float64(), bool: pa.bool_(), int: pa.int64()}
    fields = [
        pa.field(name, types[kind], nullable=False, metadata={"unit": unit})
        for name, (unit, kind) in columns(plan).items()
    ]
    schema = pa.schema(fields, metadata=provenance(plan))
    # Dictionaries do not pay: the results hardly repeat, and the inputs compress as they are.
    with (
        path.open("wb") as sink,  # Python's own file, whose errors have a number
        ParquetWriter(sink, schema, compression="zstd", use_dictionary=False) as file,
    ):
        yield lambda values: file.write_table(pa.table(values, schema), BLOCK)


def provenance(plan: Plan) -> dict[str, str]:
    """What a file comes from: the program's version and the SHA-256 of the sweep's TOML file."""
    return {"coldspray": version("coldspray"), "sweep_sha256": plan.digest}


FORMATS = {".csv": Format(csv_lines, _csv), ".parquet": Format(_as_it_is, _parquet)}

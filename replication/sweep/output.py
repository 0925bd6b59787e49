"""A sweep's file, CSV or Parquet by pyarrow: whole under its name, or not there."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version
from pathlib import Path
from typing import Any

from replication.sweep.plan import BLOCK, Plan, compute
from spreadsheets.safely import check_target, draft_of

SUFFIXES = (".csv", ".parquet")


def write(
    plan: Plan,
    path: Path,
    *,
    numbers: range | None = None,
    done: Callable[[int], object] = lambda _: None,
) -> None:
    """Compute the blocks of these numbers (default: all) and write them to one file.

    The suffix of the path says which: .csv or .parquet. `done` is told the number of cases of each
    block. The same plan and numbers make the same bytes. Raises ValueError and OSError as
    `check_output` and `compute` do, and leaves no file then.
    """
    import pyarrow as pa

    check_output(path)
    types = {float: pa.float64(), bool: pa.bool_(), int: pa.int64()}
    schema = pa.schema(
        [
            pa.field(name, types[kind], nullable=False, metadata={"unit": unit})
            for name, (unit, kind) in plan.columns.items()
        ],
        metadata=provenance(plan),
    )
    numbers = range(plan.blocks) if numbers is None else numbers
    with (
        draft_of(path) as draft,
        draft.open("wb") as file,  # Python's own, whose errors have a number
        _writer(path.suffix.lower(), file, plan, schema) as writer,
        ThreadPoolExecutor(1) as pool,  # a block is written while the next is computed
    ):
        written = pool.submit(lambda: None)
        for number in numbers:
            first = number * BLOCK
            count = min(BLOCK, plan.count - first)
            table = pa.table(compute(plan, first, count), schema)
            written.result()
            written = pool.submit(writer.write_table, table)
            done(count)
        written.result()


def _writer(suffix: str, file: Any, plan: Plan, schema: Any) -> Any:
    if suffix == ".csv":
        from pyarrow.csv import CSVWriter, WriteOptions

        heads = (f"{name} [{unit}]" if unit else name for name, (unit, _) in plan.columns.items())
        file.write(f"{','.join(heads)}\n".encode("ascii"))
        return CSVWriter(file, schema, write_options=WriteOptions(include_header=False))
    from pyarrow.parquet import ParquetWriter

    # Dictionaries do not pay: the results hardly repeat, and the inputs compress as they are.
    return ParquetWriter(file, schema, compression="zstd", use_dictionary=False)


def provenance(plan: Plan) -> dict[str, str]:
    """What a file comes from: the program's version and the SHA-256 of the sweep's TOML file."""
    return {"coldspray": version("coldspray"), "sweep_sha256": plan.digest}


def check_output(path: Path) -> None:
    """Whether a sweep can be written there, before it is computed.

    Raises ValueError for another suffix, OSError as `check_target` does.
    """
    if path.suffix.lower() not in SUFFIXES:
        raise ValueError(f"{path}: the file's name must end in {' or '.join(SUFFIXES)}")
    check_target(path)

"""`coldspray bench`: speed against error, every method and its peers in one run."""

import argparse
import sys
from collections.abc import Iterable, Sequence
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any

from replication.cli import options as shared
from replication.reading import place, read_number

if TYPE_CHECKING:
    from replication.bench.run import Trial, Watch

HELP = "speed against error: every method and its peers"


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--case", action="append", metavar="NAME", help="only this case; may be repeated"
    )
    command.add_argument(
        "--quick", action="store_true", help="beta-5 unless --case is given, 1 repeat, 1 s"
    )
    command.add_argument("--repeat", type=shared.whole(1, 10_000), metavar="N", help="repeats (7)")
    command.add_argument("--limit", metavar="X", help="for each task, in s or with its unit (5 s)")
    command.add_argument(
        "--out", type=shared.path, metavar="DIR", help="also write JSON, CSV, text and figures"
    )
    shared.output_options(command, csv=True, quiet="no progress")


def run(options: argparse.Namespace) -> int:
    from replication.bench.cases import CASES
    from replication.bench.report import bench_record, bench_rows, bench_text, check, write
    from replication.bench.run import bench
    from replication.plain import rows_csv

    names = list(dict.fromkeys(options.case or (["beta-5"] if options.quick else CASES)))
    if options.out is not None:
        check(options.out, names)
    done = bench(names, **_effort(options), watch=_watch(options))
    if options.out is not None:
        write(done, options.out)
    if options.json:
        shared.print_json(bench_record(done))
    elif options.csv:
        sys.stdout.write(rows_csv(bench_rows(done)))
    else:
        print(bench_text(done))
    return 0


def _effort(options: argparse.Namespace) -> dict[str, Any]:
    """Repeats and limit: as given, or as much as a quick or a full run takes."""
    repeat, limit = (1, 1.0) if options.quick else (7, 5.0)
    if options.limit is not None:
        with place("--limit"):
            limit = read_number(options.limit, "s")
    return {
        "repeat": repeat if options.repeat is None else options.repeat,
        "limit": limit,
    }


def _watch(options: argparse.Namespace) -> "Watch":
    """A progress bar on standard error, if that is a terminal."""
    from tqdm import tqdm

    quiet = True if options.quiet else None  # None: tqdm looks whether it is a terminal

    def watch(visits: "Sequence[Trial]", name: str) -> "AbstractContextManager[Iterable[Trial]]":
        bar: AbstractContextManager[Iterable[Trial]] = tqdm(
            visits, desc=name, disable=quiet, leave=False
        )
        return bar

    return watch

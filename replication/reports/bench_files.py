"""The files of `coldspray bench --out`: everything that one run has measured."""

from collections.abc import Sequence
from pathlib import Path

from replication.bench.run import Bench
from replication.reports.bench import bench_record, bench_rows
from replication.reports.bench_figure import image
from replication.reports.bench_text import bench_text
from replication.reports.plain import json_text, rows_csv
from spreadsheets.safely import check_folder, write_folder

__all__ = ["check", "write"]

TEXTS = ("bench.txt", "bench.json", "bench.csv")
FORMATS = ("svg", "png")


def check(folder: Path, cases: Sequence[str]) -> None:
    """Raise OSError where the files of a run on these cases cannot be written."""
    check_folder(folder, [*TEXTS, *(_figure(case, kind) for case in cases for kind in FORMATS)])


def write(done: Bench, folder: Path) -> None:
    """Write bench.txt, .json and .csv, and a figure a case, into a folder, made if needed.

    All or none. Raises OSError.
    """
    record = bench_record(done)
    texts = (bench_text(done) + "\n", json_text(record), rows_csv(bench_rows(record)))
    files = {name: text.encode() for name, text in zip(TEXTS, texts, strict=True)}
    for result in done.results:
        for kind in FORMATS:
            files[_figure(result.case.name, kind)] = image(result, kind)
    write_folder(folder, files)


def _figure(case: str, kind: str) -> str:
    return f"bench-{case}.{kind}"

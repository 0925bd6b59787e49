"""`coldspray bench`: measure speed against error, of every method and its peers, in one run."""

import argparse
import sys

from replication.cli.options import add_csv_and_json, add_quiet, path, whole
from replication.cli.output import width
from replication.user_input import place, read_number

HELP = "measure speed against error: every method and its peers"
EXAMPLE = "coldspray bench --case beta-5 --quick"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--case", metavar="NAME", action="append", help="only this case; may be repeated"
    )
    parser.add_argument(
        "--quick", action="store_true",
        help="a short run: beta-5 unless --case is given, 1 repeat, 1 s",
    )  # fmt: skip
    parser.add_argument(
        "--repeat", metavar="N", type=whole(1, 10_000), help="number of repeats (default: 7)"
    )
    parser.add_argument(
        "--limit", metavar="X", help="time for each task, in s or with its unit (default: 5 s)"
    )
    parser.add_argument(
        "--out", metavar="DIR", type=path, help="also write JSON, CSV, text and figures"
    )
    add_csv_and_json(parser)
    add_quiet(parser, "no progress")


def run(options: argparse.Namespace) -> int:
    """Measure, write the files if asked to, and print the table."""
    from replication.models.arrays import import_numba
    from spreadsheets.safely import check_folder

    if options.out is not None:
        check_folder(options.out, ["bench.txt"])
    import_numba()  # before other modules do: it says what is wrong with its surroundings
    from replication.bench.measure import BENCH_CASES, bench
    from replication.bench.show import texts, write_bench

    names = list(dict.fromkeys(options.case or (["beta-5"] if options.quick else BENCH_CASES)))
    repeat, limit = (1, 1.0) if options.quick else (7, 5.0)
    if options.limit is not None:
        with place("--limit"):
            limit = read_number(options.limit, "s")
    # None shows the progress bar on a terminal only.
    record = bench(names, options.repeat or repeat, limit, quiet=options.quiet or None)
    if options.out is not None:
        write_bench(options.out, record)
    form = "json" if options.json else "csv" if options.csv else "txt"
    sys.stdout.write(texts(record, width(piped=10_000))[f"bench.{form}"])
    return 0

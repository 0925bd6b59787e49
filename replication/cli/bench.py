"""`coldspray bench`: speed against error, every method and its peers in one run."""

import argparse
import sys

from replication.cli import options as shared
from replication.reading import place, read_number

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
    from replication.bench import CASES, bench, texts, write
    from spreadsheets.safely import check_folder

    names = list(dict.fromkeys(options.case or (["beta-5"] if options.quick else CASES)))
    if options.out is not None:
        check_folder(options.out, ["bench.txt"])
    repeat, limit = (1, 1.0) if options.quick else (7, 5.0)
    if options.limit is not None:
        with place("--limit"):
            limit = read_number(options.limit, "s")
    # Without a terminal (None) there is no bar.
    record = bench(names, options.repeat or repeat, limit, quiet=options.quiet or None)
    if options.out is not None:
        write(options.out, record)
    form = "json" if options.json else "csv" if options.csv else "txt"
    sys.stdout.write(texts(record)[f"bench.{form}"])
    return 0

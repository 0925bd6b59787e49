"""The commands that compute many cases: sweep, by a plan; bench, by every method."""

import argparse
import sys
from pathlib import Path

from replication.cli import options as shared
from replication.reading import one_line, place, read_number


def sweep_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("plan", type=shared.path, metavar="FILE", help="TOML, table [inputs]")
    told = "ends in .csv or .parquet (default: the plan's name with .csv, in this folder)"
    command.add_argument("-o", "--output", type=shared.path, metavar="FILE", help=told)
    command.add_argument("--json", action="store_true", help="print JSON: file, cases, columns")
    command.add_argument("--quiet", action="store_true", help="no progress, no word at the end")


def run_sweep(options: argparse.Namespace) -> int:
    from replication.sweep import check_output, provenance, read_plan, write

    plan = read_plan(options.plan)
    output = options.output or Path(f"{options.plan.stem}.csv")
    check_output(output)
    if output.resolve() == options.plan.resolve():
        raise ValueError(f"{output} is the plan itself: give another -o")
    bar = shared.progress(options, total=plan.count, unit=" cases", unit_scale=True)
    with bar, place(str(options.plan)):
        write(plan, output, done=bar.update)
    if options.json:
        record = {"file": str(output), "cases": plan.count, "columns": plan.columns}
        shared.print_json(record | provenance(plan))
    elif not options.quiet:
        print(f"Written: {one_line(str(output))} ({plan.count} cases)")
    return 0


def bench_options(command: argparse.ArgumentParser) -> None:
    only, quick = "only this case; may be repeated", "beta-5 unless --case is given, 1 repeat, 1 s"
    command.add_argument("--case", action="append", metavar="NAME", help=only)
    command.add_argument("--quick", action="store_true", help=quick)
    shared.whole_option(command, "--repeat", 1, 10_000, "repeats (7)")
    command.add_argument("--limit", metavar="X", help="for each task, in s or with its unit (5 s)")
    out = "also write JSON, CSV, text and figures"
    command.add_argument("--out", type=shared.path, metavar="DIR", help=out)
    shared.output_options(command, csv=True, quiet="no progress")


def run_bench(options: argparse.Namespace) -> int:
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

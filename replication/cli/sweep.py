"""`coldspray sweep`: many cases by a plan, to CSV or Parquet."""

import argparse
from pathlib import Path

from replication.cli import options as shared
from replication.reading import name_of, place

HELP = "many cases by a TOML plan, to CSV or Parquet"


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("plan", type=shared.path, metavar="FILE", help="TOML, table [inputs]")
    command.add_argument(
        "-o",
        "--output",
        type=shared.path,
        metavar="FILE",
        help="ends in .csv or .parquet (default: the plan's name with .csv, in this folder)",
    )
    command.add_argument("--json", action="store_true", help="print JSON: file, cases, columns")
    command.add_argument("--quiet", action="store_true", help="no progress, no word at the end")


def run(options: argparse.Namespace) -> int:
    from tqdm import tqdm

    from replication.sweep import check_output, provenance, read_plan, write

    plan = read_plan(options.plan)
    output = options.output or Path(f"{options.plan.stem}.csv")
    check_output(output)
    if output.resolve() == options.plan.resolve():
        raise ValueError(f"{output} is the plan itself: give another -o")
    # Without a terminal (None) there is no bar.
    bar = tqdm(total=plan.count, unit=" cases", unit_scale=True, disable=options.quiet or None)
    with bar, place(name_of(options.plan)):
        write(plan, output, done=bar.update)
    if options.json:
        record = {"file": str(output), "cases": plan.count, "columns": plan.columns}
        shared.print_json(record | provenance(plan))
    elif not options.quiet:
        print(f"Written: {name_of(output)} ({plan.count} cases)")
    return 0

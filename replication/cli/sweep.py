"""`coldspray sweep`: compute the many cases of a plan, and write them as CSV or Parquet."""

import argparse
from pathlib import Path

from replication.cli.options import add_json, add_quiet, path
from replication.cli.output import progress, put
from replication.reading import one_line, place

HELP = "run many cases from a TOML plan, to CSV or Parquet"
EXAMPLE = "coldspray sweep docs/sweeps/grid.toml -o grid.parquet"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "plan", metavar="FILE", type=path, help="a plan: TOML with a table [inputs]"
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", type=path,
        help="ends in .csv or .parquet (default: the plan's name with .csv, in this folder)",
    )  # fmt: skip
    add_json(parser, "print JSON: file, cases, columns")
    add_quiet(parser, "no progress, no closing line")


def run(options: argparse.Namespace) -> int:
    """Write the file of the plan's cases, whole or not at all."""
    from replication.sweep import check_output, provenance, read_plan, write

    plan = read_plan(options.plan)
    output = options.output or Path(f"{options.plan.stem}.csv")
    check_output(output)
    if output.resolve() == options.plan.resolve():
        raise ValueError(f"{output} is the plan itself: give another -o")
    bar = progress(options, total=plan.count, unit=" cases", unit_scale=True)
    with bar, place(str(options.plan)):
        write(plan, output, done=bar.update)
    record = {"file": str(output), "cases": plan.count, "columns": plan.columns}
    text = f"Written: {one_line(str(output))} ({plan.count} cases)"
    return put(options, record | provenance(plan), lambda: text, quietly=True)

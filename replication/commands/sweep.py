"""`coldspray sweep`: many cases by a plan, to CSV or Parquet."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from replication.commands import shared

if TYPE_CHECKING:
    from replication.sweep import Plan

HELP = "many cases by a TOML plan, to CSV or Parquet"


def options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.add_argument("plan", type=shared.path, metavar="FILE", help="TOML, table [inputs]")
    command.add_argument(
        "-o",
        "--output",
        type=shared.path,
        metavar="FILE",
        help="ends in .csv or .parquet (default: the plan's name with .csv, in this folder)",
    )
    command.add_argument(
        "--processes",
        type=int,
        metavar="N",
        help="default: by the work, up to one a core",
    )
    command.add_argument("--json", action="store_true", help="print JSON: file, cases, columns")
    command.add_argument("--quiet", action="store_true", help="no progress, no word at the end")


def run(options: argparse.Namespace) -> int:
    """Compute and write, with a progress bar on a terminal."""
    from tqdm import tqdm

    from replication.sweep.output import check_output, write
    from replication.sweep.pool import worthwhile_processes
    from replication.sweep.read import read_plan
    from replication.sweep.tables import place

    plan = read_plan(options.plan)
    output = options.output or Path(f"{options.plan.stem}.csv")
    check_output(output)
    if output.resolve() == options.plan.resolve():
        raise ValueError(f"{output} is the plan itself: give another -o")
    if options.processes is not None and options.processes < 1:
        raise ValueError("--processes wants 1 or more")
    processes = options.processes or worthwhile_processes(plan.blocks)
    # Without a terminal (None) there is no bar.
    bar = tqdm(total=plan.count, unit=" cases", unit_scale=True, disable=options.quiet or None)
    with bar, place(str(options.plan)):
        write(plan, output, processes=processes, done=bar.update)
    if options.json:
        shared.print_json(_record(output, plan))
    elif not options.quiet:
        print(f"Written: {output} ({plan.count} cases)")
    return 0


def _record(output: Path, plan: "Plan") -> dict[str, Any]:
    from replication.sweep.compute import columns
    from replication.sweep.formats import provenance

    units = {name: unit for name, (unit, _) in columns(plan).items()}
    return {"file": str(output), "cases": plan.count, "columns": units, **provenance(plan)}

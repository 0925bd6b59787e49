"""`coldspray sweep`: compute the many cases of a plan, and write them as CSV or Parquet."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from replication.cli.case import EXPECTED, doubt
from replication.cli.options import add_json, add_quiet, path
from replication.cli.output import progress, put
from replication.cli.picture import add_plot, checked, drafted, notes_on
from replication.user_input import one_line, place

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from replication.plots import Points
    from replication.sweep import Plan

HELP = "run many cases from a TOML plan, to CSV or Parquet"
EXAMPLE = "coldspray sweep docs/sweeps/figure-5.toml -o figure-5.csv"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "plan", metavar="FILE", type=path, help="a plan: TOML with a table [inputs]"
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", type=path,
        help="ends in .csv or .parquet (default: the plan's name with .csv, in this folder)",
    )  # fmt: skip
    add_plot(parser, data="the varied input (if any), and depth or normalized depth")
    add_json(parser, "print JSON: file, cases, columns")
    add_quiet(parser, "no progress, no closing line")


def run(options: argparse.Namespace) -> int:
    """Write the file of the plan's cases, whole or not at all."""
    from replication.models.arrays import import_numba
    from replication.sweep import check_output, read_plan, sweep_provenance, write_sweep

    plan = read_plan(options.plan)
    output = options.output or Path(f"{options.plan.stem}.csv")
    check_output(output)
    import_numba()  # what is wrong with its settings is no fault of the plan
    if output.resolve() == options.plan.resolve():
        raise ValueError(f"{output} is the plan itself: give another -o")
    points = _checked(options, plan, output)
    bar = progress(options, total=plan.count, unit=" cases", unit_scale=True)
    with (
        bar,
        place(str(options.plan)),
        drafted(options, lambda: _sweep_figure(options, plan, points)),
    ):
        write_sweep(plan, output, done=bar.update)
    notes, warnings = notes_on(points), _doubts(plan)
    record = {"file": str(output), "cases": plan.count, "columns": plan.columns}
    record |= sweep_provenance(plan) | {"notes": notes, "warnings": warnings}
    cases = "1 case" if plan.count == 1 else f"{plan.count} cases"
    text = f"Written: {one_line(str(output))} ({cases})"
    return put(options, record, lambda: text, warnings=warnings, notes=notes, quietly=True)


def _doubts(plan: "Plan") -> list[str]:
    """Return a warning for every input of the plan with a value that no impact has."""
    import numpy as np

    warnings = []
    for name, source in plan.sources.items():
        if name in EXPECTED:
            # A distribution may have tails that go beyond what is expected, but not its middle.
            values = source.bounds if source.count else source.at(np.array([0.5])).tolist()
            named = name.replace("_", " ")
            odd = [words for value in values for words in doubt(name, value, named)]
            warnings += odd[:1]
    return warnings


def _checked(options: argparse.Namespace, plan: "Plan", output: Path) -> "Points | None":
    """Return one's own points, if any, once it is sure that the figure can be drawn and written."""
    if options.plot is None:
        return checked(options, lambda _: None)
    from replication.plots import check_sweep, sweep_points

    greatest = {name: source.bounds[1] for name, source in plan.sources.items()}
    with place(f"--plot: {options.plan}"):
        check_sweep(plan.axes, plan.samples, plan.is_drawn)
    return checked(options, sweep_points(plan.axes, plan.is_drawn, greatest), options.plan, output)


def _sweep_figure(options: argparse.Namespace, plan: "Plan", points: "Points | None") -> "Figure":
    from replication.plots import in_title, plot_sweep
    from replication.sweep import compute

    drawn = f", {plan.samples:,} drawn with seed {plan.seed}" if plan.is_drawn else ""
    title = f"{options.plan.name}: {in_title(plan.constants)}{drawn}"
    return plot_sweep(compute(plan, 0, plan.count), plan.axes, plan.is_drawn, title, points)

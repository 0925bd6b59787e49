"""`coldspray history`: print the exact depth and velocity of a case against time."""

import argparse
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from replication.cases import inputs_of
from replication.cli.case import add_inputs, case_of, in_words
from replication.cli.options import add_csv_and_json, add_quiet, times, whole
from replication.cli.output import paragraph, put
from replication.cli.picture import (
    add_plot,
    checked,
    notes_on,
    points_of_motion,
    write_picture,
)
from replication.models.impact import Impact
from replication.text import number, numbers

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from replication.plots import Points

HELP = "print the exact depth and velocity of a case against time"
EXAMPLE = "coldspray history --times '0 ns,5 ns,10 ns'"

MOST_POINTS = 1_000_000
"""The most times, counted or listed: their table is held in memory."""


def add_options(parser: argparse.ArgumentParser) -> None:
    wanted = parser.add_mutually_exclusive_group()
    wanted.add_argument(
        "--points", metavar="N", type=whole(2, MOST_POINTS), default=101,
        help="number of times, equally spaced from impact to rest (default: %(default)s)",
    )  # fmt: skip
    wanted.add_argument(
        "--times",
        metavar="T,...",
        help='these times, such as "0 ns,5 ns"; close to rest, a velocity is right to '
        "1e-14 of the impact velocity",
    )
    add_csv_and_json(parser)
    add_quiet(parser)
    add_plot(parser, data="time, and depth or velocity")
    add_inputs(parser, with_sheet=False)


def run(options: argparse.Namespace) -> int:
    """Print depth and velocity at the times asked for, and the time of rest."""
    from replication.models.motion import history, stop_time

    case, warnings = case_of(options)
    points = checked(options, lambda file: points_of_motion(file, case), options.case_file)
    stop = stop_time(**case.motion)
    if options.times is None:
        asked = [stop * (k / (options.points - 1)) for k in range(options.points)]
    else:
        asked = times("--times", options.times, MOST_POINTS)
    depth, velocity = [0.0] * len(asked), [0.0] * len(asked)
    history(asked, **case.motion, depth=depth, speed=velocity)
    lists = {"time": asked, "depth": depth, "velocity": velocity}
    write_picture(options, lambda: _history_figure(case, lists, points))
    table = list(zip(*lists.values(), strict=True))

    def text() -> str:
        heads = ("time [ns]", "x [um]", "velocity [m/s]")
        lines = numbers(heads, ((time * 1e9, x * 1e6, v) for time, x, v in table))
        return "\n".join(
            [paragraph(in_words(case)), "", *lines, "", f"stop time  {number(stop * 1e9, 8)} ns"]
        )

    notes = notes_on(points)
    record = {"inputs": inputs_of(case), **lists, "stop_time": stop}
    record |= {"warnings": warnings, "notes": notes}
    rows = [dict(zip(lists, row, strict=True)) for row in table] if options.csv else []
    return put(options, record, text, rows, warnings, notes)


def _history_figure(
    case: Impact, lists: Mapping[str, Sequence[float]], points: "Points | None"
) -> "Figure":
    from replication.plots import plot_history

    return plot_history(case, **lists, title=in_words(case), points=points)

"""The options --plot and --data of the commands that draw, and what is refused before they work."""

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from replication.cli.options import path
from replication.models.impact import Impact
from replication.user_input import place

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from replication.plots import Points


def add_plot(parser: argparse.ArgumentParser, *, data: str = "") -> None:
    """Add --plot; and, if `data` says which columns it needs, --data."""
    group = parser.add_argument_group("a figure")
    group.add_argument(
        "--plot", type=path, metavar="FILE", help="also draw it; ends in .svg, .png or .pdf"
    )
    if data:
        text = f"draw one's own points, too: CSV with columns of {data}"
        group.add_argument("--data", type=path, metavar="FILE", help=text)


def checked(
    options: argparse.Namespace, read: Callable[[Path], "Points | None"], *inputs: Path | None
) -> "Points | None":
    """Return one's own points, if any, before the work begins; `read` reads them from --data.

    inputs: the files that the command reads, which the figure must not overwrite. Raises ValueError
    or OSError if there is no such file of points, or if the figure could not be written.
    """
    data: Path | None = getattr(options, "data", None)  # not every command has it
    if options.plot is None:
        if data is not None:
            raise ValueError("--data is drawn in the figure of --plot: give that, too")
        return None
    from replication.plots import check_plot

    with place("--plot"):
        check_plot(options.plot, data, *inputs)
    return None if data is None else read(data)


def points_of_motion(file: Path, case: Impact) -> "Points":
    """Read one's own depths or velocities against time, which are drawn over the motion of a case.

    Raises as `checked` does.
    """
    from replication.plots import DEPTH, SPEED, TIME, reach_of, read_points

    return read_points(file, TIME, (DEPTH, SPEED), reach_of(case))


def notes_on(points: "Points | None") -> list[str]:
    """Return the notes on the file of one's own points, if there is one."""
    return [] if points is None else [*points.notes]


def write_picture(options: argparse.Namespace, figure: Callable[[], "Figure"]) -> None:
    """Write the figure, if it is asked for, whole or not at all."""
    with drafted(options, figure):
        pass


@contextmanager
def drafted(options: argparse.Namespace, figure: Callable[[], "Figure"]) -> Iterator[None]:
    """Draw the figure, if it is asked for; its file gets its name when the block has succeeded."""
    if options.plot is None:
        yield
        return
    from replication.plots import content
    from spreadsheets.safely import draft_of

    drawn = content(figure(), options.plot.suffix)
    with draft_of(options.plot) as draft:
        draft.write_bytes(drawn)
        yield

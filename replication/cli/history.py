"""`coldspray history`: depth and velocity of a case against time, without small steps."""

import argparse

from replication.cases import inputs_of
from replication.cli import options as shared
from replication.models.impact import Impact
from replication.text import numbers

HELP = "depth and velocity of a case against time, without small steps"

MAX_POINTS = 1_000_000
"""As many as a sheet may have steps."""


def options(command: argparse.ArgumentParser) -> None:
    shared.input_options(command)
    at = command.add_mutually_exclusive_group()
    told = "so many times, equally spaced from touch to rest (default: 101)"
    shared.whole_option(at, "--points", 2, MAX_POINTS, told, default=101)
    at.add_argument("--times", metavar="T,...", help='these times, such as "0 ns,5 ns"')
    shared.output_options(command, csv=True)


def run(options: argparse.Namespace) -> int:
    from replication.models.motion import stop_time

    case = shared.case(options)
    stop = stop_time(**case.motion)
    if options.times is None:
        times = [stop * (k / (options.points - 1)) for k in range(options.points)]
    else:
        times = shared.times("--times", options.times, MAX_POINTS)
    depth, velocity = _history(times, case)
    record = {
        "inputs": inputs_of(case),
        "time": times,
        "depth": depth,
        "velocity": velocity,
        "stop_time": stop,
    }
    table = list(zip(times, depth, velocity, strict=True))
    rows = [{"time": t, "depth": x, "velocity": v} for t, x, v in table] if options.csv else []

    def text() -> str:
        heads = ("time [ns]", "x [um]", "velocity [m/s]")
        lines = numbers(heads, ((time * 1e9, x * 1e6, v) for time, x, v in table))
        return "\n".join([*lines, "", f"stop time  {stop * 1e9:.8g} ns"])

    return shared.put(options, record, text, rows)


def _history(times: list[float], case: Impact) -> tuple[list[float], list[float]]:
    """Depth [m] and velocity [m/s]; for many times compiled, of which the start takes a second."""
    if len(times) > 50_000:
        from replication.models import arrays

        depth, velocity = arrays.history(times, **case.motion)
        return depth.tolist(), velocity.tolist()
    from replication.models.motion import history

    depths, velocities = [0.0] * len(times), [0.0] * len(times)
    history(times, **case.motion, depth=depths, speed=velocities)
    return depths, velocities

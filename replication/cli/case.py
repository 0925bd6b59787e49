"""The commands about a case: depth, sheet, history, converge; and stability, the hard cases."""

import argparse

from replication.cases import inputs_of
from replication.cli import options as shared
from replication.text import number, numbers

MAX_POINTS = 1_000_000
"""As many as a sheet may have steps."""

MOST_STEPS = 40


def depth_options(command: argparse.ArgumentParser) -> None:
    shared.input_options(command)
    shared.output_options(command)


def run_depth(options: argparse.Namespace) -> int:
    from replication.models.depth import final_depth, normalized_depth

    case = shared.case(options)
    depth, target = final_depth(**case.motion), (case.target_density, case.target_resistance)
    ratio = normalized_depth(case.velocity, case.particle_density, *target)
    record = {
        "inputs": inputs_of(case),
        "depth": depth,
        "normalized_depth": ratio,
        "beyond_radius": ratio > 1,
    }
    text = (
        f"final depth       {number(depth * 1e6, 8)} um ({depth!r} m)\n"
        f"normalized depth  {number(ratio, 8)}\n"
        f"beyond radius     {'yes' if ratio > 1 else 'no'}"
    )
    return shared.put(options, record, lambda: text)


def sheet_options(command: argparse.ArgumentParser) -> None:
    shared.input_options(command)
    shared.scheme_option(command)
    shared.output_options(command, csv=True)


def run_sheet(options: argparse.Namespace) -> int:
    from replication.error import warnings
    from replication.models.sheet import run

    sheet = run(shared.case(options), options.scheme)
    rows = [row._asdict() for row in sheet.rows] if options.json or options.csv else []
    doubts = list(warnings(sheet).values())
    record = {
        "inputs": inputs_of(sheet.impact),
        "scheme": sheet.scheme,
        "rows": rows,
        "final_depth": sheet.final_depth,
        "normalized_depth": sheet.normalized_depth,
        "steps": sheet.steps,
        "warnings": doubts,
    }

    def text() -> str:
        """The rows, then what the report reads off the last."""
        heads = ("time [ns]", "initial [m/s]", "x [um]", "deceleration [m/s2]", "final [m/s]")
        table = ((time * 1e9, v, x * 1e6, a, final) for time, v, x, a, final in sheet.rows)
        lines = zip(("row", *range(len(sheet.rows))), numbers(heads, table), strict=True)
        return "\n".join(
            [
                *(f"{k:>5}{line}" for k, line in lines),
                "",
                f"final depth       {number(sheet.final_depth * 1e6, 8)} um",
                f"normalized depth  {number(sheet.normalized_depth, 8)}",
                f"steps             {sheet.steps}",
            ]
        )

    return shared.put(options, record, text, rows, doubts)


def history_options(command: argparse.ArgumentParser) -> None:
    shared.input_options(command)
    at = command.add_mutually_exclusive_group()
    told = "so many times, equally spaced from touch to rest (default: 101)"
    shared.whole_option(at, "--points", 2, MAX_POINTS, told, default=101)
    at.add_argument("--times", metavar="T,...", help='these times, such as "0 ns,5 ns"')
    shared.output_options(command, csv=True)


def run_history(options: argparse.Namespace) -> int:
    from replication.models.motion import history, stop_time

    case = shared.case(options)
    stop = stop_time(**case.motion)
    if options.times is None:
        times = [stop * (k / (options.points - 1)) for k in range(options.points)]
    else:
        times = shared.times("--times", options.times, MAX_POINTS)
    depth, velocity = [0.0] * len(times), [0.0] * len(times)
    history(times, **case.motion, depth=depth, speed=velocity)
    columns = {"time": times, "depth": depth, "velocity": velocity}
    record = {"inputs": inputs_of(case), **columns, "stop_time": stop}
    table = list(zip(*columns.values(), strict=True))

    def text() -> str:
        heads = ("time [ns]", "x [um]", "velocity [m/s]")
        lines = numbers(heads, ((time * 1e9, x * 1e6, v) for time, x, v in table))
        return "\n".join([*lines, "", f"stop time  {number(stop * 1e9, 8)} ns"])

    rows = [dict(zip(columns, row, strict=True)) for row in table] if options.csv else []
    return shared.put(options, record, text, rows)


def converge_options(command: argparse.ArgumentParser) -> None:
    shared.input_options(command)
    shared.scheme_option(command)
    told = "steps, coarsest first (default: from 16 times --step)"
    command.add_argument("--steps", metavar="X,X,...", help=told)
    shared.whole_option(command, "--levels", 2, MOST_STEPS, "number of steps, by halves (8)", 8)
    largest = "also find the largest step for N correct digits"
    shared.whole_option(command, "--digits", 1, 15, largest)
    shared.output_options(command)


def run_converge(options: argparse.Namespace) -> int:
    from replication.error.ladder import converge, ladder, step_for_digits, text

    case, scheme = shared.case(options), options.scheme
    if options.steps is None:
        steps = ladder(case.step, options.levels)
    else:
        steps = shared.times("--steps", options.steps, MOST_STEPS)
    record = converge(case, steps, scheme)
    record["digits"] = options.digits and step_for_digits(case, options.digits, scheme)
    warnings = (f"{x['step']!r} s: {said}" for x in record["levels"] for said in x["warnings"])
    return shared.put(options, record, lambda: text(record), warnings=warnings)


def stability_options(command: argparse.ArgumentParser) -> None:
    random, seed = "random cases (100000)", "of the random cases (1)"
    shared.whole_option(command, "--random", 1, 10_000_000, random, default=100_000)
    shared.whole_option(command, "--seed", 0, 2**63, seed, default=1)
    shared.output_options(command)


def run_stability(options: argparse.Namespace) -> int:
    from replication.error import hard_cases

    record = hard_cases.record(options.random, options.seed)
    return shared.put(options, record, lambda: hard_cases.text(record))

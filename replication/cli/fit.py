"""`coldspray fit`: fit the resistance, or a factor of it, to measured depths."""

import argparse
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from replication.asked_unit import LENGTH_UNITS, SHARE_UNITS, unit_asked
from replication.cases import OTHER_FACTOR, option
from replication.cli.case import (
    add_inputs,
    case_of,
    doubt,
    given_inputs,
    input_in_words,
    input_rounded,
    inputs_in_words,
    refuse_sought,
)
from replication.cli.options import add_csv_and_json, add_quiet, one_of, path
from replication.cli.output import paragraph, put
from replication.cli.picture import add_plot, checked, notes_on, write_picture
from replication.columns import Column, note_of_unused, read_columns
from replication.fit import (
    FITTABLE,
    Fit,
    Measurement,
    check_factor,
    fit,
    measurement_columns,
    measurements_in,
    note_of_share,
    own_resistance,
)
from replication.misfit import IMPROBABLE, ROUNDING, chance_of_chi_square, far_off, worst
from replication.models.depth import final_depth
from replication.models.impact import Impact
from replication.text import aligned, in_percent, number, numbers
from replication.user_input import place, quoted

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from replication.plots import Points

HELP = "fit the resistance, or beta, to measured velocities and depths"
EXAMPLE = "coldspray fit measured.csv --quantity beta --flow-stress '700 MPa'"

FITTED_NAMES = {name.replace("_", "-"): name for name in FITTABLE}
"""What can be fitted, as it is typed."""


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "file", metavar="DATA.csv", type=path,
        help="columns, each with a head such as 'velocity [m/s]' and 'depth [um]' or "
        "'normalized depth'; maybe 'uncertainty [um]' or '[%%]', of the depths, and the other "
        "inputs by name; of a 'diameter [um]' the radius is half",
    )  # fmt: skip
    parser.add_argument(
        "--quantity", metavar="NAME", type=one_of("quantity", FITTED_NAMES), default="resistance",
        help=f"what is fitted: {', '.join(FITTED_NAMES)} (default: %(default)s)",
    )  # fmt: skip
    add_csv_and_json(parser, "print the measurements, with fitted depths and residuals, as CSV")
    add_quiet(parser)
    add_plot(parser, data="velocity and depth, which are not fitted")
    add_inputs(parser, with_sheet=False, without=["velocity"])


def run(options: argparse.Namespace) -> int:
    """Print the fitted value with its standard error, and the residual of every measurement."""
    quantity, given = FITTED_NAMES[options.quantity], given_inputs(options)
    if "velocity" in given:
        raise ValueError("--velocity: the file has the velocities: leave it out")
    refuse_sought(quantity, given, "fitted")
    case, warnings = case_of(options)
    check_factor(case, quantity)
    columns = read_columns(options.file)
    known = measurement_columns(columns)
    _refuse_twice(given, known)
    measurements = measurements_in(known, case)
    measured = known.get("depth") or known["normalized_depth"]
    asked = _unit_asked(measured, measurements, per_radius="depth" not in known)
    if asked and not measured.unit:
        raise ValueError(asked)
    points = checked(
        options, lambda file: _further_points(file, measurements), options.file, options.case_file
    )
    notes = note_of_unused(columns, known.values())
    notes += note_of_share(known.get("uncertainty"), measured) + notes_on(points)
    try:
        with place(str(options.file)):
            fitted = fit(case, measurements, quantity)
    except ValueError as error:
        raise ValueError(asked or str(error)) from error
    warnings += [asked] if asked else []
    warnings += _doubts(fitted, measurements, options.file)
    warnings = list(dict.fromkeys([*warnings, *_misfits(case, fitted, measurements, options.file)]))
    inputs = _common_inputs(measurements)
    if divisor := OTHER_FACTOR.get(quantity):
        inputs[divisor] = fitted.resistance / fitted.value
    rows = _fitted_rows(fitted, measurements)
    write_picture(options, lambda: _fit_figure(options.file, fitted, measurements, inputs, points))
    record = {
        "inputs": inputs,
        "quantity": quantity,
        "value": fitted.value,
        "standard_error": fitted.standard_error,
        "resistance": fitted.resistance,
        "residuals": fitted.residuals,
        "chi_square": fitted.chi_square,
        "points": fitted.points,
        "measurements": rows,
        "warnings": warnings,
        "notes": notes,
    }
    return put(options, record, lambda: _fit_text(fitted, inputs, rows), rows, warnings, notes)


_STATED = ("velocity", "radius", "particle_density", "target_density")
"""The inputs of a measurement: all but the resistance."""


def _refuse_twice(given: Mapping[str, str], known: Mapping[str, Column]) -> None:
    """Raise ValueError if an option gives an input of which the file has a column."""
    for name in given:
        column = known.get(name) or (known.get("diameter") if name == "radius" else None)
        if column:
            has = f"{column.file} has the column {quoted(column.head)}"
            raise ValueError(f"{option(name)}: {has}: leave out one of the two")


def _unit_asked(column: Column, measurements: Sequence[Measurement], *, per_radius: bool) -> str:
    """Return a question that names the first depth that may be in another unit than it says, or "".

    By itself it gives a resistance that no target has, from inputs as an impact has them; in the
    other unit the resistance is as expected. per_radius: the column is of X/R.
    """
    units = SHARE_UNITS if per_radius else LENGTH_UNITS

    def is_expected(m: Measurement, value: float) -> bool:
        depth = value * m.radius if per_radius else value
        resistance = own_resistance(replace(m, depth=depth))
        return resistance is not None and not doubt("resistance", resistance, "")

    odd = [
        row
        for row, m in enumerate(measurements)
        if not is_expected(m, m.depth / m.radius if per_radius else m.depth)
        and not any(doubt(name, getattr(m, name), "") for name in _STATED)
    ]
    for row in odd:
        m = measurements[row]
        if asked := unit_asked(column, row, units, partial(is_expected, m)):
            if 2 * len(odd) < len(measurements):
                asked = "unlike most others: is it a slip?"
            radii = f"the depth is {m.depth / m.radius:.3g} times the radius"
            return f"{column.file}, line {m.line}: {radii}: {asked}"
    return ""


def _further_points(file: Path, measurements: Sequence[Measurement]) -> "Points":
    from replication.plots import DEPTH, INPUT, read_points

    deepest = {DEPTH: (max(m.depth for m in measurements), "the deepest that is fitted")}
    return read_points(file, INPUT["velocity"], (DEPTH,), deepest)


def _fit_figure(
    file: Path,
    fitted: Fit,
    measurements: Sequence[Measurement],
    inputs: Mapping[str, float],
    points: "Points | None",
) -> "Figure":
    from replication.plots import plot_fit

    return plot_fit(measurements, fitted, inputs_in_words(inputs), file.name, points)


def _common_inputs(measurements: Sequence[Measurement]) -> dict[str, float]:
    """Return the inputs beside the velocity that all measurements have in common."""
    values = {
        name: {getattr(m, name) for m in measurements} for name in _STATED if name != "velocity"
    }
    return {name: values[name].pop() for name in values if len(values[name]) == 1}


def _doubts(fitted: Fit, measurements: Sequence[Measurement], file: Path) -> list[str]:
    """Return a warning for the first value of each input that no impact has, and of the result."""
    warnings = []
    for name in _STATED:
        words = name.replace("_", " ")
        for m in measurements:
            if text := doubt(name, getattr(m, name), f"{file}, line {m.line}: {words}"):
                warnings += text
                break
    quantity = fitted.quantity.replace("_", " ")
    return warnings + doubt(fitted.quantity, fitted.value, f"the fitted {quantity}", typed=False)


def _misfits(
    case: Impact, fitted: Fit, measurements: Sequence[Measurement], file: Path
) -> list[str]:
    """Return a warning if chi square is improbably large, or if a measurement is far off."""
    chance = chance_of_chi_square(fitted)
    if chance is not None and chance < IMPROBABLE:
        row, off = worst(fitted, measurements)
        return [
            f"{file}: so large a chi square has {_chance(chance)}: the uncertainties do not "
            "account for the residuals, and the standard error by them means little; line "
            f"{measurements[row].line} is off by most, {number(off, 3)} uncertainties"
        ]
    if outlier := far_off(case, fitted, measurements):
        line = measurements[outlier.number].line
        by = f"{number(abs(outlier.excess) * 1e6, 3)} um {'more' if outlier.excess > 0 else 'less'}"
        quantity = fitted.quantity.replace("_", " ")
        value = input_rounded(fitted.quantity, outlier.without.value, 4)
        return [
            f"{file}: line {line} is far off the others: {by} than they give, "
            f"{number(outlier.deviations, 3)} standard deviations, which has "
            f"{_chance(outlier.chance)}; it was fitted, too: without it the {quantity} is {value}"
        ]
    return []


def _chance(chance: float) -> str:
    return f"a chance of {number(chance, 2) if chance > 1e-99 else 'less than 1e-99'}"


def _fitted_rows(fitted: Fit, measurements: Sequence[Measurement]) -> list[dict[str, float | None]]:
    """Return the measurements in SI units, each with its line, its fitted depth and residual."""
    return [
        {
            "line": m.line,
            "velocity": m.velocity,
            "radius": m.radius,
            "particle_density": m.particle_density,
            "target_density": m.target_density,
            "depth": m.depth,
            "uncertainty": m.uncertainty,
            "fitted_depth": final_depth(*m.impact, fitted.resistance),
            "residual": residual,
        }
        for m, residual in zip(measurements, fitted.residuals, strict=True)
    ]


def _fit_text(fitted: Fit, inputs: Mapping[str, float], rows: Sequence[Mapping[str, Any]]) -> str:
    """Return the inputs, a table of the measurements, and the fitted value below it."""
    weighted = fitted.chi_square is not None
    heads = ("line", "velocity [m/s]", "x [um]", "fitted [um]", "residual [um]")
    typical = math.hypot(*fitted.residuals) / math.sqrt(fitted.points)
    table = []
    for row in rows:
        # Where the sum of squares is least it is flat, so that its place has half of the digits of
        # a double, 2^-26 of what the residuals are; and a depth has its own rounding.
        least = 2.0**-26 * typical + ROUNDING * row["depth"]
        residual = row["residual"] if abs(row["residual"]) > least else 0.0
        cells = [row["line"], row["velocity"], row["depth"] * 1e6]
        cells += [float(f"{x * 1e6:.4g}") for x in (row["fitted_depth"], residual)]
        cells += [float(f"{residual / row['uncertainty']:.3g}")] if weighted else []
        table.append(cells)
    name = fitted.quantity.replace("_", " ")
    results = [(name, input_in_words(fitted.quantity, fitted.value))]
    if fitted.standard_error is None:
        results.append(("standard error", "unknown: one measurement, without an uncertainty"))
    else:
        share = in_percent(fitted.standard_error / fitted.value)
        error = input_in_words(fitted.quantity, fitted.standard_error, 3)
        by = "uncertainties" if weighted else "scatter"
        results.append(("standard error", f"{error}, {share}, by the {by}"))
    if fitted.chi_square is not None:
        freedom = fitted.points - 1
        results.append(("chi square", f"{number(fitted.chi_square, 4)}, {freedom} expected"))
    return "\n".join(
        [
            paragraph(inputs_in_words(inputs)),
            "",
            *numbers((*heads, "over uncertainty") if weighted else heads, table),
            "",
            *aligned(results),
        ]
    )

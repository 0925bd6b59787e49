"""`coldspray converge`: split the sheet's error at several time steps."""

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reference.scheme import Scheme
from replication.cli.case import add_inputs, case_of, doubted, in_words
from replication.cli.options import add_csv_and_json, add_quiet, add_scheme, times, whole
from replication.cli.output import paragraph, put, width
from replication.cli.picture import add_plot, checked, notes_on, write_picture
from replication.models.impact import Impact
from replication.text import columns, in_percent, number

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from replication.plots import Points

_Level = Mapping[str, Any]
"""The results at one time step, as the JSON has them."""

HELP = "split the sheet's error at several time steps; observed order, limit"
EXAMPLE = "coldspray converge --steps '0.4 ns,0.2 ns,0.1 ns' --scheme centered"

MOST_STEPS = 40
"""The most time steps, counted or listed: each half of the one before, to 1e-12 of the first."""


def add_options(parser: argparse.ArgumentParser) -> None:
    add_scheme(parser)
    wanted = parser.add_mutually_exclusive_group()
    wanted.add_argument(
        "--steps", metavar="X,X,...", help="steps, coarsest first (default: from 16 times --step)"
    )
    wanted.add_argument(
        "--levels", metavar="N", type=whole(2, MOST_STEPS), default=8,
        help="number of steps, each half of the previous one (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--digits", metavar="N", type=whole(1, 15),
        help="also find a step that, like its halvings, gives N correct digits",
    )  # fmt: skip
    add_csv_and_json(parser, "print the steps as CSV")
    add_quiet(parser)
    add_plot(parser, data="step, and error or depth")
    add_inputs(parser)


def run(options: argparse.Namespace) -> int:
    """Print the error and its parts at each step, the observed order and the limit."""
    from replication.error.ladder import GOVERNED_BY, converge, ladder, step_for_digits

    (case, warnings), scheme = case_of(options), options.scheme
    points = checked(options, lambda file: _points_of_error(file, case), options.case_file)
    if options.steps is None:
        steps = ladder(case.step, options.levels)
    else:
        steps = times("--steps", options.steps, MOST_STEPS)
    with doubted(warnings):
        record = converge(case, steps, scheme)
        record["digits"] = options.digits and step_for_digits(case, options.digits, scheme)
    record["warnings"] = warnings
    write_picture(options, lambda: _convergence_figure(case, record, points))
    rows = [level | level["budget"] for level in record["levels"]]
    for row in rows:
        del row["budget"], row["warnings"], row["warned_of"]
    notes = _notes(record["levels"]) + notes_on(points)
    return put(
        options, record, lambda: _convergence_text(case, record, GOVERNED_BY), rows, warnings, notes
    )


def _points_of_error(file: Path, case: Impact) -> "Points":
    from replication.plots import DEPTH, ERROR, STEP, reach_of, read_points

    return read_points(file, STEP, (ERROR, DEPTH), reach_of(case))


def _convergence_figure(
    case: Impact, record: Mapping[str, Any], points: "Points | None"
) -> "Figure":
    from replication.plots import plot_converge

    title = f"{in_words(case, stop=True)}, {record['scheme']} scheme"
    return plot_converge(case, record, title, points)


def _notes(levels: Sequence[_Level]) -> list[str]:
    """Return each kind of warning once. Of a ladder they are expected: its first steps are long."""
    texts, also = dict[str, str](), dict[str, list[str]]()
    for level in levels:
        step = number(level["step"] * 1e9, 5)
        for kind, words in zip(level["warned_of"], level["warnings"], strict=True):
            if kind in texts:
                also[kind].append(step)
            else:
                texts[kind], also[kind] = f"at {step} ns {words}", []
    likewise = {kind: f"; likewise at {', '.join(also[kind])} ns" for kind in texts if also[kind]}
    return [text + likewise.get(kind, "") for kind, text in texts.items()]


_PARTS = (
    "The error is the sum of four parts: time step, the scheme against the exact depth at the "
    "velocity of the last row; stop rule, that depth against the one at rest; half step, by which "
    "x stands behind that velocity, -v dt/2; and rounding."
)
_WHY = {
    Scheme.PUBLISHED: "The published scheme is first order: it takes a row's deceleration at the "
    "middle depth, but at the initial velocity, and drag depends on velocity.",
    Scheme.CENTERED: "The centered scheme is second order: it takes a row's deceleration at the "
    "middle depth and at the middle velocity.",
}


def _convergence_text(
    case: Impact, record: Mapping[str, Any], governed_by: Mapping[str, str]
) -> str:
    """Return the error and its parts as tables, the limit, and what they mean."""
    levels, columns_of = record["levels"], width()
    regimes = {level["regime"] for level in levels}
    lines = [
        paragraph(in_words(case, stop=True)),
        "",
        columns(_errors(levels), columns_of),
        "",
        columns(_error_parts(levels), columns_of),
        "",
        f"exact, at rest            {_um(record['exact'], 10)} um",
        f"exact, at stop velocity   {_um(record['exact_at_stop'], 10)} um",
        paragraph(f"limit of the last three   {_limit(record)}"),
        paragraph(_PARTS),
        paragraph(_WHY[Scheme(record["scheme"])]),
        "What governs an error:",
        *(
            paragraph(f"{name}: {means}", indent="  ", hanging="    ")
            for name, means in governed_by.items()
            if name in regimes
        ),
    ]
    if met := record["digits"]:
        digits = "1 correct digit" if met["digits"] == 1 else f"{met['digits']} correct digits"
        accident = "where the last row falls is an accident"
        lines += [
            paragraph(
                f"{digits}: {number(met['step'] * 1e9, 5)} ns ({met['steps']} steps, "
                f"error {_um(met['error'], 3)} um) and its halvings; "
                f"{number(met['fails'] * 1e9, 5)} ns fails."
            ),
            paragraph(f"Steps between them may do better or worse: {accident}."),
        ]
    return "\n".join(lines)


def _errors(levels: Sequence[_Level]) -> list[tuple[str, ...]]:
    """Return the rows of the first table: depth, error, and what governs it, at each step."""
    return [
        ("step", "steps", "depth", "error", "order", "governed by"),
        ("[ns]", "", "[um]", "[um]", "", ""),
        *(
            (
                number(level["step"] * 1e9, 5),
                str(level["steps"]),
                _um(level["depth"], 7),
                _um(level["error"], 3),
                _order(level["order"]),
                level["regime"],
            )
            for level in levels
        ),
    ]


def _error_parts(levels: Sequence[_Level]) -> list[tuple[str, ...]]:
    """Return the rows of the second table: the four parts of the error at each step."""
    return [
        ("step", "time step", "order", "stop rule", "half step", "rounding"),
        ("[ns]", "[um]", "", "[um]", "[um]", "[um]"),
        *(
            (
                number(level["step"] * 1e9, 5),
                _um(level["budget"]["time_step"], 3),
                _order(level["time_step_order"]),
                _um(level["budget"]["stop_rule"], 3),
                _um(level["budget"]["half_step"], 3),
                _um(level["budget"]["rounding"], 2),
            )
            for level in levels
        ),
    ]


def _limit(record: Mapping[str, Any]) -> str:
    if record["limit_undefined"]:
        return str(record["limit_undefined"])
    observed, order = record["observed_order"], record["nominal_order"]
    text = (
        f"{_um(record['limit'], 8)} um, observed order {observed:.2f}, "
        f"grid convergence index {in_percent(record['gci'], 2)}"
    )
    accidental = abs(observed - order) > 0.1 * order
    return f"{text} (no bound: the order is not the scheme's)" if accidental else text


def _um(length: float | None, digits: int) -> str:
    return "-" if length is None else number(length * 1e6, digits)


def _order(order: float | None) -> str:
    return "-" if order is None else f"{order:.2f}"

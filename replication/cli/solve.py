"""`coldspray solve`: print the value of one input of a case that gives a final depth."""

import argparse
from collections.abc import Mapping

from replication.cases import option
from replication.cli.case import (
    add_inputs,
    case_of,
    doubt,
    given_inputs,
    input_in_words,
    inputs_in_words,
    range_in_words,
    refuse_sought,
)
from replication.cli.options import add_json, add_quiet, one_of
from replication.cli.output import paragraph, put, width
from replication.models.impact import Impact, InputError
from replication.solve import DEPTHS, QUANTITIES, Solution, solve, solve_printed
from replication.text import columns, number
from replication.user_input import place, quoted, read_number

HELP = "print the resistance, velocity, ... that gives a final depth"
EXAMPLE = "coldspray solve resistance --depth '3.3 um' --rounded"

SOUGHT_NAMES = {name.replace("_", "-"): name for name in QUANTITIES}
"""The quantities, as they are typed."""


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "quantity", metavar="QUANTITY", type=_quantity,
        help=f"what is sought: {', '.join(SOUGHT_NAMES)}",
    )  # fmt: skip
    wanted = parser.add_mutually_exclusive_group(required=True)
    wanted.add_argument("--depth", metavar="X", help='final depth [m], such as "3.3 um"')
    wanted.add_argument("--normalized-depth", metavar="Y", help="final depth over the radius, X/R")
    parser.add_argument(
        "--rounded", action="store_true",
        help="take the depth, and every input that an option gives, as printed text: the answer is "
        "a proven range, for all values that print so; all digits are significant, and a second "
        "range is without zeros that end a whole number; what the case has is exact",
    )  # fmt: skip
    add_json(parser)
    add_quiet(parser)
    add_inputs(parser, with_sheet=False)


def _quantity(text: str) -> str:
    """Read what is sought; somebody who seeks the depth is told who gives it."""
    if text in ("depth", "normalized-depth"):
        raise argparse.ArgumentTypeError(
            "it is solved for what gives a depth; the depth of a case is printed by `coldspray "
            "depth`"
        )
    return one_of("quantity", SOUGHT_NAMES)(text)


def run(options: argparse.Namespace) -> int:
    """Print the value, its range and its condition; status 1 if no value gives the depth."""
    quantity, given = SOUGHT_NAMES[options.quantity], given_inputs(options)
    refuse_sought(quantity, given, "solved for")
    case, warnings = case_of(options)
    name = "normalized_depth" if options.depth is None else "depth"
    text: str = getattr(options, name)
    texts = {name: text, **{key: x for key, x in given.items() if key in QUANTITIES}}
    depth = _depth(name, text, quantity, case)
    try:
        if options.rounded:
            answer = solve_printed(case, quantity, texts)
        else:
            answer = solve(case, quantity, depth)
    except InputError as error:
        if quantity == "radius":
            raise
        problem = f"no {_without_underscores(quantity)} that doubles can hold gives it"
        if error.name != quantity:
            problem = str(error)
        if meant := _meant(name, text, case.radius):
            problem = f"did you mean {meant}?"
        radii = f"the depth is {depth / case.radius:.3g} times the radius"
        raise ValueError(f"{option(name)}: {radii}: {problem}") from error
    if answer.value is not None:
        named = f"the {_without_underscores(quantity)} for this depth"
        warnings += doubt(quantity, answer.value, named, typed=False)
    record = {
        "inputs": dict(answer.inputs),
        "quantity": quantity,
        "value": answer.value,
        "interval": answer.interval,
        "fewest_digits": answer.fewest_digits,
        "depth": answer.depth,
        "normalized_depth": answer.normalized_depth,
        "condition": answer.condition,
        "reason": answer.reason or None,
        "warnings": warnings,
    }
    put(options, record, lambda: _solution_text(answer, texts), warnings=warnings)
    return 0 if answer.value is not None or answer.interval is not None else 1


def _depth(name: str, text: str, quantity: str, case: Impact) -> float:
    """Read the depth, or the normalized depth, and return the depth [m]."""
    with place(option(name)):
        value = read_number(text, DEPTHS[name])
        if value <= 0:
            raise ValueError(f"{quoted(text)} is not greater than zero")
        if name == "normalized_depth" and quantity == "radius":
            raise ValueError("it does not depend on the radius: give --depth")
    return value if name == "depth" else value * case.radius


def _meant(name: str, text: str, radius: float) -> str:
    """Return the depth in um that a number without a unit means, or "" if it can mean none."""
    in_um = text.strip() + " um"
    try:
        normalized_depth = read_number(in_um, "m") / radius
    except ValueError:  # it has a unit of its own
        return ""
    meant = f'"{in_um}"' if name == "depth" else f'--depth "{in_um}"'
    return meant if 1e-3 < normalized_depth < 1e3 else ""


def _solution_text(answer: Solution, texts: Mapping[str, str]) -> str:
    """Return the inputs, the depth, and the answer with its range and condition."""
    rows = [("depth", f"{number(answer.depth * 1e6, 8)} um ({answer.depth!r} m)")]
    if answer.normalized_depth is not None:
        rows.append(("normalized depth", number(answer.normalized_depth, 8)))
    name = _without_underscores(answer.quantity)
    if answer.value is None:
        rows.append((name, f"none: the {answer.reason}"))
    else:
        rows.append((name, input_in_words(answer.quantity, answer.value)))
    if answer.interval is not None:
        rows.append(("range", _proven_range(answer, texts)))
    if answer.fewest_digits is not None:
        none = "" if answer.fewest_digits[0] > 0 else "; for some of that there is none"
        ends = range_in_words(answer.quantity, answer.fewest_digits)
        means = f"if the zeros that end a whole number count for none{none}"
        rows.append(("fewest digits", f"{ends}, {means}"))
    if answer.condition is not None:
        condition = number(answer.condition, 3)
        means = "its relative change over that of the depth"
        if abs(answer.condition) <= 10:  # so that a percent is a small change
            way = "less" if answer.condition < 0 else "more"
            means = f"1 % more depth is {condition.removeprefix('-')} % {way} {name}"
        rows.append(("condition", f"{condition}: {means}"))
    return f"{paragraph(inputs_in_words(answer.inputs))}\n\n{columns(rows, min(width(), 100))}"


def _proven_range(answer: Solution, texts: Mapping[str, str]) -> str:
    """Return the interval, rounded outward, and for which texts it is proven."""
    assert answer.interval is not None
    alike = ", ".join(f"{_without_underscores(name)} {text}" for name, text in texts.items())
    ends = range_in_words(answer.quantity, answer.interval)
    proven = f"{ends}, proven for all that prints as {alike}"
    return proven if answer.interval[0] > 0 else f"{proven}; for some of that there is none"


def _without_underscores(name: str) -> str:
    return name.replace("_", " ")

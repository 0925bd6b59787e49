"""`coldspray power`: plant misprints in copies of the report, and count what the audit notices.

Harmless rewritings are planted, too: they show how often the audit raises a false alarm.
"""

import argparse
from functools import partial

from replication.cli.options import add_json, add_quiet, whole
from replication.cli.output import progress, put, width
from replication.text import table_text

HELP = "plant misprints in memory and measure what the audit notices"
EXAMPLE = "coldspray power --sample 20 --seed 7"


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--sample", metavar="N", type=whole(1, 1_000_000), default=500,
        help="number of misprints, and of harmless rewritings (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--seed", metavar="N", type=whole(0, 2**64 - 1), default=1,
        help="seed of the random numbers (default: %(default)s)",
    )  # fmt: skip
    add_json(parser)
    add_quiet(parser, "no progress")


def run(options: argparse.Namespace) -> int:
    """Print how many misprints are noticed, by kind of entry and of edit, and which are not.

    With them stands how many harmless rewritings change a verdict.
    """
    from reference.ledger import load
    from replication.power import measure_power

    shown = partial(progress, options, unit=" texts", leave=False)
    result = measure_power(load(), options.sample, options.seed, shown)
    lines = [
        f"{result.planted} misprints, planted one at a time; {result.invisible} cannot be noticed,",
        "as all numbers that the audit relates still agree. Of the others, and of",
        f"{result.controls} harmless rewritings of numbers and equations:",
        "",
        table_text(result.rates(), width(piped=10_000)),
        "",
        "By kind of entry and of edit, in percent:",
        "",
        table_text(result.table(), width(piped=10_000)),
    ]
    if result.not_first:
        reasons = result.reasons()
        lines += ["", f"{reasons.caption}:", "", table_text(reasons, width(piped=10_000))]
    if result.unnoticed:
        lines += ["", "Visible, and not noticed:"]
        lines += ["  {entry}: {true!r} as {text!r}".format_map(plant) for plant in result.unnoticed]
    return put(options, result, lambda: "\n".join(lines))

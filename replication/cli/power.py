"""`coldspray power`: what the audit would notice, measured by planted misprints."""

import argparse
from typing import TYPE_CHECKING

from replication.cli import options as shared

if TYPE_CHECKING:
    from replication.power import Power

HELP = "plant misprints in memory and measure what the audit notices"


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--sample", type=shared.whole(1, 10**6), default=500, metavar="N", help="misprints (500)"
    )
    command.add_argument(
        "--seed", type=shared.whole(0, 2**64 - 1), default=1, metavar="N", help="of the sample (1)"
    )
    shared.output_options(command, quiet="no progress")


def run(options: argparse.Namespace) -> int:
    from tqdm import tqdm

    from reference.ledger import load
    from replication.power import power

    # Without a terminal (None) there is no bar.
    quiet = options.quiet or None
    result = power(
        load(),
        options.sample,
        options.seed,
        lambda plants: tqdm(plants, unit=" misprints", disable=quiet, leave=False),
    )
    if options.json:
        shared.print_json(result)
    else:
        print(_text(result))
    return 0


def _text(result: "Power") -> str:
    """The rates, whole, by kind of entry and by kind of edit, then what passes."""
    from replication.text import aligned

    table = result.table()
    lines = [
        f"{result.planted} misprints, one at a time; {result.invisible} cannot be seen, as every",
        "number still rounds as printed. Of the others, in percent:",
        "",
    ]
    lines += aligned([table.heads, *table.rows])
    if result.unnoticed:
        lines += ["", "Visible, and not noticed:"]
        lines += [f"  {x['entry']}: {x['true']!r} as {x['text']!r}" for x in result.unnoticed]
    return "\n".join(lines)

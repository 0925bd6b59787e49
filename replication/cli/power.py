"""`coldspray power`: what the audit would notice, measured by planted misprints."""

import argparse
from typing import TYPE_CHECKING

from replication.cli import options as shared

if TYPE_CHECKING:
    from replication.power import Power

HELP = "plant misprints in memory and measure what the audit notices"


def options(command: argparse.ArgumentParser) -> None:
    shared.whole_option(command, "--sample", 1, 10**6, "misprints (500)", default=500)
    shared.whole_option(command, "--seed", 0, 2**64 - 1, "of the sample (1)", default=1)
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
    return shared.put(options, result, lambda: _text(result))


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

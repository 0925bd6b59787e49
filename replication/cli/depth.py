"""`coldspray depth`: print the final depth of a case by the exact solution, without time steps."""

import argparse

from replication.cases import inputs_of
from replication.cli.case import add_inputs, case_of, in_words
from replication.cli.options import add_json, add_quiet
from replication.cli.output import filled, put
from replication.text import number

HELP = "print the exact final depth of a case, without time steps"
EXAMPLE = "coldspray depth --velocity '450 m/s' --radius '5 um'"


def add_options(parser: argparse.ArgumentParser) -> None:
    add_json(parser)
    add_quiet(parser)
    add_inputs(parser, with_sheet=False)


def run(options: argparse.Namespace) -> int:
    """Print the depth X [um and m], X/R, and whether X exceeds R."""
    from replication.models.depth import normalized_depth

    case, warnings = case_of(options)
    velocity, radius, *materials = case.motion.values()
    ratio = normalized_depth(velocity, *materials)
    depth = radius * ratio
    record = {
        "inputs": inputs_of(case),
        "depth": depth,
        "normalized_depth": ratio,
        "beyond_radius": ratio > 1,
        "warnings": warnings,
    }
    text = (
        f"{filled(in_words(case))}\n\n"
        f"final depth       {number(depth * 1e6, 8)} um ({depth!r} m)\n"
        f"normalized depth  {number(ratio, 8)}\n"
        f"beyond radius     {'yes' if ratio > 1 else 'no'}"
    )
    return put(options, record, lambda: text, warnings=warnings)

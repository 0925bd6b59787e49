"""`coldspray crater`: print the volume of a crater of some depth, or the depth of one of a volume.

It is a command of its own, as its question is of a shape alone: no impact enters it but the radius.
"""

import argparse

from replication.cli.case import doubt
from replication.cli.options import add_json, add_quiet
from replication.cli.output import put
from replication.models.crater import crater_depth, crater_volume_ratio, volume
from replication.models.impact import GREATEST_INPUT, LEAST_INPUT
from replication.text import number, with_unit
from replication.user_input import place, quoted, read_number

HELP = "print a crater's volume by its depth, or its depth by its volume"
EXAMPLE = "coldspray crater --volume-ratio 0.06"


def add_options(parser: argparse.ArgumentParser) -> None:
    wanted = parser.add_mutually_exclusive_group(required=True)
    wanted.add_argument("--depth", metavar="X", help='depth [m], such as "3.3 um"')
    wanted.add_argument("--normalized-depth", metavar="Y", help="depth over the radius, X/R")
    wanted.add_argument(
        "--volume-ratio", metavar="Z", help="the crater's volume over the particle's, CV/PV"
    )
    parser.add_argument(
        "--radius", metavar="R", default="11 um", help="of the particle [m] (default: %(default)s)"
    )
    add_json(parser)
    add_quiet(parser)


def run(options: argparse.Namespace) -> int:
    """Print depth and volume of a crater, alone and over the particle's (Eqs. 2-3)."""
    radius = _positive("--radius", options.radius, "m")
    if options.volume_ratio is not None:
        ratio = _positive("--volume-ratio", options.volume_ratio, "1")
        y = crater_depth(ratio)
        depth = radius * y
    elif options.normalized_depth is not None:
        y = _positive("--normalized-depth", options.normalized_depth, "1")
        depth, ratio = radius * y, crater_volume_ratio(y)
    else:
        depth = _positive("--depth", options.depth, "m")
        y, ratio = depth / radius, crater_volume_ratio(depth, radius)
    particle, warnings = volume(radius), doubt("radius", radius, "--radius")
    if options.depth is not None:
        warnings += doubt("radius", depth, "--depth")  # no crater is deeper than what is shot
    record = {
        "radius": radius,
        "depth": depth,
        "normalized_depth": y,
        "volume_ratio": ratio,
        "crater_volume": ratio * particle,
        "particle_volume": particle,
        "beyond_radius": y > 1,
        "warnings": warnings,
    }
    text = (
        f"depth             {number(depth * 1e6, 8)} um ({depth!r} m)\n"
        f"normalized depth  {number(y, 8)}\n"
        f"volume            {number(ratio * particle * 1e18, 8)} um^3\n"
        f"over particle's   {number(ratio, 8)}\n"
        f"shape             {'a cap, then a cylinder' if y > 1 else 'a cap'} "
        f"(sphere of radius {number(radius * 1e6)} um)"
    )
    return put(options, record, lambda: text, warnings=warnings)


def _positive(option: str, text: str, unit: str) -> float:
    """Read a number above zero of which squares and cubes can be computed."""
    with place(option):
        value = read_number(text, unit)
        if not LEAST_INPUT <= value <= GREATEST_INPUT:
            raise ValueError(f"{quoted(text)} is not between 1e-40 and {with_unit('1e40', unit)}")
        return value

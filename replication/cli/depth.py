"""`coldspray depth`: final depth of a case, without time steps."""

import argparse

from replication.cases import inputs_of
from replication.cli import options as shared

HELP = "final depth of a case, without time steps"


def options(command: argparse.ArgumentParser) -> None:
    shared.input_options(command)
    shared.output_options(command)


def run(options: argparse.Namespace) -> int:
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
        f"final depth       {depth * 1e6:.8g} um ({depth!r} m)\n"
        f"normalized depth  {ratio:.8g}\n"
        f"beyond radius     {'yes' if ratio > 1 else 'no'}"
    )
    return shared.put(options, record, lambda: text)

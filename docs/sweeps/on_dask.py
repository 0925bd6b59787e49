"""A sweep on a dask cluster: `python on_dask.py PLAN.toml FOLDER [SCHEDULER]`.

Each task writes some blocks as a Parquet file, to a folder that all workers can access. The
folder's name is the SHA-256 of the plan. Only complete files exist, so that another run of the same
plan continues an interrupted one. Without the address of a scheduler ("tcp://host:8786") the
cluster is this machine.
"""

import sys
from functools import partial
from pathlib import Path

from distributed import Client, as_completed

from replication.sweep import Plan, read_plan, write_sweep

BLOCKS = 64  # per task: four million cases, about 130 MB


def write_part(plan: Plan, folder: Path, first: int) -> Path:
    """Write the part that begins with block `first`, unless it exists."""
    part = folder / f"part-{first:08}.parquet"
    if not part.exists():
        write_sweep(plan, part, numbers=range(first, min(first + BLOCKS, plan.blocks)))
    return part


def run(client: Client, plan: Plan, folder: Path) -> None:
    """Have the cluster write all parts. Raises what a part raises."""
    parts_of_plan = folder / plan.digest
    parts_of_plan.mkdir(parents=True, exist_ok=True)
    parts = client.map(partial(write_part, plan, parts_of_plan), range(0, plan.blocks, BLOCKS))
    for _, part in as_completed(parts, with_results=True):
        print(part)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit("on_dask.py: give PLAN.toml FOLDER, and maybe the address of a scheduler")
    with Client(*sys.argv[3:]) as client:
        run(client, read_plan(Path(sys.argv[1])), Path(sys.argv[2]).resolve())

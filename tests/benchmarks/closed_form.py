"""Run by hand: what the closed form and many sheets cost, as ratios within one run.

python tests/benchmarks/closed_form.py
"""

import timeit
from collections.abc import Callable
from typing import Any

import numpy as np

from replication import closed_form, midpoint
from replication.analysis.stability import random_cases
from replication.impact import BETA_5
from replication.midpoint_many import run_many


def best(work: Callable[[], Any], number: int = 1, repeat: int = 7) -> float:
    """Seconds of the fastest of several runs."""
    return min(timeit.repeat(work, number=number, repeat=repeat)) / number


def depth(count: int) -> None:
    """Against the elementary calls alone, of the same number of elements."""
    cases, number = random_cases(count, seed=1), 2_000_000 // count
    p = 0.5 * cases["target_density"] * cases["velocity"] ** 2 / cases["resistance"]
    ratio = np.minimum(cases["particle_density"] / cases["target_density"] * np.log1p(p), 0.5)
    root = np.sqrt(ratio)
    angle = np.arcsin(root) / 3
    common = sum(
        best(lambda f=f, x=x: f(x), number)
        for f, x in ((np.log1p, p), (np.sqrt, ratio), (np.arcsin, root))
    )
    sines = common + 2 * best(lambda: np.sin(angle), number)
    tangent = common + best(lambda: np.tan(angle), number)
    ours = best(lambda: closed_form.final_depth(**cases), number)
    print(f"final depth of {count} cases: {ours / count * 1e9:.1f} ns each")
    print(f"  over log1p, sqrt, arcsin and two sin:  {ours / sines:.2f}")
    print(f"  over log1p, sqrt, arcsin and one tan:  {ours / tangent:.2f}")


def history(count: int, number: int) -> None:
    """Against the sheet's rows in plain Python, a case."""
    motion: dict[str, Any] = BETA_5.motion
    times = np.linspace(0, closed_form.stop_time(**motion), midpoint.run(BETA_5).steps)
    if count > 1:
        motion = {**motion, "velocity": np.linspace(400, 600, count)[:, None]}
    ours = best(lambda: closed_form.history(times, **motion), number) / count
    sheet = best(lambda: midpoint.run(BETA_5), 100)
    print(f"history of {count} cases at {len(times)} times: {ours * 1e6:.0f} us each")
    print(f"  over the sheet's rows: {ours / sheet:.2f}")


def sheets(count: int) -> None:
    """Many at once against one at a time, per row."""
    velocities = np.linspace(200, 900, count)
    rest = list(BETA_5.motion.values())[1:]
    rows = run_many(velocities, *rest)[1].sum()
    many = best(lambda: run_many(velocities, *rest), repeat=3) / rows
    one = best(lambda: midpoint.run(BETA_5), 100) / midpoint.run(BETA_5).steps
    print(f"a row of {count} sheets: {many * 1e9:.1f} ns; one sheet over it: {one / many:.0f}")


if __name__ == "__main__":
    for count in (8192, 1_000_000):
        depth(count)
    history(1, number=100)
    history(1000, number=1)
    sheets(20_000)

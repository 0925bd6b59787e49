"""Figure 3 of the report: penetration depth against time, the sheet's rows and the exact motion."""

from typing import TYPE_CHECKING, Any

import numpy as np

from reference.ledger import load
from replication.cases import CASES
from replication.models.depth import final_depth
from replication.models.impact import Impact
from replication.models.motion import history, stop_time
from replication.models.sheet import run
from replication.reports.figures.drawing import BLUE, INK, VERMILION

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAME = "figure-3"
TITLE = "Penetration depth against time, as in Figure 3 of the report"
SIZE = (5.0, 4.2)


def describe(_: dict[str, Any]) -> str:
    """The two curves in words."""
    ends = {
        f"beta = {case.beta:g}": (run(case), final_depth(**case.motion)) for case in CASES.values()
    }
    told = "; ".join(
        f"for {name} the sheet stops at {sheet.final_depth * 1e6:.4f} µm after "
        f"{sheet.rows[-1].time * 1e9:.1f} ns, the exact depth at rest is {rest * 1e6:.4f} µm"
        for name, (sheet, rest) in ends.items()
    )
    return f"Depth rises ever more slowly to rest: {told}. At this scale the two coincide."


def plot(figure: "Figure", _: dict[str, Any]) -> None:
    """Every fourth row of each sheet as a point, the exact motion as a line."""
    claims = load().claims
    axes = figure.subplots()
    looks = ((VERMILION, "o", (0, 8), "right"), (BLUE, "s", (8, -12), "left"))
    for (name, case), (color, marker, offset, side) in zip(CASES.items(), looks, strict=True):
        times, depths = _exact(case)
        axes.plot(times * 1e9, depths * 1e6, color=INK, linewidth=1.0)
        rows = run(case).arrays()
        axes.plot(rows["time"][::4] * 1e9, rows["depth"][::4] * 1e6, marker, color=color, ms=4)
        axes.annotate(
            f"β = {case.beta:g}: sheet {rows['depth'][-1] * 1e6:.2f},\n"
            f"report {claims[f'depth-{name}'].text} µm",
            (times[-1] * 1e9, depths[-1] * 1e6),
            xytext=offset,
            textcoords="offset points",
            ha=side,
        )
    axes.plot([], [], "o", color=INK, ms=4, label="the sheet, every fourth row")
    axes.plot([], [], color=INK, linewidth=1.0, label="exact")
    axes.set(xlabel="Time [ns]", ylabel="Penetration depth [µm]", xlim=(0, None), ylim=(0, 12))
    axes.legend(loc="lower right")


def _exact(case: Impact) -> tuple[Any, Any]:
    """Time [s] and depth [m] from touch to rest."""
    times = np.linspace(0.0, stop_time(**case.motion), 101)
    depths, speeds = np.empty_like(times), np.empty_like(times)
    history(times.tolist(), **case.motion, depth=depths, speed=speeds)
    return times, depths

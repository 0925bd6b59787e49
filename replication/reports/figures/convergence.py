"""Time-step error of the final depth against the step: the published and the centered scheme."""

from typing import TYPE_CHECKING, Any

from replication.reports.figures.drawing import BLUE, INK, VERMILION, power_of_ten

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAME = "convergence"
TITLE = "Error of the sheet's final depth against its time step, beta = 5"
SIZE = (5.0, 4.6)

_LOOKS = {
    "published": (VERMILION, "o", "first order"),
    "centered": (BLUE, "s", "second order"),
}
"""Color, marker, order."""


def describe(record: dict[str, Any]) -> str:
    """Both slopes, and what they are at the report's step."""
    told = []
    for ladder in record["convergence"]:
        finest = ladder["levels"][-1]
        told.append(
            f"the {ladder['scheme']} scheme's time-step error falls with order "
            f"{finest['time_step_order']:.2f}, to {abs(finest['budget']['time_step']) * 1e6:.1e} "
            f"µm at {finest['step'] * 1e9:g} ns"
        )
    return f"On logarithmic axes {'; '.join(told)}. Hollow: the whole error, with the stop rule."


def plot(figure: "Figure", record: dict[str, Any]) -> None:
    """The time-step part as filled points on a line, the whole error hollow."""
    from matplotlib.ticker import NullFormatter

    axes = figure.subplots()
    for ladder in record["convergence"]:
        color, marker, order = _LOOKS[ladder["scheme"]]
        steps = [one["step"] * 1e9 for one in ladder["levels"]]
        parts = [abs(one["budget"]["time_step"]) * 1e6 for one in ladder["levels"]]
        whole = [abs(one["error"]) * 1e6 for one in ladder["levels"]]
        name = f"{ladder['scheme']} ({order})"
        axes.loglog(steps, parts, marker=marker, color=color, ms=6, label=name)
        axes.loglog(steps, whole, marker, mfc="none", mec=color, ms=9)
    axes.axvline(0.2, color=INK, linewidth=1.0, linestyle="--")
    axes.annotate(
        "0.2 ns, the report", (0.2, 0.04), xycoords=("data", "axes fraction"),
        xytext=(5, 0), textcoords="offset points",
    )  # fmt: skip
    axes.loglog([], [], "o", color=INK, ms=6, label="filled: time step alone")
    axes.loglog([], [], "o", mfc="none", mec=INK, ms=9, label="hollow: whole error")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_major_formatter(power_of_ten)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_formatter(NullFormatter())
    axes.set(xlabel="Time step [ns]", ylabel="|error| of the final depth [µm]")
    figure.legend(loc="outside upper center", ncols=2)

"""All approaches to the normalized depth on one axis: computed, printed, quoted."""

from typing import TYPE_CHECKING, Any

from replication.reports.figures.drawing import BLUE, GREEN, INK, VERMILION

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAME = "comparison"
TITLE = "Normalized depth by every approach of the report"
SIZE = (5.0, 6.4)

_COLORS = {"observed": GREEN, "sheet": BLUE, "exact": BLUE, "Frank-Zook": VERMILION}


def describe(record: dict[str, Any]) -> str:
    """Every row with its numbers."""
    return "; ".join(_told(one) for one in record["approaches"]) + "."


def _told(one: dict[str, Any]) -> str:
    head = f"{one['kind']}, {one['name']}"
    if one["computed"] is None:
        return f"{head}: {one['printed']} as quoted, not recomputable"
    printed = f" (printed {one['printed']})" if one["printed"] else ""
    return f"{head}: {one['computed']:.3f}{printed}"


def plot(figure: "Figure", record: dict[str, Any]) -> None:
    """One row an approach: a filled dot is ours, a hollow diamond is the report's."""
    axes = figure.subplots()
    rows = record["approaches"]
    observed = [one["computed"] for one in rows if one["kind"] == "observed"]
    axes.axvspan(min(observed), max(observed), color=GREEN, alpha=0.3, linewidth=0)
    for y, one in enumerate(rows):
        color = _COLORS.get(one["kind"], INK)
        axes.annotate(_label(one), (0.01, y - 0.3), va="center")
        if one["computed"] is not None:
            axes.plot(one["computed"], y + 0.15, "o", color=color, ms=7)
        if one["printed"]:
            axes.plot(float(one["printed"]), y + 0.15, "D", mfc="none", mec=color, ms=10, mew=1.4)
        shown = one["printed"] if one["computed"] is None else f"{one['computed']:.3f}"
        axes.annotate(shown, (1.02, y + 0.15), xycoords=("axes fraction", "data"), va="center")
    axes.plot([], [], "o", color=INK, ms=7, label="computed")
    axes.plot([], [], "D", mfc="none", mec=INK, ms=10, mew=1.4, label="printed in the report")
    axes.set_yticks([])
    axes.set(xlabel="Normalized depth X/R", xlim=(0, 1.02), ylim=(len(rows) - 0.5, -0.6))
    axes.grid(visible=False, axis="y")
    figure.legend(loc="outside upper center", ncols=2)


def _label(one: dict[str, Any]) -> str:
    """Greek, and without what the page tells."""
    name = one["name"].replace("beta", "β").replace(" from Eqs. 14 and 15", "")
    quoted = "" if one["recomputable"] else " (quoted, not recomputable)"
    return f"{one['kind']}: {name.partition(', the line')[0]}{quoted}"

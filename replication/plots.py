"""Figures of a case, a sweep or a fit, with one's own points over them, as SVG, PNG or PDF.

The colors and marks of the report's two cases are those of the workbook and of the page
(`spreadsheets.styles.CURVES`). Curves differ in dashes and marks, too, so that a figure can be read
in gray. The same numbers give the same file.
"""

import io
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from replication.asked_unit import LENGTH_UNITS, TIME_UNITS, ask_if_far
from replication.cases import INPUTS
from replication.columns import Column, column_of, not_among, note_of_unused, read_columns
from replication.fit import HEADS, Fit, Measurement, note_of_share, uncertainties_in
from replication.models.depth import final_depth
from replication.models.impact import Impact
from replication.models.motion import history, stop_time
from replication.models.sheet import Sheet
from replication.text import number, with_error
from spreadsheets.safely import check_target
from spreadsheets.styles import CURVES

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    import numpy as np
    import numpy.typing as npt
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ENDINGS = (".svg", ".png", ".pdf")
"""The endings of files that a figure can be written to."""

STYLE: Mapping[str, Any] = {
    "font.family": "DejaVu Sans",  # comes with Matplotlib, so that every machine has it
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#E5E5E5",
    "grid.linewidth": 0.6,
    "legend.edgecolor": "none",
    "legend.framealpha": 0.85,
    "lines.linewidth": 1.2,
    "lines.markersize": 4,
    "svg.hashsalt": "coldspray",  # otherwise ids in the file would differ from run to run
    "svg.fonttype": "none",
}
"""The style of all figures that Matplotlib draws, in its own settings."""

INK, SHADE = "#1f2328", "#8c959f"
"""The colors of text, of one's own points and of the exact motion; and of what stands behind."""


class CurveLook(NamedTuple):
    """How a curve is drawn, in Matplotlib's words."""

    color: str
    line: str
    marker: str

    @property
    def of_line(self) -> dict[str, Any]:
        """The settings of a line without marks."""
        return {"color": self.color, "linestyle": self.line}

    @property
    def of_marks(self) -> dict[str, Any]:
        """The settings of marks without a line."""
        return {"color": self.color, "linestyle": "", "marker": self.marker}


_LINES, _MARKERS = {"solid": "-", "dash": "--"}, {"circle": "o", "square": "s"}
BY_BETA = {
    beta: CurveLook(look.color, _LINES[look.dash], _MARKERS[look.marker])
    for beta, look in CURVES.items()
}
"""The looks of the report's two cases, by their beta."""

OTHER_LOOKS = (
    CurveLook("#009e73", "-.", "^"),
    CurveLook("#cc79a7", ":", "D"),
    CurveLook("#e69f00", (0, (6, 1, 1, 1, 1, 1)), "v"),  # type: ignore[arg-type]
    CurveLook("#56b4e9", (0, (1, 3)), "P"),  # type: ignore[arg-type]
    CurveLook(INK, "-", "X"),
    CurveLook(SHADE, "--", "*"),
)
"""The looks of all other curves: more of Okabe and Ito's colors."""

MOST_CURVES = len(OTHER_LOOKS)
"""The most curves that a figure shows, one for each value of an input."""


def look_of(impact: Impact) -> CurveLook:
    """Return how a case is drawn: by its beta as the report's, or else in a look of its own.

    >>> from replication.cases import BETA_3
    >>> look_of(BETA_3).color == CURVES["3"].color
    True
    """
    return _look("" if impact.beta is None else f"{impact.beta:g}", 0)


def _look(beta: str, position: int) -> CurveLook:
    return BY_BETA.get(beta, OTHER_LOOKS[position % MOST_CURVES])


# Quantities and their units


@dataclass(frozen=True, slots=True)
class AxisQuantity:
    """A quantity of an axis: its label, its SI unit, and the names of its column in one's own file.

    Its axis is in `unit`, which is `scale` times smaller than the SI unit.
    """

    label: str
    names: tuple[str, ...]
    si: str
    unit: str
    scale: float = 1.0

    @property
    def title(self) -> str:
        """The title of its axis, such as "Time [ns]"."""
        return f"{self.label} [{self.unit}]"

    def shown(self, values: Any) -> Any:
        """Return values in the unit of the axis, as an array."""
        import numpy as np

        return np.asarray(values, float) * self.scale


_SHOWN = {"m": ("µm", 1e6), "s": ("ns", 1e9), "Pa": ("MPa", 1e-6), "kg/m^3": ("kg/m³", 1.0)}


def _quantity(name: str, si: str, label: str = "", names: Sequence[str] = ()) -> AxisQuantity:
    words = name.replace("_", " ")
    unit, scale = _SHOWN.get(si, (si, 1.0))
    return AxisQuantity(label or words.capitalize(), tuple(names) or (words,), si, unit, scale)


TIME = _quantity("time", "s", names=("time", "t", "zeit", "temps"))
SPEED = _quantity(
    "velocity", "m/s", names=("velocity", "impact velocity", "v", "geschwindigkeit", "vitesse")
)
DEPTH = _quantity("depth", "m", "Penetration depth", HEADS["depth"])
RATIO = _quantity("normalized_depth", "1", "Normalized depth X/R", ("normalized depth", "x/r"))
STEP = _quantity("step", "s", "Time step", ("step", "time step", "dt"))
ERROR = AxisQuantity(
    "Size of the error of the final depth", ("error", "error of depth"), "m", "nm", 1e9
)
UNCERTAINTY = _quantity("uncertainty", "m", names=HEADS["uncertainty"])
INPUT = {
    name: _quantity(name, si, {"velocity": "Impact velocity"}.get(name, ""), HEADS.get(name, ()))
    for name, si in INPUTS.items()
}
"""The inputs of a case, by their names."""


def in_title(inputs: Mapping[str, float]) -> str:
    """Return inputs of a case [SI], by name, as words of a title; those of the sheet are left out.

    >>> in_title({"radius": 11e-6, "beta": 5.0, "step": 2e-10})
    'radius 11 µm, beta 5'
    """
    names = [name for name in inputs if name not in ("step", "stop_velocity")]
    return ", ".join(_in_words(name, inputs[name]) for name in names)


def _in_words(name: str, value: float) -> str:
    quantity = INPUT[name]
    unit = "" if quantity.unit == "1" else f" {quantity.unit}"
    return f"{quantity.label.lower()} {number(value * quantity.scale)}{unit}"


# One's own points


@dataclass(frozen=True, slots=True)
class Points:
    """One's own points: the name of their file, and columns [SI] by quantity, of equal length.

    `notes` says which columns of the file are not used.
    """

    file: str
    columns: Mapping[AxisQuantity, Sequence[float]]
    notes: Sequence[str] = ()

    def draw(
        self, panel: "Axes", x: AxisQuantity, y: AxisQuantity, *, further: bool = False
    ) -> None:
        """Draw them on a panel of y against x, with bars for the uncertainty of a depth.

        further: others than those that a fit is of.

        Nothing is drawn if there is no column of one of the two.
        """
        if x not in self.columns or y not in self.columns:
            return
        bars = None
        if y is DEPTH and UNCERTAINTY in self.columns:
            bars = y.shown(self.columns[UNCERTAINTY])
        across, up = (quantity.shown(self.columns[quantity]) for quantity in (x, y))
        _draw_own_points(panel, across, up, bars, self.file, further=further)


def _draw_own_points(
    panel: "Axes", x: Any, y: Any, bars: Any, label: str, *, further: bool = False
) -> None:
    """Draw measured points: hollow, above all else, and with the id `data` in an SVG."""
    marker = "s" if further else "o"
    hollow = {"linestyle": "", "marker": marker, "markersize": 6, "markerfacecolor": "none"}
    settings: Any = {**hollow, "color": INK, "zorder": 5}
    if bars is not None:
        panel.errorbar(x, y, bars, color=INK, linestyle="", linewidth=0.8, capsize=2, zorder=4.9)
    (marks,) = panel.plot(x, y, label=label, **settings)
    marks.set_gid("further-data" if further else "data")


def read_points(
    path: Path,
    x: AxisQuantity | None,
    ys: Sequence[AxisQuantity],
    reach: Mapping[AxisQuantity, tuple[float, str]] = {},
) -> Points:
    """Read one's own points from a file of columns (`replication.columns`), known by their heads.

    There must be a column of x, if it is not None, and of one of `ys` at least. `reach` says how
    far [SI] that goes with which some quantities are drawn, and what it is: a column without a unit
    must not be far beyond. Raises OSError, or ValueError that names the file and what it lacks.
    """
    columns = read_columns(path)
    known: dict[AxisQuantity, Column] = {}
    # What is left may be the uncertainty: an "error" that an axis shows is none.
    for quantity in (*([x] if x else ()), *ys, UNCERTAINTY):
        if column := column_of(not_among(columns, known.values()), quantity.names):
            known[quantity] = column
    uncertainty = known.pop(UNCERTAINTY, None)
    numbers = {quantity: column.numbers(quantity.si) for quantity, column in known.items()}
    if uncertainty and DEPTH in known:  # bars are those of a depth
        bars = uncertainties_in(uncertainty, known[DEPTH], numbers[DEPTH], DEPTH.si)
        known[UNCERTAINTY], numbers[UNCERTAINTY] = uncertainty, bars
    lacks = "" if x is None or x in numbers else f"'{_head(x)}'"
    if not any(y in numbers for y in ys):
        wanted = " or ".join(f"'{_head(y)}'" for y in ys)
        lacks = f"{lacks}, and no column {wanted}" if lacks else wanted
    if lacks:
        has = ", ".join(repr(column.head) for column in columns[:6])
        raise ValueError(f"{path} has no column {lacks} (it has {has})")
    for quantity, (scale, what) in reach.items():
        if quantity in known:
            units = TIME_UNITS if quantity.si == "s" else LENGTH_UNITS
            ask_if_far(known[quantity], numbers[quantity], scale, what, units)
    notes = note_of_unused(columns, known.values())
    notes += note_of_share(known.get(UNCERTAINTY), known.get(DEPTH))
    return Points(path.name, numbers, notes)


def reach_of(impact: Impact) -> dict[AxisQuantity, tuple[float, str]]:
    """Return the reach of a case, for `read_points`: its time of rest [s] and its depth [m]."""
    time = stop_time(**impact.motion), "the time until rest"
    depth = final_depth(**impact.motion), "the final depth"
    return {TIME: time, STEP: time, DEPTH: depth, ERROR: depth}


def _head(quantity: AxisQuantity) -> str:
    return f"{quantity.names[0]} [{quantity.unit.replace('µ', 'u').replace('³', '^3')}]"


# Files


def check_plot(path: Path, *inputs: Path | None) -> None:
    """Raise ValueError if a figure cannot be written to `path`, or OSError as `check_target` does.

    >>> check_plot(Path("history.gif"))
    Traceback (most recent call last):
    ValueError: history.gif: a figure's name ends in .svg, .png or .pdf
    """
    if path.suffix.lower() not in ENDINGS:
        raise ValueError(f"{path}: a figure's name ends in {', '.join(ENDINGS[:-1])} or .pdf")
    target = check_target(path)
    if any(source is not None and source.resolve() == target for source in inputs):
        raise ValueError(f"{path} is also read: write the figure to another file")


def styled() -> "AbstractContextManager[None]":
    """Return the context in which figures are drawn and written, whatever the user's own style."""
    import matplotlib as mpl

    settings: Any = {**mpl.rcParamsDefault, **STYLE}
    settings.pop("backend", None)  # of windows, which are not touched
    return mpl.rc_context(settings)


def content(figure: "Figure", ending: str = ".svg") -> bytes:
    """Return the bytes of a figure's file, on a white background; `ending` is one of `ENDINGS`."""
    # Without dates, the same numbers give the same file.
    dates = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}, ".png": {}}
    file = io.BytesIO()
    with styled():
        form, undated = ending.lower(), dates[ending.lower()]
        figure.savefig(file, format=form[1:], dpi=160, facecolor="white", metadata=undated)
    return file.getvalue()


_TYPESET = {
    " um": " µm", "kg/m^3": "kg/m³", "rho_p": "ρₚ", "rho_t": "ρₜ", "R_t": "Rₜ", "Y_t": "Yₜ",
    " x ": " × ",
}  # fmt: skip
"""How titles are written, which come from the terminal's own lines."""


def _panels(title: str, count: int, sharex: bool = True) -> "tuple[Figure, list[Axes]]":
    """Return a figure with panels, one below another, under a title."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 1.4 + 2.6 * count), layout="constrained")
    for plain, typeset in _TYPESET.items():
        title = title.replace(plain, typeset)
    figure.suptitle(title, fontsize=9, wrap=True)
    grid = figure.subplots(count, 1, sharex=sharex, squeeze=False)
    return figure, [row[0] for row in grid]


def _legend(panel: "Axes") -> None:
    handles, labels = panel.get_legend_handles_labels()
    if labels:
        panel.legend(handles, labels)


# The figures

CURVE_POINTS = 201
"""Number of points of a smooth curve, ends included."""

MARKS = 30
"""About how many rows of a sheet are marked; with all of them the marks would be a band."""


def plot_history(
    impact: Impact,
    time: Sequence[float],
    depth: Sequence[float],
    velocity: Sequence[float],
    title: str = "",
    points: Points | None = None,
) -> "Figure":
    """Draw depth and velocity against time; these times (SI) are marked if they are few.

    If the particle sinks in that far, a line marks x = R, where the contact area stops growing.
    """
    label = "at the times asked for"
    marks = {DEPTH: Marks(label, time, depth), SPEED: Marks(label, time, velocity)}
    line, is_marked = look_of(impact).of_line, len(time) <= MARKS
    return _over_exact(impact, max(time), line, marks if is_marked else {}, title, points)


class Marks(NamedTuple):
    """What is marked over a curve: its name, times [s], and depths or velocities [SI]."""

    label: str
    times: Sequence[float]
    values: Sequence[float]


def _over_exact(
    impact: Impact,
    end: float,
    line: Mapping[str, Any],
    marks: Mapping[AxisQuantity, Marks],
    title: str,
    points: Points | None,
) -> "Figure":
    """Draw the exact depth and velocity from 0 to an end [s], in a style of line, and marks."""
    curves = _exact(impact, end)
    with styled():
        figure, panels = _panels(title, 2)
        for panel, quantity in zip(panels, (DEPTH, SPEED), strict=True):
            exact = quantity.shown(curves[quantity])
            panel.plot(TIME.shown(curves[TIME]), exact, **line, label="exact")
            if quantity in marks:
                label, times, values = marks[quantity]
                x, y = TIME.shown(times), quantity.shown(values)
                panel.plot(x, y, label=label, **look_of(impact).of_marks)
            panel.set_ylabel(quantity.title)
            if points:
                points.draw(panel, TIME, quantity)
            _legend(panel)
        _line_at_radius(panels[0], impact, max(curves[DEPTH]))
        panels[-1].set_xlabel(TIME.title)
        return figure


def _exact(impact: Impact, end: float) -> dict[AxisQuantity, list[float]]:
    """Return times from 0 to an end [s], with the exact depths and velocities: a smooth curve."""
    time = [end * k / (CURVE_POINTS - 1) for k in range(CURVE_POINTS)]
    depth, speed = [0.0] * CURVE_POINTS, [0.0] * CURVE_POINTS
    history(time, **impact.motion, depth=depth, speed=speed)
    return {TIME: time, DEPTH: depth, SPEED: speed}


def _line_at_radius(panel: "Axes", impact: Impact, deepest: float) -> None:
    """Draw the depth R, where the contact area stops growing, if the particle comes near it."""
    if deepest > 0.8 * impact.radius:
        R = impact.radius * DEPTH.scale
        panel.axhline(R, color=SHADE, linestyle=":", linewidth=1)
        panel.annotate("x = R", (0.01, R), xycoords=("axes fraction", "data"), va="bottom")


def plot_sheet(sheet: Sheet, title: str = "", points: Points | None = None) -> "Figure":
    """Draw the sheet's rows over the exact motion: depth and final velocity against time.

    A row's depth belongs to the middle of its step, half a step before its time. It is drawn there:
    at the row's time it would stand below the curve, by a difference that the sheet does not have.
    Row 0, the touch, is drawn, too.
    """
    impact, every = sheet.impact, _every(sheet.steps)
    rows = (
        sheet.rows[::every] if sheet.steps % every == 0 else [*sheet.rows[::every], sheet.rows[-1]]
    )
    last = [
        row.velocity_initial if row.velocity_final is None else row.velocity_final for row in rows
    ]
    end = max(sheet.rows[-1].time, stop_time(**impact.motion))
    label = "the sheet, all rows" if every == 1 else f"the sheet, one row of {every}"
    times, middles = (
        [row.time for row in rows],
        [max(0.0, row.time - impact.step / 2) for row in rows],
    )
    marks = {
        DEPTH: Marks(
            f"{label}, each in the middle of its step", middles, [row.depth for row in rows]
        ),
        SPEED: Marks(label, times, last),
    }
    return _over_exact(impact, end, {"color": INK}, marks, title, points)


_PARTS = {
    "time_step": ("time step", CurveLook("#009e73", "-.", "^")),
    "stop_rule": ("stop rule", CurveLook("#cc79a7", ":", "D")),
    "half_step": ("half step", CurveLook("#e69f00", "--", "v")),
    "rounding": ("rounding", CurveLook(SHADE, ":", "x")),
}
"""The parts of an error (`replication.error.ladder`), in words, and how they are drawn."""


_MOST_TICKS = 16
"""The most time steps that can be read beside each other on an axis."""


def plot_converge(
    impact: Impact, record: Mapping[str, Any], title: str = "", points: Points | None = None
) -> "Figure":
    """Draw the size of the sheet's error and of its parts against the time step, both logarithmic.

    `record` is that of `replication.error.ladder.converge`. An error of zero cannot be drawn on a
    logarithmic axis, and is left out. A gray line falls with the order of the scheme. One's own
    points are errors, or final depths, from which the exact depth at rest is subtracted.
    """
    levels, look = record["levels"], look_of(impact)
    steps = STEP.shown([level["step"] for level in levels])
    with styled():
        figure, (panel,) = _panels(title, 1)
        figure.set_size_inches(6.4, 4.8)
        panel.set(xscale="log", yscale="log", xlabel=STEP.title, ylabel=ERROR.title)
        errors = _sizes([level["error"] for level in levels])
        panel.plot(
            steps, errors, label="error", marker=look.marker, **look.of_line | {"linewidth": 2}
        )
        for part, (words, own) in _PARTS.items():
            sizes = _sizes([level["budget"][part] for level in levels])
            panel.plot(steps, sizes, label=words, marker=own.marker, **own.of_line)
        _guide(panel, steps, errors, record["nominal_order"])
        ticks = {number(step, 3): step for step in steps.tolist()}
        if points:
            own_steps = STEP.shown(points.columns[STEP])
            own_errors = points.columns.get(ERROR)
            if own_errors is None:
                own_errors = [depth - record["exact"] for depth in points.columns[DEPTH]]
            _draw_own_points(panel, own_steps, _sizes(own_errors), None, points.file)
            own_ticks = {number(step, 3): step for step in own_steps.tolist()}
            ticks |= own_ticks if len(ticks | own_ticks) <= _MOST_TICKS else {}
        panel.set_xticks([*ticks.values()], [*ticks], minor=False)
        panel.xaxis.minorticks_off()
        panel.tick_params(axis="x", labelrotation=45 if len(ticks) > 8 else 0)
        panel.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        return figure


def _sizes(lengths: Sequence[float | None]) -> Any:
    """Return the sizes of errors [nm]; those of zero, or of nothing, are NaN and are not drawn."""
    return ERROR.shown([abs(length) if length else math.nan for length in lengths])


def _guide(panel: "Axes", steps: Any, errors: Any, order: int) -> None:
    """Draw how an error of the scheme's order falls, from the greatest error on."""
    if not errors[0] > 0:
        return
    power = {1: "dt", 2: "dt²"}[order]
    line = errors[0] * (steps / steps[0]) ** order
    panel.plot(
        steps, line, color=SHADE, linewidth=0.8, zorder=1, label=f"order {order}: as {power}"
    )


def plot_fit(
    measurements: Sequence[Measurement],
    fit: Fit,
    title: str = "",
    file: str = "measured",
    points: Points | None = None,
) -> "Figure":
    """Draw measured depths with the fitted curve over velocity, and the residuals below.

    One's own points are further ones, drawn as squares, which were not fitted.

    The curve is for the inputs of the measurements if these differ in nothing but the velocity;
    otherwise the fitted depth of each measurement is marked. `fit` is of `replication.fit.fit`.
    """
    speeds = [m.velocity for m in measurements]
    depths = [m.depth for m in measurements]
    bars = None
    if all(m.uncertainty is not None for m in measurements):
        bars = DEPTH.shown([m.uncertainty for m in measurements])
    x, look, words = INPUT["velocity"], OTHER_LOOKS[0], _fitted(fit)
    with styled():
        figure, (above, below) = _panels(title, 2)
        if len({m.impact[1:] for m in measurements}) == 1:
            low, high = min(speeds), max(speeds)
            margin = (high - low) / 20 or low / 20
            low, high = max(low - margin, low / 2), high + margin
            curve = [low + (high - low) * k / (CURVE_POINTS - 1) for k in range(CURVE_POINTS)]
            fitted = [final_depth(v, *measurements[0].impact[1:], fit.resistance) for v in curve]
            above.plot(x.shown(curve), DEPTH.shown(fitted), label=words, **look.of_line)
        else:
            fitted = [final_depth(*m.impact, fit.resistance) for m in measurements]
            above.plot(x.shown(speeds), DEPTH.shown(fitted), label=words, **look.of_marks)
        _draw_own_points(above, x.shown(speeds), DEPTH.shown(depths), bars, file)
        if points:
            points.draw(above, x, DEPTH, further=True)
        below.axhline(0, **look.of_line)
        _draw_own_points(below, x.shown(speeds), DEPTH.shown(fit.residuals), bars, file)
        above.set_ylabel(DEPTH.title)
        below.set_ylabel(f"Measured less fitted [{DEPTH.unit}]")
        below.set_xlabel(x.title)
        _legend(above)
        return figure


def _fitted(fit: Fit) -> str:
    """Return the fitted quantity with its standard error, such as "resistance 3.50 ± 0.10 GPa"."""
    unit, scale = {"beta": ("", 1.0), "flow_stress": (" MPa", 1e-6)}.get(
        fit.quantity, (" GPa", 1e-9)
    )
    shown = number(fit.value * scale, 4)
    if fit.standard_error is not None:
        shown = with_error(fit.value * scale, fit.standard_error * scale)
    return f"fitted {fit.quantity.replace('_', ' ')} {shown}{unit}"


# Sweeps

MOST_DRAWN = 1_000_000
"""The most cases of a sweep that are drawn: their results are held in memory."""

QUANTILES = {0.05: 0.8, 0.5: 1.6, 0.95: 0.8}
"""The quantiles that a histogram shows, with the widths of their lines; the dashes are its own."""

_QUANTILES_TITLE = "quantiles of 5, 50 and 95 %"

SweepResults = Mapping[str, Any]
"""Columns of a sweep (SI), inputs and results, each of the shape (cases,)."""


def check_sweep(axes: Mapping[str, int], samples: int, drawn: bool) -> None:
    """Raise ValueError if the cases of a sweep make no figure.

    `axes` are the inputs with several listed values, and their numbers; `drawn` says whether inputs
    are drawn, in each of the combinations `samples` times.

    >>> check_sweep({"beta": 2, "radius": 41, "velocity": 5}, 1, False)
    Traceback (most recent call last):
    ValueError: it varies beta, radius and velocity: a figure shows one or two inputs
    """
    names, combinations = list(axes), math.prod(axes.values())
    if drawn:
        if combinations > MOST_CURVES:
            raise ValueError(
                f"it draws for {combinations} combinations of {' and '.join(names)}: a figure "
                f"shows at most {MOST_CURVES} histograms"
            )
    elif not axes:
        raise ValueError("it varies no input: there is nothing to draw against")
    elif len(axes) > 2:
        listed = f"{', '.join(names[:-1])} and {names[-1]}"
        raise ValueError(f"it varies {listed}: a figure shows one or two inputs")
    if combinations * samples > MOST_DRAWN:
        raise ValueError(
            f"it has {combinations * samples:,} cases: a figure shows {MOST_DRAWN:,} at most"
        )


def sweep_points(
    axes: Mapping[str, int], drawn: bool, greatest: Mapping[str, float] = {}
) -> Callable[[Path], Points]:
    """Return a reader of one's own points for the figure of a sweep.

    `greatest` has the greatest value [SI] of each input, which says how far the axes reach.
    """
    x = None if drawn else INPUT[_across(axes)]
    ys = (INPUT[_vertical_input(axes)],) if not drawn and _is_map(axes) else (DEPTH, RATIO)
    reach = {
        quantity: (greatest[name], f"the largest {name.replace('_', ' ')} of the plan")
        for quantity, name in (
            (DEPTH, "radius"),
            (INPUT["radius"], "radius"),
            (INPUT["step"], "step"),
        )
        if name in greatest
    }
    return lambda path: read_points(path, x, ys, reach)


def _across(axes: Mapping[str, int]) -> str:
    """Return the input along the axis x: the one with the most values, the last of equals."""
    return max(reversed([*axes]), key=axes.__getitem__)


def _is_map(axes: Mapping[str, int]) -> bool:
    """Return whether both inputs have too many values for a curve each."""
    return len(axes) == 2 and min(axes.values()) > MOST_CURVES


def _vertical_input(axes: Mapping[str, int]) -> str:
    """Return the input along the axis y of a map."""
    return next(name for name in axes if name != _across(axes))


def plot_sweep(
    results: SweepResults,
    axes: Mapping[str, int],
    drawn: bool,
    title: str = "",
    points: Points | None = None,
) -> "Figure":
    """Draw the depth and X/R of a sweep, which `check_sweep` must allow.

    One input is the axis x. A second one with few values gives a curve for each, and with more of
    them the axis y of a map with labelled contours. Of drawn inputs, histograms are shown with the
    quantiles of 5, 50 and 95 percent.
    """
    with styled():
        if drawn:
            return _histograms(results, axes, title, points)
        if _is_map(axes):
            return _contours(results, axes, title, points)
        return _curves(results, axes, title, points)


def _series(
    shown: Mapping[str, int], axes: Mapping[str, int], results: SweepResults
) -> list[tuple[str, CurveLook, tuple[int, ...]]]:
    """Return the label, the look and the position of each combination of the values shown.

    `shown` are those of `axes` of which each combination has a curve of its own.
    """
    series, listed = [], {name: _listed(name, axes, results) for name in shown}
    alone = "" if shown else _only(results, "beta")  # several curves must differ
    for count, at in enumerate(product(*map(range, shown.values()))):
        values = {name: listed[name][k] for name, k in zip(shown, at, strict=True)}
        beta = f"{values['beta']:g}" if "beta" in values else alone
        series.append((in_title(values), _look(beta, count), at))
    return series


def _only(results: SweepResults, name: str) -> str:
    """Return an input's value in words if it is the same in all cases, and otherwise nothing."""
    values = results.get(name, [])
    return f"{values[0]:g}" if len(values) and min(values) == max(values) else ""


def _listed(name: str, axes: Mapping[str, int], results: SweepResults) -> "npt.NDArray[np.float64]":
    """Return the listed values of an input [SI], one for each of its positions."""
    position = [*axes].index(name)
    along = tuple(slice(None) if k == position else 0 for k in range(len(axes) + 1))
    listed: npt.NDArray[np.float64] = _grid(results[name], axes)[along]
    return listed


def _grid(column: Any, axes: Mapping[str, int]) -> "npt.NDArray[np.float64]":
    """Return a column in the shape of the listed inputs, with the samples last."""
    import numpy as np

    return np.asarray(column, float).reshape(*axes.values(), -1)


_RESULTS = {"depth": DEPTH, "normalized_depth": RATIO}
"""What is drawn of a sweep, by the names of its columns."""


def _curves(
    results: SweepResults, axes: Mapping[str, int], title: str, points: Points | None
) -> "Figure":
    """Draw a panel for the depth and one for X/R, with a curve for each value of a second input."""
    across = _across(axes)
    x, others = INPUT[across], {name: count for name, count in axes.items() if name != across}
    inputs, position = x.shown(_listed(across, axes, results)), [*axes].index(across)
    sheet: dict[str, Any] = {}
    if "sheet_depth" in results:
        depths = results["sheet_depth"]
        sheet = {"depth": depths, "normalized_depth": depths / results["radius"]}
    figure, panels = _panels(title, len(_RESULTS))
    for panel, (column, y) in zip(panels, _RESULTS.items(), strict=True):
        for label, look, at in _series(others, axes, results):
            where: Any = (*at[:position], slice(None), *at[position:], 0)
            exact = y.shown(_grid(results[column], axes)[where])
            mark = "" if sheet or len(inputs) > MARKS else look.marker
            # The line stands over the marks, which are hollow: both can be seen where they agree.
            settings: dict[str, Any] = {**look.of_line, "marker": mark, "zorder": 3}
            panel.plot(inputs, exact, label=label or "exact", **settings)
            if sheet:
                marks, every = y.shown(_grid(sheet[column], axes)[where]), _every(len(inputs))
                words = f"{label}, the sheet" if label else "the sheet"
                hollow = {**look.of_marks, "markerfacecolor": "white"}
                panel.plot(inputs[::every], marks[::every], label=words, **hollow)
        panel.set_ylabel(y.title)
        if points:
            _with_ratio(points, results).draw(panel, x, y)
        if _is_wide(inputs):
            _make_logarithmic(panel, "x", *("y" if y is DEPTH else ""))
        _legend(panel)
    panels[-1].set_xlabel(x.title)
    return figure


def _with_ratio(points: Points, results: SweepResults) -> Points:
    """Return the points with X/R where they have a depth alone, and the sweep has one radius."""
    radius = float(results["radius"][0])
    if RATIO in points.columns or (results["radius"] != radius).any():
        return points
    ratios = [depth / radius for depth in points.columns[DEPTH]]
    return Points(points.file, {**points.columns, RATIO: ratios}, points.notes)


def _every(count: int) -> int:
    """Return of how many points one is marked."""
    return max(1, round(count / MARKS))


def _make_logarithmic(panel: "Axes", *axes: str) -> None:
    """Make the axes "x" or "y" of a panel logarithmic, with plain numbers on them."""
    for name in axes:
        panel.set(**{f"{name}scale": "log"})
        axis = panel.xaxis if name == "x" else panel.yaxis
        axis.set_major_formatter("{x:g}")


def _is_wide(values: Any) -> bool:
    """Return whether values in equal ratios span more than a factor of ten: their axis is log."""
    import numpy as np

    if values.min() <= 0 or values.max() <= 10 * values.min() or len(values) < 3:
        return False
    # Equal ratios, up to the rounding of the values and of their logarithms.
    return bool(np.ptp(np.diff(np.log(values))) < 1e-9)


def _contours(
    results: SweepResults, axes: Mapping[str, int], title: str, points: Points | None
) -> "Figure":
    """Draw a map of the depth and one of X/R over two inputs, with labelled contours."""
    from matplotlib.colors import BoundaryNorm

    across, up = _across(axes), _vertical_input(axes)
    x, y = INPUT[across], INPUT[up]
    inputs = x.shown(_listed(across, axes, results)), y.shown(_listed(up, axes, results))
    figure, panels = _panels(title, len(_RESULTS))
    for panel, (column, quantity) in zip(panels, _RESULTS.items(), strict=True):
        values = quantity.shown(_grid(results[column], axes)[..., 0])
        values = values if [*axes] == [up, across] else values.T
        if levels := _levels(values):
            shades: Any = {"cmap": "Greys", "alpha": 0.5, "extend": "both"}
            norm = BoundaryNorm(levels, 256, extend="both")
            panel.contourf(*inputs, values, levels, norm=norm, **shades)
            lines = panel.contour(*inputs, values, levels, colors=INK, linewidths=0.8)
            labels = panel.clabel(lines, fontsize=8, fmt="%g", inline=False)
            for label in labels:  # legible on its line, and whole within the panel
                label.set_clip_on(False)
                label.set_bbox({"facecolor": "#ffffffcc", "edgecolor": "none", "pad": 0.6})
        else:
            panel.set(xlim=(inputs[0].min(), inputs[0].max()))
            panel.set(ylim=(inputs[1].min(), inputs[1].max()))
            words = f"about {number(float(values.flat[0]))} everywhere"
            panel.annotate(words, (0.5, 0.5), xycoords="axes fraction", ha="center")
        panel.set(ylabel=y.title, title=quantity.title)
        wide = [name for name, own in zip("xy", inputs, strict=True) if _is_wide(own)]
        _make_logarithmic(panel, *wide)
        if points:
            points.draw(panel, x, y)
    panels[-1].set_xlabel(x.title)
    return figure


def _levels(values: Any) -> list[float]:
    """Return some ten round levels in the range of values: equal steps, or 1, 2, 5, 10, ...

    There is none if the values differ in their last digits only.
    """
    from matplotlib.ticker import LogLocator, MaxNLocator

    low, high = float(values.min()), float(values.max())
    if high - low <= 1e-12 * abs(high):
        return []
    wide = low > 0 and high > 20 * low
    locator = LogLocator(subs=(1, 2, 5), numticks=20) if wide else MaxNLocator(10)
    return [level for level in map(float, locator.tick_values(low, high)) if low < level < high]


def _histograms(
    results: SweepResults, axes: Mapping[str, int], title: str, points: Points | None
) -> "Figure":
    """Draw histograms of the depth and of X/R, with quantiles; one's own depths stand on the axis.

    The area of a histogram is 1, so that those of other numbers of cases can be compared.
    """
    import numpy as np

    figure, panels = _panels(title, len(_RESULTS), sharex=False)
    for panel, (column, quantity) in zip(panels, _RESULTS.items(), strict=True):
        table = quantity.shown(_grid(results[column], axes))
        bins = min(60, max(10, round(math.sqrt(table.shape[-1]))))
        edges = np.linspace(table.min(), table.max(), bins + 1)
        if not edges[0] < edges[-1]:  # all results are the same number
            edges = edges[0] + np.linspace(-0.5, 0.5, 2) * (abs(edges[0]) or 1.0)
        for label, look, at in _series(axes, axes, results):
            own = table[at]
            quantiles = np.quantile(own, list(QUANTILES))
            numbers = ", ".join(number(float(value), 3) for value in quantiles)
            words = f"{label}: {numbers}" if label else numbers
            heights, _ = np.histogram(own, edges, density=True)
            panel.stairs(heights, edges, label=words, color=look.color, linestyle=look.line, lw=1.2)
            for value, width in zip(quantiles, QUANTILES.values(), strict=True):
                panel.axvline(value, **look.of_line, linewidth=width)
        if points and quantity in points.columns:
            values = quantity.shown(points.columns[quantity])
            _draw_own_points(panel, values, np.zeros(len(values)), None, points.file)
        panel.set_xlabel(quantity.title)
        unit = f"1/{quantity.unit}" if quantity.unit != "1" else "1"
        panel.set_ylabel(f"Probability density [{unit}]")
        panel.margins(y=0.25)
        panel.set_ylim(bottom=0)
        panel.legend(loc="upper right", fontsize=8, title=_QUANTILES_TITLE, title_fontsize=8)
    return figure

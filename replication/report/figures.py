"""The figures, drawn from the record: SVG that takes ink and paper of the page around it."""

import io
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.etree import ElementTree as ET

from replication.audit.record import Approach, Effect, Level, Record
from replication.report.facts import shown_range

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["FIGURES", "Drawing", "draw"]

INK, BLUE, VERMILION = "#000000", "#0072B2", "#D55E00"
"""Ink becomes the color of the text around; the others, Okabe and Ito's, stand out from white and
from near-black, and from each other for the color-blind."""

_LOOKS: Any = {
    "svg.hashsalt": "coldspray",
    "svg.fonttype": "none",
    "font.family": "DejaVu Sans",
    "font.size": 9.5,
    "axes.titlesize": 9.5,
    "axes.facecolor": "none",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.use_mathtext": False,
    "grid.color": INK,
    "grid.alpha": 0.15,
    "legend.frameon": False,
    "legend.borderaxespad": 0.2,
    "lines.linewidth": 1.6,
    "savefig.facecolor": "none",
}


class Drawing(NamedTuple):
    """A figure: the name of its file, its title, what it shows in words, and its SVG."""

    name: str
    title: str
    words: str
    svg: str


class _Plan(NamedTuple):
    title: str
    size: tuple[float, float]
    words: Callable[[Record], str]
    plot: Callable[["Figure", Record], None]


def draw(record: Record) -> list[Drawing]:
    """Every figure of the record. The same record gives the same text."""
    return [_drawn(name, plan, record) for name, plan in FIGURES.items()]


def _drawn(name: str, plan: _Plan, record: Record) -> Drawing:
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context(_LOOKS):
        figure = Figure(figsize=plan.size)
        plan.plot(figure, record)
        svg = io.StringIO()
        figure.savefig(svg, format="svg", metadata={"Date": None, "Creator": None})
    words = plan.words(record)
    return Drawing(name, plan.title, words, _tidied(svg.getvalue(), name, plan.title, words))


# Normalized depth by every approach


def _comparison_words(record: Record) -> str:
    def value(approach: Approach) -> str:
        if approach.computed is None:
            return f"{approach.printed}, quoted by the report and not recomputable"
        printed = f", printed {approach.printed}" if approach.printed else ""
        return f"{approach.computed:.3f} computed{printed}"

    parts = (f"{a.kind}, {a.name}: {value(a)}" for a in record.approaches)
    return "; ".join(parts).replace("beta", "β") + "."


def _comparison(figure: "Figure", record: Record) -> None:
    """A row for each approach: what is computed filled, what is printed or quoted hollow."""
    axes = figure.add_axes((0.43, 0.19, 0.55, 0.8))
    observed = [a.computed for a in record.approaches if a.kind == "observed" and a.computed]
    approaches = [a for a in record.approaches if a.kind != "observed"]
    axes.axvspan(min(observed), max(observed), color=INK, alpha=0.25, lw=0, label="observed")
    rows = list(enumerate(approaches))
    for marker, face, color, label, chosen in (
        ("s", "none", VERMILION, "printed by the report",
         [(float(a.printed), y) for y, a in rows if a.printed and a.computed is not None]),
        ("D", "none", INK, "quoted by the report, not recomputable",
         [(float(a.printed), y) for y, a in rows if a.computed is None]),
        ("o", BLUE, BLUE, "computed in this audit",
         [(a.computed, y) for y, a in rows if a.computed is not None]),
    ):  # fmt: skip
        size = 5 if face != "none" else 8
        axes.plot(*zip(*chosen, strict=True), marker, mfc=face, mec=color, ms=size, label=label)
    axes.set_yticks(range(len(rows)), [_row_label(a) for a in approaches])
    axes.set(xlabel="Normalized depth X/R", xlim=(0, 1.1), ylim=(len(rows) - 0.5, -0.5))
    figure.legend(loc="lower left", bbox_to_anchor=(0.02, 0.0), ncols=2, columnspacing=1.0)


def _row_label(approach: Approach) -> str:
    name = approach.name.replace("beta", "β").replace(", ", ",\n")
    return f"{approach.kind}: {name}"


# What each input does


def _effects(record: Record) -> list[tuple[str, list[Effect]]]:
    """The effects in the case of the greatest beta, the longest first."""
    case = max(record.sensitivity, key=lambda s: s.beta)
    panels = (("each input ± 10 %", case.ten_percent), ("its own stated range", case.stated))
    return [(words, sorted(effects, key=_reach, reverse=True)) for words, effects in panels]


def _reach(effect: Effect) -> float:
    return abs(effect.depths[1] - effect.depths[0])


def _input(effect: Effect) -> str:
    return effect.input.replace("_", " ").replace("beta", "β")


def _sensitivity_words(record: Record) -> str:
    return " ".join(
        f"{words.capitalize()}: "
        + "; ".join(
            f"{_input(e)} {e.depths[0] * 1e6:.2f} to {e.depths[1] * 1e6:.2f} µm" for e in effects
        )
        + "."
        for words, effects in _effects(record)
    )


def _sensitivity(figure: "Figure", record: Record) -> None:
    """Two panels of bars about the depth as printed, the longest on top."""
    nominal = max(record.sensitivity, key=lambda s: s.beta).depth * 1e6
    for bottom, (words, effects) in zip((0.585, 0.125), _effects(record), strict=True):
        axes = figure.add_axes((0.3, bottom, 0.54, 0.37))
        rows = range(len(effects))
        for end, color, label in (
            (0, VERMILION, "input at its low end"),
            (1, BLUE, "at its high end"),
        ):
            changes = [e.depths[end] * 1e6 - nominal for e in effects]
            axes.barh(rows, changes, left=nominal, color=color, height=0.7, label=label)
        for y, e in enumerate(effects):
            changes = [depth * 1e6 - nominal for depth in e.depths]
            text = "\n".join(f"{x:+.3f}".replace("-", "−") for x in changes if x)
            axes.text(1.02, y, text, transform=axes.get_yaxis_transform(), va="center", size=8.5)
        stated = words != "each input ± 10 %"
        labels = [f"{_input(e)}\n{shown_range(e)}" if stated else _input(e) for e in effects]
        axes.axvline(nominal, color=INK, linewidth=1.0)
        axes.set_yticks(rows, labels)
        axes.set(title=words, xlim=(5.4, 10.6), ylim=(len(rows) - 0.5, -0.5))
        axes.grid(visible=False, axis="y")
    axes.set_xlabel("Depth X [µm]; at the right its change [µm]")
    axes.legend(loc="upper center", bbox_to_anchor=(0.3, -0.2), ncols=2)


# Depth against time, and against velocity


def _figure_3_words(record: Record) -> str:
    ends = "; ".join(
        f"for β = {c.beta:g} the sheet stops at {c.sheet_depth[-1] * 1e6:.4f} µm after "
        f"{c.sheet_time[-1] * 1e9:.1f} ns (printed {c.printed}), the exact depth at rest is "
        f"{c.exact_depth[-1] * 1e6:.4f} µm"
        for c in record.curves
    )
    return f"Depth rises ever more slowly to rest: {ends}. At this scale the two coincide."


def _figure_3(figure: "Figure", record: Record) -> None:
    """Every fourth row of each sheet as a point, the exact motion as a line."""
    axes = figure.add_axes((0.11, 0.14, 0.87, 0.83))
    for curve, color, marker in zip(record.curves, (VERMILION, BLUE), "os", strict=True):
        times, depths = ([x * f for x in xs] for xs, f in (
            (curve.exact_time, 1e9), (curve.exact_depth, 1e6)))  # fmt: skip
        axes.plot(times, depths, color=INK, linewidth=1.0)
        rows = ([t * 1e9 for t in curve.sheet_time[::4]], [x * 1e6 for x in curve.sheet_depth[::4]])
        axes.plot(
            *rows,
            marker,
            color=color,
            ms=3.5,
            label=f"the sheet, every fourth row, β = {curve.beta:g}",
        )
        end = f"{curve.sheet_depth[-1] * 1e6:.4f} µm,\nprinted {curve.printed}"
        axes.text(times[-1] + 0.8, depths[-1], end, va="center")
    axes.plot([], [], color=INK, linewidth=1.0, label="exact")
    axes.set(xlabel="Time [ns]", ylabel="Penetration depth [µm]", xlim=(0, 46), ylim=(0, 11.5))
    axes.legend(loc="lower right")


def _observed(record: Record) -> float:
    """The observed X/R that the report prints."""
    return next(float(a.printed) for a in record.approaches if a.kind == "observed" and a.printed)


def _figure_5_words(record: Record) -> str:
    curve = record.velocity_curve
    (low, high), (first, last) = (
        (values[0], values[-1]) for values in (curve.velocity, curve.exact)
    )
    return (
        f"For β = 5, X/R rises almost in proportion to the velocity, from {first:.3f} at "
        f"{low:g} m/s to {last:.3f} at {high:g} m/s; the sheet's points lie on the exact line. All "
        f"of it is above the observed {_observed(record):.3f}."
    )


def _figure_5(figure: "Figure", record: Record) -> None:
    """The exact line, the sheet's points, and the observed level."""
    axes = figure.add_axes((0.11, 0.15, 0.87, 0.82))
    curve = record.velocity_curve
    axes.plot(curve.velocity, curve.exact, color=INK, linewidth=1.0, label="exact")
    axes.plot(
        curve.velocity[::2], curve.sheet[::2], "s", color=BLUE, ms=4.5, label="the sheet, β = 5"
    )
    axes.axhline(_observed(record), color=INK, linewidth=1.0, linestyle="--", label="observed")
    axes.set(xlabel="Impact velocity [m/s]", ylabel="Normalized depth X/R", ylim=(0, 0.8))
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.06))


# The sheet's error against its time step


_SCHEMES = {
    "published": ("drag at the initial velocity", VERMILION, "o"),
    "centered": ("drag at the middle velocity", BLUE, "s"),
}


def _ladders(record: Record) -> dict[tuple[str, float], list[Level]]:
    ladders: dict[tuple[str, float], list[Level]] = {}
    for level in record.ladders:
        ladders.setdefault((level.scheme, level.beta), []).append(level)
    return ladders


def _convergence_words(record: Record) -> str:
    return "; ".join(
        f"{_SCHEMES[scheme][0]}, β = {beta:g}: "
        + ", ".join(f"{abs(e.error) * 1e9:.2g} nm at {e.step * 1e9:g} ns" for e in levels[::2])
        for (scheme, beta), levels in _ladders(record).items()
    )


def _convergence(figure: "Figure", record: Record) -> None:
    """The error of the final depth over the time step, both axes logarithmic."""
    axes = figure.add_axes((0.13, 0.13, 0.85, 0.72))
    for (scheme, beta), levels in _ladders(record).items():
        words, color, marker = _SCHEMES[scheme]
        steps = [level.step * 1e9 for level in levels]
        errors = [abs(level.error) * 1e9 for level in levels]
        face = color if beta == max(level.beta for level in record.ladders) else "none"
        axes.loglog(steps, errors, marker=marker, color=color, mfc=face, ms=5, lw=1.0,
                    label=f"{words}, β = {beta:g}")  # fmt: skip
    axes.set(xlabel="Time step [ns]", ylabel="Error of the final depth [nm]")
    axes.set_xticks(steps, [f"{step:g}" for step in steps])
    axes.yaxis.set_major_formatter("{x:g}")
    axes.minorticks_off()
    figure.legend(loc="upper center", ncols=2, columnspacing=1.0, fontsize=9)


FIGURES = {
    "comparison": _Plan("Normalized depth by every approach of the report", (5.2, 5.4),
                        _comparison_words, _comparison),
    "sensitivity": _Plan("What each input does to the exact penetration depth, β = 5",
                         (5.2, 6.2), _sensitivity_words, _sensitivity),
    "figure-3": _Plan("Penetration depth against time, as in Figure 3 of the report", (5.2, 3.8),
                      _figure_3_words, _figure_3),
    "figure-5": _Plan("Normalized depth against impact velocity, as in Figure 5 of the report",
                      (5.2, 3.4), _figure_5_words, _figure_5),
    "convergence": _Plan("Error of the sheet's final depth against its time step", (5.2, 4.0),
                         _convergence_words, _convergence),
}  # fmt: skip
"""By the name of the file."""


# Matplotlib's SVG made fit for a page

_SVG = "http://www.w3.org/2000/svg"
_LINK = "{http://www.w3.org/1999/xlink}href"


def _tidied(text: str, name: str, title: str, words: str) -> str:
    """The SVG without style attributes, which a strict content policy forbids, and without black.

    Style becomes presentation attributes, ink the color of the text around; ids begin with `name`,
    so that several figures stand in one page. A file of its own stands on white paper.
    """
    ET.register_namespace("", _SVG)
    root = ET.fromstring(text)
    for useless in ("metadata", "defs"):  # who made it; a style that attributes replace
        found = root.find(f"{{{_SVG}}}{useless}")
        if found is None:
            raise ValueError(f"Matplotlib's SVG has no <{useless}> where one was removed")
        root.remove(found)
    referenced = set(re.findall(r'(?:href="|url\()#([^")]+)', text))
    for element in root.iter():
        _present(element)
        given = element.attrib.pop("id", None)
        if given in referenced:
            element.set("id", f"{name}-{given}")
        if _LINK in element.attrib:
            element.set("href", f"#{name}-{element.attrib.pop(_LINK)[1:]}")
        for key, value in element.attrib.items():
            element.set(key, value.replace("url(#", f"url(#{name}-"))
    root.attrib |= {
        "class": "figure",
        "role": "img",
        "aria-labelledby": f"{name}-title {name}-words",
        "color": "#1f2328",
        "fill": "currentColor",  # Matplotlib leaves out what is black
        "font-family": "DejaVu Sans, Verdana, sans-serif",
        "stroke-linejoin": "round",
    }
    paper = {"class": "paper", "width": "100%", "height": "100%", "fill": "#ffffff"}
    head = [ET.Element(f"{{{_SVG}}}{tag}") for tag in ("title", "desc")]
    for element, part, content in zip(head, ("title", "words"), (title, words), strict=True):
        element.set("id", f"{name}-{part}")
        element.text = content
    root[:0] = [*head, ET.Element(f"{{{_SVG}}}rect", paper)]
    return ET.tostring(root, encoding="unicode") + "\n"


def _present(element: ET.Element) -> None:
    """Turn the style attribute of an element into presentation attributes."""
    for declaration in element.attrib.pop("style", "").split(";"):
        key, _, value = (part.strip() for part in declaration.partition(":"))
        if key and key != "font-family":
            element.set(key, value.replace(INK, "currentColor"))

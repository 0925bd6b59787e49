"""Draw the record's figures as SVG in the colors of the page around them.

No plotting library is used: its import alone takes half as long as the whole audit, and it writes
style attributes, which the page's content security policy forbids.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from math import log10

from reference.scheme import Scheme
from replication.audit.record import Record
from replication.report.words import shown_range
from spreadsheets.styles import CURVES

PAGE_INK, PAGE_SHADE = "currentColor", "#8c959f"
"""The color of the surrounding text, and a gray for what is not a case of the report. The cases
have the colors and marks of their curves in the workbook."""

WIDTH = 440

PlanePoints = Iterable[tuple[float, float]]


def draw_figures(record: Record) -> dict[str, str]:
    """Draw the figures, by name, for which the record has data: with a misprint it may have none.

    On the page they have the page's background; as separate files they have a white one.
    """
    figures = {
        "comparison": (_approaches_plot, _observed(record)),
        "sensitivity": (_sensitivity, record.sensitivity),
        "figure-3": (_figure_3, record.curves),
        "figure-5": (_figure_5, record.velocity_curve.velocity),
        "convergence": (_convergence, record.ladders),
    }
    return {name: plot(record).svg(name) for name, (plot, data) in figures.items() if data}


@dataclass
class _Plot:
    """A plot: its box in the figure (left, top, width, height) and the ranges of its axes x and y.

    `below` is the height under the box, and `words` describes the plot to those who cannot see it.
    """

    title: str
    box: tuple[float, float, float, float]
    x: tuple[float, float]
    y: tuple[float, float]
    below: float = 42
    logarithmic: bool = False
    words: str = ""
    parts: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.left, self.top, self.width, self.height = self.box

    def svg(self, name: str) -> str:
        height = f"{self.top + self.height + self.below:.0f}"
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="figure" role="img" color="#1f2328" '
            f'fill="{PAGE_INK}" font-family="DejaVu Sans, Verdana, sans-serif" font-size="12" '
            f'width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}" '
            f'aria-labelledby="{name}-title {name}-words">',
            f'<title id="{name}-title">{escape(self.title)}</title>',
            f'<desc id="{name}-words">{escape(self.words)}</desc>',
            f'<rect class="paper" width="{WIDTH}" height="{height}" fill="#ffffff"/>',
        )
        return "\n".join((*head, *self.parts, "</svg>\n"))

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Convert a point from the plot's coordinates to the figure's."""
        scaled = log10 if self.logarithmic else float
        across, up = (
            (scaled(value) - scaled(low)) / (scaled(high) - scaled(low))
            for value, (low, high) in ((x, self.x), (y, self.y))
        )
        return self.left + across * self.width, self.top + (1 - up) * self.height

    def axes(self, x: Iterable[float], y: Iterable[float], x_label: str, y_label: str = "") -> None:
        """Draw both axes with their labels, and the grid with its numbers."""
        bottom, right = self.top + self.height, self.left + self.width
        for value in x:
            across, _ = self.at(value, self.y[0])
            self.path([(across, self.top), (across, bottom)], opacity=0.15)
            self.text(across, bottom + 16, f"{value:g}", "middle")
        for value in y:
            _, down = self.at(self.x[0], value)
            self.path([(self.left, down), (right, down)], opacity=0.15)
            self.text(self.left - 6, down + 4, f"{value:g}", "end")
        self.path([(self.left, self.top), (self.left, bottom), (right, bottom)])
        self.text(self.left + self.width / 2, bottom + 33, x_label, "middle")
        if y_label:
            middle = self.top + self.height / 2
            self.text(12, middle, y_label, "middle", f' transform="rotate(-90 12 {_n(middle)})"')

    def rows(self, labels: Sequence[str]) -> None:
        """Label the rows y = 0, 1, ... on the left; a semicolon begins a second line."""
        for row, label in enumerate(labels):
            self.row_text(self.left - 8, row, label.split("; "))

    def row_text(self, x: float, row: float, lines: Sequence[str]) -> None:
        """Write lines that end at x, centered vertically on a row."""
        _, middle = self.at(self.x[0], row)
        for k, line in enumerate(lines):
            self.text(x, middle + 4 + 13 * (k - (len(lines) - 1) / 2), line, "end")

    def line(self, points: PlanePoints, color: str = PAGE_INK, dashes: str = "") -> None:
        self.path([self.at(*point) for point in points], color, dashes)

    def marks(self, kind: str, color: str, points: PlanePoints) -> None:
        for point in points:
            self.mark(kind, color, *self.at(*point))

    def bar(
        self, low: float, high: float, y: float, fill: str, height: float, edge: str = "none"
    ) -> None:
        (left, down), (right, _) = self.at(min(low, high), y), self.at(max(low, high), y)
        self.parts.append(
            f'<rect x="{_n(left)}" y="{_n(down - height / 2)}" width="{_n(right - left)}" '
            f'height="{_n(height)}" fill="{fill}" stroke="{edge}"/>'
        )

    def legend(self, x: float, y: float, entries: Mapping[str, tuple[str, str]]) -> None:
        """List entries one below another, each with the kind and color of its mark or line."""
        for k, (words, (kind, color)) in enumerate(entries.items()):
            down = y + 17 * k
            if kind.endswith("line"):
                dashes = "5 3" if kind.startswith("dashed") else ""
                self.path([(x - 9, down), (x + 9, down)], color, dashes)
            else:
                self.mark(kind, color, x, down)
            self.text(x + 15, down + 4, words)

    # The methods below take the figure's coordinates, not the plot's.

    def mark(self, kind: str, color: str, x: float, y: float) -> None:
        """Draw a mark; a hollow one is larger than a filled one, so that both can be seen."""
        is_filled, shape = not kind.startswith("hollow"), kind.rpartition(" ")[2]
        r = 3.5 if is_filled else 5.0
        place = f'rect x="{_n(x - r)}" y="{_n(y - r)}" width="{2 * r}" height="{2 * r}"'
        if shape == "circle":
            place = f'circle cx="{_n(x)}" cy="{_n(y)}" r="{r}"'
        turn = f' transform="rotate(45 {_n(x)} {_n(y)})"' if shape == "diamond" else ""
        fill = color if is_filled else "none"
        self.parts.append(f'<{place} fill="{fill}" stroke="{color}"{turn}/>')

    def path(
        self, points: PlanePoints, color: str = PAGE_INK, dashes: str = "", opacity: float = 1.0
    ) -> None:
        path = " ".join(f"{_n(x)},{_n(y)}" for x, y in points)
        faint = f' stroke-opacity="{opacity}"' if opacity < 1 else ""
        dashed = f' stroke-dasharray="{dashes}"' if dashes else ""
        self.parts.append(
            f'<polyline points="{path}" fill="none" stroke="{color}"{faint}{dashed}/>'
        )

    def text(self, x: float, y: float, words: str, anchor: str = "start", more: str = "") -> None:
        attributes = f'x="{_n(x)}" y="{_n(y)}" text-anchor="{anchor}"{more}'
        self.parts.append(f"<text {attributes}>{escape(words)}</text>")


def _n(value: float) -> str:
    return f"{value:.1f}".removesuffix(".0")


def _look(beta: float) -> tuple[str, str]:
    """Return the mark and the color of a case: those of the report's case with the nearest beta."""
    look = CURVES[min(CURVES, key=lambda known: abs(float(known) - beta))]
    return look.marker, look.color


def _observed(record: Record) -> list[float]:
    """Return the values of X/R that follow from observations."""
    return [a.computed for a in record.approaches if a.kind == "observed" and a.computed]


def _approaches_plot(record: Record) -> _Plot:
    """Show X/R by each approach in a row: computed as filled marks, printed or quoted as hollow.

    Those for a beta of the report have the color and the mark of that case.
    """
    observed = _observed(record)
    shown = [a for a in record.approaches if a.kind != "observed"]
    title = "Normalized depth by every approach of the report"
    height = 30 * len(shown)
    plot = _Plot(title, (190, 8, 240, height), (0, 1.1), (len(shown) - 0.5, -0.5), below=132)
    plot.bar(min(observed), max(observed), (len(shown) - 1) / 2, PAGE_SHADE, plot.height)
    plot.axes([k / 5 for k in range(6)], [], "Normalized depth X/R")
    plot.rows([f"{a.kind}: {a.name}".replace(", ", ",; ").replace("beta", "β") for a in shown])
    for y, a in enumerate(shown):
        kind, color = ("diamond", PAGE_INK) if a.beta is None else _look(a.beta)
        if a.shown:
            plot.marks(f"hollow {kind}", color, [(float(a.shown), y)])
        if a.computed is not None:
            plot.marks(kind, color, [(a.computed, y)])
    plot.legend(100, height + 60, {
        **{f"computed, β = {beta}": _look(float(beta)) for beta in CURVES},
        "computed, Frank and Zook": ("diamond", PAGE_INK),
        "hollow: as the report prints or quotes it": ("hollow diamond", PAGE_INK),
        f"observed, {min(observed):.3f} to {max(observed):.3f}": ("line", PAGE_SHADE),
    })  # fmt: skip
    values = []
    for a in record.approaches:
        value = f"{a.shown}, quoted by the report and not recomputable"
        if a.computed is not None:
            value = f"{a.computed:.3f} computed" + (f", printed {a.shown}" if a.shown else "")
        values.append(f"{a.kind}, {a.name}: {value}")
    plot.words = f"{'; '.join(values)}.".replace("beta", "β")
    return plot


def _sensitivity(record: Record) -> _Plot:
    """Show by bars how far each input's range moves the depth, the longest bar on top."""
    case = max(record.sensitivity, key=lambda s: s.beta)
    effects = sorted(case.stated, key=lambda e: -abs(e.depths[1] - e.depths[0]))
    title = f"What each input's stated range does to the exact penetration depth, β = {case.beta:g}"
    height, rows = 32 * len(effects), (len(effects) - 0.5, -0.5)
    plot = _Plot(title, (140, 24, 240, height), (5.4, 10.6), rows, below=84)
    plot.axes(range(6, 11), [], "Depth X [µm]")
    named = [(e.input.replace("_", " ").replace("beta", "β"), e) for e in effects]
    plot.rows([f"{name}; {shown_range(e)}" for name, e in named])
    (_, color), depth, words = _look(case.beta), case.depth * 1e6, []
    for y, (name, effect) in enumerate(named):
        ends = [x * 1e6 for x in effect.depths]
        for end, fill in zip(ends, ("none", color), strict=True):
            plot.bar(depth, end, y, fill, 18, color)
        changes = [f"{end - depth:+.3f}" for end in ends]
        plot.row_text(434, y, [c.replace("-", "−") for c in changes if float(c)])
        words.append(f"{name} {' to '.join(f'{end:.2f}' for end in ends)} µm")
    plot.line([(depth, y) for y in rows])
    looks = {"input at its low end": ("hollow square", color), "at its high end": ("square", color)}
    plot.legend(150, height + 80, looks)
    plot.text(434, 16, "change [µm]", "end")
    plot.words = f"{'; '.join(words)}."
    return plot


def _figure_3(record: Record) -> _Plot:
    """Plot depth against time: the exact motion as a line, every eighth sheet row as a mark."""
    title = "Penetration depth against time, as in Figure 3 of the report"
    plot = _Plot(title, (44, 8, 386, 260), (0, 46), (0, 11.5))
    plot.axes(range(0, 41, 10), range(0, 11, 2), "Time [ns]", "Penetration depth [µm]")
    legend, words = {"exact": ("line", PAGE_INK)}, []
    for curve in record.curves:
        look = _look(curve.beta)
        exact, sheet = (
            [(time * 1e9, depth * 1e6) for time, depth in zip(*columns, strict=True)]
            for columns in ((curve.exact_time, curve.exact_depth),
                            (curve.sheet_time, curve.sheet_depth))
        )  # fmt: skip
        plot.line(exact)
        plot.marks(*look, sheet[::8])
        legend[f"the sheet, every eighth row, β = {curve.beta:g}"] = look
        x, y = plot.at(*exact[-1])
        time, depth = sheet[-1]
        plot.text(x + 8, y, f"{depth:.4f} µm,")
        plot.text(x + 8, y + 14, f"printed {curve.shown}")
        words.append(
            f"for β = {curve.beta:g} the sheet stops at {depth:.4f} µm after {time:.1f} ns "
            f"(printed {curve.shown}), the exact depth at rest is {exact[-1][1]:.4f} µm"
        )
    plot.words = (
        f"Depth rises ever more slowly to rest: {'; '.join(words)}. At this scale they coincide."
    )
    plot.legend(205, 205, legend)
    return plot


def _figure_5(record: Record) -> _Plot:
    """Plot X/R against impact velocity: exact, by the sheet, and as observed."""
    curve = record.velocity_curve
    low, high = curve.velocity[0], curve.velocity[-1]
    title = "Normalized depth against impact velocity, as in Figure 5 of the report"
    plot = _Plot(title, (44, 8, 386, 230), (low - 5, high + 5), (0, 0.8))
    ratios = [k / 10 for k in range(9)]
    plot.axes(range(400, 501, 20), ratios, "Impact velocity [m/s]", "Normalized depth X/R")
    observed = next(float(a.shown) for a in record.approaches if a.kind == "observed" and a.shown)
    plot.line(zip(curve.velocity, curve.exact, strict=True))
    plot.line([(x, observed) for x in plot.x], PAGE_INK, "5 3")
    plot.marks(*_look(5), list(zip(curve.velocity, curve.sheet, strict=True))[::2])
    plot.legend(290, 180, {
        "exact": ("line", PAGE_INK),
        "the sheet, β = 5": _look(5),
        f"observed, {observed}": ("dashed line", PAGE_INK),
    })  # fmt: skip
    plot.words = (
        f"For β = 5, X/R rises almost in proportion to the velocity, from {curve.exact[0]:.3f} at "
        f"{low:g} m/s to {curve.exact[-1]:.3f} at {high:g} m/s; the sheet's points lie on the "
        f"exact line. All of it is above the observed {observed:.3f}."
    )
    return plot


def _convergence(record: Record) -> _Plot:
    """Plot the error of the sheet's final depth against the time step, both axes logarithmic."""
    ladders: dict[tuple[str, float], list[tuple[float, float]]] = {}
    for level in record.ladders:
        point = level.step * 1e9, abs(level.error) * 1e9
        ladders.setdefault((level.scheme, level.beta), []).append(point)
    title = "Error of the sheet's final depth against its time step"
    plot = _Plot(title, (44, 8, 386, 260), (0.04, 4), (0.01, 300), below=120, logarithmic=True)
    steps = sorted({round(level.step * 1e9, 9) for level in record.ladders})
    plot.axes(steps, [0.01, 0.1, 1, 10, 100], "Time step [ns]", "Error of the final depth [nm]")
    legend, words = {}, []
    for (scheme, beta), points in ladders.items():
        (kind, color), dashes = _look(beta), ""
        if scheme == Scheme.CENTERED:
            kind, dashes = f"hollow {kind}", "5 3"
        plot.line(points, color, dashes)
        plot.marks(kind, color, points)
        name = f"drag at the {Scheme(scheme).drag_at} velocity, β = {beta:g}"
        legend[name] = (kind, color)
        errors = ", ".join(f"{error:.2g} nm at {step:g} ns" for step, error in points[::2])
        words.append(f"{name}: {errors}")
    plot.legend(140, 322, legend)
    plot.words = "; ".join(words)
    return plot

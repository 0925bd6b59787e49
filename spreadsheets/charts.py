"""Charts of a sheet's cells, through XlsxWriter, which stores the charted values with them."""

from typing import Any

from spreadsheets.plan import Chart, Series

__all__ = ["draw"]

_COLORS = ("#1F4E9E", "#C55A11")
_FONT = {"name": "Arial", "size": 10, "bold": False}
_GRID = {"visible": True, "line": {"color": "#D0D7DE", "width": 0.75}}
_SIZE = {"width": 820, "height": 470}
"""In pixels: with the head of the sheet, a landscape page."""


def draw(book: Any, page: Any, sheet: str, chart: Chart) -> None:
    """Draw one chart on the page of `sheet`, which holds its cells."""
    if chart.categories:
        drawn = book.add_chart({"type": "line"})
    else:
        drawn = book.add_chart({"type": "scatter", "subtype": "straight"})
    for series, color in zip(chart.series, _COLORS, strict=False):
        drawn.add_series(_series(sheet, series, color, chart))
    drawn.set_title({"name": chart.title, "name_font": {"name": "Arial", "size": 13}})
    drawn.set_x_axis(_axis(chart.x_title, chart) | ({"position_axis": "on_tick"}))
    drawn.set_y_axis(_axis(chart.y_title, chart))
    drawn.set_legend({"position": "bottom", "font": _FONT})
    drawn.set_size(_SIZE)
    page.insert_chart(chart.at, drawn, {"description": chart.title})


def _series(sheet: str, series: Series, color: str, chart: Chart) -> dict[str, Any]:
    settings = {
        "name": series.name,
        "categories": _absolute(sheet, series.x),
        "values": _absolute(sheet, series.y),
        "line": {"color": color, "width": 2},
    }
    if chart.logarithmic or chart.categories:
        # Few points: show where they are.
        fill = {"color": color}
        settings["marker"] = {"type": "circle", "size": 5, "fill": fill, "border": fill}
    return settings


def _axis(title: str, chart: Chart) -> dict[str, Any]:
    settings: dict[str, Any] = {
        "name": title,
        "name_font": _FONT,
        "num_font": _FONT,
        "major_gridlines": _GRID,
        "label_position": "low",
    }
    return settings | ({"log_base": 10} if chart.logarithmic else {})


def _absolute(sheet: str, cells: str) -> str:
    """A range of cells as a chart refers to it.

    >>> _absolute("Figure 5", "B5:B25")
    "='Figure 5'!$B$5:$B$25"
    """
    ends = (f"${cell.rstrip('0123456789')}${cell.lstrip(_LETTERS)}" for cell in cells.split(":"))
    return f"='{sheet}'!{':'.join(ends)}"


_LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"

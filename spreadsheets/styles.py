"""How the workbook looks, in properties of XlsxWriter: one font, light fills, thin lines."""

from collections.abc import Mapping
from typing import Any, NamedTuple

_GRAY, _LINE, _INPUT = "#5A5A5A", "#D0D7DE", "#0000FF"
_HEAD = {"bold": True, "bg_color": "#E8EDF3", "bottom": 1}
_TYPED = {"font_color": _INPUT, "border": 1, "border_color": _LINE, "align": "right"}

STYLES: Mapping[str, Mapping[str, Any]] = {
    "body": {},
    "title": {"font_size": 14, "bold": True},
    "headline": {"font_size": 11, "bold": True},
    "note": {"font_color": _GRAY, "italic": True},
    "head": _HEAD,
    "head right": {**_HEAD, "align": "right"},
    "head unit": {**_HEAD, "align": "left", "indent": 1},
    "block": {"bold": True},
    "text": {"align": "left", "indent": 1},
    "unit": {"font_color": _GRAY, "align": "left", "indent": 1},
    "unit right": {"font_color": _GRAY, "align": "right", "bottom": 1, "bottom_color": _LINE},
    "number": {"align": "right"},
    "result": {"align": "right", "bold": True},
    "message": {"align": "left", "bold": True},
    "state": {"align": "left", "indent": 1, "bold": True},
    "input": {**_TYPED, "bg_color": "#FFF9DB"},
    "inferred": {**_TYPED, "bg_color": "#FFE3C2"},
    "printed": {"font_color": _GRAY, "align": "right"},
    "recorded": {"font_color": _GRAY, "align": "right"},
    "link": {"font_color": "#1F4E9E", "underline": 1},
}
"""The styles of cells; black where no color is given. "printed" is for texts of the report,
"recorded" for other numbers that no change of the inputs affects."""

RULES: Mapping[str, Mapping[str, Any]] = {
    "ruled": {"bottom": 1, "bottom_color": _LINE},
    "warning": {"font_color": "#B00020", "bold": True},
    "changed": {"font_color": "#8A4B00", "bold": True},
    "good": {"font_color": "#1B6E3C", "bold": True},
    "faint": {"font_color": "#8C959F", "bold": False},
}
"""The styles of rules, which name only the properties that they change."""


class ChartCurveLook(NamedTuple):
    """How a curve of a chart is drawn."""

    color: str
    dash: str
    marker: str


CURVES: Mapping[str, ChartCurveLook] = {
    "3": ChartCurveLook("#d55e00", "solid", "circle"),
    "5": ChartCurveLook("#0072b2", "dash", "square"),
}
"""The curve of a case by its beta, in the workbook, on the page and in all other figures.

They can be told apart even without color. The colors are vermilion and blue of Okabe and Ito's
palette, which stand out from white, from near-black and, for the color-blind too, from each other.
"""

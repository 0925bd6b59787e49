"""How each named style looks: one font, light fills, thin lines (properties as XlsxWriter's)."""

from typing import Any

_INK, _GRAY, _BLUE, _RED = "#000000", "#5A5A5A", "#0000FF", "#B00020"
_YELLOW, _ORANGE, _HEAD, _RULE = "#FFF9DB", "#FFE3C2", "#E8EDF3", "#D0D7DE"

_FONT: dict[str, Any] = {"font_name": "Arial", "font_size": 10, "font_color": _INK}
_RIGHT: dict[str, Any] = {"align": "right"}
_INDENT: dict[str, Any] = {"align": "left", "indent": 1}
_INPUT: dict[str, Any] = {**_FONT, "font_color": _BLUE, "border": 1, "border_color": _RULE}
_HEADING: dict[str, Any] = {**_FONT, "bold": True, "bg_color": _HEAD, "bottom": 1}

STYLES: dict[str, dict[str, Any]] = {
    "body": _FONT,
    "title": {**_FONT, "bold": True, "font_size": 14},
    "headline": {**_FONT, "bold": True, "font_size": 11},
    "note": {**_FONT, "font_color": _GRAY, "italic": True},
    "head": _HEADING,
    "head right": {**_HEADING, **_RIGHT},
    "head unit": {**_HEADING, **_INDENT},
    "block": {**_FONT, "bold": True},
    "text": {**_FONT, **_INDENT},
    "unit": {**_FONT, **_INDENT, "font_color": _GRAY},
    "unit right": {**_FONT, **_RIGHT, "font_color": _GRAY, "bottom": 1, "bottom_color": _RULE},
    "number": {**_FONT, **_RIGHT},
    "result": {**_FONT, **_RIGHT, "bold": True},
    "message": {**_FONT, "align": "left", "bold": True},
    "state": {**_FONT, **_INDENT, "bold": True},
    "input": {**_INPUT, **_RIGHT, "bg_color": _YELLOW},
    "inferred": {**_INPUT, **_RIGHT, "bg_color": _ORANGE},
    "printed": {**_FONT, **_RIGHT, "font_color": _GRAY},
    "recorded": {**_FONT, **_RIGHT, "font_color": _GRAY},
    "link": {**_FONT, "font_color": "#1F4E9E", "underline": 1},
    # Styles of a rule change what a cell already has, so they name nothing else.
    "ruled": {"bottom": 1, "bottom_color": _RULE},
    "warning": {"font_color": _RED, "bold": True},
    "changed": {"font_color": "#8A4B00", "bold": True},
    "good": {"font_color": "#1B6E3C", "bold": True},
}
STYLES |= {
    f"{name} sample": {**STYLES[name], "align": "center"}
    for name in ("input", "inferred", "number", "printed")
}
"""Style name -> properties. "printed" is for what the report prints, "recorded" for other numbers
that do not follow a change of the inputs; a "sample" looks like its style but holds no value."""

DASHES = (
    {"color": "#1F4E9E", "dash": "solid", "marker": "circle"},
    {"color": "#C55A11", "dash": "dash", "marker": "square"},
)
"""How the curves of a chart differ, so that they can be told apart without color, too."""

"""Matplotlib's SVG made fit for a page with a strict content policy and for screen readers.

No style attribute or element: presentation attributes, which a policy does not concern. Ink takes
the color of the surrounding text, so that it shows in the dark. Ids are the figure's own, so that
several figures stand in one page.
"""

import re
from xml.etree import ElementTree as ET

__all__ = ["tidy"]

_SVG = "http://www.w3.org/2000/svg"
_LINK = "{http://www.w3.org/1999/xlink}href"
_INK = "#000000"


def tidy(text: str, name: str, title: str, description: str) -> str:
    """The SVG element of a figure, without XML head; `name` begins each of its ids.

    As a file of its own it stands on white paper; a page may style `.figure` and `.paper`.
    """
    ET.register_namespace("", _SVG)
    root = ET.fromstring(text)
    for useless in ("metadata", "defs"):  # who made it; a style that the root's attributes replace
        root.remove(_required(root, useless))
    referenced = set(re.findall(r'(?:href="|url\()#([^")]+)', text))
    for element in root.iter():
        _presented(element)
        _identified(element, name, referenced)
    _head(root, name, title, description)
    return ET.tostring(root, encoding="unicode") + "\n"


def _required(root: ET.Element, tag: str) -> ET.Element:
    found = root.find(f"{{{_SVG}}}{tag}")
    if found is None:
        raise ValueError(f"matplotlib's SVG has no <{tag}> where one was removed")
    return found


def _presented(element: ET.Element) -> None:
    for declaration in element.attrib.pop("style", "").split(";"):
        key, _, given = declaration.partition(":")
        if key.strip() and key.strip() != "font-family":
            element.set(key.strip(), given.strip().replace(_INK, "currentColor"))
    if element.get("transform", "").startswith("rotate(-0 "):
        del element.attrib["transform"]


def _identified(element: ET.Element, name: str, referenced: set[str]) -> None:
    given = element.attrib.pop("id", None)
    if given in referenced:
        element.set("id", f"{name}-{given}")
    link = element.attrib.pop(_LINK, None)
    if link is not None:
        element.set("href", f"#{name}-{link[1:]}")
    for key, value in element.attrib.items():
        element.set(key, value.replace("url(#", f"url(#{name}-"))


def _head(root: ET.Element, name: str, title: str, description: str) -> None:
    attributes = {
        "class": "figure",
        "role": "img",
        "aria-labelledby": f"{name}-title {name}-desc",
        "color": "#1f2328",
        "fill": "currentColor",  # matplotlib leaves out what is black
        "font-family": "DejaVu Sans, Verdana, sans-serif",
        "stroke-linejoin": "round",
    }
    for key, value in attributes.items():
        root.set(key, value)
    paper = {"class": "paper", "width": "100%", "height": "100%", "fill": "#ffffff"}
    root.insert(0, ET.Element(f"{{{_SVG}}}rect", paper))
    for position, (tag, words) in enumerate((("title", title), ("desc", description))):
        element = ET.Element(f"{{{_SVG}}}{tag}", {"id": f"{name}-{tag}"})
        element.text = words
        root.insert(position, element)

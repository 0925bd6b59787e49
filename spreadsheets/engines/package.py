"""The parts of an .xlsx file: enough to find its worksheets and to see that none is damaged."""

from __future__ import annotations

import zipfile
import zlib
from pathlib import Path
from xml.etree import ElementTree as ET

WORKBOOK = "xl/workbook.xml"

UNREADABLE = (OSError, KeyError, zipfile.BadZipFile, zlib.error, ET.ParseError)
"""What reading a file raises that is not a sound .xlsx file."""


def read_part(archive: zipfile.ZipFile, part: str) -> ET.Element:
    """Parse one XML part of the file."""
    return ET.fromstring(archive.read(part))


def worksheets(archive: zipfile.ZipFile) -> dict[str, str]:
    """Map each worksheet's name, in the workbook's order, to the part that holds its cells."""
    parts = {
        relation.attrib["Id"]: _part(relation.attrib["Target"])
        for relation in read_part(archive, "xl/_rels/workbook.xml.rels")
        if relation.attrib["Type"].endswith("/worksheet")  # and not "/chartsheet"
    }
    sheets = read_part(archive, WORKBOOK).iterfind("{*}sheets/{*}sheet")
    related = {sheet.attrib["name"]: _relation(sheet) for sheet in sheets}
    return {name: parts[relation] for name, relation in related.items() if relation in parts}


def checked_worksheets(path: Path) -> list[str]:
    """List the worksheets of a file; raise one of UNREADABLE unless every part is well formed."""
    with zipfile.ZipFile(path) as archive:
        for part in archive.namelist():
            if part.endswith((".xml", ".rels")):
                read_part(archive, part)
        found = worksheets(archive)
        for part in found.values():
            archive.getinfo(part)
    return list(found)


def _part(target: str) -> str:
    """Resolve a target, which is relative to xl/ unless it starts at the root."""
    return target[1:] if target.startswith("/") else f"xl/{target}"


def _relation(sheet: ET.Element) -> str:
    """Read the attribute r:id, whose namespace differs between the two kinds of Office Open XML."""
    return next(value for key, value in sheet.attrib.items() if key.endswith("}id"))

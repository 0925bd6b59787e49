"""What was found as a JUnit file, which build servers show: one test a kind of difference."""

from collections.abc import Mapping, Sequence
from typing import Any
from xml.etree import ElementTree as ET

from replication.check.difference import NO_FAULT
from replication.check.record import safe

__all__ = ["junit"]


def junit(record: Mapping[str, Any], kinds: Sequence[str]) -> str:
    """A suite with one test for each kind: failed where it was found, skipped where not covered."""
    differences = record["differences"]
    failed = {d["kind"] for d in differences} - NO_FAULT
    suite = ET.Element(
        "testsuite",
        name=f"coldspray {safe(record['file'], 200)}",
        tests=str(len(kinds)),
        failures=str(len(failed)),
        errors="0",
        skipped=str("not calculated" in record["summary"]),
    )
    suite.set("skipped", str(int("not calculated" in record["summary"])))
    for kind in kinds:
        case = ET.SubElement(suite, "testcase", classname="coldspray", name=kind)
        found = [d for d in differences if d["kind"] == kind]
        text = "\n".join(_line(d) for d in found)
        if kind in failed:
            message = f"{len(found)} found, the first at {_line(found[0])}"
            ET.SubElement(case, "failure", message=message).text = text
        elif kind == "not calculated" and found:
            ET.SubElement(case, "skipped", message=text)
        elif found:
            ET.SubElement(case, "system-out").text = text
    ET.indent(suite)
    declared = '<?xml version="1.0" encoding="UTF-8"?>\n'
    return declared + ET.tostring(suite, encoding="unicode") + "\n"


def _line(difference: Mapping[str, Any]) -> str:
    where = f"{safe(difference['sheet'], 40)}!{difference['cell']}"
    return f"{where}: {safe(difference['explanation'], 300)}"

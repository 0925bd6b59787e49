"""The audit's folder: the record as JSON, CSV, Markdown, page and figures, written all or none."""

import csv
import io
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

import msgspec

from replication.audit.record import ClaimRecord, Record
from replication.plain import json_text
from spreadsheets.safely import check_folder, write_folder


def check(folder: Path) -> None:
    """Raise OSError, naming the path, where the audit's files could not be written."""
    names = ("audit.html", "audit.md", "audit.json", "audit.csv", "workbook.xlsx", "figures/x.svg")
    check_folder(folder, names)


def write(record: Record, folder: Path, beside: Mapping[str, bytes]) -> dict[str, bytes]:
    """Write the record, and the files `beside` it by name, into a folder that is made if needed.

    All or none. Returns what was written. Raises OSError, naming the file.
    """
    files = contents(record, beside)
    write_folder(folder, files)
    return files


def contents(record: Record, beside: Mapping[str, bytes]) -> dict[str, bytes]:
    """Every file of the folder by its name; the record names the hashes of those beside it."""
    from replication.report.figures import draw
    from replication.report.render import markdown, page

    hashes = {name: sha256(content).hexdigest() for name, content in beside.items()}
    provenance = {**record.provenance, "sha256": {**record.provenance["sha256"], **hashes}}
    record = msgspec.structs.replace(record, provenance=provenance)
    drawings = draw(record)
    texts = {
        "audit.html": page(record, drawings),
        "audit.md": markdown(record),
        "audit.csv": _csv(record),
        **{f"figures/{drawing.name}.svg": drawing.svg for drawing in drawings},
    }
    files = {name: text.encode() for name, text in texts.items()}
    return {**beside, **files, "audit.json": json_text(record).encode()}


_COLUMNS = (
    "id", "where", "printed", "unit", "kind", "interval_lower", "interval_upper", "computed",
    "enclosure_lower", "enclosure_upper", "verdict", "error_in_last_digit", "title", "explanation",
    "holds", "restates",
)  # fmt: skip


def _csv(record: Record) -> str:
    """A line for each claim; what does not apply is empty."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(_COLUMNS)
    writer.writerows([_cell(claim, column) for column in _COLUMNS] for claim in record.claims)
    return buffer.getvalue()


def _cell(claim: ClaimRecord, column: str) -> Any:
    name, _, end = column.rpartition("_")
    if end in ("lower", "upper"):
        ends = getattr(claim, name)
        return ends and ends[end == "upper"]
    return getattr(claim, column)

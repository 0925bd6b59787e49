"""The audit's files, written all or none."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from replication import workbook
from replication.audit import Audit, audit
from replication.processes import second_process
from replication.reports.figures import FIGURES, Drawing, draw
from replication.reports.html import page
from replication.reports.markdown import markdown
from replication.reports.numerics import numerics_record
from replication.reports.plain import json_text, rows_csv
from replication.reports.provenance import sealed
from replication.reports.records import audit_record, shown_record
from spreadsheets.safely import write_folder

__all__ = ["FILES", "write_audit"]


FILES = (
    "workbook.xlsx", "audit.html", "audit.md", "audit.json", "audit.csv",
    *(f"figures/{figure.NAME}.{kind}" for figure in FIGURES for kind in ("svg", "png")),
)  # fmt: skip


def write_audit(folder: Path) -> Audit:
    """Audit the report and write the audit's `FILES` into a folder, made if needed: all or none.

    What does not rest on the proofs is made beside them, by a second process. Raises OSError when
    the files cannot be written, or that process is killed.
    """
    with second_process() as start:
        numerics, workbook_bytes = start(numerics_record), start(workbook.to_bytes)
        done = audit()
        shown = shown_record(done, numerics())
        drawings = start(draw, shown)
        record, book = audit_record(done, shown), {"workbook.xlsx": workbook_bytes()}
        files = _contents(done, sealed(record, book), drawings())
    write_folder(folder, {**book, **files})
    return done


def _contents(
    audit: Audit, record: dict[str, Any], drawings: Sequence[Drawing]
) -> dict[str, bytes]:
    """Every file but the workbook."""
    texts = {
        "audit.html": page(record, drawings),
        "audit.md": markdown(audit, record),
        "audit.json": json_text(record),
        "audit.csv": _claims_csv(record["claims"]),
        **{f"figures/{drawing.name}.svg": drawing.svg for drawing in drawings},
    }
    pictures = {f"figures/{drawing.name}.png": drawing.png for drawing in drawings}
    return {name: text.encode() for name, text in texts.items()} | pictures


_COLUMNS = (
    "id", "where", "printed", "unit", "kind", "interval", "computed", "enclosure", "verdict",
    "error_in_last_digit", "title", "explanation",
)  # fmt: skip


def _claims_csv(claims: list[dict[str, Any]]) -> str:
    """One line a claim; an interval or enclosure takes two columns, `_lower` and `_upper`."""
    return rows_csv([_flat({name: claim[name] for name in _COLUMNS}) for claim in claims])


def _flat(record: dict[str, Any]) -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for name, value in record.items():
        if name in ("interval", "enclosure"):
            flat[f"{name}_lower"], flat[f"{name}_upper"] = value or (None, None)
        else:
            flat[name] = value
    return flat

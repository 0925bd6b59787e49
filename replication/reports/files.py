"""The audit's files, written all or none."""

import os
import tempfile
from errno import EACCES, ENOTDIR
from pathlib import Path
from typing import Any

from replication import workbook
from replication.audit import Audit
from replication.reports.figures import FIGURES, draw
from replication.reports.html import page
from replication.reports.markdown import markdown
from replication.reports.plain import json_text, rows_csv
from replication.reports.provenance import sealed
from spreadsheets.safely import check_target

__all__ = ["FILES", "check_folder", "write_audit"]


FILES = (
    "workbook.xlsx", "audit.html", "audit.md", "audit.json", "audit.csv",
    *(f"figures/{figure.NAME}.{kind}" for figure in FIGURES for kind in ("svg", "png")),
)  # fmt: skip


def check_folder(folder: Path) -> None:
    """Raise OSError where the audit's files cannot be written, before anything is computed."""
    for wanted in (folder, folder / "figures"):
        existing = _existing(wanted)
        if not existing.is_dir():
            raise NotADirectoryError(ENOTDIR, "is a file; a folder is wanted", str(existing))
        if not os.access(existing, os.W_OK):
            raise PermissionError(EACCES, "cannot be written to", str(existing))
    for path in (folder / name for name in FILES):
        if path.parent.is_dir():
            check_target(path)


def _existing(folder: Path) -> Path:
    """The folder, or the nearest above it that exists."""
    return next(path for path in (folder, *folder.absolute().parents) if path.exists())


def write_audit(audit: Audit, record: dict[str, Any], folder: Path) -> list[Path]:
    """Write the audit's `FILES` into a folder, made if needed.

    `record` is the audit as `reports.records.audit_record` gives it; the hash of the workbook is
    added to its provenance. The files are made beside the folder first and moved in when all are
    done. Raises OSError when it cannot be done.
    """
    with tempfile.TemporaryDirectory(dir=_existing(folder), prefix=".coldspray-") as temporary:
        made = Path(temporary)
        workbook.write(made / "workbook.xlsx")
        (made / "figures").mkdir()
        for name, content in _contents(audit, sealed(record, made / "workbook.xlsx")).items():
            (made / name).write_bytes(content)
        (folder / "figures").mkdir(parents=True, exist_ok=True)
        return [(made / name).replace(folder / name) for name in FILES]


def _contents(audit: Audit, record: dict[str, Any]) -> dict[str, bytes]:
    """Every file but the workbook."""
    drawings = draw(record)
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

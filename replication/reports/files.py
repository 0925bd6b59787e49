"""The audit's files, written all or none."""

import os
import tempfile
from collections.abc import Iterable
from errno import EACCES, ENOTDIR
from pathlib import Path
from typing import Any

from replication import workbook
from replication.audit import Audit
from replication.reports.markdown import markdown
from replication.reports.plain import json_text, rows_csv
from spreadsheets.safely import check_target

__all__ = ["FILES", "check_folder", "write_audit"]


FILES = ("workbook.xlsx", "audit.md", "audit.json", "audit.csv")


def check_folder(folder: Path, names: Iterable[str] = FILES) -> None:
    """Raise OSError where files of these names cannot be written, before anything is computed."""
    existing = _existing(folder)
    if not existing.is_dir():
        raise NotADirectoryError(ENOTDIR, "is a file; a folder is wanted", str(existing))
    if not os.access(existing, os.W_OK):
        raise PermissionError(EACCES, "cannot be written to", str(existing))
    for name in names if folder.is_dir() else ():
        check_target(folder / name)


def _existing(folder: Path) -> Path:
    """The folder, or the nearest above it that exists."""
    return next(path for path in (folder, *folder.absolute().parents) if path.exists())


def write_audit(audit: Audit, record: dict[str, Any], folder: Path) -> list[Path]:
    """Write workbook.xlsx, audit.md, audit.json and audit.csv into a folder, made if needed.

    `record` is the audit as `reports.records.audit_record` gives it. The files are made beside the
    folder first and moved in when all are done. Raises OSError when it cannot be done.
    """
    texts = {
        "audit.md": markdown(audit, record),
        "audit.json": json_text(record),
        "audit.csv": _claims_csv(record["claims"]),
    }
    with tempfile.TemporaryDirectory(dir=_existing(folder), prefix=".coldspray-") as temporary:
        made = Path(temporary)
        for name, text in texts.items():
            (made / name).write_text(text, encoding="utf-8", newline="\n")
        workbook.write(made / "workbook.xlsx")
        folder.mkdir(parents=True, exist_ok=True)
        return [(made / name).replace(folder / name) for name in FILES]


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

"""Records as JSON and CSV text, with every digit."""

import csv
import io
import json
from typing import Any

__all__ = ["json_text", "rows_csv"]


def json_text(record: Any) -> str:
    """One JSON document; every float with the digits that make it the same double again."""
    return json.dumps(record, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def rows_csv(rows: list[dict[str, Any]]) -> str:
    """Records as CSV; floats keep all digits, None is an empty field."""
    buffer = io.StringIO()
    writer = csv.DictWriter(buffer, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return buffer.getvalue()

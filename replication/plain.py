"""Records as JSON and CSV text, with every digit."""

import csv
import io
import json
from typing import Any

import msgspec


def json_text(record: Any) -> str:
    r"""One JSON document; every float with the digits that make it the same double again.

    Raises ValueError for a float that is not finite, which JSON cannot hold.

    >>> json_text({"depth": 1e-06})
    '{\n  "depth": 1e-06\n}\n'
    """
    compact = json.dumps(msgspec.to_builtins(record), ensure_ascii=False, allow_nan=False)
    # A file's name may hold what no encoding has; escaped, it is JSON again.
    return msgspec.json.format(compact.encode(errors="backslashreplace"), indent=2).decode() + "\n"


def rows_csv(rows: list[dict[str, Any]]) -> str:
    r"""Records as CSV; floats keep all digits, None is an empty field, truth is true or false.

    >>> rows_csv([{"depth": 1e-06, "beyond_radius": False, "gap": None}])
    'depth,beyond_radius,gap\n1e-06,false,\n'
    """
    buffer = io.StringIO()
    writer = csv.DictWriter(buffer, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows({name: _spelt(value) for name, value in row.items()} for row in rows)
    return buffer.getvalue()


def _spelt(value: Any) -> Any:
    return str(value).lower() if isinstance(value, bool) else value

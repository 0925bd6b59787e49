"""What an audit was made with and from; no clock and no machine, so that it is the same again."""

import platform
from collections.abc import Mapping
from hashlib import sha256
from importlib import metadata, resources
from typing import Any

__all__ = ["provenance", "sealed"]

_LIBRARIES = (
    "coldspray", "jinja2", "matplotlib", "mpmath", "numpy", "openpyxl", "pandas", "pint",
    "python-flint", "XlsxWriter",
)  # fmt: skip
_SOURCES = ("de_rosset_2006.txt", "ledger.toml", "conjectures.toml", "findings.toml")


def provenance() -> dict[str, Any]:
    """The command, the versions, and the hashes of the report, the ledger and what is asserted."""
    folder = resources.files("reference.report")
    return {
        "command": "coldspray audit",
        "python": platform.python_version(),
        "versions": {name: metadata.version(name) for name in _LIBRARIES},
        "sha256": {name: sha256((folder / name).read_bytes()).hexdigest() for name in _SOURCES},
    }


def sealed(record: dict[str, Any], files: Mapping[str, bytes]) -> dict[str, Any]:
    """An audit's record with the hashes of files that stand beside it."""
    made = record["provenance"]
    hashes = {name: sha256(content).hexdigest() for name, content in files.items()}
    return {**record, "provenance": {**made, "sha256": {**made["sha256"], **hashes}}}

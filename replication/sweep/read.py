"""The TOML file of a sweep, checked at the door (format: docs/sweeps/README.md)."""

import hashlib
from pathlib import Path
from typing import Any

from replication.case import INPUTS, parse_toml
from replication.impact import CASES
from replication.sweep.draws import Random
from replication.sweep.plan import EXTRAS, Plan
from replication.sweep.sources import Listed, Source
from replication.sweep.tables import check_keys, place, read_source, whole_number

__all__ = ["read_plan"]


def read_plan(path: Path) -> Plan:
    """The plan that a TOML file describes.

    Raises OSError, or ValueError that names the file, the table, the key and what would be right,
    also where an input or a combination of them would leave the range that `Impact` allows.
    """
    content = path.read_bytes()
    with place(str(path)):
        return _plan(parse_toml(content), hashlib.sha256(content).hexdigest())


def _plan(document: dict[str, Any], digest: str) -> Plan:
    check_keys(document, ["inputs"], ["sweep"])
    for name, table in document.items():
        if not isinstance(table, dict):
            raise ValueError(f"{name} must be a table, [{name}]")
    with place("[sweep]"):
        settings = document.get("sweep", {})
        check_keys(settings, [], ["case", "samples", "seed", "outputs"])
        base, extras = _base(settings), _extras(settings)
    with place("[inputs]"):
        sources = _sources(document["inputs"], base)
    with place("[sweep]"):
        samples, seed = _sampling(settings, sources)
    return Plan(sources, samples, seed, extras, digest)


def _base(settings: dict[str, Any]) -> dict[str, float]:
    name = settings.get("case", "beta-5")
    if not isinstance(name, str) or name not in CASES:
        raise ValueError(f"there is no case {name!r}: choose one of {', '.join(CASES)}")
    values = {key: getattr(CASES[name], key) for key in INPUTS}
    return {key: value for key, value in values.items() if value is not None}


def _extras(settings: dict[str, Any]) -> tuple[str, ...]:
    asked = settings.get("outputs", [])
    if not isinstance(asked, list) or any(name not in EXTRAS for name in asked):
        raise ValueError(f"outputs wants a list of {', '.join(EXTRAS)}; the depths always come")
    return tuple(name for name in EXTRAS if name in asked)


def _sampling(settings: dict[str, Any], sources: dict[str, Source]) -> tuple[int, int]:
    if any(isinstance(source, Random) for source in sources.values()):
        if "samples" not in settings:
            raise ValueError("samples is missing: how many cases to draw")
        seed = whole_number("seed", settings.get("seed", 0), 0, 2**64 - 1)
        return whole_number("samples", settings["samples"], 1), seed
    for key in ("samples", "seed"):
        if key in settings:
            raise ValueError(f"{key} is for distributions, and no input has one")
    return 1, 0


def _sources(table: dict[str, Any], base: dict[str, float]) -> dict[str, Source]:
    check_keys(table, [], INPUTS)
    if "resistance" in table:
        base = {name: base[name] for name in base if name not in ("beta", "flow_stress")}
    sources: dict[str, Source] = {name: Listed((value,)) for name, value in base.items()}
    for name, value in table.items():
        sources.pop(name, None)  # so that the order is the file's
        with place(name):
            sources[name] = read_source(name, value)
    return sources

"""Conjectures on numbers that do not follow: search ranges, slips of an equation, joint questions.

The data is `report/conjectures.toml`, whose head says what each key means. Whatever is wrong with
it is an error when it is loaded, as with the ledger.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from importlib import resources
from inspect import signature
from typing import Any

from reference.ledger import Ledger, LedgerError
from reference.ledger import load as load_ledger
from reference.printed import Printed, parse
from reference.slips import RATIOS, SLIPS
from reference.units import same_dimension, to_si

__all__ = ["Conjectures", "Family", "Joint", "Quantity", "Ratio", "Slip", "load", "read"]


@dataclass(frozen=True, slots=True)
class Quantity:
    """What an entry is a value of: the range to search [unit] and the values in handbooks.

    `budget` bounds the intervals that a search may evaluate.
    """

    name: str
    unit: str
    search: tuple[Fraction, Fraction]
    reason: str
    entries: tuple[str, ...]
    handbook: Mapping[str, Printed]
    budget: int

    @property
    def si(self) -> Fraction:
        """The factor from the unit to SI."""
        return to_si(self.unit)


@dataclass(frozen=True, slots=True, eq=False)
class Slip:
    """One way to mistake an equation: what stands in some of its places instead.

    `places` holds an entry of the ledger or a number as text; `handbook` names an input that is to
    have each of its handbook values.
    """

    name: str
    reason: str
    places: Mapping[str, str]
    handbook: str | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Family:
    """Claims of one equation, its readings as they stand, and the slips to try on each."""

    name: str
    function: str
    claims: tuple[str, ...]
    readings: tuple[Slip, ...]
    slips: tuple[Slip, ...]


@dataclass(frozen=True, slots=True)
class Ratio:
    """A quotient of two claims: its function, the input that differs, the search of the other."""

    function: str
    differs: str
    common: tuple[Fraction, Fraction]


@dataclass(frozen=True, slots=True, eq=False)
class Joint:
    """A question to several claims at once: can one set of inputs give them all?

    `replace` puts an entry in the place of another, `kept` entries stay as printed; `because` is
    the sentence that a physicist can check by hand if they cannot.
    """

    id: str
    question: str
    claims: tuple[str, ...]
    replace: Mapping[str, str]
    kept: frozenset[str]
    because: str
    ratio: Ratio | None


@dataclass(frozen=True, slots=True, eq=False)
class Conjectures:
    """All of the file."""

    quantities: tuple[Quantity, ...]
    families: tuple[Family, ...]
    joint: tuple[Joint, ...]

    def quantity(self, entry: str) -> Quantity:
        """The quantity that an entry is a value of.

        Raises LedgerError where the file has none.
        """
        for quantity in self.quantities:
            if entry in quantity.entries:
                return quantity
        raise LedgerError(f"conjectures: no quantity has {entry!r} among its entries")


@cache
def load() -> Conjectures:
    """The conjectures on the report's numbers.

    >>> load().quantity("fz-k1").name
    'fitting parameter k_1'
    """
    text = (resources.files("reference.report") / "conjectures.toml").read_text("utf-8")
    return read(tomllib.loads(text), load_ledger())


def read(document: Mapping[str, Any], ledger: Ledger) -> Conjectures:
    """Build and check the conjectures from their parsed TOML; raises LedgerError."""
    return Conjectures(
        tuple(_quantity(entry, ledger) for entry in document["quantity"]),
        tuple(_family(entry, ledger) for entry in document["family"]),
        tuple(_joint(entry, ledger) for entry in document.get("joint", [])),
    )


def _quantity(entry: Mapping[str, Any], ledger: Ledger) -> Quantity:
    low, high = (Fraction(end) for end in entry["search"])
    handbook = {item["name"]: parse(item["value"]) for item in entry.get("handbook", [])}
    for name in entry["entries"]:
        unit, value = _entry(name, ledger, entry["name"])
        if not same_dimension(unit, entry["unit"]):
            raise LedgerError(f"quantity {entry['name']!r}: {name} is in {unit}")
        if not low < value * to_si(unit) / to_si(entry["unit"]) < high:
            raise LedgerError(f"quantity {entry['name']!r}: {name} lies outside the search")
        _, _, inferred = name.partition("inferred:")
        if inferred:
            handbook |= ledger.inferred[inferred].handbook
    return Quantity(
        entry["name"], entry["unit"], (low, high), entry["reason"], tuple(entry["entries"]),
        handbook, entry.get("budget", 1000),
    )  # fmt: skip


def _entry(name: str, ledger: Ledger, where: str) -> tuple[str, Fraction]:
    """An entry's unit and its value in that unit."""
    _, _, inferred = name.partition("inferred:")
    if inferred in ledger.inferred:
        return ledger.inferred[inferred].unit, ledger.inferred[inferred].nominal
    if name not in ledger.claims or (printed := ledger.claims[name].printed) is None:
        raise LedgerError(f"{where!r}: the ledger has no number {name!r}")
    return ledger.claims[name].unit, printed.value


def _family(entry: Mapping[str, Any], ledger: Ledger) -> Family:
    if entry["function"] not in SLIPS:
        raise LedgerError(f"family {entry['name']!r}: there is no function {entry['function']!r}")
    readings, slips = (
        tuple(_slip(slip, entry, ledger) for slip in entry[key]) for key in ("readings", "slip")
    )
    for name in entry["claims"]:
        _entry(name, ledger, entry["name"])
    return Family(entry["name"], entry["function"], tuple(entry["claims"]), readings, slips)


def _slip(entry: Mapping[str, Any], family: Mapping[str, Any], ledger: Ledger) -> Slip:
    places, handbook = entry.get("set", {}), entry.get("handbook")
    known = set(signature(SLIPS[family["function"]]).parameters)
    for place in (*places, *([handbook] if handbook else [])):
        if place not in known:
            raise LedgerError(f"slip {entry['name']!r}: {family['name']} has no place {place!r}")
    for source in places.values():
        if not source[0].isdigit():
            _entry(source, ledger, entry["name"])
    return Slip(entry["name"], entry.get("reason", ""), places, handbook)


def _joint(entry: Mapping[str, Any], ledger: Ledger) -> Joint:
    replace, kept = entry.get("replace", {}), entry.get("kept", [])
    for name in entry["claims"]:
        if name not in ledger.claims or ledger.claims[name].computation is None:
            raise LedgerError(f"{entry['id']!r}: no claim {name!r} is computed")
    for name in (*replace, *replace.values(), *kept):
        _entry(name, ledger, entry["id"])
    return Joint(
        entry["id"], entry["question"], tuple(entry["claims"]), replace, frozenset(kept),
        entry.get("because", ""), _ratio(entry, ledger),
    )  # fmt: skip


def _ratio(entry: Mapping[str, Any], ledger: Ledger) -> Ratio | None:
    if "ratio" not in entry:
        return None
    function, differs = entry["ratio"]["function"], entry["ratio"]["differs"]
    if function not in RATIOS:
        raise LedgerError(f"{entry['id']!r}: there is no ratio {function!r}")
    if any(differs not in ledger.claims[name].inputs for name in entry["claims"]):
        raise LedgerError(f"{entry['id']!r}: not every claim has an input {differs!r}")
    low, high = (Fraction(end) for end in entry["ratio"]["common"])
    return Ratio(function, differs, (low, high))

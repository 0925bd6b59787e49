"""What is asserted of the report besides its claims: findings, each with numbers as evidence.

A finding is a text of `report/findings.toml`. Every number in it is a piece of evidence, asserted
as text and computed anew by the audit: if one no longer agrees, the finding says so.
"""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from importlib import resources
from typing import Any

from reference.ledger import Ledger, LedgerError
from reference.ledger import load as load_ledger
from reference.printed import parse
from reference.units import UnitError, to_si

__all__ = ["KINDS", "STATUSES", "Assertion", "FindingText", "load", "read"]

KINDS = (
    "misprint",
    "formula",
    "units",
    "rounding",
    "inconsistent pair",
    "unstated input",
    "method",
    "wording",
)

STATUSES = {
    "explained": "the arithmetic shows the cause",
    "open": "it is shown that the numbers fail or what the report leaves out, not why",
    "no fault": "examined; the report's words hold",
}

_RELATIONS = ("=", ">=", "<=", ">", "<")


@dataclass(frozen=True, slots=True)
class Assertion:
    """One piece of evidence: what its number is and how the computed one must stand to the text.

    `relation` is one of = >= <= > <, or "" where the computed number must print like the text.
    Where the text is "yes" or "no", a proof must have had that outcome.
    """

    name: str
    means: str
    text: str
    relation: str
    unit: str

    @property
    def says(self) -> str:
        """The assertion as a reader sees it, without its unit."""
        return f"{self.relation} {self.text}".strip()

    def holds(self, computed: Fraction | float | bool) -> bool:
        """Whether the computed number (in `unit`) or outcome is as asserted.

        >>> ratio = Assertion("ratio", "least ratio", "1.147", ">=", "1")
        >>> ratio.holds(1.1476), ratio.holds(1.1469)
        (True, False)
        >>> Assertion("depth", "depth", "7.66", "", "um").holds(7.6603)
        True
        """
        if self.text in ("yes", "no"):
            return computed is (self.text == "yes")
        printed = parse(self.text)
        value = Fraction(computed)
        match self.relation:
            case "=":
                return value == printed.value
            case ">=":
                return value >= printed.value
            case "<=":
                return value <= printed.value
            case ">":
                return value > printed.value
            case "<":
                return value < printed.value
        return printed.interval().contains(value)


@dataclass(frozen=True, slots=True)
class FindingText:
    """One finding as asserted; its texts name evidence as {name}.

    `by_hand`: how to check it with a pocket calculator, if it can be; `settle`: what would settle
    what it leaves open.
    """

    id: str
    title: str
    kind: str
    status: str
    claims: tuple[str, ...]
    statement: str
    by_hand: str
    settle: str
    evidence: Mapping[str, Assertion]

    def filled(self, text: str) -> str:
        """One of its texts with the asserted numbers in it."""
        return text.format(**{name: a.text for name, a in self.evidence.items()})


@cache
def load() -> Mapping[str, FindingText]:
    """The findings by id, the weightiest first.

    >>> list(load())[0]
    'frank-zook-pair'
    """
    source = resources.files("reference.report") / "findings.toml"
    return read(tomllib.loads(source.read_text("utf-8")), load_ledger())


def read(document: Mapping[str, Any], ledger: Ledger) -> Mapping[str, FindingText]:
    """Build and check the findings from parsed TOML; LedgerError names what is wrong."""
    found: dict[str, FindingText] = {}
    for entry in document.get("finding", []):
        finding = _finding(entry, ledger)
        if finding.id in found:
            raise LedgerError(f"finding {finding.id!r} stands there twice")
        found[finding.id] = finding
    if not found:
        raise LedgerError("there are no findings: the file has no [[finding]]")
    return found


_TEXTS = ("id", "title", "kind", "status", "statement", "settle")


def _finding(entry: Mapping[str, Any], ledger: Ledger) -> FindingText:
    name = entry.get("id", "?")

    def wrong(message: str) -> LedgerError:
        return LedgerError(f"finding {name!r}: {message}")

    if missing := {*_TEXTS, "claims", "evidence"} - set(entry):
        raise wrong(f"lacks {', '.join(sorted(missing))}")
    if unknown := set(entry) - {*_TEXTS, "by_hand", "claims", "evidence"}:
        raise wrong(f"there is no key {min(unknown)!r}")
    if entry["kind"] not in KINDS:
        raise wrong(f"kind {entry['kind']!r} is none of {', '.join(KINDS)}")
    if entry["status"] not in STATUSES:
        raise wrong(f"status {entry['status']!r} is none of {', '.join(STATUSES)}")
    if strangers := [claim for claim in entry["claims"] if claim not in ledger.claims]:
        raise wrong(f"there is no claim {strangers[0]!r}")
    finding = FindingText(
        **{key: " ".join(entry[key].split()) for key in _TEXTS},
        claims=tuple(entry["claims"]),
        by_hand=" ".join(entry.get("by_hand", "").split()),
        evidence={key: _assertion(key, given, wrong) for key, given in entry["evidence"].items()},
    )
    prose = f"{finding.title} {finding.statement} {finding.by_hand} {finding.settle}"
    if strangers := sorted(set(re.findall(r"\{(\w+)\}", prose)) - set(finding.evidence)):
        raise wrong(f"its texts name {{{strangers[0]}}}, which is no evidence")
    return finding


def _assertion(name: str, given: Mapping[str, str], wrong: Any) -> Assertion:
    if set(given) - {"unit"} != {"says", "means"}:
        raise wrong(f"evidence {name!r} wants says and means, and a unit unless it is a number")
    relation, _, text = given["says"].rpartition(" ")
    if relation and relation not in _RELATIONS:
        raise wrong(f"evidence {name!r}: {relation!r} is none of {', '.join(_RELATIONS)}")
    unit = given.get("unit", "1")
    try:
        to_si(unit)
        if text not in ("yes", "no"):
            parse(text)
    except (UnitError, ValueError) as error:
        raise wrong(f"evidence {name!r}: {error}") from error
    return Assertion(name, given["means"], text, relation, unit)

"""What is asserted of the report besides its claims: findings, each with numbers as evidence.

A finding is a text of `report/findings.toml`. Every number in it is a claim's printed text, a piece
of evidence that the audit computes anew, or a step of arithmetic that is calculated again: if one
no longer agrees, the finding says so.
"""

import operator
import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from importlib import resources
from typing import Any, Literal

import msgspec

from reference.arithmetic import Reals
from reference.equations import evaluate, read_expression
from reference.ledger import Ledger, LedgerError
from reference.ledger import load as load_ledger
from reference.printed import decimal_text, parse
from reference.units import to_si

_REALS = Reals(30)
_RELATIONS: Mapping[str, Callable[[Fraction, Fraction], bool]] = {
    "=": operator.eq, ">=": operator.ge, "<=": operator.le, ">": operator.gt, "<": operator.lt,
}  # fmt: skip


class Assertion(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One piece of evidence: what its number is and how the computed one must stand to the text.

    `says` is a printed number, which the computed one must print like, or a relation (= >= <= > <)
    before one. Where it is "yes" or "no", a proof must have had that outcome.
    """

    says: str
    means: str
    unit: str = "1"

    @property
    def relation(self) -> str:
        """One of = >= <= > <, or "" where the computed number must print like the text."""
        return self.says.rpartition(" ")[0]

    @property
    def text(self) -> str:
        """The number, or yes or no."""
        return self.says.rpartition(" ")[2]

    def holds(self, computed: Fraction | float | bool) -> bool:
        """Whether the computed number (in `unit`) or outcome is as asserted.

        >>> ratio = Assertion(says=">= 1.147", means="least ratio")
        >>> ratio.holds(1.1476), ratio.holds(1.1469)
        (True, False)
        >>> Assertion(says="7.66", means="depth", unit="um").holds(7.6603)
        True
        """
        if self.text in ("yes", "no"):
            return computed is (self.text == "yes")
        printed, value = parse(self.text), Fraction(computed)
        if self.relation:
            return _RELATIONS[self.relation](value, printed.value)
        return printed.interval().contains(value)


@dataclass(frozen=True, slots=True)
class Step:
    """One line of arithmetic in a text: what is calculated, and what it must print like."""

    text: str
    holds: bool


class Finding(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One finding as asserted, its texts with the printed and the asserted numbers in them.

    `by_hand`: how to check it with a pocket calculator; `settle`: what would settle what it leaves
    open; `steps`: the arithmetic in its texts, calculated again.
    """

    id: str
    title: str
    kind: Literal[
        "headline",
        "misprint",
        "formula",
        "rounding",
        "inconsistent pair",
        "unstated input",
        "method",
        "wording",
    ]
    status: Literal["explained", "open"]
    claims: tuple[str, ...]
    statement: str
    by_hand: str = ""
    settle: str = ""
    evidence: dict[str, Assertion]
    steps: tuple[Step, ...] = ()


Findings = Mapping[str, Finding]
"""By id, the weightiest first; the one called "headline" says in a sentence what came out."""


@cache
def load() -> Findings:
    """The findings on the report.

    >>> list(load())[:2]
    ['headline', 'frank-zook-pair']
    """
    source = resources.files("reference.report") / "findings.toml"
    return read(tomllib.loads(source.read_text("utf-8")), load_ledger())


def read(document: Mapping[str, Any], ledger: Ledger) -> Findings:
    """Build and check the findings from parsed TOML; LedgerError names what is wrong."""
    try:
        texts = msgspec.convert(document.get("finding", []), list[Finding])
    except msgspec.ValidationError as error:
        raise LedgerError(f"findings.toml: {error}") from error
    if not texts:
        raise LedgerError("there are no findings: the file has no [[finding]]")
    findings: dict[str, Finding] = {}
    for entry in texts:
        if entry.id in findings:
            raise LedgerError(f"finding {entry.id!r} stands there twice")
        try:
            findings[entry.id] = _finding(entry, ledger)
        except (ValueError, ArithmeticError) as error:
            raise LedgerError(f"finding {entry.id!r}: {error}") from error
    return findings


def _finding(entry: Finding, ledger: Ledger) -> Finding:
    for name in entry.claims:
        if name not in ledger.claims and name not in ledger.equations:
            raise ValueError(f"there is no claim {name!r}")
    for name, assertion in entry.evidence.items():
        to_si(assertion.unit)
        if assertion.relation not in ("", *_RELATIONS):
            raise ValueError(f"evidence {name!r}: {assertion.relation!r} is no relation")
        if assertion.text not in ("yes", "no"):
            parse(assertion.text)
    raw = (entry.title, entry.statement, entry.by_hand, entry.settle)
    filled = [_filled(" ".join(text.split()), entry.evidence, ledger) for text in raw]
    steps = tuple(_step(text) for part in filled for text in re.findall("`(.*?)`", part))
    title, statement, by_hand, settle = (text.replace("`", "") for text in filled)
    return msgspec.structs.replace(
        entry, title=title, statement=statement, by_hand=by_hand, settle=settle, steps=steps
    )


_PLACE = re.compile(r"\{([\w.-]+)(?::([^{}]+))?\}")


def _filled(text: str, evidence: Mapping[str, Assertion], ledger: Ledger) -> str:
    """The text with numbers in it: {evidence}, {claim}, {source}, {claim:unit} in another unit."""

    def number(match: re.Match[str]) -> str:
        name, unit = match.groups()
        if name in evidence:
            return evidence[name].text
        if name in ledger.claims:
            return (
                ledger.claims[name].shown
                if unit is None
                else decimal_text(ledger.value(name) / to_si(unit))
            )
        if name in ledger.sources:
            source = ledger.sources[name]
            return source.says if unit is None else decimal_text(source.value / to_si(unit))
        raise ValueError(f"its texts name {{{name}}}, which is no evidence, claim or source")

    return _PLACE.sub(number, text)


def _step(text: str) -> Step:
    """A line of arithmetic such as "2/3 * 3 = 2.0", calculated again.

    Raises ValueError for what is no such line.
    """
    left, _, right = text.rpartition("=")
    expression = re.sub(r"\bln\b", r"\\ln", left).replace("*", " ")
    value = evaluate(read_expression(expression.strip(), {}), _REALS, {})
    computed = Fraction(str(_REALS.context.nstr(value, 25)))
    return Step(text, parse(right.strip()).interval().contains(computed))

"""What is asserted of the report besides its claims: findings, each with numbers as evidence.

A finding is a text of `report/findings.toml`. Every number in it is a claim's printed text, a piece
of evidence that the audit computes anew, or a step of arithmetic that is calculated again: if one
no longer agrees, the finding says so.
"""

import operator
import re
import tomllib
from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import cache
from importlib import resources
from string import ascii_uppercase
from typing import Any, Literal

import msgspec

from reference.arithmetic import Reals
from reference.entries import Entry, LedgerError, converted, naming
from reference.equations import Node, evaluate, read_expression
from reference.ledger import Ledger
from reference.ledger import load as load_ledger
from reference.printed import decimal_text, parse
from reference.units import to_si

_REALS = Reals(30)
_RELATIONS: Mapping[str, Callable[[Fraction, Fraction], bool]] = {
    "=": operator.eq, ">=": operator.ge, "<=": operator.le, ">": operator.gt, "<": operator.lt,
}  # fmt: skip


class Assertion(Entry, frozen=True):
    """One piece of evidence: what its number is and how the computed one must stand to the text.

    `says` is a printed number, which the computed one must print like, or a relation (= >= <= > <)
    before one. Where it is "yes" or "no", a proof must have had that outcome. It is computed by a
    `formula`, as the `exact` X/R with some inputs changed, or is how often the report has `words`.
    """

    says: str
    means: str
    unit: str = "1"
    formula: str = ""
    exact: Mapping[str, str] = {}
    words: str = ""

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
        """
        if self.text in ("yes", "no"):
            return computed is (self.text == "yes")
        printed, value = parse(self.text), Fraction(computed)
        if self.relation:
            return _RELATIONS[self.relation](value, printed.value)
        return printed.interval().contains(value)


class Finding(Entry, frozen=True, kw_only=True):
    """One finding as asserted, its texts with the printed and the asserted numbers in them.

    `by_hand`: how to check it with a pocket calculator; `settle`: what would settle what it leaves
    open; `steps`: the lines of arithmetic in its texts, and whether they hold.
    """

    id: str
    title: str
    kind: Literal[
        "headline", "misprint", "formula", "rounding", "inconsistent pair", "unstated input",
        "method", "wording",
    ]  # fmt: skip
    status: Literal["explained", "open"]
    claims: tuple[str, ...]
    statement: str
    by_hand: str = ""
    settle: str = ""
    evidence: dict[str, Assertion]
    steps: dict[str, bool] = msgspec.field(default_factory=dict)


@cache
def load() -> Mapping[str, Finding]:
    """The findings on the report, the weightiest first.

    The one called "headline" says in a sentence what came out.

    >>> list(load())[:2]
    ['headline', 'frank-zook-pair']
    """
    source = resources.files("reference.report") / "findings.toml"
    return read(tomllib.loads(source.read_text("utf-8")), load_ledger())


def read(document: Mapping[str, Any], ledger: Ledger) -> Mapping[str, Finding]:
    """Build and check the findings from parsed TOML; LedgerError names what is wrong."""
    findings: dict[str, Finding] = {}
    for entry in converted(document.get("finding", []), list[Finding], "findings.toml"):
        with naming(f"finding {entry.id!r}"):
            if entry.id in findings:
                raise ValueError("it stands there twice")
            findings[entry.id] = _finding(entry, ledger)
    if not findings:
        raise LedgerError("there are no findings: the file has no [[finding]]")
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
        for formula in filter(None, (assertion.formula, *assertion.exact.values())):
            expression(formula)

    texts, steps = dict[str, str](), dict[str, bool]()
    for key in ("title", "statement", "by_hand", "settle"):
        text = " ".join(getattr(entry, key).split())
        text = _PLACE.sub(lambda match: _number(match[1], match[2], entry, ledger), text)
        steps |= {line: _holds(line) for line in re.findall("`(.*?)`", text)}
        texts[key] = text.replace("`", "")
    return msgspec.structs.replace(entry, **texts, steps=steps)


_PLACE = re.compile(r"\{([\w.-]+)(?::([^{}]+))?\}")


def _number(name: str, unit: str | None, entry: Finding, ledger: Ledger) -> str:
    """What stands for {evidence}, {claim}, {source}, or {claim:unit} in another unit."""
    if name in entry.evidence:
        return entry.evidence[name].text
    if name in ledger.claims:
        claim = ledger.claims[name]
        return claim.shown if unit is None else decimal_text(claim.value / to_si(unit))
    if name in ledger.sources:
        source = ledger.sources[name]
        return source.says if unit is None else decimal_text(source.value / to_si(unit))
    raise ValueError(f"its texts name {{{name}}}, which is no evidence, claim or source")


def _holds(text: str) -> bool:
    """Whether a line of arithmetic such as "2/3 * 3 = 2.0" holds, calculated again."""
    left, _, right = text.rpartition("=")
    value = evaluate(expression(left)[0], _REALS, {})
    computed = Fraction(str(_REALS.context.nstr(value, 25)))
    return parse(right.strip()).interval().contains(computed)


@cache
def expression(text: str) -> tuple[Node, set[str]]:
    """A line of arithmetic, and the names of the values in it. Raises EquationError.

    >>> sorted(expression("2 * a1-radius/cth.diameter - ln(3)")[1])
    ['a1-radius', 'cth.diameter']
    """
    names: dict[str, str] = {}

    def written(match: re.Match[str]) -> str:  # by letters, the same ones in every line
        letter = ascii_uppercase[len(names)]
        return r"\ln" if match[0] == "ln" else names.setdefault(match[0], letter)

    line = re.sub(r"(?<![\w.-])[a-z][\w:.-]*", written, text).replace("*", " ").strip()
    symbols = {letter: name for name, letter in names.items()}
    return read_expression(line, dict.fromkeys(ascii_uppercase, "") | symbols), {*names} - {"pi"}

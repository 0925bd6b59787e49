"""The findings: what is asserted of the report besides its claims, each with its evidence.

The findings are texts in `report/findings.toml`, whose head explains the keys. Every number in a
text is a claim's printed number, a piece of evidence that the audit computes again, or a line of
arithmetic that is calculated again. If one of them no longer agrees, the finding says so.
"""

import operator
import re
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import Literal

import msgspec

from reference.arithmetic import Reals
from reference.equations import NAMED_FUNCTIONS, Node, evaluate, read_expression
from reference.formulas import Entry
from reference.ledger import load as load_ledger
from reference.ledger import tables
from reference.printed import Rounding, decimal_text, parse
from reference.units import to_si

_REALS = Reals(30)
_RELATIONS: Mapping[str, Callable[[Fraction, Fraction], bool]] = {
    "=": operator.eq, ">=": operator.ge, "<=": operator.le, ">": operator.gt, "<": operator.lt,
}  # fmt: skip


class Assertion(Entry, frozen=True):
    """A piece of evidence: what its number means, and which computed numbers agree with it."""

    says: str
    means: str
    unit: str = "1"
    formula: str = ""
    over: Mapping[Literal["exact", "usual", "rounded"], Sequence[str]] = {}
    exact: Mapping[str, str] = {}
    run: Mapping[str, str] = {}
    verdicts: Mapping[str, str] = {}
    under: Mapping[Literal["rounding", "choices_exact", "header_exact"], Rounding | bool] = {}
    words: str = ""

    @property
    def text(self) -> str:
        """The asserted number, or the asserted outcome: "yes" or "no"."""
        return self.says.rpartition(" ")[2]

    @property
    def is_outcome(self) -> bool:
        """Whether an outcome is asserted, not a number."""
        return self.text in ("yes", "no")

    def holds(self, computed: Fraction | float | bool) -> bool:
        """Return whether the computed number (in `unit`) or outcome is as asserted.

        >>> ratio = Assertion(says=">= 1.147", means="least ratio")
        >>> ratio.holds(1.1476), ratio.holds(1.1469)
        (True, False)
        """
        if self.is_outcome:
            return computed is (self.text == "yes")
        relation, _, text = self.says.rpartition(" ")
        printed, value = parse(text), Fraction(computed)
        if relation:
            return _RELATIONS[relation](value, printed.value)
        return printed.interval().contains(value)


class Finding(Entry, frozen=True, kw_only=True):
    """A finding; `filled` puts the numbers into its texts.

    `steps` maps each line of arithmetic in the texts to whether it holds.
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
    where: Mapping[str, str] = {}
    evidence: dict[str, Assertion]
    steps: dict[str, bool] = msgspec.field(default_factory=dict)


@cache
def load() -> Mapping[str, Finding]:
    """Return the findings on the report by id, the most important first.

    The one called "headline" is a summary in one sentence.

    >>> list(load())[:2]
    ['headline', 'frank-zook-pair']
    """
    entries = tables("findings.toml", dict[Literal["finding"], list[Finding]])["finding"]
    return {entry.id: filled(entry) for entry in entries}


def filled(entry: Finding) -> Finding:
    """Return a finding with numbers in place of {names}. Raises KeyError for an unknown name."""
    texts, steps = dict[str, str](), dict[str, bool]()
    for key in ("title", "statement", "by_hand", "settle"):
        text = " ".join(getattr(entry, key).split())
        text = re.sub(r"\{([\w.-]+)(?::([^{}]+))?\}", lambda m: _number(m[1], m[2], entry), text)
        steps |= {line: _holds(line) for line in re.findall("`(.*?)`", text)}
        texts[key] = text.replace("`", "")
    return msgspec.structs.replace(entry, **texts, steps=steps)


def _number(name: str, unit: str | None, entry: Finding) -> str:
    """Return the text for {evidence}, {claim} or {source}, or for {claim:unit} in that unit."""
    if name in entry.evidence:
        return entry.evidence[name].text
    claims, sources = load_ledger().claims, load_ledger().sources
    if unit is not None:
        return decimal_text((claims.get(name) or sources[name]).value / to_si(unit))
    return claims[name].shown if name in claims else sources[name].says


def _holds(text: str) -> bool:
    """Calculate a line of arithmetic such as "2/3 * 3 = 2.0" again; return whether it holds."""
    left, _, right = text.rpartition("=")
    value = evaluate(expression(left)[0], _REALS, {})
    # Five digits fewer than were computed, so that no rounding error keeps an exact result out.
    computed = Fraction(_REALS.context.nstr(value, 25))
    return parse(right.strip()).interval().contains(computed)


@cache
def expression(text: str) -> tuple[Node, set[str]]:
    """Read a line of arithmetic, and the names of the values in it. Raises EquationError.

    >>> sorted(expression("2 * a1-radius/cth.diameter - ln(3)")[1])
    ['a1-radius', 'cth.diameter']
    """
    calls = rf"(?<![\w.-])(?=(?:{'|'.join(NAMED_FUNCTIONS)})\()"
    line = re.sub(calls, r"\\", text).replace("*", " ").strip()
    names = sorted({*re.findall(r"(?<![\w.\\-])(?:\d+-)?[a-z][\w:.-]*", line)})
    return read_expression(line, dict(zip(names, names, strict=True))), {*names} - {"pi"}

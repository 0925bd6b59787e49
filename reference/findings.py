"""What is asserted of the report besides its claims: findings, each with numbers as evidence.

A finding is a text of `report/findings.toml`. Every number in it is a claim's printed text, a piece
of evidence that the audit computes anew, or a step of arithmetic that is calculated again: if one
no longer agrees, the finding says so. The head of the file says what each key means.
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
    """One piece of evidence: what its number is and how the computed one must stand to the text."""

    says: str
    means: str
    unit: str = "1"
    formula: str = ""
    over: Mapping[Literal["exact", "usual", "rounded"], Sequence[str]] = {}
    exact: Mapping[str, str] = {}
    run: Mapping[str, str] = {}
    verdicts: Mapping[str, str] = {}
    under: Mapping[
        Literal["rounding", "choices_exact", "header_exact", "centered"], Rounding | bool
    ] = {}
    words: str = ""

    @property
    def text(self) -> str:
        """The number, or yes or no."""
        return self.says.rpartition(" ")[2]

    @property
    def is_outcome(self) -> bool:
        """Whether it is no number, but yes or no."""
        return self.text in ("yes", "no")

    def holds(self, computed: Fraction | float | bool) -> bool:
        """Whether the computed number (in `unit`) or outcome is as asserted.

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
    """One finding as asserted, its texts with the printed and the asserted numbers in them.

    `steps` are the lines of arithmetic in its texts, and whether they hold.
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
    """The findings on the report, the weightiest first.

    The one called "headline" says in a sentence what came out.

    >>> list(load())[:2]
    ['headline', 'frank-zook-pair']
    """
    entries = tables("findings.toml", dict[Literal["finding"], list[Finding]])["finding"]
    return {entry.id: filled(entry) for entry in entries}


def filled(entry: Finding) -> Finding:
    """A finding of the file with the numbers in its texts. Raises KeyError for an unknown name."""
    texts, steps = dict[str, str](), dict[str, bool]()
    for key in ("title", "statement", "by_hand", "settle"):
        text = " ".join(getattr(entry, key).split())
        text = re.sub(r"\{([\w.-]+)(?::([^{}]+))?\}", lambda m: _number(m[1], m[2], entry), text)
        steps |= {line: _holds(line) for line in re.findall("`(.*?)`", text)}
        texts[key] = text.replace("`", "")
    return msgspec.structs.replace(entry, **texts, steps=steps)


def _number(name: str, unit: str | None, entry: Finding) -> str:
    """What stands for {evidence}, {claim}, {source}, or {claim:unit} in another unit."""
    if name in entry.evidence:
        return entry.evidence[name].text
    claims, sources = load_ledger().claims, load_ledger().sources
    if unit is not None:
        return decimal_text((claims.get(name) or sources[name]).value / to_si(unit))
    return claims[name].shown if name in claims else sources[name].says


def _holds(text: str) -> bool:
    """Whether a line of arithmetic such as "2/3 * 3 = 2.0" holds, calculated again."""
    left, _, right = text.rpartition("=")
    value = evaluate(expression(left)[0], _REALS, {})
    computed = Fraction(_REALS.context.nstr(value, 25))
    return parse(right.strip()).interval().contains(computed)


@cache
def expression(text: str) -> tuple[Node, set[str]]:
    """A line of arithmetic, and the names of the values in it. Raises EquationError.

    >>> sorted(expression("2 * a1-radius/cth.diameter - ln(3)")[1])
    ['a1-radius', 'cth.diameter']
    """
    calls = rf"(?<![\w.-])(?=(?:{'|'.join(NAMED_FUNCTIONS)})\()"
    line = re.sub(calls, r"\\", text).replace("*", " ").strip()
    names = sorted({*re.findall(r"(?<![\w.\\-])(?:\d+-)?[a-z][\w:.-]*", line)})
    return read_expression(line, dict(zip(names, names, strict=True))), {*names} - {"pi"}

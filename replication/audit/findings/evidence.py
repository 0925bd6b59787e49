"""The numbers in the texts of the findings: each is computed anew and compared with the text.

A number is written as its text prints it, and beside it stands how it is computed. The `Evidence`
that comes of it is put into the text, where it gives its number. So no number stands twice, and a
number that no longer comes out makes its finding say so.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from msgspec.structs import replace

from reference.printed import parse
from reference.units import to_si
from replication.audit.record import Evidence, Finding
from replication.audit.results import Results


@dataclass(frozen=True)
class FindingFunction:
    """A function that makes a finding, and the claims and equations that this finding concerns.

    They are known before it is called, so that a claim can name its findings without the others.
    """

    function: Callable[[Results], Finding]
    concerns: tuple[str, ...]

    def __call__(self, results: Results) -> Finding:
        return replace(self.function(results), claims=list(self.concerns))


def concerning(*names: str) -> Callable[[Callable[[Results], Finding]], FindingFunction]:
    """Mark a function that makes a finding with the claims and equations that it concerns."""
    return lambda function: FindingFunction(function, names)


Computed = Fraction | float
"""A computed number in SI units; a Fraction is exact."""


def prints(name: str, text: str, value: Computed, unit: str, means: str) -> Evidence:
    """Return a number that rounds to `text`. The computed `value` is in SI, the text in `unit`.

    >>> shock = prints("shock", "9.7", 9.68e9, "GPa", "pressure of a plane impact")
    >>> f"They press {shock} GPa on each other.", shock.holds
    ('They press 9.7 GPa on each other.', True)
    """
    computed = Fraction(value) / to_si(unit)
    holds = parse(text).interval().contains(computed)
    return Evidence(name, means, unit, text, float(computed), holds)


def equals(name: str, text: str, value: Computed, unit: str, means: str) -> Evidence:
    """Return a number that is exactly the `text`, such as a count."""
    computed = Fraction(value) / to_si(unit)
    holds = computed == parse(text).value
    return Evidence(name, means, unit, f"= {text}", float(computed), holds)


def at_least(name: str, text: str, value: Computed, unit: str, means: str) -> Evidence:
    """Return a number, such as a proven lower bound, that is not below the `text`."""
    computed = Fraction(value) / to_si(unit)
    holds = computed >= parse(text).value
    return Evidence(name, means, unit, f">= {text}", float(computed), holds)


def at_most(name: str, text: str, value: Computed, unit: str, means: str) -> Evidence:
    """Return a number, such as a proven upper bound, that is not above the `text`."""
    computed = Fraction(value) / to_si(unit)
    holds = computed <= parse(text).value
    return Evidence(name, means, unit, f"<= {text}", float(computed), holds)


def above(name: str, text: str, value: Computed, unit: str, means: str) -> Evidence:
    """Return a number that is greater than the `text`."""
    computed = Fraction(value) / to_si(unit)
    holds = computed > parse(text).value
    return Evidence(name, means, unit, f"> {text}", float(computed), holds)


def proves(name: str, outcome: bool, means: str) -> Evidence:
    """Return the outcome of a proof that the finding asserts."""
    return Evidence(name, means, "1", "yes", outcome, outcome)


def refutes(name: str, outcome: bool, means: str) -> Evidence:
    """Return the outcome of a test that must fail."""
    return Evidence(name, means, "1", "no", outcome, not outcome)


def calculated(text: str, value: Computed) -> Evidence:
    """Return the result of a line of arithmetic in a text, calculated again from its numbers.

    >>> f"4/6 = {calculated('0.667', Fraction(4, 6))}"
    '4/6 = 0.667'
    """
    return prints("", text, value, "1", "")


def conclude(
    name: str,
    kind: str,
    title: str,
    statement: str,
    *,
    status: str,
    evidence: Sequence[Evidence],
    by_hand: str = "",
    steps: Sequence[Evidence] = (),
    settle: str = "",
) -> Finding:
    """Return a finding, which holds if all of its numbers do.

    `by_hand` says how to check it with a pocket calculator, and `steps` are the results in that
    text. `settle` says what would decide what a finding leaves open.
    """
    return Finding(
        id=name,
        title=title,
        kind=kind,
        status=status,
        claims=[],
        statement=statement,
        by_hand=by_hand,
        settle=settle,
        holds=all(number.holds for number in (*evidence, *steps)),
        evidence=list(evidence),
    )

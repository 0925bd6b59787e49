"""Which of several repairs is the likeliest, by the rest of the report and by public sources.

The order of a list of repairs is all that this decides: the audit asserts none of them.
"""

import re
from math import inf, log10

from reference.ledger import Claim, Ledger
from reference.printed import parse
from replication.audit.record import Repair
from replication.audit.verdict import is_contradicted


def form(text: str) -> str:
    r"""Return how a number is written: 9 stands for a digit, 0 for a zero before the point.

    >>> form("2.070E-10"), form("~ 0.38"), form(r"\frac{12}{2}"), form("twice")
    ('9.999E-99', '~ 0.99', '\\frac{99}{9}', 'word')
    """
    if not re.search(r"\d", text):
        return "word"
    return re.sub(r"(?<![.\d])0(?=\.)|(\d)", lambda match: "9" if match[1] else "0", text)


def forms_beside(ledger: Ledger, name: str) -> set[str]:
    r"""Return the forms of the other numbers of a claim's unit that stand where it does.

    They stand in the cells of Table A-1, in equations, or in the text. An author prints such
    numbers alike. There are none for an equation.

    >>> from reference.ledger import load
    >>> sorted(forms_beside(load(), "a1-time-1")), sorted(forms_beside(load(), "eq6-factor"))[-1]
    (['9', '9.99E-99', '9E-99'], '\\frac{9}{9}')
    """
    if name not in ledger.claims:
        return set()
    own = ledger.claims[name]
    return {
        form(claim.text)
        for claim in ledger.claims.values()
        if claim is not own and claim.printed is not None and _beside(claim) == _beside(own)
    }


def _beside(claim: Claim) -> tuple[str, bool, bool]:
    return claim.unit, claim.cell is None, claim.within is None


def digits_without_zeros(text: str) -> int:
    """Return how many digits of a number are left without the zeros at both its ends; 1 of a zero.

    >>> texts = ("7500", "0.0580", "5.00E+02", "10^7", "~ 0.3", "0", "1/2")
    >>> [digits_without_zeros(text) for text in texts]
    [2, 2, 1, 1, 1, 1, 2]
    """
    mantissa = re.sub(r"[Ee][-+]?\d+|(?<=10)\^.*", "", text)
    return max(1, len("".join(re.findall(r"\d", mantissa)).strip("0")))


def distance(text: str, original: str) -> float:
    """Return how far two numbers are apart, in powers of ten; infinity unless both have one sign.

    >>> distance("10^8", "10^7"), distance("5", "0")
    (1.0, inf)
    """
    values = [parse(number).value for number in (text, original)]
    if values[0] * values[1] <= 0:
        return 0.0 if values[0] == values[1] else inf
    # rounded: equally far ones must tie on every machine
    return round(abs(log10(abs(values[0])) - log10(abs(values[1]))), 9)


def rank(
    ledger: Ledger, repair: Repair, forms: set[str], kinds: tuple[str, ...], failing: str
) -> tuple[object, ...]:
    """Return a key that sorts the repairs of what is `failing`, the likeliest first.

    The fewer entries are left that fail or that public sources contradict, the likelier is a
    repair. Among equals it is likelier if

    - the repaired number has one of the `forms` that numbers beside it have,
    - it makes a number that nothing computes rounder (a slip seldom does so); a computed one with
      fewer digits only has less to agree with,
    - it changes what is failing itself, or a constant in it, not what that rests on,
    - its kind of edit has few texts, and so seldom fits by accident: `kinds` has these first,
    - the number changes less.
    """
    left, unlike, digits, apart = len(repair.failing), False, 0, 0.0
    if repair.entry in ledger.claims:
        if ledger.sources_of(repair.entry):
            changed = ledger.misprint(repair.entry, repair.text)
            left += is_contradicted(changed, repair.entry) - is_contradicted(ledger, repair.entry)
        unlike = bool(forms) and form(repair.text) not in forms
        apart = distance(repair.text, repair.original)
        if ledger.claims[repair.entry].computation is None:
            digits = digits_without_zeros(repair.text) - digits_without_zeros(repair.original)
    return (
        repair.reading, left, unlike, digits,
        failing not in (repair.entry, ledger.equation_of(repair.entry)),
        kinds.index(repair.kind), apart, repair.entry, repair.text,
    )  # fmt: skip

"""The record's numbers and texts as a reader sees them, alike in HTML and in Markdown."""

import re
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN
from fractions import Fraction
from math import inf, nextafter
from typing import Any

from replication.text import number, rounded

__all__ = [
    "NOTHING_OPEN", "admitted", "answer", "capital", "digits_of", "evidence", "is_open", "off_by",
    "plain", "proven", "section", "share", "witness",
]  # fmt: skip

NOTHING_OPEN = "Nothing is open."
"""What a finding says of how to settle it where there is nothing to settle."""


def plain(text: str) -> str:
    r"""A printed text without the TeX in which it was read.

    >>> plain(r"9.13 \times 10^9"), plain(r"\frac{1}{2}")
    ('9.13 × 10^9', '1/2')
    """
    return re.sub(r"\\frac\{(\w+)\}\{(\w+)\}", r"\1/\2", text).replace(r"\times", "×")


def capital(text: str) -> str:
    """A text with a capital first letter."""
    return text[:1].upper() + text[1:]


def section(claim: dict[str, Any]) -> str:
    """Where a claim is listed: the section of the report, or the table by itself."""
    return "Table A-1" if claim["cell"] else capital(claim["section"])


def is_open(claim: dict[str, Any]) -> bool:
    """Whether a claim is decided by the report's words, but not plainly reproduced."""
    return claim["verdict"] not in ("reproduced", "not checkable")


def digits_of(text: str) -> int:
    """How many significant digits a number is printed with.

    >>> digits_of("0.0550"), digits_of(">= 2680"), digits_of("7.6E9")
    (3, 4, 2)
    """
    mantissa = re.split(r"[eE×\\]", text)[0]
    return len(re.sub(r"\D", "", mantissa).lstrip("0")) or 1


_ROUNDING = {">=": ROUND_FLOOR, ">": ROUND_FLOOR, "<=": ROUND_CEILING, "<": ROUND_CEILING}


def evidence(piece: dict[str, Any]) -> str:
    """What was computed for a finding, to two digits beyond the asserted ones.

    A bound is rounded to its safe side.

    >>> evidence({"asserted": ">= 1.147", "computed": 1.1475699})
    '1.14756'
    """
    asserted, computed = piece["asserted"], piece["computed"]
    if isinstance(computed, bool):
        return "yes" if computed else "no"
    rounding = _ROUNDING.get(asserted.partition(" ")[0], ROUND_HALF_EVEN)
    return rounded(Fraction(computed), digits_of(asserted) + 2, rounding)


def proven(ends: list[float]) -> str:
    """A proven range, widened to ten digits at each end.

    One that a double fills, or the gap between two neighbors, is shown as a number.

    >>> proven([0.12374472967338257, 0.13081477249718315])
    '0.1237447296 to 0.1308147725'
    >>> proven([0.057999999999999996, 0.058])
    '0.058'
    """
    low, high = ends
    if nextafter(low, inf) >= high:
        return number(high, 10)
    least = rounded(Fraction(low), 10, ROUND_FLOOR)
    return f"{least} to {rounded(Fraction(high), 10, ROUND_CEILING)}"


def admitted(ends: list[float]) -> str:
    """A range of values that are all admitted, narrowed to eight digits at each end.

    >>> admitted([7839.582920074463, 7863.304376602173])
    '7839.583 to 7863.3043'
    """
    least = rounded(Fraction(ends[0]), 8, ROUND_CEILING)
    return f"{least} to {rounded(Fraction(ends[1]), 8, ROUND_FLOOR)}"


def off_by(claim: dict[str, Any]) -> str:
    """How far a claim's number is off, where digits count: nothing is a digit off an exact 2.

    >>> off_by({"kind": "result", "error_in_last_digit": -150.7268})
    '-151 units of the last printed digit'
    """
    error = claim["error_in_last_digit"]
    if error is None or claim["kind"] == "constant":
        return ""
    return f"{number(error, 3)} units of the last printed digit"


def share(part: float) -> str:
    """A share of a whole.

    >>> share(0.0021214), share(4e-6)
    ('0.21 %', 'less than 0.01 %')
    """
    return f"{number(100 * part, 2)} %" if part >= 1e-4 else "less than 0.01 %"


def answer(joint: dict[str, Any]) -> str:
    """What is known of a joint question: why not, or inputs that give all the claims.

    >>> answer({"bound": "", "witness": {"a1-radius": 1.1e-05}, "outcome": "possible"})
    'Inputs that print like the report’s give them all, for instance (SI) a1-radius 1.1e-05.'
    """
    if joint["witness"] is None:
        return str(joint["bound"])
    inputs = witness(joint["witness"])
    if joint["bound"]:
        return f"{joint['bound']} They are (SI) {inputs}."
    inferred = any(name.startswith("inferred:") for name in joint["witness"])
    which = ", with an inferred one that the evidence allows," if inferred else ""
    return f"Inputs that print like the report’s{which} give them all, for instance (SI) {inputs}."


def witness(values: dict[str, float]) -> str:
    """Inputs by name.

    >>> witness({"inferred:target-density": 7777.4658203125})
    'target-density (inferred) 7777.46582'
    """
    return ", ".join(f"{_entry(name)} {number(value, 10)}" for name, value in values.items())


def _entry(name: str) -> str:
    _, _, inferred = name.partition("inferred:")
    return f"{inferred} (inferred)" if inferred else name

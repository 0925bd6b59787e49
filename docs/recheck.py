"""Check the verdicts of an audit without its program: a short program to read instead.

    python docs/recheck.py coldspray-audit/audit.json

Only Python's standard library is used. Every verdict that the exact fractions in the file decide is
found again from them:

- A printed decimal has the interval that half a unit of its last digit gives.
- A range proven for the computed value inside that interval is "reproduced", one apart from it
  "not reproduced", else neither; so also under each other convention, and for each other reading.
- A number that repeats another agrees with it if one value prints like both.
- A constant of an equation is right if it is the only value that passes the equation's checks.
- A chosen number is consistent if it lies where what is computed from it comes out as printed.
- Counts are the counts of the verdicts, and doubles the fractions they stand for.

What it takes on trust: that the proven ranges are those of the report's formulas, and whether any
inputs that print like the report's would do ("within input rounding" needs a search, not a range).
Each difference is a line; the status is 0 if there is none, 1 if there are some, 2 for no audit.
"""

import json
import re
import sys
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

Table = dict[str, Any]

Ends = tuple[Fraction | None, Fraction | None, bool, bool]
"""Lower and upper end (None: infinite), and whether each belongs to the interval."""

DECIMAL = re.compile(r"(\d+)\.(\d+)(?:E([+-]\d+))?")
ROUNDINGS = ("to nearest, ties away from zero", "to nearest, ties to even", "cut off")


def exact(ends: list[str | None]) -> list[Fraction | None]:
    """Fractions such as "1533/200"; null stays None."""
    return [None if end is None else Fraction(end) for end in ends]


def interval(claim: Table, rounding: str = ROUNDINGS[0]) -> Ends:
    """The values that print like a claim: what its own ends say, under a rounding rule."""
    low, high = exact(claim["interval_exact"])
    text = claim["interval_text"]
    closed = (text[0] != "(", text[-1] != ")")
    digits = _digits(claim)
    if rounding == ROUNDINGS[0] or low == high or digits is None:
        return (low, high, *closed)
    value, unit = decimal(digits)
    if rounding == ROUNDINGS[2]:
        return value, value + unit, True, False
    even = value / unit % 2 == 0
    return low, high, even, even


def _digits(claim: Table) -> re.Match[str] | None:
    """The digits of a printed decimal; of an "about" they do not give the interval."""
    return None if claim["kind"] == "approximation" else DECIMAL.fullmatch(claim["printed"])


def decimal(digits: re.Match[str]) -> tuple[Fraction, Fraction]:
    """The value of a printed decimal and the unit of its last digit."""
    unit = Fraction(10) ** (int(digits[3] or 0) - len(digits[2]))
    return int(digits[1] + digits[2]) * unit, unit


def below(low: Fraction | None, high: Fraction | None, closed: bool) -> bool:
    """Whether low < high, or low = high where the end belongs to the interval."""
    return low is None or high is None or low < high or (low == high and closed)


def decided(enclosure: list[Fraction | None], target: Ends) -> str:
    """What a proven range says of an interval: inside, apart or across an end."""
    (least, most), (low, high, low_closed, high_closed) = enclosure, target
    if not (below(low, most, low_closed) and below(least, high, high_closed)):
        return "not reproduced"
    if None in (least, most):
        return "neither"
    inside = below(low, least, low_closed) and below(most, high, high_closed)
    return "reproduced" if inside else "neither"


SEARCHED = ("reproduced within input rounding", "undecided")


def _judged(claim: Table, part: Table, rounding: str) -> Iterator[str]:
    """Whether a claim, a reading of it or a convention has the verdict of its proven range."""
    verdict, enclosure = part["verdict"], exact(part["enclosure_exact"])
    says = decided(enclosure, interval(claim, rounding))
    # Of inputs that print alike, some may do even where the range reaches beyond the interval.
    if says != verdict and not (says != "not reproduced" and verdict in SEARCHED):
        yield f"its range says {says!r}, not {verdict!r} ({rounding})"
    for double, end, side in zip(part["enclosure"], enclosure, (1, -1), strict=True):
        if end is not None and (end - Fraction(double)) * side < 0:
            yield f"{double!r} does not contain the end {end}"


def differences(audit: Table) -> Iterator[str]:
    """A line for each verdict or count that does not follow from the fractions beside it."""
    claims = {claim["id"]: claim for claim in audit["claims"]}
    constants = {part["claim"]: part for e in audit["equations"] for part in e["constants"]}
    for name, claim in claims.items():
        for problem in _of_claim(claim, claims, constants.get(name)):
            yield f"{name}: {problem}"
    counts = Counter(claim["verdict"] for claim in audit["claims"])
    for verdict, count in audit["summary"].items():
        if counts.pop(verdict, 0) != count:
            yield f"summary: {count} claims are said to be {verdict!r}"
    yield from (f"summary: {verdict!r} is missing" for verdict in counts)


def _of_claim(claim: Table, claims: dict[str, Table], constant: Table | None) -> Iterator[str]:
    verdict = claim["verdict"]
    if claim["interval_exact"] is None:
        if verdict != "remark, quantified":
            yield "has a verdict and no interval"
    elif claim["enclosure_exact"] is not None:
        yield from _print(claim)
        for part in (claim, *claim["readings"]):
            yield from _judged(claim, part, ROUNDINGS[0])
            for convention in part["otherwise"]:
                yield from _judged(claim, convention, convention["rounding"])
    else:
        yield from _print(claim)
        expected = _without_a_range(claim, claims, constant)
        if verdict not in expected:
            yield f"is {verdict!r}, not {' or '.join(expected)}"


def _print(claim: Table) -> Iterator[str]:
    """Whether the interval is half a unit of the last printed digit to both sides."""
    low, high, *_ = interval(claim)
    digits = _digits(claim)
    if digits is not None and low is not None and high is not None and low != high:
        value, unit = decimal(digits)
        # Just below a power of ten the digits of 1.00E+03 stand ten times closer.
        if high != value + unit / 2 or low not in (value - unit / 2, value - unit / 20):
            yield f"{claim['printed']} does not stand for {low} to {high}"


def _without_a_range(
    claim: Table, claims: dict[str, Table], constant: Table | None
) -> tuple[str, ...]:
    """The verdicts that a claim may have of which no range is proven."""
    low, high, _, closed = interval(claim)
    if claim["restates"]:
        twin = interval(claims[claim["restates"]])
        meet = below(low, twin[1], twin[3]) and below(twin[0], high, closed)
        return ("consistent" if meet else "inconsistent",)
    if constant is not None:
        if len(constant["needed"]) != 1:
            return ("not checkable", "undecided")
        return ("reproduced" if constant["needed"] == [str(low)] else "not reproduced",)
    if claim["sources"]:
        agrees = any(source["agrees"] for source in claim["sources"])
        return ("agrees with public sources" if agrees else "differs from public sources",)
    if claim["shown_by"]:
        least, most = map(Fraction, claim["shown_by"]["interval"])
        assert low is not None
        assert high is not None
        return ("consistent" if least <= (low + high) / 2 <= most else "inconsistent",)
    return ("consistent", "not checkable")  # a count, or nothing that decides it


def main() -> int:
    """Read the file that is named, and print the differences."""
    if len(sys.argv) != 2:
        print("usage: python recheck.py audit.json", file=sys.stderr)
        return 2
    try:
        audit = json.loads(Path(sys.argv[1]).read_text("utf-8"))
        lines = list(differences(audit))
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        print(f"{sys.argv[1]!r} is no audit that can be read: {error!r}", file=sys.stderr)
        return 2
    print(*lines, sep="\n", end="\n" if lines else "")
    print(f"{len(audit['claims'])} claims, {len(lines)} differences")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())

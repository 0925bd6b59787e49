"""Check the verdicts of an audit without the program that made it: a short program to read instead.

    python docs/recheck.py coldspray-audit/audit.json

It uses only Python's standard library. It derives every verdict that the exact fractions in the
file decide, also under the other conventions and for the other readings, and it counts the
verdicts. Two things it takes on trust: that the proven ranges are those of the report's formulas,
and whether some inputs that print like the report's would do ("within input rounding"), as that
needs a search and not only a range. It prints a line for each difference. The exit status is 0 if
there is none, 1 if there are some, and 2 if the file is not an audit.
"""

import json
import re
import sys
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction
from math import inf
from pathlib import Path
from typing import Any, NamedTuple

Table = dict[str, Any]
DECIMAL = re.compile(r"(\d+)\.(\d+)(?:E([+-]\d+))?")


class Interval(NamedTuple):
    """An interval: its two ends, and whether each end belongs to it."""

    low: Fraction | float
    high: Fraction | float
    low_closed: bool = True
    high_closed: bool = True

    def contains(self, value: Fraction | float) -> bool:
        """Return whether a value is in the interval."""
        above = self.low < value or (self.low == value and self.low_closed)
        return above and (value < self.high or (value == self.high and self.high_closed))

    def meets(self, another: "Interval") -> bool:
        """Return whether some value is in both intervals."""
        low, high = max(self.low, another.low), min(self.high, another.high)
        return low < high or (low == high and self.contains(low) and another.contains(low))


def between(ends: list[str | None]) -> Interval:
    """Read an interval from fractions such as "1533/200"; None is an infinite end."""
    low, high = ends
    return Interval(-inf if low is None else Fraction(low), inf if high is None else Fraction(high))


def printing(claim: Table, rounding: str = "to nearest, ties away from zero") -> Interval:
    """Return the values that print like a claim: from its digits, or else as stated in the file."""
    text, stated = claim["interval_text"], between(claim["interval_exact"])
    stated = stated._replace(low_closed=text[0] != "(", high_closed=text[-1] != ")")
    digits = DECIMAL.fullmatch(claim["printed"])
    by_digits = claim["kind"] not in ("approximation", "bound") and stated.low != stated.high
    if not (digits and by_digits):
        return stated
    unit = Fraction(10) ** (int(digits[3] or 0) - len(digits[2]))
    value = int(digits[1] + digits[2]) * unit
    if rounding == "cut off":
        return Interval(value, value + unit, True, False)
    # Below a power of ten, such as 1.00E+03, numbers of as many digits are ten times closer.
    low = stated.low if stated.low == value - unit / 20 else value - unit / 2
    is_even = value / unit % 2 == 0
    ties = (is_even, is_even) if rounding.endswith("even") else stated[2:]
    return Interval(low, value + unit / 2, *ties)


def judged(part: Table, target: Interval) -> Iterator[str]:
    """Yield what contradicts the proven range in a claim, a reading of it, or a convention."""
    proven, verdict = between(part["enclosure_exact"]), part["verdict"]
    inside = target.contains(proven.low) and target.contains(proven.high)
    follows = "reproduced" if inside else "neither" if target.meets(proven) else "not reproduced"
    # These two verdicts rest on a search, unless the range and the interval have nothing in common.
    by_search = verdict in ("reproduced within input rounding", "undecided")
    if follows != verdict and (follows == "not reproduced" or not by_search):
        yield f"its range says {follows!r}, not {verdict!r}"
    low, high = between(part["enclosure"])[:2]  # doubles
    if not low <= proven.low <= proven.high <= high:
        yield f"{low} to {high} does not contain {proven.low} to {proven.high}"
    if "computed" in part:
        value = Fraction(part["computed"])
        slack = abs(value) / 10**15  # the last digits of a double may be wrong
        if not proven.low - slack <= value <= proven.high + slack:
            ends = f"{float(proven.low)} to {float(proven.high)}"
            yield f"the computed {part['computed']} is not within {ends}"


def without_a_range(claim: Table, claims: dict[str, Table], constants: Table) -> tuple[str, ...]:
    """Return the verdicts that are possible for a claim without a proven range.

    `constants` has for each constant of an equation the values that pass its checks, and the kind
    of the equation.
    """
    own = printing(claim)
    if claim["restates"]:  # consistent if some value prints like both
        agrees = own.meets(printing(claims[claim["restates"]]))
        return ("consistent" if agrees else "inconsistent",)
    if claim["id"] in constants:  # reproduced if no other value passes the checks of its equation
        needed, kind = constants[claim["id"]]
        if len(needed) != 1:  # what defines a symbol needs no check
            return ("not checkable", "undecided", "consistent")
        if needed != [str(own.low)]:
            return ("not reproduced",)
        if kind in ("definition", "repeat"):
            return ("consistent",)
        # Of a law that is quoted, only the law itself may decide it, which derives nothing.
        return ("reproduced", "not checkable") if kind == "taken over" else ("reproduced",)
    if claim["sources"]:
        agrees = any(source["agrees"] for source in claim["sources"])
        return ("agrees with public sources" if agrees else "differs from public sources",)
    if claim["shown_by"]:  # a choice, consistent if numbers computed from it come out as printed
        agrees = between(claim["shown_by"]["interval"]).contains((own.low + own.high) / 2)
        return ("consistent" if agrees else "inconsistent",)
    if claim["compared"]:  # with what limits it, in words
        verdicts = ("consistent", "inconsistent")
        return (*verdicts, "agrees with public sources", "differs from public sources")
    return ("consistent", "not checkable")  # a count, a definition, or nothing decides it


def of_claim(claim: Table, claims: dict[str, Table], constants: Table) -> Iterator[str]:
    """Yield what is wrong with a claim."""
    if claim["interval_exact"] is None:
        if claim["verdict"] != "remark, quantified":
            yield "has a verdict and no interval"
        return
    low, high = between(claim["interval_exact"])[:2]
    if printing(claim)[:2] != (low, high):
        yield f"{claim['printed']} does not stand for {low} to {high}"
    if claim["enclosure_exact"] is None:
        expected = without_a_range(claim, claims, constants)
        if claim["verdict"] not in expected:
            yield f"is {claim['verdict']!r}, not {' or '.join(expected)}"
        return
    for part in (claim, *claim["readings"]):
        yield from judged(part, printing(claim))
        for convention in part["otherwise"]:
            for problem in judged(convention, printing(claim, convention["rounding"])):
                yield f"{problem} ({convention['rounding']})"


def differences(audit: Table) -> Iterator[str]:
    """Yield a line for each verdict or count that does not follow from the file's fractions."""
    claims = {claim["id"]: claim for claim in audit["claims"]}
    constants = {
        c["claim"]: (c["needed"], e["kind"]) for e in audit["equations"] for c in e["constants"]
    }
    for name, claim in claims.items():
        yield from (f"{name}: {problem}" for problem in of_claim(claim, claims, constants))
    counts = Counter(claim["verdict"] for claim in audit["claims"])
    for verdict in audit["summary"] | counts:
        stated = audit["summary"].get(verdict, 0)
        if stated != counts[verdict]:
            yield f"summary: {stated} claims are said to be {verdict!r}, {counts[verdict]} are"
    if audit["counts"]["reproduced"] != counts["reproduced"]:
        yield f"counts: {audit['counts']['reproduced']} are said to be reproduced"


def main() -> int:
    """Print the differences in the file named on the command line, and return the exit status."""
    if len(sys.argv) != 2:
        print("usage: python recheck.py audit.json", file=sys.stderr)
        return 2
    try:
        audit = json.loads(Path(sys.argv[1]).read_text("utf-8"))
        lines = list(differences(audit))
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        print(f"{sys.argv[1]!r} is not a readable audit: {error!r}", file=sys.stderr)
        return 2
    print(*lines, f"{len(audit['claims'])} claims, {len(lines)} differences", sep="\n")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())

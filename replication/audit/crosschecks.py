"""Numbers that no computation of the report gives, compared with others that limit them.

"Not checkable" means only that this text does not decide a number. Three of these numbers can be
compared all the same: with a range that the report states elsewhere, with the model's own time
scale, and with rules and sheets that public sources print. Each has a function of its id.
"""

from collections.abc import Callable, Collection
from fractions import Fraction
from math import cbrt, pi
from typing import NamedTuple

import msgspec

from reference.ledger import Ledger, claims_of_case
from reference.printed import parse
from reference.units import to_si
from replication.models.impact import Impact
from replication.models.motion import stop_time
from replication.text import number


class CrossCheck(msgspec.Struct, frozen=True):
    """Whether a number passes what it is compared with, and what that is.

    with_sources: it is compared with what public sources print, not with the report.
    """

    passes: bool
    says: str
    with_sources: bool = False


def outlier_volume(ledger: Ledger) -> CrossCheck:
    """Section 2: the outlier's volume, by its diameter among those of the other particles."""
    diameter = cbrt(6 * float(ledger.value("outlier-volume")) / pi)
    least, greatest = (ledger.claims[f"particle-size-{end}"] for end in ("least", "greatest"))
    inside = float(least.value) <= diameter <= float(greatest.value)
    says = (
        f"A sphere of that volume is {number(diameter * 1e6, 3)} µm wide; the particles of the "
        f"data fall between {least.shown} and {greatest.shown} µm."
    )
    return CrossCheck(inside, says)


def autodyne_time(ledger: Ledger) -> CrossCheck:
    """Section 4: the time from which Autodyne's depth is final, scaled to the size of the particle.

    Without rates, times scale with the diameter. The model's particle stops well before.
    """
    smaller = ledger.value("mean-diameter") / ledger.value("autodyne-diameter")
    scaled = float(ledger.value("autodyne-time") * smaller)
    entries = claims_of_case(5)
    impact = Impact(**{name: float(ledger.value(claim)) for name, claim in entries.items()})
    stop = stop_time(**impact.motion)
    says = (
        f"Scaled to a particle of {ledger.claims['mean-diameter'].shown} µm it is "
        f"{number(scaled * 1e9, 2)} ns, {number(scaled / stop, 2)} times the time in which the "
        "model's particle stops (beta = 5): by the model the depth is final by then."
    )
    return CrossCheck(scaled > stop, says)


def brinell_factors(ledger: Ledger) -> tuple[Fraction, list[Fraction]]:
    """Return hardness over tensile strength [1]: of a sheet of 304, and by two rules for steels."""
    per_kgf = to_si("gram_force/mm^2") * 1000
    sources = ledger.sources
    rules = [per_kgf / sources[name].value for name in ("hardness-rule-mpa", "hardness-rule-psi")]
    return sources["304-brinell"].value * per_kgf / sources["304-tensile"].value, rules


def brinell_ratio(ledger: Ledger) -> CrossCheck:
    """Section 3: hardness over tensile strength, by two rules for steels and by a sheet of 304."""
    of_304, rules = brinell_factors(ledger)
    three = parse("3").interval()
    passes = all(three.contains(Fraction(ratio)) for ratio in rules)
    says = (
        f"By the rules that public sources print for steels it is {number(min(rules), 3)} to "
        f"{number(max(rules), 3)}, which rounds to three. The hardness and the strength on a sheet "
        f"of 304 give {number(of_304, 3)}, which does not: the rule fits annealed 304 less well."
    )
    return CrossCheck(passes, says, with_sources=True)


class CrossCheckFunction(NamedTuple):
    """A function that compares a number, and the other claims of the report that it reads.

    With them the verdict on the number may change.
    """

    compare: Callable[[Ledger], CrossCheck]
    others: Collection[str]


CROSS_CHECKS: dict[str, CrossCheckFunction] = {
    "outlier-volume": CrossCheckFunction(
        outlier_volume, ("particle-size-least", "particle-size-greatest")
    ),
    "autodyne-time": CrossCheckFunction(
        autodyne_time, ("mean-diameter", "autodyne-diameter", *claims_of_case(5).values())
    ),
    "brinell-ratio": CrossCheckFunction(brinell_ratio, ()),
}
"""How each of these numbers is compared."""


def compared_with(claim: str) -> Collection[str]:
    """Return the other claims with which a claim is compared; none if it is not compared.

    >>> compared_with("outlier-volume"), compared_with("depth-beta-5")
    (('particle-size-least', 'particle-size-greatest'), ())
    """
    return CROSS_CHECKS[claim].others if claim in CROSS_CHECKS else ()

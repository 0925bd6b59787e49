"""Joint consistency: whether one set of inputs can give several claims at once."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from reference.conjectures import Joint, Ratio
from reference.enclosure import Box, Constraint, evaluate, explore, satisfying
from reference.ledger import Claim, Ledger
from reference.printed import Interval
from reference.slips import RATIOS
from replication.audit.entries import function_of, rounding, value
from replication.audit.inference import possible
from replication.text import number, outward

__all__ = ["JointAnswer", "consistency"]


@dataclass(frozen=True, slots=True)
class JointAnswer:
    """What is proven of a joint question; `witness` holds entries (SI) that give all the claims."""

    question: Joint
    outcome: str
    bound: str
    witness: Mapping[str, Fraction] | None


_OUTCOMES = {True: "possible", False: "impossible", None: "undecided"}


def consistency(ledger: Ledger, question: Joint) -> JointAnswer:
    """Can one set of inputs that print like the report's give all the claims?

    Of a quotient: can any inputs at all, over the whole search of the common one?
    """
    if question.ratio is not None:
        return _quotient(ledger, question, question.ratio)
    claims = [_replaced(ledger.claims[name], question.replace) for name in question.claims]
    box = _box(ledger, claims, question.kept)
    constraints = [_constraint(ledger, claim, frozenset(box)) for claim in claims]
    printed = {name: value(ledger, name) for name in box}
    at_printed, _ = satisfying(constraints, {name: (x, x) for name, x in printed.items()}, budget=1)
    if at_printed:
        return JointAnswer(question, "possible", "The inputs as printed give them.", printed)
    outcome, witness = satisfying(constraints, box)
    bound = _bound(question, claims, constraints, box) if outcome is False else ""
    return JointAnswer(question, _OUTCOMES[outcome], bound, witness)


def _replaced(claim: Claim, other: Mapping[str, str]) -> Claim:
    inputs = {
        key: tuple(other.get(name, name) for name in names) for key, names in claim.inputs.items()
    }
    return replace(claim, inputs=inputs)


def _box(ledger: Ledger, claims: list[Claim], kept: frozenset[str]) -> Box:
    """The rounding of every input that may be other than printed."""
    names = sorted({n for claim in claims for names in claim.inputs.values() for n in names} - kept)
    ends = {name: possible(ledger, name) for name in names}
    return {name: (low, high) for name, (low, high) in ends.items() if low != high}


def _constraint(ledger: Ledger, claim: Claim, free: frozenset[str]) -> Constraint:
    return function_of(ledger, claim, claim.functions[""], free), claim.target


def _bound(question: Joint, claims: list[Claim], constraints: list[Constraint], box: Box) -> str:
    """What can be checked by hand: the claims that fail by themselves, and the given sentence."""
    sentences = [question.because] if question.because else []
    for claim, (function, target) in zip(claims, constraints, strict=True):
        low, high = (end / claim.si for end in evaluate(function, box))
        if target.excludes(low * claim.si, high * claim.si):
            range_ = outward(low, high)
            sentences.append(f"Alone, {claim.text} ({claim.id}) would be in {range_}.")
    return " ".join(sentences)


def _quotient(ledger: Ledger, question: Joint, ratio: Ratio) -> JointAnswer:
    one, other = (ledger.claims[name] for name in question.claims)
    (low, high), (least, greatest) = one.target.ends, other.target.ends
    printed = Interval(least / high, greatest / low)
    strengths = {
        key: rounding(ledger, claim.inputs[ratio.differs][0], loose=True)
        for key, claim in (("one", one), ("other", other))
    }
    # Octave by octave, as both logarithms vanish with the common input.
    found = [
        explore(RATIOS[ratio.function], {"common": ends, **strengths}, printed)
        for ends in _octaves(*ratio.common)
    ]
    never, some = all(f.never for f in found), any(f.inside for f in found)
    outcome = "impossible" if never else "possible" if some else "undecided"
    lower = min(f.lower for f in found)
    bound = question.because.format(low=number(lower, 5), printed=number(greatest / low, 5))
    witness = next((f.inside for f in found if f.inside), None)
    return JointAnswer(question, outcome, bound if never else "", witness)


def _octaves(low: Fraction, high: Fraction) -> list[tuple[Fraction, Fraction]]:
    ends = [low]
    while ends[-1] * 2 < high:
        ends.append(ends[-1] * 2)
    ends.append(high)
    return list(pairwise(ends))

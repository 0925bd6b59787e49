"""Why a verdict is what it is, in sentences that a reader can check."""

from fractions import Fraction

from reference.ledger import Claim, Ledger
from reference.printed import Interval
from replication.audit.explanations.sentences import sentences as tried
from replication.audit.inference import Inference, infer
from replication.audit.verdict import Assessment, Reading, Verdict
from replication.text import inward, number, outward, with_unit

__all__ = ["assumptions", "explanation"]


def explanation(ledger: Ledger, assessment: Assessment) -> str:
    """The verdict's reason: what was computed, from what, and how it stands to the printed text."""
    claim, reading = assessment.claim, assessment.reading
    if claim.kind == "blank":
        leaves = "leaves" if assessment.verdict is Verdict.REPRODUCED else "does not leave"
        return f"Our copy of the table {leaves} this cell blank, too."
    if reading is None:
        return f"Not decided by the report: {claim.given}."
    sentences = [_value(claim, reading), *_reason(claim, reading)]
    sentences += [_other(claim, other) for other in assessment.others]
    if claim.id in _evidence(ledger):
        sentences.append("It is part of the evidence from which the target density is inferred.")
    if assessment.verdict is not Verdict.REPRODUCED:
        sentences += tried(ledger, claim.id)
    return " ".join(sentences)


def _value(claim: Claim, reading: Reading) -> str:
    what = _capital(reading.computation.summary)
    if reading.computation.name == "same_as":
        what += f" ({claim.inputs['value'][0]})"
    inside = reading.verdict is Verdict.REPRODUCED
    value = with_unit(number(reading.computed), claim.unit)
    assert claim.interval is not None
    if claim.interval.lower == claim.interval.upper:
        return f"{what}: {value}, {'as' if inside else 'not'} {claim.interval}."
    return f"{what}: {value}, {'in' if inside else 'not in'} {claim.interval}."


def _reason(claim: Claim, reading: Reading) -> list[str]:
    match reading.verdict:
        case Verdict.REPRODUCED:
            return _reproduced(claim, reading)
        case Verdict.WITHIN_ROUNDING:
            return _within(reading)
        case Verdict.NOT_REPRODUCED:
            return _not_reproduced(claim, reading)
        case _:
            return [f"The proven range {outward(*reading.enclosure)} is too wide to tell."]


def _reproduced(claim: Claim, reading: Reading) -> list[str]:
    if not _inferred(claim):
        return []
    return [f"So for every admitted target density: {outward(*reading.enclosure)}."]


def _within(reading: Reading) -> list[str]:
    assert reading.witness is not None
    inputs = ", ".join(f"{key} {number(value, 10)}" for key, value in reading.witness.items())
    return [f"Inputs that print like the report's give it, for instance (SI) {inputs}."]


def _not_reproduced(claim: Claim, reading: Reading) -> list[str]:
    low, high = reading.enclosure
    if low == high:
        return ["No rounded input enters, so none could change it."]
    assert claim.interval is not None
    inputs = "all inputs that print like the report's and every possible target density"
    if claim.as_printed_inputs:
        inputs = "every admitted target density, the other inputs exactly as printed"
    side = _side(claim.interval, reading.enclosure)
    proof = f"Proven for {inputs}: it lies in {outward(low, high)}, {side}."
    if reading.loose:
        proof += f" {_LOOSE}"
    return [proof]


_LOOSE = (
    "It could agree only if what the author chose, such as 500 m/s, were itself rounded to its "
    "first digits."
)


def _side(interval: Interval, enclosure: tuple[Fraction, Fraction]) -> str:
    low, high = enclosure
    if interval.lower is not None and high <= interval.lower:
        return "all below"
    if interval.upper is not None and low >= interval.upper:
        return "all above"
    return "on both sides"


def _other(claim: Claim, other: Reading) -> str:
    shown = with_unit(number(other.computed), claim.unit)
    sentences = [f"Read as {other.name}: {shown}, {other.verdict.value}."]
    if other.verdict is Verdict.WITHIN_ROUNDING:
        sentences += _within(other)
    elif other.verdict is not Verdict.REPRODUCED and other.enclosure[0] != other.enclosure[1]:
        within = outward(*other.enclosure)
        sentences.append(f"For all inputs that print like the report's it lies within {within}.")
    if other.loose:
        sentences.append(_LOOSE)
    return " ".join(sentences)


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _inferred(claim: Claim) -> list[str]:
    names = {name for names in claim.inputs.values() for name in names}
    return sorted(name.removeprefix("inferred:") for name in names if name.startswith("inferred:"))


def _evidence(ledger: Ledger) -> set[str]:
    return {claim for entry in ledger.inferred.values() for claim in entry.evidence}


def assumptions(ledger: Ledger, assessment: Assessment) -> list[str]:
    """What the verdict takes for granted beyond the printed text."""
    claim = assessment.claim
    assumed = [] if claim.assumes is None else [claim.assumes]
    assumed += [_density(infer(ledger, name)) for name in _inferred(claim)]
    if claim.as_printed_inputs:
        assumed.append("the inputs exactly as printed, as the same sheet is run twice")
        assumed.append("significant is what changes a printed digit; the report gives no criterion")
    return assumed + _digits(assessment)


def _density(inference: Inference) -> str:
    entry, inner = inference.entry, inference.inner
    nominal = with_unit(number(entry.nominal), entry.unit)
    admitted = inward(*inner.ends)
    return f"{entry.title} {nominal}, inferred: Table A-1 as printed admits {admitted}"


def _digits(assessment: Assessment) -> list[str]:
    """Which of an ambiguous number's digits were taken, and whether it matters."""
    claim, reading = assessment.claim, assessment.reading
    printed = claim.printed
    if reading is None or printed is None or len(printed.quanta) == 1 or claim.interval is None:
        return []
    if claim.interval.lower == claim.interval.upper or claim.interval.upper is None:
        return []
    if claim.interval.lower is None:
        return []
    taken = "the fewest digits" if claim.kind == "approximation" else "all digits"
    inside = [
        printed.interval(quantum=quantum).contains(Fraction(reading.computed))
        for quantum in printed.quanta
    ]
    depends = "depends" if len(set(inside)) > 1 else "does not depend"
    return [f"{taken} of {claim.text} taken as significant; the verdict {depends} on that"]

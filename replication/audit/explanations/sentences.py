"""What was tried for a claim, in a few sentences."""

from reference.ledger import Ledger
from reference.units import to_si
from replication.audit.explanations import Explanation, explain_claim
from replication.audit.explanations.alternatives import Alternative
from replication.audit.explanations.backsolve import BackSolved
from replication.audit.explanations.misprints import Misprint
from replication.text import inward, number, with_unit

__all__ = ["alternative_text", "back_solved_text", "misprint_text", "sentences"]


def sentences(ledger: Ledger, name: str) -> list[str]:
    """Two or three sentences: single inputs, misprints, other readings."""
    explanation = explain_claim(ledger, name)
    found = [_inputs(explanation), _misprints(explanation)]
    if explanation.alternatives is not None:
        found.append(explanation.alternatives.sentence)
    return [sentence for sentence in found if sentence]


def _inputs(explanation: Explanation) -> str:
    solved = [b for b in explanation.back_solved if b.value is not None]
    if not explanation.back_solved:
        return ""
    if not solved:
        return "No single input within its physical range would give it."
    rounded = ", ".join(b.title for b in solved if b.rounding)
    tail = f"; only {rounded} could be so by rounding" if rounded else ", none within its rounding"
    near = min(solved, key=lambda b: abs(b.change or 0))
    inputs = len({b.entry for b in explanation.back_solved})
    trials = len(explanation.back_solved)
    tried = f"{inputs} input{'s' * (inputs > 1)}, each changed alone"
    tried += f" under {trials // inputs} readings ({trials} trials)" * (trials > inputs)
    return (
        f"Of {tried}, {len(solved)} could give it, the least changed being {near.title} at "
        f"{_value(near)} ({100 * (near.change or 0):+.2g} %){tail}."
    )


def _value(solved: BackSolved) -> str:
    assert solved.value is not None
    return with_unit(number(solved.value / float(to_si(solved.unit)), 4), solved.unit)


def _misprints(explanation: Explanation) -> str:
    if not explanation.misprints:
        return "No text one edit away, of it or of an input, would make it agree."
    best = explanation.misprints[0]
    breaks = f", which would break {len(best.breaks)} other claims" if best.breaks else ""
    count = len(explanation.misprints)
    texts = "One text one edit away" if count == 1 else f"{count} texts one edit away"
    return (
        f"{texts} would make it agree; first "
        f"{best.edit.text} for {best.printed} ({best.what}){breaks}."
    )


def back_solved_text(solved: BackSolved) -> str:
    """One input: what it would have to be, and what else is known of such values."""
    low, high = (number(end / to_si(solved.unit)) for end in solved.solutions.search)
    known = [mark.name for mark in solved.marks]
    notes = [f"{_reading(solved.reading)}; of {low} to {high}: {solved.proof}"]
    notes += ["prints like the report's"] if solved.rounding else []
    notes += (
        [f"such as {', '.join(known[:_SHOWN])}" + ", ..." * (len(known) > _SHOWN)] if known else []
    )
    return f"{solved.title}: {_wanted(solved)} ({'; '.join(notes)})"


def _wanted(solved: BackSolved) -> str:
    """The proven intervals, made no wider, or where there is none proven a value that was found."""
    si = to_si(solved.unit)
    parts = [
        inward(part.lower / si, part.upper / si)
        for part in solved.solutions.inner
        if part.lower is not None and part.upper is not None
    ]
    if parts:
        return with_unit(" or ".join(parts), solved.unit)
    return "no value" if solved.value is None else f"{_value(solved)} among others"


_SHOWN = 3
"""So many known values are named in a line; the JSON has them all."""


def misprint_text(misprint: Misprint, unit: str) -> str:
    """One edited text, what it would give, and what it would break."""
    gives = with_unit(number(misprint.computed), unit)
    breaks = f"breaks {len(misprint.breaks)}, first {misprint.breaks[0]}" if misprint.breaks else ""
    return (
        f"{misprint.edit.text} for {misprint.printed} ({misprint.what}, {misprint.edit.kind}): "
        f"{gives}, {_reading(misprint.reading)}; {breaks or 'breaks no other claim'}"
    )


def alternative_text(alternative: Alternative, claim: str) -> str:
    """One other reading and what it makes of the claim."""
    value, verdict = alternative.computed[claim], alternative.verdicts[claim].value
    others = "" if alternative.explains_all else ", but not with the others"
    return f"{alternative.name}: {number(value, 4)}, {verdict}" + others * alternative.explains(
        claim
    )


def _reading(name: str) -> str:
    return name or "as printed"

"""The sentences of the record: why an entry has its verdict, and what the verdict assumes."""

from collections.abc import Collection, Sequence
from enum import StrEnum
from fractions import Fraction

from reference.ledger import Claim, Convention, Ledger
from reference.printed import Interval, Rounding
from reference.scheme import Scheme
from reference.units import to_si
from replication.audit.assessment import (
    Assessment,
    Comparison,
    ConfirmedRange,
    EquationAssessment,
    Ground,
    Judgement,
    Reading,
    Verdict,
)
from replication.audit.verdict import Judge
from replication.text import between, number, quantity


def explanation(judge: Judge, claim: Claim, assessed: Assessment) -> str:
    """Explain the verdict on a claim by the ground on which it was decided."""
    ledger = judge.ledger
    match assessed.ground:
        case Ground.WORDS:
            return remark(ledger, claim)
        case Ground.REPETITION:
            return repetition(ledger, claim, assessed.verdict)
        case Ground.COMPUTATION:
            return recomputation(judge, claim, assessed.readings)
        case Ground.NO_VALUE:
            return f"With the numbers as printed it cannot be computed: {assessed.no_value}."
        case Ground.EQUATION:
            return constant_explanation(judge, claim)
        case Ground.SOURCES:
            return sources(ledger, claim, judge.sources(claim.id))
        case Ground.OTHERS:
            return fitting(ledger, claim, judge.confirmed_range(claim))
        case Ground.COMPARISON:
            return assessed.compared
        case Ground.DEFINITION:
            return f"Nothing to compute: {claim.why}."
    return f"Nothing in the report decides it: {claim.why}."


def remark(ledger: Ledger, claim: Claim) -> str:
    """Say that a claim is a remark, and where its figures are."""
    if claim.same_as is None:
        return "A remark, not a number: the figures below help to judge it."
    same = ledger.claims[claim.same_as]
    return f'It says again "{same.shown}", where the figures are: `{same.id}`.'


def repetition(ledger: Ledger, claim: Claim, verdict: Verdict) -> str:
    """Explain the verdict on a claim that repeats another number of the report, or counts."""
    if "value" not in claim.inputs:
        return f"The report lists {len(claim.inputs)}."
    restated = ledger.claims[claim.inputs["value"][0]]
    but = "" if verdict is Verdict.CONSISTENT else ", which does not agree"
    shown = quantity(restated.shown, restated.unit)
    return f"It repeats or compares with {shown} ({restated.title}){but}."


def recomputation(judge: Judge, claim: Claim, readings: Sequence[Reading]) -> str:
    """Explain the verdict on a claim that is computed: the value by each reading, and the proof."""
    first, *others = readings
    what, interval = first.summary[:1].upper() + first.summary[1:], claim.interval()
    inside = "" if first.verdict is Verdict.REPRODUCED else "not "
    relation, shown = "as" if interval.is_point else "in", str(interval).replace("E", "e")
    value = quantity(number(first.computed), claim.unit)
    reason = _reason(judge, claim, first.judgements[0])
    sentences = [f"{what}: {value}, {inside}{relation} {shown}.", reason]
    for reading in others:
        value = quantity(number(reading.computed), claim.unit)
        proven, but = between(reading.judgements[0].ends, 6), _exceptions(claim, reading)
        verdict = f"{reading.verdict} ({but})" if but else f"{reading.verdict}"
        sentences.append(f"Read as {reading.name}: {value}, {verdict}; proven range {proven}.")
    return " ".join(filter(None, sentences))


def origin(claim: Claim) -> str:
    """Return a sentence on the origin of a number that nothing in the report computes."""
    why = "the author's choice" if claim.given == "choice" else claim.why or ""
    return f"{why[:1].upper()}{why[1:]}."


def fitting(ledger: Ledger, claim: Claim, confirmed: ConfirmedRange | None) -> str:
    """Explain the verdict on a number without a computation by what is computed from it."""
    if confirmed is None:
        return f"{origin(claim)} What is computed from it does not come out as printed."
    text = quantity(between(confirmed.interval, 4, inward=True), confirmed.unit)
    titles = "; ".join(map(ledger.title, confirmed.claims))
    come = "this comes" if len(confirmed.claims) == 1 else "these come"
    return f"{origin(claim)} For {text} {come} out as printed: {titles}."


def _reason(judge: Judge, claim: Claim, judgement: Judgement) -> str:
    """Return the proof behind a judgement as a sentence; empty where the value says it all."""
    ledger, proven = judge.ledger, between(judgement.ends, 6)
    match judgement.verdict:
        case Verdict.REPRODUCED:
            relevant = judge.relevant(claim)
            return f"For the target densities that Table A-1 admits: {proven}." if relevant else ""
        case Verdict.WITHIN_ROUNDING:
            inputs = []
            for name, si in (judgement.witness or {}).items():
                value = number(si / to_si(ledger.unit(name)), 8)
                inputs.append(f"{ledger.title(name)} {quantity(value, ledger.unit(name))}")
            return f"Inputs that print like the report's give it, for instance {', '.join(inputs)}."
        case Verdict.NOT_REPRODUCED if judgement.ends[0] == judgement.ends[1]:
            return "No rounded input enters, so none could change it."
        case Verdict.NOT_REPRODUCED if judgement.against_evidence:
            titles = " and ".join(map(ledger.title, claim.inferred))
            return (
                f"Proven for inputs that print like the report's: its range is {proven}, "
                "part of which rounds to the printed number, but no inputs that give this number "
                f"also give the numbers from which the {titles} is inferred."
            )
        case Verdict.NOT_REPRODUCED:
            return f"Proven for all inputs that print like the report's: {proven}, none inside."
    return f"The proven range {proven} is too wide to tell."


# Conventions


def scope(claim: Claim, reading: Reading) -> str:
    """Say under which conventions the verdict holds, and under which it becomes another one."""
    subject = "As printed, the" if claim.readings and not reading.name else "The"
    sentence = f"{subject} verdict holds under {_conditions_met(claim, reading)}"
    if exceptions := _exceptions(claim, reading):
        return f"{sentence}; {exceptions}."
    return f"{sentence}."


class ConventionDeparture(StrEnum):
    """A way in which a convention departs from the usual one, in words."""

    EVEN = "ties to even"
    CUT = "cut digits"
    CHOICES_ROUNDED = "rounded choices of the author"
    HEADER_EXACT = "an exact header of Table A-1"
    CENTERED = "the drag at the middle velocity"


def departures(convention: Convention) -> tuple[ConventionDeparture, ...]:
    """Return in what a convention departs from the usual one.

    >>> [str(departure) for departure in departures(Convention(Rounding.CUT, header_exact=True))]
    ['cut digits', 'an exact header of Table A-1']
    """
    departing = []
    if convention.rounding is Rounding.EVEN:
        departing.append(ConventionDeparture.EVEN)
    if convention.rounding is Rounding.CUT:
        departing.append(ConventionDeparture.CUT)
    if not convention.choices_exact:
        departing.append(ConventionDeparture.CHOICES_ROUNDED)
    if convention.header_exact:
        departing.append(ConventionDeparture.HEADER_EXACT)
    if convention.scheme is Scheme.CENTERED:
        departing.append(ConventionDeparture.CENTERED)
    return tuple(departing)


def _conditions_met(claim: Claim, reading: Reading) -> str:
    """Name the conventions under which the verdict holds; some may still fail together."""
    tried = [judgement.convention for judgement in reading.judgements]
    usual = [c for c in tried if (c.rounding, c.scheme) == (tried[0].rounding, tried[0].scheme)]
    failing = {ways[0] for unmet in _unmet(reading).values() for ways in unmet if len(ways) == 1}
    conditions = [_roundings_met(failing)]
    if len({convention.choices_exact for convention in usual}) > 1:
        conditions.append(_choices_met(failing))
    if len({convention.header_exact for convention in usual}) > 1:
        conditions.append(_headers_met(failing))
    if claim.by_scheme:
        conditions.append(_schemes_met(failing))
    *first, last = conditions
    return f"{', '.join(first)} and {last}" if first else last


def _roundings_met(failing: Collection[ConventionDeparture]) -> str:
    if ConventionDeparture.CUT in failing:
        return "both ways of rounding to nearest"
    return "three ways of rounding"


def _choices_met(failing: Collection[ConventionDeparture]) -> str:
    if ConventionDeparture.CHOICES_ROUNDED in failing:
        return "the author's choices exact"
    return "the author's choices exact or rounded"


def _headers_met(failing: Collection[ConventionDeparture]) -> str:
    if ConventionDeparture.HEADER_EXACT in failing:
        return "the header of Table A-1 rounded"
    return "the header of Table A-1 exact or rounded"


def _schemes_met(failing: Collection[ConventionDeparture]) -> str:
    if ConventionDeparture.CENTERED in failing:
        return "the drag at the initial velocity"
    return "both schemes"


def _unmet(reading: Reading) -> dict[Verdict, list[tuple[ConventionDeparture, ...]]]:
    """Return the other verdicts, each with the sets of departures that give it."""
    unmet: dict[Verdict, list[tuple[ConventionDeparture, ...]]] = {}
    for judgement in reading.otherwise:
        unmet.setdefault(judgement.verdict, []).append(departures(judgement.convention))
    # A set that includes a smaller one adds nothing.
    return {
        verdict: list(dict.fromkeys(w for w in sets if not any(set(v) < set(w) for v in sets)))
        for verdict, sets in unmet.items()
    }


def _exceptions(claim: Claim, reading: Reading) -> str:
    """Return the other verdicts and the conventions that give them; empty if there are none."""

    def in_words(departure: ConventionDeparture) -> str:
        if departure is ConventionDeparture.CUT and claim.inferred:
            # The evidence for its inferred inputs is rounded to nearest under every convention.
            return f"{departure} of this number alone"
        return departure

    parts = []
    for verdict, sets in _unmet(reading).items():
        under = ", or under ".join(" with ".join(map(in_words, ways)) for ways in sets)
        comma = "," if len(sets) > 1 else ""
        parts.append(f'under {under}{comma} it becomes "{verdict}"')
    return "; ".join(parts)


def assumptions(judge: Judge, claim: Claim, computed: float | None) -> list[str]:
    """Return what the verdict assumes beyond the printed text."""
    assumed = [] if claim.assumes is None else [claim.assumes]
    relevant = claim.inferred if computed is None else judge.relevant(claim)
    for name in relevant:
        inference = judge.inference(name)
        value = quantity(number(judge.value(name)), judge.ledger.unit(name))
        admitted = between(inference.inner.ends, 6, inward=True)
        table = "Table A-1 as printed but the sphere's mass"
        assumed.append(f"{judge.ledger.title(name)} {value}, inferred: {table} admits {admitted}")
        if claim.id in inference.agreeing:
            cells = f"the {len(inference.agreeing)} cells that it is inferred from"
            assumed.append(f"{cells} show by themselves only that one value gives them all")
    if claim.by_scheme and (relevant or not claim.inferred):
        assumed.append("the drag at the velocity with which a row begins")
    values = [source.interval for source in judge.ledger.sources_of(claim.id)]
    if computed is not None:
        values = [Interval.point(Fraction(computed) * claim.si)]
    return assumed + _digits_taken(claim, values)


def _digits_taken(claim: Claim, values: Sequence[Interval]) -> list[str]:
    """Say which digits of an ambiguous number are taken as significant, and whether it matters.

    The number is compared with the values (SI) that are computed or that public sources print.
    """
    printed = claim.printed
    unambiguous = claim.is_exact or claim.bound is not None
    if printed is None or unambiguous or not values or len(printed.quanta) == 1:
        return []
    taken = "the fewest digits" if claim.kind == "approximation" else "all digits"
    if claim.computation is None and claim.kind != "approximation":
        taken = "as many digits as agree with a source"  # a source contradicts it only if none do
    ranges = (printed.interval(quantum=quantum).scaled(claim.si) for quantum in printed.quanta)
    inside = {any(map(range_.meets, values)) for range_ in ranges}
    depends = "depends" if len(inside) > 1 else "does not depend"
    return [f"{taken} of {claim.shown} taken as significant; the verdict {depends} on that"]


def sources(ledger: Ledger, claim: Claim, comparisons: Sequence[Comparison]) -> str:
    """Explain the verdict on a number that is compared with public sources."""
    agreeing, others = (
        "; ".join(
            f"{quantity(c.source.says, c.source.unit)} ({c.source.title})"
            for c in comparisons
            if c.agrees is agrees
        )
        for agrees in (True, False)
    )
    if not agreeing:
        values = [source.value for source in ledger.sources_of(claim.id)]
        says = f"{origin(claim)} No public source at hand prints it: {others}."
        lies_between = min(values) < claim.value < max(values)
        return f"{says} It lies between them." if lies_between else says
    but = f", not with {others}" if others else ""
    return f"{origin(claim)} It agrees with {agreeing}{but}."


# Equations


def equation_explanation(ledger: Ledger, assessed: EquationAssessment) -> str:
    """Explain the verdict on an equation."""
    premises = assessed.equation.follows_from
    failed = [check.says for check in assessed.checks if not check.holds]
    if not failed:
        checked = "; ".join(check.says for check in assessed.checks)
        return f"From {premises}. Checked exactly: {checked}."
    text = f"From {premises}. This does not hold: {failed[0]}."
    if assessed.factor is not None:
        text += f" The printed side is {assessed.factor} times the derived one."
    for constant in assessed.constants.values():
        if constant.verdict == Verdict.NOT_REPRODUCED:
            needed = " or ".join(constant.needed)
            printed = ledger.claims[constant.claim]
            text += f" With {needed} instead of {printed.shown} ({printed.title}) it follows."
    return text


def constant_explanation(judge: Judge, claim: Claim) -> str:
    """Explain the verdict on a constant of an equation."""
    equation, constant = judge.ledger.equations[claim.within or ""], judge.constant(claim)
    assert constant is not None
    passes = f"the equation follows from {equation.follows_from}"
    if equation.kind == "taken over":
        passes = "the equation has the right dimensions, limits and signs"
    match constant.verdict:
        case Verdict.REPRODUCED | Verdict.CONSISTENT:
            return f"With this number, and no other that was tried, {passes}."
        case Verdict.NOT_REPRODUCED:
            needed = " or ".join(constant.needed)
            return f"With {needed} instead of {claim.shown} {passes}."
        case Verdict.UNDECIDED:
            return f"With no number that was tried in its place {passes}."
    reason = f": {claim.why}" if claim.why else ""
    return f"Dimensions, limits and signs do not decide it{reason}."

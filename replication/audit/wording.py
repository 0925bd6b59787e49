"""The sentences of the record: why a verdict is what it is, and what it takes for granted."""

from collections.abc import Sequence
from fractions import Fraction

from reference.ledger import Claim, Ledger
from reference.printed import Interval, Rounding
from reference.units import to_si
from replication.audit.record import ConstantRecord, Shown, SourceRecord, Verdict
from replication.audit.verdict import Assessment, EquationAssessment, Judge, Reading
from replication.text import between, number, quantity

REMARK = "A remark, no number: the figures below are what it can be judged by."


def explanation(judge: Judge, claim: Claim, assessed: Assessment) -> str:
    """Why a claim that a computation gives, or that repeats another, has its verdict."""
    if assessed.reason:
        return f"With the numbers as printed it cannot be computed: {assessed.reason}."
    if not assessed.readings:
        if "value" not in claim.inputs:
            return f"The report lists {len(claim.inputs)}."
        restated = judge.ledger.claims[claim.inputs["value"][0]]
        but = "" if assessed.verdict is Verdict.CONSISTENT else ", which does not agree"
        shown = quantity(restated.shown, restated.unit)
        return f"It repeats or compares with {shown} ({restated.title}){but}."
    first, *others = assessed.readings
    what, interval = first.summary[:1].upper() + first.summary[1:], claim.interval()
    inside = "" if first.verdict is Verdict.REPRODUCED else "not "
    relation, shown = "as" if interval.is_point else "in", str(interval).replace("E", "e")
    value = quantity(number(first.computed), claim.unit)
    sentences = [f"{what}: {value}, {inside}{relation} {shown}.", _reason(judge, claim, first)]
    for reading in others:
        value = quantity(number(reading.computed), claim.unit)
        proven, but = between(reading.judgements[0].ends, 6), _exceptions(claim, reading)
        verdict = f"{reading.verdict}{f' ({but})' * bool(but)}"
        sentences.append(f"Read as {reading.name}: {value}, {verdict}; proven range {proven}.")
    return " ".join(filter(None, sentences))


def origin(claim: Claim) -> str:
    """Where a number comes from that nothing in the report computes, as a sentence."""
    why = "the author's choice" if claim.given == "choice" else claim.why or ""
    return f"{why[:1].upper()}{why[1:]}."


def fitting(ledger: Ledger, claim: Claim, shown: Shown | None) -> str:
    """What is known of a number that nothing computes, by what is computed from it."""
    if shown is None:
        return f"{origin(claim)} What is computed from it does not come out as printed."
    text = quantity(between(shown.interval, 4, inward=True), shown.unit)
    titles = "; ".join(map(ledger.title, shown.claims))
    come = "this comes" if len(shown.claims) == 1 else "these come"
    return f"{origin(claim)} For {text} {come} out as printed: {titles}."


def _reason(judge: Judge, claim: Claim, reading: Reading) -> str:
    judgement, ledger = reading.judgements[0], judge.ledger
    proven = between(judgement.ends, 6)
    match judgement.verdict:
        case Verdict.REPRODUCED if judge.relevant(claim):
            return f"For the target densities that Table A-1 admits: {proven}."
        case Verdict.REPRODUCED:
            return ""
        case Verdict.WITHIN_ROUNDING:
            inputs = []
            for name, si in (judgement.witness or {}).items():
                value = number(si / to_si(ledger.unit(name)), 8)
                inputs.append(f"{ledger.title(name)} {quantity(value, ledger.unit(name))}")
            return f"Inputs that print like the report's give it, for instance {', '.join(inputs)}."
        case Verdict.NOT_REPRODUCED if judgement.ends[0] == judgement.ends[1]:
            return "No rounded input enters, so none could change it."
        case Verdict.NOT_REPRODUCED if judgement.against_evidence:
            titles = " and ".join(ledger.title(name) for name in claim.inferred)
            return (
                f"Proven for inputs that print like the report's: its range is {proven}, "
                "part of which rounds to the print, but no inputs that give this number also give "
                f"the numbers from which the {titles} is inferred."
            )
        case Verdict.NOT_REPRODUCED:
            return f"Proven for all inputs that print like the report's: {proven}, none inside."
    return f"The proven range {proven} is too wide to tell."


# Conventions


def holds(claim: Claim, reading: Reading) -> str:
    """Under which conventions the verdict holds, and which would change it."""
    tried = [judgement.convention for judgement in reading.judgements]
    usual = [c for c in tried if (c.rounding, c.centered) == (tried[0].rounding, tried[0].centered)]
    varied = [word for word in ("choices", "header")
              if len({getattr(c, f"{word}_exact") for c in usual}) > 1]  # fmt: skip
    scope = "three ways of rounding"
    scope += f", with {' and '.join(varied)} exact or rounded" if varied else ""
    scope += ", in both schemes" if claim.by_scheme else ""
    tried_under = f"{'As printed, tried' if claim.readings and not reading.name else 'Tried'} under"
    but = _exceptions(claim, reading)
    return f"{tried_under} {scope}: the same{f', except: {but}' * bool(but)}."


def _exceptions(claim: Claim, reading: Reading) -> str:
    """The verdicts that some conventions change it to, and which; empty if none does."""
    exceptions: dict[str, list[tuple[str, ...]]] = {}
    for judgement in reading.otherwise:
        convention = judgement.convention
        unusual = (words for key, value, words in _UNUSUAL if getattr(convention, key) == value)
        exceptions.setdefault(judgement.verdict, []).append(tuple(unusual))
    parts = []
    for verdict, conditions in exceptions.items():
        # A condition that contains another says nothing more.
        kept = dict.fromkeys(c for c in conditions if not any(set(o) < set(c) for o in conditions))
        parts.append(f"{verdict} if {', or if '.join(map(' and '.join, kept))}")
    # What its inferred inputs rest on is rounded under every convention.
    return ", and ".join(parts).format(cut_off="of this number alone " if claim.inferred else "")


_UNUSUAL = (
    ("rounding", Rounding.EVEN, "ties go to even"),
    ("rounding", Rounding.CUT, "digits {cut_off}are cut off"),
    ("choices_exact", False, "what the author chose is rounded, too"),
    ("header_exact", True, "the header of Table A-1 is exact"),
    ("centered", True, "the drag is taken at the middle velocity"),
)
"""What a convention does otherwise than the usual one."""


def assumptions(judge: Judge, claim: Claim, computed: float | None) -> list[str]:
    """What the verdict takes for granted beyond the printed text."""
    assumed = [] if claim.assumes is None else [claim.assumes]
    telling = claim.inferred if computed is None else judge.relevant(claim)
    for name in telling:
        inference = judge.inference(name)
        value = quantity(number(judge.value(name)), judge.ledger.unit(name))
        admitted = between(inference.inner.ends, 6, inward=True)
        table = "Table A-1 as printed but the sphere's mass"
        assumed.append(f"{judge.ledger.title(name)} {value}, inferred: {table} admits {admitted}")
        if claim.id in inference.agreeing:
            cells = f"the {len(inference.agreeing)} cells that it is inferred from"
            assumed.append(f"{cells} show by themselves only that one value gives them all")
    if claim.by_scheme and (telling or not claim.inferred):
        assumed.append("the drag at the velocity with which a row begins")
    values = [source.interval for source in judge.ledger.sources_of(claim.id)]
    if computed is not None:
        values = [Interval.point(Fraction(computed) * claim.si)]
    return assumed + _digits(claim, values)


def _digits(claim: Claim, values: Sequence[Interval]) -> list[str]:
    """Which of an ambiguous number's digits were taken, and whether it matters.

    The number is compared with the values (SI): what is computed, or what public sources print.
    """
    printed = claim.printed
    unambiguous = claim.is_exact or claim.bound is not None
    if printed is None or unambiguous or not values or len(printed.quanta) == 1:
        return []
    taken = "the fewest digits" if claim.kind == "approximation" else "all digits"
    ranges = (printed.interval(quantum=quantum).scaled(claim.si) for quantum in printed.quanta)
    inside = {any(map(range_.meets, values)) for range_ in ranges}
    depends = "depends" if len(inside) > 1 else "does not depend"
    return [f"{taken} of {claim.shown} taken as significant; the verdict {depends} on that"]


def sources(ledger: Ledger, claim: Claim, records: Sequence[SourceRecord]) -> str:
    """Where a number comes from, and how it stands to the public sources for it."""
    agreeing, others = (
        "; ".join(f"{quantity(s.says, s.unit)} ({s.title})" for s in records if s.agrees is agrees)
        for agrees in (True, False)
    )
    if not agreeing:
        values = [source.value for source in ledger.sources_of(claim.id)]
        between = " It lies between them." * (min(values) < claim.value < max(values))
        return f"{origin(claim)} No public source at hand prints it: {others}.{between}"
    but = f", not with {others}" if others else ""
    return f"{origin(claim)} It agrees with {agreeing}{but}."


# Equations


def equation_explanation(ledger: Ledger, assessed: EquationAssessment) -> str:
    """Why an equation has its verdict."""
    premises = assessed.equation.follows_from
    failed = [check.says for check in assessed.checks if not check.holds]
    if not failed:
        said = "; ".join(check.says for check in assessed.checks)
        return f"From {premises}. Checked exactly: {said}."
    text = f"From {premises}. This does not hold: {failed[0]}."
    if assessed.factor is not None:
        text += f" The printed side is {assessed.factor} times the derived one."
    for constant in assessed.constants.values():
        if constant.verdict == Verdict.NOT_REPRODUCED:
            needed = " or ".join(constant.needed)
            printed = ledger.claims[constant.claim]
            text += f" With {needed} instead of {printed.shown} ({printed.title}) it follows."
    return text


def constant_explanation(ledger: Ledger, claim: Claim, constant: ConstantRecord) -> str:
    """Why a constant of an equation has its verdict."""
    equation = ledger.equations[claim.within or ""]
    passes = f"the equation follows from {equation.follows_from}"
    if equation.kind == "taken over":
        passes = "the equation has the right dimensions, limits and signs"
    match constant.verdict:
        case Verdict.REPRODUCED:
            return f"With this number, and no other that was tried, {passes}."
        case Verdict.NOT_REPRODUCED:
            needed = " or ".join(constant.needed)
            return f"With {needed} instead of {claim.shown} {passes}."
        case Verdict.UNDECIDED:
            return f"With no number that was tried in its place {passes}."
    reason = f": {claim.why}" if claim.why else ""
    return f"Dimensions, limits and signs do not decide it{reason}."

"""Sentences about a record and its claims, shared by HTML page, Markdown and terminal.

They are plain text, with ids between backticks: `Prose` typesets them.
"""

from collections.abc import Mapping, Sequence
from decimal import ROUND_CEILING
from fractions import Fraction

from reference.ledger import Claim, Convention
from replication.audit import record as r
from replication.audit.assessment import Verdict
from replication.cases import INPUTS
from replication.power import Power
from replication.report.prose import Named, plain_quotation
from replication.text import between, number, quantity, rounded

ABOUT = (
    "The report, on cold spray, asks how deep a metal particle penetrates the surface that it "
    "strikes. It solves an equation of motion in an Excel sheet, and compares the depth with "
    "experiment, with two hydrocodes and with the model of Frank and Zook (Eq. 16). This audit "
    "recomputes every number for which the report gives the means."
)

CONVENTIONS = (
    "Each computed number is judged under several conventions, as far as they concern it: digits "
    "rounded to nearest with ties away from zero or to even, or cut off; what the author chose "
    "taken as exact or as rounded to its printed digits; the header of Table A-1 likewise; the "
    "drag of the sheet at the initial velocity of a row or at its middle velocity. For a number "
    "that is reproduced, the proven range is that of the inputs as printed, with an inferred input "
    "anywhere within its evidence. For any other number, it holds for all inputs that print like "
    "the report's."
)

USUAL_CONDITIONS = (
    "Unless it says otherwise, a verdict here holds under three ways of rounding and, where these "
    "concern it, under both schemes of the sheet, and with the author's choices and the header of "
    "Table A-1 exact or rounded."
)

ABOUT_REMARKS = (
    "What the report says of its results in words gets no verdict. The figures below help to judge "
    "it; of several the first tells most."
)

ABOUT_SENSITIVITY = (
    "All depths here are exact solutions of the report's equation of motion, without time steps. "
    "The derivatives are analytic: by how many percent the depth changes for one percent of the "
    "input."
)

ABOUT_SOURCES = "The report does not derive these numbers. This is what public sources print."

ALL_COME_OUT = "Every number that can be checked comes out as printed."

CAPTIONS: Mapping[str, str] = {
    "figure-3": "The curves of the report's Figure 3, recomputed.",
    "figure-5": "The curve of the report's Figure 5, recomputed, with the observed X/R.",
    "convergence": "How far the sheet's final depth is from the exact depth at rest. A part of it "
    "is due to the stop: the sheet ends with the first velocity below the stop velocity, wherever "
    "its steps put that.",
    "sensitivity": "Final depth for beta = 5 as each input goes through a range, the others as "
    "printed.",
}
"""What stands below a figure."""

TAKEN_EXACTLY = "taken exactly as the rest of the header"
"""The condition under which the printed mass excludes the density that is assumed."""

MEANINGS: Mapping[Verdict, str] = {
    Verdict.REPRODUCED: "the value computed from the inputs as printed rounds to the "
    "printed number, for every admitted value of an input that the "
    "report does not print",
    Verdict.WITHIN_ROUNDING: "that value does not, but some inputs that round to the printed "
    "ones give a value that does",
    Verdict.NOT_REPRODUCED: "no such inputs exist: shown by interval arithmetic or algebra, "
    "not by sampling",
    Verdict.UNDECIDED: "the proven range is too wide to tell",
    Verdict.CONSISTENT: "it repeats another number of the report, is a definition, or "
    "agrees with what follows from it or limits it",
    Verdict.INCONSISTENT: "it repeats another number and does not agree",
    Verdict.AGREES: "the report does not derive it; a named public source prints it",
    Verdict.DIFFERS: "the report does not derive it; by no reading of its digits do "
    "the named sources print it",
    Verdict.REMARK: "words of the report, with the figures to judge them by",
    Verdict.NOT_CHECKABLE: "this text does not decide it: it rests on an experiment, a "
    "choice or a code that the report does not give",
}
"""What each verdict says."""


# Numbers


def printed_with_unit(claim: Claim) -> str:
    """Return what the report prints, as it is shown: a number with its unit, or the words."""
    return quantity(claim.shown, claim.unit)


def measured(value: float | None, unit: str, digits: int = 6) -> str:
    """Return a computed number with its unit, or an empty text if there is none.

    >>> measured(7.669556888793411, "um"), measured(None, "um")
    ('7.66956 µm', '')
    """
    return "" if value is None else quantity(number(value, digits), unit)


_SCALES = {"radius": (1e6, "um"), "flow_stress": (1e-6, "MPa")}


def shown_range(effect: r.Effect) -> str:
    """Return the range of an effect's input in the customary unit of that input.

    >>> effect = r.Effect(input="radius", low=8.2e-6, high=1.38e-5, ratios=[], depths=[], why="")
    >>> shown_range(effect)
    '8.2 to 13.8 µm'
    """
    scale, unit = _SCALES.get(effect.input, (1.0, INPUTS[effect.input]))
    return quantity(between((effect.low * scale, effect.high * scale), 4), unit)


def condition(record: r.ClaimRecord) -> str:
    """Return under which conventions a verdict holds, unless `USUAL_CONDITIONS` says it."""
    first = record.as_printed
    said = record.verdict.needs_explanation or (first is not None and first.otherwise)
    return record.scope if said else ""


# What an id refers to


def equation_title(record: r.EquationRecord) -> str:
    """Return the title of an equation, after its number if it has one."""
    title = record.equation.title
    return f"Eq. {record.number}, {title}" if record.number else title


def names_of(record: r.Record) -> dict[str, Named]:
    """Return what each id of a record refers to."""
    equations = {
        e.id: Named(f"Eq. {e.number}" if e.number else e.equation.title, f"equation-{e.id}")
        for e in record.equations
    }
    inferred = {
        f"inferred:{i.id}": Named(
            i.entry.title, f"inferred-{i.id}", measured(i.assumed, i.entry.unit)
        )
        for i in record.inferred
    }
    claims = {
        c.id: Named(c.claim.title, f"claim-{c.id}", printed_with_unit(c.claim))
        for c in record.claims
    }
    return equations | inferred | claims


# Sentences


def counts_in_words(counts: r.Counts) -> str:
    """Say more of the numbers that come out than `counted_briefly`, and how many equations do."""
    tell_less = counts.reproduced - counts.independent
    equations = "does" if counts.equations_failing == 1 else "do"
    return (
        f"For one of these {counts.independent} to fail, any of several printed numbers, or the "
        f"equation that computes it, would have to be wrong. {tell_less} more of the report's "
        f"{counts.numbers} numbers come out, but tell less: from {counts.evidence} the target "
        "density was inferred, "
        f"{counts.by_definition} only scale, multiply or pick printed numbers, {counts.repeats} "
        f"repeat an earlier one, and {counts.constants} are factors and powers in its equations. "
        f"Of the {counts.equations} equations, {counts.equations_derived} follow from earlier ones "
        f"or from mechanics, and {counts.equations_failing} {equations} not; the others are "
        "definitions, repeats, or quoted from the literature."
    )


def counted_briefly(counts: r.Counts) -> str:
    """Say how many numbers could have failed and did not, and how many fail."""
    bounds = "a bound" if counts.bounds == 1 else "bounds"
    numbers = "does" if counts.failing == 1 else "do"
    return (
        f"{counts.independent} numbers, {counts.bounds} of them {bounds}, could have failed by "
        "themselves and come out as printed; "
        f"{counts.failing} {numbers} not follow from what the report says."
    )


def if_choices_are_rounded(record: r.Record) -> str:
    """Name the failing numbers that come out if what the author chose is rounded, too."""
    rounded = Convention(choices_exact=False)
    named = [
        f"{claim.claim.shown} as {reading.name}"
        for claim in record.claims
        if claim.verdict.needs_explanation
        for reading in claim.assessment.readings
        for judgement in reading.otherwise
        if judgement.convention == rounded and judgement.verdict is Verdict.WITHIN_ROUNDING
    ]
    if not named:
        return ""
    come_out = "this comes out" if len(named) == 1 else "these come out"
    return f"Only if what the author chose is rounded, too, {come_out}: {', '.join(named)}."


def density(record: r.Record) -> str:
    """Say what the target density rests on: inferred, and not with the printed mass."""
    usual, names = record.inferred[0], {claim.id: claim.claim for claim in record.claims}
    entry, mass = usual.entry, names[usual.entry.mass]
    greatest = rounded(Fraction(usual.with_printed_mass[1]), 6, ROUND_CEILING)
    taken = number(usual.assumed)
    sentence = (
        f"The report prints no {entry.title}. It is inferred from {len(entry.evidence)} cells of "
        f"Table A-1, with the sphere's mass in place of the printed {printed_with_unit(mass)}"
    )
    if usual.assumed > usual.with_printed_mass[1]:
        sentence += (
            f": with that, {TAKEN_EXACTLY}, no more than "
            f"{quantity(greatest, entry.unit)} is possible, so not the {taken} assumed"
        )
    return f"{sentence}."


def entries(counts: r.Counts) -> str:
    """Say how many entries the ledger has."""
    return (
        f"Together with {counts.remarks} remarks in words, these numbers make "
        f"{counts.entries} entries."
    )


def culprit(record: r.Record) -> str:
    """Say that one misprint would explain all failures; empty if none would."""
    if record.culprit is None:
        return ""
    return f"One misprint would explain {len(record.failing)} of the failures"


def approaches_in_words(record: r.Record) -> str:
    """Say what the approaches are that their names do not tell, and why some are only quoted."""
    claims = {claim.id: claim.claim for claim in record.claims}
    sentences = ["\"Constant pressure\" is the report's law without the target's inertia."]
    sentences += (
        f"X/R by {approach.name} is quoted: it {claims[approach.claim].why}."
        for approach in record.approaches
        if approach.computed is None and approach.claim and claims[approach.claim].why
    )
    return " ".join(sentences)


def scatter_in_words(record: r.Record) -> str:
    """Say what the report states of the scatter, and what the laws make of it."""
    claims = {claim.id: claim.claim for claim in record.claims}
    sizes, velocities = claims["diameter-deviation"], claims["velocity-deviation"]
    about = "about " if velocities.kind == "approximation" else ""
    return (
        f"The report states the {sizes.title}, {printed_with_unit(sizes)}, and the "
        f"{velocities.title}, {about}{printed_with_unit(velocities)}. By mass and by drag, a "
        'particle\'s velocity is computed from its size; the law "as stated" takes the scatter of '
        "the velocities. X/R is the exact one for beta = 5."
    )


def blank_cells(record: r.Record) -> str:
    """Say how many cells of Table A-1 are blank, and which."""
    cells = record.blank_cells
    return (
        f"{len(cells)} cells of the table are blank ({cells[0]} to {cells[-1]}); they are not "
        "counted as numbers."
    )


def swap(repair: r.Repair) -> str:
    """Return what a repair changes: the text instead of the original."""
    return f"{plain_quotation(repair.text)} for {plain_quotation(repair.original)}"


def inferred(records: Sequence[r.InferredRecord]) -> str:
    """Say what is known of an input that the report does not print, under every scheme."""
    entry, last = records[0].entry, records[-1]
    sentences = [
        f"The report prints the {entry.title} nowhere.",
        f"The audit computes with {measured(last.assumed, entry.unit)}: {entry.nominal_source}.",
    ]
    for record in records:
        exact = quantity(between(record.interval, 7, inward=True), entry.unit)
        sentence = (
            f"With the drag at the {record.scheme.drag_at} velocity, Table A-1 admits {exact} if "
            "its header is exact as printed, but with the sphere’s mass"
        )
        if record.possible_with_rounded_inputs is not None:
            possible = quantity(between(record.possible_with_rounded_inputs, 7), entry.unit)
            sentence += (
                "; if the numbers of the header are rounded, except for those that the author "
                f"chose, it admits none outside {possible}"
            )
        sentences.append(f"{sentence}.")
    if compared := [comparison for record in records for comparison in record.sources]:
        admitted = sum(comparison.agrees for comparison in compared)
        sentences.append(
            f"Of the {len(compared)} values that public sources print, Table A-1 admits {admitted} "
            "without a further condition."
        )
    return " ".join(sentences)


def repetition_in_words(record: r.ClaimRecord, names: Mapping[str, Named]) -> str:
    """Say with which number of the report one that repeats it, or was chosen, agrees."""
    if record.restated is None:
        return record.explanation
    value = names[record.restated].value
    differs = value != printed_with_unit(record.claim)
    return f"agrees with `{record.restated}`" + (f", {value}" if differs else "")


def power_in_words(rates: Power) -> str:
    """Say what the audit notices of planted misprints."""
    return (
        f"{rates.planted} misprints were planted, one at a time, in copies of the report, and each "
        f"copy was judged by this audit. {rates.invisible} of them leave all numbers that it "
        "relates in agreement, so they cannot be noticed. As a control, "
        f"{rates.controls} numbers and equations were written in another way that says the same; "
        f"no verdict may change. Of the {rates.visible} misprints that are visible and of the "
        "controls, with the 95 % interval of each rate (Wilson's), measured by "
        f"`coldspray power --sample {rates.planted} --seed {rates.seed}`:"
    )

"""Sentences about a record and its claims, shared by HTML page, Markdown and terminal.

They are plain text, with ids between backticks: `Prose` typesets them.
"""

from collections.abc import Mapping, Sequence

from reference.ledger import Claim
from replication.audit import record as r
from replication.audit.assessment import Verdict
from replication.cases import INPUTS
from replication.power import Power
from replication.report.prose import Named, quoted
from replication.text import between, number, quantity

ABOUT = (
    "The report, on cold spray, asks how deep a metal particle penetrates the surface that it "
    "strikes. It solves an equation of motion in an Excel sheet, and compares the depth with "
    "experiment, with two hydrocodes and with the model of Frank and Zook (Eq. 16). This audit "
    "recomputes every number for which the report gives the means."
)

MEANINGS: Mapping[Verdict, str] = {
    Verdict.REPRODUCED: "the value computed from the inputs as printed rounds to the printed one, "
    "for every admitted value of an input that the report does not print",
    Verdict.WITHIN_ROUNDING: "the inputs as printed do not give it; some inputs that round to the "
    "printed ones do",
    Verdict.NOT_REPRODUCED: "no inputs that print like the report's give it (proven)",
    Verdict.UNDECIDED: "neither of these could be proven",
    Verdict.CONSISTENT: "it repeats another number of the report, or is a choice that agrees with "
    "what is computed from it; nothing new is shown",
    Verdict.INCONSISTENT: "it repeats another number of the report, or is a choice, and does not "
    "agree",
    Verdict.AGREES: "the report does not derive it; a public source prints it",
    Verdict.DIFFERS: "the report does not derive it; the sources at hand print something else",
    Verdict.REMARK: "words, not a number, with figures to judge them by",
    Verdict.NOT_CHECKABLE: "it rests on data, a choice or a code that the report does not give",
}
"""What each verdict says."""


# Numbers


def with_unit(claim: Claim) -> str:
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
        c.id: Named(c.claim.title, f"claim-{c.id}", with_unit(c.claim)) for c in record.claims
    }
    return equations | inferred | claims


# Sentences


def counted(counts: r.Counts) -> str:
    """Say how many numbers and equations come out as printed."""
    numbers = "number does" if counts.failing == 1 else "numbers do"
    equations = "does" if counts.equations_failing == 1 else "do"
    return (
        f"{counts.reproduced} of the report’s {counts.numbers} numbers come out as printed: "
        f"{counts.constants} factors and powers in its equations, and {counts.computed} other "
        f"numbers, of {counts.values} different values. {counts.failing} {numbers} not follow from "
        f"what it says. Of the {counts.equations} equations, {counts.equations_derived} follow "
        f"from earlier ones or from mechanics, and {counts.equations_failing} {equations} not; the "
        "others are definitions or from the literature."
    )


def entries(counts: r.Counts) -> str:
    """Say how many entries the ledger has."""
    return (
        f"Together with {counts.remarks} comparisons in words, these numbers make "
        f"{counts.entries} entries."
    )


def culprit(record: r.Record) -> str:
    """Say that one misprint would explain all failures; empty if none would."""
    if record.culprit is None:
        return ""
    return f"One misprint would explain {len(record.failing)} of the failures"


def swap(repair: r.Repair) -> str:
    """Return what a repair changes: the text instead of the original."""
    return f"{quoted(repair.text)} for {quoted(repair.original)}"


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
    return " ".join(sentences)


def repetition(record: r.ClaimRecord, names: Mapping[str, Named]) -> str:
    """Say with which number of the report one that repeats it, or was chosen, agrees."""
    if record.restated is None:
        return record.explanation
    value = names[record.restated].value
    differs = value != with_unit(record.claim)
    return f"agrees with `{record.restated}`" + (f", {value}" if differs else "")


def power(rates: Power) -> str:
    """Say what the audit notices of planted misprints."""
    return (
        f"{rates.planted} misprints were planted, one at a time, in copies of the report, and each "
        f"copy was judged by this audit. It notices {rates.detected} of them. {rates.invisible} "
        "leave all numbers that it relates in agreement, so they cannot be noticed. Of the "
        f"{rates.visible} visible ones, the true text is among the repairs that it names in "
        f"{rates.repaired} cases, and is the first of them in {rates.repaired_first}; in "
        f"{rates.accused_wrongly} cases another entry is named first. Measured by "
        f"`coldspray power --sample {rates.planted} --seed {rates.seed}`."
    )

"""What is said of a claim: each fact once, for the page, Markdown and the terminal alike.

Texts are sentences for `Prose`: ids stand between backticks.
"""

from collections.abc import Mapping, Sequence
from decimal import ROUND_CEILING, ROUND_FLOOR
from fractions import Fraction
from math import isclose

from reference.ledger import shown
from replication.audit.record import ClaimRecord, Effect, Record
from replication.audit.verdict import Verdict
from replication.audit.wording import quantity
from replication.report.prose import Named
from replication.text import number, rounded

VERDICTS = {
    Verdict.REPRODUCED: "the value computed from the inputs as printed rounds to the printed one, "
    "for every admitted value of an input that the report does not print",
    Verdict.WITHIN_ROUNDING: "the inputs as printed do not give it, some that print alike do",
    Verdict.NOT_REPRODUCED: "proven: no inputs that print like the report's give it",
    Verdict.UNDECIDED: "neither could be proven",
    Verdict.CONSISTENT: "it repeats another number of the report, or is a choice that agrees with "
    "what is computed from it; nothing new is shown",
    Verdict.INCONSISTENT: "it repeats another number of the report, or is a choice, and does not "
    "agree",
    Verdict.AGREES: "the report derives it from nothing; a public source prints it",
    Verdict.DIFFERS: "the report derives it from nothing; public sources print something else",
    Verdict.REMARK: "words, no number, with the figures to judge them by",
    Verdict.NOT_CHECKABLE: "it rests on data, a choice or a code that the report does not give",
}
"""The verdicts, and what they say."""

OPEN = {
    Verdict.NOT_REPRODUCED,
    Verdict.INCONSISTENT,
    Verdict.UNDECIDED,
    Verdict.WITHIN_ROUNDING,
}
"""The verdicts of claims that do not plainly come out as printed."""


def printed(claim: ClaimRecord) -> str:
    """What the report prints, with its unit; the words of a remark as they are."""
    return quantity(shown(claim.printed), claim.unit)


def between(ends: Sequence[float | None], digits: int = 10, inward: bool = False) -> str:
    """An interval as words, its ends shortened outward, or inward where all inside is meant.

    An end that is short but for the rounding of a double is taken as it is.

    >>> between((0.12374472967338257, 0.13081477249718315))
    '0.1237447296 to 0.1308147725'
    >>> between((7839.582511570033, 7863.3048443432035), 8, inward=True)
    '7839.5826 to 7863.3048'
    >>> between((0.057999999999999996, 0.058))
    '0.058'
    """
    low, high = (float(end) + 0.0 for end in ends if end is not None)  # no sign on a zero
    directions = (ROUND_CEILING, ROUND_FLOOR) if inward else (ROUND_FLOOR, ROUND_CEILING)
    first, last = (_end(end, digits, way) for end, way in zip((low, high), directions, strict=True))
    return first if low == high or first == last else f"{first} to {last}"


def _end(end: float, digits: int, direction: str) -> str:
    nearest = number(end, digits)
    if isclose(float(nearest), end, rel_tol=1e-14):
        return nearest
    return rounded(Fraction(end), digits, direction)


_SCALES = {
    "velocity": (1.0, "m/s"),
    "radius": (1e6, "um"),
    "particle_density": (1.0, "kg/m^3"),
    "target_density": (1.0, "kg/m^3"),
    "beta": (1.0, "1"),
    "flow_stress": (1e-6, "MPa"),
}


def shown_range(effect: Effect) -> str:
    """The range of an effect's input in the unit that a reader wants.

    >>> effect = Effect(input="radius", low=8.2e-6, high=1.38e-5, ratios=[], depths=[], why="")
    >>> shown_range(effect)
    '8.2 to 13.8 µm'
    """
    scale, unit = _SCALES[effect.input]
    return quantity(between((effect.low * scale, effect.high * scale), 4), unit)


def names_of(record: Record) -> dict[str, Named]:
    """What the ids of a record name, and where the page shows it."""
    equations = {
        e.id: Named(f"Eq. {e.number}" if e.number else e.title, f"equation-{e.id}")
        for e in record.equations
    }
    inferred = {
        f"inferred:{i.id}": Named(i.title, f"inferred-{i.id}", quantity(number(i.assumed), i.unit))
        for i in record.inferred
    }
    claims = {c.id: Named(c.title, f"claim-{c.id}", printed(c)) for c in record.claims}
    return equations | inferred | claims


def facts(claim: ClaimRecord, names: Mapping[str, Named]) -> list[tuple[str, str]]:
    """Label and text of all that is known of a claim beside its verdict and explanation."""
    unit, off, still = claim.unit, claim.error_in_last_digit, claim.shown_by
    inputs = (
        " × ".join(f"`{name}` {names[name].value}" for name in entries)
        for entries in claim.rests_on.values()
    )
    readings = (
        f"{reading.name}: {quantity(number(reading.computed, 10), unit)}, {reading.verdict}, "
        f"proven range {between(reading.enclosure)}. {reading.holds}"
        + (f" For instance (SI) {_values(reading.witness)}." if reading.witness else "")
        for reading in claim.readings
    )
    sources = (
        f"{s.title}, {s.address}, prints {quantity(s.says, s.unit)} ({s.applies})"
        for s in claim.sources
    )
    told = {
        "rounds to it": quantity((claim.interval_text or "").replace("E", "e"), unit),
        "computed": claim.computed is not None and quantity(number(claim.computed, 10), unit),
        "to 25 digits": claim.reference,
        "proven range": claim.enclosure and between(claim.enclosure),
        "off by": off is not None
        and claim.verdict in OPEN
        and f"{number(off, 3)} units of the last printed digit",
        "from": claim.computed is not None and ", ".join(inputs),
        "for instance (SI)": claim.witness and _values(claim.witness),
        "read otherwise": "; ".join(readings),
        "assumed": "; ".join(claim.assumes),
        "would still agree": still
        and f"{quantity(between(still.interval, 6, inward=True), still.unit)}, by "
        + ", ".join(f"`{name}`" for name in still.claims),
        "public sources": "; ".join(sources),
        "workbook cell": claim.workbook and f"`{claim.workbook}`",
    }
    return [(label, text) for label, text in told.items() if text]


def _values(values: Mapping[str, float]) -> str:
    return ", ".join(f"`{name}` {number(value, 10)}" for name, value in values.items())

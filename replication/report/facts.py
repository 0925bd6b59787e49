"""What is said of a claim: each fact once, for the page, Markdown and the terminal alike.

Texts are sentences for `prose`: ids stand between backticks.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN
from fractions import Fraction
from math import isclose
from string import ascii_lowercase
from typing import NamedTuple

from reference.ledger import shown
from reference.units import written
from replication.audit.record import (
    BackSolvedRecord,
    ClaimRecord,
    Effect,
    EvidenceRecord,
    Record,
    RepairRecord,
)
from replication.audit.verdict import Verdict
from replication.report.prose import Named, quoted
from replication.text import number, rounded

__all__ = [
    "VERDICTS",
    "Arranged",
    "Table",
    "between",
    "evidence",
    "facts",
    "failing",
    "names_of",
    "printed",
    "quantity",
    "repairs",
    "shown_range",
    "significant",
    "tables",
]

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


# Numbers as text


def quantity(text: str, unit: str) -> str:
    """A number's text with its unit.

    >>> quantity("7.67", "um"), quantity("0.70", "1")
    ('7.67 µm', '0.70')
    """
    return f"{text} {written(unit)}".strip()


def printed(claim: ClaimRecord) -> str:
    """What the report prints, with its unit; the words of a remark as they are."""
    return quantity(shown(claim.printed), claim.unit)


def between(ends: Sequence[float], digits: int = 10, inward: bool = False) -> str:
    """An interval as words, its ends shortened outward, or inward where all inside is meant.

    An end that is short but for the rounding of a double is taken as it is.

    >>> between((0.12374472967338257, 0.13081477249718315))
    '0.1237447296 to 0.1308147725'
    >>> between((7839.582511570033, 7863.3048443432035), 8, inward=True)
    '7839.5826 to 7863.3048'
    >>> between((0.057999999999999996, 0.058))
    '0.058'
    """
    if ends[0] == ends[1]:
        return number(ends[0] + 0.0, digits)  # no sign on a zero
    directions = (ROUND_CEILING, ROUND_FLOOR) if inward else (ROUND_FLOOR, ROUND_CEILING)
    low, high = (
        _end(end, digits, direction) for end, direction in zip(ends, directions, strict=True)
    )
    return low if low == high else f"{low} to {high}"


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


# The facts of a claim


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


Facts = list[tuple[str, str]]


def facts(claim: ClaimRecord, names: Mapping[str, Named]) -> Facts:
    """Label and text of all that is known of a claim beside its verdict and explanation."""
    told = ((label, tell(claim, names)) for label, tell in _FIELDS)
    return [(label, text) for label, text in told if text]


def _interval(claim: ClaimRecord, _: Mapping[str, Named]) -> str:
    return quantity((claim.interval_text or "").replace("E", "e"), claim.unit)


def _computed(claim: ClaimRecord, _: Mapping[str, Named]) -> str:
    return "" if claim.computed is None else quantity(number(claim.computed, 10), claim.unit)


def _enclosure(claim: ClaimRecord, _: Mapping[str, Named]) -> str:
    return _proven(claim.enclosure)


def _proven(ends: tuple[float | None, float | None] | None) -> str:
    if ends is None:
        return ""
    low, high = ends
    assert low is not None, "a proven range has two ends"
    assert high is not None, "a proven range has two ends"
    return between((low, high))


def _off(claim: ClaimRecord, _: Mapping[str, Named]) -> str:
    if claim.error_in_last_digit is None or claim.verdict not in OPEN:
        return ""
    return f"{number(claim.error_in_last_digit, 3)} units of the last printed digit"


def _inputs(claim: ClaimRecord, names: Mapping[str, Named]) -> str:
    parts = [
        " × ".join(f"`{name}` {names[name].value}" for name in entries)
        for entries in claim.rests_on.values()
    ]
    return ", ".join(parts) if claim.computed is not None else ""


def _witness(values: Mapping[str, float] | None) -> str:
    return ", ".join(f"`{name}` {number(value, 10)}" for name, value in (values or {}).items())


def _readings(claim: ClaimRecord, _: Mapping[str, Named]) -> str:
    return "; ".join(
        f"{reading.name}: {quantity(number(reading.computed, 10), claim.unit)}, {reading.verdict}, "
        f"proven range {_proven(reading.enclosure)}. {reading.holds}"
        + (f" For instance (SI) {_witness(reading.witness)}." if reading.witness else "")
        for reading in claim.readings
    )


def _shown_by(claim: ClaimRecord, _: Mapping[str, Named]) -> str:
    if claim.shown_by is None:
        return ""
    ends = between(claim.shown_by.interval, 6, inward=True)
    told = ", ".join(f"`{name}`" for name in claim.shown_by.claims)
    return f"{quantity(ends, claim.shown_by.unit)}, by {told}"


def _sources(claim: ClaimRecord, _: Mapping[str, Named]) -> str:
    return "; ".join(
        f"{s.title}, {s.address}, prints {quantity(s.says, s.unit)} ({s.applies})"
        for s in claim.sources
    )


_FIELDS: tuple[tuple[str, Callable[[ClaimRecord, Mapping[str, Named]], str]], ...] = (
    ("prints so", _interval),
    ("computed", _computed),
    ("to 25 digits", lambda claim, _: claim.reference or ""),
    ("proven range", _enclosure),
    ("off by", _off),
    ("from", _inputs),
    ("for instance (SI)", lambda claim, _: _witness(claim.witness)),
    ("read otherwise", _readings),
    ("assumed", lambda claim, _: "; ".join(claim.assumes)),
    ("would still agree", _shown_by),
    ("public sources", _sources),
    ("workbook cell", lambda claim, _: f"`{claim.workbook}`" if claim.workbook else ""),
)
"""Every fact of a claim, in order, and how it is told."""


class Table(NamedTuple):
    """A table of a claim or of an equation; the first cell of a row is its head."""

    caption: str
    heads: tuple[str, ...]
    rows: Sequence[tuple[str, ...]]


def tables(claim: ClaimRecord) -> list[Table]:
    """What was tried for a claim that fails, and what a remark or a choice is judged by."""
    figures = [(f.means, quantity(number(f.value, 5), f.unit)) for f in claim.figures]
    slips = [(s.name, s.reason, number(s.value, 3), s.fits or "no") for s in claim.slips]
    found = (
        Table("The figures", ("what", "computed"), figures),
        _back_solved(claim.back_solved),
        repairs(claim.repairs),
        Table("Slips the author may have made", ("slip", "what it is", "gives", "fits"), slips),
    )  # fmt: skip
    return [table for table in found if table.rows]


def failing(record: Record, claims: Iterable[ClaimRecord]) -> Table:
    """The claims that do not come out as printed: what is printed, and what follows instead."""
    claims = list(claims)
    needed = {c.claim: c.needed for equation in record.equations for c in equation.constants}
    names = list(dict.fromkeys(reading.name for claim in claims for reading in claim.readings))
    rows = []
    for claim in claims:
        shortened = f"#.{significant(claim.printed)}g"
        computed = "" if claim.computed is None else format(claim.computed, shortened)
        if claim.id in needed:
            computed = f"{' or '.join(needed[claim.id])} would follow"
        otherwise = {reading.name: f"{reading.computed:{shortened}}" for reading in claim.readings}
        others = (otherwise.get(name, "") for name in names)
        rows.append((f"`{claim.id}`", printed(claim), computed, *others))
    heads = ("number", "printed", "computed as printed", *names)
    return Table("What does not come out as printed", heads, rows)


def significant(text: str) -> int:
    """How many significant digits a printed number has.

    >>> significant("0.0550"), significant(">= 2680"), significant("7.6E9")
    (3, 4, 2)
    """
    mantissa = re.split(r"[eE×\\]", text)[0]
    return len(re.sub(r"\D", "", mantissa).lstrip("0")) or 1


def evidence(piece: EvidenceRecord) -> str:
    """What was computed for a finding, to two digits more than asserted; a bound, safely rounded.

    >>> piece = EvidenceRecord(
    ...     name="", means="", unit="1", asserted=">= 1.147", computed=1.1475699, holds=True
    ... )
    >>> evidence(piece)
    '1.14756'
    """
    if isinstance(piece.computed, bool):
        return _yes(piece.computed)
    safe = {">": ROUND_FLOOR, "<": ROUND_CEILING}.get(piece.asserted[:1], ROUND_HALF_EVEN)
    digits = significant(piece.asserted) + 2
    return quantity(rounded(Fraction(piece.computed), digits, safe), piece.unit)


def _yes(agrees: bool | None) -> str:
    return {True: "yes", False: "no", None: ""}[agrees]


def _back_solved(solved: Iterable[BackSolvedRecord]) -> Table:
    """A row for each input, a column for each reading."""
    rows: dict[str, dict[str, BackSolvedRecord]] = {}
    for item in solved:
        rows.setdefault(item.entry, {})[item.reading] = item
    readings = list(dict.fromkeys(reading for row in rows.values() for reading in row))
    return Table(
        "One input changed, all others as printed: the values that would give the number, proven "
        "within the range searched",
        ("input", "printed", *(f"needed, {reading or 'as printed'}" for reading in readings),
         "searched"),
        [
            (
                f"`{entry}`",
                quantity(number(item.printed), item.unit),
                *(_needed(row[reading]) if reading in row else "" for reading in readings),
                f"{between(item.search, 4)}: {item.search_reason}",
            )
            for entry, row in rows.items()
            for item in [next(iter(row.values()))]
        ],
    )  # fmt: skip


def _needed(solved: BackSolvedRecord) -> str:
    if not solved.intervals:
        return "undecided" if solved.proof == "undecided" else "none"
    text = quantity(
        ", ".join(between(ends, 6, inward=True) for ends in solved.intervals), solved.unit
    )
    text += " or beyond" if "end of the range" in solved.proof else ""
    return text + (", which prints alike" if solved.prints_alike else "")


def repairs(records: Iterable[RepairRecord]) -> Table:
    """The misprints that would explain a failure."""
    rows = [
        (
            f"`{repair.entry}`",
            quoted(repair.printed),
            quoted(repair.text),
            repair.kind,
            repair.reading or "as printed",
            ", ".join(f"`{name}`" for name in repair.failing) or "nothing",
        )
        for repair in records
    ]
    return Table(
        "Misprints that would explain it: one edit of the text",
        ("text of", "printed", "instead", "edit", "read", "then still fails"),
        rows,
    )


# The order of the page


@dataclass(frozen=True, slots=True)
class Arranged:
    """The claims of a record in the groups that a page shows, each claim in one of them."""

    open: list[ClaimRecord] = field(default_factory=list)
    constants: dict[str, ClaimRecord] = field(default_factory=dict)
    cells: dict[str, ClaimRecord] = field(default_factory=dict)
    computed: list[ClaimRecord] = field(default_factory=list)
    remarks: list[ClaimRecord] = field(default_factory=list)
    compared: list[ClaimRecord] = field(default_factory=list)
    repeated: list[ClaimRecord] = field(default_factory=list)
    undecided: dict[str, list[ClaimRecord]] = field(default_factory=dict)

    @classmethod
    def of(cls, record: Record) -> "Arranged":
        """The groups of a record."""
        groups = cls()
        constants = {c.claim for equation in record.equations for c in equation.constants}
        for claim in record.claims:
            verdict = Verdict(claim.verdict)
            if verdict in OPEN:
                groups.open.append(claim)
            elif claim.id in constants:
                groups.constants[claim.id] = claim
            elif claim.cell:
                groups.cells[claim.cell] = claim
            elif verdict is Verdict.REPRODUCED:
                groups.computed.append(claim)
            elif verdict is Verdict.REMARK:
                groups.remarks.append(claim)
            elif verdict in (Verdict.AGREES, Verdict.DIFFERS):
                groups.compared.append(claim)
            elif verdict is Verdict.CONSISTENT:
                groups.repeated.append(claim)
            else:
                groups.undecided.setdefault(claim.explanation, []).append(claim)
        return groups

    @property
    def marks(self) -> dict[tuple[str, str], str]:
        """A letter for each verdict of the table's cells, with its conventions or its reason."""
        said = dict.fromkeys(self.said(claim) for claim in self.cells.values())
        return dict(zip(said, ascii_lowercase, strict=False))

    @staticmethod
    def said(claim: ClaimRecord) -> tuple[str, str]:
        """The verdict of a claim and under which conventions it holds, or why."""
        return claim.verdict, claim.holds or claim.explanation

    @property
    def header(self) -> list[ClaimRecord]:
        """The header of Table A-1: its second column."""
        return [claim for cell, claim in self.cells.items() if cell.startswith("B")]

    @property
    def rows(self) -> list[list[ClaimRecord | None]]:
        """The rows of Table A-1 below the header, None where a cell is blank."""
        names = [cell for cell in self.cells if not cell.startswith("B")]
        columns = sorted({name[0] for name in names})
        numbers = sorted({int(name[1:]) for name in names})
        return [[self.cells.get(f"{column}{n}") for column in columns] for n in numbers]

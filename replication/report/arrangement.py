"""What page and Markdown show of a record, and where: decided here, laid out by the templates."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from string import ascii_lowercase

from reference.ledger import INFERRED, in_header
from replication.audit.assessment import Comparison, Verdict
from replication.audit.record import ClaimRecord, EquationRecord, Finding, InferredRecord, Record
from replication.power import measured_rates
from replication.report import tables, words
from replication.report.prose import Named
from replication.report.terminal import capital
from replication.text import Table

SECTIONS: Mapping[str, str] = {
    "summary": "Summary",
    "open": "What does not follow",
    "findings": "Findings, most important first",
    "approaches": "All approaches side by side",
    "sheet": "The sheet and the exact motion",
    "sensitivity": "What the depth depends on",
    "scatter": "What scatter does",
    "inferred": "The target density, inferred",
    "equations": "The equations",
    "table-a-1": "Table A-1",
    "computed": "Recomputed numbers",
    "remarks": "Remarks, with figures",
    "sources": "Numbers compared with public sources",
    "repeated": "Numbers that repeat, are chosen, or are compared",
    "undecided": "Numbers that nothing in the report decides",
    "power": "What this audit would notice",
    "symbols": "Symbols",
    "provenance": "Provenance",
}
"""The sections in their order: the name of each, by which it is linked to, and its title."""

_BY_VERDICT: Mapping[Verdict, str] = {
    Verdict.REPRODUCED: "computed",
    Verdict.CONSISTENT: "repeated",
    Verdict.AGREES: "sources",
    Verdict.DIFFERS: "sources",
    Verdict.REMARK: "remarks",
    Verdict.NOT_CHECKABLE: "undecided",
}
"""The section for a claim with such a verdict; any other is shown in the section "open"."""

Claims = Mapping[str, ClaimRecord]
"""Claims by id."""


@dataclass(frozen=True)
class Card:
    """A claim that is shown by itself.

    Texts are empty, and `facts` and `tables` have no entries, where there is nothing to show.
    """

    record: ClaimRecord
    is_open: bool
    mathml: str
    formula: str
    by_hand: str
    findings: Sequence[Finding]
    facts: Sequence[tuple[str, str]]
    tables: Sequence[Table]


@dataclass(frozen=True)
class FindingPart:
    """A finding, what would settle it where it is open, and its numbers."""

    finding: Finding
    settle: str
    numbers: Table

    @property
    def contents(self) -> str:
        """What is shown of it beside its statement, in words."""
        contents = ["by hand"] if self.finding.by_hand else []
        contents += ["what would settle it"] if self.settle else []
        if not contents:
            return "Its numbers"
        return f"{capital(', '.join(contents))}, and its numbers"


@dataclass(frozen=True)
class EquationPart:
    """An equation, and its constants: verdicts by id, and the records of those that are shown here.

    A constant that fails is shown in the section "open".
    """

    record: EquationRecord
    title: str
    constants: Sequence[tuple[str, Verdict, ClaimRecord | None]]
    repairs: Table


@dataclass(frozen=True)
class SourcesPart:
    """What public sources print for a claim, or for an input whose `record` is None."""

    name: str
    named: Named
    origin: str
    record: ClaimRecord | None
    comparisons: Sequence[Comparison]


@dataclass(frozen=True)
class TableA1:
    """Table A-1 as printed: its header, and rows of claims or of words for cells without one.

    `notes` are the verdicts with their conventions, by letter; `letters` has each claim's letter.
    """

    header: Sequence[ClaimRecord]
    heads: Sequence[str]
    rows: Sequence[Sequence[ClaimRecord | str]]
    letters: Mapping[str, str]
    notes: Mapping[str, tuple[Verdict, str]]
    assumed: str
    proven: Table


class Arrangement:
    """The parts of a page about a record."""

    def __init__(self, record: Record) -> None:
        self.record = record
        self.names = words.names_of(record)
        self._by_hand_first = sorted(record.findings, key=lambda finding: not finding.by_hand)
        self.groups = _groups(record)
        self.numbers = {finding.id: k for k, finding in enumerate(record.findings, 1)}
        self.sections = {
            name: title for name, title in SECTIONS.items() if self.groups.get(name, True)
        }

    # The summary

    @property
    def verdicts(self) -> list[tuple[int, Verdict, str]]:
        """How many claims have each verdict, and what it says."""
        summary = self.record.summary
        return [(summary[verdict], verdict, words.MEANINGS[verdict]) for verdict in Verdict]

    @property
    def on_open(self) -> list[Finding]:
        """The findings that concern mostly what does not come out as printed."""
        failing = self.groups["open"]
        return [
            finding
            for finding in self.record.findings
            if 2 * sum(name in failing for name in finding.claims) >= len(finding.claims)
        ]

    # Claims

    def cards(self, section: str) -> list[Card]:
        """Return the claims of a section, each with all that is shown of it."""
        return [self._card(record) for record in self.groups[section].values()]

    def _card(self, record: ClaimRecord) -> Card:
        findings = [finding for finding in self._by_hand_first if record.id in finding.claims]
        is_open, worked = record.id in self.groups["open"], record.worked
        mathml = formula = by_hand = ""
        if is_open:
            within = record.claim.within
            around = (e.mathml for e in self.record.equations if e.id == within)
            mathml = worked.mathml if worked else next(around, "")
            formula = worked.formula if worked else ""
            ways = (worked.by_hand if worked else "", *(finding.by_hand for finding in findings))
            by_hand = next(filter(None, ways), "")
        facts = tables.facts(record, self.names)
        return Card(
            record,
            is_open,
            mathml,
            formula,
            by_hand,
            findings,
            facts,
            tables.explanation_tables(record, self.names),
        )

    @property
    def repeated(self) -> list[tuple[ClaimRecord, str]]:
        """The claims that repeat others or are chosen, each with what it agrees with."""
        records = self.groups["repeated"].values()
        return [(record, words.repetition_in_words(record, self.names)) for record in records]

    @property
    def said_again(self) -> list[ClaimRecord]:
        """The remarks that say again what another says, and so have no figures of their own."""
        return [record for record in self.groups["remarks"].values() if record.claim.same_as]

    @property
    def undecided(self) -> list[tuple[str, list[ClaimRecord]]]:
        """The claims that nothing decides, by the reason."""
        records = sorted(self.groups["undecided"].values(), key=lambda record: record.explanation)
        return [
            (why, list(own)) for why, own in groupby(records, key=lambda record: record.explanation)
        ]

    @property
    def table_a_1(self) -> TableA1:
        """Table A-1, less the cells that fail."""
        return _table_a_1(self.groups["table-a-1"], self.record.blank_cells)

    # Other sections

    @property
    def findings(self) -> list[FindingPart]:
        """The findings, with their numbers."""
        return [
            FindingPart(
                finding=finding,
                settle=finding.settle if finding.status == "open" else "",
                numbers=tables.evidence(finding),
            )
            for finding in self.record.findings
        ]

    @property
    def inferred(self) -> list[tuple[str, str]]:
        """The ids of the inputs that the report does not print, and what is known of each."""
        by_name: dict[str, list[InferredRecord]] = {}
        for record in self.record.inferred:
            by_name.setdefault(record.id, []).append(record)
        return [(name, words.inferred(records)) for name, records in by_name.items()]

    @property
    def equations(self) -> list[EquationPart]:
        """The equations, with their constants."""
        here = self.groups["equations"]
        return [
            EquationPart(
                record=record,
                title=words.equation_title(record),
                constants=[
                    (name, constant.verdict, here.get(name))
                    for name, constant in record.assessment.constants.items()
                ],
                repairs=tables.repairs(record.repairs),
            )
            for record in self.record.equations
        ]

    @property
    def sources(self) -> list[SourcesPart]:
        """What is compared with public sources, claims first."""
        claims = [(record.id, "printed", record.sources) for record in self.record.claims]
        inputs = [(INFERRED + entry.id, "assumed", entry.sources) for entry in self.record.inferred]
        shown = self.groups["sources"]
        return [
            SourcesPart(name, self.names[name], origin, shown.get(name), comparisons)
            for name, origin, comparisons in (*claims, *inputs)
            if comparisons
        ]

    @property
    def power(self) -> tuple[str, Table, Table, Table]:
        """What the audit notices of planted misprints: in words, the rates, by kind, and reasons.

        The reasons are those for which a true text is not named first.
        """
        rates = measured_rates()
        return words.power_in_words(rates), rates.rates(), rates.table(), rates.reasons()


def _groups(record: Record) -> dict[str, dict[str, ClaimRecord]]:
    """Sort the claims into sections; each is in one only."""
    constants = {name for equation in record.equations for name in equation.assessment.constants}
    names = ("open", "equations", "table-a-1", *dict.fromkeys(_BY_VERDICT.values()))
    groups: dict[str, dict[str, ClaimRecord]] = {name: {} for name in names}
    for claim in record.claims:
        name = _BY_VERDICT.get(claim.verdict, "open")
        if name != "open" and claim.id in constants:
            name = "equations"
        elif name != "open" and claim.claim.cell:
            name = "table-a-1"
        elif name != "open" and claim.assessment.compared:
            name = "repeated"
        groups[name][claim.id] = claim
    return groups


def _table_a_1(claims: Claims, blank: Sequence[str]) -> TableA1:
    cells = {str(record.claim.cell): record for record in claims.values()}
    notes = {c.id: (c.verdict, c.scope or c.explanation) for c in claims.values()}
    letters = dict(zip(dict.fromkeys(notes.values()), ascii_lowercase, strict=False))
    below = [cell for cell in cells if not in_header(cell)]
    heads = {cell[0]: cells[cell].claim.title.partition(",")[0] for cell in below}
    columns, rows = sorted(heads), sorted({int(cell[1:]) for cell in below})

    def content(cell: str) -> ClaimRecord | str:
        # A cell that fails is shown further up on the page.
        return cells.get(cell) or ("blank" if cell in blank else "above")

    return TableA1(
        header=[record for cell, record in cells.items() if in_header(cell)],
        heads=[heads[column] for column in columns],
        rows=[[content(f"{column}{row}") for column in columns] for row in rows],
        letters={name: letters[note] for name, note in notes.items()},
        notes={letter: note for note, letter in letters.items()},
        assumed="; ".join(dict.fromkeys(a for c in claims.values() for a in c.assumes)),
        proven=tables.proven(claims.values()),
    )

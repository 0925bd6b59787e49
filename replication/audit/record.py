"""The record of a finished audit: everything that any report shows, as plain typed data.

`audit.json` is this record, key by key, and its JSON Schema is generated from these classes.
Reports render the record and compute nothing. Values are in SI units unless the class has a `unit`.
"""

from enum import StrEnum
from typing import Any, TypeVar

import msgspec

from reference.ledger import Convention, Report

SCHEMA = "coldspray-audit-2"
"""The name and version of this set of keys."""

Ends = tuple[float | None, float | None]
"""The lower and the upper end as doubles; null for an infinite end."""

ExactEnds = tuple[str | None, str | None]
"""The lower and the upper end as exact fractions, such as "1533/200"."""


class Verdict(StrEnum):
    """What the audit can conclude about a claim or an equation."""

    REPRODUCED = "reproduced"
    WITHIN_ROUNDING = "reproduced within input rounding"
    NOT_REPRODUCED = "not reproduced"
    UNDECIDED = "undecided"
    CONSISTENT = "consistent"
    INCONSISTENT = "inconsistent"
    AGREES = "agrees with public sources"
    DIFFERS = "differs from public sources"
    REMARK = "remark, quantified"
    NOT_CHECKABLE = "not checkable"

    @property
    def is_failure(self) -> bool:
        """Whether the entry contradicts the rest of the report; `--exit-code` reports claims."""
        return self in (Verdict.NOT_REPRODUCED, Verdict.INCONSISTENT)

    @property
    def is_open(self) -> bool:
        """Whether the inputs as printed do not give the entry: explanations are tried for these."""
        return self.is_failure or self in (Verdict.UNDECIDED, Verdict.WITHIN_ROUNDING)

    @property
    def is_doubtful(self) -> bool:
        """Whether it is open or differs from public sources: `power` counts it as noticed."""
        return self.is_open or self is Verdict.DIFFERS


class _Part(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A part of the record."""


class Judged(_Part, frozen=True):
    """A verdict under one convention.

    `rounding` is the rule by which a value became the printed text. `choices` and `header` say
    whether the values that the author chose, and the header of Table A-1, are taken as "exact" or
    "rounded". `scheme` is "published" if the sheet takes the drag at the velocity at the start of a
    step, "centered" if in its middle. `enclosure` is a range proven to contain the value: for the
    inputs as printed if the verdict is "reproduced", else for all inputs that print like them.
    Inferred inputs vary over all values that their evidence admits.
    """

    rounding: str
    choices: str
    header: str
    scheme: str
    verdict: Verdict
    enclosure: Ends
    enclosure_exact: ExactEnds


def in_words(convention: Convention) -> dict[str, Any]:
    """Return a convention as the fields of `Judged` that describe it."""
    return {
        "rounding": convention.rounding.value,
        "choices": "exact" if convention.choices_exact else "rounded",
        "header": "exact" if convention.header_exact else "rounded",
        "scheme": convention.scheme,
    }


class ReadingRecord(_Part, frozen=True):
    """The value and the verdict that one reading of the report's words gives a claim."""

    name: str
    summary: str
    verdict: Verdict
    computed: float
    reference: str
    enclosure: Ends
    enclosure_exact: ExactEnds
    witness: dict[str, float] | None
    holds: str
    otherwise: list[Judged]


class Proof(StrEnum):
    """What is proven about the intervals of a `BackSolvedRecord`."""

    INSIDE = "proven inside, and none beyond"
    TO_AN_END = "proven, up to an end of the range"
    NONE = "proven: none in the range does"
    UNDECIDED = "undecided"


class BackSolvedRecord(_Part, frozen=True):
    """The values of one input, all others as printed, for which the claim would agree."""

    reading: str
    entry: str
    title: str
    unit: str
    printed: float
    intervals: list[tuple[float, float]]
    search: tuple[float, float]
    search_reason: str
    proof: Proof


class RepairRecord(_Part, frozen=True):
    """A correction of a printed text by one edit, with which the claim would agree.

    `failing` are the claims and equations that would fail with it.
    """

    entry: str
    title: str
    reading: str
    printed: str
    text: str
    kind: str
    failing: list[str]


class SlipRecord(_Part, frozen=True):
    """What Eq. 16 gives with slips of the author's: `departures` of them, named in `name`.

    `fits` says for which target densities it gives the printed number.
    """

    name: str
    departures: int
    value: float
    fits: str


class SlipsTried(_Part, frozen=True):
    """The family of slips that was tried for a claim, as `replication.audit.slips` explains.

    It has `members`, of which `near` come within a factor of 1.5 of the printed number. `expected`
    is how many of them would fit it by accident.
    """

    members: int
    near: int
    expected: float


class SourceRecord(_Part, frozen=True):
    """A public source for a claim or an inferred input, and how the two compare."""

    id: str
    title: str
    address: str
    quote: str
    says: str
    unit: str
    applies: str
    agrees: bool
    outcome: str


class Figure(_Part, frozen=True):
    """A number that helps to judge a remark; null where the inputs make no sense."""

    means: str
    value: float | None
    unit: str


class Shown(_Part, frozen=True):
    """The range of a chosen number for which the claims computed from it agree."""

    claims: list[str]
    interval: tuple[float, float]
    unit: str


class ClaimRecord(_Part, frozen=True):
    """One printed number with its verdict and proof; values are in the claim's unit.

    `computed` is a double, whose last digits may lie outside the proven `enclosure`.
    """

    id: str
    title: str
    where: str
    line: int
    section: str
    equation: str | None
    cell: str | None
    quote: str
    printed: str
    unit: str
    kind: str
    interval: Ends | None
    interval_exact: ExactEnds | None
    interval_text: str | None
    verdict: Verdict
    restates: str | None
    computed_by: str | None
    computed: float | None
    reference: str | None
    enclosure: Ends | None
    enclosure_exact: ExactEnds | None
    witness: dict[str, float] | None
    error_in_last_digit: float | None
    holds: str
    otherwise: list[Judged]
    readings: list[ReadingRecord]
    rests_on: dict[str, list[str]]
    assumes: list[str]
    explanation: str
    formula: str | None
    mathml: str | None
    by_hand: str | None
    shown_by: Shown | None
    sources: list[SourceRecord]
    figures: list[Figure]
    back_solved: list[BackSolvedRecord]
    repairs: list[RepairRecord]
    slips: list[SlipRecord]
    slips_tried: SlipsTried | None
    workbook: str | None


class ConstantRecord(_Part, frozen=True):
    """The verdict on a constant of an equation; `needed` are the values that pass every check."""

    claim: str
    verdict: Verdict
    needed: list[str]


class EquationRecord(_Part, frozen=True):
    """One printed equation with its verdict."""

    id: str
    number: str | None
    title: str
    where: str
    text: str
    mathml: str
    kind: str
    follows_from: str
    verdict: Verdict
    factor: str | None
    constants: list[ConstantRecord]
    explanation: str
    repairs: list[RepairRecord]


class Evidence(_Part, frozen=True):
    """A number in a finding's text, as asserted and as computed here, or the outcome of a proof.

    `asserted` is the number as the text prints it, perhaps after a relation (">= 17.7"), or "yes"
    or "no". `computed` is null where it has no value, which a misprint in the report may cause.
    """

    name: str
    means: str
    unit: str
    asserted: str
    computed: float | bool | None
    holds: bool

    def __str__(self) -> str:
        """Return the number as it stands in the text, without its relation."""
        return self.asserted.rpartition(" ")[2]


class Finding(_Part, frozen=True):
    """What a failed or surprising claim shows about the report, with the evidence."""

    id: str
    title: str
    kind: str
    status: str
    claims: list[str]
    statement: str
    by_hand: str
    settle: str
    holds: bool
    evidence: list[Evidence]


class InferredRecord(_Part, frozen=True):
    """An input that the report never prints, and the values that its evidence admits, in `unit`."""

    id: str
    title: str
    unit: str
    scheme: str
    assumed: float
    nominal_source: str
    interval: tuple[float, float]
    interval_exact: tuple[str, str]
    with_printed_mass: tuple[float, float]
    possible_with_rounded_inputs: tuple[float, float] | None
    evidence: list[str]
    odd: list[str]
    sources: list[SourceRecord]


class Approach(_Part, frozen=True):
    """The normalized depth X/R by one approach, as computed here and as printed."""

    kind: str
    name: str
    computed: float | None = None
    printed: str = ""
    claim: str | None = None


class Effect(_Part, frozen=True):
    """The exact X/R and depth at both ends of an input's range; `why` says which range it is."""

    input: str
    low: float
    high: float
    ratios: list[float]
    depths: list[float]
    why: str


class Sensitivity(_Part, frozen=True):
    """How the exact final depth of one case depends on its inputs."""

    beta: float
    depth: float
    elasticities: dict[str, float]
    stated: list[Effect]


class Scatter(_Part, frozen=True):
    """The particles of the stream by one law of their velocity.

    The deviations are those of the velocity, to first order. `velocities` and `ratios` (X/R) are
    the values that each share of the particles does not exceed.
    """

    law: str
    standard_deviation: float
    mean_deviation: float
    shares: list[float]
    velocities: list[float]
    ratios: list[float]


class Curve(_Part, frozen=True):
    """Depth against time, from first contact to rest."""

    beta: float
    printed: str
    sheet_time: list[float]
    sheet_depth: list[float]
    exact_time: list[float]
    exact_depth: list[float]


class VelocityCurve(_Part, frozen=True):
    """X/R against impact velocity for beta = 5."""

    velocity: list[float]
    sheet: list[float]
    exact: list[float]


class Level(_Part, frozen=True):
    """The sheet's final depth at one time step, and its error: sheet less exact depth at rest."""

    beta: float
    scheme: str
    step: float
    steps: int
    depth: float
    error: float


class Counts(_Part, frozen=True):
    """How many claims and equations there are, by kind and outcome.

    The `entries` are all claims: `numbers` are printed numbers, `remarks` comparisons in words. Of
    the `reproduced` numbers, `constants` stand in equations and `computed` are calculated from
    their inputs; `values` counts the different values among these, each once however often it is
    printed. `failing` claims and `equations_failing` contradict the rest of the report.
    """

    entries: int
    numbers: int
    remarks: int
    reproduced: int
    constants: int
    computed: int
    values: int
    failing: int
    equations: int
    equations_derived: int
    equations_failing: int


class Record(_Part, frozen=True):
    """The finished audit.

    `failing` are the claims and equations that contradict the rest of the report; `culprit` is the
    one misprint that would explain all of them, if there is one.
    """

    schema: str
    headline: str
    report: Report
    summary: dict[str, int]
    counts: Counts
    culprit: RepairRecord | None
    failing: list[str]
    claims: list[ClaimRecord]
    equations: list[EquationRecord]
    findings: list[Finding]
    inferred: list[InferredRecord]
    approaches: list[Approach]
    sensitivity: list[Sensitivity]
    scatter: list[Scatter]
    curves: list[Curve]
    velocity_curve: VelocityCurve
    ladders: list[Level]
    blank_cells: list[str]
    symbols: dict[str, str]
    provenance: dict[str, Any]

    def claim(self, name: str) -> ClaimRecord:
        """Return the claim with this id. Raises KeyError if there is none."""
        return {claim.id: claim for claim in self.claims}[name]


_Filled = TypeVar("_Filled", bound=_Part)


def filled(kind: type[_Filled], *sources: object, **given: Any) -> _Filled:
    """Build a part of the record; fields not given are copied from the sources by name.

    Raises TypeError where not exactly one source has a field.
    """
    for name in sorted(set(kind.__struct_fields__) - given.keys()):
        values = [getattr(source, name) for source in sources if hasattr(source, name)]
        if len(values) != 1:
            raise TypeError(f"{kind.__name__}.{name}: {len(values)} sources have it")
        given[name] = values[0]
    return kind(**given)


def schema() -> dict[str, Any]:
    """Return the JSON Schema of `audit.json`."""
    dialect = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return dialect | msgspec.json.schema(Record)

"""The record of a finished audit: everything that any page or file shows.

A claim, an equation or an input is recorded with the ledger's entry and the judge's assessment
themselves, beside what was found out about them. `replication.report.document` writes the record as
`audit.json`. Reports render the record and compute nothing. Values are in SI units unless the class
has a `unit`.
"""

from collections.abc import Sequence
from enum import StrEnum
from typing import Any

import msgspec

from reference.enclosure import Ends
from reference.ledger import Claim, Equation, Inferred, Report
from reference.scheme import Scheme
from replication.audit.assessment import (
    Assessment,
    Comparison,
    ConfirmedRange,
    EquationAssessment,
    Reading,
    Verdict,
)
from replication.text import with_unit
from replication.user_input import advice

SCHEMA = "coldspray-audit-2"
"""The name and version of the keys of `audit.json`."""


class _Part(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A part of the record."""


# Explanations that were tried


class Proof(StrEnum):
    """What is proven about the intervals of a `BackSolved`."""

    INSIDE = "proven inside, and none beyond"
    TO_AN_END = "proven, up to an end of the range"
    NONE = "proven: none in the range does"
    UNDECIDED = "undecided"


class BackSolved(_Part, frozen=True):
    """The values of one input, all others as printed, for which the claim would agree."""

    reading: str
    entry: str
    title: str
    unit: str
    as_printed: float = msgspec.field(name="printed")
    intervals: list[tuple[float, float]]
    search: tuple[float, float]
    search_reason: str
    proof: Proof


class Repair(_Part, frozen=True):
    """A correction by one edit, `text` for the `original`, with which the claim would agree.

    `failing` are the claims and equations that would fail with it.
    """

    entry: str
    title: str
    reading: str
    original: str = msgspec.field(name="printed")
    text: str
    kind: str
    failing: list[str]


class FittingSlip(_Part, frozen=True):
    """What Eq. 16 gives with slips of the author's: `departures` of them, named in `name`.

    `value` is X/R at the target density taken. `fits` says for which target densities the printed
    number is given.
    """

    name: str
    departures: int
    value: float
    fits: str


class SlipsTried(_Part, frozen=True):
    """The family of slips that was tried for a claim, as `replication.audit.slips` explains.

    It has `forms`, and `members` different values, of which `near` come within a factor of 1.5 of
    the printed number. `expected` is how many would fit it by accident, if those that come so near
    lay there evenly on a logarithmic scale.
    """

    forms: int
    members: int
    near: int
    expected: float


class Figure(_Part, frozen=True):
    """A number that helps to judge a remark; null where the inputs make no sense."""

    means: str
    value: float | None
    unit: str


# Claims, equations and inferred inputs


class Worked(_Part, frozen=True):
    """A claim's equation with numbers put in, as MathML, and the steps by hand."""

    formula: str
    mathml: str
    by_hand: str


class ClaimRecord(_Part, frozen=True):
    """One printed number with its verdict and proof; values are in the claim's unit.

    `scopes` has for each reading a sentence on the conventions under which its verdict holds.
    `error_in_last_digit` is the computed less the printed number, in units of its last digit. Where
    the number fails, `worked` shows how it is calculated, and `back_solved`, `repairs` and `slips`
    what might explain it. `figures` help to judge a remark.
    """

    claim: Claim
    assessment: Assessment
    explanation: str
    scopes: Sequence[str]
    assumes: Sequence[str]
    error_in_last_digit: float | None
    worked: Worked | None
    confirmed_range: ConfirmedRange | None
    sources: Sequence[Comparison]
    figures: Sequence[Figure]
    back_solved: Sequence[BackSolved]
    repairs: Sequence[Repair]
    slips: Sequence[FittingSlip]
    slips_tried: SlipsTried | None

    def __repr__(self) -> str:
        """A line; `msgspec.structs.asdict` has all fields."""
        return f"<claim {self.id}: {with_unit(self.claim.text, self.claim.unit)}, {self.verdict}>"

    @property
    def id(self) -> str:
        """The claim's id in the ledger."""
        return self.claim.id

    @property
    def verdict(self) -> Verdict:
        """The verdict on the claim."""
        return self.assessment.verdict

    @property
    def as_printed(self) -> Reading | None:
        """What the report's words give as printed; None if nothing is computed."""
        return next(iter(self.assessment.readings), None)

    @property
    def computed(self) -> float | None:
        """The value computed from the inputs as printed; its last digits may be off by roundoff."""
        return None if self.as_printed is None else self.as_printed.computed

    @property
    def scope(self) -> str:
        """Under which conventions the verdict holds; empty if nothing is computed."""
        return next(iter(self.scopes), "")

    @property
    def restated(self) -> str | None:
        """The id of the claim whose number this one repeats; None for any other claim."""
        return self.claim.inputs.get("value", (None,))[0] if self.claim.restates else None


class EquationRecord(_Part, frozen=True):
    """One printed equation, its text with LaTeX markup and as MathML, with its verdict."""

    assessment: EquationAssessment
    text: str
    mathml: str
    explanation: str
    repairs: Sequence[Repair]

    @property
    def id(self) -> str:
        """The equation's id in the ledger."""
        return self.equation.id

    @property
    def equation(self) -> Equation:
        """The ledger's entry."""
        return self.assessment.equation

    @property
    def verdict(self) -> Verdict:
        """The verdict on the equation."""
        return self.assessment.verdict

    @property
    def number(self) -> str | None:
        """Its number in the report; None if it has none."""
        return self.equation.place.equation


class InferredRecord(_Part, frozen=True):
    """An input that the report never prints, and the values that its evidence admits, in its unit.

    Every value in `interval` gives all agreeing evidence, taken exactly as printed but with a
    sphere's mass; in `with_printed_mass` with the mass as printed. Rounded inputs admit none
    outside `possible_with_rounded_inputs`.
    """

    id: str
    entry: Inferred
    scheme: Scheme
    assumed: float
    interval: Ends
    with_printed_mass: Ends
    possible_with_rounded_inputs: Ends | None
    evidence: Sequence[str]
    odd: Sequence[str]
    sources: Sequence[Comparison]


# Findings


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


# The comparison of the report's approaches, and pictures


class Approach(_Part, frozen=True):
    """The normalized depth X/R by one approach, as computed here and, `shown`, as printed.

    `beta` is that of the report's case; null for an approach that has none.
    """

    kind: str
    name: str
    beta: int | None = None
    computed: float | None = None
    shown: str = msgspec.field(name="printed", default="")
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
    """Depth against time, from first contact to rest; `shown` is the final depth as printed."""

    beta: float
    shown: str = msgspec.field(name="printed")
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

    The `entries` are all claims: `numbers` are printed numbers, `remarks` what it says in words.
    Of the `reproduced` numbers, `constants` stand in equations and `computed` are calculated
    from their inputs; `values` counts the different values among these, each once however often
    it is printed. Of the computed ones, only the `independent` ones could have failed by
    themselves, and `bounds` of these are open on one side; an input was inferred from the
    `evidence`, and the others are true `by_definition` of printed numbers, or `repeats` of an
    earlier one (see `Standing`).
    `failing` claims and `equations_failing` contradict the rest of the report.
    """

    entries: int
    numbers: int
    remarks: int
    reproduced: int
    constants: int
    computed: int
    values: int
    independent: int
    bounds: int
    evidence: int
    by_definition: int
    repeats: int
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
    culprit: Repair | None
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
        """Return the claim with this id. Raises KeyError if there is none, and names similar ones.

        >>> from replication.audit.audit import audit
        >>> audit().claim("depth-beta-5")
        <claim depth-beta-5: 7.67 um, reproduced>
        """
        claims = {claim.id: claim for claim in self.claims}
        if name not in claims:
            hint = advice(name, claims, "`coldspray claims` lists the ids")
            raise KeyError(f"there is no claim {name!r}; {hint}")
        return claims[name]

    def __repr__(self) -> str:
        """A line, not the whole: that has some 340,000 characters."""
        counted = ", ".join(
            f"{count} {verdict}" for verdict, count in self.summary.items() if count
        )
        return f"<audit of {len(self.claims)} entries: {counted}; {len(self.findings)} findings>"

"""What an audit concludes about a printed number or an equation, and what that rests on."""

from collections.abc import Mapping, Sequence
from enum import Enum, StrEnum, auto
from fractions import Fraction

import msgspec

from reference.derivations import Check
from reference.enclosure import Ends
from reference.ledger import Convention, Equation, Source


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
    def needs_explanation(self) -> bool:
        """Whether the inputs as printed do not give the entry: explanations are tried for these."""
        return self.is_failure or self in (Verdict.UNDECIDED, Verdict.WITHIN_ROUNDING)

    @property
    def is_doubtful(self) -> bool:
        """Whether it needs one or differs from public sources: `power` counts it as noticed."""
        return self.needs_explanation or self is Verdict.DIFFERS


class Standing(StrEnum):
    """What a reproduced number tells: which inputs would have to be wrong for it to fail?

    INDEPENDENT: any of several printed numbers, or the equation that computes it. EVIDENCE: none,
    as an input was inferred from it. BY_DEFINITION: the printed numbers that it scales, multiplies
    or selects. REPEATS: those of an earlier number, which would have failed with it.
    """

    INDEPENDENT = "independent"
    EVIDENCE = "evidence"
    BY_DEFINITION = "by definition"
    REPEATS = "repeats"


class Ground(Enum):
    """On what a claim's verdict was decided; its explanation tells that, and nothing else.

    WORDS: it is a remark, not a number. REPETITION: another number of the report, or a count.
    COMPUTATION: the value that the report's formulas give for the inputs as printed. NO_VALUE: they
    give none. EQUATION: the checks of the equation in which it stands. SOURCES: what public sources
    print. OTHERS: the claims that are computed from it. COMPARISON: a number that limits it.
    DEFINITION: there is nothing to decide. NOTHING: the report does not decide it.
    """

    WORDS = auto()
    REPETITION = auto()
    COMPUTATION = auto()
    NO_VALUE = auto()
    EQUATION = auto()
    SOURCES = auto()
    OTHERS = auto()
    COMPARISON = auto()
    DEFINITION = auto()
    NOTHING = auto()


class Judgement(msgspec.Struct, frozen=True):
    """The verdict under one convention.

    `ends` is a range proven to contain the value, in the claim's unit: if the printed inputs give
    the number, for these and all admitted values of the inferred inputs; else for all inputs that
    print like the report's. Unless the number is reproduced, `witness` holds inputs (SI) that give
    it, if some are known; it has the mass in place of a radius computed from the mass.
    `against_evidence`: some value in the range prints like the claim, but it is proven that no
    inputs give both it and the numbers from which an input is inferred.
    """

    convention: Convention
    verdict: Verdict
    ends: Ends
    witness: Mapping[str, Fraction] | None = None
    against_evidence: bool = False


class Reading(msgspec.Struct, frozen=True):
    """The result of one computation of a claim, by one reading of the report; in the claim's unit.

    `computed` is the models' double for the inputs as printed (in a ledger with a misprint, that of
    the ledger's formula), `reference` the same value to 25 digits; `judgements` has one judgement
    for every convention, the usual one first.
    """

    name: str
    summary: str
    computed: float
    reference: str
    judgements: tuple[Judgement, ...]

    @property
    def verdict(self) -> Verdict:
        """The verdict under the usual convention."""
        return self.judgements[0].verdict

    @property
    def otherwise(self) -> list[Judgement]:
        """The judgements whose verdict differs from that under the usual convention."""
        return [judgement for judgement in self.judgements if judgement.verdict != self.verdict]


class Assessment(msgspec.Struct, frozen=True):
    """The verdict on a claim, its ground, and the readings behind it, the one as printed first.

    `no_value` says why the inputs as printed give no value, where they should. `standing` is what a
    reproduced number tells, and `compared` what a number was compared with that nothing computes.
    """

    verdict: Verdict
    ground: Ground
    readings: tuple[Reading, ...] = ()
    no_value: str = ""
    standing: Standing | None = None
    compared: str = ""


class Comparison(msgspec.Struct, frozen=True):
    """A public source for a claim or an inferred input, and how the two compare."""

    source: Source
    agrees: bool
    outcome: str


class ConfirmedRange(msgspec.Struct, frozen=True):
    """The range of a chosen number, in `unit`, for which the `claims` computed from it agree."""

    claims: Sequence[str]
    interval: tuple[float, float]
    unit: str


class JudgedConstant(msgspec.Struct, frozen=True):
    """The verdict on a constant of an equation; `needed` are the values that pass every check."""

    claim: str
    verdict: Verdict
    needed: list[str]


class EquationAssessment(msgspec.Struct, frozen=True):
    """The verdict on an equation, the checks behind it, and the verdicts on its constants."""

    equation: Equation
    verdict: Verdict
    checks: tuple[Check, ...]
    constants: Mapping[str, JudgedConstant]

    @property
    def factor(self) -> Fraction | None:
        """The printed over the derived side; None unless they differ by a constant factor."""
        return next((check.factor for check in self.checks if check.factor is not None), None)

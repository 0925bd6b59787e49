"""The verdict on one claim: whether the printed number follows from what the report prints."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction

from reference.computations import Computation
from reference.enclosure import Box, Exploration, Function, explore
from reference.exact import Reals
from reference.ledger import Claim, Ledger
from reference.printed import Interval
from replication.audit.entries import function_of, replica_of, rounding, value
from replication.audit.inference import Inference, infer

__all__ = ["Assessment", "Reading", "Verdict", "assess"]

_REALS = Reals(50)


class Verdict(Enum):
    """The five verdicts, from best to worst known."""

    REPRODUCED = "reproduced"
    WITHIN_ROUNDING = "reproduced within input rounding"
    NOT_REPRODUCED = "not reproduced"
    UNDECIDED = "undecided"
    NOT_CHECKABLE = "not checkable"


@dataclass(frozen=True, slots=True)
class Reading:
    """What one computation makes of a claim. All numbers are in the claim's unit.

    `computed` is the replica's double at the inputs as printed, `reference` the same to 50 digits.
    `enclosure` is a proven range of the value: over all admitted values of the inferred inputs if
    the claim is reproduced, otherwise over all inputs that print like the report's. `witness`
    holds entries (SI) that reproduce the claim where the printed ones do not; `loose` says, where
    none do, whether some would if no trailing zero were significant and no choice exact.
    """

    name: str
    computation: Computation
    verdict: Verdict
    computed: float
    reference: str
    enclosure: tuple[Fraction, Fraction]
    witness: dict[str, Fraction] | None = None
    loose: bool | None = None


@dataclass(frozen=True, slots=True)
class Assessment:
    """The verdict on a claim, with the reading it comes from and the other readings."""

    claim: Claim
    verdict: Verdict
    reading: Reading | None
    others: tuple[Reading, ...] = ()

    @property
    def error_in_last_digit(self) -> float | None:
        """Computed minus printed, in units of the last digit; None where no digit counts."""
        claim = self.claim
        printed = claim.printed
        if self.reading is None or printed is None or claim.relation or printed.quantum == 0:
            return None
        quantum = printed.quanta[-1] if claim.kind == "approximation" else printed.quantum
        return float((Fraction(self.reading.computed) - printed.value) / quantum)


def assess(ledger: Ledger, claim: Claim, cell_is_blank: Callable[[str], bool]) -> Assessment:
    """The verdict on one claim.

    `cell_is_blank` says whether the workbook's Table A-1 leaves a cell empty.
    """
    if claim.kind == "blank":
        assert claim.place.cell is not None
        blank = cell_is_blank(claim.place.cell)
        return Assessment(claim, Verdict.REPRODUCED if blank else Verdict.NOT_REPRODUCED, None)
    if claim.computation is None:
        return Assessment(claim, Verdict.NOT_CHECKABLE, None)
    first, *others = (
        _Question(ledger, claim, name, function).answer()
        for name, function in claim.functions.items()
    )
    return Assessment(claim, first.verdict, first, tuple(others))


class _Question:
    """Does this computation give the printed number?"""

    def __init__(self, ledger: Ledger, claim: Claim, name: str, function: Function) -> None:
        assert claim.computation is not None
        self.ledger, self.claim, self.name, self.function = ledger, claim, name, function
        self.computation = claim.readings.get(name, claim.computation)
        self.target = claim.target
        self.entries = sorted({entry for names in claim.inputs.values() for entry in names})
        self.of_entries = function_of(ledger, claim, function, frozenset(self.entries))

    def explore(self, box: Box) -> Exploration:
        return explore(self.of_entries, box, self.target)

    def answer(self) -> Reading:
        at_nominal = self.explore(self.as_printed())
        if at_nominal.always:
            everywhere = self.explore({**self.as_printed(), **self.inferred(_inner)})
            if everywhere.always:
                return self.reading(Verdict.REPRODUCED, everywhere)
            if everywhere.outside is None:
                return self.reading(Verdict.UNDECIDED, everywhere)
            # Only some admitted values do: the printed evidence does not tell which is meant.
            return self.reading(Verdict.WITHIN_ROUNDING, everywhere, witness=at_nominal.inside)
        if not at_nominal.never:
            return self.reading(Verdict.UNDECIDED, at_nominal)
        return self.search()

    def search(self) -> Reading:
        """The inputs as printed do not give the number: do any that print like them?"""
        # With other inputs rounded, the inferred ones may be what is attained, or possible, at all.
        fixed = self.claim.as_printed_inputs
        for which in (_inner,) if fixed else (_inner, _attained):
            found = self.explore({**self.rounded(), **self.inferred(which)})
            if found.inside is not None and self.evidence_holds(found.inside):
                return self.reading(Verdict.WITHIN_ROUNDING, found, witness=found.inside)
        widest = self.inferred(_outer if fixed else _possible)
        found = self.explore({**self.rounded(), **widest})
        if not found.never:
            return self.reading(Verdict.UNDECIDED, found)
        loosely = self.explore({**self.rounded(loose=True), **widest})
        return self.reading(Verdict.NOT_REPRODUCED, found, loose=loosely.inside is not None)

    def evidence_holds(self, witness: dict[str, Fraction]) -> bool:
        """Whether the witness reproduces the evidence of the inferred inputs, too."""
        names = (name.partition("inferred:")[2] for name in self.entries)
        return all(infer(self.ledger, name).holds_at(witness) for name in names if name)

    def as_printed(self) -> dict[str, tuple[Fraction, Fraction]]:
        values = {name: value(self.ledger, name) for name in self.entries}
        return {name: (number, number) for name, number in values.items()}

    def rounded(self, loose: bool = False) -> dict[str, tuple[Fraction, Fraction]]:
        """Every printed entry that prints like the report's."""
        if self.claim.as_printed_inputs:
            return self.as_printed()
        printed = (name for name in self.entries if not name.startswith("inferred:"))
        return {name: rounding(self.ledger, name, loose) for name in printed}

    def inferred(self, which: Callable[[Inference], Interval]) -> Box:
        ends = {}
        for name in self.entries:
            _, _, inferred = name.partition("inferred:")
            if inferred:
                ends[name] = which(infer(self.ledger, inferred)).ends
        return ends

    def reading(
        self,
        verdict: Verdict,
        explored: Exploration,
        witness: dict[str, Fraction] | None = None,
        loose: bool | None = None,
    ) -> Reading:
        si = self.claim.si
        return Reading(
            name=self.name,
            computation=self.computation,
            verdict=verdict,
            computed=self.replica(),
            reference=self.reference(),
            enclosure=(explored.lower / si, explored.upper / si),
            witness=witness,
            loose=loose,
        )

    def replica(self) -> float:
        result = replica_of(self.ledger, self.claim, self.computation)({})
        return float(Fraction(result) / self.claim.si)

    def reference(self) -> str:
        numbers = {name: _REALS.number(value(self.ledger, name)) for name in self.entries}
        result = self.of_entries(_REALS, **numbers)
        if isinstance(result, Fraction):
            result = _REALS.number(result)
        digits = 25  # shown; computed to 50
        return str(_REALS.context.nstr(result / _REALS.number(self.claim.si), digits))


def _inner(inference: Inference) -> Interval:
    return inference.inner


def _outer(inference: Inference) -> Interval:
    return inference.outer


def _attained(inference: Inference) -> Interval:
    return inference.attained


def _possible(inference: Inference) -> Interval:
    return inference.possible

"""The verdict on one claim: whether the printed number follows from what the report prints."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction

from reference.computations import Computation
from reference.enclosure import Exploration, Function, explore
from reference.exact import Reals
from reference.ledger import Claim, Ledger
from reference.printed import Interval
from replication.audit.inference import infer, nominal
from replication.audit.replica import REPLICA

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
    holds inputs (SI) that reproduce the claim where those as printed do not; `loose` says, where
    no inputs do, whether some would with every trailing zero taken as insignificant; `robust`
    whether a reproduced claim is reproduced by every admitted value of the inferred inputs.
    """

    name: str
    computation: Computation
    verdict: Verdict
    computed: float
    reference: str
    enclosure: tuple[Fraction, Fraction]
    witness: dict[str, Fraction] | None = None
    robust: bool | None = None
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
        """Computed minus printed, in units of the last printed digit; None where there is none."""
        printed = self.claim.printed
        if self.reading is None or printed is None or printed.quantum == 0:
            return None
        return float((Fraction(self.reading.computed) - printed.value) / printed.quantum)


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
        assert claim.interval is not None
        assert claim.computation is not None
        self.ledger, self.claim, self.name, self.function = ledger, claim, name, function
        self.computation = claim.readings.get(name, claim.computation)
        self.target = claim.interval.scaled(claim.si)
        self.nominal = {key: nominal(ledger, names) for key, names in claim.inputs.items()}
        self.point = {key: (value, value) for key, value in self.nominal.items()}

    def answer(self) -> Reading:
        at_nominal = explore(self.function, self.point, self.target)
        if at_nominal.always:
            everywhere = explore(self.function, self.admitted(), self.target)
            return self.reading(Verdict.REPRODUCED, everywhere, robust=everywhere.always)
        if not at_nominal.never:
            return self.reading(Verdict.UNDECIDED, at_nominal)
        return self.search()

    def search(self) -> Reading:
        """The inputs as printed do not give the number: do any that print like them?"""
        found = explore(self.function, self.box(), self.target)
        if found.inside is not None:
            return self.reading(Verdict.WITHIN_ROUNDING, found, witness=found.inside)
        widest = explore(self.function, self.box(outer=True), self.target)
        if not widest.never:
            return self.reading(Verdict.UNDECIDED, widest)
        loose = explore(self.function, self.box(outer=True, loose=True), self.target)
        return self.reading(Verdict.NOT_REPRODUCED, widest, loose=not loose.never)

    def admitted(self) -> dict[str, tuple[Fraction, Fraction]]:
        """Inputs as printed, with every admitted value of the inferred ones."""
        return {key: self.range(key, as_printed=True) for key in self.point}

    def box(self, outer: bool = False, loose: bool = False) -> dict[str, tuple[Fraction, Fraction]]:
        """Every input that prints like the report's."""
        as_printed = self.claim.as_printed_inputs
        return {key: self.range(key, as_printed, outer, loose) for key in self.point}

    def range(
        self, key: str, as_printed: bool, outer: bool = False, loose: bool = False
    ) -> tuple[Fraction, Fraction]:
        low = high = Fraction(1)
        for name in self.claim.inputs[key]:
            ends = self.entry(name, outer, loose)
            if as_printed and not name.startswith("inferred:"):
                ends = Interval.point(nominal(self.ledger, (name,)))
            assert ends.lower is not None
            assert ends.upper is not None
            low, high = low * ends.lower, high * ends.upper
        return low, high

    def entry(self, name: str, outer: bool, loose: bool) -> Interval:
        _, _, inferred = name.partition("inferred:")
        if not inferred:
            return self.ledger.claims[name].as_input(loose)
        inference = infer(self.ledger, inferred)
        return inference.outer if outer else inference.inner

    def reading(
        self,
        verdict: Verdict,
        explored: Exploration,
        witness: dict[str, Fraction] | None = None,
        robust: bool | None = None,
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
            robust=robust,
            loose=loose,
        )

    def replica(self) -> float:
        row = {} if self.claim.row is None else {"row": self.claim.row}
        inputs = {key: float(value) for key, value in self.nominal.items()}
        value = float(REPLICA[self.computation.name](**row, **inputs))
        return float(Fraction(value) / self.claim.si)

    def reference(self) -> str:
        numbers = {key: _REALS.number(value) for key, value in self.nominal.items()}
        value = self.function(_REALS, **numbers)
        if isinstance(value, Fraction):
            value = _REALS.number(value)
        digits = 25  # shown; computed to 50
        return str(_REALS.context.nstr(value / _REALS.number(self.claim.si), digits))

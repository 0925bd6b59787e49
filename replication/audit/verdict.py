"""The verdicts: whether a printed number or equation follows from what the report prints."""

from collections.abc import Iterator, Mapping
from fractions import Fraction
from functools import cache, cached_property, partial
from itertools import islice, product
from math import prod

import msgspec
from msgspec.structs import replace

from reference.arithmetic import InexactError, Rationals, Reals
from reference.enclosure import Box, Ends, enclose, satisfying
from reference.equations import EquationError, dimension
from reference.formulas import Check, Equation, derive
from reference.ledger import INFERRED, Claim, Convention, Ledger, in_header
from reference.printed import Interval, Rounding
from reference.units import Dimension, DimensionError
from replication.audit.inference import Inference
from replication.audit.record import ConstantRecord, Verdict
from replication.audit.replica import replica

_REALS, _RATIONALS = Reals(50), Rationals()


class Judgement(msgspec.Struct, frozen=True):
    """The verdict under one convention.

    `ends`: of a range that is proven to hold the value, in the claim's unit. Where the printed
    inputs give the number it covers all admitted values of the inferred inputs, else all inputs
    that print like the report's. `witness`: where the printed inputs do not give the number, some
    (SI) that do; a radius that was computed from the mass is given by the mass. `against_evidence`:
    some values in the range print like the claim, but their inputs are proven not to give the
    numbers from which an input is inferred.
    """

    convention: Convention
    verdict: Verdict
    ends: Ends
    witness: Mapping[str, Fraction] | None = None
    against_evidence: bool = False


class Reading(msgspec.Struct, frozen=True):
    """What one computation makes of a claim. All numbers are in the claim's unit.

    `computed` is the replica's double at the inputs as printed, `reference` the same to 25 digits;
    `judgements` hold one for every convention, the usual one first.
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
        """The conventions that give another verdict."""
        return [judgement for judgement in self.judgements if judgement.verdict != self.verdict]


class Assessment(msgspec.Struct, frozen=True):
    """The verdict on a claim, why, and the readings that it comes from; the first is as printed."""

    verdict: Verdict
    reason: str = ""
    readings: tuple[Reading, ...] = ()


def restates(ledger: Ledger, claim: Claim) -> bool:
    """Whether a claim that only repeats or counts agrees with what it repeats or counts.

    It does if some value prints like both texts and, of a bound, satisfies it.
    """
    assert claim.computation is not None
    if claim.computation.name == "count":
        return claim.target().contains(Fraction(len(claim.inputs)))
    (name,) = claim.inputs["value"]
    # A choice or an exact number has one value; a bound or an "about" has its own interval.
    loose = claim.bound is not None or claim.kind == "approximation"
    interval = claim.target() if loose else claim.as_input(Convention())
    return interval.meets(ledger.claims[name].as_input(Convention()))


class Judge:
    """Judges the claims of one ledger; what several of them ask for is computed once.

    With `every_convention` they are judged under all of them, else under the usual one only.
    """

    def __init__(self, ledger: Ledger, *, every_convention: bool = True) -> None:
        self.ledger, self.every_convention = ledger, every_convention
        self._inferences = cache(partial(Inference, ledger))

    def inference(
        self, name: str, *, centered: bool = False, rounding: Rounding = Rounding.AWAY
    ) -> Inference:
        """What the evidence, so rounded, says of an unprinted input, under one of the schemes."""
        return self._inferences(name, centered=centered, rounding=rounding)

    @cached_property
    def assumed(self) -> Mapping[str, Fraction]:
        """The value taken for every inferred input: the nominal one, if its evidence admits it."""
        values = {}
        for name in (INFERRED + key for key in self.ledger.inferred):
            inner, nominal = self.inference(name).inner, self.ledger.value(name)
            values[name] = nominal if inner.contains(nominal) else sum(inner.ends, Fraction(0)) / 2
        return values

    @property
    def moved(self) -> set[str]:
        """The inferred inputs whose evidence does not admit the nominal value."""
        return {name for name, value in self.assumed.items() if value != self.ledger.value(name)}

    def value(self, name: str) -> Fraction:
        """An entry's value as printed, or as assumed where it is inferred, in SI."""
        return self.assumed[name] if name in self.assumed else self.ledger.value(name)

    def assess(self, claim: Claim) -> Assessment:
        """The verdict on a claim that a computation gives; a reason only where it has no value.

        A claim whose formula has none at the inputs as printed does not follow from them.
        """
        if claim.computation is not None and claim.computation.restates:
            agrees = restates(self.ledger, claim)
            return Assessment(Verdict.CONSISTENT if agrees else Verdict.INCONSISTENT)
        try:
            readings = tuple(self._reading(claim, name) for name in claim.computations)
        except ArithmeticError as error:
            return Assessment(Verdict.NOT_REPRODUCED, str(error))
        return Assessment(readings[0].verdict, readings=readings)

    def _reading(self, claim: Claim, name: str) -> Reading:
        computation, function = claim.computations[name], self.ledger.function(claim, reading=name)
        exact = function(_REALS, **{e: _REALS.number(self.value(e)) for e in claim.entries})
        reference = _REALS.number(exact) if isinstance(exact, Fraction) else exact
        reference /= _REALS.number(claim.si)
        computed = float(reference)
        if not self.ledger.misprinted:  # of a misprint in an equation the models know nothing
            computed = float(Fraction(self.answer(claim, name)) / claim.si)
        digits = str(_REALS.context.nstr(reference, 25))
        judgements = islice(self._judgements(claim, name), None if self.every_convention else 1)
        in_unit = tuple(
            replace(judgement, ends=(judgement.ends[0] / claim.si, judgement.ends[1] / claim.si))
            for judgement in judgements
        )
        return Reading(name, computation.summary, computed, digits, in_unit)

    def answer(self, claim: Claim, name: str = "", scheme: str = "published") -> float:
        """What the models give for a claim at its inputs as printed, in SI."""
        computation = claim.computations[name]
        inputs = {key: float(prod(map(self.value, names))) for key, names in claim.inputs.items()}
        settings: dict[str, object] = {"row": claim.row} if computation.by_row else {}
        if computation.by_scheme:
            settings["scheme"] = scheme
        return replica(computation.name, inputs, **settings)

    def _judgements(self, claim: Claim, name: str) -> Iterator[Judgement]:
        """Under every convention that makes a difference, the usual one first; ends in SI."""
        printed = self.printed(claim)
        for centered in (False, True) if claim.by_scheme else (False,):
            inferred = {e: self.inference(e, centered=centered).inner.ends for e in claim.inferred}
            at_print = everywhere = self._range(claim, name, centered, printed)
            if inferred:
                everywhere = self._range(claim, name, centered, {**printed, **inferred})
            for rounding in Rounding:
                convention, target = Convention(rounding, centered=centered), claim.target(rounding)
                if target.excludes(*at_print):
                    conventions = _input_conventions(self.ledger, claim, convention)
                    yield from map(partial(self._search, claim, name), conventions)
                elif target.encloses(*everywhere):
                    yield Judgement(convention, Verdict.REPRODUCED, everywhere)
                elif target.encloses(*at_print):
                    # Only some admitted values do: the evidence does not tell which is meant.
                    witness = {entry: self.value(entry) for entry in claim.entries}
                    yield Judgement(convention, Verdict.WITHIN_ROUNDING, everywhere, witness)
                else:
                    yield Judgement(convention, Verdict.UNDECIDED, everywhere)

    def _search(self, claim: Claim, name: str, convention: Convention) -> Judgement:
        """The inputs as printed do not give the number: do others that print like them?

        Those must also give the numbers from which an input is inferred. A radius that was computed
        from the mass is given by the mass.
        """
        target = claim.target(convention.rounding)
        function = self.ledger.function(claim, reading=name, centered=convention.centered)
        box = own_box = self.box(claim, convention)
        ends = enclose(function, box).ends
        if target.excludes(*ends):
            return Judgement(convention, Verdict.NOT_REPRODUCED, ends)
        budget = _BUDGET // 10 if claim.by_whole_sheet else _BUDGET
        own = constraints = [(function, target)]
        names, wide = set(claim.entries), dict[str, Ends]()
        for entry in claim.inferred:
            inference = self.inference(entry, centered=convention.centered)
            constraints, box = inference.joint(convention, box, constraints)
            wide[entry] = inference.entry.search
            if inference.entry.radius in names - box.keys():
                names.add(inference.entry.mass)
        outcome, point = satisfying(constraints, box, budget)
        if outcome is None and wide:
            # In halves of its whole range of search, an inferred input may be narrowed sooner.
            outcome, point = satisfying(constraints, {**box, **wide}, budget)
        witness = point and {entry: x for entry, x in point.items() if entry in names}
        against_evidence = bool(
            wide and outcome is False and satisfying(own, own_box, _BUDGET // 10)[0]
        )
        return Judgement(convention, _VERDICTS[outcome], ends, witness, against_evidence)

    def telling(self, claim: Claim) -> list[str]:
        """The inferred inputs on which a claim's value, as printed, is not proven not to depend."""
        inferred = {entry: self.inference(entry).inner.ends for entry in claim.inferred}
        if not inferred:
            return []
        idle = enclose(self.ledger.function(claim), {**self.printed(claim), **inferred}).idle
        return [entry for entry in claim.inferred if entry not in idle]

    def printed(self, claim: Claim) -> Box:
        """The inputs of a claim as printed, or as assumed where they are inferred."""
        return {entry: (self.value(entry),) * 2 for entry in claim.entries}

    def box(self, claim: Claim, convention: Convention) -> Box:
        """All inputs of a claim that print like the report's, or that its evidence admits."""
        return {entry: self.rounded(entry, convention).ends for entry in claim.entries}

    def rounded(self, entry: str, convention: Convention) -> Interval:
        """The values of an input (SI) that print like it, or that its evidence admits."""
        if entry in self.ledger.claims:
            return self.ledger.claims[entry].as_input(convention)
        return self.inference(entry, centered=convention.centered).admitted(convention)

    def _range(self, claim: Claim, name: str, centered: bool, box: Box) -> Ends:
        """A proven range of a claim's values, in SI.

        One exact value if the box allows only one, by inputs that make a difference, and that is
        rational: only so can it be told to lie exactly on an end of a printed interval.
        """
        function = self.ledger.function(claim, reading=name, centered=centered)
        range_, computation = enclose(function, box), claim.computations[name]
        decided = all(claim.target(rounding).decides(*range_.ends) for rounding in Rounding)
        # Of a whole sheet, or where a row squares twice, the fractions grow very long.
        long = computation.by_scheme and (not computation.by_row or (centered and decided))
        if long or any(box[entry][0] != box[entry][1] for entry in box.keys() - range_.idle):
            return range_.ends
        try:
            exact = Fraction(function(_RATIONALS, **{key: low for key, (low, _) in box.items()}))
        except InexactError:
            return range_.ends
        return exact, exact


_VERDICTS = {
    True: Verdict.WITHIN_ROUNDING, False: Verdict.NOT_REPRODUCED, None: Verdict.UNDECIDED,
}  # fmt: skip
"""By whether some inputs that print like the report's give the number."""

_BUDGET = 100
"""Most boxes that a search tries; a tenth of it for whole sheets, each of which takes 10 ms."""


def _input_conventions(ledger: Ledger, claim: Claim, usual: Convention) -> Iterator[Convention]:
    """The conventions on inputs that make a difference to the claim, the usual one first.

    Where a sheet's result is taken as cut off, its inputs are exact: Table A-1, which the same
    sheet printed, is not cut off, so it is not asked which rounded inputs would do. For a result of
    the whole sheet the author's choices are exact: if the 5 of beta were rounded to its one digit,
    any depth would do.
    """
    claims = [ledger.claims[entry] for entry in claim.stated]
    chosen = any(entry.chosen for entry in claims)
    header = bool(claim.inferred) or any(in_header(entry.cell) for entry in claims)
    if claim.by_scheme and usual.rounding is Rounding.CUT:
        yield replace(usual, header_exact=True)
        return
    choices_exact = (True, False) if chosen and not claim.by_whole_sheet else (True,)
    for choices, head in product(choices_exact, (False, True) if header else (False,)):
        yield replace(usual, choices_exact=choices, header_exact=head)


# Equations, and the constants in them


class EquationAssessment(msgspec.Struct, frozen=True):
    """The verdict on an equation with the checks that it comes from."""

    equation: Equation
    verdict: Verdict
    checks: tuple[Check, ...]
    constants: Mapping[str, ConstantRecord]

    @property
    def factor(self) -> Fraction | None:
        """Printed over derived; None where they do not differ, or in more than a number."""
        return next((check.factor for check in self.checks if check.factor is not None), None)


def assess_equation(ledger: Ledger, name: str, *, constants: bool = True) -> EquationAssessment:
    """The verdict on one equation, and, if they are asked for, on its constants.

    One that the report derives must pass every check; of one that it takes over only dimensions,
    limits and signs can be checked, and it stays "not checkable" where they hold.

    >>> from reference.ledger import load
    >>> assess_equation(load(), "eq16").factor
    Fraction(1, 2)
    """
    equation, checks = ledger.equations[name], tuple(_checks(ledger, name))
    holds = all(check.holds for check in checks)
    passed, failed = {
        "derived": (Verdict.REPRODUCED, Verdict.NOT_REPRODUCED),
        "definition": (Verdict.CONSISTENT, Verdict.INCONSISTENT),
        "taken over": (Verdict.NOT_CHECKABLE, Verdict.NOT_REPRODUCED),
    }[equation.kind]
    judged = _constants(ledger, name, holds) if constants else {}
    return EquationAssessment(equation, passed if holds else failed, checks, judged)


def follows(ledger: Ledger, name: str) -> bool:
    """Whether an equation passes every check."""
    return all(check.holds for check in _checks(ledger, name))


def _checks(ledger: Ledger, name: str) -> Iterator[Check]:
    """Its derivation first: the dimensions alone are seldom what is wrong."""
    try:
        ledger.read(ledger.printed_text(name))
    except EquationError as error:
        yield Check(str(error), holds=False)
        return
    try:
        yield from derive(ledger.equations[name], ledger.sides, ledger.written)
    except (EquationError, ZeroDivisionError, KeyError, ValueError) as error:
        yield Check(f"it can be derived: {error}", holds=False)
    known: dict[str, Dimension | Fraction] = {**ledger.dimensions}
    known |= {key: ledger.value(s.value) for key, s in ledger.symbols.items() if s.value}
    says = "both sides have the same dimensions"
    try:
        units = [dimension(side, known) for side in ledger.sides[name]]
        yield Check(says, all(unit == units[0] for unit in units))
    except (DimensionError, EquationError) as error:
        yield Check(f"{says}: {error}", holds=False)


def _constants(ledger: Ledger, name: str, holds: bool) -> dict[str, ConstantRecord]:
    printed = {claim: ledger.value(claim) for claim in ledger.constants_of(name)}

    def passing(claim: str, corrected: Mapping[str, Fraction]) -> list[Fraction]:
        """The values of a constant with which every check holds, another constant corrected."""
        tried = sorted({*_USUAL, *(printed[claim] * factor for factor in (1, 2, Fraction(1, 2)))})
        texts = {value: ledger.printed_text(name, {**corrected, claim: value}) for value in tried}
        return [v for v, text in texts.items() if follows(ledger.misprint(name, text), name)]

    needed = {claim: passing(claim, {}) for claim in printed}
    repairs = [] if holds else [claim for claim, values in needed.items() if values]
    if len(repairs) == 1:
        # The others are judged with that one corrected.
        (culprit,) = repairs
        corrected = {culprit: needed[culprit][0]}
        needed |= {claim: passing(claim, corrected) for claim in printed if claim != culprit}
    constants = {}
    for claim, values in needed.items():
        verdict = Verdict.NOT_REPRODUCED if values else Verdict.UNDECIDED
        if printed[claim] in values:
            verdict = Verdict.REPRODUCED if len(values) == 1 else Verdict.NOT_CHECKABLE
        constants[claim] = ConstantRecord(claim=claim, verdict=verdict, needed=[*map(str, values)])
    return constants


_USUAL = tuple(map(Fraction, ("1/4", "1/3", "1/2", "2/3", "1", "4/3", "3/2", "2", "7/3", "3", "4")))
"""Constants that equations of physics have; a printed one is told apart from all of these."""
